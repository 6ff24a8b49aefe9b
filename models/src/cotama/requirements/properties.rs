//! The requirements of the decisional level, and how each of them is known.
//!
//! Numbers follow the supervisors: GS global, LS local, AS adapters, CS contextual, GM observation
//! module, OB observers, WD watchdog, DP the permit to move, M the robot. Texts are in the language
//! of `cotama check`, about [`delivery`](crate::cotama::delivery) as one net that acts in rounds:
//! `round` is marked between two rounds, `turn.N.E` when the net `N` is to read the mailbox `E`,
//! `after.N.E` when it has, and `turn.outside` when every net has had its turn.
//!
//! Where the shipped system differs from the model that Durand et al. (TAROS 2010) let us
//! reconstruct (`verification/tests/rounds/reconstruction.rs`):
//! - flags of observers go through the observation module, which reads them in the round in which
//!   the contextual supervisor decides, so that no reaction is later (improved: the paper has the
//!   module, the first model left it out);
//! - the status vector is closed: who loses the sonars loses localisation by particles and
//!   avoidance (inferred);
//! - what moves the robot holds a permit, which `halt` destroys (improved);
//! - hard failures without a report of their own are reported as `hard` (inferred);
//! - faults and the operator are two nets; what is really lost is known to the first one alone
//!   (improved);
//! - a camera that nobody watches counts as lost (inferred).

use super::guarded::Guarded;
use super::requirement::{Asked, Requirement, Watch, at_end, requirements, said};
use crate::cotama::label::Label;

/// Watches a loss that is used at the ends of rounds in a row.
macro_rules! used_without {
    ($name:literal, $lost:literal, $used:literal) => {
        at_end(
            $name,
            concat!("!faults.", $lost, " & (", $used, ")"),
            concat!("faults.", $lost, " | !(", $used, ")"),
            3,
        )
    };
}

/// The places in which path following runs.
const FOLLOWING: &[&str] = &["Optimal", "Reduced", "Odometric", "Reactive", "Degraded"];

requirements! {
    /// The requirements of [`delivery`](crate::cotama::delivery).
    REQUIREMENTS;
    GS1 Stated "The mission is in exactly one place.",
        checked "AG gs.Wait + gs.DriveA + gs.Receive + gs.DriveB + gs.Deliver + gs.Done + \
                 gs.Security + gs.Safe = 1";
    GS2 Inferred "A drive is under way only while the mission drives, and then it is, but for the \
                  round of its start and of its end.",
        checked "AG (round -> (ls.Idle | gs.DriveA | gs.DriveB) & \
                 (ls.Idle & (gs.DriveA | gs.DriveB) -> ls.start_drive.waiting | \
                 gs.drive_done.waiting))";
    GS3 Stated "A global event is answered in the next round; then the robot stops for good as \
                soon as it stands, and says so.",
        checked "AG (secured <= 1 & (turn.outside & gs.Security -> fireable(gs.secured)))",
        watched by [at_end("secured", "gs.global_event.waiting", "gs.Security | gs.Safe", 2)],
        said [said("gs", &[], &["Safe"], "alarm"), said("gs", &[], &["Safe"], "wifi_warning")];
    GS4 Stated "Who was told to halt never moves again, and stays stopped.",
        checked "AG ((gs.Security | gs.Safe -> ls.Idle & permit.Destroyed) & \
                 (gs.Security -> AX (gs.Security | gs.Safe)) & (gs.Safe -> AX gs.Safe) & \
                 (round & (gs.Security | gs.Safe) -> !ls.start_drive.waiting))",
        said [said("gs", &[], &["Security"], "halt")];
    GS5 Stated "The mission is done when the object is delivered, not before it was received, and \
                that not before the first drive.",
        checked "!E[!gs.Deliver U gs.Done] & !E[!gs.DriveB U gs.Deliver] & !E[!gs.Receive U \
                 gs.DriveB] & !E[!gs.DriveA U gs.Receive]";
    GS6 Stated "From everywhere the mission can end: accomplished, or stopped for good; and it can \
                be accomplished.",
        checked "EF gs.Done & AG (!deadlock & EF ((gs.Done | gs.Safe) & ls.Idle))";
    GS7 Stated "A global event is never masked.",
        checked "AG (after.gs.global_event -> gs.Security | gs.Safe)";
    LS1 Stated "A drive is in one place, so that at most one mode is active; path following and \
                teleoperation run in theirs only.",
        checked "AG (ls.Idle + ls.Planning + ls.Following + ls.HandOver + ls.Teleprogrammed + \
                 ls.Teleoperated + ls.End = 1 & pf.Off + ls.Following = 1 & \
                 to.Off + ls.Teleoperated = 1)";
    LS2 Stated "The robot may move exactly while it follows a path or the operator drives; who \
                hands over stops it.",
        checked "AG (permit.Granted <-> ls.Following | ls.Teleoperated)",
        said [
            said(
                "ls",
                &["Planning", "Following", "Teleoperated"],
                &["HandOver", "Teleprogrammed"],
                "stop_robot"
            )
        ];
    LS3 Stated "A hard failure is answered after two rounds: the operator is asked, or the mission \
                stops.",
        checked "AG answer <= 1",
        watched by [
            at_end(
                "hard",
                "gom.drift_flag.waiting | gom.bumper_flag.waiting | gom.planner_flag.waiting | \
                 gom.camera_flag.waiting | gom.hard_flag.waiting",
                "!(gom.drift_flag.waiting | gom.bumper_flag.waiting | gom.planner_flag.waiting | \
                 gom.camera_flag.waiting | gom.hard_flag.waiting)",
                1
            ),
            Watch {
                name: "answer",
                at_end: false,
                begins: "hard & (ls.local_event.waiting | gs.global_event.waiting)",
                ends: "ls.HandOver | gs.Security | gs.Safe",
                most: 2,
            }
        ],
        said [said("ls", &[], &["HandOver"], "op_request")];
    LS4 Stated "Who waits for the operator can be told that no answer comes, and then the mission \
                stops after two rounds.",
        checked "AG (refused <= 2 & (turn.outside & ls.HandOver -> fireable(operator.gives_up1)))",
        watched by [at_end("refused", "cs.refusal.waiting", "gs.Security | gs.Safe", 3)];
    LS5 Inferred "No goal is reached while a flag, a report, a local or a global event is \
                  unanswered.",
        checked "AG (round & ls.End -> \
                 !(cs.ambiguous.waiting | cs.camera.waiting | cs.collision.waiting | \
                 cs.hard.waiting | cs.minor.waiting | cs.mcl_lost.waiting | \
                 cs.planner.waiting | cs.refusal.waiting | \
                 cs.slow.waiting | cs.sonar.waiting | cs.vital.waiting | cs.wifi_lost.waiting | \
                 cs.avoidance.waiting | cs.smz.waiting | gom.vital_flag.waiting | \
                 gom.wifi_flag.waiting | gom.camera_flag.waiting | gom.sonar_flag.waiting | \
                 gom.avoidance_flag.waiting | gom.smz_flag.waiting | gom.mcl_flag.waiting | \
                 gom.drift_flag.waiting | gom.bumper_flag.waiting | \
                 gom.planner_flag.waiting | gom.hard_flag.waiting | \
                 gom.minor_flag.waiting | gom.deadline_flag.waiting | \
                 ls.local_event.waiting | gs.global_event.waiting))";
    LS6 Stated "From everywhere a drive can end; in each of its modes it can still reach its goal, \
                unless something vital is lost; and it ends when failures do and everybody goes \
                on.",
        checked "AG ((EF ls.Idle) & (gom.vital & gom.wifi & !ls.Idle & !gs.global_event.waiting & \
                 !cs.refusal.waiting & faults.wifi & faults.vital -> EF ls.End))",
        tested in "verification/tests/rounds/liveness.rs";
    LS7 Stated "No two of planning, path following and teleoperation run together; what ends is \
                stopped.",
        checked "AG (pf.Off + to.Off >= 1 & (ls.Planning -> pf.Off & to.Off))",
        said [
            said("ls", &[], &["Planning"], "run_pp"),
            said("ls", &["Planning"], &["Following", "HandOver", "Idle"], "stop_pp"),
            said("ls", &["Following"], &["End", "HandOver", "Idle"], "pf_stop"),
            said("ls", &["Teleoperated"], &["End", "HandOver", "Idle", "Teleprogrammed"], "to_stop")
        ];
    LS8 Inferred "The operator is asked at most once for each hard report.",
        checked "AG ((!ls.HandOver & !turn.ls.local_event -> AX !ls.HandOver) & \
                 (!ls.local_event.waiting & \
                 !(turn.cs.ambiguous | turn.cs.camera | turn.cs.collision | turn.cs.hard | \
                 turn.cs.planner) -> AX !ls.local_event.waiting) & \
                 (after.ls.local_event -> !ls.local_event.waiting))";
    LS9 Inferred "The operator drives only with camera and link, as far as is known, whoever asks \
                  for it.",
        guarded [Guarded {
            net: "ls",
            from: "HandOver",
            to: "Teleoperated",
            by: &["gom.camera", "gom.wifi"],
        }];
    AS1 Stated "Path following runs one set of modules at a time, and teleoperation too.",
        checked "AG (pf.Off + pf.Optimal + pf.Reduced + pf.Odometric + pf.Reactive + \
                 pf.Degraded = 1 & \
                 to.Off + to.Full + to.Degraded = 1)";
    AS2 Stated "What is lost is used at the ends of two rounds at most.",
        checked "AG (without_mcl <= 2 & without_sonar <= 2 & without_avoidance <= 2 & \
                 without_smz <= 2 & \
                 without_camera <= 2 & without_wifi <= 2 & without_vital <= 2)",
        watched by [
            used_without!("without_mcl", "mcl", "pf.Optimal | pf.Reduced | pf.Reactive"),
            used_without!("without_sonar", "sonar", "pf.Optimal | pf.Reduced | pf.Odometric | \
                                                     pf.Reactive | to.Full"),
            used_without!("without_avoidance", "avoidance", "to.Full | pf.Reactive"),
            used_without!("without_smz", "smz", "pf.Optimal | pf.Reduced | pf.Odometric"),
            used_without!("without_camera", "camera", "to.Full | to.Degraded"),
            used_without!("without_wifi", "wifi", "to.Full | to.Degraded"),
            used_without!(
                "without_vital",
                "vital",
                "pf.Optimal | pf.Reduced | pf.Odometric | pf.Reactive | pf.Degraded | \
                 ls.Planning | to.Full | to.Degraded"
            )
        ];
    AS3 Inferred "Until it is stopped, path following only degrades, and only when an adapter \
                  event asks for it.",
        checked "AG ((pf.Reduced -> AX !pf.Optimal) & \
                 (pf.Odometric -> AX !(pf.Optimal | pf.Reduced | pf.Reactive)) & \
                 (pf.Reactive -> AX (pf.Reactive | pf.Degraded | pf.Off)) & \
                 (pf.Degraded -> AX (pf.Degraded | pf.Off)) & (to.Degraded -> AX !to.Full) & \
                 (pf.Optimal & !(turn.pf.adapt_rt | turn.pf.adapt_mcl | turn.pf.adapt_sonar | \
                 turn.pf.adapt_smz) -> AX (pf.Optimal | pf.Off)) & \
                 (pf.Reduced & !(turn.pf.adapt_mcl | turn.pf.adapt_sonar | turn.pf.adapt_smz) -> \
                 AX (pf.Reduced | pf.Off)) & \
                 (pf.Odometric & !(turn.pf.adapt_sonar | turn.pf.adapt_smz) -> \
                 AX (pf.Odometric | pf.Off)) & \
                 (pf.Reactive & !(turn.pf.adapt_mcl | turn.pf.adapt_sonar | \
                 turn.pf.adapt_avoidance) -> AX (pf.Reactive | pf.Off)) & \
                 (to.Full & !turn.to.adapt_sonar -> AX (to.Full | to.Off)))";
    AS4 Stated "Particles are reduced twice at most, each time with a request, and all are back \
                when path following ends.",
        checked "AG ((pf.Reduced -> pf.level <= 1) & (pf.Reduced | pf.Reactive | pf.level = 2) & \
                 (pf.level = 0 -> AX (pf.level = 0 | !(pf.Reduced | pf.Reactive))) & \
                 (pf.Reactive & pf.level = 1 & \
                 !turn.pf.adapt_rt -> AX (pf.level = 1 | !pf.Reactive)) & \
                 (pf.Reactive & pf.level = 2 & !turn.pf.adapt_rt -> AX pf.level = 2) & \
                 (pf.Reduced & pf.level = 1 & \
                 !turn.pf.adapt_rt -> AX (pf.level = 1 | !pf.Reduced)))",
        said [
            said("pf", &["Optimal", "Reduced"], &["Reduced"], "reduce_particles").on("adapt_rt"),
            said("pf", &["Reactive"], &["Reactive"], "reduce_particles").on("adapt_rt")
        ];
    AS5 Inferred "An adapter event is read in the next round, and answered where it is not too \
                  late.",
        checked "AG ((after.pf.adapt_rt -> !pf.adapt_rt.waiting & !pf.Optimal) & \
                 (turn.pf.adapt_rt & pf.Reduced & pf.level = 1 -> AX pf.level = 0) & \
                 (after.pf.adapt_mcl -> !pf.adapt_mcl.waiting & !pf.Optimal & !pf.Reduced & \
                 !pf.Reactive) & \
                 (turn.pf.adapt_mcl & pf.Reactive -> AX pf.Degraded) & \
                 (turn.pf.adapt_rt & pf.Reactive & pf.level = 1 -> AX pf.level = 0) & \
                 (turn.pf.adapt_rt & pf.Reactive & pf.level = 2 -> AX pf.level = 1) & \
                 (after.pf.adapt_smz -> !pf.adapt_smz.waiting & \
                 (pf.Off | pf.Reactive | pf.Degraded)) & \
                 (turn.pf.adapt_smz & gom.avoidance & (pf.Optimal | pf.Reduced) -> \
                 AX pf.Reactive) & \
                 (turn.pf.adapt_smz & pf.Reduced & pf.level = 1 & gom.avoidance -> \
                 AX pf.level = 1) & \
                 (after.pf.adapt_avoidance -> !pf.adapt_avoidance.waiting & \
                 (pf.Off | pf.Degraded)) & \
                 (turn.pf.adapt_mcl & (pf.Optimal | pf.Reduced) -> AX pf.Odometric) & \
                 (after.pf.adapt_sonar -> !pf.adapt_sonar.waiting & (pf.Off | pf.Degraded)) & \
                 (after.pf.adapt_bump -> !pf.adapt_bump.waiting) & \
                 (after.pf.adapt_minor -> !pf.adapt_minor.waiting) & \
                 (after.to.adapt_minor -> !to.adapt_minor.waiting) & \
                 (after.to.adapt_sonar -> !to.adapt_sonar.waiting & !to.Full) & \
                 (turn.pf.adapt_rt & pf.Off -> AX pf.Off))",
        said [
            said(
                "pf",
                &["Optimal", "Reduced", "Odometric", "Reactive"],
                &["Optimal", "Reduced", "Odometric", "Reactive"],
                "limit_speed"
            )
            .on("adapt_bump"),
            said("pf", FOLLOWING, FOLLOWING, "adjust").on("adapt_minor"),
            said("to", &["Full", "Degraded"], &["Full", "Degraded"], "adjust").on("adapt_minor")
        ];
    AS6 Stated "Who runs without avoidance limits the speed.",
        said [
            said("pf", &[], &["Degraded"], "limit_speed"),
            said("to", &[], &["Degraded"], "limit_speed")
        ];
    AS7 Stated "Path following starts with what is available: all modules, without localisation, \
                with the other avoidance, or without any.",
        checked "AG (turn.outside -> (pf.Off & !faults.sonar -> AX (pf.Off | pf.Degraded)) & \
                 (pf.Off & gom.sonar & !gom.mcl & gom.smz -> AX (pf.Off | pf.Odometric)) & \
                 (pf.Off & gom.sonar & gom.mcl & gom.smz -> AX (pf.Off | pf.Optimal)) & \
                 (pf.Off & gom.sonar & !gom.smz & gom.mcl & gom.avoidance -> \
                 AX (pf.Off | pf.Reactive)) & \
                 (pf.Off & !gom.smz & !(gom.mcl & gom.avoidance) -> \
                 AX (pf.Off | pf.Degraded)) & \
                 (to.Off & !faults.sonar -> AX !to.Full) & \
                 (to.Off & !faults.avoidance -> AX !to.Full) & \
                 (to.Off & gom.avoidance -> AX !to.Degraded) & \
                 (!(faults.camera & faults.wifi) -> \
                 AX (!to.Off | ls.Teleoperated | !permit.Granted | ls.Following)) & \
                 (to.Off & !(gom.camera & gom.wifi) -> AX to.Off))";
    CS1 Stated "What a report means is a function of the report, of where the robot is and of what \
                is left; where it is reached, it is this one.",
        checked DECISIONS,
        tested in "models/tests/cotama_data/decisions.rs";
    CS2 Stated "The more severe, the stronger the answer.",
        tested in "models/tests/cotama_data/decisions.rs";
    CS3 Inferred "Every flag that tells something new is reported and decided upon in the next \
                  round, once.",
        checked "AG ((turn.outside -> !(cs.ambiguous.waiting | cs.camera.waiting | \
                 cs.collision.waiting | cs.hard.waiting | cs.minor.waiting | cs.mcl_lost.waiting | \
                 cs.planner.waiting | cs.refusal.waiting | cs.slow.waiting | cs.sonar.waiting | \
                 cs.vital.waiting | cs.wifi_lost.waiting | cs.avoidance.waiting | cs.smz.waiting | \
                 gom.vital_flag.waiting | gom.wifi_flag.waiting | gom.camera_flag.waiting | \
                 gom.sonar_flag.waiting | gom.avoidance_flag.waiting | \
                 gom.smz_flag.waiting | gom.mcl_flag.waiting | \
                 gom.drift_flag.waiting | gom.bumper_flag.waiting | gom.planner_flag.waiting | \
                 gom.hard_flag.waiting | gom.minor_flag.waiting | gom.deadline_flag.waiting)) & \
                 (turn.gom.vital_flag & gom.vital -> AX cs.vital.waiting) & \
                 (turn.gom.wifi_flag & gom.wifi -> AX cs.wifi_lost.waiting) & \
                 (turn.gom.camera_flag & gom.camera -> AX cs.camera.waiting) & \
                 (turn.gom.sonar_flag & gom.sonar -> AX cs.sonar.waiting) & \
                 (turn.gom.mcl_flag & gom.mcl -> AX cs.mcl_lost.waiting) & \
                 (turn.gom.avoidance_flag & gom.avoidance -> AX cs.avoidance.waiting) & \
                 (turn.gom.smz_flag & gom.smz -> AX cs.smz.waiting) & \
                 (turn.gom.drift_flag & !gom.suspected -> AX cs.ambiguous.waiting) & \
                 (turn.gom.bumper_flag -> AX cs.collision.waiting) & \
                 (turn.gom.planner_flag -> AX cs.planner.waiting) & \
                 (turn.gom.hard_flag -> AX cs.hard.waiting) & \
                 (turn.gom.minor_flag -> AX cs.minor.waiting) & \
                 (turn.gom.deadline_flag -> AX cs.slow.waiting))";
    CS4 Inferred "The adapters are asked only for what they have the modules for.",
        checked "AG (turn.outside -> !((pf.adapt_rt.waiting | pf.adapt_mcl.waiting | \
                 pf.adapt_sonar.waiting | pf.adapt_bump.waiting | pf.adapt_minor.waiting | \
                 pf.adapt_smz.waiting | pf.adapt_avoidance.waiting) & !faults.vital) & \
                 !((to.adapt_sonar.waiting | to.adapt_minor.waiting) & \
                 !(faults.camera & faults.wifi & faults.vital)))";
    CS5 Inferred "No operator is asked who cannot be reached, and none is waited for during more \
                  than two rounds.",
        checked "AG ((turn.outside -> !(ls.local_event.waiting & !faults.wifi)) & alone <= 2)",
        watched by [at_end(
            "alone",
            "(ls.HandOver | ls.Teleprogrammed | ls.Teleoperated) & !faults.wifi",
            "!((ls.HandOver | ls.Teleprogrammed | ls.Teleoperated) & !faults.wifi)",
            3
        )];
    GM1 Inferred "The status vector is closed under dependencies: without sonars there is neither \
                  localisation by particles nor avoidance.",
        checked "AG ((gom.mcl -> gom.sonar) & (gom.avoidance -> gom.sonar) & \
                 (turn.outside -> (gom.avoidance <-> faults.sonar & faults.avoidance) & \
                 (gom.sonar <-> faults.sonar) & (gom.smz <-> faults.smz) & \
                 (gom.camera <-> faults.camera & faults.watch) & \
                 (gom.wifi <-> faults.wifi) & (gom.vital <-> faults.vital) & \
                 (gom.mcl -> faults.mcl)))",
        tested in "models/tests/cotama_data/availability.rs";
    GM2 Inferred "Nothing that is lost is available again.",
        checked "AG ((!gom.mcl -> AX !gom.mcl) & (!gom.sonar -> AX !gom.sonar) & \
                 (!gom.avoidance -> AX !gom.avoidance) & (!gom.smz -> AX !gom.smz) & \
                 (!gom.camera -> AX !gom.camera) & (!gom.wifi -> AX !gom.wifi) & \
                 (!gom.vital -> AX !gom.vital))",
        tested in "models/tests/cotama_data/availability.rs";
    GM3 Inferred "What tells nothing new is not reported: a loss that is known, and a suspicion \
                  until the robot sets out again.",
        checked "AG ((after.gom.drift_flag -> gom.suspected) & \
                 (turn.gom.mcl_flag & !gom.mcl -> AX !cs.mcl_lost.waiting) & \
                 (turn.gom.avoidance_flag & !gom.avoidance -> AX !cs.avoidance.waiting) & \
                 (turn.gom.smz_flag & !gom.smz -> AX !cs.smz.waiting) & \
                 (turn.gom.drift_flag & gom.suspected -> AX !cs.ambiguous.waiting) & \
                 cs.ambiguous.waiting + cs.camera.waiting + cs.collision.waiting + \
                 cs.hard.waiting + cs.minor.waiting + cs.mcl_lost.waiting + \
                 cs.planner.waiting + cs.refusal.waiting + \
                 cs.slow.waiting + cs.sonar.waiting + cs.vital.waiting + cs.wifi_lost.waiting + \
                 cs.avoidance.waiting + cs.smz.waiting <= 1 & \
                 (gom.suspected & turn.outside & !ls.Planning & \
                 !ls.Following -> AX (gom.suspected <-> !ls.Planning & !ls.Following)) & \
                 (gom.suspected & turn.ls.start_drive & ls.Idle -> AX !gom.suspected) & \
                 (gom.suspected & turn.outside & \
                 ls.Planning -> AX (gom.suspected <-> !ls.Following)))";
    OB1 Inferred "Nobody drives by a camera that nobody watches, but at the ends of two rounds.",
        checked "AG unwatched_camera <= 2",
        watched by [used_without!("unwatched_camera", "watch", "to.Full | to.Degraded")];
    WD1 Stated "Fewer violations in a row than the limit raise no real-time fault.",
        tested in "verification/tests/tpn/watchdog.rs";
    WD2 Stated "As many violations in a row as the limit raise one before the next release.",
        tested in "verification/tests/tpn/watchdog.rs";
    WD3 Inferred "The violations counted are at most the limit.",
        tested in "verification/tests/tpn/watchdog.rs";
    WD4 Inferred "In a loop of one period, a module that overruns delays the others by its extra \
                  time at most.",
        tested in "core/executive/src/tests/watchdogs.rs";
    WD5 Inferred "A job that was skipped publishes nothing.",
        tested in "core/executive/src/tests/watchdogs.rs";
    WD6 Inferred "A job in time ends the count.",
        tested in "verification/tests/tpn/watchdog.rs";
    DP1 Assumed "Between two rounds the robot may move only in path following and teleoperation.",
        checked "AG (round & permit.Granted -> ls.Following | ls.Teleoperated)";
    DP2 Assumed "There is no permit any more once it was destroyed.",
        checked "AG (permit.Destroyed -> AX permit.Destroyed)";
    DP3 Assumed "Who stops for good has no permit.",
        checked "AG (gs.Security | gs.Safe <-> permit.Destroyed)";
    M1 Stated "Whatever fails, in whatever order: stopped for good, the robot never moves again.",
        checked "AG (gs.Safe -> AG !permit.Granted)";
    M2 Inferred "The permit is withdrawn in the very turn in which a local or a global event is \
                 read.",
        checked "AG ((after.ls.local_event -> !permit.Granted) & \
                 (after.gs.global_event -> permit.Destroyed))";
}

/// The cells of the table of decisions: what waits when the contextual supervisor has read a
/// report.
const DECISIONS: &str = "AG (\
    (after.cs.slow -> (pf.adapt_rt.waiting <-> \
        pf.Optimal | ((pf.Reduced | pf.Reactive) & pf.level >= 1)) & \
        (pf.adapt_mcl.waiting <-> (pf.Reduced | pf.Reactive) & pf.level = 0) & \
        ((pf.Reduced | pf.Reactive) & pf.level = 0 -> !gom.mcl) & \
        ls.local_event.waiting + gs.global_event.waiting + pf.adapt_sonar.waiting + \
        pf.adapt_bump.waiting + to.adapt_sonar.waiting = 0) & \
    (after.cs.mcl_lost -> (pf.adapt_mcl.waiting <-> pf.Optimal | pf.Reduced | pf.Reactive) & \
        ls.local_event.waiting + gs.global_event.waiting + pf.adapt_rt.waiting + \
        pf.adapt_sonar.waiting + pf.adapt_bump.waiting + to.adapt_sonar.waiting = 0) & \
    (after.cs.sonar -> (pf.adapt_sonar.waiting <-> ls.Following & !pf.Degraded) & \
        (to.adapt_sonar.waiting <-> to.Full) & \
        ls.local_event.waiting + gs.global_event.waiting + pf.adapt_rt.waiting + \
        pf.adapt_mcl.waiting + pf.adapt_bump.waiting = 0) & \
    (after.cs.smz -> (pf.adapt_smz.waiting <-> ls.Following & !pf.Degraded)) & \
    (after.cs.avoidance -> (to.adapt_sonar.waiting <-> to.Full) & \
        (pf.adapt_avoidance.waiting <-> pf.Reactive) & \
        ls.local_event.waiting + gs.global_event.waiting + \
        pf.adapt_rt.waiting + pf.adapt_mcl.waiting + pf.adapt_sonar.waiting + \
        pf.adapt_bump.waiting = 0) & \
    (after.cs.ambiguous -> (ls.local_event.waiting <-> gom.wifi & (ls.Planning | ls.Following)) & \
        (gs.global_event.waiting <-> !gom.wifi & (ls.Planning | ls.Following))) & \
    (after.cs.collision -> (ls.local_event.waiting <-> gom.wifi & (ls.Planning | pf.Degraded)) & \
        (gs.global_event.waiting <-> !gom.wifi & (ls.Planning | pf.Degraded)) & \
        (pf.adapt_bump.waiting <-> ls.Following & !pf.Degraded)) & \
    (after.cs.minor -> (pf.adapt_minor.waiting <-> ls.Following) & \
        (to.adapt_minor.waiting <-> ls.Teleoperated) & \
        ls.local_event.waiting + gs.global_event.waiting + pf.adapt_rt.waiting + \
        pf.adapt_mcl.waiting + pf.adapt_sonar.waiting + pf.adapt_bump.waiting + \
        to.adapt_sonar.waiting = 0) & \
    (after.cs.hard -> (ls.local_event.waiting <-> gom.wifi & \
        (ls.Planning | ls.Following | ls.Teleoperated)) & \
        (gs.global_event.waiting <-> !gom.wifi & \
        (ls.Planning | ls.Following | ls.Teleoperated))) & \
    (after.cs.planner -> (ls.local_event.waiting <-> gom.wifi & ls.Planning) & \
        (gs.global_event.waiting <-> !gom.wifi & ls.Planning)) & \
    (after.cs.camera -> (ls.local_event.waiting <-> gom.wifi & ls.Teleoperated) & \
        (gs.global_event.waiting <-> !gom.wifi & ls.Teleoperated)) & \
    (turn.cs.wifi_lost & (ls.HandOver | ls.Teleprogrammed | ls.Teleoperated) -> \
        AX gs.global_event.waiting) & \
    (turn.cs.wifi_lost & !(ls.HandOver | ls.Teleprogrammed | ls.Teleoperated) -> \
        AX !gs.global_event.waiting) & \
    (after.cs.vital -> gs.global_event.waiting) & \
    (after.cs.refusal -> (gs.global_event.waiting <-> ls.HandOver | ls.Teleprogrammed | \
        ls.Teleoperated)) & \
    (after.cs.ambiguous | after.cs.collision | after.cs.hard | after.cs.planner | \
        after.cs.camera | after.cs.vital | after.cs.refusal -> \
        pf.adapt_rt.waiting + pf.adapt_mcl.waiting + pf.adapt_sonar.waiting + \
        pf.adapt_minor.waiting + to.adapt_sonar.waiting + to.adapt_minor.waiting = 0) & \
    (turn.outside -> gs.global_event.waiting + ls.local_event.waiting + pf.adapt_rt.waiting + \
        pf.adapt_mcl.waiting + pf.adapt_sonar.waiting + pf.adapt_bump.waiting + \
        pf.adapt_smz.waiting + pf.adapt_avoidance.waiting + pf.adapt_minor.waiting + \
        to.adapt_sonar.waiting + to.adapt_minor.waiting <= 1))";
