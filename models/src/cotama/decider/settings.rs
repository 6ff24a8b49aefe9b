//! Settings of modules that an adapter changes on weak and medium failures, and how long they last.

use crate::cotama::dependability::{Adjusted, Adjustment, Adjustments, Diagnosis, Flags};
use crate::cotama::level::Cause;
use crate::cotama::modules::Mode;
use crate::cotama::supervisors::{delivery, path_following, teleoperation};
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::{Firing, Names, Observer};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// One for each [`Adjustment`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Settings([Setting; Adjustment::ALL.len()]);

#[derive(Clone, Copy, Debug, Default)]
struct Setting {
    /// The finding that it answers, with its flags; and when one of them was last raised.
    cause: Cause,
    flags: Flags,
    seen: Millis,
    /// An adapter has changed it.
    changed: bool,
}

impl Settings {
    /// Adopts the setting that a diagnosis asks for.
    pub(super) fn found(&mut self, diagnosis: Diagnosis, flags: Flags, cause: Cause) {
        if let Some(setting) = diagnosis.adjustment().and_then(|it| self.0.get_mut(it as usize)) {
            (setting.cause, setting.flags) = (cause, flags);
        }
    }

    /// These flags are raised now.
    pub(super) fn see(&mut self, now: Millis, up: Flags) {
        for it in self.0.iter_mut().filter(|it| !it.flags.common(up).is_empty()) {
            it.seen = now;
        }
    }

    /// An adapter has acted on these findings, or starts with what is known.
    pub(super) fn change(&mut self, acted: &[Cause], starts: bool, up: Flags) {
        for it in &mut self.0 {
            it.changed |= it.cause.0 > 0 && acted.contains(&it.cause);
            it.changed |= starts && !it.flags.common(up).is_empty();
        }
    }

    /// Whether time alone changes nothing of what they leave.
    pub(super) fn stay(&self, now: Millis, up: Flags) -> bool {
        self.0.iter().all(|it| {
            let gone = now.0.saturating_sub(it.seen.0);
            let is_up = !it.flags.common(up).is_empty();
            !it.changed || is_up || gone >= u64::from(Adjustment::HOLD_MS)
        })
    }

    /// Returns the factors that the settings leave of speed and quality.
    pub(super) fn effect(&self, now: Millis, mode: Mode) -> Adjusted {
        let lasts = |it: &Setting| {
            let gone = now.0.saturating_sub(it.seen.0);
            it.changed && gone < u64::from(Adjustment::HOLD_MS)
        };
        let changed = Adjustment::ALL.iter().zip(&self.0).filter(|(_, it)| lasts(it));
        changed.fold(Adjustments::NONE, |all, (it, _)| all.with(*it)).effect(mode)
    }
}

/// Sees which findings adapters act on, and passes everything on.
pub(super) struct Acting<'o, O> {
    pub(super) observer: &'o mut O,
    acted: [Cause; 8],
    count: usize,
}

impl<'o, O> Acting<'o, O> {
    pub(super) fn new(observer: &'o mut O) -> Self {
        Self { observer, acted: [Cause(0); 8], count: 0 }
    }

    pub(super) fn acted(&self) -> &[Cause] {
        self.acted.get(..self.count).unwrap_or_default()
    }
}

impl<P: Names, O: Observer<P, Cause>> Observer<P, Cause> for Acting<'_, O> {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        let adapters = [
            Of::<PlaceId>::from(delivery::Place::pf(path_following::Place::Off)).component,
            Of::<PlaceId>::from(delivery::Place::to(teleoperation::Place::Off)).component,
        ];
        let Of::<TransitionId> { component, .. } = firing.id;
        if adapters.contains(&component)
            && let Some(slot) = self.acted.get_mut(self.count)
        {
            *slot = firing.carries;
            self.count = self.count.saturating_add(1);
        }
        self.observer.on_fire(firing);
    }

    fn on_ignore(&mut self, event: Of<EventId>, cause: Cause) {
        self.observer.on_ignore(event, cause);
    }
}
