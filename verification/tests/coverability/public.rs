//! Nets of others, in the folder that the environment variable `COTAMA_MCC_DIR` names: files
//! `*.pnml`, and what is known of them in `facts.tsv`.

use super::pumps_ten_times;
use cotama_golden::public_folder;
use cotama_verification::coverability::{Bounded, CoverabilitySet, Limits, bounded};
use cotama_verification::pnml;
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;

#[test]
fn public_nets_are_bounded_or_not_as_published() {
    let Some(folder) = public_folder("COTAMA_MCC_DIR", "which nets are bounded") else { return };
    let text = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = text.lines().map(|line| line.split('\t'));
    let header: Vec<&str> = lines.next().unwrap().collect();
    let (mut yes, mut no, mut exact) = (0, 0, 0);
    for line in lines {
        let fact: BTreeMap<&str, &str> = header.iter().copied().zip(line).collect();
        let model = fact["model"];
        let bytes = std::fs::read(folder.join(format!("{model}.pnml"))).unwrap();
        let pt = Pt::from(&pnml::read(model, &bytes).unwrap().view().net());
        let limits = Limits { nodes: 20_000, ..Limits::default() };
        match bounded(&pt, &Limits { nodes: 100_000, ..limits }) {
            Bounded::Yes => {
                assert_ne!(fact["max_place"], "+inf", "{model}");
                yes += 1;
            }
            Bounded::No(growth) => {
                assert_eq!(fact["max_place"], "+inf", "{model}");
                pumps_ten_times(&pt, &growth);
                no += 1;
            }
            Bounded::Unknown(unfinished) => eprintln!("{model}: {unfinished}"),
        }
        // A set that is found has exact bounds.
        if let Ok(set) = CoverabilitySet::new(&pt, &limits) {
            let most = set.bounds().into_iter().max().unwrap();
            assert_eq!(
                most.finite().map_or("+inf".to_owned(), |it| it.to_string()),
                fact["max_place"],
                "{model}"
            );
            if fact["quasi_live"] != "?" {
                let dead = set.dead_transitions().len();
                let said = if dead == 0 { "yes".to_owned() } else { format!("no ({dead} dead)") };
                assert_eq!(said, fact["quasi_live"], "{model}");
            }
            exact += 1;
        }
    }
    eprintln!("{yes} bounded, {no} unbounded, {exact} with exact bounds");
    assert_eq!((yes, no), (29, 1));
}
