//! Answers as numbers of 32 bits, as a page reads them; times are two of them, the lower first.

use super::board::{Board, time};
use alloc::vec::Vec;
use cotama_core::net::EventId;
use cotama_core::units::Millis;
use cotama_play::{Reason, Record};

/// Returns what happened: how many records, and of each its time, whether it is a round, and lists
/// with their lengths: events, transitions fired, pairs of an unused event and its
/// [`reason`], outputs, pairs of a place and its tokens.
pub fn records(all: &[Record]) -> Vec<u32> {
    let mut out = Vec::from([all.len() as u32]);
    for it in all {
        put(&mut out, it.at);
        out.push(u32::from(it.round));
        list(&mut out, it.events.iter().map(|it| [it.0]));
        list(&mut out, it.fired.iter().map(|it| [it.0]));
        list(&mut out, it.unused.iter().map(|it| [it.event.0, reason(it.reason)]));
        list(&mut out, it.emitted.iter().map(|it| [it.0]));
        list(&mut out, it.changed.iter().map(|it| [it.0.0, it.1]));
    }
    out
}

/// Returns the state: the steps taken, those of the run, the time; whether something waits in a
/// mailbox; whether something happens next by itself, when, and which transition fires first; the
/// tokens of all places; and of each event, told at the time of the halves `low` and `high`, 0 and
/// the transition that would use it, or the [`reason`] why none would and 0.
pub fn state(board: &Board, low: u32, high: u32) -> Vec<u32> {
    let session = board.session();
    let mut out = Vec::from([board.at() as u32, board.steps() as u32]);
    put(&mut out, session.now());
    out.push(u32::from(session.round_is_due()));
    let deadline = session.deadline();
    out.push(u32::from(deadline.is_some()));
    put(&mut out, deadline.map_or(Millis(0), |it| it.0));
    out.push(deadline.map_or(0, |it| it.1.0));
    list(&mut out, session.marking().iter().map(|&it| [it]));
    let events = (0..session.net().events.len() as u32).map(EventId);
    let next = board.before_event(time(low, high));
    list(
        &mut out,
        events.map(|it| match next.prospect(it) {
            Ok(transition) => [0, transition.0],
            Err(refusal) => [reason(refusal.reason), 0],
        }),
    );
    out
}

/// Returns the number of a reason, from 1.
pub fn reason(it: Reason) -> u32 {
    match it {
        Reason::OnPurpose => 1,
        Reason::NotEnabled => 2,
        Reason::TooEarly => 3,
        Reason::TooLate => 4,
        Reason::Full => 5,
    }
}

fn put(out: &mut Vec<u32>, Millis(ms): Millis) {
    out.extend([ms as u32, (ms >> 32) as u32]);
}

/// A list of items of the same size, after its length in items.
pub(super) fn list<const N: usize>(out: &mut Vec<u32>, items: impl Iterator<Item = [u32; N]>) {
    let at = out.len();
    out.push(0);
    items.for_each(|it| out.extend(it));
    let length = (out.len() - at - 1) / N;
    out[at] = length as u32;
}
