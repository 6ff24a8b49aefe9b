//! Written nets are PNML, and read back as the same net.

use cotama_core::net::owned::{
    OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition,
};
use cotama_core::net::{Arc, EventId, OutputId, Place, PlaceId, Role, Within};
use cotama_verification::pnml;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeSet;

/// Reads back what was written, in both forms.
fn comes_back(net: &OwnedNet) {
    let view = net.view();
    assert_eq!(view.net().defect(), None);
    for text in [pnml::write(&view.net()), pnml::write_for_tina(&view.net())] {
        match pnml::read("written.pnml", text.as_bytes()) {
            Ok(read) => assert_eq!(&read, net, "{text}"),
            Err(errors) => panic!("{errors}\n{text}"),
        }
    }
}

/// Checks a written file against what the grammars of the core model and of P/T nets demand of the
/// elements that the writer uses: their order, their attributes, unique ids, arcs that end at
/// nodes.
fn is_valid(text: &str) {
    let mut reader = quick_xml::Reader::from_str(text);
    reader.config_mut().expand_empty_elements = true;
    let mut open: Vec<(String, String)> = Vec::new();
    let (mut ids, mut places, mut transitions) =
        (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    let mut arcs = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Start(tag) => {
                let name = tag.name().0.to_owned();
                let foreign = open.iter().any(|(open, _)| open == "toolspecific");
                if let Some((_, children)) = open.last_mut() {
                    *children += &name;
                    children.push(' ');
                }
                let attribute =
                    |key: &str| tag.try_get_attribute(key).unwrap().map(|it| it.value.into_owned());
                if !foreign {
                    assert_eq!(attributes(&tag), allowed_attributes(&name), "{name}");
                    if let Some(id) = attribute("id") {
                        assert!(ids.insert(id.clone()), "{id} twice");
                        match name.as_str() {
                            "place" => _ = places.insert(id),
                            "transition" => _ = transitions.insert(id),
                            _ => {}
                        }
                    }
                    if name == "arc" {
                        arcs.push((attribute("source").unwrap(), attribute("target").unwrap()));
                    }
                }
                open.push((if foreign { "toolspecific".to_owned() } else { name }, String::new()));
            }
            Event::End(_) => {
                let (name, children) = open.pop().unwrap();
                assert!(in_order(&name, &children), "{name}: {children}");
            }
            Event::Eof => break,
            _ => {}
        }
    }
    for (source, target) in arcs {
        let there = places.contains(&source) && transitions.contains(&target);
        let back = transitions.contains(&source) && places.contains(&target);
        assert!(there || back, "{source} to {target}");
    }
}

fn attributes(tag: &BytesStart<'_>) -> Vec<String> {
    tag.attributes().map(|attribute| attribute.unwrap().key.0.to_owned()).collect()
}

fn allowed_attributes(element: &str) -> Vec<&'static str> {
    match element {
        "pnml" => vec!["xmlns"],
        "net" => vec!["id", "type"],
        "page" | "place" | "transition" => vec!["id"],
        "arc" => vec!["id", "source", "target"],
        "toolspecific" => vec!["tool", "version"],
        _ => vec![],
    }
}

/// Whether the children of an element are some of the allowed ones, in this order.
fn in_order(element: &str, children: &str) -> bool {
    let (once, many): (&[&str], &[&str]) = match element {
        "pnml" => (&["net"], &[]),
        "net" => (&["name", "toolspecific", "page"], &[]),
        "page" => (&[], &["place", "transition", "arc"]),
        "place" => (&["name", "initialMarking", "toolspecific"], &[]),
        "transition" => (&["name", "toolspecific"], &[]),
        "arc" => (&["inscription", "toolspecific"], &[]),
        "name" | "initialMarking" | "inscription" => (&["text"], &[]),
        _ => return true,
    };
    let mut children = children.split_whitespace().peekable();
    for name in once {
        children.next_if_eq(name);
    }
    for name in many {
        while children.next_if_eq(name).is_some() {}
    }
    children.next().is_none()
}

fn weird_text() -> impl Strategy<Value = String> {
    let palette = "ab  \t\n\r<>&\"'\\{}u;#]]>\
        \u{0}\u{1b}\u{7f}\u{85}\u{a0}é→🤖\u{2028}\u{fffd}\u{fffe}\u{ffff}";
    let character =
        prop_oneof![4 => select(palette.chars().collect::<Vec<_>>()), 1 => any::<char>()];
    proptest::collection::vec(character, 0..8).prop_map(|text| text.into_iter().collect())
}

/// Texts of which no two are the same.
fn names(count: usize) -> impl Strategy<Value = Vec<String>> {
    proptest::collection::vec(weird_text(), count).prop_map(|mut names| {
        let mut taken = BTreeSet::new();
        for name in &mut names {
            while !taken.insert(name.clone()) {
                name.push('+');
            }
        }
        names
    })
}

fn number() -> impl Strategy<Value = u32> {
    prop_oneof![3 => 0..4_u32, 1 => any::<u32>(), 1 => Just(u32::MAX)]
}

fn weight() -> impl Strategy<Value = u32> {
    number().prop_map(|weight| weight.max(1))
}

fn places(count: usize) -> impl Strategy<Value = Vec<OwnedPlace>> {
    let place =
        (weird_text(), number(), number(), any::<bool>(), 0..5_usize, any::<prop::sample::Index>());
    (names(count), proptest::collection::vec(place, count)).prop_map(|(names, drawn)| {
        let mut places: Vec<OwnedPlace> = Vec::new();
        for (name, (doc, a, b, bounded, role, of)) in names.into_iter().zip(drawn) {
            let mut place = OwnedPlace { doc, ..OwnedPlace::new(&name, a.min(b)) };
            place.bound = if bounded { a.max(b) } else { Place::UNBOUNDED };
            place.role = [Role::State, Role::Data, Role::Shared, Role::Mailbox, Role::State][role];
            if role == 4 && !places.is_empty() {
                let of = of.index(places.len());
                place.role = Role::Complement(PlaceId(of as u32));
                place.bound = places[of].bound;
                place.initial = places[of].bound - places[of].initial;
            }
            places.push(place);
        }
        places
    })
}

fn signals(count: usize) -> impl Strategy<Value = Vec<OwnedSignal>> {
    let docs = proptest::collection::vec(weird_text(), count);
    (names(count), docs).prop_map(|(names, docs)| {
        names.into_iter().zip(docs).map(|(name, doc)| OwnedSignal { name, doc }).collect()
    })
}

fn arcs(places: usize) -> impl Strategy<Value = Vec<Arc>> {
    let all: Vec<usize> = (0..places).collect();
    let chosen = subsequence(all, 0..=places).prop_shuffle();
    (chosen, proptest::collection::vec(weight(), places)).prop_map(|(chosen, weights)| {
        chosen
            .into_iter()
            .zip(weights)
            .map(|(place, weight)| Arc { place: PlaceId(place as u32), weight })
            .collect()
    })
}

fn within() -> impl Strategy<Value = Option<Within>> {
    let interval = (number(), number(), any::<bool>()).prop_map(|(a, b, limited)| {
        if limited {
            let [a, b] = [a, b].map(|it| it.min(Within::LATEST));
            Within { earliest: a.min(b), latest: Some(a.max(b)) }
        } else {
            Within { earliest: a, latest: None }
        }
    });
    proptest::option::of(interval)
}

fn ids(count: usize, most: usize) -> impl Strategy<Value = Vec<u32>> {
    proptest::collection::vec(0..count.max(1) as u32, if count == 0 { 0..=0 } else { 0..=most })
}

fn transition(
    places: usize,
    events: usize,
    outputs: usize,
) -> impl Strategy<Value = OwnedTransition> {
    let lines = prop_oneof![Just(None), number().prop_map(Some)];
    let needs = (arcs(places), any::<u8>());
    let said = (weird_text(), lines, ids(events, 1), ids(outputs, 3), within(), any::<i16>());
    (needs, arcs(places), said).prop_map(
        |((needs, reads), give, (doc, line, on, emits, within, priority))| {
            let is_read = |arc: &Arc| reads >> (arc.place.0 % 8) & 1 == 1;
            let (read, take) = needs.into_iter().partition(is_read);
            OwnedTransition {
                name: String::new(),
                doc,
                line: line.unwrap_or(0),
                on: on.first().copied().map(EventId),
                take,
                read,
                give,
                emits: emits.into_iter().map(OutputId).collect(),
                within,
                priority,
            }
        },
    )
}

fn law(places: usize) -> impl Strategy<Value = OwnedLaw> {
    let place = || (0..places as u32).prop_map(PlaceId);
    prop_oneof![
        (arcs(places), number()).prop_map(|(sum, equals)| OwnedLaw::Invariant { sum, equals }),
        (place(), place()).prop_map(|(a, b)| OwnedLaw::NeverBoth(a, b)),
        place().prop_map(OwnedLaw::Reachable),
        place().prop_map(OwnedLaw::AlwaysCan),
        Just(OwnedLaw::HandlesAll),
        Just(OwnedLaw::Settles),
        proptest::option::of(place()).prop_map(|end| OwnedLaw::DeadlockFree { end }),
        Just(OwnedLaw::Deterministic),
    ]
}

fn ignored(places: usize, events: usize) -> impl Strategy<Value = Vec<OwnedIgnored>> {
    let most = if events == 0 { 0..=0 } else { 0..=3 };
    let pair = (0..events.max(1) as u32, 0..places as u32);
    let guard = proptest::collection::btree_map(0..places as u32, 1..=u32::MAX, 0..=2);
    let ignored = (pair, guard).prop_map(|((event, place), guard)| OwnedIgnored {
        event: EventId(event),
        place: PlaceId(place),
        guard: guard.into_iter().map(|(at, weight)| Arc { place: PlaceId(at), weight }).collect(),
    });
    proptest::collection::vec(ignored, most)
}

fn net() -> impl Strategy<Value = OwnedNet> {
    (1..7_usize, 0..4_usize, 0..4_usize, 0..7_usize).prop_flat_map(
        |(places_count, events, outputs, count)| {
            let transitions =
                proptest::collection::vec(transition(places_count, events, outputs), count);
            let laws = proptest::collection::vec(law(places_count), 0..5);
            let texts = (weird_text(), weird_text(), names(count));
            let signals = (signals(events), signals(outputs), ignored(places_count, events));
            (texts, places(places_count), signals, transitions, laws).prop_map(
                |(
                    (name, doc, names),
                    places,
                    (events, outputs, ignored),
                    mut transitions,
                    laws,
                )| {
                    for (transition, name) in transitions.iter_mut().zip(names) {
                        transition.name = name;
                    }
                    OwnedNet { name, doc, places, events, outputs, transitions, ignored, laws }
                },
            )
        },
    )
}

fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(2_000)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_net_comes_back_as_it_was(net in net()) {
        comes_back(&net);
        is_valid(&pnml::write(&net.view().net()));
    }
}

#[test]
fn an_empty_net_comes_back() {
    comes_back(&OwnedNet::default());
}

#[test]
fn a_read_is_not_a_take_that_is_given_back() {
    let mut net = OwnedNet::new("lamp", "");
    let power = net.place(OwnedPlace::new("power", 1)).unwrap();
    let lit = net.place(OwnedPlace::new("lit", 0)).unwrap();
    net.transition(OwnedTransition::new("reads").read(power, 1).give(lit, 1)).unwrap();
    net.transition(OwnedTransition::new("borrows").take(power, 1).give(lit, 1).give(power, 1))
        .unwrap();
    net.transition(OwnedTransition::new("doubles").read(power, 2).give(power, 3)).unwrap();
    comes_back(&net);
}

#[test]
fn the_heaviest_arcs_share_one_inscription() {
    let mut net = OwnedNet::new("heavy", "");
    let place = net.place(OwnedPlace::new("place", u32::MAX)).unwrap();
    net.transition(OwnedTransition::new("t").read(place, u32::MAX).give(place, u32::MAX)).unwrap();
    assert!(pnml::write(&net.view().net()).contains("<text>8589934590</text>"));
    comes_back(&net);
}

#[test]
fn the_written_text_of_a_small_net() {
    let mut net = OwnedNet::new("door", "It opens \"by itself\".");
    let shut = net.place(OwnedPlace::new("shut", 1).at_most(1)).unwrap();
    let open = net.place(OwnedPlace::new(" open\u{1b}", 0)).unwrap();
    let free = net.place(OwnedPlace::new("free", 2)).unwrap();
    let come = net.event("come", "").unwrap();
    net.transition(
        OwnedTransition::new("opens").on(come).take(shut, 1).read(free, 2).give(open, 1),
    )
    .unwrap();
    net.transition(OwnedTransition::new("shuts").within(100, None).take(open, 1).give(shut, 1))
        .unwrap();
    net.laws.push(OwnedLaw::NeverBoth(shut, open));
    let text = pnml::write(&net.view().net());
    cotama_golden::compare("tests/golden/pnml/door.pnml", &text);
    is_valid(&text);
    comes_back(&net);
}

#[test]
fn tina_is_told_when_a_transition_fires() {
    let mut net = OwnedNet::new("times", "");
    let event = net.event("event", "").unwrap();
    net.transition(OwnedTransition::new("at once")).unwrap();
    net.transition(OwnedTransition::new("soon").within(4, Some(9))).unwrap();
    net.transition(OwnedTransition::new("late").within(4, None)).unwrap();
    net.transition(OwnedTransition::new("asked").on(event)).unwrap();
    net.transition(OwnedTransition::new("asked in time").on(event).within(4, Some(9))).unwrap();
    let text = pnml::write_for_tina(&net.view().net());
    let interval = |line: &str| {
        let start = line.strip_prefix(
            "<delay><interval xmlns=\"http://www.w3.org/1998/Math/MathML\" closure=",
        )?;
        start.strip_suffix("</interval></delay>").map(str::to_owned)
    };
    let intervals: Vec<String> = text.lines().filter_map(interval).collect();
    assert_eq!(
        intervals,
        [
            "\"closed\"><cn>0</cn><cn>0</cn>",
            "\"closed\"><cn>4</cn><cn>9</cn>",
            "\"closed-open\"><cn>4</cn><ci>infty</ci>",
            "\"closed-open\"><cn>0</cn><ci>infty</ci>",
            "\"closed-open\"><cn>4</cn><ci>infty</ci>",
        ]
    );
    comes_back(&net);
}
