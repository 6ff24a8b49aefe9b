//! The whole decisional level of the delivery robot, as firmware links it: the decider, from flags
//! to requests, on the supervisors that its file prints, the executive of a drive, and an allocator
//! on the tables of the mission. No heap, nothing left out but texts.
#![no_std]

pub mod reach;
pub mod walk;

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::executive::{Executive, Happening, Overruns, TaskSet};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request};
use cotama_core::panorama::Panorama;
use cotama_core::player::Firing;
use cotama_core::problem::{Candidate, Problem};
use cotama_core::units::{Micros, Millis};
use cotama_models::level::{Cause, Drive, Perceived, Requests, Round, Rows, Told};
use cotama_models::missions::tables::delivery::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};
use cotama_printed::{Careful, Decider, Level, at_rest, tasks};

/// The first configuration in which the robot drives.
const DRIVES: usize = 1;
/// The modules that run in it.
pub const TASKS: usize = tasks::TASKS[DRIVES].len();
const STAGES: usize = ACTIVITIES.len();
const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
/// The most steps that the exact allocator may take.
const STEPS: u64 = 10_000;

/// All that the level remembers between two calls.
#[derive(Clone, Copy)]
pub struct Robot {
    decider: Decider<Careful>,
    executive: Executive<TASKS>,
    mission: Mission,
}

/// The plan of the mission.
#[derive(Clone, Copy)]
pub struct Mission {
    monitor: Monitor<2>,
    plan: [u16; STAGES],
}

/// The memory of the caller's that planning needs while it goes on, by the rule and exactly; on the
/// stack here.
pub const PLANNING_BYTES: [usize; 2] = {
    let problem = CANDIDATES * size_of::<Candidate<2>>() + STAGES * size_of::<&[Candidate<2>]>();
    let rule = STAGES * size_of::<[u32; 2]>();
    let exact = CANDIDATES * size_of::<Item<2>>() + STAGES * size_of::<Stage<2>>();
    [problem + rule, problem + exact]
};

impl Robot {
    /// At rest; `None` when the modules of a drive do not fit the processor.
    pub fn new() -> Option<Self> {
        let mut all = tasks::TASKS[DRIVES].iter().map(|it| it.1);
        let mut tasks = [all.next()?; TASKS];
        for (task, it) in tasks.iter_mut().skip(1).zip(all) {
            *task = it;
        }
        TaskSet::new(&tasks).ok()?.schedulable(Overruns::None).ok()?;
        Some(Self {
            decider: Decider::new(at_rest(Careful::default())),
            executive: Executive::new(tasks).ok()?,
            mission: Mission { monitor: Monitor::new(LIMITS, ORDER).ok()?, plan: [0; STAGES] },
        })
    }

    /// Begins anew with supervisors in this state.
    pub fn restart(&mut self, level: Level<Careful>) {
        self.decider.restart(level);
    }

    /// The decider, to be looked at.
    pub fn decider(&self) -> &Decider<Careful> {
        &self.decider
    }

    /// The task that has the processor.
    pub fn running(&self) -> Option<usize> {
        self.executive.running()
    }

    /// Observers tell what they see.
    pub fn perceive(&mut self, now: Millis, seen: Perceived) -> Rows {
        self.decider.perceive(now, seen)
    }

    /// A period of the decisional level, with everything that fires shown to a witness who counts.
    pub fn decide(
        &mut self,
        now: Millis,
        said: Option<Told>,
        drive: Drive,
        fired: &mut u32,
    ) -> (Round, Requests) {
        let mut count = |_: &Firing<'_, Careful, Cause>| *fired = fired.wrapping_add(1);
        let round = self.decider.period(now, said, drive, &mut count);
        (round, self.decider.requests(now))
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
