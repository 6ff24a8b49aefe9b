//! The contract of time: how often it is told makes no difference, and nothing is early or late.

use super::lamp;
use crate::player::{Outcome, Player, Why};
use cotama_units::proofs::few;
use cotama_units::units::Millis;

type Lamp = lamp::Player;

/// The lamp after any three of its events at any time up to 21 ms.
fn any_lamp() -> Lamp {
    let mut lamp = Player::new();
    for _ in 0..3 {
        let now = Millis(lamp.now().0 + u64::from(few::<3>()));
        let event = if kani::any() { lamp::Event::press } else { lamp::Event::stop };
        let _ = lamp.offer(now, &event);
    }
    lamp
}

/// However often the time in between is told, the same has happened in the end.
#[kani::proof]
#[kani::unwind(8)]
pub fn time_can_be_told_in_any_portions() {
    let lamp = any_lamp();
    let (first, second) = (u64::from(few::<3>()), u64::from(few::<3>()));
    let (mut once, mut twice) = (lamp, lamp);
    let end = Millis(lamp.now().0 + first + second);
    let all = once.advance(end);
    let some = twice.advance(Millis(lamp.now().0 + first));
    let rest = twice.advance(end);
    assert!(once == twice && all.fired == some.fired + rest.fired && once.now() == end);
    assert!(!all.behind && !some.behind && !rest.behind);
    kani::cover!(some.fired == 1 && rest.fired == 1, "one in each portion");
}

/// Nothing fires before the instant that the player names, and something does at it; without one
/// nothing ever does.
#[kani::proof]
#[kani::unwind(8)]
pub fn the_player_wakes_when_something_fires() {
    let lamp = any_lamp();
    let (mut early, mut due) = (lamp, lamp);
    match lamp.wake_at() {
        Some(Millis(at)) => {
            assert!(at > lamp.now().0);
            assert!(early.advance(Millis(at - 1)).fired == 0 && due.advance(Millis(at)).fired == 1);
            assert!(early.wake_at() == Some(Millis(at)));
        }
        None => assert!(due.advance(Millis(u64::MAX)).fired == 0),
    }
    kani::cover!(lamp.wake_at().is_some_and(|it| it.0 < lamp.now().0 + 3), "a clock has run");
    kani::cover!(lamp.wake_at().is_none(), "nothing is due");
}

/// A transition without event fires at its first instant, also when the time is told late.
#[kani::proof]
#[kani::unwind(8)]
pub fn a_due_transition_fires_at_its_due_time() {
    let (start, late) = (u64::from(few::<3>()), u64::from(few::<4>()));
    let mut lamp = Lamp::new();
    assert!(lamp.offer(Millis(start), &lamp::Event::press).fired());
    let mut fired = [None; 2];
    let mut count = 0;
    let mut note = |it: &lamp::Firing<'_>| {
        fired[count] = Some((it.at, it.transition()));
        count += 1;
    };
    let _ = lamp.advance_with(Millis(start + late), &mut note);
    let first = (late >= 5).then_some((Millis(start + 5), lamp::Transition::late));
    let second = (late >= 7).then_some((Millis(start + 7), lamp::Transition::back));
    assert!(fired == [first, second]);
    kani::cover!(late > 7, "told late");
}

/// An event is answered within its interval only, both ends included, and the player says on which
/// side of it the event came.
#[kani::proof]
#[kani::unwind(8)]
pub fn an_event_has_its_interval() {
    let (start, age) = (u64::from(few::<3>()), u64::from(few::<3>()));
    let mut lamp = Lamp::new();
    assert!(lamp.offer(Millis(start), &lamp::Event::press).fired());
    let said = lamp.offer(Millis(start + age), &lamp::Event::stop);
    let expected = match age {
        0 => Outcome::Ignored { why: Why::TooEarly(lamp::Transition::stop) },
        1 | 2 => Outcome::Fired { transition: lamp::Transition::stop, settled: 0 },
        3 | 4 => Outcome::Ignored { why: Why::TooLate(lamp::Transition::stop) },
        // At 5 ms the lamp is late, and what is due goes before what is offered.
        _ => Outcome::Ignored { why: Why::NotEnabled },
    };
    assert!(said == expected);
    kani::cover!(age == 4, "too late");
}

/// A time before the last one counts as the last one.
#[kani::proof]
#[kani::unwind(8)]
pub fn time_does_not_go_back() {
    let lamp = any_lamp();
    let mut told = lamp;
    let back = Millis(lamp.now().0.saturating_sub(1 + u64::from(few::<3>())));
    assert!(told.advance(back).fired == 0 && told == lamp);
    let (mut back_then, mut now) = (lamp, lamp);
    let event = lamp::Event::press;
    assert!(back_then.offer(back, &event) == now.offer(lamp.now(), &event) && back_then == now);
    kani::cover!(back < lamp.now() && now != lamp, "an event of the past");
}

/// A clock never runs beyond its cap, and only while its transition has its tokens.
#[kani::proof]
#[kani::unwind(8)]
pub fn clocks_stop_at_their_caps() {
    let mut lamp = any_lamp();
    let _ = lamp.advance(Millis(lamp.now().0 + u64::from(few::<3>())));
    let code = crate::player::Program::code(&lamp.program);
    for (elapsed, clock) in lamp.clocks.iter().zip(code.clocks) {
        let runs = code.holds(&lamp.marking, &clock.need);
        assert!(*elapsed <= if runs { clock.cap() } else { 0 });
    }
    kani::cover!(lamp.clocks.contains(&4), "at 4 ms");
    kani::cover!(lamp.clocks.contains(&3), "at the cap");
}
