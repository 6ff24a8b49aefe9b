//! Nets as files of other tools: SCXML, JANI, tables of matrices, JSON.
//!
//! The texts of four small nets stand in `tests/golden/exports`; `UPDATE_GOLDEN=1` writes them
//! anew.

mod laws;
mod nets;
mod properties;
mod random;

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{NetError, Role, TransitionId};
use cotama_verification::drawing::matrix;
use cotama_verification::formats::{jani, json, scxml};
use std::path::Path;

fn check_golden(name: &str, text: &str) {
    cotama_golden::compare(Path::new("tests/golden/exports").join(name), text);
}

/// Compares the content of JSON. That of `odd` is compared letter by letter, for its form.
fn check_content(name: &str, text: &str) {
    check_golden(name, &cotama_golden::json_lines(&serde_json::from_str(text).unwrap()));
}

fn check_all(stem: &str, net: &OwnedNet) {
    let view = net.view();
    let net = view.net();
    assert_eq!(net.defect(), None);
    check_content(&format!("{stem}.jani"), &jani::write(&net));
    check_golden(&format!("{stem}.tsv"), &matrix::write(&net));
    check_content(&format!("{stem}.json"), &json::write(&net));
}

#[test]
fn a_door_with_a_flag_a_counter_and_an_abort_group() {
    let net = nets::door();
    check_all("door", &net);
    check_golden("door.scxml", &scxml::write(&net.view().net()).unwrap());
    assert_eq!(scxml::unkept_intervals(&net.view().net()), Ok(vec![]));
}

#[test]
fn a_timed_light_keeps_the_intervals_that_start_with_a_state_and_reports_the_others() {
    let net = nets::traffic_light();
    check_all("light", &net);
    check_golden("light.scxml", &scxml::write(&net.view().net()).unwrap());
    // `stop early` needs what `ask` changes meanwhile; `extend` needs an event.
    assert_eq!(
        scxml::unkept_intervals(&net.view().net()),
        Ok(vec![TransitionId(3), TransitionId(4)])
    );
}

#[test]
fn a_net_without_events_and_time_waits_for_the_names_of_its_transitions() {
    let net = nets::choice();
    check_all("choice", &net);
    check_golden("choice.scxml", &scxml::write(&net.view().net()).unwrap());
    let ring = |states: u32| {
        let mut net = OwnedNet::new("ring", "");
        let places: Vec<_> = (0..states)
            .map(|it| net.place(OwnedPlace::new(&format!("p{it}"), u32::from(it == 0))).unwrap())
            .collect();
        for (at, &from) in places.iter().enumerate() {
            let to = places[(at + 1) % places.len()];
            let name = format!("t {at}");
            net.transition(OwnedTransition::new(&name).take(from, 1).give(to, 1)).unwrap();
        }
        net
    };
    let stays = || {
        two_states(|net| {
            let a = net.transitions[0].take[0].place;
            net.transition(OwnedTransition::new("error").read(a, 1)).unwrap();
        })
    };
    let counts = || {
        two_states(|net| {
            let (a, b) = (net.transitions[0].take[0].place, net.transitions[0].give[0].place);
            let count = cotama_core::net::PlaceId(2);
            let back = OwnedTransition::new("back").take(b, 1).give(a, 1).give(count, 1);
            net.transition(back).unwrap();
        })
    };
    for net in [net, ring(1), ring(2), ring(20), two_states(|_| ()), stays(), counts()] {
        let view = net.view();
        let all: Vec<_> = (0..net.transitions.len() as u32).map(TransitionId).collect();
        assert_eq!(scxml::waiting(&view.net()), Ok(all), "{}", net.name);
        let text = scxml::write(&view.net()).unwrap();
        let transitions = || text.lines().filter(|it| it.contains("<transition "));
        assert_eq!(transitions().count(), net.transitions.len());
        for (line, transition) in transitions().zip(&net.transitions) {
            assert!(line.contains(" event=\""), "{}: {line}", transition.name);
            // The platform sends `error.communication` and `done.state.x`.
            assert!(!line.contains("event=\"error\"") && !line.contains("event=\"done\""));
        }
    }
}

#[test]
fn transitions_that_would_fire_for_ever_at_the_start_wait_and_others_do_not() {
    let with_event = |change: &dyn Fn(&mut OwnedNet)| {
        two_states(|net| {
            let event = net.event("stop", "").unwrap();
            let end = net.place(OwnedPlace::new("end", 0)).unwrap();
            let a = net.transitions[0].take[0].place;
            let stop = OwnedTransition::new("stop").on(event).take(a, 1).give(end, 1);
            net.transition(stop).unwrap();
            change(net);
        })
    };
    let (a, b, count) =
        (cotama_core::net::PlaceId(0), cotama_core::net::PlaceId(1), cotama_core::net::PlaceId(2));
    let move_ = |name: &str, from, to| OwnedTransition::new(name).take(from, 1).give(to, 1);
    let waits = |change: &dyn Fn(&mut OwnedNet)| -> Vec<u32> {
        let net = with_event(change);
        scxml::waiting(&net.view().net()).unwrap().iter().map(|it| it.0).collect()
    };
    let add = |net: &mut OwnedNet, line: OwnedTransition| {
        net.transition(line).unwrap();
    };
    // `go` alone leads to `b` and rests.
    assert_eq!(waits(&|_| ()), [0; 0]);
    // There and back.
    assert_eq!(waits(&|net| add(net, move_("back", b, a))), [0, 2]);
    // Once there, round and round.
    assert_eq!(waits(&|net| add(net, move_("turn", b, b))), [2]);
    // A timer of no time is no rest.
    assert_eq!(waits(&|net| add(net, move_("back", b, a).within(0, Some(5)))), [0, 2]);
    // A timer of some time is.
    assert_eq!(waits(&|net| add(net, move_("back", b, a).within(1, Some(5)))), [0; 0]);
    // Counting without an end.
    let grows = |net: &mut OwnedNet| {
        net.places[2].bound = cotama_core::net::Place::UNBOUNDED;
        let more = OwnedTransition::new("more").read(b, 1).give(count, 1);
        net.transition(more).unwrap();
    };
    assert_eq!(waits(&grows), [2]);
    // Counting down ends by itself.
    let falls = |net: &mut OwnedNet| {
        net.places[2].initial = 5;
        let less = OwnedTransition::new("less").read(b, 1).take(count, 1);
        net.transition(less).unwrap();
    };
    assert_eq!(waits(&falls), [0; 0]);
}

#[test]
fn philosophers_are_several_machines() {
    let net = nets::philosophers(3);
    check_all("philosophers", &net);
    assert_eq!(
        refusal(&net),
        "more than one token in the states at the start (1 in `fork_0`, 1 in `fork_1`, 1 in \
         `fork_2`, 1 in `thinks_0`, 1 in `thinks_1`, 1 in `thinks_2`): there must be exactly one"
    );
}

#[test]
fn a_producer_and_a_consumer_with_weights_and_reads() {
    let net = nets::producer_consumer();
    check_all("producer_consumer", &net);
    assert_eq!(
        refusal(&net),
        "transition `pack` takes or reads no state: it must take or read exactly one"
    );
}

fn refusal(net: &OwnedNet) -> String {
    scxml::write(&net.view().net()).unwrap_err().to_string()
}

/// Two states and the transition `go` from the first; `change` is what each case alters.
fn two_states(change: impl FnOnce(&mut OwnedNet)) -> OwnedNet {
    let mut net = OwnedNet::new("two", "");
    let a = net.place(OwnedPlace::new("a", 1)).unwrap();
    let b = net.place(OwnedPlace::new("b", 0)).unwrap();
    let count = net.place(OwnedPlace::new("count", 0).at_most(5)).unwrap();
    net.places[count.0 as usize].role = Role::Data;
    net.transition(OwnedTransition::new("go").take(a, 1).give(b, 1)).unwrap();
    change(&mut net);
    net
}

#[test]
fn a_net_that_is_no_state_machine_is_refused_with_the_reason() {
    let net = two_states(|_| ());
    assert!(scxml::write(&net.view().net()).is_ok());
    let net = two_states(|net| net.places[0].initial = 0);
    assert_eq!(refusal(&net), "no state has a token at the start: exactly one must");
    let net = two_states(|net| net.transitions[0].take.clear());
    assert_eq!(
        refusal(&net),
        "transition `go` takes or reads no state: it must take or read exactly one"
    );
    let net = two_states(|net| net.transitions[0].read = net.transitions[0].give.clone());
    assert_eq!(
        refusal(&net),
        "transition `go` takes or reads `a`, `b`: it must take or read exactly one"
    );
    let net = two_states(|net| net.transitions[0].give.clear());
    assert_eq!(
        refusal(&net),
        "transition `go` takes `a` and gives no state: it must give exactly one"
    );
    let net =
        two_states(|net| net.transitions[0].read = std::mem::take(&mut net.transitions[0].take));
    assert_eq!(
        refusal(&net),
        "transition `go` reads `a` and gives `b`: it must take `a` to leave it"
    );
    let net = two_states(|net| net.transitions[0].give[0].weight = 2);
    assert_eq!(
        refusal(&net),
        "transition `go` needs or gives more than one token of `b`, which is a state"
    );
    let net = two_states(|net| net.transitions[0].give[0].weight = 0);
    assert_eq!(
        scxml::write(&net.view().net()),
        Err(scxml::NotAStateMachine::Defect(NetError::Arcs { transition: 0 }))
    );
}

#[test]
fn a_complement_has_to_be_one() {
    let complemented = |of, change: fn(&mut OwnedNet)| {
        two_states(|net| {
            net.places[0].bound = 1;
            let it = &net.places[of as usize];
            let place = OwnedPlace::new("rest", it.bound - it.initial).at_most(it.bound);
            let role = Role::Complement(cotama_core::net::PlaceId(of));
            net.place(OwnedPlace { role, ..place }).unwrap();
            change(net);
        })
    };
    assert_eq!(
        refusal(&complemented(0, |_| ())),
        "place `rest` is the complement of `a`, which is neither data nor shared"
    );
    let uneven = complemented(2, |net| {
        let transition = net.transitions[0].clone();
        net.transitions[0] = transition.give(cotama_core::net::PlaceId(2), 1);
    });
    assert_eq!(
        refusal(&uneven),
        "transition `go` changes `rest` and what it complements, but not by opposite numbers"
    );
}

#[test]
fn odd_names_become_identifiers_and_stay_readable() {
    let mut net = OwnedNet::new("", "a --> b <!-- ---");
    let places = ["a\"b<&>", "a b", "a_b", "\u{1}\n--", "if", "Ω"]
        .map(|name| net.place(OwnedPlace::new(name, 0)).unwrap());
    net.places[0].initial = 1;
    net.places[4].role = Role::Data;
    let events = ["door.open", "door open", "door_open"].map(|name| net.event(name, "").unwrap());
    for (event, place) in events.into_iter().zip(&places[1..]) {
        net.transition(OwnedTransition::new("-- \t?").on(event).take(places[0], 1).give(*place, 1))
            .unwrap();
    }
    net.transitions[0] = net.transitions[0].clone().give(places[4], 1).read(places[4], 2);
    let view = net.view();
    check_golden("odd.scxml", &scxml::write(&view.net()).unwrap());
    check_golden("odd.jani", &jani::write(&view.net()));
    check_golden("odd.tsv", &matrix::write(&view.net()));
    check_golden("odd.json", &json::write(&view.net()));
}

/// The error of the text of the door with one change, and its message.
fn json_error(from: &str, to: &str) -> json::Wrong {
    let text = json::write(&nets::door().view().net());
    assert!(text.contains(from), "{from}");
    json::read(&text.replacen(from, to, 1)).unwrap_err()
}

fn json_refusal(from: &str, to: &str) -> String {
    json_error(from, to).message
}

#[test]
fn json_that_is_no_net_is_refused_with_the_reason() {
    assert_eq!(
        json_refusal("cotama/net/1", "cotama/net/2"),
        "`schema` is `cotama/net/2`, but a net has `cotama/net/1`"
    );
    assert_eq!(
        json_error("\"priority\": 10", "\"priority\": 1.5").to_string(),
        "line 291, column 21: a whole number is needed here, not 1.5"
    );
    assert_eq!(
        json_error("\"priority\": 0", "\"prioriti\": 0").to_string(),
        "line 134, column 16: unknown key `prioriti`; known: `name`, `doc`, `line`, \
         `on`, `take`, `read`, `give`, `emits`, `within`, `priority`"
    );
    assert_eq!(
        json_error("\"initial\": 1,", "").to_string(),
        "line 12, column 5: `initial` is missing"
    );
    assert_eq!(
        json_refusal("\"name\": \"moving\"", "\"name\": \"closed\""),
        "two places are named `closed`"
    );
    assert_eq!(
        json_refusal("\"on\": \"press\"", "\"on\": \"pres\""),
        "transition `start` names the event `pres`, which the net does not have"
    );
    assert_eq!(
        json_refusal("\"emits\": [\n        \"motor on\"", "\"emits\": [\n        \"motor\""),
        "transition `start` names the output `motor`, which the net does not have"
    );
    assert_eq!(
        json_refusal("\"complement\": \"locked\"", "\"complement\": \"lock\""),
        "place `not locked` names the place `lock`, which the net does not have"
    );
    assert_eq!(
        json_refusal("\"reachable\": \"worn out\"", "\"reachable\": \"worn\""),
        "entry 3 of `laws` names the place `worn`, which the net does not have"
    );
    assert_eq!(
        json_refusal("\"event\": \"key\"", "\"event\": \"\""),
        "entry 1 of `ignored` names the event ``, which the net does not have"
    );
    let guard = "\"guard\": [\n        {\n          \"place\": \"";
    assert_eq!(
        json_refusal(&format!("{guard}locked"), &format!("{guard}lock")),
        "entry 2 of `ignored` names the place `lock`, which the net does not have"
    );
    assert_eq!(
        json_refusal(&format!("{guard}locked"), &format!("{guard}cycles left")),
        "a law, or an entry of `ignored`, has an arc of weight 0, or a place twice in one sum or \
         guard"
    );
    assert_eq!(
        json_refusal("\"weight\": 1", "\"weight\": 0"),
        "transition `start` has an arc of weight 0, or names a place twice in `give`, or in `take` \
         and `read` together"
    );
    assert_eq!(
        json_refusal("\"initial\": 1", "\"initial\": 2"),
        "place `closed` has more tokens at the start than its bound, or does not sum to the bound \
         with the place that it complements"
    );
    assert_eq!(
        json_refusal("\"within\": null", "\"within\": { \"earliest\": 2, \"latest\": 1 }"),
        "transition `start` has an interval that ends before it begins, or after 4294967294 ms"
    );
    let misnamed = json_error("\"on\": \"press\"", "\"on\": \"pres\"");
    assert_eq!(misnamed.help.as_deref(), Some("did you mean `press`?"));
    let text = json::write(&nets::door().view().net());
    let line = text.lines().position(|it| it.contains("\"on\": \"press\"")).unwrap() + 1;
    assert_eq!(misnamed.line, line);
    assert_eq!(json::read("").unwrap_err().to_string(), "line 1, column 1: the file is empty");
    assert_eq!(
        json::read(&"[".repeat(100_000)).unwrap_err().to_string(),
        "line 1, column 1: a list stands where an object is needed"
    );
}

#[test]
fn json_beyond_the_limits_is_refused() {
    let long = " ".repeat(json::MAX_BYTES + 1);
    let error = json::read(&long).unwrap_err().to_string();
    assert_eq!(
        error,
        "line 1, column 1: the text has 67108865 bytes, more than the 67108864 that are read"
    );
    let mut net = OwnedNet::new("wide", "");
    let mut transition = OwnedTransition::new("t");
    for i in 0..=json::MAX_ARCS {
        let place = net.place(OwnedPlace::new(&i.to_string(), 0)).unwrap();
        transition = transition.give(place, 1);
    }
    net.transition(transition).unwrap();
    let error = json::read(&json::write(&net.view().net())).unwrap_err();
    assert_eq!(error.message, "transition `t` has more than 1000 arcs");
    net.transitions[0].give.pop();
    assert_eq!(json::read(&json::write(&net.view().net())), Ok(net));
}
