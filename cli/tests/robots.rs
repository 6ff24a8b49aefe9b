//! A robot of one's own, from its file: every command that takes it, and those that do not.

use crate::common::Folder;
use serde_json::json;
use std::fmt::Write;

/// A folder with the file that `cotama new` writes.
fn cart(name: &str) -> Folder {
    let folder = Folder::new(name);
    let answer = folder.cotama(&["new", "robot", "cart", "--json"]).json(0);
    assert_eq!(answer["files"], json!(["cart.toml"]));
    folder
}

#[test]
fn a_new_robot_keeps_its_requirements() {
    let answer = cart("robots_check").cotama(&["check", "cart.toml", "--json"]).json(0);
    let results = answer["results"].as_array().unwrap();
    assert_eq!((results.len(), &answer["semantics"]), (18, &json!("rounds")));
    assert!(results.iter().all(|it| it["verdict"] == "true"), "{results:?}");
    let blind = results.iter().find(|it| it["id"] == "AS4.Blind").unwrap();
    let sentence = "`Blind` runs at the ends of two rounds at most without what it needs.";
    assert_eq!(blind["sentence"], sentence);
}

#[test]
fn a_changed_robot_shows_how_it_breaks_a_property() {
    let folder = cart("robots_changed");
    let asked = ["check", "cart.toml", "--property", "AG !follow.Blind", "--json"];
    let answer = folder.cotama(&asked).json(1);
    let trace = answer["results"][0]["trace"].as_array().unwrap();
    let names: Vec<_> = trace.iter().filter_map(|it| it["transition"].as_str()).collect();
    // The scanner is started anew twice before it counts as lost.
    assert_eq!(names.iter().filter(|it| it.contains("gom.LID1_restarts")).count(), 2, "{names:?}");
}

#[test]
fn all_that_takes_a_model_takes_a_robot() {
    let folder = cart("robots_models");
    let states = folder.cotama(&["statespace", "cart.toml", "--json"]).json(0);
    assert_eq!((&states["states"], &states["rounds"]["states"]), (&json!("2660"), &json!("838")));
    let models = folder.cotama(&["models", "cart.toml", "--json"]).json(0);
    assert_eq!(models["models"][0]["components"].as_array().unwrap().len(), 8);
    let svg = folder.cotama(&["export", "cart.toml", "--format", "svg"]).stdout;
    assert!(svg.starts_with("<svg") && svg.contains("contextual"));
    let played = folder.cotama(&["simulate", "cart.toml", "gs.drive_wanted"]);
    assert_eq!(played.code, Some(0), "{}", played.stderr);
    let listed = folder.cotama(&["list", "--json"]).json(0);
    assert_eq!(listed["robots"][2]["name"], "transport");
    let shown = folder.cotama(&["show", "transport"]).stdout;
    folder.write("again.toml", shown);
    let again = folder.cotama(&["models", "again.toml", "--json"]).json(0);
    let mut of_shipped = folder.cotama(&["models", "transport", "--json"]).json(0);
    of_shipped["models"][0]["name"] = json!("again.toml");
    assert_eq!(again["models"], of_shipped["models"]);
}

#[test]
fn the_failures_of_a_robot_are_analysed_if_their_rates_are_said() {
    let folder = cart("robots_fmeca");
    let answer = folder.cotama(&["fmeca", "cart.toml", "--json"]).json(0);
    let rows = answer["rows"].as_array().unwrap();
    let reactions: Vec<_> = rows.iter().map(|it| it["reaction"].as_str().unwrap()).collect();
    assert_eq!(
        reactions,
        [
            "start scan anew 2 times; then another configuration",
            "end the mission",
            "stop, ask the operator",
            "record",
            "set 60 % of the speed; record",
        ]
    );
    let text = folder.read("cart.toml").replace("mean_hours = 20\n", "");
    folder.write("silent.toml", text);
    let refused = folder.cotama(&["fmeca", "silent.toml"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("silent.toml: no `mean_hours` in STK1"), "{}", refused.stderr);
}

#[test]
fn commands_of_missions_say_that_a_robot_is_none() {
    let folder = cart("robots_missions");
    for command in ["plan", "run", "campaign"] {
        let refused = folder.cotama(&[command, "cart.toml"]);
        assert_eq!(refused.code, Some(2), "{command}");
        let (is, next) = ("this is a robot", "try `cotama check cart.toml`");
        assert!(refused.stderr.contains(is) && refused.stderr.contains(next), "{}", refused.stderr);
    }
}

#[test]
fn mistakes_in_the_file_of_the_transport_robot_are_found() {
    let folder = Folder::new("robots_mistakes");
    let whole = folder.cotama(&["show", "transport"]).stdout;
    let with = |from: &str, to: &str| {
        assert!(whole.contains(from), "{from}");
        whole.replacen(from, to, 1)
    };
    // Nobody sees that the camera fails, creep speed is called the best, and another module is
    // started anew.
    let unseen = with("flags = [\"depth_late\"]\nlatency_ms", "unseen = \"\"\nlatency_ms");
    let ranked = with("\"Manual.Guarded\"", "\"Manual.Guarded\"\nrank = 2");
    let ranked = ranked.replacen("\"Manual.Creep\"", "\"Manual.Creep\"\nrank = 1", 1);
    let started = with("restart = { module = \"scan\"", "restart = { module = \"fleet\"");
    for (text, said) in [
        (unseen, "`Follow.Low` never runs"),
        (ranked, "`Manual.Guarded` never runs"),
        (started, "`LID1` starts `fleet` anew, which works without what it loses"),
    ] {
        folder.write("mistaken.toml", text);
        let ended = folder.cotama(&["check", "mistaken.toml"]);
        assert_eq!(ended.code, Some(2));
        assert!(ended.stderr.contains(said), "{}", ended.stderr);
    }
    // A wheel that is blocked is recorded, and nobody is asked: the file makes sense.
    let hard =
        "severity = { autonomous = \"hard\", operator = \"hard\" }\nflags = [\"wheel_blocked\"]";
    folder.write("mistaken.toml", with(hard, &hard.replace("hard", "weak")));
    let mission = folder.cotama(&["show", "shift"]).stdout;
    let mission = mission.split("[run]").next().unwrap().replace("\"transport", "\"mistaken.toml");
    folder.write("round.toml", mission);
    let line = "campaign round.toml --runs 2000 --require not-failed --out found";
    let line: Vec<_> = line.split(' ').collect();
    assert_eq!(folder.cotama(&line).code, Some(1));
    let small = folder.read("found/failures/001.toml");
    let event = small.split("event = [").nth(1).unwrap().split("]\n").next().unwrap();
    assert!(event.lines().filter(|it| it.contains("mode")).count() == 1, "{small}");
    assert!(event.contains("WHL1"), "{small}");
}

/// A file of a robot with so many kinds of hardware that may be lost, and a configuration for each
/// of them in each of three sub-objectives.
fn large(losses: usize) -> String {
    let mut text = "format = \"cotama-robot/1\"\nname = \"large\"\n\
        [hardware.base]\n[module.drive]\nhardware = [\"base\"]\n\
        [operator]\nneeds = [\"drive\"]\n[[configuration]]\nname = \"ByHand\"\n\
        sub_objective = \"Hand\"\nmode = \"operator\"\nrequired = [\"drive\"]\nspeed_mm_s = 100\n"
        .to_owned();
    let flags: Vec<_> = (0..losses).map(|it| format!("\"f{it}\"")).collect();
    let _ = writeln!(text, "[observer.eye]\nflags = [{}]", flags.join(", "));
    for at in 0..losses {
        let _ = writeln!(
            text,
            "[hardware.h{at}]\n[module.m{at}]\nhardware = [\"h{at}\"]\n\
             [[failure]]\nid = \"F{at}\"\nmode = \"lost\"\n\
             severity = {{ autonomous = \"medium\", operator = \"weak\" }}\n\
             flags = [\"f{at}\"]\nloses = [\"h{at}\"]"
        );
        for part in 0..3 {
            let _ = writeln!(
                text,
                "[[configuration]]\nname = \"S{part}.C{at}\"\nsub_objective = \"S{part}\"\n\
                 mode = \"autonomous\"\nrequired = [\"drive\", \"m{at}\"]\nspeed_mm_s = 500"
            );
        }
    }
    text
}

#[test]
fn a_robot_too_large_for_one_net_is_unknown_in_little_memory() {
    let folder = Folder::new("robots_large");
    folder.write("large.toml", large(8));
    for line in ["check large.toml", "check large.toml --semantics interleaving"] {
        let ended = folder.shell(&format!("ulimit -v {}; cotama {line} --json", 300_000));
        assert_eq!(ended.code, Some(3), "{line}: {}", ended.stderr);
        let answer: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
        let results = answer["results"].as_array().unwrap();
        assert_eq!((results.len(), &results[0]["id"]), (63, &json!("GS1")), "{line}");
        assert!(results.iter().all(|it| it["verdict"] == "unknown"), "{line}");
    }
    let asked = folder.cotama(&["check", "large.toml", "--property", "AG !hand.ByHand"]);
    assert_eq!(asked.code, Some(3), "{}", asked.stderr);
    assert!(asked.stdout.contains("more than 100000 transitions"), "{}", asked.stdout);
    let counted = folder.cotama(&["statespace", "large.toml", "--json"]).json(3);
    assert!(counted["limit"].as_str().unwrap().contains("more than 100000 transitions"));
}
