//! An observer that stops observing is a known fact: nobody drives by a camera that nobody watches.

use super::delivery;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode, Module};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};

fn run(injections: Vec<Injection>) -> Run {
    let script = Script { injections, answers: Vec::new() };
    Supervised::new(&delivery()).unwrap().run(&script).unwrap()
}

fn at(mm: u64, mode: FailureMode) -> Injection {
    Injection::new(When::Place(Millimetres(mm)), mode)
}

/// Returns the decisions and actions on the first drive, in words of the nets; numbers of variants
/// left out.
fn acted(run: &Run) -> String {
    let end = run.fired.iter().position(|it| it.transition == "g2").unwrap();
    let acts = run.fired[..end].iter().filter(|it| ["ls", "pf", "to", "cs"].contains(&it.net));
    let name = |it: &str| it.split('.').next().unwrap().to_owned();
    acts.map(|it| name(&it.transition)).collect::<Vec<_>>().join(" ")
}

/// Returns for each failure whether it was seen, and how long the robot went on without a module
/// that it takes.
fn seen(run: &Run) -> Vec<(FailureMode, bool, u64)> {
    let of = |it: &cotama_sim::supervised::Conduct| {
        let diagnosed = it.detected.is_some_and(|it| it.1 != Diagnosis::None);
        (it.mode, diagnosed, it.exposed.0)
    };
    run.conduct.iter().map(of).collect()
}

/// The sonars are lost, the robot bumps into something, the operator drives, and the camera fails:
/// it is watched as before, so that the robot stops and asks again, and the operator gives a path.
#[test]
fn lost_sonars_do_not_hide_a_camera_that_fails() {
    let (son1, loc3, cam1) = (FailureMode::Son1, FailureMode::Loc3, FailureMode::Cam1);
    let run = run(vec![at(26_000, son1), at(34_000, loc3), at(36_000, cam1)]);
    assert_eq!(seen(&run), [(son1, true, 5_200), (loc3, true, 0), (cam1, true, 1_200)]);
    assert_eq!(
        acted(&run),
        "l1 l2 a1 sonar1 a8 collision3 l5 as4 l7 b2 camera1 l12 bs2 l6 l9 a3 l3 as4 l14"
    );
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 2));
}

/// Whoever checks sonars and camera crashes: neither is known to be sound any more. The robot asks,
/// and follows the operator's path without sonars. Then the camera fails, which nobody sees, and
/// the robot bumps into something and asks again: driving by hand is not offered, so that nobody
/// ever drives by that camera.
#[test]
fn an_unwatched_camera_is_never_used_for_driving() {
    let (sw1, cam1, loc3) = (FailureMode::Sw1, FailureMode::Cam1, FailureMode::Loc3);
    let crash = Injection { part: Module::OSen, ..at(26_000, sw1) };
    let run = run(vec![crash, at(30_000, cam1), at(34_000, loc3)]);
    assert_eq!(seen(&run), [(sw1, true, 0), (cam1, false, 0), (loc3, true, 0)]);
    assert_eq!(
        acted(&run),
        "l1 l2 a1 sonar1 a8 ambiguous3 l5 as4 l6 l9 a3 collision3 l5 as4 l6 l9 a3 l3 as4 l14"
    );
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 2));
    assert_eq!(run.exposed, Millis(0));
}

/// The array falls silent twice, and the first time ends: it is silent still, and who looks at its
/// readings sees nothing of a third failure.
#[test]
fn a_flag_goes_back_when_the_last_failure_that_holds_it_is_over() {
    let at = |m: u64| When::Place(Millimetres(m * 1_000));
    let first = Injection { until: Some(at(20)), ..Injection::new(at(5), FailureMode::Son2) };
    let last = Injection::new(at(30), FailureMode::Son3);
    let seen = |injections: Vec<Injection>| {
        let run = run(injections);
        run.conduct.last().unwrap().detected.unwrap().1
    };
    assert_eq!(seen(vec![first, last]), Diagnosis::Unique(FailureMode::Son3));
    let second = Injection::new(at(12), FailureMode::Son2);
    assert_eq!(seen(vec![first, second, last]), Diagnosis::None);
}
