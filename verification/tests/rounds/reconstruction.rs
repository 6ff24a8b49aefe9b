//! The decisional level as it was first reconstructed: faults and operator are one net, and reports
//! reach the contextual supervisor without diagnosis. What came of it
//! is [`delivery`](cotama_models::nets::by_hand::delivery); this one is kept for its state counts,
//! which two other programs found as well.

use cotama_core::net::EventId;
use cotama_core::player::Outcome;
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_models::nets::by_hand::{
    contextual, global, local, path_following, supervision, teleoperation,
};
use cotama_verification::flat::flat;
use std::collections::HashMap;

net! {
    /// The events that may happen next; one of these a round.
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
            /// The operator's avoidance works: as long as the sonars do.
            avoidance: true,
            /// The avoidance of path following works, always.
            smz: true,
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
            slow, ambiguous, collision, planner, refusal,
            /// Never, all of them: this environment has no failure beyond the listed ones.
            hard, minor, avoidance_lost, smz_lost,
            mcl_lost, sonar_lost, camera, wifi_lost, vital,
        }
        transitions {
            mission on mission_received [waiting]: Ready => Ready emit mission;
            path on path_ready [planning]: Ready => Ready emit path;
            goal on goal_reached [following & vital & !local_pending & !global_pending]:
                Ready => Ready emit goal;
            object on object_received [receiving]: Ready => Ready emit object;
            delivery on object_delivered [delivering]: Ready => Ready emit delivery;
            stand on stopped [securing]: Ready => Ready emit stand;
            teleprogram1 on op_teleprogram [hand_over & wifi]: Ready => Ready emit teleprogram;
            teleprogram2 on op_teleprogram [teleoperated & wifi]: Ready => Ready emit teleprogram;
            teleoperate on op_teleoperate [hand_over & wifi & camera]:
                Ready => Ready emit teleoperate;
            waypoints on op_waypoints [teleprogrammed & wifi]: Ready => Ready emit waypoints;
            new_path on op_path [teleprogrammed & wifi]: Ready => Ready emit new_path;
            operator_goal on op_goal_reached
                [teleoperated & wifi & vital & !local_pending & !global_pending]:
                Ready => Ready emit operator_goal;
            gives_up1 on op_gives_up [hand_over]: Ready => Ready emit refusal;
            gives_up2 on op_gives_up [teleprogrammed]: Ready => Ready emit refusal;
            gives_up3 on op_gives_up [teleoperated]: Ready => Ready emit refusal;
            slow1 on too_slow [optimal]: Ready => Ready emit slow;
            slow2 on too_slow [reduced]: Ready => Ready emit slow;
            ambiguous1 on ambiguous [planning]: Ready => Ready emit ambiguous;
            ambiguous2 on ambiguous [following]: Ready => Ready emit ambiguous;
            ambiguous3 on ambiguous [teleoperated]: Ready => Ready emit ambiguous;
            collision1 on collision [following]: Ready => Ready emit collision;
            collision2 on collision [teleoperated]: Ready => Ready emit collision;
            planner on planner_failed [planning]: Ready => Ready emit planner;
            mcl1 on lose_mcl [mcl & !safe]: Ready => Ready do mcl = false emit mcl_lost;
            mcl2 on lose_mcl [mcl & safe & !idle]: Ready => Ready do mcl = false emit mcl_lost;
            sonar1 on lose_sonar [sonar & !safe]:
                Ready => Ready do sonar = false & avoidance = false emit sonar_lost;
            sonar2 on lose_sonar [sonar & safe & !idle]:
                Ready => Ready do sonar = false & avoidance = false emit sonar_lost;
            camera1 on lose_camera [camera & !safe]: Ready => Ready do camera = false emit camera;
            camera2 on lose_camera [camera & safe & !idle]:
                Ready => Ready do camera = false emit camera;
            wifi1 on lose_wifi [wifi & !safe]: Ready => Ready do wifi = false emit wifi_lost;
            wifi2 on lose_wifi [wifi & safe & !idle]:
                Ready => Ready do wifi = false emit wifi_lost;
            vital1 on lose_vital [vital & !safe]: Ready => Ready do vital = false emit vital;
            vital2 on lose_vital [vital & safe & !idle]:
                Ready => Ready do vital = false emit vital;
        }
        laws { left_to_checker; }
    }
}

system! {
    /// The decisional level and its environment, for one mission of two drives. In a round the
    /// supervisors take their turns; then the environment does one thing. It stands where the
    /// shipped system has `gom`: what happens is reported without diagnosis.
    pub mod reconstruction extends supervision {
        instead { gom: environment }
        links {
            gom.mission => gs.mission_received now;
            gom.object => gs.object_received now;
            gom.delivery => gs.object_delivered now;
            gom.stand => gs.stopped now;
            gom.path => ls.path_ready now;
            gom.goal => ls.goal_reached now;
            gom.teleprogram => ls.op_teleprogram now;
            gom.teleoperate => ls.op_teleoperate now;
            gom.waypoints => ls.op_waypoints now;
            gom.new_path => ls.op_path now;
            gom.operator_goal => ls.op_goal_reached now;
            gom.refusal => cs.refusal mail 1;
        }
        shared {
            gom.planning = ls.Planning;
            gom.following = ls.Following;
            gom.hand_over = ls.HandOver;
            gom.teleprogrammed = ls.Teleprogrammed;
            gom.teleoperated = ls.Teleoperated;
            gom.optimal = pf.Optimal;
            gom.reduced = pf.Reduced;
            gom.waiting = gs.Wait;
            gom.receiving = gs.Receive;
            gom.delivering = gs.Deliver;
            gom.securing = gs.Security;
            gom.safe = gs.Safe;
            gom.idle = ls.Idle;
        }
        pending {
            gom.local_pending = ls.local_event;
            gom.global_pending = gs.global_event;
        }
    }
}

const NOW: Millis = Millis(0);
const ENVIRONMENT: u16 = 4;

/// After each round the environment does one thing, or nothing: 4,166 states and 22,810 such steps,
/// as counted by two other programs for the same model.
#[test]
fn the_rounds_reach_4166_states() {
    let first = reconstruction::Player::new();
    let mut seen = HashMap::from([(*first.marking(), 0_usize)]);
    let (mut states, mut edges) = (vec![first], 0);
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        at += 1;
        let mut after = state;
        assert_eq!(after.round(NOW).waiting, 0, "no mailbox is ever full");
        let events = (0..environment::NET.events.len()).map(|event| Some(EventId(event as u32)));
        for event in std::iter::once(None).chain(events) {
            let mut next = after;
            if let Some(id) = event {
                match next.offer_id(NOW, Of { component: ENVIRONMENT, id }, (), &mut ()) {
                    Outcome::Fired { .. } => {}
                    Outcome::Ignored { .. } => continue,
                    other @ Outcome::Refused { .. } => panic!("{other:?}"),
                }
            }
            edges += 1;
            seen.entry(*next.marking()).or_insert_with(|| {
                states.push(next);
                states.len() - 1
            });
        }
    }
    assert_eq!(
        (states.len(), edges),
        (
            cotama_golden::figure("reconstruction.states"),
            cotama_golden::figure("reconstruction.steps")
        )
    );
}

#[test]
fn the_decisional_level_is_one_net_too() {
    let net = flat(&reconstruction::SYSTEM).unwrap();
    assert_eq!(net.view().net().defect(), None);
    assert_eq!((net.places.len(), net.transitions.len()), (123, 5_431));
}
