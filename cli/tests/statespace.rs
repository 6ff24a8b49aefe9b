//! `cotama statespace`: counts, limits, growth without end.

use crate::common::{Folder, golden};
use serde_json::json;

#[test]
fn the_screens_of_state_spaces() {
    let folder = Folder::new("statespace_screens");
    golden("statespace_kanban.txt", &folder.cotama(&["statespace", "kanban:2"]).stdout);
    golden("statespace_watchdog.txt", &folder.cotama(&["statespace", "watchdog"]).stdout);
    let cut = folder.cotama(&["statespace", "kanban:4", "--max-states", "10000"]);
    assert_eq!(cut.code, Some(3));
    golden("statespace_cut.txt", &cut.stdout);
    folder.write("pump.net", "net pump  tr in -> tank  tr out tank*2 ->  tr never spare ->");
    golden(
        "statespace_unbounded.txt",
        &folder.cotama(&["statespace", "pump.net", "--untimed"]).stdout,
    );
}

#[test]
fn all_is_counted_and_the_same_on_two_threads() {
    let folder = Folder::new("statespace_counts");
    let mut answers = ["1", "2"]
        .map(|jobs| folder.cotama(&["statespace", "kanban:2", "--jobs", jobs, "--json"]).json(0));
    for (field, value) in [
        ("states", json!("4600")),
        ("arcs", json!("28120")),
        ("max_place", json!("2")),
        ("max_sum", json!("8")),
        ("deadlocks", json!("0")),
        ("safe", json!(false)),
        ("bounded", json!(true)),
        ("markings", json!("4600")),
        ("classes", json!(null)),
        ("engine", json!("explicit")),
    ] {
        assert_eq!(answers[0][field], value, "{field}");
    }
    for answer in &mut answers {
        answer["seconds"] = json!(0);
        answer["bytes_per_state"] = json!(0);
    }
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn the_same_input_gives_the_same_answer_but_for_the_seconds() {
    let folder = Folder::new("statespace_twice");
    let mut answers =
        [(); 2].map(|()| folder.cotama(&["statespace", "philosophers:4", "--json"]).json(0));
    for answer in &mut answers {
        answer["seconds"] = json!(0);
    }
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn the_shipped_supervisors_are_counted_in_rounds() {
    let figure = |name| cotama_golden::figure::<u64>(name).to_string();
    let folder = Folder::new("statespace_rounds");
    let answer = folder.cotama(&["statespace", "delivery_by_hand", "--json"]).json(0);
    assert_eq!(
        answer["rounds"],
        json!({ "states": figure("delivery.states"), "edges": figure("delivery.steps") })
    );
    assert_eq!((&answer["states"], &answer["semantics"]), (&json!("339854"), &json!("rounds")));
}

#[test]
fn state_classes_are_counted_where_there_are_intervals() {
    let folder = Folder::new("statespace_classes");
    folder.write("race.net", "tr fast [1,2] idle -> won  tr slow ]2,3] idle -> lost  pl idle (1)");
    let answer = folder.cotama(&["statespace", "race.net", "--json"]).json(0);
    let counts = ["classes", "edges", "markings", "deadlocks", "states"]
        .map(|it| answer[it].as_str().unwrap().to_owned());
    assert_eq!(counts, ["2", "1", "2", "1", "2"]);
    assert_eq!((&answer["timed"], &answer["dead_transitions"]), (&json!(true), &json!(["slow"])));
    let answer = folder.cotama(&["statespace", "race.net", "--untimed", "--json"]).json(0);
    assert_eq!((&answer["states"], &answer["classes"]), (&json!("3"), &json!(null)));
}

/// Two tokens that were met are known; that there are never two is not.
#[test]
fn a_search_that_was_cut_short_never_says_one_safe() {
    let folder = Folder::new("statespace_cut_safe");
    let net = "tr a [1,1] p -> q  tr b [1,1] q -> r*2  tr c [1,1] r ->  pl p (1)";
    folder.write("doubles.net", net);
    for more in [&[][..], &["--untimed"]] {
        for (states, safe, count) in
            [("2", json!(null), json!(null)), ("3", json!(false), json!(null))]
        {
            let line = ["statespace", "doubles.net", "--max-states", states, "--json"];
            let answer = folder.cotama(&[&line[..], more].concat()).json(3);
            assert_eq!((&answer["safe"], &answer["states"]), (&safe, &count), "{states} {more:?}");
        }
        let line = ["statespace", "doubles.net", "--json"];
        let answer = folder.cotama(&[&line[..], more].concat()).json(0);
        assert_eq!((&answer["safe"], &answer["states"]), (&json!(false), &json!("5")));
        assert_eq!((&answer["max_place"], &answer["max_sum"]), (&json!("2"), &json!("2")));
        assert_eq!((&answer["dead_places"], &answer["dead_transitions"]), (&json!([]), &json!([])));
    }
}

#[test]
fn an_unbounded_net_is_an_answer_and_shows_how_it_grows() {
    let folder = Folder::new("statespace_unbounded");
    folder.write("pump.net", "tr in -> tank  tr out tank*2 ->");
    let answer = folder.cotama(&["statespace", "pump.net", "--untimed", "--json"]).json(0);
    assert_eq!((&answer["bounded"], &answer["states"]), (&json!(false), &json!(null)));
    assert_eq!(answer["growth"], json!({ "first": [], "repeated": ["in"] }));
    let lines = folder.cotama(&["statespace", "pump.net", "--untimed", "--mcc"]).stdout;
    assert!(lines.starts_with("STATE_SPACE STATES +inf TECHNIQUES EXPLICIT"), "{lines}");
}

#[test]
fn the_contest_gets_four_lines_or_one() {
    let folder = Folder::new("statespace_mcc");
    let lines = folder.cotama(&["statespace", "kanban:2", "--mcc"]).stdout;
    let numbers: Vec<_> =
        lines.lines().map(|it| it.split(" TECHNIQUES ").next().unwrap()).collect();
    let wanted = [
        "STATE_SPACE STATES 4600",
        "STATE_SPACE TRANSITIONS 28120",
        "STATE_SPACE MAX_TOKEN_PER_MARKING 8",
        "STATE_SPACE MAX_TOKEN_IN_PLACE 2",
    ];
    assert_eq!(numbers, wanted);
    let cut = folder.cotama(&["statespace", "kanban:4", "--max-states", "1000", "--mcc"]);
    assert_eq!((cut.code, cut.stdout.as_str()), (Some(3), "CANNOT_COMPUTE\n"));
}

#[test]
fn memory_has_a_limit_that_is_an_answer() {
    let folder = Folder::new("statespace_memory");
    // Kanban(10) has 10^9 markings. What the program may take in all is more than what the search
    // may.
    let line = "ulimit -v 200000; cotama statespace kanban:10 --max-memory 64 --json";
    let answer = folder.shell(line).json(3);
    assert_eq!(
        (&answer["states"], &answer["limit"]),
        (&json!(null), &json!("the limit of memory was reached"))
    );
    assert!(answer["explored"]["states"].as_str().unwrap().len() > 6, "{answer}");
    let answer =
        folder.cotama(&["statespace", "kanban:10", "--max-seconds", "0.2", "--json"]).json(3);
    assert_eq!(answer["limit"], "the limit of time was reached");
}
