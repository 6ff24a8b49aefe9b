//! What happens to the robot at its places.

use super::World;
use crate::record::Recorder;
use crate::setup::NM_PER_MM;
use cotama_models::missions::faults::EventKind;

impl World<'_> {
    /// Everything that waits at this place happens, with a check after each event.
    pub(super) fn happen<R: Recorder>(&mut self, recorder: &mut R) {
        while let Some(&pending) = self.events.get(self.next_event) {
            if pending.x_nm > self.x_nm || self.ended.is_some() {
                return;
            }
            self.next_event += 1;
            self.set_leg();
            let before_us = self.time_us;
            let units = self.happens(pending.kind);
            if R::WANTED {
                recorder.record(self.event_record(&pending, units, self.time_us - before_us));
            }
            self.check(recorder);
        }
    }

    /// One event happens. Gives the units of hardware that were really lost or came back.
    fn happens(&mut self, kind: EventKind) -> u8 {
        match kind {
            EventKind::Obstacle { delay } => {
                self.counts.obstacles += 1;
                self.hinder(delay.0.saturating_mul(1000), self.leg.real_uw);
                0
            }
            EventKind::Odometry { extra } => {
                self.counts.odometry += 1;
                if let Some((speed, real_uw)) = self.driving() {
                    let way_nm = extra.0.saturating_mul(NM_PER_MM);
                    self.hinder(way_nm.div_ceil(speed), real_uw);
                }
                0
            }
            EventKind::Fault { hardware, units } => {
                self.counts.faults += 1;
                let before = self.available.of(hardware);
                self.available = self.available.without(hardware, units);
                let lost = before - self.available.of(hardware);
                self.lost = (hardware, lost);
                lost
            }
            EventKind::Repair { hardware, units } => {
                self.counts.repairs += 1;
                let before = self.available.of(hardware);
                let all = self.simulation.all_hardware().of(hardware);
                let after = before.saturating_add(units).min(all);
                self.available = self.available.with(hardware, after).unwrap_or(self.available);
                if after > before {
                    self.monitor.hardware_returned();
                }
                after - before
            }
        }
    }

    /// Time is lost, in one piece.
    fn hinder(&mut self, us: u64, power_uw: u64) {
        self.time_us = self.time_us.saturating_add(us);
        self.take(us, power_uw);
    }

    /// The speed (mm/s, above zero) and the real power (µW) of the current activity, or of the
    /// first one after it that travels; none if none does.
    fn driving(&self) -> Option<(u64, u64)> {
        let mut remaining =
            (self.activity..self.choice.len()).map(|activity| self.chosen(activity));
        let alternative = remaining.find(|alternative| alternative.speed.0 > 0)?;
        Some((alternative.speed.0, self.real_uw(&alternative)))
    }
}
