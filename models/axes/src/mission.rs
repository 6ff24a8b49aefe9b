//! Missions with performance axes, as data (Lambert et al. 2024, Sections 2 and 6.1).

use crate::formula::Formula;
use crate::speeds::Speeds;

/// Named whole numbers of a part of the mission, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Attributes(pub(crate) Vec<(String, i64)>);

impl FromIterator<(String, i64)> for Attributes {
    fn from_iter<I: IntoIterator<Item = (String, i64)>>(all: I) -> Self {
        Self(all.into_iter().collect())
    }
}

impl Attributes {
    /// Returns the number of this name.
    pub fn get(&self, key: &str) -> Option<i64> {
        self.0.iter().find(|it| it.0 == key).map(|it| it.1)
    }

    /// Puts another number in the place of one that is there.
    pub(crate) fn set(&mut self, key: &str, value: i64) {
        if let Some(own) = self.0.iter_mut().find(|it| it.0 == key) {
            own.1 = value;
        }
    }
}

/// A mission whose performance is judged on any number of axes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mission {
    /// Name of the mission.
    pub name: String,
    /// Attributes of the robot: mass, braking and the like.
    pub robot: Attributes,
    /// Speeds that the robot drives.
    pub speeds: Speeds,
    /// Attributes of the laptop, which has a battery of its own.
    pub laptop: Attributes,
    /// Power of motion at `v` mm/s: `c0 + c1 v / 1000 + c2 v v / 1000000` mW, rounded half up.
    pub motion_power: [i64; 3],
    /// The detectors whose period counts for obstacles.
    pub detect_by: DetectBy,
    /// Hardware, by kind.
    pub hardware: Vec<Hardware>,
    /// Task implementation options (TIO, Section 6.2.2).
    pub options: Vec<Tio>,
    /// Objectives, in sequence.
    pub objectives: Vec<Objective>,
    /// Zones of the path, which may lie over one another.
    pub zones: Vec<Zone>,
    /// Points of view on performance (Section 6.1.1).
    pub axes: Vec<Axis>,
    /// Measures of performance, in the order of their axes (Section 6.1.2).
    pub indicators: Vec<Indicator>,
    /// Constraints on indicators (Section 6.1.3), in the order of treatment.
    pub constraints: Vec<Constraint>,
}

/// The detectors whose period counts for the avoidance of obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DetectBy {
    /// The fastest of the robot that sees in the zones here; Tables 6 and 7 need it.
    Zone,
    /// The fastest that the moving option itself uses, as Section 6.1.4 says.
    Option,
}

/// A kind of hardware.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// Name of the kind.
    pub id: String,
    /// Number that the robot has.
    pub units: i64,
    /// Attributes of one unit.
    pub attributes: Attributes,
}

/// A task implementation option: hardware and software for a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tio {
    /// Name of the option.
    pub id: String,
    /// Name of its task.
    pub task: String,
    /// Units that it needs, one number a kind of hardware.
    pub needs: Vec<i64>,
    /// The highest speed that it drives itself, mm/s, where that is below the robot's.
    pub most_mm_s: Option<i64>,
    /// Attributes, as the load of its software.
    pub attributes: Attributes,
}

/// The task of localisation, which goes along with another one.
pub const LOCALISATION: &str = "LOC";

impl Tio {
    /// Whether the option itself moves, turns or detects, and does not only localise.
    pub fn leads(&self) -> bool {
        self.task != LOCALISATION
    }
}

/// An objective.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Name of the objective.
    pub id: String,
    /// The begin on the path, mm.
    pub x_start_mm: i64,
    /// The end; the begin if the robot stands.
    pub x_end_mm: i64,
    /// For each of its tasks the options, by index.
    pub tasks: Vec<Vec<usize>>,
}

/// A stretch of the path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Zone {
    /// Name of the zone.
    pub id: String,
    /// The begin, mm.
    pub x_start_mm: i64,
    /// The end, mm.
    pub x_end_mm: i64,
    /// Kinds of hardware that see no obstacles here, by index.
    pub blind: Vec<usize>,
    /// The option that must be one of those taken here, by index.
    pub require_tio: Option<usize>,
    /// The hardware that the leading option must need here, by index.
    pub require_hardware: Option<usize>,
    /// The highest speed that is allowed here, mm/s, whatever formulas say.
    pub most_mm_s: Option<i64>,
    /// Attributes, as the width.
    pub attributes: Attributes,
}

/// A point of view on performance (Section 6.1.1).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Name of the axis.
    pub id: String,
    /// Whether it is always considered: safety, energy, localisation, stability. None if unsaid.
    pub is_major: Option<bool>,
}

/// A measure on an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indicator {
    /// Name with that of its axis, as `energy.RC`.
    pub id: String,
    /// The axis, by index.
    pub axis: usize,
    /// Unit of the values, in words.
    pub unit: String,
    /// Whether values add up along the mission (equation 3), or each activity has its own.
    pub adds_up: bool,
    /// Value of an activity that travels; none where the indicator does not apply.
    pub travel: Option<Formula>,
    /// Value of an activity that stands.
    pub stand: Option<Formula>,
}

impl Indicator {
    /// The formula of activities that travel, or of those that stand.
    pub fn formula(&self, travels: bool) -> Option<&Formula> {
        if travels { self.travel.as_ref() } else { self.stand.as_ref() }
    }
}

/// A constraint: indicator, operator, goal (Section 6.1.3).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraint {
    /// Name of the constraint.
    pub id: String,
    /// The indicator, by index.
    pub indicator: usize,
    /// When it must hold.
    pub kind: Kind,
    /// Relation of the value to the goal.
    pub relation: Relation,
    /// The goal, in the unit of the indicator.
    pub goal: i64,
    /// Other goals in zones, by index: a goal that varies along the mission (equation 1).
    pub at: Vec<(usize, i64)>,
}

impl Constraint {
    /// The goal in these zones: the strictest said for one of them, else the general one.
    pub fn goal_in(&self, zones: &[usize]) -> i64 {
        let here = self.at.iter().filter(|it| zones.contains(&it.0)).map(|it| it.1);
        let strictest = match self.relation {
            Relation::Below | Relation::AtMost => here.min(),
            Relation::Equal | Relation::AtLeast | Relation::Above => here.max(),
        };
        strictest.unwrap_or(self.goal)
    }
}

/// When a constraint must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// In every activity, for its own value (equation 1): bounds speeds, drops candidates.
    Core,
    /// At the end of the mission, for the sum (equation 2).
    End,
    /// After each activity, for the sum so far: equation 1 for a quantity that adds up. No example
    /// of the paper has one; a reading of this project.
    Running,
}

impl Kind {
    /// The word of files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Core => "core",
            Self::End => "end",
            Self::Running => "running",
        }
    }
}

/// Relation that a value must have to a goal (Section 6.1.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `<`
    Below,
    /// `<=`
    AtMost,
    /// `=`
    Equal,
    /// `>=`
    AtLeast,
    /// `>`
    Above,
}

impl Relation {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Below, Self::AtMost, Self::Equal, Self::AtLeast, Self::Above];

    /// The sign of files.
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Below => "<",
            Self::AtMost => "<=",
            Self::Equal => "=",
            Self::AtLeast => ">=",
            Self::Above => ">",
        }
    }

    /// Whether a value stands so to a goal.
    pub const fn holds(self, value: i64, goal: i64) -> bool {
        match self {
            Self::Below => value < goal,
            Self::AtMost => value <= goal,
            Self::Equal => value == goal,
            Self::AtLeast => value >= goal,
            Self::Above => value > goal,
        }
    }

    /// Returns the margin of a value (Section 7.2.3, equation 7): the goal less the value; with the
    /// sign turned for an `at least`; of an equality the distance, below zero.
    pub const fn margin(self, value: i64, goal: i64) -> i64 {
        match self {
            Self::Below => goal - 1 - value,
            Self::AtMost => goal - value,
            Self::Equal => -(goal - value).abs(),
            Self::AtLeast => value - goal,
            Self::Above => value - goal - 1,
        }
    }

    /// The most that a value may be.
    pub(crate) const fn most(self, goal: i64) -> Option<i64> {
        match self {
            Self::Below => Some(goal - 1),
            Self::AtMost | Self::Equal => Some(goal),
            Self::AtLeast | Self::Above => None,
        }
    }

    /// The least that a value may be.
    pub(crate) const fn least(self, goal: i64) -> Option<i64> {
        match self {
            Self::Above => Some(goal + 1),
            Self::AtLeast | Self::Equal => Some(goal),
            Self::AtMost | Self::Below => None,
        }
    }
}

/// Sense of an objective on a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// Little is good.
    Min,
    /// Much is good.
    Max,
}

/// Wish for little or much of a sum over the mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ask {
    /// Whether little or much is good.
    pub sense: Sense,
    /// The indicator, by index; its values add up.
    pub indicator: usize,
}

impl Mission {
    /// Returns the indicator of this name, by index.
    pub fn indicator(&self, id: &str) -> Option<usize> {
        self.indicators.iter().position(|it| it.id == id)
    }

    /// Returns the constraint of this name, by index.
    pub fn constraint(&self, id: &str) -> Option<usize> {
        self.constraints.iter().position(|it| it.id == id)
    }
}

/// Constraints that are left out, as a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Lifted(pub(crate) u32);

impl Lifted {
    /// The same set with one more constraint, by index.
    #[must_use]
    pub const fn with(self, constraint: usize) -> Self {
        Self(self.0 | if constraint < 32 { 1 << constraint } else { 0 })
    }

    /// Whether a constraint is left out.
    pub const fn has(self, constraint: usize) -> bool {
        constraint < 32 && self.0 >> constraint & 1 == 1
    }

    /// Whether all of another set are in this one.
    pub const fn covers(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The constraints of the set, by index.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..32).filter(move |&it| self.has(it))
    }
}
