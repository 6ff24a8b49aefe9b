//! Every plan over an abstract timeline.

use super::uniform::of_run;
use super::{Draws, Strategy};
use crate::plan::Plan;
use crate::space::Space;
use cotama_models::robots::Moment;
use cotama_sim::streams::Streams;

/// Every plan with as many faults as the space has at most, over its [timeline](Space::timeline):
/// every kind and every moment of each fault, in the order of their numbers. Parameters (modules,
/// delays, ends) are drawn, since they have too many values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exhaustive;

/// The factors of a plan: for each fault its kind and its moment.
#[derive(Clone, Debug)]
pub(super) struct Factors {
    faults: usize,
    kinds: u64,
    timeline: Vec<Moment>,
}

impl Factors {
    pub(super) fn of(space: &Space) -> Self {
        let faults = usize::try_from(space.most).unwrap_or(usize::MAX).clamp(1, 8);
        Self { faults, kinds: space.kinds.len() as u64, timeline: space.timeline() }
    }

    pub(super) const fn count(&self) -> usize {
        2 * self.faults
    }

    /// How many values each factor has.
    pub(super) fn widths(&self) -> impl Iterator<Item = u64> {
        let pair = [self.kinds.max(1), self.timeline.len() as u64];
        std::iter::repeat_n(pair, self.faults).flatten()
    }
}

/// The plan with these values; its parameters are drawn for the run.
pub(super) fn plan(
    space: &Space,
    factors: &Factors,
    values: &[u64],
    streams: Streams,
    run: u64,
) -> Plan {
    let mut stream = of_run(streams, run);
    let faults = values.chunks_exact(2).map(|pair| {
        let (kind, when) = (space.kinds[pair[0] as usize].kind, factors.timeline[pair[1] as usize]);
        space.with(kind, when, &mut stream)
    });
    Plan { faults: faults.collect() }
}

impl Strategy for Exhaustive {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        let factors = Factors::of(space);
        Box::new(All { space, factors, streams: Streams::new(seed), run: first })
    }

    fn total(&self, space: &Space) -> Option<u64> {
        Some(Factors::of(space).widths().fold(1, u64::saturating_mul))
    }
}

struct All<'s> {
    space: &'s Space,
    factors: Factors,
    streams: Streams,
    run: u64,
}

impl Draws for All<'_> {
    fn next(&mut self) -> Plan {
        let (run, mut left) = (self.run, self.run);
        self.run += 1;
        let digit = |width: u64| {
            let it = left % width;
            left /= width;
            it
        };
        let values: Vec<_> = self.factors.widths().map(digit).collect();
        plan(self.space, &self.factors, &values, self.streams, run)
    }
}
