//! A game and the record of what happened in it.

use super::ms;
use super::refusal::{refusal, round_is_full, taken_by_others};
use super::step::Step;
use crate::answers::model::{
    DeadlineRow, EnabledRow, RefusalRow, SimulateAnswer, StepRow, TokensRow,
};
use cotama_core::net::{Arc, EventId, Net, OutputId, PlaceId, Transition, TransitionId};
use cotama_core::player::{Stepped, Why};
use cotama_core::units::Millis;
use cotama_verification::play::{Fired, Game, Numbered, Unused};
use std::collections::BTreeMap;

/// The most transitions that fire in one session.
pub(super) const MOST_FIRINGS: usize = 200_000;
/// The most rounds that follow each other because something waits.
const MOST_ROUNDS: usize = 1_000;

/// More than [`MOST_FIRINGS`] transitions would fire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Endless;

/// A game and its record.
pub(super) struct Session<'n, 'c> {
    net: &'n Net<'n>,
    /// Numbers of a system, which reads its mail in rounds.
    numbered: &'n Numbered,
    game: Box<dyn Game<'c> + 'c>,
    rounds: bool,
    marking: Vec<u32>,
    steps: Vec<StepRow>,
    firings: usize,
}

/// A state that a session goes back to.
pub(super) struct Saved<'c> {
    game: Box<dyn Game<'c> + 'c>,
    marking: Vec<u32>,
    steps: usize,
    firings: usize,
}

impl<'n, 'c> Session<'n, 'c> {
    /// A game that has not begun to be recorded.
    pub(super) fn new(
        numbered: &'n Numbered,
        net: &'n Net<'n>,
        game: Box<dyn Game<'c> + 'c>,
        rounds: bool,
    ) -> Self {
        let marking = net.places.iter().map(|place| place.initial).collect();
        Self { net, numbered, game, rounds, marking, steps: vec![], firings: 0 }
    }

    /// Records what fired at the start, and lets fire what is due at time zero.
    pub(super) fn begin(&mut self, fired: &[Fired]) -> Result<(), Endless> {
        self.record(fired);
        let begun = if self.rounds { Ok(()) } else { self.advance(Millis(0)) };
        self.look();
        begun
    }

    /// Does what a step says.
    pub(super) fn apply(&mut self, step: &Step) -> Result<(), Endless> {
        let done = match (self.rounds, self.numbered.is_system()) {
            (true, false) => self.synchronous(step),
            (true, true) => self.round(step.at).and_then(|()| self.offer(step)),
            (false, _) => self.advance(step.at).and_then(|()| self.offer(step)),
        };
        self.look();
        done
    }

    /// Offers the events of a step, one after the other, and lets settle what follows.
    fn offer(&mut self, step: &Step) -> Result<(), Endless> {
        for &event in &step.events {
            let mut fired = vec![];
            match self.game.offer(step.at, event, &mut fired) {
                Ok(_) => self.record(&fired),
                Err(why) => {
                    let ignored = vec![refusal(self.net, &self.marking, event, why)];
                    self.push(step.at, &[event], &[], ignored);
                }
            }
            if !self.rounds {
                self.advance(step.at)?;
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
            self.steps.iter_mut().next_back().into_iter().for_each(|it| it.round = true);
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
        let net = self.net;
        let mut changed = vec![];
        for ((place, tokens), id) in
            net.places.iter().zip(&mut self.marking).zip((0..).map(PlaceId))
        {
            let now = self.game.tokens(id);
            if std::mem::replace(tokens, now) != now
                && (id.0 as usize) < self.numbered.shown_places()
            {
                changed.push(TokensRow { place: place.name.to_owned(), tokens: now });
            }
        }
        if let Some(step) = self.steps.last_mut() {
            step.changed.retain(|it| changed.iter().all(|new| new.place != it.place));
            step.changed.extend(changed);
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
    fn synchronous(&mut self, step: &Step) -> Result<(), Endless> {
        let before = self.game.fork();
        let mut fired = vec![];
        let round = self.game.step(step.at, &step.events, &mut fired);
        let used = |event| fired.iter().any(|it| self.is_on(it, event));
        let unused = step.events.iter().filter(|&&event| !used(event));
        let ignored =
            unused.map(|&event| self.refused_round(&*before, step.at, round, event)).collect();
        self.push(step.at, &step.events, &fired, ignored);
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
    ) -> RefusalRow {
        if round.full {
            return round_is_full(self.net, event);
        }
        let mut fired = vec![];
        let _ = before.fork().step(at, &[event], &mut fired);
        if fired.iter().any(|it| self.is_on(it, event)) {
            return taken_by_others(self.net, event);
        }
        // Offered alone, it is the marking and the clocks that refuse it; what settles before that
        // is for later rounds.
        let why = match before.fork().offer(at, event, &mut vec![]) {
            Err(why) => why,
            Ok(_) => Unused::Ignored(Why::NotEnabled),
        };
        refusal(self.net, &self.marking, event, why)
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

    fn push(&mut self, at: Millis, events: &[EventId], fired: &[Fired], ignored: Vec<RefusalRow>) {
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
            let name = net.places.get(place as usize)?.name;
            let shown = (place as usize) < self.numbered.shown_places();
            (tokens != before && shown).then(|| TokensRow { place: name.to_owned(), tokens })
        });
        let outputs = transitions().flat_map(|it| it.emits);
        let output = |id: &OutputId| net.outputs.get(id.0 as usize).map(|it| it.name.to_owned());
        self.firings += fired.len();
        self.steps.push(StepRow {
            time_ms: ms(at),
            events: events.iter().map(|&event| self.event(event)).collect(),
            fired: transitions().map(|it| it.name.to_owned()).collect(),
            emitted: outputs.filter_map(output).collect(),
            changed: changed.collect(),
            ignored,
            round: false,
        });
    }

    fn transition(&self, TransitionId(id): TransitionId) -> Option<&'n Transition<'n>> {
        self.net.transitions.get(id as usize)
    }

    fn name(&self, id: TransitionId) -> String {
        self.transition(id).map_or_else(String::new, |it| it.name.to_owned())
    }

    fn event(&self, EventId(id): EventId) -> String {
        self.net.events.get(id as usize).map_or_else(String::new, |it| it.name.to_owned())
    }

    /// Returns the played net or system, as one net.
    pub(super) fn net(&self) -> &'n Net<'n> {
        self.net
    }

    /// The time it was last told.
    pub(super) fn now(&self) -> Millis {
        self.game.now()
    }

    /// How many steps were recorded.
    pub(super) fn recorded(&self) -> usize {
        self.steps.len()
    }

    /// Returns the state, to be brought back later.
    pub(super) fn save(&self) -> Saved<'c> {
        Saved {
            game: self.game.fork(),
            marking: self.marking.clone(),
            steps: self.steps.len(),
            firings: self.firings,
        }
    }

    /// Makes undone what happened since.
    pub(super) fn restore(&mut self, saved: Saved<'c>) {
        self.steps.truncate(saved.steps);
        (self.game, self.marking, self.firings) = (saved.game, saved.marking, saved.firings);
    }

    /// Returns the steps from `from` on, and the events possible now.
    pub(super) fn answer(&self, by_name: bool, complete: bool, from: usize) -> SimulateAnswer {
        let steps = self.steps.get(from..).unwrap_or_default();
        let mut enabled = vec![];
        let mut unused = vec![];
        for event in (0..self.net.events.len() as u32).map(EventId) {
            match self.prospect(event) {
                Ok(transition) => enabled.push(EnabledRow { event: self.event(event), transition }),
                Err(refusal) => unused.push(refusal),
            }
        }
        let marked = self.net.places.iter().zip(&self.marking).take(self.numbered.shown_places());
        SimulateAnswer {
            schema: "cotama/simulate/1",
            model: self.net.name.to_owned(),
            rounds: self.rounds,
            by_name,
            complete,
            ignored: steps.iter().map(|step| step.ignored.len() as u64).sum(),
            time_ms: ms(self.now()),
            fired: steps.iter().flat_map(|step| step.fired.iter().cloned()).collect(),
            steps: steps.to_vec(),
            marking: marked.map(|(place, &tokens)| (place.name.to_owned(), tokens)).collect(),
            enabled,
            unused,
            deadline: self.deadline(),
        }
    }

    /// The transition that would use an event now, or why none would.
    fn prospect(&self, event: EventId) -> Result<String, RefusalRow> {
        let (now, mut game, mut fired) = (self.now(), self.game.fork(), vec![]);
        if self.rounds && !self.numbered.is_system() {
            let round = game.step(now, &[event], &mut fired);
            let user = fired.iter().find(|it| self.is_on(it, event));
            let user = user.ok_or_else(|| self.refused_round(&*self.game, now, round, event))?;
            return Ok(self.name(user.transition));
        }
        match game.offer(now, event, &mut fired) {
            Ok(transition) => Ok(self.name(transition)),
            Err(why) => Err(refusal(self.net, &self.marking, event, why)),
        }
    }

    fn deadline(&self) -> Option<DeadlineRow> {
        let at = self.game.wake_at()?;
        let mut fired = vec![];
        let _ = self.game.fork().advance(at, &mut fired);
        Some(DeadlineRow { time_ms: ms(at), transition: self.name(fired.first()?.transition) })
    }
}
