//! The token game by the book: an independent second implementation that the player is compared
//! with.
//!
//! Tokens are numbers in a list, clocks are instants, what is undone is kept as a copy, and every
//! question is answered by looking at all transitions. It is slow, and short enough to be compared
//! with the definitions by eye: those of [`cotama_core::player`] for events, time and rounds, those
//! of [`Player::step`](cotama_core::player::Player::step) for synchronous steps.

pub mod flat;
pub mod nets;
mod steps;
pub mod systems;

use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::{Outcome, Round, Why};
use cotama_core::system::{Delivery, Of, System};
use flat::{Book, Cell, weight};
use std::collections::VecDeque;
use std::rc::Rc;

/// The most transitions that fire in one call before the game is [endless](Game::endless): no more
/// than the player lets fire.
pub const ENDLESS: u32 = 1_000;

/// A system that is being played. What events carry along is a number.
#[derive(Clone, Debug)]
pub struct Game<'s> {
    /// The system.
    pub system: System<'s>,
    /// The system written out.
    pub book: Rc<Book>,
    /// The state, which can be undone.
    pub state: State,
    /// The time.
    pub now: u64,
    /// Events so far, in this order.
    pub told: Vec<Told>,
    /// How many transitions have fired in this call.
    pub fired: u32,
    /// Whether a call had to be cut short. What the game says is then not to be compared any more.
    pub endless: bool,
}

/// Tokens, mailboxes and clocks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct State {
    /// The tokens of each cell.
    pub tokens: Vec<u32>,
    /// Waiting events of each mailbox, the oldest first.
    pub mail: Vec<VecDeque<u16>>,
    /// Since when the marking has enabled each transition, undisturbed.
    pub since: Vec<Option<u64>>,
}

/// Something that happened, with what is carried along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// A transition fired, on this event or by itself, at this time.
    Fired(Of<TransitionId>, Option<Of<EventId>>, u64, u16),
    /// An event was ignored for good.
    Ignored(Of<EventId>, u16),
    /// Something was put into the mailbox of an event.
    Mailed(Of<EventId>, u16),
    /// Something was taken out of the mailbox of an event, which another one empties.
    Cleared(Of<EventId>, u16),
}

/// The mailbox of this event is full.
struct Full(Of<EventId>);

impl<'s> Game<'s> {
    /// The system as it starts, at this time, and settled.
    pub fn start(system: &System<'s>, now: u64) -> Self {
        let book = Rc::new(Book::of(system));
        let state = State {
            tokens: book.initial.clone(),
            mail: vec![VecDeque::new(); book.mailboxes.len()],
            since: vec![None; book.lines.len()],
        };
        let (told, fired, endless) = (Vec::new(), 0, false);
        let mut game = Self { system: *system, book, state, now, told, fired, endless };
        game.start_clocks();
        game.settle_all();
        game
    }

    /// Lets time pass, then offers an event, then settles.
    pub fn offer(
        &mut self,
        now: u64,
        event: Of<EventId>,
        carries: u16,
    ) -> Outcome<Of<TransitionId>> {
        self.advance(now);
        let before = self.fired;
        let answer = self.all_or_nothing(|game| {
            let answer = game.hear(event, carries)?;
            Ok(answer.ok_or_else(|| game.why(event)))
        });
        self.settle_all();
        match answer {
            Ok(Ok(line)) => {
                let settled = (self.fired - before).saturating_sub(1);
                Outcome::Fired { transition: self.book.lines[line].id, settled }
            }
            Ok(Err(why)) => Outcome::Ignored { why },
            Err(Full(full)) => Outcome::Refused { full },
        }
    }

    /// Lets time pass: transitions without event fire as soon as they can. Between the instants at
    /// which an interval begins, or is over, nothing changes.
    pub fn advance(&mut self, now: u64) {
        self.fired = 0;
        loop {
            self.settle_all();
            while self.fire_due() {
                self.settle_all();
            }
            match self.next_change().filter(|&at| at <= now) {
                Some(at) => self.now = at,
                None => break,
            }
        }
        self.now = self.now.max(now);
    }

    /// One round: every net takes its turn, then all settle.
    pub fn round(&mut self, now: u64) -> Round {
        self.advance(now);
        let mut round = Round::default();
        let mut mailboxes = (0..self.book.mailboxes.len()).peekable();
        for component in 0..self.system.components.len() as u16 {
            self.settle(component..component + 1);
            let here = |it: &usize| self.book.clone().mailboxes[*it].component == component;
            let mine: Vec<usize> = std::iter::from_fn(|| mailboxes.next_if(here)).collect();
            for mailbox in mine {
                self.read_all(mailbox, &mut round);
            }
        }
        self.settle_all();
        round
    }

    /// A net reads a mailbox, as far as it is filled now.
    fn read_all(&mut self, mailbox: usize, round: &mut Round) {
        let event = self.book.mailboxes[mailbox];
        for _ in 0..self.state.mail[mailbox].len() {
            if self.state.mail[mailbox].is_empty() {
                return; // what was read has emptied it
            }
            let read = self.all_or_nothing(|game| {
                let carries = game.take_out(mailbox);
                game.hear(event, carries)
            });
            match read {
                Ok(Some(_)) => round.fired += 1,
                Ok(None) => round.ignored += 1,
                Err(Full(_)) => {
                    round.waiting += 1;
                    return;
                }
            }
        }
    }

    /// Whether something waits in a mailbox.
    pub fn round_is_due(&self) -> bool {
        self.state.mail.iter().any(|it| !it.is_empty())
    }

    /// When something can happen next, if nothing comes from outside.
    pub fn wake_at(&self) -> Option<u64> {
        if self.round_is_due() || !self.is_settled() {
            return Some(self.now);
        }
        let due = |&at: &usize| {
            let (within, since) = (self.book.lines[at].within?, self.state.since[at]?);
            Some((since + u64::from(within.earliest)).max(self.now))
        };
        let by_itself = self.book.order.iter().filter(|&&at| self.book.lines[at].on.is_none());
        by_itself.filter(|&&at| self.can(at)).filter_map(due).min()
    }

    /// Whether nothing fires at once by itself.
    pub fn is_settled(&self) -> bool {
        (0..self.system.components.len()).all(|it| self.at_once(it as u16).next().is_none())
    }

    /// Does all of it or nothing.
    fn all_or_nothing<T>(
        &mut self,
        act: impl FnOnce(&mut Self) -> Result<T, Full>,
    ) -> Result<T, Full> {
        let before = (self.state.clone(), self.told.len(), self.fired);
        let done = act(self);
        if done.is_err() {
            (self.state, self.fired) = (before.0, before.2);
            self.told.truncate(before.1);
        }
        done
    }

    /// A net hears an event: which transition fires on it, if one does.
    fn hear(&mut self, event: Of<EventId>, carries: u16) -> Result<Option<usize>, Full> {
        for clear in self.system.clears.iter().filter(|it| it.on == event) {
            let emptied = Of { component: event.component, id: clear.mailbox };
            let mailbox = self.mailbox(emptied);
            while !self.state.mail[mailbox].is_empty() {
                let carried = self.take_out(mailbox);
                self.told.push(Told::Cleared(emptied, carried));
            }
        }
        let answering = self.on(event).find(|&it| self.can(it) && self.in_time(it));
        match answering {
            Some(line) => self.fire(line, Some(event), carries)?,
            None => self.told.push(Told::Ignored(event, carries)),
        }
        Ok(answering)
    }

    /// Fires a transition, with all that it causes, and its net settles.
    fn fire(&mut self, line: usize, on: Option<Of<EventId>>, carries: u16) -> Result<(), Full> {
        self.act(line, on, carries)?;
        let component = self.book.lines[line].id.component;
        loop {
            let next = self.at_once(component).next();
            match next {
                Some(line) => self.act(line, None, carries)?,
                None => return Ok(()),
            }
        }
    }

    /// Moves the tokens of a transition, and causes what it says.
    fn act(&mut self, line: usize, on: Option<Of<EventId>>, carries: u16) -> Result<(), Full> {
        let book = self.book.clone();
        let it = &book.lines[line];
        self.change(&it.take, &it.give, Some(line));
        self.told.push(Told::Fired(it.id, on, self.now, carries));
        self.fired += 1;
        self.endless |= self.fired >= ENDLESS;
        for &(event, delivery) in &it.says {
            match delivery {
                Delivery::Now => _ = self.hear(event, carries)?,
                Delivery::Mail { .. } => self.put_in(event, carries)?,
            }
        }
        Ok(())
    }

    fn put_in(&mut self, event: Of<EventId>, carries: u16) -> Result<(), Full> {
        let cells = [Cell::Waiting(event), Cell::Room(event)].map(|it| self.book.find(it));
        let [Some(waiting), Some(room)] = cells else { unreachable!("a mailbox has cells") };
        if self.state.tokens[room] == 0 {
            return Err(Full(event));
        }
        self.change(&[(room, 1)], &[(waiting, 1)], None);
        let mailbox = self.mailbox(event);
        self.state.mail[mailbox].push_back(carries);
        self.told.push(Told::Mailed(event, carries));
        Ok(())
    }

    fn take_out(&mut self, mailbox: usize) -> u16 {
        let event = self.book.mailboxes[mailbox];
        let cells = [Cell::Waiting(event), Cell::Room(event)].map(|it| self.book.find(it));
        let [Some(waiting), Some(room)] = cells else { unreachable!("a mailbox has cells") };
        self.change(&[(waiting, 1)], &[(room, 1)], None);
        self.state.mail[mailbox].pop_front().expect("something waits")
    }

    /// The position of the mailbox of an event.
    fn mailbox(&self, event: Of<EventId>) -> usize {
        let is_it = |it: &Of<EventId>| *it == event;
        self.book.mailboxes.iter().position(is_it).expect("it has a mailbox")
    }

    /// All nets settle, those of the first component first.
    fn settle_all(&mut self) {
        self.settle(0..self.system.components.len() as u16);
    }

    /// Transitions without event and interval of these nets fire until none can: one that mails to
    /// a full mailbox cannot.
    fn settle(&mut self, components: std::ops::Range<u16>) {
        loop {
            let next: Vec<usize> = components.clone().flat_map(|it| self.at_once(it)).collect();
            if !next.into_iter().any(|line| self.fires(line)) {
                return;
            }
        }
    }

    /// Fires the first transition that is due by itself and can: whether there was one.
    fn fire_due(&mut self) -> bool {
        let is_due = |&at: &usize| {
            let it = &self.book.lines[at];
            it.on.is_none() && it.within.is_some() && self.in_time(at) && self.can(at)
        };
        let due: Vec<usize> = self.book.order.iter().copied().filter(is_due).collect();
        due.into_iter().any(|line| self.fires(line))
    }

    /// Fires a transition by itself, with all that it causes; `false` when a mailbox is full.
    fn fires(&mut self, line: usize) -> bool {
        self.all_or_nothing(|game| game.fire(line, None, 0)).is_ok()
    }

    /// The transitions without event and interval of a net that can fire, the first one first.
    fn at_once(&self, component: u16) -> impl Iterator<Item = usize> {
        let is_one = move |&at: &usize| {
            let it = &self.book.lines[at];
            it.id.component == component && it.on.is_none() && it.within.is_none() && self.can(at)
        };
        self.book.order.iter().copied().filter(is_one)
    }

    /// The transitions on an event, the first one first.
    fn on(&self, event: Of<EventId>) -> impl Iterator<Item = usize> {
        let is_on = move |at: &usize| self.book.lines[*at].on == Some(event);
        self.book.order.iter().copied().filter(is_on)
    }

    /// Why no transition fires on an event.
    fn why(&self, event: Of<EventId>) -> Why<Of<TransitionId>> {
        let net = self.system.components[usize::from(event.component)].net;
        let first = self.on(event).find(|&it| self.has_tokens(it));
        let Some(first) = first else {
            let mut here = net.ignored.iter().filter(|it| it.event == event.id);
            let component = event.component;
            let tokens = |id| self.place(Of { component, id });
            let marked = here.any(|it| {
                let mut guard = it.guard.iter();
                tokens(it.place) > 0 && guard.all(|arc| tokens(arc.place) >= arc.weight)
            });
            return if marked { Why::OnPurpose } else { Why::NotEnabled };
        };
        let (line, waited) = (&self.book.lines[first], self.waited(first));
        if line.within.is_some_and(|it| waited < u64::from(it.earliest)) {
            Why::TooEarly(line.id)
        } else if self.in_time(first) {
            Why::Full(line.id)
        } else {
            Why::TooLate(line.id)
        }
    }

    /// Moves tokens, and starts the clocks of what this disturbs anew.
    fn change(&mut self, take: &[(usize, u32)], give: &[(usize, u32)], own: Option<usize>) {
        for &(cell, weight) in take {
            self.state.tokens[cell] -= weight;
        }
        self.stop_clocks();
        if let Some(own) = own {
            self.state.since[own] = None;
        }
        for &(cell, weight) in give {
            self.state.tokens[cell] += weight;
        }
        self.start_clocks();
    }

    /// Stops the clocks of transitions that the marking does not enable.
    fn stop_clocks(&mut self) {
        for at in 0..self.state.since.len() {
            if !self.has_tokens(at) {
                self.state.since[at] = None;
            }
        }
    }

    /// Starts the clocks of transitions that the marking enables and whose clocks do not run yet.
    fn start_clocks(&mut self) {
        for at in 0..self.state.since.len() {
            if self.has_tokens(at) {
                self.state.since[at].get_or_insert(self.now);
            }
        }
    }

    /// The next instant at which an interval of an enabled transition begins, or is over.
    fn next_change(&self) -> Option<u64> {
        let changes = self.book.lines.iter().zip(&self.state.since).flat_map(|(line, since)| {
            let earliest = line.within.map(|it| u64::from(it.earliest));
            let over = line.within.and_then(|it| Some(u64::from(it.latest?) + 1));
            [earliest, over].map(|it| Some((*since)? + it?))
        });
        changes.flatten().filter(|&at| at > self.now).min()
    }

    /// The tokens of a place.
    pub fn place(&self, place: Of<PlaceId>) -> u32 {
        self.state.tokens[self.book.place(&self.system, place)]
    }

    /// Whether a transition can fire now, if the event that it needs comes.
    pub fn can_fire(&self, line: usize) -> bool {
        self.can(line) && self.in_time(line)
    }

    /// Whether tokens and room are there, in a game that goes on.
    fn can(&self, line: usize) -> bool {
        !self.endless && self.has_tokens(line) && self.has_room(line)
    }

    /// Whether the tokens that it takes and reads are there.
    pub fn has_tokens(&self, line: usize) -> bool {
        let it = &self.book.lines[line];
        it.take.iter().chain(&it.read).all(|&(cell, weight)| self.state.tokens[cell] >= weight)
    }

    /// Whether no cell would hold more than its bound; of a transition that [has
    /// tokens](Self::has_tokens).
    fn has_room(&self, line: usize) -> bool {
        let it = &self.book.lines[line];
        it.give.iter().all(|&(cell, given)| {
            let left = self.state.tokens[cell] - weight(&it.take, cell);
            u64::from(left) + u64::from(given) <= u64::from(self.book.cells[cell].1)
        })
    }

    /// Whether no cell holds more than its bound.
    pub fn is_within_bounds(&self) -> bool {
        self.state.tokens.iter().zip(&self.book.cells).all(|(&tokens, it)| tokens <= it.1)
    }

    /// How long the marking has enabled it.
    fn waited(&self, line: usize) -> u64 {
        self.state.since[line].map_or(0, |since| self.now - since)
    }

    /// Whether its interval allows it to fire now. Only one on an event can be too late.
    fn in_time(&self, line: usize) -> bool {
        let it = &self.book.lines[line];
        let waited = self.waited(line);
        it.within.is_none_or(|within| {
            let late = within.latest.is_some_and(|latest| waited > u64::from(latest));
            waited >= u64::from(within.earliest) && (it.on.is_none() || !late)
        })
    }
}
