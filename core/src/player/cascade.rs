//! What follows from a firing in a system: rendezvous and mailboxes, all of it or nothing.

use super::SETTLE;
use super::code::{Entry, Mailbox, NONE, bounds, minus};
use super::observer::{Firing, Observer};
use super::outcome::Outcome;
use super::player::Player;
use super::program::Program;
use crate::system::data::DEPTH;

/// A mailbox on the way is full: its position.
struct Full(u16);

/// What happens inside. Events and transitions are told by their numbers.
#[derive(Clone, Copy)]
enum Happened<M> {
    /// A transition fired, on this event or by itself.
    Fired(u16, Option<u16>),
    Ignored(u16),
    Mailed(u16),
    /// With what was in the mailbox.
    Cleared(u16, M),
}

/// The most happenings that are remembered until it is clear that no mailbox is full. After more of
/// them everything is done once more.
const REMEMBERED: usize = 16;

/// What has happened so far, for the observer.
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

/// What is under way in the player `L`.
struct UnderWay<'w, L, M> {
    carries: M,
    /// Is told what happens.
    tell: &'w mut dyn FnMut(&L, Happened<M>),
    /// Of each net under way: which one, where the outputs of its transition have come to in the
    /// routes, and where they end.
    said: [(u16, u16, u16); DEPTH + 1],
    depth: usize,
    fired: u32,
}

impl<'w, L, M> UnderWay<'w, L, M> {
    fn new(carries: M, tell: &'w mut dyn FnMut(&L, Happened<M>)) -> Self {
        Self { carries, tell, said: [(0, 0, 0); DEPTH + 1], depth: 0, fired: 0 }
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
        let outcome = self.whole(offered, carries, observer, &|player, under_way| {
            player.clear(event, under_way);
            let Some(entry) = player.answering(event) else {
                let why = player.why(usize::from(event));
                (under_way.tell)(player, Happened::Ignored(event));
                return Ok(Outcome::Ignored { why });
            };
            player.fire(&entry, Some(event), under_way)?;
            let settled = under_way.fired.saturating_sub(1);
            Ok(Outcome::Fired { transition: entry.transition, settled })
        });
        outcome.unwrap_or_else(|Full(mailbox)| {
            let code = self.program.code();
            let full = code.mailboxes.get(usize::from(mailbox)).map_or(0, |it| it.event);
            Outcome::Refused { full: code.event(full) }
        })
    }

    /// Fires a transition that can fire by itself, with all that follows from it; how many more
    /// fired, or `None` when a mailbox on the way is full and nothing has happened.
    pub(super) fn fire_whole(
        &mut self,
        entry: &Entry<W>,
        observer: &mut dyn Observer<P, M>,
    ) -> Option<u32> {
        let fired = self.whole(None, M::default(), observer, &|player, under_way| {
            player.fire(entry, None, under_way)?;
            Ok(under_way.fired.saturating_sub(1))
        });
        fired.ok()
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
    fn whole<T>(
        &mut self,
        offered: Option<&P::Event>,
        carries: M,
        observer: &mut dyn Observer<P, M>,
        act: &dyn Fn(&mut Self, &mut UnderWay<'_, Self, M>) -> Result<T, Full>,
    ) -> Result<T, Full> {
        let before = (self.marking, self.clocks, self.slots);
        let mut journal = Journal { happened: [None; REMEMBERED], count: 0 };
        let done = act(self, &mut UnderWay::new(carries, &mut |_, it| journal.push(it)));
        if done.is_ok() && journal.count <= REMEMBERED {
            for it in journal.happened.iter().flatten() {
                self.show(*it, offered, carries, observer);
            }
            return done;
        }
        (self.marking, self.clocks, self.slots) = before;
        done?;
        let mut tell = |it: &Self, happened| it.show(happened, offered, carries, observer);
        act(self, &mut UnderWay::new(carries, &mut tell))
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
                // What was offered from outside is what the first transition fired on.
                let event = offered.filter(|it| Some(super::Kind::id(*it)) == on);
                let (transition, program) = (self.program.transition(id), &self.program);
                observer.on_fire(&Firing { transition, id, on, event, carries, at, program });
            }
            Happened::Ignored(event) => observer.on_ignore(code.event(event), carries),
            Happened::Mailed(event) => observer.on_mail(code.event(event), carries),
            Happened::Cleared(event, carried) => observer.on_clear(code.event(event), carried),
        }
    }

    /// The transition that fires on an event now.
    #[inline]
    fn answering(&self, event: u16) -> Option<Entry<W>> {
        let code = self.program.code();
        let can = |it: &Entry<W>| self.can(&code, it) && self.open(&code, it);
        code.first(usize::from(event), &self.marking, can).copied()
    }

    /// Fires a transition that is enabled, and does all that follows from it.
    fn fire(
        &mut self,
        entry: &Entry<W>,
        on: Option<u16>,
        under_way: &mut UnderWay<'_, Self, M>,
    ) -> Result<(), Full> {
        let mut settled = 0;
        self.begin(entry, on, under_way);
        while let Some(frame) =
            under_way.depth.checked_sub(1).and_then(|top| under_way.said.get_mut(top))
        {
            let (component, next, end) = *frame;
            let code = self.program.code();
            if next < end {
                frame.1 = next.saturating_add(1);
                let Some(&route) = code.routes.get(usize::from(next)) else { continue };
                if route.mailbox != NONE {
                    self.put(route.mailbox, under_way)?;
                    continue;
                }
                self.clear(route.event, under_way);
                match self.answering(route.event) {
                    Some(entry) => self.begin(&entry, Some(route.event), under_way),
                    None => (under_way.tell)(self, Happened::Ignored(route.event)),
                }
            } else {
                under_way.depth = under_way.depth.saturating_sub(1);
                // All that the net said has arrived: it settles.
                let row = code.first_urgent().saturating_add(usize::from(component));
                let can = |it: &Entry<W>| self.can(&code, it);
                if settled < SETTLE
                    && let Some(entry) = code.first(row, &self.marking, can).copied()
                {
                    settled += 1;
                    self.begin(&entry, None, under_way);
                }
            }
        }
        Ok(())
    }

    /// Moves the tokens of a transition; what it says is then under way.
    fn begin(&mut self, entry: &Entry<W>, on: Option<u16>, under_way: &mut UnderWay<'_, Self, M>) {
        self.apply(entry);
        under_way.fired = under_way.fired.saturating_add(1);
        (under_way.tell)(self, Happened::Fired(entry.transition, on));
        let code = self.program.code();
        let component = code.transition(entry.transition).component;
        let (first, end) = bounds(code.says, usize::from(entry.transition));
        if let Some(frame) = under_way.said.get_mut(under_way.depth) {
            *frame = (component, first as u16, end as u16);
            under_way.depth = under_way.depth.saturating_add(1);
        }
    }

    /// Puts something into a mailbox.
    fn put(&mut self, mailbox: u16, under_way: &mut UnderWay<'_, Self, M>) -> Result<(), Full> {
        let Some(it) = self.program.code().mailboxes.get(usize::from(mailbox)) else {
            return Ok(());
        };
        let (it, waiting) = (*it, it.waiting.of(&self.marking));
        if waiting >= u32::from(it.capacity) {
            return Err(Full(mailbox));
        }
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
        let (from, to) =
            if more { (mailbox.room, mailbox.waiting) } else { (mailbox.waiting, mailbox.room) };
        let mut take = [0; W];
        if let Some(word) = take.get_mut(usize::from(from.word)) {
            *word = from.tokens(1);
        }
        let left = minus(&self.marking, &take);
        if C > 0 {
            self.restart(&left);
        }
        self.marking = left;
        if let Some(word) = self.marking.get_mut(usize::from(to.word)) {
            *word = word.wrapping_add(to.tokens(1));
        }
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
