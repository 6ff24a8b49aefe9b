//! Certificates with something changed at random: they never stop the checker, and never make it
//! believe what is not so.

use crate::certificates::graph::graph;
use crate::certificates::random::{self, Dice};
use crate::certificates::search::Space;
use crate::certificates::stories::*;
use cotama_verification::certificate::*;
use serde_json::{Value, json};

fn certificates() -> Vec<Value> {
    let (track, tools, battery) = (track(), tools(), battery());
    let formula = |it| Question::Formula(it);
    let leaf = |list: &[(usize, u64)]| Case::Contradiction(list.to_vec());
    let refutation = |facts, cases| Evidence::Refutation(Refutation { dead: vec![], facts, cases });
    let sum = |weights| Fact::sum(&track, weights, &track.initial).unwrap();
    let both = Formula::And(vec![has("on1", 1), has("on2", 1)]);
    let exclusive =
        refutation(vec![sum(&[(0, 1), (2, 1), (4, 1)])], vec![leaf(&[(0, 1), (1, 1), (2, 1)])]);
    let no_deadlock = refutation(
        vec![sum(&[(0, -1), (2, -1), (4, -1)]), Fact::trap(&track, &[1, 2])],
        vec![
            Case::Split(0),
            leaf(&[(0, 1), (2, 1), (3, 1), (4, 1)]),
            leaf(&[(1, 1), (2, 1), (4, 1)]),
        ],
    );
    let ways: [&[u32]; 4] = [&[], &[0], &[], &[2]];
    let each = Evidence::Each(ways.iter().map(|it| Evidence::trace(&track, it)).collect());
    let starved = a(g(f(has("on1", 1))));
    let idle = e(f(g(at_most("idle1", 0))));
    let never = Evidence::Refutation(Refutation {
        dead: vec![("charge".into(), vec![leaf(&[])])],
        facts: vec![Fact::sum(&battery, &[(0, 1), (1, 1), (2, 2)], &battery.initial).unwrap()],
        cases: vec![leaf(&[(0, 1), (1, 1)])],
    });
    let pump = net(
        "pump",
        &[("power", 1), ("on", 0)],
        &[("start", &[("power", 1)], &[("power", 1), ("on", 1)])],
    );
    let grows = Evidence::Growth(Growth { stem: vec!["start".into()], pump: vec!["start".into()] });
    let mut all = vec![
        Certificate::of(
            &tools,
            "",
            formula(e(f(Formula::Deadlock))),
            true,
            Evidence::trace(&tools, &[0, 2]),
        ),
        Certificate::of(&tools, "", formula(idle), true, Evidence::lasso(&tools, &[0, 2], &[])),
        Certificate::of(
            &track,
            "",
            formula(starved),
            false,
            Evidence::lasso(&track, &[0, 1], &[2, 3]),
        ),
        Certificate::of(&track, "", formula(a(g(not(both)))), true, exclusive),
        Certificate::of(&track, "", formula(a(g(not(Formula::Deadlock)))), true, no_deadlock),
        Certificate::of(&track, "", Question::QuasiLive, true, each),
        Certificate::of(&pump, "", Question::Unbounded { places: vec!["on".into()] }, true, grows),
        // Refused as it is; a change may mend it.
        Certificate::of(&battery, "", formula(e(f(has("broken", 2)))), false, never),
    ];
    for (question, verdict) in [
        (Question::Live, false),
        (Question::Stable, false),
        (Question::OneSafe, false),
        (Question::Bound { places: vec!["full".into()], most: 2 }, true),
        (formula(a(g(e(f(has("full", 1)))))), false),
        (formula(e(g(not(Formula::Deadlock)))), true),
        (formula(a(f(has("empty", 1)))), true),
        (formula(e(u(has("full", 1), ax(Formula::Deadlock)))), true),
    ] {
        all.push(graph(&battery, question, verdict));
    }
    all.push(graph(&track, Question::Live, true));
    all.extend(random::certificates(&mut Dice(3), 30));
    all.iter().map(|it| serde_json::from_str(&it.text()).unwrap()).collect()
}

/// All values inside of a value, by their place.
fn places(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter()
                .enumerate()
                .for_each(|(number, it)| places(it, format!("{at}/{number}"), found));
        }
        Value::Object(fields) => {
            fields.iter().for_each(|(name, it)| places(it, format!("{at}/{name}"), found));
        }
        _ => {}
    }
    found.push(at);
}

pub(crate) fn change(json: &mut Value, dice: &mut Dice) {
    let mut all = Vec::new();
    places(json, String::new(), &mut all);
    let other = json.pointer(&all[dice.roll(all.len())]).unwrap().clone();
    let pointer = &all[dice.roll(all.len())];
    let here = json.pointer_mut(pointer).unwrap();
    let kinds = [
        "not", "E", "A", "EX", "AX", "X", "F", "G", "one", "trace", "deadlock", "live", "state",
        "or", "and",
    ];
    match (dice.roll(4), &mut *here) {
        (0, _) => *here = other,
        (_, Value::Number(number)) => {
            let number = number.as_i64().unwrap_or(0);
            *here = match dice.roll(5) {
                0 => json!(number.saturating_add(1)),
                1 => json!(number.saturating_sub(1)),
                2 => json!(number.wrapping_neg()),
                3 => json!(0),
                _ => json!([i64::MAX, i64::MIN, 2, 7][dice.roll(4)]),
            };
        }
        (_, Value::Bool(truth)) => *truth = !*truth,
        (_, Value::Array(list)) if !list.is_empty() => {
            let (a, b) = (dice.roll(list.len()), dice.roll(list.len()));
            match dice.roll(3) {
                0 => list.swap(a, b),
                1 => list.insert(a, list[b].clone()),
                _ => {
                    list.remove(a);
                }
            }
        }
        (1, Value::Object(fields)) if fields.len() == 1 => {
            let inner = fields.values().next().unwrap().clone();
            *here = json!({ kinds[dice.roll(kinds.len())]: inner });
        }
        (2, _) => *here = json!({ kinds[dice.roll(8)]: here.clone() }),
        (_, Value::String(text)) if text.contains(' ') => {
            let mut words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            let at = dice.roll(words.len());
            words[at] = dice.roll(4).to_string();
            *text = words.join(" ");
        }
        (_, Value::String(text)) => kinds[dice.roll(kinds.len())].clone_into(text),
        _ => {}
    }
}

#[test]
fn a_changed_certificate_that_is_accepted_is_true() {
    let (certificates, mut dice) = (certificates(), Dice(1));
    let (mut believed, mut unbounded) = (0, 0);
    for round in 0..20_000 {
        let mut json = certificates[round % certificates.len()].clone();
        for _ in 0..=dice.roll(3) {
            change(&mut json, &mut dice);
        }
        let text = json.to_string();
        if verify(&text).is_err() {
            continue;
        }
        believed += 1;
        // Some changes make the net unbounded; there a plain search has no answer.
        let Some(space) = Space::new(&json["net"], 2_000) else {
            unbounded += 1;
            continue;
        };
        assert_eq!(
            Some(json["verdict"] == true),
            space.answer(&json["question"]),
            "believed: {text}"
        );
    }
    assert!(believed > 1_000 && unbounded * 10 < believed, "{unbounded} of {believed}");
}

#[test]
fn no_text_stops_the_checker() {
    let (certificates, mut dice) = (certificates(), Dice(2));
    for round in 0..20_000 {
        let mut bytes = certificates[round % certificates.len()].to_string().into_bytes();
        for _ in 0..=dice.roll(4) {
            let at = dice.roll(bytes.len());
            match dice.roll(4) {
                0 => bytes[at] = b"0123456789-\"[]{},:eE. "[dice.roll(22)],
                1 => bytes.insert(at, b"0123456789-\"[]{},:eE. "[dice.roll(22)]),
                2 => {
                    bytes.remove(at);
                }
                _ => bytes[at] ^= 1 << dice.roll(7),
            }
        }
        if let Ok(text) = std::str::from_utf8(&bytes) {
            let _ = verify(text);
        }
    }
}
