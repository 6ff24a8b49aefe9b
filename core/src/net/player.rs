//! Plays a net: events go in, transitions fire, and what happened comes out.
//!
//! Time comes in as an argument and the next deadline goes out ([`Player::wake_at`]), so the same
//! player serves firmware, a simulator and proofs. At every instant, in this order:
//!
//! 1. Transitions without event fire as soon as their interval allows, the one due first going
//!    first; of several due at the same instant the one of the highest priority, then the earlier
//!    line. After each of them the net *settles*: transitions without event and interval fire until
//!    none is enabled.
//! 2. An event is *offered*: the first enabled transition on it fires (by priority, then by line),
//!    and the net settles; or the event is ignored, and the player says why. Nothing waits inside
//!    the player.
//!
//! **Time.** The clock of a transition starts when the marking enables it, and starts anew whenever
//! a firing disturbs it: when it fires itself, or when what the firing takes leaves it disabled,
//! even if what is given back enables it again (Merlin's time Petri nets, with single-server
//! clocks). Reading disturbs no clock. The semantics is *strong* for transitions without event:
//! time does not pass their last instant. They fire at their first, so a later last instant only
//! tells the checker what to allow for. For a transition on an event it is *weak*: when its last
//! instant has passed, it is not enabled any more until its clock starts anew. A player that is
//! told the time late catches up: what was due fires at the time when it was due, in order.

use super::code::{Code, Entry, NO_CLOCK};
use super::data::{PlaceId, TransitionId};
use super::program::{Firing, Kind, Observer, Program, StateMachine};
use crate::units::Millis;

/// The most transitions that one call lets fire while it catches up; see [`Advanced::behind`].
pub const CATCH_UP: u32 = 10_000;

/// What became of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use = "an event may have been ignored"]
pub enum Outcome<T> {
    /// A transition fired.
    Fired {
        /// Its line.
        transition: T,
        /// How many fired at once by themselves after it.
        settled: u32,
    },
    /// None fired; the event is gone.
    Ignored {
        /// Why.
        why: Why<T>,
    },
}

impl<T> Outcome<T> {
    /// Whether a transition fired.
    pub const fn fired(&self) -> bool {
        matches!(self, Self::Fired { .. })
    }
}

/// Why an event is ignored. When a transition on it has its tokens: what else the first such one
/// lacks, even where the event is ignored on purpose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why<T> {
    /// A marked place ignores it on purpose.
    OnPurpose,
    /// No transition on it has the tokens it needs.
    NotEnabled,
    /// This one has, but its interval has not begun.
    TooEarly(T),
    /// This one has, but its interval is over.
    TooLate(T),
    /// This one has, but a place would hold more than its bound.
    Full(T),
    /// The player is behind the time it was told: [`Player::advance`] it first.
    Behind,
}

/// What happened while time passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[must_use = "the player may be behind"]
pub struct Advanced {
    /// How many transitions fired.
    pub fired: u32,
    /// Whether there is more to catch up with than [`CATCH_UP`] transitions: call again.
    pub behind: bool,
}

/// A marking of a net, its clocks, and the time.
///
/// `W` is the number of words of the marking, `C` that of transitions with an interval; `net!`
/// names the type with both as `Player` in the module that it makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Player<P, const W: usize, const C: usize> {
    pub(super) program: P,
    pub(super) marking: [u64; W],
    /// How long each transition with an interval has been enabled, up to [`Clock::cap`]; zero when
    /// it is not.
    pub(super) clocks: [u32; C],
    pub(super) now: Millis,
}

impl<P: Program<W>, const W: usize, const C: usize> Player<P, W, C> {
    /// The net as it starts, at this time, and settled. Clocks begin now.
    pub fn start(
        program: P,
        now: Millis,
        observer: &mut impl Observer<P::Event, P::Transition, P::Output>,
    ) -> Self {
        let marking = program.code().initial;
        let mut player = Self { program, marking, clocks: [0; C], now };
        player.settle(observer);
        player
    }

    /// Offers an event; see [`Player::offer_with`].
    #[inline]
    pub fn offer(&mut self, now: Millis, event: &P::Event) -> Outcome<P::Transition> {
        self.offer_with(now, event, &mut ())
    }

    /// Lets time pass up to `now`, then offers an event, then settles. Every transition that fires
    /// is shown to the observer.
    #[inline]
    pub fn offer_with(
        &mut self,
        now: Millis,
        event: &P::Event,
        observer: &mut impl Observer<P::Event, P::Transition, P::Output>,
    ) -> Outcome<P::Transition> {
        if C > 0 || !self.program.code().bounded {
            if self.advance_with(now, observer).behind {
                return Outcome::Ignored { why: Why::Behind };
            }
        } else {
            // Nothing waits for an instant, and settling ends: only a round can have left something
            // to fire.
            self.settle(observer);
            self.now = self.now.max(now);
        }
        let code = self.program.code();
        let can = |it: &Entry<W>| self.can(&code, it) && self.open(it);
        if let Some(entry) = code.first(event.id().0 as usize, &self.marking, can).copied() {
            self.fire(&entry, Some(event), observer);
            let transition = self.program.transition(entry.id());
            return Outcome::Fired { transition, settled: self.settle(observer) };
        }
        Outcome::Ignored { why: self.why(event) }
    }

    /// Lets time pass; see [`Player::advance_with`].
    pub fn advance(&mut self, now: Millis) -> Advanced {
        self.advance_with(now, &mut ())
    }

    /// Lets time pass up to `now`: transitions without event fire when they are due. A time before
    /// the last one counts as the last one.
    pub fn advance_with(
        &mut self,
        now: Millis,
        observer: &mut impl Observer<P::Event, P::Transition, P::Output>,
    ) -> Advanced {
        let fired = self.settle(observer);
        let mut advanced = Advanced { fired, behind: self.is_cut_short(fired) };
        while !advanced.behind {
            let left = now.0.saturating_sub(self.now.0);
            match self.due() {
                Some((wait, entry)) if u64::from(wait) <= left => {
                    if advanced.fired >= CATCH_UP {
                        advanced.behind = true;
                        break;
                    }
                    self.pass(u64::from(wait));
                    self.fire(&entry, None, observer);
                    let settled = self.settle(observer);
                    advanced.fired += 1 + settled;
                    advanced.behind = self.is_cut_short(settled);
                }
                _ => {
                    self.pass(left);
                    break;
                }
            }
        }
        advanced
    }

    /// When it wants to be told the time: the instant at which the next transition is due by
    /// itself.
    pub fn wake_at(&self) -> Option<Millis> {
        if !self.settled() {
            return Some(self.now); // after a round
        }
        let (wait, _) = self.due()?;
        Some(Millis(self.now.0.saturating_add(u64::from(wait))))
    }

    /// The time it was last told.
    pub const fn now(&self) -> Millis {
        self.now
    }

    /// The tokens of a place.
    #[inline]
    pub fn tokens(&self, place: impl Into<PlaceId>) -> u32 {
        self.program.code().tokens(&self.marking, place.into())
    }

    /// The packed marking; [`Code::tokens`] reads it.
    pub const fn marking(&self) -> &[u64; W] {
        &self.marking
    }

    /// What it plays.
    pub const fn program(&self) -> &P {
        &self.program
    }

    /// Whether this transition could fire now, its event offered.
    pub fn enabled(&self, transition: TransitionId) -> bool {
        let code = self.program.code();
        let mut entries = code.entries.iter();
        entries
            .find(|entry| entry.id() == transition)
            .is_some_and(|it| self.can(&code, it) && self.open(it))
    }

    /// Whether no transition fires at once by itself.
    pub(super) fn settled(&self) -> bool {
        let code = self.program.code();
        code.urgent(&self.marking, |it| self.can(&code, it)).is_none()
    }

    /// Whether settling stopped before its end, having let so many transitions fire.
    fn is_cut_short(&self, fired: u32) -> bool {
        fired >= self.program.code().settle && !self.settled()
    }

    /// Lets transitions without event and interval fire until none is enabled; how many did.
    #[inline]
    fn settle(&mut self, observer: &mut impl Observer<P::Event, P::Transition, P::Output>) -> u32 {
        let mut fired = 0;
        while fired < self.program.code().settle {
            let code = self.program.code();
            let Some(entry) = code.urgent(&self.marking, |it| self.can(&code, it)).copied() else {
                break;
            };
            self.fire(&entry, None, observer);
            fired += 1;
        }
        fired
    }

    /// Fires a transition that [can](Self::can) fire.
    #[inline]
    fn fire(
        &mut self,
        entry: &Entry<W>,
        event: Option<&P::Event>,
        observer: &mut impl Observer<P::Event, P::Transition, P::Output>,
    ) {
        let code = self.program.code();
        let after = code.after(&self.marking, &entry.delta);
        if C > 0
            && let Some(take) = code.takes.get(usize::from(entry.transition))
        {
            self.restart(&minus(&self.marking, take));
            if let Some(elapsed) = self.clocks.get_mut(usize::from(entry.clock)) {
                *elapsed = 0;
            }
        }
        self.marking = after;
        let id = entry.id();
        observer.on_fire(&Firing {
            transition: self.program.transition(id),
            id,
            event,
            outputs: self.program.outputs(id),
            at: self.now,
        });
    }

    /// Whether the interval of a transition allows it to fire now.
    #[inline]
    pub(super) fn open(&self, entry: &Entry<W>) -> bool {
        if C == 0 || entry.clock == NO_CLOCK {
            return true;
        }
        let clock = usize::from(entry.clock);
        match (self.program.code().clocks.get(clock), self.clocks.get(clock)) {
            (Some(clock), Some(&elapsed)) => {
                clock.earliest <= elapsed
                    && (!clock.event || clock.latest == u32::MAX || elapsed <= clock.latest)
            }
            _ => true,
        }
    }

    /// The transition without event that is due first, and how long it has to wait.
    #[inline]
    fn due(&self) -> Option<(u32, Entry<W>)> {
        let code = self.program.code();
        let mut first: Option<(u32, &Entry<W>)> = None;
        // In their order, so that of several due at one instant the first one goes first.
        for entry in code.row(usize::from(code.events) + 1, &self.marking)? {
            let number = usize::from(entry.clock);
            let (Some(clock), Some(elapsed)) = (code.clocks.get(number), self.clocks.get(number))
            else {
                continue;
            };
            let waits = clock.earliest.saturating_sub(*elapsed);
            if first.is_none_or(|(least, _)| waits < least) && self.can(&code, entry) {
                first = Some((waits, entry));
            }
        }
        first.map(|(waits, entry)| (waits, *entry))
    }

    /// Whether the tokens that a transition needs are there, and there is room for those that it
    /// gives.
    #[inline]
    pub(super) fn can(&self, code: &Code<'_, W>, entry: &Entry<W>) -> bool {
        code.holds(&self.marking, &entry.need)
            && (code.bounded || code.holds(&code.bounds, &code.after(&self.marking, &entry.delta)))
    }

    /// Starts clocks anew of transitions that what was taken has left disabled; given what is left.
    pub(super) fn restart(&mut self, left: &[u64; W]) {
        let code = self.program.code();
        for (elapsed, clock) in self.clocks.iter_mut().zip(code.clocks) {
            if !code.holds(left, &clock.need) {
                *elapsed = 0;
            }
        }
    }

    /// Lets time pass for the clocks alone.
    pub(super) fn pass(&mut self, time: u64) {
        self.now.0 = self.now.0.saturating_add(time);
        if C == 0 || time == 0 {
            return;
        }
        let code = self.program.code();
        let time = u32::try_from(time).unwrap_or(u32::MAX);
        for (elapsed, clock) in self.clocks.iter_mut().zip(code.clocks) {
            if code.holds(&self.marking, &clock.need) {
                *elapsed = elapsed.saturating_add(time).min(clock.cap());
            }
        }
    }

    /// Why no transition on this event fires.
    #[inline]
    fn why(&self, event: &P::Event) -> Why<P::Transition> {
        let code = self.program.code();
        if C > 0 || !code.bounded {
            let holds = |it: &Entry<W>| code.holds(&self.marking, &it.need);
            if let Some(entry) = code.first(event.id().0 as usize, &self.marking, holds) {
                let transition = self.program.transition(entry.id());
                let number = usize::from(entry.clock);
                return match (code.clocks.get(number), self.clocks.get(number)) {
                    (Some(clock), Some(&elapsed)) if elapsed < clock.earliest => {
                        Why::TooEarly(transition)
                    }
                    (Some(_), Some(_)) if !self.open(entry) => Why::TooLate(transition),
                    _ => Why::Full(transition),
                };
            }
        }
        if code.ignores(&self.marking, event.id()) { Why::OnPurpose } else { Why::NotEnabled }
    }
}

impl<P: Program<W> + Default, const W: usize, const C: usize> Player<P, W, C> {
    /// The net as it starts, at time zero, and settled.
    pub fn new() -> Self {
        Self::start(P::default(), Millis(0), &mut ())
    }
}

impl<P: Program<W> + Default, const W: usize, const C: usize> Default for Player<P, W, C> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: Program<W> + StateMachine, const W: usize, const C: usize> Player<P, W, C> {
    /// The marked place of a state machine, to be matched on. Of a net that is none this does not
    /// compile.
    #[inline]
    pub fn state(&self) -> P::State {
        const {
            assert!(
                P::IS_ONE,
                "this net is no state machine of at most 32 states: ask for `tokens` of its places instead of its `state`"
            );
        }
        let state = self.program.code().state(&self.marking);
        match P::STATES.get(state) {
            Some(state) => *state,
            // A state machine has one token, so this is never needed.
            None => P::STATES[0],
        }
    }
}

/// What is left of a marking; what is taken is there.
pub(super) fn minus<const W: usize>(marking: &[u64; W], take: &[u64; W]) -> [u64; W] {
    let mut left = *marking;
    for (left, take) in left.iter_mut().zip(take) {
        *left = left.wrapping_sub(*take);
    }
    left
}
