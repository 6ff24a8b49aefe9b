//! Verdicts as findings, in SARIF 2.1.0 (OASIS, 2020), which editors and forges read.

use super::junit::steps;
use crate::answers::check::{CheckAnswer, ResultRow, VerdictName};
use serde_json::{Value, json};
use std::path::Path;

/// One run of the checker: a rule for each property, a result for each verdict. What shows that a
/// property is false is a flow of steps.
pub(super) fn text(answer: &CheckAnswer) -> String {
    let rules: Vec<Value> = answer.results.iter().map(rule).collect();
    let results = answer.results.iter().enumerate();
    let results: Vec<Value> = results.map(|(at, row)| result(at, row, &answer.model)).collect();
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
    format!("{log:#}\n")
}

fn rule(row: &ResultRow) -> Value {
    let said = row.sentence.unwrap_or(&row.property);
    json!({ "id": row.name, "shortDescription": { "text": said } })
}

fn result(at: usize, row: &ResultRow, model: &str) -> Value {
    let (kind, level, message) = match row.verdict {
        VerdictName::True => ("pass", "none", "it is true"),
        VerdictName::False => ("fail", "error", row.cause.as_deref().unwrap_or("it is false")),
        VerdictName::Unknown => {
            ("open", "none", row.reason.as_deref().unwrap_or("it is not known"))
        }
    };
    let mut result = json!({
        "ruleId": row.name,
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

/// A model of the program has a name, one of the user's a file.
fn place(model: &str) -> Value {
    if Path::new(model).is_file() {
        json!({ "physicalLocation": { "artifactLocation": { "uri": model } } })
    } else {
        json!({ "logicalLocations": [{ "fullyQualifiedName": model }] })
    }
}

fn step(model: &str, said: &str) -> Value {
    let mut place = place(model);
    place["message"] = json!({ "text": said });
    place
}
