//! Halls with clutter, a robot with exact eyes all around, and its drive.
#![allow(
    dead_code,
    missing_docs,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::cast_precision_loss
)]

use core::f64::consts::{PI, TAU};
use cotama_core::units::Millis;
use cotama_floor::{Bounds, Footprint, Kind, Point, Pose, Ray, Segment, Segments, Sense, Surface};
use cotama_navigation::{Braking, Limits, LocalMap};
use cotama_plane::{Command, Drivetrain, Vehicle};
use proptest::prelude::*;

pub const SIZE: f64 = 10.0;
pub const RADIUS: f64 = 0.25;
pub const PERIOD: Millis = Millis(100);
const RAYS: usize = 720;

/// A hall of 10 m with boxes: x, y, width and height of each.
pub fn hall(boxes: &[[f64; 4]]) -> Segments {
    let bounds = Bounds { least: Point::origin(), most: Point::new(SIZE, SIZE) };
    let corners = |[x, y, w, h]: [f64; 4]| {
        let (right, top) = ((x + w).min(SIZE), (y + h).min(SIZE));
        [[x, y], [right, y], [right, top], [x, top]].map(Point::from)
    };
    let solids: Vec<_> = boxes.iter().map(|it| corners(*it)).collect();
    let solids: Vec<_> = solids.iter().map(|it| (it.as_slice(), Kind::Furniture)).collect();
    let ends = corners([0.0, 0.0, SIZE, SIZE]);
    let wall = |at: usize| Segment { from: ends[at], to: ends[(at + 1) % 4], kind: Kind::Wall };
    Segments::new(bounds, &[0, 1, 2, 3].map(wall), &solids).unwrap()
}

pub fn clutter() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let side = 0.1..1.5;
    let one = (0.0..9.8, 0.0..9.8, side.clone(), side);
    prop::collection::vec(one.prop_map(|(x, y, w, h)| [x, y, w, h]), 0..14)
}

pub fn place() -> impl Strategy<Value = Point> {
    (0.4..9.6, 0.4..9.6).prop_map(|(x, y)| Point::new(x, y))
}

/// A Pioneer 3-DX with a highest speed of its own.
pub fn drivetrain(speed: f64) -> Drivetrain {
    Drivetrain {
        speed,
        acceleration: 0.3,
        turn: 1.745,
        turn_acceleration: 1.745,
        wheel: 0.0975,
        axle: 0.33,
        real: [1.0; 3],
        counts: 76_600.0,
        footprint: Footprint::disc(RADIUS),
        motors: None,
        battery: None,
    }
}

pub fn braking(of: &Drivetrain) -> Braking {
    Braking::new(Limits::of(of), RADIUS, 0.05, 0.1)
}

/// A robot that sees exactly, all around.
pub struct Robot {
    pub drivetrain: Drivetrain,
    pub vehicle: Vehicle,
    pub map: LocalMap,
    pub floor: Segments,
}

impl Robot {
    pub fn new(floor: Segments, speed: f64, at: Point, heading: f64) -> Self {
        let mut it = Self {
            drivetrain: drivetrain(speed),
            vehicle: Vehicle::new(Pose::new(at.coords, heading)),
            map: LocalMap::new(2 * RAYS, Millis(200)),
            floor,
        };
        it.sense(&Pose::identity());
        it
    }

    fn sense(&mut self, motion: &Pose) {
        self.map.advance(motion, PERIOD);
        let pose = self.vehicle.pose();
        let heading = pose.rotation.angle();
        let angle = |at: usize| heading - PI + TAU * at as f64 / RAYS as f64;
        let from = pose.translation.vector.into();
        let rays: Vec<_> = (0..RAYS).map(|at| Ray::at(from, angle(at))).collect();
        let mut ranges = vec![0.0; RAYS];
        self.floor.distances(&rays, 20.0, Sense::Sound, &mut ranges);
        self.map.take_scan(&Pose::identity(), TAU, &ranges);
    }

    /// Drives a period, and returns the motion.
    pub fn go(&mut self, command: Command) -> Pose {
        let before = *self.vehicle.pose();
        self.vehicle.step(&self.drivetrain, &self.floor, command, 0.1);
        let motion = before.inverse() * self.vehicle.pose();
        self.sense(&motion);
        motion
    }

    pub fn at(&self) -> Point {
        self.vehicle.pose().translation.vector.into()
    }

    pub fn has_room(&self) -> bool {
        self.floor.clearance(self.at(), 1.0) > RADIUS + 0.06
    }

    pub fn sees(&self, target: Point) -> Point {
        self.vehicle.pose().inverse() * target
    }
}
