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
///
/// ```
/// use cotama_core::units::{Millimetres, Millis};
/// use cotama_models::cotama::FailureMode::Son2;
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::supervised::{Injection, Planted, Script, Supervised, When};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let injections = vec![Injection::new(When::Place(Millimetres(5_000)), Son2)];
/// let script = Script { injections, ..Script::default() };
/// let late = Planted::Late(Son2, Millis(20_000));
/// let blind = Supervised::new(&mission).unwrap().with_planted(vec![late]);
/// assert_eq!(blind.run(&script).unwrap().unseen, Millis(20_000));
/// ```
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
