//! The senses of a robot in one run.

use crate::around::{Around, KEEPS_M, Order, Wants, free};
use crate::base::{Base, LOW_CHARGE, faults};
use crate::bench::Bench;
use crate::devices::{By, Devices};
use crate::modules::{Jobs, Modules};
use crate::observing::{Observing, PER_HOUR, Period};
use crate::sonars::{RANGE_M, ring};
use cotama_core::executive::{Happening, Latest};
use cotama_core::units::{Micros, MillimetresPerSecond, Millis};
use cotama_devices::{
    Disc, Fault, Link, LinkSettings, Mode, Ring, Scene, Sensed, SettingsError, Stream, Streams,
};
use cotama_floor::Pose;
use cotama_localisation::Localiser;
use cotama_models::robots::{Harm, Harmed, Robot, Role, members};
use cotama_observers::{FalseAlarms, OnPath, Poses};
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
    devices: Devices,
    modules: Modules,
    mail: Mail,
    streams: Streams,
    chance: Stream,
    harms: Vec<Harmed>,
    /// The pose of the odometry's origin, as the robot believes.
    origin: Pose,
    /// The ranges, and those of the reading before: an echo of something is there twice.
    ranges: [[f64; 16]; 2],
    located: Option<By>,
    is_led: bool,
    /// The time since signals were read.
    unread: Millis,
    /// The modules that begin anew with the next reading, a bit each.
    restarted: u64,
    image: Option<(Millis, Millis)>,
    heard: Option<Millis>,
    flags: u64,
    /// Whether the newest command was given in the last period.
    is_commanded: bool,
    /// The things that harms put on the floor, with the harm.
    put: Vec<(Harm, Disc)>,
    around: Around,
}

/// The data that modules publish, each with its age.
#[derive(Clone, Debug, Default)]
struct Mail {
    /// The pose of the odometry's origin, by localisation.
    origin: Latest<Pose>,
    order: Latest<Order>,
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
    /// The fastest that the motors go.
    pub fastest: MillimetresPerSecond,
    /// Whether the motors are halted: those that run away stand, too.
    pub is_halted: bool,
    /// The modules that begin anew in this period, a bit each.
    pub restarted: u64,
    /// The most particles of localisation.
    pub particles: u64,
}

impl Default for Uses {
    fn default() -> Self {
        Self {
            modules: 0,
            is_led: false,
            moves: false,
            fastest: MillimetresPerSecond(0),
            is_halted: false,
            restarted: 0,
            particles: u64::MAX,
        }
    }
}

/// The time between two readings of all signals.
const READS: Millis = Millis(100);
/// A speed that no robot has, in mm/s.
const MOST_MM_S: f64 = 1e6;
/// Way by which localisation is led astray when it is lost, in metres.
const ASTRAY_M: f64 = 1.5;
/// Things that harms put on the floor, each so far ahead along the path; their radius, in metres,
/// and the places that are tried, 10 cm one after the other.
const THINGS: [(Harm, f64); 3] =
    [(Harm::MapWrong, 1.5), (Harm::PersonInWay, 1.0), (Harm::ThingUnseen, 0.9)];
const THING_M: f64 = 0.25;
const THING_STEPS: u32 = 50;
/// Noise of ranges that read anything, in metres.
const NOISY_M: f64 = 1.0;
/// Loss of level of a weak link, in dB.
const WEAKER_DB: f64 = 45.0;
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
        let promise = FalseAlarms::per_hour(PER_HOUR)?;
        let devices = Devices::new(robot, bench, streams, promise)?;
        let around = Around::new(rover, devices.lasers.count() > 0);
        let mut it = Self {
            robot,
            ring: Ring::new(&ring(), &streams, "sonar")?,
            link: Link::new(&LinkSettings::wifi(), &bench.access, &streams, "link")?,
            localiser: Localiser::new(&bench.chart, &streams, "localisation"),
            base,
            observing,
            devices,
            modules: Modules::new(robot)?,
            mail: Mail::default(),
            streams,
            chance: streams.stream("senses"),
            harms: Vec::new(),
            origin: Pose::identity(),
            ranges: [[RANGE_M; 16]; 2],
            located: None,
            is_led: false,
            unread: Millis(0),
            restarted: 0,
            image: None,
            heard: None,
            flags: 0,
            is_commanded: true,
            put: Vec::new(),
            around,
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
        let last = self.mail.order.read(Micros(0)).map_or(f64::INFINITY, |it| it.0.limit_m_s);
        (last * 1_000.0).min(MOST_MM_S) as u64
    }

    /// Whether a new command is given, and reaches the motors.
    pub fn is_heard(&self) -> bool {
        self.is_commanded && !self.has(Harm::PacketsSilent)
    }

    /// Whether the emergency button cuts the motors off.
    pub fn is_cut(&self) -> bool {
        self.has(Harm::EmergencyStop)
    }

    /// Whether the motors run away.
    pub fn runs_away(&self) -> bool {
        self.has(Harm::MotorRunaway)
    }

    fn has(&self, harm: Harm) -> bool {
        self.harms.iter().any(|it| it.harm == harm)
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
        let set = self.link.faults().replace(&fades, &self.streams, "link");
        debug_assert!(set.is_ok(), "faults of a level");
        for sonar in 0..16 {
            let faults = sonar_faults(harms, sonar, rover.now());
            let set = self.ring.set_faults(sonar, &faults, &self.streams, "sonar");
            debug_assert!(set.is_ok(), "faults of a ring of 16 sonars");
        }
        self.devices.harm(harms, rover.now(), self.streams);
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
        self.put.retain(|it| has(harms, it.0));
        for (harm, ahead) in THINGS.into_iter().filter(|it| is_new(it.0)) {
            let track = rover.course().track();
            let (near, _) = track.find(rover.pose().translation.vector.into(), 0.0, track.length());
            // Further on where the path leads back to where the robot is.
            let robot = rover.pose().translation.vector;
            let clear = rover.course().drivetrain().footprint.radius() + THING_M + KEEPS_M;
            let places = (0..THING_STEPS).map(|step| {
                let along = near.along + ahead + f64::from(step) * 0.1;
                track.pose(near.piece, along).translation.vector
            });
            let mut places = places.filter(|it| (it - robot).norm() > clear);
            let there = places.next().map(|it| Disc { centre: it.into(), radius: THING_M });
            self.put.extend(there.map(|it| (harm, it)));
        }
        rover.put(None);
        self.put.iter().for_each(|it| rover.put(Some(it.1)));
    }

    /// Senses after a period, and looks what is wrong; of shorter periods than 100 ms, after as
    /// many as make such a time. `told` is the speed that the motors were told.
    pub fn sense(
        &mut self,
        rover: &mut Rover<'_>,
        uses: Uses,
        told: MillimetresPerSecond,
        time: Millis,
    ) {
        self.restarted |= uses.restarted;
        self.unread.0 += time.0;
        if self.unread < READS {
            return;
        }
        let time = core::mem::take(&mut self.unread);
        let now = rover.now();
        let things = self.put.iter().filter(|it| it.0 != Harm::ThingUnseen).map(|it| &it.1);
        let around: Vec<Disc> = rover.people().iter().chain(things).copied().collect();
        let scene = Scene::of(rover.course().surface(), &around);
        self.ring.sense(now, rover.pose(), &scene);
        self.devices.sense(rover, &around);
        let fresh = |it: &Sensed<f64>| now.0.saturating_sub(it.taken.0) < time.0;
        self.base.gyro = self.devices.turn(now).filter(fresh).map(|it| it.value);
        let packets = self.base.taken();
        self.base.read(rover, time.0 as f64 / 1_000.0, &self.harms);
        let is_packet_lost = self.base.taken() == packets;
        self.modules.restart(core::mem::take(&mut self.restarted));
        let particles = self.localiser.estimate().particles;
        let jobs = self.modules.pass(uses.modules, &self.harms, particles, (now, time));
        self.localiser.allow(usize::try_from(uses.particles).unwrap_or(usize::MAX));
        let has = |role: Role| {
            let all = members(uses.modules).filter_map(|it| self.robot.modules.get(it));
            all.flat_map(|it| &it.roles).any(|it| *it == role)
        };
        let avoids = has(Role::Avoidance);
        let by = self.devices.by(self.robot, uses.modules);
        let under = self.devices.under(self.robot, uses.modules);
        // A role that runs in no module takes no time; one that does works as its module publishes.
        let works = |role: Role| !has(role) || jobs.of(self.robot, role).is_some();
        let commander = if uses.is_led { Role::Link } else { Role::Guidance };
        self.is_commanded = works(commander);
        let has_no_plan = has(Role::Planning) && self.has(Harm::PlanFails);
        let (is_read, is_seen, is_linked) =
            (works(Role::Ranges), works(Role::Images), works(Role::Link));
        self.hear(now, rover, [is_seen, is_linked]);
        if is_read {
            let read = self.ring.latest(now).filter(|_| self.devices.has_sonars()).unwrap_or(&[]);
            self.ranges.swap(0, 1);
            for (range, it) in self.ranges[0].iter_mut().zip(read) {
                *range = it.map_or(RANGE_M, |it| it.value);
            }
        }
        self.devices.see(rover, &self.origin, by.filter(|_| !uses.is_led));
        self.locate(rover, by, &jobs, uses.is_led);
        let free = free(rover, &self.ranges, (&self.devices, under));
        self.around.see(rover, &self.ring, (&self.devices, under), time);
        let published = jobs.of(self.robot, Role::Avoidance).and_then(Happening::publication);
        let wants = if uses.is_led {
            Wants::Led
        } else if avoids {
            Wants::Avoids
        } else {
            Wants::Goes
        };
        match (wants, published) {
            (Wants::Avoids, None) => {} // the last order holds until the next one
            (_, published) => match (self.around.order(rover, free, wants), published) {
                (Some(order), Some(it)) => self.mail.order.publish(it, order),
                _ => self.mail.order = Latest::empty(),
            },
        }
        let is_new = jobs.of(self.robot, Role::Localisation).is_some();
        let poses = by.filter(|_| is_new).map(|it| {
            let (located, covariance) = self.located_at(rover.odometry(), it);
            Poses { odometry: *rover.odometry(), located, covariance }
        });
        let devices = self.devices.look(rover, &self.origin, by);
        let track = rover.course().track();
        let along = rover.along();
        let at = rover.believed().translation.vector.into();
        let (near, lateral_m) = track.find(at, (along - 1.0).max(0.0), along + 1.0);
        let follows = uses.moves && !uses.is_led;
        if uses.is_led {
            self.observing.restart(); // he knows no path
        }
        let read = self.ring.latest(now);
        let period = Period {
            now,
            ranges: read,
            base: &self.base,
            poses: poses.map(|value| Sensed { taken: now, value }),
            place: follows.then_some(OnPath { along_m: near.along, lateral_m }),
            is_told_to_move: uses.moves,
            level_dbm: self.link.latest(now),
            heard: self.heard,
            image: self.image,
            free_m: free,
            is_packet_lost,
            jobs: &jobs,
            told_m_s: told.0 as f64 / 1_000.0,
            has_no_plan,
            devices,
        };
        self.flags = self.observing.look(&period);
    }

    /// Images and the operator's station.
    fn hear(&mut self, now: Millis, rover: &Rover<'_>, [is_seen, is_linked]: [bool; 2]) {
        let has = |harm: Harm| self.harms.iter().any(|it| it.harm == harm);
        let at = rover.pose().translation.vector.into();
        self.link.sense(now, at, rover.course().surface());
        let is_down = has(Harm::LinkDown);
        if !is_down && is_linked {
            self.heard = Some(now);
        }
        if !has(Harm::CameraSilent) && is_seen {
            let late = if has(Harm::CameraLate) { 2_000 } else { 0 };
            self.image = Some((now, Millis(now.0.saturating_sub(late))));
        }
    }

    /// Works out where the robot is, and lets it believe so.
    fn locate(&mut self, rover: &mut Rover<'_>, by: Option<By>, jobs: &Jobs, is_led: bool) {
        let odometry = *rover.odometry();
        if is_led {
            self.origin = rover.pose() * odometry.inverse();
        } else {
            if self.is_led || (by.is_some() && by != self.located) {
                let believed = self.origin * odometry;
                self.put(&believed);
                self.devices.marks.iter_mut().for_each(|it| it.begin(believed, odometry));
            }
            let published =
                jobs.of(self.robot, Role::Localisation).and_then(Happening::publication);
            if let (Some(by), Some(publication)) = (by, published) {
                match by {
                    By::Ring => {
                        self.localiser.update(&odometry, &self.ranges[0]);
                    }
                    By::Lasers => {
                        if let Some(it) = self.devices.reading(rover.now()) {
                            self.localiser.update(&it.odometry, &it.ranges);
                        }
                    }
                    By::Marks => {}
                }
                let origin = self.located_at(&odometry, by).0 * odometry.inverse();
                self.mail.origin.publish(publication, origin);
                self.origin = origin;
            }
        }
        (self.is_led, self.located) = (is_led, by);
        rover.believe(self.origin);
    }

    /// Returns the pose by localisation, with its covariance.
    fn located_at(&self, odometry: &Pose, by: By) -> (Pose, Matrix3<f64>) {
        let marks = self.devices.marks.as_ref().filter(|_| by == By::Marks);
        let by_ranges = || (self.localiser.pose_at(odometry), self.localiser.estimate().covariance);
        marks.map_or_else(by_ranges, |it| it.pose_at(odometry))
    }
}

/// Returns the faults of a sonar that harms make.
fn sonar_faults(harms: &[Harmed], sonar: usize, now: Millis) -> Vec<Fault> {
    let of = |it: &Harmed| {
        let own = usize::from(it.unit) == sonar;
        match it.harm {
            Harm::SonarFar if own => Some(Mode::Stuck(RANGE_M)),
            Harm::SonarNear if own => Some(Mode::Stuck(0.3)),
            Harm::SonarSilent => Some(Mode::DropOut(1.0)),
            Harm::SonarsNoisy => Some(Mode::Noise(NOISY_M)),
            _ => None,
        }
    };
    let modes = harms.iter().filter_map(of);
    modes.filter_map(|it| Fault::new(it).ok()).map(|it| it.from(now)).collect()
}
