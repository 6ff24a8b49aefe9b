//! How likely a random run of a net is as a property says: statistical model checking of nets.
//!
//! In each marking every enabled transition is equally likely to fire, and time plays no part.
//! That is a choice, not a law of nature: an estimate speaks of runs drawn so. What a single run
//! shows is certain whatever the choice: one run that breaks `AG p` refutes it, one that comes to
//! `p` proves `EF p`.
//!
//! ```
//! use cotama_models::nets::families::philosophers;
//! use cotama_sim::estimate::{Asked, Draw, draw};
//! use cotama_property::{self as property, pt::Pt};
//!
//! let net = Pt::from(&philosophers(2).unwrap().view().net());
//! let starve = property::parse("EF deadlock", &net).unwrap().question;
//! let asked = [Asked::new(starve.formula().unwrap(), &net).unwrap()];
//! let runs = Draw { runs: 1_000, steps: 20, seed: 1, jobs: 2 };
//! let found = draw(&net, &asked, runs).unwrap();
//! // The shortest way to starve: each takes a fork.
//! assert_eq!(found.tallies[0].shortest_holding.unwrap().steps, 2);
//! ```

mod chain;
mod path;
mod tally;
mod walk;

pub use path::{Asked, NotOfARun, Wants};
pub use tally::{Drawn, Overflow, Tally, Witness};

use crate::streams::Streams;
use chain::{Chain, Run};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use std::ops::Range;

/// Which runs are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draw {
    /// Number of runs.
    pub runs: u64,
    /// The most transitions that a run fires.
    pub steps: u64,
    /// The seed of all draws; each run has a stream of its own, named by its number.
    pub seed: u64,
    /// On how many threads, at least one; changes nothing of what is found.
    pub jobs: usize,
}

/// Draws runs and judges each. A run ends when all questions are decided, in a deadlock, or after
/// the most steps.
///
/// # Errors
/// When a place of some run would hold more than 4,294,967,295 tokens: the first such run.
pub fn draw(net: &Pt, asked: &[Asked<'_>], all: Draw) -> Result<Drawn, Overflow> {
    let jobs = (all.jobs.max(1) as u64).min(all.runs.max(1));
    let part = |job: u64| share(all.runs, job, jobs)..share(all.runs, job + 1, jobs);
    let parts: Vec<Result<Drawn, Overflow>> = std::thread::scope(|scope| {
        let begun: Vec<_> = (1..jobs)
            .map(|job| scope.spawn(move || walk_all(net, asked, all, part(job))))
            .collect();
        let first = walk_all(net, asked, all, part(0));
        let rest = begun.into_iter().map(|it| match it.join() {
            Ok(drawn) => drawn,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        std::iter::once(first).chain(rest).collect()
    });
    // Parts are in the order of runs, so the first error is that of the first run.
    let mut whole = Drawn::none(asked.len());
    for part in parts {
        whole.add(&part?);
    }
    Ok(whole)
}

/// The run of this number again: what it fires, in order, until it has so many steps.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_sim::estimate::{Witness, replay};
/// use cotama_property::pt::Pt;
/// let net = Pt::from(&door::NET);
/// let fired = replay(&net, 7, Witness { run: 3, steps: 5 });
/// assert_eq!(fired.len(), 5);
/// assert_eq!(fired, replay(&net, 7, Witness { run: 3, steps: 5 }));
/// ```
pub fn replay(net: &Pt, seed: u64, which: Witness) -> Vec<TransitionId> {
    let stream = Streams::new(seed).stream(&stream_of(which.run));
    Chain::new(net, &[]).fired(Run { number: which.run, most: which.steps, stream })
}

fn stream_of(run: u64) -> String {
    format!("run {run}")
}

/// How many of these runs come before the part of a job.
fn share(runs: u64, job: u64, jobs: u64) -> u64 {
    (u128::from(runs) * u128::from(job) / u128::from(jobs)) as u64
}

fn walk_all(
    net: &Pt,
    asked: &[Asked<'_>],
    all: Draw,
    numbers: Range<u64>,
) -> Result<Drawn, Overflow> {
    let (mut drawn, mut chain) = (Drawn::none(asked.len()), Chain::new(net, asked));
    let (streams, mut open) = (Streams::new(all.seed), Vec::new());
    for number in numbers {
        let stream = streams.stream(&stream_of(number));
        let run = Run { number, most: all.steps, stream };
        drawn.steps += chain.run(run, &mut open, &mut drawn.tallies)?;
        drawn.runs += 1;
    }
    Ok(drawn)
}
