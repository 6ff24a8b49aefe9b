//! Drawings of small nets, byte for byte, and what holds for drawings of any net.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test nets drawings` writes the expected
//! files anew.

mod nets;
pub(crate) mod xml;

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, Role, TransitionId};
use cotama_verification::drawing::figure::Style;
use cotama_verification::drawing::svg;
use cotama_verification::drawing::svg::Highlight;
use cotama_verification::formats::{dot, mermaid};
use proptest::prelude::*;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use xml::Element;

/// Compares with a file of `tests/golden/drawings`.
fn golden(file: &str, text: &str) {
    cotama_golden::compare(Path::new("tests/golden/drawings").join(file), text);
}

fn all_formats(name: &str, net: &OwnedNet, style: Style) {
    let view = net.view();
    let net = view.net();
    assert_eq!(net.defect(), None);
    golden(&format!("{name}.svg"), &svg::write(&net, style));
    golden(&format!("{name}.dot"), &dot::write(&net, style));
    golden(&format!("{name}.mmd"), &mermaid::write(&net, style));
}

#[test]
fn a_door_is_a_state_diagram_with_one_arrow_for_the_stop() {
    all_formats("door", &nets::door(), Style::Auto);
}

#[test]
fn a_crossing_is_drawn_as_states_and_on_request_as_a_net() {
    all_formats("crossing", &nets::crossing(), Style::Auto);
    all_formats("crossing-net", &nets::crossing(), Style::Net);
}

#[test]
fn philosophers_are_no_state_machine_whatever_is_asked_for() {
    let net = nets::philosophers();
    let view = net.view();
    for style in [Style::States, Style::Auto] {
        let net = view.net();
        assert_eq!(svg::write(&net, style), svg::write(&net, Style::Net));
        assert_eq!(dot::write(&net, style), dot::write(&net, Style::Net));
        assert_eq!(mermaid::write(&net, style), mermaid::write(&net, Style::Net));
    }
}

#[test]
fn crates_show_weights_read_arcs_and_a_shared_place() {
    all_formats("crates", &nets::crates(), Style::Auto);
}

#[test]
fn odd_names_are_escaped() {
    all_formats("odd", &nets::odd(), Style::Auto);
    all_formats("odd-net", &nets::odd(), Style::Net);
}

#[test]
fn a_supervisor_of_seven_states_is_a_state_diagram() {
    all_formats("supervisor", &nets::supervisor(), Style::Auto);
}

#[test]
fn an_empty_net_is_an_empty_drawing() {
    let net = OwnedNet::new("", "");
    check_svg(&svg::write(&net.view().net(), Style::Auto));
    assert_eq!(mermaid::write(&net.view().net(), Style::Auto), "flowchart TB\n");
}

/// The label between two states in DOT.
fn dot_edges(net: &OwnedNet) -> Vec<String> {
    let text = dot::write(&net.view().net(), Style::Auto);
    text.lines().filter(|line| line.contains("->")).map(|line| line.trim().to_owned()).collect()
}

#[test]
fn a_complement_reads_as_a_negated_guard_and_a_change_as_an_assignment() {
    let edges = dot_edges(&nets::crossing());
    let expected = [
        "start -> p0;",
        "p0 -> p0 [label=\"button [!wanted] / lamp_on, wanted := true\"];",
        "p0 -> p1 [label=\"[wanted] / amber  10000..20000 ms\"];",
        "p1 -> p2 [label=\"[wanted] / red, walk, wanted := false  3000 ms\"];",
        "p2 -> p3 [label=\"/ stop  8000 ms\"];",
        "p3 -> p0 [label=\"/ green  2000..2500 ms\"];",
    ];
    assert_eq!(edges, expected);
}

#[test]
fn both_values_of_a_flag_on_one_line_are_one_label() {
    let mut it = nets::Sketch::new("lamp", "");
    let here = it.state("here", 1, "");
    let (lit, dark) = it.flag("lit", Role::Data, false);
    let other = it.flag("other", Role::Data, false).0;
    let line = it.step(here, here, "light", &[]).line;
    it.net.transitions[0] = it.net.transitions[0].clone().take(dark, 1).give(lit, 1);
    it.step(here, here, "light", &[]).line = line;
    it.net.transitions[1] = it.net.transitions[1].clone().read(lit, 1);
    assert_eq!(dot_edges(&it.net), ["start -> p0;", "p0 -> p0 [label=\"light / lit := true\"];"]);
    // A transition that depends on the flag beside the flag itself keeps the two apart.
    it.net.transitions[1] = it.net.transitions[1].clone().give(other, 1);
    let apart = r#"p0 -> p0 [label="light [!lit] / lit := true\nlight [lit] / other += 1"];"#;
    it.net.places[other.0 as usize].bound = 5;
    assert_eq!(dot_edges(&it.net), ["start -> p0;", apart]);
}

#[test]
fn counters_read_as_comparisons() {
    let mut it = nets::Sketch::new("tries", "");
    let (from, to) = (it.state("from", 1, ""), it.state("to", 0, ""));
    let tries = it
        .net
        .place(OwnedPlace { role: Role::Data, ..OwnedPlace::new("tries", 0).at_most(3) })
        .unwrap();
    let left =
        OwnedPlace { role: Role::Complement(tries), ..OwnedPlace::new("left", 3).at_most(3) };
    let left = it.net.place(left).unwrap();
    let add = |it: &mut nets::Sketch,
               more: fn(OwnedTransition, PlaceId, PlaceId) -> OwnedTransition| {
        it.step(from, to, "", &[]);
        let last = it.net.transitions.last_mut().unwrap();
        *last = more(last.clone(), tries, left);
    };
    add(&mut it, |step, tries, _| step.read(tries, 2));
    add(&mut it, |step, _, left| step.read(left, 3));
    add(&mut it, |step, tries, left| step.read(tries, 2).read(left, 1));
    add(&mut it, |step, tries, left| step.read(tries, 1).read(left, 1));
    add(&mut it, |step, tries, left| step.take(left, 1).give(tries, 1));
    add(&mut it, |step, tries, left| step.take(tries, 2).give(left, 2));
    let labels = "[tries ≥ 2]\\n[tries ≤ 0]\\n[tries = 2]\\n[1 ≤ tries ≤ 2]\\n[tries ≤ 2] / tries \
        += 1\\n\
                  [tries ≥ 2] / tries -= 2";
    assert_eq!(
        dot_edges(&it.net),
        ["start -> p0;".to_owned(), format!("p0 -> p1 [label=\"{labels}\"];")]
    );
}

#[test]
fn a_net_that_is_no_state_machine_is_drawn_as_a_net() {
    let is_states = |net: &OwnedNet| {
        mermaid::write(&net.view().net(), Style::States).starts_with("stateDiagram")
    };
    assert!(is_states(&nets::door()));
    let mut second_token = nets::door();
    second_token.places[1].initial = 1;
    assert!(!is_states(&second_token));
    let mut heavy = nets::door();
    heavy.transitions[0].give[0].weight = 2;
    assert!(!is_states(&heavy));
    let mut mailbox = nets::door();
    mailbox.places.push(OwnedPlace { role: Role::Mailbox, ..OwnedPlace::new("inbox", 0) });
    assert!(!is_states(&mailbox));
    let mut stateless = nets::door();
    stateless.transitions.push(OwnedTransition::new("anywhere"));
    assert!(!is_states(&stateless));
}

#[test]
fn a_marking_and_a_transition_are_pointed_out() {
    let net = nets::crates();
    let (view, transitions) = (net.view(), [TransitionId(1)]);
    let marking = [0, 1, 5, 7, 2, 0, 1, 8];
    let highlight = Highlight { marking: Some(&marking), transitions: &transitions, places: None };
    let text = svg::write_highlighted(&view.net(), Style::Auto, &highlight);
    golden("crates-highlighted.svg", &text);
    assert!(text.contains("<g id=\"place-1\" class=\"place hot\">"));
    assert!(text.contains("<g id=\"place-0\" class=\"place\">"));
    assert!(text.contains("<g id=\"transition-1\" class=\"transition hot\">"));
    assert!(text.contains("<g id=\"transition-0\" class=\"transition\">"));
    // Places that are chosen are coloured in place of those that are marked.
    let highlight = Highlight { places: Some(&[PlaceId(0)]), ..highlight };
    let text = svg::write_highlighted(&view.net(), Style::Auto, &highlight);
    assert!(text.contains("<g id=\"place-0\" class=\"place hot\">"));
    assert!(text.contains("<g id=\"place-1\" class=\"place\">"));
    // A marking that is too short leaves the other places empty.
    check_svg(&svg::write_highlighted(
        &view.net(),
        Style::Auto,
        &Highlight { marking: Some(&[1]), ..Highlight::default() },
    ));
}

#[test]
fn a_large_net_has_few_bars_with_every_transition_at_one_of_them() {
    let net = &cotama_models::nets::ace::selection::NET;
    assert_eq!(net.transitions.len(), 61);
    let of = |text: &str| {
        let elements = check_svg(text);
        let count = |class: &str| {
            elements.iter().filter(|it| it.get("class").is_some_and(|it| it == class)).count()
        };
        (count("transition"), count("place"), elements[0].number("width"))
    };
    let text = svg::write(net, Style::Auto);
    let (bars, places, width) = of(&text);
    let (all, _, wide) = of(&svg::write(net, Style::Net));
    assert_eq!((all, places), (61, 9), "data are words");
    assert!(bars <= 12 && width < 2000 && wide > 4 * width, "{bars} bars, {width} of {wide}");
    for it in net.transitions {
        let line = it.name.split('.').next().unwrap();
        let bars = text.split("class=\"transition\"><title>").skip(1);
        let titles: Vec<&str> = bars.map(|it| it.split("</title>").next().unwrap()).collect();
        let says = |title: &str, name: &str| {
            title.split("&#10;").any(|it| it.split(':').next() == Some(name))
        };
        let at = |name: &str| titles.iter().filter(|it| says(it, name)).count();
        assert_eq!(at(it.name), 1, "{}", it.name);
        assert!(text.contains(&format!("<tspan class=\"strong\">{line}</tspan>")), "{line}");
        let is_made = it.name != line;
        assert!(!is_made || !text.contains(&format!("strong\">{}</tspan>", it.name)));
    }
    let lines = net.transitions.iter().map(|it| it.name.split('.').next().unwrap());
    for text in [dot::write(net, Style::Auto), mermaid::write(net, Style::Auto)] {
        assert!(lines.clone().all(|it| text.contains(it)), "{text}");
    }
}

/// Well-formed, ids once, all shapes in the picture, no two nodes on each other. Returns the
/// elements.
fn check_svg(text: &str) -> Vec<Element> {
    let elements = xml::parse(text).unwrap_or_else(|error| panic!("{error}:\n{text}"));
    let mut ids: Vec<&str> = elements.iter().filter_map(|it| it.get("id")).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "an id occurs twice");
    let (width, height) = (elements[0].number("width"), elements[0].number("height"));
    let inside = |x: i64, y: i64| {
        assert!((0..=width).contains(&x) && (0..=height).contains(&y), "{x} {y} is outside");
    };
    let mut boxes: Vec<[i64; 4]> = Vec::new();
    for it in &elements {
        let class = it.get("class").unwrap_or_default();
        let shape = match it.name.as_str() {
            "rect" if class != "paper" => {
                let (x, y) = (it.number("x"), it.number("y"));
                [x, y, x + it.number("width"), y + it.number("height")]
            }
            "circle" => {
                let (x, y, r) = (it.number("cx"), it.number("cy"), it.number("r"));
                [x - r, y - r, x + r, y + r]
            }
            "text" => {
                inside(it.number("x"), it.number("y"));
                continue;
            }
            "path" => {
                let numbers = it
                    .get("d")
                    .unwrap_or_default()
                    .split(|c: char| !c.is_ascii_digit() && c != '-');
                numbers
                    .filter(|it| !it.is_empty())
                    .for_each(|it| assert!(it.parse::<i64>().is_ok_and(|it| it >= 0)));
                continue;
            }
            _ => continue,
        };
        inside(shape[0], shape[1]);
        inside(shape[2], shape[3]);
        if it.name == "rect" || class == "rim" {
            boxes.push(shape);
        }
    }
    for (at, one) in boxes.iter().enumerate() {
        for other in &boxes[..at] {
            let apart = one[2] <= other[0]
                || other[2] <= one[0]
                || one[3] <= other[1]
                || other[3] <= one[1];
            assert!(apart, "{one:?} and {other:?} overlap");
        }
    }
    elements
}

/// Any net: roles, weights and ids as they come, some of them out of range.
fn any_net(size: usize) -> impl Strategy<Value = OwnedNet> {
    let name = prop_oneof!["[a-z]{0,12}", "\\PC{0,8}", any::<String>()];
    let role = prop_oneof![
        4 => Just(Role::State),
        2 => Just(Role::Data),
        1 => Just(Role::Shared),
        1 => Just(Role::Mailbox),
        1 => (0..size as u32).prop_map(|at| Role::Complement(PlaceId(at))),
    ];
    let place = (name, 0..7_u32, role);
    let arcs = || proptest::collection::vec((0..size as u32 + 1, 0..4_u32), 0..4);
    let transition = (arcs(), arcs(), arcs(), proptest::option::of(any::<(u32, Option<u32>)>()));
    let places = proptest::collection::vec(place, 0..size);
    (places, proptest::collection::vec(transition, 0..size)).prop_map(|(places, transitions)| {
        let mut net = OwnedNet::new("any", "net");
        for (name, initial, role) in places {
            net.place(OwnedPlace { role, ..OwnedPlace::new(&name, initial).at_most(6) }).unwrap();
        }
        for (take, read, give, within) in transitions {
            let mut it = OwnedTransition::new("t");
            it = take.into_iter().fold(it, |it, (place, weight)| it.take(PlaceId(place), weight));
            it = read.into_iter().fold(it, |it, (place, weight)| it.read(PlaceId(place), weight));
            it = give.into_iter().fold(it, |it, (place, weight)| it.give(PlaceId(place), weight));
            if let Some((earliest, latest)) = within {
                it = it.within(earliest, latest);
            }
            net.transition(it).unwrap();
        }
        net
    })
}

/// Any state machine over a few events, with some edges to the same state.
fn any_states(size: u32) -> impl Strategy<Value = OwnedNet> {
    let edge = (0..size, 0..size, 0..5_usize, proptest::collection::vec(0..6_usize, 0..5));
    proptest::collection::vec(edge, 0..3 * size as usize).prop_map(move |edges| {
        let mut it = nets::Sketch::new("states", "");
        let states: Vec<PlaceId> =
            (0..size).map(|at| it.state(&format!("State{at}"), u32::from(at == 0), "")).collect();
        let events = ["", "go", "some_event", "an_event_with_a_long_name", "e"];
        let outputs = ["a", "stop_robot", "op_request", "run_path_planner", "x", "y"];
        for (from, to, event, emits) in edges {
            let emits: Vec<&str> = emits.into_iter().map(|at| outputs[at]).collect();
            it.step(states[from as usize], states[to as usize], events[event], &emits);
        }
        it.net
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_net_gives_a_sound_drawing_and_the_same_one_twice(net in any_net(14)) {
        let (view, again) = (net.view(), net.clone());
        let again = again.view();
        for style in [Style::Auto, Style::Net, Style::States] {
            let text = svg::write(&view.net(), style);
            check_svg(&text);
            prop_assert_eq!(text, svg::write(&again.net(), style));
            prop_assert_eq!(dot::write(&view.net(), style), dot::write(&again.net(), style));
            prop_assert_eq!(
                mermaid::write(&view.net(), style),
                mermaid::write(&again.net(), style)
            );
        }
    }

    #[test]
    fn any_state_machine_is_drawn_with_all_its_states(net in any_states(9)) {
        let elements = check_svg(&svg::write(&net.view().net(), Style::Auto));
        let states = elements.iter().filter(|it| it.get("class") == Some("state"));
        prop_assert_eq!(states.count(), 9);
    }
}

#[test]
fn a_net_of_hundreds_of_nodes_is_drawn() {
    let mut it = nets::Sketch::new("large", "");
    let states: Vec<PlaceId> =
        (0..300).map(|at| it.state(&format!("S{at}"), u32::from(at == 0), "")).collect();
    for at in 0..600_usize {
        let to = (at * at * 7 + 13 * at + 1) % states.len();
        it.step(states[at % states.len()], states[to], "event", &["output"]);
    }
    check_svg(&svg::write(&it.net.view().net(), Style::States));
    check_svg(&svg::write(&it.net.view().net(), Style::Net));
}

#[test]
fn a_net_beyond_all_limits_is_drawn() {
    let mut it = nets::Sketch::new("chain", "");
    let states: Vec<PlaceId> =
        (0..500).map(|at| it.state(&format!("S{at}"), u32::from(at == 0), "")).collect();
    for at in 1..states.len() {
        it.step(states[at - 1], states[at], "on", &[]);
        it.step(states[at], states[at / 3], &format!("back{at}"), &[]);
    }
    check_svg(&svg::write(&it.net.view().net(), Style::States));
}

#[test]
fn graphviz_reads_the_written_graphs() {
    if !cotama_golden::has_tool("dot", "DOT files") {
        return;
    }
    let nets = [
        nets::door(),
        nets::crossing(),
        nets::philosophers(),
        nets::crates(),
        nets::odd(),
        nets::supervisor(),
    ];
    for net in nets {
        for style in [Style::Net, Style::States] {
            let text = dot::write(&net.view().net(), style);
            let mut dot = Command::new("dot");
            dot.arg("-Tcanon").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
            let mut child = dot.spawn().unwrap();
            child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
            let output = child.wait_with_output().unwrap();
            let complaints = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && complaints.is_empty(), "{complaints}\n{text}");
        }
    }
}
