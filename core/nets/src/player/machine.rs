//! Nets that are state machines: one token, in one of several states.

use super::field::clamped;
use crate::net::data::{Arc, Net, Role, Transition};
use crate::system::data::System;

/// The most states of which a player looks the transitions up by the state: two bits each, all in
/// the first word.
const MOST: usize = 32;

/// How many states a net alone has when it is a state machine over its [`Role::State`] places (one
/// otherwise), and whether it is one.
pub(super) const fn machine(system: &System<'_>) -> (usize, bool) {
    match system.components {
        [alone] => match states(alone.net) {
            Some(states) => (states, true),
            None => (1, false),
        },
        _ => (1, false),
    }
}

/// Whether exactly one place of role [`Role::State`] is marked at any time, because transitions
/// only move one token among them; for nets of at most 32 such places.
///
/// ```
/// use cotama_core::{net, player::is_state_machine};
/// net! { mod lamp { places { Off: 1, On } events { go } transitions { on on go: Off => On; } } }
/// net! { mod fork { places { A: 1, B, C } events { go } transitions { go on go: A => B & C; } } }
/// assert!(is_state_machine(&lamp::NET));
/// assert!(!is_state_machine(&fork::NET));
/// ```
pub const fn is_state_machine(net: &Net<'_>) -> bool {
    states(net).is_some()
}

/// How many states it has: there is one token in them, and every transition moves it, reads it or
/// leaves it alone.
const fn states(net: &Net<'_>) -> Option<usize> {
    let mut states = 0;
    let mut tokens = 0;
    while states < net.places.len() && matches!(net.places[states].role, Role::State) {
        if clamped(net.places[states].bound) != 1 {
            return None;
        }
        tokens += net.places[states].initial;
        states += 1;
    }
    if states == 0 || states > MOST || tokens != 1 {
        return None;
    }
    let mut at = 0;
    while at < net.transitions.len() {
        let it = &net.transitions[at];
        let (taken, read) = (among(it.take, states), among(it.read, states));
        let given = among(it.give, states);
        if !(taken == 1 && read == 0 && given == 1 || taken == 0 && read <= 1 && given == 0) {
            return None;
        }
        at += 1;
    }
    Some(states)
}

/// How many of these arcs go to the first places.
const fn among(arcs: &[Arc], places: usize) -> usize {
    let mut count = 0;
    let mut at = 0;
    while at < arcs.len() {
        count += ((arcs[at].place.0 as usize) < places) as usize;
        at += 1;
    }
    count
}

/// Whether a transition takes or reads this state.
pub(super) const fn needs_state(it: &Transition<'_>, state: usize) -> bool {
    has(it.take, state) || has(it.read, state)
}

const fn has(arcs: &[Arc], place: usize) -> bool {
    let mut at = 0;
    while at < arcs.len() {
        if arcs[at].place.0 as usize == place {
            return true;
        }
        at += 1;
    }
    false
}
