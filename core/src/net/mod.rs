//! Supervisors as typed Petri nets.

mod data;
mod defect;
#[cfg(feature = "alloc")]
pub mod owned;

pub use data::{
    Arc, EventId, Ignored, Law, Net, OutputId, Place, PlaceId, Role, Signal, Transition, TransitionId, Within,
};
pub use defect::Defect;
