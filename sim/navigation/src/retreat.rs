//! A short way back, to recover.

use crate::braking::Braking;
use crate::local_map::LocalMap;
use crate::work::Work;
use cotama_floor::Pose;
use cotama_plane::Command;

/// State of a way back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Still going.
    Going,
    /// The length was driven.
    Done,
    /// Something is known to be behind.
    Blocked,
    /// The periods ran out.
    Late,
}

/// A straight way back, bounded in length and in periods; it begins again only if made anew.
#[derive(Clone, Debug)]
pub struct Retreat {
    braking: Braking,
    speed: f64,
    left_m: f64,
    periods: u32,
    progress: Progress,
    work: Work,
}

impl Retreat {
    /// The longest way back, in metres.
    pub const MOST_M: f64 = 2.0;

    /// A way back of a length in metres, up to [`MOST_M`](Self::MOST_M), at a speed in m/s, and in
    /// at most so many periods.
    pub fn new(braking: Braking, length_m: f64, speed: f64, periods: u32) -> Self {
        let (left_m, speed) = (length_m.clamp(0.0, Self::MOST_M), speed.abs());
        Self { braking, speed, left_m, periods, progress: Progress::Going, work: Work::default() }
    }

    /// Returns the speeds of the next period, after a motion that odometry tells. Once it is not
    /// going any more, it stands.
    pub fn command(&mut self, map: &LocalMap, now: Command, motion: &Pose) -> Command {
        self.left_m += motion.translation.x;
        if self.progress == Progress::Going {
            if self.left_m <= now.speed * now.speed / (2.0 * self.braking.limits.acceleration) {
                self.progress = Progress::Done;
            } else if self.periods == 0 {
                self.progress = Progress::Late;
            }
            self.periods = self.periods.saturating_sub(1);
        }
        if self.progress != Progress::Going {
            return Command::default();
        }
        let back = Command { speed: -self.speed, turn: 0.0 };
        self.braking.look(now, map, &mut self.work);
        if self.braking.room(now, back, &mut self.work).is_none() {
            self.progress = Progress::Blocked;
            return Command::default();
        }
        back
    }

    /// Returns how it stands with it.
    pub const fn progress(&self) -> Progress {
        self.progress
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}
