//! The body of a robot on its mission, at the fidelity of the run.

use super::Drive;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_plane::{Course, Rover};

/// Something that goes along a path, and that failures hold back.
pub(crate) trait Moves {
    /// Stands at once.
    fn stand(&mut self);

    /// Goes on for a time towards a speed, no further than an end.
    fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis);
}

impl Moves for Drive {
    fn stand(&mut self) {
        Self::stand(self);
    }

    fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis) {
        Self::go(self, towards, end, time);
    }
}

/// A robot on a line, or one on wheels.
#[derive(Clone, Debug)]
pub(crate) enum Mover<'c> {
    Line {
        drive: Drive,
        /// The way to drive before it gets on along its path.
        owed: Millimetres,
        moved: bool,
    },
    Plane(Box<Rover<'c>>),
}

impl<'c> Mover<'c> {
    /// A robot that stands at the start of its path; on a line where it has no course.
    pub(crate) fn new(acceleration: u64, course: Option<(&'c Course, u64)>) -> Self {
        match course {
            Some((course, seed)) => Self::Plane(Box::new(Rover::new(course, seed))),
            None => Self::Line {
                drive: Drive::new(acceleration.max(1)),
                owed: Millimetres(0),
                moved: false,
            },
        }
    }

    /// Returns the robot on a line.
    pub(crate) const fn line(&self) -> Option<&Drive> {
        match self {
            Self::Line { drive, .. } => Some(drive),
            Self::Plane(_) => None,
        }
    }

    /// Returns the robot on a line.
    pub(crate) const fn line_mut(&mut self) -> Option<&mut Drive> {
        match self {
            Self::Line { drive, .. } => Some(drive),
            Self::Plane(_) => None,
        }
    }

    /// Returns the robot on wheels.
    pub(crate) fn rover(&self) -> Option<&Rover<'c>> {
        match self {
            Self::Line { .. } => None,
            Self::Plane(it) => Some(it),
        }
    }

    /// Returns how far it has come along its path.
    pub(crate) fn x(&self) -> Millimetres {
        match self {
            Self::Line { drive, .. } => drive.x(),
            Self::Plane(it) => it.x(),
        }
    }

    pub(crate) fn speed(&self) -> MillimetresPerSecond {
        match self {
            Self::Line { drive, .. } => drive.speed(),
            Self::Plane(it) => it.speed(),
        }
    }

    /// Whether it stands, and does not turn either.
    pub(crate) fn stands(&self) -> bool {
        match self {
            Self::Line { drive, .. } => drive.speed().0 == 0,
            Self::Plane(it) => it.stands(),
        }
    }

    pub(crate) fn braking_distance(&self) -> Millimetres {
        match self {
            Self::Line { drive, .. } => drive.braking_distance(),
            Self::Plane(it) => it.braking_distance(),
        }
    }

    /// Whether it moved in the last period.
    pub(crate) fn moved(&self) -> bool {
        match self {
            Self::Line { moved, .. } => *moved,
            Self::Plane(it) => it.moved(),
        }
    }

    /// Whether it ran against something.
    pub(crate) fn touches(&self) -> bool {
        self.rover().is_some_and(Rover::touches)
    }

    /// Owes a way beside the path.
    pub(crate) fn owe(&mut self, way: Millimetres) {
        match self {
            Self::Line { owed, .. } => owed.0 += way.0,
            Self::Plane(it) => it.owe(way),
        }
    }

    /// Returns the way that is left beside the path.
    pub(crate) fn owed(&self) -> Millimetres {
        match self {
            Self::Line { owed, .. } => *owed,
            Self::Plane(it) => it.owed(),
        }
    }
}

impl Moves for Mover<'_> {
    fn stand(&mut self) {
        match self {
            Self::Line { drive, .. } => drive.stand(),
            Self::Plane(it) => it.stand(),
        }
    }

    /// Goes on; of its way it takes first what is owed, so that it is as far along its path as it
    /// was.
    fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis) {
        match self {
            Self::Line { drive, owed, moved } => {
                let before = drive.x();
                let stays = end.0 <= before.0;
                let end = Millimetres(if stays { end.0 } else { end.0 + owed.0 });
                drive.go(towards, end, time);
                let way = drive.x().0.saturating_sub(before.0);
                *moved = way > 0;
                let taken = way.min(owed.0);
                drive.set_back(Millimetres(taken));
                owed.0 -= taken;
            }
            Self::Plane(it) => it.go(towards, end, time),
        }
    }
}
