//! Properties of the exports of every net.

use crate::exports::random::{PLACES, SIGNALS, complemented, machine, net, net_reaching};
use cotama_core::net::owned::OwnedTransition;
use cotama_core::net::{Arc, Net};
use cotama_verification::drawing::matrix;
use cotama_verification::formats::{jani, json, scxml};
use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn json_gives_back_the_net(net in net()) {
        prop_assert_eq!(net.view().net().defect(), None);
        prop_assert_eq!(json::read(&json::write(&net.view().net())), Ok(net));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_net_with_unknown_ids_is_written_and_refused_when_read(
        net in net_reaching(PLACES + 2, SIGNALS + 1),
    ) {
        let view = net.view();
        let (refused, defect) =
            (json::read(&json::write(&view.net())).is_err(), view.net().defect());
        prop_assert_eq!(refused, defect.is_some());
        prop_assert!(scxml::write(&view.net()).is_err() || defect.is_none());
        jani::write(&view.net());
        matrix::write(&view.net());
    }

    #[test]
    fn any_text_is_read_or_refused(text in any::<String>()) {
        prop_assert!(json::read(&text).is_err());
    }

    #[test]
    fn a_state_machine_is_well_formed_xml_with_every_transition(net in machine()) {
        prop_assert_eq!(net.view().net().defect(), None);
        let text = scxml::write(&net.view().net()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let tags = tags(&text).map_err(TestCaseError::fail)?;
        let count = |name| tags.iter().filter(|tag| tag.split(' ').next() == Some(name)).count();
        prop_assert_eq!(count("transition"), net.transitions.len());
        prop_assert_eq!(count("state"), 2);
        prop_assert_eq!(count("data"), net.places.len() - 2);
    }

    #[test]
    fn the_guards_and_assignments_of_a_chart_are_those_of_the_net(
        net in complemented(), values in (0..2i64, 0..6i64, 0..2i64), state in 0..2usize,
    ) {
        let view = net.view();
        let text = scxml::write(&view.net()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let tags = tags(&text).map_err(TestCaseError::fail)?;
        let mut marking = vec![0, 0, values.0, values.1, values.2, 1 - values.0, 5 - values.1];
        marking[state] = 1;
        let variables = BTreeMap::from([("v0", values.0), ("v1", values.1), ("v2", values.2)]);
        let (mut source, mut seen) = ("", 0);
        for (at, tag) in tags.iter().enumerate() {
            if tag.starts_with("state ") {
                source = attribute(tag, "id").unwrap();
            } else if tag.starts_with("transition ") {
                seen += 1;
                let id: usize = attribute(tag, "cotama:name").unwrap()[1..].parse().unwrap();
                let cond = attribute(tag, "cond").unwrap_or("true");
                let open = source == ["a", "b"][state] && cond.split(" \
                    &amp;&amp; ").all(|it| term(it, &variables) != 0);
                prop_assert_eq!(open, is_enabled(&view.net(), &marking, id), "{} at \
                    {:?}", tag, marking);
                if open {
                    let mut after = variables.clone();
                    for assign in tags[at + 1..].iter().take_while(|it| it.starts_with("assign ")) {
                        let location = attribute(assign, "location").unwrap();
                        *after.get_mut(location).unwrap() =
                            term(attribute(assign, "expr").unwrap(), &variables);
                    }
                    let target = attribute(tag, "target").unwrap_or(source);
                    let found = [
                        i64::from(target == "a"),
                        i64::from(target == "b"),
                        after["v0"],
                        after["v1"],
                        after["v2"],
                    ];
                    let mut expected = marking.clone();
                    fire(&view.net(), &mut expected, id);
                    prop_assert_eq!(&found[..], &expected[..5], "{} at {:?}", tag, marking);
                }
            }
        }
        prop_assert_eq!(seen, net.transitions.len());
    }

    #[test]
    fn a_jani_model_fires_as_the_net_does(
        net in net(),
        choices in vec(any::<prop::sample::Index>(), 8),
    ) {
        let view = net.view();
        let model: Value = serde_json::from_str(&jani::write(&view.net())).unwrap();
        let names: Vec<&str> =
            list(&model["variables"]).map(|it| it["name"].as_str().unwrap()).collect();
        let edges: Vec<&Value> = list(&model["automata"][0]["edges"]).collect();
        prop_assert_eq!(edges.len(), net.transitions.len());
        let mut variables: BTreeMap<&str, i64> =
            names
                .iter()
                .zip(list(&model["variables"]))
                .map(|(&name, it)| (name, it["initial-value"].as_i64().unwrap()))
                .collect();
        let mut marking: Vec<i64> = net.places.iter().map(|it| i64::from(it.initial)).collect();
        for choice in choices {
            let found: Vec<i64> = names.iter().map(|name| variables[name]).collect();
            prop_assert_eq!(&found, &marking);
            let enabled: Vec<usize> =
                (0..edges.len()).filter(|&it| is_enabled(&view.net(), &marking, it)).collect();
            let open = |it: &usize| {
                edges[*it].get("guard").is_none_or(|guard| value(&guard["exp"], &variables) != 0)
            };
            prop_assert_eq!(&enabled, &(0..edges.len()).filter(open).collect::<Vec<_>>());
            if enabled.is_empty() {
                break;
            }
            let fired = enabled[choice.index(enabled.len())];
            let assignments = list(&edges[fired]["destinations"][0]["assignments"]);
            let new: Vec<(&str, i64)> =
                assignments
                    .map(|it| (it["ref"].as_str().unwrap(), value(&it["value"], &variables)))
                    .collect();
            variables.extend(new);
            fire(&view.net(), &mut marking, fired);
        }
    }

    #[test]
    fn the_table_holds_every_arc(net in net()) {
        let text = matrix::write(&net.view().net());
        let rows: Vec<Vec<&str>> = text
            .lines()
            .filter(|it| !it.starts_with('#'))
            .map(|it| it.split('\t').collect())
            .collect();
        prop_assert_eq!(rows.len(), 1 + 4 * net.places.len());
        let numbers = |part: usize, place: usize| -> Vec<i64> {
            rows[1 + part * net.places.len() + place][2..]
                .iter()
                .map(|it| it.parse().unwrap())
                .collect()
        };
        let weight = |arcs: &[Arc], place: usize| {
            arcs.iter().find(|it| it.place.0 as usize == place).map_or(0, |it| i64::from(it.weight))
        };
        for place in 0..net.places.len() {
            let column = |arcs: fn(&OwnedTransition) -> &[Arc]| -> Vec<i64> {
                net.transitions.iter().map(|it| weight(arcs(it), place)).collect()
            };
            let (pre, post) = (column(|it| &it.take), column(|it| &it.give));
            let change: Vec<i64> = post.iter().zip(&pre).map(|(post, pre)| post - pre).collect();
            prop_assert_eq!(numbers(0, place), pre);
            prop_assert_eq!(numbers(1, place), column(|it| &it.read));
            prop_assert_eq!(numbers(2, place), post);
            prop_assert_eq!(numbers(3, place), change);
        }
    }
}

pub(super) fn is_enabled(net: &Net<'_>, marking: &[i64], transition: usize) -> bool {
    let it = &net.transitions[transition];
    it.take.iter().chain(it.read).all(|arc| marking[arc.place.0 as usize] >= i64::from(arc.weight))
}

pub(super) fn fire(net: &Net<'_>, marking: &mut [i64], transition: usize) {
    let it = &net.transitions[transition];
    it.take.iter().for_each(|arc| marking[arc.place.0 as usize] -= i64::from(arc.weight));
    it.give.iter().for_each(|arc| marking[arc.place.0 as usize] += i64::from(arc.weight));
}

pub(super) fn list(value: &Value) -> impl Iterator<Item = &Value> + Clone {
    value.as_array().unwrap().iter()
}

/// The value of a JANI expression; a truth value is 0 or 1.
fn value(expression: &Value, variables: &BTreeMap<&str, i64>) -> i64 {
    if let Some(number) = expression.as_i64() {
        return number;
    }
    if let Some(name) = expression.as_str() {
        return variables[name];
    }
    let (left, right) =
        (value(&expression["left"], variables), value(&expression["right"], variables));
    match expression["op"].as_str().unwrap() {
        "+" => left + right,
        "-" => left - right,
        "≥" => i64::from(left >= right),
        "∧" => left & right,
        op => panic!("{op}"),
    }
}

/// The value of an attribute, as it is written.
fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    tag.split_once(&format!(" {name}=\""))?.1.split_once('"').map(|(value, _)| value)
}

/// The value of an ECMAScript expression as charts have them; a truth value is 0 or 1.
fn term(text: &str, variables: &BTreeMap<&str, i64>) -> i64 {
    let number = |text: &str| text.parse().unwrap_or_else(|_| variables[text]);
    match text.split(' ').collect::<Vec<_>>()[..] {
        ["true"] => 1,
        ["false"] => 0,
        [left, "&gt;=", right] => i64::from(number(left) >= number(right)),
        [left, "&lt;=", right] => i64::from(number(left) <= number(right)),
        [left, "+", right] => number(left) + number(right),
        [left, "-", right] => number(left) - number(right),
        [one] => one.strip_prefix('!').map_or_else(|| number(one), |not| 1 - number(not)),
        _ => panic!("{text}"),
    }
}

/// The start tags of an XML text, or why it is not well formed (as far as the exports go).
fn tags(text: &str) -> Result<Vec<String>, String> {
    let allowed = |c: char| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{FFFD}' | '\u{10000}'..);
    if let Some(c) = text.chars().find(|&c| !allowed(c)) {
        return Err(format!("{c:?} is not allowed"));
    }
    let mut rest = text
        .strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>")
        .ok_or("no declaration")?
        .trim_start();
    let (mut open, mut all) = (Vec::new(), Vec::new());
    while !rest.is_empty() {
        if let Some(comment) = rest.strip_prefix("<!--") {
            let (inside, after) = comment.split_once("--").ok_or("a comment without an end")?;
            rest = after
                .strip_prefix('>')
                .ok_or_else(|| format!("two hyphens in {inside}"))?
                .trim_start();
            continue;
        }
        let (tag, after) =
            rest.strip_prefix('<').and_then(|it| it.split_once('>')).ok_or("text between tags")?;
        rest = after.trim_start();
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop().as_deref() != Some(name) {
                return Err(format!("{name} ends, but is not open"));
            }
            continue;
        }
        let (tag, empty) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
        let pieces: Vec<&str> = tag.split('"').collect();
        let name = pieces[0].split(' ').next().unwrap_or_default().to_owned();
        let quoted = pieces.len() == 1
            || pieces[..pieces.len() - 1].iter().step_by(2).all(|it| it.ends_with('='));
        if !quoted || pieces.len().is_multiple_of(2) || pieces.iter().any(|it| it.contains('<')) {
            return Err(format!("attributes of <{tag}>"));
        }
        all.push(tag.to_owned());
        if !empty {
            open.push(name);
        }
    }
    if open.is_empty() { Ok(all) } else { Err(format!("{open:?} stay open")) }
}
