//! Rings of sonars.

use crate::fault::Fault;
use crate::faults::Faults;
use crate::laser::fan;
use crate::scene::Scene;
use crate::sensed::{Clock, Pipe, Rate, Sensed};
use crate::settings::{SettingsError, within};
use core::f64::consts::{FRAC_PI_2, PI};
use cotama_core::units::Millis;
use cotama_floor::{Point, Pose, Ray, Sense, Vector};
use cotama_streams::{Stream, Streams};

/// The most sonars of a ring.
pub const MAX_SONARS: usize = 64;
/// The most rays of a cone.
pub const MAX_CONE_RAYS: usize = 64;

/// Properties of a ring of sonars.
#[derive(Clone, Debug, PartialEq)]
pub struct RingSettings {
    /// Each sonar on the robot, in metres and radians: x ahead, y to the left. The banks follow
    /// each other, all of the same number.
    pub mounts: Vec<Pose>,
    /// The number of banks. They fire at the same time, each its sonars one after the other.
    pub banks: usize,
    /// The angle of the cone, in radians.
    pub cone_rad: f64,
    /// The number of rays that stand for a cone.
    pub rays: usize,
    /// Things that are nearer read this, in metres.
    pub least_m: f64,
    /// The reading if no echo comes back, in metres.
    pub range_m: f64,
    /// Deviation of a range, in metres.
    pub noise_m: f64,
    /// Up to this angle of incidence an echo comes back for sure, in radians.
    pub echo_rad: f64,
    /// From this angle of incidence on none comes back, in radians: the sound is thrown away as by
    /// a mirror. In between the chance falls with the cosine.
    pub mirror_rad: f64,
    /// How likely a sonar takes the echo of one that fires with it for its own.
    pub cross_talk: f64,
    /// The time between two sonars of a bank, and the latency of a reading.
    pub rate: Rate,
}

impl RingSettings {
    /// The ring of a Pioneer 3-DX: poses as in ARIA's `p3dx-sh.p` (`SonarUnit` 0 to 15), a cone of
    /// 30° and 0.1 to 5 m as in Stage's `pioneer.inc`; two banks that fire independently, a sonar
    /// every 40 ms (Pioneer 3 Operations Manual), so that a sweep takes 320 ms. 5 m is also what a
    /// sonar reads that hears nothing (Durand et al., TAROS 2010, Section 4).
    ///
    /// Assumed: a deviation of 2 cm; echoes for sure up to 25° and none beyond 60°, which lies
    /// between smooth and rough walls; cross talk once in 200 readings.
    pub fn pioneer() -> Self {
        const FRONT: [(f64, f64, f64); 4] = [
            (0.069, 0.136, 90.0),
            (0.114, 0.119, 50.0),
            (0.148, 0.078, 30.0),
            (0.166, 0.027, 10.0),
        ];
        const REAR: [(f64, f64, f64); 4] = [
            (-0.157, 0.136, 90.0),
            (-0.203, 0.119, 130.0),
            (-0.237, 0.078, 150.0),
            (-0.255, 0.027, 170.0),
        ];
        let pose = |(x, y, deg): (f64, f64, f64)| Pose::new(Vector::new(x, y), deg.to_radians());
        let right = |(x, y, deg): (f64, f64, f64)| pose((x, -y, -deg));
        let front = FRONT.map(pose).into_iter().chain(FRONT.map(right).into_iter().rev());
        let rear = REAR.map(right).into_iter().chain(REAR.map(pose).into_iter().rev());
        Self {
            mounts: front.chain(rear).collect(),
            banks: 2,
            cone_rad: 30_f64.to_radians(),
            rays: 5,
            least_m: 0.1,
            range_m: 5.0,
            noise_m: 0.02,
            echo_rad: 25_f64.to_radians(),
            mirror_rad: 60_f64.to_radians(),
            cross_talk: 0.005,
            rate: Rate { period: Millis(40), latency: Millis(40) },
        }
    }

    /// Returns settings with which all sonars fire at once, after each period: as robots do whose
    /// sonars are simulated.
    #[must_use]
    pub fn all_at_once(self, period: Millis) -> Self {
        let rate = Rate { period, ..self.rate };
        Self { banks: self.mounts.len(), rate, ..self }
    }

    fn check(&self) -> Result<(), SettingsError> {
        let sonars = self.mounts.len();
        within("the number of sonars", sonars as f64, 1.0, MAX_SONARS as f64)?;
        within("the number of banks", self.banks as f64, 1.0, sonars as f64)?;
        within(
            "the number of sonars left over by equal banks",
            (sonars % self.banks) as f64,
            0.0,
            0.0,
        )?;
        within("the number of rays of a cone", self.rays as f64, 1.0, MAX_CONE_RAYS as f64)?;
        within("the cone in radians", self.cone_rad, 0.0, PI)?;
        within("the range in m", self.range_m, 0.01, 100.0)?;
        within("the least range in m", self.least_m, 0.0, self.range_m)?;
        within("the deviation in m", self.noise_m, 0.0, 100.0)?;
        within("the angle of sure echoes in radians", self.echo_rad, 0.0, FRAC_PI_2)?;
        within("the angle without echoes in radians", self.mirror_rad, self.echo_rad, FRAC_PI_2)?;
        within("the chance of cross talk", self.cross_talk, 0.0, 1.0)
    }
}

/// A sonar of the ring.
#[derive(Clone, Debug)]
struct Sonar {
    mount: Pose,
    chance: Stream,
    faults: Faults,
}

/// A ring of sonars.
///
/// A sonar reads the nearest thing in its cone that sends an echo back. Glass does. A surface that
/// it meets aslant does not, and the echo of something behind may come (Kuc and Siegel,
/// "Physically based simulation model for acoustic sensor robot navigation", IEEE PAMI 9(6), 1987,
/// describe why). A sonar may hear another that fires at the same time, if that sound is sooner
/// there (Borenstein and Koren, "Error eliminating rapid ultrasonic firing for mobile robot
/// obstacle avoidance", IEEE T-RA 11(1), 1995).
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Ring, RingSettings, Scene, Streams};
/// use cotama_floor::{Point, Pose, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Real, &[]).unwrap();
/// let settings = RingSettings { noise_m: 0.0, cross_talk: 0.0, ..RingSettings::pioneer() };
/// let mut ring = Ring::new(&settings, &Streams::new(7), "sonar").unwrap();
/// let pose = Pose::new(Point::new(10.5, 10.0).coords, 0.0);
/// for now in (0..=320).step_by(40).map(Millis) {
///     ring.sense(now, &pose, &Scene::of(&surface, &[]));
/// }
/// let read = ring.latest(Millis(320)).unwrap();
/// // To the left a wall, to the right the glass of the lounge, each 1 m away from the middle.
/// let mm = |it: usize| (read[it].unwrap().value * 1_000.0).round();
/// assert_eq!([0, 7].map(mm), [864.0, 864.0]);
/// assert_eq!([0, 7].map(|it: usize| read[it].unwrap().taken.0), [0, 280]);
/// assert_eq!(read[3].unwrap().value, 5.0); // along the corridor
/// ```
#[derive(Clone, Debug)]
pub struct Ring {
    sonars: Vec<Sonar>,
    banks: usize,
    settings: Sound,
    clock: Clock,
    /// How often a sonar of each bank has fired.
    fired: usize,
    /// The distance of the furthest sonar from the robot's origin.
    reach: f64,
    /// The ways of a cone's rays as a sonar sees them.
    ways: Vec<Vector>,
    rays: Vec<Ray>,
    distances: Vec<f64>,
    /// The echoes of those that fire together.
    echoes: Vec<f64>,
    read: Vec<Option<Sensed<f64>>>,
    pipe: Pipe<Option<Sensed<f64>>>,
}

/// Properties that all sonars of a ring share.
#[derive(Clone, Copy, Debug)]
struct Sound {
    least_m: f64,
    range_m: f64,
    noise_m: f64,
    /// Cosines of the two angles of incidence.
    sure: f64,
    never: f64,
    cross_talk: f64,
}

impl Sound {
    /// Whether an echo comes back at an angle of incidence; the luck is from 0 up to 1.
    fn comes_back(&self, cosine: f64, luck: f64) -> bool {
        cosine >= self.sure || cosine - self.never > luck * (self.sure - self.never)
    }
}

impl Ring {
    /// A ring of a name, after which its random numbers are named.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        settings: &RingSettings,
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        settings.check()?;
        let (count, banks) = (settings.mounts.len(), settings.banks);
        let sweep = Millis(settings.rate.period.0.saturating_mul((count / banks) as u64));
        let sonar = |(at, mount): (usize, &Pose)| Sonar {
            mount: *mount,
            chance: streams.stream(&format!("{name} {at}")),
            faults: Faults::none(1, sweep),
        };
        let sonars: Vec<_> = settings.mounts.iter().enumerate().map(sonar).collect();
        let from = settings.mounts.iter().map(|it| it.translation.vector.norm());
        let ray = Ray { from: Point::origin(), along: Vector::x() };
        Ok(Self {
            sonars,
            banks,
            settings: Sound {
                least_m: settings.least_m,
                range_m: settings.range_m,
                noise_m: settings.noise_m,
                sure: libm::cos(settings.echo_rad),
                never: libm::cos(settings.mirror_rad),
                cross_talk: settings.cross_talk,
            },
            clock: Clock::new(settings.rate.period),
            fired: 0,
            reach: from.fold(0.0, f64::max),
            ways: fan(settings.cone_rad, settings.rays),
            rays: vec![ray; banks * settings.rays],
            distances: vec![f64::INFINITY; banks * settings.rays],
            echoes: vec![f64::INFINITY; banks],
            read: vec![None; count],
            pipe: Pipe::new(count, None, settings.rate)?,
        })
    }

    /// Adds faults of a sonar, in place of those that it had.
    ///
    /// # Errors
    /// Numbers that are out of range, that of the sonar with them.
    pub fn set_faults(
        &mut self,
        sonar: usize,
        faults: &[Fault],
        streams: &Streams,
        name: &str,
    ) -> Result<(), SettingsError> {
        within("the sonar", sonar as f64, 0.0, self.sonars.len().saturating_sub(1) as f64)?;
        let Some(it) = self.sonars.get_mut(sonar) else { return Ok(()) };
        it.faults.replace(faults, streams, &format!("{name} {sonar}"))
    }

    /// The time at which the next sonars fire.
    pub fn due(&self) -> Millis {
        self.clock.due()
    }

    /// Fires the sonars whose turn it is, for a robot at a pose.
    pub fn sense(&mut self, now: Millis, robot: &Pose, scene: &Scene<'_>) {
        if !self.clock.strikes(now) {
            return;
        }
        let each = self.sonars.len() / self.banks;
        let turn = self.fired % each;
        self.fired = turn + 1;
        let width = self.ways.len();
        let firing = self.sonars.iter().skip(turn).step_by(each);
        for (sonar, rays) in firing.zip(self.rays.chunks_mut(width)) {
            let at = robot * sonar.mount;
            let from = Point::from(at.translation.vector);
            for (ray, way) in rays.iter_mut().zip(&self.ways) {
                *ray = Ray { from, along: at.rotation * way };
            }
        }
        let around = (Point::from(robot.translation.vector), self.reach);
        let (range, sound) = (self.settings.range_m, self.settings);
        scene.distances(around, &self.rays, range, Sense::Sound, &mut self.distances);
        let firing = self.sonars.iter_mut().skip(turn).step_by(each);
        let cones = self.rays.chunks(width).zip(self.distances.chunks_mut(width));
        for ((sonar, echo), (rays, distances)) in firing.zip(&mut self.echoes).zip(cones) {
            let luck = sonar.chance.part();
            *echo = nearest_echo(scene, rays, distances, &sound, luck);
        }
        let firing = self.sonars.iter_mut().enumerate().skip(turn).step_by(each);
        for (bank, (number, sonar)) in firing.enumerate() {
            let own = self.echoes.get(bank).copied().unwrap_or(f64::INFINITY);
            let other = other_bank(&mut sonar.chance, bank, self.banks);
            let hears = sonar.chance.part() < sound.cross_talk;
            let heard = self.echoes.get(other).copied().filter(|_| hears).unwrap_or(own).min(own);
            let noisy = heard + sonar.chance.error() * sound.noise_m;
            let range = if heard > sound.range_m { sound.range_m } else { noisy };
            let mut reading = [range.clamp(sound.least_m, sound.range_m)];
            if sonar.faults.apply(now, &mut reading)
                && let Some(read) = self.read.get_mut(number)
            {
                let [value] = reading;
                *read = Some(Sensed { taken: now, value });
            }
        }
        self.pipe.push(now, &self.read);
    }

    /// Returns the newest readings that have arrived, in metres, in the order of the sonars; none
    /// of a sonar that has not fired yet.
    pub fn latest(&self, now: Millis) -> Option<&[Option<Sensed<f64>>]> {
        self.pipe.latest(now).map(|it| it.value)
    }
}

/// Draws one of the other banks.
fn other_bank(chance: &mut Stream, bank: usize, banks: usize) -> usize {
    let others = banks.saturating_sub(1).max(1) as u64;
    (bank + 1 + chance.below(others) as usize) % banks
}

/// Returns the distance of the nearest thing in a cone that sends an echo back.
fn nearest_echo(
    scene: &Scene<'_>,
    rays: &[Ray],
    distances: &mut [f64],
    sound: &Sound,
    luck: f64,
) -> f64 {
    /// Rays alone and rays together may differ by less.
    const SLACK_M: f64 = 1e-6;
    for _ in 0..rays.len() {
        let all = rays.iter().zip(distances.iter_mut());
        let Some((ray, distance)) = all.min_by(|a, b| a.1.total_cmp(b.1)) else { break };
        if distance.is_infinite() {
            break;
        }
        let echo = scene.echo(ray, *distance + SLACK_M, Sense::Sound);
        if let Some(echo) = echo.filter(|it| sound.comes_back(it.cosine, luck)) {
            return echo.distance;
        }
        *distance = f64::INFINITY;
    }
    f64::INFINITY
}
