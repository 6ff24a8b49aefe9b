//! The global observation module: from flags of observers to reports, and what is known to be
//! available.

use cotama_core::net;

net! {
    /// Global observation module (Durand et al., TAROS 2010, Section V.A): collects flags,
    /// diagnoses, keeps the module status vector, and reports what is new. A flag that tells
    /// nothing new is ignored.
    ///
    /// Inferred: the vector is closed under dependencies, so that a lost sonar takes localisation
    /// by particles and avoidance along; a diagnosis that is not unique makes its candidates
    /// suspect until the robot sets out again, and is reported once.
    pub mod observation {
        places {
            /// It diagnoses at once.
            Watching: 1,
        }
        flags {
            /// Localisation by particles is available, as far as is known.
            mcl: true,
            /// The sonars are.
            sonar: true,
            /// Avoidance for the operator is: it needs the sonars too.
            avoidance: true,
            /// The avoidance of path following is, as far as it does not need the sonars.
            smz: true,
            /// The camera is.
            camera: true,
            /// The operator can be reached.
            wifi: true,
            /// Power, micro-controller and effectors are.
            vital: true,
            /// Several faults are possible, and it is not settled which.
            suspected: false,
        }
        events {
            /// The vital parts: power, micro-controller, effectors.
            vital_flag,
            wifi_flag, camera_flag, sonar_flag, avoidance_flag, smz_flag, mcl_flag,
            /// Odometry and localisation drift apart while the robot goes backward for too
            /// long.
            drift_flag,
            bumper_flag, planner_flag,
            /// Any other failure whose severity is hard where it happens.
            hard_flag,
            /// Any other failure whose severity is weak or medium where it happens.
            minor_flag,
            /// Localisation misses its deadline persistently.
            deadline_flag,
            /// A path is planned or followed anew: what was suspected is settled, and may
            /// be suspected again.
            settle,
        }
        outputs {
            vital, wifi_lost, camera, sonar_lost, avoidance_lost, smz_lost, mcl_lost, ambiguous,
            collision, planner, hard, minor, slow,
        }
        transitions {
            vital on vital_flag [vital]: Watching => Watching do vital = false emit vital;
            wifi on wifi_flag [wifi]: Watching => Watching do wifi = false emit wifi_lost;
            camera on camera_flag [camera]: Watching => Watching do camera = false emit camera;
            sonar on sonar_flag [sonar]:
                Watching => Watching do sonar = false & mcl = false & avoidance = false
                emit sonar_lost;
            avoidance on avoidance_flag [avoidance]:
                Watching => Watching do avoidance = false emit avoidance_lost;
            smz on smz_flag [smz]: Watching => Watching do smz = false emit smz_lost;
            mcl on mcl_flag [mcl]: Watching => Watching do mcl = false emit mcl_lost;
            drift on drift_flag [!suspected]:
                Watching => Watching do suspected = true emit ambiguous;
            bumper on bumper_flag: Watching => Watching emit collision;
            planner on planner_flag: Watching => Watching emit planner;
            hard on hard_flag: Watching => Watching emit hard;
            minor on minor_flag: Watching => Watching emit minor;
            slow on deadline_flag: Watching => Watching emit slow;
            settled on settle [suspected]: Watching => Watching do suspected = false;
        }
        laws {
            invariant(Watching = 1);
            deterministic;
        }
    }
}
