//! Dates for firing sequences.

use crate::tpn::net;
use crate::tpn::replay::replay;
use cotama_verification::tpn::{
    Date, Limit, Limits, NoSchedule, Reach, Schedule, TimeNet, deadlock, reach, schedule,
};

/// The dates of a sequence of names, after a replay of them; or why there are none.
fn dates(net: &TimeNet, sequence: &str) -> Result<String, NoSchedule> {
    let sequence: Vec<_> =
        sequence.split_whitespace().map(|it| net.transition(it).unwrap()).collect();
    let run = schedule(net, &sequence)?;
    replay(net, &run).unwrap();
    Ok(run.steps.iter().map(|step| step.date.to_string()).collect::<Vec<_>>().join(" "))
}

#[test]
fn closed_bounds_give_the_earliest_integers() {
    let net = net("tr work [3,7] job -> done  tr rest [2,2] done -> job  pl job (1)");
    assert_eq!(dates(&net, "work rest work").unwrap(), "3 5 8");
    assert_eq!(dates(&net, "").unwrap(), "");
}

#[test]
fn an_early_firing_waits_for_the_needs_of_a_later_one() {
    // b's clock starts when a fires, and c is due at 10 sharp: a cannot fire before 6.
    let net = net("tr a [0,w[ p -> q  tr b [0,4] q -> r  tr c [10,10] s -> u  pl p (1)  pl s (1)");
    assert_eq!(dates(&net, "a c b").unwrap(), "6 10 10");
    assert_eq!(dates(&net, "a b c").unwrap(), "0 0 10");
}

#[test]
fn open_bounds_give_fractions_as_coarse_as_they_can_be() {
    let half = net("tr a ]0,1[ p -> q  pl p (1)");
    assert_eq!(dates(&half, "a").unwrap(), "0.5");
    let integers = net("tr a ]1,9[ p -> q  pl p (1)");
    assert_eq!(dates(&integers, "a").unwrap(), "2");
    // Three firings strictly inside of one unit leave four gaps.
    let quarters = net(
        "tr a ]0,w[ p3 -> p2  tr b ]0,w[ p2 -> p1  tr c ]0,w[ p1 -> p0  tr end [1,1] e -> f  tr d \
         ]0,w[ p0 -> pl p3 (1)  pl e (1)",
    );
    assert_eq!(dates(&quarters, "a b c end").unwrap(), "0.25 0.5 0.75 1");
    assert_eq!(
        dates(&quarters, "a b c d").unwrap(),
        "0.25 0.5 0.75 \
        1"
    ); // at 1, just before the end
}

#[test]
fn an_open_upper_bound_is_not_reached() {
    let net = net("tr a [0,5[ p -> q  tr b [4,w[ s -> u  pl p (1)  pl s (1)");
    assert_eq!(dates(&net, "b a").unwrap(), "4 4");
    let late = crate::tpn::net("tr a [0,4[ p -> q  tr b [4,w[ s -> u  pl p (1)  pl s (1)");
    assert_eq!(dates(&late, "b a"), Err(NoSchedule::TooLate(0)));
    assert_eq!(dates(&late, "a b").unwrap(), "0 4");
}

#[test]
fn a_sequence_that_cannot_be_is_refused_with_its_first_wrong_firing() {
    let net = net("tr a [1,2] p -> q  tr b [3,3] p -> q  tr c q -> p  pl p (1)");
    assert_eq!(dates(&net, "a c b"), Err(NoSchedule::TooLate(2)));
    assert_eq!(dates(&net, "a a"), Err(NoSchedule::Disabled(1)));
    let beyond = cotama_core::net::TransitionId(7);
    assert_eq!(schedule(&net, &[beyond]), Err(NoSchedule::Disabled(0)));
    assert_eq!(
        NoSchedule::TooLate(2).to_string(),
        "before firing 3 of the sequence another one is due"
    );
}

#[test]
fn dates_that_no_integer_holds_are_said_to_be_too_large() {
    let largest = cotama_verification::tpn::Interval::LARGEST;
    let net = net(&format!("tr a [{largest},{largest}] p -> p  pl p (1)"));
    let sequence = |length| vec![net.transition("a").unwrap(); length];
    let last = schedule(&net, &sequence(64)).unwrap().steps[63].date;
    assert_eq!(last, Date { parts: 64 * largest, per_unit: 1 });
    assert_eq!(schedule(&net, &sequence(65)), Err(NoSchedule::Overflow));
}

#[test]
fn a_way_to_a_deadlock_has_dates() {
    let net = net(
        "tr take_a [0,3] idle1 a -> has1  tr take_b [2,5] has1 b -> both1  tr back1 [1,1] both1 -> \
         idle1 a b\n\
                   tr take_b' [1,4] idle2 b -> has2  tr take_a' [2,5] has2 a -> both2  tr back2 \
                   [1,1] both2 -> idle2 a b\n\
                   pl idle1 (1)  pl idle2 (1)  pl a (1)  pl b (1)",
    );
    let Reach::Reached(run) = deadlock(&net, &Limits::default()) else { panic!("no deadlock") };
    let dead = replay(&net, &run).unwrap();
    assert!(net.transitions().iter().all(|it| !crate::tpn::discrete::enabled(it, &dead)));
    let shown = |run: &Schedule| {
        let step = |step: &cotama_verification::tpn::Step| {
            format!("{} {}", step.date, net.transitions()[step.transition.0 as usize].name)
        };
        run.steps.iter().map(step).collect::<Vec<_>>()
    };
    assert_eq!(shown(&run), ["0 take_a", "1 take_b'"]);
}

#[test]
fn an_unreachable_marking_was_looked_for_in_all_classes() {
    let net = net("tr send [0,3] client -> waiting request  tr serve [2,4] request -> answer\n\
                   tr receive [0,1] answer waiting -> client  tr give_up [6,9] waiting -> failed  \
                   pl client (1)");
    let failed = net.place("failed").unwrap().0 as usize;
    let limits = Limits::default();
    assert_eq!(reach(&net, |it| it[failed] > 0, &limits), Reach::Unreachable { classes: 3 });
    let few = Limits { states: 2, ..limits };
    let cut = Reach::Unknown { limit: Limit::States, classes: 2 };
    assert_eq!(reach(&net, |it| it[failed] > 0, &few), cut);
    assert_eq!(reach(&net, |_| true, &few), Reach::Reached(Schedule::default()));
}

#[test]
fn a_long_run_has_dates_too() {
    let net = net(
        "tr tick [10,10] clock -> clock  tr move ]0,3[ a -> b  tr back [1,w[ b -> a  tr count \
         [7,7] c -> c n\n\
                   pl clock (1)  pl a (1)  pl c (1)",
    );
    let n = net.place("n").unwrap().0 as usize;
    let Reach::Reached(run) = reach(&net, |it| it[n] == 60, &Limits::default()) else {
        panic!("not reached")
    };
    assert_eq!(replay(&net, &run).unwrap()[n], 60);
    assert_eq!(run.steps.last().unwrap().date, Date { parts: 420, per_unit: 1 });
}

#[test]
fn thousands_of_firings_in_one_unit_have_dates() {
    let net =
        net("tr a ]0,w[ p -> q  tr b ]0,w[ q -> p n  tr end [1,1] e -> f  pl p (1)  pl e (1)");
    let [a, b, end] = ["a", "b", "end"].map(|it| net.transition(it).unwrap());
    let run = schedule(&net, &[[a, b].repeat(3_000), vec![end]].concat()).unwrap();
    assert_eq!(replay(&net, &run).unwrap()[net.place("n").unwrap().0 as usize], 3_000);
    assert_eq!(run.steps[0].date, Date { parts: 1, per_unit: 8_192 });
}
