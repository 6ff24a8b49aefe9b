//! The executor against the textbook of Petri nets, over time, with mailboxes, and after a restore.

mod executor;
mod ignored;
mod mailboxes;
mod refinement;
mod snapshots;
mod timing;

pub use executor::*;
pub use ignored::*;
pub use mailboxes::*;
pub use refinement::*;
pub use snapshots::*;
pub use timing::*;

use crate::net::{Net, PlaceId};
use crate::player::{Player, Program};
use cotama_units::proofs::few;
use cotama_units::units::Millis;

crate::net! {
    /// Parts are worked on one at a time; two that are done bring two new ones.
    pub mod buffer {
        places { Idle: 1, Busy, Stock: 3 of 3, Done: 0 of 3 }
        events { start, end, refill }
        transitions {
            start on start: Idle & Stock => Busy;
            end on end: Busy => Idle & Done;
            skip on end: Idle & Stock => Idle & Done;
            refill on refill: Done * 2 => Stock * 2 read Idle;
        }
        laws { invariant(Idle & Busy = 1); invariant(Stock & Busy & Done = 3); }
    }
}

crate::net! {
    /// A relay of four places, of which the middle ones are left at once.
    pub mod relay {
        places { First: 2 of 2, Second: 0 of 2, Third: 0 of 2, Last: 0 of 2 }
        events { go, back }
        transitions {
            go on go: First => Second;
            on: Second => Third;
            over: Third => Last priority 1;
            back on back: Last => First;
        }
        laws { invariant(First & Second & Third & Last = 2); settles; }
    }
}

crate::net! {
    /// A lamp that may be stopped for a while, and goes out by itself.
    pub mod lamp {
        places { Off: 1, On, Late }
        events { press, stop }
        transitions {
            start on press: Off => On;
            stop on stop: On => Off within 1..=2 ms;
            late: On => Late within 5..=5 ms;
            back: Late => Off within 2..=4 ms;
        }
        laws { invariant(Off & On & Late = 1); }
    }
}

crate::net! {
    /// Two that have nothing to do with each other.
    pub mod twins {
        places { One: 3 of 3, Moved: 0 of 3, Other: 3 of 3, Turned: 0 of 3 }
        events { left, right }
        transitions {
            move_two on left: One * 2 => Moved;
            turn on right: Other => Turned read Turned;
            turn_first on right: Other * 2 => Turned * 2;
        }
    }
}

crate::net! {
    /// A gate that may be forced by those who have paid, and shuts by itself.
    pub mod gate {
        places { Shut: 1, Open, Paid: 0 of 2, Owed: 2 of 2 }
        events { turn, pay, knock }
        transitions {
            turn on turn: Shut => Open within 2..=3 ms;
            force on turn: Shut & Paid => Open & Owed within 1..=1 ms priority 1;
            pay on pay: Open & Owed => Open & Paid within 1..=2 ms;
            shut: Open => Shut within 4..=4 ms;
        }
        ignore { knock in Shut; turn in Open; turn in Paid; }
    }
}

/// A marking with these tokens, in the order of the places.
fn marking<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
    program: &P,
    tokens: &[u8],
) -> [u64; W] {
    let mut marking = [0; W];
    for (field, &tokens) in program.code().fields.iter().zip(tokens) {
        marking[usize::from(field.word)] += field.tokens(u32::from(tokens));
    }
    marking
}

/// Any number of tokens of each place of a net, within bounds of three at most.
fn any_tokens<const PLACES: usize>(net: &Net<'_>) -> [u8; PLACES] {
    let mut tokens = [0; PLACES];
    for (tokens, place) in tokens.iter_mut().zip(net.places) {
        *tokens = if place.bound == 1 { few::<1>() } else { few::<2>() };
        kani::assume(u32::from(*tokens) <= place.bound);
    }
    tokens
}

/// The tokens of each place of a net alone.
fn tokens<P, const W: usize, const C: usize, const PLACES: usize>(
    player: &Player<P, W, C>,
) -> [u8; PLACES]
where
    P: Program<W, C>,
{
    core::array::from_fn(|place| player.tokens(PlaceId(place as u32)) as u8)
}

/// A net alone in this marking, at time zero, its clocks at zero.
fn at<P: Program<W, C>, const W: usize, const C: usize>(
    program: P,
    tokens: &[u8],
) -> Player<P, W, C> {
    let marking = marking(&program, tokens);
    Player { program, marking, clocks: [0; C], slots: [], now: Millis(0) }
}
