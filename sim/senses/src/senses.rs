//! The senses of a robot in one run.

use crate::base::{Base, LOW_CHARGE, faults};
use crate::bench::Bench;
use crate::observing::{Observing, Period};
use crate::sonars::{RANGE_M, ring};
use cotama_core::units::Millis;
use cotama_devices::{
    Disc, Fault, Link, LinkSettings, Mode, Ring, Scene, Sensed, SettingsError, Stream, Streams,
};
use cotama_floor::{Point, Pose};
use cotama_localisation::Localiser;
use cotama_models::robots::{Harm, Harmed, Robot, Role, members};
use cotama_navigation::{Braking, Histogram, Limits, LocalMap, Thresholds};
use cotama_observers::{OnPath, Poses};
use cotama_plane::Rover;
use nalgebra::{Matrix3, Vector3};

/// The senses of one robot in one run. A clone goes on as the original does.
#[derive(Clone, Debug)]
pub struct Senses<'b> {
    robot: &'b Robot,
    ring: Ring,
    link: Link,
    localiser: Localiser<'b>,
    base: Base,
    observing: Observing,
    streams: Streams,
    chance: Stream,
    harms: Vec<Harmed>,
    /// The pose of the odometry's origin, as the robot believes.
    origin: Pose,
    /// The ranges, and those of the reading before: an echo of something is there twice.
    ranges: [[f64; 16]; 2],
    is_located: bool,
    is_led: bool,
    image: Option<(Millis, Millis)>,
    heard: Option<Millis>,
    flags: u64,
    /// The fastest that the ranges leave, in m/s.
    limit: f64,
    around: Around,
}

/// The things around the robot, and how it keeps away from them.
#[derive(Clone, Debug)]
struct Around {
    map: LocalMap,
    histogram: Histogram,
    /// The odometry of the period before.
    before: Pose,
    is_avoiding: bool,
}

/// Modules and motion of the robot in a period, as its configuration allows.
#[derive(Clone, Copy, Debug)]
pub struct Uses {
    /// The modules that run, a bit each.
    pub modules: u64,
    /// Whether the operator leads the robot: he sees where it is.
    pub is_led: bool,
    /// Whether it is told to move.
    pub moves: bool,
}

/// The room that the robot keeps ahead, in metres, and how far ahead along its path it looks.
const KEEPS_M: f64 = 0.25;
const AHEAD_M: f64 = 2.0;
/// The room along its path below which it leaves it, and from which it takes it up again; how far
/// ahead on it the place is that it then goes for.
const NEAR_M: f64 = 0.7;
const FREE_M: f64 = 1.2;
const PURSUED_M: f64 = 1.5;
/// The points around it that it keeps: three of each sonar, for 2 s.
const MOST_POINTS: usize = 1_000;
/// The room that avoidance keeps beside the robot, in metres.
const MARGIN_M: f64 = 0.05;
/// By how much a pose may be wrong: paths have just the room that the robot needs.
const ASIDE_M: f64 = 0.07;
/// A speed that no robot has, in mm/s.
const MOST_MM_S: f64 = 1e6;
/// Way by which localisation is led astray when it is lost, in metres.
const ASTRAY_M: f64 = 1.5;
/// Place of a thing that is on no map: so far ahead along the path; and its radius, in metres.
const THING: [f64; 2] = [1.5, 0.25];
/// Loss of level of a weak link, in dB.
const WEAKER_DB: f64 = 30.0;
/// The deviations of the pose at which a robot is put down or led to: 5 cm and 3°.
const PUT: [f64; 3] = [0.05, 0.05, 0.05];

impl<'b> Senses<'b> {
    /// The senses of a robot at the start of its course.
    ///
    /// # Errors
    /// Numbers of devices that make no sense.
    pub fn new(
        bench: &'b Bench,
        robot: &'b Robot,
        rover: &Rover<'_>,
        seed: u64,
    ) -> Result<Self, SettingsError> {
        let streams = Streams::new(seed);
        let base = Base::new(rover.course().drivetrain(), streams.stream("base"));
        let observing = Observing::new(robot, bench, &base)?;
        // No floor says where access points are: one in the middle (assumed).
        let bounds = cotama_floor::Surface::bounds(rover.course().surface());
        let middle = nalgebra::center(&bounds.least, &bounds.most);
        let mut it = Self {
            robot,
            ring: Ring::new(&ring(), &streams, "sonar")?,
            link: Link::new(&LinkSettings::wifi(), &[middle], &streams, "link")?,
            localiser: Localiser::new(&bench.chart, &streams, "localisation"),
            base,
            observing,
            streams,
            chance: streams.stream("senses"),
            harms: Vec::new(),
            origin: Pose::identity(),
            ranges: [[RANGE_M; 16]; 2],
            is_located: false,
            is_led: false,
            image: None,
            heard: None,
            flags: 0,
            limit: f64::INFINITY,
            around: Around {
                map: LocalMap::new(MOST_POINTS, Millis(2_000)),
                histogram: Histogram::new(braking(rover), Thresholds::default()),
                before: *rover.odometry(),
                is_avoiding: false,
            },
        };
        it.put(rover.pose());
        Ok(it)
    }

    /// Returns the flags that are up, a bit each by their number in the robot's file.
    pub const fn flags(&self) -> u64 {
        self.flags
    }

    /// Returns the fastest that ranges ahead leave, in mm/s.
    pub fn limit_mm_s(&self) -> u64 {
        (self.limit * 1_000.0).min(MOST_MM_S) as u64
    }

    /// Whether commands reach the motors.
    pub fn is_heard(&self) -> bool {
        !self.harms.iter().any(|it| it.harm == Harm::PacketsSilent)
    }

    /// The robot is put down at a pose that is known.
    fn put(&mut self, pose: &Pose) {
        let covariance = Matrix3::from_diagonal(&Vector3::from(PUT.map(|it| it * it)));
        let started = self.localiser.start_at(pose, &covariance);
        debug_assert!(started.is_ok(), "a pose on a floor");
        self.observing.restart();
    }

    /// Harms what failures under way harm, and mends the rest.
    pub fn harm(&mut self, harms: &[Harmed], rover: &mut Rover<'_>) {
        if harms == self.harms {
            return;
        }
        let before = core::mem::replace(&mut self.harms, harms.to_vec());
        let is_new = |harm: Harm| {
            let has = |all: &[Harmed]| all.iter().any(|it| it.harm == harm);
            has(harms) && !has(&before)
        };
        let set = rover.set_drive_faults(&faults(harms));
        debug_assert!(set.is_ok(), "fewer harms than faults that there may be");
        let has = |all: &[Harmed], harm: Harm| all.iter().any(|it| it.harm == harm);
        if has(harms, Harm::BatteryLow) != has(&before, Harm::BatteryLow) {
            rover.charge(if has(harms, Harm::BatteryLow) { LOW_CHARGE } else { 1.0 });
        }
        let fades = |it: &Harmed| match it.harm {
            Harm::LinkWeak => Fault::new(Mode::Bias(-WEAKER_DB)).ok(),
            _ => None,
        };
        let fades: Vec<_> = harms.iter().filter_map(fades).collect();
        let set = self.link.set_faults(&fades, &self.streams, "link");
        debug_assert!(set.is_ok(), "faults of a level");
        for sonar in 0..16 {
            let faults = sonar_faults(harms, sonar, rover.now());
            let set = self.ring.set_faults(sonar, &faults, &self.streams, "sonar");
            debug_assert!(set.is_ok(), "faults of a ring of 16 sonars");
        }
        if is_new(Harm::PacketsRestart) {
            self.base.restart();
            rover.forget();
        }
        if is_new(Harm::PoseLost) {
            let astray = self.chance.part() * core::f64::consts::TAU;
            let (sin, cos) = libm::sincos(astray);
            let mut pose = rover.believed();
            pose.translation.vector += nalgebra::Vector2::new(cos, sin) * ASTRAY_M;
            self.put(&pose);
        }
        if is_new(Harm::MapWrong) {
            let track = rover.course().track();
            let (near, _) = track.find(rover.pose().translation.vector.into(), 0.0, track.length());
            let there = track.pose(near.piece, near.along + THING[0]);
            rover.put(Some(Disc { centre: there.translation.vector.into(), radius: THING[1] }));
        } else if !harms.iter().any(|it| it.harm == Harm::MapWrong) {
            rover.put(None);
        }
    }

    /// Senses after a period, and looks what is wrong.
    pub fn sense(&mut self, rover: &mut Rover<'_>, uses: Uses, time: Millis) {
        let now = rover.now();
        let around: Vec<Disc> = rover.people().iter().chain(rover.things()).copied().collect();
        let scene = Scene::of(rover.course().surface(), &around);
        self.ring.sense(now, rover.pose(), &scene);
        let packets = self.base.taken();
        self.base.read(rover, time.0 as f64 / 1_000.0, &self.harms);
        let is_packet_lost = self.base.taken() == packets;
        self.hear(now, rover);
        let has = |role: Role| {
            let all = members(uses.modules).filter_map(|it| self.robot.modules.get(it));
            all.flat_map(|it| &it.roles).any(|it| *it == role)
        };
        let (locates, avoids) = (has(Role::Localisation), has(Role::Avoidance));
        let read = self.ring.latest(now).unwrap_or(&[]);
        self.ranges.swap(0, 1);
        for (range, it) in self.ranges[0].iter_mut().zip(read) {
            *range = it.map_or(RANGE_M, |it| it.value);
        }
        self.locate(rover, locates, uses.is_led);
        let free = self.free(rover);
        self.keep_away(rover, free, avoids && !uses.is_led, time);
        let estimate = self.localiser.estimate();
        let poses = locates.then(|| Poses {
            odometry: *rover.odometry(),
            located: self.localiser.pose_at(rover.odometry()),
            covariance: estimate.covariance,
        });
        let track = rover.course().track();
        let along = rover.along();
        let at = rover.believed().translation.vector.into();
        let (near, lateral_m) = track.find(at, (along - 1.0).max(0.0), along + 1.0);
        let read = self.ring.latest(now);
        let period = Period {
            now,
            ranges: read,
            base: &self.base,
            poses: poses.map(|value| Sensed { taken: now, value }),
            place: OnPath { along_m: near.along, lateral_m },
            is_told_to_move: uses.moves,
            level_dbm: self.link.latest(now),
            heard: self.heard,
            image: self.image,
            free_m: free,
            is_packet_lost,
        };
        self.flags = self.observing.look(&period);
    }

    /// Images and the operator's station.
    fn hear(&mut self, now: Millis, rover: &Rover<'_>) {
        let has = |harm: Harm| self.harms.iter().any(|it| it.harm == harm);
        let at = rover.pose().translation.vector.into();
        self.link.sense(now, at, rover.course().surface());
        let is_down = has(Harm::LinkDown);
        if !is_down {
            self.heard = Some(now);
        }
        if !has(Harm::CameraSilent) {
            let late = if has(Harm::CameraLate) { 2_000 } else { 0 };
            self.image = Some((now, Millis(now.0.saturating_sub(late))));
        }
    }

    /// Works out where the robot is, and lets it believe so.
    fn locate(&mut self, rover: &mut Rover<'_>, locates: bool, is_led: bool) {
        let odometry = *rover.odometry();
        if is_led {
            self.origin = rover.pose() * odometry.inverse();
        } else {
            if self.is_led || (locates && !self.is_located) {
                self.put(&(self.origin * odometry));
            }
            if locates {
                self.localiser.update(&odometry, &self.ranges[0]);
                self.origin = self.localiser.pose_at(&odometry) * odometry.inverse();
            }
        }
        (self.is_led, self.is_located) = (is_led, locates);
        rover.believe(self.origin);
    }

    /// Keeps away from things: where something is in the way, VFH+ chooses another one; where it
    /// chooses none, the robot brakes before it.
    fn keep_away(&mut self, rover: &mut Rover<'_>, free: f64, avoids: bool, time: Millis) {
        let odometry = *rover.odometry();
        let around = &mut self.around;
        let motion = around.before.inverse() * odometry;
        around.before = odometry;
        around.map.advance(&motion, time);
        let settings = ring();
        if let Some(read) = self.ring.latest(rover.now()) {
            around.map.take_ring(&settings.mounts, settings.cone_rad, RANGE_M, read);
        }
        let until = if around.is_avoiding { FREE_M } else { NEAR_M };
        around.is_avoiding = avoids && free < until;
        let room = (free - KEEPS_M).max(0.0);
        let brakes = (2.0 * rover.course().drivetrain().acceleration * room).sqrt();
        if !around.is_avoiding {
            rover.steer(None);
            self.limit = if avoids { brakes } else { f64::INFINITY };
            return;
        }
        let (track, along) = (rover.course().track(), rover.along());
        let (near, _) = track.find(rover.believed().translation.vector.into(), along, along + 0.5);
        let there = track.pose(near.piece, near.along + PURSUED_M);
        let target = rover.believed().inverse_transform_point(&there.translation.vector.into());
        let now = rover.vehicle().speeds();
        let speed = rover.course().drivetrain().speed / 2.0;
        let choice = around.histogram.choose(&around.map, now, target, speed);
        rover.steer(Some(choice.command()));
        self.limit = f64::INFINITY;
    }

    /// Returns the room along the path by the ranges, in metres beyond the robot: up to the first
    /// echo so near to the path that the robot would touch what sent it.
    fn free(&self, rover: &Rover<'_>) -> f64 {
        let radius = rover.course().drivetrain().footprint.radius();
        let (track, along, pose) = (rover.course().track(), rover.along(), rover.believed());
        let mounts = ring().mounts;
        let both = self.ranges[0].iter().zip(&self.ranges[1]);
        let points = mounts.iter().zip(both).filter_map(|(mount, (now, before))| {
            let range = now.max(*before);
            (range < RANGE_M).then(|| mount * Point::new(range, 0.0))
        });
        let ways = points.filter_map(|it| {
            let (near, aside) = track.find(pose * it, along, along + AHEAD_M);
            let is_in_way = aside < radius - ASIDE_M && near.along > along + ASIDE_M;
            is_in_way.then_some(near.along - along - radius)
        });
        ways.fold(RANGE_M, f64::min)
    }
}

fn braking(rover: &Rover<'_>) -> Braking {
    let drivetrain = rover.course().drivetrain();
    let radius_m = drivetrain.footprint.radius();
    Braking::new(Limits::of(drivetrain), radius_m, MARGIN_M, 0.1)
}

/// Returns the faults of a sonar that harms make.
fn sonar_faults(harms: &[Harmed], sonar: usize, now: Millis) -> Vec<Fault> {
    let of = |it: &Harmed| {
        let own = usize::from(it.unit) == sonar;
        match it.harm {
            Harm::SonarFar if own => Some(Mode::Stuck(RANGE_M)),
            Harm::SonarNear if own => Some(Mode::Stuck(0.3)),
            Harm::SonarSilent => Some(Mode::DropOut(1.0)),
            _ => None,
        }
    };
    let modes = harms.iter().filter_map(of);
    modes.filter_map(|it| Fault::new(it).ok()).map(|it| it.from(now)).collect()
}
