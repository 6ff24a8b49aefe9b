//! `cotama models`: what models there are, and what is known of one.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

fn named<'a>(answer: &'a Value, name: &str) -> &'a Value {
    answer["models"].as_array().unwrap().iter().find(|it| it["name"] == name).unwrap()
}

#[test]
fn the_screens_of_models() {
    let folder = Folder::new("models_screens");
    golden("models.txt", &folder.cotama(&["models"]).stdout);
    for name in ["door", "contextual", "delivery", "philosophers", "philosophers:3"] {
        let ended = folder.cotama(&["models", name]);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{name}");
        golden(&format!("models_{}.txt", name.replace(':', "_")), &ended.stdout);
    }
}

#[test]
fn it_is_said_of_each_law_how_it_was_shown() {
    let answer = Folder::new("models_laws").cotama(&["models", "--json"]).json(0);
    let door = named(&answer, "door");
    assert_eq!(
        (&door["places"], &door["states"], &door["firings"]),
        (&json!(7), &json!(8), &json!(17))
    );
    let law = json!({ "law": "never_both(Closing, obstacle)", "shown": "while_compiling" });
    assert_eq!(door["laws"][1], law);
    assert_eq!(named(&answer, "contextual")["states"], Value::Null);
    let family = named(&answer, "philosophers");
    assert_eq!((&family["kind"], &family["places"]), (&json!("family"), &Value::Null));
    assert_eq!(family["numbers"], json!({ "least": 2, "most": 10_000 }));
    let system = named(&answer, "delivery");
    assert_eq!(system["components"][1], json!({ "name": "ls", "net": "local" }));
}

#[test]
fn laws_of_a_family_and_of_a_file_are_only_claimed() {
    let folder = Folder::new("models_claimed");
    let answer = folder.cotama(&["models", "philosophers:3", "--json"]).json(0);
    let net = named(&answer, "philosophers:3");
    assert_eq!((&net["places"], &net["transitions"]), (&json!(15), &json!(15)));
    assert_eq!((&net["states"], &net["laws"][0]["shown"]), (&Value::Null, &json!("claimed")));
    assert_eq!(folder.cotama(&["export", "door", "--output", "door.pnml"]).code, Some(0));
    let answer = folder.cotama(&["models", "door.pnml", "--json"]).json(0);
    let file = named(&answer, "door.pnml");
    assert_eq!((&file["places"], &file["laws"][0]["shown"]), (&json!(7), &json!("claimed")));
}

#[test]
fn a_shared_place_is_counted_where_it_is_at_home() {
    let answer = Folder::new("models_system").cotama(&["models", "--json"]).json(0);
    let nets = [
        "global",
        "local",
        "path_following",
        "teleoperation",
        "permit",
        "observation",
        "contextual",
        "faults",
        "operator",
    ];
    let all: u64 = nets.iter().map(|net| named(&answer, net)["places"].as_u64().unwrap()).sum();
    // Each shared place has a complement, which is as shared as it is.
    let shared = 2 * (4 + 4 + 1 + 14 + 5);
    assert_eq!(named(&answer, "delivery")["places"], all - shared);
}

#[test]
fn names_that_a_terminal_would_obey_are_shown_as_codes() {
    let folder = Folder::new("models_obeyed");
    let text = folder.cotama(&["export", "door", "--format", "json"]).stdout;
    folder.write("door.json", text.replace("Closing", "\\u001b[31mClosing"));
    for arguments in [
        &["models", "door.json"][..],
        &["simulate", "door.json", "Cal"],
        &["simulate", "door.json"],
    ] {
        let ended = folder.cotama(arguments);
        assert!(!ended.stdout.contains('\u{1b}') && !ended.stderr.contains('\u{1b}'), "{ended:?}");
    }
}
