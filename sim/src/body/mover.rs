//! The body of a robot on its mission, at the fidelity of the run.

use super::{Drive, FIRMWARE_WATCHDOG};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::robots::{Harmed, Robot};
use cotama_plane::{Course, Met, Rover};
use cotama_senses::{Bench, Senses, Uses};

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

/// The floor of a mission for its runs, and what its robot senses with there.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    pub(crate) course: Course,
    /// `None` where all is told.
    pub(crate) bench: Option<Bench>,
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
    Signal(Box<Sensing<'c>>),
}

/// A robot on wheels that is told nothing.
#[derive(Clone, Debug)]
pub(crate) struct Sensing<'c> {
    rover: Rover<'c>,
    senses: Senses<'c>,
    uses: Uses,
    /// The speed and the end that were commanded last, and for how long no command was heard.
    last: (MillimetresPerSecond, Millimetres),
    unheard: Millis,
}

impl<'c> Mover<'c> {
    /// A robot that stands at the start of its path; on a line where it has no ground.
    pub(crate) fn new(robot: &'c Robot, ground: Option<(&'c Ground, u64)>) -> Self {
        let acceleration = robot.body.as_ref().map_or(1, |it| it.acceleration);
        let line = Self::Line {
            drive: Drive::new(acceleration.max(1)),
            owed: Millimetres(0),
            moved: false,
        };
        let Some((ground, seed)) = ground else { return line };
        let rover = Rover::new(&ground.course, seed);
        let Some(bench) = &ground.bench else { return Self::Plane(Box::new(rover)) };
        match Senses::new(bench, robot, &rover, seed) {
            Ok(senses) => Self::Signal(Box::new(Sensing {
                rover,
                senses,
                uses: Uses::default(),
                last: (MillimetresPerSecond(0), Millimetres(0)),
                unheard: Millis(0),
            })),
            Err(why) => {
                debug_assert!(false, "the bench has the same devices: {why:?}");
                line
            }
        }
    }

    /// Returns the robot on a line.
    pub(crate) const fn line(&self) -> Option<&Drive> {
        match self {
            Self::Line { drive, .. } => Some(drive),
            Self::Plane(_) | Self::Signal(_) => None,
        }
    }

    /// Returns the robot on a line.
    pub(crate) const fn line_mut(&mut self) -> Option<&mut Drive> {
        match self {
            Self::Line { drive, .. } => Some(drive),
            Self::Plane(_) | Self::Signal(_) => None,
        }
    }

    /// Returns the robot on wheels.
    pub(crate) fn rover(&self) -> Option<&Rover<'c>> {
        match self {
            Self::Line { .. } => None,
            Self::Plane(it) => Some(it),
            Self::Signal(it) => Some(&it.rover),
        }
    }

    fn rover_mut(&mut self) -> Option<&mut Rover<'c>> {
        match self {
            Self::Line { .. } => None,
            Self::Plane(it) => Some(it),
            Self::Signal(it) => Some(&mut it.rover),
        }
    }

    /// Returns the flags that signals raise, a bit each; `None` where flags are told.
    pub(crate) fn flags(&self) -> Option<u64> {
        match self {
            Self::Signal(it) => Some(it.senses.flags()),
            Self::Line { .. } | Self::Plane(_) => None,
        }
    }

    /// Tells what runs in this period, and what is harmed.
    pub(crate) fn prepare(&mut self, uses: Uses, harms: &[Harmed]) {
        if let Self::Signal(it) = self {
            it.uses = uses;
            it.senses.harm(harms, &mut it.rover);
        }
    }

    /// Returns how far it has come along its path.
    pub(crate) fn x(&self) -> Millimetres {
        match (self, self.rover()) {
            (Self::Line { drive, .. }, _) => drive.x(),
            (_, rover) => rover.map_or(Millimetres(0), Rover::x),
        }
    }

    pub(crate) fn speed(&self) -> MillimetresPerSecond {
        match (self, self.rover()) {
            (Self::Line { drive, .. }, _) => drive.speed(),
            (_, rover) => rover.map_or(MillimetresPerSecond(0), Rover::speed),
        }
    }

    /// Whether it stands, and does not turn either.
    pub(crate) fn stands(&self) -> bool {
        match (self, self.rover()) {
            (Self::Line { drive, .. }, _) => drive.speed().0 == 0,
            (_, rover) => rover.is_none_or(Rover::stands),
        }
    }

    pub(crate) fn braking_distance(&self) -> Millimetres {
        match (self, self.rover()) {
            (Self::Line { drive, .. }, _) => drive.braking_distance(),
            (_, rover) => rover.map_or(Millimetres(0), Rover::braking_distance),
        }
    }

    /// Whether it moved in the last period.
    pub(crate) fn moved(&self) -> bool {
        match (self, self.rover()) {
            (Self::Line { moved, .. }, _) => *moved,
            (_, rover) => rover.is_some_and(Rover::moved),
        }
    }

    /// Whether it is in the plane, all is told, and nothing on its floor moves.
    pub(crate) fn is_alone(&self) -> bool {
        matches!(self, Self::Plane(it) if it.is_alone())
    }

    /// Whether it ran against something.
    pub(crate) fn touches(&self) -> bool {
        self.rover().is_some_and(Rover::touches)
    }

    /// Owes a way beside the path.
    pub(crate) fn owe(&mut self, way: Millimetres) {
        if let Self::Line { owed, .. } = self {
            owed.0 += way.0;
        }
        if let Some(rover) = self.rover_mut() {
            rover.owe(way);
        }
    }

    /// Feeds hardware with so much power from now on, beside the motors.
    #[allow(clippy::cast_precision_loss)] // the power of a robot
    pub(crate) fn power_hardware(&mut self, power: Milliwatts) {
        if let Some(rover) = self.rover_mut() {
            rover.power_hardware(power.0 as f64 / 1_000.0);
        }
    }

    /// Opens or closes a door of the floor; on a line there are none.
    pub(crate) fn set_door(&mut self, door: usize, is_open: bool) {
        if let Some(rover) = self.rover_mut() {
            rover.set_door(door, is_open);
        }
    }

    /// Returns what became of a door in its way in the last period.
    pub(crate) fn take_met(&mut self) -> Option<Met> {
        self.rover_mut()?.take_met()
    }

    /// Returns the way that is left beside the path.
    pub(crate) fn owed(&self) -> Millimetres {
        match (self, self.rover()) {
            (Self::Line { owed, .. }, _) => *owed,
            (_, rover) => rover.map_or(Millimetres(0), Rover::owed),
        }
    }
}

impl Moves for Mover<'_> {
    fn stand(&mut self) {
        if let Self::Line { drive, .. } = self {
            drive.stand();
        }
        if let Some(rover) = self.rover_mut() {
            rover.stand();
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
                debug_assert!(drive.x() >= before, "a way beside the path is none along it");
            }
            Self::Plane(it) => it.go(towards, end, time),
            Self::Signal(it) => it.go(towards, end, time),
        }
    }
}

impl Sensing<'_> {
    /// Goes on as commanded, no faster than ranges leave; without commands as the last one said,
    /// until the micro-controller stops the motors.
    fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis) {
        let (told, end) = if self.senses.is_heard() {
            self.unheard = Millis(0);
            (MillimetresPerSecond(towards.0.min(self.senses.limit_mm_s())), end)
        } else {
            self.unheard.0 += time.0;
            let stops = self.unheard >= FIRMWARE_WATCHDOG;
            let (last, end) = self.last;
            (if stops { MillimetresPerSecond(0) } else { last }, end)
        };
        self.last = (told, end);
        let is_cut = self.senses.is_cut();
        if is_cut {
            self.rover.stand();
        }
        let towards = match (is_cut, self.senses.runs_away() && !self.uses.is_halted) {
            (true, _) => MillimetresPerSecond(0),
            (false, true) => self.uses.fastest,
            (false, false) => told,
        };
        self.rover.lead(self.uses.is_led);
        self.rover.go(towards, end, time);
        self.senses.sense(&mut self.rover, self.uses, told, time);
    }
}
