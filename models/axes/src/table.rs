//! Phase P1: activities, their candidates with speeds and values, and what removed which
//! combination of options (Lambert et al. 2024, Section 6.2).

use crate::formula::{Formula, Inducer};
use crate::mission::{Kind, Lifted, Mission, Relation};
use crate::steps::{Steps, Stop};
use crate::tree::Wrong;
use crate::world::{Motion, World};

/// A mission has at most so many activities.
const MAX_ACTIVITIES: usize = 256;
/// An activity has at most so many combinations of options, and all activities so many together.
const MAX_COMBINATIONS: usize = 4_096;
const MAX_ALL_COMBINATIONS: usize = 65_536;

/// The activities of a mission with their candidates.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// In sequence.
    pub activities: Vec<Activity>,
}

/// An activity: the largest stretch of an objective on which constraints are the same (Section
/// 6.2.1).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Activity {
    /// The objective, by index.
    pub objective: usize,
    /// The begin, mm.
    pub x_start_mm: i64,
    /// The end, mm.
    pub x_end_mm: i64,
    /// The zones that cover it, by index; none if the robot stands.
    pub zones: Vec<usize>,
    /// Combinations of options that constraints leave.
    pub candidates: Vec<Candidate>,
    /// Combinations that a constraint removed.
    pub dropped: Vec<Dropped>,
}

/// One option for each task, the speed that follows, and the values of indicators.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// By index, in the order of the tasks.
    pub options: Vec<usize>,
    /// Zero if the robot stands.
    pub speed_mm_s: i64,
    /// Core constraints that the next speed breaks, by index; none where the robot itself is no
    /// faster, or stands.
    pub bounded_by: Vec<usize>,
    /// For each indicator its value, if it applies.
    pub values: Vec<Option<i64>>,
}

/// A combination that is no candidate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// By index, in the order of the tasks.
    pub options: Vec<usize>,
    /// All that speak against it.
    pub by: Vec<Reason>,
}

/// Cause that removes a combination of options.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A zone requires an option that is not taken.
    RequiredTio(usize),
    /// A zone requires hardware that the leading option does not need.
    RequiredHardware(usize),
    /// Zones blind each detector of the leading option.
    Blind,
    /// No detector counts, and an indicator reads its attributes.
    NoDetector,
    /// A core constraint breaks at every speed; at the lowest one, this one does.
    Core(usize),
}

impl Reason {
    /// Returns a name for it, as `glass.require_tio`, or that of the constraint.
    pub fn name(self, mission: &Mission) -> String {
        let zone = |it: usize| mission.zones.get(it).map_or("", |it| it.id.as_str());
        match self {
            Self::RequiredTio(it) => format!("{}.require_tio", zone(it)),
            Self::RequiredHardware(it) => format!("{}.require_hardware", zone(it)),
            Self::Blind => "blind".into(),
            Self::NoDetector => "no_detector".into(),
            Self::Core(it) => {
                mission.constraints.get(it).map_or_else(String::new, |it| it.id.clone())
            }
        }
    }
}

impl Table {
    /// Makes the table without some constraints.
    ///
    /// # Errors
    /// [`Stop::Wrong`] for arithmetic that does not come out, with its place in the file;
    /// [`Stop::Limit`] for too many activities, combinations or steps.
    pub fn new(mission: &Mission, lifted: Lifted, steps: &mut Steps) -> Result<Self, Stop> {
        let mut activities = cut(mission)?;
        let mut all = 0;
        for activity in &mut activities {
            let Some(objective) = mission.objectives.get(activity.objective) else { continue };
            let combinations = combinations(&objective.tasks)?;
            all += combinations.len();
            if all > MAX_ALL_COMBINATIONS {
                return Err(Stop::Limit);
            }
            for options in combinations {
                match combination(mission, activity, options, lifted, steps)? {
                    Ok(candidate) => activity.candidates.push(candidate),
                    Err(dropped) => activity.dropped.push(dropped),
                }
            }
        }
        Ok(Self { activities })
    }

    /// Returns how many plans there are, within the limits or not; none beyond 128 bits.
    pub fn combinations(&self) -> Option<u128> {
        let counts = self.activities.iter().map(|it| it.candidates.len() as u128);
        counts.into_iter().try_fold(1, u128::checked_mul)
    }
}

impl Candidate {
    /// The value of an indicator, by index; zero where it does not apply, as in sums.
    pub fn value(&self, indicator: usize) -> i64 {
        self.values.get(indicator).copied().flatten().unwrap_or(0)
    }
}

impl Activity {
    /// Whether the robot travels.
    pub const fn travels(&self) -> bool {
        self.x_start_mm < self.x_end_mm
    }

    /// Number of combinations before constraints.
    pub const fn before(&self) -> usize {
        self.candidates.len() + self.dropped.len()
    }

    /// The highest speed of a candidate, mm/s.
    pub fn speed_max_mm_s(&self) -> i64 {
        self.candidates.iter().map(|it| it.speed_mm_s).max().unwrap_or(0)
    }

    pub(crate) fn world<'m>(&'m self, mission: &'m Mission, options: &'m [usize]) -> World<'m> {
        let length = self.x_end_mm - self.x_start_mm;
        World::new(mission, &self.zones, options, length, self.travels())
    }
}

/// Returns names of options, as `M5 L2`.
pub fn label(mission: &Mission, options: &[usize]) -> String {
    let names: Vec<_> =
        options.iter().filter_map(|&it| mission.options.get(it)).map(|it| it.id.as_str()).collect();
    names.join(" ")
}

/// Cuts objectives that travel at the borders of zones inside them.
fn cut(mission: &Mission) -> Result<Vec<Activity>, Stop> {
    let mut borders: Vec<_> =
        mission.zones.iter().flat_map(|it| [it.x_start_mm, it.x_end_mm]).collect();
    borders.sort_unstable();
    borders.dedup();
    let mut activities = Vec::new();
    for (number, objective) in mission.objectives.iter().enumerate() {
        let (start, end) = (objective.x_start_mm, objective.x_end_mm);
        let mut from = start;
        let inside = borders.iter().copied().filter(|&it| start < it && it < end);
        for to in inside.chain([end]) {
            if activities.len() == MAX_ACTIVITIES {
                return Err(Stop::Limit);
            }
            let covers = |it: &crate::mission::Zone| it.x_start_mm <= from && to <= it.x_end_mm;
            let zones = mission.zones.iter().enumerate().filter(|it| start < end && covers(it.1));
            activities.push(Activity {
                objective: number,
                x_start_mm: from,
                x_end_mm: to,
                zones: zones.map(|it| it.0).collect(),
                candidates: Vec::new(),
                dropped: Vec::new(),
            });
            from = to;
        }
    }
    Ok(activities)
}

/// Returns all combinations of one option for each task, the first task outermost.
fn combinations(tasks: &[Vec<usize>]) -> Result<Vec<Vec<usize>>, Stop> {
    let mut all = vec![Vec::new()];
    for options in tasks {
        if all.len().saturating_mul(options.len()) > MAX_COMBINATIONS {
            return Err(Stop::Limit);
        }
        let longer = |begun: Vec<usize>| {
            options.iter().map(move |&it| begun.iter().copied().chain([it]).collect())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    Ok(all)
}

/// A core constraint where it applies.
struct Test<'m> {
    constraint: usize,
    whose: &'m str,
    formula: Formula,
    relation: Relation,
    goal: i64,
}

impl Test<'_> {
    fn fails(&self, world: &World<'_>, motion: Motion) -> Result<bool, Wrong> {
        let value = world.value(&self.formula, motion, self.whose)?;
        Ok(!self.relation.holds(value, self.goal))
    }
}

/// Returns the core constraints on an activity.
fn tests<'m>(
    mission: &'m Mission,
    activity: &Activity,
    world: &World<'_>,
    counts: impl Fn(usize) -> bool,
) -> Result<Vec<Test<'m>>, Wrong> {
    let mut tests = Vec::new();
    for (constraint, it) in mission.constraints.iter().enumerate() {
        if it.kind != Kind::Core || !counts(constraint) {
            continue;
        }
        let Some(indicator) = mission.indicators.get(it.indicator) else { continue };
        let Some(formula) = indicator.formula(world.travels) else { continue };
        let whose = indicator.id.as_str();
        let formula = world.given(formula, whose)?;
        let goal = it.goal_in(&activity.zones);
        tests.push(Test { constraint, whose, formula, relation: it.relation, goal });
    }
    Ok(tests)
}

/// Returns what experimental constraints say against a combination (Section 6.2.3).
fn experimental(mission: &Mission, activity: &Activity, world: &World<'_>) -> Vec<Reason> {
    let mut by = Vec::new();
    for (number, zone) in activity.zones.iter().filter_map(|&it| Some((it, mission.zones.get(it)?)))
    {
        if zone.require_hardware.is_some_and(|it| !world.leads_with(it)) {
            by.push(Reason::RequiredHardware(number));
        }
        if zone.require_tio.is_some_and(|it| !world.options.contains(&it)) {
            by.push(Reason::RequiredTio(number));
        }
    }
    let own = |it: usize| world.sees(it) && world.leads_with(it);
    let is_blind = |&it: &usize| mission.zones.get(it).is_some_and(|it| !it.blind.is_empty());
    let blinds = activity.zones.iter().any(is_blind);
    if blinds && !(0..mission.hardware.len()).any(own) {
        by.push(Reason::Blind);
    } else if world.travels && world.detector.is_none() && reads_detector(mission) {
        by.push(Reason::NoDetector);
    }
    by
}

fn reads_detector(mission: &Mission) -> bool {
    let formulas = mission.indicators.iter().filter_map(|it| it.travel.as_ref());
    formulas.flat_map(Formula::inducers).any(|it| matches!(it, Inducer::Detector(_)))
}

pub(crate) fn combination(
    mission: &Mission,
    activity: &Activity,
    options: Vec<usize>,
    lifted: Lifted,
    steps: &mut Steps,
) -> Result<Result<Candidate, Dropped>, Stop> {
    let world = activity.world(mission, &options);
    let by = experimental(mission, activity, &world);
    if !by.is_empty() {
        return Ok(Err(Dropped { options, by }));
    }
    let tests = tests(mission, activity, &world, |it| !lifted.has(it))?;
    let travels = activity.travels();
    let speeds = if travels { mission.speeds.up_to(world.most_mm_s()) } else { 1 };
    let work = 1 + tests.iter().map(|it| it.formula.size()).sum::<u64>();
    let mut broken = Vec::new();
    for number in (0..speeds).rev() {
        steps.take(work)?;
        let motion = world.at(if travels { mission.speeds.at(number) } else { 0 });
        let bounded_by = broken;
        broken = Vec::new();
        for test in &tests {
            if test.fails(&world, motion)? {
                broken.push(test.constraint);
            }
        }
        if broken.is_empty() {
            let mut values = Vec::new();
            for it in &mission.indicators {
                let formula = it.formula(world.travels);
                let value = formula.map(|formula| world.value(formula, motion, &it.id));
                values.push(value.transpose()?);
            }
            let speed_mm_s = motion.speed_mm_s;
            return Ok(Ok(Candidate { options, speed_mm_s, bounded_by, values }));
        }
    }
    Ok(Err(Dropped { options, by: broken.into_iter().map(Reason::Core).collect() }))
}

/// Whether one core constraint alone holds at a speed in mm/s.
pub(crate) fn holds_alone(
    mission: &Mission,
    activity: &Activity,
    options: &[usize],
    constraint: usize,
    speed: i64,
    steps: &mut Steps,
) -> Result<bool, Stop> {
    let world = activity.world(mission, options);
    let tests = tests(mission, activity, &world, |it| it == constraint)?;
    steps.take(1 + tests.iter().map(|it| it.formula.size()).sum::<u64>())?;
    let mut holds = true;
    for test in &tests {
        holds &= !test.fails(&world, world.at(speed))?;
    }
    Ok(holds)
}

/// Returns the highest speed in whole mm/s, at most `most`, at which one core constraint alone
/// holds; none if it holds at no speed.
///
/// # Errors
/// [`Stop::Wrong`] for arithmetic that does not come out; [`Stop::Limit`] for too many steps.
pub fn speed_alone(
    mission: &Mission,
    activity: &Activity,
    options: &[usize],
    constraint: usize,
    most: i64,
    steps: &mut Steps,
) -> Result<Option<i64>, Stop> {
    let world = activity.world(mission, options);
    let tests = tests(mission, activity, &world, |it| it == constraint)?;
    for speed in (1..=most).rev() {
        steps.take(1 + tests.iter().map(|it| it.formula.size()).sum::<u64>())?;
        let mut holds = true;
        for test in &tests {
            holds &= !test.fails(&world, world.at(speed))?;
        }
        if holds {
            return Ok(Some(speed));
        }
    }
    Ok(None)
}
