//! The result of a run.

use cotama_core::hardware::Equipment;
use cotama_core::units::Millis;
use cotama_models::margins::Spent;
use cotama_models::missions::infeasible::amount;
use cotama_models::missions::{AXES, Mission};
use serde::{Deserialize, Serialize};

/// The most replans of a run; the robot stops safely when one more is asked for.
pub const MAX_REPLANS: u64 = 10_000;
/// The most checks of the margins in a run; the robot stops safely when one more is due.
pub const MAX_CHECKS: u64 = 1_000_000;
/// A supervised run ends after this time, whatever it does.
pub const LONGEST: Millis = Millis(3_600_000);

/// The result of a run: a few numbers and its plans.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::run::Outcome;
/// use cotama_sim::{options::Options, setup::Simulation};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let run = Simulation::new(&mission, &Options::default()).unwrap().run(0).unwrap();
/// assert_eq!((run.outcome, run.margins), (Outcome::Completed, [51_699, 26_682]));
/// let causes: Vec<_> = run.plans.iter().map(|it| it.cause.text(&mission)).collect();
/// assert_eq!(causes[..2], ["start", "energy margin below zero"]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// Why it is not completed; none if it is.
    pub reason: Option<Reason>,
    /// The plans in the order of time: the first one is that of the start.
    pub plans: Vec<PlanMade>,
    /// How many plans there were after the first.
    pub replans: u64,
    /// How often the operator was asked.
    pub operator_requests: u64,
    /// Limits less used at the end (ms, mJ); nothing is planned any more.
    pub margins: [i64; 2],
    /// Amounts used (ms, mJ), rounded half up.
    pub used: [u64; 2],
    /// The time used, in µs, exact.
    pub time_us: u64,
    /// The energy used, in pJ, exact.
    pub energy_pj: u128,
    /// How far the robot came, in whole mm of path.
    pub x_mm: u64,
    /// Counts of the events.
    pub events: EventCounts,
    /// How often the margins were checked.
    pub checks: u64,
    /// Amounts of each activity that it came to, in their order.
    pub spent: Vec<Spent>,
}

/// How a mission ended.
///
/// ```
/// use cotama_sim::run::Outcome;
/// let names = [Outcome::Completed, Outcome::Safe, Outcome::Failed].map(Outcome::name);
/// assert_eq!(names, ["completed", "safe", "failed"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// All activities are done, within the limits.
    Completed,
    /// The robot stopped safely, within its limits: no plan was left, or the supervisors ended the
    /// mission.
    Safe,
    /// A limit is exceeded, whatever else: all activities may be done, or the robot stands. A
    /// supervised run also fails when it is not over after [`LONGEST`].
    Failed,
}

impl Outcome {
    /// Returns the name in traces and answers: `completed`, `safe`, `failed`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Safe => "safe",
            Self::Failed => "failed",
        }
    }
}

/// How many events of each kind happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EventCounts {
    /// Obstacles.
    pub obstacles: u64,
    /// Faults of hardware.
    pub faults: u64,
    /// Repairs of hardware.
    pub repairs: u64,
    /// Wrong odometry.
    pub odometry: u64,
}

impl EventCounts {
    /// Returns the number of all events.
    pub const fn total(&self) -> u64 {
        self.obstacles + self.faults + self.repairs + self.odometry
    }
}

/// A plan that came into force.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanMade {
    /// The cause of the plan.
    pub cause: PlanCause,
    /// When, in µs.
    pub t_us: u64,
    /// Position, in whole mm of path.
    pub x_mm: u64,
    /// The index of its first activity.
    pub first_activity: usize,
    /// For each activity from the first on, the index of its alternative.
    pub choice: Vec<u16>,
    /// The margins that the plan before would have had (ms, mJ); none at the start.
    pub before: Option<[i64; 2]>,
    /// The margins of this plan (ms, mJ).
    pub after: [i64; 2],
    /// Amounts used so far (ms, mJ).
    pub used: [u64; 2],
    /// The planned cost of what is left of its first activity (ms, mJ); the others are whole.
    pub first_cost: [u32; 2],
    /// The steps of the allocator.
    pub steps: u64,
    /// The allocator that found it: `panorama`, `exact` or, by the wishes of a mission with axes,
    /// `axes`.
    pub allocator: &'static str,
    /// The hardware that works, where its loss changes speeds.
    pub slowed_by: Option<Equipment>,
}

/// Why a plan was needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlanCause {
    /// The mission starts.
    Start,
    /// The margin of this axis is below zero.
    Margin {
        /// The axis.
        axis: usize,
    },
    /// The margin of a further sum is below zero, in a mission with axes.
    End {
        /// The end constraint, by its number among those of the scenario.
        end: usize,
    },
    /// The plan needs hardware that failed.
    Hardware {
        /// The index of the hardware.
        hardware: usize,
        /// The units lost.
        units: u8,
    },
    /// Hardware that had failed works again.
    Returned {
        /// The index of the hardware.
        hardware: usize,
    },
    /// A failure of a robot's file, by its number, took something that the plan needs.
    Failure(usize),
    /// Parts that a loss of a robot's file, by its number, took work again.
    Works(usize),
    /// The margins leave room for a better plan.
    Room,
}

impl PlanCause {
    /// In words: `start`, `energy margin below zero`, `one laser lost`, `no scan (LID1)`, `room for
    /// a better plan`.
    pub fn text(self, mission: &Mission) -> String {
        match self {
            Self::Start => "start".into(),
            Self::Margin { axis } => format!("{} margin below zero", AXES[axis.min(1)]),
            Self::End { end } => format!("{} margin below zero", name_of(mission, end)),
            Self::Hardware { hardware, units } => {
                const NUMBERS: [&str; 8] =
                    ["no", "one", "two", "three", "four", "five", "six", "seven"];
                let name = mission.hardware.get(hardware).map_or("hardware", |it| it.name.as_str());
                let plural = if units == 1 || name.ends_with('s') { "" } else { "s" };
                format!("{} {name}{plural} lost", NUMBERS[usize::from(units).min(7)])
            }
            Self::Returned { hardware } => {
                let name = mission.hardware.get(hardware).map_or("hardware", |it| it.name.as_str());
                format!("{name} back")
            }
            Self::Failure(it) => failure(mission, it),
            Self::Works(it) => {
                let losses = mission.robot().map(|it| &it.robot().losses.losses);
                let name = losses.and_then(|all| all.get(it)).map_or("a part", |it| &it.name);
                format!("{name} back")
            }
            Self::Room => "room for a better plan".into(),
        }
    }
}

/// A failure of the robot of a mission in words: `no scan (LID1)`.
fn failure(mission: &Mission, number: usize) -> String {
    let row = mission.robot().and_then(|it| it.robot().failures.get(number));
    row.map_or_else(|| "a failure".to_owned(), |it| format!("{} ({})", it.mode, it.id))
}

/// Why a mission is not completed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// No plan was found for what is left.
    NoPlan(NoPlan),
    /// A limit is exceeded.
    LimitExceeded {
        /// The axis.
        axis: usize,
        /// By how much, in ms or mJ.
        by: u64,
    },
    /// An end constraint of a mission with axes does not hold.
    EndMissed {
        /// Its number among those of the scenario.
        end: usize,
        /// By how much, in the unit of its indicator.
        by: u64,
    },
    /// [`MAX_REPLANS`] plans were made, and one more was asked for.
    TooManyReplans,
    /// The margins were checked [`MAX_CHECKS`] times.
    TooManyChecks,
    /// The operator gave up, and the global supervisor ended the mission.
    GivenUp,
    /// The global supervisor ended the mission for a failure of a robot's file, by its number.
    EndedBy {
        /// Number of the failure.
        failure: usize,
    },
    /// The laptop is down: the micro-controller has stopped the robot.
    Mindless,
    /// A supervised mission was not done after [`LONGEST`].
    TooLong,
    /// The robot ran against something, in the plane.
    Touched,
    /// A door has closed, and nothing leads to the goal of a drive any more.
    Blocked {
        /// Number of the drive.
        drive: usize,
        /// Number of the door.
        door: usize,
    },
}

/// Why no plan was found.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::run::NoPlan;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let short = NoPlan::Limit { axis: 1, short: 355_896 };
/// assert_eq!(short.text(&mission), "no plan within the energy limit: 355.896 J short");
/// assert_eq!(NoPlan::Emptied { activity: 3 }.text(&mission), "no alternative left for A4");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NoPlan {
    /// A limit cannot be met, as far as the allocator can tell.
    Limit {
        /// The axis.
        axis: usize,
        /// Amount missing on the axis, in ms or mJ.
        short: u64,
    },
    /// No plan is within the limits, and the search was cut short before it was known which of them
    /// cannot be met.
    Infeasible,
    /// The hardware that works covers no alternative of an activity.
    Emptied {
        /// The index of the activity.
        activity: usize,
    },
    /// The search was cut short by its budget.
    Unknown {
        /// The steps taken.
        steps: u64,
    },
}

/// Returns the name of an end constraint, by its number among those of the scenario.
fn name_of(mission: &Mission, end: usize) -> &str {
    let end = mission.scenario().ends.get(end).map(|it| it.constraint);
    let constraints = mission.axes.as_ref().map(|it| &it.mission.constraints);
    constraints.zip(end).and_then(|(all, it)| all.get(it)).map_or("further", |it| &it.id)
}

impl NoPlan {
    /// In words, with ids of the mission.
    pub fn text(self, mission: &Mission) -> String {
        match self {
            Self::Limit { axis, short } => {
                let axis = axis.min(1);
                format!("no plan within the {} limit: {} short", AXES[axis], amount(axis, short))
            }
            Self::Emptied { activity } => {
                let id =
                    mission.scenario().activities.get(activity).map_or("?", |it| it.id.as_str());
                format!("no alternative left for {id}")
            }
            Self::Infeasible => "no plan within the limits".into(),
            Self::Unknown { steps } => format!("no plan found in {steps} steps"),
        }
    }
}

impl Reason {
    /// In words, with ids of the mission.
    pub fn text(self, mission: &Mission) -> String {
        match self {
            Self::NoPlan(none) => none.text(mission),
            Self::LimitExceeded { axis, by } => {
                let axis = axis.min(1);
                format!("{} limit exceeded by {}", AXES[axis], amount(axis, by))
            }
            Self::EndMissed { end, by } => {
                format!("`{}` does not hold, by {by}", name_of(mission, end))
            }
            Self::TooManyReplans => format!("stopped after {MAX_REPLANS} replans"),
            Self::TooManyChecks => format!("stopped after {MAX_CHECKS} checks"),
            Self::Blocked { drive, door } => {
                let way = mission.way.as_ref();
                let goal = way.and_then(|it| it.asked.to.get(drive)).map_or("its goal", |it| it);
                let doors = way.and_then(|it| it.doors.as_ref().ok());
                let door = doors.and_then(|it| it.get(door)).map_or("a door", |it| it);
                format!("nothing leads to `{goal}` any more: `{door}` is closed")
            }
            Self::GivenUp => {
                "the operator gave up, and the global supervisor ended the mission".into()
            }
            Self::EndedBy { failure: it } => {
                format!("the global supervisor ended the mission: {}", failure(mission, it))
            }
            Self::Mindless => "the laptop is down; the micro-controller stopped the motors".into(),
            Self::Touched => "it ran against something".into(),
            Self::TooLong => format!("not done after {} s", LONGEST.0 / 1000),
        }
    }
}
