//! `cotama play`: pages in which models are played. Their runs are held against those of the
//! program by `sim/playground/module/check.py`.

use crate::common::Folder;
use crate::schemas::validate;
use serde_json::{Value, json};

/// The data of a page.
fn data(page: &str) -> Value {
    let (_, data) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_page_holds_all_that_it_needs() {
    let folder = Folder::new("play");
    let answer = folder.cotama(&["play", "door", "--json"]).json(0);
    validate("play", &answer);
    assert_eq!(answer["file"], "door.html");
    let page = folder.read("door.html");
    assert_eq!(answer["bytes"], page.len());
    for outside in ["src=", "@import", "url(", "fetch(", "XMLHttpRequest"] {
        assert!(!page.contains(outside), "{outside}");
    }
    let data = data(&page);
    assert_eq!(data["events"][0], json!(["Call", "Somebody wants to pass."]));
    assert_eq!(data["transitions"][0], json!(["call", 0, null]));
    assert_eq!((&data["system"], &data["by_name"]), (&json!(false), &json!(false)));
}

#[test]
fn a_transition_that_nobody_tells_says_why_it_fires() {
    let folder = Folder::new("play_why");
    assert_eq!(folder.cotama(&["play", "delivery", "--output", "d.html"]).code, Some(0));
    let data = data(&folder.read("d.html"));
    let transitions = data["transitions"].as_array().unwrap();
    let why = |name: &str| transitions.iter().find(|it| it[0] == name).unwrap()[2].clone();
    assert_eq!(why("gs.g1"), Value::Null);
    assert_eq!(why("ls.start1"), "answers start_drive, which other nets say: gs.start_drive");
    assert_eq!((&data["system"], &data["mail"]), (&json!(true), &json!(true)));
}

#[test]
fn a_model_that_cannot_be_played_is_refused_and_leaves_no_page() {
    let folder = Folder::new("play_refused");
    let refused = folder.cotama(&["play", "philosophers:5000"]);
    assert_eq!(refused.code, Some(2));
    let simulated = folder.cotama(&["simulate", "philosophers:5000", "x"]);
    assert_eq!(refused.stderr, simulated.stderr);
    assert_eq!(folder.cotama(&["play", "dor"]).code, Some(2));
    assert_eq!(folder.cotama(&["play", "door", "--output", "none/door.html"]).code, Some(2));
    assert_eq!(folder.files(""), [""; 0]);
}

fn place(name: &str, initial: u32) -> Value {
    json!({ "name": name, "doc": name, "initial": initial, "bound": 1, "role": "state" })
}

#[test]
fn names_of_a_file_do_nothing_in_its_page() {
    let folder = Folder::new("play_names");
    let name = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&\u{202e}";
    let arc = |place: &str| json!([{ "place": place, "weight": 1 }]);
    let net = json!({ "schema": "cotama/net/1", "name": name, "doc": name,
        "places": [place(name, 1), place("other", 0)],
        "events": [{ "name": name, "doc": name }], "outputs": [{ "name": name, "doc": name }],
        "transitions": [{ "name": name, "doc": name, "line": 0, "on": name, "take": arc(name),
            "read": [], "give": arc("other"), "emits": [name], "within": null, "priority": 0 }],
        "ignored": [], "laws": [] });
    folder.write("net.json", net.to_string());
    assert_eq!(folder.cotama(&["play", "net.json"]).code, Some(0));
    let page = folder.read("net.html");
    assert_eq!((page.matches("<script").count(), page.matches("</script").count()), (2, 2));
    assert!(!page.contains("<img") && !page.contains('\u{202e}'));
    assert_eq!(data(&page)["events"][0][0], name);
}
