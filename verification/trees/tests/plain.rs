//! The exploration beside a plain walk by the executor alone.

use crate::random::Maker;
use cotama_streams::Streams;
use cotama_trees::explore::{Assumptions, Limits, Pair, Space};
use cotama_trees::findings::{Wishes, check};
use cotama_trees::plain::walk;
use cotama_trees::reader::read_text;
use cotama_trees::tree::Answer;

/// Compares so many random trees; returns how many were small enough.
fn compared(count: usize, name: &str) -> usize {
    let mut maker = Maker { stream: Streams::new(46).stream(name), leaves: 0 };
    let mut compared = 0;
    for number in 0..count {
        let text = maker.tree_of(2 + number % 2);
        let tree = read_text(&text).unwrap().tree;
        let skips = number % 5 == 0;
        let Some(plain) = walk(&tree, skips, Assumptions::default(), None, 400) else { continue };
        let limits = Limits::default();
        let mut space = Space::explore(&tree, skips, Assumptions::default(), limits);
        let facts = space.facts(&[]);
        let pairs = |all: &[Pair]| all.iter().map(|it| (it.nodes, it.ticks)).collect();
        assert_eq!(facts.states, plain.states, "{text}");
        assert_eq!(facts.ends, plain.ends, "{text}");
        assert_eq!((facts.stuck, facts.spins), (plain.stuck, plain.spins), "{text}");
        assert_eq!(plain.lost, pairs(&facts.success_lost), "{text}");
        assert_eq!(plain.both, pairs(&facts.both_running), "{text}");
        assert_eq!(plain.overlap, pairs(&facts.started_while_running), "{text}");
        let says = |answer: Answer| {
            let never = |it: &u8| *it != 0 && *it >> answer as u8 & 1 == 0;
            (0..tree.nodes.len()).filter(|it| never(&plain.said[*it])).collect::<Vec<_>>()
        };
        assert_eq!(facts.never_success, says(Answer::Success), "{text}");
        assert_eq!(facts.never_failure, says(Answer::Failure), "{text}");
        let report = check(&tree, &Wishes { skips, ..Wishes::default() }, limits);
        let throws = report.findings.iter().any(|it| it.question == "halt-exception");
        assert_eq!(throws, plain.halting_throws, "{text}");
        compared += 1;
    }
    compared
}

#[test]
fn explorations_of_random_trees_agree_with_a_plain_walk() {
    assert_eq!(compared(300, "plain"), 292);
}

#[test]
#[ignore = "seconds: CI runs it"]
fn explorations_of_two_thousand_random_trees_agree_with_a_plain_walk() {
    assert_eq!(compared(2_100, "plain, many"), 2_046);
}
