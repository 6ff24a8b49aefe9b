//! QR marks: what a camera sees of them, and the pose of the robot by them.

use crate::lasers::mount;
use cotama_core::units::Millis;
use cotama_devices::{Camera, CameraSettings, Fault, Mode, QrMark, Rate, Scene, Sensed};
use cotama_devices::{SettingsError, Sighting, Streams};
use cotama_floor::{Point, Pose, Surface};
use cotama_models::robots::sensing::MarkCamera;
use cotama_models::robots::{Harm, Harmed};
use cotama_observers::{Job, OdometryErrors};
use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
use std::collections::VecDeque;

/// The time for which the robot knows where it was when a picture was taken.
const HISTORY: usize = 32;
/// A mark is expected for sure so much inside of what the camera finds: as a part of distance and
/// speed, and in radians of both angles.
const SURE_PART: f64 = 0.8;
const SURE_RAD: f64 = 0.14;
/// Deviations of a pose that nothing but odometry has told for long: 1 m, 1 m, 0.2 rad.
const UNSURE: [f64; 3] = [1.0, 1.0, 0.2];
/// Sightings are taken for wrong beyond this squared Mahalanobis distance of two degrees of
/// freedom: one of 10,000 right ones is.
const GATE: f64 = 18.42;

/// The camera of a robot, the marks that its map has, and its pose by them.
#[derive(Clone, Debug)]
pub(crate) struct Marks {
    camera: Camera,
    settings: CameraSettings,
    known: Vec<QrMark>,
    /// The hardware that it is, as a bit.
    pub(crate) hardware: u64,
    /// The odometry and the speed of the last periods, the oldest first.
    history: VecDeque<(Millis, Pose, f64)>,
    /// The picture that was looked at last.
    newest: Option<Millis>,
    is_covered: bool,
    filter: Filter,
}

impl Marks {
    pub(crate) fn new(
        of: &MarkCamera,
        marks: &[QrMark],
        streams: Streams,
    ) -> Result<Self, SettingsError> {
        let settings = CameraSettings {
            mount: mount(&of.mount),
            view_rad: f64::from(of.view_deg).to_radians(),
            speed_m_s: of.sharp_mm_s as f64 / 1_000.0,
            rate: Rate { period: of.times[0], latency: of.times[1] },
            ..CameraSettings::kinect()
        };
        Ok(Self {
            camera: Camera::new(&settings, marks, &streams, "marks")?,
            settings,
            known: marks.to_vec(),
            hardware: 1 << of.hardware,
            history: VecDeque::with_capacity(HISTORY),
            newest: None,
            is_covered: false,
            filter: Filter::at(Pose::identity(), Pose::identity()),
        })
    }

    /// Harms the camera, or mends it.
    pub(crate) fn harm(&mut self, harms: &[Harmed], now: Millis, streams: Streams) {
        let has = |harm: Harm| harms.iter().any(|it| it.harm == harm);
        self.is_covered = has(Harm::MarksCovered);
        let silent = Fault::new(Mode::DropOut(1.0)).ok().filter(|_| has(Harm::CameraSilent));
        let faults: Vec<_> = silent.into_iter().map(|it| it.from(now)).collect();
        let set = self.camera.faults().replace(&faults, &streams, "marks");
        debug_assert!(set.is_ok(), "faults of pictures");
    }

    /// Takes a picture if one is due.
    pub(crate) fn sense(
        &mut self,
        now: Millis,
        pose: &Pose,
        (odometry, speed_m_s): (&Pose, f64),
        scene: &Scene<'_>,
    ) {
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        self.history.push_back((now, *odometry, speed_m_s));
        self.camera.sense(now, pose, speed_m_s, scene);
    }

    /// Begins to localise at a pose that is not sure.
    pub(crate) fn begin(&mut self, believed: Pose, odometry: Pose) {
        self.filter = Filter::at(believed, odometry);
    }

    /// Looks at a picture that is new: corrects the pose by it where that `is_used`, and says
    /// whether the marks are in it that the map has there.
    pub(crate) fn look(
        &mut self,
        now: Millis,
        origin: &Pose,
        charted: &dyn Surface,
        is_used: bool,
    ) -> Option<Job> {
        let Sensed { taken, value } = self.camera.latest(now)?;
        if self.newest.replace(taken) == Some(taken) {
            return None;
        }
        let (_, odometry, speed) = *self.history.iter().find(|it| it.0 == taken)?;
        let seen: &[Sighting] = if self.is_covered { &[] } else { value };
        if is_used {
            self.filter.goes_to(odometry);
            for it in seen {
                if let Some(mark) = self.known.get(it.mark) {
                    self.filter.sees(mark.at, it, &self.settings);
                }
            }
        }
        if speed > self.settings.speed_m_s * SURE_PART {
            return None;
        }
        let camera = origin * odometry * self.settings.mount;
        let sure = self.known.iter().enumerate();
        let mut sure = sure.filter(|it| self.is_sure(it.1, &camera, charted)).peekable();
        sure.peek()?;
        let is_kept = sure.any(|(mark, _)| seen.iter().any(|it| it.mark == mark));
        Some(if is_kept { Job::Kept } else { Job::Missed })
    }

    /// Whether the camera finds a mark for sure, there.
    fn is_sure(&self, mark: &QrMark, camera: &Pose, charted: &dyn Surface) -> bool {
        let from = Point::from(camera.translation.vector);
        let way = mark.at - from;
        let distance = way.norm();
        let seen = camera.inverse_transform_vector(&way);
        let facing = -mark.facing.dot(&way) / distance.max(1e-9);
        let CameraSettings { view_rad, sure_sizes, aslant_rad, .. } = self.settings;
        let is_near = distance < sure_sizes * SURE_PART * mark.size_m * facing;
        let ahead = seen.x / distance.max(1e-9);
        is_near
            && ahead > libm::cos((view_rad / 2.0 - SURE_RAD).max(0.0))
            && facing > libm::cos((aslant_rad - SURE_RAD).max(0.0))
            && Scene::of(charted, &[]).is_clear(from, mark.at + mark.facing * 0.01)
    }

    /// Returns the pose by marks, and by odometry since the last picture, with its covariance.
    pub(crate) fn pose_at(&self, odometry: &Pose) -> (Pose, Matrix3<f64>) {
        let Filter { pose, covariance, at } = &self.filter;
        (pose * (at.inverse() * odometry), *covariance)
    }
}

/// A Kalman filter of the pose, by sightings of marks that are known (Thrun, Burgard, Fox,
/// Probabilistic Robotics, 2005, Table 7.2).
#[derive(Clone, Debug)]
struct Filter {
    pose: Pose,
    /// Covariance of x, y and heading on the map.
    covariance: Matrix3<f64>,
    /// The odometry at this pose.
    at: Pose,
}

impl Filter {
    fn at(pose: Pose, at: Pose) -> Self {
        let covariance = Matrix3::from_diagonal(&Vector3::from(UNSURE.map(|it| it * it)));
        Self { pose, covariance, at }
    }

    /// Goes on to where odometry is now.
    fn goes_to(&mut self, odometry: Pose) {
        let step = self.at.inverse() * odometry;
        let (way, turned) = (step.translation.vector.norm(), step.rotation.angle().abs());
        let moved = self.pose.rotation * step.translation.vector;
        let OdometryErrors { way: along, drift, turn } = OdometryErrors::pioneer();
        let mut motion = Matrix3::identity();
        motion[(0, 2)] = -moved.y;
        motion[(1, 2)] = moved.x;
        let aside = along * along * way;
        let heading = drift * drift * way + turn * turn * turned;
        let noise = Matrix3::from_diagonal(&Vector3::new(aside, aside, heading));
        self.covariance = motion * self.covariance * motion.transpose() + noise;
        self.pose *= step;
        self.at = odometry;
    }

    /// Corrects the pose by a mark at a place, unless the sighting is taken for wrong.
    fn sees(&mut self, mark: Point, it: &Sighting, camera: &CameraSettings) {
        // The camera from the robot, as the map has it; its change with the heading is across.
        let arm = self.pose.rotation * camera.mount.translation.vector;
        let to = mark.coords - self.pose.translation.vector - arm;
        let distance = to.norm();
        if distance < 1e-3 {
            return;
        }
        let way = to / distance;
        let heading = (self.pose.rotation * camera.mount.rotation).angle();
        let bearing = libm::atan2(to.y, to.x) - heading;
        let across = Vector2::new(-arm.y, arm.x);
        let side = Vector2::new(-way.y, way.x) / distance;
        let slope = Matrix2x3::new(
            -way.x,
            -way.y,
            -way.dot(&across),
            -side.x,
            -side.y,
            -side.dot(&across) - 1.0,
        );
        let [far, aside] = [camera.noise_part * distance, camera.noise_rad];
        let noise = Matrix2::new(far * far, 0.0, 0.0, aside * aside);
        let apart = it.bearing - bearing;
        let apart = libm::atan2(libm::sin(apart), libm::cos(apart));
        let error = Vector2::new(it.distance - distance, apart);
        let spread = slope * self.covariance * slope.transpose() + noise;
        let Some(inverse) = spread.try_inverse() else { return };
        if error.dot(&(inverse * error)) > GATE {
            return;
        }
        let gain = self.covariance * slope.transpose() * inverse;
        let change = gain * error;
        self.pose.translation.vector += Vector2::new(change.x, change.y);
        self.pose.rotation *= nalgebra::UnitComplex::new(change.z);
        let covariance = (Matrix3::identity() - gain * slope) * self.covariance;
        self.covariance = (covariance + covariance.transpose()) / 2.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_floor::Vector;

    /// A robot at (3, 2) that believes to be 60 cm and 8° elsewhere sees three marks again and
    /// again, with a camera that looks to the left.
    #[test]
    fn a_robot_that_sees_three_marks_finds_where_it_is() {
        let mount = Pose::new(Vector::new(0.2, 0.05), 0.6);
        let camera = CameraSettings { mount, ..CameraSettings::kinect() };
        let truth = Pose::new(Vector::new(3.0, 2.0), 0.3);
        let mut filter = Filter::at(Pose::new(Vector::new(3.4, 1.6), 0.44), Pose::identity());
        let marks = [[4.0, 5.0], [2.0, 4.0], [5.0, 4.5]].map(Point::from);
        for mark in marks.iter().cycle().take(90) {
            let seen = (truth * mount).inverse_transform_point(mark);
            let bearing = libm::atan2(seen.y, seen.x);
            let it = Sighting { mark: 0, distance: seen.coords.norm(), bearing };
            filter.sees(*mark, &it, &camera);
        }
        let off = truth.inverse() * filter.pose;
        let (far, turned) = (off.translation.vector.norm(), off.rotation.angle().abs());
        assert!(far < 0.01 && turned < 0.005, "{far} m, {turned} rad");
    }

    #[test]
    fn a_sighting_of_another_mark_is_taken_for_wrong() {
        let camera = CameraSettings::kinect();
        let mut filter = Filter::at(Pose::identity(), Pose::identity());
        filter.covariance = Matrix3::identity() * 0.01;
        let it = Sighting { mark: 0, distance: 2.0, bearing: 0.0 };
        filter.sees(Point::new(4.0, 1.0), &it, &camera);
        assert_eq!(filter.pose, Pose::identity());
    }
}
