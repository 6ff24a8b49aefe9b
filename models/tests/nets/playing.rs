//! Every shipped net, played from each marking that it can be in: with each event, and with clocks
//! just before, at and after the instants where something changes.

use crate::golden;
use crate::matrix::{matrix, said};
use crate::textbook::{Marking, explore_played, settled, words};
use crate::time::{Timed, turning_points};
use cotama_core::net::{Known, MARKINGS, Net, PlaceId};
use cotama_core::player::{Checked, EventNames, Outcome, Player, Program, Snapshot, Why};
use cotama_core::units::Millis;
use cotama_models::nets::{ace, charger, crossing, door, watchdog};
use std::collections::HashSet;

/// Reachable markings, those of them that are settled, firings, and the most that fire at once one
/// after another.
type Counts = (usize, usize, usize, usize);

fn play<P: Program<W, C> + Copy, const W: usize, const C: usize>(
    program: P,
    net: &Net<'_>,
    known: Known,
    events: &[P::Event],
) -> Counts {
    let graph = explore_played(net, MARKINGS).unwrap();
    let settle = graph.longest_settling(net).unwrap();
    let explored = Known::Explored {
        markings: graph.markings.len(),
        firings: graph.edges(),
        settle: settle as u32,
    };
    assert_eq!(known, explored);
    assert_eq!(events.len(), net.events.len());

    let reachable: HashSet<&Marking> = graph.markings.iter().collect();
    let lasting: Vec<&Marking> = graph.markings.iter().filter(|it| settled(net, it)).collect();
    for marking in &lasting {
        for elapsed in clocks(net, marking) {
            let timed = Timed { net: *net, marking: (*marking).clone(), elapsed };
            let player = restored::<P, W, C>(program, &timed);
            let (at, wait) = (player.now(), timed.due().map(|(wait, _)| wait));
            assert_eq!(player.wake_at(), wait.map(|wait| Millis(at.0 + wait)));
            // Nothing happens before the next instant that matters; there, what is due happens.
            for time in wait.into_iter().flat_map(|wait| [wait.saturating_sub(1), wait, wait + 1]) {
                let (mut player, mut timed) = (player, timed.clone());
                assert_eq!(player.advance(Millis(at.0 + time)).fired as usize, timed.advance(time));
                same(&player, &timed);
                assert!(reachable.contains(&timed.marking));
            }
            for (number, event) in events.iter().enumerate() {
                let (mut player, mut timed) = (player, timed.clone());
                let outcome = answer(player.offer(at, event));
                let expected = timed.offer(number);
                assert_eq!(
                    outcome,
                    said(net, expected),
                    "{} in {}",
                    net.events[number].name,
                    words(net, marking)
                );
                same(&player, &timed);
                assert!(reachable.contains(&timed.marking));
            }
        }
    }
    let head = format!(
        "{}: {} markings, {} settled, {} firings\n",
        net.name,
        graph.markings.len(),
        lasting.len(),
        graph.edges()
    );
    golden::check(&format!("{}.txt", net.name), &(head + &matrix(net, &graph)));
    (graph.markings.len(), lasting.len(), graph.edges(), settle)
}

/// All combinations of clock values at which something changes.
fn clocks(net: &Net<'_>, marking: &Marking) -> Vec<Vec<u64>> {
    (0..net.transitions.len()).fold(vec![vec![]], |before, transition| {
        let points = turning_points(net, transition, marking);
        let with = |point| before.iter().map(move |it| [&it[..], &[point]].concat());
        points.into_iter().flat_map(with).collect()
    })
}

fn restored<P: Program<W, C>, const W: usize, const C: usize>(
    program: P,
    timed: &Timed<'_>,
) -> Player<Checked<P>, W, C> {
    let code = program.code();
    let fingerprint = code.fingerprint;
    let mut from = Snapshot { fingerprint, marking: [0; W], clocks: [0; C], slots: [(); 0] };
    for (field, &tokens) in code.fields.iter().zip(&timed.marking) {
        from.marking[usize::from(field.word)] |= field.tokens(tokens);
    }
    for (clock, to) in code.clocks.iter().zip(&mut from.clocks) {
        let transition = code.entries[usize::from(clock.entry)].transition;
        *to = u32::try_from(timed.elapsed[usize::from(transition)]).unwrap();
    }
    Player::restore(Checked(program), Millis(1_000_000), &from).unwrap()
}

/// The player has the marking and the clocks of the textbook.
fn same<P: Program<W, C>, const W: usize, const C: usize>(
    player: &Player<P, W, C>,
    timed: &Timed<'_>,
) {
    let played: Marking =
        (0..timed.marking.len()).map(|at| player.tokens(PlaceId(at as u32))).collect();
    assert_eq!(words(&timed.net, &played), words(&timed.net, &timed.marking));
    assert_eq!(played, timed.marking);
    assert_eq!(player.wake_at().map(|it| it.0), timed.due().map(|(wait, _)| player.now().0 + wait));
    let code = player.program().code();
    for (clock, &shown) in code.clocks.iter().zip(&player.snapshot().clocks) {
        let transition = usize::from(code.entries[usize::from(clock.entry)].transition);
        let within = timed.net.transitions[transition].within.unwrap();
        let cap = within.latest.map_or(within.earliest, |latest| latest + 1);
        assert_eq!(u64::from(shown), timed.elapsed[transition].min(cap.into()));
    }
}

fn answer<T: EventNames + core::fmt::Debug>(outcome: Outcome<T>) -> String {
    match outcome {
        Outcome::Fired { transition, settled } => format!("{transition:?}, then {settled}"),
        Outcome::Ignored { why: Why::OnPurpose } => "ignored".into(),
        Outcome::Ignored { why: Why::NotEnabled } => "-".into(),
        Outcome::Ignored { why: Why::TooEarly(transition) } => {
            format!("too early for {transition:?}")
        }
        Outcome::Ignored { why: Why::TooLate(transition) } => {
            format!("too late for {transition:?}")
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_door_does_its_declared_transitions_and_nothing_else() {
    use door::Event::*;
    let counts = play::<_, _, { clock_count(&door::NET) }>(
        door::Program,
        &door::NET,
        door::KNOWN,
        &[Call, EndOpen, EndClosed, Obstacle, Clear],
    );
    assert_eq!(counts, (8, 8, 17, 0));
}

#[test]
fn a_watchdog_does_its_declared_transitions_and_nothing_else() {
    use watchdog::Event::*;
    let counts = play::<_, _, { clock_count(&watchdog::NET) }>(
        watchdog::Program,
        &watchdog::NET,
        watchdog::KNOWN,
        &[Release, Done, CsAck],
    );
    assert_eq!(counts, (10, 10, 16, 0));
}

#[test]
fn a_charger_does_its_declared_transitions_and_nothing_else() {
    use charger::Event::*;
    let counts = play::<_, _, { clock_count(&charger::NET) }>(
        charger::Program,
        &charger::NET,
        charger::KNOWN,
        &[Inserted, Removed, Recovered, Reached, Tapered, Sagged, Overheated, Cooled],
    );
    assert_eq!(counts, (9, 9, 25, 0));
}

#[test]
fn a_crossing_does_its_declared_transitions_and_nothing_else() {
    let counts = play::<_, _, { clock_count(&crossing::NET) }>(
        crossing::Program,
        &crossing::NET,
        crossing::KNOWN,
        &[crossing::Event::Button],
    );
    assert_eq!(counts, (9, 8, 11, 1));
}

#[test]
fn a_request_does_its_declared_transitions_and_nothing_else() {
    use ace::request::Event::*;
    let counts = play::<_, _, 0>(
        ace::request::Program,
        &ace::request::NET,
        ace::request::KNOWN,
        &[Trigger, Accepted, Refused, Displaced, Ended],
    );
    assert_eq!(counts, (4, 4, 8, 0));
}

#[test]
fn a_selection_does_its_declared_transitions_and_nothing_else() {
    use ace::selection::Event::*;
    let counts = play::<_, _, 0>(
        ace::selection::Program,
        &ace::selection::NET,
        ace::selection::KNOWN,
        &[
            NavigationTriggers,
            VisionTriggers,
            InteractionTriggers,
            TraversabilityTriggers,
            EmergencyTriggers,
            Completed,
            Failed,
        ],
    );
    assert_eq!(counts, (41, 6, 75, 2));
}

#[test]
fn a_behaviour_does_its_declared_transitions_and_nothing_else() {
    use ace::behaviour::Event::*;
    let counts = play::<_, _, 0>(
        ace::behaviour::Program,
        &ace::behaviour::NET,
        ace::behaviour::KNOWN,
        &[Explore, FollowPerson, GoInDirection, ReachGoal, Idle, Released],
    );
    assert_eq!(counts, (5, 5, 28, 0));
}

#[test]
fn an_accuracy_does_its_declared_transitions_and_nothing_else() {
    use ace::accuracy::Event::*;
    let counts = play::<_, _, 0>(
        ace::accuracy::Program,
        &ace::accuracy::NET,
        ace::accuracy::KNOWN,
        &[Consistent, Inconsistent, Begin],
    );
    assert_eq!(counts, (25, 21, 65, 1));
}

/// How many transitions of a net have an interval.
const fn clock_count(net: &Net<'_>) -> usize {
    let (mut count, mut at) = (0, 0);
    while at < net.transitions.len() {
        count += net.transitions[at].within.is_some() as usize;
        at += 1;
    }
    count
}
