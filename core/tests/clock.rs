//! The clock that a player is told: one of 32 bits that begins anew, and one that goes back.

use cotama_core::net;
use cotama_core::player::{Firing, Observer};
use cotama_core::ticks::Ticks32;
use cotama_core::units::Millis;

net! {
    mod lamp {
        places { Off: 1, On }
        events { press }
        outputs { dark }
        transitions { on on press: Off => On; off: On => Off emit dark after 1000 ms; }
    }
}

const WRAP: u64 = 1 << 32;

/// The instants at which the timer ends.
#[derive(Default)]
struct Ends(Vec<u64>);

impl Observer<lamp::Program> for Ends {
    fn on_fire(&mut self, firing: &Firing<'_, lamp::Program>) {
        if firing.on.is_none() {
            self.0.push(firing.at.0);
        }
    }
}

#[test]
fn a_timer_of_one_second_across_the_wrap_ends_after_one_second() {
    for wrap in [1, 2, 3, 10] {
        for before in [0, 1, 2, 10, 500, 998, 999, 1_000, 1_001] {
            for step in [1, 7, 100, 999, 1_000, 5_000] {
                let pressed = wrap * WRAP - before;
                let mut ticks = Ticks32::going_on_at(Millis(pressed - 3));
                let mut lamp = lamp::Player::start(lamp::Program, ticks.latest(), &mut ());
                assert!(lamp.offer(ticks.widen(pressed as u32), &lamp::Event::press).fired());
                assert_eq!(lamp.wake_at(), Some(Millis(pressed + 1_000)));
                let (mut ends, mut at) = (Ends::default(), pressed);
                while at < pressed + 1_000 {
                    assert_eq!(ends.0, [0; 0], "at {at}");
                    at += step;
                    let now = ticks.widen(at as u32);
                    assert_eq!(lamp.clock_went_back(now), None);
                    assert!(!lamp.advance_with(now, &mut ends).behind);
                }
                assert_eq!(ends.0, [pressed + 1_000], "{before} ms before wrap {wrap}");
            }
        }
    }
}

/// The same with the bare count: why it is widened.
#[test]
fn a_bare_count_goes_back_by_all_of_its_range_and_is_seen_to() {
    let mut lamp = lamp::Player::start(lamp::Program, Millis(WRAP - 100), &mut ());
    assert!(lamp.offer(Millis(WRAP - 100), &lamp::Event::press).fired());
    assert_eq!(lamp.clock_went_back(Millis(900)), Some(Millis(WRAP - 1_000)));
    assert_eq!(lamp.advance(Millis(900)).fired, 0);
    assert_eq!(lamp.state(), lamp::State::On);
}

#[test]
fn a_clock_that_goes_back_is_told_by_how_much_and_time_stands_still() {
    let cases = [(500, 499), (500, 0), (999, 1), (1, 0), (700, 350)];
    for (last, back) in cases {
        let mut lamp = lamp::Player::new();
        assert!(lamp.offer(Millis(0), &lamp::Event::press).fired());
        assert_eq!(lamp.advance(Millis(last)).fired, 0);
        let stays = lamp;
        assert_eq!(lamp.clock_went_back(Millis(back)), Some(Millis(last - back)));
        assert_eq!(lamp.advance(Millis(back)).fired, 0);
        assert!(!lamp.offer(Millis(back), &lamp::Event::press).fired());
        assert_eq!(lamp, stays, "back from {last} to {back}");
        for now in [last, last + 1, 5_000, u64::MAX] {
            assert_eq!(lamp.clock_went_back(Millis(now)), None);
        }
        assert_eq!(lamp.wake_at(), Some(Millis(1_000)));
        let mut ends = Ends::default();
        assert!(!lamp.advance_with(Millis(1_200), &mut ends).behind);
        assert_eq!(ends.0, [1_000]);
    }
}

/// An interrupt reads the counter, and its event is offered after a later count was told.
#[test]
fn a_count_read_before_the_wrap_and_told_after_it_goes_back_by_its_age() {
    let mut ticks = Ticks32::starting_at(u32::MAX - 9);
    let mut lamp = lamp::Player::start(lamp::Program, ticks.latest(), &mut ());
    assert_eq!(lamp.advance(ticks.widen(10)).fired, 0);
    let late = ticks.widen(u32::MAX);
    assert_eq!(lamp.clock_went_back(late), Some(Millis(11)));
    assert!(lamp.offer(late, &lamp::Event::press).fired());
    assert_eq!(lamp.wake_at(), Some(Millis(WRAP + 1_010)));
}
