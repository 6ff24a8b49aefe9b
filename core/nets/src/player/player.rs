//! The player: events, time and rounds.

use super::CATCH_UP;
use super::code::{Code, Entry, bounds};
use super::observer::{Anyone, Observer};
use super::outcome::{Advanced, Outcome, Round, Why};
use super::program::{Kind, Program, StateMachine};
use crate::net::data::{EventId, PlaceId, TransitionId};
use crate::system::data::Of;
use cotama_units::units::Millis;

/// A marking of all nets and mailboxes of a system, its clocks, and the time.
///
/// `W` is the number of words of the marking, `C` that of transitions with an interval, `S` that of
/// all that can wait in mailboxes, and `M` is what events carry along. `net!` and `system!` name
/// the type with these as `Player` in the module that they make.
///
/// ```
/// use cotama_core::{net, units::Millis};
/// net! { mod egg { places { Raw: 1, Hard } transitions { boil: Raw => Hard after 300_000 ms; } } }
/// let mut egg = egg::Player::new();
/// assert_eq!(egg.wake_at(), Some(Millis(300_000)));
/// assert_eq!(egg.advance(Millis(400_000)).fired, 1);
/// assert_eq!((egg.state(), egg.wake_at()), (egg::State::Hard, None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Player<P, const W: usize, const C: usize = 0, const S: usize = 0, M = ()> {
    pub(super) program: P,
    pub(super) marking: [u64; W],
    /// How long each transition with an interval has been enabled, up to
    /// [`Clock::cap`](super::code::Clock::cap); zero when it is not.
    pub(super) clocks: [u32; C],
    pub(super) slots: [M; S],
    pub(super) now: Millis,
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// Whether its type says that it plays a net alone.
    pub(super) const ALONE: bool = matches!(P::ALONE, Some(true));

    /// The system as it starts, at this time, and settled. Clocks begin now.
    pub fn start(program: P, now: Millis, observer: &mut impl Observer<P, M>) -> Self {
        let marking = program.code().initial;
        let mut player = Self { program, marking, clocks: [0; C], slots: [M::default(); S], now };
        if Self::ALONE {
            player.rest(observer);
        } else {
            player.rest(&mut Anyone(observer));
        }
        player
    }

    /// Offers an event; see [`offer_carrying`](Self::offer_carrying).
    #[inline]
    pub fn offer(&mut self, now: Millis, event: &P::Event) -> Outcome<P::Transition> {
        self.offer_with(now, event, &mut ())
    }

    /// Offers an event; see [`offer_carrying`](Self::offer_carrying).
    #[inline]
    pub fn offer_with(
        &mut self,
        now: Millis,
        event: &P::Event,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<P::Transition> {
        self.offer_carrying(now, event, M::default(), observer)
    }

    /// Lets time pass up to `now`, then offers an event from outside with what it carries along,
    /// then settles. The observer is told all that happens.
    #[inline]
    pub fn offer_carrying(
        &mut self,
        now: Millis,
        event: &P::Event,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<P::Transition> {
        let outcome = if Self::ALONE {
            self.answer(now, event.id(), Some(event), carries, observer)
        } else {
            self.answer(now, event.id(), Some(event), carries, &mut Anyone(observer))
        };
        outcome.map(|it| self.program.transition(self.program.code().transition(it)))
    }

    /// Offers an event that is known by its number alone; see
    /// [`offer_carrying`](Self::offer_carrying).
    pub fn offer_id(
        &mut self,
        now: Millis,
        event: Of<EventId>,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<Of<TransitionId>> {
        let outcome = if Self::ALONE {
            self.answer(now, event, None, carries, observer)
        } else {
            self.answer(now, event, None, carries, &mut Anyone(observer))
        };
        outcome.map(|it| self.program.code().transition(it))
    }

    /// Answers an offered event, and names transitions by their numbers.
    #[inline]
    fn answer(
        &mut self,
        now: Millis,
        id: Of<EventId>,
        event: Option<&P::Event>,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<u16> {
        let code = self.program.code();
        if C > 0 || !Self::bounded(code) || !Self::is_alone(code) {
            if self.pass_to(now, observer).behind {
                return Outcome::Ignored { why: Why::Behind };
            }
        } else {
            debug_assert!(
                self.settled_if_proven(),
                "nothing waits, and what is proven has settled"
            );
            self.now = self.now.max(now);
        }
        let code = self.program.code();
        let Some(kind) = code.event_number(id) else {
            return Outcome::Ignored { why: Why::NoSuchEvent };
        };
        if !Self::is_alone(code) {
            let outcome = self.deliver(kind as u16, event, carries, observer);
            return self.and_rest(outcome, observer);
        }
        let can = |it: &Entry<'_, W>| self.can(code, it) && self.open(code, it);
        let Some(at) = code.first(kind, &self.marking, can) else {
            observer.on_ignore(id, carries);
            return Outcome::Ignored { why: self.why(kind) };
        };
        let at_once = code.first_urgent()..code.timed();
        let Some(transition) = self.fire_alone(at, Some(id), event, carries, observer) else {
            return Outcome::Ignored { why: Why::NotEnabled }; // no entry stands there
        };
        let settled = self.settle(at_once, carries, observer);
        Outcome::Fired { transition, settled }
    }

    /// The same outcome, once all nets have settled.
    fn and_rest(
        &mut self,
        outcome: Outcome<u16>,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<u16> {
        let more = self.rest(observer);
        match outcome {
            Outcome::Fired { transition, settled } => {
                Outcome::Fired { transition, settled: settled.saturating_add(more) }
            }
            other => other,
        }
    }

    /// Lets time pass; see [`advance_with`](Self::advance_with).
    pub fn advance(&mut self, now: Millis) -> Advanced {
        self.advance_with(now, &mut ())
    }

    /// Lets time pass up to `now`: transitions without event fire when they are due. One that is
    /// due while a mailbox that it mails to is full waits until there is room. A time before the
    /// last one counts as the last one; [`clock_went_back`](Self::clock_went_back) says so.
    #[inline]
    pub fn advance_with(&mut self, now: Millis, observer: &mut impl Observer<P, M>) -> Advanced {
        if Self::ALONE {
            self.pass_to(now, observer)
        } else {
            self.pass_to(now, &mut Anyone(observer))
        }
    }

    /// Lets time pass.
    fn pass_to(&mut self, now: Millis, observer: &mut impl Observer<P, M>) -> Advanced {
        // A net proven to settle has settled before.
        let settled = Self::ALONE && Self::bounded(self.program.code());
        let fired = if settled { 0 } else { self.rest(observer) };
        let mut advanced = Advanced { fired, behind: self.is_cut_short(fired) };
        let mut refused = [false; C];
        while !advanced.behind {
            let left = now.0.saturating_sub(self.now.0);
            if let Some(wait) = self.retry(&refused, left) {
                self.pass(u64::from(wait));
                let fired = self.rest(observer);
                advanced.fired = advanced.fired.saturating_add(fired);
                advanced.behind = self.is_cut_short(fired);
                refused = [false; C];
                continue;
            }
            let (wait, at) = match self.due(&refused) {
                Some((wait, at)) if u64::from(wait) <= left => (wait, at),
                _ => {
                    self.pass(left);
                    break;
                }
            };
            if advanced.fired >= CATCH_UP {
                advanced.behind = true;
                break;
            }
            self.pass(u64::from(wait));
            if let Some(more) = self.fire_due(at, observer) {
                let settled = self.rest(observer);
                advanced.fired =
                    advanced.fired.saturating_add(1).saturating_add(more).saturating_add(settled);
                advanced.behind = self.is_cut_short(settled);
                refused = [false; C];
            } else if let Some(entry) = self.program.code().entries.get(usize::from(at))
                && let Some(refused) = refused.get_mut(usize::from(entry.clock))
            {
                *refused = true;
            }
        }
        advanced
    }

    /// One round at `now`; see [`round_with`](Self::round_with).
    pub fn round(&mut self, now: Millis) -> Round {
        self.round_with(now, &mut ())
    }

    /// Lets time pass up to `now`; then every net takes its turn; then all settle.
    pub fn round_with(&mut self, now: Millis, observer: &mut impl Observer<P, M>) -> Round {
        let observer = &mut Anyone(observer);
        let behind = self.pass_to(now, observer).behind;
        let mut round = Round { behind, ..Round::default() };
        let components = if behind { 0 } else { self.program.code().components() };
        for component in 0..components {
            self.turn(component, &mut round, observer);
        }
        self.rest(observer);
        round
    }

    /// Whether something waits in a mailbox.
    pub fn round_is_due(&self) -> bool {
        S > 0 && self.program.code().mailboxes.iter().any(|it| it.waiting.of(&self.marking) > 0)
    }

    /// The next instant at which anything can happen without an event from outside: at once when a
    /// [round is due](Self::round_is_due), otherwise when the next transition is due by itself.
    pub fn wake_at(&self) -> Option<Millis> {
        let code = self.program.code();
        if self.round_is_due() || !self.settled(code) {
            return Some(self.now);
        }
        let (wait, _) = self.due(&[false; C])?;
        Some(Millis(self.now.0.saturating_add(u64::from(wait))))
    }

    /// The tokens of a place.
    #[inline]
    pub fn tokens(&self, place: impl Into<Of<PlaceId>>) -> u32 {
        self.program.code().tokens(&self.marking, place.into())
    }

    /// How many wait in the mailbox of an event; zero when it has none.
    pub fn waiting(&self, event: &impl Kind) -> u32 {
        let code = self.program.code();
        let number = code.event_number(event.id());
        let mut boxes = code.mailboxes.iter();
        boxes
            .find(|it| Some(usize::from(it.event)) == number)
            .map_or(0, |it| it.waiting.of(&self.marking))
    }

    /// The packed marking of all nets and mailboxes; [`Code::tokens`] reads it.
    pub const fn marking(&self) -> &[u64; W] {
        &self.marking
    }

    /// Returns how long each transition with an interval has been enabled, in milliseconds up to
    /// the end of its interval; zero while it is not.
    pub const fn clocks(&self) -> &[u32; C] {
        &self.clocks
    }

    /// Returns the program played.
    pub const fn program(&self) -> &P {
        &self.program
    }

    /// Whether this transition could fire now, its event offered.
    pub fn enabled(&self, transition: impl Into<Of<TransitionId>>) -> bool {
        let (code, transition) = (self.program.code(), transition.into());
        let mut entries = (0..code.entries.len()).filter_map(|at| code.entry(at));
        entries
            .find(|it| code.transition(it.transition) == transition)
            .is_some_and(|it| self.can(code, &it) && self.open(code, &it))
    }

    /// The marked place of a component that is a state machine, to be matched on; `N` is its
    /// program. It does not compile for a net that is no state machine.
    pub fn state_of<N: StateMachine>(&self, component: u16) -> N::State {
        const {
            assert!(
                N::IS_ONE,
                "this net is no state machine of at most 32 states: ask for `tokens` of its places"
            );
        }
        let marked =
            |&(at, _): &(u32, &N::State)| self.tokens(Of { component, id: PlaceId(at) }) > 0;
        let state = (0..u32::MAX).zip(N::STATES).find(marked);
        debug_assert!(state.is_some(), "a state machine has one token");
        state.map_or(N::STATES[0], |it| *it.1)
    }

    /// Whether it is known that no bound is ever exceeded.
    #[inline]
    pub(super) fn bounded(code: &Code<'_, W>) -> bool {
        P::TRUSTED && code.bounded
    }

    /// The most transitions that fire at once by themselves one after another.
    #[inline]
    pub(super) fn longest(code: &Code<'_, W>) -> u32 {
        if P::TRUSTED { code.settle } else { super::SETTLE }
    }

    /// Whether what an event does ends when its net has settled.
    #[inline]
    pub(super) fn is_alone(code: &Code<'_, W>) -> bool {
        match P::ALONE {
            Some(alone) => alone,
            None => code.is_alone(),
        }
    }

    /// Whether the tokens that a transition needs are there, and there is room for those that it
    /// gives.
    #[inline]
    pub(super) fn can(&self, code: &Code<'_, W>, entry: &Entry<'_, W>) -> bool {
        code.holds(&self.marking, entry.need)
            && (Self::bounded(code)
                || code.holds(&code.bounds, &super::code::plus(&self.marking, entry.delta)))
    }

    /// Why no transition on this event fires.
    #[inline]
    pub(super) fn why(&self, kind: usize) -> Why<u16> {
        let code = self.program.code();
        if C > 0 || !Self::bounded(code) {
            let holds = |it: &Entry<'_, W>| code.holds(&self.marking, it.need);
            let first = code.first(kind, &self.marking, holds);
            if let Some(entry) = first.and_then(|at| code.entries.get(usize::from(at))) {
                let number = usize::from(entry.clock);
                return match (code.clocks.get(number), self.clocks.get(number)) {
                    (Some(clock), Some(&elapsed)) if elapsed < clock.earliest => {
                        Why::TooEarly(entry.transition)
                    }
                    (Some(clock), Some(&elapsed)) if !clock.is_open(elapsed) => {
                        Why::TooLate(entry.transition)
                    }
                    _ => Why::Full(entry.transition),
                };
            }
        }
        if code.ignores(&self.marking, kind) { Why::OnPurpose } else { Why::NotEnabled }
    }

    /// One net takes its turn.
    fn turn(&mut self, component: usize, round: &mut Round, observer: &mut impl Observer<P, M>) {
        let row = self.program.code().first_urgent().saturating_add(component);
        self.settle(row..row.saturating_add(1), M::default(), observer);
        let (first, end) = bounds(self.program.code().turns, component);
        for at in first..end {
            let boxes = self.program.code().mailboxes;
            let waiting = boxes.get(at).map_or(0, |it| it.waiting.of(&self.marking));
            for _ in 0..waiting {
                match self.read_and_deliver(at, observer) {
                    Some(Outcome::Fired { .. }) => round.fired = round.fired.saturating_add(1),
                    Some(Outcome::Ignored { .. }) => {
                        round.ignored = round.ignored.saturating_add(1);
                    }
                    Some(Outcome::Refused { .. }) => {
                        round.waiting = round.waiting.saturating_add(1);
                        break;
                    }
                    // An event read before has emptied it.
                    None => break,
                }
            }
        }
    }
}

impl<
    P: Program<W, C, S> + Default,
    const W: usize,
    const C: usize,
    const S: usize,
    M: Copy + Default,
> Player<P, W, C, S, M>
{
    /// The system as it starts, at time zero, and settled.
    pub fn new() -> Self {
        Self::start(P::default(), Millis(0), &mut ())
    }
}

impl<
    P: Program<W, C, S> + Default,
    const W: usize,
    const C: usize,
    const S: usize,
    M: Copy + Default,
> Default for Player<P, W, C, S, M>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<P, const W: usize, const C: usize, const S: usize, M: Copy + Default> Player<P, W, C, S, M>
where
    P: Program<W, C, S> + StateMachine,
{
    /// The marked place of a state machine, to be matched on. It does not compile for a net that is
    /// no state machine.
    #[inline]
    pub fn state(&self) -> P::State {
        const {
            assert!(
                P::IS_ONE,
                "this net is no state machine of at most 32 states: ask for `tokens` of its places \
                 instead of its `state`"
            );
        }
        let state = self.program.code().state(&self.marking);
        debug_assert!(state < P::STATES.len(), "a state machine has one token");
        P::STATES.get(state).copied().unwrap_or(P::STATES[0])
    }
}
