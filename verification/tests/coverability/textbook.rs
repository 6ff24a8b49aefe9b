//! Nets with known minimal coverability sets.

use super::{end, net, pumps_ten_times, set, shown};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::coverability::{Bounded, Limits, bounded};

#[test]
fn a_producer_fills_an_unbounded_buffer() {
    // ready -> produced, produced -> ready + buffer, idle + buffer -> busy, busy -> idle
    let pt = net(
        &[1, 0, 0, 1, 0],
        &[
            [&[(0, 1)], &[(1, 1)]],
            [&[(1, 1)], &[(0, 1), (2, 1)]],
            [&[(2, 1), (3, 1)], &[(4, 1)]],
            [&[(4, 1)], &[(3, 1)]],
        ],
    );
    let set = set(&pt);
    assert_eq!(shown(&set), ["0 1 ω 0 1", "0 1 ω 1 0", "1 0 ω 0 1", "1 0 ω 1 0"]);
    assert_eq!(set.bound(&[PlaceId(0), PlaceId(1), PlaceId(3), PlaceId(4)]), Some(2));
    assert_eq!(set.bound(&[PlaceId(0), PlaceId(2)]), None);
    assert_eq!(set.dead_transitions(), []);
    let Bounded::No(growth) = bounded(&pt, &Limits::default()) else { panic!("it is unbounded") };
    assert_eq!(growth.stem.firings, Some(vec![]));
    assert_eq!(growth.pump.firings, Some(vec![TransitionId(0), TransitionId(1)]));
    assert_eq!(growth.grows, [(PlaceId(2), 1)]);
    pumps_ten_times(&pt, &growth);
}

#[test]
fn tokens_doubled_by_a_loop_are_unbounded_only_while_the_loop_runs() {
    // Karp and Miller: a -> a + x, a -> b, b + x -> b + 2y
    let pt = net(
        &[1, 0, 0, 0],
        &[
            [&[(0, 1)], &[(0, 1), (2, 1)]],
            [&[(0, 1)], &[(1, 1)]],
            [&[(1, 1), (2, 1)], &[(1, 1), (3, 2)]],
        ],
    );
    let set = set(&pt);
    assert_eq!(shown(&set), ["0 1 ω ω", "1 0 ω 0"]);
    // For seven in y the first loop runs four times.
    let way = set.covers(&[(PlaceId(3), 7)]).unwrap();
    assert_eq!(end(&pt, &way), [0, 1, 0, 8]);
    assert_eq!(way.length, 9);
    assert_eq!(set.covers(&[(PlaceId(0), 1), (PlaceId(3), 1)]), None);
}

#[test]
fn a_weak_computer_of_powers_of_two_is_bounded_by_them() {
    // Each of n rounds can double x: p + x -> p + 2y, p -> q, q + y -> q + x, q + n -> p.
    let rounds = 4;
    let pt = net(
        &[1, 0, 1, 0, rounds],
        &[
            [&[(0, 1), (2, 1)], &[(0, 1), (3, 2)]],
            [&[(0, 1)], &[(1, 1)]],
            [&[(1, 1), (3, 1)], &[(1, 1), (2, 1)]],
            [&[(1, 1), (4, 1)], &[(0, 1)]],
        ],
    );
    let set = set(&pt);
    assert_eq!(set.bound(&[PlaceId(2)]), Some(32));
    assert_eq!(set.bound(&[PlaceId(2), PlaceId(3)]), Some(32));
    assert_eq!(bounded(&pt, &Limits::default()), Bounded::Yes);
    let way = set.covers(&[(PlaceId(2), 32)]).unwrap();
    assert_eq!(end(&pt, &way)[2], 32);
}

#[test]
fn a_pump_within_a_pump_is_repeated_as_often_as_the_outer_one_needs() {
    // a fills x; three of x give one y; five of y give one z, and a starts again each time.
    let pt = net(
        &[1, 0, 0, 0],
        &[
            [&[(0, 1)], &[(0, 1), (1, 1)]],
            [&[(1, 3)], &[(2, 1)]],
            [&[(0, 1), (2, 5)], &[(0, 1), (3, 1)]],
        ],
    );
    let set = set(&pt);
    assert_eq!(shown(&set), ["1 ω ω ω"]);
    let way = set.covers(&[(PlaceId(3), 4)]).unwrap();
    assert!(end(&pt, &way)[3] >= 4);
    // Four of z take 20 of y and 60 of x.
    assert!(way.length >= 84);
}

#[test]
fn a_transition_that_needs_nothing_pumps_at_once() {
    let pt = net(&[0, 0], &[[&[], &[(0, 1)]], [&[(0, 2)], &[(1, 1)]]]);
    assert_eq!(shown(&set(&pt)), ["ω ω"]);
    let Bounded::No(growth) = bounded(&pt, &Limits::default()) else { panic!("it is unbounded") };
    assert_eq!((growth.stem.length, growth.pump.length), (0, 1));
    pumps_ten_times(&pt, &growth);
}

#[test]
fn a_net_of_nothing_has_one_marking() {
    let pt = net::<2>(&[], &[]);
    assert_eq!(shown(&set(&pt)), [""]);
    assert_eq!(bounded(&pt, &Limits::default()), Bounded::Yes);
    // A transition without any arcs can fire for ever, and changes nothing.
    let pt = net(&[], &[[&[], &[]]]);
    assert_eq!(bounded(&pt, &Limits::default()), Bounded::Yes);
    assert_eq!(set(&pt).dead_transitions(), []);
}

#[test]
fn a_place_that_grows_only_where_others_shrink_is_bounded() {
    // x and y turn into each other, two for one only ever once.
    let pt = net(
        &[3, 0, 1],
        &[[&[(0, 1)], &[(1, 1)]], [&[(1, 1)], &[(0, 1)]], [&[(2, 1), (0, 1)], &[(1, 2)]]],
    );
    let set = set(&pt);
    assert_eq!(set.bound(&[PlaceId(0), PlaceId(1)]), Some(4));
    assert_eq!(
        shown(&set),
        ["0 3 1", "0 4 0", "1 2 1", "1 3 0", "2 1 1", "2 2 0", "3 0 1", "3 1 0", "4 0 0"]
    );
    assert_eq!(bounded(&pt, &Limits::default()), Bounded::Yes);
}

#[test]
fn a_repeated_part_of_a_pump_needs_its_tokens_each_time() {
    // s fills c until it leaves; out, three times c -> d where it came to, and back for three d,
    // which returns three c.
    let pt = net(
        &[1, 0, 0, 0, 0, 0],
        &[
            [&[(0, 1)], &[(0, 1), (3, 1)]],
            [&[(0, 1)], &[(1, 1)]],
            [&[(1, 1)], &[(2, 1)]],
            [&[(2, 1), (3, 1)], &[(2, 1), (4, 1)]],
            [&[(2, 1), (4, 3)], &[(1, 1), (3, 3), (5, 1)]],
        ],
    );
    let set = set(&pt);
    let way = set.covers(&[(PlaceId(1), 1), (PlaceId(5), 4)]).unwrap();
    assert!(end(&pt, &way)[5] >= 4);
}

#[test]
fn growth_after_a_long_way_is_found() {
    // 3000 tokens move from one place to the other, one by one; only all of them together start to
    // fill a third.
    let pt = net(&[3_000, 0, 0], &[[&[(0, 1)], &[(1, 1)]], [&[(1, 3_000)], &[(1, 3_000), (2, 1)]]]);
    let Bounded::No(growth) = bounded(&pt, &Limits::default()) else { panic!("it is unbounded") };
    assert_eq!((growth.stem.length, &*growth.grows), (3_000, &[(PlaceId(2), 1)][..]));
    pumps_ten_times(&pt, &growth);
}
