//! Why a mission has no plan, and what would give it one.
//!
//! That a mission cannot be done is an answer, and this is the whole of it: which limit cannot be
//! met and by how much, or which activity the hardware leaves without an alternative; the
//! activities that weigh most; and the *relaxations* that suffice, each alone, the smallest first.
//! Every statement comes from a complete search, so that a limit raised as said has a plan, and
//! raised by one unit less has none.
//!
//! *Order of relaxations.* First limits raised, by how much of the limit they add (of two limits
//! raised together the larger part counts); then constraints lifted, hardware kept and objectives
//! dropped, each in the order of the mission file, the end of the mission cut off last. The mission
//! stays whole as long as possible, and what is only a matter of a budget comes before what changes
//! how the robot works.
//!
//! Several changes of one kind are offered only where no single one of them suffices, and then none
//! of them can be left out; changes of different kinds are not combined. An empty list therefore
//! says that no kind of change suffices alone. A relaxation says what suffices, not what is safe: a
//! constraint has its reason.
//!
//! ```
//! use cotama_models::missions::infeasible::{Reason, explain};
//! use cotama_models::missions::{Mission, embedded};
//! let patrol = embedded::mission("patrol").unwrap();
//! let mission = Mission::parse(patrol.name, patrol.text).unwrap();
//! let all = mission.available();
//! assert_eq!(explain(&mission, mission.limits, all), None);
//!
//! let why = explain(&mission, [600_000, 4_320_000], all).unwrap(); // 1.2 Wh instead of 2.4 Wh
//! assert_eq!(why.reason, Reason::Limit { axis: 1, limit: 4_320_000, least: 4_675_896 });
//! let relaxation = why.relaxations[0].wording(&mission);
//! let raised = "raise the energy limit from 4320 J to 4675.896 J (+355.896 J, 8.2 %)";
//! assert_eq!(relaxation, raised);
//! ```

mod limits;
mod trials;
mod wording;

pub use wording::amount;

use crate::missions::mission::Unfolded;
use crate::missions::scenario::Constraint;
use cotama_core::hardware::Equipment;
use trials::{Found, Trial, Trials};

/// The most steps of one search in [`explain`].
pub const STEPS: u64 = 5_000_000;
/// All searches of an explanation together take at most so many times the steps of one, or of
/// [`STEPS`] if that is more. Beside its own steps every search takes one for eight combinations of
/// options.
pub const SHARED: u64 = 4;
/// The most activities named as the heaviest.
pub const HEAVIEST: usize = 5;

/// Why a mission has no plan, and what would give it one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The demand that cannot be met.
    pub reason: Reason,
    /// The activities that cost most on the axis of the reason, in the plan of the least total
    /// there; at most [`HEAVIEST`], the heaviest first. Empty when the reason is not a limit.
    pub heaviest: Vec<Heavy>,
    /// The relaxations, each of which suffices alone, in the order of the
    /// [module's documentation](self).
    pub relaxations: Vec<Relaxation>,
    /// Whether every search came to its end. Otherwise each relaxation suffices still, but there
    /// may be more of them, and smaller ones.
    pub complete: bool,
}

/// A demand that cannot be met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// One limit, while the other is kept. Where either could be raised, the one that needs less of
    /// its limit.
    Limit {
        /// The axis.
        axis: usize,
        /// The limit on the axis.
        limit: u64,
        /// The least total on the axis within the other limit.
        least: u64,
    },
    /// Neither limit can be met, not even without the other.
    Limits {
        /// The limits.
        limits: [u64; 2],
        /// The least total on each axis, whatever the other.
        least: [u64; 2],
    },
    /// The hardware leaves an activity without alternatives.
    NoAlternative {
        /// The index of the first such activity.
        activity: usize,
        /// The kinds that alternatives need and of which too few work: each alternative needs at
        /// least one of these. Never empty, and none covers another.
        lacks: Vec<Equipment>,
        /// The constraints, with the index of their zone, that exclude some combination of its
        /// options.
        constraints: Vec<(usize, Constraint)>,
        /// The indices of further activities without alternatives.
        others: Vec<usize>,
    },
    /// One of the limits or both: the search ended before it was known which, and by how much.
    SomeLimit {
        /// The steps it was given.
        steps: u64,
    },
    /// Nothing: the search ended before it found a plan or the proof that there is none.
    Undecided {
        /// The steps it was given.
        steps: u64,
    },
}

/// An activity and what it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heavy {
    /// The index of the activity.
    pub activity: usize,
    /// The axis.
    pub axis: usize,
    /// Cost of the alternative there.
    pub cost: u32,
    /// Share of the total, in thousandths, rounded half up.
    pub permille: u16,
}

/// A change after which the mission has a plan.
///
/// ```
/// use cotama_models::missions::infeasible::{Relaxation, explain};
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (limits, all) = ([600_000, 4_320_000], mission.available());
/// let why = explain(&mission, limits, all).unwrap();
/// let raised = Relaxation::RaiseLimit { axis: 1, from: 4_320_000, to: 4_675_896 };
/// assert_eq!(why.relaxations[0], raised);
/// let (mission, limits, all) = raised.apply(&mission, limits, all).unwrap();
/// assert_eq!(explain(&mission, limits, all), None); // now there is a plan
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Relaxation {
    /// Raise a limit.
    RaiseLimit {
        /// The axis.
        axis: usize,
        /// The limit.
        from: u64,
        /// The least limit that suffices.
        to: u64,
    },
    /// Raise both limits. Of the pairs none of which can be lowered, the two with the least on one
    /// axis are given.
    RaiseLimits {
        /// The limits.
        from: [u64; 2],
        /// Limits that suffice, and neither can be lower while the other stays.
        to: [u64; 2],
    },
    /// Lift a constraint of a zone.
    LiftConstraint {
        /// The index of the zone.
        zone: usize,
        /// The constraint to lift.
        constraint: Constraint,
    },
    /// Lift several constraints, none of which can be left out.
    LiftConstraints {
        /// The constraints, with the index of their zone.
        constraints: Vec<(usize, Constraint)>,
    },
    /// Keep, or repair, hardware.
    KeepHardware {
        /// The index of the hardware.
        hardware: usize,
        /// The least number of working units that suffices, those that work now included.
        units: u8,
    },
    /// Keep, or repair, hardware of several kinds.
    KeepHardwares {
        /// For each kind its index and a number of working units, none of which can be lower.
        hardware: Vec<(usize, u8)>,
    },
    /// Drop an objective. One that travels takes all that follow with it, and only the last is
    /// offered.
    DropObjective {
        /// The index of the objective.
        objective: usize,
    },
}

/// Explains why a mission has no plan within `limits` (ms and mJ, inclusive) with the `available`
/// hardware; `None` when it has one.
///
/// ```
/// use cotama_models::missions::infeasible::explain;
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let why = explain(&mission, [400_000, 8_640_000], mission.available()).unwrap();
/// let reason = "the duration limit of 400 s cannot be met: within the energy limit the least is \
///               490.031 s (+90.031 s, 22.5 %)";
/// assert_eq!(why.reason.wording(&mission), reason);
/// ```
pub fn explain(mission: &Unfolded, limits: [u64; 2], available: Equipment) -> Option<Explanation> {
    explain_within(mission, limits, available, STEPS)
}

/// [`explain`] with at most so many steps for one search, instead of [`STEPS`].
pub fn explain_within(
    mission: &Unfolded,
    limits: [u64; 2],
    available: Equipment,
    steps: u64,
) -> Option<Explanation> {
    let mut trials = Trials::new(mission, steps);
    let as_is = Trial { limits, available, lifted: &[], without: 0..0 };
    match trials.run(&as_is, None) {
        Found::Plan(_) => return None,
        Found::Nothing => {}
        Found::Unknown => {
            let reason = Reason::Undecided { steps };
            return Some(Explanation {
                reason,
                heaviest: vec![],
                relaxations: vec![],
                complete: false,
            });
        }
    }
    let (reason, heaviest, mut relaxations) = match no_alternative(mission, available) {
        Some(reason) => (reason, vec![], vec![]),
        None => limits::raised(&mut trials, mission, &as_is, steps),
    };
    let constraints = trials.lift_all(mission);
    relaxations.extend(lifts(&mut trials, &as_is, &constraints));
    relaxations.extend(kept_hardware(&mut trials, mission, &as_is));
    relaxations.extend(dropped_objectives(&mut trials, mission, &as_is));
    Some(Explanation { reason, heaviest, relaxations, complete: trials.complete() })
}

fn no_alternative(mission: &Unfolded, available: Equipment) -> Option<Reason> {
    let activities = &mission.scenario().activities;
    let mut empty = activities.iter().enumerate().filter_map(|(index, activity)| {
        activity.alternatives.iter().all(|it| !available.covers(it.needs)).then_some(index)
    });
    let activity = empty.next()?;
    let others = empty.collect();
    let short = |needs: Equipment| {
        let kinds = 0..mission.hardware.len();
        let short = kinds.filter(|&kind| needs.of(kind) > available.of(kind));
        short.fold(Equipment::NONE, |all, kind| all.with(kind, needs.of(kind)).unwrap_or(all))
    };
    let all: Vec<_> = activities[activity].alternatives.iter().map(|it| short(it.needs)).collect();
    let least = |one: &Equipment| all.iter().all(|other| other == one || !one.covers(*other));
    let mut lacks: Vec<_> = all.iter().copied().filter(least).collect();
    lacks.sort_unstable_by_key(|units| units.to_bits());
    lacks.dedup();
    let mut constraints: Vec<_> = activities[activity]
        .dropped
        .iter()
        .flat_map(|dropped| dropped.by.iter().copied())
        .collect();
    constraints.sort_unstable();
    constraints.dedup();
    Some(Reason::NoAlternative { activity, lacks, constraints, others })
}

/// Each constraint that suffices, or a set without one to spare.
fn lifts(
    trials: &mut Trials<'_>,
    as_is: &Trial<'_>,
    constraints: &[(usize, Constraint)],
) -> Vec<Relaxation> {
    let mut without =
        |lifted: &[(usize, Constraint)]| trials.feasible(&Trial { lifted, ..as_is.clone() });
    let mut found: Vec<_> = constraints.iter().copied().filter(|&one| without(&[one])).collect();
    if !found.is_empty() {
        return found
            .into_iter()
            .map(|(zone, constraint)| Relaxation::LiftConstraint { zone, constraint })
            .collect();
    }
    if constraints.len() < 2 || !without(constraints) {
        return vec![];
    }
    found = constraints.to_vec();
    for one in constraints {
        let rest: Vec<_> = found.iter().copied().filter(|other| other != one).collect();
        if without(&rest) {
            found = rest;
        }
    }
    vec![Relaxation::LiftConstraints { constraints: found }]
}

/// Each kind of hardware of which more units suffice, or units of several kinds without one to
/// spare.
fn kept_hardware(
    trials: &mut Trials<'_>,
    mission: &Unfolded,
    as_is: &Trial<'_>,
) -> Vec<Relaxation> {
    let now = as_is.available;
    let kinds = mission.hardware.iter().enumerate();
    let lost: Vec<_> = kinds.filter(|(kind, it)| now.of(*kind) < it.units).collect();
    let mut with = |available: Equipment| trials.feasible(&Trial { available, ..as_is.clone() });
    let keep = |units: Equipment, kind: usize, count: u8| units.with(kind, count).unwrap_or(units);

    let mut found = Vec::new();
    for &(hardware, it) in &lost {
        let least =
            (now.of(hardware) + 1..=it.units).find(|&units| with(keep(now, hardware, units)));
        found.extend(least.map(|units| Relaxation::KeepHardware { hardware, units }));
    }
    let mut units = lost.iter().fold(now, |units, &(kind, it)| keep(units, kind, it.units));
    if !found.is_empty() || lost.len() < 2 || !with(units) {
        return found;
    }
    for &(kind, it) in &lost {
        let least = (now.of(kind)..it.units).find(|&count| with(keep(units, kind, count)));
        units = keep(units, kind, least.unwrap_or(it.units));
    }
    let kept = lost.iter().map(|&(kind, _)| (kind, units.of(kind)));
    let hardware = kept.filter(|&(kind, count)| count > now.of(kind)).collect();
    vec![Relaxation::KeepHardwares { hardware }]
}

/// Each objective that does not travel and suffices, then the last travelling one at which the
/// mission can end; what is left must be a mission.
fn dropped_objectives(
    trials: &mut Trials<'_>,
    mission: &Unfolded,
    as_is: &Trial<'_>,
) -> Vec<Relaxation> {
    let all = mission.objectives.len();
    let mut found = Vec::new();
    let (travelling, standing): (Vec<_>, Vec<_>) =
        (0..all).partition(|&objective| mission.objectives[objective].travels());
    // Only supervised missions have rules that an objective left out can break.
    let whole = |objective: &usize| {
        mission.under.is_none() || mission.without_objective(*objective).is_some()
    };
    for objective in standing.into_iter().filter(|_| all > 1).filter(whole) {
        if trials.feasible(&Trial { without: objective..objective + 1, ..as_is.clone() }) {
            found.push(Relaxation::DropObjective { objective });
        }
    }
    // The less is left, the more fits; before the first objective nothing would be left.
    let ends: Vec<_> = travelling.into_iter().filter(|&objective| objective > 0).collect();
    let fits = ends.partition_point(|&objective| {
        trials.feasible(&Trial { without: objective..all, ..as_is.clone() })
    });
    let last = ends[..fits].iter().rev().find(|objective| whole(objective));
    found.extend(last.map(|&objective| Relaxation::DropObjective { objective }));
    found
}

impl Relaxation {
    /// The mission, limits and hardware with this change; `None` when it is not one of this
    /// mission.
    pub fn apply(
        &self,
        mission: &Unfolded,
        mut limits: [u64; 2],
        mut available: Equipment,
    ) -> Option<(Unfolded, [u64; 2], Equipment)> {
        let mut changed = None;
        match self {
            Self::RaiseLimit { axis, to, .. } => *limits.get_mut(*axis)? = *to,
            Self::RaiseLimits { to, .. } => limits = *to,
            Self::LiftConstraint { zone, constraint } => {
                changed = Some(mission.without_zone_constraint(*zone, *constraint)?);
            }
            Self::LiftConstraints { constraints } => {
                for &(zone, constraint) in constraints {
                    let before = changed.as_ref().unwrap_or(mission);
                    changed = Some(before.without_zone_constraint(zone, constraint)?);
                }
            }
            Self::KeepHardware { hardware, units } => {
                available = available.with(*hardware, *units)?;
            }
            Self::KeepHardwares { hardware } => {
                for &(kind, units) in hardware {
                    available = available.with(kind, units)?;
                }
            }
            Self::DropObjective { objective } => {
                changed = Some(mission.without_objective(*objective)?);
            }
        }
        Some((changed.unwrap_or_else(|| mission.clone()), limits, available))
    }
}
