//! COTAMA (Durand, Godary-Dejean, Lapierre, Passama, Crestani, TAROS 2010): the decisional level of
//! a Pioneer 3-DX that delivers an object from one office to another.
//!
//! The paper describes the supervisors and shows some of them as figures; the nets here are a
//! reconstruction, and names of places and transitions are ours.
//!
//! Beside the nets stands what they rest on, as data without heap: modules and resources with the
//! closure that says what is [`available`], [`Configuration`]s, the decision as a function
//! ([`decide`]) and the two rules behind it ([`by_rules`]), the FMECA ([`RULES`], [`TEXTS`]) and
//! the diagnosis of flags ([`diagnose`]). Every fact says whether it is stated, inferred or
//! assumed, by its [`Label`] or in its documentation.

mod causes;
mod configurations;
mod decision_table;
mod delivery_system;
mod diagnosis;
mod flags;
mod fmeca;
mod fmeca_table;
mod guarded;
mod health;
mod label;
mod level;
pub mod load;
mod members;
#[cfg(feature = "std")]
pub mod mission_net;
mod module_table;
mod modules;
mod ports;
mod properties;
pub mod recovery;
mod recovery_properties;
mod report;
mod resources;
mod robot;
mod severity;
mod situation;
mod status_vector;
mod supervisors;
mod surroundings;
mod world;

pub use causes::{Rib, functions, ribs};
pub use configurations::{
    CONFIGURATIONS, Configuration, ConfigurationFacts, Configurations, DEGRADED_SPEED, FULL_SPEED,
    Mode, SubObjective,
};
pub use decision_table::{contextual, recovering_contextual};
pub use delivery_system::{delivery, recovering};
pub use diagnosis::{
    Diagnosis, Probe, Probes, ambiguity_groups, are_confusable, confusable_pairs, diagnose,
    is_detectable, shared_flags, undetectable,
};
pub use flags::{Flag, Flags};
pub use fmeca::{Description, FMECA_COLUMNS, FmecaCsv, Persistence, Rule, Signature};
pub use fmeca_table::{FailureMode, FailureModes, RULES, TEXTS};
pub use guarded::Guarded;
pub use health::{Health, Status, StatusVector};
pub use label::Label;
pub use level::{Cause, DecisionalLevel, Level, Permit, Return, Told, named};
pub use module_table::MODULES;
pub use modules::{Kind, Module, ModuleFacts, Modules, available};
pub use ports::{Data, Datum, ModuleEvent, ModuleEvents, Parameter, Request};
pub use properties::{Asked, REQUIREMENTS, Requirement, Said, Watch};
pub use recovery_properties::{RECOVERY_REQUIREMENTS, REPLACED};
pub use report::{Class, Decision, Report, Reports, decide, lost_after};
pub use resources::{Resource, Resources};
pub use robot::permit;
pub use severity::{Severity, by_availability, by_rules, by_severity, is_settled, judge, severity};
pub use situation::{Loss, Losses, Situation};
pub use status_vector::{observation, recovering_observation};
pub use supervisors::{
    global, local, path_following, recovering_path_following, recovering_teleoperation,
    teleoperation,
};
pub use surroundings::{faults, operator, recovering_faults};
pub use world::environment;

use cotama_core::system;

system! {
    /// The decisional level and its environment, for one mission of two drives. In a round the
    /// supervisors take their turns in this order; then the environment does one thing.
    pub mod decision {
        nets {
            gs: global,
            ls: local,
            pf: path_following,
            to: teleoperation,
            cs: contextual,
            env: environment,
        }
        links {
            gs.start_drive => ls.start_drive mail 1;
            gs.gs_abort => ls.gs_abort now;
            ls.ended => ls.tick mail 1;
            ls.drive_done => gs.drive_done mail 1;
            ls.pf_start => pf.pf_start now;
            ls.pf_stop => pf.pf_stop now;
            ls.to_start => to.to_start now;
            ls.to_stop => to.to_stop now;
            cs.global_event => gs.global_event mail 1;
            cs.local_event => ls.local_event mail 1;
            cs.adapt_rt => pf.adapt_rt mail 1;
            cs.adapt_mcl => pf.adapt_mcl mail 1;
            cs.adapt_sonar => pf.adapt_sonar mail 1;
            cs.adapt_bump => pf.adapt_bump mail 1;
            cs.adapt_sonar_teleoperation => to.adapt_sonar mail 1;
            env.mission => gs.mission_received now;
            env.object => gs.object_received now;
            env.delivery => gs.object_delivered now;
            env.stand => gs.stopped now;
            env.path => ls.path_ready now;
            env.goal => ls.goal_reached now;
            env.teleprogram => ls.op_teleprogram now;
            env.teleoperate => ls.op_teleoperate now;
            env.waypoints => ls.op_waypoints now;
            env.new_path => ls.op_path now;
            env.operator_goal => ls.op_goal_reached now;
            env.report_slow => cs.slow mail 1;
            env.report_ambiguous => cs.ambiguous mail 1;
            env.report_collision => cs.collision mail 1;
            env.report_planner => cs.planner mail 1;
            env.report_hard => cs.hard mail 1;
            env.report_avoidance => cs.avoidance mail 1;
            env.report_refusal => cs.refusal mail 1;
            env.report_mcl => cs.mcl_lost mail 1;
            env.report_sonar => cs.sonar mail 1;
            env.report_camera => cs.camera mail 1;
            env.report_wifi => cs.wifi_lost mail 1;
            env.report_vital => cs.vital mail 1;
        }
        shared {
            ls.camera = env.camera;
            ls.wifi & cs.wifi = env.wifi;
            pf.sonar & to.sonar = env.sonar;
            pf.mcl & cs.mcl = env.mcl;
            cs.planning & env.planning = ls.Planning;
            cs.following & env.following = ls.Following;
            cs.hand_over & env.hand_over = ls.HandOver;
            cs.teleprogrammed & env.teleprogrammed = ls.Teleprogrammed;
            cs.teleoperated & env.teleoperated = ls.Teleoperated;
            cs.optimal & env.optimal = pf.Optimal;
            cs.reduced & env.reduced = pf.Reduced;
            cs.odometric = pf.Odometric;
            cs.degraded = pf.Degraded;
            cs.avoiding = to.Full;
            cs.level = pf.level;
            env.waiting = gs.Wait;
            env.receiving = gs.Receive;
            env.delivering = gs.Deliver;
            env.securing = gs.Security;
            env.safe = gs.Safe;
            env.idle = ls.Idle;
        }
        pending {
            ls.local_pending & env.local_pending = ls.local_event;
            ls.global_pending & env.global_pending = gs.global_event;
        }
        clears {
            ls.gs_abort empties ls.local_event & ls.start_drive;
        }
    }
}
