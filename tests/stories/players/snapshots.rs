//! A stored player comes back as it was, and a damaged one breaks no law.

use super::{Act, Log, Played, delay, nets, systems, with_size_of};
use cotama_core::checksum::crc32;
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Law, PlaceId, Role, Within};
use cotama_core::player::{
    Checked, Loaded, Packed, Player, Program, RestoreError, Snapshot, Stored, clocks, words,
};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::Game;
use cotama_tests::textbook::flat::Cell;
use cotama_tests::textbook::nets::{Time, one_in};
use cotama_tests::textbook::systems::{CLOCKS, OwnedSystem};

/// A player of a stored marking.
type Restored<'c, const W: usize, const C: usize, const S: usize> =
    Player<Checked<Loaded<'c, W, C, S>>, W, C, S, u16>;

/// How often a damaged snapshot was refused, and why; the first one counts those that were not.
type Refused = [u32; 6];

/// Stores and restores after each of 50 events, unharmed and with one byte changed.
fn storing_changes_nothing<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
    refused: &mut Refused,
) {
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = packed.load(system);
    let mut player: Played<'_, W, C, S> = Player::start(program, Millis(0), &mut ());
    let mut restored: Option<Restored<'_, W, C, S>> = None;
    for _ in 0..50 {
        let now = Millis(player.now().0 + delay(draw));
        // Restored a moment ago, it goes on as if nothing had been.
        let act = Act::any(system, draw);
        let (mut log, mut again) = (Log::new(system), Log::new(system));
        let done = match act {
            Act::Offer(event, carries) => {
                let outcome = player.offer_carrying(now, &event, carries, &mut log);
                let same = |it: &mut Restored<'_, W, C, S>| {
                    it.offer_carrying(now, &event, carries, &mut again) == outcome
                };
                restored.as_mut().is_none_or(same)
            }
            Act::Round => {
                let round = player.round_with(now, &mut log);
                restored.as_mut().is_none_or(|it| it.round_with(now, &mut again) == round)
            }
            Act::Pass => {
                let advanced = player.advance_with(now, &mut log);
                restored.as_mut().is_none_or(|it| it.advance_with(now, &mut again) == advanced)
            }
        };
        assert!(done, "seed {seed}: {act:?}");
        if let Some(restored) = &restored {
            assert_eq!(log.told, again.told, "seed {seed}");
            assert_same_player(restored, &player, seed);
        }
        if player.advance(now).behind {
            return;
        }
        let stored = player.snapshot();
        let mut room = [0; 512];
        let bytes = stored.write(&mut room).unwrap().to_vec();
        assert_eq!(bytes.len(), Snapshot::<W, C, S, u16>::BYTES);
        assert_eq!(Snapshot::read(&bytes), Some(stored), "seed {seed}");
        let from = Player::restore(Checked(program), now, &stored)
            .unwrap_or_else(|why| panic!("seed {seed}: {why}"));
        assert_same_player(&from, &player, seed);
        restored = Some(from);

        let mut damaged = bytes;
        let at = draw.between(0, damaged.len() as u64 - 1) as usize;
        damaged[at] ^= draw.between(1, 255) as u8;
        assert_eq!(Snapshot::<W, C, S, u16>::read(&damaged), None, "seed {seed}");
        restoring_breaks_no_law(Checked(program), &damaged_content(stored, draw), seed, refused);
    }
}

/// The same with one byte changed, before its checksum is made.
fn damaged_content<const W: usize, const C: usize, const S: usize>(
    mut stored: Snapshot<W, C, S, u16>,
    draw: &mut Draw,
) -> Snapshot<W, C, S, u16> {
    let (at, bits) =
        (draw.between(0, (8 + 8 * W + 4 * C) as u64 - 1) as usize, draw.between(1, 255));
    match at {
        0..8 => stored.fingerprint ^= bits << (8 * at),
        _ if at < 8 + 8 * W => stored.marking[at / 8 - 1] ^= bits << (8 * (at % 8)),
        _ => stored.clocks[(at - 8 - 8 * W) / 4] ^= (bits as u32) << (8 * (at % 4)),
    }
    stored
}

fn restoring_breaks_no_law<const W: usize, const C: usize, const S: usize>(
    program: Checked<Loaded<'_, W, C, S>>,
    damaged: &Snapshot<W, C, S, u16>,
    seed: u64,
    refused: &mut Refused,
) {
    let same = damaged.fingerprint == program.0.code().fingerprint;
    let restored = Player::restore(program, Millis(0), damaged);
    assert_eq!(same, !matches!(restored, Err(RestoreError::OtherSystem { .. })), "seed {seed}");
    match restored {
        Ok(restored) => {
            assert_eq!(restored.snapshot(), *damaged, "seed {seed}");
            assert_lawful(&restored, seed);
            refused[0] += 1;
        }
        Err(RestoreError::OtherSystem { .. }) => refused[1] += 1,
        Err(RestoreError::Marking) => refused[2] += 1,
        Err(RestoreError::Law(..)) => refused[3] += 1,
        Err(RestoreError::Clock(_)) => refused[4] += 1,
        Err(RestoreError::NotSettled) => refused[5] += 1,
        Err(other) => panic!("seed {seed}: {other}"),
    }
}

fn assert_same_player<const W: usize, const C: usize, const S: usize>(
    one: &Restored<'_, W, C, S>,
    two: &Played<'_, W, C, S>,
    seed: u64,
) {
    assert_eq!((one.now(), one.snapshot()), (two.now(), two.snapshot()), "seed {seed}");
    assert_eq!(one.wake_at(), two.wake_at(), "seed {seed}");
    assert_eq!(one.round_is_due(), two.round_is_due(), "seed {seed}");
}

/// Bounds, complements, invariants and clocks are as in a marking that the system can have, and it
/// is settled; where there are mailboxes something may wait for room.
fn assert_lawful<const W: usize, const C: usize, const S: usize>(
    player: &Restored<'_, W, C, S>,
    seed: u64,
) {
    let (program, code) = (player.program(), player.program().0.code());
    let system = program.system();
    let mut game = Game::start(&system, 0);
    game.endless = false;
    let cells = game.book.cells.iter().map(|&(cell, bound)| match cell {
        Cell::Place(of) => player.tokens(of),
        Cell::Absence(of) => bound - player.tokens(of),
        Cell::Waiting(event) => player.waiting(&event),
        Cell::Room(event) => bound - player.waiting(&event),
    });
    game.state.tokens = cells.collect();
    assert!(game.is_within_bounds(), "seed {seed}");
    assert!(S > 0 || game.is_settled(), "seed {seed}");
    for (component, net) in (0..).zip(system.components.iter().map(|it| it.net)) {
        let tokens = |id: PlaceId| player.tokens(Of { component, id });
        for (place, it) in (0..).zip(net.places) {
            if let Role::Complement(of) = it.role {
                assert_eq!(tokens(PlaceId(place)) + tokens(of), it.bound, "seed {seed}");
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
    }
    for (number, &elapsed) in player.snapshot().clocks.iter().enumerate() {
        let line = |entry: u16| usize::from(code.entries[usize::from(entry)].transition);
        let clock = code.clocks.get(number);
        let runs = clock.is_some_and(|clock| game.has_tokens(line(clock.entry)));
        assert!(runs || elapsed == 0, "seed {seed}: clock {number}");
    }
}

#[test]
fn a_stored_player_comes_back_and_a_damaged_one_breaks_no_law() {
    let mut refused = [0; 6];
    for time in [Time::Without, Time::With] {
        for (seed, net, mut draw) in nets(400_000..402_500, time) {
            let (draw, refused) = (&mut draw, &mut refused);
            net.with(|it| {
                with_size_of!(it, draw, storing_changes_nothing(it, seed, draw, refused));
            });
        }
    }
    assert!(refused.iter().all(|&it| it > 100), "{refused:?}");
}

#[test]
fn a_system_that_is_stored_comes_back_with_all_that_waits() {
    let mut refused = [0; 6];
    for (seed, system, mut draw) in systems(900_000, 3_000) {
        let (draw, refused) = (&mut draw, &mut refused);
        system.with(|it| with_size_of!(it, draw, storing_changes_nothing(it, seed, draw, refused)));
    }
    // An unsettled marking may wait for room in a mailbox: only systems without any are refused,
    // and those are few.
    assert!(refused[..5].iter().all(|&it| it > 100) && refused[5] > 0, "{refused:?}");
}

/// Returns the answer of one net's player to the snapshot of another one.
fn refusal(of: &OwnedNet, by: &OwnedNet) -> Option<RestoreError> {
    let [of, by] = [of, by].map(|it| OwnedSystem::alone(it.clone()));
    let stored = of.with(|of| {
        let packed = Packed::<4, CLOCKS>::of(of).unwrap();
        Played::<'_, 4, CLOCKS, 0>::start(packed.load(of), Millis(0), &mut ()).snapshot()
    });
    by.with(|by| {
        let packed = Packed::<4, CLOCKS>::of(by).unwrap();
        Restored::<'_, 4, CLOCKS, 0>::restore(Checked(packed.load(by)), Millis(0), &stored).err()
    })
}

#[test]
fn the_snapshot_of_another_net_is_refused() {
    let mut last: Option<OwnedNet> = None;
    for (seed, net, mut draw) in nets(500_000..502_000, Time::With) {
        if net.with(words).unwrap() > 4 || one_in(&mut draw, 8) {
            continue;
        }
        let net = net.nets[0].clone();
        if let Some(last) = &last {
            let other = refusal(last, &net);
            assert!(
                matches!(other, Some(RestoreError::OtherSystem { .. })),
                "seed {seed}: {other:?}"
            );
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
        let is_refused = matches!(refused, Some(RestoreError::OtherSystem { .. }));
        assert!(is_refused, "{number}: {refused:?}");
    }
}

/// Tells a story of the lamp.
fn with_lamp(net: &OwnedNet, story: impl FnOnce(Checked<Loaded<'_, 1, 1>>)) {
    OwnedSystem::alone(net.clone()).with(|system| {
        assert_eq!((words(system), clocks(system)), (Some(1), 1));
        let packed = Packed::<1, 1>::of(system).unwrap();
        story(Checked(packed.load(system)));
    });
}

/// The checksum tells any damage of up to 32 bits in a row: here of any one byte, in any way.
#[test]
fn a_snapshot_of_the_wrong_length_or_with_a_damaged_byte_is_none() {
    with_lamp(&lamp(), |program| {
        let player: Restored<'_, 1, 1, 0> = Player::start(program, Millis(0), &mut ());
        let (mut room, stored) = ([0; 24], player.snapshot());
        assert_eq!(stored.fingerprint, program.code().fingerprint);
        assert_eq!(stored.write(&mut room[..23]), None);
        assert_eq!(stored.write(&mut room).map(<[u8]>::len), Some(24));
        assert_eq!(Snapshot::<1, 1, 0, u16>::read(&room), Some(stored));
        assert_eq!(Snapshot::<1, 1, 0, u16>::read(&room[..23]), None);
        let mut longer = [0; 32];
        longer[..20].copy_from_slice(&room[..20]);
        let checksum = crc32(&longer[..28]);
        longer[28..].copy_from_slice(&checksum.to_le_bytes());
        assert_eq!(Snapshot::<1, 1, 0, u16>::read(&longer), None);
        for at in 0..room.len() {
            for bits in 1..=u8::MAX {
                let mut damaged = room;
                damaged[at] ^= bits;
                assert_eq!(Snapshot::<1, 1, 0, u16>::read(&damaged), None, "{at} {bits}");
            }
        }
    });
}

#[test]
fn a_snapshot_in_no_state_is_refused() {
    with_lamp(&lamp(), |program| {
        let mut stored = Restored::<'_, 1, 1, 0>::start(program, Millis(0), &mut ()).snapshot();
        stored.marking[0] -= program.code().fields[0].tokens(1);
        let refused = Restored::<'_, 1, 1, 0>::restore(program, Millis(0), &stored).err();
        assert_eq!(refused, Some(RestoreError::Marking));
    });
}

#[test]
fn a_snapshot_with_two_tokens_that_are_never_both_there_is_refused() {
    let mut net = lamp();
    for place in &mut net.places {
        place.role = Role::Data;
    }
    net.laws = vec![OwnedLaw::Reachable(PlaceId(1)), OwnedLaw::NeverBoth(PlaceId(0), PlaceId(1))];
    with_lamp(&net, |program| {
        let mut stored = Restored::<'_, 1, 1, 0>::start(program, Millis(0), &mut ()).snapshot();
        stored.marking[0] |= program.code().fields[1].tokens(1);
        let refused = Restored::<'_, 1, 1, 0>::restore(program, Millis(0), &stored).err();
        assert_eq!(refused, Some(RestoreError::Law(0, 1)));
    });
}

/// Something that can be carried along, of which not all bytes stand for something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Light {
    #[default]
    Red,
    Green,
}

impl Stored for Light {
    const BYTES: usize = 1;

    fn write(&self, bytes: &mut [u8]) {
        bytes[0] = *self as u8;
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        [Self::Red, Self::Green].into_iter().find(|it| *it as u8 == bytes[0])
    }
}

#[test]
fn a_payload_without_meaning_is_not_read() {
    let stored: Snapshot<1, 0, 2, Light> =
        Snapshot { fingerprint: 7, marking: [1], clocks: [], slots: [Light::Green, Light::Red] };
    let mut room = [0; 22];
    assert_eq!(stored.write(&mut room).map(<[u8]>::len), Some(22));
    assert_eq!(Snapshot::read(&room), Some(stored));
    let numbers =
        Snapshot::<1, 0, 2, u8> { fingerprint: 7, marking: [1], clocks: [], slots: [1, 2] };
    assert!(numbers.write(&mut room).is_some());
    assert_eq!(Snapshot::<1, 0, 2, Light>::read(&room), None);
}
