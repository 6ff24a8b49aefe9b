//! Claims of the sources of the nets, to the millisecond and to the cycle.

use crate::textbook::{Marking, explore, settled};
use crate::time::{Answer, Timed};
use cotama_core::net::MARKINGS;
use cotama_core::player::Outcome;
use cotama_core::units::Millis;
use cotama_models::nets::{ace, watchdog};

/// A watchdog that has seen `misses` in a row, and whose next job was released at the time that is
/// given back.
fn after(misses: u64) -> (watchdog::Player, u64) {
    use watchdog::Event::{Done, Release};
    let mut player = watchdog::Player::new();
    for miss in 0..misses {
        assert!(player.offer(Millis(200 * miss), &Release).fired());
        assert!(player.offer(Millis(200 * miss + 110), &Done).fired());
    }
    assert!(player.offer(Millis(200 * misses), &Release).fired());
    (player, 200 * misses)
}

#[test]
fn a_job_that_is_done_at_its_deadline_is_late() {
    use watchdog::{Event::Done, Place::misses, Transition};
    let (mut in_time, start) = after(1);
    assert!(matches!(
        in_time.offer(Millis(start + 99), &Done),
        Outcome::Fired { transition: Transition::w2, .. }
    ));
    assert_eq!(in_time.tokens(misses), 0);

    let (mut late, start) = after(1);
    assert!(matches!(
        late.offer(Millis(start + 100), &Done),
        Outcome::Fired { transition: Transition::w4, .. }
    ));
    assert_eq!(late.tokens(misses), 2);
}

#[test]
fn three_misses_in_a_row_are_one_fault_and_two_are_none() {
    use watchdog::{Output, State};
    for (before, then, says) in [
        (0, State::Idle, vec![Output::SkipJob]),
        (1, State::Idle, vec![Output::SkipJob]),
        (2, State::Fault, vec![Output::SkipJob, Output::RtFault]),
    ] {
        let (mut player, start) = after(before);
        let mut said = vec![];
        let mut listen = |firing: &watchdog::Firing<'_>| said.extend(firing.outputs());
        // The job never ends: its deadline is after 100 ms, and its extra time over 20 ms later.
        assert_eq!(player.advance_with(Millis(start + 119), &mut listen).fired, 1);
        assert_eq!(player.state(), State::Extra);
        assert_eq!(player.advance_with(Millis(start + 1_000), &mut listen).fired, 1);
        assert_eq!((player.state(), said), (then, says));
    }
}

/// ACE, property 6: a goal that stays blocked is reported after (levels) x (MAXTRIALS + 1) = 20
/// cycles.
#[test]
fn a_blocked_goal_is_reported_after_twenty_cycles_and_not_after_nineteen() {
    let blocked = |cycles| {
        let mut control = ace::accuracy::Player::new();
        for cycle in 1..=cycles {
            assert!(
                control.offer(Millis(500 * cycle), &ace::accuracy::Event::Inconsistent).fired()
            );
        }
        control
    };
    let nineteen = blocked(19);
    assert_eq!(nineteen.state(), ace::accuracy::State::Accuracy1);
    assert_eq!(nineteen.tokens(ace::accuracy::Place::trials), 4);
    let twenty = blocked(20);
    assert_eq!((twenty.state(), twenty.now()), (ace::accuracy::State::Failed, Millis(10_000)));

    // From wherever it may be, twenty suffice.
    let net = ace::accuracy::NET;
    let graph = explore(&net, MARKINGS).unwrap();
    let longest = |marking: &Marking| {
        let mut timed = Timed::new(&net, marking);
        (0..=20).take_while(|_| matches!(timed.offer(1), Answer::Fired { .. })).count()
    };
    let settled = graph.markings.iter().filter(|it| settled(&net, it));
    assert_eq!(settled.map(longest).max(), Some(20));
}

/// ACE, property 4: while a subsystem is active, nothing of lower priority becomes active; and 5:
/// the emergency stop always does, at once.
#[test]
fn priority_decides_who_holds_the_robot() {
    use ace::selection::{Event::*, Place::*, Player};
    let subsystems = [Navigation, Vision, Interaction, Traversability, Emergency];
    let triggers = [
        NavigationTriggers,
        VisionTriggers,
        InteractionTriggers,
        TraversabilityTriggers,
        EmergencyTriggers,
    ];
    for (held, first) in triggers.iter().enumerate() {
        for (asks, second) in triggers.iter().enumerate() {
            let mut ace = Player::new();
            assert!(ace.offer(Millis(0), first).fired() && ace.offer(Millis(1), second).fired());
            assert_eq!(ace.tokens(subsystems[held.max(asks)]), 1);
            assert_eq!(ace.tokens(Active), 1);
        }
    }
}

/// ACE, property 3: every trigger is answered at once, and once.
#[test]
fn every_trigger_is_answered_at_once() {
    use ace::selection::{Event::*, Output, Player};
    let triggers = [
        NavigationTriggers,
        VisionTriggers,
        InteractionTriggers,
        TraversabilityTriggers,
        EmergencyTriggers,
    ];
    for first in triggers {
        for second in triggers {
            let (mut ace, mut answers) = (Player::new(), vec![]);
            let mut listen = |firing: &ace::selection::Firing<'_>| answers.extend(firing.outputs());
            assert!(ace.offer_with(Millis(0), &first, &mut listen).fired());
            assert!(ace.offer_with(Millis(0), &second, &mut listen).fired());
            let of = |answer: &Output| {
                format!("{answer:?}").replace("Accepted", "").replace("Refused", "")
            };
            let asked =
                |event: &ace::selection::Event| format!("{event:?}").replace("Triggers", "");
            assert_eq!(answers.iter().map(of).collect::<Vec<_>>(), [asked(&first), asked(&second)]);
        }
    }
}
