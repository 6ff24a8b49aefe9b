//! The supervisors of the decisional level as nets, and composed with what happens to them.

mod decision_table;
mod delivery_system;
mod hierarchy;
pub mod recovery;
mod status_vector;
mod surroundings;

pub use crate::level::permit;
pub use decision_table::{contextual, recovering_contextual};
pub use delivery_system::{delivery, recovering, supervision};
pub use hierarchy::{
    global, local, path_following, recovering_path_following, recovering_teleoperation,
    teleoperation,
};
pub use status_vector::{observation, recovering_observation};
pub use surroundings::{faults, operator, recovering_faults};
