//! Public nets, from the folder that `COTAMA_MCC_DIR` names.

use super::ends_in;
use cotama_checker::stubborn::{deadlock, reach_reduced};
use cotama_core::net::PlaceId;
use cotama_verification::explicit::{Limits, Reached};
use cotama_verification::pnml::{self, read_within};
use cotama_verification::property::mcc::{self, Answer};
use cotama_verification::property::{Atom, Formula, Ids, Linear, Question, Reachability};
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_MCC_DIR", "stubborn sets")
}

fn rows(file: PathBuf) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(file).unwrap();
    text.lines().skip(1).map(|line| line.split('\t').map(str::to_owned).collect()).collect()
}

fn net(file: PathBuf) -> (Pt, pnml::Imported) {
    let imported =
        read_within("net", &std::fs::read(file).unwrap(), pnml::Limits::default()).unwrap();
    (Pt::from(&imported.net.view().net()), imported)
}

#[test]
fn deadlocks_of_public_nets_are_those_of_the_facts() {
    let Some(folder) = folder() else { return };
    let limits = Limits { states: 300_000, ..Limits::default() };
    let mut open = Vec::new();
    let rows = rows(folder.join("facts.tsv"));
    assert_eq!(rows.len(), 30);
    for row in rows {
        let (pt, _) = net(folder.join(row[0].clone() + ".pnml"));
        let started = std::time::Instant::now();
        let reached = deadlock(&pt, &limits, &|_| ());
        if std::env::var_os("TIMES").is_some() {
            eprintln!("{} {} {:?}", row[0], reached.states(), started.elapsed());
        }
        match reached {
            Reached::Trace { transitions, .. } => {
                assert!(
                    row[10] == "yes" && ends_in(&pt, &transitions, &Formula::Atom(Atom::Deadlock)),
                    "{}",
                    row[0]
                );
            }
            Reached::Never { .. } => assert_eq!(row[10], "no", "{}", row[0]),
            Reached::Unknown { .. } => open.push(row[0].clone()),
        }
    }
    assert_eq!(open, [""; 0]);
}

#[test]
fn reachability_verdicts_of_public_files_are_those_of_the_table() {
    let Some(folder) = folder() else { return };
    let mut verdicts: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    for row in rows(folder.join("properties/verdicts.tsv")) {
        if row[0].contains("Reachability") {
            verdicts.entry(row[0].clone()).or_default().push(row);
        }
    }
    let mut compared = 0;
    for (file, rows) in verdicts {
        let (pt, imported) = net(folder.join(file.split_once('.').unwrap().0.to_owned() + ".pnml"));
        let bytes = std::fs::read(folder.join("properties").join(&file)).unwrap();
        let properties = mcc::read(&file, &bytes, &pt, Ids::from(&imported)).unwrap();
        for row in rows {
            let property = properties.iter().find(|it| it.name == row[1]).unwrap();
            let Question::Formula(formula) = &property.question else { panic!("not a formula") };
            let Some(asked) = Reachability::new(formula) else { continue };
            let reached = reach_reduced(&pt, &asked.goal, &Limits::default(), &|_| ()).unwrap();
            let found = match &reached {
                Reached::Trace { transitions, .. } => {
                    assert!(ends_in(&pt, transitions, &asked.goal), "{}", row[1]);
                    true
                }
                Reached::Never { .. } => false,
                Reached::Unknown { .. } => panic!("{}: {reached:?}", row[1]),
            };
            let answer = mcc::answer("it", Answer::Verdict(found == asked.expected), &[]);
            assert_eq!(answer.split_whitespace().nth(2), Some(row[2].as_str()), "{}", row[1]);
            compared += 1;
        }
    }
    assert_eq!(compared, 160);
}

#[test]
fn two_processes_are_never_in_their_critical_section_at_once() {
    let Some(folder) = folder() else { return };
    for (name, prefix, places) in
        [("LamportFastMutEx-PT-3", "P-CS_", 4), ("Peterson-PT-3", "cs_", 4)]
    {
        let (pt, _) = net(folder.join(name.to_owned() + ".pnml"));
        let critical =
            (0..pt.places.len() as u32).filter(|it| pt.places[*it as usize].starts_with(prefix));
        let weights: Vec<_> = critical.map(|it| (PlaceId(it), -1)).collect();
        assert_eq!(weights.len(), places);
        let inside =
            |constant| Formula::Atom(Atom::AtMost(Linear { constant, weights: weights.clone() }));
        let started = std::time::Instant::now();
        let one = reach_reduced(&pt, &inside(1), &Limits::default(), &|_| ()).unwrap();
        assert!(matches!(one, Reached::Trace { .. }), "{name}: {one:?}");
        if std::env::var_os("TIMES").is_some() {
            eprintln!("{name} one {} {:?}", one.states(), started.elapsed());
        }
        // A release build takes seconds for all of Peterson's markings, a debug build minutes.
        let limits = Limits {
            states: if cfg!(debug_assertions) { 30_000 } else { u64::MAX },
            ..Limits::default()
        };
        let two = reach_reduced(&pt, &inside(2), &limits, &|_| ()).unwrap();
        if std::env::var_os("TIMES").is_some() {
            eprintln!("{name} two {} {:?}", two.states(), started.elapsed());
        }
        match two {
            Reached::Never { .. } => {}
            Reached::Unknown { .. } => assert!(cfg!(debug_assertions) && name == "Peterson-PT-3"),
            Reached::Trace { .. } => panic!("{name}: {two:?}"),
        }
    }
}
