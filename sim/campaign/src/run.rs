//! The runs of a campaign: what is asked for, what one run leaves, and the loop.

use crate::observed::Observed;
use crate::plan::Plan;
use crate::requirement::Requirement;
use crate::requirements::Requirements;
use crate::sampling::Sampling;
use crate::space::{Rates, Space};
use crate::strategy::{BLOCK, Strategy, StrategyName};
use crate::subject::{Subject, Unready};
use cotama_models::robots::RobotFile;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;

/// The most runs of a campaign.
pub const MAX_RUNS: u64 = 1_000_000_000;
/// The most faults of a plan.
pub const MAX_FAULTS: u64 = 8;
/// The most shards of a campaign.
pub const MAX_SHARDS: u64 = 100_000;

/// The settings of a campaign: with the mission, all that its results depend on.
///
/// ```
/// use cotama_campaign::run::Settings;
/// use cotama_campaign::strategy::StrategyName;
/// let strategy = StrategyName::Guided;
/// let settings = Settings { runs: 5_000, strategy, ..Settings::new(true) };
/// let asked: Vec<_> = settings.requirements.iter().map(ToString::to_string).collect();
/// assert_eq!(asked, ["in-time", "brakes", "stands-when-safe"]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// How many missions are run, at most [`MAX_RUNS`].
    pub runs: u64,
    /// The seed of all draws.
    pub seed: u64,
    /// How plans are drawn.
    pub strategy: StrategyName,
    /// How kinds of faults are weighted.
    pub rates: Rates,
    /// The fewest and the most faults of a plan, at most [`MAX_FAULTS`].
    pub faults: (u64, u64),
    /// Requirements of every run.
    pub requirements: Requirements,
}

impl Settings {
    /// A thousand runs of uniformly drawn plans with one to three faults.
    pub fn new(supervised: bool) -> Self {
        let requirements = if supervised {
            [Requirement::InTime, Requirement::Brakes, Requirement::StandsWhenSafe].into()
        } else {
            [Requirement::NotFailed].into()
        };
        Self {
            runs: 1_000,
            seed: 0,
            strategy: StrategyName::Uniform,
            rates: Rates::Even,
            faults: (1, 3),
            requirements,
        }
    }
}

/// A part of a campaign: every so-many-th block of its runs.
///
/// ```
/// use cotama_campaign::run::Shard;
/// let shard = Shard { index: 2, of: 3 };
/// assert_eq!(shard.blocks(4_600).collect::<Vec<_>>(), [1, 4]);
/// assert_eq!(Shard::ALL.blocks(1).collect::<Vec<_>>(), [0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Number of the shard, from 1.
    pub index: u64,
    /// How many shards there are.
    pub of: u64,
}

impl Shard {
    /// The whole.
    pub const ALL: Self = Self { index: 1, of: 1 };

    /// The numbers of its blocks, of a campaign with so many runs.
    pub fn blocks(self, runs: u64) -> impl Iterator<Item = u64> {
        (0..runs.div_ceil(BLOCK))
            .skip(self.index.saturating_sub(1) as usize)
            .step_by(self.of as usize)
    }
}

/// The result of one run: a line of the results.
///
/// ```
/// use cotama_campaign::run::Line;
/// let text = r#"{"run":7,"outcome":"safe","time_ms":5,"energy_mj":7,"x_mm":9,"requests":1,"#;
/// let text = format!(r#"{text}"replans":0,"exposed_ms":0,"faults":[],"violated":[]}}"#);
/// let line: Line = serde_json::from_str(&text).unwrap();
/// assert_eq!((line.run, line.observed.requests), (7, 1));
/// assert_eq!(serde_json::to_string(&line).unwrap(), text);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Line {
    /// The number of the run, from 0.
    pub run: u64,
    /// The observations; those that are not serialised are empty when a line was read.
    #[serde(flatten)]
    pub observed: Observed,
    /// Faults of the run; under supervisors with the state of the local one then, as
    /// `SON2@Following`.
    pub faults: Vec<String>,
    /// The requirements that did not hold.
    pub violated: Requirements,
    /// The plan as a `panorama-faults/1` file, where one did not hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<String>,
}

/// A campaign, ready to run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::run::{Campaign, Settings};
/// use cotama_campaign::subject::{Policy, Subject};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let requirements = ["completed".parse().unwrap()].into();
/// let settings = Settings { requirements, ..Settings::new(false) };
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// let campaign = Campaign::new(subject, settings).unwrap();
/// let failing = campaign.block(0).iter().filter(|it| !it.violated.is_empty()).count();
/// assert_eq!((campaign.block(0).len(), failing), (1_000, 352));
/// ```
#[derive(Debug)]
pub struct Campaign<'m> {
    /// The subject of the runs.
    pub subject: Subject<'m>,
    /// The settings.
    pub settings: Settings,
    space: Space,
    strategy: Box<dyn Strategy>,
}

impl<'m> Campaign<'m> {
    /// A campaign with the space of its mission. A strategy that counts its plans runs no more than
    /// there are.
    ///
    /// # Errors
    /// When a requirement is no property of the mission's supervisors.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_campaign::run::{Campaign, Settings, Shard};
    /// use cotama_campaign::subject::{Policy, Subject};
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let subject = Subject::new(&mission, Policy::default()).unwrap();
    /// let settings = Settings { runs: 20, ..Settings::new(true) };
    /// let campaign = Campaign::new(subject, settings).unwrap();
    /// let mut lines = Vec::new();
    /// campaign.run(Shard::ALL, 0, 1, &mut |block| {
    ///     lines.extend(block);
    ///     std::ops::ControlFlow::Continue(())
    /// });
    /// assert_eq!(lines.len(), 20);
    /// assert!(lines.iter().all(|it| it.violated.is_empty()));
    /// ```
    pub fn new(subject: Subject<'m>, settings: Settings) -> Result<Self, Unready> {
        let (least, most) = settings.faults;
        let space = subject.space(settings.rates, least..=most);
        Self::within(subject, settings, space)
    }

    /// A campaign with a space of the caller's.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn within(subject: Subject<'m>, settings: Settings, space: Space) -> Result<Self, Unready> {
        let subject = subject.watching(&settings.requirements)?;
        let strategy = settings.strategy.strategy(&space);
        let runs = strategy.total(&space).map_or(settings.runs, |it| it.min(settings.runs));
        Ok(Self { subject, settings: Settings { runs, ..settings }, space, strategy })
    }

    /// Returns the sampling of so many of its runs; `tested` after a test that could have stopped
    /// it as soon as it was decided.
    pub fn sampling(&self, runs: u64, tested: bool) -> Sampling {
        let every = self.plans().is_some_and(|it| it == runs);
        match (self.strategy.estimates(), tested) {
            (true, false) => Sampling::Fixed,
            (true, true) => Sampling::Stopped,
            (false, _) if every => Sampling::Every,
            (false, _) => Sampling::Chosen,
        }
    }

    /// How many different plans there are, if the strategy counts them.
    pub fn plans(&self) -> Option<u64> {
        self.strategy.total(&self.space)
    }

    /// The runs of a block, in their order.
    pub fn block(&self, block: u64) -> Vec<Line> {
        let runs = self.runs_of(block);
        runs.into_iter().map(|(run, plan, observed)| self.line(run, &plan, observed)).collect()
    }

    /// Returns the plans of all runs, in their order. Missions are run again, as a strategy may
    /// learn of them.
    pub fn drawn(&self) -> Vec<Plan> {
        let blocks = Shard::ALL.blocks(self.settings.runs);
        blocks.flat_map(|it| self.runs_of(it)).map(|it| it.1).collect()
    }

    fn runs_of(&self, block: u64) -> Vec<(u64, Plan, Observed)> {
        let first = block.saturating_mul(BLOCK);
        let count = self.settings.runs.saturating_sub(first).min(BLOCK);
        let mut draws = self.strategy.block(&self.space, self.settings.seed, first);
        let runs = (first..first + count).map(|run| {
            let plan = draws.next();
            let observed = self.subject.run(&plan);
            draws.learn(&observed, self.distance(&observed));
            (run, plan, observed)
        });
        runs.collect()
    }

    /// The least distance of a run from breaking a requirement.
    pub fn distance(&self, observed: &Observed) -> i64 {
        let distances = self.settings.requirements.iter().map(|it| it.distance(observed));
        distances.min().unwrap_or(i64::MAX)
    }

    fn line(&self, run: u64, plan: &Plan, observed: Observed) -> Line {
        let broken = self.settings.requirements.iter().filter(|it| !it.holds(&observed));
        let violated: Requirements = broken.cloned().collect();
        let robot = self.subject.mission().and_then(|it| it.robot()).map(RobotFile::robot);
        let faults = if let Some(robot) = robot {
            let id = |it: usize| robot.failures.get(it).map_or("", |it| it.id.as_str());
            observed.met.iter().map(|(failure, at)| format!("{}@{at}", id(*failure))).collect()
        } else {
            let one = |it: &crate::plan::Fault| {
                self.subject.signature(&Plan { faults: vec![it.clone()] })
            };
            plan.faults.iter().map(one).collect()
        };
        Line {
            run,
            observed,
            faults,
            plan: (!violated.is_empty()).then(|| self.subject.stored(plan)),
            violated,
        }
    }

    /// Runs the blocks of a shard but for the first so many, on so many threads, and gives them to
    /// `sink` one after the other in their order, until it breaks off.
    pub fn run(
        &self,
        shard: Shard,
        done: usize,
        jobs: usize,
        sink: &mut dyn FnMut(Vec<Line>) -> ControlFlow<()>,
    ) {
        let blocks: Vec<u64> = shard.blocks(self.settings.runs).skip(done).collect();
        let jobs = jobs.clamp(1, blocks.len().max(1));
        if jobs == 1 {
            for &block in &blocks {
                if sink(self.block(block)).is_break() {
                    return;
                }
            }
            return;
        }
        let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let (send, receive) = sync_channel(jobs * 2);
        thread::scope(|scope| {
            for _ in 0..jobs {
                let (send, next, stopped, blocks) = (send.clone(), &next, &stopped, &blocks);
                scope.spawn(move || {
                    loop {
                        let at = next.fetch_add(1, Ordering::Relaxed);
                        let Some(&block) = blocks.get(at) else { return };
                        let is_over = stopped.load(Ordering::Relaxed);
                        if is_over || send.send((at, self.block(block))).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(send);
            let (mut early, mut due) = (BTreeMap::new(), 0);
            for (at, lines) in receive {
                early.insert(at, lines);
                while let Some(lines) = early.remove(&due) {
                    due += 1;
                    if !stopped.load(Ordering::Relaxed) && sink(lines).is_break() {
                        stopped.store(true, Ordering::Relaxed);
                    }
                }
            }
        });
    }
}
