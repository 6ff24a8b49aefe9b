//! Published nets with published facts: none is contradicted, and most are found.

use super::nets::{enabled, replay};
use cotama_checker::structural;
use cotama_checker::structural::{Answer, Limits, Structure};
use cotama_verification::pnml;
use cotama_verification::pt::Pt;
use std::path::{Path, PathBuf};

fn folder() -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_MCC_DIR", "the structure of public nets")
}

fn net(folder: &Path, name: &str) -> Pt {
    let bytes = std::fs::read(folder.join(format!("{name}.pnml"))).unwrap();
    Pt::from(&pnml::read(name, &bytes).unwrap().view().net())
}

/// The columns asked for of every row, with the model first.
fn facts(folder: &Path, columns: &[&str]) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut rows = text.lines().map(|it| it.split('\t').collect::<Vec<_>>());
    let names = rows.next().unwrap();
    let at: Vec<_> =
        columns.iter().map(|it| names.iter().position(|name| name == it).unwrap()).collect();
    rows.map(|row| at.iter().map(|&it| row[it].to_owned()).collect()).collect()
}

#[test]
fn bounds_are_never_below_the_published_ones_and_mostly_equal() {
    let Some(folder) = folder() else { return };
    let mut open = Vec::new();
    for row in facts(&folder, &["model", "max_place", "bounded"]) {
        let [model, most, bounded] = &row[..] else { panic!("a short row") };
        let pt = net(&folder, model);
        let mut structure = Structure::new(&pt, &Limits::default());
        let bounds = structure.bounds().to_vec();
        assert!(bounds.iter().flatten().all(|it| it.holds(&pt, structure.dead())), "{model}");
        match bounds.iter().map(|it| it.as_ref().map(|it| it.at_most)).collect::<Option<Vec<_>>>() {
            Some(bounds) => {
                assert_eq!(bounded, "yes", "{model}");
                assert_eq!(bounds.iter().max().unwrap().to_string(), *most, "{model}");
            }
            None => open.push(model.clone()),
        }
    }
    // An unbounded net has no bounds to be found.
    assert_eq!(open, ["CryptoMiner-PT-D03N000"]);
}

#[test]
fn one_safety_is_never_contradicted() {
    let Some(folder) = folder() else { return };
    let mut open = Vec::new();
    for row in facts(&folder, &["model", "safe"]) {
        let [model, safe] = &row[..] else { panic!("a short row") };
        let pt = net(&folder, model);
        match Structure::new(&pt, &Limits::default()).one_safe() {
            Answer::Impossible(_) => assert_eq!(safe, "yes", "{model}"),
            Answer::Reachable(trace) => {
                assert_eq!(safe, "no", "{model}");
                assert!(replay(&pt, &trace).iter().any(|&it| it > 1));
            }
            Answer::Unknown(_) => open.push(model.clone()),
        }
    }
    assert_eq!(open, ["CryptoMiner-PT-D03N000"]);
}

#[test]
fn deadlocks_are_never_contradicted() {
    let Some(folder) = folder() else { return };
    let mut open = Vec::new();
    for row in facts(&folder, &["model", "deadlock"]) {
        let [model, deadlock] = &row[..] else { panic!("a short row") };
        let pt = net(&folder, model);
        let mut structure = Structure::new(&pt, &Limits::default());
        match structure.deadlock() {
            Answer::Impossible(proof) => {
                assert_eq!(deadlock, "no", "{model}");
                assert!(proof.holds(&pt, structure.dead()), "{model}");
            }
            Answer::Reachable(trace) => {
                assert_eq!(deadlock, "yes", "{model}");
                assert!(enabled(&pt, &replay(&pt, &trace)).next().is_none());
            }
            Answer::Unknown(_) => open.push(model.clone()),
        }
    }
    let expected = [
        "Angiogenesis-PT-01",
        "AutoFlight-PT-01a",
        "BridgeAndVehicles-PT-V04P05N02",
        "SafeBus-PT-03",
        "CryptoMiner-PT-D03N010",
        "PermAdmissibility-PT-01",
    ];
    assert_eq!(open, expected);
}

#[test]
fn siphons_and_dead_transitions_are_never_contradicted() {
    let Some(folder) = folder() else { return };
    let rows = facts(&folder, &["model", "deadlock", "live", "quasi_live"]);
    assert_eq!(rows.len(), 30);
    for row in rows {
        let [model, deadlock, live, quasi_live] = &row[..] else { panic!("a short row") };
        let pt = net(&folder, model);
        let found = structural::commoner(&pt, &structural::minimal_siphons(&pt, 100, 2_000_000));
        assert!(found.deadlock_free != Some(true) || deadlock == "no", "{model}");
        assert!(found.live != Some(true) || live == "yes", "{model}");
        assert!(found.live != Some(false) || live.starts_with("no"), "{model}");
        let mut structure = Structure::new(&pt, &Limits::default());
        structure.find_dead_transitions();
        assert!(structure.dead().holds(&pt), "{model}");
        let dead = structure.dead().transitions.len();
        let most = match quasi_live.strip_prefix("no (").and_then(|it| it.strip_suffix(" dead)")) {
            Some(dead) => dead.parse().unwrap(),
            None if quasi_live == "yes" => 0,
            None => usize::MAX,
        };
        assert!(dead <= most, "{model}: {dead} of {most}");
    }
}
