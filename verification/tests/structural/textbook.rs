//! Small nets with results that can be found by hand.

use super::nets::{kanban, philosophers, replay};
use crate::numbered::net;
use cotama_checker::structural::certificate::{
    Bound, DeadTransitions, LinearInvariant, Refutation, Sum, unreachable,
};
use cotama_checker::structural::{
    Answer, Effort, Limit, Limits, Structure, Unknown, class, commoner, minimal_siphons,
    place_invariants, place_semiflows,
};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::property::Linear;
use std::sync::Arc;
use std::time::Instant;

fn tokens_at_most(place: u32, most: i64) -> Linear {
    Linear { constant: -most, weights: vec![(PlaceId(place), 1)] }
}

fn tokens_at_least(place: u32, least: i64) -> Linear {
    Linear { constant: least, weights: vec![(PlaceId(place), -1)] }
}

#[test]
fn three_philosophers_starve_after_three_steps() {
    let pt = philosophers(3, false);
    let mut structure = Structure::new(&pt, &Limits::default());
    let Answer::Reachable(trace) = structure.deadlock() else { panic!("not found") };
    assert_eq!(trace.len(), 3);
    assert!(super::nets::enabled(&pt, &replay(&pt, &trace)).next().is_none());
}

#[test]
fn philosophers_who_keep_an_order_never_starve() {
    for count in 2..8 {
        let pt = philosophers(count, true);
        let mut structure = Structure::new(&pt, &Limits::default());
        let Answer::Impossible(proof) = structure.deadlock() else {
            panic!("not proved for {count}")
        };
        assert!(proof.holds(&pt, structure.dead()));
        let siphons = minimal_siphons(&pt, 1_000, 10_000_000);
        assert!(siphons.complete);
        assert_eq!(commoner(&pt, &siphons).deadlock_free, Some(true));
    }
}

#[test]
fn at_most_every_other_philosopher_eats() {
    let pt = philosophers(7, false);
    let mut structure = Structure::new(&pt, &Limits::default());
    let eat: Vec<_> = (0..7).map(|at| (PlaceId(4 * at + 3), 1)).collect();
    let bound = structure.upper_bound(&eat).unwrap();
    assert_eq!(bound.at_most, 3);
    assert!(bound.holds(&pt, structure.dead()));
    let neighbours = structure.reach(&[tokens_at_least(3, 1), tokens_at_least(7, 1)]);
    assert!(matches!(neighbours, Answer::Impossible(_)));
    let apart = [tokens_at_least(3, 1), tokens_at_least(11, 1)];
    let Answer::Reachable(trace) = structure.reach(&apart) else { panic!("not found") };
    let marking = replay(&pt, &trace);
    assert_eq!((marking[3], marking[11]), (1, 1));
}

#[test]
fn the_kanban_system_has_its_published_invariants() {
    let pt = kanban(5);
    assert_eq!(place_invariants(&pt).unwrap().len(), 5);
    let semiflows = place_semiflows(&pt, 100);
    assert!(semiflows.complete);
    let cell = |cell: u32| (0..4).map(|which| (4 * cell + which, 1)).collect::<Vec<_>>();
    for at in 0..4 {
        assert!(semiflows.flows.contains(&cell(at)));
    }
    let siphons = minimal_siphons(&pt, 100, 1_000_000);
    let found = commoner(&pt, &siphons);
    assert_eq!((found.deadlock_free, found.live), (Some(true), Some(true)));
}

#[test]
fn a_proof_with_a_wrong_number_is_refused() {
    let pt = kanban(2);
    let mut structure = Structure::new(&pt, &Limits::default());
    let bound = structure.upper_bound(&[(PlaceId(0), 1)]).unwrap();
    assert_eq!(bound.at_most, 2);
    assert!(bound.holds(&pt, structure.dead()));
    assert!(!Bound { at_most: 1, ..bound.clone() }.holds(&pt, structure.dead()));
    let Refutation::Sum(sum) = bound.refutation.clone() else { panic!("not a sum") };
    let stronger =
        LinearInvariant { constant: sum.invariant.constant - 1, ..(*sum.invariant).clone() };
    let forged = Refutation::Sum(Sum { invariant: Arc::new(stronger), ..sum });
    assert!(!Bound { refutation: forged, ..bound }.holds(&pt, structure.dead()));
}

#[test]
fn the_last_token_of_a_trap_stays() {
    // Two tokens become one: the state equation alone would let the last one go.
    let pt = net(&[3], &[[&[(0, 2)], &[], &[(0, 1)]]]);
    let structure = Structure::new(&pt, &Limits::default());
    let goal = [tokens_at_most(0, 0)];
    let Answer::Impossible(proof) = structure.reach(&goal) else { panic!("not proved") };
    assert!(unreachable(&pt, structure.dead(), &goal, &proof));
    let Refutation::Sum(sum) = proof else { panic!("not a sum") };
    assert_eq!(sum.traps.len(), 1);
    assert_eq!(sum.traps[0].0.places, [PlaceId(0)]);
}

#[test]
fn half_a_token_is_no_token() {
    let pt = net(&[3, 0], &[[&[(0, 1)], &[], &[(1, 1)]]]);
    let structure = Structure::new(&pt, &Limits::default());
    let goal = [
        Linear { constant: -3, weights: vec![(PlaceId(1), 2)] },
        Linear { constant: 3, weights: vec![(PlaceId(1), -2)] },
    ];
    let Answer::Impossible(proof) = structure.reach(&goal) else { panic!("not proved") };
    assert!(matches!(proof, Refutation::Tokens { place: PlaceId(0), at: 1, .. }));
    assert!(unreachable(&pt, structure.dead(), &goal, &proof));
    let few = Effort { nodes: 1, ..Effort::default() };
    let answer = Structure::with_effort(&pt, &Limits::default(), few).reach(&goal);
    assert_eq!(answer, Answer::Unknown(Unknown::Limit(Limit::Work)));
}

#[test]
fn a_transition_that_never_gets_its_tokens_is_dead() {
    // The key lies behind the door; and two tokens are never in two places that share one.
    let pt = net(
        &[0, 0, 1, 0, 0],
        &[
            [&[(0, 1)], &[], &[(1, 1)]],
            [&[(1, 1)], &[], &[(0, 1)]],
            [&[(2, 1)], &[], &[(3, 1)]],
            [&[], &[(2, 1), (3, 1)], &[(4, 1)]],
            [&[(4, 1)], &[], &[]],
        ],
    );
    let mut structure = Structure::new(&pt, &Limits::default());
    assert_eq!(structure.dead().transitions, [TransitionId(0), TransitionId(1)]);
    structure.find_dead_transitions();
    assert_eq!(structure.dead().transitions, [0, 1, 3, 4].map(TransitionId));
    assert!(structure.dead().holds(&pt));
    let bounds: Vec<_> =
        structure.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
    assert_eq!(bounds, [0, 0, 1, 1, 0].map(Some));
}

#[test]
fn a_place_that_grows_without_limit_has_no_bound() {
    let pt = net(&[1, 0], &[[&[], &[(0, 1)], &[(1, 1)]]]);
    let mut structure = Structure::new(&pt, &Limits::default());
    let bounds: Vec<_> =
        structure.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
    assert_eq!(bounds, [Some(1), None]);
    let Answer::Reachable(trace) = structure.one_safe() else { panic!("not found") };
    assert_eq!(replay(&pt, &trace), [1, 2]);
    let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
    assert!(proof.holds(&pt, structure.dead()));
}

#[test]
fn a_net_without_transitions_is_dead_and_one_without_places_is_not() {
    assert_eq!(
        Structure::new(&net::<2>(&[1], &[]), &Limits::default()).deadlock(),
        Answer::Reachable(Vec::new())
    );
    let free = net(&[], &[[&[], &[], &[]]]);
    let mut structure = Structure::new(&free, &Limits::default());
    let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
    assert!(proof.holds(&free, structure.dead()));
}

#[test]
fn numbers_that_pass_63_bits_are_no_answer() {
    let most = u32::MAX;
    let arcs: Vec<[(u32, u32); 1]> =
        (0..8).flat_map(|at| [[(at, most - at)], [(at + 1, most - 7 * at)]]).collect();
    let transitions: Vec<_> = arcs.chunks(2).map(|it| [&it[0][..], &it[1][..]]).collect();
    let pt = net(&[most; 9], &transitions);
    assert_eq!(place_invariants(&pt), None);
    assert!(!place_semiflows(&pt, 100).complete);
    let mut structure = Structure::new(&pt, &Limits::default());
    let found: Vec<_> = structure.bounds().to_vec();
    assert!(found.iter().flatten().all(|it| it.holds(&pt, structure.dead())));
}

#[test]
fn classes_are_told_apart() {
    let ring = class(&net(&[1, 0], &[[&[(0, 1)], &[], &[(1, 1)]], [&[(1, 1)], &[], &[(0, 1)]]]));
    assert!(ring.state_machine && ring.marked_graph && ring.free_choice);
    let fork = class(&net(
        &[1, 0, 0],
        &[[&[(0, 1)], &[], &[(1, 1), (2, 1)]], [&[(1, 1), (2, 1)], &[], &[(0, 1)]]],
    ));
    assert!(!fork.state_machine && fork.marked_graph);
    let both =
        class(&net(&[1, 1], &[[&[(0, 1), (1, 1)], &[], &[]], [&[(0, 1), (1, 1)], &[], &[]]]));
    assert!(!both.free_choice && both.extended_free_choice);
    let one_more = class(&net(&[1, 1], &[[&[(0, 1), (1, 1)], &[], &[]], [&[(0, 1)], &[], &[]]]));
    assert!(!one_more.extended_free_choice && one_more.asymmetric_choice);
    let crossed = [&[(0, 1), (1, 1)][..], &[(0, 1)], &[(1, 1)]].map(|take| [take, &[]]);
    let crossed = class(&net(&[1, 1], &crossed));
    assert!(crossed.ordinary && !crossed.asymmetric_choice);
    assert!(!class(&net(&[1], &[[&[(0, 2)], &[], &[]]])).ordinary);
}

#[test]
fn a_free_choice_net_with_a_siphon_that_runs_dry_is_not_live() {
    let pt = net(
        &[1, 0],
        &[[&[(0, 1)], &[], &[(1, 1)]], [&[(1, 1)], &[], &[(0, 1)]], [&[(1, 1)], &[], &[]]],
    );
    let siphons = minimal_siphons(&pt, 10, 1_000);
    assert_eq!(siphons.siphons.len(), 1);
    assert_eq!(siphons.controlled(), Some(false));
    let found = commoner(&pt, &siphons);
    assert_eq!((found.deadlock_free, found.live), (None, Some(false)));
    assert!(!minimal_siphons(&pt, 0, 1_000).complete);
    assert!(!minimal_siphons(&pt, 10, 1).complete);
}

#[test]
fn three_tokens_make_one_pair_and_not_one_and_a_half() {
    let pt = net(&[3, 0], &[[&[(0, 2)], &[], &[(1, 1)]]]);
    let mut structure = Structure::new(&pt, &Limits::default());
    let most: Vec<_> = structure.bounds().iter().flatten().map(|it| it.at_most).collect();
    assert_eq!(most, [3, 1]);
}

#[test]
fn some_siphons_alone_prove_nothing() {
    let ordered = philosophers(3, true);
    let some = minimal_siphons(&ordered, 1, 10_000_000);
    assert!(!some.complete && some.siphons.iter().all(|it| it.trap.is_some()));
    assert_eq!((some.controlled(), commoner(&ordered, &some).deadlock_free), (None, None));
    assert_eq!(
        minimal_siphons(&philosophers(3, false), 1_000, 10_000_000).controlled(),
        Some(false)
    );
}

#[test]
fn a_forged_proof_is_refused() {
    // A source adds one token at a time: no marking of its place is out of reach, whatever is
    // written down.
    let pt = net(&[0], &[[&[], &[], &[(0, 1)]]]);
    let refuses = |goal: Linear, sum: Sum| {
        !unreachable(&pt, &DeadTransitions::default(), &[goal], &Refutation::Sum(sum))
    };
    let never_grows = LinearInvariant { weights: vec![(PlaceId(0), 1)], constant: 0 };
    let sum = Sum { premises: vec![(0, 1)], invariant: Arc::new(never_grows), ..Sum::default() };
    assert!(refuses(tokens_at_least(0, 1), sum));
    // `-5 - tokens <= 0` always holds; minus once it is `5 + tokens <= 0`, which does not follow.
    let never_shrinks = LinearInvariant { weights: vec![(PlaceId(0), -1)], constant: 0 };
    let turned =
        Sum { premises: vec![(0, -1)], invariant: Arc::new(never_shrinks), ..Sum::default() };
    assert!(refuses(tokens_at_least(0, -5), turned));
}

#[test]
fn a_transition_that_needs_less_is_not_disabled_with_one_that_needs_more() {
    // The first one fires once, the other one for ever.
    let pt = net(&[2, 0], &[[&[(0, 2)], &[], &[(0, 1), (1, 1)]], [&[(0, 1)], &[], &[(0, 1)]]]);
    let mut structure = Structure::new(&pt, &Limits::default());
    let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
    assert!(proof.holds(&pt, structure.dead()));
}

#[test]
fn a_budget_too_small_gives_no_verdict() {
    let pt = philosophers(3, true);
    // 1,347 are enough.
    for work in [0, 1_300] {
        let effort = Effort { work, ..Effort::default() };
        let found = Structure::with_effort(&pt, &Limits::default(), effort).deadlock();
        assert!(matches!(found, Answer::Unknown(Unknown::Limit(Limit::Work))), "{found:?}");
    }
    let limits = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    let found = Structure::new(&pt, &limits).deadlock();
    assert!(matches!(found, Answer::Unknown(Unknown::Limit(Limit::Time))), "{found:?}");
}
