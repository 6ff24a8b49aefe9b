//! JANI in the dialect of SCAN: only probabilities of `F` over state expressions, which are neither
//! compared nor nested.

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
        let compared = &property["expression"]["values"];
        let (values, formula) = (&compared["left"], &compared["left"]["exp"]);
        let sign = compared["op"].as_str().unwrap_or_default();
        let form = (values["op"].as_str(), formula["op"].as_str(), compared["right"].as_u64());
        if form != (Some("Pmax"), Some("F"), Some(0)) || !["≤", ">"].contains(&sign) {
            bail!("{name} has the unexpected form {form:?} {sign}");
        }
        if formula["exp"].to_string().contains("Pmax") {
            writeln!(said, "  {name}: left out, SCAN has no nested probability")?;
            continue;
        }
        writeln!(said, "  {name}: without `{sign} 0`")?;
        let states = &property["expression"]["states"];
        let expression =
            json!({ "op": "filter", "fun": "values", "values": values, "states": states });
        kept.push(json!({ "name": name, "expression": expression }));
        if sign == ">" {
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
