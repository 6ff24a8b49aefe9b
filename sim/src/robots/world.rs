//! One mission of a robot, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise and
//! lower their flags, which are diagnosed; the supervisors take a round and are told one thing. So
//! a run is a run of the nets that were checked.

use super::drawn::Drawing;
use super::failing::Failures;
use super::hindered::Hindered;
use super::monitor::Watching;
use super::operator::Operator;
use super::{Conduct, DoorChange, Injection, Run, Script};
use crate::body::{Drive, Ground, Mover};
use crate::plan::{Planning, Progress};
use crate::record::{Recorder, Silent};
use crate::run::{LONGEST, Outcome};
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::level::{Decider, Level, Tables};
use cotama_models::missions::Mission;
use cotama_models::missions::tables::Rest;
use cotama_models::robots::{Body, Global, Moment, Parts, Robot, Where};
use records::Recording;
use std::collections::BTreeSet;

mod motion;
mod observing;
mod passing;
mod planning;
mod records;
mod telling;

/// A mission under way.
pub(super) struct World<'m, P, const W: usize, const S: usize> {
    pub(super) mission: &'m Mission,
    pub(super) robot: &'m Robot,
    body: &'m Body,
    pub(super) decider: Decider<'m, P, W, 0, S>,
    pub(super) planning: Planning<'m>,
    pub(super) now: Millis,
    pub(super) drive: Mover<'m>,
    energy_uj: u64,
    waiting: Vec<Injection>,
    doors: Vec<DoorChange>,
    until: Vec<Option<Moment>>,
    failures: Failures,
    hindered: Hindered,
    operator: Operator,
    /// The parts that are known to be lost.
    pub(super) known: Parts,
    /// The failures that are known to have taken them.
    known_rows: BTreeSet<usize>,
    /// The modules that were started anew in this period, a bit each.
    restarted: u64,
    /// The place of the global supervisor, the objective, and since when it is under way.
    global: Global,
    pub(super) objective: usize,
    objective_since: Millis,
    /// Since when the robot is where it is in its drive, and when it came to places first.
    place: Where,
    place_since: Millis,
    first: Vec<(Option<usize>, Millis)>,
    withdrawn: Option<Millimetres>,
    permitted: bool,
    pub(super) period: Millis,
    pub(super) run: Run,
    watching: Watching<'m>,
    /// When transitions fired last, and which.
    last: (Millis, Vec<String>),
    /// Whether it was told that no plan is left.
    planless: bool,
    /// Whether nothing happened in the last period.
    calm: bool,
    /// The observations of the last period in which the computer was up.
    #[cfg(test)]
    pub(super) observed: Option<Observed>,
}

/// Flags as they are raised and up, and the modules that work.
#[cfg(test)]
pub(super) struct Observed {
    pub(super) now: Millis,
    pub(super) raised: u64,
    pub(super) up: u64,
    pub(super) works: u64,
}

#[cfg(test)]
impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Goes on for a period; whether the mission goes on, and the computer is up.
    pub(super) fn goes_on(&mut self) -> bool {
        let mut silent = Silent;
        self.step(&mut Recording::new(&mut silent));
        self.end().is_none() && self.failures.thinks(self.robot)
    }

    fn note_observed(&mut self, now: Millis) {
        let tables = self.tables();
        let flags = |row: usize| tables.failures.get(row).map_or(0, |it| it.flags);
        let new = self.run.conduct.iter().filter(|it| it.detected == Some(now));
        let open = self.failures.all.iter().filter(|it| it.found && !it.over);
        self.observed = Some(Observed {
            now,
            raised: new.fold(0, |set, it| set | flags(it.failure)),
            up: open.fold(0, |set, it| set | flags(it.number)),
            works: self.robot.available(self.failures.broken(self.robot)),
        });
    }
}

impl<'m, P: Program<W, 0, S>, const W: usize, const S: usize> World<'m, P, W, S> {
    /// A robot at the start of its mission, with its plan; `None` where the mission has no robot
    /// with a body.
    pub(super) fn start(
        tables: &'m Tables<'m>,
        program: P,
        planning: Planning<'m>,
        script: &Script,
        ground: Option<(&'m Ground, u64)>,
        period: Millis,
        watching: Watching<'m>,
    ) -> Option<Self> {
        let mission = planning.mission();
        let robot = mission.robot()?.robot();
        let body = robot.body.as_ref()?;
        let run = Run {
            outcome: Outcome::Failed,
            time: Millis(0),
            x: Millimetres(0),
            used: [0; 2],
            operator_requests: 0,
            alarms: Vec::new(),
            told: Vec::new(),
            rounds: 0,
            conduct: Vec::new(),
            configurations: Vec::new(),
            plans: Vec::new(),
            spent: Vec::new(),
            exposed: Millis(0),
            braked: Millimetres(0),
            moved_when_safe: false,
            unseen: Millis(0),
            planned_with_lost: false,
            ended_by: None,
            fired: BTreeSet::new(),
            touched: None,
            missed: None,
            blocked: None,
            violated: None,
        };
        let drive = Mover::new(robot, ground);
        let signals = drive.flags();
        let doors = if drive.line().is_some() { Vec::new() } else { script.doors.clone() };
        Some(Self {
            mission,
            robot,
            body,
            decider: Decider::new(Level::start(tables, program)),
            planning,
            now: Millis(0),
            drive,
            energy_uj: 0,
            waiting: script.injections.clone(),
            doors,
            until: Vec::new(),
            failures: Failures { period: body.period, signals, ..Failures::default() },
            hindered: Hindered::new(&script.events, &script.power_errors),
            operator: Operator::new(&script.answers),
            known: Parts::NONE,
            known_rows: BTreeSet::new(),
            restarted: 0,
            global: Global::Waits,
            objective: 0,
            objective_since: Millis(0),
            place: Where::Rests,
            place_since: Millis(0),
            first: Vec::new(),
            withdrawn: None,
            permitted: false,
            period,
            run,
            watching,
            last: (Millis(0), Vec::new()),
            planless: false,
            calm: false,
            #[cfg(test)]
            observed: None,
        })
    }

    /// Failures that are told are found as they were measured; by signals none is told.
    pub(super) fn draw(&mut self, drawing: Drawing) {
        self.failures.drawing = Some(drawing).filter(|_| self.failures.signals.is_none());
    }

    /// Runs to the end.
    pub(super) fn run<R: Recorder>(&mut self, recorder: &mut R) {
        let mut recording = Recording::new(recorder);
        self.record_plan(&mut recording);
        loop {
            self.step(&mut recording);
            self.record_progress(&mut recording);
            if !R::WANTED && self.end().is_none() {
                self.pass_over();
            }
            if let Some(outcome) = self.end() {
                self.run.missed = self.missed(outcome);
                self.run.outcome = outcome;
                break;
            }
        }
        self.record_end(&mut recording);
    }

    /// Runs until something is diagnosed after the first failure, or nothing is within a time.
    pub(super) fn look(&mut self, window: Millis) {
        let mut silent = Silent;
        let mut recording = Recording::new(&mut silent);
        while self.end().is_none() {
            self.step(&mut recording);
            let is_over = self.run.conduct.first().is_some_and(|it| {
                it.detected.is_some() || self.now.0 >= it.injected.0.saturating_add(window.0)
            });
            if is_over {
                break;
            }
        }
        (self.run.time, self.run.x) = (self.now, self.drive.x());
    }

    /// Goes on for a time after the robot was made safe, and notes whether it moves.
    pub(super) fn stand_for(&mut self, after: Millis) {
        let (until, from) = (self.now.0.saturating_add(after.0), self.drive.x());
        let (used, now) = (self.used(), self.now);
        let mut silent = Silent;
        let mut recording = Recording::new(&mut silent);
        while self.run.outcome == Outcome::Safe && self.now.0 < until {
            self.step(&mut recording);
        }
        self.run.moved_when_safe |= self.drive.x() > from;
        (self.run.time, self.run.x, self.run.used) = (now, from, used);
    }

    /// The run, when it is over.
    pub(super) fn into_run(mut self) -> Run {
        let at = Progress { used: self.run.used, ..self.progress() };
        self.run.spent = self.planning.spent(&at);
        self.run.plans = self.planning.made;
        self.run.unseen = self.failures.unseen;
        self.run
    }

    fn step<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let before = self.drive.line().copied();
        self.calm = true;
        self.fail(recording);
        let happened = self.hindered.happen(self.now, &mut self.drive);
        self.travel();
        let met = self.meet(recording);
        let is_even =
            |(now, before): (&Drive, Drive)| now.is_steady_since(&before, self.body.period);
        self.calm &= match self.drive.line().zip(before) {
            Some(lines) => is_even(lines),
            None => self.drive.is_alone() && !met,
        };
        if self.failures.thinks(self.robot) {
            self.observe(recording);
            self.see(self.now);
            if !happened.is_empty() || met || self.looks_at_margins() {
                self.watch_margins(recording);
            }
            self.round(recording);
        }
        self.now.0 += self.body.period.0;
        debug_assert!(self.is_sound());
    }

    /// Returns whether what is planned, known and driven fits together.
    fn is_sound(&self) -> bool {
        let places = self.now.0.is_multiple_of(self.body.period.0)
            && self.place_since <= self.now
            && self.objective_since <= self.now
            && self.objective <= self.mission.objectives.len();
        let failures = self.until.len() == self.failures.all.len()
            && self.run.conduct.len() == self.failures.all.len();
        let found = self.run.conduct.iter().all(|it| {
            it.injected <= self.now && it.detected.is_none_or(|found| found >= it.injected)
        });
        places && failures && found && self.drive.speed() <= self.body.speed_max
    }

    /// Whether margins are looked at in this period: once a second.
    pub(super) fn looks_at_margins(&self) -> bool {
        self.now.0 / 1_000 != self.now.0.saturating_sub(self.body.period.0) / 1_000
    }

    /// How the mission ends, if it does.
    fn end(&self) -> Option<Outcome> {
        // By signals, contact is seen: a flag is raised, and the supervisors decide.
        let is_told = self.failures.signals.is_none();
        if self.run.violated.is_some() || (is_told && self.run.touched.is_some()) {
            return Some(Outcome::Failed);
        }
        let stands = self.drive.stands();
        if stands && self.run.blocked.is_some() {
            return Some(self.within(Outcome::Safe));
        }
        let left_alone = !self.failures.thinks(self.robot)
            && stands
            && (!self.level().permits() || self.failures.is_abandoned(self.robot, self.now));
        match self.global {
            Global::Safe if stands => Some(self.within(Outcome::Safe)),
            _ if left_alone => Some(self.within(Outcome::Safe)),
            Global::Done => Some(self.within(Outcome::Completed)),
            _ if self.now >= LONGEST => Some(Outcome::Failed),
            _ => None,
        }
    }

    fn within(&self, outcome: Outcome) -> Outcome {
        let limits = self.mission.scenario().limits;
        let within = self.used().iter().zip(limits).all(|(used, limit)| *used <= limit);
        if within && self.missed(outcome).is_none() { outcome } else { Outcome::Failed }
    }

    /// The end constraint of a mission with axes that does not hold, and by how much.
    fn missed(&self, outcome: Outcome) -> Option<(usize, u64)> {
        self.planning.missed(&self.progress(), outcome == Outcome::Completed)
    }

    /// Duration and energy used, in ms and mJ.
    pub(super) const fn used(&self) -> [u64; 2] {
        [self.now.0, self.energy_uj / 1_000]
    }

    fn is_due(&self, when: Moment) -> bool {
        let since = |place: Option<usize>, after: Millis| {
            let first = self.first.iter().find(|it| it.0 == place);
            first.is_some_and(|it| self.now.0 >= it.1.0 + after.0)
        };
        match when {
            Moment::Place(x) => self.drive.x() >= x,
            Moment::At(at) => self.now >= at,
            Moment::During(place, after) => since(Some(place), after),
            Moment::Waiting(after) => since(None, after),
        }
    }

    /// Injects the failures that are due, and ends those that are over.
    fn fail<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let (due, wait): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.waiting).into_iter().partition(|it| self.is_due(it.when));
        self.waiting = wait;
        let ended: Vec<bool> =
            self.until.iter().map(|it| it.is_some_and(|it| self.is_due(it))).collect();
        let ends = |it: usize| ended.get(it).copied().unwrap_or(false);
        self.failures.end(self.robot, self.now, ends);
        self.calm &= due.is_empty();
        let (open, wait): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.doors).into_iter().partition(|it| self.is_due(it.when));
        self.doors = wait;
        open.iter().for_each(|it| self.drive.set_door(it.door, it.is_open));
        for it in due {
            self.begin(it.failure, it.until, recording);
        }
    }

    /// A failure begins.
    fn begin<R: Recorder>(
        &mut self,
        failure: usize,
        until: Option<Moment>,
        recording: &mut Recording<'_, R>,
    ) {
        self.failures.fail(self.robot, self.now, failure);
        self.until.push(until);
        self.run.conduct.push(Conduct {
            failure,
            injected: self.now,
            x: self.drive.x(),
            during: self.place,
            detected: None,
            taken_for: Vec::new(),
            decided: None,
            answered: None,
            exposed: Millis(0),
        });
        self.record_failure(recording, failure);
    }

    /// The supervisors.
    pub(super) const fn level(&self) -> &Level<'m, P, W, 0, S> {
        self.decider.level()
    }

    pub(super) const fn tables(&self) -> &'m Tables<'m> {
        self.decider.level().tables()
    }

    /// Whether a drive is under way.
    pub(super) fn drives(&self) -> bool {
        matches!(self.global, Global::Does(_)) && !self.objective_stands()
    }

    /// The configuration that runs.
    pub(super) const fn configuration(&self) -> Option<usize> {
        match self.place {
            Where::Runs { configuration, .. } => Some(configuration),
            Where::Rests | Where::Waits => None,
        }
    }

    /// The activity under way.
    pub(super) fn activity(&self) -> usize {
        let last = self.mission.scenario().activities.len().saturating_sub(1);
        if self.objective >= self.mission.objectives.len() {
            return last;
        }
        self.planning.activity(self.objective, self.drive.x().0).min(last)
    }

    /// How far the mission has come.
    pub(super) fn progress(&self) -> Progress {
        let (x, t_us) = (self.drive.x(), self.now.0.saturating_mul(1_000));
        let (used, runs) = (self.used(), self.configuration());
        let at = Progress { t_us, used, runs, ..Progress::start(x) };
        let Some(objective) = self.mission.objectives.get(self.objective) else {
            return Progress { first: self.mission.scenario().activities.len(), ..at };
        };
        let first = self.planning.activity(self.objective, x.0);
        if objective.travels() {
            let end = self.mission.scenario().activities.get(first).map_or(0, |it| it.x_end.0);
            let left = Millimetres((end.saturating_sub(x.0) + self.drive.owed().0).max(1));
            let beside = self.planning.slower(first, left, |it| self.lasting_speed(it));
            Progress { first, rest: Some(Rest::Travel(left)), beside, ..at }
        } else {
            let done = self.now.0.saturating_sub(self.objective_since.0);
            let left = Millis(self.planning.standing(first).0.saturating_sub(done));
            Progress { first, rest: Some(Rest::Time(left)), ..at }
        }
    }

    /// The fastest that a configuration goes from now on, as far as is known: settings that answer
    /// failures which stay hold the robot back for all of its way.
    fn lasting_speed(&self, configuration: usize) -> MillimetresPerSecond {
        let of = self.robot.configurations.get(configuration);
        let left = u64::from(self.decider.adapted().lasting_speed(self.tables()));
        of.map_or(MillimetresPerSecond(0), |it| MillimetresPerSecond(it.speed.0 * left / 1_000))
    }
}
