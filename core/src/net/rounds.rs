//! Synchronous rounds: the other meaning of a net.
//!
//! [`Player::offer`] *interleaves*: one transition after another, each seeing what the one before
//! it did. In a *round* all transitions see the same marking, as hardware does at a clock edge
//! (interpreted Petri nets, Andreu, Souquet and Gil 2008): in the order of priority, then of the
//! net, each transition whose event is among those offered, or that needs none, fires if what the
//! ones before it left of the marking enables it; all that is given arrives at the end. A round is
//! always one of the possible interleavings, so what the laws forbid no round does.
//!
//! They differ where one transition enables the next: it fires in the same `offer`, but only in the
//! next round.
//!
//! ```
//! use cotama_core::{net, units::Millis};
//! net! {
//!     /// Two lamps that hand a light on.
//!     pub mod chain {
//!         places { A: 1, B, C }
//!         events { Tick }
//!         transitions {
//!             first on Tick: A => B;
//!             second: B => C;
//!         }
//!     }
//! }
//! let mut interleaved = chain::Player::new();
//! assert!(interleaved.offer(Millis(0), &chain::Event::Tick).fired());
//! assert_eq!(interleaved.tokens(chain::Place::C), 1); // `second` saw what `first` did
//!
//! let mut round = chain::Player::new();
//! assert_eq!(round.round(Millis(0), &[chain::Event::Tick]).fired, 1);
//! assert_eq!(round.tokens(chain::Place::B), 1); // `second` comes with the next round
//! assert_eq!(round.round(Millis(0), &[]).fired, 1);
//! assert_eq!(round.tokens(chain::Place::C), 1);
//! ```

use super::code::Entry;
use super::player::{Player, minus};
use super::program::{Firing, Kind, Observer, Program};
use crate::units::Millis;

/// What a round did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[must_use = "an event may have been ignored"]
pub struct Round {
    /// How many transitions fired.
    pub fired: u32,
    /// Bit `i` is set when no transition on the `i`-th of the events fired; of the first 64.
    pub ignored: u64,
    /// Whether nothing happened because a place would have held more than its bound. Not in a net
    /// whose bounds are proven.
    pub full: bool,
}

impl<P: Program<W>, const W: usize, const C: usize> Player<P, W, C> {
    /// One synchronous round at `now` with these events; see [`Player::round_with`].
    pub fn round(&mut self, now: Millis, events: &[P::Event]) -> Round {
        self.round_with(now, events, &mut ())
    }

    /// One synchronous round at `now` with these events, of which a transition can use any number.
    /// Time passes before it, and nothing fires meanwhile. Afterwards the net does not settle: that
    /// is for the next rounds.
    pub fn round_with(
        &mut self,
        now: Millis,
        events: &[P::Event],
        observer: &mut impl Observer<P::Event, P::Transition, P::Output>,
    ) -> Round {
        self.pass(now.0.saturating_sub(self.now.0));
        let code = self.program.code();
        // First what fires, then whether it fits, then it happens: a round that does not fit leaves
        // no trace.
        let (mut left, mut given) = (self.marking, [0; W]);
        let mut round = Round { ignored: ones(events.len()), ..Round::default() };
        for &at in code.order {
            let Some(entry) = code.entries.get(usize::from(at)) else { continue };
            if self.takes_part(entry, &left, events) {
                (left, given) = self.applied(entry, &left, &given);
                // Tested one by one: the sum of many gifts could outgrow a field and disturb
                // others.
                if !code.holds(&code.bounds, &given) {
                    return Round { full: true, ..round };
                }
            }
        }
        let after = code.after(&left, &given);
        if !code.holds(&code.bounds, &after) {
            return Round { full: true, ..round };
        }
        let mut again = (self.marking, [0; W]);
        for &at in code.order {
            let Some(entry) = code.entries.get(usize::from(at)) else { continue };
            if !self.takes_part(entry, &again.0, events) {
                continue;
            }
            again = self.applied(entry, &again.0, &again.1);
            if let Some(elapsed) = self.clocks.get_mut(usize::from(entry.clock)) {
                *elapsed = 0;
            }
            round.fired = round.fired.saturating_add(1);
            let id = entry.id();
            for (event, bit) in events.iter().zip((0..u64::BITS).map(|bit| 1_u64.wrapping_shl(bit)))
            {
                if self.is_on(entry, event) {
                    round.ignored &= !bit;
                }
            }
            observer.on_fire(&Firing {
                transition: self.program.transition(id),
                id,
                event: events.iter().find(|event| self.is_on(entry, event)),
                outputs: self.program.outputs(id),
                at: self.now,
            });
        }
        self.restart(&left);
        self.marking = after;
        round
    }

    /// Whether an entry is on this event.
    fn is_on(&self, entry: &Entry<W>, event: &P::Event) -> bool {
        let on = self.program.code().kind(event.id().0 as usize);
        on.iter().any(|it| it.transition == entry.transition)
    }

    fn takes_part(&self, entry: &Entry<W>, left: &[u64; W], events: &[P::Event]) -> bool {
        let code = self.program.code();
        if !code.holds(left, &entry.need) || !self.open(entry) {
            return false;
        }
        let events_end = usize::from(code.events);
        let by_itself = [events_end, events_end + 1]
            .iter()
            .any(|&kind| code.kind(kind).iter().any(|it| it.transition == entry.transition));
        by_itself || events.iter().any(|event| self.is_on(entry, event))
    }

    /// What is left and what is given after one more transition.
    fn applied(&self, entry: &Entry<W>, left: &[u64; W], given: &[u64; W]) -> ([u64; W], [u64; W]) {
        let code = self.program.code();
        let Some(take) = code.takes.get(usize::from(entry.transition)) else {
            return (*left, *given);
        };
        let (mut more, mut word) = (code.after(given, &entry.delta), 0);
        while word < W {
            more[word] = more[word].wrapping_add(take[word]);
            word += 1;
        }
        (minus(left, take), more)
    }
}

/// This many ones, from the lowest bit; at most 64.
fn ones(count: usize) -> u64 {
    if count >= 64 { u64::MAX } else { (1 << count) - 1 }
}
