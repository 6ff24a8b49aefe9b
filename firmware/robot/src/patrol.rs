//! The patrol mission of 187 m (Lambert et al. 2024, Section 4.2): planned, watched, planned again
//! when a margin falls below zero or hardware is lost.

use crate::trace::{Sink, Trace};
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use cotama_core::units::Millimetres;
use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{Alternative, EMPTY, ENERGY, Rest, buffer_sizes, remaining};

/// How many activities there are.
pub const STAGES: usize = ACTIVITIES.len();
/// How many alternatives they have, all together.
pub const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
/// So many nodes of its search the exact allocator remembers.
const SEEN: usize = 64;
/// The most steps of the exact allocator.
pub const STEPS: u64 = 200_000;
/// Both lasers are units of this kind of hardware.
const LASERS: usize = 1;

/// The memory of a problem of the whole mission, in RAM while a plan is made.
#[derive(Clone, Debug)]
pub struct Tables([Candidate<2>; CANDIDATES]);

impl Tables {
    /// Unused.
    pub const EMPTY: Self = Self([EMPTY; CANDIDATES]);
}

/// The memory of the exact allocator.
#[derive(Clone, Debug)]
pub struct Workspace {
    items: [Item<2>; CANDIDATES],
    stages: [Stage<2>; STAGES],
    seen: [Seen<2>; SEEN],
}

impl Workspace {
    /// Unused.
    pub const EMPTY: Self = Self {
        items: [Item::EMPTY; CANDIDATES],
        stages: [Stage::EMPTY; STAGES],
        seen: [Seen::EMPTY; SEEN],
    };

    /// The allocator in this memory: the most quality, then the least energy.
    pub fn exact(&mut self) -> Exact<'_, 2> {
        const OBJECTIVES: [Objective; 2] = [Objective::MostQuality, Objective::Least(ENERGY)];
        let Self { items, stages, seen } = self;
        Exact::new(&OBJECTIVES, STEPS, items, stages).with_memory(seen)
    }
}

/// The planner.
#[derive(Debug)]
pub enum Planner<'w> {
    /// The rule of the paper.
    Rule,
    /// The best plan: the most quality, then the least energy.
    Exact(&'w mut Workspace),
}

/// The plan, and how far the mission has come.
#[derive(Clone, Copy, Debug)]
pub struct Patrol {
    monitor: Monitor<2>,
    available: Equipment,
    plan: [u16; STAGES],
    /// The activity under way, and what is left of it.
    first: usize,
    rest: Rest,
}

/// Something that happens on the way: the activity, thousandths of its planned time and energy that
/// it takes, and whether a laser fails, so many mm before its end.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    /// Thousandths of planned time and energy; 1,000 as planned.
    pub takes: [u64; 2],
    /// A laser fails so far before the end.
    pub laser_fails: Option<Millimetres>,
}

impl Leg {
    /// As planned.
    pub const PLANNED: Self = Self { takes: [1_000; 2], laser_fails: None };
}

/// Obstacles slow the robot down before the laboratory, a laser fails at 118 m as in the paper, and
/// the floor after that costs energy: places and amounts but for the 118 m are ours.
pub const COURSE: [Leg; STAGES] = {
    let mut course = [Leg::PLANNED; STAGES];
    course[0].takes = [1_200, 1_100];
    course[13].laser_fails = Some(Millimetres(5_500));
    course[14].takes = [1_080, 1_600];
    course
};

impl Default for Patrol {
    fn default() -> Self {
        Self::at(0, Rest::Travel(ACTIVITIES[0].length()), AVAILABLE, [0; 2])
    }
}

impl Patrol {
    /// Under way: the activity and what is left of it, the hardware, time and energy used.
    pub fn at(first: usize, rest: Rest, available: Equipment, used: [u64; 2]) -> Self {
        // The limits and the order are constants of the mission, tested there.
        let Ok(mut monitor) = Monitor::new(LIMITS, ORDER) else { unreachable!() };
        let _ = monitor.spend(&used);
        Self { monitor, available, plan: [0; STAGES], first, rest }
    }

    /// Plans what is left; whether there is a plan.
    pub fn plan(
        &mut self,
        planner: &mut Planner<'_>,
        tables: &mut Tables,
        trace: &mut Trace<'_, impl Sink>,
    ) -> bool {
        let planned = self.make(planner, tables);
        match planned {
            Some((cost, quality)) => {
                trace.plan(self.first, &self.plan[self.first..], cost, quality);
                true
            }
            None => {
                trace.no_plan(self.first);
                false
            }
        }
    }

    /// Plans what is left, without a word; the totals of the plan: ms, mJ, and quality.
    pub fn make(
        &mut self,
        planner: &mut Planner<'_>,
        tables: &mut Tables,
    ) -> Option<([u64; 2], u64)> {
        match planner {
            Planner::Rule => {
                let mut caps = [[0; 2]; STAGES];
                self.allocate(&mut Panorama::new(&mut caps), tables)
            }
            Planner::Exact(workspace) => self.allocate(&mut workspace.exact(), tables),
        }
    }

    /// The alternatives of the activities that are left.
    pub fn left(&self) -> &[u16] {
        self.plan.get(self.first..).unwrap_or(&[])
    }

    #[inline(never)]
    fn allocate(
        &mut self,
        allocator: &mut impl Allocator<2>,
        tables: &mut Tables,
    ) -> Option<([u64; 2], u64)> {
        let mut lists = [&[][..]; STAGES];
        let left = ACTIVITIES.get(self.first..)?;
        let lists =
            remaining(left, Some(self.rest), self.available, &mut tables.0, &mut lists).ok()?;
        let problem = Problem::new(lists, self.monitor.left(), ORDER).ok()?;
        let answer = allocator.allocate(&problem, self.plan.get_mut(self.first..)?).ok()?;
        let Answer::Planned(planned) = answer else { return None };
        // Positions in the lists, as alternatives of the activities.
        for (chosen, list) in self.plan.iter_mut().skip(self.first).zip(lists) {
            *chosen = list.get(usize::from(*chosen))?.id;
        }
        self.monitor.planned(&planned.cost).ok()?;
        Some((planned.cost, planned.quality))
    }

    /// Drives the whole mission over a course; how often it was planned again, or `None` when there
    /// was no plan.
    pub fn drive(
        &mut self,
        course: &[Leg; STAGES],
        planner: &mut Planner<'_>,
        tables: &mut Tables,
        trace: &mut Trace<'_, impl Sink>,
    ) -> Option<usize> {
        let mut replans = 0;
        self.plan(planner, tables, trace).then_some(())?;
        for (at, leg) in course.iter().enumerate() {
            if let (Some(left), Rest::Travel(length)) = (leg.laser_fails, self.rest) {
                self.goes(Rest::Travel(Millimetres(length.0.saturating_sub(left.0))), leg);
                self.rest = Rest::Travel(left);
                self.available = self.available.without(LASERS, 1);
                replans += usize::from(self.watch(planner, tables, trace)?);
            }
            self.goes(self.rest, leg);
            self.first = at + 1;
            let Some(next) = ACTIVITIES.get(self.first) else { break };
            let alternative = &next.alternatives[usize::from(self.plan[self.first])];
            self.rest = next.whole(alternative);
            replans += usize::from(self.watch(planner, tables, trace)?);
        }
        Some(replans)
    }

    /// So much of the activity under way is done.
    fn goes(&mut self, done: Rest, leg: &Leg) {
        let Some(cost) = self.alternative(self.first).and_then(|it| it.cost(done)) else { return };
        let taken = [0, 1].map(|axis| u64::from(cost[axis]) * leg.takes[axis] / 1_000);
        let _ = self.monitor.spend(&taken);
    }

    fn alternative(&self, at: usize) -> Option<&'static Alternative> {
        ACTIVITIES.get(at)?.alternatives.get(usize::from(*self.plan.get(at)?))
    }

    /// Plans again when the plan no longer holds; `None` when there is none.
    fn watch(
        &mut self,
        planner: &mut Planner<'_>,
        tables: &mut Tables,
        trace: &mut Trace<'_, impl Sink>,
    ) -> Option<bool> {
        let (mut rest, mut needs) = ([0; 2], Equipment::NONE);
        for (at, activity) in ACTIVITIES.iter().enumerate().skip(self.first) {
            let it = self.alternative(at)?;
            let left = if at == self.first { self.rest } else { activity.whole(it) };
            let cost = it.cost(left)?;
            rest = [0, 1].map(|axis| rest[axis] + u64::from(cost[axis]));
            needs = needs.union(it.needs);
        }
        match self.monitor.assess(&rest, needs, self.available).ok()? {
            Request::Keep | Request::Up => Some(false),
            Request::Down(_) => self.plan(planner, tables, trace).then_some(true),
        }
    }
}
