//! Families of trees, whose numbers of states are known by formulas.

use cotama_trees::explore::{Assumptions, Limits, Space};
use cotama_trees::findings::timeouts;
use cotama_trees::reader::read_text;

/// Returns the numbers of states, before and after merging.
fn size(inner: &str) -> (usize, usize) {
    let text =
        format!("<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">{inner}</BehaviorTree></root>");
    let tree = read_text(&text).unwrap().tree;
    let mut space = Space::explore(&tree, false, Assumptions::default(), Limits::default());
    (space.size().0, space.minimal())
}

fn actions(n: usize, around: impl Fn(usize) -> String) -> String {
    (1..=n).map(around).collect()
}

#[test]
fn parallel_actions_have_the_states_of_the_formula() {
    for n in 1..=7_u32 {
        let all = actions(n as usize, |it| format!("<A{it}/>"));
        let found = size(&format!("<ParallelAll max_failures=\"1\">{all}</ParallelAll>"));
        let states = 3_usize.pow(n) - 2_usize.pow(n) + 1;
        assert_eq!(found, (states, 2_usize.pow(n + 1) - 2), "{n}");
    }
}

fn retries(n: usize) -> (usize, usize) {
    let all = actions(n, |it| {
        format!("<RetryUntilSuccessful num_attempts=\"3\"><A{it}/></RetryUntilSuccessful>")
    });
    size(&format!("<Parallel success_count=\"{n}\" failure_count=\"1\">{all}</Parallel>"))
}

#[test]
fn parallel_retries_have_the_states_of_the_formula() {
    for n in 1..=4_u32 {
        let states = 5_usize.pow(n) + 3_usize.pow(n) - 2_usize.pow(n);
        assert_eq!(retries(n as usize), (states, states), "{n}");
    }
}

#[test]
#[ignore = "a minute: CI runs it"]
fn seven_parallel_retries_have_the_states_of_the_formula() {
    assert_eq!(retries(7), (80_184, 80_184));
}

#[test]
fn nested_recoveries_have_the_states_of_the_formula() {
    for n in 1..=7_u32 {
        let nested = (1..=n).fold("<A1/>".to_owned(), |inner, it| {
            format!("<RecoveryNode number_of_retries=\"2\">{inner}<A{}/></RecoveryNode>", it + 1)
        });
        let states = 2 * 3_usize.pow(n);
        assert_eq!(size(&nested), (states, states), "{n}");
    }
}

#[test]
fn a_timeout_halts_its_child_after_the_ticks_of_its_bound() {
    for (msec, period) in [(70, 10), (65, 10), (5, 10), (1_000, 10)] {
        let text = format!(
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Timeout msec=\"{msec}\"><A1/>\
             </Timeout></BehaviorTree></root>"
        );
        let tree = read_text(&text).unwrap().tree;
        let assumptions = Assumptions::default().every(Some(period));
        let space = Space::explore(&tree, false, assumptions, Limits::default());
        // The child starts in the first tick; the last of these states ends in the next one.
        let (ticks, ms) = timeouts(&tree, period)[0].1.unwrap();
        assert_eq!((space.size().0 as i64, ms), (1 + ticks, ticks * period as i64));
        assert_eq!(ms, msec.max(10) / 10 * 10 + if msec % 10 > 0 && msec > 10 { 10 } else { 0 });
    }
}
