//! Questions to a model: the wish for no deadlock, one marking or all, and units of time.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

/// Returns the name, the question and the verdict of each answer.
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

/// The usual question is the number of tokens, where one token each cannot be all.
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

/// The time that the first question leaves is for the others, in equal parts.
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

/// The door is never open and closed, so no run is fair, and what is true of fair runs says
/// nothing.
#[test]
fn a_property_true_for_want_of_fair_runs_says_so() {
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
    assert_eq!(fired, ["gs.g1", "ls.start1", "idle"]);
    assert_eq!(result["rest"], serde_json::json!({ "loop_from": 2 }));
}

#[test]
fn a_quantifier_that_could_reach_further_is_asked_for_its_parentheses() {
    let folder = Folder::new("questions_reach");
    for (text, wide, narrow) in [
        ("AG Closed -> Open", "AG (Closed -> Open)", "(AG Closed) -> Open"),
        ("AG Closed -> AF Open", "AG (Closed -> AF Open)", "(AG Closed) -> AF Open"),
        ("EF Closed & Open", "EF (Closed & Open)", "(EF Closed) & Open"),
        (
            "EF Closed | Open -> Closed",
            "EF (Closed | Open -> Closed)",
            "(EF Closed) | Open -> Closed",
        ),
        ("A G Closed -> Open", "A (G Closed -> Open)", "(A G Closed) -> Open"),
        ("E F Closed and Open", "E (F Closed and Open)", "(E F Closed) and Open"),
    ] {
        let error = folder.cotama(&["check", "door", "--property", text, "--json"]).json(2);
        let help = error["help"].as_str().unwrap();
        assert_eq!(help, format!("write `{wide}`, or `{narrow}`"), "{text}");
        // Both are read, where the second says that it is about the start.
        for text in [wide, narrow] {
            let line = ["check", "door", "--untimed", "--initial", "--property", text];
            let ended = folder.cotama(&line);
            assert!(matches!(ended.code, Some(0 | 1)), "{text}: {ended:?}");
        }
    }
    for text in ["Closed -> AF Open", "Closed & EF Open", "(AG Closed) -> Open", "!Open | AG Open"]
    {
        let error = folder.cotama(&["check", "door", "--property", text, "--json"]).json(2);
        let message = error["message"].as_str().unwrap();
        assert_eq!(
            message,
            "a part of this speaks of one marking, and no quantifier says of which"
        );
    }
}

#[test]
fn places_that_are_called_like_words_are_asked_for_by_their_names() {
    let folder = Folder::new("questions_letters");
    folder.write("it.net", "net it\ntr B A -> E\ntr C E -> F U\ntr D F U -> A\npl A (1)\n");
    for (text, code) in [
        ("EF E", 0),
        ("AG (A -> !E)", 0),
        ("AG EF A", 0),
        ("EF (F & U)", 0),
        ("E[A U E]", 0),
        ("AF E", 0),
        ("EF (E & F)", 1),
        ("bounds(E + F)", 0),
        ("EF fireable(B)", 0),
    ] {
        let ended = folder.cotama(&["check", "it.net", "--property", text]);
        assert_eq!(ended.code, Some(code), "{text}: {ended:?}");
    }
}

#[test]
fn two_properties_of_one_name_are_told_apart() {
    let folder = Folder::new("questions_names");
    folder.write("p.txt", "a: EF Open\na: AG Open\nb: EF Open\n");
    let answer = folder.cotama(&["check", "door", "--properties", "p.txt", "--json"]).json(1);
    let names = answer["results"].as_array().unwrap().iter().map(|it| &it["name"]);
    assert_eq!(names.collect::<Vec<_>>(), ["a", "a#2", "b"]);
}

/// A contest file of properties `EF place >= 1`, each with its name.
fn contest(named: &[(&str, &str)]) -> String {
    let property = |(name, place): &(&str, &str)| {
        format!(
            "<property><id>{name}</id><description>{name}</description><formula><exists-path>\
             <finally><integer-ge><tokens-count><place>{place}</place></tokens-count>\
             <integer-constant>1</integer-constant></integer-ge></finally></exists-path></formula>\
             </property>\n"
        )
    };
    let all: String = named.iter().map(property).collect();
    format!("<property-set xmlns='http://tapaal.net/'>\n{all}</property-set>\n")
}

#[test]
fn a_property_of_any_name_in_a_file_is_answered_by_that_name() {
    let folder = Folder::new("questions_any_name");
    folder.write("it.net", "tr t p -> q\npl p (1)\npl r (0)\n");
    // As the file writes it, as it is called, and as one word of the contest.
    let names = [
        (
            "Query Comment/Name Here",
            "Query Comment/Name Here",
            r"Query\u{20}Comment/Name\u{20}Here",
        ),
        ("EF P4=1", "EF P4=1", r"EF\u{20}P4=1"),
        ("two  words", "two  words", r"two\u{20}\u{20}words"),
        ("a,b;c:d", "a,b;c:d", "a,b;c:d"),
        ("&lt;x&gt; &amp; y", "<x> & y", r"<x>\u{20}&\u{20}y"),
        ("Prüfung", "Prüfung", "Prüfung"),
        ("--json", "--json", "--json"),
        ("1", "1", "1"),
        ("1", "1#2", "1#2"),
        ("deadlock_free", "deadlock_free", "deadlock_free"),
        ("", "property-11", "property-11"),
    ];
    let asked = |at: usize| if at.is_multiple_of(2) { ("q", "true") } else { ("r", "false") };
    let named: Vec<_> = names.iter().enumerate().map(|(at, it)| (it.0, asked(at).0)).collect();
    folder.write("p.xml", contest(&named));
    let answer = folder.cotama(&["check", "it.net", "--properties", "p.xml", "--json"]).json(1);
    let found: Vec<_> = verdicts(&answer);
    let expected = names.iter().enumerate().map(|(at, it)| {
        let (place, verdict) = asked(at);
        format!("{}; EF {place}; {verdict}", it.1)
    });
    assert_eq!(found, expected.collect::<Vec<_>>());
    let lines = folder.cotama(&["check", "it.net", "--properties", "p.xml", "--mcc"]).stdout;
    let lines: Vec<_> = lines.lines().map(|it| it.split(" TECHNIQUES").next().unwrap()).collect();
    let expected = names
        .iter()
        .enumerate()
        .map(|(at, it)| format!("FORMULA {} {}", it.2, asked(at).1.to_uppercase()));
    assert_eq!(lines, expected.collect::<Vec<_>>());
    // Each alone, too.
    for (written, name, _) in names.iter().filter(|it| !it.0.is_empty() && it.1 != "1#2") {
        folder.write("p.xml", contest(&[(written, "q")]));
        let answer = folder.cotama(&["check", "it.net", "--properties", "p.xml", "--json"]).json(0);
        assert_eq!(verdicts(&answer), [format!("{name}; EF q; true")]);
    }
}

#[test]
fn a_net_of_tina_without_any_interval_is_a_net_without_time() {
    let folder = Folder::new("questions_untimed");
    let loops = |count: usize, interval: &str| {
        let one = |at| {
            format!("tr a{at} {interval} p{at} -> q{at}\ntr b{at} q{at} -> p{at}\npl p{at} (9)\n")
        };
        (0..count).map(one).collect::<String>()
    };
    folder.write("plain.net", loops(4, ""));
    folder.write("open.net", loops(4, "[0,w["));
    folder.write("timed.net", loops(1, "[1,2]"));
    for net in ["plain.net", "open.net"] {
        let space = folder.cotama(&["statespace", net, "--json"]).json(0);
        assert_eq!((&space["states"], &space["classes"]), (&"10000".into(), &Value::Null), "{net}");
        let ended = folder.cotama(&["check", net, "--property", "quasi_live"]);
        assert!(ended.code == Some(0) && !ended.stdout.contains("classes"), "{ended:?}");
        let line = ["estimate", net, "--property", "EF q0", "--runs", "10"];
        assert!(matches!(folder.cotama(&line).code, Some(0 | 3)), "{net}");
        assert_eq!(folder.cotama(&["simulate", net, "a0", "b0"]).code, Some(0), "{net}");
    }
    assert!(folder.cotama(&["statespace", "timed.net"]).stdout.contains("classes"));
    assert_eq!(folder.cotama(&["estimate", "timed.net", "--property", "EF q0"]).code, Some(2));
}

#[test]
fn a_net_of_tina_without_any_interval_is_answered_as_the_same_net_in_pnml() {
    let folder = Folder::new("questions_plain");
    for (net, states, deadlocks, quasi_live, bound) in [
        ("tr a p -> q\ntr b q -> p\npl p (20)\n", "21", "0", 0, 20),
        ("net one\ntr a p -> q\npl p (1)\n", "2", "1", 0, 1),
        ("tr a p*2 -> q\ntr b q -> r\npl p (5)\n", "6", "1", 0, 2),
        ("tr a p -> q\ntr never q*9 -> p\npl p (3)\n", "4", "1", 1, 3),
        ("tr a [0,w[ p -> q\ntr b q -> p\npl p (7)\n", "8", "0", 0, 7),
        ("# no interval\ntr {a b} p -> q r\ntr c q r -> p\npl p (2)\n", "3", "0", 0, 2),
        ("tr a p r?1 -> q\ntr b q -> p\npl p (2)\npl r (1)\n", "3", "0", 0, 2),
    ] {
        folder.write("it.net", net);
        assert_eq!(folder.cotama(&["export", "it.net", "-o", "it.pnml"]).code, Some(0), "{net}");
        for file in ["it.net", "it.pnml"] {
            let space = folder.cotama(&["statespace", file, "--json"]).json(0);
            let found = ["states", "deadlocks", "classes"].map(|it| space[it].clone());
            assert_eq!(found, [json!(states), json!(deadlocks), Value::Null], "{file}: {net}");
            let ended = folder.cotama(&["check", file, "--property", "quasi_live"]);
            assert_eq!(ended.code, Some(quasi_live), "{file}: {net}");
            assert!(!ended.stdout.contains("classes"), "{}", ended.stdout);
            let ended = folder.cotama(&["check", file, "--property", "bounds(q)", "--mcc"]);
            let line = format!("FORMULA bounds(q) {bound} TECHNIQUES ");
            assert!(ended.stdout.starts_with(&line), "{file}: {}", ended.stdout);
            let line = ["estimate", file, "--property", "EF q", "--runs", "10", "--json"];
            assert_eq!(folder.cotama(&line).json(0)["results"][0]["holding"], 10, "{file}: {net}");
        }
    }
}
