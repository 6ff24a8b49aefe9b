//! The vector field histogram, VFH+.

use crate::braking::Braking;
use crate::local_map::LocalMap;
use crate::window::Choice;
use crate::work::Work;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use cotama_floor::Point;
use cotama_plane::Command;

/// Number of sectors around the robot, of 5° each.
pub const SECTORS: usize = 72;
/// Openings of more sectors are wide.
const WIDE: usize = 16;
/// Room beyond radius and margin by which points are enlarged, in metres.
const SPARE_M: f64 = 0.05;
/// Gain of the turn on the angle to the chosen way, in 1/s.
const GAIN: f64 = 1.5;

/// Numbers of VFH+.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Points further away count nothing, in metres.
    pub range_m: f64,
    /// A sector with less becomes free.
    pub low: f64,
    /// A sector with more becomes blocked.
    pub high: f64,
    /// Weights of a way: its angle to the target, to the heading, and to the way chosen before. The
    /// first is more than both others together, so that the target is sought.
    pub weights: [f64; 3],
}

impl Default for Thresholds {
    /// Weights of 5, 2 and 2 as Ulrich and Borenstein propose for goal oriented robots. The
    /// thresholds are assumed: a fresh point blocks its sectors within three quarters of 2 m.
    fn default() -> Self {
        Self { range_m: 2.0, low: 0.15, high: 0.25, weights: [5.0, 2.0, 2.0] }
    }
}

/// VFH+ (I. Ulrich, J. Borenstein, "VFH+: reliable obstacle avoidance for fast mobile robots", IEEE
/// International Conference on Robotics and Automation, 1998): a polar histogram of enlarged
/// points, made binary with hysteresis; of its openings, the way of least cost.
///
/// Left out: the mask of turning circles, as the robot turns on the spot. A sector keeps the
/// largest magnitude of its points, not the sum of cells, as a local map holds points, of which a
/// near thing gives many. Added: speeds come from [`Braking`]. The robot goes ahead only if it can
/// stop; else it turns on the spot, and stands when no sector is free.
#[derive(Clone, Debug)]
pub struct Histogram {
    braking: Braking,
    thresholds: Thresholds,
    magnitudes: [f64; SECTORS],
    is_blocked: [bool; SECTORS],
    /// The way that was chosen before, in the robot's frame of that period.
    before: f64,
    work: Work,
}

impl Histogram {
    /// An avoidance without history.
    pub fn new(braking: Braking, thresholds: Thresholds) -> Self {
        Self {
            braking,
            thresholds,
            magnitudes: [0.0; SECTORS],
            is_blocked: [false; SECTORS],
            before: 0.0,
            work: Work::default(),
        }
    }

    /// Chooses the speeds of the next period, for a target in the robot's frame and a speed in m/s
    /// that it shall not exceed.
    pub fn choose(&mut self, map: &LocalMap, now: Command, target: Point, speed: f64) -> Choice {
        self.fill(map, target.coords.norm());
        let Some(way) = self.way(libm::atan2(target.y, target.x)) else { return Choice::Stand };
        let limits = self.braking.limits;
        let turn = (GAIN * way).clamp(-limits.turn, limits.turn);
        self.before = wrapped(way - turn * self.braking.period_s);
        let ahead = speed.clamp(0.0, limits.speed) * libm::cos(way).max(0.0);
        let ahead = if way.abs() >= FRAC_PI_2 / 2.0 { 0.0 } else { ahead };
        self.braking.look(now, map, &mut self.work);
        for part in [1.0, 0.5, 0.25, 0.0] {
            let told = Command { speed: ahead * part, turn };
            if self.braking.room(now, told, &mut self.work).is_some() {
                let stands = told.speed == 0.0 && told.turn.abs() < 1e-3;
                return if stands { Choice::Stand } else { Choice::Go(told) };
            }
        }
        Choice::Stand
    }

    /// Makes the histogram. Things beyond the target do not count.
    fn fill(&mut self, map: &LocalMap, target_m: f64) {
        self.magnitudes = [0.0; SECTORS];
        let size = self.braking.radius_m + self.braking.margin_m + SPARE_M;
        let range = self.thresholds.range_m.min(target_m + size);
        for point in map.points() {
            let distance = point.at.coords.norm();
            self.work.operations += 1;
            if distance > range {
                continue;
            }
            // Certainty squared times a - b d², with 1 at the robot and 0 at the range.
            let certainty = map.weight(point);
            let nearness = 1.0 - (distance / self.thresholds.range_m).min(1.0);
            let magnitude = certainty * certainty * nearness;
            let half = if distance > size { libm::asin(size / distance) } else { FRAC_PI_2 };
            let middle = libm::atan2(point.at.y, point.at.x);
            let (first, last) = (number(middle - half), number(middle + half));
            let count = (last + SECTORS - first) % SECTORS + 1;
            let all = self.magnitudes.iter_mut();
            for (at, it) in all.enumerate() {
                if (at + SECTORS - first) % SECTORS < count {
                    *it = it.max(magnitude);
                }
            }
        }
        for (blocked, magnitude) in self.is_blocked.iter_mut().zip(&self.magnitudes) {
            *blocked = *magnitude > self.thresholds.high
                || (*blocked && *magnitude >= self.thresholds.low);
        }
    }

    /// Returns the way of least cost: the middle of a narrow opening; of a wide one, its sides and,
    /// if it lies within, the target.
    fn way(&mut self, target: f64) -> Option<f64> {
        let blocked = |at: usize| self.is_blocked.get(at % SECTORS).copied().unwrap_or(false);
        let mut best: Option<(f64, f64)> = None;
        let mut tried = 0;
        let [to_target, to_heading, to_before] = self.thresholds.weights;
        let mut offer = |way: f64| {
            let off = |other: f64| wrapped(way - other).abs();
            let cost =
                to_target * off(target) + to_heading * off(0.0) + to_before * off(self.before);
            tried += 1;
            if best.is_none_or(|it| cost < it.0 - 1e-9) {
                best = Some((cost, wrapped(way)));
            }
        };
        match (0..SECTORS).find(|it| blocked(*it)) {
            None => offer(target),
            Some(from) => {
                let mut open = 0;
                for at in from + 1..=from + SECTORS {
                    if !blocked(at) {
                        open += 1;
                        continue;
                    }
                    let (first, last) = (angle(at - open), angle(at + SECTORS - 1));
                    if open > WIDE {
                        let side = TAU * (WIDE / 2) as f64 / SECTORS as f64;
                        offer(first + side);
                        offer(last - side);
                        let inside = (target - first - side).rem_euclid(TAU);
                        if inside <= TAU * (open - WIDE) as f64 / SECTORS as f64 {
                            offer(target);
                        }
                    } else if open > 0 {
                        offer(angle(at - open) + TAU * (open - 1) as f64 / 2.0 / SECTORS as f64);
                    }
                    open = 0;
                }
            }
        }
        self.work.nodes += tried;
        best.map(|it| it.1)
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}

/// Returns the number of the sector of an angle.
fn number(angle: f64) -> usize {
    let part = angle.rem_euclid(TAU) / TAU * SECTORS as f64;
    (part as usize).min(SECTORS - 1)
}

/// Returns the middle of a sector.
fn angle(sector: usize) -> f64 {
    (sector as f64 + 0.5) / SECTORS as f64 * TAU
}

/// Returns the same angle between -π and π.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}
