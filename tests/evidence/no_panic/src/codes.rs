//! The roots of what a player asks of its program and its marking, and of players without an
//! observer.
//!
//! A program comes as its caller can make it at worst: of lists of any length, with numbers of
//! nothing.

use cotama_core::checksum::crc32;
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::code::{Clock, minus, plus};
use cotama_core::player::{Code, Field, Outcome, Round, Stepped};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::nets::door;

/// Words of a marking.
const W: usize = 2;

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_code_numbers(
    code: &Code<'_, W>,
    number: u16,
    event: Of<EventId>,
) -> (Of<EventId>, Option<usize>, Of<TransitionId>) {
    (code.event(number), code.event_number(event), code.transition(number))
}

#[unsafe(no_mangle)]
fn root_code_enabled(code: &Code<'_, W>, marking: &[u64; W], kind: usize) -> [bool; 2] {
    let first = code.first(kind, marking, |it| code.holds(marking, it.need));
    [first.is_some(), code.row(kind, marking).is_some()]
}

#[unsafe(no_mangle)]
fn root_code_read(
    code: &Code<'_, W>,
    marking: &[u64; W],
    place: Of<PlaceId>,
    event: usize,
) -> (usize, u32, [bool; 2]) {
    let asked = [code.ignores(marking, event), code.is_alone()];
    (code.state(marking), code.tokens(marking, place), asked)
}

#[unsafe(no_mangle)]
fn root_clock_read(clock: &Clock<W>, elapsed: u32) -> (u32, bool) {
    (clock.cap(), clock.is_open(elapsed))
}

#[unsafe(no_mangle)]
fn root_markings(marking: &[u64; W], other: &[u64; W]) -> [[u64; W]; 2] {
    [plus(marking, other), minus(marking, other)]
}

#[unsafe(no_mangle)]
fn root_crc32(bytes: &[u8]) -> u32 {
    crc32(bytes)
}

#[unsafe(no_mangle)]
fn root_field(field: Field, marking: &[u64; W], tokens: u32) -> (u32, u64) {
    (field.of(marking), field.tokens(tokens))
}

#[unsafe(no_mangle)]
fn root_outcome_map(outcome: Outcome<u16>) -> Outcome<u32> {
    outcome.map(u32::from)
}

#[unsafe(no_mangle)]
fn root_player_new() -> door::Player {
    door::Player::new()
}

#[unsafe(no_mangle)]
fn root_player_round(player: &mut door::Player, now: Millis) -> Round {
    player.round(now)
}

#[unsafe(no_mangle)]
fn root_player_step(player: &mut door::Checked, now: Millis, events: &[door::Event]) -> Stepped {
    player.step(now, events)
}

#[unsafe(no_mangle)]
fn root_firing_transition(of: &door::Firing<'_>) -> door::Transition {
    of.transition()
}
