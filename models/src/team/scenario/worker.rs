//! The robots of a team as data: all are of one file, and each task is a mission of four
//! objectives.

use crate::robots::supervisors::Step;
use crate::robots::{Body, Mode, Robot, RobotFile};
use std::sync::LazyLock;

/// The file of the robots of every team.
const FILE: &str = "p3dx-delivery";

static ROBOT: LazyLock<Option<RobotFile>> = LazyLock::new(|| RobotFile::shipped(FILE));

/// Returns the robot of which all robots of a team are; `None` never, as it is shipped.
pub fn robot() -> Option<&'static Robot> {
    ROBOT.as_ref().map(RobotFile::robot)
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

/// A failure of a robot of a team: a row of the robot's file, by its number.
///
/// ```
/// use cotama_models::team::scenario::Row;
/// let stops = Row::named("EST1").unwrap();
/// assert_eq!((stops.name(), Row::all().count()), ("EST1", 47));
/// assert_eq!(Row::named("EST9"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Row(usize);

impl Row {
    /// All rows, in the order of the file.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        (0..robot().map_or(0, |it| it.failures.len())).map(Self)
    }

    /// Returns the row of this number; `None` if the file has fewer.
    pub fn new(number: usize) -> Option<Self> {
        Self::all().nth(number)
    }

    /// Returns the row of a short name, for example `MOT1`.
    pub fn named(name: &str) -> Option<Self> {
        robot()?.failure(name).map(Self)
    }

    /// Returns the number of the failure in the robot's file.
    pub const fn number(self) -> usize {
        self.0
    }

    /// Returns the short name.
    pub fn name(self) -> &'static str {
        self.of().map_or("?", |it| it.id.as_str())
    }

    /// Returns the row in words.
    ///
    /// ```
    /// use cotama_models::team::scenario::Row;
    /// let silent = Row::named("SON2").unwrap();
    /// assert_eq!(silent.words(), "SON2, sonar array: whole array silent");
    /// ```
    pub fn words(self) -> String {
        let Some(row) = self.of() else { return String::new() };
        match row.item.as_str() {
            "" => format!("{}: {}", row.id, row.mode),
            item => format!("{}, {item}: {}", row.id, row.mode),
        }
    }

    /// Returns the mean time between two such failures, in thousandths of an hour; `None` where
    /// nobody knows.
    pub fn mean_mh(self) -> Option<u64> {
        self.of()?.mean_mh
    }

    fn of(self) -> Option<&'static crate::robots::Failure> {
        robot()?.failures.get(self.0)
    }
}

/// Returns the fastest that a robot can drive by itself after these losses, in mm/s; `None` where
/// it cannot do without the operator.
///
/// ```
/// use cotama_models::team::scenario::{pace, robot};
/// let sonars = robot().unwrap().losses.losses.iter().position(|it| it.name == "sonar_arrays");
/// assert_eq!([0, 1 << sonars.unwrap()].map(pace), [Some(300), Some(150)]);
/// ```
pub fn pace(lost: u32) -> Option<u64> {
    let robot = robot()?;
    let own = robot.sub_objectives.iter().enumerate();
    let mut own = own.filter(|it| it.1.mode == Mode::Autonomous);
    let slowest = own.try_fold(u64::MAX, |slowest, (number, it)| {
        let best = robot.configurations.get(robot.best(number, lost)?)?;
        Some(if it.moves { slowest.min(best.speed.0) } else { slowest })
    });
    slowest.filter(|it| (1..u64::MAX).contains(it))
}

/// Returns how long a robot stands to plan before a drive, in ms.
pub fn planning_ms() -> u64 {
    let Some(robot) = robot() else { return 0 };
    let own = robot.sub_objectives.iter().enumerate();
    let own = own.filter(|it| it.1.mode == Mode::Autonomous && !it.1.moves);
    let best = own.filter_map(|it| robot.configurations.get(robot.best(it.0, 0)?));
    best.fold(0, |all, it| all.saturating_add(it.takes.0))
}

/// How long a drive over a way from a standstill takes at a pace in mm/s, in ms: the end stops it.
/// A pace of 0 counts as 1.
///
/// ```
/// use cotama_models::team::scenario::drive_ms;
/// assert_eq!(drive_ms(3_000, 600), 6_000); // 5 s of way, 1 s to speed up
/// ```
pub fn drive_ms(way_mm: u64, pace: u64) -> u64 {
    let pace = pace.max(1);
    let body = robot().and_then(|it| it.body.as_ref());
    let acceleration = body.map_or(1, |it: &Body| it.acceleration.max(1));
    let way = way_mm.saturating_mul(1_000) / pace;
    way.saturating_add(pace.saturating_mul(1_000) / (2 * acceleration))
}
