//! Cameras that find QR marks.

use crate::faults::Faults;
use crate::scene::Scene;
use crate::sensed::{Clock, Pipe, Rate, Sensed};
use crate::settings::{SettingsError, within};
use core::f64::consts::{FRAC_PI_2, TAU};
use cotama_core::units::Millis;
use cotama_floor::{Floor, Point, Pose, Vector, metres};
use cotama_streams::{Stream, Streams};

/// A QR mark at a wall, as a camera needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QrMark {
    /// The middle.
    pub at: Point,
    /// The way that it faces, of length 1.
    pub facing: Vector,
    /// The side of the square, in metres.
    pub size_m: f64,
}

impl QrMark {
    /// Returns the marks of a floor, in their order.
    pub fn of(floor: &Floor) -> Vec<Self> {
        let mark = |it: &cotama_floor::Mark| {
            let (sin, cos) = libm::sincos(f64::from(it.facing_deg).to_radians());
            let size_m = f64::from(it.size) / 1_000.0;
            Self { at: metres(it.at), facing: Vector::new(cos, sin), size_m }
        };
        floor.marks.iter().map(mark).collect()
    }
}

/// Properties of a camera that finds marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSettings {
    /// The camera on the robot, in metres and radians: x ahead, y to the left.
    pub mount: Pose,
    /// The angle from one side of the picture to the other, in radians.
    pub view_rad: f64,
    /// Up to so many times its size away, a mark is found for sure.
    pub sure_sizes: f64,
    /// From so many times its size on, it is not found; in between the chance falls evenly.
    pub never_sizes: f64,
    /// The largest angle between the facing of a mark and the line to the camera, in radians.
    pub aslant_rad: f64,
    /// A robot that is faster takes blurred pictures, in which nothing is found; in m/s.
    pub speed_m_s: f64,
    /// Deviation of a distance as a part of it.
    pub noise_part: f64,
    /// Deviation of a bearing, in radians.
    pub noise_rad: f64,
    /// Times of pictures.
    pub rate: Rate,
}

impl CameraSettings {
    /// A Kinect at the robot's origin: 57° and 30 pictures a second (its published
    /// specification), of 640 columns. A robot finds codes below 0.45 m/s (Lambert et al., J.
    /// Intell. Robot. Syst. 110, 2024, Section 4.3).
    ///
    /// Derived: a code has 21 modules at least (ISO/IEC 18004); it is found for sure with 4 columns
    /// a module, at 7.6 times its size, and not with less than 2, at 15.3 times. Assumed: 60°
    /// aslant; a deviation of 2 % and of 0.5°; a latency of 100 ms.
    pub fn kinect() -> Self {
        Self {
            mount: Pose::identity(),
            view_rad: 57_f64.to_radians(),
            sure_sizes: 7.6,
            never_sizes: 15.3,
            aslant_rad: 60_f64.to_radians(),
            speed_m_s: 0.45,
            noise_part: 0.02,
            noise_rad: 0.5_f64.to_radians(),
            rate: Rate { period: Millis(33), latency: Millis(100) },
        }
    }
}

/// A mark in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// The number of the mark.
    pub mark: usize,
    /// How far it is from the camera, in metres.
    pub distance: f64,
    /// The angle to it from straight ahead of the camera, in radians: positive to the left.
    pub bearing: f64,
}

impl CameraSettings {
    /// Returns the chance that a mark is found, so many times its size away.
    fn chance(&self, sizes: f64) -> f64 {
        if sizes <= self.sure_sizes {
            return 1.0;
        }
        ((self.never_sizes - sizes) / (self.never_sizes - self.sure_sizes)).max(0.0)
    }
}

/// The light of a mark begins so far before the wall that carries it, in metres.
const BEFORE_WALL_M: f64 = 0.005;

/// The most marks.
pub const MAX_MARKS: usize = 4_096;

/// A camera that finds QR marks: in its field of view, near enough, not too far from the side, with
/// nothing between that light does not pass.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Camera, CameraSettings, QrMark, Scene, Streams};
/// use cotama_floor::{Point, Pose, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Real, &[]).unwrap();
/// let marks = QrMark::of(&office);
/// let settings = CameraSettings::kinect();
/// let mut camera = Camera::new(&settings, &marks, &Streams::new(7), "camera").unwrap();
/// // A robot in the corridor looks at the wall to the north.
/// let pose = Pose::new(Point::new(9.5, 10.0).coords, std::f64::consts::FRAC_PI_2);
/// camera.sense(Millis(0), &pose, 0.3, &Scene::of(&surface, &[]));
/// let seen = camera.latest(Millis(100)).unwrap().value;
/// assert_eq!(office.marks[seen[0].mark].name, "qr corridor 2");
/// assert!((seen[0].distance - 1.0).abs() < 0.1 && seen[0].bearing.abs() < 0.05);
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    settings: CameraSettings,
    /// Cosines of half the field of view, and of the largest angle aslant.
    view: f64,
    aslant: f64,
    clock: Clock,
    marks: Vec<QrMark>,
    /// The numbers of each mark are drawn from a stream of its own, for each picture.
    chances: Vec<Stream>,
    /// The distance of each mark, then the bearing of each; infinite if it is not seen.
    frame: Vec<f64>,
    seen: Vec<Sighting>,
    faults: Faults,
    pipe: Pipe<Sighting>,
}

impl Camera {
    /// A camera of a name, after which its random numbers are named, and the marks that there are.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        settings: &CameraSettings,
        marks: &[QrMark],
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        let it = *settings;
        within("the number of marks", marks.len() as f64, 0.0, MAX_MARKS as f64)?;
        within("the field of view in radians", it.view_rad, 0.0, TAU)?;
        within("sizes at which a mark is found for sure", it.sure_sizes, 0.0, 1_000.0)?;
        within("sizes at which no mark is found", it.never_sizes, it.sure_sizes, 1_000.0)?;
        within("the angle aslant in radians", it.aslant_rad, 0.0, FRAC_PI_2)?;
        within("the speed in m/s", it.speed_m_s, 0.0, f64::INFINITY)?;
        within("the deviation of a distance", it.noise_part, 0.0, 1.0)?;
        within("the deviation of a bearing in radians", it.noise_rad, 0.0, TAU)?;
        let nothing = Sighting { mark: 0, distance: 0.0, bearing: 0.0 };
        let chance = |at: usize| streams.stream(&format!("{name} mark {at}"));
        Ok(Self {
            settings: it,
            view: libm::cos(it.view_rad / 2.0),
            aslant: libm::cos(it.aslant_rad),
            clock: Clock::new(it.rate.period),
            marks: marks.to_vec(),
            chances: (0..marks.len()).map(chance).collect(),
            frame: vec![f64::INFINITY; 2 * marks.len()],
            seen: Vec::with_capacity(marks.len()),
            faults: Faults::none(2 * marks.len(), it.rate.period).on_first(marks.len()),
            pipe: Pipe::new(marks.len(), nothing, it.rate)?,
        })
    }

    /// Returns the faults of its pictures, to be replaced: pictures are lost, frozen or late as a
    /// whole; effects on numbers change the distances.
    pub fn faults(&mut self) -> &mut Faults {
        &mut self.faults
    }

    /// The time of the next picture.
    pub fn due(&self) -> Millis {
        self.clock.due()
    }

    /// Takes a picture if one is due, for a robot at a pose and a speed in m/s.
    pub fn sense(&mut self, now: Millis, robot: &Pose, speed_m_s: f64, scene: &Scene<'_>) {
        if !self.clock.strikes(now) {
            return;
        }
        let CameraSettings { mount, noise_part, noise_rad, .. } = self.settings;
        let at = robot * mount;
        let is_sharp = speed_m_s.abs() <= self.settings.speed_m_s;
        let (distances, bearings) = self.frame.split_at_mut(self.marks.len());
        let places = distances.iter_mut().zip(bearings);
        for ((mark, chance), (distance, bearing)) in
            self.marks.iter().zip(&mut self.chances).zip(places)
        {
            (*distance, *bearing) = (f64::INFINITY, f64::INFINITY);
            let Some(look) = Look::at(mark, &at).filter(|_| is_sharp) else { continue };
            if look.sizes >= self.settings.never_sizes {
                continue;
            }
            // Drawn for each mark that is near, whether it is hidden or not.
            let (luck, far, aside) = (chance.part(), chance.error(), chance.error());
            let is_in_view = look.ahead >= self.view && look.facing >= self.aslant;
            if is_in_view && luck < self.settings.chance(look.sizes) && look.is_free(scene) {
                *distance = look.distance * (1.0 + far * noise_part);
                *bearing = look.bearing + aside * noise_rad;
            }
        }
        if !self.faults.apply(now, &mut self.frame) {
            return;
        }
        self.seen.clear();
        let (distances, bearings) = self.frame.split_at(self.marks.len());
        let all = distances.iter().zip(bearings).enumerate().filter(|it| it.1.1.is_finite());
        self.seen.extend(all.map(|(mark, (distance, bearing))| Sighting {
            mark,
            distance: *distance,
            bearing: *bearing,
        }));
        self.pipe.push(now, &self.seen);
    }

    /// Returns the marks in the newest picture that has arrived, by number.
    pub fn latest(&self, now: Millis) -> Option<Sensed<&[Sighting]>> {
        self.pipe.latest(now)
    }
}

/// A camera's look at a mark, as if nothing were between.
struct Look {
    from: Point,
    to: Point,
    distance: f64,
    bearing: f64,
    /// Cosine of the bearing.
    ahead: f64,
    /// Cosine of the angle between the facing of the mark and the line to the camera.
    facing: f64,
    /// The distance in sizes of the mark as it looks from the side.
    sizes: f64,
}

impl Look {
    /// Looks at a mark from a pose; `None` from behind or from its very middle.
    fn at(mark: &QrMark, camera: &Pose) -> Option<Self> {
        let from = Point::from(camera.translation.vector);
        let way = mark.at - from;
        let distance = way.norm();
        let seen = camera.inverse_transform_vector(&way);
        let facing = -mark.facing.dot(&way) / distance;
        (facing > 0.0).then(|| Self {
            from,
            // Just before the wall that carries it.
            to: mark.at + mark.facing * BEFORE_WALL_M,
            distance,
            bearing: libm::atan2(seen.y, seen.x),
            ahead: seen.x / distance,
            facing,
            sizes: distance / (mark.size_m * facing),
        })
    }

    fn is_free(&self, scene: &Scene<'_>) -> bool {
        scene.is_clear(self.from, self.to)
    }
}
