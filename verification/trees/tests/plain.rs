//! The exploration beside a plain walk by the executor alone; ticks at a period beside a clock.

use crate::random::Maker;
use cotama_streams::Streams;
use cotama_trees::explore::{Assumptions, Limits, Pair, Space};
use cotama_trees::findings::{Wishes, check};
use cotama_trees::machine::{Machine, Stop};
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
        let period = [None, Some(20)][number / 2 % 2];
        let assumptions = Assumptions::default().every(period);
        let Some(plain) = walk(&tree, skips, assumptions.clone(), None, 400) else { continue };
        let limits = Limits::default();
        let mut space = Space::explore(&tree, skips, assumptions.clone(), limits);
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
        let report = check(&tree, &Wishes { skips, assumptions, ..Wishes::default() }, limits);
        let throws = report.findings.iter().any(|it| it.question == "halt-exception");
        assert_eq!(throws, plain.halting_throws, "{text}");
        compared += 1;
    }
    compared
}

#[test]
fn explorations_of_random_trees_agree_with_a_plain_walk() {
    assert_eq!(compared(300, "plain"), 293);
}

#[test]
#[ignore = "seconds: CI runs it"]
fn explorations_of_two_thousand_random_trees_agree_with_a_plain_walk() {
    assert_eq!(compared(2_100, "plain, many"), 2_046);
}

#[test]
fn ticks_at_a_period_are_ticks_by_the_clock() {
    let mut maker = Maker { stream: Streams::new(46).stream("periods"), leaves: 0 };
    let mut timed = 0;
    for _ in 0..600 {
        let text = maker.tree();
        let tree = read_text(&text).unwrap().tree;
        let ms = [10, 25, 30, 200][maker.below(4)];
        let mut beating = Machine::with_period(&tree, ms);
        let mut clock = Machine::with_clock(&tree);
        timed += ["Delay", "Timeout", "Sleep", "Rate"].iter().any(|it| text.contains(it)) as u32;
        for _ in 0..12 {
            let mut stops = (beating.tick(), clock.tick());
            while let (Stop::Asked(question), _) = stops {
                assert_eq!(stops.0, stops.1, "{text}");
                let reply = question.replies[maker.below(question.replies.len())];
                stops = (beating.reply(reply), clock.reply(reply));
            }
            assert_eq!(stops.0, stops.1, "{text}");
            assert_eq!(beating.take_events(), clock.take_events(), "{text}");
            assert_eq!(beating.blackboard(), clock.blackboard(), "{text}");
            if matches!(stops.0, Stop::Thrown(_)) {
                break;
            }
            clock.wait(ms as i64);
        }
    }
    assert_eq!(timed, 221);
}
