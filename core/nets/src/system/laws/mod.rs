//! The law of a small system, checked while compiling: whatever reaches one of its nets is used, or
//! ignored on purpose.
//!
//! That each net handles all its events alone is not enough: an event can arrive by `now` before
//! its receiver settles, and what another net does to a shared place is seen by all of them. So
//! what is explored here is the system as a [`Player`](crate::player::Player) plays it.

mod play;
mod states;
mod words;

pub use states::{Culprit, STATES, Step, Violation};

use super::data::System;
use crate::player::code::Code;

/// A claim about a system, as `system!` writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// `handles(all)`.
    HandlesAll,
    /// `left_to_checker`: it is not explored while compiling.
    LeftToChecker,
}

/// Checks what a system claims: in how many states it rests, or `None` when nothing was explored.
/// Ends the compilation with an explanation when it does not hold, or when the system is too large.
#[must_use]
#[track_caller]
pub const fn check<const W: usize>(
    system: &System<'_>,
    code: &Code<'_, W>,
    claims: &[Claim],
) -> Option<usize> {
    let mut at = 0;
    while at < claims.len() {
        if matches!(claims[at], Claim::LeftToChecker) {
            return None;
        }
        at += 1;
    }
    if claims.is_empty() {
        return None;
    }
    match judge(system, code) {
        Ok(states) => Some(states),
        Err(violation) => violation.text(system, code).stop(),
    }
}

/// Explores a system: whether each event that is delivered to a net, offered from outside, by `now`
/// or out of a mailbox, makes a transition fire or is ignored on purpose in a marked place of that
/// net. What is refused because a mailbox is full is not delivered. Usable at run time as well;
/// `code` is the same system, packed.
///
/// From outside come the events that no link leads to. The answer is the number of states in which
/// the system rests.
///
/// # Errors
/// The first event that is neither used nor ignored on purpose, with a shortest path there; or that
/// the system has intervals, does not settle, or is too large.
pub const fn judge<const W: usize>(
    system: &System<'_>,
    code: &Code<'_, W>,
) -> Result<usize, Violation<W>> {
    states::explore(system, code)
}
