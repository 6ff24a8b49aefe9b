//! Formulas of CTL.

use super::{formula, lamp, replayed};
use crate::properties::oracle::{Space, lasso};
use crate::properties::random::{Random, branching, net};
use cotama_core::net::TransitionId;
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::property::{Ctl, CtlNode, Formula};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{CtlAnswer, Fairness, Rest, Run, Verdict, answer, ctl};

fn answered(pt: &Pt, formula: &Formula) -> CtlAnswer {
    let graph = Graph::new(pt, &Limits::default(), &|_| ()).unwrap();
    ctl(&graph, &Ctl::new(formula).unwrap(), &Fairness::default(), 1 << 30, 2).unwrap()
}

#[test]
fn verdicts_are_those_of_the_oracle() {
    let (mut random, mut compared, mut hold, mut shown) = (Random(21), 0, 0, 0);
    while compared < 5_000 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let said = branching(&mut random, &pt, 3);
        if space.markings.len() > 40 || said.is_state() {
            continue;
        }
        compared += 1;
        let expected = space.satisfying(&said)[0];
        hold += u32::from(expected);
        let text = || format!("{} on {pt:?}", said.display(&pt));
        let found = answered(&pt, &said);
        assert_eq!(found.verdict, expected, "{}", text());
        if let Some(witness) = &found.witness {
            replayed(&space, &witness.run);
            shown += u32::from(witness.is_complete);
        }
        let verdict = answer(&pt, &said, &Limits::default(), &|_| ());
        let Verdict::Known { holds, run, .. } = verdict else { panic!("{verdict:?}: {}", text()) };
        assert_eq!(holds, expected, "{}", text());
        if let Some(run) = run {
            replayed(&space, &run);
        }
    }
    assert!((1_000..4_000).contains(&hold) && shown > 1_000, "{hold} {shown}");
}

#[test]
fn labels_and_ranks_are_right_in_every_marking() {
    let mut random = Random(22);
    for _ in 0..1_500 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let said = branching(&mut random, &pt, 2);
        if space.markings.len() > 30 || said.is_state() {
            continue;
        }
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        let form = Ctl::new(&said).unwrap();
        let found = ctl(&graph, &form, &Fairness::default(), 1 << 30, 1).unwrap();
        let states = 0..graph.states();
        let number = |at: usize| {
            space.markings.iter().position(|it| *it == graph.marking(at as u32)).unwrap()
        };
        let expected = space.satisfying(&said);
        if let Some(label) = &found.labels[form.root() as usize] {
            assert!(
                states.clone().all(|it| label[it] == expected[number(it)]),
                "{}",
                said.display(&pt)
            );
        }
        for (node, ranks) in form.nodes().iter().zip(&found.ranks) {
            let (CtlNode::Until(a, b), Some(ranks)) = (node, ranks) else { continue };
            let [a, b] = [a, b].map(|it| found.labels[*it as usize].as_ref().unwrap());
            for state in states.clone() {
                let next =
                    graph.successors(state as u32).iter().map(|it| ranks[*it as usize]).min();
                let expected = match next {
                    _ if b[state] => 0,
                    Some(rank) if a[state] && rank < u32::MAX => rank + 1,
                    _ => u32::MAX,
                };
                assert_eq!(ranks[state], expected, "{}", said.display(&pt));
            }
        }
    }
}

/// A complete witness is compared with what the formula says of one run.
#[test]
fn witnesses_of_one_quantifier_are_runs_as_the_formula_says() {
    let (mut random, mut compared) = (Random(23), 0);
    while compared < 3_000 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let a = crate::properties::random::state(&mut random, &pt, 1);
        let b = crate::properties::random::state(&mut random, &pt, 1);
        let path = match random.below(4) {
            0 => Formula::Finally(a.into()),
            1 => Formula::Globally(a.into()),
            _ => Formula::Until(a.into(), b.into()),
        };
        compared += 1;
        let exists = Formula::Exists(path.clone().into());
        let found = answered(&pt, &exists);
        assert_eq!(found.verdict, space.satisfying(&exists)[0]);
        if found.verdict {
            let witness = found.witness.unwrap_or_else(|| panic!("{}", exists.display(&pt)));
            assert!(witness.is_complete);
            let (run, back) = replayed(&space, &witness.run);
            assert!(lasso(&space, &run, back, &path), "{:?}: {}", witness.run, exists.display(&pt));
        }
        let all = Formula::All(path.clone().into());
        let found = answered(&pt, &all);
        assert_eq!(found.verdict, space.satisfying(&all)[0]);
        if !found.verdict {
            let witness = found.witness.unwrap_or_else(|| panic!("{}", all.display(&pt)));
            assert!(witness.is_complete);
            let (run, back) = replayed(&space, &witness.run);
            assert!(!lasso(&space, &run, back, &path), "{:?}: {}", witness.run, all.display(&pt));
        }
    }
}

#[test]
fn a_deadlock_has_no_successor_and_lasts() {
    let pt = lamp();
    for (text, expected) in [
        ("AG EX true", false),
        ("EF AX false", true),
        ("AF deadlock", false),
        ("EF EG !(on | off)", true),
        ("AG (deadlock -> AG deadlock)", true),
        ("AG (on -> EX off & EX deadlock)", true),
        ("E[off U on] & A[off U on]", true),
        ("EG EF off", true),
        ("AG AF on", false),
    ] {
        assert_eq!(answered(&pt, &formula(&pt, text)).verdict, expected, "{text}");
    }
}

#[test]
fn evidence_is_nested_as_far_as_one_run_shows_it() {
    let pt = lamp();
    let witness = |text: &str| answered(&pt, &formula(&pt, text)).witness.unwrap();
    let stem = |all: &[u32]| all.iter().map(|it| TransitionId(*it)).collect::<Vec<_>>();
    // Not AG AF on: go where it can stay dark for ever.
    let run = Run { stem: stem(&[0, 2]), rest: Rest::Stays };
    assert_eq!((witness("AG AF on").run, witness("AG AF on").is_complete), (run, true));
    let run = Run { stem: stem(&[0, 1]), rest: Rest::Any };
    assert_eq!(witness("EX (on & EX (off & EX on))").run.stem, stem(&[0, 1, 0]));
    assert_eq!(witness("EX (on & EX off)").run, run);
    // Two things that each take a run.
    assert!(!witness("EF on & EX EX off").is_complete);
    assert_eq!(answered(&pt, &formula(&pt, "AG !(on & off)")).witness, None);
}

#[test]
fn parts_that_do_not_matter_are_not_looked_at() {
    let pt = lamp();
    let said = formula(&pt, "EF on | AG AF on");
    let Formula::Or(_) = &said else { panic!("not Or") };
    let found = answered(&pt, &said);
    assert!(found.verdict && found.labels.contains(&None));
}
