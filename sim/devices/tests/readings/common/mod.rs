//! Halls that are drawn, whose coordinates are multiples of 1/64 m around the origin: mirrored and
//! turned by right angles, they are the same numbers but for signs.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use cotama_devices::Disc;
use cotama_floor::{Bounds, Kind, Point, Pose, Segment, Segments};
use nalgebra::{Complex, Translation2, Unit};
use proptest::prelude::*;

pub(crate) const HALF_M: f64 = 8.0;

/// Something that is done to the plane, and is exact.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Motion {
    /// Nothing.
    Stay,
    /// The y axis is turned around.
    Mirror,
    /// All is turned by 90°.
    Turn,
}

impl Motion {
    pub(crate) fn of(self, at: Point) -> Point {
        match self {
            Self::Stay => at,
            Self::Mirror => Point::new(at.x, -at.y),
            Self::Turn => Point::new(-at.y, at.x),
        }
    }

    /// A pose at a point that looks along a direction.
    pub(crate) fn pose(self, at: Point, (cos, sin): (f64, f64)) -> Pose {
        let way = self.of(Point::new(cos, sin));
        let rotation = Unit::new_unchecked(Complex::new(way.x, way.y));
        Pose::from_parts(Translation2::from(self.of(at).coords), rotation)
    }
}

/// A hall: straight pieces, discs, and a robot.
#[derive(Clone, Debug)]
pub(crate) struct Hall {
    pub(crate) segments: Vec<Segment>,
    pub(crate) discs: Vec<Disc>,
    pub(crate) robot: Point,
    pub(crate) heading: f64,
}

impl Hall {
    pub(crate) fn floor(&self, motion: Motion) -> Segments {
        let bounds =
            Bounds { least: Point::new(-HALF_M, -HALF_M), most: Point::new(HALF_M, HALF_M) };
        let moved =
            |it: &Segment| Segment { from: motion.of(it.from), to: motion.of(it.to), ..*it };
        let segments: Vec<_> = self.segments.iter().map(moved).collect();
        Segments::new(bounds, &segments, &[]).unwrap()
    }

    pub(crate) fn discs(&self, motion: Motion) -> Vec<Disc> {
        let moved = |it: &Disc| Disc { centre: motion.of(it.centre), ..*it };
        self.discs.iter().map(moved).collect()
    }

    pub(crate) fn pose(&self, motion: Motion) -> Pose {
        let (sin, cos) = libm::sincos(self.heading);
        motion.pose(self.robot, (cos, sin))
    }
}

fn point(half: i32) -> impl Strategy<Value = Point> {
    let coordinate = -64 * half..=64 * half;
    let metres = |it: i32| f64::from(it) / 64.0;
    (coordinate.clone(), coordinate).prop_map(move |(x, y)| Point::new(metres(x), metres(y)))
}

/// Halls with up to `segments` pieces of these kinds.
pub(crate) fn halls(kinds: &'static [Kind], segments: usize) -> impl Strategy<Value = Hall> {
    let segment = (point(8), point(8), proptest::sample::select(kinds))
        .prop_filter("a length", |it| it.0 != it.1)
        .prop_map(|(from, to, kind)| Segment { from, to, kind });
    let disc = (point(8), 8..64)
        .prop_map(|(centre, radius)| Disc { centre, radius: f64::from(radius) / 64.0 });
    let segments = proptest::collection::vec(segment, 0..segments);
    let discs = proptest::collection::vec(disc, 0..4);
    (segments, discs, point(7), -3.2..3.2).prop_map(|(segments, discs, robot, heading)| Hall {
        segments,
        discs,
        robot,
        heading,
    })
}
