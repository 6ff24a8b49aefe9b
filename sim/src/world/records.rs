//! The robot's records in the trace.

use super::World;
use crate::plan::NM_PER_MM;
use crate::run::{PlanCause, PlanMade, Reason, Run};
use crate::setup::Pending;
use crate::trace::{Abort, Activity, End, Event, Occurrence, PlanRow, Record, Sample};
use cotama_core::units::mul_div_half_up;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::EventKind;

impl PlanMade {
    /// The plan in words and numbers: one row an activity. `mission` must be the mission that was
    /// run.
    pub fn rows(&self, mission: &Mission) -> Vec<PlanRow> {
        let slowed = self.slowed_by.and_then(|it| mission.slowed(it));
        let activities = mission.scenario().activities.iter().enumerate();
        let rows = activities.skip(self.first_activity).zip(&self.choice).enumerate();
        rows.filter_map(|(row, ((number, activity), &id))| {
            let own = slowed.as_ref().and_then(|it| it.alternatives.get(number));
            let alternative = own.unwrap_or(&activity.alternatives).get(usize::from(id))?;
            let whole = alternative.cost(activity.table().whole(alternative))?;
            let [duration, energy] = if row == 0 { self.first_cost } else { whole };
            Some(PlanRow {
                activity: activity.id.clone(),
                choice: activity.labels.get(usize::from(id)).cloned().unwrap_or_default(),
                speed_mm_s: alternative.speed.0,
                duration_ms: u64::from(duration),
                energy_mj: u64::from(energy),
            })
        })
        .collect()
    }
}

impl World<'_> {
    fn x_mm(&self) -> u64 {
        self.x_nm / NM_PER_MM
    }

    fn id(&self, activity: usize) -> String {
        self.simulation
            .mission()
            .scenario()
            .activities
            .get(activity)
            .map_or_else(String::new, |it| it.id.clone())
    }

    pub(super) fn activity_record(&self) -> Record {
        Record::Activity(Activity {
            t_us: self.time_us,
            x_mm: self.x_mm(),
            activity: self.id(self.activity),
            choice: self.planning.label(self.activity).to_owned(),
            speed_mm_s: self.leg.alternative.speed.0,
        })
    }

    pub(super) fn sample_record(&self, margins: [i64; 2]) -> Record {
        let (speed, power) = self.pace();
        Record::Sample(Sample {
            t_us: self.time_us,
            x_mm: self.x_mm(),
            used: self.used().into(),
            margins: margins.into(),
            planned_power_mw: power.0,
            real_power_mw: mul_div_half_up(self.real_now_uw(), 1, 1000).unwrap_or(u64::MAX),
            speed_mm_s: speed.0,
        })
    }

    pub(super) fn event_record(&self, pending: &Pending, units: u8, lost_us: u64) -> Record {
        let name = |kind: usize| {
            self.simulation
                .mission()
                .hardware
                .get(kind)
                .map_or_else(String::new, |it| it.name.clone())
        };
        let event = match pending.kind {
            EventKind::Obstacle { delay } => Occurrence::Obstacle { delay_ms: delay.0 },
            EventKind::Odometry { extra } => Occurrence::Odometry { extra_mm: extra.0 },
            EventKind::Fault { hardware, .. } => Occurrence::Fault {
                hardware: name(hardware),
                units_lost: units,
                units_left: self.available.of(hardware),
            },
            EventKind::Repair { hardware, .. } => Occurrence::Repair {
                hardware: name(hardware),
                units_back: units,
                units_left: self.available.of(hardware),
            },
        };
        let random = pending.random.and_then(|index| self.simulation.faults.random.get(index));
        let random = random.map(|random| random.name.clone());
        Record::Event(Event { t_us: self.time_us, x_mm: self.x_mm(), event, random, lost_us })
    }

    pub(super) fn abort_record(&self, cause: PlanCause, reason: Reason) -> Record {
        let mission = self.simulation.mission();
        Record::Abort(Abort {
            t_us: self.time_us,
            x_mm: self.x_mm(),
            cause: cause.text(mission),
            reason: reason.text(mission),
        })
    }

    pub(super) fn end_record(&self, run: &Run) -> Record {
        Record::End(End {
            t_us: run.time_us,
            x_mm: run.x_mm,
            outcome: run.outcome,
            reason: run.reason.map(|reason| reason.text(self.simulation.mission())),
            margins: run.margins.into(),
            used: run.used.into(),
            replans: run.replans,
            operator_requests: run.operator_requests,
        })
    }
}
