//! Findings about a tree in SARIF 2.1.0, each at the line of its node.

use crate::answers::check::tree::{TreeAnswer, TreeRow};
use crate::check::sarif::{log, reference};
use serde_json::{Value, json};

/// Writes one run of the checker: a rule for each question, a result for each finding.
pub(super) fn text(answer: &TreeAnswer) -> String {
    let mut rules: Vec<(&str, Value)> = Vec::new();
    for row in &answer.results {
        if rules.iter().all(|it| it.0 != row.name) {
            let said = json!({ "text": row.property });
            rules.push((&row.name, json!({ "id": row.name, "shortDescription": said })));
        }
    }
    let found = answer.results.iter().filter(|it| it.message.is_some());
    let results: Vec<_> = found.map(|it| result(it, &answer.model)).collect();
    let rules: Vec<Value> = rules.into_iter().map(|it| it.1).collect();
    log(&rules, &results)
}

fn result(row: &TreeRow, model: &str) -> Value {
    let uri = reference(row.file.as_deref().unwrap_or(model));
    let region = json!({
        "startLine": row.line.unwrap_or(1).max(1),
        "startColumn": row.column.unwrap_or(1).max(1),
    });
    let at = json!({ "physicalLocation": {
        "artifactLocation": { "uri": uri },
        "region": region,
    } });
    let message = row.message.as_deref().unwrap_or("");
    let help = row.help.as_deref().unwrap_or("");
    let steps = row.trace.iter().flatten().map(|it| {
        let said = format!("tick {}: {} -> {}", it.tick, it.events.join(" "), it.status);
        json!({ "location": { "message": { "text": said }, "physicalLocation": {
            "artifactLocation": { "uri": uri },
        } } })
    });
    let steps: Vec<Value> = steps.collect();
    let mut result = json!({
        "ruleId": row.name,
        "level": row.level.unwrap_or("note"),
        "message": { "text": format!("{message}. {help}") },
        "locations": [at],
    });
    if !steps.is_empty() {
        result["codeFlows"] = json!([{ "threadFlows": [{ "locations": steps }] }]);
    }
    result
}
