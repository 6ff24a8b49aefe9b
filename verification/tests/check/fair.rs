//! Assumptions on runs.

use super::timed_logic::assumptions;
use crate::check::{named, replay};
use crate::properties::oracle::Space;
use crate::properties::random::{Random, branching, net as small, state};
use crate::temporal::side_by_side;
use cotama_core::net;
use cotama_core::net::TransitionId;
use cotama_verification::assert_holds;
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::property::{Assumptions, Ctl, Formula, Question};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};

net! {
    /// A lift that is called while it waits.
    mod lift {
        places {
            /// Nobody called.
            Idle: 1,
            /// Somebody waits for it.
            Called,
            /// Somebody waits, and something is in its way.
            Blocked,
            /// The lift is there.
            There
        }
        events { Call, Again, Block, Clear, Arrive, Leave }
        transitions {
            call   on Call:   Idle => Called;
            again  on Again:  Called => Called;
            block  on Block:  Called => Blocked;
            clear  on Clear:  Blocked => Called;
            arrive on Arrive: Called => There;
            leave  on Leave:  There => Idle;
        }
        laws { deadlock_free; }
    }
}

/// The text of the panic of a test.
fn said(property: &str) -> String {
    let panic = std::panic::catch_unwind(|| assert_holds!(lift::NET, property))
        .expect_err("it does not hold");
    *panic.downcast::<String>().expect("a text")
}

#[test]
fn repeated_calls_alone_are_no_reason_for_never() {
    assert!(said("AG (Called -> AF There)").contains("step 2 repeats for ever (`again`)"));
    assert_holds!(lift::NET, "AG (Called -> AF (There | Blocked)) assuming weak(arrive)");
    // Arriving is not possible all the time: what is in the way comes and goes.
    let blocked = said("AG (Called -> AF There) assuming weak(arrive)");
    assert!(blocked.contains("repeat for ever (`block` and `clear`)"), "{blocked}");
    assert_holds!(lift::NET, "AG (Called -> AF There) assuming strong(arrive)");
}

#[test]
fn formulas_about_recurrence_hold_on_fair_runs() {
    assert_holds!(
        lift::NET,
        "A (G F There | F G Blocked) assuming strong(arrive)",
        "A (G F There | F G Blocked) assuming often(There)",
        "E (G F There & F Blocked) assuming often(There)",
        "E (G F There & G F Blocked) assuming strong(arrive, clear)"
    );
}

#[test]
fn a_fair_run_that_shows_it_is_told_like_any_other() {
    let expected = "
`AG AF Idle assuming often(Called)` does not hold: on a run that goes on for ever from step 1 on
  `Idle` is never marked.
cause: step 2 repeats for ever (`again`), and `Idle` is never marked.
       `block` (on `Block`) could fire before every step of the cycle and never does: the run is
       unfair to it (left out by `assuming weak(block)`).
       `arrive` (on `Arrive`) could fire before every step of the cycle and never does: the run is
       unfair to it (left out by `assuming weak(arrive)`).
net:   lift: A lift that is called while it waits.

   step  fires  on     changes
  start                Idle
      1  call   Call   -Idle +Called
  from here on step 2 repeats for ever
      2  again  Again  no change
    end                as after step 1

where
  Idle    Nobody called.
  Called  Somebody waits for it.

";
    assert_eq!(said("AG AF Idle assuming often(Called)"), expected);
}

#[test]
fn without_a_fair_run_all_runs_do_all_things() {
    assert_holds!(
        lift::NET,
        "AF false assuming often(Idle & There)",
        "!EG true assuming often(Idle & There)"
    );
    assert_holds!(lift::NET, "EG true assuming often(Idle), weak(call, again, arrive, leave)");
}

#[test]
fn the_front_agrees_with_the_engine_on_two_thousand_nets_and_its_runs_replay() {
    let mut random = Random(61);
    let mut shown = 0;
    for _ in 0..2_000 {
        let pt = small(&mut random);
        let some = |random: &mut Random| -> Vec<_> {
            (0..pt.transitions.len() as u32)
                .map(TransitionId)
                .filter(|_| random.below(3) == 0)
                .collect()
        };
        let (weak, strong) = (some(&mut random), some(&mut random));
        let often = (0..random.below(2)).map(|_| state(&mut random, &pt, 2)).collect();
        let assumed = Assumptions { weak, strong, often };
        let formula = branching(&mut random, &pt, 3);
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        let fairness = Fairness::of(&assumed).unwrap();
        let engine = ctl(&graph, &Ctl::new(&formula).unwrap(), &fairness, 1 << 30, 1).unwrap();
        let property = named(Question::Fair(formula, assumed), &pt);
        let model = Model::from(pt);
        let answer = check(&model, &property, &Options::default());
        assert_eq!(answer.verdict, Verdict::Holds(engine.verdict), "{}", property.name);
        shown += usize::from(replay::replays(model.pt(), &property.question, &answer));
    }
    assert!(shown > 200, "{shown}");
}

/// The markings of a net, each as often as transitions lead to it; behind the places a place for
/// each transition that says that it fired last.
fn space(pt: &Pt) -> Space<'_> {
    let transitions = pt.transitions.len();
    let (mut markings, mut successors) = (Vec::new(), Vec::new());
    markings.push([&pt.initial[..], &vec![0; transitions]].concat());
    while successors.len() < markings.len() {
        let marking: Vec<u32> = markings[successors.len()].clone();
        let mut next = Vec::new();
        for fired in (0..transitions).filter(|it| pt.enabled(&marking, *it as u32)) {
            let mut after = pt.fire(&marking[..pt.places.len()], fired as u32).unwrap();
            after.extend((0..transitions).map(|it| u32::from(it == fired)));
            next.push(markings.iter().position(|it| *it == after).unwrap_or(markings.len()));
            if next.last() == Some(&markings.len()) {
                markings.push(after);
            }
        }
        successors.push(next);
    }
    Space::of(pt, markings, successors)
}

#[test]
fn formulas_of_ltl_on_fair_runs_agree_with_the_oracle() {
    let (mut random, mut compared, mut changed) = (Random(62), 0, 0);
    while compared < 60 {
        let pt = if compared % 2 == 0 { small(&mut random) } else { side_by_side(&mut random) };
        let said = state(&mut random, &pt, 1);
        let said = Formula::Globally(Formula::Finally(said.into()).into());
        let said = if random.below(2) == 0 { said } else { Formula::Not(said.into()) };
        if Space::new(&pt).markings.len() > 4 || !said.needs_run() {
            continue;
        }
        compared += 1;
        let space = space(&pt);
        let (assumed, parts) = assumptions(&mut random, &pt);
        let some = |parts: &[Formula], path: &Formula| {
            let all = parts.iter().chain([path, &Formula::TRUE]).cloned().collect();
            space.satisfying(&Formula::Exists(Formula::And(all).into()))[0]
        };
        let expected = some(&parts, &said);
        changed += usize::from(some(&[], &said) != expected);
        let question = Question::Fair(Formula::Exists(said.clone().into()), assumed);
        let property = named(question, &pt);
        let answer = check(&Model::from(pt.clone()), &property, &Options::default());
        assert_eq!(answer.verdict, Verdict::Holds(expected), "{} on {pt:?}", property.name);
    }
    assert!(changed > 0);
}
