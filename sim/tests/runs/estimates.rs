//! Random runs of nets, against probabilities that are worked out exactly.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

use cotama_campaign::statistics::clopper_pearson;
use cotama_core::net::TransitionId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_models::nets::families::philosophers;
use cotama_models::nets::{door, watchdog};
use cotama_property::pt::Pt;
use cotama_property::{Condition, Formula, parse};
use cotama_sim::estimate::{Asked, Draw, NotOfARun, Tally, Witness, draw, replay};
use std::collections::BTreeMap;

const RUNS: u64 = 20_000;

fn formula(text: &str, net: &Pt) -> Formula {
    parse(text, net).unwrap().question.formula().unwrap().clone()
}

fn drawn(text: &str, net: &Pt, all: Draw) -> Tally {
    let formula = formula(text, net);
    draw(net, &[Asked::new(&formula, net).unwrap()], all).unwrap().tallies[0]
}

/// The probability that a run comes to a goal within so many steps, and before something else: all
/// markings with their probabilities, step by step.
fn exactly(net: &Pt, goal: &str, before: &str, steps: u64) -> f64 {
    let [goal, before] = [goal, before].map(|it| formula(it, net));
    let goal = Condition::new(&goal, net).unwrap();
    let before = Condition::new(&before, net).unwrap();
    let (mut now, mut reached) = (BTreeMap::from([(net.initial.clone(), 1.0)]), 0.0);
    for step in 0..=steps {
        let mut next = BTreeMap::new();
        for (marking, share) in now {
            if goal.holds(marking.as_slice()) {
                reached += share;
                continue;
            }
            let all = 0..net.transitions.len() as u32;
            let enabled: Vec<_> = all.filter(|it| net.enabled(&marking, *it)).collect();
            if step < steps && before.holds(marking.as_slice()) {
                for &it in &enabled {
                    let after = net.fire(&marking, it).unwrap();
                    *next.entry(after).or_insert(0.0) += share / enabled.len() as f64;
                }
            }
        }
        now = next;
    }
    reached
}

#[test]
fn estimates_are_those_of_the_exact_distribution() {
    let philosophers = Pt::from(&philosophers(3).unwrap().view().net());
    let (door, watchdog) = (Pt::from(&door::NET), Pt::from(&watchdog::NET));
    for (net, asked, goal, before, steps) in [
        (&philosophers, "EF deadlock", "deadlock", "true", 12),
        (&philosophers, "EF eat_1", "eat_1", "true", 6),
        (&philosophers, "A (!eat_2 U eat_1)", "eat_1", "!eat_2", 9),
        (&watchdog, "AF Fault", "Fault", "true", 20),
        (&watchdog, "EF misses >= 2", "misses >= 2", "true", 9),
        (&door, "EF (Closing & obstacle)", "Closing & obstacle", "true", 7),
        (&door, "EF Open", "Open", "true", 0),
    ] {
        let truth = exactly(net, goal, before, steps);
        let all = Draw { runs: RUNS, steps, seed: 11, jobs: 2 };
        let tally = drawn(asked, net, all);
        // One in a million tables like this one would fail.
        let found = clopper_pearson(tally.holding, RUNS, 0.999_999_9);
        assert!(found.holds(truth), "{asked}: {truth} is not in {found:?}");
        // A property that always holds also holds of the other runs.
        if asked.starts_with("EF") {
            let never = drawn(&format!("AG !({goal})"), net, all);
            assert_eq!(never.holding, RUNS - tally.holding, "{asked}");
            assert_eq!(never.shortest_broken, tally.shortest_holding, "{asked}");
            assert_eq!(drawn(&format!("!AG !({goal})"), net, all), tally, "{asked}");
        }
    }
    let starved = exactly(&philosophers, "deadlock", "true", 12);
    assert!((0.3..0.7).contains(&starved), "{starved} tells nothing");
}

/// Heads wins at once; tails stays there, so that nothing is ever decided but in a deadlock.
fn coin(ends: bool) -> Pt {
    let mut net = OwnedNet::new("coin", "");
    let [start, heads, tails] =
        ["start", "heads", "tails"].map(|it| net.place(OwnedPlace::new(it, 0)).unwrap());
    net.places[start.0 as usize].initial = 1;
    for (name, side) in [("up", heads), ("down", tails)] {
        net.transition(OwnedTransition::new(name).take(start, 1).give(side, 1)).unwrap();
    }
    if !ends {
        net.transition(OwnedTransition::new("spin").take(tails, 1).give(tails, 1)).unwrap();
    }
    Pt::from(&net.view().net())
}

#[test]
fn a_deadlock_decides_questions_that_more_steps_would_not() {
    let all = Draw { runs: 1_000, steps: 5, seed: 3, jobs: 1 };
    for (asked, holds_with_heads) in [("AF heads", true), ("AG !heads", false)] {
        let [ended, spins] = [true, false].map(|ends| drawn(asked, &coin(ends), all));
        // The same runs; those that spin are not decided when their steps are used up.
        assert_eq!((ended.holding, ended.open), (spins.holding, 0), "{asked}");
        let tails = if holds_with_heads { 1_000 - ended.holding } else { ended.holding };
        assert_eq!(spins.open, tails, "{asked}");
        assert!((400..600).contains(&tails));
        let way = Witness { steps: 1, ..ended.shortest_holding.unwrap() };
        assert_eq!((ended.shortest_holding, ended.shortest_broken.unwrap().steps), (Some(way), 1));
        let by_tails =
            if holds_with_heads { spins.shortest_broken } else { spins.shortest_holding };
        assert_eq!(by_tails, None);
    }
}

#[test]
fn threads_change_nothing_and_the_shortest_run_replays() {
    let net = Pt::from(&philosophers(4).unwrap().view().net());
    let asked = ["EF deadlock", "AG !(eat_1 & eat_3)", "EF (eat_2 & eat_4)"];
    let formulas = asked.map(|it| formula(it, &net));
    let asked: Vec<_> = formulas.iter().map(|it| Asked::new(it, &net).unwrap()).collect();
    let all = |jobs| Draw { runs: 1_001, steps: 50, seed: 5, jobs };
    let found = draw(&net, &asked, all(1)).unwrap();
    assert_eq!(found.runs, 1_001);
    for jobs in [2, 3, 7, 2_000] {
        assert_eq!(draw(&net, &asked, all(jobs)).unwrap(), found, "{jobs} threads");
    }
    // Questions are judged over the same runs, so one alone is answered alike.
    let alone = draw(&net, &asked[2..], all(1)).unwrap();
    assert_eq!(alone.tallies, found.tallies[2..]);
    let way = |witness: Option<Witness>| replay(&net, 5, witness.unwrap());
    let marked = |way: &[TransitionId]| {
        way.iter().fold(net.initial.clone(), |marking, it| {
            assert!(net.enabled(&marking, it.0));
            net.fire(&marking, it.0).unwrap()
        })
    };
    let shortest = way(found.tallies[0].shortest_holding);
    assert_eq!(shortest.len(), 4); // each has taken a fork
    assert!((0..net.transitions.len() as u32).all(|it| !net.enabled(&marked(&shortest), it)));
    let both = marked(&way(found.tallies[1].shortest_broken));
    let eats = |name: &str| both[net.place(name).unwrap().0 as usize] == 1;
    assert!(eats("eat_1") && eats("eat_3"));
}

#[test]
fn a_place_that_overflows_is_an_error_and_names_the_first_run() {
    let mut net = OwnedNet::new("doubles", "");
    let tank = net.place(OwnedPlace::new("tank", 1)).unwrap();
    let gives = OwnedTransition::new("fill").read(tank, 1).give(tank, 1 << 31);
    net.transition(gives).unwrap();
    let net = Pt::from(&net.view().net());
    let formula = formula("EF deadlock", &net);
    let asked = [Asked::new(&formula, &net).unwrap()];
    let overflows = |steps| draw(&net, &asked, Draw { runs: 9, steps, seed: 0, jobs: 2 });
    assert_eq!(overflows(1).unwrap().steps, 9);
    let error = overflows(2).unwrap_err();
    assert_eq!((error.run, error.transition, error.place), (0, TransitionId(0), tank));
}

#[test]
fn questions_that_one_run_cannot_decide_are_refused() {
    let net = Pt::from(&door::NET);
    for (text, why) in [
        ("Open", NotOfARun::Start),
        ("AG (Closing -> AF<=200ms Closed)", NotOfARun::Time),
        ("AG EF Closed", NotOfARun::Nested),
        ("A (G F Closed)", NotOfARun::Nested),
        ("EF Open & EF Closed", NotOfARun::Nested),
        ("!A (Open U Closed)", NotOfARun::Nested),
        ("EX Open", NotOfARun::Nested),
    ] {
        let formula = formula(text, &net);
        assert_eq!(Asked::new(&formula, &net).unwrap_err(), why, "{text}");
    }
}
