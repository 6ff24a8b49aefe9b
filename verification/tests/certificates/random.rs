//! Random nets and formulas: the checker finds what a plain search finds.

use crate::certificates::graph::graph;
use crate::certificates::search::Space;
use crate::certificates::shown;
use crate::certificates::stories::*;
use cotama_verification::certificate::{Certificate, Formula, Question};
use cotama_verification::pt::Pt;
use serde_json::{Value, json};

pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self, sides: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % sides.max(1)
    }
}

const PLACES: [&str; 4] = ["a", "b", "c", "d"];
const TRANSITIONS: [&str; 5] = ["r", "s", "t", "u", "v"];

/// Transitions take and give one or two tokens.
pub(crate) fn any_net(dice: &mut Dice) -> Pt {
    let places = PLACES.map(|it| (it, dice.roll(3) as u32));
    let mut side = || {
        let first = dice.roll(4);
        let mut arcs = vec![(PLACES[first], 1 + dice.roll(4) as u32 / 3)];
        if dice.roll(2) == 0 {
            arcs.push((PLACES[(first + 1 + dice.roll(3)) % 4], 1));
        }
        arcs
    };
    let transitions = TRANSITIONS.map(|it| (it, side(), side()));
    let transitions: Vec<_> =
        transitions.iter().map(|it| (it.0, it.1.as_slice(), it.2.as_slice())).collect();
    net("any", &places, &transitions)
}

fn any_formula(dice: &mut Dice, depth: usize) -> Formula {
    let place = PLACES[dice.roll(4)];
    if depth == 0 {
        return match dice.roll(5) {
            0 => Formula::Deadlock,
            1 => fireable(TRANSITIONS[dice.roll(5)]),
            2 => at_most(place, [0, 1, 2][dice.roll(3)]),
            3 => Formula::AtMost(linear(
                0,
                &[(place, 2), (if place == "b" { "c" } else { "b" }, -1)],
            )),
            _ => has(place, [1, 2][dice.roll(2)]),
        };
    }
    let one = any_formula(dice, depth - 1);
    let quantified = |dice: &mut Dice, path| if dice.roll(2) == 0 { e(path) } else { a(path) };
    match dice.roll(8) {
        0 => not(one),
        1 => Formula::And(vec![one, any_formula(dice, depth - 1)]),
        2 => Formula::Or(vec![one, any_formula(dice, depth - 1)]),
        3 => {
            if dice.roll(2) == 0 {
                ex(one)
            } else {
                ax(one)
            }
        }
        4 => quantified(dice, f(one)),
        5 => quantified(dice, g(one)),
        _ => {
            let other = any_formula(dice, depth - 1);
            quantified(dice, u(one, other))
        }
    }
}

/// So many certificates of nets with few markings.
pub(crate) fn certificates(dice: &mut Dice, count: usize) -> Vec<Certificate> {
    let mut all = Vec::new();
    while all.len() < count {
        let net = any_net(dice);
        let empty = Certificate::of(
            &net,
            "",
            Question::Live,
            true,
            cotama_verification::certificate::Evidence::None,
        );
        let json: Value = serde_json::from_str(&empty.text()).unwrap();
        let Some(space) = Space::new(&json["net"], 60) else { continue };
        let question = match dice.roll(12) {
            0 => Question::Live,
            1 => Question::QuasiLive,
            2 => Question::Stable,
            3 => Question::OneSafe,
            4 => Question::Bound {
                places: vec!["a".into(), "c".into()],
                most: [0, 1, 2, 3, 4][dice.roll(5)],
            },
            _ => Question::Formula(any_formula(dice, 3)),
        };
        let asked = Certificate::of(&net, "", question.clone(), true, empty.evidence);
        let asked: Value = serde_json::from_str(&asked.text()).unwrap();
        let Some(verdict) = space.answer(&asked["question"]) else { continue };
        all.push(graph(&net, question, verdict));
    }
    all
}

#[test]
fn the_checker_agrees_with_a_search() {
    let mut seen = [0, 0];
    for certificate in certificates(&mut Dice(4), 2_000) {
        shown(&certificate);
        let json: Value = serde_json::from_str(&certificate.text()).unwrap();
        let mut other = json;
        other["verdict"] = json!(!certificate.verdict);
        let error = cotama_verification::certificate::verify(&other.to_string()).unwrap_err();
        assert_eq!(error.message, "the opposite of what is claimed is so");
        seen[usize::from(certificate.verdict)] += 1;
    }
    assert!(seen.iter().all(|it| *it > 600), "{seen:?}");
}
