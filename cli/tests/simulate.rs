//! `cotama simulate`: nets in play.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

fn simulate(name: &str, arguments: &[&str], code: i32) -> Value {
    let folder = Folder::new(&format!("simulate_{name}"));
    folder.cotama(&[&["simulate"], arguments, &["--json"]].concat()).json(code)
}

#[test]
fn the_screens_of_simulations() {
    let folder = Folder::new("simulate_screens");
    let screens: [(&str, &[&str]); 8] = [
        ("door", &["door", "Call", "EndOpen", "+5000", "EndOpen", "Obstacle@5200"]),
        ("crossing", &["crossing", "Button", "+30000"]),
        ("crossing_rounds", &["crossing", "--rounds", "Button,Button", "+10000", "+3000"]),
        ("philosophers", &["philosophers:3", "left_first_1", "then_right_1", "left_first_2"]),
        ("watchdog", &["watchdog", "Release", "+100", "Release", "Done"]),
        ("nothing", &["contextual"]),
        ("delivery", &["delivery", "gs.mission_received", "ls.Planning_done", "faults.fail_BMP1"]),
        ("delivery_rounds", &["delivery", "--rounds", "gs.mission_received", "+100", "+100"]),
    ];
    for (name, arguments) in screens {
        let ended = folder.cotama(&[&["simulate"], arguments].concat());
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{name}");
        golden(&format!("simulate_{name}.txt"), &ended.stdout);
    }
}

#[test]
fn a_door_opens_and_closes_by_itself() {
    let answer = simulate("door", &["door", "Call", "EndOpen@2000", "+5000"], 0);
    assert_eq!(answer["fired"], json!(["call", "opened", "close"]));
    assert_eq!((&answer["time_ms"], &answer["marking"]["Closing"]), (&json!(7_000), &json!(1)));
    let last = json!({ "time_ms": 7_000, "events": [], "fired": ["close"], "ignored": [],
        "emitted": ["DriveClosed"],
        "changed": [{ "place": "Open", "tokens": 0 }, { "place": "Closing", "tokens": 1 }] });
    assert_eq!(answer["steps"][2], last);
    assert_eq!(answer["enabled"][0], json!({ "event": "Call", "transition": "reopen" }));
    assert_eq!(answer["deadline"], Value::Null);
}

#[test]
fn immediate_firings_belong_to_the_step_that_caused_them() {
    let answer = simulate("settles", &["crossing", "Button", "+10000"], 0);
    assert_eq!(answer["steps"][1]["fired"], json!(["served", "warn"]));
    assert_eq!(answer["deadline"], json!({ "time_ms": 13_000, "transition": "red" }));
}

#[test]
fn an_ignored_event_is_no_error_unless_it_is_said_to_be() {
    for (strict, code) in [(&[][..], 0), (&["--strict"], 1)] {
        let answer = simulate("ignored", &[&["door", "EndOpen", "Call"], strict].concat(), code);
        assert_eq!((&answer["ignored"], &answer["fired"]), (&json!(1), &json!(["call"])));
        let refusal = json!({ "event": "EndOpen", "reason": "on_purpose",
            "text": "ignored on purpose in Closed" });
        assert_eq!(answer["steps"][0]["ignored"], json!([refusal]));
    }
}

/// A lamp that can be switched off from 100 ms to 200 ms after it was switched on, and three times
/// at most.
fn lamp() -> Value {
    let arc = |place: &str| json!([{ "place": place, "weight": 1 }]);
    let transition = |name: &str, take: &str, give: Value, within: Value| {
        json!({ "name": name, "doc": "", "line": 0, "on": name, "take": arc(take), "read": [],
            "give": give, "emits": [], "within": within, "priority": 0 })
    };
    let place = |name: &str, initial: u32, bound: u32| {
        json!({
            "name": name, "doc": "", "initial": initial, "bound": bound, "role": "state"
        })
    };
    json!({ "schema": "cotama/net/\
        1", "name": "lamp", "doc": "", "outputs": [], "ignored": [], "laws": [],
        "places": [place("dark", 1, 1), place("lit", 0, 1), place("count", 0, 3)],
        "events": [{ "name": "on", "doc": "" }, { "name": "off", "doc": "" }],
        "transitions": [
            transition("on", "dark", json!([
                { "place": "lit", "weight": 1 }, { "place": "count", "weight": 2 }
            ]),
                Value::Null),
            transition("off", "lit", arc("dark"), json!({ "earliest": 100, "latest": 200 })),
        ] })
}

#[test]
fn it_is_said_why_an_event_is_ignored() {
    let folder = Folder::new("simulate_why");
    folder.write("lamp.json", lamp().to_string());
    let words = ["off", "on", "off@99", "off@100", "on"];
    let answer =
        folder.cotama(&[&["simulate", "lamp.json", "--json"], &words[..]].concat()).json(0);
    let why = |step: usize| {
        let ignored = &answer["steps"][step]["ignored"][0];
        (ignored["reason"].as_str().unwrap(), ignored["text"].as_str().unwrap())
    };
    assert_eq!(why(0), ("not_enabled", "`off` needs lit"));
    assert_eq!(
        why(2),
        ("too_early", "too early: `off` fires on it 100 to 200 ms after it is enabled")
    );
    assert_eq!(why(4), ("full", "`on` would put more than 3 tokens into count"));
    let late = folder.cotama(&["simulate", "lamp.json", "--json", "on", "off@201"]).json(0);
    assert_eq!(late["steps"][1]["ignored"][0]["reason"], "too_late");
}

#[test]
fn transitions_of_a_plain_net_are_fired_by_name() {
    let answer = simulate("plain", &["philosophers:2", "left_first_1", "left_first_2", "end_1"], 0);
    assert_eq!((&answer["by_name"], &answer["enabled"]), (&json!(true), &json!([])));
    assert_eq!(answer["fired"], json!(["left_first_1", "left_first_2"]));
    assert_eq!(answer["marking"]["with_left_2"], 1);
}

#[test]
fn a_round_offers_several_events_at_once() {
    let folder = Folder::new("simulate_rounds");
    let json = |arguments: &[&str]| {
        folder.cotama(&[&["simulate", "--json", "--rounds"], arguments].concat()).json(0)
    };
    // Both need the fork between them.
    let answer = json(&["philosophers:2", "left_first_1,right_first_2"]);
    let step = &answer["steps"][0];
    assert_eq!(step["events"], json!(["left_first_1", "right_first_2"]));
    assert_eq!(step["fired"], json!(["left_first_1"]));
    assert_eq!(step["ignored"][0]["text"], "others of the round took what it needs");
    // A transition enabled by another one fires in the next round only.
    let answer = json(&["crossing", "Button", "+10000", "+0"]);
    assert_eq!(answer["fired"], json!(["press.Stop.request_0", "served", "warn"]));
    assert_eq!(answer["steps"][1]["fired"], json!(["served"]));
}

#[test]
fn events_come_one_a_line_from_standard_input() {
    let folder = Folder::new("simulate_lines");
    folder.write("events.txt", "# A visitor.\nCall\n\n  EndOpen@2000\r\n+5000\n");
    let piped = folder.shell("cotama simulate door < events.txt");
    let said = folder.cotama(&["simulate", "door", "Call", "EndOpen@2000", "+5000"]);
    assert_eq!((piped.code, piped.stdout), (said.code, said.stdout));
    let both = folder.shell("cotama export door --format pnml | cotama simulate - Call --json");
    assert_eq!(both.json(0)["fired"], json!(["call"]));
}

#[test]
fn a_door_is_played_by_hand() {
    let folder = Folder::new("simulate_hand");
    let lines = [
        "2", "Call", "E", "EndO", "+5000", "marking", "foo", "back", "back", "back", "back",
        "back", "help", "quit", "Call",
    ];
    folder.write("lines", lines.join("\n"));
    let ended = folder.shell("cotama simulate door --interactive < lines 2>&1");
    assert_eq!(ended.code, Some(0));
    golden("simulate_by_hand.txt", &ended.stdout);
    let ended = folder.shell("printf 'Call' | cotama simulate door -i");
    assert!(ended.code == Some(0) && ended.stdout.ends_with("> \n"), "{ended:?}");
}

#[test]
fn a_net_that_does_not_come_to_rest_is_stopped() {
    let folder = Folder::new("simulate_endless");
    let mut net = lamp();
    // From `lit` and back to it, at any time from now on: at once, and for ever.
    net["transitions"][1]["on"] = Value::Null;
    net["transitions"][1]["within"] = json!({ "earliest": 0, "latest": null });
    net["transitions"][1]["give"] = json!([{ "place": "lit", "weight": 1 }]);
    folder.write("spin.json", net.to_string());
    let answer = folder.cotama(&["simulate", "spin.json", "--json", "on", "+1"]).json(3);
    assert_eq!((&answer["complete"], &answer["time_ms"]), (&json!(false), &json!(0)));
    let ended = folder.cotama(&["simulate", "spin.json", "on"]);
    assert!(
        ended.code == Some(3) && ended.stdout.contains("\nstopped: "),
        "{}",
        ended.code.unwrap()
    );
    let ended = folder.shell("printf 'on\nquit' | cotama simulate spin.json -i");
    assert!(
        ended.code == Some(0) && ended.stdout.contains("would fire: not done"),
        "{}",
        ended.stdout
    );
}

#[test]
fn nets_of_any_size_up_to_the_largest_are_played() {
    for n in [2, 10, 40, 150, 600] {
        let model = format!("philosophers:{n}");
        let last = format!("left_first_{n}");
        let answer = simulate("sizes", &[&model, &last], 0);
        assert_eq!(answer["fired"], json!([last]));
        assert_eq!(answer["marking"].as_object().unwrap().len(), 5 * n);
    }
}

#[test]
fn a_line_of_any_length_is_no_harm_by_hand() {
    let folder = Folder::new("simulate_long");
    folder.write("line", "x".repeat(200_000));
    let ended = folder.shell("cotama simulate door -i < line");
    assert_eq!(ended.code, Some(0));
}

#[test]
fn nets_of_a_system_read_their_mail_in_rounds() {
    let answer = simulate("system", &["delivery", "gs.mission_received"], 0);
    let rounds: Vec<_> =
        answer["steps"].as_array().unwrap().iter().map(|it| &it["round"]).collect();
    assert_eq!(rounds, [&Value::Null, &json!(true)]);
    assert_eq!(answer["marking"]["ls.start_drive.waiting"], 0);
    // With --rounds nothing is read before the next word.
    let answer = simulate("system_rounds", &["delivery", "--rounds", "gs.mission_received"], 0);
    assert_eq!(answer["marking"]["ls.start_drive.waiting"], 1);
    let folder = Folder::new("simulate_system_unknown");
    let ended = folder.cotama(&["simulate", "delivery", "mission_received"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("did you mean `gs.mission_received`?"), "{}", ended.stderr);
}
