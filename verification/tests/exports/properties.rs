//! What holds of the exports of every net.

use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition};
use cotama_core::net::{Arc, EventId, Ignored, Net, OutputId, PlaceId, Role, Within};
use cotama_verification::export::{jani, json, matrix, scxml};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;

const PLACES: u32 = 6;
const SIGNALS: u32 = 3;

fn name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,3}", "[ab.\\-_ \"'<>&#\\\\\t\n\r]{0,4}", any::<String>()]
}

/// Names that differ: each ends with its position, a digit.
fn names(count: u32) -> impl Strategy<Value = Vec<String>> {
    let number =
        |names: Vec<String>| names.iter().zip(0..).map(|(name, i)| format!("{name}{i}")).collect();
    vec(name(), count as usize).prop_map(number)
}

fn signals() -> impl Strategy<Value = Vec<OwnedSignal>> {
    let signals = |(names, doc): (Vec<String>, String)| {
        names.into_iter().map(|name| OwnedSignal { name, doc: doc.clone() }).collect()
    };
    (names(SIGNALS), name()).prop_map(signals)
}

/// Arcs to places from `from` on, none twice.
fn arcs(from: u32, to: u32) -> impl Strategy<Value = Vec<Arc>> {
    let arcs = |arcs: BTreeMap<u32, u32>| {
        arcs.into_iter().map(|(p, weight)| Arc { place: PlaceId(p), weight }).collect()
    };
    proptest::collection::btree_map(from..to, 1..4u32, 0..3).prop_map(arcs)
}

fn transition(places: u32, signals: u32) -> impl Strategy<Value = OwnedTransition> {
    let within = (0..100u32, option::of(0..100u32))
        .prop_map(|(earliest, more)| Within { earliest, latest: more.map(|more| earliest + more) });
    let arcs = (arcs(0, places / 2), arcs(places / 2, places), arcs(0, places));
    let rest = (
        vec((0..signals).prop_map(OutputId), 0..3),
        option::of(within),
        any::<i16>(),
        any::<u32>(),
    );
    (name(), name(), option::of((0..signals).prop_map(EventId)), arcs, rest).prop_map(
        |(name, doc, on, (take, read, give), (emits, within, priority, line))| OwnedTransition {
            name,
            doc,
            line,
            on,
            take,
            read,
            give,
            emits,
            within,
            priority,
        },
    )
}

fn law(places: u32) -> impl Strategy<Value = OwnedLaw> {
    let place = || (0..places).prop_map(PlaceId);
    prop_oneof![
        (arcs(0, places), any::<u32>())
            .prop_map(|(sum, equals)| OwnedLaw::Invariant { sum, equals }),
        (place(), place()).prop_map(|(a, b)| OwnedLaw::NeverBoth(a, b)),
        place().prop_map(OwnedLaw::Reachable),
        place().prop_map(OwnedLaw::AlwaysCan),
        Just(OwnedLaw::HandlesAll),
        Just(OwnedLaw::Settles),
        option::of(place()).prop_map(|end| OwnedLaw::DeadlockFree { end }),
        Just(OwnedLaw::Deterministic),
    ]
}

fn places() -> impl Strategy<Value = Vec<OwnedPlace>> {
    let kind = (0..5u8, 0..3u32, 0..4u32, any::<bool>());
    (names(PLACES), vec(kind, PLACES as usize), name()).prop_map(|(names, kinds, doc)| {
        let mut places: Vec<OwnedPlace> = Vec::new();
        for (name, (kind, initial, more, bounded)) in names.into_iter().zip(kinds) {
            let place = OwnedPlace::new(&name, initial).doc(&doc);
            let place = if bounded { place.at_most(initial + more) } else { place };
            places.push(match (kind, places.last()) {
                (0, Some(of)) => {
                    let (initial, bound) = (of.bound - of.initial, of.bound);
                    OwnedPlace {
                        initial,
                        bound,
                        role: Role::Complement(PlaceId(places.len() as u32 - 1)),
                        ..place
                    }
                }
                (1, _) => OwnedPlace { role: Role::Shared, ..place },
                (2, _) => OwnedPlace { role: Role::Mailbox, ..place },
                (3, _) => OwnedPlace { role: Role::Data, ..place },
                _ => place,
            });
        }
        places
    })
}

/// A net whose transitions, laws and ignored events name places below `reach` and signals below
/// `signals`.
fn net_reaching(reach: u32, signal_reach: u32) -> impl Strategy<Value = OwnedNet> {
    let ignored = (0..signal_reach, 0..reach)
        .prop_map(|(e, p)| Ignored { event: EventId(e), place: PlaceId(p) });
    let lists =
        (vec(transition(reach, signal_reach), 0..6), vec(ignored, 0..3), vec(law(reach), 0..5));
    ((name(), name()), places(), (signals(), signals()), lists).prop_map(
        |((name, doc), places, (events, outputs), (transitions, ignored, laws))| OwnedNet {
            name,
            doc,
            places,
            events,
            outputs,
            transitions,
            ignored,
            laws,
        },
    )
}

fn net() -> impl Strategy<Value = OwnedNet> {
    net_reaching(PLACES, SIGNALS)
}

/// Two states, the other places variables.
fn machine() -> impl Strategy<Value = OwnedNet> {
    let moves = vec((0..2u32, option::of(0..2u32), transition(PLACES, SIGNALS)), 0..6);
    (net(), moves).prop_map(|(net, moves)| {
        let mut net = OwnedNet { transitions: Vec::new(), ..net };
        for (i, place) in net.places.iter_mut().enumerate() {
            place.role = if i < 2 { Role::State } else { Role::Data };
            place.bound = if i == 3 { 1 } else { u32::MAX };
            place.initial = u32::from(i == 0);
        }
        for (from, to, mut it) in moves {
            for arcs in [&mut it.take, &mut it.read, &mut it.give] {
                arcs.retain(|arc| arc.place.0 >= 2);
            }
            let it = match to {
                Some(to) => it.take(PlaceId(from), 1).give(PlaceId(to), 1),
                None => it.read(PlaceId(from), 1),
            };
            net.transition(it).unwrap();
        }
        net
    })
}

/// Two states, then variables with complements: `v0` up to 1, `v1` up to 5, and `v2` up to 1
/// without one.
fn complemented() -> impl Strategy<Value = OwnedNet> {
    let moves = vec((0..2u32, option::of(0..2u32), vec((0..6u8, 1..3u32), 3)), 1..8);
    (0..2u32, 0..6u32, moves).prop_map(|(v0, v1, moves)| {
        let mut net = OwnedNet::new("complemented", "");
        let state = |name, initial| OwnedPlace::new(name, initial).at_most(1);
        let data = |name, initial, bound| OwnedPlace {
            role: Role::Data,
            ..OwnedPlace::new(name, initial).at_most(bound)
        };
        let rest = |name, of, initial, bound| OwnedPlace {
            role: Role::Complement(of),
            ..data(name, initial, bound)
        };
        let states = [state("a", 1), state("b", 0)].map(|it| net.place(it).unwrap());
        let v = [data("v0", v0, 1), data("v1", v1, 5), data("v2", 0, 1)]
            .map(|it| net.place(it).unwrap());
        let c = [rest("c0", v[0], 1 - v0, 1), rest("c1", v[1], 5 - v1, 5)]
            .map(|it| net.place(it).unwrap());
        for (from, to, uses) in moves {
            let it = OwnedTransition::new(&format!("t{}", net.transitions.len()));
            let mut it = match to {
                Some(to) => it.take(states[from as usize], 1).give(states[to as usize], 1),
                None => it.read(states[from as usize], 1),
            };
            for (i, (usage, weight)) in uses.into_iter().enumerate() {
                it = match (usage, c.get(i)) {
                    (0, Some(&c)) => it.take(c, weight).give(v[i], weight),
                    (1, Some(&c)) => it.take(v[i], weight).give(c, weight),
                    (2, Some(&c)) => it.read(c, weight),
                    (3, _) => it.read(v[i], weight),
                    (4, None) => it.give(v[i], weight),
                    (5, None) => it.take(v[i], weight),
                    _ => it,
                };
            }
            net.transition(it).unwrap();
        }
        net
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn json_gives_back_the_net(net in net()) {
        prop_assert_eq!(net.view().net().defect(), None);
        prop_assert_eq!(json::read(&json::write(&net.view().net())), Ok(net));
    }

    #[test]
    fn a_net_with_unknown_ids_is_written_and_refused_when_read(net in net_reaching(PLACES + 2, SIGNALS + 1)) {
        let view = net.view();
        let (refused, defect) = (json::read(&json::write(&view.net())).is_err(), view.net().defect());
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
                        *after.get_mut(location).unwrap() = term(attribute(assign, "expr").unwrap(), &variables);
                    }
                    let target = attribute(tag, "target").unwrap_or(source);
                    let found = [i64::from(target == "a"), i64::from(target == "b"), after["v0"], after["v1"], after["v2"]];
                    let mut expected = marking.clone();
                    fire(&view.net(), &mut expected, id);
                    prop_assert_eq!(&found[..], &expected[..5], "{} at {:?}", tag, marking);
                }
            }
        }
        prop_assert_eq!(seen, net.transitions.len());
    }

    #[test]
    fn a_jani_model_fires_as_the_net_does(net in net(), choices in vec(any::<prop::sample::Index>(), 8)) {
        let view = net.view();
        let model: Value = serde_json::from_str(&jani::write(&view.net())).unwrap();
        let names: Vec<&str> = list(&model["variables"]).map(|it| it["name"].as_str().unwrap()).collect();
        let edges: Vec<&Value> = list(&model["automata"][0]["edges"]).collect();
        prop_assert_eq!(edges.len(), net.transitions.len());
        let mut variables: BTreeMap<&str, i64> =
            names.iter().zip(list(&model["variables"])).map(|(&name, it)| (name, it["initial-value"].as_i64().unwrap())).collect();
        let mut marking: Vec<i64> = net.places.iter().map(|it| i64::from(it.initial)).collect();
        for choice in choices {
            let found: Vec<i64> = names.iter().map(|name| variables[name]).collect();
            prop_assert_eq!(&found, &marking);
            let enabled: Vec<usize> = (0..edges.len()).filter(|&it| is_enabled(&view.net(), &marking, it)).collect();
            let open = |it: &usize| edges[*it].get("guard").is_none_or(|guard| value(&guard["exp"], &variables) != 0);
            prop_assert_eq!(&enabled, &(0..edges.len()).filter(open).collect::<Vec<_>>());
            if enabled.is_empty() {
                break;
            }
            let fired = enabled[choice.index(enabled.len())];
            let assignments = list(&edges[fired]["destinations"][0]["assignments"]);
            let new: Vec<(&str, i64)> =
                assignments.map(|it| (it["ref"].as_str().unwrap(), value(&it["value"], &variables))).collect();
            variables.extend(new);
            fire(&view.net(), &mut marking, fired);
        }
    }

    #[test]
    fn the_table_holds_every_arc(net in net()) {
        let text = matrix::write(&net.view().net());
        let rows: Vec<Vec<&str>> = text.lines().filter(|it| !it.starts_with('#')).map(|it| it.split('\t').collect()).collect();
        prop_assert_eq!(rows.len(), 1 + 4 * net.places.len());
        let numbers = |part: usize, place: usize| -> Vec<i64> {
            rows[1 + part * net.places.len() + place][2..].iter().map(|it| it.parse().unwrap()).collect()
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

fn is_enabled(net: &Net<'_>, marking: &[i64], transition: usize) -> bool {
    let it = &net.transitions[transition];
    it.take.iter().chain(it.read).all(|arc| marking[arc.place.0 as usize] >= i64::from(arc.weight))
}

fn fire(net: &Net<'_>, marking: &mut [i64], transition: usize) {
    let it = &net.transitions[transition];
    it.take.iter().for_each(|arc| marking[arc.place.0 as usize] -= i64::from(arc.weight));
    it.give.iter().for_each(|arc| marking[arc.place.0 as usize] += i64::from(arc.weight));
}

fn list(value: &Value) -> impl Iterator<Item = &Value> + Clone {
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
