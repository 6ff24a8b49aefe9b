//! The supervisors of one mission of two drives: global, local, and the two adapters.

use cotama_core::net;

net! {
    /// Global supervisor of the delivery mission (Durand et al., TAROS 2010, Section V.C.1): which
    /// objective, or security.
    pub mod global {
        places {
            /// No mission yet.
            Wait: 1,
            /// Driving to office A.
            DriveA,
            /// Waiting for the object.
            Receive,
            /// Driving to office B.
            DriveB,
            /// Handing the object over.
            Deliver,
            /// The mission is accomplished.
            Done,
            /// Stopping for good.
            Security,
            /// Stopped for good, alarm given.
            Safe,
        }
        events {
            /// The objective cannot be managed, or goes on without a vital part.
            global_event,
            /// The drive has reached its goal.
            drive_done,
            /// The operator gives a mission.
            mission_received,
            /// The object is on board.
            object_received,
            /// The object has been handed over.
            object_delivered,
            /// The robot stands.
            stopped,
        }
        outputs { start_drive, gs_abort, halt, alarm, wifi_warning }
        groups { Mission: Wait & DriveA & Receive & DriveB & Deliver & Done; }
        transitions {
            g1 on mission_received: Wait => DriveA emit start_drive;
            g2 on drive_done: DriveA => Receive;
            g3 on object_received: Receive => DriveB emit start_drive;
            g4 on drive_done: DriveB => Deliver;
            g5 on object_delivered: Deliver => Done;
            /// From wherever the mission is.
            abort on global_event: Mission => Security emit gs_abort & halt;
            secured on stopped: Security => Safe emit alarm & wifi_warning;
        }
        ignore { global_event in Security & Safe; }
        laws {
            invariant(Wait & DriveA & Receive & DriveB & Deliver & Done & Security & Safe = 1);
            always_can(Safe);
            reachable(Done);
            deadlock_free_except(Safe);
            deterministic;
        }
    }
}

net! {
    /// Local supervisor of the Drive objective (Durand et al., TAROS 2010, Fig. 3): planning,
    /// following, and the operator when the robot needs help.
    pub mod local {
        places {
            /// No drive.
            Idle: 1,
            /// A path is planned.
            Planning,
            /// The path is followed, autonomously.
            Following,
            /// The robot stands and asks the operator.
            HandOver,
            /// The robot stands; the operator edits way-points or a path.
            Teleprogrammed,
            /// The operator drives.
            Teleoperated,
            /// The goal is reached.
            End,
        }
        shared {
            /// The camera is there.
            camera: true,
            /// The operator can be reached.
            wifi: true,
            /// Something that may take the goal back waits: a local event,
            local_pending,
            /// a global event,
            global_pending,
        }
        events {
            local_event,
            start_drive,
            /// The next round.
            tick,
            path_ready,
            goal_reached,
            op_teleprogram,
            op_teleoperate,
            op_waypoints,
            op_path,
            op_goal_reached,
            gs_abort,
        }
        outputs {
            run_pp, stop_pp, pf_start, pf_stop, to_start, to_stop,
            stop_robot, op_request, drive_done,
            /// The goal is reached: the drive is done with the next round.
            ended,
        }
        groups { Driving: Planning & Following & HandOver & Teleprogrammed & Teleoperated & End; }
        transitions {
            l1 on start_drive: Idle => Planning emit run_pp;
            l2 on path_ready: Planning => Following emit stop_pp & pf_start;
            l3 on goal_reached [!local_pending & !global_pending]:
                Following => End emit pf_stop & ended;
            l4 on local_event: Planning => HandOver emit stop_pp & stop_robot & op_request;
            l5 on local_event: Following => HandOver emit pf_stop & stop_robot & op_request;
            l6 on op_teleprogram: HandOver => Teleprogrammed;
            l7 on op_teleoperate [camera & wifi]: HandOver => Teleoperated emit to_start;
            l8 on op_waypoints: Teleprogrammed => Planning emit run_pp;
            l9 on op_path: Teleprogrammed => Following emit pf_start;
            l10 on op_teleprogram: Teleoperated => Teleprogrammed emit to_stop & stop_robot;
            l11 on op_goal_reached [!local_pending & !global_pending]:
                Teleoperated => End emit to_stop & ended;
            l12 on local_event: Teleoperated => HandOver emit to_stop & stop_robot & op_request;
            l13 on local_event: Teleprogrammed => HandOver emit op_request;
            l14 on tick: End => Idle emit drive_done;
            /// What runs is stopped; only where it runs does it hear of it.
            abort on gs_abort: Driving => Idle emit stop_pp & pf_stop & to_stop;
        }
        laws {
            invariant(
                Idle & Planning & Following & HandOver & Teleprogrammed & Teleoperated & End = 1
            );
            always_can(Idle);
            reachable(End);
            deadlock_free;
            deterministic;
        }
    }
}

net! {
    /// Adapter supervisor of autonomous path following (Durand et al., TAROS 2010, Fig. 4): which
    /// modules, and how many particles.
    pub mod path_following {
        places {
            /// Not running.
            Off: 1,
            /// All modules, all particles.
            Optimal,
            /// All modules, fewer particles.
            Reduced,
            /// Odometry in place of Monte Carlo localisation.
            Odometric,
            /// The other avoidance, with guidance apart: DVZ in place of SMZ.
            Reactive,
            /// No avoidance, no localisation, lower speed.
            Degraded,
        }
        counters {
            /// Particles: full, fewer, floor.
            level: 2 of 2,
        }
        shared { sonar: true, mcl: true, smz: true, avoidance: true }
        events {
            adapt_rt, adapt_mcl, adapt_sonar, adapt_bump,
            /// Path following has lost its avoidance, and the sonars are there.
            adapt_smz,
            /// The other avoidance is.
            adapt_avoidance,
            /// A setting of a module is to change.
            adapt_minor,
            pf_start, pf_stop,
        }
        outputs {
            limit_speed, reduce_particles,
            /// A setting of a module changes, as long as its cause lasts.
            adjust,
        }
        transitions {
            a1 on pf_start [sonar & mcl & smz]: Off => Optimal;
            a2 on pf_start [sonar & !mcl & smz]: Off => Odometric;
            a3 on pf_start [!sonar]: Off => Degraded emit limit_speed;
            a4 on adapt_rt: Optimal => Reduced do level -= 1 emit reduce_particles;
            a5 on adapt_rt: Reduced => Reduced do level -= 1 emit reduce_particles;
            a6 on adapt_mcl: Optimal => Odometric do level = 2;
            a7 on adapt_mcl: Reduced => Odometric do level = 2;
            a8 on adapt_sonar: Optimal => Degraded do level = 2 emit limit_speed;
            a9 on adapt_sonar: Reduced => Degraded do level = 2 emit limit_speed;
            a10 on adapt_sonar: Odometric => Degraded emit limit_speed;
            a11 on adapt_bump: Optimal => Optimal emit limit_speed;
            a12 on adapt_bump: Reduced => Reduced emit limit_speed;
            a13 on adapt_bump: Odometric => Odometric emit limit_speed;
            a14 on pf_start [sonar & mcl & !smz & avoidance]: Off => Reactive;
            a15 on pf_start [sonar & mcl & !smz & !avoidance]: Off => Degraded emit limit_speed;
            a16 on pf_start [sonar & !mcl & !smz]: Off => Degraded emit limit_speed;
            a17 on adapt_smz [avoidance]: Optimal => Reactive;
            /// With so many particles as there are.
            a18 on adapt_smz [avoidance]: Reduced => Reactive;
            a19 on adapt_smz [!avoidance]: Optimal => Degraded do level = 2 emit limit_speed;
            a20 on adapt_smz [!avoidance]: Reduced => Degraded do level = 2 emit limit_speed;
            a21 on adapt_smz: Odometric => Degraded emit limit_speed;
            a22 on adapt_rt: Reactive => Reactive do level -= 1 emit reduce_particles;
            a23 on adapt_mcl: Reactive => Degraded do level = 2 emit limit_speed;
            a24 on adapt_sonar: Reactive => Degraded do level = 2 emit limit_speed;
            a25 on adapt_avoidance: Reactive => Degraded do level = 2 emit limit_speed;
            a26 on adapt_bump: Reactive => Reactive emit limit_speed;
            m1 on adapt_minor: Optimal => Optimal emit adjust;
            m2 on adapt_minor: Reduced => Reduced emit adjust;
            m3 on adapt_minor: Odometric => Odometric emit adjust;
            m4 on adapt_minor: Degraded => Degraded emit adjust;
            m5 on adapt_minor: Reactive => Reactive emit adjust;
            as1 on pf_stop: Optimal => Off do level = 2;
            as2 on pf_stop: Reduced => Off do level = 2;
            as3 on pf_stop: Odometric => Off;
            as4 on pf_stop: Degraded => Off;
            as5 on pf_stop: Reactive => Off do level = 2;
        }
        ignore {
            adapt_rt in Off;
            adapt_mcl in Off;
            adapt_sonar in Off;
            adapt_bump in Off;
            adapt_minor in Off;
            adapt_smz in Off;
            adapt_avoidance in Off;
            pf_stop in Off;
        }
        laws {
            invariant(Off & Optimal & Reduced & Odometric & Reactive & Degraded = 1);
            always_can(Off);
            deadlock_free;
            deterministic;
        }
    }
}

net! {
    /// Adapter supervisor of teleoperation: with avoidance, or without.
    pub mod teleoperation {
        places {
            /// Not running.
            Off: 1,
            /// With obstacle avoidance.
            Full,
            /// Without, at lower speed.
            Degraded,
        }
        shared { sonar: true }
        events {
            adapt_sonar,
            /// A setting of a module is to change.
            adapt_minor,
            to_start, to_stop,
        }
        outputs {
            limit_speed,
            /// A setting of a module changes, as long as its cause lasts.
            adjust,
        }
        transitions {
            b1 on to_start [sonar]: Off => Full;
            b2 on to_start [!sonar]: Off => Degraded emit limit_speed;
            b3 on adapt_sonar: Full => Degraded emit limit_speed;
            m1 on adapt_minor: Full => Full emit adjust;
            m2 on adapt_minor: Degraded => Degraded emit adjust;
            bs1 on to_stop: Full => Off;
            bs2 on to_stop: Degraded => Off;
        }
        ignore { adapt_sonar in Off; adapt_minor in Off; to_stop in Off; }
        laws {
            invariant(Off & Full & Degraded = 1);
            always_can(Off);
            deadlock_free;
            deterministic;
        }
    }
}
