//! Every mutant of the shipped supervisors, and the requirement that it breaks first.

use crate::delivery::{explored, watched};
use crate::golden;
use crate::mutations::{Mutant, mutants};
use cotama_core::system::System;
use cotama_models::cotama::{Asked, REQUIREMENTS, Requirement, delivery};
use cotama_verification::explicit::Graph;
use cotama_verification::property::{Ctl, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};

/// Global, local, both adapters, permit, observation module, contextual.
const SUPERVISORS: u16 = 7;

fn holds(asked: &Asked, pt: &Pt, graph: &Graph) -> bool {
    let Question::Formula(formula) = parse(asked.text, pt).unwrap().question else {
        panic!("{}", asked.text)
    };
    ctl(graph, &Ctl::new(&formula.simplified()).unwrap(), &Fairness::default()).verdict
}

/// The requirement that a system breaks: the first one of what transitions say, then of what needs no memory, then of the others.
fn broken(system: &System<'_>) -> Option<&'static str> {
    let unsaid = |it: &&Requirement| it.said.iter().any(|said| said.unsaid(system).next().is_some());
    if let Some(it) = REQUIREMENTS.iter().find(unsaid) {
        return Some(it.id);
    }
    let Ok(plain) = watched(system, &[]) else { return Some("(no system)") };
    let (pt, graph) = explored(&plain);
    let asked = || REQUIREMENTS.iter().filter_map(|it| Some((it.id, it.asked?)));
    let mut simple = asked().filter(|it| it.1.watches.is_empty());
    if let Some((id, _)) = simple.find(|it| !holds(&it.1, &pt, &graph)) {
        return Some(id);
    }
    let mut others = asked().filter(|it| !it.1.watches.is_empty());
    let breaks = |it: &(&str, Asked)| {
        let (pt, graph) = explored(&watched(system, it.1.watches).unwrap());
        !holds(&it.1, &pt, &graph)
    };
    others.find(breaks).map(|it| it.0)
}

/// Mutants that break nothing, and why.
const HARMLESS: [(&str, &str); 7] = [
    (
        "ls.gs_abort empties ls.local_event",
        "the drive is idle and ignores the event, and starts only after it was read",
    ),
    ("pf.as1.level_0: level stays", "it never fires"),
    ("pf.a9.level_1: without level >= 1", "at the floor the line before it fires"),
    ("cs.slow3.mcl_1: without level < 1", "above the floor the line before it fires"),
    ("cs.collision2: without !wifi", "with a link the line before it fires"),
    ("ls.abort.Teleprogrammed: without stop_pp", "nothing is planned there"),
    (
        "ls.camera = gom.wifi, not gom.camera",
        "the operator of this environment does not ask to drive without a camera: the guard is a second line",
    ),
];

fn line(mutant: &Mutant) -> String {
    let harmless = || HARMLESS.iter().find(|it| it.0 == mutant.name).map_or("survives", |it| it.1);
    match broken(&mutant.system) {
        Some(id) => format!("{}: {} - breaks {id}\n", mutant.kind, mutant.name),
        None => format!("{}: {} - harmless, {}\n", mutant.kind, mutant.name, harmless()),
    }
}

/// Of each kind so many, from all nets.
const EACH: usize = 5;

fn selected(all: &[Mutant]) -> Vec<&Mutant> {
    let mut kinds: Vec<_> = all.iter().map(|it| it.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let of = |kind| {
        let all: Vec<_> = all.iter().filter(|it| it.kind == kind).collect();
        let step = all.len().div_ceil(EACH);
        all.into_iter().step_by(step).collect::<Vec<_>>()
    };
    kinds.into_iter().flat_map(of).collect()
}

fn table(mutants: &[&Mutant]) -> String {
    let lines = mutants.iter().map(|it| {
        let line = line(it);
        eprint!("{line}");
        line
    });
    lines.collect()
}

#[test]
#[ignore = "takes ten minutes of one core"]
fn mutants_of_each_kind_break_a_requirement() {
    let all = mutants(delivery::SYSTEM, SUPERVISORS);
    let table = table(&selected(&all));
    golden("mutants_selected.txt", &table);
    assert!(!table.contains("survives"), "{table}");
    assert!(table.lines().filter(|it| it.contains(" - breaks ")).count() >= 40);
}

/// Says of each mutant what it breaks; those that survive are for a person to look at.
#[test]
#[ignore = "takes half an hour of one core when compiled with --release"]
fn most_of_all_mutants_break_a_requirement() {
    let all = mutants(delivery::SYSTEM, SUPERVISORS);
    let table = table(&all.iter().collect::<Vec<_>>());
    let breaking = table.lines().filter(|it| it.contains(" - breaks ")).count();
    eprintln!("{breaking} of {}", all.len());
    assert!(10 * breaking >= 8 * all.len(), "{table}");
}
