//! The seven points of the published run (Durand et al., TAROS 2010, Section VI), on the drive from
//! office A to office B.

use super::delivery;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::Configuration::{
    self, FollowingDegraded, FollowingOptimal, FollowingReduced, Planning, TeleoperationDegraded,
    TeleoperationFull, Teleprogramming,
};
use cotama_models::cotama::{Class, Diagnosis, FailureMode, FailureModes};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Run, Script, Supervised};

fn run() -> Run {
    let mission = delivery();
    Supervised::new(&mission).unwrap().run(&Script::from(&mission.run.faults)).unwrap()
}

/// Returns the firings in the nets of the reconstruction; numbers of variants left out.
fn sequence(run: &Run) -> Vec<&str> {
    let nets = ["gs", "ls", "pf", "to"];
    let fired = run.fired.iter().filter(|it| nets.contains(&it.net));
    fired.map(|it| it.transition.split('.').next().unwrap()).collect()
}

#[test]
fn the_supervisors_fire_as_the_reconstruction_says() {
    let first_drive = "g1 l1 l2 a1 l3 as1 l14 g2";
    let second_drive =
        "g3 l1 l2 a1 a4 l5 as2 l7 b1 l10 bs1 l9 a1 a8 l5 as4 l7 b2 l11 bs2 l14 g4 g5";
    let both: Vec<_> = first_drive.split(' ').chain(second_drive.split(' ')).collect();
    let run = run();
    assert_eq!(sequence(&run), both);
}

#[test]
fn each_point_has_its_modules() {
    let run = run();
    // The drive to office A takes the first two.
    let second_drive: Vec<_> = run.configurations.iter().filter_map(|it| it.1).skip(2).collect();
    let expected: [Configuration; 8] = [
        Planning,              // point 1
        FollowingOptimal,      // still point 1: localisation by particles
        FollowingReduced,      // point 2: fewer of them
        TeleoperationFull,     // point 4, after the hand-over of point 3
        Teleprogramming,       // point 5: the operator gives a path
        FollowingOptimal,      // and it is followed with all particles again
        FollowingDegraded,     // point 6: odometry, no avoidance, slower
        TeleoperationDegraded, // point 7
    ];
    assert_eq!(second_drive, expected);
}

#[test]
fn each_failure_is_diagnosed_and_answered_as_published() {
    let run = run();
    let conduct: Vec<_> = run
        .conduct
        .iter()
        .map(|it| {
            (it.mode, it.detected.map(|it| it.1).unwrap(), it.decided.map(|it| it.1).unwrap())
        })
        .collect();
    use FailureMode::{Bmp2, Loc1, Loc2, Loc3, Odo2, Rt1, Son1};
    let not_unique = |modes: &[FailureMode]| Diagnosis::Ambiguous(FailureModes::of(modes));
    let expected = [
        (Rt1, Diagnosis::Unique(Rt1), Class::Adapter),
        (Loc2, not_unique(&[Odo2, Loc1, Loc2]), Class::Local),
        (Son1, Diagnosis::Unique(Son1), Class::Adapter),
        (Loc3, not_unique(&[Bmp2, Loc3]), Class::Local),
    ];
    assert_eq!(conduct, expected);
    // From the flags to the decision one round, to the reaction another one.
    for it in &run.conduct {
        let (detected, decided, answered) =
            (it.detected.unwrap().0, it.decided.unwrap().0, it.answered.unwrap());
        assert_eq!((decided.0 - detected.0, answered.0 - decided.0), (100, 100), "{it:?}");
    }
}

#[test]
fn the_object_is_delivered_after_two_requests() {
    let run = run();
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 2));
    assert_eq!((run.x, run.time), (Millimetres(80_000), Millis(413_200)));
    assert!(!run.moved_when_safe);
    // Localisation goes on after it was late: its watchdog is answered.
    assert_eq!(run.oldest_pose, Millis(620));
}

#[test]
fn the_operator_is_not_asked_without_failures() {
    let mission = delivery();
    let run = Supervised::new(&mission).unwrap().run(&Script::default()).unwrap();
    assert_eq!(
        (run.outcome, run.operator_requests, run.exposed),
        (Outcome::Completed, 0, Millis(0))
    );
}
