//! A marking, and which transitions are enabled in it, kept up to date from firing to firing.

use super::tally::Overflow;
use crate::streams::Stream;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;

/// A run among markings that are not remembered.
pub(super) struct Walk<'n> {
    net: &'n Pt,
    marking: Vec<u32>,
    /// For each transition, how many places lack its needs.
    lacking: Vec<u32>,
    /// A bit for each transition that lacks nothing, and how many there are.
    enabled: Vec<u64>,
    count: u64,
}

impl<'n> Walk<'n> {
    pub(super) fn new(net: &'n Pt) -> Self {
        let count = net.transitions.len();
        Self {
            net,
            marking: net.initial.clone(),
            lacking: vec![0; count],
            enabled: vec![0; count.div_ceil(64)],
            count: 0,
        }
    }

    /// Begins in a marking.
    pub(super) fn begin(&mut self, marking: &[u32]) {
        self.marking.copy_from_slice(marking);
        self.enabled.fill(0);
        self.count = 0;
        for transition in 0..self.lacking.len() as u32 {
            let lacks = |it: &&(u32, u32)| marking[it.0 as usize] < it.1;
            let lacking = self.net.needs.of(transition).iter().filter(lacks).count() as u32;
            self.lacking[transition as usize] = lacking;
            if lacking == 0 {
                self.flip(transition);
                self.count += 1;
            }
        }
    }

    pub(super) fn marking(&self) -> &[u32] {
        &self.marking
    }

    pub(super) fn is_dead(&self) -> bool {
        self.count == 0
    }

    /// Fires one of the enabled transitions, all equally likely; none in a deadlock.
    #[inline]
    pub(super) fn step(&mut self, stream: &mut Stream) -> Option<Result<u32, Overflow>> {
        let mut left = stream.below(self.count);
        for (word, base) in self.enabled.iter().zip((0_u32..).step_by(64)) {
            let here = u64::from(word.count_ones());
            if left < here {
                let mut word = *word;
                for _ in 0..left {
                    word &= word - 1;
                }
                let transition = base + word.trailing_zeros();
                return Some(self.fire(transition).map(|()| transition));
            }
            left -= here;
        }
        None
    }

    fn fire(&mut self, transition: u32) -> Result<(), Overflow> {
        let net = self.net;
        for &(place, change) in net.effects.of(transition) {
            let before = self.marking[place as usize];
            let after = u32::try_from(i64::from(before) + change).map_err(|_| {
                let (transition, place) = (TransitionId(transition), PlaceId(place));
                Overflow { run: 0, transition, place }
            })?;
            self.marking[place as usize] = after;
            for &(consumer, need) in net.consumers.of(place) {
                match (before >= need, after >= need) {
                    (true, false) => self.lack(consumer),
                    (false, true) => self.supply(consumer),
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// One place more lacks what a transition needs.
    #[inline]
    fn lack(&mut self, transition: u32) {
        let lacking = &mut self.lacking[transition as usize];
        *lacking += 1;
        if *lacking == 1 {
            self.count -= 1;
            self.flip(transition);
        }
    }

    /// One place fewer does.
    #[inline]
    fn supply(&mut self, transition: u32) {
        let lacking = &mut self.lacking[transition as usize];
        *lacking -= 1;
        if *lacking == 0 {
            self.count += 1;
            self.flip(transition);
        }
    }

    #[inline]
    fn flip(&mut self, transition: u32) {
        self.enabled[transition as usize / 64] ^= 1 << (transition % 64);
    }
}
