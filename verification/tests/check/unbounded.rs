//! Nets with infinitely many markings: what is answered is never at odds with the markings that are
//! met first, and a run or a certificate shows it.

use crate::check::{nets, replay};
use crate::properties::random::{self, Random};
use cotama_core::net::PlaceId;
use cotama_verification::certificate::verify;
use cotama_verification::check::{Extent, Model, Options, Verdict, check_all};
use cotama_verification::coverability::{self, Bounded};
use cotama_verification::explicit::Limits;
use cotama_verification::property::{Formula, Property, Question};
use cotama_verification::pt::Pt;
use std::collections::{BTreeSet, VecDeque};

/// The first markings, breadth first.
fn first(pt: &Pt, most: usize) -> Vec<Vec<u32>> {
    let mut met = BTreeSet::from([pt.initial.clone()]);
    let (mut waiting, mut order) = (VecDeque::from([pt.initial.clone()]), Vec::new());
    while let Some(marking) = waiting.pop_front().filter(|_| order.len() < most) {
        for transition in (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(&marking, it)) {
            let after = pt.fire(&marking, transition).unwrap();
            if met.insert(after.clone()) {
                waiting.push_back(after);
            }
        }
        order.push(marking);
    }
    order
}

fn questions(random: &mut Random, pt: &Pt) -> Vec<Property> {
    let goal = random::state(random, pt, 2);
    let reached = Formula::Exists(Formula::Finally(goal.into()).into());
    let branching = random::branching(random, pt, 2);
    let path = random::path(random, pt, 2, false);
    let linear = random::quantified(random, path);
    let mut all: Vec<Question> = [reached, branching, linear].map(Question::Formula).into();
    all.extend((0..pt.places.len() as u32).map(|it| Question::Bound(vec![PlaceId(it)])));
    all.push(Question::Bound(vec![PlaceId(0), PlaceId(1)]));
    all.extend([
        Question::Liveness,
        Question::QuasiLiveness,
        Question::StableMarking,
        Question::OneSafe,
    ]);
    all.into_iter().map(|question| crate::check::named(question, pt)).collect()
}

#[derive(Debug, Default, PartialEq, Eq)]
struct Counts {
    finite: usize,
    /// Finite, and among the first markings is one with so many tokens.
    met: usize,
    infinite: usize,
    /// Infinite, with a certificate.
    grows: usize,
    reached: usize,
    never: usize,
    others: usize,
    unknown: usize,
}

fn compare(pt: &Pt, random: &mut Random, evidence: bool, counts: &mut Counts) {
    let (model, properties, first) =
        (Model::from(pt.clone()), questions(random, pt), first(pt, 200));
    let limits = Limits { states: 1_000, ..Limits::default() };
    let answers =
        check_all(&model, &properties, &Options { evidence, limits, ..Options::default() });
    for (property, answer) in properties.iter().zip(&answers) {
        let text = || format!("{}\n{answer:?}\n{pt:#?}", property.name);
        replay::replays(pt, &property.question, answer);
        let certificate = answer.certificate(pt, property);
        if let Ok(it) = &certificate {
            verify(&it.text()).unwrap_or_else(|error| panic!("{error}\n{}", text()));
        }
        match (&property.question, &answer.verdict) {
            (_, Verdict::Unknown(_)) => counts.unknown += 1,
            (Question::Bound(places), Verdict::Bound(extent)) => {
                let sum = |it: &Vec<u32>| {
                    places.iter().map(|at| u64::from(it[at.0 as usize])).sum::<u64>()
                };
                let most = first.iter().map(sum).max().unwrap();
                match extent {
                    Extent::Finite(bound) => {
                        assert!(most <= *bound, "{}", text());
                        counts.finite += 1;
                        counts.met += usize::from(most == *bound);
                    }
                    Extent::Infinite => {
                        counts.infinite += 1;
                        counts.grows += usize::from(certificate.is_ok());
                    }
                }
            }
            (Question::QuasiLiveness, Verdict::Holds(holds)) => {
                let fires = |it: u32| first.iter().any(|marking| pt.enabled(marking, it));
                assert!(*holds || !(0..pt.transitions.len() as u32).all(fires), "{}", text());
                counts.others += 1;
            }
            (Question::StableMarking, Verdict::Holds(holds)) => {
                let stays = |it: usize| first.iter().all(|marking| marking[it] == pt.initial[it]);
                assert!(!*holds || (0..pt.places.len()).any(stays), "{}", text());
                counts.others += 1;
            }
            (Question::OneSafe, Verdict::Holds(holds)) => {
                assert!(!*holds, "{}", text());
                counts.others += 1;
            }
            (Question::Formula(Formula::Exists(path)), Verdict::Holds(holds)) => match &**path {
                Formula::Finally(goal) if goal.is_state() => {
                    let found = first.iter().any(|it| replay::meets(pt, it, goal));
                    assert!(*holds || !found, "{}", text());
                    *(if *holds { &mut counts.reached } else { &mut counts.never }) += 1;
                }
                _ => counts.others += 1,
            },
            _ => counts.others += 1,
        }
    }
}

#[test]
fn verdicts_on_twenty_unbounded_nets_agree_with_their_markings() {
    let (mut random, mut counts, mut compared) = (Random(7), Counts::default(), 0);
    while compared < 20 {
        let pt = nets::any(&mut random);
        let limits = Limits { states: 2_000, ..Limits::default() };
        if !matches!(coverability::bounded(&pt, &limits), Bounded::No(_)) {
            continue;
        }
        compare(&pt, &mut random, compared % 2 == 0, &mut counts);
        compared += 1;
    }
    let expected = Counts {
        finite: 54,
        met: 54,
        infinite: 42,
        grows: 21,
        reached: 18,
        never: 4,
        others: 103,
        unknown: 15,
    };
    assert_eq!(counts, expected);
}
