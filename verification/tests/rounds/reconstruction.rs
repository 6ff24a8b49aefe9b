//! The decisional level as it was first reconstructed: faults and operator are one net, and reports
//! reach the contextual supervisor without diagnosis. The shipped system is
//! [`delivery`](cotama_models::cotama::delivery); this one is kept for its state counts, which two
//! other programs found as well.

use cotama_core::net::EventId;
use cotama_core::player::Outcome;
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_models::cotama::{contextual, global, local, path_following, teleoperation};
use cotama_verification::flat::flat;
use std::collections::{BTreeSet, HashMap};

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

system! {
    /// The decisional level and its environment, for one mission of two drives. In a round the
    /// supervisors take their turns in this order; then the environment does one thing.
    pub mod reconstruction {
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

const NOW: Millis = Millis(0);

/// After each round the environment does one thing, or nothing: 4,166 states and 22,810 such steps,
/// as counted by two other programs for the same model.
#[test]
fn the_rounds_reach_4166_states() {
    let first = reconstruction::Player::new();
    let mut seen = HashMap::from([(*first.marking(), 0_usize)]);
    let (mut states, mut edges) = (vec![first], 0);
    let mut fired = BTreeSet::new();
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        at += 1;
        let mut after = state;
        let mut observer = |firing: &reconstruction::Firing<'_>| {
            fired.insert((firing.id.component, firing.id.id.0));
        };
        assert_eq!(after.round_with(NOW, &mut observer).waiting, 0, "no mailbox is ever full");
        let events = (0..environment::NET.events.len()).map(|event| Some(EventId(event as u32)));
        for event in std::iter::once(None).chain(events) {
            let mut next = after;
            if let Some(id) = event {
                match next.offer_id(NOW, Of { component: 5, id }, (), &mut observer) {
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
    assert_eq!((states.len(), edges), (4_166, 22_810));
    let never: Vec<_> = reconstruction::SYSTEM.components[..4]
        .iter()
        .zip(0_u16..)
        .flat_map(|(it, component)| {
            let names = it.net.transitions.iter().zip(0_u32..);
            names
                .filter(|(_, id)| !fired.contains(&(component, *id)))
                .map(|(it, _)| it.name)
                .collect::<Vec<_>>()
        })
        .collect();
    println!("{never:?}");
}

#[test]
fn the_decisional_level_is_one_net_too() {
    let net = flat(&reconstruction::SYSTEM).unwrap();
    assert_eq!(net.view().net().defect(), None);
    assert_eq!((net.places.len(), net.transitions.len()), (105, 4_077));
}
