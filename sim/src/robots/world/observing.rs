//! Flags of a period: told of failures, or raised by signals; and what is diagnosed of them.

use super::World;
use super::records::Recording;
use crate::record::Recorder;
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::level::Cause;

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Observers look whether settings are still needed, and whether what is lost works again.
    pub(super) fn see(&mut self, now: Millis) {
        let tables = self.tables();
        let broken = self.failures.broken_losses(self.robot, tables);
        self.decider.see(now, self.failures.shown(tables), broken);
        #[cfg(test)]
        self.note_observed(now);
        self.calm &= self.decider.listens();
    }

    /// Observers raise flags, and what they show is reported.
    pub(super) fn observe<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let unmasked = self.decider.unmasked(self.now);
        self.failures.unmask(self.tables(), unmasked);
        let mut seen = self.failures.look(self.robot, self.place);
        let (tables, now) = (self.tables(), self.now);
        let (new, shown) = match self.drive.flags() {
            Some(up) => self.failures.sense(self.robot, up, now),
            None => (0, Vec::new()),
        };
        seen.extend(shown);
        if seen.is_empty() && new == 0 {
            return;
        }
        self.calm = false;
        let hidden = self.decider.hidden(self.now);
        let (raised, taken) = self.failures.diagnosed(self.robot, tables, (new, &seen), hidden);
        if taken.is_empty() && self.failures.signals.is_some() {
            return; // flags that no row explains are not told
        }
        self.failures.find(&seen);
        if seen.is_empty() {
            self.run.alarms.push((self.now, taken.clone()));
        }
        for it in &seen {
            if let Some(conduct) = self.run.conduct.get_mut(*it) {
                conduct.detected = Some(self.now);
                conduct.taken_for.clone_from(&taken);
            }
        }
        self.record_diagnosis(recording, &seen, &raised, &taken);
        for failure in taken {
            let its_own = seen
                .iter()
                .find(|it| self.failures.all.get(**it).is_some_and(|it| it.number == failure));
            // A false alarm has no failure for its cause.
            let cause = its_own.or(seen.first()).map_or(0, |it| it + 1);
            let cause = Cause(u16::try_from(cause).unwrap_or(u16::MAX));
            self.decider.report(failure, cause);
        }
    }
}
