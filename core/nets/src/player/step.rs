//! Synchronous steps: the other meaning of a net alone.
//!
//! [`Player::offer`] *interleaves*: one transition after another, each seeing what the one before
//! it did. In a *step* all transitions see the same marking, as hardware does at a clock edge
//! (interpreted Petri nets, Andreu, Souquet and Gil 2008): in the order of priority, then of the
//! net, each transition whose event is among those offered, or that needs none, fires if what the
//! ones before it left of the marking enables it; all that is given arrives at the end. A step is
//! always one of the possible interleavings of the token game.
//!
//! They differ where one transition enables the next: it fires in the same `offer`, but only in the
//! next step.
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
//! let mut stepped = chain::Checked::new();
//! assert_eq!(stepped.step(Millis(0), &[chain::Event::Tick]).fired, 1);
//! assert_eq!(stepped.tokens(chain::Place::B), 1); // `second` comes with the next step
//! assert_eq!(stepped.step(Millis(0), &[]).fired, 1);
//! assert_eq!(stepped.tokens(chain::Place::C), 1);
//! ```

use super::code::{Code, Entry, minus, plus};
use super::observer::{Firing, Observer};
use super::outcome::Stepped;
use super::player::Player;
use super::program::{Checked, Kind, Program};
use cotama_units::units::Millis;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<Checked<P>, W, C, S, M>
{
    /// One synchronous step at `now` with these events; see [`Player::step_with`].
    pub fn step(&mut self, now: Millis, events: &[P::Event]) -> Stepped {
        self.step_with(now, events, &mut ())
    }

    /// One synchronous step at `now` with these events, of which a transition can use any number.
    /// Time passes before it, and nothing fires meanwhile. Afterwards the net does not settle: that
    /// is for the next steps. In a system of several nets nothing happens: they have
    /// [rounds](Player::round).
    pub fn step_with(
        &mut self,
        now: Millis,
        events: &[P::Event],
        observer: &mut impl Observer<Checked<P>, M>,
    ) -> Stepped {
        self.pass(now.0.saturating_sub(self.now.0));
        let code = self.program.code();
        // First what fires, then whether it fits, then it happens: a step that does not fit leaves
        // no trace.
        let (mut left, mut given) = (self.marking, [0; W]);
        let mut step = Stepped { ignored: ones(events.len()), ..Stepped::default() };
        for at in (0..usize::MAX).map_while(|at| self.program.ordered(at)) {
            let Some(entry) = code.entry(usize::from(at)) else { continue };
            debug_assert!(self.fits(&left), "what is left was there");
            if self.takes_part(code, &entry, &left, events) {
                (left, given) = self.applied(&entry, &left, &given);
                // Tested one by one: the sum of many gifts could outgrow a field and disturb
                // others.
                if !code.holds(&code.bounds, &given) {
                    return Stepped { full: true, ..step };
                }
            }
        }
        let after = plus(&left, &given);
        if !code.holds(&code.bounds, &after) {
            return Stepped { full: true, ..step };
        }
        let mut again = (self.marking, [0; W]);
        for at in (0..usize::MAX).map_while(|at| self.program.ordered(at)) {
            let Some(entry) = code.entry(usize::from(at)) else { continue };
            if !self.takes_part(code, &entry, &again.0, events) {
                continue;
            }
            again = self.applied(&entry, &again.0, &again.1);
            if let Some(elapsed) = self.clocks.get_mut(usize::from(entry.clock)) {
                *elapsed = 0;
            }
            step.fired = step.fired.saturating_add(1);
            for (event, bit) in events.iter().zip((0..u64::BITS).map(|bit| 1_u64.wrapping_shl(bit)))
            {
                if is_on(code, &entry, event) {
                    step.ignored &= !bit;
                }
            }
            let event = events.iter().find(|event| is_on(code, &entry, *event));
            let id = code.transition(entry.transition);
            observer.on_fire(&Firing {
                id,
                on: event.map(Kind::id),
                event,
                carries: M::default(),
                at: self.now,
                program: &self.program,
            });
        }
        debug_assert!(again == (left, given), "what fires is what was looked at");
        // `code` borrows the program: clocks are told once it is not needed any more.
        self.restart(&left);
        self.marking = after;
        step
    }

    fn takes_part(
        &self,
        code: &Code<'_, W>,
        entry: &Entry<'_, W>,
        left: &[u64; W],
        events: &[P::Event],
    ) -> bool {
        if !code.holds(left, entry.need) || !self.open(code, entry) {
            return false;
        }
        let by_itself = code.first_urgent()..code.timed().saturating_add(1);
        let mut by_itself = code.kinds(by_itself).iter();
        by_itself.any(|it| it.transition == entry.transition)
            || events.iter().any(|event| is_on(code, entry, event))
    }

    /// Returns the tokens left and the tokens given after one more transition.
    fn applied(
        &self,
        entry: &Entry<'_, W>,
        left: &[u64; W],
        given: &[u64; W],
    ) -> ([u64; W], [u64; W]) {
        let take = self.program.takes(entry.transition);
        (minus(left, &take), plus(&plus(given, entry.delta), &take))
    }
}

/// Whether an entry is on this event.
fn is_on<const W: usize>(code: &Code<'_, W>, entry: &Entry<'_, W>, event: &impl Kind) -> bool {
    let Some(kind) = code.event_number(event.id()) else { return false };
    let on = code.kinds(kind..kind.saturating_add(1));
    on.iter().any(|it| it.transition == entry.transition)
}

/// This many ones, from the lowest bit; at most 64.
fn ones(count: usize) -> u64 {
    if count >= 64 { u64::MAX } else { (1 << count) - 1 }
}
