//! Odometry against localisation: growth and jumps of their distance, and the spread.

use crate::flag::Flag;
use crate::promise::FalseAlarms;
use crate::quantile::chi_square_quantile;
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};
use nalgebra::{Isometry2, Matrix3, Vector3};

/// Two estimates of the pose of one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Poses {
    /// The pose of odometry, in its own frame.
    pub odometry: Isometry2<f64>,
    /// The pose of localisation, on the map.
    pub located: Isometry2<f64>,
    /// Covariance of the located x, y (m²) and heading (rad²), on the map.
    pub covariance: Matrix3<f64>,
}

impl Poses {
    fn is_finite(&self) -> bool {
        let pose = |it: &Isometry2<f64>| {
            it.translation.vector.iter().all(|it| it.abs() < 1e9) && it.rotation.re.abs() <= 1.1
        };
        let covariance = self.covariance.iter().all(|it| it.abs() < 1e12);
        pose(&self.odometry) && pose(&self.located) && covariance
    }
}

/// Errors of odometry: deviations that grow with the square root of what was driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryErrors {
    /// Deviation of the way, in m per √m.
    pub way: f64,
    /// Deviation of the heading by the way, in rad per √m.
    pub drift: f64,
    /// Deviation of the heading by turning, in rad per √rad.
    pub turn: f64,
}

impl OdometryErrors {
    /// Errors of a Pioneer 3-DX after its calibration: all assumed.
    pub const fn pioneer() -> Self {
        Self { way: 0.01, drift: 0.01, turn: 0.03 }
    }

    pub(crate) fn check(&self) -> Result<(), SettingsError> {
        within("the error of the way in m per √m", self.way, 1e-6, 10.0)?;
        within("the error of the heading in rad per √m", self.drift, 1e-6, 10.0)?;
        within("the error of the heading in rad per √rad", self.turn, 1e-6, 10.0)
    }
}

/// A stretch that was driven: the way since its begin, and the covariance of odometry's error.
#[derive(Clone, Debug, PartialEq)]
struct Stretch {
    began: Sensed<Poses>,
    last: Sensed<Poses>,
    /// Covariance of x, y and heading in the frame of the pose at the begin.
    covariance: Matrix3<f64>,
}

impl Stretch {
    fn new(poses: Sensed<Poses>) -> Self {
        Self { began: poses, last: poses, covariance: Matrix3::zeros() }
    }

    /// Adds a step: Σ' = F Σ Fᵀ + G Q Gᵀ (Siegwart, Nourbakhsh, Scaramuzza, Introduction to
    /// Autonomous Mobile Robots, 2nd ed., Section 5.2.4), with errors of way and heading.
    fn add(&mut self, errors: &OdometryErrors, poses: Sensed<Poses>) {
        let driven = self.began.value.odometry.inv_mul(&self.last.value.odometry);
        let step = self.last.value.odometry.inv_mul(&poses.value.odometry);
        let aside = driven.rotation * step.translation.vector;
        let (way, turn) = (step.translation.vector.norm(), step.rotation.angle().abs());
        let mut heading = Matrix3::identity();
        heading[(0, 2)] = -aside.y;
        heading[(1, 2)] = aside.x;
        let half = driven.rotation.angle() + step.rotation.angle() / 2.0;
        let (sin, cos) = libm::sincos(half);
        let along = Vector3::new(cos, sin, 0.0);
        let across = Vector3::new(-aside.y / 2.0, aside.x / 2.0, 1.0);
        let ways = errors.way * errors.way * way;
        let headings = errors.drift * errors.drift * way + errors.turn * errors.turn * turn;
        self.covariance = heading * self.covariance * heading.transpose()
            + along * along.transpose() * ways
            + across * across.transpose() * headings;
        self.last = poses;
    }

    /// Returns the squared Mahalanobis distance of the two ways that were driven, as odometry and
    /// as localisation have it; `None` if a covariance is none.
    fn distance(&self) -> Option<f64> {
        let (from, to) = (&self.began.value, &self.last.value);
        let driven = from.odometry.inv_mul(&to.odometry);
        let located = from.located.inv_mul(&to.located);
        let aside = located.translation.vector - driven.translation.vector;
        let turned = (driven.rotation.inverse() * located.rotation).angle();
        let error = Vector3::new(aside.x, aside.y, turned);
        // Errors of both located poses, turned into the frame of the first.
        let back = from.located.rotation.inverse();
        let mut at_end = Matrix3::identity();
        at_end.fixed_view_mut::<2, 2>(0, 0).copy_from(back.to_rotation_matrix().matrix());
        let mut at_begin = -at_end;
        at_begin[(0, 2)] = located.translation.y;
        at_begin[(1, 2)] = -located.translation.x;
        let covariance = self.covariance
            + at_begin * from.covariance * at_begin.transpose()
            + at_end * to.covariance * at_end.transpose();
        let solved = covariance.cholesky()?.solve(&error);
        Some(error.dot(&solved))
    }
}

/// An observer of the distance between odometry and localisation: its growth over a window, or its
/// jump from one pose to the next (Durand et al., TAROS 2010, Section VI.A.2).
///
/// *Assumption.* Errors of odometry are normal and independent from step to step, with deviations
/// that grow with the square root of the way and the turn; errors of localisation are normal, with
/// the covariance that comes with the pose, and independent at both ends of the window. If they
/// are alike at both ends, or localisation follows odometry, the distance is smaller than assumed,
/// and alarms are fewer.
///
/// *Threshold.* The squared Mahalanobis distance of the two ways driven over the window is a
/// chi-square number of 3 degrees of freedom; its quantile that is exceeded with the chance of a
/// decision, of which there is one per window (Bar-Shalom, Li, Kirubarajan, Estimation with
/// Applications to Tracking and Navigation, 2001, Section 1.4.17). A covariance that is not
/// positive definite is raised.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{Apart, FalseAlarms, Flag, OdometryErrors, Poses};
/// use nalgebra::{Isometry2, Matrix3, Vector2};
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let errors = OdometryErrors::pioneer();
/// let mut growth = Apart::new(errors, Millis(5_000), promise).unwrap();
/// // The map pushes the located pose back by 30 cm over 1.5 m.
/// let mut flag = Flag::Clear;
/// for step in 0..=50_u64 {
///     let x = step as f64 * 0.03;
///     let poses = Poses {
///         odometry: Isometry2::new(Vector2::new(x, 0.0), 0.0),
///         located: Isometry2::new(Vector2::new(0.8 * x, 0.0), 0.0),
///         covariance: Matrix3::identity() * 0.0004,
///     };
///     flag = growth.observe(Some(Sensed { taken: Millis(step * 100), value: poses }));
/// }
/// assert_eq!(flag, Flag::Raised);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Apart {
    errors: OdometryErrors,
    window: u64,
    most: f64,
    stretch: Option<Stretch>,
    flag: Flag,
}

impl Apart {
    /// An observer with a window: 5 s show growth, one period shows jumps.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        errors: OdometryErrors,
        window: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        errors.check()?;
        within("the window in ms", window.0 as f64, 1.0, 600_000.0)?;
        let most = chi_square_quantile(3, promise.per_decision(window));
        Ok(Self { errors, window: window.0, most, stretch: None, flag: Flag::Clear })
    }

    /// Looks at the newest poses. The flag stays from the end of a window to the end of the next.
    pub fn observe(&mut self, poses: Option<Sensed<Poses>>) -> Flag {
        let Some(poses) = poses.filter(|it| it.value.is_finite()) else { return Flag::Missing };
        let stretch = self.stretch.get_or_insert_with(|| Stretch::new(poses));
        if poses.taken > stretch.last.taken {
            stretch.add(&self.errors, poses);
        }
        if stretch.last.taken.0 - stretch.began.taken.0 >= self.window {
            let is_far = stretch.distance().is_none_or(|it| it > self.most);
            self.flag = Flag::raised_if(is_far);
            *stretch = Stretch::new(stretch.last);
        }
        self.flag
    }
}

/// An observer of the spread of a localisation.
///
/// *Assumption.* A sound localisation has at most some deviations of position and heading; it works
/// out its covariance of so many independent particles, so that each variance is the true one times
/// a chi-square number of k - 1 degrees of freedom over k - 1.
///
/// *Threshold.* σ² χ²(k - 1) / (k - 1), at the quantile that is exceeded with a third of the chance
/// of a decision, as three variances are looked at.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_observers::{FalseAlarms, Flag, Spread};
/// use nalgebra::Matrix3;
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let spread = Spread::new([0.15, 0.1], 100, Millis(100), promise).unwrap();
/// assert_eq!(spread.observe(Some(&(Matrix3::identity() * 0.01))), Flag::Clear);
/// assert_eq!(spread.observe(Some(&(Matrix3::identity() * 0.04))), Flag::Raised);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    most: [f64; 3],
}

impl Spread {
    /// An observer of deviations of position (m) and heading (rad), worked out of some particles.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        [position, heading]: [f64; 2],
        particles: u32,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the deviation of a position in m", position, 1e-6, 1e3)?;
        within("the deviation of a heading in rad", heading, 1e-6, 10.0)?;
        within("the number of particles", f64::from(particles), 2.0, 1e6)?;
        let degrees = particles - 1;
        let quantile = chi_square_quantile(degrees, promise.shared_by(3).per_decision(period));
        let most = |it: f64| it * it * quantile / f64::from(degrees);
        Ok(Self { most: [most(position), most(position), most(heading)] })
    }

    /// Looks at a covariance. A variance that is below 0 or no number is raised.
    pub fn observe(&self, covariance: Option<&Matrix3<f64>>) -> Flag {
        let Some(covariance) = covariance else { return Flag::Missing };
        let variances = covariance.diagonal();
        let is_good = |(it, most): (&f64, &f64)| (0.0..=*most).contains(it);
        Flag::raised_if(!variances.iter().zip(&self.most).all(is_good))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::{Measured, normal};
    use cotama_devices::{Stream, Streams};

    const ERRORS: OdometryErrors = OdometryErrors::pioneer();
    /// Deviations of the localisation: ahead, aside, heading.
    const NOISE: [f64; 3] = [0.03, 0.01, 0.02];

    /// A robot on arcs, with errors of odometry and of localisation as they are assumed.
    struct Drive {
        real: Isometry2<f64>,
        odometry: Isometry2<f64>,
        now: u64,
        noise: Stream,
        /// Share of the way that odometry does not see.
        lost: f64,
        jump: f64,
    }

    impl Drive {
        fn new(seed: u64) -> Self {
            let noise = Streams::new(seed).stream("drive");
            let pose = Isometry2::new([3.0, -2.0].into(), 2.0);
            let odometry = Isometry2::identity();
            Self { real: pose, odometry, now: 0, noise, lost: 0.0, jump: 0.0 }
        }

        fn step(&mut self) -> Option<Sensed<Poses>> {
            self.now += 100;
            let arc = |way: f64, turn: f64| {
                let half = Isometry2::rotation(turn / 2.0);
                half * Isometry2::translation(way, 0.0) * half
            };
            let turn = 0.05 * libm::sin(self.now as f64 / 7_000.0);
            let way_error = ERRORS.way * libm::sqrt(0.03) * normal(&mut self.noise);
            let turns = ERRORS.drift * ERRORS.drift * 0.03 + ERRORS.turn * ERRORS.turn * turn.abs();
            let turn_error = libm::sqrt(turns) * normal(&mut self.noise);
            self.real *= arc(0.03, turn);
            self.odometry *= arc(0.03 * (1.0 - self.lost) + way_error, turn + turn_error);
            let error = NOISE.map(|it| it * normal(&mut self.noise));
            let located =
                self.real * Isometry2::new([error[0] + self.jump, error[1]].into(), error[2]);
            let mut body = Matrix3::from_diagonal(&Vector3::from(NOISE.map(|it| it * it)));
            let mut rotation = Matrix3::identity();
            rotation
                .fixed_view_mut::<2, 2>(0, 0)
                .copy_from(self.real.rotation.to_rotation_matrix().matrix());
            body = rotation * body * rotation.transpose();
            let value = Poses { odometry: self.odometry, located, covariance: body };
            Some(Sensed { taken: Millis(self.now), value })
        }
    }

    fn measure(window: u64, per_hour: f64, windows: u64, name: &str) {
        let promise = FalseAlarms::per_hour(per_hour).unwrap();
        let mut apart = Apart::new(ERRORS, Millis(window), promise).unwrap();
        let mut measured = Measured::of(promise.per_decision(Millis(window)));
        let mut drive = Drive::new(7);
        apart.observe(drive.step());
        for _ in 0..windows {
            for _ in 1..window / 100 {
                apart.observe(drive.step());
            }
            measured.decision(apart.observe(drive.step()));
        }
        measured.is_as_promised(name);
    }

    #[test]
    fn distances_grow_as_seldom_as_promised() {
        measure(5_000, 14.4, 20_000, "growth"); // 0.02 per window
    }

    #[test]
    fn located_poses_jump_as_seldom_as_promised() {
        measure(100, 360.0, 100_000, "jump");
    }

    #[test]
    fn an_encoder_that_loses_a_tenth_grows_the_distance() {
        let promise = FalseAlarms::per_hour(0.36).unwrap();
        let mut apart = Apart::new(ERRORS, Millis(5_000), promise).unwrap();
        let mut drive = Drive::new(8);
        drive.lost = 0.2;
        let raised = (0..=50).filter(|_| apart.observe(drive.step()) == Flag::Raised).count();
        assert_eq!(raised, 1); // at the end of the window, not before
    }

    #[test]
    fn a_located_pose_that_jumps_is_raised_in_its_period() {
        let promise = FalseAlarms::per_hour(0.36).unwrap();
        let mut jump = Apart::new(ERRORS, Millis(100), promise).unwrap();
        let mut drive = Drive::new(9);
        assert!((0..100).all(|_| jump.observe(drive.step()) == Flag::Clear));
        drive.jump = 0.4;
        assert_eq!(jump.observe(drive.step()), Flag::Raised);
        assert_eq!(jump.observe(drive.step()), Flag::Clear); // it goes on from there
    }

    /// The whole way turns with the heading at its begin: an error of one deviation explains all.
    #[test]
    fn a_heading_that_was_wrong_at_the_begin_is_no_jump() {
        let exact = OdometryErrors { way: 1e-5, drift: 1e-5, turn: 1e-5 };
        let promise = FalseAlarms::per_hour(0.36).unwrap();
        let mut apart = Apart::new(exact, Millis(100), promise).unwrap();
        let poses = |at: [f64; 2], heading, deviation: f64| Poses {
            odometry: Isometry2::new(at.into(), 0.0),
            located: Isometry2::new(at.into(), heading),
            covariance: Matrix3::from_diagonal(&[1e-6, 1e-6, deviation * deviation].into()),
        };
        let read = |taken, value| Some(Sensed { taken: Millis(taken), value });
        apart.observe(read(0, poses([0.0, 0.0], 0.02, 0.02)));
        assert_eq!(apart.observe(read(100, poses([1.0, 1.0], 0.0, 1e-3))), Flag::Clear);
        // With a heading that was sure, it is one.
        apart.observe(read(200, poses([1.0, 1.0], 0.02, 1e-3)));
        assert_eq!(apart.observe(read(300, poses([2.0, 2.0], 0.0, 1e-3))), Flag::Raised);
    }

    #[test]
    fn poses_that_were_seen_make_no_decision() {
        let promise = FalseAlarms::per_hour(0.36).unwrap();
        let mut jump = Apart::new(ERRORS, Millis(100), promise).unwrap();
        let mut drive = Drive::new(9);
        jump.observe(drive.step());
        drive.jump = 1.0;
        let far = drive.step();
        assert_eq!([far, far, far].map(|it| jump.observe(it)), [Flag::Raised; 3]);
        assert_eq!(jump.observe(None), Flag::Missing);
    }

    #[test]
    fn a_covariance_that_is_none_is_raised() {
        let promise = FalseAlarms::per_hour(0.36).unwrap();
        let mut jump = Apart::new(ERRORS, Millis(100), promise).unwrap();
        let mut drive = Drive::new(9);
        jump.observe(drive.step());
        let mut poses = drive.step().unwrap();
        poses.value.covariance = -Matrix3::identity();
        assert_eq!(jump.observe(Some(poses)), Flag::Raised);
        let spread = Spread::new([0.1, 0.1], 100, Millis(100), promise).unwrap();
        assert_eq!(spread.observe(Some(&-Matrix3::identity())), Flag::Raised);
        assert_eq!(spread.observe(Some(&Matrix3::repeat(f64::NAN))), Flag::Raised);
    }

    #[test]
    fn spreads_of_few_particles_alarm_as_seldom_as_promised() {
        let promise = FalseAlarms::per_hour(720.0).unwrap();
        let spread = Spread::new([0.1, 0.05], 20, Millis(100), promise).unwrap();
        let mut measured = Measured::of(promise.per_decision(Millis(100)));
        let mut noise = Streams::new(3).stream("particles");
        for _ in 0..30_000 {
            let mut variance = |deviation: f64| {
                let all: [f64; 20] = std::array::from_fn(|_| deviation * normal(&mut noise));
                let mean = all.iter().sum::<f64>() / 20.0;
                all.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / 19.0
            };
            let all = Vector3::new(variance(0.1), variance(0.1), variance(0.05));
            measured.decision(spread.observe(Some(&Matrix3::from_diagonal(&all))));
        }
        measured.is_as_promised("spread");
    }
}
