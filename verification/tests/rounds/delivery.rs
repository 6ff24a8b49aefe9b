//! The requirements of the shipped decisional level, as questions to its net of rounds.
//!
//! The environment is every sequence of faults, answers and progress, one a round, at any time; so
//! what holds here holds for every pair of faults, and for all that follow one another, wherever
//! they come.

use crate::golden;
use cotama_models::cotama::{
    Asked, RECOVERY_REQUIREMENTS, REQUIREMENTS, Requirement, Watch, delivery,
};
use cotama_verification::certificate::{Certificate, Evidence, Formula, Question, verify};
use cotama_verification::check::{Checker, Model, Options, Verdict};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{FlatError, Looks, Rounds, Size, rounds};
use cotama_verification::property;
use cotama_verification::pt::Pt;
use std::fmt::Write;

/// Rounds, with what it takes to remember.
pub(crate) fn watched(of: &Rounds, watches: &[Watch]) -> Result<Rounds, FlatError> {
    let mut rounds = of.clone();
    for it in watches {
        let looks = if it.at_end { Looks::AtEnd } else { Looks::BeforeOutside };
        rounds.watch(it.name, looks, (it.begins, it.ends), it.most)?;
    }
    Ok(rounds)
}

/// The net of rounds and its graph.
pub(crate) fn explored(rounds: &Rounds) -> (Pt, Graph) {
    let pt = Pt::from(&rounds.net().unwrap().view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    (pt, graph)
}

fn with_evidence() -> Options<'static> {
    Options { evidence: true, ..Options::default() }
}

fn requirement(id: &str) -> &'static Requirement {
    REQUIREMENTS.iter().find(|it| it.id == id).unwrap()
}

#[test]
fn the_shipped_supervisors_have_110346_states_between_rounds() {
    let rounds = rounds(&delivery::SYSTEM).unwrap();
    let net = rounds.net().unwrap();
    assert_eq!(net.view().net().defect(), None);
    let (pt, graph) = explored(&rounds);
    assert_eq!((pt.places.len(), pt.transitions.len()), (253, 2_566));
    assert_eq!((graph.states(), graph.arcs()), (339_854, 446_584));
    assert_eq!(
        rounds.size(&graph),
        Size {
            states: cotama_golden::figure("delivery.states"),
            edges: cotama_golden::figure("delivery.steps")
        }
    );
}

/// Whether the comments of a file of tests name a requirement.
fn is_named(id: &str, file: &str) -> bool {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    let comments = text.lines().map(str::trim_start);
    let mut comments = comments.filter(|it| it.starts_with("///") || it.starts_with("//!"));
    comments.any(|it| it.split(|it: char| !it.is_alphanumeric()).any(|word| word == id))
}

#[test]
fn each_file_that_is_said_to_test_a_requirement_names_it() {
    let mut files = 0;
    for it in REQUIREMENTS.iter().chain(RECOVERY_REQUIREMENTS) {
        if let Some(file) = it.tests {
            assert!(is_named(it.id, file), "no test of {file} is said to be one of {}", it.id);
            files += 1;
        }
    }
    assert_eq!(files, 13);
    // The check is the job of the executive, and the net of the watchdog has no jobs.
    assert!(!is_named("WD5", "verification/tests/tpn/watchdog.rs"));
}

/// By which engine, among how many markings, with which evidence; `said` counts what transitions
/// must say. The small checker looks at the certificate where it is short, or where that is wanted.
fn known(
    of: &Requirement,
    plain: &Rounds,
    model: &Model,
    checker: &Checker<'_>,
    verified: bool,
) -> String {
    let mut line = of.id.to_owned();
    if let Some(asked) = of.asked {
        line += &if asked.watches.is_empty() {
            answered(of.id, asked.text, model, checker, verified)
        } else {
            let rounds = watched(plain, asked.watches).unwrap();
            let model = self::model(&rounds);
            let checker = checker.watched(&model, rounds.watching(), &with_evidence());
            answered(of.id, asked.text, &model, &checker, verified)
        };
    }
    for said in of.said {
        assert_eq!(said.unsaid(&delivery::SYSTEM).next(), None, "{}", of.id);
    }
    if !of.said.is_empty() {
        let _ = write!(line, " said {}", of.said.len());
    }
    for guarded in of.guarded {
        assert_eq!(guarded.unguarded(&delivery::SYSTEM).next(), None, "{}", of.id);
        line += " guarded";
    }
    if let Some(file) = of.tests {
        assert!(is_named(of.id, file), "no test of {file} is said to be one of {}", of.id);
        let _ = write!(line, " {file}");
    }
    line + "\n"
}

fn answered(id: &str, text: &str, model: &Model, checker: &Checker<'_>, verified: bool) -> String {
    let property = property::parse(text, model.pt()).unwrap();
    let answer = checker.answer(&property, &with_evidence());
    assert_eq!(answer.verdict, Verdict::Holds(true), "{id}");
    let is_short = matches!(answer.evidence, Evidence::Refutation(_));
    let certificate = answer.certificate(model.pt(), &property);
    if let (true, Ok(certificate)) = (verified || is_short, &certificate) {
        match verify(&certificate.text()) {
            Ok(verified) => assert!(verified.verdict && id != TOO_MUCH, "{id}"),
            Err(error) => {
                let said = "evidence.graph: is too much work to check";
                assert_eq!((id, error.to_string().as_str()), (TOO_MUCH, said));
            }
        }
    }
    let evidence = match answer.evidence {
        _ if certificate.is_err() => "uncertified",
        Evidence::Refutation(_) => "refutation",
        Evidence::Graph(_) => "graph",
        Evidence::Each(_) => "parts",
        Evidence::One(_) => "part",
        other => panic!("{id}: {other:?}"),
    };
    format!(" {} {} {evidence}", answer.engine(), answer.states)
}

fn model(rounds: &Rounds) -> Model {
    Model::from(&rounds.net().unwrap().view().net())
}

/// Returns the known verdicts of requirements, one a line.
fn all_known(of: impl Iterator<Item = &'static Requirement>, verified: bool) -> String {
    let plain = rounds(&delivery::SYSTEM).unwrap();
    let model = model(&plain);
    let checker = Checker::new(&model);
    of.map(|it| known(it, &plain, &model, &checker, verified)).collect()
}

#[test]
#[ignore = "a minute: CI runs it"]
fn every_requirement_holds() {
    golden("requirements.txt", &all_known(REQUIREMENTS.iter(), false));
}

/// So many requirements are quick.
const AT_ONCE: usize = 27;

/// The others of which a certificate is written, all of them with the graph.
const CERTIFIED: [&str; 5] = ["GS3", "GS6", "LS4", "CS5", "OB1"];

/// The requirement that is too much work for the small checker: a deadlock in each of 339,854
/// markings.
const TOO_MUCH: &str = "GS6";

/// Whether it takes no memory, and no deadlock, which the small checker writes out as twenty
/// thousand inequalities.
fn is_quick(asked: &Asked) -> bool {
    asked.watches.is_empty() && !asked.text.contains("deadlock")
}

/// As one formula, so that the small checker passes through the markings once.
#[test]
#[ignore = "takes minutes"]
fn the_small_checker_is_convinced_of_27_requirements_at_once() {
    let (pt, graph) = explored(&rounds(&delivery::SYSTEM).unwrap());
    let asked = REQUIREMENTS.iter().filter_map(|it| it.asked).filter(is_quick);
    let formulas = asked.map(|it| match property::parse(it.text, &pt).unwrap().question {
        property::Question::Formula(formula) => Formula::new(&pt, &formula.simplified()).unwrap(),
        other => panic!("{other:?}"),
    });
    let formulas: Vec<_> = formulas.collect();
    assert_eq!((formulas.len(), graph.states()), (AT_ONCE, 339_854));
    let question = Question::Formula(Formula::And(formulas));
    let certificate = Certificate::of(&pt, "all", question, true, Evidence::Graph(graph.states()));
    assert!(verify(&certificate.text()).unwrap().verdict);
}

#[test]
#[ignore = "195 s of one core when compiled with --release: the small checker passes through all \
    markings, plainly"]
fn the_small_checker_is_convinced_of_each_of_the_others_but_one() {
    let known = all_known(REQUIREMENTS.iter().filter(|it| is_other(it)), true);
    assert_eq!(with_a_graph(known.lines()), CERTIFIED, "{known}");
}

fn is_other(of: &Requirement) -> bool {
    of.asked.is_some_and(|it| !is_quick(&it))
}

/// The requirements of the lines that say that a certificate holds the graph.
fn with_a_graph<'t>(known: impl Iterator<Item = &'t str>) -> Vec<&'t str> {
    let lines = known.map(|it| it.split_whitespace().collect::<Vec<_>>());
    lines.filter(|it| it.contains(&"graph")).map(|it| it[0]).collect()
}

/// The certificates that the small checker is asked for by hand, beside those known today: all
/// other questions are quick, or certified, or have more than 500,000 markings.
#[test]
fn the_certificates_for_the_small_checker_are_those_of_the_golden_file() {
    let quick = REQUIREMENTS.iter().filter_map(|it| it.asked).filter(is_quick);
    assert_eq!(quick.count(), AT_ONCE);
    let others: Vec<_> = REQUIREMENTS.iter().filter(|it| is_other(it)).map(|it| it.id).collect();
    let golden = include_str!("../golden/rounds/requirements.txt");
    let of = |others: bool| {
        let of = move |it: &&str| {
            let id = it.split_whitespace().next();
            requirement(id.unwrap()).asked.is_some() && is_other(requirement(id.unwrap())) == others
        };
        golden.lines().filter(of)
    };
    assert_eq!(with_a_graph(of(true)), CERTIFIED);
    let uncertified = |it: &&str| it.contains(" uncertified");
    let left: Vec<_> = of(true).filter(uncertified).map(|it| &it[..3]).collect();
    assert_eq!((left, others.len()), (vec!["LS3", "AS2"], CERTIFIED.len() + 2));
    assert_eq!((of(false).count(), of(false).filter(uncertified).count()), (AT_ONCE, 0));
}

/// The most that the watches in a requirement's text count when they may count further: the worst
/// cases of its duties in rounds.
fn worst(id: &str) -> Vec<u32> {
    const MANY: u32 = 6;
    let asked = requirement(id).asked.unwrap();
    let (watches, plain) = (asked.watches, rounds(&delivery::SYSTEM).unwrap());
    let of = |(at, it): (usize, &Watch)| {
        let mut watches = watches.to_vec();
        watches.truncate(at + 1);
        let uses = |of: &Watch| it.begins.split_whitespace().any(|word| word == of.name);
        watches.retain(|of| uses(of) || of.name == it.name);
        watches.last_mut().unwrap().most = MANY;
        let (pt, graph) = explored(&watched(&plain, &watches).unwrap());
        graph.tokens(pt.place(it.name).unwrap()).max().unwrap()
    };
    watches.iter().enumerate().filter(|it| asked.text.contains(it.1.name)).map(of).collect()
}

/// GS3: the round in which the event is mailed is the first one. How long the robot takes to stand
/// is for its brakes to say.
#[test]
#[ignore = "seconds each: CI runs it"]
fn a_global_event_is_answered_in_the_next_round() {
    assert_eq!(worst("GS3"), [1]);
}

/// LS3: the round of the failure is over once, the round of the decision is over once; then the
/// operator is asked.
#[test]
fn a_hard_failure_is_answered_after_two_rounds() {
    assert_eq!(worst("LS3"), [1]);
}

/// LS4: what bounds how long the robot waits is the patience of whoever says that no answer comes;
/// no round does. Once it is said, the mission stops after two rounds.
#[test]
#[ignore = "seconds each: CI runs it"]
fn a_refusal_stops_the_mission_after_two_rounds() {
    assert_eq!(worst("LS4"), [2]);
}

/// AS2, by loss: localisation, sonars, both avoidances, camera, link, what is vital.
#[test]
#[ignore = "a minute: CI runs it"]
fn a_lost_part_is_used_for_two_rounds_at_most() {
    assert_eq!(worst("AS2"), [2; 7]);
}

#[test]
#[ignore = "seconds each: CI runs it"]
fn an_operator_out_of_reach_is_waited_for_at_most_two_rounds() {
    assert_eq!(worst("CS5"), [2]);
}

/// OB1.
#[test]
fn an_unwatched_camera_is_used_for_at_most_two_rounds() {
    assert_eq!(worst("OB1"), [2]);
}

/// AS5 and CS3: in the round after it was mailed an adapter event is read before the contextual
/// supervisor decides again, and a flag is reported and decided upon before anything else comes
/// from outside.
#[test]
#[ignore = "seconds each: CI runs it"]
fn an_adapter_event_and_a_report_take_one_round() {
    let (pt, graph) = explored(&rounds(&delivery::SYSTEM).unwrap());
    let places = |part: &str| {
        let is = |it: &(usize, &String)| it.1.contains(part) && it.1.ends_with(".waiting");
        pt.places.iter().enumerate().filter(is).map(|it| it.0).collect::<Vec<_>>()
    };
    let adapters = places(".adapt_");
    let reports: Vec<_> = places("cs.").into_iter().chain(places("_flag")).collect();
    assert_eq!((adapters.len(), reports.len()), (9, 27));
    let turns = pt.places.iter().enumerate().filter(|it| it.1.starts_with("turn.cs."));
    let turns: Vec<_> = turns.map(|it| it.0).collect();
    let outside = pt.place("turn.outside").unwrap().0 as usize;
    let mut decided = 0;
    for state in 0..graph.states() as u32 {
        let marking = graph.marking(state);
        let waits = |places: &[usize]| places.iter().any(|&it| marking[it] > 0);
        let decides = waits(&turns);
        decided += u32::from(decides);
        assert!(!(decides && waits(&adapters)));
        assert!(!(marking[outside] > 0 && waits(&reports)));
    }
    assert!(decided > 1_000);
}
