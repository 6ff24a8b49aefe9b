//! `cotama check --certificate` and `cotama verify`.

use crate::check::check;
use crate::common::{Folder, golden};
use serde_json::json;

#[test]
fn a_certificate_is_checked_again_and_refused_when_it_was_changed() {
    let folder = Folder::new("check_certificate");
    let more = ["--certificate", "feast.json"];
    assert_eq!(check(&folder, "philosophers:3", &["EF deadlock"], &more).code, Some(0));
    golden("verify_feast.txt", &folder.cotama(&["verify", "feast.json"]).stdout);
    let answer = folder.shell("cotama verify - --json < feast.json").json(0);
    assert_eq!((&answer["verified"], &answer["verdict"]), (&json!(true), &json!(true)));
    let text = folder.read("feast.json");
    folder.write("claimed.json", text.replace("\"verdict\":true", "\"verdict\":false"));
    let answer = folder.cotama(&["verify", "claimed.json", "--json"]).json(1);
    assert_eq!((&answer["verified"], &answer["verdict"]), (&json!(false), &json!(null)));
    assert!(answer["at"].is_string() && answer["message"].is_string());
    golden("verify_refused.txt", &folder.cotama(&["verify", "claimed.json"]).stdout);
    folder.write("cut.json", &text[..text.len() / 2]);
    folder.write("other.json", text.replace("cotama-certificate/1", "cotama-certificate/9"));
    for name in ["cut.json", "other.json", "missing.json"] {
        let ended = folder.cotama(&["verify", name]);
        assert!(ended.code == Some(2) && ended.stderr.contains(name), "{ended:?}");
    }
}

#[test]
fn evidence_of_every_kind_is_accepted() {
    let folder = Folder::new("check_evidence");
    folder.write("pump.net", "tr in -> tank  tr out tank*2 ->");
    for (model, property, code, kind) in [
        ("kanban:2", "P1 = 2", 0, "state"),
        ("philosophers:3", "AG !deadlock", 1, "trace"),
        ("door", "A (F G Closed | G F Blocked)", 1, "lasso"),
        ("kanban:5", "AG !deadlock", 0, "refutation"),
        ("kanban:2", "AG EF Pback1", 0, "graph"),
        ("kanban:3", "bounds(P1 + P2)", 0, "parts"),
        ("pump.net", "bounds(tank)", 0, "growth"),
    ] {
        let more = ["--untimed", "--initial", "--certificate", "it.json", "--json"];
        let answer = check(&folder, model, &[property], &more).json(code);
        let row = &answer["results"][0];
        assert_eq!(
            (&row["evidence"], &row["certificate"]),
            (&json!(kind), &json!("it.json")),
            "{property}"
        );
        let answer = folder.cotama(&["verify", "it.json", "--json"]).json(0);
        assert_eq!(answer["verdict"], json!(code == 0), "{property}");
        std::fs::remove_file(folder.path().join("it.json")).unwrap();
    }
}

#[test]
fn without_evidence_no_certificate_is_written() {
    let folder = Folder::new("check_no_evidence");
    let ended = check(&folder, "watchdog", &["EF Fault"], &["--certificate", "it.json"]);
    assert_eq!(ended.code, Some(0));
    assert!(
        ended.stderr.contains("no certificate for EF Fault: properties of time nets"),
        "{ended:?}"
    );
    assert_eq!(folder.files(""), [""; 0]);
}

#[test]
fn of_several_properties_each_has_a_file_of_its_own() {
    let folder = Folder::new("check_several");
    let more = ["--certificate", "it.json", "--trace", "run.html"];
    let ended = check(&folder, "philosophers:3", &["EF deadlock", "EF eat_1"], &more);
    assert_eq!(ended.code, Some(0), "{ended:?}");
    assert_eq!(folder.files(""), ["it-1.json", "it-2.json", "run-1.html", "run-2.html"]);
    assert!(folder.read("run-2.html").starts_with("<!DOCTYPE html>"));
    let more = ["--trace", "run.json"];
    assert_eq!(check(&folder, "philosophers:3", &["AG !deadlock"], &more).code, Some(1));
    let run: serde_json::Value = serde_json::from_str(&folder.read("run.json")).unwrap();
    assert_eq!((&run["holds"], &run["deadlock"]), (&json!(false), &json!(true)));
}

/// In a deadlock no marking follows, and the next marking of a run is the one that lasts: two
/// questions, each of which has one text everywhere.
#[test]
fn the_next_marking_is_one_question_on_the_command_line_in_files_and_in_certificates() {
    let folder = Folder::new("certificates_next");
    folder.write("dead.net", "net dead\npl p (1)\ntr t q -> p\n");
    folder.write("last.net", "net last\npl q (1)\ntr t q -> p\n");
    let verdict = |net: &str, text: &str| {
        let answer =
            folder.shell(&format!("cotama check {net} --initial --property '{text}' --json"));
        let answer: serde_json::Value = serde_json::from_str(&answer.stdout).unwrap();
        answer["results"][0]["verdict"].as_str().unwrap().to_owned()
    };
    for (text, dead, last) in [
        ("EX true", "false", "true"),
        ("E(X(true))", "false", "true"),
        ("E (X true)", "false", "true"),
        ("E[X true]", "false", "true"),
        ("AX false", "true", "false"),
        ("A(X(false))", "true", "false"),
        ("!(A(!(X(true))))", "true", "true"),
        ("!(E(!(X(false))))", "false", "false"),
        ("E(X(p))", "false", "true"),
        ("!(A(!(X(p))))", "true", "true"),
    ] {
        assert_eq!(verdict("dead.net", text), dead, "{text} of a deadlock");
        assert_eq!(verdict("last.net", text), last, "{text} before a deadlock");
        for net in ["dead.net", "last.net"] {
            let asked = format!("check {net} --initial --property '{text}' --certificate it.json");
            let code = folder.shell(&format!("cotama {asked}")).code;
            assert!(matches!(code, Some(0 | 1)), "{text}");
            let line = format!("cotama verify it.json --model {net} --property '{text}'");
            let ended = folder.shell(&line);
            assert_eq!(ended.code, Some(0), "{text}: {ended:?}");
            // The text of the question in the certificate is the same question.
            let shown = folder.cotama(&["verify", "it.json", "--json"]).json(0);
            let question = shown["question"].as_str().unwrap();
            let again = verdict(net, question);
            assert_eq!(again, shown["verdict"].as_bool().unwrap().to_string(), "{question}");
        }
    }
    // A certificate of one is none of the other.
    folder.cotama(&["check", "dead.net", "--property", "E(X(p))", "--certificate", "it.json"]);
    for (text, code) in [("EX p", 0), ("E(X(p))", 0), ("!(A(!(X(p))))", 1)] {
        let about = ["verify", "it.json", "--model", "dead.net", "--property", text];
        assert_eq!(folder.cotama(&about).code, Some(code), "{text}");
    }
    folder.write(
        "next.xml",
        "<property-set><property><id>next one</id><formula><exists-path><next><true/></next>\
         </exists-path></formula></property></property-set>",
    );
    let line = folder.cotama(&["check", "dead.net", "--properties", "next.xml", "--mcc"]);
    assert!(line.stdout.starts_with("FORMULA next\\u{20}one FALSE "), "{line:?}");
}
