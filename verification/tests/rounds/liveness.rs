//! LS6 as liveness: nobody is left in the middle of a drive once failures have come to an end and
//! everybody goes on.

use crate::delivery::explored;
use cotama_models::nets::by_hand::delivery;
use cotama_verification::explicit::{Goal, Graph};
use cotama_verification::flat::rounds;
use cotama_verification::property::{Ctl, Formula, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};

/// The places in which a drive waits for a path, for the goal, or for the operator. What it waits
/// for comes: it does not stay there for ever.
const WAITS: [&str; 5] =
    ["!ls.Planning", "!ls.Following", "!ls.HandOver", "!ls.Teleprogrammed", "!ls.Teleoperated"];

/// No run goes on for ever in which, from some time on, no failure comes and the drive does not
/// end: wherever neither has happened yet, one of them will.
const ENDS: &str = "AG AF (ls.Idle | gom.vital_flag.waiting | gom.wifi_flag.waiting | \
    gom.camera_flag.waiting | gom.sonar_flag.waiting | gom.avoidance_flag.waiting | \
    gom.mcl_flag.waiting | gom.drift_flag.waiting | gom.bumper_flag.waiting | \
    gom.planner_flag.waiting | gom.hard_flag.waiting | gom.deadline_flag.waiting)";

fn formula(text: &str, pt: &Pt) -> Formula {
    let Question::Formula(formula) = parse(text, pt).unwrap().question else { panic!("{text}") };
    formula.simplified()
}

fn holds(text: &str, pt: &Pt, graph: &Graph, waits: &[&str]) -> bool {
    let waits: Vec<_> = waits.iter().map(|it| formula(it, pt)).collect();
    let recurring = waits.iter().map(|it| Goal::new(it).unwrap()).collect();
    ctl(
        graph,
        &Ctl::new(&formula(text, pt)).unwrap(),
        &Fairness { recurring, ..Fairness::default() },
        u64::MAX,
        2,
    )
    .unwrap()
    .verdict
}

#[test]
#[ignore = "a minute: CI runs it"]
fn every_drive_ends_when_failures_do_and_everybody_goes_on() {
    let (pt, graph) = explored(&rounds(&delivery::SYSTEM).unwrap());
    assert!(holds(ENDS, &pt, &graph, &WAITS));
    // Each of them has to go on, and failures have to end: with them the operator is asked again
    // and again.
    for left_out in WAITS {
        let others: Vec<_> = WAITS.into_iter().filter(|it| *it != left_out).collect();
        assert!(!holds(ENDS, &pt, &graph, &others), "{left_out}");
    }
    assert!(!holds("AG AF ls.Idle", &pt, &graph, &WAITS));
}
