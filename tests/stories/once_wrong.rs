//! Programs of a few lines in which the player was wrong once.

use cotama_core::net::EventId;
use cotama_core::player::{
    Firing, Names, Observer, Outcome, Packed, Player, Program, Round, Why, clocks, words,
};
use cotama_core::system::{Component, Of, System, SystemError};
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_models::nets::by_hand::{delivery, global};

/// No supervisor of the level has an interval, and yet it knows the time.
#[test]
fn the_decisional_level_reports_firings_when_they_happen() {
    let (mut level, mut at) = (delivery::Player::new(), Vec::new());
    let mut note = |it: &delivery::Firing<'_>| at.push(it.at);
    let mission = delivery::Event::gs(global::Event::mission_received);
    let told = level.offer_with(Millis(5_000), &mission, &mut note);
    let Outcome::Fired { settled, .. } = told else { panic!("{told:?}") };
    let round = level.round_with(Millis(5_100), &mut note);
    assert!(round.fired > 0, "{round:?}");
    let (first, then) = at.split_at(1 + settled as usize);
    assert!(first.iter().all(|&it| it == Millis(5_000)), "{first:?}");
    assert!(!then.is_empty() && then.iter().all(|&it| it == Millis(5_100)), "{then:?}");
    assert_eq!(level.now(), Millis(5_100));
}

net! {
    /// Rings once.
    pub mod alarm {
        places { Quiet: 1, Loud }
        flags { set }
        events { ring }
        transitions { ring on ring: Quiet => Loud do set = true; }
    }
}

net! {
    /// Brakes as soon as the alarm is set.
    pub mod brake {
        places { Free: 1, Braked }
        shared { set }
        outputs { brake }
        transitions { brake [set]: Free => Braked emit brake; }
    }
}

net! {
    /// Brakes when the alarm has been set for 200 ms.
    pub mod patient {
        places { Free: 1, Braked }
        shared { set }
        outputs { brake }
        transitions { brake [set]: Free => Braked emit brake within 200..=200 ms; }
    }
}

system! {
    /// An alarm and two brakes. The brakes come first in the order of turns.
    pub mod train {
        nets { brake: brake, patient: patient, alarm: alarm }
        shared { brake.set & patient.set = alarm.set; }
    }
}

#[test]
fn a_transition_enabled_by_the_flag_of_another_net_fires_at_once_or_is_announced() {
    let (mut train, mut told) = (train::Player::new(), Vec::new());
    let mut note = |it: &train::Firing<'_>| told.push((it.outputs().next(), it.at));
    assert_eq!(train.wake_at(), None);
    let ring = train::Event::alarm(alarm::Event::ring);
    let outcome = train.offer_with(Millis(10_000), &ring, &mut note);
    let transition = train::Transition::alarm(alarm::Transition::ring);
    assert_eq!(outcome, Outcome::Fired { transition, settled: 1 });
    assert_eq!(train::state::brake(&train), brake::State::Braked);
    assert_eq!(train::state::patient(&train), patient::State::Free);
    assert_eq!(train.wake_at(), Some(Millis(10_200)));
    assert_eq!(train.advance_with(Millis(20_000), &mut note).fired, 1);
    assert_eq!(train::state::patient(&train), patient::State::Braked);
    assert_eq!(train.wake_at(), None);
    let braked = train::Output::brake(brake::Output::brake);
    let patiently = train::Output::patient(patient::Output::brake);
    let expected = [(None, 10_000), (Some(braked), 10_000), (Some(patiently), 10_200)];
    assert_eq!(told, expected.map(|it| (it.0, Millis(it.1))));
}

net! {
    /// Is filled with five at a time when it is empty: no bound is ever exceeded.
    pub mod crate_of_five {
        places { Empty: 1, Parts: 0 of 5 }
        events { fill, unload }
        transitions {
            fill on fill: Empty => Parts * 5;
            unload on unload: Parts * 5 => Empty;
        }
        laws { deadlock_free; }
    }
}

/// A marking both empty and full, which only damage can bring about. Five and five are ten, which
/// is two and a carry where there is room for a number up to seven.
#[test]
fn a_restored_marking_that_cannot_be_reached_loses_no_token() {
    use crate_of_five::{Checked, Event, Place, Transition};
    let mut full = crate_of_five::Player::new();
    assert!(full.offer(Millis(0), &Event::fill).fired());
    let mut stored = full.snapshot();
    let code = full.program().code();
    assert!(code.bounded);
    stored.marking[0] |= code.fields[0].tokens(1);
    let mut player =
        Checked::restore(cotama_core::player::Checked::default(), Millis(0), &stored).unwrap();
    assert_eq!([Place::Empty, Place::Parts].map(|it| player.tokens(it)), [1, 5]);
    let refused = player.offer(Millis(0), &Event::fill);
    assert_eq!(refused, Outcome::Ignored { why: Why::Full(Transition::fill) });
    assert_eq!([Place::Empty, Place::Parts].map(|it| player.tokens(it)), [1, 5]);
    assert!(!player.offer(Millis(0), &Event::unload).fired()); // two would be empty
}

/// A player of a net that `net!` makes does not compile with other sizes: see
/// [`Program`](cotama_core::player::Program). One that is made at run time is not packed.
#[test]
fn a_net_with_an_interval_has_no_player_without_clocks() {
    let alone = [Component::alone(&patient::NET)];
    let system = System::alone(&alone);
    assert_eq!((words(&system), clocks(&system)), (Some(1), 1));
    assert_eq!(Packed::<1>::of(&system).err(), Some(SystemError::TooLong));
    let packed = Packed::<1, 1>::of(&system).unwrap();
    let player = Player::<_, 1, 1>::start(packed.load(&system), Millis(0), &mut ());
    assert_eq!(player.wake_at(), None); // nothing sets what it shares
}

net! {
    /// Asks once, after 5 ms.
    pub mod asker {
        places { Ready: 1, Asked }
        outputs { ask }
        transitions { ask: Ready => Asked emit ask within 5..=5 ms; }
    }
}

net! {
    /// Notes what it is asked within 10 ms of the last time.
    pub mod clerk {
        places { Open: 1 }
        events { ask }
        outputs { note }
        transitions { note on ask: Open => Open emit note within 0..=10 ms; }
    }
}

net! {
    /// Reads notes. A new one makes those before it void.
    pub mod reader {
        places { Idle: 1 }
        events { note }
        transitions { read on note: Idle => Idle; }
    }
}

system! {
    /// There is room for two notes.
    pub mod office {
        nets { asker: asker, clerk: clerk, reader: reader }
        links {
            asker.ask => clerk.ask now;
            clerk.note => reader.note mail 2;
        }
        clears { reader.note empties reader.note; }
    }
}

const ASK: office::Event = office::Event::clerk(clerk::Event::ask);

/// With two notes waiting nobody can ask, until at 11 ms nobody notes it any more: that is when the
/// asker asks, however often it is told the time.
#[test]
fn a_transition_that_waits_for_room_fires_when_it_needs_none() {
    let told_at = |times: &[u64]| {
        let (mut office, mut at) = (office::Player::new(), Vec::new());
        for _ in 0..2 {
            assert!(office.offer(Millis(0), &ASK).fired());
        }
        for &now in times {
            let _ = office.advance_with(Millis(now), &mut |it: &office::Firing<'_>| at.push(it.at));
        }
        (office, at)
    };
    let late = told_at(&[20]);
    assert_eq!(late.1, [Millis(11)]);
    assert_eq!(late, told_at(&(1..=20).collect::<Vec<_>>()));
    assert_eq!(late, told_at(&[5, 10, 20]));
}

/// An event thrown away by one that is read has not been read.
#[test]
fn a_waiting_event_thrown_away_is_not_ignored() {
    let mut office = office::Player::new();
    for _ in 0..2 {
        assert!(office.offer(Millis(0), &ASK).fired());
    }
    assert_eq!(office.round(Millis(0)), Round { fired: 1, ..Round::default() });
    assert!(!office.round_is_due());
}

net! {
    /// A door that locks by itself.
    pub mod door {
        places { Open: 1, Closed, Locked }
        events { close }
        transitions { close on close: Open => Closed; lock: Closed => Locked; }
    }
}

/// A net alone says as much as one of several.
#[test]
fn a_net_alone_reports_ignored_events_and_carries_payloads() {
    #[derive(Default)]
    struct Log(Vec<(bool, u8)>);
    impl<P: Names> Observer<P, u8> for Log {
        fn on_fire(&mut self, firing: &Firing<'_, P, u8>) {
            self.0.push((true, firing.carries));
        }
        fn on_ignore(&mut self, _: Of<EventId>, carries: u8) {
            self.0.push((false, carries));
        }
    }
    let (mut door, mut log) = (Player::<door::Program, 1, 0, 0, u8>::new(), Log::default());
    let event = door::Event::close;
    assert!(door.offer_carrying(Millis(0), &event, 7, &mut log).fired());
    assert!(!door.offer_carrying(Millis(0), &event, 8, &mut log).fired());
    assert_eq!(log.0, [(true, 7), (true, 7), (false, 8)]);
}
