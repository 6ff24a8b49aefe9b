//! The requirements of the decisional level: questions to the model checker, and the reasons why
//! each of them holds.

mod guarded;
mod properties;
mod recovery_properties;
mod requirement;

pub use guarded::Guarded;
pub use properties::REQUIREMENTS;
pub use recovery_properties::{RECOVERY_REQUIREMENTS, REPLACED};
pub use requirement::{Asked, Requirement, Said, Watch};
