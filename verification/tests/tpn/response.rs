//! How long a place takes to be marked after a firing.

use crate::tpn::{bound, finite, net, shown};
use cotama_verification::tpn::{self, Interval, Limit, Limits, Response, Time};

#[test]
fn times_in_a_row_add_up() {
    let net = net("tr a [1,2] p -> q  tr b [10,20] q -> r  tr c [5,5] r -> s  pl p (1)");
    assert_eq!(bound(&net, "a", "s"), "15..25");
    assert_eq!(bound(&net, "b", "s"), "5..5");
    assert_eq!(bound(&net, "c", "s"), "0..0"); // marked by the firing itself
    assert_eq!(bound(&net, "c", "p"), "inf..inf");
}

#[test]
fn the_start_is_measured_as_a_firing_is() {
    let net = net("tr a [1,2] p -> q  tr b ]10,20[ q -> r  pl p (1)");
    let from_start =
        |place| shown(tpn::bound_from_start(&net, net.place(place).unwrap(), &Limits::default()));
    assert_eq!([from_start("p"), from_start("q"), from_start("r")], ["0..0", "1..2", "11..22"]);
}

#[test]
fn times_side_by_side_are_not_added() {
    let net = net(
        "tr fork [0,0] p -> a b  tr a [1,9] a -> a'  tr b [3,4] b -> b'  tr join [0,0] a' b' -> \
         end  pl p (1)",
    );
    assert_eq!(bound(&net, "fork", "end"), "3..9");
    assert_eq!(bound(&net, "a", "end"), "0..3"); // b may be behind, by less than 4 - 1
    assert_eq!(bound(&net, "b", "end"), "0..6");
}

#[test]
fn clocks_that_run_since_before_count() {
    // The alarm is due 10 after the start, whenever the fault comes.
    let net = net(
        "tr fault [2,7] sane -> faulty  tr look [10,10] clock faulty?1 -> alarm  pl sane (1)  pl \
         clock (1)",
    );
    assert_eq!(bound(&net, "fault", "alarm"), "10..10"); // a read arc enables it no sooner
    let polled = crate::tpn::net(
        "tr fault [2,7] sane -> faulty  tr look [10,10] clock -> looked  tr tell [0,0] looked \
         faulty -> alarm\n\
                             pl sane (1)  pl clock (1)",
    );
    assert_eq!(bound(&polled, "fault", "alarm"), "3..8");
}

#[test]
fn a_cycle_on_the_way_makes_it_endless() {
    let net = net("tr go [1,1] p -> a  tr spin [2,2] a -> a  tr leave [1,3] a -> b  pl p (1)");
    assert_eq!(bound(&net, "go", "b"), "1..inf");
    // Also in no time.
    let zeno = crate::tpn::net(
        "tr go [1,1] p -> a  tr spin [0,0] a -> a  tr leave [0,3] a -> b  pl p (1)",
    );
    assert_eq!(bound(&zeno, "go", "b"), "0..inf");
    // A cycle that time forbids is none.
    let late = crate::tpn::net(
        "tr go [1,1] p -> a  tr spin [4,4] a -> a  tr leave [1,3] a -> b  pl p (1)",
    );
    assert_eq!(bound(&late, "go", "b"), "1..3");
}

#[test]
fn a_deadlock_and_a_time_without_end_are_endless() {
    let net = net("tr go [1,1] p -> a  tr stop [1,2] a -> dead  tr leave [1,3] a -> b  pl p (1)");
    assert_eq!(bound(&net, "go", "b"), "1..inf");
    let waits = crate::tpn::net("tr go [1,1] p -> a  tr leave [7,w[ a -> b  pl p (1)");
    assert_eq!(bound(&waits, "go", "b"), "7..inf");
    let kept = crate::tpn::net(
        "tr go [1,1] p -> a  tr leave [7,w[ a -> b  tr force [5,9] a -> b  pl p (1)",
    );
    assert_eq!(bound(&kept, "go", "b"), "5..9");
}

#[test]
fn each_firing_starts_its_own_measurement() {
    // Asked again each 2, answered 5 after the first time asked of each lot.
    let net = net(
        "tr ask [2,2] p n -> p  tr answer [5,5] q -> r  tr again [0,0] r -> q  pl p (1)  pl n (9)  \
         pl q (1)",
    );
    assert_eq!(bound(&net, "ask", "r"), "0..5");
}

#[test]
fn a_marking_that_lasts_no_time_counts() {
    let net = net(
        "tr go [1,1] p -> a  tr pass [0,0] a -> b  tr on [0,0] b -> c  tr end [9,9] c -> p  pl p \
         (1)",
    );
    assert_eq!(bound(&net, "go", "b"), "0..0");
    assert_eq!(bound(&net, "pass", "a"), "10..10"); // not the one before
}

#[test]
fn bounds_that_are_not_attained_are_the_bounds() {
    let net = net("tr go [1,1] p -> a  tr one ]2,4[ a -> b  tr two ]1,3] b -> c  pl p (1)");
    assert_eq!(bound(&net, "go", "c"), "3..7");
}

#[test]
fn a_transition_that_never_fires_has_no_response() {
    let net = net("tr go [2,3] p -> a  tr late [4,5] p -> b  pl p (1)");
    assert_eq!(bound(&net, "late", "b"), "never fires");
}

#[test]
fn limits_end_the_work_with_an_answer() {
    let net = net("tr a [1,2] p -> q  tr b [1,2] q -> r  tr c [3,3] r -> p  pl p (1)");
    let limits = Limits { states: 2, ..Limits::default() };
    let (a, p) = (net.transition("a").unwrap(), net.place("p").unwrap());
    assert_eq!(
        tpn::bound(&net, a, p, &limits),
        Response::Unknown { limit: Limit::States, explored: 2 }
    );
    // Times to reach classes count, too.
    assert_eq!(
        tpn::bound(&net, a, p, &Limits { states: 3, ..limits }),
        Response::Unknown { limit: Limit::States, explored: 4 }
    );
    let unbounded = crate::tpn::net("tr a -> p");
    let (a, p) = (unbounded.transition("a").unwrap(), unbounded.place("p").unwrap());
    let unknown = tpn::bound(&unbounded, a, p, &Limits::default());
    assert!(matches!(unknown, Response::Unknown { limit: Limit::Unbounded, .. }), "{unknown:?}");
}

#[test]
fn the_largest_bounds_are_exact_and_larger_sums_are_not_guessed() {
    let large = Interval::LARGEST;
    let chain = |length: usize| {
        let step = |at: usize| format!("tr t{at} ]{},{large}[ p{at} -> p{}\n", large - 1, at + 1);
        net(&format!("pl p0 (1) {}", (0..length).map(step).collect::<String>()))
    };
    let from_start = |length: usize| {
        let net = chain(length);
        tpn::bound_from_start(&net, net.place(&format!("p{length}")).unwrap(), &Limits::default())
    };
    // A strict bound on both sides of one unit: the greatest lower and the least upper bound are a
    // unit apart.
    assert_eq!(from_start(1), Response::Between { min: finite(large - 1), max: finite(large) });
    assert_eq!(
        from_start(3),
        Response::Between { min: finite(3 * (large - 1)), max: finite(3 * large) }
    );
    assert!(matches!(from_start(5), Response::Unknown { limit: Limit::Tokens, .. }));
    assert!(Time::Finite(u64::MAX) < Time::Infinite);
}

#[test]
fn times_beyond_15_bits_are_exact() {
    let net = net("pl p (1)  tr wait [20000,30000] p -> q  tr go [40000,50000] q -> r");
    let r = net.place("r").unwrap();
    assert_eq!(shown(tpn::bound_from_start(&net, r, &Limits::default())), "60000..80000");
}

#[test]
fn clocks_that_run_side_by_side_keep_their_distance() {
    // `on` comes one unit after `off`, which takes away what would mark the place two units after
    // `ask`.
    let net =
        net("pl one (1)  pl two (1)  pl idle (1)  tr ask [0,10] idle -> asked  tr answer [0,2] \
            asked -> told
         tr off [10,10] one -> ended  tr drop [0,0] ended asked -> dropped  tr on [11,11] two -> \
         told");
    assert_eq!(bound(&net, "ask", "told"), "0..3");
}
