//! Nets of others, in the folder that the environment variable `COTAMA_MCC_DIR` names: files
//! `*.pnml`, and what is known of them in `facts.tsv`.

use cotama_verification::explicit::{Graph, Limit, Limits, statespace};
use cotama_verification::pnml;
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;
use std::path::PathBuf;

type Fact = BTreeMap<String, String>;

fn facts() -> Option<(PathBuf, Vec<Fact>)> {
    let folder = cotama_golden::public_folder("COTAMA_MCC_DIR", "counts of markings")?;
    let text = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = text.lines().map(|line| line.split('\t').map(str::to_owned));
    let header: Vec<String> = lines.next().unwrap().collect();
    let facts = lines.map(|line| header.iter().cloned().zip(line).collect()).collect();
    Some((folder, facts))
}

fn read(folder: &std::path::Path, model: &str) -> Pt {
    let bytes = std::fs::read(folder.join(format!("{model}.pnml"))).unwrap();
    match pnml::read(model, &bytes) {
        Ok(net) => Pt::from(&net.view().net()),
        Err(errors) => panic!("{errors}"),
    }
}

fn word(is: bool) -> &'static str {
    if is { "yes" } else { "no" }
}

/// Compares all that is known of nets with so many markings; returns how many there are, none where
/// they are skipped.
fn check(range: std::ops::Range<u64>, jobs: usize) -> Option<usize> {
    let (folder, facts) = facts()?;
    let mut checked = 0;
    for fact in &facts {
        let states = fact["states"].parse::<u64>().unwrap_or(u64::MAX);
        if !range.contains(&states) {
            continue;
        }
        checked += 1;
        let model = &fact["model"];
        let pt = read(&folder, model);
        let space = statespace(&pt, &Limits::default(), jobs, &|_| ());
        let counts = [
            ("states", space.states),
            ("edges", space.arcs),
            ("max_place", space.max_place),
            ("max_marking", space.max_sum),
            ("dead_markings", space.dead_markings),
        ];
        for (name, count) in counts {
            assert_eq!(count.to_string(), fact[name], "{name} of {model}");
        }
        assert_eq!(word(space.dead_markings > 0), fact["deadlock"], "{model}");
        assert_eq!(space.safe().map(word), Some(&*fact["safe"]), "{model}");
        assert_eq!(space.bounded.map(word), Some(&*fact["bounded"]), "{model}");
        let dead = match space.dead_transitions.len() {
            0 => "yes".to_owned(),
            dead => format!("no ({dead} dead)"),
        };
        assert_eq!(dead, fact["quasi_live"], "{model}");
        drop(space);
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        assert_eq!(
            [graph.states() as u64, graph.arcs() as u64],
            [counts[0].1, counts[1].1],
            "{model}"
        );
        let liveness = graph.liveness();
        let live = match (liveness.is_live(), fact["live"].as_str()) {
            (true, _) => "yes".to_owned(),
            (false, "no") => "no".to_owned(),
            (false, _) => format!("no ({} of {} live)", liveness.live.len(), pt.transitions.len()),
        };
        assert_eq!(live, fact["live"], "{model}");
        assert_eq!(word(liveness.reversible), fact["reversible"], "{model}");
    }
    Some(checked)
}

#[test]
fn public_nets_of_up_to_a_million_markings_have_all_known_properties() {
    assert!(matches!(check(0..1_000_000, 1), None | Some(23)));
}

#[test]
#[ignore = "takes a minute with optimisation and 2 GB: cargo test --release -p cotama-verification \
    --test engines statespace -- --ignored"]
fn public_nets_of_up_to_twenty_million_markings_have_all_known_properties() {
    assert!(matches!(check(1_000_000..20_000_000, 2), None | Some(5)));
}

#[test]
fn public_nets_that_are_too_large_or_unbounded_end_at_a_limit() {
    let Some((folder, _)) = facts() else { return };
    let limits = Limits { states: 100_000, ..Limits::default() };
    let gpu = statespace(&read(&folder, "DiscoveryGPU-PT-15a"), &limits, 1, &|_| ());
    assert_eq!((gpu.limit, gpu.bounded), (Some(Limit::States), Some(true)));
    let miner = statespace(&read(&folder, "CryptoMiner-PT-D03N000"), &limits, 1, &|_| ());
    assert_eq!((miner.limit, miner.bounded), (Some(Limit::Unbounded), Some(false)));
}
