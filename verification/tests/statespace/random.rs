//! Random nets, compared with the search as in a textbook.

use super::plain::plain;
use super::{at_least, fired, net};
use cotama_checker::bounds::bounds;
use cotama_core::net::TransitionId;
use cotama_fuzz::split_mix;
use cotama_verification::explicit::{Goal, Graph, Limit, Limits, Reached, reach, statespace};
use cotama_verification::property::{Atom, Formula};
use cotama_verification::pt::Pt;

/// The most markings that are passed through.
const MOST: usize = 600;

/// Numbers that look random, the same ones for the same seed.
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: u32) -> u32 {
        (split_mix(&mut self.0) % u64::from(end)) as u32
    }

    /// Some places, each once, with weights: mostly 1.
    fn arcs(&mut self, places: u32, most: u32) -> Vec<(u32, u32)> {
        let mut arcs: Vec<(u32, u32)> = Vec::new();
        for _ in 0..self.below(most + 1) {
            let place = self.below(places);
            let weight = [1, 1, 1, 2, 3][self.below(5) as usize];
            if arcs.iter().all(|it| it.0 != place) {
                arcs.push((place, weight));
            }
        }
        arcs
    }
}

/// A net: small, of up to 90 places so that markings take more than one word, or with many tokens.
fn random(seed: u64) -> Pt {
    let mut draw = Draw(seed);
    let (places, transitions, tokens) = match seed % 4 {
        0 => (1 + draw.below(6), draw.below(8), 4),
        1 => (4 + draw.below(12), 4 + draw.below(12), 3),
        2 => (60 + draw.below(31), 10 + draw.below(30), 2),
        _ => (2 + draw.below(4), 2 + draw.below(4), 400),
    };
    let initial: Vec<u32> = (0..places).map(|_| draw.below(tokens)).collect();
    let keeps = draw.below(3) > 0;
    let arcs: Vec<[Vec<(u32, u32)>; 3]> = (0..transitions)
        .map(|_| {
            let (take, read) = (draw.arcs(places, 3), draw.arcs(places, 1));
            let mut give = draw.arcs(places, 3);
            if keeps {
                // Tokens move, one by one: their number stays, or shrinks.
                give.truncate(take.len());
                for it in &mut give {
                    it.1 = 1;
                }
            }
            [take, read, give]
        })
        .collect();
    let arcs: Vec<[&[(u32, u32)]; 3]> =
        arcs.iter().map(|it| it.each_ref().map(Vec::as_slice)).collect();
    net(&initial, &arcs)
}

#[test]
fn counts_are_those_of_a_plain_search_on_one_and_on_three_threads() {
    let (mut complete, mut dead) = (0, 0);
    for seed in 0..2_000 {
        let pt = random(seed);
        let expected = plain(&pt, MOST);
        let limits = Limits { states: MOST as u64, ..Limits::default() };
        let space = statespace(&pt, &limits, 1, &|_| ());
        assert_eq!(statespace(&pt, &limits, 3, &|_| ()).arcs, space.arcs, "seed {seed}");
        assert_eq!(space.states, expected.markings.len() as u64, "seed {seed}");
        assert_eq!(
            space.arcs,
            expected.arcs.iter().map(Vec::len).sum::<usize>() as u64,
            "seed {seed}"
        );
        assert_eq!(space.bounds, expected.bounds(), "seed {seed}");
        assert_eq!(space.max_place, expected.bounds().into_iter().max().unwrap(), "seed {seed}");
        let sum = |it: &Vec<u32>| it.iter().copied().map(u64::from).sum::<u64>();
        assert_eq!(space.max_sum, expected.markings.iter().map(sum).max().unwrap(), "seed {seed}");
        let deadlocks = expected.arcs.iter().filter(|it| it.is_empty()).count() as u64;
        assert_eq!(space.dead_markings, deadlocks, "seed {seed}");
        assert_eq!(space.depth, *expected.depths.last().unwrap(), "seed {seed}");
        let fires = |id: &TransitionId| expected.arcs.iter().flatten().any(|it| it.0 == id.0);
        let never = (0..pt.transitions.len() as u32).map(TransitionId).filter(|it| !fires(it));
        assert_eq!(space.dead_transitions, never.collect::<Vec<_>>(), "seed {seed}");
        assert_eq!(space.limit.is_none(), expected.is_complete, "seed {seed}");
        complete += u32::from(expected.is_complete);
        dead += deadlocks;
        for (bound, held) in bounds(&pt).iter().zip(&space.bounds) {
            assert!(bound.is_none_or(|it| *held <= it.into()), "seed {seed}");
        }
        match &space.growth {
            Some(growth) => {
                assert!(!expected.is_complete && space.bounded == Some(false), "seed {seed}");
                let before = fired(&pt, &growth.first);
                let all: Vec<_> = growth.first.iter().chain(&growth.repeated).copied().collect();
                let after = fired(&pt, &all);
                assert!(
                    before.iter().zip(&after).all(|(a, b)| a <= b) && before != after,
                    "seed {seed}"
                );
            }
            None if expected.is_complete => assert_eq!(space.bounded, Some(true), "seed {seed}"),
            None => assert_eq!(space.limit, Some(Limit::States), "seed {seed}"),
        }
    }
    assert!(complete > 1_000 && dead > 1_000, "{complete} complete nets, {dead} dead markings");
}

#[test]
fn ways_are_shortest_and_the_same_on_three_threads() {
    let (mut found, mut never) = (0, 0);
    for seed in 0..2_000 {
        let pt = random(seed);
        let expected = plain(&pt, MOST);
        let mut draw = Draw(!seed);
        let goal = match draw.below(4) {
            0 => Formula::Atom(Atom::Deadlock),
            1 if !pt.transitions.is_empty() => {
                let transition = draw.below(pt.transitions.len() as u32);
                Formula::Not(Box::new(Formula::Atom(Atom::Fireable(vec![TransitionId(
                    transition,
                )]))))
            }
            _ => {
                // A marking of the last levels, at least: far away.
                let marking = &expected.markings[expected.markings.len() - 1];
                let part = marking.iter().enumerate().take(4);
                Formula::And(
                    part.map(|(place, tokens)| at_least(place as u32, (*tokens).into())).collect(),
                )
            }
        };
        let holds = |at: &usize| match &goal {
            Formula::Atom(_) => expected.arcs[*at].is_empty(),
            Formula::Not(inner) => match &**inner {
                Formula::Atom(Atom::Fireable(ids)) => {
                    expected.arcs[*at].iter().all(|it| it.0 != ids[0].0)
                }
                _ => unreachable!(),
            },
            Formula::And(all) => all.iter().all(|it| match it {
                Formula::Atom(Atom::AtMost(it)) => {
                    i64::from(expected.markings[*at][it.weights[0].0.0 as usize]) >= it.constant
                }
                _ => unreachable!(),
            }),
            _ => unreachable!(),
        };
        let first = (0..expected.markings.len()).find(holds);
        let limits = Limits { states: MOST as u64, ..Limits::default() };
        let reached = reach(&pt, Goal::new(&goal).unwrap(), &limits, 1, &|_| ());
        assert_eq!(
            reach(&pt, Goal::new(&goal).unwrap(), &limits, 3, &|_| ()),
            reached,
            "seed {seed}"
        );
        match (&reached, first) {
            (Reached::Trace { transitions, .. }, Some(first)) => {
                found += 1;
                assert_eq!(transitions.len() as u64, expected.depths[first], "seed {seed}");
                let end = fired(&pt, transitions);
                let end = expected.markings.iter().position(|it| *it == end).unwrap();
                assert!(holds(&end), "seed {seed}");
            }
            (Reached::Never { states }, None) => {
                never += 1;
                assert!(
                    expected.is_complete && *states == expected.markings.len() as u64,
                    "seed {seed}"
                );
            }
            (Reached::Unknown { limit, states }, None) => {
                assert_eq!(
                    (*limit, *states),
                    (Limit::States, expected.markings.len() as u64),
                    "seed {seed}"
                );
            }
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    assert!(found > 800 && never > 200, "{found} found, {never} never");
}

#[test]
fn graphs_are_those_of_a_plain_search_with_the_same_numbers() {
    for seed in 0..2_000 {
        let pt = random(seed);
        let expected = plain(&pt, MOST);
        let limits = Limits { states: MOST as u64, ..Limits::default() };
        let graph = match Graph::new(&pt, &limits, &|_| ()) {
            Ok(graph) => graph,
            Err(limit) => {
                assert!(limit.limit == Limit::States && !expected.is_complete, "seed {seed}");
                continue;
            }
        };
        assert_eq!(graph.states(), expected.markings.len(), "seed {seed}");
        for state in 0..graph.states() {
            let arcs = graph.transitions(state as u32).into_iter().map(|it| it.0);
            let to = graph.successors(state as u32).iter().map(|it| Some(*it as usize));
            assert_eq!(arcs.zip(to).collect::<Vec<_>>(), expected.arcs[state], "seed {seed}");
            assert_eq!(graph.marking(state as u32), expected.markings[state], "seed {seed}");
        }
        let last = graph.states() as u32 - 1;
        let way = graph.path(last);
        assert_eq!(way.len() as u64, expected.depths[last as usize], "seed {seed}");
        assert_eq!(fired(&pt, &way), expected.markings[last as usize], "seed {seed}");
        if graph.states() <= 200 {
            let reachable = expected.reachable();
            let components = graph.components();
            for (a, from) in reachable.iter().enumerate() {
                for (b, to) in reachable.iter().enumerate() {
                    let same = components.of[a] == components.of[b];
                    assert_eq!(same, from[b] && to[a], "seed {seed}: {a} and {b}");
                    assert!(
                        !from[b] || components.of[b] <= components.of[a],
                        "seed {seed}: {a} to {b}"
                    );
                }
            }
            let liveness = graph.liveness();
            let fires = |it: u32, state: usize| expected.arcs[state].iter().any(|arc| arc.0 == it);
            let all = || 0..expected.markings.len();
            let mut sorted = [Vec::new(), Vec::new(), Vec::new()];
            for transition in 0..pt.transitions.len() as u32 {
                let again =
                    |from: usize| all().any(|to| reachable[from][to] && fires(transition, to));
                let kind = if all().all(again) { 0 } else { 1 + usize::from(!again(0)) };
                sorted[kind].push(TransitionId(transition));
            }
            let home = all().filter(|to| all().all(|from| reachable[from][*to])).count() as u64;
            let reversible = all().all(|from| reachable[from][0]);
            assert_eq!([liveness.live, liveness.mortal, liveness.dead], sorted, "seed {seed}");
            assert_eq!((liveness.home, liveness.reversible), (home, reversible), "seed {seed}");
        }
    }
}
