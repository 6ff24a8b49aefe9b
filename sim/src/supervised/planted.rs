//! Defects planted on purpose, so that it can be measured what finds them: of observers, of the use
//! of the allocator, of the simulated robot. Those of the supervisors are nets changed by hand:
//! [`Supervised::of_supervisors`].

use super::{Supervised, Supervisors, Unsupervised};
use cotama_core::player::Packed;
use cotama_core::system::System;
use cotama_core::units::Millis;
use cotama_models::cotama::FailureMode;
use cotama_models::missions::Mission;

/// A defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planted {
    /// No observer sees this failure.
    Unseen(FailureMode),
    /// No observer sees the second failure while the first is under way.
    UnseenWhile(FailureMode, FailureMode),
    /// Observers see this failure so much later than its row of the FMECA says.
    Late(FailureMode, Millis),
    /// Plans are made with modules that are lost.
    PlansWithLost,
    /// The robot creeps on when it is to stand for good.
    Creeps,
}

impl<'m> Supervised<'m> {
    /// The embedded mission, or one with its objectives, under these supervisors: the nets of
    /// [`delivery`](cotama_models::cotama::delivery::SYSTEM) with transitions that were changed,
    /// for example. They have the places and events of those, in their order.
    ///
    /// # Errors
    /// When the nets do not fit each other.
    pub fn of_supervisors(
        mission: &'m Mission,
        system: System<'static>,
    ) -> Result<Self, Unsupervised> {
        let packed = Packed::of(&system).map_err(Unsupervised::Unfit)?;
        let supervisors = Supervisors::Given(system, Box::new(packed));
        Ok(Self::with(mission, supervisors))
    }

    /// With these defects.
    #[must_use]
    pub fn with_planted(self, planted: Vec<Planted>) -> Self {
        Self { planted, ..self }
    }
}
