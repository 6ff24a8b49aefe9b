//! What a player stores comes back as it was, and what is damaged breaks no law.

use super::{Played, delay, nets, with_size_of};
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, Law, Net, PlaceId, Role, Within};
use cotama_core::player::{Loaded, Packed, Player, Program, RestoreError, Snapshot, clocks, words};
use cotama_core::units::Millis;
use cotama_tests::instances::Draw;
use cotama_tests::textbook::Game;
use cotama_tests::textbook::nets::{CLOCKS, Time, one_in};

/// Stores and restores after each of 50 events, unharmed and with one byte changed.
fn storing_changes_nothing<const W: usize, const C: usize>(
    net: &Net<'_>,
    seed: u64,
    draw: &mut Draw,
    refused: &mut [u32; 6],
) {
    let packed = Packed::<W>::of(net).unwrap();
    let program = packed.load(net);
    let mut player: Played<'_, W, C> = Player::start(program, Millis(0), &mut ());
    for _ in 0..50 {
        let now = Millis(player.now().0 + delay(draw));
        if player.advance(now).behind {
            return;
        }
        if !net.events.is_empty() {
            let event = EventId(draw.between(0, net.events.len() as u64 - 1) as u32);
            if player.offer(now, &event).fired() && player.advance(now).behind {
                return;
            }
        }
        let stored = player.snapshot();
        let mut room = [0; 128];
        let bytes = stored.write(&mut room).unwrap().to_vec();
        assert_eq!(bytes.len(), Snapshot::<W, C>::BYTES);
        assert_eq!(Snapshot::read(&bytes), Some(stored), "seed {seed}");
        let restored = Player::restore(program, now, &stored)
            .unwrap_or_else(|why| panic!("seed {seed}: {why}"));
        assert_same_player(&restored, &player, seed);

        let mut damaged = bytes;
        let at = draw.between(0, damaged.len() as u64 - 1) as usize;
        damaged[at] ^= draw.between(1, 255) as u8;
        let damaged = Snapshot::<W, C>::read(&damaged).unwrap();
        match Player::restore(program, now, &damaged) {
            Ok(restored) => {
                assert_eq!(restored.snapshot(), damaged, "seed {seed}");
                assert_lawful(&restored, seed);
                refused[0] += 1;
            }
            Err(RestoreError::OtherNet { .. }) => {
                assert!(at < 8, "seed {seed}");
                refused[1] += 1;
            }
            Err(RestoreError::Marking) => refused[2] += 1,
            Err(RestoreError::Law(_)) => refused[3] += 1,
            Err(RestoreError::Clock(_)) => refused[4] += 1,
            Err(RestoreError::NotSettled) => refused[5] += 1,
        }
    }
}

fn assert_same_player<const W: usize, const C: usize>(
    one: &Played<'_, W, C>,
    two: &Played<'_, W, C>,
    seed: u64,
) {
    assert_eq!((one.now(), one.snapshot()), (two.now(), two.snapshot()), "seed {seed}");
    assert_eq!(one.wake_at(), two.wake_at(), "seed {seed}");
}

/// Bounds, complements, invariants and clocks are as in a marking that the net can have, and the
/// net is settled.
fn assert_lawful<const W: usize, const C: usize>(player: &Played<'_, W, C>, seed: u64) {
    let Loaded { net, code } = player.program();
    let mut game = Game::start(net, 0);
    let tokens = |place: PlaceId| player.tokens(place);
    game.tokens = (0..net.places.len()).map(|it| tokens(PlaceId(it as u32))).collect();
    assert!(game.is_within_bounds(), "seed {seed}");
    assert!(game.is_settled(), "seed {seed}");
    for (place, it) in net.places.iter().enumerate() {
        if let Role::Complement(of) = it.role {
            assert_eq!(game.tokens[place] + tokens(of), it.bound, "seed {seed}");
        }
    }
    for law in net.laws {
        match *law {
            Law::Invariant { sum, equals } => {
                let sum: u32 = sum.iter().map(|arc| arc.weight * tokens(arc.place)).sum();
                assert_eq!(sum, equals, "seed {seed}");
            }
            Law::NeverBoth(a, b) => assert!(tokens(a) == 0 || tokens(b) == 0, "seed {seed}"),
            _ => {}
        }
    }
    let stored = player.snapshot();
    for (number, &elapsed) in stored.clocks.iter().enumerate() {
        let runs = code
            .clocks
            .get(number)
            .is_some_and(|clock| game.has_tokens(code.entries[usize::from(clock.entry)].id()));
        assert!(runs || elapsed == 0, "seed {seed}: clock {number}");
    }
}

#[test]
fn what_is_stored_comes_back_and_what_is_damaged_breaks_no_law() {
    let mut refused = [0; 6];
    for time in [Time::Without, Time::With] {
        for (seed, net, mut draw) in nets(400_000..402_500, time) {
            let view = net.view();
            let net = &view.net();
            let (draw, refused) = (&mut draw, &mut refused);
            with_size_of!(net, draw, storing_changes_nothing(net, seed, draw, refused));
        }
    }
    assert!(refused.iter().all(|&it| it > 100), "{refused:?}");
}

/// What the player of one net says to the snapshot of another one.
fn refusal(of: &OwnedNet, by: &OwnedNet) -> Option<RestoreError> {
    let (of, by) = (of.view(), by.view());
    let (of, by) = (of.net(), by.net());
    let (stored, other) = (Packed::<4>::of(&of).unwrap(), Packed::<4>::of(&by).unwrap());
    let stored: Played<'_, 4, CLOCKS> = Player::start(stored.load(&of), Millis(0), &mut ());
    Played::<'_, 4, CLOCKS>::restore(other.load(&by), Millis(0), &stored.snapshot()).err()
}

#[test]
fn the_snapshot_of_another_net_is_refused() {
    let mut last: Option<OwnedNet> = None;
    for (seed, net, mut draw) in nets(500_000..502_000, Time::With) {
        if words(&net.view().net()).unwrap() > 4 || one_in(&mut draw, 8) {
            continue;
        }
        if let Some(last) = &last {
            let other = refusal(last, &net);
            assert!(matches!(other, Some(RestoreError::OtherNet { .. })), "seed {seed}: {other:?}");
        }
        last = Some(net);
    }
}

/// A lamp that can be dimmed, and goes off after a while.
fn lamp() -> OwnedNet {
    let mut net = OwnedNet::new("lamp", "");
    let press = net.event("press", "").unwrap();
    let off = net.place(OwnedPlace::new("off", 1).at_most(1)).unwrap();
    let on = net.place(OwnedPlace::new("on", 0).at_most(1)).unwrap();
    net.transition(OwnedTransition::new("light").on(press).take(off, 1).give(on, 1)).unwrap();
    net.transition(OwnedTransition::new("time out").take(on, 1).give(off, 1).within(10, Some(20)))
        .unwrap();
    net
}

#[test]
fn the_snapshot_of_another_version_of_a_net_is_refused() {
    assert_eq!(refusal(&lamp(), &lamp()), None);
    let changes: [fn(&mut OwnedNet); 8] = [
        |net| net.places[1].bound = 2,
        |net| net.places[1].name = "lit".into(),
        |net| net.places.swap(0, 1),
        |net| net.transitions[0].take[0].weight = 2,
        |net| net.transitions[0].on = None,
        |net| net.transitions[1].within = None,
        |net| net.transitions[1].within = Some(Within { earliest: 10, latest: None }),
        |net| net.transitions[1].read = net.transitions[1].take.split_off(0),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut other = lamp();
        change(&mut other);
        let refused = refusal(&lamp(), &other);
        assert!(matches!(refused, Some(RestoreError::OtherNet { .. })), "{number}: {refused:?}");
    }
}

#[test]
fn a_snapshot_of_the_wrong_length_is_none() {
    let view = lamp();
    let view = view.view();
    let net = view.net();
    assert_eq!((words(&net), clocks(&net)), (Some(1), 1));
    let packed = Packed::<1>::of(&net).unwrap();
    let player: Played<'_, 1, 1> = Player::start(packed.load(&net), Millis(0), &mut ());
    let (mut room, stored) = ([0; 20], player.snapshot());
    assert_eq!(stored.fingerprint, player.program().code().fingerprint);
    assert_eq!(stored.write(&mut room[..19]), None);
    assert_eq!(stored.write(&mut room).map(<[u8]>::len), Some(20));
    assert_eq!(Snapshot::<1, 1>::read(&room), Some(stored));
    assert_eq!(Snapshot::<1, 1>::read(&room[..19]), None);
}

#[test]
fn a_snapshot_with_two_tokens_that_are_never_both_there_is_refused() {
    let mut net = lamp();
    for place in &mut net.places {
        place.role = Role::Data;
    }
    net.laws = vec![OwnedLaw::Reachable(PlaceId(1)), OwnedLaw::NeverBoth(PlaceId(0), PlaceId(1))];
    let view = net.view();
    let net = view.net();
    let packed = Packed::<1>::of(&net).unwrap();
    let program = packed.load(&net);
    let mut stored = Played::<'_, 1, 1>::start(program, Millis(0), &mut ()).snapshot();
    stored.marking[0] |= program.code.fields[1].tokens(1);
    let refused = Played::<'_, 1, 1>::restore(program, Millis(0), &stored).err();
    assert_eq!(refused, Some(RestoreError::Law(1)));
}
