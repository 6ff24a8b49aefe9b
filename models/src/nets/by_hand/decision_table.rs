//! The contextual supervisor: what a report means where the robot is.

use cotama_core::net;

net! {
    /// Contextual supervisor (Durand et al., TAROS 2010, Section V.B): from a report, by its
    /// severity where the robot is and by what is still available, to an event for the adapter, the
    /// local or the global supervisor. What is not listed is acknowledged and recorded only.
    pub mod contextual {
        places {
            /// It decides at once.
            Ready: 1,
        }
        shared {
            planning, following, hand_over, teleprogrammed, teleoperated,
            optimal, reduced, odometric, reactive, degraded, avoiding,
            level: 2 of 2,
            wifi: true, mcl: true,
        }
        events {
            ambiguous, camera, collision,
            /// Any other failure that is hard where it happens.
            hard,
            /// The operator's avoidance is lost, and the sonars are not.
            avoidance,
            /// The avoidance of path following is lost, and the sonars are not.
            smz,
            mcl_lost,
            /// Any other failure that is weak or medium where it happens.
            minor,
            planner, refusal, slow, sonar, vital, wifi_lost,
        }
        outputs {
            global_event, local_event, adapt_rt, adapt_mcl, adapt_sonar, adapt_bump,
            adapt_sonar_teleoperation,
            /// A setting of a module is to change; the cause says which.
            adapt_minor,
            adapt_minor_teleoperation,
            adapt_smz, adapt_avoidance,
        }
        transitions {
            slow1 on slow [optimal & level >= 1]: Ready => Ready emit adapt_rt;
            slow2 on slow [reduced & level >= 1]: Ready => Ready emit adapt_rt;
            /// At the floor of particles localisation counts as lost.
            slow3 on slow [reduced & level < 1]: Ready => Ready do mcl = false emit adapt_mcl;
            slow4 on slow [reactive & level >= 1]: Ready => Ready emit adapt_rt;
            slow5 on slow [reactive & level < 1]: Ready => Ready do mcl = false emit adapt_mcl;
            mcl1 on mcl_lost [optimal]: Ready => Ready emit adapt_mcl;
            mcl2 on mcl_lost [reduced]: Ready => Ready emit adapt_mcl;
            mcl3 on mcl_lost [reactive]: Ready => Ready emit adapt_mcl;
            smz1 on smz [following & !degraded]: Ready => Ready emit adapt_smz;
            sonar1 on sonar [following & !degraded]: Ready => Ready emit adapt_sonar;
            sonar2 on sonar [avoiding]: Ready => Ready emit adapt_sonar_teleoperation;
            avoidance1 on avoidance [avoiding]: Ready => Ready emit adapt_sonar_teleoperation;
            avoidance2 on avoidance [reactive]: Ready => Ready emit adapt_avoidance;
            ambiguous1 on ambiguous [planning & wifi]: Ready => Ready emit local_event;
            ambiguous2 on ambiguous [planning & !wifi]: Ready => Ready emit global_event;
            ambiguous3 on ambiguous [following & wifi]: Ready => Ready emit local_event;
            ambiguous4 on ambiguous [following & !wifi]: Ready => Ready emit global_event;
            collision1 on collision [planning & wifi]: Ready => Ready emit local_event;
            collision2 on collision [planning & !wifi]: Ready => Ready emit global_event;
            collision3 on collision [degraded & wifi]: Ready => Ready emit local_event;
            collision4 on collision [degraded & !wifi]: Ready => Ready emit global_event;
            collision5 on collision [following & !degraded]: Ready => Ready emit adapt_bump;
            hard1 on hard [planning & wifi]: Ready => Ready emit local_event;
            hard2 on hard [planning & !wifi]: Ready => Ready emit global_event;
            hard3 on hard [following & wifi]: Ready => Ready emit local_event;
            hard4 on hard [following & !wifi]: Ready => Ready emit global_event;
            hard5 on hard [teleoperated & wifi]: Ready => Ready emit local_event;
            hard6 on hard [teleoperated & !wifi]: Ready => Ready emit global_event;
            minor1 on minor [following]: Ready => Ready emit adapt_minor;
            minor2 on minor [teleoperated]: Ready => Ready emit adapt_minor_teleoperation;
            planner1 on planner [planning & wifi]: Ready => Ready emit local_event;
            planner2 on planner [planning & !wifi]: Ready => Ready emit global_event;
            camera1 on camera [teleoperated & wifi]: Ready => Ready emit local_event;
            camera2 on camera [teleoperated & !wifi]: Ready => Ready emit global_event;
            wifi1 on wifi_lost [hand_over]: Ready => Ready emit global_event;
            wifi2 on wifi_lost [teleprogrammed]: Ready => Ready emit global_event;
            wifi3 on wifi_lost [teleoperated]: Ready => Ready emit global_event;
            vital on vital: Ready => Ready emit global_event;
            refusal1 on refusal [hand_over]: Ready => Ready emit global_event;
            refusal2 on refusal [teleprogrammed]: Ready => Ready emit global_event;
            refusal3 on refusal [teleoperated]: Ready => Ready emit global_event;
        }
        laws { left_to_checker; }
    }
}
