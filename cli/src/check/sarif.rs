//! Verdicts as findings, in SARIF 2.1.0 (OASIS, 2020), which editors and forges read.
//!
//! A forge takes a file only if each finding has a physical location with a URI, and shows no more
//! than some characters of a text; so every model has one, whether it is a file or not.

use super::junit::steps;
use super::uri;
use crate::answers::check::{CheckAnswer, ResultRow, VerdictName};
use crate::catalogue;
use cotama_core::text;
use serde_json::{Value, json};

/// The most characters of a description that GitHub takes.
const DESCRIBED: usize = 1024;

/// One run of the checker: a rule for each property, a result for each verdict. What shows that a
/// property is false is a flow of steps.
pub(super) fn text(answer: &CheckAnswer) -> String {
    let mut rules: Vec<(String, Value)> = Vec::new();
    let mut results = Vec::new();
    for row in &answer.results {
        let id = id(row);
        // A name has one rule.
        let at = rules.iter().position(|it| it.0 == id).unwrap_or_else(|| {
            rules.push((id.clone(), rule(&id, row)));
            rules.len() - 1
        });
        results.push(result(&id, at, row, &answer.model));
    }
    let rules: Vec<Value> = rules.into_iter().map(|it| it.1).collect();
    log(&rules, &results)
}

/// Writes one run of the checker with its rules and results.
pub(crate) fn log(rules: &[Value], results: &[Value]) -> String {
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "cotama",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            } },
            "results": results,
        }],
    });
    text::json(&format!("{log:#}\n")).to_string()
}

/// Returns a file as a URI reference.
pub(crate) fn reference(path: &str) -> String {
    uri::reference(path, cfg!(windows))
}

/// Returns the id of a rule: never empty.
fn id(row: &ResultRow) -> String {
    let name = if row.name.trim().is_empty() { &row.property } else { &row.name };
    name.clone()
}

fn rule(id: &str, row: &ResultRow) -> Value {
    let said = row.sentence.as_deref().unwrap_or(&row.property);
    let said: String = said.chars().take(DESCRIBED).collect();
    json!({
        "id": id,
        "shortDescription": { "text": said },
        "fullDescription": { "text": said },
        "help": { "text": "Whether it is so in every run, or which run shows that it is not." },
    })
}

fn result(id: &str, at: usize, row: &ResultRow, model: &str) -> Value {
    let (kind, level, message) = match row.verdict {
        VerdictName::True => ("pass", "none", "it is true"),
        VerdictName::False => ("fail", "error", row.cause.as_deref().unwrap_or("it is false")),
        VerdictName::Unknown => {
            ("open", "none", row.reason.as_deref().unwrap_or("it is not known"))
        }
    };
    let mut result = json!({
        "ruleId": id,
        "ruleIndex": at,
        "kind": kind,
        "level": level,
        "message": { "text": format!("{}: {message}", row.property) },
        "locations": [place(model)],
    });
    if row.trace.is_some() {
        let steps = steps(row).into_iter().skip(1);
        let steps: Vec<Value> = steps.map(|it| json!({ "location": step(model, &it) })).collect();
        result["codeFlows"] = json!([{ "threadFlows": [{ "locations": steps }] }]);
    }
    result
}

/// Returns the location of a model, from its first character on: its file, or for one without a
/// file a path that says whence it came, `builtin/NAME` or `standard-input`, beside its name.
fn place(model: &str) -> Value {
    let family = model.split(':').next().unwrap_or(model);
    let (uri, is_file) = match model {
        "-" => ("standard-input".to_owned(), false),
        _ if catalogue::entry(family).is_some() => {
            (uri::reference(&format!("builtin/{model}"), false), false)
        }
        path => (reference(path), true),
    };
    let region = json!({ "startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1 });
    let physical = json!({ "artifactLocation": { "uri": uri }, "region": region });
    let mut place = json!({ "physicalLocation": physical });
    if !is_file {
        place["logicalLocations"] = json!([{ "fullyQualifiedName": model }]);
    }
    place
}

fn step(model: &str, said: &str) -> Value {
    let mut place = place(model);
    place["message"] = json!({ "text": said });
    place
}
