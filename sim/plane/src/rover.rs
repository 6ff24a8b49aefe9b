//! A robot on the path of its mission.

use crate::course::Course;
use crate::detours::Detours;
use crate::doors::Doors;
use crate::drive::{Drive, Signals};
use crate::fault::DriveFault;
use crate::follower::{Follower, STEP};
use crate::odometry::Odometry;
use crate::track::Near;
use crate::vehicle::{Command, Vehicle};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_devices::{Disc, People, SettingsError};
use cotama_floor::Pose;

mod beside;
mod doors;

use doors::Halts;
pub use doors::Met;

/// A robot that follows the path of its mission, and knows where it is.
#[derive(Clone, Debug)]
pub struct Rover<'c> {
    course: &'c Course,
    /// The course of this run alone, where the floor or the path changed.
    own: Option<Box<Course>>,
    doors: Option<Box<Doors>>,
    detours: Detours,
    /// Whether it stops before a door.
    halts: Halts,
    met: Option<Met>,
    vehicle: Vehicle,
    drive: Drive,
    seed: u64,
    odometry: Odometry,
    follower: Follower,
    /// How far it has come along its path.
    x: Millimetres,
    /// The way to drive before it gets on along its path.
    owed: Millimetres,
    aside: Aside,
    /// The length along its path at which it turned back last.
    turned: f64,
    moved: bool,
    contact: Contact,
    people: Option<People>,
    /// Things in its way that are on no map.
    things: Vec<Disc>,
    /// The pose of its odometry's origin as it believes; `None` where it knows its pose.
    belief: Option<Pose>,
    /// Whether somebody who leads it looks out for people.
    is_led: bool,
    /// The speeds that avoidance wants in place of those along the path.
    steers: Option<Command>,
    /// The time since the start.
    now: Millis,
}

/// Contact of the robot with something: `Now` in the last period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Contact {
    Never,
    Before,
    Now,
}

/// A way that the robot drives beside its path: back along it, and forth again.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Aside {
    No,
    /// Back, up to this length along the path that leads back.
    Back(f64),
    /// Forth, to where it was.
    Forth,
}

/// How far ahead it looks for people, and the room that it keeps from them, in metres.
const LOOKS: f64 = 4.0;
const KEEPS: f64 = 0.3;
/// How near a robot comes to where it stops, in metres.
const AT: f64 = 0.001_5;

impl<'c> Rover<'c> {
    /// A robot that stands at the start of its path; people are where this seed draws them.
    pub fn new(course: &'c Course, seed: u64) -> Self {
        let start = course.track().start();
        let radius = course.drivetrain().footprint.radius();
        let robot = Disc { centre: start.translation.vector.into(), radius };
        let people = course.people(seed).ok().flatten();
        let people = people.map(|mut it| {
            it.make_room(&robot);
            it
        });
        Self {
            course,
            own: None,
            doors: None,
            detours: Detours::default(),
            halts: Halts::No,
            met: None,
            vehicle: Vehicle::new(start),
            drive: Drive::new(course.drivetrain()),
            seed,
            odometry: Odometry::new(start),
            follower: Follower::new(Near { piece: 0, along: 0.0 }),
            x: Millimetres(0),
            owed: Millimetres(0),
            aside: Aside::No,
            turned: 0.0,
            moved: false,
            contact: Contact::Never,
            people,
            things: Vec::new(),
            belief: None,
            is_led: false,
            steers: None,
            now: Millis(0),
        }
    }

    /// Returns how far it has come along its path; never less than before.
    pub const fn x(&self) -> Millimetres {
        self.x
    }

    /// Returns its speed along its way, rounded up to mm/s.
    pub fn speed(&self) -> MillimetresPerSecond {
        MillimetresPerSecond(milli(self.vehicle.speeds().speed.abs()))
    }

    /// Whether it stands, and does not turn either.
    pub fn stands(&self) -> bool {
        self.vehicle.speeds() == Command::default()
    }

    /// Returns its pose.
    pub const fn pose(&self) -> &Pose {
        self.vehicle.pose()
    }

    /// Returns the pose that its encoders tell.
    pub const fn odometry(&self) -> &Pose {
        self.odometry.pose()
    }

    /// Returns the signals of motors, encoders and the battery.
    pub fn signals(&self) -> Signals {
        self.drive.signals(self.vehicle.counts(self.course().drivetrain()))
    }

    /// Gives faults to the drive in place of those that it has; their times count from the start.
    ///
    /// # Errors
    /// More than [`MAX_FAULTS`](cotama_devices::MAX_FAULTS).
    pub fn set_drive_faults(&mut self, faults: &[DriveFault]) -> Result<(), SettingsError> {
        self.drive.set_faults(faults, self.seed)
    }

    /// Feeds hardware with so many W from now on, beside the motors.
    pub fn power_hardware(&mut self, watts: f64) {
        self.drive.power_hardware(watts);
    }

    /// Carries so many kg from now on.
    pub fn carry(&mut self, payload: f64) {
        self.drive.carry(payload);
    }

    /// Charges the battery to a part, from 0 to 1.
    pub fn charge(&mut self, part: f64) {
        self.drive.charge(part);
    }

    /// Whether it moved in the last period, also on the spot.
    pub const fn moved(&self) -> bool {
        self.moved
    }

    /// Whether it ran against something.
    pub const fn touches(&self) -> bool {
        !matches!(self.contact, Contact::Never)
    }

    /// Whether it touched something in the last period.
    pub const fn is_pressed(&self) -> bool {
        matches!(self.contact, Contact::Now)
    }

    /// Lets it believe that its odometry began at this pose: from now on it follows its path by
    /// odometry, and looks out for nobody by itself.
    pub fn believe(&mut self, origin: Pose) {
        self.belief = Some(origin);
    }

    /// Lets somebody lead it, or nobody any more: who leads it sees people, and brakes before them.
    pub fn lead(&mut self, is_led: bool) {
        self.is_led = is_led;
    }

    /// Goes with these speeds from now on, where it is to move, and not along its path.
    pub fn steer(&mut self, speeds: Option<Command>) {
        self.steers = speeds;
    }

    /// Returns the pose at which it believes to be.
    pub fn believed(&self) -> Pose {
        match &self.belief {
            Some(origin) => origin * self.odometry.pose(),
            None => *self.vehicle.pose(),
        }
    }

    /// Puts a thing on the floor, or takes all away.
    pub fn put(&mut self, thing: Option<Disc>) {
        match thing {
            Some(it) => self.things.push(it),
            None => self.things.clear(),
        }
    }

    /// Returns the things on the floor that are on no map.
    pub fn things(&self) -> &[Disc] {
        &self.things
    }

    /// Lets its odometry begin anew, at the origin.
    pub fn forget(&mut self) {
        self.odometry.begin(Pose::identity());
    }

    /// Returns how far along its path it is, in metres.
    pub const fn along(&self) -> f64 {
        self.follower.along()
    }

    /// Returns the time since the start.
    pub const fn now(&self) -> Millis {
        self.now
    }

    /// Returns the course that it goes.
    pub fn course(&self) -> &Course {
        self.own.as_deref().unwrap_or(self.course)
    }

    /// Returns its wheels and their speeds.
    pub const fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Returns the people around it.
    pub fn people(&self) -> &[Disc] {
        self.people.as_ref().map_or(&[], People::now)
    }

    /// Whether nobody walks and no door moves on its floor, and it knows its pose.
    pub const fn is_alone(&self) -> bool {
        self.people.is_none() && self.doors.is_none() && self.belief.is_none()
    }

    /// Returns how far it would still go if it braked now.
    pub fn braking_distance(&self) -> Millimetres {
        let speed = self.vehicle.speeds().speed;
        Millimetres(milli(speed * speed / (2.0 * self.course().drivetrain().acceleration)))
    }

    /// Stands at once.
    pub fn stand(&mut self) {
        self.vehicle.stand();
    }

    /// Goes on for a time towards a speed, no further along its path than an end; an end that is
    /// reached holds it.
    pub fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis) {
        self.moved = false;
        if self.contact == Contact::Now {
            self.contact = Contact::Before;
        }
        self.now.0 += time.0;
        let towards = towards.0 as f64 / 1_000.0;
        self.see_doors();
        let towards = if self.halts == Halts::No { towards } else { 0.0 };
        let slowed = if self.people.is_some() { self.among_people(towards) } else { towards };
        let is_blind = self.belief.is_some() && !self.is_led;
        let towards = if is_blind { towards } else { slowed };
        let on_path = self.aside == Aside::No && self.owed.0 == 0;
        let mut steps = time.0.div_ceil(10);
        if self.drive.is_off() || (end.0 <= self.x.0 && on_path) {
            self.vehicle.stand();
            self.drive.rested(self.vehicle.pose().translation.vector.into(), steps);
            return;
        }
        while steps > 0 {
            steps -= self.step(towards, end, steps);
        }
        let drivetrain = self.own.as_deref().unwrap_or(self.course).drivetrain();
        self.odometry.read(drivetrain, self.vehicle.counts(drivetrain));
    }

    /// Whether its last step, from where it was before, led it further into a thing.
    fn runs_into_a_thing(&self, before: &Vehicle) -> bool {
        let radius = self.course.drivetrain().footprint.radius();
        let of = |it: &Vehicle| Disc { centre: it.pose().translation.vector.into(), radius };
        let (before, now) = (of(before), of(&self.vehicle));
        self.things.iter().any(|it| now.gap(it) < before.gap(it).min(0.0))
    }

    /// Returns the speed at which it still stands before it comes close to somebody on its path: it
    /// knows where people are.
    fn among_people(&mut self, towards: f64) -> f64 {
        let course = self.own.as_deref().unwrap_or(self.course);
        let along = self.follower.along();
        let robot = Disc {
            centre: self.vehicle.pose().translation.vector.into(),
            radius: course.drivetrain().footprint.radius(),
        };
        let Some(people) = &mut self.people else { return towards };
        let (now, track) = (self.now, course.track());
        let mut speed = towards;
        // Nobody steps where the robot could not stand any more.
        let brakes = self.vehicle.speeds().speed;
        let brakes = brakes * brakes / (2.0 * course.drivetrain().acceleration);
        let seen = Disc { radius: robot.radius + brakes, ..robot };
        for person in people.advance(now, &[seen]) {
            let gap = robot.gap(person);
            if gap < 0.0 {
                self.contact = Contact::Now;
            }
            // Ahead alone: a path may lead back over where it came from.
            let (near, aside) = track.find(person.centre, along, along + LOOKS);
            let is_ahead = near.along > along && gap < LOOKS;
            if is_ahead && aside < robot.radius + person.radius + KEEPS {
                let left = (gap - KEEPS).max(0.0);
                speed = speed.min((2.0 * course.drivetrain().acceleration * left).sqrt());
            }
        }
        speed
    }

    /// Goes on for a step, or for all of these where nothing changes; returns for how many.
    fn step(&mut self, speed: f64, end: Millimetres, most: u64) -> u64 {
        if self.owed.0 > 0 && self.aside == Aside::No && self.vehicle.speeds().speed == 0.0 {
            self.turn_back();
        }
        let goal = match self.aside {
            Aside::No if self.owed.0 > 0 => self.follower.along(), // brakes, to turn back
            Aside::No => self.detours.goal(end.0 as f64 / 1_000.0),
            Aside::Back(to) => to,
            Aside::Forth if self.detours.is_none() => self.x.0 as f64 / 1_000.0,
            Aside::Forth => self.turned,
        };
        let course = self.own.as_deref().unwrap_or(self.course);
        let (track, drivetrain) = (
            if matches!(self.aside, Aside::Back(_)) { course.back() } else { course.track() },
            course.drivetrain(),
        );
        let now = self.vehicle.speeds();
        let (before, pose) = (*self.vehicle.pose(), self.believed());
        let (command, same) = self.follower.command(track, &pose, now, drivetrain, speed, goal);
        let steered = self.steers.filter(|_| speed > 0.0);
        let (command, same) = steered.map_or((command, same), |it| (it, 0.0));
        let all = STEP * most as f64;
        let even = self.drive.is_sound() && now == command && same > now.speed * all;
        let (steps, time) = if even { (most, all) } else { (1, STEP) };
        let effect = self.drive.effect(pose.translation.vector.into());
        let surface = course.surface();
        let vehicle = (!self.things.is_empty()).then(|| self.vehicle.clone());
        let step = self.vehicle.step_under(drivetrain, surface, command, time, &effect);
        self.drive.took(&step, steps);
        if self.vehicle.touches() {
            self.contact = Contact::Now;
        }
        if let Some(before) = vehicle.filter(|it| self.runs_into_a_thing(it)) {
            self.vehicle = before;
            self.vehicle.stand();
            self.contact = Contact::Now;
        }
        self.moved |= *self.vehicle.pose() != before;
        if self.belief.is_some() {
            self.odometry.read(drivetrain, self.vehicle.counts(drivetrain));
        }
        self.follower.see(track, &self.believed());
        let along = self.follower.along();
        // A robot that is not to move is nowhere else than it was.
        if along + AT < goal || speed == 0.0 {
            if self.aside == Aside::No {
                self.x = self.reached(along, end);
            }
            return steps;
        }
        match self.aside {
            Aside::No if self.owed.0 > 0 => {
                self.x = self.reached(along, end);
            }
            Aside::No => {
                self.x = self.x.max(end);
                self.vehicle.stand();
            }
            Aside::Back(_) => {
                self.vehicle.stand();
                self.aside = Aside::Forth;
                let length = course.track().length();
                self.follow(length - along);
            }
            Aside::Forth => {
                self.aside = Aside::No;
                self.owed = Millimetres(0);
            }
        }
        steps
    }

    /// Returns how far it is along its path, no further than an end, and never less than before.
    fn reached(&self, along: f64, end: Millimetres) -> Millimetres {
        self.x.max(Millimetres(floor_milli(self.detours.x(along)).min(end.0)))
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // lengths and speeds of a floor
fn milli(it: f64) -> u64 {
    (it * 1_000.0).ceil() as u64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // lengths of a floor
fn floor_milli(it: f64) -> u64 {
    (it * 1_000.0).floor() as u64
}
