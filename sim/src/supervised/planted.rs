//! Missions with defects planted on purpose: see [`Planted`]. Those of the supervisors are nets
//! changed by hand: [`Supervised::of_supervisors`].

use super::{Supervised, Supervisors, Unsupervised};
use crate::body::Planted;
use cotama_core::player::Packed;
use cotama_core::system::System;
use cotama_models::missions::Mission;

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
