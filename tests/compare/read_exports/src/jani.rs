//! JANI in the dialect of SCAN: no path quantifiers, only probabilities of `F` and `G` over state
//! expressions.

use anyhow::{Context, bail};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

pub fn read(text: &str, folder: &Path) -> anyhow::Result<String> {
    let mut model: Value = serde_json::from_str(text)?;
    let mut said = String::new();
    let mut reachable = Vec::new();
    let properties = model["properties"].take();
    let mut kept = Vec::new();
    for property in properties.as_array().context("no properties")? {
        let name = property["name"].as_str().context("a property without a name")?;
        let path = &property["expression"]["values"];
        let formula = &path["exp"];
        let (quantifier, operator) = (path["op"].as_str(), formula["op"].as_str());
        if formula["exp"].to_string().contains("deadlock") || formula["exp"]["op"] == "∃" {
            writeln!(
                said,
                "  {name}: left out, SCAN has no deadlock predicate and no nested quantifier"
            )?;
            continue;
        }
        let probability = match (quantifier, operator) {
            (Some("∀"), Some("G")) => "Pmin",
            (Some("∃"), Some("F")) => "Pmax",
            other => bail!("{name} has the unexpected form {other:?}"),
        };
        writeln!(said, "  {name}: {} as {probability}", quantifier.unwrap_or_default())?;
        let values = json!({ "op": probability, "exp": formula });
        let states = &property["expression"]["states"];
        let expression =
            json!({ "op": "filter", "fun": "values", "values": values, "states": states });
        kept.push(json!({ "name": name, "expression": expression }));
        if probability == "Pmax" {
            reachable.push(name.to_owned());
        }
    }
    let all: Vec<String> =
        kept.iter().filter_map(|it| it["name"].as_str().map(str::to_owned)).collect();
    model["properties"] = Value::Array(kept);
    let file = folder.join("model.jani");
    fs::write(&file, model.to_string())?;
    scan_jani::load(&file, &all)?;
    // A run ends when the formula is decided or nothing can happen any more: only these nets stop
    // for certain.
    if model["name"] == "philosophers" {
        for name in reachable {
            let (scan, _) = scan_jani::load(&file, std::slice::from_ref(&name))?;
            let report = scan.adaptive(0.95, 0.05)?;
            writeln!(said, "  {name}: in {} of {} runs of SCAN", report.successes, report.runs)?;
            if report.successes == 0 {
                bail!("{name} is never reached");
            }
        }
    }
    Ok(said)
}
