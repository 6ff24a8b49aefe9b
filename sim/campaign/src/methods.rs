//! Variants of a team, as methods of giving out tasks, each over many seeds: what one costs on
//! average, and what it costs more than another one with the same seeds.

use cotama_models::team::Capability;
use cotama_models::team::scenario::Scenario;
use cotama_sim::fleet::{
    record::{Fate, SkillUses},
    run,
};
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

/// The results of a variant over all seeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Results<V> {
    /// The variant.
    pub variant: V,
    /// For how long robots worked, with the utility of what was not done, in ms a run.
    pub cost_ms: Spread,
    /// From when a task became known until it was done, in ms a task.
    pub waited_ms: Spread,
    /// The same less that of the first variant with the same seed.
    pub more_waited_ms: Spread,
    /// Cost less that of the first variant with the same seed, in ms a run.
    pub more_ms: Spread,
    /// The same in thousandths of the cost of the first.
    pub more_permille: Spread,
    /// What skills did that may fail.
    pub skills: SkillResults,
    /// Tasks done, and tasks reported, over all runs.
    pub done: usize,
    /// Tasks reported as not to be done, of all runs.
    pub reported: usize,
    /// Tasks that were put up again, over all runs.
    pub reopened: u64,
    /// Runs of which something did not hold: none, or the protocol is wrong.
    pub unsound: usize,
}

/// What skills that may fail did over all seeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkillResults {
    /// How often such skills were used, in thousandths a run.
    pub uses_milli: Spread,
    /// How often one failed, so that an action was repeated or its task given back, in thousandths
    /// a run.
    pub failed_milli: Spread,
    /// The same less that of the first variant with the same seed.
    pub more_failed_milli: Spread,
    /// Awards to their robots that would have gone to others had all known how often these skills
    /// fail, in thousandths a run.
    pub undue_milli: Spread,
    /// How often the robot had used such skills before each of them, over all runs, in rising
    /// order.
    pub undue_after: Vec<u32>,
}

/// One run.
#[derive(Clone, Debug, Default)]
struct One {
    uses: i64,
    failed: i64,
    undue: Vec<u32>,
    cost_ms: i64,
    waited_ms: i64,
    done: usize,
    reported: usize,
    reopened: u64,
    sound: bool,
}

/// Runs so many seeds from the first one on, with each variant, on so many threads; the number of
/// threads changes nothing. `scenario` makes what is run. The first variant is what the others are
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
pub fn compare<V: Copy + Sync>(
    scenario: &(impl Fn(u64, V) -> Scenario + Sync),
    first_seed: u64,
    seeds: u64,
    variants: &[V],
    threads: usize,
) -> Vec<Results<V>> {
    let mut first: Vec<One> = Vec::new();
    let mut all = Vec::new();
    for &variant in variants {
        let runs = runs(&|seed| scenario(seed, variant), first_seed, seeds, threads.max(1));
        if first.is_empty() {
            first.clone_from(&runs);
        }
        all.extend(results(variant, &runs, &first));
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
    let may_fail = |it: &&SkillUses| {
        let at = scenario.skills.iter().position(|name| *name == it.skill);
        let skill = at.and_then(|it| Capability::new(u8::try_from(it).ok()?));
        let robot = scenario.robots.get(it.robot);
        robot.zip(skill).is_some_and(|(robot, skill)| robot.fails.of(skill) > 0)
    };
    let uses = run.skills.iter().filter(may_fail).map(|it| i64::from(it.uses)).sum();
    One {
        uses,
        failed: i64::from(run.failed_uses),
        undue: run.undue.clone(),
        cost_ms: i64::try_from(run.cost_ms).unwrap_or(i64::MAX),
        waited_ms: i64::try_from(run.waited_ms / (done as u64).max(1)).unwrap_or(i64::MAX),
        done,
        reported: run.count(Fate::Reported),
        reopened: u64::from(run.reopened),
        sound: run.is_sound(),
    }
}

fn results<V>(variant: V, runs: &[One], first: &[One]) -> Option<Results<V>> {
    let spread = |value: &dyn Fn((&One, &One)) -> i64| {
        Spread::of(&runs.iter().zip(first).map(value).collect::<Vec<_>>())
    };
    let mut undue_after: Vec<u32> = runs.iter().flat_map(|it| it.undue.iter().copied()).collect();
    undue_after.sort_unstable();
    let skills = SkillResults {
        uses_milli: spread(&|it| it.0.uses * 1_000)?,
        failed_milli: spread(&|it| it.0.failed * 1_000)?,
        more_failed_milli: spread(&|it| (it.0.failed - it.1.failed) * 1_000)?,
        undue_milli: spread(&|it| {
            i64::try_from(it.0.undue.len()).map_or(i64::MAX, |it| it * 1_000)
        })?,
        undue_after,
    };
    Some(Results {
        variant,
        skills,
        more_waited_ms: spread(&|it| it.0.waited_ms - it.1.waited_ms)?,
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
