//! What a team is to do, and with whom.

use super::floor::{Floor, Place, Spot};
use cotama_core::team::Combine;
use cotama_models::cotama::FailureMode;
pub use cotama_models::team::ErrorClass;
use cotama_models::team::{CapabilitySet, Role, Skill};

/// A robot of the team.
#[derive(Clone, Debug)]
pub struct RobotSpec {
    /// Its name.
    pub name: String,
    /// What it can do, and how reliably.
    pub skills: Vec<Skill>,
    /// Where it begins.
    pub start: Place,
}

impl RobotSpec {
    /// What it can do.
    pub fn capabilities(&self) -> CapabilitySet {
        let there = |it: &&Skill| it.reliability.is_there();
        let all = self.skills.iter().filter(there).map(|it| it.capability);
        all.fold(CapabilitySet::NONE, CapabilitySet::with)
    }
}

/// Something to be done: an object is to come from one place to another, or words are to be said.
#[derive(Clone, Debug)]
pub struct TaskSpec {
    /// Its name.
    pub name: String,
    /// When it becomes known, in ms.
    pub arrival_ms: u64,
    /// It becomes known when this task is done, and not before.
    pub after: Option<usize>,
    /// Where its object is at the beginning, and where it is to come to.
    pub start: Place,
    /// See `start`.
    pub goal: Place,
    /// What it costs to leave it undone, in ms of a robot's time.
    pub utility_ms: u32,
    /// How the costs of roles become one.
    pub combine: Combine,
    /// One of these is carried out.
    pub plans: Vec<PlanSpec>,
}

/// One way to do a task.
#[derive(Clone, Debug)]
pub struct PlanSpec {
    /// Its name.
    pub name: String,
    /// What it yields less than the best plan, in ms.
    pub extra_ms: u32,
    /// A robot for each.
    pub roles: Vec<RoleSpec>,
}

/// What one robot does: it drives, takes something, drives, and gives it to somebody.
#[derive(Clone, Debug)]
pub struct RoleSpec {
    /// What it needs.
    pub role: &'static Role<'static>,
    /// What is taken, and where.
    pub take: Take,
    /// To whom it is given, and where.
    pub give: Give,
    /// How long it takes to take it, in ms.
    pub take_ms: u64,
    /// How long it takes to give it, in ms.
    pub give_ms: u64,
}

/// What is taken.
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

/// What a bidder asks for a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offer {
    /// The task.
    pub task: usize,
    /// The plan of it.
    pub plan: usize,
    /// The role of that.
    pub role: usize,
    /// What it costs, in ms.
    pub cost_ms: u32,
}

/// A coalition that a broker bids.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Share {
    /// The task.
    pub task: usize,
    /// The plan of it.
    pub plan: usize,
    /// The robot of each role, and what it costs there, in ms.
    pub robots: Vec<(usize, u32)>,
    /// What the task costs, in parts.
    pub cost: u64,
}

/// Where a robot is in its task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// It has none.
    Rests,
    /// It drives to where something is taken.
    ToTake,
    /// It takes it.
    Takes,
    /// It drives to where it is given.
    ToGive,
    /// It gives it.
    Gives,
    /// It has done its role.
    Done,
    /// It is being stopped.
    Stops,
    /// It has stopped for good.
    Safe,
}

/// Something that goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// When.
    pub when: FaultTime,
    /// What.
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

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A robot fails.
    Robot(usize, FailureMode),
    /// The object of a task moves under the hand: it is to be taken again.
    Shifted(usize),
    /// The object of a task turns: two fingers can no longer grasp it.
    Turned(usize),
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
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Rounds => "rounds",
            Self::OneByOne => "one-by-one",
        }
    }
}

/// Who looks for the best coalition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formation {
    /// The auctioneer, from the bids of all.
    #[default]
    Central,
    /// The brokers, each among the coalitions that it answers for (Algorithm A.1).
    Distributed,
}

/// All that a run needs.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// Places and ways.
    pub floor: Floor,
    /// Who is there; at most [`MAX_ROBOTS`].
    pub robots: Vec<RobotSpec>,
    /// What is to be done.
    pub tasks: Vec<TaskSpec>,
    /// What goes wrong.
    pub faults: Vec<Fault>,
    /// How good the network is.
    pub network: super::network::Quality,
    /// How tasks are given to robots.
    pub method: Method,
    /// Who looks for coalitions.
    pub formation: Formation,
    /// At which robot the auctioneer is; if none it is at a desk of its own.
    pub auctioneer: Option<usize>,
    /// How much more than its bid a role may cost, in thousandths.
    pub slack_permille: u32,
    /// Whether a robot also gives a task back when it costs more than the second-best bid.
    pub second_best: bool,
    /// The seed of the network's random numbers.
    pub seed: u64,
}

/// The most robots of a team.
pub const MAX_ROBOTS: usize = 64;

/// The object of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Object {
    pub(super) at: Whereabouts,
    /// Two fingers can grasp it.
    pub(super) handle: bool,
}

/// Where an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whereabouts {
    Lies(Spot),
    Held(usize),
    Delivered,
}
