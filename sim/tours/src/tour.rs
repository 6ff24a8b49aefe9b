//! The robot on its way, second after second.

use crate::leg::{Leg, real_factor};
use crate::limits::Limit;
use crate::run::{Cause, Choice, NotRun, Outcome, Planned, Run};
use crate::safe::{Safe, without};
use cotama_axes::{
    Activity, Ask, Case, Course, Lifted, Mission, Plan, Problem, Steps, Stop, Table, What,
};

mod safety;

/// Margins are looked at so often, in ms.
pub const PERIOD_MS: i64 = 1_000;

/// A plan at work: activities with the candidates that were taken, from the one under way on.
#[derive(Debug, Default)]
struct Rest {
    table: Table,
    choices: Vec<usize>,
    /// Objectives of the mission before the first one of the table.
    before: usize,
    at: usize,
}

impl Rest {
    fn step(&self) -> Option<(&Activity, usize)> {
        Some((self.table.activities.get(self.at)?, *self.choices.get(self.at)?))
    }

    /// Returns what the activities after the one under way take of an indicator.
    fn later(&self, indicator: usize) -> i64 {
        let rows = self.table.activities.iter().zip(&self.choices).skip(self.at + 1);
        let value = |(it, choice): (&Activity, &usize)| {
            it.candidates.get(*choice).map_or(0, |it| it.value(indicator))
        };
        rows.map(value).sum()
    }
}

struct Tour<'m> {
    mission: &'m Mission,
    ask: &'m [Ask],
    course: &'m Course,
    limits: Vec<Limit>,
    safe: Option<Safe>,
    steps: Steps,
    /// Units of each kind of hardware that work.
    units: Vec<i64>,
    /// Whether each event has happened.
    happened: Vec<bool>,
    /// Sums that were used before the leg under way, by indicator.
    used: Vec<i64>,
    t_ms: i64,
    x_mm: i64,
    /// The objective of the mission, by index.
    objective: usize,
    rest: Rest,
    plans: Vec<Planned>,
    turned: Option<(i64, i64)>,
    hurried: Option<(i64, i64)>,
}

/// Runs a mission with its plan of the start, and plans again where it must.
///
/// # Errors
/// A [`NotRun`] where the robot does not leave.
pub fn run(case: &Case) -> Result<Run, NotRun> {
    let (mission, course) = (&case.mission, &case.course);
    let limits = Limit::all(mission).map_err(NotRun::Equality)?;
    let mut steps = Steps::default();
    let stated = course.home.as_ref();
    let safe = stated.map(|it| Safe::new(mission, it, &limits, &mut steps)).transpose()?;
    let mut tour = Tour {
        mission,
        ask: &case.ask,
        course,
        limits,
        safe,
        steps,
        units: mission.hardware.iter().map(|it| it.units).collect(),
        happened: vec![false; course.script.events.len()],
        used: vec![0; mission.indicators.len()],
        t_ms: 0,
        x_mm: mission.objectives.first().map_or(0, |it| it.x_start_mm),
        objective: 0,
        rest: Rest::default(),
        plans: Vec::new(),
        turned: None,
        hurried: None,
    };
    let rest = tour.planned(0, None).map_err(|it| match it {
        Stop::Limit => NotRun::Limit,
        Stop::Wrong(it) => NotRun::Wrong(it),
    })?;
    tour.rest = rest.ok_or(NotRun::NoPlan)?;
    tour.note(Cause::Start);
    let outcome = tour.drive();
    Ok(Run {
        outcome,
        t_ms: tour.t_ms,
        x_mm: tour.x_mm,
        used: tour.used,
        plans: tour.plans,
        turned: tour.turned,
        hurried: tour.hurried,
    })
}

/// Fate of a leg.
enum After {
    Done,
    /// The rest was planned again, from where the robot is.
    Again,
    Ended(Outcome),
}

impl Tour<'_> {
    fn drive(&mut self) -> Outcome {
        loop {
            let Some((activity, choice)) = self.rest.step() else { return self.arrived() };
            let candidate = activity.candidates.get(choice).filter(|it| self.works(&it.options));
            let Some(candidate) = candidate else { return Outcome::Stopped };
            let script = &self.course.script;
            let factor = |it: usize| real_factor(script, it, &activity.zones);
            let leg = Leg::new(self.mission, activity, candidate, factor);
            self.objective = self.rest.before + activity.objective;
            match self.go(leg) {
                After::Done => self.rest.at += 1,
                After::Again => {}
                After::Ended(outcome) => return outcome,
            }
        }
    }

    /// Goes on with a leg to its end, or to where the rest is planned again.
    fn go(&mut self, mut leg: Leg) -> After {
        loop {
            if let Some(after) = self.happen(&mut leg) {
                return after;
            }
            if let Some(after) = self.look(&mut leg) {
                return after;
            }
            if leg.left_ms() <= 0 {
                self.take(&leg);
                return After::Done;
            }
            let ms = self.next_ms(&leg);
            if let Some(outcome) = self.keep_safe(&leg, ms) {
                return outcome;
            }
            leg.done_ms += ms;
            self.t_ms += ms;
            self.x_mm = leg.x_mm(0);
            let used = |it: &Limit| self.used_in(&leg, it.indicator);
            let spent = self.limits.iter().find(|it| it.most().is_some_and(|most| used(it) > most));
            if let Some(it) = spent.map(|it| it.constraint) {
                self.take(&leg);
                return After::Ended(Outcome::Stranded(it));
            }
        }
    }

    /// Returns the time to the next look, event or end.
    fn next_ms(&self, leg: &Leg) -> i64 {
        let period = PERIOD_MS - self.t_ms.rem_euclid(PERIOD_MS);
        let events = self.course.script.events.iter().zip(&self.happened).filter(|it| !it.1);
        let ahead = events.map(|it| it.0.x_mm).filter(|it| leg.travels() && *it > self.x_mm);
        let event = ahead.map(|it| leg.until_ms(it)).min().unwrap_or(period);
        period.min(event).min(leg.left_ms()).max(1)
    }

    fn used_in(&self, leg: &Leg, indicator: usize) -> i64 {
        self.used.get(indicator).copied().unwrap_or(0) + leg.used(indicator)
    }

    /// Counts what a leg used; nothing more is counted of it.
    fn take(&mut self, leg: &Leg) {
        for (at, used) in self.used.iter_mut().enumerate() {
            *used += leg.used(at);
        }
    }

    /// Events of the places that were reached happen.
    fn happen(&mut self, leg: &mut Leg) -> Option<After> {
        let course = self.course;
        let mut lost = None;
        for (event, happened) in course.script.events.iter().zip(&mut self.happened) {
            if *happened || event.x_mm > self.x_mm {
                continue;
            }
            *happened = true;
            match &event.what {
                What::Costs(costs) => {
                    for (indicator, cost) in costs {
                        if let Some(used) = self.used.get_mut(*indicator) {
                            *used += cost;
                        }
                    }
                }
                What::Lost(hardware, units) => {
                    if let Some(it) = self.units.get_mut(*hardware) {
                        *it = (*it - units).max(0);
                        lost = Some(*hardware);
                    }
                }
            }
        }
        let hardware = lost.filter(|_| self.needs_lost(leg))?;
        Some(self.again(leg, Cause::Lost(hardware)))
    }

    /// Whether the plan needs hardware that does not work.
    fn needs_lost(&self, leg: &Leg) -> bool {
        let rows = self.rest.table.activities.iter().zip(&self.rest.choices).skip(self.rest.at + 1);
        let later =
            rows.filter_map(|(it, choice)| it.candidates.get(*choice)).map(|it| &it.options);
        std::iter::once(&leg.options).chain(later).any(|it| !self.works(it))
    }

    fn works(&self, options: &[usize]) -> bool {
        let mut needs = options.iter().filter_map(|&it| self.mission.options.get(it));
        needs.all(|it| it.needs.iter().zip(&self.units).all(|(need, units)| need <= units))
    }

    /// Looks at the margins, once a period and where a leg begins.
    fn look(&mut self, leg: &mut Leg) -> Option<After> {
        if self.hurried.is_some() || (self.t_ms % PERIOD_MS != 0 && leg.done_ms != 0) {
            return None;
        }
        let last = |it: &Limit| {
            let used = self.used_in(leg, it.indicator) + leg.planned_rest(it.indicator);
            it.margin(used + self.rest.later(it.indicator))
        };
        let broken = self.limits.iter().find(|it| last(it) < 0)?.constraint;
        Some(self.again(leg, Cause::Margin(broken)))
    }

    /// Plans the rest again: of a drive from where the robot is, of a task from its end on.
    fn again(&mut self, leg: &mut Leg, cause: Cause) -> After {
        let stays = !leg.travels() && leg.done_ms > 0 && self.works(&leg.options);
        self.take(leg);
        let under_way = stays.then_some(&*leg);
        match self.planned(self.objective + usize::from(stays), under_way) {
            Ok(Some(rest)) => {
                self.rest = rest;
                self.note(cause);
                if stays {
                    self.finish_task(leg);
                }
                After::Again
            }
            Ok(None) | Err(_) => self.go_safely(),
        }
    }

    /// Ends a task that was under way when the rest was planned.
    fn finish_task(&mut self, leg: &mut Leg) {
        let before: Vec<_> = (0..self.used.len()).map(|it| leg.used(it)).collect();
        self.t_ms += leg.left_ms();
        leg.done_ms += leg.left_ms();
        for ((at, used), before) in self.used.iter_mut().enumerate().zip(before) {
            *used += leg.used(at) - before;
        }
    }

    /// Returns the best plan of the rest; `None` where none keeps the constraints. A task that is
    /// under way goes on as planned.
    fn planned(&mut self, first: usize, under_way: Option<&Leg>) -> Result<Option<Rest>, Stop> {
        let mut left = without(self.mission, &self.units);
        left.objectives.drain(..first.min(left.objectives.len()));
        if let Some(it) = left.objectives.first_mut().filter(|it| it.x_start_mm < it.x_end_mm) {
            it.x_start_mm = it.x_start_mm.max(self.x_mm);
        }
        let last: Vec<_> = self.limits.iter().map(|it| it.constraint).collect();
        for (at, it) in left.constraints.iter_mut().enumerate() {
            if last.contains(&at) || it.kind == cotama_axes::Kind::Running {
                let task = under_way.map_or(0, |leg| leg.planned_rest(it.indicator));
                let used = self.used.get(it.indicator).copied().unwrap_or(0) + task;
                it.goal -= used;
                it.at.iter_mut().for_each(|it| it.1 -= used);
            }
        }
        let table = Table::new(&left, Lifted::default(), &mut self.steps)?;
        let problem = Problem::new(&left, &table, Lifted::default());
        let found: Option<Plan> = problem.best(self.ask, &mut self.steps)?;
        Ok(found.map(|it| Rest { table, choices: it.choices, before: first, at: 0 }))
    }

    fn note(&mut self, cause: Cause) {
        let rows = self.rest.table.activities.iter().zip(&self.rest.choices);
        let choices = rows.filter_map(|(it, choice)| {
            let candidate = it.candidates.get(*choice)?;
            Some(Choice {
                objective: self.rest.before + it.objective,
                x_start_mm: it.x_start_mm,
                options: candidate.options.clone(),
                speed_mm_s: candidate.speed_mm_s,
            })
        });
        let choices = choices.collect();
        self.plans.push(Planned { t_ms: self.t_ms, x_mm: self.x_mm, cause, choices });
    }

    /// All is done.
    fn arrived(&self) -> Outcome {
        let value = |it: &Limit| self.used.get(it.indicator).copied().unwrap_or(0);
        let broken = self.limits.iter().find(|it| it.margin(value(it)) < 0);
        broken.map_or(Outcome::Completed, |it| Outcome::Missed(it.constraint))
    }
}
