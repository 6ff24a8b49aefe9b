//! The supervisors as they are shipped, composed; and the same where modules may return.

use super::decision_table::contextual;
use super::hierarchy::{global, local, path_following, teleoperation};
use super::status_vector::observation;
use super::surroundings::{faults, operator};
use crate::level::permit;
use cotama_core::system;

system! {
    /// The supervisors with what observes the robot for them, and what connects them; faults, the
    /// operator and the robot come with [`delivery`].
    #[macro_export]
    pub mod supervision {
        nets {
            gs: global,
            ls: local,
            pf: path_following,
            to: teleoperation,
            gom: observation,
            cs: contextual,
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
            cs.adapt_smz => pf.adapt_smz mail 1;
            cs.adapt_avoidance => pf.adapt_avoidance mail 1;
            cs.adapt_minor => pf.adapt_minor mail 1;
            cs.adapt_sonar_teleoperation => to.adapt_sonar mail 1;
            cs.adapt_minor_teleoperation => to.adapt_minor mail 1;
            gom.slow => cs.slow mail 1;
            gom.ambiguous => cs.ambiguous mail 1;
            gom.collision => cs.collision mail 1;
            gom.planner => cs.planner mail 1;
            gom.hard => cs.hard mail 1;
            gom.minor => cs.minor mail 1;
            gom.mcl_lost => cs.mcl_lost mail 1;
            gom.sonar_lost => cs.sonar mail 1;
            gom.avoidance_lost => cs.avoidance mail 1;
            gom.smz_lost => cs.smz mail 1;
            gom.camera => cs.camera mail 1;
            gom.wifi_lost => cs.wifi_lost mail 1;
            gom.vital => cs.vital mail 1;
        }
        shared {
            ls.camera = gom.camera;
            ls.wifi & cs.wifi = gom.wifi;
            pf.sonar = gom.sonar;
            to.sonar & pf.avoidance = gom.avoidance;
            pf.smz = gom.smz;
            pf.mcl & cs.mcl = gom.mcl;
            cs.planning = ls.Planning;
            cs.following = ls.Following;
            cs.hand_over = ls.HandOver;
            cs.teleprogrammed = ls.Teleprogrammed;
            cs.teleoperated = ls.Teleoperated;
            cs.optimal = pf.Optimal;
            cs.reduced = pf.Reduced;
            cs.odometric = pf.Odometric;
            cs.reactive = pf.Reactive;
            cs.degraded = pf.Degraded;
            cs.avoiding = to.Full;
            cs.level = pf.level;
        }
        pending {
            ls.local_pending = ls.local_event;
            ls.global_pending = gs.global_event;
        }
        clears {
            ls.gs_abort empties ls.local_event & ls.start_drive;
        }
        laws { left_to_checker; }
    }
}

system! {
    /// COTAMA's decisional level as it drives the robot, with everything that may fail and the
    /// operator. Events that no net here causes come from the robot and from whoever gives missions
    /// and objects.
    pub mod delivery extends supervision {
        nets before gom { permit: permit }
        nets {
            faults: faults,
            operator: operator,
        }
        links {
            gs.halt => permit.halt now;
            ls.run_pp => gom.settle now;
            ls.pf_start => permit.grant & gom.settle now;
            ls.pf_stop => permit.revoke now;
            ls.to_start => permit.grant now;
            ls.to_stop => permit.revoke now;
            faults.vital_flag => gom.vital_flag mail 1;
            faults.wifi_flag => gom.wifi_flag mail 1;
            faults.camera_flag => gom.camera_flag mail 1;
            faults.sonar_flag => gom.sonar_flag mail 1;
            faults.avoidance_flag => gom.avoidance_flag mail 1;
            faults.smz_flag => gom.smz_flag mail 1;
            faults.mcl_flag => gom.mcl_flag mail 1;
            faults.drift_flag => gom.drift_flag mail 1;
            faults.bumper_flag => gom.bumper_flag mail 1;
            faults.planner_flag => gom.planner_flag mail 1;
            faults.hard_flag => gom.hard_flag mail 1;
            faults.minor_flag => gom.minor_flag mail 1;
            faults.deadline_flag => gom.deadline_flag mail 1;
            operator.op_teleprogram => ls.op_teleprogram now;
            operator.op_teleoperate => ls.op_teleoperate now;
            operator.op_waypoints => ls.op_waypoints now;
            operator.op_path => ls.op_path now;
            operator.op_goal_reached => ls.op_goal_reached now;
            operator.refusal => cs.refusal mail 1;
        }
        shared {
            operator.camera = faults.camera;
            operator.wifi = faults.wifi;
            operator.hand_over = ls.HandOver;
            operator.teleprogrammed = ls.Teleprogrammed;
            operator.teleoperated = ls.Teleoperated;
        }
    }
}
