//! A game and the record of what happened in it.

use super::game::{Fired, Game, Unused};
use super::numbered::Numbered;
use super::refusal::Refusal;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use core::mem::replace;
use cotama_core::net::{Arc, EventId, Net, OutputId, PlaceId, Transition, TransitionId};
use cotama_core::player::{Stepped, Why};
use cotama_core::units::Millis;

/// The most transitions that fire in one session, or since its records were last
/// [taken](Session::take).
pub const MOST_FIRINGS: usize = 200_000;
/// The most rounds that follow each other because something waits.
const MOST_ROUNDS: usize = 1_000;

/// More than [`MOST_FIRINGS`] transitions would fire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Endless;

/// Something that happened: an event with what settled after it, what fired by itself, or a round.
/// Numbers are those of the [`Numbered`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Time of it.
    pub at: Millis,
    /// The events that were offered; none for what fired by itself.
    pub events: Vec<EventId>,
    /// True if it is what the nets of a system did in their turns, with what they had mailed.
    pub round: bool,
    /// The transitions that fired, in this order.
    pub fired: Vec<TransitionId>,
    /// The events that no transition used.
    pub unused: Vec<Refusal>,
    /// The outputs that were emitted, in this order.
    pub emitted: Vec<OutputId>,
    /// The places that hold another number of tokens afterwards, with that number.
    pub changed: Vec<(PlaceId, u32)>,
}

/// A game and its record: what `cotama simulate` plays.
///
/// ```
/// use cotama_core::net::{EventId, TransitionId};
/// use cotama_core::units::Millis;
/// use cotama_core::system::{Component, System};
/// use cotama_play::{Numbered, Session};
/// cotama_core::net! {
///     pub mod lamp {
///         places { Dark: 1, Lit }
///         events { press }
///         transitions { on on press: Dark => Lit; off: Lit => Dark after 5_000 ms; }
///     }
/// }
/// let numbered = Numbered::of(&System::alone(&[Component::alone(&lamp::NET)]));
/// let view = numbered.whole().view();
/// let net = view.net();
/// numbered
///     .play(Millis(0), &mut |game, fired| {
///         let mut session = Session::new(&numbered, &net, game, false);
///         session.begin(&fired).unwrap();
///         session.apply(Millis(100), &[EventId(0)]).unwrap();
///         session.apply(Millis(9_000), &[]).unwrap();
///         let off = &session.records()[1];
///         assert_eq!((off.at, off.fired.as_slice()), (Millis(5_100), &[TransitionId(1)][..]));
///     })
///     .unwrap();
/// ```
pub struct Session<'n, 'c> {
    net: &'n Net<'n>,
    /// Numbers of a system, which reads its mail in rounds.
    numbered: &'n Numbered,
    game: Box<dyn Game<'c> + 'c>,
    rounds: bool,
    marking: Vec<u32>,
    records: Vec<Record>,
    firings: usize,
}

/// A state that a session goes back to.
pub struct Saved<'c> {
    game: Box<dyn Game<'c> + 'c>,
    marking: Vec<u32>,
    records: usize,
    firings: usize,
}

impl Clone for Saved<'_> {
    fn clone(&self) -> Self {
        Self { game: self.game.fork(), marking: self.marking.clone(), ..*self }
    }
}

impl<'n, 'c> Session<'n, 'c> {
    /// A game that has not begun to be recorded. With `rounds` each word is one: of a net a
    /// synchronous step, of a system the turns of its nets, then what is offered.
    pub fn new(
        numbered: &'n Numbered,
        net: &'n Net<'n>,
        game: Box<dyn Game<'c> + 'c>,
        rounds: bool,
    ) -> Self {
        let marking = net.places.iter().map(|place| place.initial).collect();
        Self { net, numbered, game, rounds, marking, records: vec![], firings: 0 }
    }

    /// Records what fired at the start, and lets fire what is due at time zero.
    ///
    /// # Errors
    /// When it does not come to rest.
    pub fn begin(&mut self, fired: &[Fired]) -> Result<(), Endless> {
        self.record(fired);
        let begun = if self.rounds { Ok(()) } else { self.advance(Millis(0)) };
        self.look();
        begun
    }

    /// Lets time pass up to `at`, then offers these events: at most one, but in a round.
    ///
    /// # Errors
    /// When it does not come to rest; [`restore`](Self::restore) leads back.
    pub fn apply(&mut self, at: Millis, events: &[EventId]) -> Result<(), Endless> {
        let done = match (self.rounds, self.numbered.is_system()) {
            (true, false) => self.synchronous(at, events),
            (true, true) => self.round(at).and_then(|()| self.offer(at, events)),
            (false, _) => self.advance(at).and_then(|()| self.offer(at, events)),
        };
        self.look();
        done
    }

    /// Offers the events of a step, one after the other, and lets settle what follows.
    fn offer(&mut self, at: Millis, events: &[EventId]) -> Result<(), Endless> {
        for &event in events {
            let mut fired = vec![];
            match self.game.offer(at, event, &mut fired) {
                Ok(_) => self.record(&fired),
                Err(why) => {
                    let ignored = vec![Refusal::of(self.net, &self.marking, event, why)];
                    self.push(at, &[event], &[], ignored);
                }
            }
            if !self.rounds {
                self.advance(at)?;
            }
        }
        Ok(())
    }

    /// Time passes, and each net of a system takes its turn.
    fn round(&mut self, at: Millis) -> Result<(), Endless> {
        self.pass(at)?;
        let mut fired = vec![];
        let behind = self.game.round(at, &mut fired);
        if self.rounds || !fired.is_empty() {
            self.push(at, &[], &fired, vec![]);
            self.records.iter_mut().next_back().into_iter().for_each(|it| it.round = true);
        }
        self.look();
        if behind { Err(Endless) } else { Ok(()) }
    }

    /// Time passes; a round follows as soon as something waits in a mailbox.
    fn advance(&mut self, to: Millis) -> Result<(), Endless> {
        for _ in 0..MOST_ROUNDS {
            let woken = self.game.wake_at().filter(|_| self.numbered.is_system());
            let next = woken.map_or(to, |it| it.min(to));
            self.pass(next)?;
            if self.game.round_is_due() {
                self.round(next)?;
            } else if next == to {
                return Ok(());
            }
        }
        Err(Endless)
    }

    /// Reads from the game what arcs do not say: mailboxes, and places that several nets change.
    fn look(&mut self) {
        let mut changed = vec![];
        for (tokens, id) in self.marking.iter_mut().zip((0..).map(PlaceId)) {
            let now = self.game.tokens(id);
            if replace(tokens, now) != now && (id.0 as usize) < self.numbered.shown_places() {
                changed.push((id, now));
            }
        }
        if let Some(record) = self.records.last_mut() {
            record.changed.retain(|it| changed.iter().all(|new| new.0 != it.0));
            record.changed.extend(changed);
        }
    }

    fn pass(&mut self, to: Millis) -> Result<(), Endless> {
        loop {
            let mut fired = vec![];
            let behind = self.game.advance(to, &mut fired);
            self.record(&fired);
            if self.firings > MOST_FIRINGS {
                return Err(Endless);
            }
            if !behind {
                return Ok(());
            }
        }
    }

    /// All transitions of a net see the same marking.
    fn synchronous(&mut self, at: Millis, events: &[EventId]) -> Result<(), Endless> {
        let before = self.game.fork();
        let mut fired = vec![];
        let round = self.game.step(at, events, &mut fired);
        let used = |event| fired.iter().any(|it| self.is_on(it, event));
        let unused = events.iter().filter(|&&event| !used(event));
        let ignored = unused.map(|&event| self.refused_round(&*before, at, round, event)).collect();
        self.push(at, events, &fired, ignored);
        if self.firings > MOST_FIRINGS { Err(Endless) } else { Ok(()) }
    }

    fn is_on(&self, fired: &Fired, event: EventId) -> bool {
        self.transition(fired.transition).is_some_and(|it| it.on == Some(event))
    }

    /// Why a round from `before` did not use an event.
    fn refused_round(
        &self,
        before: &(dyn Game<'c> + 'c),
        at: Millis,
        round: Stepped,
        event: EventId,
    ) -> Refusal {
        if round.full {
            return Refusal::round_is_full(event);
        }
        let mut fired = vec![];
        let _ = before.fork().step(at, &[event], &mut fired);
        if fired.iter().any(|it| self.is_on(it, event)) {
            return Refusal::taken_by_others(event);
        }
        // Offered alone, it is the marking and the clocks that refuse it; what settles before that
        // is for later rounds.
        let why = match before.fork().offer(at, event, &mut vec![]) {
            Err(why) => why,
            Ok(_) => Unused::Ignored(Why::NotEnabled),
        };
        Refusal::of(self.net, &self.marking, event, why)
    }

    /// Records transitions: an event, or a transition that was due, with what settled after it.
    fn record(&mut self, fired: &[Fired]) {
        let net = self.net;
        let settles = |it: &Fired| {
            let timed =
                net.transitions.get(it.transition.0 as usize).is_some_and(|it| it.within.is_some());
            !it.offered && !timed
        };
        for group in fired.chunk_by(|_, next| settles(next)) {
            let Some(first) = group.first() else { continue };
            let event =
                self.transition(first.transition).and_then(|it| it.on).filter(|_| first.offered);
            self.push(first.at, event.as_slice(), group, vec![]);
        }
    }

    fn push(&mut self, at: Millis, events: &[EventId], fired: &[Fired], unused: Vec<Refusal>) {
        let net = self.net;
        let transitions =
            || fired.iter().filter_map(|it| net.transitions.get(it.transition.0 as usize));
        let mut before = BTreeMap::new();
        for transition in transitions() {
            let mut change = |arc: &Arc, change: fn(u32, u32) -> u32| {
                let PlaceId(place) = arc.place;
                if let Some(tokens) = self.marking.get_mut(place as usize) {
                    before.entry(place).or_insert(*tokens);
                    *tokens = change(*tokens, arc.weight);
                }
            };
            // Tokens that a round gives arrive at its end, so it never takes more than there are.
            transition.take.iter().for_each(|arc| change(arc, u32::saturating_sub));
            transition.give.iter().for_each(|arc| change(arc, u32::saturating_add));
        }
        let changed = before.iter().filter_map(|(&place, &before)| {
            let tokens = *self.marking.get(place as usize)?;
            let shown = (place as usize) < self.numbered.shown_places();
            (tokens != before && shown).then_some((PlaceId(place), tokens))
        });
        self.firings = self.firings.saturating_add(fired.len());
        self.records.push(Record {
            at,
            events: events.to_vec(),
            round: false,
            fired: fired.iter().map(|it| it.transition).collect(),
            unused,
            emitted: transitions().flat_map(|it| it.emits).copied().collect(),
            changed: changed.collect(),
        });
    }

    fn transition(&self, TransitionId(id): TransitionId) -> Option<&'n Transition<'n>> {
        self.net.transitions.get(id as usize)
    }

    /// Returns the played net or system, as one net.
    pub fn net(&self) -> &'n Net<'n> {
        self.net
    }

    /// The time it was last told.
    pub fn now(&self) -> Millis {
        self.game.now()
    }

    /// True if something waits in a mailbox.
    pub fn round_is_due(&self) -> bool {
        self.game.round_is_due()
    }

    /// Returns the numbers by which everything is named.
    pub fn numbered(&self) -> &'n Numbered {
        self.numbered
    }

    /// True if each word is a round: see [`new`](Self::new).
    pub fn rounds(&self) -> bool {
        self.rounds
    }

    /// All that happened, in this order.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// Takes the records out; so many more transitions may fire again.
    pub fn take(&mut self) -> Vec<Record> {
        self.firings = 0;
        core::mem::take(&mut self.records)
    }

    /// The tokens of each place, by its number.
    pub fn marking(&self) -> &[u32] {
        &self.marking
    }

    /// The same session, to go on with in another way; its records are not copied.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self { game: self.game.fork(), marking: self.marking.clone(), records: vec![], ..*self }
    }

    /// Returns the state, to be brought back later.
    pub fn save(&self) -> Saved<'c> {
        Saved {
            game: self.game.fork(),
            marking: self.marking.clone(),
            records: self.records.len(),
            firings: self.firings,
        }
    }

    /// Makes undone what happened since.
    pub fn restore(&mut self, saved: Saved<'c>) {
        self.records.truncate(saved.records);
        (self.game, self.marking, self.firings) = (saved.game, saved.marking, saved.firings);
    }

    /// The transition that would use an event now.
    ///
    /// # Errors
    /// Why none would.
    pub fn prospect(&self, event: EventId) -> Result<TransitionId, Refusal> {
        let (now, mut game, mut fired) = (self.now(), self.game.fork(), vec![]);
        if self.rounds && !self.numbered.is_system() {
            let round = game.step(now, &[event], &mut fired);
            let user = fired.iter().find(|it| self.is_on(it, event));
            let user = user.ok_or_else(|| self.refused_round(&*self.game, now, round, event))?;
            return Ok(user.transition);
        }
        let offered = game.offer(now, event, &mut fired);
        offered.map_err(|why| Refusal::of(self.net, &self.marking, event, why))
    }

    /// When something happens next by itself, and the transition that fires first.
    pub fn deadline(&self) -> Option<(Millis, TransitionId)> {
        let at = self.game.wake_at()?;
        let mut fired = vec![];
        let _ = self.game.fork().advance(at, &mut fired);
        Some((at, fired.first()?.transition))
    }
}
