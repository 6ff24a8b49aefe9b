//! Snapshots: the same player comes back, and nothing that it could not have been.

use super::lamp;
use super::mailboxes::{line, receiver, sender};
use crate::player::{Program, RestoreError, Snapshot};
use cotama_units::proofs::few;
use cotama_units::units::Millis;

type Line = line::Checked<u8>;

/// The line after any four of its events.
fn any_line() -> Line {
    let mut line = Line::new();
    for _ in 0..4 {
        let sent = line::Event::sender(sender::Event::send);
        match few::<2>() {
            0 => _ = line.offer_carrying(Millis(0), &sent, few::<2>(), &mut ()),
            1 => _ = line.round(Millis(0)),
            2 => _ = line.offer(Millis(0), &line::Event::receiver(receiver::Event::release)),
            _ => _ = line.offer(Millis(0), &line::Event::sender(sender::Event::call_off)),
        }
    }
    line
}

/// A snapshot that is written, read and restored is the same player, with what waits in its
/// mailboxes.
#[kani::proof]
#[kani::unwind(66)]
pub fn a_restored_system_is_the_same() {
    let line = any_line();
    let mut bytes = [0; 64];
    let Some(written) = line.snapshot().write(&mut bytes) else { unreachable!() };
    let Some(read) = Snapshot::read(written) else { unreachable!() };
    let back = Line::restore(line.program, line.now(), &read);
    assert!(back == Ok(line));
    kani::cover!(line.waiting(&line::Event::receiver(receiver::Event::part)) == 2, "two wait");
    kani::cover!(line.slots[0] == 3 && line.round_is_due(), "what waits carries a number");
}

/// The same with clocks that run.
#[kani::proof]
#[kani::unwind(8)]
pub fn a_restored_clock_is_the_same() {
    let mut lamp = lamp::Checked::new();
    for _ in 0..2 {
        let now = Millis(lamp.now().0 + u64::from(few::<3>()));
        let event = if kani::any() { lamp::Event::press } else { lamp::Event::stop };
        let _ = lamp.offer(now, &event);
    }
    let restored = lamp::Checked::restore(lamp.program, lamp.now(), &lamp.snapshot());
    let Ok(back) = restored else { unreachable!() };
    assert!(back == lamp && back.wake_at() == lamp.wake_at());
    kani::cover!(lamp.clocks[0] == 1, "a clock at 1 ms");
}

/// A restored state keeps the bounds, the laws and the caps of clocks, and is settled, whatever was
/// stored; every other marking is refused.
#[kani::proof]
#[kani::unwind(9)]
pub fn only_possible_states_are_restored() {
    let word = u64::from(few::<7>());
    let clocks = [0; 3].map(|_: u8| u32::from(few::<3>()));
    let program = lamp::Checked::new().program;
    let fingerprint = program.code().fingerprint;
    let stored = Snapshot::<1, 3> { fingerprint, marking: [word], clocks, slots: [] };
    let restored = lamp::Checked::restore(program, Millis(5), &stored);
    let code = program.code();
    // Three places of one bit and its guard: a token in one of them, and nothing beside them.
    let is_marking = [0, 1, 2].iter().any(|place| word == code.fields[*place].tokens(1));
    let runs = |at: usize| code.holds(&[word], &code.clocks[at].need);
    let most = |at: usize| if runs(at) { code.clocks[at].cap() } else { 0 };
    let is_time = (0..3).all(|at| clocks[at] <= most(at));
    assert!(restored.is_ok() == (is_marking && is_time));
    assert!(!matches!(restored, Err(RestoreError::Clock(_))) || is_marking);
    assert!(
        restored.is_ok_and(|it| it.now() == Millis(5) && it.clocks == clocks) == restored.is_ok()
    );
    kani::cover!(restored.is_ok() && clocks.iter().any(|it| *it > 1), "with clocks");
    kani::cover!(is_marking && !is_time, "a clock that cannot be");
}

/// One damaged byte anywhere in a stored snapshot is noticed.
#[kani::proof]
#[kani::unwind(35)]
pub fn a_damaged_snapshot_is_not_read() {
    let mut lamp = lamp::Checked::new();
    let _ = lamp.offer(Millis(0), &lamp::Event::press);
    let _ = lamp.advance(Millis(u64::from(few::<1>())));
    let mut bytes = [0; 32];
    let Some(written) = lamp.snapshot().write(&mut bytes) else { unreachable!() };
    let length = written.len();
    let place = usize::from(few::<5>());
    kani::assume(place < length);
    let damage: u8 = kani::any();
    bytes[place] ^= damage;
    let read = Snapshot::<1, 3>::read(&bytes[..length]);
    assert!(read.is_some() == (damage == 0));
    assert!(Snapshot::<1, 3>::read(&bytes[..length - 1]).is_none());
    kani::cover!(place == length - 1 && damage == 1, "the checksum");
    kani::cover!(damage == 0, "none");
}

/// A snapshot of another net, or of another version of this one, is refused by its fingerprint.
#[kani::proof]
#[kani::unwind(8)]
pub fn a_snapshot_of_another_net_is_refused() {
    let lamp = lamp::Checked::new();
    let changed: u64 = kani::any();
    let stored = lamp.snapshot();
    let other = Snapshot { fingerprint: stored.fingerprint ^ changed, ..stored };
    let back = lamp::Checked::restore(lamp.program, Millis(0), &other);
    let expected = stored.fingerprint;
    let refused = RestoreError::OtherSystem { expected, found: expected ^ changed };
    assert!(if changed == 0 { back == Ok(lamp) } else { back == Err(refused) });
    kani::cover!(changed == 1, "one bit");
    kani::cover!(changed == 0, "none");
}
