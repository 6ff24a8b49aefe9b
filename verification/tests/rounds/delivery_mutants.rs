//! Every mutant of the shipped supervisors, and the requirement that it breaks first.

use crate::breaks::broken;
use crate::golden;
use crate::mutations::{Mutant, mutants};
use cotama_models::cotama::delivery;
use std::thread;

/// Global, local, both adapters, permit, observation module, contextual.
const SUPERVISORS: u16 = 7;

/// Mutants that break nothing, and why.
const HARMLESS: &[(&str, &[&str])] = &[
    (
        "no drive is under way there",
        &[
            "gs.abort.Deliver: without gs_abort",
            "gs.abort.Done: without gs_abort",
            "gs.abort.Receive: without gs_abort",
            "gs.abort.Wait: without gs_abort",
        ],
    ),
    (
        "the drive is idle and ignores the event, and starts only after it was read",
        &["ls.gs_abort empties ls.local_event"],
    ),
    (
        "nothing is planned there",
        &[
            "ls.abort.End: without stop_pp",
            "ls.abort.Following: without stop_pp",
            "ls.abort.HandOver: without stop_pp",
            "ls.abort.Teleoperated: without stop_pp",
            "ls.abort.Teleprogrammed: without stop_pp",
        ],
    ),
    (
        "no path is followed there",
        &[
            "ls.abort.End: without pf_stop",
            "ls.abort.HandOver: without pf_stop",
            "ls.abort.Planning: without pf_stop",
            "ls.abort.Teleoperated: without pf_stop",
            "ls.abort.Teleprogrammed: without pf_stop",
        ],
    ),
    (
        "the operator does not drive there",
        &[
            "ls.abort.End: without to_stop",
            "ls.abort.Following: without to_stop",
            "ls.abort.HandOver: without to_stop",
            "ls.abort.Planning: without to_stop",
            "ls.abort.Teleprogrammed: without to_stop",
        ],
    ),
    ("without sonars there is no localisation by particles either", &["pf.a1: without sonar"]),
    ("with localisation the line before it fires", &["pf.a2: without !mcl"]),
    (
        "it never fires: all particles are there",
        &[
            "pf.a6.level_1: without level >= 1",
            "pf.a8.level_1: without level >= 1",
            "pf.a19.level_0: not !avoidance",
            "pf.a19.level_0: without !avoidance",
            "pf.a19.level_1: not !avoidance",
            "pf.a19.level_1: without !avoidance",
            "pf.a19.level_1: without level >= 1",
            "pf.as1.level_1: without level >= 1",
        ],
    ),
    (
        "it never fires: some particles are gone",
        &[
            "pf.a7.level_2: not level >= 2",
            "pf.a7.level_2: without level >= 2",
            "pf.a9.level_2: not level >= 2",
            "pf.a9.level_2: without level >= 2",
            "pf.a20.level_2: not !avoidance",
            "pf.a20.level_2: without !avoidance",
            "pf.a20.level_2: not level >= 2",
            "pf.a20.level_2: without level >= 2",
            "pf.as2.level_2: not level >= 2",
            "pf.as2.level_2: without level >= 2",
        ],
    ),
    (
        "all particles are there",
        &[
            "cs.slow1: without level >= 1",
            "pf.a6.level_2: without level >= 2",
            "pf.a8.level_2: without level >= 2",
            "pf.a19.level_2: without level >= 2",
            "pf.as1.level_2: without level >= 2",
        ],
    ),
    (
        "at the floor the line before it fires",
        &[
            "pf.a7.level_1: without level >= 1",
            "pf.a9.level_1: without level >= 1",
            "pf.a20.level_1: without level >= 1",
            "pf.as2.level_1: without level >= 1",
            "pf.a23.level_1: without level >= 1",
            "pf.a24.level_1: without level >= 1",
            "pf.a25.level_1: without level >= 1",
            "pf.as5.level_1: without level >= 1",
        ],
    ),
    (
        "below all particles a line before it fires",
        &[
            "pf.a23.level_2: without level >= 2",
            "pf.a24.level_2: without level >= 2",
            "pf.a25.level_2: without level >= 2",
            "pf.as5.level_2: without level >= 2",
        ],
    ),
    (
        "without sonars a line before it fires",
        &["pf.a14: without sonar", "pf.a15: without sonar", "pf.a16: without sonar"],
    ),
    (
        "with SMZ a line before it fires",
        &["pf.a14: without !smz", "pf.a15: without !smz", "pf.a16: without !smz"],
    ),
    (
        "with localisation it is degraded as well, or a line before it fires",
        &["pf.a15: without mcl", "pf.a16: without !mcl"],
    ),
    (
        "with avoidance the line before it fires",
        &[
            "to.b2: without !sonar",
            "pf.a15: without !avoidance",
            "pf.a19.level_2: without !avoidance",
            "pf.a20.level_0: without !avoidance",
            "pf.a20.level_1: without !avoidance",
        ],
    ),
    (
        "what moves the robot was stopped just before: nothing is granted",
        &["permit.destroyed.Granted: to Withheld"],
    ),
    (
        "particles are at the floor in two sets only, with one answer",
        &[
            "cs.slow3.mcl_0: without reduced",
            "cs.slow3.mcl_1: without reduced",
            "cs.slow5.mcl_0: without reactive",
            "cs.slow5.mcl_1: without reactive",
        ],
    ),
    (
        "above the floor the line before it fires",
        &[
            "cs.slow3.mcl_0: without level < 1",
            "cs.slow3.mcl_1: without level < 1",
            "cs.slow5.mcl_0: without level < 1",
            "cs.slow5.mcl_1: without level < 1",
        ],
    ),
    (
        "with a link the line before it fires",
        &[
            "cs.ambiguous2: without !wifi",
            "cs.ambiguous4: without !wifi",
            "cs.camera2: without !wifi",
            "cs.collision2: without !wifi",
            "cs.collision4: without !wifi",
            "cs.hard2: without !wifi",
            "cs.hard4: without !wifi",
            "cs.hard6: without !wifi",
            "cs.planner2: without !wifi",
        ],
    ),
    ("without avoidance one of the lines before it fires", &["cs.collision5: without !degraded"]),
    ("no transition looks at it", &["cs.odometric = pf.Reactive, not pf.Odometric"]),
];

/// Variants that never fire: where they start, all particles are there, or some are gone.
const NEVER: &[&str] = &[
    "pf.a6.level_0",
    "pf.a6.level_1",
    "pf.a7.level_2",
    "pf.a8.level_0",
    "pf.a8.level_1",
    "pf.a9.level_2",
    "pf.a19.level_0",
    "pf.a19.level_1",
    "pf.a20.level_2",
    "pf.as1.level_0",
    "pf.as1.level_1",
    "pf.as2.level_2",
];

fn harmless(mutant: &Mutant) -> Option<&'static str> {
    let name = mutant.name.as_str();
    let of = name.split(':').next().unwrap_or(name);
    if ["goes elsewhere", "do dropped"].contains(&mutant.kind) && NEVER.contains(&of) {
        return Some("it never fires");
    }
    HARMLESS.iter().find(|it| it.1.contains(&name)).map(|it| it.0)
}

fn line(mutant: &Mutant) -> String {
    let known = match (broken(&mutant.system), harmless(mutant)) {
        (Ok(Some(id)), _) => format!("breaks {id}"),
        (Ok(None), Some(why)) => format!("harmless: {why}"),
        (Ok(None), None) => "survives".to_owned(),
        (Err(error), _) => format!("refused: {error}"),
    };
    let line = format!("{}: {} - {known}\n", mutant.kind, mutant.name);
    eprint!("{line}");
    line
}

/// The lines of mutants, found on two threads.
fn table(mutants: &[&Mutant]) -> String {
    let half =
        |from: usize| mutants.iter().skip(from).step_by(2).map(|it| line(it)).collect::<Vec<_>>();
    let (even, odd) = thread::scope(|scope| {
        let odd = scope.spawn(|| half(1));
        (half(0), odd.join().unwrap())
    });
    let odd = odd.into_iter().map(Some).chain([None]);
    even.into_iter().zip(odd).flat_map(|(even, odd)| [Some(even), odd]).flatten().collect()
}

/// The number of mutants of each kind that are not harmless, from all nets.
const EACH: usize = 5;

fn selected(all: &[Mutant]) -> Vec<&Mutant> {
    let mut kinds: Vec<_> = all.iter().map(|it| it.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let of = |kind| {
        let all: Vec<_> =
            all.iter().filter(|it| it.kind == kind && harmless(it).is_none()).collect();
        let step = all.len().div_ceil(EACH);
        all.into_iter().step_by(step).collect::<Vec<_>>()
    };
    kinds.into_iter().flat_map(of).collect()
}

/// The outcome of each mutant, as the long run wrote it.
const TABLE: &str = include_str!("../golden/rounds/mutants.txt");

#[test]
#[ignore = "minutes: CI runs it"]
fn mutants_of_each_kind_break_the_requirements_of_the_table() {
    let all = mutants(delivery::SYSTEM, SUPERVISORS);
    let made = table(&selected(&all));
    let wrong: Vec<_> = made.lines().filter(|line| !TABLE.lines().any(|it| it == *line)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(made.lines().filter(|it| it.contains(" - breaks ")).count() >= 45, "{made}");
}

#[test]
#[ignore = "40 minutes of one core when compiled with --release: 781 mutants"]
fn every_mutant_breaks_a_requirement_or_is_known_to_be_harmless() {
    let all = mutants(delivery::SYSTEM, SUPERVISORS);
    golden("mutants.txt", &table(&all.iter().collect::<Vec<_>>()));
}

/// The table takes too long to be made each time: here it is seen to be one of today's nets.
#[test]
fn the_table_gives_each_mutant_a_broken_requirement_or_a_reason() {
    let all = mutants(delivery::SYSTEM, SUPERVISORS);
    assert_eq!(TABLE.lines().count(), all.len());
    for (mutant, line) in all.iter().zip(TABLE.lines()) {
        let begins = format!("{}: {} - ", mutant.kind, mutant.name);
        let known = line.strip_prefix(&begins).unwrap_or_else(|| panic!("{begins}: {line}"));
        match (known.strip_prefix("harmless: "), harmless(mutant)) {
            (None, None) => {
                assert!(known.starts_with("breaks ") || known.starts_with("refused: "), "{line}");
            }
            (told, why) => assert_eq!(told, why, "{line}"),
        }
    }
    let named: Vec<_> = HARMLESS.iter().flat_map(|it| it.1).collect();
    assert!(named.iter().all(|name| all.iter().any(|it| it.name == **name)));
}
