//! The schemas in `schemas/cotama.json` are printed one by one, and every answer is as they say.

use crate::common::Folder;
use jsonschema::Validator;
use serde_json::{Map, Value};
use std::path::PathBuf;

const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

const COMMANDS: [&str; 36] = [
    "list",
    "explain-team",
    "plan",
    "plan-axes",
    "run",
    "run-team",
    "allocate",
    "assign",
    "assign-curves",
    "replay",
    "models",
    "simulate",
    "play",
    "simulate-tree",
    "check",
    "check-tree",
    "statespace",
    "statespace-tree",
    "estimate",
    "verify",
    "conform",
    "conform-tree",
    "recording",
    "floor",
    "fmeca",
    "measure",
    "campaign",
    "run-two-ways",
    "risk-learn",
    "risk-infer",
    "risk-coherence",
    "risk-discretise",
    "risk-separated",
    "risk-choose",
    "new",
    "error",
];

fn stored() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("schemas/cotama.json")
}

/// The stored schema of an answer: the definitions of all, of which it names its own.
fn schema(command: &str) -> Validator {
    let text = std::fs::read_to_string(stored()).unwrap();
    let mut schema: Value = serde_json::from_str(&text).unwrap();
    schema["$ref"] = format!("#/answers/{command}").into();
    jsonschema::validator_for(&schema).unwrap()
}

/// An answer is as its stored schema says.
pub(crate) fn validate(command: &str, answer: &Value) {
    let errors: Vec<_> =
        schema(command).iter_errors(answer).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{command}: {errors:?}");
}

#[test]
fn a_printed_schema_is_the_stored_one_with_the_definitions_that_it_names() {
    let folder = Folder::new("schemas");
    let stored: Value = serde_json::from_str(&std::fs::read_to_string(stored()).unwrap()).unwrap();
    for command in COMMANDS {
        let printed = folder.cotama(&["schema", command]);
        assert_eq!(printed.code, Some(0));
        let mut schema: Map<String, Value> = serde_json::from_str(&printed.stdout).unwrap();
        // Each name is of a definition: a validator can be made.
        jsonschema::validator_for(&Value::from(schema.clone())).unwrap();
        assert_eq!(schema.remove("$schema").unwrap(), DRAFT, "{command}");
        let definitions = schema.remove("$defs");
        for (name, definition) in definitions.iter().flat_map(|it| it.as_object().unwrap()) {
            assert_eq!(*definition, stored["$defs"][name], "{command}");
            let named = format!("\"#/$defs/{name}\"");
            assert!(printed.stdout.contains(&named), "{command} does not name {name}");
        }
        assert_eq!(Value::from(schema), stored["answers"][command], "{command}");
    }
}

#[test]
fn a_schema_refuses_an_answer_of_another_command_or_with_a_field_missing() {
    let folder = Folder::new("schemas_refuse");
    let mut answer = folder.cotama(&["list", "--json"]).json(0);
    let validator = schema("list");
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
