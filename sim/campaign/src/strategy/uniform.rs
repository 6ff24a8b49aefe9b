//! Plans drawn independently of each other.

use super::{Draws, Strategy};
use crate::plan::Plan;
use crate::space::{Space, Weighted};
use cotama_sim::streams::{Stream, Streams};

/// Every plan is drawn from the space as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uniform;

/// Every plan is drawn from kinds of faults of which each is there or not, by the toss of a coin
/// for the run (swarm testing: Groce et al., ISSTA 2012): some plans repeat few kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Swarm;

impl Strategy for Uniform {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        each(space, seed, first, |space, stream| space.draw(stream, &space.kinds))
    }

    fn estimates(&self) -> bool {
        true
    }
}

impl Strategy for Swarm {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        each(space, seed, first, |space, stream| {
            let kinds = swarm(space, stream);
            space.draw(stream, &kinds)
        })
    }

    fn estimates(&self) -> bool {
        true
    }
}

/// Plans drawn one by one, each from the random numbers of its run.
pub(super) fn each<'s>(
    space: &'s Space,
    seed: u64,
    first: u64,
    draw: fn(&Space, &mut Stream) -> Plan,
) -> Box<dyn Draws + 's> {
    Box::new(Each { space, streams: Streams::new(seed), run: first, draw })
}

struct Each<'s> {
    space: &'s Space,
    streams: Streams,
    run: u64,
    draw: fn(&Space, &mut Stream) -> Plan,
}

impl Draws for Each<'_> {
    fn next(&mut self) -> Plan {
        let mut stream = of_run(self.streams, self.run);
        self.run += 1;
        (self.draw)(self.space, &mut stream)
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
