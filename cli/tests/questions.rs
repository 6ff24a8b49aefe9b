//! What is asked of a model: the wish for no deadlock, one marking or all, and units of time.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

/// Of each answer the name, the question and the verdict.
fn verdicts(answer: &Value) -> Vec<String> {
    let text = |it: &Value| format!("{}; {}; {}", it["name"], it["property"], it["verdict"]);
    answer["results"].as_array().unwrap().iter().map(|it| text(it).replace('"', "")).collect()
}

#[test]
fn deadlock_free_is_the_wish() {
    let folder = Folder::new("questions_wish");
    let ask = ["--property", "deadlock_free", "--certificate", "it.json", "--json"];
    let answer = folder.cotama(&[&["check", "kanban:2"][..], &ask].concat()).json(0);
    assert_eq!(verdicts(&answer), ["deadlock_free; AG !deadlock; true"]);
    assert_eq!(folder.cotama(&["verify", "it.json"]).code, Some(0));
    let answer = folder.cotama(&[&["check", "philosophers:3"][..], &ask].concat()).json(1);
    assert_eq!(verdicts(&answer), ["deadlock_free; AG !deadlock; false"]);
    assert_eq!(folder.cotama(&["verify", "it.json"]).code, Some(0));
    // The same in a file, under its own name or another.
    folder.write("two.txt", "deadlock_free\nmine: deadlock_free\n");
    let answer = folder.cotama(&["check", "kanban:2", "--properties", "two.txt", "--json"]).json(0);
    assert_eq!(
        verdicts(&answer),
        ["deadlock_free; AG !deadlock; true", "mine; AG !deadlock; true"]
    );
}

#[test]
fn deadlock_is_an_atom_and_needs_a_quantifier() {
    let folder = Folder::new("questions_atom");
    let said = folder.cotama(&["check", "kanban:2", "--property", "deadlock"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""));
    golden("bad_property_deadlock.txt", &said.stderr);
    let said = folder.cotama(&["check", "kanban:2", "--property", " P1 = 2"]);
    assert_eq!(said.code, Some(2));
    golden("bad_property_state.txt", &said.stderr);
    folder.write("wanted.txt", "EF deadlock\nfirst: deadlock\n");
    let said = folder.cotama(&["check", "kanban:2", "--properties", "wanted.txt"]);
    assert_eq!(said.code, Some(2));
    golden("bad_property_file_state.txt", &said.stderr);
    for (property, code) in
        [("deadlock", 1), ("!deadlock", 0), ("EF deadlock", 0), ("eat_1 = 0", 0)]
    {
        let line = ["check", "philosophers:3", "--property", property, "--initial"];
        assert_eq!(folder.cotama(&line).code, Some(code), "{property}");
    }
}

#[test]
fn bounds_of_time_have_their_unit() {
    let folder = Folder::new("questions_units");
    let property = ["--property", "bound(w1 -> Fault)"];
    let watchdog = [&["check", "watchdog"][..], &property].concat();
    assert_eq!(folder.cotama(&[&watchdog[..], &["--json"]].concat()).json(0)["time_unit"], "ms");
    let screen = folder.cotama(&watchdog).stdout;
    assert!(screen.lines().nth(1).unwrap().contains("100 ms to no limit  bound("), "{screen}");
    folder.write("race.net", "tr fast [1,2] idle -> won\ntr late [5,7] won -> done\npl idle (1)");
    let race = ["check", "race.net", "--property", "bound(fast -> done)"];
    assert!(folder.cotama(&race).stdout.contains("5 to 7, in the unit of the file  bound("));
    assert_eq!(folder.cotama(&[&race[..], &["--json"]].concat()).json(0)["time_unit"], Value::Null);
    let untimed = folder.cotama(&["check", "kanban:2", "--property", "EF P1 = 0", "--json"]);
    assert_eq!(untimed.json(0)["time_unit"], json!(null));
}

/// Where one token each cannot be all, how many there are is asked, not whether it is one.
#[test]
fn a_net_that_starts_with_two_tokens_is_asked_for_its_bounds() {
    let folder = Folder::new("questions_usual");
    for (net, question) in [
        ("tr a p -> q\npl p (1)", "one_safe"),
        ("tr a p -> q\npl p (2)", "bounds"),
        ("tr a p -> q*2\npl p (1)", "bounds"),
        ("tr a p*2 -> q\npl p (1)", "bounds"),
    ] {
        folder.write("it.net", net);
        let answer = folder.cotama(&["check", "it.net", "--json"]).json(1);
        assert_eq!(answer["results"][1]["name"], question, "{net}");
    }
}

/// What the first question leaves of the time is for the others, in equal parts.
#[test]
fn questions_share_the_time() {
    let folder = Folder::new("questions_time");
    let all = ["AG P1 <= 10", "AG P2 <= 10"];
    let ask = ["--engine", "explicit", "--max-seconds", "1.5", "--json"];
    let line = ["check", "kanban:10", "--property", all[0], "--property", all[1]];
    let answer = folder.cotama(&[&line[..], &ask].concat()).json(3);
    let seconds = [0, 1].map(|it| answer["results"][it]["seconds"].as_f64().unwrap());
    assert!(seconds[1] > 0.7 * seconds[0] && seconds[0] < 1.2, "{answer:#}");
}

#[test]
fn a_file_has_comments_and_names_with_room_around_them() {
    let folder = Folder::new("questions_file");
    folder.write("asked.txt", "  # not one\nfirst : EF Open\n");
    let line = ["check", "door", "--properties", "asked.txt", "--json"];
    assert_eq!(verdicts(&folder.cotama(&line).json(0)), ["first; EF Open; true"]);
}

#[test]
fn the_contest_is_told_of_a_place_without_bound() {
    let folder = Folder::new("questions_contest");
    folder.write("pump.net", "tr in -> tank  tr out tank*2 ->");
    let line = ["check", "pump.net", "--untimed", "--property", "bounds(tank)", "--mcc"];
    let said = folder.cotama(&line).stdout;
    assert!(said.starts_with("FORMULA bounds(tank) +inf TECHNIQUES "), "{said}");
}

#[test]
fn each_limit_says_which_option_allows_more() {
    let folder = Folder::new("questions_way_out");
    let limits = [["--max-memory", "1"], ["--max-states", "9"], ["--max-seconds", "0.1"]];
    for [option, value] in limits {
        let line = ["check", "kanban:10", "--property", "AG P1 <= 10", option, value];
        let said = folder.cotama(&[&line[..], &["--engine", "explicit"]].concat()).stdout;
        let other = limits.iter().filter(|it| it[0] != option);
        assert!(said.contains(&format!("{option} allows more")), "{said}");
        assert!(other.into_iter().all(|it| !said.contains(it[0])), "{said}");
    }
}

#[test]
fn a_certificate_shows_its_own_property_only() {
    let folder = Folder::new("questions_certificate");
    let line = ["check", "kanban:2", "--property", "EF P1 = 0", "--certificate", "it.json"];
    assert_eq!(folder.cotama(&line).code, Some(0));
    for (property, code) in [("EF P1 = 0", 0), ("EF P1 = 1", 1)] {
        let line = ["verify", "it.json", "--model", "kanban:2", "--property", property];
        assert_eq!(folder.cotama(&line).code, Some(code), "{property}");
    }
}

/// The door is never open and closed, so no run is fair, and what is true of fair runs says nothing.
#[test]
fn what_holds_because_no_run_is_as_assumed_says_so() {
    let folder = Folder::new("questions_unfair");
    let vacuous = |assumed: &str| {
        let asked = format!("AF Closed assuming often({assumed})");
        let words = ["check", "door", "--untimed", "--property", &asked, "--json"];
        folder.cotama(&words).json(0)["results"][0]["vacuous"].clone()
    };
    assert_eq!(vacuous("Open & Closed"), "no run is as it is assumed to be");
    assert_eq!(vacuous("Closed"), serde_json::Value::Null);
}

/// The robot waits for ever before it is asked for anything, or on its first drive: a loop of a
/// round in which nothing happens. Firings of the machinery of rounds are counted and not shown.
#[test]
fn a_loop_of_rounds_begins_behind_the_rounds_that_lead_to_it() {
    let folder = Folder::new("questions_rounds");
    let told = folder.cotama(&["check", "delivery", "--property", "AF gs.Deliver"]).stdout;
    let rounds: Vec<_> = told.lines().filter(|it| it.contains("round ")).map(str::trim).collect();
    assert_eq!(rounds, ["round 1  nothing from outside", "what follows round 0 repeats for ever"]);

    let asked = "AG (gs.DriveA -> AF gs.Deliver)";
    let answer = folder.cotama(&["check", "delivery", "--property", asked, "--json"]).json(1);
    let result = &answer["results"][0];
    let fired: Vec<_> =
        result["trace"].as_array().unwrap().iter().map(|it| it["transition"].clone()).collect();
    assert_eq!(fired, ["gs.g1", "ls.l1 + gom.settle ignored", "idle"]);
    assert_eq!(result["rest"], serde_json::json!({ "loop_from": 2 }));
}
