//! The whole decisional level of the delivery robot, as firmware links it: the decider, from flags
//! to requests, the executive of the optimal path following, and an allocator on the tables of the
//! mission. No heap, nothing left out but texts.
#![no_std]

pub mod reach;

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::executive::{Executive, Happening, Overruns, TaskSet};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use cotama_core::units::{Micros, Millis};
use cotama_models::cotama::Configuration::FollowingOptimal;
use cotama_models::cotama::load::{self, Load, MOST, SPARE};
use cotama_models::cotama::{
    Body, Cause, Configuration, DecisionalLevel, DeliveryDecider, Finding, Health, Modules,
    NoPlanLeft, Perceived, Plans, Requests, Told, Why, Word, delivery,
};
use cotama_models::missions::tables::delivery::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};

/// The tasks of the optimal path following: its modules, and the load of the computer.
pub const TASKS: usize = FollowingOptimal.scheduled().len() + 1;
/// Each activity of the mission is an objective.
const OBJECTIVES: u32 = ACTIVITIES.len() as u32;
const STAGES: usize = ACTIVITIES.len();
const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
/// The most steps that the exact allocator may take.
const STEPS: u64 = 10_000;

/// All that the level remembers between two calls.
#[derive(Clone, Copy)]
pub struct Robot {
    decider: DeliveryDecider,
    executive: Executive<TASKS>,
    mission: Mission,
}

/// The plan, and how far the mission has come.
#[derive(Clone, Copy)]
pub struct Mission {
    monitor: Monitor<2>,
    plan: [u16; STAGES],
    /// The activity under way, and what is left of it.
    first: usize,
    rest: Rest,
}

/// The configurations of a drive, in the order of its alternatives and of its hardware.
const DRIVES: [Configuration; 4] = {
    use Configuration as C;
    [C::FollowingOptimal, C::FollowingDvz, C::FollowingOdometric, C::FollowingDegraded]
};

/// The memory of the caller's that planning needs while it goes on, by the rule and exactly; on the
/// stack here.
pub const PLANNING_BYTES: [usize; 2] = {
    let problem = CANDIDATES * size_of::<Candidate<2>>() + STAGES * size_of::<&[Candidate<2>]>();
    let rule = STAGES * size_of::<[u32; 2]>();
    let exact = CANDIDATES * size_of::<Item<2>>() + STAGES * size_of::<Stage<2>>();
    [problem + rule, problem + exact]
};

impl Plans for Mission {
    fn is_over(&self) -> bool {
        self.first >= STAGES
    }

    fn plan(&mut self, _: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        let have = DRIVES.iter().enumerate().filter(|(_, it)| it.runs_on(available));
        let units = have.fold(Equipment::NONE, |all, (kind, _)| all.with(kind, 1).unwrap_or(all));
        let (first, rest) = (self.first, self.rest);
        if self.plan_by_rule(first, rest, units) { Ok(true) } else { Err(NoPlanLeft) }
    }

    fn configuration(&self) -> Option<Configuration> {
        let left = ACTIVITIES.iter().zip(&self.plan).skip(self.first);
        let drive = { left }.find(|it| it.0.x_start != it.0.x_end)?;
        DRIVES.get(usize::from(*drive.1)).copied()
    }

    fn short(&self) -> Option<usize> {
        None // the monitor says so, with the consumption: see `Robot::watch`
    }
}

impl Robot {
    /// At rest, with localisation by so many particles; `None` when they do not fit the processor.
    pub fn new(load: Load) -> Option<Self> {
        let mut tasks = [SPARE; MOST];
        let particles = load::most_particles(FollowingOptimal, load, &mut tasks).ok()??;
        let tasks = load::tasks(FollowingOptimal, load, particles, &mut tasks);
        TaskSet::new(tasks).ok()?.schedulable(Overruns::None).ok()?;
        Some(Self {
            decider: DeliveryDecider::start(delivery::Program, OBJECTIVES, None),
            executive: Executive::new(tasks.try_into().ok()?).ok()?,
            mission: Mission {
                monitor: Monitor::new(LIMITS, ORDER).ok()?,
                plan: [0; STAGES],
                first: 0,
                rest: Rest::Travel(ACTIVITIES[0].length()),
            },
        })
    }

    /// The same robot with its supervisors in this state, and with what is known to be broken.
    #[must_use]
    pub fn at(&self, level: DecisionalLevel, known: Health) -> Self {
        Self { decider: DeliveryDecider::resume(level, OBJECTIVES, known), ..*self }
    }

    /// The task that has the processor.
    pub fn running(&self) -> Option<usize> {
        self.executive.running()
    }

    /// Observers tell what they see.
    pub fn perceive(&mut self, now: Millis, seen: Perceived) -> Option<Finding> {
        self.decider.perceive(now, seen, &mut self.mission)
    }

    /// A round of the decisional level, with everything that fires shown to a witness who counts.
    pub fn round(
        &mut self,
        now: Millis,
        said: Option<Word>,
        body: Body,
        fired: &mut u32,
    ) -> (Option<Told>, Requests) {
        let mut count = |_: &delivery::Firing<'_, Cause>| *fired = fired.wrapping_add(1);
        let round = self.decider.round(now, said, body, &mut count);
        (round.told, self.decider.requests())
    }

    /// The executive is told the time, or that a job is done, or that a fault was answered.
    pub fn schedule(
        &mut self,
        now: Micros,
        done: Option<usize>,
        answered: Option<usize>,
    ) -> Option<Happening> {
        match (done, answered) {
            (Some(task), _) => self.executive.complete(task, now).ok(),
            (_, Some(task)) => self.executive.acknowledge(task, now),
            (None, None) => self.executive.step(now),
        }
    }

    /// Whether the plan still holds after this consumption.
    pub fn watch(&mut self, spent: &[u64; 2], rest: &[u64; 2]) -> Option<Request> {
        self.mission.monitor.spend(spent).ok()?;
        self.mission.monitor.assess(rest, AVAILABLE, AVAILABLE).ok()
    }

    /// The mission that is planned.
    pub fn mission(&mut self) -> &mut Mission {
        &mut self.mission
    }
}

impl Mission {
    /// Plans the mission from one of its activities on, of which `rest` is left, by the rule of the
    /// paper; whether there is a plan.
    pub fn plan_by_rule(&mut self, first: usize, rest: Rest, units: Equipment) -> bool {
        let mut caps = [[0; 2]; STAGES];
        self.plan(first, rest, units, &mut Panorama::new(&mut caps)).is_some()
    }

    /// The same, exactly.
    pub fn plan_exactly(&mut self, first: usize, rest: Rest, units: Equipment) -> bool {
        let (mut items, mut stages) = ([Item::EMPTY; CANDIDATES], [Stage::EMPTY; STAGES]);
        let objectives = [Objective::MostQuality, Objective::Least(1)];
        self.plan(first, rest, units, &mut Exact::new(&objectives, STEPS, &mut items, &mut stages))
            .is_some()
    }

    fn plan(
        &mut self,
        first: usize,
        rest: Rest,
        units: Equipment,
        allocator: &mut impl Allocator<2>,
    ) -> Option<()> {
        let mut candidates: [Candidate<2>; CANDIDATES] = [EMPTY; CANDIDATES];
        let mut lists = [&[][..]; STAGES];
        let lists =
            remaining(ACTIVITIES.get(first..)?, Some(rest), units, &mut candidates, &mut lists)
                .ok()?;
        let problem = Problem::new(lists, self.monitor.left(), ORDER).ok()?;
        let answer = allocator.allocate(&problem, self.plan.get_mut(first..)?).ok()?;
        let Answer::Planned(planned) = answer else { return None };
        self.monitor.planned(&planned.cost).ok()
    }
}
