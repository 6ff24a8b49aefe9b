//! A decider that goes on from a stored state, in the memory where it is.

use super::{Decider, Known, Origin, Returns, Settings};
use crate::cotama::decisions::Losses;
use crate::cotama::dependability::{FailureModes, Flags};
use crate::cotama::level::Level;
use crate::cotama::modules::Health;
use cotama_core::player::Program;
use cotama_core::units::Millis;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// As [`resume`](Self::resume), without a second decider on the stack of a small processor.
    /// Objectives, and whether what returns is used again, stay as they are.
    ///
    /// ```
    /// use cotama_core::units::Millis;
    /// use cotama_models::cotama::{
    ///     DecisionalLevel, DeliveryDecider, Health, Module, Modules, delivery,
    /// };
    /// let mut decider = DeliveryDecider::start(delivery::Program, 4, None);
    /// let blind = Health { faulty: Modules::of(&[Module::Cam]), ..Health::SOUND };
    /// decider.restart(DecisionalLevel::default(), blind);
    /// assert_eq!(decider.health(), blind);
    /// ```
    pub fn restart(&mut self, level: Level<P, W, C, S>, known: Health) {
        self.level = level;
        self.known = Known::from(known);
        self.lost = Losses::lacking(self.known.relied_on);
        self.situation = self.level.situation(self.lost);
        self.global = self.level.global();
        (self.now, self.since, self.stands_since) = (Millis(0), Millis(0), Millis(0));
        self.up = Flags::NONE;
        self.found = FailureModes::NONE;
        self.origin.fill(Origin::default());
        self.findings = 0;
        self.settings = Settings::default();
        self.returns = self.returns.as_ref().map(|_| Returns::default());
        self.untold.clear();
        self.plannings_failed = 0;
        self.resigned = false;
    }
}
