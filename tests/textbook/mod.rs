//! The token game by the book: an independent second implementation that the player is compared
//! with.
//!
//! Tokens are numbers in a list, clocks are instants, and every question is answered by looking at
//! all transitions. It is slow, and short enough to be compared with the definitions by eye: those
//! of [`Player`](cotama_core::player::Player) for one event after the other, of
//! [`Stepped`](cotama_core::player::Stepped) for synchronous steps.

pub mod nets;
mod steps;

use cotama_core::net::{Arc, EventId, Ignored, Net, PlaceId, TransitionId, Within};
use cotama_core::player::LARGEST;
use cotama_core::player::{CATCH_UP, Outcome, SETTLE, Why};
use std::cmp::Reverse;

/// A net that is being played.
#[derive(Clone, Debug)]
pub struct Game<'n> {
    /// The net.
    pub net: &'n Net<'n>,
    /// The tokens of each place.
    pub tokens: Vec<u32>,
    /// Since when the marking has enabled each transition, undisturbed.
    pub since: Vec<Option<u64>>,
    /// The time.
    pub now: u64,
    /// What has fired so far, in this order.
    pub fired: Vec<Fired>,
    /// Whether it came to one of the limits: more than [`SETTLE`] or [`CATCH_UP`] transitions in a
    /// row fired by themselves. What the game says is then not to be compared any more.
    pub endless: bool,
    /// All transitions: those of the highest priority first, then those of earlier lines.
    order: Vec<TransitionId>,
}

/// A transition that fired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fired {
    /// Which one.
    pub transition: TransitionId,
    /// The event that it used.
    pub event: Option<EventId>,
    /// When.
    pub at: u64,
}

impl<'n> Game<'n> {
    /// The net as it starts, at this time, and settled.
    pub fn start(net: &'n Net<'n>, now: u64) -> Self {
        let tokens = net.places.iter().map(|place| place.initial).collect();
        let since = vec![None; net.transitions.len()];
        let mut order: Vec<_> =
            (0..net.transitions.len()).map(|it| TransitionId(it as u32)).collect();
        order.sort_by_key(|it| (Reverse(net.transitions[it.0 as usize].priority), it.0));
        let mut game = Self { net, tokens, since, now, fired: Vec::new(), endless: false, order };
        game.start_clocks();
        game.settle();
        game
    }

    /// Lets time pass, then offers an event, then settles.
    pub fn offer(&mut self, now: u64, event: EventId) -> Outcome<TransitionId> {
        self.advance(now);
        let on_event = |it: &TransitionId| self.net.transitions[it.0 as usize].on == Some(event);
        let candidates: Vec<TransitionId> = self.order.iter().copied().filter(on_event).collect();
        if let Some(&transition) = candidates.iter().find(|&&it| self.can_fire(it)) {
            self.fire(transition, Some(event));
            return Outcome::Fired { transition, settled: self.settle() };
        }
        let on_purpose = |it: &Ignored| it.event == event && self.at(it.place) > 0;
        let why = match candidates.into_iter().find(|&it| self.has_tokens(it)) {
            Some(it) if self.waited(it) < u64::from(self.within(it).earliest) => Why::TooEarly(it),
            Some(it) if !self.in_time(it) => Why::TooLate(it),
            Some(it) => Why::Full(it),
            None if self.net.ignored.iter().any(on_purpose) => Why::OnPurpose,
            None => Why::NotEnabled,
        };
        Outcome::Ignored { why }
    }

    /// Lets time pass: transitions without event fire when they are due.
    pub fn advance(&mut self, now: u64) {
        let (now, already) = (now.max(self.now), self.fired.len());
        self.settle();
        while let Some((at, transition)) = self.next_due().filter(|&(at, _)| at <= now) {
            if self.endless || self.fired.len() - already >= CATCH_UP as usize {
                self.endless = true;
                return;
            }
            self.now = at;
            self.fire(transition, None);
            self.settle();
        }
        self.now = now;
    }

    /// When the next transition is due by itself.
    pub fn wake_at(&self) -> Option<u64> {
        let at_once = self.next_at_once().map(|_| self.now);
        at_once.or_else(|| self.next_due().map(|(at, _)| at))
    }

    /// Whether a transition can fire now, if the event that it needs comes.
    pub fn can_fire(&self, transition: TransitionId) -> bool {
        self.has_tokens(transition) && self.has_room(transition) && self.in_time(transition)
    }

    /// Whether nothing fires at once by itself.
    pub fn is_settled(&self) -> bool {
        self.next_at_once().is_none()
    }

    /// Whether no place holds more than its bound.
    pub fn is_within_bounds(&self) -> bool {
        let bounds = self.net.places.iter().map(|place| place.bound.min(LARGEST));
        self.tokens.iter().zip(bounds).all(|(&tokens, bound)| tokens <= bound)
    }

    /// Whether no order in which transitions can fire, whatever the time and the priorities,
    /// exceeds a bound; `false` as well when the net has more than so many markings.
    pub fn is_bounded(net: &'n Net<'n>, markings: usize) -> bool {
        let start = Self::start(net, 0);
        let initial: Vec<u32> = net.places.iter().map(|place| place.initial).collect();
        let mut known = vec![initial];
        let mut next = 0;
        while let Some(tokens) = known.get(next).cloned() {
            for &transition in &start.order {
                let mut game = Self { tokens: tokens.clone(), ..start.clone() };
                if !game.has_tokens(transition) {
                    continue;
                }
                if !game.has_room(transition) || known.len() > markings {
                    return false;
                }
                game.fire(transition, None);
                if !known.contains(&game.tokens) {
                    known.push(game.tokens);
                }
            }
            next += 1;
        }
        true
    }

    /// Fires transitions without event and interval until none is enabled; how many.
    fn settle(&mut self) -> u32 {
        let mut settled = 0;
        while let Some(transition) = self.next_at_once() {
            if settled == SETTLE {
                self.endless = true;
                break;
            }
            self.fire(transition, None);
            settled += 1;
        }
        settled
    }

    /// Moves tokens, and starts the clocks of what this disturbs anew.
    fn fire(&mut self, transition: TransitionId, event: Option<EventId>) {
        let it = &self.net.transitions[transition.0 as usize];
        self.take(it.take);
        self.stop_clocks();
        self.since[transition.0 as usize] = None;
        self.give(it.give);
        self.start_clocks();
        self.fired.push(Fired { transition, event, at: self.now });
    }

    fn take(&mut self, arcs: &[Arc]) {
        for arc in arcs {
            self.tokens[arc.place.0 as usize] -= arc.weight;
        }
    }

    fn give(&mut self, arcs: &[Arc]) {
        for arc in arcs {
            self.tokens[arc.place.0 as usize] += arc.weight;
        }
    }

    /// Of transitions that the marking does not enable.
    fn stop_clocks(&mut self) {
        for transition in self.order.clone() {
            if !self.has_tokens(transition) {
                self.since[transition.0 as usize] = None;
            }
        }
    }

    /// Of transitions that the marking enables and whose clocks do not run yet.
    fn start_clocks(&mut self) {
        for &transition in &self.order {
            if self.has_tokens(transition) {
                self.since[transition.0 as usize].get_or_insert(self.now);
            }
        }
    }

    /// The transition to fire next of those without event and interval.
    fn next_at_once(&self) -> Option<TransitionId> {
        let at_once = |it: &TransitionId| {
            let it = &self.net.transitions[it.0 as usize];
            it.on.is_none() && it.within.is_none()
        };
        self.order.iter().copied().filter(at_once).find(|&it| self.can_fire(it))
    }

    /// The transition to fire next of those without event but with an interval, and when. The last
    /// instant of the interval does not matter: one that there was no room for fires as soon as
    /// there is.
    fn next_due(&self) -> Option<(u64, TransitionId)> {
        let due = |id: TransitionId| {
            let it = &self.net.transitions[id.0 as usize];
            let waits = it.on.is_none() && self.has_tokens(id) && self.has_room(id);
            let within = it.within.filter(|_| waits)?;
            let since = self.since[id.0 as usize]?;
            Some(((since + u64::from(within.earliest)).max(self.now), id))
        };
        self.order.iter().copied().filter_map(due).min_by_key(|&(at, _)| at)
    }

    fn at(&self, place: PlaceId) -> u32 {
        self.tokens[place.0 as usize]
    }

    /// Whether the tokens that it takes and reads are there.
    pub fn has_tokens(&self, transition: TransitionId) -> bool {
        let it = &self.net.transitions[transition.0 as usize];
        it.take.iter().chain(it.read).all(|arc| self.at(arc.place) >= arc.weight)
    }

    /// Whether no place would hold more than its bound; of a transition that [has
    /// tokens](Self::has_tokens).
    fn has_room(&self, transition: TransitionId) -> bool {
        let it = &self.net.transitions[transition.0 as usize];
        it.give.iter().all(|given| {
            let taken =
                it.take.iter().find(|taken| taken.place == given.place).map_or(0, |arc| arc.weight);
            let after = u64::from(self.at(given.place) - taken) + u64::from(given.weight);
            after <= u64::from(self.net.places[given.place.0 as usize].bound.min(LARGEST))
        })
    }

    fn within(&self, transition: TransitionId) -> Within {
        let any_time = Within { earliest: 0, latest: None };
        self.net.transitions[transition.0 as usize].within.unwrap_or(any_time)
    }

    /// How long the marking has enabled it.
    fn waited(&self, transition: TransitionId) -> u64 {
        self.since[transition.0 as usize].map_or(0, |since| self.now - since)
    }

    /// Whether its interval allows it to fire now. Only one on an event can be too late.
    fn in_time(&self, transition: TransitionId) -> bool {
        let (waited, within) = (self.waited(transition), self.within(transition));
        let on_event = self.net.transitions[transition.0 as usize].on.is_some();
        waited >= u64::from(within.earliest)
            && (!on_event || within.latest.is_none_or(|latest| waited <= u64::from(latest)))
    }
}
