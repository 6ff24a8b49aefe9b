//! Sums that a mission with axes carries to its end, and their limits.

use super::PlannedActivity;
use crate::missions::diagnostic::Diagnostic;
use crate::missions::known::NO_LIMIT;
use cotama_axes::{Inducer, Kind, Mission, Relation};

/// An end constraint of a mission with axes (Lambert et al. 2024, equation 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct End {
    /// The constraint of the mission, by index.
    pub constraint: usize,
    /// The indicator that it limits, by index.
    pub indicator: usize,
    /// The relation of the sum to the goal.
    pub relation: Relation,
    /// The goal, in the unit of the indicator.
    pub goal: i64,
    /// The way in which the sum grows.
    pub grows: Grows,
}

/// The way in which a sum grows while the mission runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grows {
    /// As the simulator counts it, with all that happens on the way: duration (0) or energy (1).
    Counted(usize),
    /// With the time of an activity, waiting too: its formula reads the duration.
    WithTime,
    /// With the part of an activity that is done.
    WithWay,
}

impl End {
    /// Returns the axis that the simulator counts and the most that it may be, if it limits one.
    fn limit(&self) -> Option<(usize, u64)> {
        let Grows::Counted(axis) = self.grows else { return None };
        let most = match self.relation {
            Relation::AtMost => self.goal,
            Relation::Below => self.goal - 1,
            Relation::Equal | Relation::AtLeast | Relation::Above => return None,
        };
        Some((axis, most.max(0).unsigned_abs()))
    }
}

/// Returns the end constraints of a mission whose activities have the values of their candidates.
///
/// # Errors
/// That one asks for equality, which no run keeps to the last unit.
pub(in crate::missions) fn of(
    mission: &Mission,
    activities: &[PlannedActivity],
) -> Result<Vec<End>, Vec<Diagnostic>> {
    let (mut ends, mut errors) = (Vec::new(), Vec::new());
    for (constraint, it) in mission.constraints.iter().enumerate() {
        if it.kind != Kind::End {
            continue;
        }
        if it.relation == Relation::Equal {
            let message = format!("`{}` asks for equality, which no run keeps", it.id);
            let help = "write `<=` or `>=`; `cotama-axes/1` plans with `=`";
            errors.push(Diagnostic::new(0..0, message, "").help(help));
        }
        let (indicator, relation, goal) = (it.indicator, it.relation, it.goal);
        let grows = grows(mission, activities, indicator);
        ends.push(End { constraint, indicator, relation, goal, grows });
    }
    if errors.is_empty() { Ok(ends) } else { Err(errors) }
}

/// Whether sums beyond duration and energy have a limit.
pub(in crate::missions) fn are_further(ends: &[End]) -> bool {
    ends.iter().any(|it| !matches!(it.grows, Grows::Counted(_)))
}

/// Returns the limits on duration and energy, and the order in which they are treated.
pub(in crate::missions) fn limits(ends: &[End]) -> ([u64; 2], [usize; 2]) {
    let mut limits = [NO_LIMIT; 2];
    let mut order = Vec::new();
    for (axis, most) in ends.iter().filter_map(End::limit) {
        limits[axis] = limits[axis].min(most);
        if !order.contains(&axis) {
            order.push(axis);
        }
    }
    (limits, if order.first() == Some(&1) { [1, 0] } else { [0, 1] })
}

/// Returns the constraint that is the limit of each axis, by index.
pub(in crate::missions) fn limiting(ends: &[End]) -> [Option<usize>; 2] {
    [0, 1].map(|axis| {
        let own = ends.iter().filter_map(|it| Some((it.limit()?, it.constraint)));
        let own = own.filter(|it| it.0.0 == axis);
        own.min_by_key(|it| it.0.1).map(|it| it.1)
    })
}

/// Finds the sums that the simulator counts: an indicator in ms that is the duration of each
/// candidate, and one in mJ that is its energy.
fn grows(mission: &Mission, activities: &[PlannedActivity], indicator: usize) -> Grows {
    let Some(it) = mission.indicators.get(indicator) else { return Grows::WithWay };
    let counted = (0..2)
        .find(|axis| it.unit == ["ms", "mJ"][*axis] && is_counted(activities, indicator, *axis));
    if let Some(axis) = counted {
        return Grows::Counted(axis);
    }
    let mut inducers = it.travel.iter().chain(&it.stand).flat_map(|it| it.inducers());
    if inducers.any(|it| *it == Inducer::Duration) { Grows::WithTime } else { Grows::WithWay }
}

/// Whether an indicator has for each alternative the value that is its cost on an axis.
fn is_counted(activities: &[PlannedActivity], indicator: usize, axis: usize) -> bool {
    activities.iter().all(|planned| {
        let table = planned.table();
        let mut rows = planned.alternatives.iter().zip(&planned.derived);
        rows.all(|(it, derived)| {
            let cost = it.cost(table.whole(it)).map(|it| i64::from(it[axis]));
            cost == Some(derived.value(indicator))
        })
    })
}
