//! Random nets: counts, graphs and verdicts are those of the explorer; certificates are believed,
//! and changed ones only where what they claim is so.

use super::own::{self, Own};
use crate::check::mutations::{self, Changed};
use crate::check::named;
use crate::properties::oracle::Space;
use crate::properties::random::{self, Random};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::certificate::verify;
use cotama_verification::check::{Choice, Extent, Model, Options, Verdict, check_all};
use cotama_verification::explicit::{Graph, Limits, statespace};
use cotama_verification::property::{Atom, Formula, Property, Question};
use cotama_verification::pt::Pt;
use std::collections::BTreeSet;

#[derive(Debug, Default)]
struct Counts {
    answered: usize,
    unknown: usize,
    runs: usize,
    certified: usize,
    holding: usize,
    changed: Changed,
    inhibitors: usize,
    reads: usize,
    resets: usize,
    priorities: usize,
    /// Nets in which these arcs change what is reachable.
    telling: usize,
}

fn questions(random: &mut Random, pt: &Pt) -> Vec<Property> {
    let goal = random::state(random, pt, 2);
    let reached = if random.below(2) == 0 {
        Formula::Exists(Formula::Finally(goal.into()).into())
    } else {
        Formula::All(Formula::Globally(goal.into()).into())
    };
    let branching = random::branching(random, pt, 3);
    let path = random::path(random, pt, 2, false);
    let linear = random::quantified(random, path);
    let place = |random: &mut Random| PlaceId(random.below(pt.places.len()) as u32);
    let sum = (0..=random.below(3)).map(|_| place(random)).collect();
    let deadlock = Formula::Exists(Formula::Finally(Formula::Atom(Atom::Deadlock).into()).into());
    let transition = TransitionId(random.below(pt.transitions.len()) as u32);
    let fires = Formula::Atom(Atom::Fireable(vec![transition]));
    let global = match random.below(5) {
        0 => Question::Liveness,
        1 => Question::QuasiLiveness,
        2 => Question::StableMarking,
        3 => Question::OneSafe,
        _ => Question::Formula(Formula::All(Formula::Finally(fires.into()).into())),
    };
    let mut all: Vec<_> = [reached, branching, linear, deadlock].map(Question::Formula).into();
    all.extend([Question::Bound(sum), global]);
    all.into_iter().map(|question| named(question, pt)).collect()
}

fn expected(space: &Space<'_>, question: &Question) -> Verdict {
    if let Question::Bound(places) = question {
        let sum = |it: &Vec<u32>| places.iter().map(|at| u64::from(it[at.0 as usize])).sum::<u64>();
        return Verdict::Bound(Extent::Finite(space.markings.iter().map(sum).max().unwrap()));
    }
    Verdict::Holds(space.verdict(question).unwrap())
}

/// Compares counts and graph, packed, on one and two threads.
fn compare_counts(pt: &Pt, space: &Space<'_>) {
    let limits = Limits::default();
    for jobs in [1, 2] {
        let found = statespace(pt, &limits, jobs, &|_| ());
        assert_eq!(found.limit, None, "{pt:#?}");
        assert_ne!(found.bounded, Some(false), "{pt:#?}");
        let (dead, arcs) = (
            space.enabled.iter().filter(|it| it.is_empty()).count() as u64,
            space.enabled.iter().map(Vec::len).sum::<usize>() as u64,
        );
        let counted = (found.states, found.arcs, found.dead_markings);
        assert_eq!(counted, (space.markings.len() as u64, arcs, dead), "{pt:#?}");
        let most = |at: usize| space.markings.iter().map(|it| u64::from(it[at])).max().unwrap();
        let bounds: Vec<u64> = (0..pt.places.len()).map(most).collect();
        assert_eq!(found.bounds, bounds, "{pt:#?}");
        let fired: BTreeSet<u32> = space.enabled.iter().flatten().copied().collect();
        let never = (0..pt.transitions.len() as u32).filter(|it| !fired.contains(it));
        assert_eq!(found.dead_transitions, never.map(TransitionId).collect::<Vec<_>>(), "{pt:#?}");
        same_graph(&Graph::on(pt, &limits, jobs, &|_| ()).unwrap(), space);
    }
}

/// The explorer fires transitions in their order and meets markings breadth first, as the graph.
fn same_graph(graph: &Graph, space: &Space<'_>) {
    assert_eq!(graph.states(), space.markings.len());
    for (state, marking) in (0..).zip(&space.markings) {
        assert_eq!(graph.marking(state)[..marking.len()], marking[..], "{:#?}", space.net);
        let fired: Vec<u32> = graph.transitions(state).iter().map(|it| it.0).collect();
        assert_eq!(fired, space.enabled[state as usize], "{:#?}", space.net);
        let leads: Vec<usize> = graph.successors(state).iter().map(|it| *it as usize).collect();
        assert_eq!(leads, space.successors[state as usize], "{:#?}", space.net);
    }
}

/// The same net beside so many places that markings are too wide to be packed.
fn wide(net: &Own) -> Own {
    let mut wide = net.clone();
    wide.places.extend((0..300).map(|at| (format!("far{at}"), 1 << 31)));
    wide
}

fn ask(net: &Own, random: &mut Random, number: usize, counts: &mut Counts) {
    let pt = net.pt();
    let Some(space) = net.space(&pt, 40) else { return };
    compare_counts(&pt, &space);
    if number.is_multiple_of(10) {
        let pt = wide(net).pt();
        same_graph(&Graph::new(&pt, &Limits::default(), &|_| ()).unwrap(), &space);
        let found = statespace(&pt, &Limits::default(), 1, &|_| ());
        assert_eq!(found.states, space.markings.len() as u64);
    }
    let (model, properties) = (Model::from(pt.clone()), questions(random, &pt));
    let wanted: Vec<_> = properties.iter().map(|it| expected(&space, &it.question)).collect();
    let choices = [
        (Choice::Auto, false),
        (Choice::Auto, true),
        (Choice::Explicit, false),
        (Choice::Structural, false),
        (Choice::Stubborn, true),
    ];
    for (engine, evidence) in choices {
        let options = Options { engine, evidence, ..Options::default() };
        let answers = check_all(&model, &properties, &options);
        for ((property, answer), wanted) in properties.iter().zip(&answers).zip(&wanted) {
            let text = || format!("{engine:?}, {evidence}: {}\n{answer:?}\n{pt:#?}", property.name);
            if matches!(answer.verdict, Verdict::Unknown(_)) {
                assert!(matches!(engine, Choice::Structural | Choice::Stubborn), "{}", text());
                counts.unknown += 1;
                continue;
            }
            assert_eq!(answer.verdict, *wanted, "{}", text());
            counts.answered += 1;
            counts.holding += usize::from(answer.verdict == Verdict::Holds(true));
            if let Some(run) = &answer.run {
                let mut marking = pt.initial.clone();
                for it in &run.stem {
                    assert!(net.enabled(&marking).contains(&it.0), "{}", text());
                    marking = net.fire(&marking, it.0).unwrap();
                }
                counts.runs += 1;
            }
            let Ok(certificate) = answer.certificate(&pt, property) else { continue };
            let shown = verify(&certificate.text());
            shown.unwrap_or_else(|error| panic!("{error}\n{}", text()));
            certificate.is_about(&pt, property).unwrap();
            counts.certified += 1;
            if evidence && engine == Choice::Auto && number.is_multiple_of(5) {
                mutations::change(&certificate, 11, random, &mut counts.changed);
            }
        }
    }
}

fn counts(nets: usize) -> Counts {
    let (mut random, mut counts, mut asked) = (Random(37), Counts::default(), 0);
    while asked < nets {
        let net = own::any(&mut random);
        let Some((markings, ..)) = net.explored(40) else { continue };
        ask(&net, &mut random, asked, &mut counts);
        asked += 1;
        counts.inhibitors += net.moves.iter().map(|it| it.inhibit.len()).sum::<usize>();
        counts.reads += net.moves.iter().map(|it| it.read.len()).sum::<usize>();
        counts.resets += net.moves.iter().map(|it| it.reset.len()).sum::<usize>();
        let first = net.moves[0].priority;
        counts.priorities += usize::from(net.moves.iter().any(|it| it.priority != first));
        let mut plain = net.clone();
        for it in &mut plain.moves {
            (it.inhibit, it.reset, it.priority) = (Vec::new(), Vec::new(), 0);
        }
        let same = plain.explored(40).is_some_and(|it| it.0 == markings);
        counts.telling += usize::from(!same);
    }
    counts
}

#[test]
fn five_hundred_nets_are_as_the_explorer_says() {
    let counts = counts(500);
    assert!(counts.telling > 250 && counts.priorities > 50, "{counts:?}");
    assert!(counts.changed.refused > 2_000 && counts.changed.open < 100, "{counts:?}");
    assert!(counts.certified > 3_000 && counts.runs > 1_000, "{counts:?}");
}

#[test]
#[ignore = "some minutes: CI runs it"]
fn twenty_thousand_nets_are_as_the_explorer_says() {
    let counts = counts(20_000);
    println!("{counts:?}");
    assert!(counts.telling > 10_000 && counts.priorities > 2_000, "{counts:?}");
    assert!(counts.changed.refused > 80_000 && counts.changed.open < 4_000, "{counts:?}");
}

/// A goal that is never reached is not among the first markings of an unbounded net.
#[test]
fn unbounded_nets_are_not_spoken_of_wrongly() {
    let (mut random, mut asked, mut never, mut found) = (Random(41), 0, 0, 0);
    let limits = Limits { states: 20_000, ..Limits::default() };
    while asked < 400 {
        let net = own::any(&mut random);
        if net.explored(60).is_some() {
            continue;
        }
        asked += 1;
        let pt = net.pt();
        let space = net.first(&pt, 200);
        let model = Model::from(pt.clone());
        let goal = random::state(&mut random, &pt, 2);
        let met = space.satisfying(&goal).contains(&true);
        let reached = Question::Formula(Formula::Exists(Formula::Finally(goal.into()).into()));
        let options = Options { limits, ..Options::default() };
        let answer = &check_all(&model, &[named(reached, &pt)], &options)[0];
        match answer.verdict {
            Verdict::Holds(true) => found += 1,
            Verdict::Holds(false) => {
                assert!(!met, "{answer:?}\n{pt:#?}");
                never += 1;
            }
            _ => {}
        }
        if statespace(&pt, &limits, 1, &|_| ()).bounded == Some(true) {
            assert!(net.explored(20_000).is_some(), "{pt:#?}");
        }
    }
    assert!(never > 20 && found > 200, "{never} {found}");
}

/// Without any of these arcs nothing is special.
#[test]
fn a_net_without_such_arcs_is_the_plain_one() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut net = own::any(&mut random);
        for it in &mut net.moves {
            (it.inhibit, it.reset, it.priority) = (Vec::new(), Vec::new(), 3);
        }
        let pt = net.pt();
        assert!(pt.is_plain());
    }
}
