//! Path following by a law on lateral and heading error, with a virtual target.

use crate::braking::Limits;
use crate::work::Work;
use cotama_floor::{Path, Pose};
use cotama_plane::Command;

/// Place of a robot as its target on the path sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Way by which it is ahead of the target along the path's tangent, in metres.
    pub ahead: f64,
    /// Way by which it is to the left, in metres.
    pub aside: f64,
    /// By how much its heading is turned from the tangent, from -π to π.
    pub heading: f64,
}

/// Gains of the law. All are per metre of way, so that they shape a path in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    /// Gain of the target, which runs after the robot: `k1`, in 1/m.
    pub target: f64,
    /// Gain of the heading, `k2`, in 1/m.
    pub heading: f64,
    /// Gain of the lateral error in the turn, `γ`, in 1/m².
    pub aside: f64,
    /// The steepest approach, `θa`, in radians.
    pub approach: f64,
    /// Steepness with which that approach is taken, `kδ`, in 1/m.
    pub steepness: f64,
}

impl Default for Gains {
    /// Gains that bring a robot back within about 2 m of way.
    fn default() -> Self {
        Self { target: 2.0, heading: 3.0, aside: 1.0, approach: 1.2, steepness: 1.5 }
    }
}

/// Speeds of a robot and of its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steer {
    /// Speeds of the robot.
    pub command: Command,
    /// Speed of the target along the path, in m/s.
    pub target: f64,
}

/// The path following law of D. Soetanto, L. Lapierre and A. Pascoal, "Adaptive, non-singular
/// path-following control of dynamic wheeled robots" (IEEE Conference on Decision and Control,
/// 2003), its kinematic part: the approach angle is that of A. Micaelli and C. Samson (INRIA report
/// 2097, 1993), and the target runs freely, so that no start is singular.
///
/// With `s`, `y`, `θ` the errors, `c` the curvature, `v` the speed and `δ = -θa tanh(kδ y)`:
/// target `ṡ = v cos θ + k1 v s`; turn
/// `ω = c ṡ + δ̇ - γ y v (sin θ - sin δ) / (θ - δ) - k2 v (θ - δ)`. Then
/// `V = (s² + y² + (θ - δ)² / γ) / 2` falls: `V̇ = -k1 v s² + v y sin δ - k2 v (θ - δ)² / γ`.
///
/// *Saturation.* The gains are times `v`, so `ω` and `ṡ` are proportional to `v`. Where `ω` is more
/// than the wheels turn, all three are scaled down together: the robot goes the same path more
/// slowly, and `V` falls as before along it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Law {
    /// The gains, all above 0.
    pub gains: Gains,
}

impl Law {
    /// Returns the angle at which the path is approached, `δ`.
    pub fn approach(&self, aside: f64) -> f64 {
        -self.gains.approach * libm::tanh(self.gains.steepness * aside)
    }

    /// Returns `V`, which never grows.
    pub fn lyapunov(&self, it: Errors) -> f64 {
        let off = it.heading - self.approach(it.aside);
        (it.ahead * it.ahead + it.aside * it.aside + off * off / self.gains.aside) / 2.0
    }

    /// Returns the speeds for errors, at a curvature in 1/m and a speed in m/s that is not
    /// exceeded.
    ///
    /// ```
    /// use cotama_navigation::{Errors, Law, Limits};
    /// let wheels = Limits { speed: 0.3, acceleration: 0.3, turn: 0.5, turn_acceleration: 1.7 };
    /// // On the path: straight on. On an arc of 1 m: with it.
    /// let there = Errors { ahead: 0.0, aside: 0.0, heading: 0.0 };
    /// assert_eq!(Law::default().steer(there, 0.0, 0.3, &wheels).command.turn, 0.0);
    /// assert_eq!(Law::default().steer(there, 1.0, 0.3, &wheels).command.turn, 0.3);
    /// // To the left of it: to the right, no faster than the wheels turn, and so more slowly.
    /// let aside = Errors { aside: 1.0, ..there };
    /// let command = Law::default().steer(aside, 0.0, 0.3, &wheels).command;
    /// assert!((command.turn + 0.5).abs() < 1e-12 && command.speed < 0.3);
    /// ```
    pub fn steer(&self, it: Errors, curvature: f64, speed: f64, limits: &Limits) -> Steer {
        let Gains { target, heading, aside, approach, steepness } = self.gains;
        let speed = speed.clamp(0.0, limits.speed);
        let (sin, cos) = libm::sincos(it.heading);
        // Rates for a speed of 1 m/s.
        let runs = cos + target * it.ahead;
        let drifts = sin - curvature * runs * it.ahead;
        let tanh = libm::tanh(steepness * it.aside);
        let wanted = -approach * tanh;
        let wanted_rate = -approach * steepness * (1.0 - tanh * tanh) * drifts;
        let off = it.heading - wanted;
        // The mean of cos between both angles, also where they are the same.
        let half = off / 2.0;
        let sinc = if half.abs() < 1e-6 { 1.0 } else { libm::sin(half) / half };
        let mean = libm::cos(f64::midpoint(it.heading, wanted)) * sinc;
        let bends = curvature * runs + wanted_rate - aside * it.aside * mean - heading * off;
        let speed = speed.min(limits.turn / bends.abs().max(1e-9));
        Steer { command: Command { speed, turn: bends * speed }, target: runs * speed }
    }
}

/// A robot's guidance along a path: the law, and where its target is.
///
/// The path has straight pieces. At a corner the heading of the target jumps, and the robot turns
/// with a bend that the law shapes; it slows down where its wheels cannot turn as fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Guidance {
    law: Law,
    along: f64,
    work: Work,
}

impl Guidance {
    /// A robot whose target is at a length along the path, in metres.
    pub const fn new(law: Law, along: f64) -> Self {
        Self { law, along, work: Work { operations: 0, rays: 0, nodes: 0 } }
    }

    /// Returns the length along the path where the target is, in metres.
    pub const fn along(&self) -> f64 {
        self.along
    }

    /// Returns the errors of a believed pose.
    pub fn errors(&self, path: &Path, pose: &Pose) -> Errors {
        let target = path.pose(self.along);
        let local = target.inverse() * pose;
        let Pose { rotation, translation } = local;
        Errors { ahead: translation.x, aside: translation.y, heading: rotation.angle() }
    }

    /// Returns the speeds of the next period for a believed pose, towards a speed in m/s; it brakes
    /// so as to stand at the end. The target moves on by a period in seconds.
    pub fn command(
        &mut self,
        path: &Path,
        pose: &Pose,
        speed: f64,
        limits: &Limits,
        period_s: f64,
    ) -> Command {
        let left = (path.length() - self.along).max(0.0);
        let brakes = (2.0 * limits.acceleration * left).sqrt();
        let errors = self.errors(path, pose);
        let steer = self.law.steer(errors, 0.0, speed.min(brakes), limits);
        self.along = (self.along + steer.target * period_s).clamp(0.0, path.length());
        self.work.operations += 1;
        steer.command
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}
