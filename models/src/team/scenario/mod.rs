//! A team at work, as data: its floor, robots, tasks, faults, network, and how tasks are given out.
//!
//! A `cotama-team/1` file says all of it ([`Scenario::parse`]), and [`Scenario::to_toml`] writes
//! one that reads as the same. The simulator runs it, a campaign draws other faults for it.
//!
//! ```
//! use cotama_models::team::scenario::Scenario;
//! let text = r#"
//! format = "cotama-team/1"
//! name = "two rooms"
//! [floor]
//! places = ["hall", "store", "desk"]
//! [[floor.way]]
//! between = ["hall", "store"]
//! length_mm = 9000
//! [[floor.way]]
//! between = ["hall", "desk"]
//! length_mm = 6000
//! [[robot]]
//! name = "anna"
//! at = "hall"
//! skills = ["move", "grasp"]
//! [[task]]
//! name = "parcel"
//! from = "store"
//! to = "desk"
//! skip_ms = 600000
//! [[task.plan]]
//! name = "carry"
//! [[task.plan.role]]
//! name = "carrier"
//! needs = ["move", "grasp"]
//! take = "object"
//! give = "goal"
//! take_ms = 5000
//! give_ms = 5000
//! "#;
//! let scenario = Scenario::parse("two.toml", text).unwrap();
//! assert_eq!((scenario.robots.len(), scenario.tasks[0].plans[0].roles.len()), (1, 1));
//! assert_eq!(Scenario::parse("again.toml", &scenario.to_toml()), Ok(scenario));
//! ```

mod bid;
mod coalitions;
mod crowd;
mod floor;
mod ground;
mod reader;
mod reasons;
mod seat;
mod supply;
#[cfg(test)]
mod tests;
mod track;
mod trust;
mod worker;
mod writer;

pub use bid::{Outlook, Parts, Quote, common_denominator};
pub use coalitions::{Figures, Gate, MOST_COALITIONS, Passes, Pruning};
pub use crowd::{Crowd, MOST_DELAYS, Travel};
pub use floor::{Floor, On, Place, Spot};
pub use ground::{Asked, MOST_PAIRED, MOST_PLANNED, Ways};
pub use reader::{FAULTS, FaultsOfTeam};
pub use reasons::{Contest, Counted, Lack, Offer, Reasons};
pub use seat::{Seat, Stay};
pub use supply::Supply;
pub use trust::{FailureRates, Trust};
pub use worker::{Row, SLOTS, USUAL, WORDS, drive_ms, pace, power, steps, usual};

use super::capability::{Capability, CapabilitySet, Robot, Skill};
use super::constraint::Constraint;
use super::task::{Action, ActionPlan, Role};
use crate::robots::RobotFile;
use cotama_core::team::Combine;

/// Reads the drink service of the thesis (3.6), run 2, which is shipped.
///
/// # Errors
/// Never: a test reads it.
pub fn service() -> Result<Scenario, crate::missions::MissionErrors> {
    Scenario::parse("service", include_str!("../../../teams/service.toml"))
}

/// A robot of the team.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotSpec {
    /// Name of the robot.
    pub name: String,
    /// Motion, failures and supervisors of the robot.
    pub file: RobotFile,
    /// Capabilities and their reliability.
    pub skills: Vec<Skill>,
    /// How often uses of them fail.
    pub fails: FailureRates,
    /// Start on the floor.
    pub start: Place,
    /// When it is part of the team.
    pub stay: Stay,
    /// Battery and way home; `None` where nobody counts the energy of the robot.
    pub supply: Option<Supply>,
}

impl RobotSpec {
    /// Returns the robot as its bids see it.
    pub fn robot(&self) -> Robot<'_> {
        Robot { name: &self.name, skills: &self.skills }
    }

    /// Returns the capabilities of the robot.
    pub fn capabilities(&self) -> CapabilitySet {
        self.robot().capabilities()
    }
}

/// Something to be done: an object is to come from one place to another, or words are to be said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskSpec {
    /// Name of the task.
    pub name: String,
    /// When it becomes known, in ms.
    pub arrival_ms: u64,
    /// The task that has to be done before this one becomes known.
    pub after: Option<usize>,
    /// Place of its object at the beginning, and the place where the object must be delivered.
    pub start: Place,
    /// Place where the object must be delivered.
    pub goal: Place,
    /// Cost of leaving the task undone, in ms of a robot's time.
    pub utility_ms: u32,
    /// How the costs of roles become one.
    pub combine: Combine,
    /// One of these is carried out.
    pub plans: Vec<PlanSpec>,
}

/// One way to do a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanSpec {
    /// Name of the plan.
    pub name: String,
    /// Yield that the plan lacks to the best plan, in ms.
    pub extra_ms: u32,
    /// A robot for each.
    pub roles: Vec<RoleSpec>,
}

/// The part of one robot in a task: it drives, takes something, drives, and hands it over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RoleSpec {
    /// Name of the role.
    pub name: String,
    /// The capabilities that each of its actions needs; at most
    /// [`MAX_STEPS`](super::MAX_STEPS) actions.
    pub actions: Vec<Needs>,
    /// The object taken, and its place.
    pub take: Take,
    /// To whom it is given, and where.
    pub give: Give,
    /// How long it takes to take it, in ms.
    pub take_ms: u64,
    /// How long it takes to give it, in ms.
    pub give_ms: u64,
}

impl RoleSpec {
    /// Whether these capabilities are enough for all actions (3.6).
    pub fn possible(&self, set: CapabilitySet) -> bool {
        self.actions.iter().all(|it| it.hold(set))
    }

    /// Runs something on the role as bids see it.
    pub fn with_role<R>(&self, act: impl FnOnce(&Role<'_>) -> R) -> R {
        let has = |set: &CapabilitySet| -> Vec<Constraint<'_>> {
            set.iter().map(Constraint::Has).collect()
        };
        let any: Vec<Vec<Vec<Constraint<'_>>>> =
            self.actions.iter().map(|it| it.0.iter().map(has).collect()).collect();
        let all: Vec<Vec<Constraint<'_>>> =
            any.iter().map(|it| it.iter().map(|it| Constraint::Any(it)).collect()).collect();
        let name = self.name.as_str();
        let action = |it| Action { name, needs: Constraint::All(it) };
        let actions: Vec<_> = all.iter().map(|it| action(it.as_slice())).collect();
        act(&Role { name, plans: &[ActionPlan { name, actions: &actions }] })
    }
}

/// The capabilities that an action needs: one of each of these sets (def. 3.9, 3.10).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Needs(pub Vec<CapabilitySet>);

impl Needs {
    /// All of these.
    pub fn all(list: &[Capability]) -> Self {
        Self(list.iter().map(|it| CapabilitySet::of(&[*it])).collect())
    }

    /// Whether these capabilities are enough.
    pub fn hold(&self, set: CapabilitySet) -> bool {
        self.0.iter().all(|any| any.has_any(set))
    }
}

/// The object taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Take {
    /// The object, where it is.
    Object,
    /// The object from the partner before, here.
    Partner(Place),
    /// Nothing: here is something to be said.
    Words(Place),
}

/// To whom it is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Give {
    /// To who waits at the goal of the task.
    Goal,
    /// To the partner behind, here.
    Partner(Place),
    /// To nobody.
    Nobody,
}

/// The stage of a robot in its task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// The robot has no task.
    Rests,
    /// The robot drives to the place where it takes the object.
    ToTake,
    /// The robot takes the object.
    Takes,
    /// The robot drives to the place where it hands the object over.
    ToGive,
    /// The robot hands the object over.
    Gives,
    /// The robot has done its role.
    Done,
    /// The robot is being stopped.
    Stops,
    /// The robot has stopped for good.
    Safe,
}

impl Stage {
    /// All stages.
    pub const ALL: [Self; 8] = [
        Self::Rests,
        Self::ToTake,
        Self::Takes,
        Self::ToGive,
        Self::Gives,
        Self::Done,
        Self::Stops,
        Self::Safe,
    ];

    /// Returns the name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rests => "rests",
            Self::ToTake => "to_take",
            Self::Takes => "takes",
            Self::ToGive => "to_give",
            Self::Gives => "gives",
            Self::Done => "done",
            Self::Stops => "stops",
            Self::Safe => "safe",
        }
    }
}

/// Something that goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Time of the fault.
    pub when: FaultTime,
    /// The kind of fault.
    pub what: FaultKind,
}

/// When something goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultTime {
    /// So long after the start, in ms.
    At(u64),
    /// So many ms after a robot came to a stage of a task, in whichever award of it, for the time
    /// of this number, from 1.
    During {
        /// The robot.
        robot: usize,
        /// The task.
        task: usize,
        /// The stage.
        stage: Stage,
        /// From 1 on.
        time: u32,
        /// So long after.
        after_ms: u64,
    },
}

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A robot fails: a row of its file.
    Robot(usize, Row),
    /// The robot that gives tasks out at that time fails; nobody, where the auctioneer is at a
    /// desk, or where none leads. A row of the first robot's file; the robot fails by the row of
    /// its own file of [the same short name](Scenario::row_of).
    Auctioneer(Row),
    /// The object of a task moves under the hand: it is to be taken again.
    Shifted(usize),
    /// The object of a task turns: these capabilities can no longer take it.
    Turned(usize, CapabilitySet),
}

/// How tasks are given to robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All open tasks at once at the least cost.
    #[default]
    Optimal,
    /// The rounds of the thesis: a task of several robots after the other, then all of one.
    Rounds,
    /// One task after the other, in the order of their coming, each to who asks least.
    OneByOne,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::Optimal, Self::Rounds, Self::OneByOne];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Rounds => "rounds",
            Self::OneByOne => "one-by-one",
        }
    }
}

/// The search for the best coalition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formation {
    /// The auctioneer, from the bids of all.
    #[default]
    Central,
    /// The brokers, each among the coalitions that it answers for (Algorithm A.1).
    Distributed,
}

impl Formation {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Central, Self::Distributed];

    /// Returns the name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Central => "central",
            Self::Distributed => "distributed",
        }
    }
}

/// How good the network is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quality {
    /// The least delay of a message, in ms.
    pub delay_ms: u64,
    /// So much more it may take, evenly, in ms.
    pub jitter_ms: u64,
    /// How many of a thousand messages are lost.
    pub loss_permille: u16,
    /// How many of a thousand arrive twice.
    pub copies_permille: u16,
}

impl Quality {
    /// Nothing is lost or copied.
    pub const PERFECT: Self =
        Self { delay_ms: 5, jitter_ms: 0, loss_permille: 0, copies_permille: 0 };
    /// A wireless network in an office, but for its loss: assumed.
    pub const OFFICE: Self =
        Self { delay_ms: 5, jitter_ms: 45, loss_permille: 0, copies_permille: 5 };
}

/// All that a run needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scenario {
    /// Name of the scenario.
    pub name: String,
    /// The names of capabilities, by their numbers.
    pub skills: Vec<String>,
    /// Places and ways.
    pub floor: Floor,
    /// The ways on which drives are delayed.
    pub crowds: Vec<Crowd>,
    /// The robots; at most [`MAX_ROBOTS`].
    pub robots: Vec<RobotSpec>,
    /// The tasks.
    pub tasks: Vec<TaskSpec>,
    /// The faults.
    pub faults: Vec<Fault>,
    /// How good the network is.
    pub network: Quality,
    /// How tasks are given to robots.
    pub method: Method,
    /// The search for coalitions.
    pub formation: Formation,
    /// The party that gives tasks out.
    pub auctioneer: Seat,
    /// How much more than its bid a role may cost, in thousandths.
    pub slack_permille: u32,
    /// Whether a robot also gives a task back when it costs more than the second-best bid.
    pub second_best: bool,
    /// What bids take the reliability of capabilities to be.
    pub trust: Trust,
    /// Delays on crowded ways, as bids take them to be.
    pub travel: Travel,
    /// The seed of the random numbers of the network, and of uses that fail.
    pub seed: u64,
}

/// The most robots of a team.
pub const MAX_ROBOTS: usize = 64;
/// Value of `format` in files of teams.
pub const FORMAT: &str = "cotama-team/1";
/// The most tasks, faults, and ways between places of a file.
const MANY: usize = 10_000;
