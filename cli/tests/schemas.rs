//! The schemas in `schemas/` are those of the types, and every answer is as they say.

use crate::common::Folder;
use serde_json::Value;
use std::path::PathBuf;

const COMMANDS: [&str; 21] = [
    "list",
    "plan",
    "run",
    "run-team",
    "allocate",
    "assign",
    "replay",
    "models",
    "simulate",
    "check",
    "statespace",
    "estimate",
    "verify",
    "conform",
    "recording",
    "fmeca",
    "campaign",
    "new",
    "error",
    "mission",
    "faults",
];

fn stored(command: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("schemas/{command}.json"))
}

/// An answer is as its stored schema says.
pub(crate) fn validate(command: &str, answer: &Value) {
    let schema = std::fs::read_to_string(stored(command)).unwrap();
    let validator = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    let errors: Vec<_> = validator.iter_errors(answer).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{command}: {errors:?}");
}

#[test]
fn the_stored_schemas_are_those_of_the_types() {
    let folder = Folder::new("schemas");
    for command in COMMANDS {
        let printed = folder.cotama(&["schema", command]);
        assert_eq!(printed.code, Some(0));
        cotama_golden::compare(stored(command), &printed.stdout);
    }
}

#[test]
fn a_schema_refuses_an_answer_of_another_command_or_with_a_field_missing() {
    let folder = Folder::new("schemas_refuse");
    let mut answer = folder.cotama(&["list", "--json"]).json(0);
    let schema = std::fs::read_to_string(stored("list")).unwrap();
    let validator = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    assert!(validator.is_valid(&answer));
    answer["schema"] = "cotama/plan/1".into();
    assert!(!validator.is_valid(&answer));
    answer["schema"] = "cotama/list/1".into();
    answer.as_object_mut().unwrap().remove("missions");
    assert!(!validator.is_valid(&answer));
}

#[test]
fn the_list_names_the_patrol_and_the_door() {
    let answer = Folder::new("list").cotama(&["list", "--json"]).json(0);
    assert_eq!(answer["missions"][0]["name"], "patrol");
    assert_eq!(answer["models"][0]["name"], "door");
    for kind in ["models", "scenarios", "maps"] {
        assert!(answer[kind].is_array());
    }
}
