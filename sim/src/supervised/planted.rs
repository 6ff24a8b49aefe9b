//! Defects planted on purpose, so that it can be measured what finds them: of observers, of the use
//! of the allocator, of the simulated robot. Those of the supervisors are nets changed by hand:
//! [`Supervised::of_supervisors`](super::Supervised::of_supervisors).

use cotama_core::units::Millis;
use cotama_models::cotama::FailureMode;

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
