//! Robots and doors around a person.

use super::Habits;
use crate::scene::Disc;
use cotama_floor::{Point, Vector};

/// Room between a robot and a person who squeezes past it, in metres.
const SQUEEZE: f64 = 0.05;

/// The robots and the leaves of doors that people meet.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub(super) robots: &'a [Disc],
    pub(super) leaves: &'a [[Point; 2]],
}

impl Around<'_> {
    /// Whether a step leads a person through a leaf, or nearer to one that is too near.
    pub(super) fn bars(&self, here: Disc, to: Point) -> bool {
        self.leaves.iter().any(|leaf| {
            let far = distance(*leaf, to);
            crosses(*leaf, [here.centre, to])
                || (far < here.radius && far < distance(*leaf, here.centre))
        })
    }
}

/// Returns the point beside a robot that is nearest to one which is too close to it.
pub(super) fn beside(robot: &Disc, to: Point, radius_m: f64) -> Point {
    let (away, least) = (to - robot.centre, robot.radius + radius_m + SQUEEZE);
    let distance = away.norm();
    if distance >= least {
        return to;
    }
    if distance > 0.0 {
        robot.centre + away * (least / distance)
    } else {
        robot.centre + Vector::new(least, 0.0)
    }
}

/// Whether a step ends closer to a robot than the gap, and does not lead away from it.
pub(super) fn is_hindered(here: Disc, to: Point, habits: &Habits, robots: &[Disc]) -> bool {
    let there = Disc { centre: to, ..here };
    robots.iter().any(|it| it.gap(&there) < habits.gap_m && it.gap(&there) <= it.gap(&here))
}

/// Returns the distance of a point from a leaf.
fn distance([from, to]: [Point; 2], at: Point) -> f64 {
    let way = to - from;
    let part = ((at - from).dot(&way) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (from + way * part - at).norm()
}

/// Whether a step leads from one side of a leaf to the other, through it.
fn crosses(leaf: [Point; 2], step: [Point; 2]) -> bool {
    let parts = |[a, b]: [Point; 2], ends: [Point; 2]| {
        let [one, two] = ends.map(|it| (b - a).perp(&(it - a)));
        one * two < 0.0
    };
    parts(leaf, step) && parts(step, leaf)
}
