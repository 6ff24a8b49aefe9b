//! Methods of giving out tasks, each over many seeds: what one costs on average, and what it costs
//! more than another one with the same seeds.

use cotama_models::team::scenario::{Method, Scenario};
use cotama_sim::fleet::{record::Fate, run};
use std::thread;

/// A mean with the half width of its interval of 95 %, both rounded.
///
/// ```
/// use cotama_campaign::methods::Spread;
/// let spread = Spread::of(&[10, 20, 30, 40]).unwrap();
/// assert_eq!((spread.mean, spread.half_width), (25, 13)); // 1.96 * 12.91 / 2 = 12.65
/// assert_eq!(Spread::of(&[7]), Some(Spread { mean: 7, half_width: 0 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spread {
    /// The mean.
    pub mean: i64,
    /// The normal interval reaches so far to both sides.
    pub half_width: u64,
}

impl Spread {
    /// Returns the spread of some values; `None` of none.
    pub fn of(values: &[i64]) -> Option<Self> {
        let count = i128::try_from(values.len()).ok().filter(|it| *it > 0)?;
        let sum: i128 = values.iter().map(|it| i128::from(*it)).sum();
        let half = if sum < 0 { -count / 2 } else { count / 2 };
        let mean = i64::try_from((sum + half) / count).ok()?;
        // The sum of squared deviations times the count is an integer.
        let squares: i128 = values.iter().map(|it| i128::from(*it) * i128::from(*it)).sum();
        let deviations = (squares * count - sum * sum).unsigned_abs();
        let count = count.unsigned_abs();
        // 1.96 times the root of deviations / (count² (count - 1)), rounded up.
        let under = count * count * (count - 1).max(1) * 10_000;
        let scaled = deviations.saturating_mul(196 * 196);
        let root = scaled.div_ceil(under).isqrt();
        let up = u128::from(root * root * under < scaled);
        Some(Self { mean, half_width: u64::try_from(root + up).ok()? })
    }
}

/// The results of a method over all seeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Results {
    /// The method.
    pub method: Method,
    /// For how long robots worked, with the utility of what was not done, in ms a run.
    pub cost_ms: Spread,
    /// From when a task became known until it was done, in ms a task.
    pub waited_ms: Spread,
    /// Cost less that of the optimal method with the same seed, in ms a run.
    pub more_ms: Spread,
    /// The same in thousandths of the optimal cost.
    pub more_permille: Spread,
    /// Tasks done, and tasks reported, over all runs.
    pub done: usize,
    /// Tasks reported as not to be done, of all runs.
    pub reported: usize,
    /// Tasks that were put up again, over all runs.
    pub reopened: u64,
    /// Runs of which something did not hold: none, or the protocol is wrong.
    pub unsound: usize,
}

/// One run.
#[derive(Clone, Copy, Debug, Default)]
struct One {
    cost_ms: i64,
    waited_ms: i64,
    done: usize,
    reported: usize,
    reopened: u64,
    sound: bool,
}

/// Runs so many seeds from the first one on, with each method, on so many threads; the number of
/// threads changes nothing. `scenario` makes what is run. The first method is what the others are
/// compared with.
///
/// ```
/// use cotama_models::team::scenario::{Method, Scenario};
/// use cotama_campaign::methods::compare;
/// use cotama_sim::fleet::scenarios::{FleetOptions, fleet};
/// let scenario = |seed, method| {
///     let options = FleetOptions { robots: 6, tasks: 8, failures: 1, ..FleetOptions::default() };
///     fleet(&FleetOptions { seed, method, ..options })
/// };
/// let both = compare(&scenario, 0, 2, &[Method::Optimal, Method::OneByOne], 2);
/// assert_eq!(both.iter().map(|it| it.unsound).sum::<usize>(), 0);
/// assert_eq!(both[0].more_ms.mean, 0);
/// ```
pub fn compare(
    scenario: &(impl Fn(u64, Method) -> Scenario + Sync),
    first_seed: u64,
    seeds: u64,
    methods: &[Method],
    threads: usize,
) -> Vec<Results> {
    let mut first: Vec<One> = Vec::new();
    let mut all = Vec::new();
    for &method in methods {
        let runs = runs(&|seed| scenario(seed, method), first_seed, seeds, threads.max(1));
        if first.is_empty() {
            first.clone_from(&runs);
        }
        all.extend(results(method, &runs, &first));
    }
    all
}

fn runs(
    scenario: &(impl Fn(u64) -> Scenario + Sync),
    first: u64,
    seeds: u64,
    threads: usize,
) -> Vec<One> {
    let mut runs = vec![One::default(); usize::try_from(seeds).unwrap_or(usize::MAX)];
    let part = runs.len().div_ceil(threads).max(1);
    thread::scope(|scope| {
        for (number, part_of) in runs.chunks_mut(part).enumerate() {
            scope.spawn(move || {
                for (at, it) in part_of.iter_mut().enumerate() {
                    let seed = first.wrapping_add((number * part + at) as u64);
                    *it = one(&scenario(seed));
                }
            });
        }
    });
    runs
}

fn one(scenario: &Scenario) -> One {
    let run = run(scenario);
    let done = run.count(Fate::Done);
    One {
        cost_ms: i64::try_from(run.cost_ms).unwrap_or(i64::MAX),
        waited_ms: i64::try_from(run.waited_ms / (done as u64).max(1)).unwrap_or(i64::MAX),
        done,
        reported: run.count(Fate::Reported),
        reopened: u64::from(run.reopened),
        sound: run.is_sound(),
    }
}

fn results(method: Method, runs: &[One], first: &[One]) -> Option<Results> {
    let spread = |value: &dyn Fn((&One, &One)) -> i64| {
        Spread::of(&runs.iter().zip(first).map(value).collect::<Vec<_>>())
    };
    Some(Results {
        method,
        cost_ms: spread(&|it| it.0.cost_ms)?,
        waited_ms: spread(&|it| it.0.waited_ms)?,
        more_ms: spread(&|it| it.0.cost_ms - it.1.cost_ms)?,
        more_permille: spread(&|it| (it.0.cost_ms - it.1.cost_ms) * 1_000 / it.1.cost_ms.max(1))?,
        done: runs.iter().map(|it| it.done).sum(),
        reported: runs.iter().map(|it| it.reported).sum(),
        reopened: runs.iter().map(|it| it.reopened).sum(),
        unsound: runs.iter().filter(|it| !it.sound).count(),
    })
}
