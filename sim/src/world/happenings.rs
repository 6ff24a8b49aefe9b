//! The events of the robot at its places.

use super::World;
use crate::record::Recorder;
use cotama_models::missions::faults::EventKind;

impl World<'_> {
    /// Everything that waits at this place happens, with a check after each event, until one holds
    /// the robot up.
    pub(super) fn happen<R: Recorder>(&mut self, recorder: &mut R) {
        while let Some(&pending) = self.events.get(self.next_event) {
            if pending.x_nm > self.x_nm || self.ended.is_some() {
                return;
            }
            self.next_event += 1;
            self.set_leg();
            let units = self.happens(pending.kind);
            if self.hold_up(pending, recorder) {
                return;
            }
            if R::WANTED {
                recorder.record(self.event_record(&pending, units, 0));
            }
            self.check(recorder);
        }
    }

    /// One event happens. Gives the units of hardware that were really lost or came back.
    fn happens(&mut self, kind: EventKind) -> u8 {
        match kind {
            EventKind::Obstacle { .. } => {
                self.counts.obstacles += 1;
                0
            }
            EventKind::Odometry { .. } => {
                self.counts.odometry += 1;
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
                    self.planning.hardware_returned();
                }
                after - before
            }
        }
    }
}
