//! The party that gives the tasks of a team out, and when a robot is part of it.

/// The party that gives the tasks of a team out (Rohrmueller, TUM 2011, 3.6.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seat {
    /// A desk of its own, which never fails (strategy i).
    #[default]
    Desk,
    /// A robot, with whose laptop it fails for good (strategy ii).
    Robot(usize),
    /// A robot; when it fails, the next one that is there takes over (strategy iii).
    Queue(usize),
}

impl Seat {
    /// Returns the robot that gives tasks out at the beginning, if it is one.
    pub const fn robot(self) -> Option<usize> {
        match self {
            Self::Desk => None,
            Self::Robot(it) | Self::Queue(it) => Some(it),
        }
    }
}

/// When a robot is part of a team.
///
/// ```
/// use cotama_models::team::scenario::Stay;
/// let day = Stay { joins_ms: 60_000, leaves_ms: Some(90_000) };
/// assert_eq!([0, 60_000, 90_000].map(|it| day.works(it)), [false, true, false]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stay {
    /// The moment from which it is there, in ms.
    pub joins_ms: u64,
    /// The moment from which it takes no new task, and goes when it has none, in ms.
    pub leaves_ms: Option<u64>,
}

impl Stay {
    /// Whether the robot takes tasks at this time.
    pub const fn works(self, now_ms: u64) -> bool {
        let stays = match self.leaves_ms {
            Some(leaves) => now_ms < leaves,
            None => true,
        };
        self.joins_ms <= now_ms && stays
    }
}
