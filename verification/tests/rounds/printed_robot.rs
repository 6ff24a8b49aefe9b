cotama_core::net! {
    /// Global supervisor: one drive after another, or security.
    pub mod net_gs {
        places {
            /// No drive.
            Wait: 1,
            /// A drive is under way.
            Drive,
            /// Stopping for good.
            Security,
            /// Stopped for good, alarm given.
            Safe,
        }
        events {
            /// The objective cannot be managed, or something vital is lost.
            global_event,
            /// No configuration is left, and nobody can be asked.
            no_way,
            /// The drive has reached its goal.
            drive_done,
            /// A drive is wanted.
            drive_wanted,
            /// The robot stands.
            stopped,
        }
        outputs {
            start_drive,
            gs_abort,
            halt,
            alarm,
        }
        transitions {
            start on drive_wanted: Wait => Drive emit start_drive;
            done on drive_done: Drive => Wait;
            abort_Wait on global_event: Wait => Security emit gs_abort & halt;
            give_up_Wait on no_way: Wait => Security emit gs_abort & halt;
            abort_Drive on global_event: Drive => Security emit gs_abort & halt;
            give_up_Drive on no_way: Drive => Security emit gs_abort & halt;
            secured on stopped: Security => Safe emit alarm;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// Local supervisor: which sub-objective of a drive runs.
    pub mod net_ls {
        places {
            /// No drive.
            Idle: 1,
            /// Follow
            Follow,
            /// Manual
            Manual,
            /// The robot stands and waits for the operator, or for its end.
            Waits,
            /// The goal is reached.
            End,
        }
        shared {
            lost_lidar,
            lost_camera,
            local_pending,
            global_pending,
        }
        events {
            /// The sub-objective needs the operator.
            local_event,
            /// A drive begins.
            start_drive,
            /// The next round.
            tick,
            /// The mission ends.
            gs_abort,
            /// The sub-objective is reached.
            Follow_done,
            /// The sub-objective is reached.
            Manual_done,
            /// The operator chooses it.
            op_Manual,
        }
        outputs {
            start_Follow,
            stop_Follow,
            start_Manual,
            stop_Manual,
            op_request,
            no_way,
            ended,
            drive_done,
        }
        transitions {
            start1 on start_drive: Idle => Follow emit start_Follow;
            Follow_done on Follow_done [!local_pending & !global_pending]: Follow => End
                emit stop_Follow & ended;
            Manual_done on Manual_done [!local_pending & !global_pending]: Manual => End
                emit stop_Manual & ended;
            next on tick: End => Idle emit drive_done;
            ask_Follow on local_event: Follow => Waits emit stop_Follow & op_request;
            ask_Manual on local_event: Manual => Waits emit stop_Manual & op_request;
            Waits_to_Manual1 on op_Manual: Waits => Manual emit start_Manual;
            abort_Follow on gs_abort: Follow => Idle emit stop_Follow;
            abort_Manual on gs_abort: Manual => Idle emit stop_Manual;
            abort_Waits on gs_abort: Waits => Idle;
            abort_End on gs_abort: End => Idle;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// Adapter of Follow: which modules run.
    pub mod net_follow {
        places {
            /// Not running.
            Off: 1,
            /// Careful
            Careful,
            /// Blind
            Blind,
        }
        shared {
            lost_lidar,
            lost_camera,
        }
        events {
            /// The configuration that runs is not available any more.
            adapt,
            /// The sub-objective starts.
            start,
            /// The sub-objective ends.
            stop,
        }
        outputs {
            run_Careful,
            run_Blind,
        }
        transitions {
            start1 on start [!lost_lidar]: Off => Careful emit run_Careful;
            start2 on start [lost_lidar & !lost_camera]: Off => Careful emit run_Careful;
            start3 on start [lost_lidar & lost_camera]: Off => Blind emit run_Blind;
            Careful_adapts3 on adapt [lost_lidar & lost_camera]: Careful => Blind emit run_Blind;
            Careful_stops on stop: Careful => Off;
            Blind_stops on stop: Blind => Off;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// The permit to move: motion is a capability that a running activity holds, and that `halt`
    /// destroys for good. Ours: the papers only say that the robot stops (Durand et al., TAROS
    /// 2010, Section V.C.1).
    pub mod net_permit {
        places {
            /// No permit: the robot stands, or brakes.
            Withheld: 1,
            /// Commands of motion are obeyed.
            Granted,
            /// There will be no permit any more.
            Destroyed,
        }
        events {
            /// An activity that moves the robot starts.
            grant,
            /// The activity ends.
            revoke,
            /// The mission is given up.
            halt,
        }
        transitions {
            granted on grant: Withheld => Granted;
            revoked on revoke: Granted => Withheld;
            destroyed_Withheld on halt: Withheld => Destroyed;
            destroyed_Granted on halt: Granted => Destroyed;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// Global observation module: what is known to be lost, and what is told of it.
    pub mod net_gom {
        places {
            /// Diagnoses at once.
            Ready: 1,
        }
        flags {
            /// lidar is known to be lost.
            lost_lidar: false,
            /// camera is known to be lost.
            lost_camera: false,
        }
        counters {
            /// How often scan may still be started anew.
            restarts_LID1: 2 of 2,
        }
        events {
            /// LID1: no scan
            flag_LID1,
            /// CAM1: no image
            flag_CAM1,
            /// STK1: stuck
            flag_STK1,
        }
        outputs {
            LID1,
            restart_scan,
            CAM1,
            STK1,
        }
        transitions {
            LID1_restarts on flag_LID1 [restarts_LID1 >= 1]: Ready => Ready do restarts_LID1 -= 1
                emit restart_scan;
            LID1 on flag_LID1 [restarts_LID1 <= 0 & !lost_lidar]: Ready => Ready
                do lost_lidar = true emit LID1;
            CAM1 on flag_CAM1 [!lost_camera]: Ready => Ready do lost_camera = true emit CAM1;
            STK1 on flag_STK1: Ready => Ready emit STK1;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// Contextual supervisor: what a report means where the robot is.
    pub mod net_cs {
        places {
            /// Decides at once.
            Ready: 1,
        }
        shared {
            in_Follow,
            in_Manual,
            waits,
            runs_Careful,
            runs_Blind,
            lost_lidar,
            lost_camera,
        }
        events {
            /// LID1: no scan
            LID1,
            /// CAM1: no image
            CAM1,
            /// STK1: stuck
            STK1,
            /// The operator gives up, or does not answer in time.
            refusal,
        }
        outputs {
            global_event,
            local_event,
            adapt_Follow,
        }
        transitions {
            LID1_Careful1 on LID1 [in_Follow & runs_Careful & lost_camera]: Ready => Ready
                emit adapt_Follow;
            CAM1_Careful1 on CAM1 [in_Follow & runs_Careful & lost_lidar]: Ready => Ready
                emit adapt_Follow;
            STK1_Follow1 on STK1 [in_Follow]: Ready => Ready emit local_event;
            refusal_in_Manual on refusal [in_Manual]: Ready => Ready emit global_event;
            refusal_waits on refusal [waits]: Ready => Ready emit global_event;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// All failures and returns, at any time.
    pub mod net_faults {
        places {
            /// Anything may fail.
            Ready: 1,
        }
        events {
            /// LID1: no scan
            fail_LID1,
            /// CAM1: no image
            fail_CAM1,
            /// STK1: stuck
            fail_STK1,
        }
        outputs {
            flag_LID1,
            flag_CAM1,
            flag_STK1,
        }
        transitions {
            fail_LID1 on fail_LID1: Ready => Ready emit flag_LID1;
            fail_CAM1 on fail_CAM1: Ready => Ready emit flag_CAM1;
            fail_STK1 on fail_STK1: Ready => Ready emit flag_STK1;
        }
        laws { left_to_checker; }
    }
}

cotama_core::net! {
    /// The operator: may do anything, at any time.
    pub mod net_operator {
        places {
            /// May do anything.
            Ready: 1,
        }
        shared {
            waits,
            in_Manual,
            lost_lidar,
            lost_camera,
        }
        events {
            /// He gives up, or is silent for too long.
            gives_up,
            /// He chooses it.
            choose_Manual,
            /// He is done with it.
            finish_Manual,
        }
        outputs {
            refusal,
            op_Manual,
            Manual_done,
        }
        transitions {
            choose_Manual_waits1 on choose_Manual [waits]: Ready => Ready emit op_Manual;
            finish_Manual1 on finish_Manual [in_Manual]: Ready => Ready emit Manual_done;
            gives_up_in_Manual on gives_up [in_Manual]: Ready => Ready emit refusal;
            gives_up_waits on gives_up [waits]: Ready => Ready emit refusal;
        }
        laws { left_to_checker; }
    }
}

cotama_core::system! {
    /// The supervisors of scout, made from its file.
    pub mod net_scout {
        nets {
            gs: net_gs,
            ls: net_ls,
            follow: net_follow,
            permit: net_permit,
            gom: net_gom,
            cs: net_cs,
            faults: net_faults,
            operator: net_operator,
        }
        links {
            gs.start_drive => ls.start_drive mail 1;
            gs.gs_abort => ls.gs_abort now;
            gs.halt => permit.halt now;
            ls.ended => ls.tick mail 1;
            ls.drive_done => gs.drive_done mail 1;
            ls.no_way => gs.no_way mail 1;
            cs.global_event => gs.global_event mail 1;
            cs.local_event => ls.local_event mail 1;
            ls.start_Follow => follow.start now;
            ls.stop_Follow => follow.stop now;
            cs.adapt_Follow => follow.adapt mail 1;
            ls.start_Follow => permit.grant now;
            ls.stop_Follow => permit.revoke now;
            ls.start_Manual => permit.grant now;
            ls.stop_Manual => permit.revoke now;
            gom.LID1 => cs.LID1 mail 1;
            faults.flag_LID1 => gom.flag_LID1 mail 1;
            gom.CAM1 => cs.CAM1 mail 1;
            faults.flag_CAM1 => gom.flag_CAM1 mail 1;
            gom.STK1 => cs.STK1 mail 1;
            faults.flag_STK1 => gom.flag_STK1 mail 1;
            operator.refusal => cs.refusal mail 1;
            operator.op_Manual => ls.op_Manual now;
            operator.Manual_done => ls.Manual_done now;
        }
        shared {
            cs.waits = ls.Waits;
            operator.waits = ls.Waits;
            cs.in_Follow = ls.Follow;
            cs.in_Manual = ls.Manual;
            operator.in_Manual = ls.Manual;
            cs.runs_Careful = follow.Careful;
            cs.runs_Blind = follow.Blind;
            cs.lost_lidar = gom.lost_lidar;
            operator.lost_lidar = gom.lost_lidar;
            ls.lost_lidar = gom.lost_lidar;
            follow.lost_lidar = gom.lost_lidar;
            cs.lost_camera = gom.lost_camera;
            operator.lost_camera = gom.lost_camera;
            ls.lost_camera = gom.lost_camera;
            follow.lost_camera = gom.lost_camera;
        }
        pending {
            ls.local_pending = ls.local_event;
            ls.global_pending = gs.global_event;
        }
        clears {
            ls.gs_abort empties ls.local_event;
            ls.gs_abort empties ls.start_drive;
        }
        laws { left_to_checker; }
    }
}
