//! The clocks of a player: the time it was told, and how long transitions with an interval have
//! been enabled.

use super::code::{Code, Entry, NONE, minus, plus};
use super::player::Player;
use super::program::Program;
use cotama_units::units::Millis;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// The time it was last told.
    pub const fn now(&self) -> Millis {
        self.now
    }

    /// Returns how far this time lies before the one last told; `None` when it does not. Asked
    /// before [`offer`](Self::offer) or [`advance`](Self::advance), it shows a clock that went
    /// back: for the player, time stands still until the clock has caught up.
    ///
    /// ```
    /// use cotama_core::{net, units::Millis};
    /// net! { mod egg { places { Raw: 1, Hard } transitions { boil: Raw => Hard after 300 ms; } } }
    /// let mut egg = egg::Player::new();
    /// assert_eq!(egg.advance(Millis(200)).fired, 0);
    /// assert_eq!(egg.clock_went_back(Millis(50)), Some(Millis(150)));
    /// assert_eq!(egg.advance(Millis(50)).fired, 0); // still at 200 ms
    /// assert_eq!((egg.now(), egg.wake_at()), (Millis(200), Some(Millis(300))));
    /// assert_eq!(egg.clock_went_back(Millis(200)), None);
    /// ```
    #[must_use]
    pub const fn clock_went_back(&self, now: Millis) -> Option<Millis> {
        match self.now.checked_sub(now) {
            Some(Millis::ZERO) | None => None,
            back => back,
        }
    }

    /// Moves the tokens of the transition at a position; its number.
    #[inline]
    pub(super) fn apply(&mut self, at: u16) -> Option<u16> {
        let code = self.program.code();
        let entry = code.entry(usize::from(at))?;
        let (number, clock) = (entry.transition, entry.clock);
        let after = plus(&self.marking, entry.delta);
        debug_assert!(self.fits(&after), "a transition that fires keeps every bound");
        if C > 0
            && let Some(take) = code.takes.get(usize::from(number))
        {
            let left = minus(&self.marking, take);
            self.restart(&left);
            if let Some(elapsed) = self.clocks.get_mut(usize::from(clock)) {
                *elapsed = 0;
            }
        }
        self.marking = after;
        Some(number)
    }

    /// Whether no place holds more than it can. For a program loaded at run time that is said to be
    /// bounded, the proof is its caller's.
    pub(super) fn fits(&self, marking: &[u64; W]) -> bool {
        let code = self.program.code();
        if P::ALONE.is_none() && code.bounded {
            return true;
        }
        let clear = |(guards, word): (&u64, &u64)| word & guards == 0;
        code.guards.iter().zip(marking).all(clear) && code.holds(&code.bounds, marking)
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

    /// Whether the interval of a transition allows it to fire now.
    #[inline]
    pub(super) fn open(&self, code: &Code<'_, W>, entry: &Entry<'_, W>) -> bool {
        if C == 0 || entry.clock == NONE {
            return true;
        }
        let clock = usize::from(entry.clock);
        match (code.clocks.get(clock), self.clocks.get(clock)) {
            (Some(clock), Some(&elapsed)) => clock.is_open(elapsed),
            _ => true,
        }
    }

    /// How long the transition without event that is due first has to wait, and its position; of
    /// those that are not refused.
    #[inline]
    pub(super) fn due(&self, refused: &[bool; C]) -> Option<(u32, u16)> {
        if C == 0 {
            return None;
        }
        let code = self.program.code();
        let mut first: Option<(u32, u16)> = None;
        let (start, end) = code.row(code.timed(), &self.marking)?;
        // In their order, so that of several due at one instant the first one goes first.
        for at in start..end {
            let entry = code.entry(usize::from(at))?;
            let number = usize::from(entry.clock);
            debug_assert!(number < C && number < code.clocks.len(), "it waits for an instant");
            let (Some(clock), Some(&elapsed)) = (code.clocks.get(number), self.clocks.get(number))
            else {
                continue;
            };
            if S > 0 && refused.get(number) == Some(&true) {
                continue;
            }
            let waits = clock.earliest.saturating_sub(elapsed);
            if first.is_none_or(|(least, _)| waits < least) && self.can(code, &entry) {
                first = Some((waits, at));
            }
        }
        first
    }

    /// How long until an event may find another answer, because the interval of a transition on it
    /// begins or is over: when within `left`, and something that could fire by itself waits for
    /// room in a mailbox. Then it may do without.
    pub(super) fn retry(&self, refused: &[bool; C], left: u64) -> Option<u32> {
        let code = self.program.code();
        if C == 0 || S == 0 || !refused.contains(&true) && self.settled(code) {
            return None;
        }
        let changes = self.clocks.iter().zip(code.clocks).filter_map(|(&elapsed, clock)| {
            let runs = clock.event && code.holds(&self.marking, &clock.need);
            let ends = [clock.earliest, clock.cap()].into_iter().filter(|&end| end > elapsed).min();
            ends.filter(|_| runs).map(|end| end.saturating_sub(elapsed))
        });
        let first = changes.min()?;
        let due = self.due(refused).map_or(u32::MAX, |it| it.0);
        (first <= due && u64::from(first) <= left).then_some(first)
    }
}
