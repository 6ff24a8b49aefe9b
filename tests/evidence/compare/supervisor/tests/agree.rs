//! The four versions are one supervisor.

use statig::blocking::InitializedStateMachine;
use supervisor::stream::Stream;
use supervisor::{Outcome, State, Supervisor, by_hand, by_net, by_smlang, by_statig};

/// Returns the answers of a version to the first events, and the states after them.
fn story<S: Supervisor>() -> Vec<(Outcome, State)> {
    let (mut supervisor, mut stream) = (S::new(), Stream::new());
    let next = |now| {
        let outcome = supervisor.offer(now, stream.next(supervisor.state()));
        (outcome, supervisor.state())
    };
    (0..100_000).map(next).collect()
}

#[test]
fn all_answer_alike() {
    let by_hand = story::<by_hand::Drive>();
    assert!(by_hand == story::<by_net::drive::Player>());
    assert!(by_hand == story::<by_smlang::StateMachine<by_smlang::Flags>>());
    assert!(by_hand == story::<InitializedStateMachine<by_statig::Drive>>());
}

#[test]
fn every_transition_fires_and_half_of_the_events_do() {
    let story = story::<by_hand::Drive>();
    let mut lines: Vec<_> =
        story.iter().filter_map(|(outcome, _)| outcome.map(|(line, _)| line as u32)).collect();
    let fired = lines.len();
    lines.sort_unstable();
    lines.dedup();
    assert_eq!(lines.len(), 20); // and two of the 22 lines fire by themselves
    assert!(story.iter().any(|(outcome, _)| matches!(outcome, Some((_, 1)))));
    assert!((45_000..55_000).contains(&fired), "{fired}");
}
