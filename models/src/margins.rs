//! Margins that keep their promise: how much of the limits to hold back for what remains of a
//! mission, learned from past runs.
//!
//! PANORAMA plans again when *limit - used - planned rest* is below zero (Lambert et al., J.
//! Intell. Robot. Syst. 110, 2024, eqs. 7 and 8). Here the planned rest becomes a bound: of n past
//! runs the ratios of what the rest took over what was planned are sorted, and the k-th smallest
//! with k = ceil((n + 1) coverage) bounds that of the next run with this probability at least,
//! whatever the law of the drift, if runs are exchangeable (split conformal prediction; Vovk,
//! Gammerman, Shafer, Algorithmic Learning in a Random World, 2005). Each activity has its own
//! bound of all that follows, since quantiles do not add.
//!
//! ```
//! use cotama_models::margins::{Calibration, Spent};
//! // One activity, planned for 100 s and 1 kJ; 19 runs took 1 s to 19 s longer.
//! let run = |longer: u64| Spent {
//!     activity: 0,
//!     planned: [100_000, 1_000],
//!     used: [100_000 + 1_000 * longer, 1_000],
//!     done: true,
//! };
//! let runs: Vec<_> = (1..=19).map(|it| vec![run(it)]).collect();
//! let ids = ["A1".to_owned()];
//! let learned = Calibration::learn("errand", &ids, &runs, 900_000);
//! assert_eq!((learned.from[0].runs, learned.from[0].rank), (19, Some(18)));
//! assert_eq!(learned.from[0].bounds, [Some(1_180_000), Some(1_000_000)]);
//! // So few runs bound nothing at 99 %.
//! assert_eq!(Calibration::learn("errand", &ids, &runs, 990_000).from[0].bounds, [None, None]);
//! let text = learned.to_toml("errands");
//! assert_eq!(Calibration::parse("margins.toml", &text).unwrap(), learned);
//! ```

mod reader;

use crate::toml_text::quoted;
use cotama_core::hold::{Hold, ONE, rank};

/// Value of `format` in the files.
pub const MARGINS_FORMAT: &str = "cotama-margins/1";
/// The most runs that are learned from.
pub const MAX_RUNS: u32 = 10_000_000;

/// Amounts that an activity of a run took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spent {
    /// Its position in the mission.
    pub activity: usize,
    /// Amounts planned for it (ms, mJ), by the plan that was in force: where that changed on the
    /// way, by each for its part of the way.
    pub planned: [u64; 2],
    /// Amounts used (ms, mJ).
    pub used: [u64; 2],
    /// Whether it was done; the run ended in it if not.
    pub done: bool,
}

/// Bounds for the rest of a mission, learned from runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Calibration {
    /// Name of the mission.
    pub mission: String,
    /// The promise, in millionths: at least so often a rest stays within its bound.
    pub coverage: u32,
    /// For each activity, in their order, the bound of the rest from its start on.
    pub from: Vec<Promise>,
}

/// A bound for the rest of a mission from the start of an activity on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Promise {
    /// Id of the activity.
    pub activity: String,
    /// How many runs came there.
    pub runs: u32,
    /// Rank of the ratio that is the bound, from 1 for the smallest; none where there are too few.
    pub rank: Option<u32>,
    /// The bounds of duration and energy, in millionths of what is planned; none where too many of
    /// the runs did not come to their end, or were too few.
    pub bounds: [Option<u32>; 2],
}

impl Promise {
    /// Returns the ratios to hold back; one where there is no bound.
    pub fn hold(&self) -> Hold<2> {
        Hold::new(self.bounds.map(|it| it.unwrap_or(ONE)))
    }
}

impl Calibration {
    /// Learns the bounds of a mission with these activities from runs, each the activities that it
    /// came to, in their order. A run that did not come to the end has no finite ratio.
    pub fn learn(mission: &str, ids: &[String], runs: &[Vec<Spent>], coverage: u32) -> Self {
        let from = ids.iter().enumerate().map(|(first, activity)| {
            let rests = runs.iter().filter_map(|run| rest(run, first));
            let ends = |rest: &[Spent]| ends(rest, ids.len());
            bound(activity, rests.map(|it| (it, ends(it))), coverage)
        });
        Self { mission: mission.to_owned(), coverage, from: from.collect() }
    }

    /// Learns what each activity takes by itself, as [`learn`](Self::learn) does of all that
    /// follows. Sums of these bounds are no bounds of sums.
    ///
    /// ```
    /// use cotama_models::margins::{Calibration, Spent};
    /// let run = |used| vec![Spent { activity: 0, planned: [100, 10], used, done: true }];
    /// let runs = [run([110, 10]), run([150, 20]), run([120, 30])];
    /// let median = Calibration::alone("errand", &["A1".to_owned()], &runs, 500_000);
    /// assert_eq!(median.from[0].bounds, [Some(1_200_000), Some(2_000_000)]);
    /// ```
    pub fn alone(mission: &str, ids: &[String], runs: &[Vec<Spent>], coverage: u32) -> Self {
        let from = ids.iter().enumerate().map(|(first, activity)| {
            let each = runs.iter().filter_map(|run| run.iter().find(|it| it.activity == first));
            bound(activity, each.map(|it| (std::slice::from_ref(it), it.done)), coverage)
        });
        Self { mission: mission.to_owned(), coverage, from: from.collect() }
    }

    /// Returns whether a run passed the bound of an activity on an axis: `None` if it did not come
    /// there, or there is no bound. A run that did not come to the end passed it.
    pub fn missed(&self, first: usize, axis: usize, run: &[Spent]) -> Option<bool> {
        let bound = self.from.get(first)?.bounds.get(axis).copied().flatten()?;
        let rest = rest(run, first)?;
        let done = ends(rest, self.from.len());
        let ratio = if done { ratio(sums(rest)[axis]) } else { None };
        Some(ratio.is_none_or(|it| it > bound))
    }

    /// Returns the calibration as a file, with its origin as a comment.
    #[must_use]
    pub fn to_toml(&self, origin: &str) -> String {
        let mut text = format!("# Learned from: {}\n", origin.replace(['\n', '\r'], " "));
        let mut put = |line: String| {
            text += &line;
            text.push('\n');
        };
        put(format!("format = {}", quoted(MARGINS_FORMAT)));
        put(format!("mission = {}", quoted(&self.mission)));
        put(format!("coverage_ppm = {}", self.coverage));
        for it in &self.from {
            put("\n[[from]]".to_owned());
            put(format!("activity = {}", quoted(&it.activity)));
            put(format!("runs = {}", it.runs));
            if let Some(rank) = it.rank {
                put(format!("rank = {rank}"));
            }
            for (key, bound) in ["duration_ppm", "energy_ppm"].into_iter().zip(it.bounds) {
                if let Some(bound) = bound {
                    put(format!("{key} = {bound}"));
                }
            }
        }
        text
    }
}

/// The bound of parts of runs, each with whether it was done.
fn bound<'r>(
    activity: &str,
    parts: impl Iterator<Item = (&'r [Spent], bool)>,
    coverage: u32,
) -> Promise {
    let mut scores: [Vec<Option<u32>>; 2] = [Vec::new(), Vec::new()];
    for (part, done) in parts {
        for (scores, sum) in scores.iter_mut().zip(sums(part)) {
            scores.push(ratio(sum).filter(|_| done));
        }
    }
    let runs = u32::try_from(scores[0].len()).unwrap_or(MAX_RUNS);
    let rank = rank(u64::from(runs), coverage).and_then(|it| u32::try_from(it).ok());
    let bounds = scores.map(|mut scores| {
        scores.sort_unstable_by_key(|it| it.map_or(u64::MAX, u64::from));
        *scores.get(rank? as usize - 1)?
    });
    Promise { activity: activity.to_owned(), runs, rank, bounds }
}

/// Whether what a run did from an activity on came to the end of so many.
fn ends(rest: &[Spent], activities: usize) -> bool {
    rest.last().is_some_and(|it| it.done && it.activity + 1 == activities)
}

/// A run from an activity on, if it came there.
fn rest(run: &[Spent], first: usize) -> Option<&[Spent]> {
    let at = run.iter().position(|it| it.activity == first)?;
    run.get(at..)
}

/// The amounts used and planned, on each axis.
fn sums(rest: &[Spent]) -> [(u64, u64); 2] {
    [0, 1].map(|axis| {
        let add = |(used, planned): (u64, u64), it: &Spent| {
            (used.saturating_add(it.used[axis]), planned.saturating_add(it.planned[axis]))
        };
        rest.iter().fold((0, 0), add)
    })
}

/// Used over planned, in millionths, rounded up; `None` beyond 4,294 times, or where nothing was
/// planned and something used.
pub fn ratio((used, planned): (u64, u64)) -> Option<u32> {
    match (used, planned) {
        (0, 0) => Some(ONE),
        (_, 0) => None,
        _ => {
            let parts = u128::from(used) * u128::from(ONE);
            u32::try_from(parts.div_ceil(u128::from(planned))).ok().map(|it| it.max(1))
        }
    }
}
