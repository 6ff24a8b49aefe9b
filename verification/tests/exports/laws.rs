//! Properties of JANI models, evaluated by the words of the format alone, beside the laws of nets.

use crate::exports::nets;
use crate::exports::properties::{fire, is_enabled, list};
use crate::exports::random::net;
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId};
use cotama_verification::formats::jani;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::HashMap;

/// All markings of a net and which lead to which; the first is that of the start.
struct Space {
    markings: Vec<Vec<i64>>,
    next: Vec<Vec<usize>>,
}

impl Space {
    /// Returns the space of a net that has at most so many markings.
    fn of(net: &OwnedNet, most: usize) -> Option<Self> {
        let view = net.view();
        let net = view.net();
        let start: Vec<i64> = net.places.iter().map(|it| i64::from(it.initial)).collect();
        let mut known = HashMap::from([(start.clone(), 0)]);
        let (mut markings, mut next) = (vec![start], Vec::new());
        while next.len() < markings.len() {
            let from = markings[next.len()].clone();
            let mut to = Vec::new();
            for at in (0..net.transitions.len()).filter(|&it| is_enabled(&net, &from, it)) {
                let mut after = from.clone();
                fire(&net, &mut after, at);
                to.push(*known.entry(after.clone()).or_insert_with(|| {
                    markings.push(after);
                    markings.len() - 1
                }));
            }
            next.push(to);
            if markings.len() > most {
                return None;
            }
        }
        Some(Self { markings, next })
    }

    /// Returns for each marking whether one that holds can follow it, or is it.
    fn can(&self, holds: &[bool]) -> Vec<bool> {
        let mut can = holds.to_vec();
        loop {
            let more: Vec<_> = (0..can.len())
                .filter(|&at| !can[at] && self.next[at].iter().any(|&it| can[it]))
                .collect();
            if more.is_empty() {
                return can;
            }
            more.into_iter().for_each(|at| can[at] = true);
        }
    }

    /// Whether a law holds; none for those about events.
    fn law(&self, law: &OwnedLaw) -> Option<bool> {
        let tokens = |it: PlaceId, at: usize| self.markings[at][it.0 as usize];
        let all = || 0..self.markings.len();
        Some(match law {
            OwnedLaw::Invariant { sum, equals } => all().all(|at| {
                let of = |arc: &Arc| i64::from(arc.weight) * tokens(arc.place, at);
                sum.iter().map(of).sum::<i64>() == i64::from(*equals)
            }),
            OwnedLaw::NeverBoth(a, b) => !all().any(|at| tokens(*a, at) > 0 && tokens(*b, at) > 0),
            OwnedLaw::Reachable(place) => all().any(|at| tokens(*place, at) > 0),
            OwnedLaw::AlwaysCan(place) => {
                let marked: Vec<_> = all().map(|at| tokens(*place, at) > 0).collect();
                self.can(&marked).into_iter().all(|it| it)
            }
            OwnedLaw::DeadlockFree { end } => all()
                .all(|at| !self.next[at].is_empty() || end.is_some_and(|end| tokens(end, at) > 0)),
            OwnedLaw::HandlesAll | OwnedLaw::Settles | OwnedLaw::Deterministic => return None,
        })
    }

    /// The value of an expression of JANI in each marking, a truth value as 0 or 1. Nothing is
    /// drawn, so a largest probability is 1 where some choices lead there.
    fn value(&self, expression: &Value, names: &[&str]) -> Vec<i64> {
        let all = |value: i64| vec![value; self.markings.len()];
        if let Some(number) = expression.as_i64() {
            return all(number);
        }
        if let Some(truth) = expression.as_bool() {
            return all(i64::from(truth));
        }
        if let Some(name) = expression.as_str() {
            let at = names.iter().position(|it| *it == name).unwrap();
            return self.markings.iter().map(|it| it[at]).collect();
        }
        let inside = |key: &str| self.value(&expression[key], names);
        let op = expression["op"].as_str().unwrap();
        match op {
            "¬" => inside("exp").into_iter().map(|it| 1 - it).collect(),
            "Pmax" => {
                assert_eq!(expression["exp"]["op"], "F");
                let holds = self.value(&expression["exp"]["exp"], names);
                let holds: Vec<_> = holds.into_iter().map(|it| it != 0).collect();
                self.can(&holds).into_iter().map(i64::from).collect()
            }
            _ => inside("left").into_iter().zip(inside("right")).map(|it| binary(op, it)).collect(),
        }
    }
}

fn binary(op: &str, (left, right): (i64, i64)) -> i64 {
    match op {
        "+" => left + right,
        "*" => left * right,
        "≥" => i64::from(left >= right),
        ">" => i64::from(left > right),
        "≤" => i64::from(left <= right),
        "≠" => i64::from(left != right),
        "∧" => left & right,
        op => panic!("{op}"),
    }
}

/// The verdict on each property of a net as JANI, by the words of JANI.
fn verdicts(net: &OwnedNet, space: &Space) -> Vec<(String, bool)> {
    let model: Value = serde_json::from_str(&jani::write(&net.view().net())).unwrap();
    // Storm reads models of Markov, and of them those that choose.
    assert_eq!((&model["jani-version"], &model["type"]), (&json!(1), &json!("mdp")));
    let names: Vec<_> = list(&model["variables"]).map(|it| it["name"].as_str().unwrap()).collect();
    let verdict = |it: &Value| {
        let asked = &it["expression"];
        let at = [&asked["op"], &asked["fun"], &asked["states"]["op"]];
        assert_eq!(at, ["filter", "∀", "initial"], "{asked}");
        (it["name"].as_str().unwrap().to_owned(), space.value(&asked["values"], &names)[0] != 0)
    };
    list(&model["properties"]).map(verdict).collect()
}

/// A line of places that one token walks, and laws that hold of it or do not.
fn walk(ends: bool) -> OwnedNet {
    let mut net = OwnedNet::new("walk", "");
    let places: Vec<_> = (0..4)
        .map(|at| net.place(OwnedPlace::new(&format!("p{at}"), u32::from(at == 0))).unwrap())
        .collect();
    let last = if ends { 2 } else { 3 };
    for at in 0..last {
        let step = OwnedTransition::new(&format!("t{at}"));
        let to = places[if ends { at + 1 } else { (at + 1) % last }];
        net.transition(step.take(places[at], 1).give(to, 1)).unwrap();
    }
    let sum = |equals| OwnedLaw::Invariant {
        sum: places.iter().map(|&place| Arc { place, weight: 1 }).collect(),
        equals,
    };
    net.laws = vec![
        sum(1),
        sum(2),
        OwnedLaw::NeverBoth(places[0], places[1]),
        OwnedLaw::NeverBoth(places[2], places[2]),
        OwnedLaw::Reachable(places[2]),
        OwnedLaw::Reachable(places[3]),
        OwnedLaw::AlwaysCan(places[2]),
        OwnedLaw::AlwaysCan(places[0]),
        OwnedLaw::DeadlockFree { end: None },
        OwnedLaw::DeadlockFree { end: Some(places[2]) },
    ];
    net
}

#[test]
fn properties_in_jani_have_the_verdicts_of_the_laws() {
    let said = |net: &OwnedNet| {
        let all = verdicts(net, &Space::of(net, 10_000).unwrap());
        all.iter().map(|it| format!("{} {}", it.0, it.1)).collect::<Vec<_>>().join(", ")
    };
    for (net, expected) in [
        (
            nets::door(),
            "invariant true, never_both_locked_moving true, reachable_worn_out true, \
             deadlock_free true",
        ),
        (
            nets::philosophers(2),
            "reachable_eats_0 true, reachable_eats_1 true, deadlock_free false",
        ),
        (
            nets::philosophers(4),
            "reachable_eats_0 true, reachable_eats_1 true, reachable_eats_2 true, \
             reachable_eats_3 true, deadlock_free false",
        ),
        (
            nets::philosophers(3),
            "reachable_eats_0 true, reachable_eats_1 true, reachable_eats_2 true, \
             deadlock_free false",
        ),
        (
            walk(true),
            "invariant true, invariant_2 false, never_both_p0_p1 true, never_both_p2_p2 false, \
             reachable_p2 true, reachable_p3 false, always_can_p2 true, always_can_p0 false, \
             deadlock_free false, deadlock_free_2 true",
        ),
        (
            walk(false),
            "invariant true, invariant_2 false, never_both_p0_p1 true, never_both_p2_p2 false, \
             reachable_p2 true, reachable_p3 false, always_can_p2 true, always_can_p0 true, \
             deadlock_free true, deadlock_free_2 true",
        ),
    ] {
        assert_eq!(said(&net), expected);
    }
}

#[test]
fn properties_in_jani_are_the_laws_of_any_net() {
    let mut runner = TestRunner::new(ProptestConfig {
        cases: 2_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let counted = Cell::new([0; 2]);
    let compared = runner.run(&net(), |net| {
        if let Some(space) = Space::of(&net, 300) {
            let found: Vec<_> = verdicts(&net, &space).into_iter().map(|it| it.1).collect();
            let expected: Vec<_> = net.laws.iter().filter_map(|it| space.law(it)).collect();
            let mut counts = counted.get();
            expected.iter().for_each(|&it| counts[usize::from(it)] += 1);
            counted.set(counts);
            prop_assert_eq!(found, expected);
        }
        Ok(())
    });
    compared.unwrap_or_else(|error| panic!("{error}"));
    let counts = counted.get();
    assert!(counts.iter().all(|&it| it > 300), "{counts:?}");
}
