//! Explanations for people: one sentence each, with ids and units.

use super::{Heavy, Reason, Relaxation};
use crate::missions::definition::AXES;
use crate::missions::mission::Unfolded;
use crate::missions::scenario::Constraint;
use crate::missions::tables::{DURATION, ENERGY};
use cotama_core::hardware::Equipment;
use cotama_core::units::Millimetres;

/// The name of an axis.
fn name(axis: usize) -> &'static str {
    AXES.get(axis).copied().unwrap_or("unknown")
}

/// So much of an axis, ms or mJ, in seconds or joules: exact, in as few digits as that takes.
///
/// ```
/// use cotama_models::missions::infeasible::amount;
/// use cotama_models::missions::tables::{DURATION, ENERGY};
/// assert_eq!(amount(DURATION, 8_500), "8.5 s");
/// assert_eq!([4_675_896, 4_000_000].map(|it| amount(ENERGY, it)), ["4675.896 J", "4000 J"]);
/// ```
pub fn amount(axis: usize, value: u64) -> String {
    format!("{} {}", thousandths(value), if axis == ENERGY { "J" } else { "s" })
}

/// A place on the path, in metres.
fn at(Millimetres(x): Millimetres) -> String {
    format!("{} m", thousandths(x))
}

fn thousandths(value: u64) -> String {
    let digits = format!("{}.{:03}", value / 1000, value % 1000);
    digits.trim_end_matches('0').trim_end_matches('.').to_owned()
}

impl Reason {
    /// The reason in a sentence, without a full stop.
    pub fn wording(&self, mission: &Unfolded) -> String {
        match self {
            Self::Limit { axis, limit, least } => {
                let other = name(usize::from(*axis == DURATION));
                format!(
                    "the {} limit of {} cannot be met: within the {other} limit the least is {} \
                     ({})",
                    name(*axis),
                    amount(*axis, *limit),
                    amount(*axis, *least),
                    more(*axis, *limit, *least)
                )
            }
            Self::Limits { limits, least } => {
                let [duration, energy] = [DURATION, ENERGY].map(|axis| {
                    let more = more(axis, limits[axis], least[axis]);
                    let [limit, least] = [limits, least].map(|it| amount(axis, it[axis]));
                    format!("the least {} is {least}, the limit {limit} ({more})", name(axis))
                });
                format!("neither limit can be met, even without the other: {duration}; {energy}")
            }
            Self::NoAlternative { activity, lacks, constraints, others } => {
                let lacks: Vec<_> = lacks.iter().map(|&lack| units(mission, lack)).collect();
                let place = place(mission, *activity);
                let lacks = lacks.join(", or ");
                let mut said = format!(
                    "{place} has no alternative with this hardware: every one needs {lacks}"
                );
                if !constraints.is_empty() {
                    let constraints: Vec<_> = constraints
                        .iter()
                        .map(|&(zone, which)| constraint(mission, zone, which))
                        .collect();
                    said = format!("{said}; others are excluded by {}", listed(&constraints));
                }
                if !others.is_empty() {
                    let others: Vec<_> =
                        others.iter().map(|&other| id(mission, other).to_owned()).collect();
                    said = format!("{said}; nor have {}", listed(&others));
                }
                said
            }
            Self::SomeLimit { steps } => {
                format!(
                    "no plan is within the limits; which of them cannot be met, and by how much, \
                     was not found in {steps} steps"
                )
            }
            Self::Undecided { steps } => {
                format!(
                    "neither a plan nor the proof that there is none was found in {steps} steps"
                )
            }
        }
    }
}

impl Heavy {
    /// The activity, its place, its cost and its part of the total.
    pub fn wording(&self, mission: &Unfolded) -> String {
        format!(
            "{}: {}, {}",
            place(mission, self.activity),
            amount(self.axis, self.cost.into()),
            percent(self.permille.into())
        )
    }
}

impl Relaxation {
    /// The change as an advice, without a full stop.
    pub fn wording(&self, mission: &Unfolded) -> String {
        match self {
            Self::RaiseLimit { axis, from, to } => format!("raise {}", raised(*axis, *from, *to)),
            Self::RaiseLimits { from, to } => {
                let [duration, energy] = [0, 1].map(|axis| raised(axis, from[axis], to[axis]));
                format!("raise {duration} and {energy}")
            }
            Self::LiftConstraint { zone, constraint: which } => {
                format!("lift {}", constraint(mission, *zone, *which))
            }
            Self::LiftConstraints { constraints } => {
                let constraints: Vec<_> = constraints
                    .iter()
                    .map(|&(zone, which)| constraint(mission, zone, which))
                    .collect();
                format!("lift {}", listed(&constraints))
            }
            Self::KeepHardware { hardware, units } => {
                format!("keep {}", kept(mission, *hardware, *units))
            }
            Self::KeepHardwares { hardware } => {
                let kinds: Vec<_> =
                    hardware.iter().map(|&(kind, units)| kept(mission, kind, units)).collect();
                format!("keep {}", listed(&kinds))
            }
            Self::DropObjective { objective } => match mission.objectives.get(*objective) {
                Some(it) if it.travels() => {
                    let follows = mission.objectives.len() > objective + 1;
                    let follows = if follows { " and all that follow" } else { "" };
                    format!("drop objective {}{follows}, ending at {}", it.id, at(it.x_start))
                }
                it => format!("drop objective {}", it.map_or("", |it| it.id.as_str())),
            },
        }
    }
}

fn raised(axis: usize, from: u64, to: u64) -> String {
    let [low, high] = [from, to].map(|it| amount(axis, it));
    format!("the {} limit from {low} to {high} ({})", name(axis), more(axis, from, to))
}

/// By how much more, absolute and relative.
fn more(axis: usize, from: u64, to: u64) -> String {
    let by = to.saturating_sub(from);
    let shown = amount(axis, by);
    match (u128::from(by) * 1000 + u128::from(from / 2)).checked_div(from.into()) {
        Some(permille) => format!("+{shown}, {}", percent(permille)),
        None => format!("+{shown}"),
    }
}

fn percent(permille: u128) -> String {
    match permille {
        0 => "below 0.1 %".to_owned(),
        _ => format!("{}.{} %", permille / 10, permille % 10),
    }
}

fn constraint(mission: &Unfolded, zone: usize, which: Constraint) -> String {
    let which = match which {
        Constraint::Hardware => "hardware",
        Constraint::Tio => "option",
    };
    format!(
        "the {which} constraint of zone \"{}\"",
        mission.zones.get(zone).map_or("", |zone| &zone.id)
    )
}

fn kept(mission: &Unfolded, kind: usize, units: u8) -> String {
    format!("{units} {}", mission.hardware.get(kind).map_or("", |it| &it.name))
}

fn units(mission: &Unfolded, units: Equipment) -> String {
    let kinds = (0..mission.hardware.len()).filter(|&kind| units.of(kind) > 0);
    let kinds: Vec<_> = kinds.map(|kind| kept(mission, kind, units.of(kind))).collect();
    listed(&kinds)
}

fn id(mission: &Unfolded, activity: usize) -> &str {
    mission.scenario().activities.get(activity).map_or("", |it| &it.id)
}

fn place(mission: &Unfolded, activity: usize) -> String {
    let Some(it) = mission.scenario().activities.get(activity) else { return String::new() };
    let objective = mission.objectives.get(it.objective).map_or("", |objective| &objective.id);
    let place = if it.x_start < it.x_end {
        format!("{} to {}", at(it.x_start), at(it.x_end))
    } else {
        format!("at {}", at(it.x_start))
    };
    format!("activity {} (objective {objective}, {place})", it.id)
}

/// The most things listed in a sentence.
const MAX_LISTED: usize = 10;

/// `a`, `a and b`, `a, b and c`, and of very many the first and the number of the others.
fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] if parts.len() <= MAX_LISTED => {
            format!("{} and {last}", first.join(", "))
        }
        _ => format!("{} and {} more", parts[..MAX_LISTED].join(", "), parts.len() - MAX_LISTED),
    }
}
