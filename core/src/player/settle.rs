//! What fires at once by itself.

use super::code::{Code, Entry};
use super::observer::Observer;
use super::player::Player;
use super::program::Program;
use core::ops::Range;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// Whether nothing fires at once by itself.
    pub(super) fn settled(&self, code: &Code<'_, W>) -> bool {
        let kinds = code.first_urgent()..code.timed();
        code.rests(&self.marking) || self.urgent(code, kinds, 0).is_none()
    }

    /// Whether settling stopped before its end, having let so many transitions fire.
    pub(super) fn is_cut_short(&self, fired: u32) -> bool {
        let code = self.program.code();
        !(P::ALONE && code.bounded) && fired >= code.settle && !self.settled(&code)
    }

    /// The position, at or after `from`, and the transition of these kinds that fires next at once
    /// by itself.
    #[inline]
    fn urgent<'c>(
        &self,
        code: &Code<'c, W>,
        kinds: Range<usize>,
        from: usize,
    ) -> Option<(usize, &'c Entry<W>)> {
        if Self::is_alone(code) {
            let entry = code.first(kinds.start, &self.marking, |it| self.can(code, it));
            return entry.map(|it| (0, it));
        }
        let entries = code.kinds(kinds).iter().enumerate().skip(from);
        let mut enabled = entries.filter(|it| self.can(code, it.1));
        enabled.next()
    }

    /// Lets all nets settle; how many transitions fired.
    #[inline]
    pub(super) fn rest(&mut self, observer: &mut impl Observer<P, M>) -> u32 {
        let code = self.program.code();
        self.settle(code.first_urgent()..code.timed(), M::default(), observer)
    }

    /// Lets transitions of these kinds, without event and interval, fire until none is enabled that
    /// is not waiting for room in a mailbox; how many did, with what followed. In a net alone they
    /// carry this along.
    #[inline]
    pub(super) fn settle(
        &mut self,
        kinds: Range<usize>,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> u32 {
        let (mut fired, mut from) = (0_u32, 0);
        while fired < self.program.code().settle {
            let code = self.program.code();
            if code.rests(&self.marking) {
                break;
            }
            let Some((at, &entry)) = self.urgent(&code, kinds.clone(), from) else { break };
            match self.fire_by_itself(&entry, carries, observer) {
                Some(more) => (fired, from) = (fired.saturating_add(1).saturating_add(more), 0),
                None => from = at.saturating_add(1),
            }
        }
        fired
    }

    /// Fires a transition that can fire by itself, with what follows from it; how many more fired,
    /// or `None` when a mailbox on the way is full and nothing has happened.
    #[inline]
    pub(super) fn fire_by_itself(
        &mut self,
        entry: &Entry<W>,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Option<u32> {
        if Self::is_alone(&self.program.code()) {
            self.fire_alone(entry, None, None, carries, observer);
            return Some(0);
        }
        self.fire_whole(entry, observer)
    }
}
