//! Rare events of a random process: importance splitting, and importance sampling.
//!
//! Plain sampling needs about a hundred hits for an estimate within a fifth, thus ten million for
//! a probability of 1e-5. Splitting climbs a ladder of levels towards the event and starts again
//! from where it came to; its estimate has no bias, whatever the levels are.

use super::statistics::{Interval, mean_interval};
use crate::streams::{Stream, Streams};

/// A process that goes on step by step, with a level that rises towards a rare event.
pub trait Process {
    /// Where it is.
    type State: Clone;

    /// Where it begins.
    fn start(&self) -> Self::State;

    /// Goes on; whether it has come to an end.
    fn step(&self, state: &mut Self::State, stream: &mut Stream) -> bool;

    /// How near the event is, from 0; the event is [`top`](Self::top). A step raises it by at most
    /// one, or the ladder has levels that nobody stands on.
    fn level(&self, state: &Self::State) -> u32;

    /// The level of the event.
    fn top(&self) -> u32;
}

/// An estimate and what it cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The probability, with an interval by Student's distribution over the repetitions.
    pub interval: Interval,
    /// How many steps were taken.
    pub steps: u64,
    /// The variance of one repetition, times the steps that one takes: the less, the better.
    pub work: f64,
}

/// Fixed-effort splitting (Garvels, Kroese, Eur. Trans. Telecomm. 9, 1998): at each level so many
/// walkers start from where those before first reached it, and the shares that reach the next one
/// are multiplied. So many repetitions, which are independent, give the interval.
///
/// ```
/// use cotama_sim::campaign::rare::{Process, splitting};
/// use cotama_sim::streams::Stream;
/// /// Three steps up in ten, seven down; from 1 it ends at 0, or at the top.
/// struct Walk(u32);
/// impl Process for Walk {
///     type State = u32;
///     fn start(&self) -> u32 {
///         1
///     }
///     fn step(&self, at: &mut u32, stream: &mut Stream) -> bool {
///         *at = if stream.below(10) < 3 { *at + 1 } else { *at - 1 };
///         *at == 0
///     }
///     fn level(&self, at: &u32) -> u32 {
///         *at
///     }
///     fn top(&self) -> u32 {
///         self.0
///     }
/// }
/// let ratio: f64 = 7.0 / 3.0;
/// let truth = (ratio - 1.0) / (ratio.powi(14) - 1.0); // about one in 100,000
/// let found = splitting(&Walk(14), 200, 50, 1, 0.95);
/// assert!(found.interval.holds(truth));
/// ```
pub fn splitting<P: Process>(
    process: &P,
    walkers: usize,
    repetitions: usize,
    seed: u64,
    confidence: f64,
) -> Estimate {
    let (streams, mut steps) = (Streams::new(seed), 0);
    let estimates: Vec<f64> = (0..repetitions)
        .map(|number| {
            let mut stream = streams.stream(&format!("splitting {number}"));
            once(process, walkers.max(1), &mut stream, &mut steps)
        })
        .collect();
    estimate(&estimates, steps, confidence)
}

fn estimate(estimates: &[f64], steps: u64, confidence: f64) -> Estimate {
    let interval = mean_interval(estimates, confidence);
    let interval =
        Interval { low: interval.low.max(0.0), high: interval.high.min(1.0), ..interval };
    let count = estimates.len() as f64;
    let squares: f64 = estimates.iter().map(|it| (it - interval.estimate).powi(2)).sum();
    let variance = squares / (count - 1.0).max(1.0);
    Estimate { interval, steps, work: variance * steps as f64 / count }
}

fn once<P: Process>(process: &P, walkers: usize, stream: &mut Stream, steps: &mut u64) -> f64 {
    let first = process.start();
    let (mut level, mut from, mut share) = (process.level(&first), vec![first], 1.0);
    while level < process.top() {
        let mut reached = Vec::new();
        for _ in 0..walkers {
            let mut state = from[stream.below(from.len() as u64) as usize].clone();
            loop {
                *steps += 1;
                let ended = process.step(&mut state, stream);
                if process.level(&state) > level {
                    reached.push(state);
                    break;
                }
                if ended {
                    break;
                }
            }
        }
        if reached.is_empty() {
            return 0.0;
        }
        share *= reached.len() as f64 / walkers as f64;
        (level, from) = (level + 1, reached);
    }
    share
}

/// Importance sampling: each run is drawn by another law and gives the likelihood ratio of both if
/// the event happened, else zero; `run` also says how many steps it took. The interval is only as
/// good as the law: where its ratios have no small variance it is too narrow.
pub fn sampling(
    mut run: impl FnMut(&mut Stream) -> (f64, u64),
    runs: usize,
    seed: u64,
    confidence: f64,
) -> Estimate {
    let (streams, mut steps) = (Streams::new(seed), 0);
    let values: Vec<f64> = (0..runs)
        .map(|number| {
            let (value, taken) = run(&mut streams.stream(&format!("sampling {number}")));
            steps += taken;
            value
        })
        .collect();
    estimate(&values, steps, confidence)
}
