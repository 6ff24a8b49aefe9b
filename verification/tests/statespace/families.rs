//! Families of nets, with the counts that are known of them.

use super::{net, space};
use cotama_checker::bounds::bounds;
use cotama_models::nets::families::{fms, kanban, philosophers, swimming_pool, token_ring};
use cotama_verification::explicit::{Limit, Limits, StateSpace, statespace};
use cotama_verification::pt::Pt;

fn counts(net: &cotama_core::net::owned::OwnedNet) -> [u64; 5] {
    let space = space(&Pt::from(&net.view().net()));
    assert_eq!((space.limit, space.bounded), (None, Some(true)));
    [space.states, space.arcs, space.max_place, space.max_sum, space.dead_markings]
}

#[test]
fn the_kanban_system_has_its_published_counts() {
    assert_eq!(counts(&kanban(1).unwrap()), [160, 616, 1, 4, 0]);
    assert_eq!(counts(&kanban(2).unwrap()), [4_600, 28_120, 2, 8, 0]);
    assert_eq!(counts(&kanban(3).unwrap()), [58_400, 446_400, 3, 12, 0]);
    assert_eq!(counts(&kanban(4).unwrap()), [454_475, 3_979_850, 4, 16, 0]);
}

#[test]
fn the_flexible_manufacturing_system_has_its_published_counts() {
    assert_eq!(counts(&fms(2).unwrap()), [3_444, 16_311, 3, 12, 0]);
}

#[test]
fn philosophers_have_three_states_each_and_two_deadlocks() {
    for n in 2..=8 {
        let [states, .., deadlocks] = counts(&philosophers(n).unwrap());
        assert_eq!((states, deadlocks), (3_u64.pow(n), 2));
    }
    assert_eq!(counts(&philosophers(5).unwrap()), [243, 945, 1, 10, 2]);
    assert_eq!(counts(&philosophers(10).unwrap()), [59_049, 459_270, 1, 20, 2]);
}

#[test]
fn the_token_ring_and_the_swimming_pool_have_their_published_counts() {
    assert_eq!(counts(&token_ring(5).unwrap())[..1], [166]);
    assert_eq!(counts(&swimming_pool(1).unwrap()), [89_621, 450_003, 20, 45, 0]);
}

#[test]
fn many_threads_count_the_same_as_one() {
    for net in [kanban(4), philosophers(11), swimming_pool(1)] {
        let pt = Pt::from(&net.unwrap().view().net());
        let one = space(&pt);
        for jobs in 2..=5 {
            let many = statespace(&pt, &Limits::default(), jobs, &|_| ());
            // Blocks that are not full differ; nothing else does.
            assert_eq!(StateSpace { bytes: one.bytes, peak: one.peak, ..many }, one);
        }
    }
}

#[test]
fn a_net_without_transitions_has_one_marking() {
    let space = space(&net::<2>(&[3, 0], &[]));
    assert_eq!((space.states, space.arcs, space.dead_markings, space.max_sum), (1, 0, 1, 3));
    assert_eq!((space.bounds, space.depth), (vec![3, 0], 0));
}

#[test]
fn a_net_without_places_has_one_marking_too() {
    let space = space(&net(&[], &[[&[], &[], &[]]]));
    assert_eq!((space.states, space.arcs, space.dead_markings, space.max_place), (1, 1, 0, 0));
}

#[test]
fn a_transition_that_only_reads_leads_back_to_its_marking() {
    let space = space(&net(&[1, 0], &[[&[], &[(0, 1)], &[]], [&[(0, 1)], &[], &[(1, 1)]]]));
    assert_eq!((space.states, space.arcs, space.dead_markings), (2, 2, 1));
}

/// A token that moves along a chain of places.
fn chain(places: u32) -> Pt {
    let mut initial = vec![0; places as usize];
    initial[0] = 1;
    let arcs: Vec<[[(u32, u32); 1]; 2]> =
        (1..places).map(|to| [[(to - 1, 1)], [(to, 1)]]).collect();
    let moves: Vec<[&[(u32, u32)]; 3]> =
        arcs.iter().map(|[take, give]| [&take[..], &[], &give[..]]).collect();
    net(&initial, &moves)
}

#[test]
fn the_only_token_of_nine_thousand_places_bounds_them_all() {
    assert_eq!(bounds(&chain(9_000)), vec![Some(1); 9_000]);
}

#[test]
fn of_thousands_of_transitions_none_fires_with_the_token_of_one_place_alone() {
    // Two tokens that move side by side, so that none is ever one place ahead of the other.
    let places: u32 = 1_000;
    let side_by_side = (1..places).map(|it| {
        let (take, give) = ([it - 1, places + it - 1], [it, places + it]);
        [take.map(|it| (it, 1)).to_vec(), vec![], give.map(|it| (it, 1)).to_vec()]
    });
    // A firing without the token that is read would leave no place below zero.
    let ahead = (1..places).map(|it| [vec![(it - 1, 1)], vec![(places + it, 1)], vec![]]);
    let all: Vec<[Vec<_>; 3]> = side_by_side.chain(ahead).collect();
    let all: Vec<[&[(u32, u32)]; 3]> =
        all.iter().map(|it| it.each_ref().map(Vec::as_slice)).collect();
    let initial: Vec<u32> = (0..2 * places).map(|it| u32::from(it % places == 0)).collect();
    let space = super::space(&super::net(&initial, &all));
    assert_eq!((space.states, space.arcs, space.dead_markings), (1_000, 999, 1));
}

#[test]
fn five_hundred_places_fit_in_a_marking() {
    let chain = space(&chain(500));
    assert_eq!((chain.states, chain.arcs, chain.dead_markings, chain.limit), (500, 499, 1, None));
    assert_eq!(chain.bounds, vec![1; 500]);
}

#[test]
fn a_level_of_five_thousand_large_markings_is_counted_whole() {
    let mut initial = vec![0; 5_001];
    initial[0] = 1;
    let gives: Vec<[(u32, u32); 1]> = (1..=5_000).map(|it| [(it, 1)]).collect();
    let moves: Vec<[&[(u32, u32)]; 3]> =
        gives.iter().map(|give| [&[(0, 1)][..], &[], &give[..]]).collect();
    let star = space(&net(&initial, &moves));
    assert_eq!(
        (star.states, star.arcs, star.dead_markings, star.limit),
        (5_001, 5_000, 5_000, None)
    );
}

#[test]
fn a_marking_of_more_than_128_words_is_no_limit() {
    // Places of 32 bits and one more each, which nothing bounds: 256 of them are too many
    // to be packed.
    let counters = |count: u32| {
        let gives: Vec<[(u32, u32); 1]> = (0..count).map(|it| [(it, 1 << 31)]).collect();
        let moves: Vec<[&[(u32, u32)]; 3]> =
            gives.iter().map(|it| [&[][..], &[], &it[..]]).collect();
        space(&net(&vec![0; count as usize], &moves)).limit
    };
    assert_eq!((counters(4), counters(256)), (Some(Limit::Tokens), Some(Limit::Tokens)));
}
