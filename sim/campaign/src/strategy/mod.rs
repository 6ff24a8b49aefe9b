//! Which plan comes next: strategies behind one door.
//!
//! Runs are numbered, and a [block](BLOCK) of runs has one [`Draws`]. What a strategy learns
//! stays in its block, so that blocks can be run in any order, on any thread or machine, and the
//! plan of every run is a function of the seed and its number.

mod covering;
mod exhaustive;
mod guided;
mod races;
mod uniform;

pub use covering::Covering;
pub use exhaustive::Exhaustive;
pub use guided::Guided;
pub use races::Races;
pub use uniform::{Swarm, Uniform};

use super::observed::Observed;
use super::plan::Plan;
use super::space::Space;
use std::fmt;

/// How many runs are drawn by one [`Draws`].
pub const BLOCK: u64 = 1_000;

/// Draws the plans of a campaign; one of your own is asked for its blocks as those here are.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::plan::Plan;
/// use cotama_campaign::space::{Rates, Space};
/// use cotama_campaign::strategy::{Draws, Strategy};
/// /// Nothing ever fails.
/// #[derive(Debug)]
/// struct Calm;
/// impl Draws for Calm {
///     fn next(&mut self) -> Plan {
///         Plan::default()
///     }
/// }
/// impl Strategy for Calm {
///     fn block<'s>(&'s self, _: &'s Space, _: u64, _: u64) -> Box<dyn Draws + 's> {
///         Box::new(Calm)
///     }
/// }
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let space = Space::of(&mission, Rates::Even, 1..=3);
/// assert_eq!(Calm.block(&space, 0, 0).next(), Plan::default());
/// ```
pub trait Strategy: fmt::Debug + Send + Sync {
    /// Draws the runs from `first` on, at most [`BLOCK`] of them, of the campaign with this seed.
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's>;

    /// How many different plans there are, if it counts them: it ends after these.
    fn total(&self, _space: &Space) -> Option<u64> {
        None
    }

    /// Whether runs are drawn independently of each other and of what they come to, so that the
    /// share of failures among them estimates a probability.
    fn estimates(&self) -> bool {
        false
    }
}

/// Draws the plans of one block, in the order of runs.
pub trait Draws {
    /// The next plan.
    fn next(&mut self) -> Plan;

    /// Learns the outcome of the plan before, and its least distance from breaking a requirement.
    fn learn(&mut self, _run: &Observed, _distance: i64) {}
}

/// The strategies by name.
///
/// ```
/// use cotama_campaign::strategy::StrategyName;
/// let names = StrategyName::ALL.map(StrategyName::name);
/// assert_eq!(names[..4], ["uniform", "swarm", "pairwise", "three-way"]);
/// assert_eq!(names[4..], ["guided", "races", "exhaustive"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrategyName {
    /// [`Uniform`].
    Uniform,
    /// [`Swarm`].
    Swarm,
    /// [`Covering`] with any two values.
    Pairwise,
    /// [`Covering`] with any three values.
    ThreeWay,
    /// [`Guided`].
    Guided,
    /// [`Races`].
    Races,
    /// [`Exhaustive`].
    Exhaustive,
}

impl StrategyName {
    /// All.
    pub const ALL: [Self; 7] = [
        Self::Uniform,
        Self::Swarm,
        Self::Pairwise,
        Self::ThreeWay,
        Self::Guided,
        Self::Races,
        Self::Exhaustive,
    ];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Swarm => "swarm",
            Self::Pairwise => "pairwise",
            Self::ThreeWay => "three-way",
            Self::Guided => "guided",
            Self::Races => "races",
            Self::Exhaustive => "exhaustive",
        }
    }

    /// Why the share of failures among its plans estimates no probability; none where it does.
    pub const fn estimates_nothing(self) -> Option<&'static str> {
        match self {
            Self::Uniform | Self::Swarm => None,
            Self::Pairwise | Self::ThreeWay => {
                Some("its plans are the rows of an array, which are chosen to differ")
            }
            Self::Guided => Some("it draws by what came of the plans before"),
            Self::Races => Some("it aims at the moments at which supervisors act"),
            Self::Exhaustive => Some("it runs its plans in their order, each once"),
        }
    }

    /// The strategy.
    pub fn strategy(self, space: &Space) -> Box<dyn Strategy> {
        match self {
            Self::Uniform => Box::new(Uniform),
            Self::Swarm => Box::new(Swarm),
            Self::Pairwise => Box::new(Covering::new(space, 2)),
            Self::ThreeWay => Box::new(Covering::new(space, 3)),
            Self::Guided => Box::new(Guided),
            Self::Races => Box::new(Races),
            Self::Exhaustive => Box::new(Exhaustive),
        }
    }
}
