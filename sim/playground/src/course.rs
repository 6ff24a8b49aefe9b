//! The course of a mission under a plan of faults: the decider of a page, period after period, in
//! a world of even motion.
//!
//! Flags rise as in the simulator: after the latency of a row of the FMECA, while an observer that
//! works can see it. The robot goes as fast as it may, and speeds up and brakes evenly. Energy,
//! margins, plans that are made again, obstacles and all that the plane adds are left out; what a
//! planner told in a run is a fault of that run.

use super::board::Board;
use super::pilot::{Pilot, Played, Seen, worked};
use alloc::vec::Vec;
use cotama_core::net::TransitionId;
use cotama_core::player::{Firing, Names, Observer};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::level::{Act, Cause, Drive, Global, Mode, Told, Where};
use operator::Operator;
use under_way::{Demand, Failures};

mod answer;
mod operator;
mod plan;
mod under_way;
mod world;

pub use plan::{Answers, Fault, Plan, numbers};
pub use world::{Leg, Module, Objective, Observer as Watch, Row, Runs, World};

/// Between two rounds, as in a page.
const PERIOD: u64 = 100;
/// The longest course: that of the simulator.
const LONGEST: u64 = 3_600_000;
/// Between two samples of the way.
const SAMPLE: u64 = 1_000;

/// When something happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// At this place of the path, in mm.
    Place(u64),
    /// So long after the start.
    At(Millis),
    /// So long after a sub-objective, by its number, began for the first time.
    During(usize, Millis),
    /// So long after the robot waited for the operator for the first time.
    Waiting(Millis),
}

/// The end of a course.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Not over after an hour.
    Never,
    /// The mission is accomplished.
    Done,
    /// The mission was ended, and the robot stands.
    Safe,
}

/// The fate of a fault: when it began, when its flags rose, and when it was over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fate {
    /// When it began.
    pub began: Option<Millis>,
    /// When its flags rose first.
    pub found: Option<Millis>,
    /// When it was over.
    pub over: Option<Millis>,
}

/// Something of a course that is worth a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The robot is elsewhere in its drive.
    Place(Where),
    /// New flags are taken for a failure, by its number.
    Taken(usize),
    /// The supervisors were told something, and accepted it.
    Told(Told),
    /// A transition fired, by its number on the board.
    Fired(u32),
}

/// A period as the decider saw and heard it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Input {
    /// When.
    pub at: Millis,
    /// All that there was to see, and the word that was said.
    pub seen: Seen,
    /// True if the robot moves without a permit.
    pub coasts: bool,
}

/// A course from its start to its end.
#[derive(Clone, Debug)]
pub struct Course {
    /// The kind of its end.
    pub ended: Ended,
    /// When.
    pub end: Millis,
    /// The fate of each fault.
    pub fates: Vec<Fate>,
    /// All that happened, in the order of time.
    pub marks: Vec<(Millis, Mark)>,
    /// Time, place in mm and speed in mm/s, each second.
    pub samples: Vec<(Millis, u64, u64)>,
    /// The periods of the decider.
    pub inputs: Vec<Input>,
}

impl Course {
    /// Runs a plan; transitions are numbered as on this board.
    pub fn of(pilot: &Pilot, board: &Board, world: &World, plan: &Plan) -> Self {
        Going::new(pilot, board, world, plan).run()
    }
}

/// A course under way.
struct Going<'c> {
    pilot: &'c Pilot,
    board: &'c Board,
    world: &'c World,
    plan: &'c Plan,
    decider: Played,
    now: Millis,
    /// Place along the path in µm, and speed in mm/s.
    x_um: u64,
    speed: u64,
    failures: Failures<'c>,
    planned: Option<usize>,
    operator: Operator<'c>,
    place: Where,
    place_since: Millis,
    first: Vec<(Option<usize>, Millis)>,
    global: Global,
    objective: usize,
    objective_since: Millis,
    course: Course,
}

impl<'c> Going<'c> {
    fn new(pilot: &'c Pilot, board: &'c Board, world: &'c World, plan: &'c Plan) -> Self {
        let decider = pilot.begins();
        let course = Course {
            ended: Ended::Never,
            end: Millis(0),
            fates: plan.faults.iter().map(|_| Fate::default()).collect(),
            marks: Vec::new(),
            samples: Vec::new(),
            inputs: Vec::new(),
        };
        Self {
            pilot,
            board,
            world,
            plan,
            place: decider.level().place(),
            decider,
            now: Millis(0),
            x_um: 0,
            speed: 0,
            failures: Failures::new(world, pilot.tables().failures),
            planned: None,
            operator: Operator::new(&plan.answers),
            place_since: Millis(0),
            first: Vec::new(),
            global: Global::Waits,
            objective: 0,
            objective_since: Millis(0),
            course,
        }
    }

    fn run(mut self) -> Course {
        while self.now.0 < LONGEST {
            self.fail();
            self.travel();
            if self.failures.thinks() {
                self.period();
            }
            if self.now.0.is_multiple_of(SAMPLE) {
                self.course.samples.push((self.now, self.x(), self.speed));
            }
            self.now.0 += PERIOD;
            if let Some(ended) = self.is_over() {
                self.course.ended = ended;
                break;
            }
        }
        self.course.samples.push((self.now, self.x(), self.speed));
        self.course.end = self.now;
        self.course
    }

    fn x(&self) -> u64 {
        self.x_um / 1_000
    }

    fn is_over(&self) -> Option<Ended> {
        let left_alone = !self.failures.thinks()
            && self.speed == 0
            && (!self.decider.level().permits() || self.failures.is_abandoned(self.now));
        match self.global {
            Global::Done => Some(Ended::Done),
            Global::Safe if self.speed == 0 => Some(Ended::Safe),
            _ if left_alone => Some(Ended::Safe),
            _ => None,
        }
    }

    /// Faults begin and end.
    fn fail(&mut self) {
        let is_due = |when: Moment| {
            let since = |place: Option<usize>, after: Millis| {
                let first = self.first.iter().find(|it| it.0 == place);
                first.is_some_and(|it| self.now.0 >= it.1.0 + after.0)
            };
            match when {
                Moment::Place(x) => self.x_um / 1_000 >= x,
                Moment::At(at) => self.now >= at,
                Moment::During(place, after) => since(Some(place), after),
                Moment::Waiting(after) => since(None, after),
            }
        };
        for (at, (it, fate)) in self.plan.faults.iter().zip(&mut self.course.fates).enumerate() {
            if fate.began.is_none() && is_due(it.when) {
                fate.began = Some(self.now);
                if it.is_told {
                    (self.planned, fate.found) = (Some(it.row), Some(self.now));
                }
                self.failures.begin(at, it.row, self.now);
            } else if fate.began.is_some() && it.until.is_some_and(is_due) {
                self.failures.end(at);
            }
        }
        self.failures.pass(self.now);
        for (fault, over) in self.failures.overs() {
            if let Some(fate) = self.course.fates.get_mut(fault).filter(|_| over) {
                fate.over.get_or_insert(self.now);
            }
        }
    }

    /// The objective that is under way, if the robot drives for it.
    fn drives(&self) -> Option<&'c Objective> {
        let Global::Does(_) = self.global else { return None };
        self.world.objectives.get(self.objective).filter(|it| it.travels)
    }

    /// The robot goes on for a period.
    fn travel(&mut self) {
        let level = self.decider.level();
        let requests = self.decider.requests(self.now);
        let led = self.pilot.mode(self.place) == Some(Mode::Operator);
        let mut target = if requests.drive { requests.speed.0 } else { 0 };
        if !led {
            target = target.min(self.world.pace(self.x()));
        }
        let demand = Demand { fastest: self.world.fastest, halted: level.is_halted(), led };
        let target = self.failures.go(target, &demand, self.now);
        let goal = self.drives().map(|it| it.end_mm * 1_000);
        let left_mm = goal.map_or(u64::MAX, |it| it.saturating_sub(self.x_um) / 1_000);
        let change = self.world.acceleration * PERIOD / 1_000;
        let stops = (2 * self.world.acceleration).saturating_mul(left_mm).isqrt().max(change);
        let target = target.map(|it| it.min(stops));
        self.speed = match target {
            None => 0,
            Some(it) => it.clamp(self.speed.saturating_sub(change), self.speed + change),
        };
        self.x_um += self.speed * PERIOD;
        if let Some(goal) = goal.filter(|it| self.x_um >= *it) {
            (self.x_um, self.speed) = (goal, 0);
        }
    }

    /// A period of the decider.
    fn period(&mut self) {
        let moves = self.pilot.moves(self.place);
        let waits =
            self.place == Where::Waits || self.pilot.mode(self.place) == Some(Mode::Operator);
        for fault in self.failures.look(moves, waits) {
            if let Some(fate) = self.course.fates.get_mut(fault) {
                fate.found.get_or_insert(self.now);
            }
        }
        let coasts = self.speed > 0 && !self.decider.requests(self.now).drive;
        let drive = Drive { at_goal: false, stands: !coasts && !self.decider.level().permits() };
        let (up, works) = (self.failures.up(), self.failures.works());
        // Reports go first: a word would be lost.
        let listens =
            self.decider.listens() && self.planned.is_none() && up & !self.decider.up() == 0;
        let (said, planned) = (self.says(listens), self.planned.take());
        let seen = Seen { up, works, said, planned, drive };
        self.course.inputs.push(Input { at: self.now, seen, coasts });
        let numbered = self.board.session().numbered();
        let tables = self.pilot.tables();
        let mut acts = Acts { fired: Vec::new() };
        let (rows, round) = worked(&mut self.decider, self.now, seen, &mut acts);
        let rows = rows.worst_first(tables.failures).chain(seen.planned);
        let mut marks: Vec<Mark> = rows.map(Mark::Taken).collect();
        marks.extend(round.told.map(Mark::Told));
        for of in acts.fired {
            let first = numbered.first_transition(usize::from(of.component));
            marks.extend(first.map(|it| Mark::Fired(it.0 + of.id.0)));
            for act in tables.acts(of) {
                match act {
                    Act::Restart(module) => self.failures.restart(usize::from(module)),
                    Act::Set(report) => {
                        let sets = tables.reports.get(usize::from(report)).and_then(|it| it.sets);
                        let of = |row: usize| {
                            tables.failures.get(row).is_some_and(|it| it.report == report)
                        };
                        self.failures.set(of, sets.is_some_and(|it| it.mends));
                    }
                    Act::Ask(_) | Act::Hide(_) => {}
                }
            }
        }
        self.course.marks.extend(marks.into_iter().map(|it| (self.now, it)));
        self.follow();
    }

    /// Returns the word of the mission, the drive or the operator.
    fn says(&mut self, listens: bool) -> Option<Told> {
        match self.global {
            Global::Secures => (self.speed == 0).then_some(Told::Stopped),
            Global::Safe | Global::Done => None,
            Global::Waits => Some(Told::Begins),
            Global::Does(objective) => match self.world.objectives.get(objective) {
                Some(it) if !it.travels => {
                    let stood = self.now.0 - self.objective_since.0;
                    (stood >= it.stands.0).then_some(Told::Over(objective))
                }
                _ => self.drive_says(listens),
            },
        }
    }

    fn drive_says(&mut self, listens: bool) -> Option<Told> {
        let goal = self.drives().map_or(u64::MAX, |it| it.end_mm);
        let view = operator::View {
            place: self.place,
            x: self.x(),
            lost: self.decider.level().lost(),
            link: self.failures.link(),
            at_goal: self.x() >= goal && self.speed == 0,
            listens,
        };
        if let Some(word) = self.operator.says(self.pilot, self.world, self.now, view) {
            return Some(word);
        }
        let Where::Runs { sub_objective, configuration } = self.place else { return None };
        if self.pilot.mode(self.place) != Some(Mode::Autonomous) {
            return None;
        }
        let reached = if self.pilot.moves(self.place) {
            view.at_goal
        } else {
            let takes = self.world.configurations.get(configuration).map_or(0, |it| it.takes.0);
            self.now.0 - self.place_since.0 >= takes
        };
        reached.then_some(Told::Reached(sub_objective))
    }

    /// Notes where the supervisors have come to.
    fn follow(&mut self) {
        let (global, place) = (self.decider.level().global(), self.decider.level().place());
        if global != self.global {
            self.global = global;
            self.objective = match global {
                Global::Waits => 0,
                Global::Does(it) => it,
                Global::Done => self.world.objectives.len(),
                Global::Secures | Global::Safe => self.objective,
            };
            self.objective_since = self.now;
        }
        if place == self.place {
            return;
        }
        let before = core::mem::replace(&mut self.place, place);
        if before.is_left_for(place) {
            self.place_since = self.now;
        }
        if place != Where::Rests && !self.first.iter().any(|it| it.0 == place.sub_objective()) {
            self.first.push((place.sub_objective(), self.now));
        }
        if self.pilot.mode(before) == Some(Mode::Operator)
            && before.sub_objective() != place.sub_objective()
        {
            self.failures.is_helped();
        }
        self.course.marks.push((self.now, Mark::Place(place)));
    }
}

/// Hears what fired.
struct Acts {
    fired: Vec<Of<TransitionId>>,
}

impl<P: Names> Observer<P, Cause> for Acts {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.fired.push(firing.id);
    }
}
