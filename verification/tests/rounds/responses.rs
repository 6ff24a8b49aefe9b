//! How many rounds a reaction takes at worst.

use crate::asked::{ALONE, ANSWER, LOSSES, watch, watch_loss};
use crate::reconstruction::reconstruction;
use cotama_verification::check::{Extent, Model, Options, Verdict, check};
use cotama_verification::flat::{Looks, Rounds, rounds};
use cotama_verification::property;

/// More than any of them takes.
const MANY: u32 = 6;

fn worst(rounds: &Rounds, name: &str) -> u64 {
    let net = rounds.net().unwrap();
    let model = Model::from(&net.view().net());
    let question = property::parse(&format!("bounds({name})"), model.pt()).unwrap();
    match check(&model, &question, &Options::default()).verdict {
        Verdict::Bound(Extent::Finite(most)) => most,
        other => panic!("{other:?}"),
    }
}

fn holds(text: &str) -> Verdict {
    let net = rounds(&reconstruction::SYSTEM).unwrap().net().unwrap();
    let model = Model::from(&net.view().net());
    check(&model, &property::parse(text, model.pt()).unwrap(), &Options::default()).verdict
}

fn lasting(observer: (&str, Looks, &str, &str)) -> u64 {
    let mut rounds = rounds(&reconstruction::SYSTEM).unwrap();
    if observer.0 == "answer" {
        watch(&mut rounds, crate::asked::HARD, 1);
    }
    watch(&mut rounds, observer, MANY);
    worst(&rounds, observer.0)
}

/// The round of the failure is the first one: LS3, and GS3 up to `Security`.
#[test]
fn a_hard_failure_is_answered_after_two_rounds() {
    assert_eq!(1 + lasting(ANSWER), 2);
    let secured = ("secured", Looks::AtEnd, "gs.global_event.waiting", "gs.Security | gs.Safe");
    assert_eq!(1 + lasting(secured), 2);
}

/// CS3.
#[test]
fn every_report_is_read_in_the_round_after_it() {
    assert_eq!(
        holds(
            "AG (turn.outside -> !(cs.ambiguous.waiting | cs.camera.waiting | cs.collision.waiting \
             | cs.mcl_lost.waiting | cs.planner.waiting | cs.refusal.waiting | cs.slow.waiting | \
             cs.sonar.waiting | cs.vital.waiting | cs.wifi_lost.waiting))"
        ),
        Verdict::Holds(true)
    );
}

/// AS2: at the ends of so many rounds in a row what is lost is used.
#[test]
fn a_lost_part_is_used_for_two_rounds_at_most() {
    let worst = LOSSES.map(|loss| {
        let mut rounds = rounds(&reconstruction::SYSTEM).unwrap();
        watch_loss(&mut rounds, loss, MANY);
        (loss.0, worst(&rounds, &format!("without_{}", loss.0)))
    });
    assert_eq!(worst, [("mcl", 2), ("sonar", 2), ("camera", 2), ("wifi", 2), ("vital", 2)]);
}

/// CS5.
#[test]
fn an_operator_out_of_reach_is_waited_for_at_most_two_rounds() {
    assert_eq!(lasting(ALONE), 2);
}

/// GS3: the robot may never stand, as far as its environment says; then it is never `Safe`.
#[test]
fn nothing_bounds_how_long_the_robot_takes_to_stand() {
    assert_eq!(lasting(("standing", Looks::AtEnd, "gs.Security", "gs.Safe")), u64::from(MANY));
    assert_eq!(holds("AG (gs.Security -> AF gs.Safe)"), Verdict::Holds(false));
    assert_eq!(holds("AG (gs.Security -> EF gs.Safe)"), Verdict::Holds(true));
}
