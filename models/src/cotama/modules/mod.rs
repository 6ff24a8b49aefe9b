//! The executive level: modules, what they stand on, which sets of them run, and the
//! processor time that they take.

mod configurations;
mod health;
pub mod load;
mod module;
mod resources;
mod table;

pub use configurations::{
    CONFIGURATIONS, Configuration, ConfigurationFacts, Configurations, DEGRADED_SPEED, FULL_SPEED,
    Mode, SubObjective,
};
pub use health::{Health, Status, StatusVector};
pub use module::{Kind, Module, ModuleFacts, Modules};
pub use resources::{Resource, Resources};
pub use table::{MODULES, available};
