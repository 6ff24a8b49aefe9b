//! Everything that happens to the supervisors: the robot, the operator, and faults.

use cotama_core::net;

net! {
    /// What may happen next; one of these a round.
    pub mod environment {
        places {
            /// Anything may happen.
            Ready: 1,
        }
        flags {
            /// Localisation by particles is available.
            mcl: true,
            /// The sonars work.
            sonar: true,
            /// The camera works.
            camera: true,
            /// The operator can be reached.
            wifi: true,
            /// Power, micro-controller and effectors work.
            vital: true,
        }
        shared {
            waiting: true, receiving, delivering, securing, safe,
            idle: true, planning, following, hand_over, teleprogrammed, teleoperated,
            optimal, reduced,
            local_pending, global_pending,
        }
        events {
            mission_received, path_ready, goal_reached, object_received, object_delivered, stopped,
            op_teleprogram, op_teleoperate, op_waypoints, op_path, op_goal_reached, op_gives_up,
            too_slow, ambiguous, collision, planner_failed,
            lose_mcl, lose_sonar, lose_camera, lose_wifi, lose_vital,
        }
        outputs {
            mission, path, goal, object, delivery, stand,
            teleprogram, teleoperate, waypoints, new_path, operator_goal,
            report_slow, report_ambiguous, report_collision, report_planner, report_refusal,
            /// Never, both: this environment has no failure beyond the listed ones.
            report_hard, report_avoidance,
            report_mcl, report_sonar, report_camera, report_wifi, report_vital,
        }
        transitions {
            mission on mission_received [waiting]: Ready => Ready emit mission;
            path on path_ready [planning]: Ready => Ready emit path;
            goal on goal_reached [following & vital & !local_pending & !global_pending]: Ready => Ready emit goal;
            object on object_received [receiving]: Ready => Ready emit object;
            delivery on object_delivered [delivering]: Ready => Ready emit delivery;
            stand on stopped [securing]: Ready => Ready emit stand;
            teleprogram1 on op_teleprogram [hand_over & wifi]: Ready => Ready emit teleprogram;
            teleprogram2 on op_teleprogram [teleoperated & wifi]: Ready => Ready emit teleprogram;
            teleoperate on op_teleoperate [hand_over & wifi & camera]: Ready => Ready emit teleoperate;
            waypoints on op_waypoints [teleprogrammed & wifi]: Ready => Ready emit waypoints;
            new_path on op_path [teleprogrammed & wifi]: Ready => Ready emit new_path;
            operator_goal on op_goal_reached [teleoperated & wifi & vital & !local_pending & !global_pending]:
                Ready => Ready emit operator_goal;
            gives_up1 on op_gives_up [hand_over]: Ready => Ready emit report_refusal;
            gives_up2 on op_gives_up [teleprogrammed]: Ready => Ready emit report_refusal;
            gives_up3 on op_gives_up [teleoperated]: Ready => Ready emit report_refusal;
            slow1 on too_slow [optimal]: Ready => Ready emit report_slow;
            slow2 on too_slow [reduced]: Ready => Ready emit report_slow;
            ambiguous1 on ambiguous [planning]: Ready => Ready emit report_ambiguous;
            ambiguous2 on ambiguous [following]: Ready => Ready emit report_ambiguous;
            ambiguous3 on ambiguous [teleoperated]: Ready => Ready emit report_ambiguous;
            collision1 on collision [following]: Ready => Ready emit report_collision;
            collision2 on collision [teleoperated]: Ready => Ready emit report_collision;
            planner on planner_failed [planning]: Ready => Ready emit report_planner;
            mcl1 on lose_mcl [mcl & !safe]: Ready => Ready do mcl = false emit report_mcl;
            mcl2 on lose_mcl [mcl & safe & !idle]: Ready => Ready do mcl = false emit report_mcl;
            sonar1 on lose_sonar [sonar & !safe]: Ready => Ready do sonar = false emit report_sonar;
            sonar2 on lose_sonar [sonar & safe & !idle]: Ready => Ready do sonar = false emit report_sonar;
            camera1 on lose_camera [camera & !safe]: Ready => Ready do camera = false emit report_camera;
            camera2 on lose_camera [camera & safe & !idle]: Ready => Ready do camera = false emit report_camera;
            wifi1 on lose_wifi [wifi & !safe]: Ready => Ready do wifi = false emit report_wifi;
            wifi2 on lose_wifi [wifi & safe & !idle]: Ready => Ready do wifi = false emit report_wifi;
            vital1 on lose_vital [vital & !safe]: Ready => Ready do vital = false emit report_vital;
            vital2 on lose_vital [vital & safe & !idle]: Ready => Ready do vital = false emit report_vital;
        }
        laws { left_to_checker; }
    }
}
