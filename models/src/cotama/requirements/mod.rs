//! What the decisional level is required to do: questions to the model checker, and what makes each
//! of them true.

mod guarded;
mod properties;
mod recovery_properties;
mod requirement;

pub use guarded::Guarded;
pub use properties::REQUIREMENTS;
pub use recovery_properties::{RECOVERY_REQUIREMENTS, REPLACED};
pub use requirement::{Asked, Requirement, Said, Watch};
