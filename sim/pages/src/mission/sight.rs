//! Rays of the robot's lasers, or of its sonars where it has none, up to the floor as it is: as far
//! as it could see from where it was, not what its devices read.

use super::view::View;
use crate::svg::fixed;
use cotama_floor::picture::Pixels;
use cotama_floor::{Held, Point, Ray, Sense, metres};
use std::f64::consts::PI;

/// Rays that are drawn of a laser.
const OF_LASER: u16 = 19;

/// The headings of a Pioneer's ring in degrees, and its range in metres.
const RING_DEG: [i32; 16] =
    [90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90];
const RING_M: f64 = 5.0;

/// A ray of the robot.
struct Look {
    from_m: [f64; 2],
    heading: f64,
    range_m: f64,
}

/// Rays of a robot on its floor.
pub(super) struct Sight {
    floor: Held,
    sense: Sense,
    looks: Vec<Look>,
}

fn radians(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

impl Sight {
    /// Returns the rays of a mission's robot; `None` where no floor or no device is known.
    pub(super) fn of(view: &View<'_>) -> Option<Self> {
        let body = view.mission.as_ref().ok()?.robot()?.robot().body.as_ref()?;
        let [floor, _] = Held::of(view.way.as_ref()?).ok()?;
        let metres_of = |it: i32| f64::from(it) / 1_000.0;
        let mut looks = Vec::new();
        for laser in &body.sensing.lasers {
            let from_m = [metres_of(laser.mount.x_mm), metres_of(laser.mount.y_mm)];
            let view_deg = f64::from(laser.view_deg);
            for ray in 0..OF_LASER {
                let part = f64::from(ray) / f64::from(OF_LASER - 1) - 0.5;
                let heading = radians(f64::from(laser.mount.heading_deg) + view_deg * part);
                looks.push(Look { from_m, heading, range_m: laser.range[1].0 as f64 / 1_000.0 });
            }
        }
        let sense = if looks.is_empty() { Sense::Sound } else { Sense::Light };
        if looks.is_empty() && !body.sensing.no_sonars {
            let ring = RING_DEG.map(|it| Look {
                from_m: [0.0; 2],
                heading: radians(f64::from(it)),
                range_m: RING_M,
            });
            looks.extend(ring);
        }
        (!looks.is_empty()).then_some(Self { floor, sense, looks })
    }

    /// Returns the ends of all rays at a pose as a list of JSON, in pixels.
    pub(super) fn ends(&self, at_mm: [i32; 2], heading_mrad: i32, pixels: &Pixels) -> String {
        let (at, heading) = (metres(at_mm), f64::from(heading_mrad) / 1_000.0);
        let (sin, cos) = libm::sincos(heading);
        let ends = self.looks.iter().flat_map(|it| {
            let [x, y] = it.from_m;
            let from = Point::new(at.x + x * cos - y * sin, at.y + x * sin + y * cos);
            let angle = heading + it.heading;
            let hit = self.floor.surface().hit(&Ray::at(from, angle), it.range_m, self.sense);
            let length = hit.map_or(it.range_m, |it| it.distance);
            let (sin, cos) = libm::sincos(angle);
            pixels.at(Point::new(from.x + length * cos, from.y + length * sin)).map(fixed)
        });
        format!("[{}]", ends.collect::<Vec<_>>().join(","))
    }
}
