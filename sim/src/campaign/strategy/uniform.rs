//! Plans drawn independently of each other.

use super::{Draws, Strategy};
use crate::campaign::plan::Plan;
use crate::campaign::space::{Space, Weighted};
use crate::streams::{Stream, Streams};

/// Every plan is drawn from the space as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uniform;

/// Every plan is drawn from kinds of faults of which each is there or not, by the toss of a coin
/// for the run (swarm testing: Groce et al., ISSTA 2012): some plans repeat few kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Swarm;

impl Strategy for Uniform {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        Box::new(Independent { space, streams: Streams::new(seed), run: first, swarm: false })
    }

    fn estimates(&self) -> bool {
        true
    }
}

impl Strategy for Swarm {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        Box::new(Independent { space, streams: Streams::new(seed), run: first, swarm: true })
    }

    fn estimates(&self) -> bool {
        true
    }
}

struct Independent<'s> {
    space: &'s Space,
    streams: Streams,
    run: u64,
    swarm: bool,
}

impl Draws for Independent<'_> {
    fn next(&mut self) -> Plan {
        let mut stream = of_run(self.streams, self.run);
        self.run += 1;
        if !self.swarm {
            return self.space.draw(&mut stream, &self.space.kinds);
        }
        let kinds = swarm(self.space, &mut stream);
        self.space.draw(&mut stream, &kinds)
    }
}

/// The random numbers of a run.
pub(super) fn of_run(streams: Streams, run: u64) -> Stream {
    streams.stream(&format!("run {run}"))
}

/// The kinds of one swarm: at least one.
fn swarm(space: &Space, stream: &mut Stream) -> Vec<Weighted> {
    let kinds: Vec<_> = space.kinds.iter().copied().filter(|_| stream.below(2) == 0).collect();
    if kinds.is_empty() { space.kinds.clone() } else { kinds }
}
