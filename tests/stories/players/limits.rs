//! Nets that never come to rest, and the ends of the number ranges.

use super::{Played, load, nets, with_size_of};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, NetError, PlaceId, TransitionId};
use cotama_core::player::{
    Advanced, CATCH_UP, Checked, Loaded, Outcome, Packed, Player, SETTLE, Stepped, Why,
};
use cotama_core::system::{Component, Of, System};
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::nets::Time;

/// A net of one place with this transition, of which the arcs are still missing, and an event.
fn wheel(transition: OwnedTransition) -> OwnedNet {
    let mut net = OwnedNet::new("wheel", "");
    let place = net.place(OwnedPlace::new("axle", 1).at_most(1)).unwrap();
    net.event("push", "").unwrap();
    net.transition(transition.take(place, 1).give(place, 1)).unwrap();
    net
}

/// Tells a story of a player of this net, that starts at time zero; it is one that can do
/// synchronous steps too.
fn with_player(net: &OwnedNet, story: impl FnOnce(&mut Player<Checked<Loaded<'_, 1, 2>>, 1, 2>)) {
    let view = net.view();
    let net = view.net();
    let alone = [Component::alone(&net)];
    let system = System::alone(&alone);
    let packed = Packed::<1, 2>::of(&system).unwrap();
    story(&mut Player::start(Checked(packed.load(&system)), Millis(0), &mut ()));
}

const PUSH: Of<EventId> = Of { component: 0, id: EventId(0) };

/// The only transition.
const TURN: Of<TransitionId> = of(0);

const fn of(transition: u32) -> Of<TransitionId> {
    Of { component: 0, id: TransitionId(transition) }
}

fn fired(settled: u32) -> Outcome<Of<TransitionId>> {
    Outcome::Fired { transition: TURN, settled }
}

fn ignored(why: Why<Of<TransitionId>>) -> Outcome<Of<TransitionId>> {
    Outcome::Ignored { why }
}

#[test]
fn a_net_that_never_settles_is_behind_for_ever() {
    with_player(&wheel(OwnedTransition::new("spin")), |player| {
        for now in [0, 1, 1_000_000] {
            assert_eq!(player.advance(Millis(now)), Advanced { fired: SETTLE, behind: true });
            assert_eq!(player.offer(Millis(now), &PUSH), ignored(Why::Behind));
            assert_eq!((player.now(), player.wake_at()), (Millis(0), Some(Millis(0))));
        }
        // A step is one, however many follow.
        assert_eq!(player.step(Millis(7), &[]), Stepped { fired: 1, ..Stepped::default() });
    });
}

#[test]
fn a_net_that_fires_without_time_passing_is_behind_for_ever() {
    with_player(&wheel(OwnedTransition::new("spin").within(0, Some(0))), |player| {
        for now in [0, 1, 1_000_000] {
            assert_eq!(player.advance(Millis(now)), Advanced { fired: CATCH_UP, behind: true });
            assert_eq!(player.offer(Millis(now), &PUSH), ignored(Why::Behind));
            assert_eq!((player.now(), player.wake_at()), (Millis(0), Some(Millis(0))));
        }
    });
}

#[test]
fn a_player_that_sleeps_too_long_catches_up_with_several_calls() {
    with_player(&wheel(OwnedTransition::new("turn").within(3, Some(3))), |player| {
        let now = Millis(3 * u64::from(2 * CATCH_UP) + 2);
        assert_eq!(player.advance(now), Advanced { fired: CATCH_UP, behind: true });
        assert_eq!(player.now(), Millis(3 * u64::from(CATCH_UP)));
        assert_eq!(player.advance(now), Advanced { fired: CATCH_UP, behind: false });
        assert_eq!((player.now(), player.wake_at()), (now, Some(Millis(now.0 + 1))));
        assert_eq!(player.offer(now, &PUSH), ignored(Why::NotEnabled));
    });
}

#[test]
fn time_does_not_go_back() {
    with_player(&wheel(OwnedTransition::new("turn").on(PUSH.id).within(10, Some(20))), |player| {
        assert_eq!(player.offer(Millis(9), &PUSH), ignored(Why::TooEarly(TURN)));
        assert_eq!(player.advance(Millis(4)), Advanced::default());
        assert_eq!(player.now(), Millis(9));
        assert_eq!(player.offer(Millis(10), &PUSH), fired(0));
        assert_eq!(player.step(Millis(0), &[PUSH]), Stepped { ignored: 1, ..Stepped::default() });
        assert_eq!(player.offer(Millis(30), &PUSH), fired(0));
        assert_eq!(player.offer(Millis(51), &PUSH), ignored(Why::TooLate(TURN)));
    });
}

#[test]
fn the_longest_interval_is_kept_to_the_millisecond() {
    let longest = u64::from(u32::MAX);
    with_player(&wheel(OwnedTransition::new("turn").within(u32::MAX, None)), |player| {
        assert_eq!(player.wake_at(), Some(Millis(longest)));
        assert_eq!(player.advance(Millis(longest - 1)), Advanced::default());
        assert_eq!(player.advance(Millis(3 * longest - 1)), Advanced { fired: 2, behind: false });
        assert_eq!(player.wake_at(), Some(Millis(3 * longest)));
    });
    with_player(
        &wheel(OwnedTransition::new("turn").on(PUSH.id).within(0, Some(u32::MAX - 1))),
        |player| {
            assert_eq!(player.offer(Millis(longest - 1), &PUSH), fired(0));
            assert_eq!(player.offer(Millis(2 * longest - 1), &PUSH), ignored(Why::TooLate(TURN)));
            assert_eq!(player.offer(Millis(u64::MAX), &PUSH), ignored(Why::TooLate(TURN)));
        },
    );
}

#[test]
fn time_ends_without_an_error() {
    with_player(&wheel(OwnedTransition::new("turn").within(u32::MAX, None)), |player| {
        assert_eq!(player.advance(Millis(u64::MAX)), Advanced { fired: CATCH_UP, behind: true });
    });
    with_player(&wheel(OwnedTransition::new("turn").on(PUSH.id).within(10, None)), |player| {
        assert_eq!(player.advance(Millis(u64::MAX)), Advanced::default());
        assert_eq!(player.offer(Millis(u64::MAX), &PUSH), fired(0));
        assert_eq!(player.offer(Millis(u64::MAX), &PUSH), ignored(Why::TooEarly(TURN)));
    });
}

#[test]
fn a_step_tells_of_the_first_64_events() {
    with_player(&wheel(OwnedTransition::new("turn").on(PUSH.id)), |player| {
        assert_eq!(player.step(Millis(0), &[PUSH; 70]), Stepped { fired: 1, ..Stepped::default() });
    });
    with_player(&wheel(OwnedTransition::new("turn").on(PUSH.id).within(1, None)), |player| {
        assert_eq!(
            player.step(Millis(0), &[PUSH; 70]),
            Stepped { ignored: u64::MAX, ..Stepped::default() }
        );
        assert_eq!(
            player.step(Millis(0), &[PUSH; 64]),
            Stepped { ignored: u64::MAX, ..Stepped::default() }
        );
        assert_eq!(
            player.step(Millis(0), &[PUSH; 63]),
            Stepped { ignored: u64::MAX >> 1, ..Stepped::default() }
        );
    });
}

/// A step of two that give to the same place, each of which it has room for.
#[test]
fn a_step_does_not_fit_when_its_gifts_together_do_not() {
    let mut net = OwnedNet::new("two givers", "");
    let left = net.place(OwnedPlace::new("left", 1).at_most(1)).unwrap();
    let right = net.place(OwnedPlace::new("right", 1).at_most(1)).unwrap();
    let both = net.place(OwnedPlace::new("both", 0).at_most(1)).unwrap();
    net.event("push", "").unwrap();
    net.transition(OwnedTransition::new("from left").on(PUSH.id).take(left, 1).give(both, 1))
        .unwrap();
    net.transition(OwnedTransition::new("from right").on(PUSH.id).take(right, 1).give(both, 1))
        .unwrap();
    with_player(&net, |player| {
        let step = player.step(Millis(0), &[PUSH]);
        assert_eq!(step, Stepped { fired: 0, ignored: 1, full: true });
        assert_eq!([left, right, both].map(|it| player.tokens(it)), [1, 1, 0]);
        assert_eq!(player.offer(Millis(0), &PUSH), fired(0));
        assert_eq!(player.offer(Millis(0), &PUSH), ignored(Why::Full(of(1))));
    });
}

/// Whatever the net does, no call lets more than so many transitions fire, and no place holds more
/// than its bound.
fn every_call_returns<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
) -> bool {
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = load(&packed, system, draw);
    let mut player: Played<'_, W, C, S> = Player::start(program, Millis(0), &mut ());
    let mut endless = false;
    for step in 1..=3 {
        let now = Millis(step * 10_000_000);
        let Advanced { fired, behind } = player.advance(now);
        assert!(fired <= CATCH_UP + SETTLE, "seed {seed}: {fired}");
        assert_eq!(behind, player.wake_at().is_some_and(|due| due <= now), "seed {seed}");
        assert_eq!(behind, player.now() < now, "seed {seed}");
        endless |= behind;
        for (place, it) in (0..).zip(system.components[0].net.places) {
            assert!(player.tokens(PlaceId(place)) <= it.bound, "seed {seed}");
        }
    }
    endless
}

#[test]
fn every_call_returns_even_where_a_net_never_rests() {
    let mut endless = 0;
    for (seed, net, mut draw) in nets(600_000..601_000, Time::With) {
        let draw = &mut draw;
        let is_endless = net.with(|it| with_size_of!(it, draw, every_call_returns(it, seed, draw)));
        endless += u32::from(is_endless);
    }
    assert!(endless > 100, "{endless}");
}

#[test]
fn a_place_starts_with_at_most_65_535_tokens() {
    let stock = |tokens| {
        let mut net = OwnedNet::new("stock", "");
        net.place(OwnedPlace::new("Parts", tokens)).unwrap();
        let view = net.view();
        Packed::<1, 0>::alone(&view.net()).err()
    };
    assert_eq!(stock(65_535), None);
    assert_eq!(stock(65_536), Some(NetError::Place { place: 0 }));
}
