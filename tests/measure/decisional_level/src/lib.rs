//! The whole decisional level of the delivery robot, as firmware links it: the supervisors,
//! diagnosis and decision, the executive of the optimal path following, and an allocator on the
//! tables of the mission. No heap, nothing left out but texts.
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
    Cause, Decision, DecisionalLevel, Diagnosis, Flags, Health, Losses, Modules, Report, Told,
    decide, delivery, diagnose, judge,
};
use cotama_models::missions::tables::delivery::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};

/// The tasks of the optimal path following: its modules, and the load of the computer.
pub const TASKS: usize = FollowingOptimal.scheduled().len() + 1;
const STAGES: usize = ACTIVITIES.len();
const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
/// The most steps that the exact allocator may take.
const STEPS: u64 = 10_000;

/// All that the level remembers between two calls.
#[derive(Clone, Copy)]
pub struct Robot {
    level: DecisionalLevel,
    executive: Executive<TASKS>,
    monitor: Monitor<2>,
    health: Health,
    lost: Losses,
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

/// What follows from flags.
#[derive(Clone, Copy)]
pub struct Concluded {
    /// What is broken, as far as is known.
    pub diagnosis: Diagnosis,
    /// What is newly lost, and to be told.
    pub lost: Losses,
    /// What is to be reported.
    pub report: Option<Report>,
    /// What the table and the rules of severity and availability say to it.
    pub decisions: [Decision; 2],
}

impl Robot {
    /// At rest, with localisation by so many particles; `None` when they do not fit the processor.
    pub fn new(load: Load) -> Option<Self> {
        let mut tasks = [SPARE; MOST];
        let particles = load::most_particles(FollowingOptimal, load, &mut tasks).ok()??;
        let tasks = load::tasks(FollowingOptimal, load, particles, &mut tasks);
        TaskSet::new(tasks).ok()?.schedulable(Overruns::None).ok()?;
        Some(Self {
            level: DecisionalLevel::default(),
            executive: Executive::new(tasks.try_into().ok()?).ok()?,
            monitor: Monitor::new(LIMITS, ORDER).ok()?,
            health: Health::SOUND,
            lost: Losses::NONE,
            plan: [0; STAGES],
        })
    }

    /// The same robot with its supervisors in this state, and with this health.
    #[must_use]
    pub fn at(&self, level: DecisionalLevel, health: Health) -> Self {
        Self { level, health, ..*self }
    }

    /// The task that has the processor.
    pub fn running(&self) -> Option<usize> {
        self.executive.running()
    }

    /// Flags are diagnosed; the report is judged where the robot is.
    pub fn observe(&mut self, raised: Flags, part: Modules) -> Concluded {
        let diagnosis = diagnose(raised, self.health.available());
        self.health = self.health.union(diagnosis.health(part));
        let lost = Losses::lacking(self.health.relied_on()).without(self.lost);
        self.lost = self.lost.union(lost);
        let situation = self.level.situation(self.lost);
        let (report, severity) = diagnosis.judged(raised, situation.mode());
        let said = report.map(|it| [decide(it, situation), judge(it, severity, situation)]);
        Concluded { diagnosis, lost, report, decisions: said.unwrap_or([Decision::Record; 2]) }
    }

    /// The supervisors are told something; the number of what fired, counted by `fired`.
    pub fn tell(&mut self, now: Millis, told: Told, cause: Cause, fired: &mut u32) {
        let mut count = |_: &delivery::Firing<'_, Cause>| *fired = fired.wrapping_add(1);
        let _ = self.level.tell(now, told, cause, &mut count);
    }

    /// The supervisors take a round.
    pub fn round(&mut self, now: Millis, fired: &mut u32) -> bool {
        let mut count = |_: &delivery::Firing<'_, Cause>| *fired = fired.wrapping_add(1);
        let _ = self.level.round(now, &mut count);
        self.level.permit().is_some()
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
        self.monitor.spend(spent).ok()?;
        self.monitor.assess(rest, AVAILABLE, AVAILABLE).ok()
    }

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
            remaining(ACTIVITIES.get(first..)?, rest, units, &mut candidates, &mut lists).ok()?;
        let problem = Problem::new(lists, self.monitor.left(), ORDER).ok()?;
        let answer = allocator.allocate(&problem, self.plan.get_mut(first..)?).ok()?;
        let Answer::Planned(planned) = answer else { return None };
        self.monitor.planned(&planned.cost).ok()
    }
}
