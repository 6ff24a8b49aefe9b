//! The robots of a team as data: each is of a robot's file, and each task is a mission of four
//! objectives.

use super::{RobotSpec, Scenario};
use crate::robots::supervisors::{self, Step};
use crate::robots::{Body, Mode, Robot, RobotFile, members};
use cotama_core::player::Packed;
use cotama_core::units::Milliwatts;
use std::sync::LazyLock;

/// The most words of a marking of a robot's supervisors.
pub const WORDS: usize = 8;
/// The most events that can wait in the mailboxes of a robot's supervisors.
pub const SLOTS: usize = 256;

/// The file of robots that name none.
pub const USUAL: &str = "p3dx-delivery";

static ROBOT: LazyLock<Option<RobotFile>> = LazyLock::new(|| RobotFile::shipped(USUAL));

/// Returns the robot of those that name none.
///
/// # Panics
/// Never: the file is shipped.
pub fn usual() -> RobotFile {
    ROBOT.clone().expect("the file is shipped")
}

/// Returns the objectives of a task for its global supervisor: drive, receive, drive, deliver.
///
/// ```
/// let steps = cotama_models::team::scenario::steps();
/// assert_eq!(steps.iter().filter(|it| it.drives()).count(), 2);
/// assert_eq!(steps[1].ends.as_deref(), Some("object_received"));
/// ```
pub fn steps() -> Vec<Step> {
    let all = [
        ("DriveA", None),
        ("Receive", Some("object_received")),
        ("DriveB", None),
        ("Deliver", Some("object_delivered")),
    ];
    all.map(|(name, ends)| Step { name: name.to_owned(), ends: ends.map(str::to_owned) }).into()
}

/// A failure of a robot of a team: a row of its robot's file, by its number.
///
/// ```
/// use cotama_models::team::scenario::{Row, usual};
/// let file = usual();
/// let stops = Row::named(file.robot(), "EST1").unwrap();
/// assert_eq!((stops.name(file.robot()), Row::all(file.robot()).count()), ("EST1", 47));
/// assert_eq!(Row::named(file.robot(), "EST9"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Row(usize);

impl Row {
    /// All rows, in the order of the file.
    pub fn all(robot: &Robot) -> impl Iterator<Item = Self> + Clone + use<> {
        (0..robot.failures.len()).map(Self)
    }

    /// Returns the row of this number.
    pub const fn new(number: usize) -> Self {
        Self(number)
    }

    /// Returns the row of a short name, for example `MOT1`.
    pub fn named(robot: &Robot, name: &str) -> Option<Self> {
        robot.failure(name).map(Self)
    }

    /// Returns the number of the failure in the robot's file.
    pub const fn number(self) -> usize {
        self.0
    }

    /// Returns the short name; `?` where the file has fewer rows.
    pub fn name(self, robot: &Robot) -> &str {
        robot.failures.get(self.0).map_or("?", |it| it.id.as_str())
    }

    /// Returns the row in words.
    ///
    /// ```
    /// use cotama_models::team::scenario::{Row, usual};
    /// let file = usual();
    /// let silent = Row::named(file.robot(), "SON2").unwrap();
    /// assert_eq!(silent.words(file.robot()), "SON2, sonar array: whole array silent");
    /// ```
    pub fn words(self, robot: &Robot) -> String {
        let Some(row) = robot.failures.get(self.0) else { return "?".to_owned() };
        match row.item.as_str() {
            "" => format!("{}: {}", row.id, row.mode),
            item => format!("{}, {item}: {}", row.id, row.mode),
        }
    }
}

impl Scenario {
    /// Returns the row of this robot that a fault of the auctioneer means: faults of the auctioneer
    /// count rows of the first robot, and mean the row of the same short name.
    pub fn row_of(&self, robot: usize, auctioneers: Row) -> Option<Row> {
        let name = auctioneers.name(self.robots.first()?.file.robot());
        Row::named(self.robots.get(robot)?.file.robot(), name)
    }
}

impl RobotSpec {
    /// Returns the fastest that the robot can drive by itself after these losses, in mm/s; `None`
    /// where it cannot do without the operator.
    pub fn pace(&self, lost: u32) -> Option<u64> {
        pace(self.file.robot(), lost)
    }

    /// Returns how long a drive of the robot over a way takes, the planning before it included, in
    /// ms.
    pub fn drive_ms(&self, way_mm: u64, pace: u64) -> u64 {
        let robot = self.file.robot();
        planning_ms(robot).saturating_add(drive_ms(robot, way_mm, pace))
    }
}

/// Returns the reason why a robot cannot be part of a team, if there is one.
pub(super) fn unfit(robot: &Robot) -> Option<&'static str> {
    if robot.body.is_none() {
        return Some("the file says nothing of its body");
    }
    if pace(robot, 0).is_none() {
        return Some("the robot cannot drive by itself");
    }
    let system = supervisors::of_mission(robot, &steps());
    let packed = system.with(Packed::<WORDS, 0, SLOTS>::of);
    packed.is_err().then_some("the robot has more supervisors than a team can play")
}

/// Returns the fastest that a robot can drive by itself after these losses, in mm/s; `None` where
/// it cannot do without the operator.
///
/// ```
/// use cotama_models::team::scenario::{pace, usual};
/// let file = usual();
/// let sonars = file.robot().losses.losses.iter().position(|it| it.name == "sonar_arrays");
/// let paces = [0, 1 << sonars.unwrap()].map(|lost| pace(file.robot(), lost));
/// assert_eq!(paces, [Some(300), Some(150)]);
/// ```
pub fn pace(robot: &Robot, lost: u32) -> Option<u64> {
    let own = robot.sub_objectives.iter().enumerate();
    let mut own = own.filter(|it| it.1.mode == Mode::Autonomous);
    let slowest = own.try_fold(u64::MAX, |slowest, (number, it)| {
        let best = robot.configurations.get(robot.best(number, lost)?)?;
        Some(if it.moves { slowest.min(best.speed.0) } else { slowest })
    });
    slowest.filter(|it| (1..u64::MAX).contains(it))
}

/// Returns the most power of the hardware of the configurations in which a robot drives by itself
/// when nothing is lost, in mW.
pub(super) fn hardware_power(robot: &Robot) -> u64 {
    let own = robot.sub_objectives.iter().enumerate();
    let own = own.filter(|it| it.1.mode == Mode::Autonomous && it.1.moves);
    let best = own.filter_map(|it| robot.best(it.0, 0));
    best.map(|it| power(robot, it).0).max().unwrap_or(0)
}

/// Returns the power of the hardware that a configuration uses.
///
/// ```
/// use cotama_models::team::scenario::{power, usual};
/// let file = usual();
/// assert_eq!(power(file.robot(), usize::MAX).0, 0); // there is none of this number
/// ```
pub fn power(robot: &Robot, configuration: usize) -> Milliwatts {
    let required = robot.configurations.get(configuration).map_or(0, |it| it.required);
    let modules = members(required).filter_map(|it| robot.modules.get(it));
    let used = modules.fold(0, |all, it| all | it.needs.hardware);
    let used = members(used).filter_map(|it| robot.hardware.get(it));
    Milliwatts(used.fold(0, |all, it| all.saturating_add(it.power.0)))
}

/// Returns how long a robot stands to plan before a drive, in ms.
fn planning_ms(robot: &Robot) -> u64 {
    let own = robot.sub_objectives.iter().enumerate();
    let own = own.filter(|it| it.1.mode == Mode::Autonomous && !it.1.moves);
    let best = own.filter_map(|it| robot.configurations.get(robot.best(it.0, 0)?));
    best.fold(0, |all, it| all.saturating_add(it.takes.0))
}

/// Returns how long a drive over a way from a standstill takes at a pace in mm/s, in ms: the end
/// stops it. A pace of 0 counts as 1.
///
/// ```
/// use cotama_models::team::scenario::{drive_ms, usual};
/// let ms = drive_ms(usual().robot(), 3_000, 600);
/// assert_eq!(ms, 6_000); // 5 s of way, 1 s to speed up
/// ```
pub fn drive_ms(robot: &Robot, way_mm: u64, pace: u64) -> u64 {
    let pace = pace.max(1);
    let acceleration = robot.body.as_ref().map_or(1, |it: &Body| it.acceleration.max(1));
    let way = way_mm.saturating_mul(1_000) / pace;
    way.saturating_add(pace.saturating_mul(1_000) / (2 * acceleration))
}
