//! The filter: particles that move, are weighed and are drawn anew.

use crate::angle::wrap;
use crate::chart::{Chart, Reading};
use crate::estimate::{Estimate, heaviest};
use crate::histogram::{Histogram, needed};
use crate::motion::Motion;
use crate::parameters::{Model, Parameters};
use crate::particles::Particles;
use crate::resampling::Sums;
use cotama_floor::{Point, Pose};
use cotama_streams::{Stream, Streams};
use nalgebra::{Matrix3, Vector3};

/// Reasons why a robot cannot start where it is said to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartError {
    /// The pose is not finite, or further than 1,000 km away.
    Pose,
    /// The covariance is not finite, not symmetric, or has a negative variance in some direction.
    Covariance,
}

impl core::fmt::Display for StartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Pose => "the pose is beyond 1,000 km; use a nearer one",
            Self::Covariance => "this is no covariance; give variances and no correlation",
        })
    }
}

impl core::error::Error for StartError {}

/// The localisation of a robot on a chart.
///
/// ```
/// use cotama_floor::{Pose, Version, embedded};
/// use cotama_localisation::{Chart, Localiser, Parameters, Sensor};
/// use cotama_streams::Streams;
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Charted, &[]).unwrap();
/// let sensor = Sensor::laser(&Pose::identity(), core::f64::consts::PI, 181, 8.0).unwrap();
/// let chart = Chart::new(&surface, 0.1, &sensor, &Parameters::default()).unwrap();
/// let mut localiser = Localiser::new(&chart, &Streams::new(7), "robot 1");
/// assert_eq!(localiser.estimate().particles, 2_000); // anywhere
/// let start = Pose::new([11.0, 10.0].into(), 0.0);
/// localiser.start_at(&start, &nalgebra::Matrix3::from_diagonal_element(0.01)).unwrap();
/// assert!((localiser.estimate().pose.translation.x - 11.0).abs() < 0.01);
/// ```
#[derive(Clone, Debug)]
pub struct Localiser<'c> {
    chart: &'c Chart,
    now: Particles,
    /// Particles that are drawn, before they take the place of the others.
    next: Particles,
    histogram: Histogram,
    sums: Sums,
    reading: Reading,
    likelihoods: Vec<f32>,
    /// Numbers of the particles that are drawn.
    drawn: Vec<u32>,
    motion: Stream,
    chance: Stream,
    /// The most particles that are drawn; never less than `min_particles`.
    most: usize,
    /// The odometry of the last update.
    odometry: Option<Pose>,
    /// Updates since particles were drawn anew.
    updates: usize,
    estimate: Estimate,
}

impl<'c> Localiser<'c> {
    /// A robot of a name, after which its random numbers are named. It starts at the initial pose
    /// of the parameters, and where there is none, it may be anywhere.
    pub fn new(chart: &'c Chart, streams: &Streams, name: &str) -> Self {
        let most = chart.parameters().max_particles;
        let mut it = Self {
            chart,
            now: Particles::with_capacity(most),
            next: Particles::with_capacity(most),
            // Those that are, and as many that are drawn anywhere.
            histogram: Histogram::with_capacity(2 * most),
            sums: Sums::with_capacity(most),
            reading: chart.reading(),
            likelihoods: Vec::with_capacity(most),
            drawn: Vec::with_capacity(most),
            motion: streams.stream(&format!("{name} motion")),
            chance: streams.stream(&format!("{name} chance")),
            most,
            odometry: None,
            updates: 0,
            estimate: Estimate {
                pose: Pose::identity(),
                covariance: Matrix3::zeros(),
                weight: 0.0,
                clusters: 0,
                particles: 0,
                effective: 0.0,
                likelihood: 0.0,
                likelihood_short: 0.0,
                likelihood_long: 0.0,
            },
        };
        match chart.parameters().initial_pose {
            Some(pose) => it.scatter(&pose, &Matrix3::zeros()),
            None => it.start_anywhere(),
        }
        it
    }

    /// Draws at most so many particles from now on, within those of the parameters.
    pub fn allow(&mut self, most: usize) {
        let of = self.chart.parameters();
        self.most = most.clamp(of.min_particles, of.max_particles);
    }

    /// Starts where the robot is said to be, with the covariance of x and y in metres and the
    /// heading in radians.
    ///
    /// # Errors
    /// A pose or a covariance that makes no sense; nothing is changed then.
    pub fn start_at(&mut self, pose: &Pose, covariance: &Matrix3<f64>) -> Result<(), StartError> {
        if !is_near(pose) {
            return Err(StartError::Pose);
        }
        let factor = factor(covariance).ok_or(StartError::Covariance)?;
        self.scatter(pose, &factor);
        Ok(())
    }

    /// Starts anywhere: the most particles, evenly over the free cells and all headings.
    pub fn start_anywhere(&mut self) {
        self.now.clear();
        for _ in 0..self.chart.parameters().max_particles {
            self.now.push(self.chart.anywhere(&mut self.chance));
        }
        self.begin();
    }

    /// Draws the most particles around a pose, by a factor of the covariance.
    fn scatter(&mut self, pose: &Pose, factor: &Matrix3<f64>) {
        let mean = Vector3::new(pose.translation.x, pose.translation.y, pose.rotation.angle());
        let Point { coords: origin } = self.chart.origin();
        self.now.clear();
        for _ in 0..self.chart.parameters().max_particles {
            let errors = Vector3::from_fn(|_, _| self.chance.error());
            let it = mean + factor * errors;
            let at = [it.x - origin.x, it.y - origin.y, wrap(it.z)];
            self.now.push(at.map(|it| it as f32));
        }
        self.begin();
    }

    fn begin(&mut self) {
        self.now.settle();
        self.odometry = None;
        self.updates = 0;
        self.estimate.likelihood = 0.0;
        self.estimate.likelihood_short = 0.0;
        self.estimate.likelihood_long = 0.0;
        self.summarise();
    }

    /// Returns the chart.
    pub fn chart(&self) -> &'c Chart {
        self.chart
    }

    /// Returns the estimate of the last update, or of the start.
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// Returns where the robot is at a later pose of the odometry: that of the last update, and
    /// what it has gone since.
    pub fn pose_at(&self, odometry: &Pose) -> Pose {
        let before = self.odometry.unwrap_or(*odometry);
        self.estimate.pose * (before.inverse() * odometry)
    }

    /// Returns all particles with their weights.
    pub fn particles(&self) -> impl Iterator<Item = (Pose, f64)> + '_ {
        let Particles { x, y, heading, weight, .. } = &self.now;
        let origin = self.chart.origin().coords;
        x.iter().zip(y).zip(heading).zip(weight).map(move |(((x, y), heading), weight)| {
            let at = nalgebra::Vector2::new(f64::from(*x), f64::from(*y)) + origin;
            (Pose::new(at, f64::from(*heading)), *weight)
        })
    }

    /// Takes a reading: the pose that the odometry tells, and a range for each beam of the sensor
    /// in metres; one at its range or beyond is of a beam that saw nothing, and one that is not a
    /// number says nothing.
    ///
    /// Returns whether the filter was updated: at the first reading, and when the robot has moved
    /// as far as the parameters say. Odometry beyond 1,000 km is no reading.
    pub fn update(&mut self, odometry: &Pose, ranges: &[f64]) -> bool {
        let parameters = self.chart.parameters();
        if !is_near(odometry) {
            return false;
        }
        if let Some(before) = &self.odometry {
            if !has_moved(before, odometry, parameters) {
                return false;
            }
            let motion = Motion::between(before, odometry, parameters);
            motion.apply(&mut self.now, &mut self.motion);
        }
        self.odometry = Some(*odometry);
        self.weigh(ranges);
        self.summarise();
        self.updates += 1;
        if self.updates >= parameters.resample_interval {
            self.updates = 0;
            self.draw();
        }
        true
    }

    /// Weighs all particles by a reading, unless it says nothing.
    fn weigh(&mut self, ranges: &[f64]) {
        let beams = self.chart.look(ranges, &mut self.reading);
        if beams == 0 {
            return;
        }
        let parameters = self.chart.parameters();
        let likelihoods = &mut self.likelihoods;
        likelihoods.resize(self.now.len(), 0.0);
        self.chart.weigh(&self.reading, &self.now, likelihoods);
        let mut mean = 0.0;
        if parameters.laser_model_type == Model::LikelihoodFieldProb {
            let most = likelihoods.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            for (weight, it) in self.now.weight.iter_mut().zip(likelihoods) {
                mean += *weight * libm::exp(f64::from(*it) / beams as f64);
                *weight *= f64::from(libm::expf(*it - most));
            }
        } else {
            for (weight, it) in self.now.weight.iter_mut().zip(likelihoods) {
                *weight *= f64::from(*it);
                mean += *weight;
            }
        }
        self.now.normalise();
        let Estimate { likelihood, likelihood_short, likelihood_long, .. } = &mut self.estimate;
        *likelihood = mean;
        let Parameters { recovery_alpha_fast, recovery_alpha_slow, .. } = *parameters;
        for (kept, rate) in
            [(likelihood_short, recovery_alpha_fast), (likelihood_long, recovery_alpha_slow)]
        {
            let is_first = *kept == 0.0 && rate > 0.0;
            *kept = if is_first { mean } else { *kept + rate * (mean - *kept) };
        }
    }

    /// Puts particles in bins, and estimates.
    fn summarise(&mut self) {
        self.histogram.fill(&self.now);
        let origin = self.chart.origin();
        let (pose, covariance, weight, clusters) = heaviest(&self.now, &mut self.histogram, origin);
        let it = &mut self.estimate;
        (it.pose, it.covariance, it.weight, it.clusters) = (pose, covariance, weight, clusters);
        it.effective = self.now.effective();
        it.particles = self.now.len();
    }

    /// The part of the particles that are drawn anywhere, 1 - short / long (Thrun, Burgard, Fox,
    /// Probabilistic Robotics, 2005, table 8.3).
    fn stray(&self) -> f64 {
        let Estimate { likelihood_short, likelihood_long, .. } = self.estimate;
        if likelihood_long > 0.0 {
            (1.0 - likelihood_short / likelihood_long).max(0.0)
        } else {
            0.0
        }
    }

    /// Draws particles anew: their number by KLD-sampling, which ones with low variance.
    fn draw(&mut self) {
        debug_assert!((self.now.weight.iter().sum::<f64>() - 1.0).abs() < 1e-9, "weights sum to 1");
        let Parameters { min_particles, pf_err, pf_z, .. } = *self.chart.parameters();
        let max_particles = self.most;
        let stray = self.stray();
        self.sums.fill(&self.now.weight);
        self.next.clear();
        // As in the paper one is drawn after the other until they are enough, which finds their
        // number; those that stay are drawn at once, when that number is known. It is known before
        // where all bins together need no more than the least.
        let (mut count, mut bins, mut enough) = (0, 0, min_particles as f64);
        let all = needed(self.histogram.bins(), pf_err, pf_z);
        if stray == 0.0 && (all <= enough || min_particles == max_particles) {
            count = min_particles;
        } else {
            self.sums.guide();
        }
        while count < max_particles && (count as f64) < enough {
            count += 1;
            let is_new = if stray > 0.0 && self.chance.part() < stray {
                let pose = self.chart.anywhere(&mut self.chance);
                self.next.push(pose);
                self.histogram.draw_at(pose)
            } else {
                let part = self.chance.part();
                self.histogram.draw(self.sums.find(part))
            };
            if is_new {
                bins += 1;
                enough = needed(bins, pf_err, pf_z).max(min_particles as f64);
            }
        }
        // Those anywhere are there already.
        let kept = count - self.next.added();
        self.drawn.clear();
        let drawn = &mut self.drawn;
        self.sums.draw(kept, self.chance.part(), |at| drawn.push(at as u32));
        self.next.gather(&self.now, &self.drawn);
        self.next.settle();
        core::mem::swap(&mut self.now, &mut self.next);
        self.estimate.particles = count;
        debug_assert!((min_particles..=max_particles).contains(&self.now.len()));
    }
}

/// Whether a pose is finite and within 1,000 km.
fn is_near(pose: &Pose) -> bool {
    let mut at = pose.translation.vector.iter();
    at.all(|it| (-1e6..=1e6).contains(it)) && pose.rotation.angle().is_finite()
}

/// Whether the odometry has moved far enough for an update; as in Nav2 along one of its axes.
fn has_moved(before: &Pose, now: &Pose, parameters: &Parameters) -> bool {
    let way = now.translation.vector - before.translation.vector;
    let turn = wrap(now.rotation.angle() - before.rotation.angle());
    way.x.abs() > parameters.update_min_d
        || way.y.abs() > parameters.update_min_d
        || turn.abs() > parameters.update_min_a
}

/// Returns a lower factor of a covariance, which may have directions without variance.
fn factor(of: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let scale = of.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    let slack = 1e-9 * scale;
    if !scale.is_finite() || of.iter().any(|it| !it.is_finite()) {
        return None;
    }
    if (of - of.transpose()).iter().any(|it| it.abs() > slack) {
        return None;
    }
    let mut lower = Matrix3::zeros();
    for column in 0..3 {
        for row in column..3 {
            let done = (0..column).map(|it| lower[(row, it)] * lower[(column, it)]).sum::<f64>();
            let left: f64 = of[(row, column)] - done;
            if row == column {
                if left < -slack {
                    return None;
                }
                lower[(row, column)] = left.max(0.0).sqrt();
            } else if lower[(column, column)] * lower[(column, column)] > slack {
                lower[(row, column)] = left / lower[(column, column)];
            } else if left * left > slack * scale.max(1.0) {
                return None;
            }
        }
    }
    Some(lower)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sensor;
    use cotama_floor::{Version, embedded};

    #[test]
    fn updates_take_no_memory() {
        let surface = embedded::OFFICE.floor().unwrap();
        let surface = surface.surface(Version::Charted, &[]).unwrap();
        let mounts = [Pose::identity(), Pose::rotation(1.0), Pose::rotation(2.0)];
        let sensor = Sensor::sonars(&mounts, 0.5, 3, 5.0).unwrap();
        let parameters = Parameters {
            recovery_alpha_slow: 0.01,
            recovery_alpha_fast: 0.9,
            pf_err: 0.02,
            ..Parameters::default()
        };
        let chart = Chart::new(&surface, 0.2, &sensor, &parameters).unwrap();
        let mut it = Localiser::new(&chart, &Streams::new(1), "robot");
        let room = |it: &Localiser<'_>| {
            let particles = [&it.now, &it.next].map(|it| it.capacity()).concat();
            let others = [it.likelihoods.capacity(), it.drawn.capacity(), it.reading.capacity()];
            [particles, others.to_vec(), it.histogram.capacity(), it.sums.capacity()].concat()
        };
        let before = room(&it);
        for step in 0..50 {
            let ranges = [1.0 + f64::from(step % 7), 2.0, 5.0 - f64::from(step % 3)];
            assert!(it.update(&Pose::translation(f64::from(step), 0.0), &ranges));
        }
        assert_eq!(room(&it), before);
    }
}
