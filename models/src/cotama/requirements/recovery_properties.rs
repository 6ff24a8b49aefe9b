//! The requirements of the decisional level where modules may return, in place of [`REPLACED`] of
//! the requirements of [`delivery`](crate::cotama::delivery).

use super::requirement::{Asked, Requirement, at_end, requirements, said};
use crate::cotama::label::Label;

/// The requirements of [`delivery`](crate::cotama::delivery) that say that nothing returns. All
/// others are those of [`recovering`](crate::cotama::recovering) as well.
pub const REPLACED: [&str; 2] = ["AS3", "GM2"];

requirements! {
    /// The requirements of [`recovering`](crate::cotama::recovering) beside those of
    /// [`delivery`](crate::cotama::delivery) but [`REPLACED`].
    RECOVERY_REQUIREMENTS;
    RC1 Assumed "An adapter goes up at most once for each return of a module, two rounds after it.",
        tested in "verification/tests/rounds/recovering.rs";
    RC2 Assumed "A return is counted once it has lasted, and so many times in a mission.",
        tested in "verification/tests/tpn/recovery.rs";
    RC3 Assumed "Until it is stopped, an adapter goes up only when it is told that more is \
                 available, and with all particles.",
        checked "AG ((pf.Degraded & !turn.pf.adapt_better -> AX (pf.Degraded | pf.Off)) & \
                 (pf.Odometric & !turn.pf.adapt_better -> AX !(pf.Optimal | pf.Reduced)) & \
                 (pf.Reactive -> AX (pf.Reactive | pf.Degraded | pf.Off)) & \
                 (pf.Reduced -> AX !pf.Optimal) & \
                 (turn.pf.adapt_better & !pf.Reduced -> AX !pf.Reduced) & \
                 (to.Degraded & !turn.to.adapt_better -> AX !to.Full))";
    RC4 Assumed "It goes up as far as what is known to be available, and no further.",
        checked "AG ((turn.pf.adapt_better & \
                 pf.Degraded -> (!(gom.sonar & gom.smz) & AX pf.Degraded) | \
                 (gom.sonar & gom.smz & gom.mcl & AX pf.Optimal) | \
                 (gom.sonar & gom.smz & !gom.mcl & AX pf.Odometric)) & \
                 (turn.pf.adapt_better & \
                 pf.Odometric -> (gom.sonar & gom.mcl & AX pf.Optimal) | \
                 (!(gom.sonar & gom.mcl) & AX pf.Odometric)) & \
                 (turn.to.adapt_better & \
                 to.Degraded -> (gom.avoidance & AX to.Full) | (!gom.avoidance & AX to.Degraded)))",
        said [
            said("pf", &["Degraded"], &["Optimal", "Odometric"], "lift_limit"),
            said("to", &["Degraded"], &["Full"], "lift_limit")
        ];
    RC5 Assumed "Who does not run does not go up: neither in the hand-over, nor in \
                 tele-programming, nor at rest.",
        checked "AG ((turn.pf.adapt_better & pf.Off -> AX pf.Off) & \
                 (turn.to.adapt_better & to.Off -> AX to.Off) & \
                 (turn.outside & pf.adapt_better.waiting -> ls.Following) & \
                 (turn.outside & to.adapt_better.waiting -> ls.Teleoperated))";
    RC6 Assumed "Going up neither grants nor withdraws the permit to move, and ends no activity.",
        checked "AG (turn.pf.adapt_better | turn.to.adapt_better -> \
                 (permit.Granted -> AX permit.Granted) & (!permit.Granted -> AX !permit.Granted) & \
                 (ls.Following -> AX ls.Following) & (ls.Teleoperated -> AX ls.Teleoperated))";
    RC7 Assumed "Only what returns is available again; localisation that was given up is not.",
        checked "AG ((!gom.mcl & !turn.gom.mcl_sound -> AX !gom.mcl) & \
                 (!gom.sonar & !turn.gom.sonar_sound -> AX !gom.sonar) & \
                 (!gom.avoidance & !turn.gom.avoidance_sound -> AX !gom.avoidance) & \
                 (!gom.smz -> AX !gom.smz) & (!gom.camera -> AX !gom.camera) & \
                 (!gom.wifi -> AX !gom.wifi) & (!gom.vital -> AX !gom.vital) & \
                 (gom.given_up -> !gom.mcl & AX gom.given_up) & \
                 (after.cs.slow & (pf.Reduced | pf.Reactive) & pf.level = 0 -> gom.given_up))";
    RC8 Assumed "A return is for the adapter that runs without the module, and else it is recorded \
                 only; it is read in the next round.",
        checked "AG ((turn.cs.sonar_back & pf.Degraded -> AX pf.adapt_better.waiting) & \
                 (turn.cs.mcl_back & pf.Odometric -> AX pf.adapt_better.waiting) & \
                 (turn.cs.avoidance_back & to.Degraded -> AX to.adapt_better.waiting) & \
                 (!pf.adapt_better.waiting & !(turn.cs.sonar_back & pf.Degraded) & \
                 !(turn.cs.mcl_back & pf.Odometric) -> AX !pf.adapt_better.waiting) & \
                 (!to.adapt_better.waiting & \
                 !(turn.cs.avoidance_back & to.Degraded) -> AX !to.adapt_better.waiting) & \
                 (turn.cs.sonar_back | turn.cs.mcl_back | turn.cs.avoidance_back -> \
                 AX (ls.local_event.waiting + gs.global_event.waiting + pf.adapt_rt.waiting + \
                 pf.adapt_mcl.waiting + pf.adapt_sonar.waiting + pf.adapt_bump.waiting + \
                 to.adapt_sonar.waiting = 0)) & \
                 (turn.outside -> !(gom.sonar_sound.waiting | gom.mcl_sound.waiting | \
                 gom.avoidance_sound.waiting | cs.sonar_back.waiting | cs.mcl_back.waiting | \
                 cs.avoidance_back.waiting) & \
                 pf.adapt_better.waiting + to.adapt_better.waiting <= 1) & \
                 (after.pf.adapt_better -> !pf.adapt_better.waiting) & \
                 (after.to.adapt_better -> !to.adapt_better.waiting))";
    RC9 Assumed "What has returned is used again after two rounds at most.",
        checked "AG (unused_sonar <= 2 & unused_mcl <= 2 & unused_avoidance <= 2)",
        watched by [
            at_end(
                "unused_sonar",
                "faults.sonar & faults.smz & pf.Degraded",
                "!faults.sonar | !faults.smz | !pf.Degraded",
                3
            ),
            at_end(
                "unused_mcl",
                "faults.sonar & faults.mcl & !gom.given_up & pf.Odometric",
                "!faults.sonar | !faults.mcl | gom.given_up | !pf.Odometric",
                3
            ),
            at_end(
                "unused_avoidance",
                "faults.sonar & faults.avoidance & to.Degraded",
                "!faults.sonar | !faults.avoidance | !to.Degraded",
                3
            )
        ];
}
