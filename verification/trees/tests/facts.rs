//! Facts of the second program, equal but for what depends on how states are stored.

use crate::folder::{folder, load, real, text};
use cotama_trees::explore::{Assumptions, Facts, Limits, Space};
use cotama_trees::reader::Options;
use cotama_trees::tree::Tree;
use serde_json::{Value, json};

/// Returns the facts in the second program's words.
fn told(tree: &Tree, facts: &Facts, minimal: usize) -> Value {
    let pairs = |all: &[cotama_trees::explore::Pair]| {
        let mut all: Vec<_> = all
            .iter()
            .map(|it| (tree.shown(it.nodes.0), tree.shown(it.nodes.1), it.ticks))
            .collect();
        all.sort();
        json!(all)
    };
    let names = |all: &[usize]| json!(all.iter().map(|it| tree.shown(*it)).collect::<Vec<_>>());
    let ends: Vec<_> = facts.ends.iter().map(|it| (it.0.shown(tree), *it.1)).collect();
    let labels =
        |all: &[usize]| json!(all.iter().map(|it| &tree.nodes[*it].label).collect::<Vec<_>>());
    json!({
        "minimal": minimal,
        "ends": ends.into_iter().collect::<std::collections::BTreeMap<_, _>>(),
        "stuck": facts.stuck > 0,
        "forever": facts.forever,
        "restarted_forever": labels(&facts.restarted),
        "spins": facts.spins,
        "both_running": pairs(&facts.both_running),
        "started_while_running": pairs(&facts.started_while_running),
        "success_lost": pairs(&facts.success_lost),
        "never_ticked": names(&facts.never_ticked),
        "never_success": names(&facts.never_success),
        "never_failure": names(&facts.never_failure),
    })
}

pub(crate) fn compare(name: &str, tree: &Tree, wanted: &Value) {
    let mut space = Space::explore(tree, false, Assumptions::default(), Limits::default());
    let facts = space.facts(&[]);
    let found = told(tree, &facts, space.minimal());
    for (key, value) in found.as_object().unwrap() {
        if wanted.get(key).is_none() {
            continue;
        }
        let wanted = match key.as_str() {
            "stuck" => json!(wanted[key].as_u64().unwrap() > 0),
            _ => wanted[key].clone(),
        };
        assert_eq!(value, &wanted, "{name}: {key}");
    }
    let Some(early) = wanted.get("read_before_written") else { return };
    let mut found: Vec<_> = facts
        .read_before_written
        .iter()
        .map(|it| (tree.nodes[it.node].label.clone(), it.entry.clone(), it.ticks))
        .collect();
    found.sort();
    assert_eq!(json!(found), *early, "{name}: read_before_written");
}

#[test]
fn facts_of_small_trees_equal_those_of_the_second_program() {
    let Some(folder) = folder() else { return };
    let mut trees = 0;
    for line in text(&folder.join("traces/facts.jsonl")).lines() {
        let wanted: Value = serde_json::from_str(line).unwrap();
        let name = wanted["tree"].as_str().unwrap();
        let path = folder.join(format!("traces/{name}.xml"));
        let tree = load(&path, &Options::default()).unwrap().tree;
        if wanted.get("not_explored").is_some() {
            continue;
        }
        compare(name, &tree, &wanted);
        trees += 1;
    }
    assert_eq!(trees, 52);
}

#[test]
fn facts_of_real_trees_equal_those_of_the_second_program() {
    let Some(folder) = folder() else { return };
    let (mut trees, mut refused) = (0, 0);
    for line in text(&folder.join("reference/facts.jsonl")).lines() {
        let wanted: Value = serde_json::from_str(line).unwrap();
        let name = wanted["tree"].as_str().unwrap();
        let path = folder.join("trees").join(name);
        let loaded = load(&path, &real(&folder, wanted["main"].as_str()));
        if wanted.get("refused").is_some() {
            assert!(loaded.is_err(), "{name} is refused: {}", wanted["refused"]);
            refused += 1;
            continue;
        }
        let tree = loaded.unwrap_or_else(|it| panic!("{it}")).tree;
        compare(name, &tree, &wanted);
        trees += 1;
    }
    assert_eq!((trees, refused), (45, 11));
}
