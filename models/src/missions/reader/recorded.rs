//! Reading what a campaign noted beside the faults of a failure.

use super::fields::Fields;
use crate::missions::faults::{Adapts, Ending, Expected, FIDELITIES, OUTCOMES, PlannedBy};
use crate::missions::known::{ALLOCATORS, COUNTS, OBJECTIVES, SEARCHES};

/// `[planner]`.
pub(super) fn planner(mut fields: Fields<'_>) -> Option<PlannedBy> {
    let objective = fields.choice("objective", "objective of plans", &OBJECTIVES.map(|it| it.0));
    let by = fields.choice("allocator", "allocator", &ALLOCATORS);
    let steps = fields.optional_integer("steps", SEARCHES);
    let policy = if fields.has("policy") {
        fields.choice("policy", "policy", &Adapts::NAMES.map(|it| it.0))
    } else {
        Some(Adapts::NAMES[0].0)
    };
    let fidelity = if fields.has("fidelity") {
        fields.choice("fidelity", "fidelity", &FIDELITIES)
    } else {
        Some(FIDELITIES[0])
    };
    fields.finish();
    let objective = OBJECTIVES.iter().find(|it| Some(it.0) == objective)?.1;
    let policy = Adapts::NAMES.iter().find(|it| Some(it.0) == policy)?.1;
    let fidelity = FIDELITIES.iter().position(|it| Some(*it) == fidelity)?;
    let exact = by? == ALLOCATORS[1];
    Some(PlannedBy { objective, exact, steps: steps.ok()?, policy, fidelity })
}

/// `[expected]`.
pub(crate) fn expected(mut fields: Fields<'_>) -> Option<Expected> {
    let mission = fields.optional_text("mission");
    let robot = fields.optional_text("robot");
    let seed = fields.optional_integer("seed", COUNTS);
    let requirement = fields.text("requirement");
    let outcome = fields.choice("outcome", "outcome", &OUTCOMES);
    let [time_ms, energy_mj, x_mm] =
        ["time_ms", "energy_mj", "x_mm"].map(|it| fields.integer::<u64>(it, COUNTS));
    let [replans, requests, exposed_ms, broken_ms] =
        ["replans", "requests", "exposed_ms", "broken_ms"]
            .map(|it| fields.optional_integer::<u64>(it, COUNTS));
    fields.finish();
    let end = Ending {
        outcome: outcome?,
        time_ms: time_ms?,
        energy_mj: energy_mj?,
        x_mm: x_mm?,
        replans: replans.ok()?,
        requests: requests.ok()?,
        exposed_ms: exposed_ms.ok()?,
        broken_ms: broken_ms.ok()?,
    };
    Some(Expected {
        mission: mission.ok()?.map(|it| it.value),
        robot: robot.ok()?.map(|it| it.value),
        seed: seed.ok()?.unwrap_or(0),
        requirement: requirement?.value,
        end,
    })
}
