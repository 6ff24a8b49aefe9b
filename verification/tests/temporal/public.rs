//! Public property files, from the folder that `COTAMA_MCC_DIR` names.

use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::pnml::{self, read_within};
use cotama_verification::property::{Ctl, Ids, Property, Question, mcc};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, Rest, Verdict, answer, ctl};
use std::collections::BTreeMap;
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_MCC_DIR", "CTL and LTL")
}

/// The verdicts of each file, by property.
fn verdicts(folder: &std::path::Path) -> BTreeMap<String, BTreeMap<String, bool>> {
    let text = std::fs::read_to_string(folder.join("properties/verdicts.tsv")).unwrap();
    let mut verdicts: BTreeMap<String, BTreeMap<String, bool>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let cells: Vec<_> = line.split('\t').collect();
        if !cells[0].contains("UpperBounds") {
            verdicts
                .entry(cells[0].into())
                .or_default()
                .insert(cells[1].into(), cells[2] == "TRUE");
        }
    }
    verdicts
}

fn properties(folder: &std::path::Path, file: &str) -> (Pt, Vec<Property>) {
    let net = folder.join(file.split_once('.').unwrap().0.to_owned() + ".pnml");
    let imported =
        read_within("net", &std::fs::read(net).unwrap(), pnml::Limits::default()).unwrap();
    let pt = Pt::from(&imported.net.view().net());
    let bytes = std::fs::read(folder.join("properties").join(file)).unwrap();
    let properties = mcc::read(file, &bytes, &pt, Ids::from(&imported)).unwrap();
    (pt, properties)
}

#[test]
fn answers_are_those_of_the_table() {
    let Some(folder) = folder() else { return };
    let limits = Limits { states: 100_000, ..Limits::default() };
    let (mut answered, mut shown) = (0, 0);
    for (file, expected) in verdicts(&folder) {
        let (pt, properties) = properties(&folder, &file);
        let started = std::time::Instant::now();
        let before = answered;
        for property in properties {
            let (Question::Formula(formula), Some(expected)) =
                (&property.question, expected.get(&property.name))
            else {
                continue;
            };
            let verdict = answer(&pt, formula, &limits, &|_| ());
            let Verdict::Known { holds, run, .. } = verdict else {
                panic!("{}: {verdict:?}", property.name)
            };
            assert_eq!(holds, *expected, "{}", property.name);
            answered += 1;
            if let Some(run) = run {
                shown += 1;
                let fire = |marking: Vec<u32>, it: &cotama_core::net::TransitionId| {
                    assert!(pt.enabled(&marking, it.0), "{}", property.name);
                    pt.fire(&marking, it.0).unwrap()
                };
                let end = run.stem.iter().fold(pt.initial.clone(), fire);
                if let Rest::Cycle(cycle) = &run.rest {
                    assert_eq!(cycle.iter().fold(end.clone(), fire), end, "{}", property.name);
                }
            }
        }
        if std::env::var_os("TIMES").is_some() {
            eprintln!("{file} {} {:?}", answered - before, started.elapsed());
        }
    }
    assert_eq!(answered, 396);
    assert!(shown > 100, "{shown}");
}

#[test]
fn labels_of_the_stored_graph_give_the_verdicts_of_the_table() {
    let Some(folder) = folder() else { return };
    let mut answered = 0;
    for (file, expected) in verdicts(&folder).into_iter().filter(|it| !it.0.contains("LTL")) {
        let (pt, properties) = properties(&folder, &file);
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        for property in properties {
            let (Question::Formula(formula), Some(expected)) =
                (&property.question, expected.get(&property.name))
            else {
                continue;
            };
            let Some(formula) = Ctl::new(formula) else { continue };
            assert_eq!(
                ctl(&graph, &formula, &Fairness::default(), 4 << 30, 2).unwrap().verdict,
                *expected,
                "{}",
                property.name
            );
            answered += 1;
        }
    }
    assert_eq!(answered, 320);
}
