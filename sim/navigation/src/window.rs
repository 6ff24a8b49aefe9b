//! The dynamic window.

use crate::braking::Braking;
use crate::local_map::LocalMap;
use crate::work::Work;
use core::f64::consts::{PI, TAU};
use cotama_floor::Point;
use cotama_plane::Command;

/// A robot's next speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// Go on with these speeds; from them it can stop.
    Go(Command),
    /// Stand: no other motion is admissible, or none is better than to stand.
    Stand,
}

impl Choice {
    /// Returns the speeds to tell the wheels.
    pub fn command(self) -> Command {
        if let Self::Go(it) = self { it } else { Command::default() }
    }
}

/// Clear way that is as good as any longer one, in metres.
pub const CLEAR_M: f64 = 2.0;

/// Weights of the objective; the sum is what a motion is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Weight of the heading towards the target, where the robot would stand.
    pub heading: f64,
    /// Weight of the way that is clear on the arc of the motion, up to [`CLEAR_M`].
    pub clear: f64,
    /// Weight of the speed ahead.
    pub speed: f64,
}

impl Default for Weights {
    /// Assumed: heading and clear way alike, the speed less.
    fn default() -> Self {
        Self { heading: 1.0, clear: 1.0, speed: 0.3 }
    }
}

/// The dynamic window approach (D. Fox, W. Burgard, S. Thrun, IEEE Robotics & Automation Magazine
/// 4(1), 1997): of the speeds that the wheels reach within a period and from which the robot can
/// stop, the one with the best sum of heading, clear way on its arc, and speed.
///
/// In a dead end it stands, or turns where it is; it never says that it gives up. The caller bounds
/// how long it may.
#[derive(Clone, Debug)]
pub struct DynamicWindow {
    braking: Braking,
    weights: Weights,
    /// Speeds and turns that are tried.
    steps: [u32; 2],
    /// Points within the way that is looked ahead.
    seen: Vec<Point>,
    work: Work,
}

impl DynamicWindow {
    /// A window with so many steps from its middle to each side, 1 to 20.
    pub fn new(braking: Braking, weights: Weights, steps: u32) -> Self {
        let steps = steps.clamp(1, 20);
        let seen = Vec::with_capacity(crate::local_map::MAX_POINTS);
        Self { braking, weights, steps: [steps, steps], seen, work: Work::default() }
    }

    /// Returns the braking law.
    pub const fn braking(&self) -> &Braking {
        &self.braking
    }

    /// Chooses the speeds of the next period, for a target in the robot's frame and a speed in m/s
    /// that it shall not exceed.
    pub fn choose(&mut self, map: &LocalMap, now: Command, target: Point, speed: f64) -> Choice {
        let limits = self.braking.limits;
        let speed = speed.clamp(0.0, limits.speed);
        self.braking.look(now, map, &mut self.work);
        let view = CLEAR_M + self.size();
        self.seen.clear();
        self.seen.extend(map.points().map(|it| it.at).filter(|it| it.coords.norm() <= view));
        let reach = [
            limits.acceleration * self.braking.period_s,
            limits.turn_acceleration * self.braking.period_s,
        ];
        let part = |at: u32, of: u32| at as f64 / of as f64 - 1.0;
        let mut best: Option<(f64, Command)> = None;
        // To stand comes first: of motions that are worth the same, the first is taken.
        let stand = core::iter::once(Command::default());
        let [ahead, aside] = self.steps;
        let tried = (0..=2 * ahead).flat_map(|v| (0..=2 * aside).map(move |w| (v, w)));
        let tried = tried.map(|(v, w)| Command {
            speed: (now.speed + part(v, ahead) * reach[0]).clamp(0.0, speed),
            turn: (now.turn + part(w, aside) * reach[1]).clamp(-limits.turn, limits.turn),
        });
        for told in stand.chain(tried) {
            if self.braking.room(now, told, &mut self.work).is_none() {
                continue;
            }
            let clear = self.clear(told);
            let there = self.braking.stands_at(now, told).inverse() * target;
            let off = libm::atan2(there.y, there.x).abs();
            let Weights { heading, clear: open, speed: fast } = self.weights;
            let speed = told.speed / limits.speed.max(1e-9);
            let worth = heading * (1.0 - off / PI) + open * clear / CLEAR_M + fast * speed;
            if best.is_none_or(|it| worth > it.0 + 1e-9) {
                best = Some((worth, told));
            }
        }
        match best {
            Some((_, told)) if told != Command::default() => Choice::Go(told),
            _ => Choice::Stand,
        }
    }

    /// Returns the radius that is kept free.
    fn size(&self) -> f64 {
        self.braking.radius_m + self.braking.margin_m
    }

    /// Returns how far the robot goes on the arc of speeds before it comes too near to a point, up
    /// to [`CLEAR_M`]: `dist(v, ω)` there.
    ///
    /// With `R` the radius of the arc, `d` the distance of a point from its centre and `r` the room
    /// that is needed, it is met before the point's own angle by `acos((R² + d² - r²) / 2Rd)`.
    fn clear(&mut self, told: Command) -> f64 {
        if told.speed <= 0.0 {
            return CLEAR_M;
        }
        let (size, bend) = (self.size(), told.turn / told.speed);
        self.work.operations += self.seen.len() as u64;
        let way = |at: &Point| {
            // Turned so that the arc bends to the left.
            let (x, y) = (at.x, if bend < 0.0 { -at.y } else { at.y });
            if bend.abs() < 1e-3 {
                let before =
                    if y.abs() < size { (size * size - y * y).sqrt() } else { return CLEAR_M };
                return if x > 0.0 { (x - before).max(0.0) } else { CLEAR_M };
            }
            let radius = bend.abs().recip();
            let from = Point::new(x, y - radius);
            let distance = from.coords.norm();
            if (distance - radius).abs() >= size || distance + radius <= size {
                return CLEAR_M;
            }
            let cos = (radius * radius + distance * distance - size * size)
                / (2.0 * radius * distance).max(1e-9);
            let angle = libm::atan2(from.x, -from.y).rem_euclid(TAU);
            let met = angle - libm::acos(cos.clamp(-1.0, 1.0));
            radius * met.max(0.0)
        };
        self.seen.iter().map(way).fold(CLEAR_M, f64::min)
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}
