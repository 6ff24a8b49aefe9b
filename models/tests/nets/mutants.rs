//! Every shipped net with one small mistake in it: do its laws notice?
//!
//! A mistake is a transition that is not there, an arc that does not read, an arc that gives to
//! another place, or one token more or less at the start. What the laws let pass is one of three:
//! *equivalent*, when the net fires exactly as before (the mistake touches what is never enabled,
//! or a condition that always holds); *seen in the table* of events that is kept with these tests;
//! or it *survives*, with a reason.

use crate::matrix::matrix;
use crate::textbook::{Graph, Trouble, explore};
use crate::{golden, laws};
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{self, Culprit, MARKINGS, Net, Role};
use cotama_core::player::Packed;
use cotama_models::nets::{ace, charger, crossing, door, watchdog};
use std::collections::{BTreeMap, HashSet};
use std::fmt::Write;

/// The effect of a mistake that no law notices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Elsewhere,
    Unchanged,
    Missing,
    Unread,
    Start,
}

impl Kind {
    /// Why a law cannot notice it, or none is there that does.
    fn reason(self) -> &'static str {
        match self {
            Self::Elsewhere => {
                "it leads to another state: laws say which states there are, not what leads where"
            }
            Self::Unchanged => "a flag or counter is left as it was, and no law speaks of it there",
            Self::Missing => {
                "the event is ignored, or time passes: laws do not say that something must happen"
            }
            Self::Unread => "it fires in more markings: laws do not say that something must wait",
            Self::Start => "it starts elsewhere, and comes to the same markings",
        }
    }
}

struct Mutant {
    kind: Kind,
    /// The mistake, with the line of the transition instead of its name.
    what: String,
    net: OwnedNet,
}

/// All nets with one mistake.
fn mutants(net: &Net<'_>) -> Vec<Mutant> {
    let (right, mut wrong) = (OwnedNet::from(net), vec![]);
    let name = |place: u32| net.places[place as usize].name;
    let mut with = |kind, what: String, mistake: &dyn Fn(&mut OwnedNet)| {
        let mut net = right.clone();
        mistake(&mut net);
        wrong.push(Mutant { kind, what, net });
    };
    for (at, it) in net.transitions.iter().enumerate() {
        let line = it.name.split('.').next().unwrap();
        with(Kind::Missing, format!("{line} is missing"), &|net| _ = net.transitions.remove(at));
        for (arc, read) in it.read.iter().enumerate() {
            let what = format!("{line} does not read {}", name(read.place.0));
            with(Kind::Unread, what, &|net| _ = net.transitions[at].read.remove(arc));
        }
        for (arc, give) in it.give.iter().enumerate() {
            let data = net.places[give.place.0 as usize].role != Role::State;
            let kind = if data { Kind::Unchanged } else { Kind::Elsewhere };
            let given = |place: u32| it.give.iter().any(|other| other.place.0 == place);
            for place in (0..net.places.len() as u32).filter(|&place| !given(place)) {
                let what =
                    format!("{line} gives {} instead of {}", name(place), name(give.place.0));
                with(kind, what, &|net| net.transitions[at].give[arc].place.0 = place);
            }
        }
    }
    for (at, place) in net.places.iter().enumerate() {
        if place.initial > 0 {
            let what = format!("{} starts with one less", place.name);
            with(Kind::Start, what, &|net| net.places[at].initial -= 1);
        }
        if place.initial < place.bound {
            let what = format!("{} starts with one more", place.name);
            with(Kind::Start, what, &|net| net.places[at].initial += 1);
        }
    }
    wrong
}

/// All firings, as something that can be compared: marking, name of the transition, marking.
fn firings<'g>(net: &Net<'g>, graph: &'g Graph) -> HashSet<(&'g [u32], &'g str, &'g [u32])> {
    let each = graph.firings.iter().zip(&graph.markings);
    let each = each.flat_map(|(firings, from)| firings.iter().map(move |&(by, to)| (from, by, to)));
    each.map(|(from, by, to)| (&from[..], net.transitions[by].name, &graph.markings[to][..]))
        .collect()
}

/// Mistakes, each with how many variants of its line have it.
type Mistakes<'m> = BTreeMap<&'m str, usize>;

fn list(text: &mut String, mistakes: &Mistakes<'_>) {
    for (what, count) in mistakes {
        let variants = if *count > 1 { format!(" ({count} variants)") } else { String::new() };
        writeln!(text, "       {what}{variants}").unwrap();
    }
}

/// Returns the defect in the roles of places, or the law that `net!` would refuse.
fn broken(net: &Net<'_>, graph: &Graph) -> Option<&'static str> {
    if laws::roles_are_broken(net, graph) {
        return Some("complement");
    }
    let packed = Packed::<1, 8>::alone(net).unwrap();
    let violation = net::judge(net, &packed.code()).err()?;
    Some(match violation.culprit {
        Culprit::Forever { .. } => "settles",
        _ => laws::name(&violation.law?),
    })
}

/// How many mutants there are, and how many of them the laws catch, are equivalent, are seen in the
/// table, and survive.
type Verdict = (usize, usize, usize, usize, usize);

/// Makes all mutants and writes down what becomes of them. `survive` says why some may.
fn judge(net: &Net<'_>, survive: &str) -> Verdict {
    let right = explore(net, MARKINGS).unwrap();
    assert_eq!(broken(net, &right), None);
    let (table, right) = (matrix(net, &right), firings(net, &right));
    let mutants = mutants(net);
    let (mut caught, mut seen) = (Mistakes::new(), BTreeMap::<Kind, Mistakes<'_>>::new());
    let (mut equivalent, mut survivors) = (Mistakes::new(), Mistakes::new());
    for Mutant { kind, what, net: wrong } in &mutants {
        let view = wrong.view();
        let wrong = view.net();
        let whose = match (wrong.defect(), explore(&wrong, MARKINGS)) {
            (Some(_), _) => caught.entry("definition"),
            (_, Err(Trouble::Bound)) => caught.entry("bound"),
            (_, Err(Trouble::TooMany)) => caught.entry("size"),
            (_, Ok(graph)) => match broken(&wrong, &graph) {
                Some(law) => caught.entry(law),
                None if firings(&wrong, &graph) == right => equivalent.entry(what),
                None if matrix(&wrong, &graph) != table => {
                    seen.entry(*kind).or_default().entry(what)
                }
                None => survivors.entry(what),
            },
        };
        *whose.or_default() += 1;
    }
    let sum = |mistakes: &Mistakes<'_>| mistakes.values().sum::<usize>();
    let all_seen = seen.values().map(sum).sum();
    let verdict = (mutants.len(), sum(&caught), sum(&equivalent), all_seen, sum(&survivors));

    let mut text = format!("{}: {} mutants\n\n{} caught by laws\n", net.name, verdict.0, verdict.1);
    for (law, count) in &caught {
        writeln!(text, "  {count:4} {law}").unwrap();
    }
    writeln!(text, "\n{} equivalent", verdict.2).unwrap();
    list(&mut text, &equivalent);
    writeln!(text, "\n{} seen only in the table of events", verdict.3).unwrap();
    for (kind, mistakes) in &seen {
        writeln!(text, "  {:4} {}", sum(mistakes), kind.reason()).unwrap();
        list(&mut text, mistakes);
    }
    writeln!(text, "\n{} survive", verdict.4).unwrap();
    if verdict.4 > 0 {
        writeln!(text, "  {survive}").unwrap();
        list(&mut text, &survivors);
    }
    golden::check(&format!("{}_mutants.txt", net.name), &text);
    assert_eq!(survive.is_empty(), verdict.4 == 0, "survivors have a reason: {survivors:#?}");
    verdict
}

#[test]
fn mistakes_in_the_door() {
    assert_eq!(judge(&door::NET, ""), (120, 103, 0, 17, 0));
}

#[test]
fn mistakes_in_the_watchdog() {
    assert_eq!(judge(&watchdog::NET, ""), (85, 66, 1, 18, 0));
}

#[test]
fn mistakes_in_the_charger() {
    assert_eq!(judge(&charger::NET, ""), (348, 305, 0, 43, 0));
}

#[test]
fn mistakes_in_the_crossing() {
    assert_eq!(judge(&crossing::NET, ""), (97, 92, 0, 5, 0));
}

#[test]
fn mistakes_in_the_request() {
    assert_eq!(judge(&ace::request::NET, ""), (36, 20, 0, 16, 0));
}

#[test]
fn mistakes_in_the_selection() {
    let rounds = "they matter in synchronous rounds only: between events the check takes no time";
    assert_eq!(judge(&ace::selection::NET, rounds), (1_848, 1_637, 35, 96, 80));
}

#[test]
fn mistakes_in_the_behaviour() {
    assert_eq!(judge(&ace::behaviour::NET, ""), (263, 220, 0, 43, 0));
}

#[test]
fn mistakes_in_the_accuracy() {
    let rounds = "they matter in synchronous rounds only: with five failed trials the accuracy \
                  falls at once";
    assert_eq!(judge(&ace::accuracy::NET, rounds), (538, 329, 0, 201, 8));
}
