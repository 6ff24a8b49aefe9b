//! The result of a run, from its trace.

use crate::answers::axes_run::FurtherMargin;
use crate::answers::risk::HeldAnswer;
use crate::answers::{EventRow, Outcome, PlanMade, PlanRow, RunBody};
use crate::margins::watch::Watch;
use cotama_core::units::mul_div_half_up;
use cotama_models::margins::Calibration;
use cotama_sim::run::Run;
use cotama_sim::trace::{self, Event, Occurrence, Plan, Record, Trace};

/// The answer for a run and the trace that it left.
pub(crate) fn body(trace: &Trace, run: &Run, mission: &str) -> RunBody {
    let reason = trace.records.iter().find_map(|record| match record {
        Record::End(end) => end.reason.clone(),
        _ => None,
    });
    let plans = trace.records.iter().filter_map(|record| match record {
        Record::Plan(it) => Some(plan_made(it)),
        _ => None,
    });
    let events = trace.records.iter().filter_map(|record| match record {
        Record::Event(it) => Some(event_row(it)),
        _ => None,
    });
    RunBody {
        mission: mission.into(),
        seed: trace.header.options.seed,
        outcome: match run.outcome {
            cotama_sim::run::Outcome::Completed => Outcome::Completed,
            cotama_sim::run::Outcome::Safe => Outcome::Safe,
            cotama_sim::run::Outcome::Failed => Outcome::Failed,
        },
        reason,
        infeasible: None,
        plans: plans.collect(),
        replans: run.replans,
        operator_requests: run.operator_requests,
        duration_margin_ms: Some(run.margins[0]),
        energy_margin_mj: Some(run.margins[1]),
        duration_ms: run.used[0],
        energy_mj: run.used[1],
        x_mm: run.x_mm,
        events: events.collect(),
        supervised: super::supervised::supervised(trace),
        held: held(trace, run),
        report: None,
        trace: None,
        recordings: Vec::new(),
    }
}

/// Whether the run kept within the margins that it held back; they stand in its trace.
fn held(trace: &Trace, run: &Run) -> Option<HeldAnswer> {
    let text = trace.header.options.margins.as_ref()?;
    let known = Calibration::parse("margins", text).ok()?;
    let mut watch = Watch::new(&known);
    watch.add(&run.spent);
    Some(watch.held())
}

/// A time in ms, rounded half up.
fn ms(us: u64) -> u64 {
    mul_div_half_up(us, 1, 1000).unwrap_or(0)
}

fn plan_made(plan: &Plan) -> PlanMade {
    let row = |row: &trace::PlanRow| PlanRow {
        activity: row.activity.clone(),
        choice: row.choice.clone(),
        speed_mm_s: row.speed_mm_s,
        duration_ms: row.duration_ms,
        energy_mj: row.energy_mj,
        quality: None,
    };
    PlanMade {
        cause: plan.cause.clone(),
        time_ms: ms(plan.t_us),
        x_mm: plan.x_mm,
        first_activity: plan.first_activity.clone(),
        plan: plan.plan.iter().map(row).collect(),
        duration_margin_before_ms: plan.before.map(|it| it.duration_ms),
        energy_margin_before_mj: plan.before.map(|it| it.energy_mj),
        duration_margin_after_ms: plan.after.duration_ms,
        energy_margin_after_mj: plan.after.energy_mj,
        steps: plan.steps,
        allocator: plan.allocator.clone(),
        further: plan.further.iter().map(further).collect(),
    }
}

fn further(it: &trace::FurtherMargin) -> FurtherMargin {
    FurtherMargin { constraint: it.constraint.clone(), margin: it.margin }
}

fn event_row(event: &Event) -> EventRow {
    let mut row = EventRow {
        time_ms: ms(event.t_us),
        x_mm: event.x_mm,
        kind: "",
        text: String::new(),
        lost_ms: ms(event.lost_us),
        hardware: None,
        units: None,
        units_left: None,
        extra_mm: None,
    };
    match &event.event {
        Occurrence::Obstacle { .. } => {
            row.kind = "obstacle";
            row.text = "an obstacle in the way".into();
        }
        Occurrence::Detour { door, extra_mm } => {
            row.kind = "detour";
            row.text = format!("`{door}` is closed, {extra_mm} mm more to drive");
            row.extra_mm = Some(*extra_mm);
        }
        Occurrence::Odometry { extra_mm } => {
            row.kind = "odometry";
            row.text = format!("the position was wrong, {extra_mm} mm more to drive");
            row.extra_mm = Some(*extra_mm);
        }
        Occurrence::Fault { hardware, units_lost, units_left } => {
            row.kind = "fault";
            row.text = format!("{hardware} failed: {units_lost} lost, {units_left} left");
            (row.units, row.units_left) = (Some(*units_lost), Some(*units_left));
            row.hardware = Some(hardware.clone());
        }
        Occurrence::Repair { hardware, units_back, units_left } => {
            row.kind = "repair";
            row.text = format!("{hardware} repaired: {units_back} back, {units_left} work");
            (row.units, row.units_left) = (Some(*units_back), Some(*units_left));
            row.hardware = Some(hardware.clone());
        }
    }
    if let Some(name) = &event.random {
        row.text = format!("{} ({name})", row.text);
    }
    row
}
