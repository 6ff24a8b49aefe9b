//! The consequences of a firing in a system: rendezvous and mailboxes, all of them or none.

use super::SETTLE;
use super::code::{Mailbox, NONE, Route, bounds};
use super::observer::{Firing, Observer};
use super::outcome::{Outcome, Why};
use super::player::Player;
use super::program::Program;
use crate::system::data::DEPTH;

/// A mailbox on the way is full: its position.
struct Full(u16);

/// One happening inside the player. It names events and transitions by their numbers.
#[derive(Clone, Copy)]
enum Happened<M> {
    /// A transition fired, on this event or by itself.
    Fired(u16, Option<u16>),
    Ignored(u16),
    Mailed(u16),
    /// A mailbox lost an entry, which carried this.
    Cleared(u16, M),
}

/// The journal keeps so many happenings until it is clear that no mailbox is full. When there are
/// more, the player does everything once more to tell them.
const REMEMBERED: usize = 16;

/// The events so far, for the observer.
struct Journal<M> {
    happened: [Option<Happened<M>>; REMEMBERED],
    count: usize,
}

impl<M: Copy> Journal<M> {
    fn push(&mut self, it: Happened<M>) {
        if let Some(slot) = self.happened.get_mut(self.count) {
            *slot = Some(it);
        }
        self.count = self.count.saturating_add(1);
    }
}

/// The firings that have begun in the player `L` and have not delivered all their outputs.
struct UnderWay<'w, L, M> {
    carries: M,
    /// Hears what happens.
    tell: &'w mut dyn FnMut(&L, Happened<M>),
    /// For each net under way: its component, its next route, and the end of its routes.
    said: [(u16, u16, u16); DEPTH + 1],
    depth: usize,
    fired: u32,
}

/// The first thing that happens.
#[derive(Clone, Copy)]
enum Begins {
    /// This event is delivered.
    On(u16),
    /// The transition at this position fires by itself.
    With(u16),
}

impl<'w, L, M> UnderWay<'w, L, M> {
    fn new(carries: M, tell: &'w mut dyn FnMut(&L, Happened<M>)) -> Self {
        Self { carries, tell, said: [(0, 0, 0); DEPTH + 1], depth: 0, fired: 0 }
    }

    /// The net that began last, and its next route. When it has no route left, it is not under way
    /// any more.
    fn next(&mut self) -> Option<(u16, Option<u16>)> {
        let top = self.depth.checked_sub(1)?;
        let (component, next, end) = self.said.get_mut(top)?;
        let route = *next;
        if route < *end {
            *next = route.saturating_add(1);
            return Some((*component, Some(route)));
        }
        self.depth = top;
        Some((*component, None))
    }

    fn push(&mut self, said: (u16, u16, u16)) {
        debug_assert!(self.depth <= DEPTH, "no chain of a system without defect is longer");
        if let Some(frame) = self.said.get_mut(self.depth) {
            *frame = said;
            self.depth = self.depth.saturating_add(1);
        }
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// Delivers an event to its net, with all that follows from it.
    pub(super) fn deliver(
        &mut self,
        event: u16,
        offered: Option<&P::Event>,
        carries: M,
        observer: &mut dyn Observer<P, M>,
    ) -> Outcome<u16> {
        self.whole(Begins::On(event), offered, carries, observer)
    }

    /// Fires the transition at this position, which can fire by itself, with all that follows from
    /// it; how many more fired, or `None` when a mailbox on the way is full and nothing has
    /// happened.
    pub(super) fn fire_whole(&mut self, at: u16, observer: &mut dyn Observer<P, M>) -> Option<u32> {
        match self.whole(Begins::With(at), None, M::default(), observer) {
            Outcome::Fired { settled, .. } => Some(settled),
            _ => None,
        }
    }

    /// The oldest in a mailbox is read and delivered; it stays where it is when that is refused.
    /// `None` when it is empty.
    pub(super) fn read_and_deliver(
        &mut self,
        mailbox: usize,
        observer: &mut dyn Observer<P, M>,
    ) -> Option<Outcome<u16>> {
        let before = (self.marking, self.clocks, self.slots);
        let (event, carries) = self.read(mailbox)?;
        let outcome = self.deliver(event, None, carries, observer);
        if let Outcome::Refused { .. } = outcome {
            (self.marking, self.clocks, self.slots) = before;
        }
        Some(outcome)
    }

    /// Does all of it or nothing; the observer is told when it is clear that no mailbox is full.
    fn whole(
        &mut self,
        begins: Begins,
        offered: Option<&P::Event>,
        carries: M,
        observer: &mut dyn Observer<P, M>,
    ) -> Outcome<u16> {
        let before = (self.marking, self.clocks, self.slots);
        let mut journal = Journal { happened: [None; REMEMBERED], count: 0 };
        let mut remember = |_: &Self, it| journal.push(it);
        match self.go(begins, &mut UnderWay::new(carries, &mut remember)) {
            Ok(outcome) if journal.count <= REMEMBERED => {
                for it in journal.happened.iter().flatten() {
                    self.show(*it, offered, carries, observer);
                }
                return outcome;
            }
            Ok(_) => {}
            Err(Full(mailbox)) => {
                (self.marking, self.clocks, self.slots) = before;
                let code = self.program.code();
                let full = code.mailboxes.get(usize::from(mailbox)).map_or(0, |it| it.event);
                return Outcome::Refused { full: code.event(full) };
            }
        }
        (self.marking, self.clocks, self.slots) = before;
        let mut tell = |it: &Self, happened| it.show(happened, offered, carries, observer);
        // No mailbox was full.
        let again = self.go(begins, &mut UnderWay::new(carries, &mut tell));
        debug_assert!(again.is_ok(), "the same happens again");
        again.unwrap_or(Outcome::Ignored { why: Why::NotEnabled })
    }

    /// Does what begins so, and all that follows from it.
    fn go(
        &mut self,
        begins: Begins,
        under_way: &mut UnderWay<'_, Self, M>,
    ) -> Result<Outcome<u16>, Full> {
        let (first, on) = match begins {
            Begins::With(at) => (Some(at), None),
            Begins::On(event) => {
                self.clear(event, under_way);
                (self.answering(event), Some(event))
            }
        };
        let Some(transition) = first.and_then(|at| self.begin(at, on, under_way)) else {
            if let Some(event) = on {
                (under_way.tell)(self, Happened::Ignored(event));
            }
            return Ok(Outcome::Ignored { why: self.why(usize::from(on.unwrap_or(NONE))) });
        };
        let mut settled = 0;
        while let Some((component, next)) = under_way.next() {
            let code = self.program.code();
            match next.map(|it| code.routes.get(usize::from(it)).copied()) {
                Some(None) => {}
                Some(Some(Route { event, mailbox: NONE })) => {
                    self.clear(event, under_way);
                    let answer = self.answering(event);
                    if answer.and_then(|at| self.begin(at, Some(event), under_way)).is_none() {
                        (under_way.tell)(self, Happened::Ignored(event));
                    }
                }
                Some(Some(Route { mailbox, .. })) => self.put(mailbox, under_way)?,
                // All that the net said has arrived: it settles.
                None => {
                    let row = code.first_urgent().saturating_add(usize::from(component));
                    let (first, end) = code.span(row..row.saturating_add(1));
                    if settled < SETTLE
                        && let Some(at) = self.enabled_from(first, end)
                    {
                        settled += 1;
                        self.begin(at, None, under_way);
                    }
                }
            }
        }
        Ok(Outcome::Fired { transition, settled: under_way.fired.saturating_sub(1) })
    }

    /// Tells the observer.
    fn show(
        &self,
        it: Happened<M>,
        offered: Option<&P::Event>,
        carries: M,
        observer: &mut dyn Observer<P, M>,
    ) {
        let (code, at) = (self.program.code(), self.now);
        match it {
            Happened::Fired(number, on) => {
                let id = code.transition(number);
                let on = on.map(|it| code.event(it));
                // The first transition fired on the event offered from outside.
                let event = offered.filter(|it| Some(super::Kind::id(*it)) == on);
                let program = &self.program;
                observer.on_fire(&Firing { id, on, event, carries, at, program });
            }
            Happened::Ignored(event) => observer.on_ignore(code.event(event), carries),
            Happened::Mailed(event) => observer.on_mail(code.event(event), carries),
            Happened::Cleared(event, carried) => observer.on_clear(code.event(event), carried),
        }
    }

    /// The position of the transition that fires on an event now.
    fn answering(&self, event: u16) -> Option<u16> {
        let row = usize::from(event);
        let (first, end) = self.program.code().span(row..row.saturating_add(1));
        self.enabled_from(first, end)
    }

    /// The position of the first transition from one position on, up to another one, that can fire
    /// now.
    pub(super) fn enabled_from(&self, first: u16, end: u16) -> Option<u16> {
        let code = self.program.code();
        (first..end).find(|&at| {
            debug_assert!(usize::from(at) < code.entries.len(), "a span of entries");
            let entry = code.entry(usize::from(at));
            entry.is_some_and(|it| self.can(code, &it) && self.open(code, &it))
        })
    }

    /// Moves the tokens of the transition at this position; what it says is then under way. Its
    /// number.
    fn begin(
        &mut self,
        at: u16,
        on: Option<u16>,
        under_way: &mut UnderWay<'_, Self, M>,
    ) -> Option<u16> {
        let number = self.apply(at)?;
        under_way.fired = under_way.fired.saturating_add(1);
        (under_way.tell)(self, Happened::Fired(number, on));
        let code = self.program.code();
        let (first, end) = bounds(code.says, usize::from(number));
        debug_assert!(first <= end && end <= code.routes.len(), "routes of the system");
        under_way.push((code.transition(number).component, first as u16, end as u16));
        Some(number)
    }

    /// Puts something into a mailbox.
    fn put(&mut self, mailbox: u16, under_way: &mut UnderWay<'_, Self, M>) -> Result<(), Full> {
        debug_assert!(usize::from(mailbox) < self.program.code().mailboxes.len(), "a mailbox");
        let Some(it) = self.program.code().mailboxes.get(usize::from(mailbox)) else {
            return Ok(());
        };
        let (it, waiting) = (*it, it.waiting.of(&self.marking));
        if waiting >= u32::from(it.capacity) {
            return Err(Full(mailbox));
        }
        debug_assert!(usize::from(it.slot) + (waiting as usize) < S, "a slot for each that waits");
        if let Some(slot) = self.slots.iter_mut().skip(usize::from(it.slot)).nth(waiting as usize) {
            *slot = under_way.carries;
        }
        self.count(&it, true);
        (under_way.tell)(self, Happened::Mailed(it.event));
        Ok(())
    }

    /// Takes the oldest out of a mailbox: its event and what it carries along.
    fn read(&mut self, mailbox: usize) -> Option<(u16, M)> {
        let it = *self.program.code().mailboxes.get(mailbox)?;
        let waiting = it.waiting.of(&self.marking) as usize;
        let slot = usize::from(it.slot);
        debug_assert!(slot + waiting <= S, "a slot for each that waits");
        let slots = self.slots.get_mut(slot..slot.checked_add(waiting)?)?;
        let oldest = *slots.first()?;
        // One place to the front each; `rotate_left` divides, and the compiler does not see that
        // never by zero.
        let mut behind = oldest;
        slots.iter_mut().rev().for_each(|slot| core::mem::swap(slot, &mut behind));
        self.count(&it, false);
        Some((it.event, oldest))
    }

    /// Moves one between what waits in a mailbox and the room in it.
    fn count(&mut self, mailbox: &Mailbox, more: bool) {
        let waiting = Some(mailbox.waiting);
        let (from, to) = if more { (mailbox.room, waiting) } else { (waiting, mailbox.room) };
        if let Some(from) = from
            && let Some(word) = self.marking.get_mut(usize::from(from.word))
        {
            *word = word.wrapping_sub(from.tokens(1));
        }
        if C > 0 {
            let left = self.marking;
            self.restart(&left);
        }
        if let Some(to) = to
            && let Some(word) = self.marking.get_mut(usize::from(to.word))
        {
            *word = word.wrapping_add(to.tokens(1));
        }
        debug_assert!(self.fits(&self.marking), "a mailbox holds no more than it can");
    }

    /// Empties the mailboxes that an event empties.
    fn clear(&mut self, event: u16, under_way: &mut UnderWay<'_, Self, M>) {
        for at in 0..self.program.code().clears.len() {
            let Some(&(on, mailbox)) = self.program.code().clears.get(at) else { return };
            if on == event {
                while let Some((emptied, carried)) = self.read(usize::from(mailbox)) {
                    (under_way.tell)(self, Happened::Cleared(emptied, carried));
                }
            }
        }
    }
}
