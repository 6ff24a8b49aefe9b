//! Published and confirmed answers.

use crate::tpn::{bound, discrete, folder, net};
use cotama_verification::tpn::{self, Limit, Limits, TimeNet};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn read(folder: &Path, name: &str) -> TimeNet {
    net(&fs::read_to_string(folder.join(format!("{name}.net"))).unwrap())
}

/// The rows of a table: of each the value of each column.
fn rows(table: &str) -> Vec<BTreeMap<&str, &str>> {
    let mut lines = table.lines();
    let columns: Vec<_> = lines.next().unwrap().split('\t').collect();
    lines.map(|line| columns.iter().copied().zip(line.split('\t')).collect()).collect()
}

#[test]
fn every_net_has_the_classes_and_markings_that_are_known_of_it() {
    let Some(folder) = folder("their known answers") else { return };
    let table = fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let limits = Limits { states: 1_000_000, ..Limits::default() };
    let rows = rows(&table);
    for row in &rows {
        let name = row["net"];
        let net = read(&folder, name);
        assert_eq!(net.places().len().to_string(), row["places"], "places of {name}");
        assert_eq!(
            net.transitions().len().to_string(),
            row["transitions"],
            "transitions of {name}"
        );
        let untimed = tpn::untimed(&net.untimed(), &limits);
        let count = |bounded, count: usize| {
            if bounded == Some(false) { "+inf".to_owned() } else { count.to_string() }
        };
        assert_eq!(
            count(untimed.bounded(), untimed.markings),
            row["markings_untimed"],
            "untimed markings of {name}"
        );
        assert_ne!(untimed.bounded(), None);
        let classes = tpn::classes(&net, &limits);
        assert_eq!(classes.bounded(), Some(row["bounded"] == "yes"), "whether {name} is bounded");
        let bounded = classes.bounded();
        assert_eq!(count(bounded, classes.classes()), row["classes"], "classes of {name}");
        assert_eq!(count(bounded, classes.edges()), row["edges"], "edges of {name}");
        assert_eq!(count(bounded, classes.markings()), row["markings"], "markings of {name}");
        assert_eq!(
            classes.dead_markings().to_string(),
            row["dead_markings"],
            "dead markings of {name}"
        );
        assert_eq!(
            classes.stopped(),
            if row["bounded"] == "yes" { None } else { Some(Limit::Unbounded) }
        );
        if row["bounded"] == "yes" {
            let reached = matches!(tpn::deadlock(&net, &limits), tpn::Reach::Reached(_));
            assert_eq!(reached, row["deadlock"] == "yes", "deadlock of {name}");
        }
    }
    assert_eq!(rows.len(), 17);
}

/// Every `step` makes `alarm` possible up to a unit earlier: of the marking with `walking` there
/// are 300,001 classes, of that with `resting` 300,000 that differ in the earliest date of `alarm`
/// alone, some of them with the same hash; of that with `walking` after the alarm two, and of that
/// with `resting` one.
#[test]
fn classes_that_differ_in_one_earliest_date_alone_are_told_apart() {
    let net = net("tr step [0,1] walking -> walking  tr rest [0,1] walking -> resting  tr alarm \
         [300000,900000] armed ->\n\
                   pl walking (1)  pl armed (1)");
    let classes = tpn::classes(&net, &Limits::default());
    assert_eq!(
        (classes.classes(), classes.markings(), classes.bounded()),
        (600_004, 4, Some(true))
    );
}

/// A name as files write it, without its braces.
fn bare(name: &str) -> String {
    match name.strip_prefix('{').and_then(|it| it.strip_suffix('}')) {
        Some(inner) => inner.replace("\\{", "{").replace("\\}", "}").replace("\\\\", "\\"),
        None => name.to_owned(),
    }
}

#[test]
fn every_response_takes_the_time_that_is_known_of_it() {
    let Some(folder) = folder("their known answers") else { return };
    let table = fs::read_to_string(folder.join("bounds.tsv")).unwrap();
    let rows = rows(&table);
    for row in &rows {
        let known = match (row["min"], row["max"]) {
            ("none", "none") => "never fires".to_owned(),
            (min, max) => format!("{min}..{max}"),
        };
        let (from, to) = (bare(row["from"]), bare(row["to"]));
        let net = read(&folder, row["net"]);
        assert_eq!(bound(&net, &from, &to), known, "{}: bound({from} -> {to})", row["net"]);
    }
    assert_eq!(rows.len(), 75);
}

#[test]
fn every_response_of_the_smaller_closed_nets_agrees_with_integer_clocks() {
    let Some(folder) = folder("their known answers") else { return };
    let table = fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut compared = 0;
    for row in rows(&table) {
        let net = read(&folder, row["net"]);
        let open = net.transitions().iter().map(|it| it.interval);
        let open =
            open.filter(|it| it.lower_strict || it.upper_strict && it.upper.is_some()).count();
        let Some(states) = discrete::states(&net, 1_000, 9).filter(|_| open == 0) else { continue };
        for (from, transition) in net.transitions().iter().enumerate() {
            for (to, place) in net.places().iter().enumerate() {
                let (from_name, to_name) = (&transition.name, &place.name);
                let known = states.bound(from, to);
                assert_eq!(
                    bound(&net, from_name, to_name),
                    known,
                    "{}: bound({from_name} -> {to_name})",
                    row["net"]
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 632);
}
