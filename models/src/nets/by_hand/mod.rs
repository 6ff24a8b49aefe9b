//! COTAMA's supervisors, written by hand: an example of nets that the compiler checks, and of how
//! they work together (Durand et al., TAROS 2010, Section V and Figs. 3 and 4; what the paper shows
//! as figures is reconstructed, and names of places and transitions are ours). A robot at work runs
//! the supervisors that its [file](crate::level) makes.

mod decision_table;
mod delivery_system;
mod hierarchy;
mod status_vector;
mod surroundings;

pub use crate::level::permit;
pub use decision_table::contextual;
pub use delivery_system::{delivery, supervision};
pub use hierarchy::{global, local, path_following, teleoperation};
pub use status_vector::observation;
pub use surroundings::{faults, operator};
