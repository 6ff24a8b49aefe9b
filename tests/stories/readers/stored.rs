//! Markings that were stored.

use cotama_core::checksum::crc32;
use cotama_core::player::Checked;
use cotama_core::units::Millis;
use cotama_core::{net, player, system};

super::readers! {
    snapshots: read_snapshot, [];
}

net! {
    /// Is pressed, and says so.
    mod button {
        places { Free: 1 }
        events { press }
        outputs { pressed }
        transitions { press on press: Free => Free emit pressed; }
    }
}

net! {
    /// A lamp that goes off by itself, and breaks when it was lit five times.
    mod lamp {
        places { Off: 1, On, Broken }
        counters { left: 5 of 5 }
        events { toggle }
        transitions {
            light on toggle [left >= 1]: Off => On do left -= 1;
            fail on toggle [left < 1]: Off => Broken;
            early on toggle: On => Off within 10..=200 ms;
            late: On => Off after 300 ms;
        }
        laws { invariant(Off & On & Broken = 1); never_both(On, Broken); }
    }
}

system! {
    /// A room with a lamp, whose button may be pressed faster than the lamp looks.
    mod room {
        nets { button: button, lamp: lamp }
        links { button.pressed => lamp.toggle mail 3; }
    }
}

const SIZE: player::code::Size = room::SIZE;
type Snapshot = player::Snapshot<{ SIZE.words }, { SIZE.clocks }, { SIZE.slots }, u16>;
type Room = room::Checked<u16>;

const PRESS: room::Event = room::Event::button(button::Event::press);
const TOGGLE: room::Event = room::Event::lamp(lamp::Event::toggle);

/// Bytes with a checksum that is right are read, and written as they were.
fn written_again(bytes: &[u8]) -> Option<Snapshot> {
    let read = Snapshot::read(bytes)?;
    let mut room = [0; Snapshot::BYTES];
    assert_eq!(read.write(&mut room), Some(bytes));
    Some(read)
}

/// Bytes as they are; then as many as there must be with the checksum that they must have, so that
/// what is checked behind it is reached. Whether a player goes on from there.
fn read_snapshot(bytes: &[u8]) -> bool {
    let _ = written_again(bytes);
    let mut whole = [0; Snapshot::BYTES];
    for (to, &from) in whole.iter_mut().zip(bytes) {
        *to = from;
    }
    if let Some((content, checksum)) = whole.split_last_chunk_mut::<4>() {
        *checksum = crc32(content).to_le_bytes();
    }
    let stored = written_again(&whole).expect("its length and checksum are right");
    match Room::restore(Checked(room::Program), Millis(7), &stored) {
        Ok(mut room) => {
            assert_eq!(room.snapshot(), stored);
            goes_on(&mut room);
            true
        }
        Err(refused) => {
            assert!(!refused.to_string().is_empty());
            false
        }
    }
}

/// From any marking that is taken: nothing panics, and what comes can be stored and taken again, as
/// the laws of this room stay true from wherever they are. (Where one alone says nothing of what
/// comes, a marking that is taken and that no run reaches may break it later.)
fn goes_on(room: &mut Room) {
    for (at, carries) in (0..).map(|it| Millis(7 + 40 * it)).zip(1..=12) {
        let event = if carries % 4 == 0 { &TOGGLE } else { &PRESS };
        let _ = room.offer_carrying(at, event, carries, &mut ());
        if carries % 3 == 0 {
            let _ = room.round(at);
        }
        let stored = room.snapshot();
        let again = Room::restore(Checked(room::Program), at, &stored);
        let again = again.unwrap_or_else(|refused| panic!("{refused}: {stored:?}"));
        assert_eq!(again.snapshot(), stored);
    }
}

/// The corpus: the room at its start, with mail and a clock that runs, and with no light left.
#[test]
fn the_corpus_is_a_stored_player() {
    let written = |name: &str, room: &Room| {
        let mut bytes = [0; Snapshot::BYTES];
        of::snapshots::READER.keeps(name, room.snapshot().write(&mut bytes).unwrap());
    };
    let mut room = Room::start(Checked(room::Program), Millis(0), &mut ());
    written("start", &room);
    for at in 0..3 {
        let _ = room.offer_carrying(Millis(at * 50), &PRESS, at as u16 + 1, &mut ());
        if at == 0 {
            let _ = room.round(Millis(at));
        }
    }
    assert!(room.round_is_due() && room.wake_at().is_some());
    written("on", &room);
    for at in 1..20 {
        let _ = room.offer_carrying(Millis(at * 400), &TOGGLE, 9, &mut ());
    }
    written("broken", &room);
}
