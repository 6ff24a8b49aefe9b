//! Runs a system.
//!
//! **An offered event** from outside reaches its net at once. A transition fires; what it emits
//! *now* makes the receivers fire in the same step, one after the other and depth first; what it
//! *mails* waits. Then the net settles. All of it happens or nothing: when a mailbox on the way is
//! full, the event is [refused](Offered::Refused) and the system is as it was.
//!
//! **A round** gives each net its turn, in the order of the system. At its turn a net settles, then
//! reads its mailboxes in the order in which its events are listed, each as far as it was filled
//! when the turn began. What it reads makes a transition fire, or is ignored for good, or, when a
//! mailbox is full, goes on waiting.
//!
//! **Time** is as in [`net::Player`](crate::net::Player), over the transitions of all nets.
//!
//! What an event carries along, of type `M`, travels with everything that is emitted because of it.

use super::code::{Clock, Code, Entry, Mailbox, NONE};
use super::data::{DEPTH, Of};
use super::happening::{Happening, Offered, Turned, Witness};
use crate::net::{EventId, Kind, PlaceId, TransitionId};
use crate::units::Millis;

/// The most transitions that fire at once by themselves one after another in one net.
pub const SETTLE: u32 = 1_000;
/// The most transitions that one call lets fire by themselves while it catches up.
pub const CATCH_UP: u32 = 10_000;

/// A packed system.
pub trait Program<const W: usize> {
    /// The packed system.
    fn code(&self) -> Code<'_, W>;
}

impl<const W: usize> Program<W> for Code<'_, W> {
    fn code(&self) -> Code<'_, W> {
        *self
    }
}

/// A marking of all nets and mailboxes of a system, its clocks, and the time.
///
/// `W` is the number of words of the marking, `C` that of transitions with an interval, `S` that of
/// all that can wait in mailboxes, and `M` is what events carry along; `system!` names the type
/// with these as `Player`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Player<P, M, const W: usize, const C: usize, const S: usize> {
    program: P,
    marking: [u64; W],
    clocks: [u32; C],
    slots: [M; S],
    now: Millis,
}

/// A mailbox on the way is full.
struct Full(u16);

impl<P: Program<W>, M: Copy + Default, const W: usize, const C: usize, const S: usize>
    Player<P, M, W, C, S>
{
    /// The system as it starts, at this time, settled.
    pub fn start(program: P, now: Millis, witness: &mut impl Witness<M>) -> Self {
        let marking = program.code().initial;
        let mut player = Self { program, marking, clocks: [0; C], slots: [M::default(); S], now };
        for component in 0..player.components() {
            player.settle(component, witness);
        }
        player
    }

    /// Offers an event to a component, from outside, at `now`, with what it carries along.
    pub fn offer(
        &mut self,
        now: Millis,
        event: Of<EventId>,
        carries: M,
        witness: &mut impl Witness<M>,
    ) -> Offered {
        if C > 0 && self.advance(now, witness).behind {
            return Offered::NotNow;
        }
        match self.number(event) {
            Some(number) => self.deliver(number, carries, witness),
            None => Offered::NotNow,
        }
    }

    /// One round at `now`: every net takes its turn.
    pub fn round(&mut self, now: Millis, witness: &mut impl Witness<M>) -> Turned {
        let mut turned = Turned::default();
        if C > 0 && self.advance(now, witness).behind {
            return turned;
        }
        for component in 0..self.components() {
            self.turn(component, &mut turned, witness);
        }
        turned
    }

    /// One net takes its turn.
    fn turn(&mut self, component: u16, turned: &mut Turned, witness: &mut impl Witness<M>) {
        self.settle(component, witness);
        let code = self.program.code();
        let boxes = bounds(code.turns, component);
        for at in boxes {
            let waiting =
                self.program.code().mailboxes.get(at).map_or(0, |it| it.waiting.of(&self.marking));
            for _ in 0..waiting {
                let before = (self.marking, self.clocks, self.slots);
                let Some((event, carries)) = self.read(at) else { break };
                let count = match self.deliver(event, carries, witness) {
                    Offered::Fired(_) => &mut turned.fired,
                    Offered::Ignored | Offered::NotNow => &mut turned.ignored,
                    Offered::Refused { .. } => {
                        (self.marking, self.clocks, self.slots) = before;
                        turned.waiting = turned.waiting.saturating_add(1);
                        break;
                    }
                };
                *count = count.saturating_add(1);
            }
        }
    }

    /// Lets time pass up to `now`: transitions without event fire when they are due. One that is
    /// due while a mailbox that it mails to is full waits until there is room.
    pub fn advance(&mut self, now: Millis, witness: &mut impl Witness<M>) -> crate::net::Advanced {
        let mut advanced = crate::net::Advanced::default();
        let mut refused = [false; C];
        loop {
            let left = now.0.saturating_sub(self.now.0);
            let (wait, at) = match self.due(&refused) {
                Some((wait, at)) if u64::from(wait) <= left => (wait, at),
                _ => {
                    self.pass(left);
                    return advanced;
                }
            };
            if advanced.fired >= CATCH_UP {
                advanced.behind = true;
                return advanced;
            }
            self.pass(u64::from(wait));
            let fired =
                self.whole(witness, |player, witness| player.fire(at, None, M::default(), witness));
            if fired.is_ok() {
                advanced.fired += 1;
                refused = [false; C];
            } else {
                let entry = self
                    .program
                    .code()
                    .entries
                    .get(usize::from(at))
                    .map_or(NONE, |entry| entry.clock);
                if let Some(refused) = refused.get_mut(usize::from(entry)) {
                    *refused = true;
                }
            }
        }
    }

    /// When it wants to be told the time: the instant at which the next transition is due by
    /// itself.
    pub fn wake_at(&self) -> Option<Millis> {
        let (wait, _) = self.due(&[false; C])?;
        Some(Millis(self.now.0.saturating_add(u64::from(wait))))
    }

    /// The tokens of a place of a component.
    pub fn tokens(&self, place: Of<PlaceId>) -> u32 {
        let code = self.program.code();
        let at = bounds(code.places, place.component).nth(place.id.0 as usize);
        at.and_then(|at| code.fields.get(at)).map_or(0, |field| field.of(&self.marking))
    }

    /// How many wait in the mailbox of an event; zero when it has none.
    pub fn waiting(&self, event: Of<EventId>) -> u32 {
        let number = self.number(event);
        let mut boxes = self.program.code().mailboxes.iter();
        boxes.find(|it| Some(it.event) == number).map_or(0, |it| it.waiting.of(&self.marking))
    }

    /// The packed marking of all nets and mailboxes.
    pub const fn marking(&self) -> &[u64; W] {
        &self.marking
    }

    /// The time it was last told.
    pub const fn now(&self) -> Millis {
        self.now
    }

    fn components(&self) -> u16 {
        (self.program.code().turns.len() as u16).saturating_sub(1)
    }

    /// The number of an event, counted over all nets.
    fn number(&self, event: Of<EventId>) -> Option<u16> {
        bounds(self.program.code().events, event.component)
            .nth(event.id.0 as usize)
            .map(|it| it as u16)
    }

    /// The component and event of a number.
    fn event(&self, number: u16) -> Of<EventId> {
        let firsts = self.program.code().events;
        let component = firsts.partition_point(|&first| first <= number).saturating_sub(1);
        let first = firsts.get(component).copied().unwrap_or(0);
        Of { component: component as u16, id: EventId(u32::from(number.saturating_sub(first))) }
    }

    /// Does all of it or nothing: once unseen, and when no mailbox was full, once more and seen.
    fn whole<T, V: Witness<M>>(
        &mut self,
        witness: &mut V,
        act: impl Fn(&mut Self, &mut dyn Witness<M>) -> Result<T, Full>,
    ) -> Result<T, Full> {
        let before = (self.marking, self.clocks, self.slots);
        let tried = act(self, &mut ());
        (self.marking, self.clocks, self.slots) = before;
        tried?;
        act(self, witness)
    }

    /// Delivers an event to its net, with all that follows from it.
    fn deliver(&mut self, number: u16, carries: M, witness: &mut impl Witness<M>) -> Offered {
        let result = self.whole(witness, |player, witness| {
            player.clear(number, witness);
            let Some(at) = player.enabled(number) else {
                witness.see(&Happening::Ignored { event: player.event(number), carries });
                return Ok(Offered::Ignored);
            };
            let entry = player.program.code().entries.get(usize::from(at)).copied();
            player.fire(at, Some(number), carries, witness)?;
            Ok(entry.map_or(Offered::NotNow, |entry| Offered::Fired(entry.id())))
        });
        result.unwrap_or_else(|Full(mailbox)| {
            let full =
                self.program.code().mailboxes.get(usize::from(mailbox)).map_or(0, |it| it.event);
            Offered::Refused { full: self.event(full) }
        })
    }

    /// Lets a net settle; stops where a mailbox is full.
    fn settle(&mut self, component: u16, witness: &mut impl Witness<M>) {
        for _ in 0..SETTLE {
            let Some(at) = self.enabled(self.urgent(component)) else { return };
            if self
                .whole(witness, |player, witness| player.fire(at, None, M::default(), witness))
                .is_err()
            {
                return;
            }
        }
    }

    /// The row of what fires at once by itself in a component.
    fn urgent(&self, component: u16) -> u16 {
        self.program.code().events.last().copied().unwrap_or(0).saturating_add(component)
    }

    /// The first transition of a row that can fire now.
    fn enabled(&self, row: u16) -> Option<u16> {
        let code = self.program.code();
        bounds(code.rows, row)
            .find(|&at| {
                code.entries
                    .get(at)
                    .is_some_and(|entry| self.can(&code, entry) && self.open(&code, entry))
            })
            .map(|at| at as u16)
    }

    fn can(&self, code: &Code<'_, W>, entry: &Entry<W>) -> bool {
        code.holds(&self.marking, &entry.need)
            && code.holds(&code.bounds, &sum(&self.marking, &entry.delta))
    }

    fn open(&self, code: &Code<'_, W>, entry: &Entry<W>) -> bool {
        let clock = usize::from(entry.clock);
        match (code.clocks.get(clock), self.clocks.get(clock)) {
            (Some(clock), Some(&elapsed)) => {
                clock.earliest <= elapsed
                    && (!clock.event || clock.latest == u32::MAX || elapsed <= clock.latest)
            }
            _ => true,
        }
    }

    /// Fires a transition that is enabled, and does all that follows from it.
    fn fire(
        &mut self,
        at: u16,
        on: Option<u16>,
        carries: M,
        witness: &mut dyn Witness<M>,
    ) -> Result<(), Full> {
        // Where the outputs of the transition of each net under way have come to, and where they
        // end.
        let mut under_way = [(0_u16, 0_u16, 0_u16); DEPTH + 1];
        let mut depth = 0;
        let mut settled = 0;
        self.step(at, on, carries, witness, &mut under_way, &mut depth);
        while let Some(frame) = depth.checked_sub(1).and_then(|top| under_way.get_mut(top)) {
            let (component, next, end) = *frame;
            if next < end {
                frame.1 += 1;
                let Some(route) = self.program.code().routes.get(usize::from(next)).copied() else {
                    continue;
                };
                if route.mailbox != NONE {
                    self.put(route.mailbox, carries, witness)?;
                    continue;
                }
                self.clear(route.event, witness);
                match self.enabled(route.event) {
                    Some(at) => {
                        self.step(
                            at,
                            Some(route.event),
                            carries,
                            witness,
                            &mut under_way,
                            &mut depth,
                        );
                    }
                    None => {
                        witness.see(&Happening::Ignored { event: self.event(route.event), carries })
                    }
                }
            } else {
                depth -= 1;
                // All that the net said has arrived: it settles.
                if settled < SETTLE
                    && let Some(at) = self.enabled(self.urgent(component))
                {
                    settled += 1;
                    self.step(at, None, carries, witness, &mut under_way, &mut depth);
                }
            }
        }
        Ok(())
    }

    /// Moves the tokens of a transition; what it says is then under way.
    fn step(
        &mut self,
        at: u16,
        on: Option<u16>,
        carries: M,
        witness: &mut dyn Witness<M>,
        under_way: &mut [(u16, u16, u16); DEPTH + 1],
        depth: &mut usize,
    ) {
        let Some(entry) = self.program.code().entries.get(usize::from(at)).copied() else { return };
        // Clocks ask what was there between taking and giving; without clocks nothing is listed.
        let between =
            self.program.code().takes.get(usize::from(at)).map(|it| difference(&self.marking, it));
        self.marking = sum(&self.marking, &entry.delta);
        if let Some(between) = between {
            self.restart(&between, entry.clock);
        }
        let on = on.map(|on| self.event(on));
        witness.see(&Happening::Fired { transition: entry.id(), on, carries, at: self.now });
        if let Some(frame) = under_way.get_mut(*depth) {
            *frame = (entry.component, entry.routes.0, entry.routes.1);
            *depth += 1;
        }
    }

    /// Starts clocks anew of transitions that are disabled, or were in between, and of the one that
    /// fired.
    fn restart(&mut self, between: &[u64; W], fired: u16) {
        if C == 0 {
            return;
        }
        let code = self.program.code();
        for (number, (elapsed, clock)) in (0_u16..).zip(self.clocks.iter_mut().zip(code.clocks)) {
            let enabled = code.entries.get(usize::from(clock.entry)).is_some_and(|entry| {
                code.holds(&self.marking, &entry.need) && code.holds(between, &entry.need)
            });
            if !enabled || number == fired {
                *elapsed = 0;
            }
        }
    }

    /// Puts something into a mailbox.
    fn put(&mut self, mailbox: u16, carries: M, witness: &mut dyn Witness<M>) -> Result<(), Full> {
        let Some(it) = self.program.code().mailboxes.get(usize::from(mailbox)).copied() else {
            return Ok(());
        };
        let waiting = it.waiting.of(&self.marking);
        if waiting >= u32::from(it.capacity) {
            return Err(Full(mailbox));
        }
        if let Some(slot) = self.slots.iter_mut().skip(usize::from(it.slot)).nth(waiting as usize) {
            *slot = carries;
        }
        self.count(&it, true);
        witness.see(&Happening::Mailed { to: self.event(it.event), carries });
        Ok(())
    }

    /// Takes the oldest out of a mailbox: its event and what it carries along.
    fn read(&mut self, mailbox: usize) -> Option<(u16, M)> {
        let it = self.program.code().mailboxes.get(mailbox).copied()?;
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
        if let Some(word) = self.marking.get_mut(usize::from(from.word)) {
            *word = word.wrapping_sub(from.tokens(1));
        }
        if let Some(word) = self.marking.get_mut(usize::from(to.word)) {
            *word = word.wrapping_add(to.tokens(1));
        }
        let marking = self.marking;
        self.restart(&marking, NONE);
    }

    /// Empties the mailboxes that an event empties.
    fn clear(&mut self, event: u16, witness: &mut dyn Witness<M>) {
        for at in 0..self.program.code().clears.len() {
            let Some(&(on, mailbox)) = self.program.code().clears.get(at) else { return };
            if on == event {
                while let Some((emptied, carries)) = self.read(usize::from(mailbox)) {
                    witness.see(&Happening::Cleared { mailbox: self.event(emptied), carries });
                }
            }
        }
    }

    /// The transition without event that is due first, and how long it has to wait.
    fn due(&self, refused: &[bool; C]) -> Option<(u32, u16)> {
        let code = self.program.code();
        let row = code.rows.len().checked_sub(2)? as u16;
        let mut first: Option<(u32, u16)> = None;
        for at in bounds(code.rows, row) {
            let Some(entry) = code.entries.get(at) else { continue };
            let number = usize::from(entry.clock);
            let (Some(clock), Some(&elapsed)) = (code.clocks.get(number), self.clocks.get(number))
            else {
                continue;
            };
            let waits = clock.earliest.saturating_sub(elapsed);
            let blocked = refused.get(number).copied().unwrap_or(false);
            if !blocked && first.is_none_or(|(least, _)| waits < least) && self.can(&code, entry) {
                first = Some((waits, at as u16));
            }
        }
        first
    }

    /// Lets time pass for the clocks alone.
    fn pass(&mut self, time: u64) {
        self.now.0 = self.now.0.saturating_add(time);
        let code = self.program.code();
        let time = u32::try_from(time).unwrap_or(u32::MAX);
        for (elapsed, clock) in self.clocks.iter_mut().zip(code.clocks) {
            let entry = code.entries.get(usize::from(clock.entry));
            if entry.is_some_and(|entry| code.holds(&self.marking, &entry.need)) {
                *elapsed = elapsed.saturating_add(time).min(cap(clock));
            }
        }
    }
}

impl<P: Program<W> + Default, M: Copy + Default, const W: usize, const C: usize, const S: usize>
    Player<P, M, W, C, S>
{
    /// The system as it starts, at time zero, settled.
    pub fn new() -> Self {
        Self::start(P::default(), Millis(0), &mut ())
    }
}

impl<P: Program<W> + Default, M: Copy + Default, const W: usize, const C: usize, const S: usize>
    Default for Player<P, M, W, C, S>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const W: usize> Entry<W> {
    /// Its component and transition.
    pub const fn id(&self) -> Of<TransitionId> {
        Of { component: self.component, id: TransitionId(self.transition as u32) }
    }
}

impl<const W: usize> Code<'_, W> {
    /// Whether these tokens are there.
    #[inline]
    pub fn holds(&self, marking: &[u64; W], need: &[u64; W]) -> bool {
        let words = marking.iter().zip(need).zip(&self.guards);
        words.fold(true, |held, ((has, need), guards)| {
            held & ((has | guards).wrapping_sub(*need) & guards == *guards)
        })
    }
}

/// The time beyond which it makes no difference how long a transition has been enabled.
const fn cap(clock: &Clock) -> u32 {
    if clock.latest == u32::MAX { clock.earliest } else { clock.latest + 1 }
}

/// From the `at`-th of these numbers up to the next one.
fn bounds(firsts: &[u16], at: u16) -> core::ops::Range<usize> {
    match (firsts.get(usize::from(at)), firsts.get(usize::from(at) + 1)) {
        (Some(&first), Some(&next)) => usize::from(first)..usize::from(next),
        _ => 0..0,
    }
}

fn sum<const W: usize>(marking: &[u64; W], delta: &[u64; W]) -> [u64; W] {
    let mut sum = *marking;
    sum.iter_mut().zip(delta).for_each(|(word, delta)| *word = word.wrapping_add(*delta));
    sum
}

fn difference<const W: usize>(marking: &[u64; W], take: &[u64; W]) -> [u64; W] {
    let mut left = *marking;
    left.iter_mut().zip(take).for_each(|(word, take)| *word = word.wrapping_sub(*take));
    left
}

/// An event of a component that `system!` named.
pub fn event(component: u16, event: &impl Kind) -> Of<EventId> {
    Of { component, id: event.id() }
}
