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

mod decisions;
mod dependability;
mod label;
mod level;
mod members;
mod modules;
mod requirements;
mod supervisors;
mod world;

pub use decisions::*;
pub use dependability::*;
pub use label::Label;
#[cfg(feature = "std")]
pub(crate) use level::WAIT_OVER;
pub use level::{Cause, DecisionalLevel, Level, Permit, Return, Told, named};
pub use modules::*;
pub use requirements::*;
pub use supervisors::*;
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
