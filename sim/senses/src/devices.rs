//! Lasers, camera and gyro of one robot, and what it knows by them.

use crate::bench::Bench;
use crate::gyro;
use crate::lasers::{self, Lasers, Reading};
use crate::marks::Marks;
use crate::watching::{Raised, Scan, Watching};
use cotama_core::units::Millis;
use cotama_devices::{Disc, Gyro, Scene, Sensed, SettingsError, Streams};
use cotama_floor::Pose;
use cotama_models::robots::{Harmed, Robot, Role, Sensing, members};
use cotama_observers::{FalseAlarms, Job, Turn};
use cotama_plane::Rover;

/// The way in which a robot localises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum By {
    Ring,
    Lasers,
    Marks,
}

/// The devices.
#[derive(Clone, Debug)]
pub(crate) struct Devices {
    pub(crate) lasers: Lasers,
    pub(crate) marks: Option<Marks>,
    gyro: Option<Gyro>,
    watching: Watching,
    /// The lasers by which the robot localises, a bit each.
    localising: u64,
    of: Sensing,
    /// The hardware under the modules that run, which are asked but once.
    under: (u64, u64),
    job: Option<Job>,
}

impl Devices {
    pub(crate) fn new(
        robot: &Robot,
        bench: &Bench,
        streams: Streams,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        let of = robot.body.as_ref().map(|it| it.sensing.clone()).unwrap_or_default();
        let marks = of.camera.map(|it| Marks::new(&it, &bench.marks, streams)).transpose()?;
        Ok(Self {
            lasers: Lasers::new(&of, streams)?,
            marks,
            gyro: of.gyro.map(|it| gyro::gyro(&it, streams)).transpose()?,
            watching: Watching::new(&of, bench, promise)?,
            localising: bench.localising,
            of,
            under: (0, 0),
            job: None,
        })
    }

    pub(crate) const fn has_sonars(&self) -> bool {
        !self.of.no_sonars
    }

    /// Harms devices, or mends them.
    pub(crate) fn harm(&mut self, harms: &[Harmed], now: Millis, streams: Streams) {
        self.lasers.harm(harms, now, streams);
        if let Some(marks) = &mut self.marks {
            marks.harm(harms, now, streams);
        }
        if let Some(it) = &mut self.gyro {
            gyro::harm(it, harms, now, streams);
        }
    }

    /// Takes the readings that are due.
    pub(crate) fn sense(&mut self, rover: &Rover<'_>, around: &[Disc]) {
        let (now, pose, odometry) = (rover.now(), rover.pose(), rover.odometry());
        let scene = Scene::of(rover.course().surface(), around);
        self.lasers.sense(now, pose, odometry, &scene);
        if let Some(marks) = &mut self.marks {
            let speed = rover.vehicle().speeds().speed;
            marks.sense(now, pose, (odometry, speed), &scene);
        }
        if let Some(gyro) = &mut self.gyro {
            gyro.sense(now, rover.vehicle().turns());
        }
    }

    /// Returns the newest turn of the gyro, in rad/s.
    pub(crate) fn turn(&self, now: Millis) -> Option<Sensed<f64>> {
        self.gyro.as_ref()?.latest(now)
    }

    /// Returns the hardware under the modules that run.
    pub(crate) fn under(&mut self, robot: &Robot, modules: u64) -> u64 {
        if self.under.0 != modules {
            self.under = (modules, robot.hardware_under(modules));
        }
        self.under.1
    }

    /// Returns by what the modules that run localise; of several ways, the most exact one.
    pub(crate) fn by(&self, robot: &Robot, modules: u64) -> Option<By> {
        let of = members(modules).filter(|it| {
            let module = robot.modules.get(*it);
            module.is_some_and(|it| it.roles.contains(&Role::Localisation))
        });
        let by = |it: usize| {
            let hardware = robot.hardware_under(1 << it);
            if lasers::under(&self.of.lasers, hardware) != 0 {
                return Some(By::Lasers);
            }
            if self.marks.as_ref().is_some_and(|it| it.hardware & hardware != 0) {
                return Some(By::Marks);
            }
            (self.localising == 0 && self.has_sonars()).then_some(By::Ring)
        };
        let all: Vec<_> = of.filter_map(by).collect();
        [By::Lasers, By::Ring, By::Marks].into_iter().find(|it| all.contains(it))
    }

    /// Returns the newest scans by which the robot localises.
    pub(crate) fn reading(&self, now: Millis) -> Option<Reading> {
        self.lasers.reading(self.localising, now)
    }

    /// Looks at a new picture of a robot that believes the origin of its odometry to be there.
    pub(crate) fn see(&mut self, rover: &Rover<'_>, origin: &Pose, by: Option<By>) {
        let is_used = by == Some(By::Marks);
        let marks = self.marks.as_mut();
        self.job =
            marks.and_then(|it| it.look(rover.now(), origin, rover.course().charted(), is_used));
    }

    /// Looks what is wrong with devices.
    pub(crate) fn look(&mut self, rover: &Rover<'_>, origin: &Pose, by: Option<By>) -> Raised {
        let (now, charted) = (rover.now(), rover.course().charted());
        let Self { lasers, watching, .. } = self;
        let scan = |at: usize| Scan {
            taken: lasers.taken(at, now),
            is_blind: lasers.is_blind(at, now),
            // Where no laser localises the pose is not good enough.
            is_apart: (by == Some(By::Lasers))
                .then(|| lasers.is_apart(at, now, origin, charted))
                .flatten(),
        };
        let turn = self.gyro.as_ref().and_then(|it| it.latest(now)).map(|it| {
            let odometry = *rover.odometry();
            Sensed { taken: it.taken, value: Turn { gyro: it.value, odometry } }
        });
        watching.look(now, (0..lasers.count()).map(scan), self.job, turn)
    }
}
