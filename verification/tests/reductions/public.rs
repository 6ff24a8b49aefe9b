//! Nets of others; the folder of them is given by the environment variable `COTAMA_MCC_DIR`.

use crate::reductions::space::{Space, is_dead, run};
use cotama_checker::reductions::{Goal, Keep, reduce};
use cotama_golden::public_folder;
use cotama_verification::pnml;
use cotama_verification::pt::Pt;

/// Markings of a reduced net that are passed through.
const MARKINGS: usize = 150_000;

#[test]
fn public_nets_have_the_known_deadlocks_when_reduced() {
    let Some(folder) = public_folder("COTAMA_MCC_DIR", "reductions") else { return };
    let facts = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = facts.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let column = |name: &str| header.iter().position(|it| *it == name).unwrap();
    let mut decided = 0;
    eprintln!(
        "{:32} {:>11} {:>11} {:>18} {:>8}",
        "model", "before", "after", "markings before", "after"
    );
    for row in lines {
        let model = row[column("model")];
        let net = pnml::read(model, &std::fs::read(folder.join(format!("{model}.pnml"))).unwrap())
            .unwrap();
        let net = Pt::from(&net.view().net());
        let reduced = reduce(&net, &Keep::new(Goal::Deadlock));
        let space = Space::new(&reduced.net, MARKINGS);
        let size = |pt: &Pt| format!("{} x {}", pt.places.len(), pt.transitions.len());
        let markings =
            if space.complete { space.markings.len().to_string() } else { "more".to_owned() };
        let counts: Vec<_> =
            reduced.counts.iter().map(|it| format!("{} {}", it.1, it.0.name())).collect();
        eprintln!(
            "{model:32} {:>11} {:>11} {:>18} {markings:>8}  {}",
            size(&net),
            size(&reduced.net),
            row[column("states")],
            counts.join(", ")
        );
        let dead = space.dead().next();
        if let Some(dead) = dead {
            let lifted = reduced.trail.lift(&net, &space.path(dead)).unwrap();
            assert!(is_dead(&net, &run(&net, &lifted).unwrap()), "{model}");
        }
        if space.complete || dead.is_some() {
            assert_eq!(dead.is_some(), row[column("deadlock")] == "yes", "{model}");
            decided += 1;
        }
    }
    eprintln!("{decided} decided");
    assert!(decided >= 25, "{decided}");
}
