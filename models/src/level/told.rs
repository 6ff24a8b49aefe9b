//! Words for the supervisors, and places of theirs.

use cotama_core::player::Stored;

/// The cause of an event: a number that the caller chose, for example the position of a fault in
/// its list. It travels with everything that is done because of the event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cause(pub u16);

/// As its number.
impl Stored for Cause {
    const BYTES: usize = u16::BYTES;

    fn write(&self, bytes: &mut [u8]) {
        self.0.write(bytes);
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        u16::read(bytes).map(Self)
    }
}

/// Something that the supervisors are told from outside; one in a round keeps the runs those that
/// were checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Told {
    /// The mission begins; of a robot without one, a drive.
    Begins,
    /// The task for which the robot stands in an objective, by its number, is done.
    Over(usize),
    /// The robot stands, after the mission was ended.
    Stopped,
    /// A sub-objective, by its number, is reached.
    Reached(usize),
    /// A report, by its number.
    Report(usize),
    /// Parts that a loss, by its number, took work again.
    Back(usize),
    /// The operator chooses one of his sub-objectives, by its number.
    Chooses(usize),
    /// The operator is done with one of his sub-objectives, by its number.
    Done(usize),
    /// The operator gives up, or is silent for too long.
    GivesUp,
}

impl Told {
    /// Returns its kind, from 0 on in the order of the declaration, and the number of what it is
    /// about, 0 where there is none: for frames and for C.
    ///
    /// ```
    /// use cotama_models::level::Told;
    /// assert_eq!(Told::Reached(2).to_numbers(), (3, 2));
    /// assert_eq!(Told::from_numbers(3, 2), Some(Told::Reached(2)));
    /// assert_eq!(Told::from_numbers(0, 2), None); // a beginning has no number
    /// ```
    pub const fn to_numbers(self) -> (u8, usize) {
        match self {
            Self::Begins => (0, 0),
            Self::Over(it) => (1, it),
            Self::Stopped => (2, 0),
            Self::Reached(it) => (3, it),
            Self::Report(it) => (4, it),
            Self::Back(it) => (5, it),
            Self::Chooses(it) => (6, it),
            Self::Done(it) => (7, it),
            Self::GivesUp => (8, 0),
        }
    }

    /// Returns the word of a kind and a number; `None` where they stand for nothing.
    pub const fn from_numbers(kind: u8, number: usize) -> Option<Self> {
        Some(match (kind, number) {
            (0, 0) => Self::Begins,
            (1, _) => Self::Over(number),
            (2, 0) => Self::Stopped,
            (3, _) => Self::Reached(number),
            (4, _) => Self::Report(number),
            (5, _) => Self::Back(number),
            (6, _) => Self::Chooses(number),
            (7, _) => Self::Done(number),
            (8, 0) => Self::GivesUp,
            _ => return None,
        })
    }
}

/// The place of the global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Global {
    /// No mission yet, or no drive.
    Waits,
    /// An objective, by its number, is under way; the drive of a robot without a mission is 0.
    Does(usize),
    /// The mission is accomplished.
    Done,
    /// The mission is ended, the robot still moves.
    Secures,
    /// The mission is ended, the robot stands.
    Safe,
}

/// Decider of the robot's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Mode {
    /// The robot.
    Autonomous,
    /// The operator, by hand or by way-points.
    Operator,
}

/// Place of the robot in its drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Where {
    /// No drive.
    Rests,
    /// The robot stands and waits for the operator, or for its end.
    Waits,
    /// A configuration runs.
    Runs {
        /// The sub-objective.
        sub_objective: usize,
        /// The configuration.
        configuration: usize,
    },
}

impl Where {
    /// Returns the sub-objective that runs; `None` where none does.
    pub const fn sub_objective(self) -> Option<usize> {
        match self {
            Self::Runs { sub_objective, .. } => Some(sub_objective),
            Self::Rests | Self::Waits => None,
        }
    }

    /// Returns the configuration that runs; `None` where none does.
    pub const fn configuration(self) -> Option<usize> {
        match self {
            Self::Runs { configuration, .. } => Some(configuration),
            Self::Rests | Self::Waits => None,
        }
    }

    /// Whether the robot has left this place for another one: not so for another configuration of
    /// the sub-objective that runs.
    pub fn is_left_for(self, next: Self) -> bool {
        self.sub_objective() != next.sub_objective()
            || (self == Self::Waits) != (next == Self::Waits)
    }
}
