//! Speeds that avoidance allows, driven in the plane: an obstacle is seen as late as possible.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_axes::{Case, Lifted, PATROL, Steps, Table};
use cotama_floor::{Bounds, Footprint, Kind, Point, Pose, Segment, Segments};
use cotama_models::robots::Robot;
use cotama_plane::{Command, Drivetrain, Vehicle};
use cotama_streams::{Stream, Streams};
use std::sync::LazyLock;

static PIONEER: LazyLock<Drivetrain> = LazyLock::new(|| {
    let robot = Robot::shipped("p3dx-patrol").unwrap();
    Drivetrain::of(robot.body.as_ref().unwrap())
});

/// A corridor and a robot in it, in mm, mm/s² and ms.
struct Corridor {
    width: u64,
    clearance: u64,
    radius: u64,
    braking: u64,
    detect: u64,
    cycle: u64,
    range: u64,
    mass_g: u64,
}

impl Corridor {
    fn drawn(stream: &mut Stream) -> Self {
        let mut from = |least: u64, most: u64| least + stream.below(most - least + 1);
        Self {
            width: from(1_200, 4_000),
            clearance: from(50, 300),
            radius: from(150, 300),
            braking: from(200, 1_500),
            detect: from(20, 600),
            cycle: from(20, 200),
            range: from(600, 4_000),
            mass_g: from(5_000, 40_000),
        }
    }

    /// The speed that the patrol's constraints derive for it, and whether avoidance bounds it;
    /// `None` where no speed is left.
    fn speed(&self) -> Option<(u64, bool)> {
        let mut text = PATROL.to_owned();
        let mut set = |from: &str, to: String| {
            assert!(text.contains(from), "{from}");
            text = text.replacen(from, &to, 1);
        };
        set("mass_g = 25000", format!("mass_g = {}", self.mass_g));
        set("braking_mm_s2 = 300", format!("braking_mm_s2 = {}", self.braking));
        set("body_radius_mm = 250", format!("body_radius_mm = {}", self.radius));
        set("wall_clearance_mm = 235", format!("wall_clearance_mm = {}", self.clearance));
        set("cycle_ms = 100", format!("cycle_ms = {}", self.cycle));
        set("detect_ms = 420", "detect_ms = 9999".into());
        set("detect_ms = 100", format!("detect_ms = {}", self.detect));
        set("range_mm = 4000", format!("range_mm = {}", self.range));
        set("width_mm = 1700", format!("width_mm = {}", self.width));
        let mut case = Case::parse(&text).unwrap();
        case.mission.objectives.truncate(1);
        let avoidance = case.mission.constraint("avoidance").unwrap();
        let table = Table::new(&case.mission, Lifted::default(), &mut Steps::default()).unwrap();
        let first = table.activities[0].candidates.iter().max_by_key(|it| it.speed_mm_s)?;
        let speed = u64::try_from(first.speed_mm_s).unwrap();
        Some((speed, first.bounded_by == [avoidance]))
    }

    /// Whether a robot at this speed touches something that comes into its radius of avoidance.
    fn touches(&self, speed_mm_s: u64) -> bool {
        let m = |it: u64| it as f64 / 1_000.0;
        let ahead = m((self.width / 2 - self.clearance).min(self.range));
        let line = |from: [f64; 2], to: [f64; 2]| Segment {
            from: from.into(),
            to: to.into(),
            kind: Kind::Wall,
        };
        let side = m(self.width) / 2.0;
        let walls = [
            line([-2.0, side], [8.0, side]),
            line([-2.0, -side], [8.0, -side]),
            line([ahead, -side], [ahead, side]),
        ];
        let bounds = Bounds { least: Point::new(-10.0, -10.0), most: Point::new(10.0, 10.0) };
        let floor = Segments::new(bounds, &walls, &[]).unwrap();
        let known = PIONEER.clone();
        let footprint = Footprint::disc(m(self.radius));
        let at_once =
            Drivetrain { speed: 10.0, acceleration: 1e9, real: [1.0; 3], footprint, ..known };
        let mut vehicle = Vehicle::new(Pose::new([0.0, 0.0].into(), 0.0));
        let command = Command { speed: m(speed_mm_s), turn: 0.0 };
        // Up to its speed at once, then blind for a period of the detector and a cycle of control.
        vehicle.step(&at_once, &floor, command, 1e-9);
        let braking = Drivetrain { acceleration: m(self.braking), ..at_once };
        vehicle.step(&braking, &floor, command, m(self.detect + self.cycle));
        let mut touched = vehicle.touches();
        while vehicle.speeds().speed > 0.0 {
            vehicle.step(&braking, &floor, Command::default(), 0.01);
            touched |= vehicle.touches();
        }
        touched
    }
}

#[test]
fn a_robot_at_its_derived_speed_touches_nothing_and_10_mm_s_faster_it_does() {
    let mut stream = Streams::new(42).stream("corridors");
    let (mut by_avoidance, mut others, mut touching) = ([0, 0], [0, 0], 0);
    for _ in 0..1_000 {
        let corridor = Corridor::drawn(&mut stream);
        let (speed, is_bound) = corridor.speed().unwrap();
        touching += usize::from(corridor.touches(speed));
        let [count, faster] = if is_bound { &mut by_avoidance } else { &mut others };
        (*count, *faster) = (*count + 1, *faster + usize::from(corridor.touches(speed + 10)));
    }
    assert_eq!(touching, 0);
    assert_eq!(by_avoidance, [283, 283]);
    // Bounds of its energy, its frames or its body are below; in 11 both are within 10 mm/s.
    assert_eq!(others, [717, 11]);
}
