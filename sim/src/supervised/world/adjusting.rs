//! Settings that adapters change on weak and medium failures, and what they leave of speed and
//! quality.

use super::{CLOCKS, PERIOD, World};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{Adjusted, Adjustment, Adjustments, Cause};

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// An adapter has acted on this cause: where its row says so, a setting changes.
    pub(super) fn adjust(&mut self, cause: Cause) {
        let failure = usize::from(cause.0).checked_sub(1).and_then(|it| self.failures.get_mut(it));
        if let Some(failure) = failure {
            failure.adjusted = true;
        }
    }

    /// An adapter starts, with the settings that what is known asks for.
    pub(super) fn start_adjusted(&mut self) {
        for (failure, conduct) in self.failures.iter_mut().zip(&self.run.conduct) {
            failure.adjusted |= !failure.over && conduct.detected.is_some();
        }
    }

    /// Settings outlast their failure for a while.
    pub(super) fn outlast(&mut self) {
        for it in self.failures.iter_mut().filter(|it| it.over) {
            it.past.0 += PERIOD.0;
        }
    }

    /// What the settings leave.
    pub(super) fn adjusted(&self) -> Adjusted {
        let hold = Millis(u64::from(Adjustment::HOLD_MS));
        let lasts = self.failures.iter().zip(&self.run.conduct);
        let lasts = lasts.filter(|(it, _)| it.adjusted && it.past <= hold);
        let adjustments = lasts.filter_map(|(_, it)| it.detected.and_then(|it| it.1.adjustment()));
        let all = adjustments.fold(Adjustments::NONE, Adjustments::with);
        all.effect(self.situation.mode())
    }

    /// So much of the path was driven.
    pub(super) fn drive_well(&mut self, activity: usize, way_mm: u64) {
        let quality = self.planning.quality(activity, self.situation.configuration());
        self.quality += way_mm * u64::from(quality) * u64::from(self.adjusted().quality);
    }
}
