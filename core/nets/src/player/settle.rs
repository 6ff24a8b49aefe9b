//! Settling: transitions that fire at once by themselves.

use super::code::Code;
use super::observer::{Firing, Observer};
use super::player::Player;
use super::program::Program;
use crate::net::data::EventId;
use crate::system::data::Of;
use core::ops::Range;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// Whether a net that is proven to settle has done so.
    pub(super) fn settled_if_proven(&self) -> bool {
        let code = self.program.code();
        !(Self::ALONE && Self::bounded(code)) || self.settled(code)
    }

    /// Whether nothing fires at once by itself.
    pub(super) fn settled(&self, code: &Code<'_, W>) -> bool {
        if code.rests(&self.marking) {
            return true;
        }
        if Self::is_alone(code) {
            return self.urgent(code).is_none();
        }
        let (first, end) = code.span(code.first_urgent()..code.timed());
        self.enabled_from(first, end).is_none()
    }

    /// Whether settling stopped before its end, having let so many transitions fire.
    pub(super) fn is_cut_short(&self, fired: u32) -> bool {
        let code = self.program.code();
        !(Self::ALONE && Self::bounded(code)) && fired >= Self::longest(code) && !self.settled(code)
    }

    /// The position of the transition of a net alone that fires next at once by itself.
    #[inline]
    fn urgent(&self, code: &Code<'_, W>) -> Option<u16> {
        code.first(code.first_urgent(), &self.marking, |it| self.can(code, it))
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
        if Self::is_alone(self.program.code()) {
            let mut fired = 0_u32;
            while fired < Self::longest(self.program.code()) {
                let code = self.program.code();
                if code.rests(&self.marking) {
                    break;
                }
                let Some(at) = self.urgent(code) else { break };
                self.fire_alone(at, None, None, carries, observer);
                fired = fired.saturating_add(1);
            }
            debug_assert!(self.settled_if_proven(), "it settles within the steps that are proven");
            return fired;
        }
        self.settle_nets(kinds, observer)
    }

    /// The same of a system of several nets.
    fn settle_nets(&mut self, kinds: Range<usize>, observer: &mut impl Observer<P, M>) -> u32 {
        let (first, end) = self.program.code().span(kinds);
        let (mut fired, mut from) = (0_u32, first);
        while fired < Self::longest(self.program.code())
            && !self.program.code().rests(&self.marking)
        {
            let Some(at) = self.enabled_from(from, end) else { break };
            match self.fire_whole(at, observer) {
                Some(more) => (fired, from) = (fired.saturating_add(1).saturating_add(more), first),
                None => from = at.saturating_add(1),
            }
        }
        fired
    }

    /// Fires the transition at this position of a net alone; its number.
    #[inline]
    pub(super) fn fire_alone(
        &mut self,
        at: u16,
        on: Option<Of<EventId>>,
        event: Option<&P::Event>,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Option<u16> {
        let number = self.apply(at)?;
        let id = self.program.code().transition(number);
        let (program, at) = (&self.program, self.now);
        observer.on_fire(&Firing { id, on, event, carries, at, program });
        Some(number)
    }

    /// Fires the transition at this position, which is due, with what follows from it; how many
    /// more fired, or `None` when a mailbox on the way is full and nothing has happened.
    #[inline]
    pub(super) fn fire_due(&mut self, at: u16, observer: &mut impl Observer<P, M>) -> Option<u32> {
        if Self::is_alone(self.program.code()) {
            return self.fire_alone(at, None, None, M::default(), observer).map(|_| 0);
        }
        self.fire_whole(at, observer)
    }
}
