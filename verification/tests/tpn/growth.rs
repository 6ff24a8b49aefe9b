//! Nets with and without a limit to their tokens.

use crate::tpn::net;
use cotama_verification::tpn::{self, Limit, Limits};
use std::time::Instant;

const LIMITS: Limits = Limits { states: 2_000, bytes: 1 << 26, deadline: None };

/// Whether it is bounded, as far as that is known; and without time.
fn bounded(text: &str) -> (Option<bool>, Option<bool>) {
    let net = net(text);
    (tpn::classes(&net, &LIMITS).bounded(), tpn::untimed(&net.untimed(), &LIMITS).bounded())
}

#[test]
fn a_source_that_nothing_stops_grows() {
    assert_eq!(bounded("tr t ->  a"), (Some(false), Some(false)));
    assert_eq!(bounded("tr t [1,2] p -> p a*3  pl p (1)"), (Some(false), Some(false)));
    assert_eq!(bounded("tr t [1,2] ->"), (Some(true), Some(true)));
}

#[test]
fn a_consumer_that_is_too_slow_is_found_out() {
    let text =
        |earliest| format!("tr make [1,2] p -> p item  tr use [{earliest},3] item ->  pl p (1)");
    assert_eq!(bounded(&text(2)), (Some(false), Some(false)));
    assert_eq!(bounded(&text(0)), (Some(false), Some(false))); // it need not be fast
}

#[test]
fn a_larger_marking_alone_proves_nothing() {
    // Two items of one lot can meet, and lots come too slowly for more.
    let paced = "tr make [5,5] p -> p item*2  tr use [1,2] item -> done  tr clear [0,0] done*2 ->  \
        pl p (1)";
    assert_eq!(bounded(paced), (Some(true), Some(false)));
    // The second token makes `both` urgent, which ends all growth.
    let urgent = "tr make [1,1] p -> p item  tr both [0,0] item*2 p ->  pl p (1)";
    assert_eq!(bounded(urgent), (Some(true), Some(false)));
}

#[test]
fn growth_that_time_forbids_is_no_growth() {
    let net = "tr slow [2,2] p -> p item  tr fast [1,1] p -> q  pl p (1)";
    assert_eq!(bounded(net), (Some(true), Some(false)));
}

#[test]
fn an_unproved_bound_is_not_known() {
    // Each lap takes one token more than the last: nothing repeats as it was, though tokens grow.
    let laps = "tr go [1,1] p a -> p b*2  tr turn [0,0] p b*1000000 -> q  tr back [1,1] p b -> p \
        a  pl p (1)  pl a (1)";
    let net = net(laps);
    let limits = Limits { states: 200, ..LIMITS };
    let classes = tpn::classes(&net, &limits);
    assert_eq!((classes.bounded(), classes.stopped()), (None, Some(Limit::States)));
    assert_eq!(classes.classes(), 200);
}

#[test]
fn a_net_that_is_bounded_without_time_is_bounded_whatever_the_limit() {
    let net = net(
        "tr t [1,2] a -> b  tr u [3,4] a' -> b'  tr v [2,9] b -> a  tr w [1,7] b' -> a'  pl a (1)  \
         pl a' (1)",
    );
    let classes = tpn::classes(&net, &Limits { states: 5, ..LIMITS });
    assert_eq!(
        (classes.bounded(), classes.stopped(), classes.classes()),
        (Some(true), Some(Limit::States), 5)
    );
    let whole = tpn::classes(&net, &LIMITS);
    assert_eq!((whole.bounded(), whole.stopped(), whole.markings()), (Some(true), None, 4));
}

#[test]
fn limits_end_the_work_with_an_answer() {
    let net = net("tr t [1,2] a -> b c  tr u [3,4] b ->  tr v [2,9] c -> a  pl a (3)");
    let stopped = |limits| tpn::classes(&net, &limits).stopped();
    assert_eq!(stopped(Limits { states: 0, ..LIMITS }), Some(Limit::States));
    assert_eq!(stopped(Limits { bytes: 100, ..LIMITS }), Some(Limit::Bytes));
    assert_eq!(stopped(Limits { bytes: 1_000, ..LIMITS }), Some(Limit::Bytes));
    assert_eq!(stopped(Limits { deadline: Some(Instant::now()), ..LIMITS }), Some(Limit::Time));
    // The times of 200 transitions take almost a megabyte.
    let many = |from| {
        (0..200).map(|it| format!("tr t{it} [1,2] {from} -> r  ")).collect::<Vec<_>>().concat()
    };
    for (from, classes) in [("p", 0), ("q", 1)] {
        let wide = tpn::classes(
            &crate::tpn::net(&format!("tr go [1,1] p -> q  {}pl p (1)", many(from))),
            &Limits { bytes: 500_000, ..LIMITS },
        );
        assert_eq!((wide.stopped(), wide.classes()), (Some(Limit::Bytes), classes));
    }
    let ring = crate::tpn::net("tr t a -> b  tr u b -> c  tr v c -> d  tr w d -> a  pl a (1)");
    let untimed = tpn::untimed(&ring.untimed(), &Limits { states: 3, ..LIMITS });
    assert_eq!((untimed.markings, untimed.stopped), (3, Some(Limit::States)));
}

#[test]
fn a_place_that_holds_all_it_can_ends_the_work() {
    let net =
        net("tr t [1,2] a -> a b*3  tr u [0,0] b*4294967295 a -> c  pl a (1)  pl b (4294967293)");
    let classes = tpn::classes(&net, &LIMITS);
    assert_eq!((classes.bounded(), classes.stopped()), (None, Some(Limit::Tokens)));
}
