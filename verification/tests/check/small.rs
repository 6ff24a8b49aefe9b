//! Thousands of small nets: what each engine answers is so by the book, every certificate verifies,
//! every run shows its verdict.

use crate::check::mutations::{self, Changed};
use crate::check::{nets, replay};
use crate::properties::oracle::{self, Space};
use crate::properties::random::{self, Random};
use cotama_core::net::PlaceId;
use cotama_verification::certificate::verify;
use cotama_verification::check::{Answer, Choice, Extent, Model, Options, Verdict, check_all};
use cotama_verification::property::{Formula, Property, Question};
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;

/// One of so many nets has its certificates changed.
const CHANGED: usize = 10;

/// One question of each sort.
fn questions(random: &mut Random, pt: &Pt) -> Vec<Property> {
    let goal = random::state(random, pt, 2);
    let reached = if random.below(2) == 0 {
        Formula::Exists(Formula::Finally(goal.into()).into())
    } else {
        Formula::All(Formula::Globally(goal.into()).into())
    };
    let branching = random::branching(random, pt, 3);
    // Seldom a formula has quantifiers inside of what is said of runs, as neither CTL nor LTL has.
    let mixed = random.below(20) == 0;
    let path = random::path(random, pt, 2, mixed);
    let linear = random::quantified(random, path);
    let place = |random: &mut Random| PlaceId(random.below(pt.places.len()) as u32);
    let sum = (0..=random.below(3)).map(|_| place(random)).collect();
    let deadlock = Formula::Atom(cotama_verification::property::Atom::Deadlock);
    let global = match random.below(5) {
        0 => Question::Liveness,
        1 => Question::QuasiLiveness,
        2 => Question::StableMarking,
        3 => Question::OneSafe,
        _ => Question::Formula(Formula::Exists(Formula::Finally(deadlock.into()).into())),
    };
    let mut all: Vec<Question> = [reached, branching, linear].map(Question::Formula).into();
    all.extend([Question::Bound(sum), global]);
    all.into_iter().map(|question| crate::check::named(question, pt)).collect()
}

/// The verdict by the book.
fn expected(space: &Space<'_>, question: &Question) -> Verdict {
    match question {
        Question::Bound(places) => Verdict::Bound(Extent::Finite(oracle::bound(space.net, places))),
        question => Verdict::Holds(oracle::verdict(space.net, question).unwrap()),
    }
}

/// Checks the run of an answer; whether there is one.
fn run_shows(space: &Space<'_>, property: &Property, answer: &Answer) -> bool {
    let there = replay::replays(space.net, &property.question, answer);
    if let (true, Question::Formula(formula), Verdict::Holds(holds)) =
        (there, &property.question, &answer.verdict)
    {
        let run = answer.run.as_ref().unwrap();
        let formula = formula.simplified();
        // A quantifier over runs inside another one can need more than one run to be shown.
        let quantified = |it: &Formula| matches!(it, Formula::Exists(_) | Formula::All(_));
        let single = match &formula {
            Formula::Exists(path) | Formula::All(path) => !path.any(&quantified),
            _ => false,
        };
        let shown = replay::shows(space, &formula, *holds, run);
        assert!(shown || !single, "{}\n{run:?}\n{:#?}", property.name, space.net);
    }
    there
}

#[derive(Debug, Default)]
struct Counts {
    /// Answers by the engine that was chosen and the one that decided.
    answered: BTreeMap<(&'static str, &'static str), usize>,
    unknown: BTreeMap<&'static str, usize>,
    runs: usize,
    certified: usize,
    /// With evidence asked for, of the engines that are chosen by themselves.
    uncertified: usize,
    changed: Changed,
}

const CHOICES: [(&str, Choice); 4] = [
    ("auto", Choice::Auto),
    ("structural", Choice::Structural),
    ("stubborn", Choice::Stubborn),
    ("explicit", Choice::Explicit),
];

/// Asks a net everything, in every way.
fn ask(pt: &Pt, random: &mut Random, change: bool, counts: &mut Counts) {
    let model = Model::from(pt.clone());
    let (space, properties) = (Space::new(pt), questions(random, pt));
    let expected: Vec<Verdict> =
        properties.iter().map(|it| expected(&space, &it.question)).collect();
    for (choice, engine) in CHOICES {
        for evidence in [false, true] {
            let options = Options { engine, evidence, ..Options::default() };
            let answers = check_all(&model, &properties, &options);
            for ((property, answer), expected) in properties.iter().zip(&answers).zip(&expected) {
                if matches!(answer.verdict, Verdict::Unknown(_)) {
                    *counts.unknown.entry(choice).or_default() += 1;
                    continue;
                }
                let text = || {
                    format!("{choice}, evidence {evidence}: {}\n{answer:?}\n{pt:#?}", property.name)
                };
                assert_eq!(&answer.verdict, expected, "{}", text());
                *counts.answered.entry((choice, answer.engine())).or_default() += 1;
                counts.runs += usize::from(run_shows(&space, property, answer));
                let Ok(certificate) = answer.certificate(pt, property) else {
                    counts.uncertified += usize::from(evidence && engine == Choice::Auto);
                    continue;
                };
                verify(&certificate.text()).unwrap_or_else(|error| panic!("{error}\n{}", text()));
                counts.certified += 1;
                if change && evidence && engine == Choice::Auto {
                    mutations::change(&certificate, 11, random, &mut counts.changed);
                }
            }
        }
    }
}

/// Asks so many nets.
fn counts(nets: usize) -> Counts {
    let (mut random, mut counts) = (Random(6), Counts::default());
    let mut asked = 0;
    while asked < nets {
        let pt = nets::any(&mut random);
        if nets::markings(&pt, 40).is_none() {
            continue;
        }
        ask(&pt, &mut random, asked % CHANGED == 0, &mut counts);
        asked += 1;
    }
    counts
}

#[test]
fn a_thousand_small_nets_are_as_the_book_says() {
    let counts = counts(1_000);
    // By itself it always answers.
    assert_eq!(counts.unknown, BTreeMap::from([("structural", 430), ("stubborn", 2_414)]));
    let answered: usize = counts.answered.values().sum();
    let Changed { refused, true_again, open } = counts.changed;
    assert_eq!(
        (answered, counts.runs, counts.certified, counts.uncertified, refused, true_again, open),
        (37_156, 16_256, 29_884, 72, 4_817, 608, 9)
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn twenty_thousand_small_nets_are_as_the_book_says() {
    let counts = counts(20_000);
    assert_eq!(counts.unknown, BTreeMap::from([("structural", 8_654), ("stubborn", 48_102)]));
    for (choice, engine, least) in [
        ("auto", "structural", 80_000),
        ("auto", "stubborn", 36_000),
        ("auto", "explicit", 6_000),
        ("auto", "temporal", 27_000),
        ("auto", "reductions", 10_000),
        ("structural", "structural", 108_000),
        ("stubborn", "stubborn", 60_000),
        ("explicit", "explicit", 124_000),
    ] {
        assert!(counts.answered[&(choice, engine)] >= least, "{choice}, {engine}: {counts:?}");
    }
    assert!(
        counts.runs > 320_000 && counts.certified > 580_000 && counts.uncertified < 3_000,
        "{counts:?}"
    );
    let Changed { refused, true_again, open } = counts.changed;
    assert!(refused > 94_000 && true_again > 10_000 && open < 400, "{refused} {true_again} {open}");
}
