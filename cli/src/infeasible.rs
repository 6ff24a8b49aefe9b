//! Why there is no plan, as an answer.

use crate::answers::{Change, Heavy, Kept, Reason, Relaxation, ZoneConstraint};
use cotama_core::allocation::Shortfall;
use cotama_core::hardware::Equipment;
use cotama_models::missions::infeasible;
use cotama_models::missions::{AXES, Constraint, Mission};

/// Why a mission has no plan within these limits with this hardware; none if it has one, or if the
/// search for the explanation was cut short.
pub(crate) fn explain(mission: &Mission, limits: [u64; 2], available: Equipment) -> Option<Reason> {
    let found = infeasible::explain(mission, limits, available)?;
    let mut reason = match &found.reason {
        infeasible::Reason::Limit { axis, limit, least } => over(*axis, *limit, *least),
        infeasible::Reason::Limits { limits, least } => {
            let axis = mission.order[0];
            over(axis, limits[axis], least[axis])
        }
        infeasible::Reason::NoAlternative { activity, .. } => {
            let id = mission.scenario().activities.get(*activity).map(|it| it.id.clone());
            Reason { activity: id, ..Reason::default() }
        }
        infeasible::Reason::SomeLimit { .. } => Reason::default(),
        infeasible::Reason::Undecided { .. } => return None,
    };
    reason.text = found.reason.wording(mission);
    reason.heaviest = found.heaviest.iter().map(|heavy| heaviest(mission, heavy)).collect();
    reason.relaxations = found.relaxations.iter().map(|it| relaxation(mission, it)).collect();
    Some(reason)
}

/// Returns the reason of an allocator that proved within so many steps that there is no plan.
pub(crate) fn short(shortfall: Option<Shortfall>, steps: u64) -> Reason {
    let undecided = || Reason {
        text: format!(
            "no plan is within the limits; which of them cannot be met is not known after {steps} \
             steps: use more `--steps`"
        ),
        ..Reason::default()
    };
    shortfall.map_or_else(undecided, |it| over(it.axis(), it.limit(), it.least()))
}

/// A limit that is below the least that is needed.
fn over(axis: usize, limit: u64, least: u64) -> Reason {
    let axis = axis.min(1);
    let gap = least.saturating_sub(limit);
    let [limited, needed, more] = [limit, least, gap].map(|it| infeasible::amount(axis, it));
    let name = AXES[axis];
    Reason {
        text: format!(
            "the {name} limit of {limited} cannot be met: at least {needed} are needed (+{more})"
        ),
        axis: Some(name.into()),
        limit: Some(limit),
        least: Some(least),
        gap: Some(gap),
        ..Reason::default()
    }
}

/// The rule of the paper says that there is no plan, and is wrong.
pub(crate) fn missed(way_out: &str) -> Reason {
    let text = format!("the rule of PANORAMA finds no plan, but a complete search does: {way_out}");
    Reason { text, ..Reason::default() }
}

fn heaviest(mission: &Mission, heavy: &infeasible::Heavy) -> Heavy {
    Heavy {
        activity: mission
            .scenario()
            .activities
            .get(heavy.activity)
            .map_or_else(String::new, |it| it.id.clone()),
        cost: heavy.cost.into(),
        permille: heavy.permille,
        text: heavy.wording(mission),
    }
}

fn relaxation(mission: &Mission, found: &infeasible::Relaxation) -> Relaxation {
    use infeasible::Relaxation as Found;
    let lifted = |&(zone, constraint): &(usize, Constraint)| ZoneConstraint {
        zone: mission.zones.get(zone).map_or_else(String::new, |zone| zone.id.clone()),
        constraint: match constraint {
            Constraint::Hardware => "hardware",
            Constraint::Tio => "option",
        },
    };
    let kept = |&(kind, units): &(usize, u8)| Kept {
        hardware: mission.hardware.get(kind).map_or_else(String::new, |it| it.name.clone()),
        units,
    };
    let change = match found {
        Found::RaiseLimit { axis: 0, to, .. } => {
            Change::RaiseLimit { duration_limit_ms: Some(*to), energy_limit_mj: None }
        }
        Found::RaiseLimit { to, .. } => {
            Change::RaiseLimit { duration_limit_ms: None, energy_limit_mj: Some(*to) }
        }
        Found::RaiseLimits { to: [duration, energy], .. } => Change::RaiseLimit {
            duration_limit_ms: Some(*duration),
            energy_limit_mj: Some(*energy),
        },
        Found::LiftConstraint { zone, constraint } => {
            Change::LiftConstraint { constraints: vec![lifted(&(*zone, *constraint))] }
        }
        Found::LiftConstraints { constraints } => {
            Change::LiftConstraint { constraints: constraints.iter().map(lifted).collect() }
        }
        Found::KeepHardware { hardware, units } => {
            Change::KeepHardware { hardware: vec![kept(&(*hardware, *units))] }
        }
        Found::KeepHardwares { hardware } => {
            Change::KeepHardware { hardware: hardware.iter().map(kept).collect() }
        }
        Found::DropObjective { objective } => {
            let id =
                mission.objectives.get(*objective).map_or_else(String::new, |it| it.id.clone());
            Change::DropObjective { objective: id }
        }
    };
    Relaxation { change, text: found.wording(mission) }
}

impl Relaxation {
    /// The limits of duration and energy that are raised, if that is the change.
    pub(crate) fn raised(&self) -> Option<(Option<u64>, Option<u64>)> {
        match self.change {
            Change::RaiseLimit { duration_limit_ms, energy_limit_mj } => {
                Some((duration_limit_ms, energy_limit_mj))
            }
            _ => None,
        }
    }
}
