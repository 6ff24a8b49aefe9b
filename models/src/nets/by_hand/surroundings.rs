//! The environment of the shipped supervisors for checking: every failure that may happen, and the
//! operator.

use cotama_core::net;

net! {
    /// Everything that may fail, at any time: what is lost stays lost, the rest may come again and
    /// again.
    pub mod faults {
        places {
            /// Anything may fail.
            Ready: 1,
        }
        flags {
            /// Localisation by particles works.
            mcl: true,
            /// The sonars work.
            sonar: true,
            /// The operator's avoidance works.
            avoidance: true,
            /// The avoidance of path following does.
            smz: true,
            /// The camera works.
            camera: true,
            /// The operator can be reached.
            wifi: true,
            /// Power, micro-controller and effectors work.
            vital: true,
            /// Somebody would see the camera fail.
            watch: true,
        }
        events {
            lose_vital, lose_wifi, lose_camera, lose_sonar, lose_avoidance, lose_smz, lose_mcl,
            /// Odometry and localisation drift apart; why is not known.
            drift,
            bump, no_path,
            /// Any other hard failure; also: no plan is left that keeps the limits of the
            /// mission.
            fail_hard,
            /// Any other weak or medium failure.
            fail_slightly,
            overload,
            /// The observer of the camera stops observing, which is known at once. It is told as
            /// the loss of the camera.
            lose_watch,
        }
        outputs {
            vital_flag, wifi_flag, camera_flag, sonar_flag, avoidance_flag, smz_flag, mcl_flag,
            drift_flag, bumper_flag, planner_flag, hard_flag, minor_flag, deadline_flag,
        }
        transitions {
            vital on lose_vital [vital]: Ready => Ready do vital = false emit vital_flag;
            wifi on lose_wifi [wifi]: Ready => Ready do wifi = false emit wifi_flag;
            camera on lose_camera [camera & watch]:
                Ready => Ready do camera = false emit camera_flag;
            /// The camera counts as lost from here on: whether it fails makes no difference.
            watch on lose_watch [watch & camera]:
                Ready => Ready do watch = false emit camera_flag;
            sonar on lose_sonar [sonar]: Ready => Ready do sonar = false emit sonar_flag;
            avoidance on lose_avoidance [avoidance]:
                Ready => Ready do avoidance = false emit avoidance_flag;
            smz on lose_smz [smz]: Ready => Ready do smz = false emit smz_flag;
            mcl on lose_mcl [mcl]: Ready => Ready do mcl = false emit mcl_flag;
            drift on drift: Ready => Ready emit drift_flag;
            bump on bump: Ready => Ready emit bumper_flag;
            no_path on no_path: Ready => Ready emit planner_flag;
            hard on fail_hard: Ready => Ready emit hard_flag;
            minor on fail_slightly: Ready => Ready emit minor_flag;
            slow on overload: Ready => Ready emit deadline_flag;
        }
        laws { left_to_checker; }
    }
}

net! {
    /// The operator: answers as long as the link works; gives up, or is silent for too long, at any
    /// time.
    pub mod operator {
        places {
            /// Whatever he does.
            Ready: 1,
        }
        shared { hand_over, teleprogrammed, teleoperated, camera: true, wifi: true }
        events { teleprogram, teleoperate, waypoints, new_path, arrived, gives_up }
        outputs { op_teleprogram, op_teleoperate, op_waypoints, op_path, op_goal_reached, refusal }
        transitions {
            teleprogram1 on teleprogram [hand_over & wifi]: Ready => Ready emit op_teleprogram;
            teleprogram2 on teleprogram [teleoperated & wifi]: Ready => Ready emit op_teleprogram;
            teleoperate on teleoperate [hand_over & wifi & camera]:
                Ready => Ready emit op_teleoperate;
            waypoints on waypoints [teleprogrammed & wifi]: Ready => Ready emit op_waypoints;
            new_path on new_path [teleprogrammed & wifi]: Ready => Ready emit op_path;
            arrived on arrived [teleoperated & wifi]: Ready => Ready emit op_goal_reached;
            gives_up1 on gives_up [hand_over]: Ready => Ready emit refusal;
            gives_up2 on gives_up [teleprogrammed]: Ready => Ready emit refusal;
            gives_up3 on gives_up [teleoperated]: Ready => Ready emit refusal;
        }
        laws { left_to_checker; }
    }
}
