//! Driving over floors, as laws.

#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]
#![allow(clippy::float_cmp)] // to the last bit

use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_floor::embedded::OFFICE;
use cotama_floor::{
    Bounds, Cell, Footprint, Grid, Ground, Kind, Needs, Point, Pose, Segment, Segments, Surface,
};
use cotama_models::missions::{Asked, Mission, embedded};
use cotama_models::robots::{Robot, RobotFile};
use cotama_plane::{Command, Course, Drivetrain, Odometry, Rover, Vehicle};
use proptest::prelude::*;

/// The wheels of a Pioneer 3-DX that may go as fast as is told, with these errors.
fn drivetrain(real: [f64; 3]) -> Drivetrain {
    let robot = Robot::shipped("p3dx-delivery").unwrap();
    let known = Drivetrain::of(robot.body.as_ref().unwrap());
    let footprint = Footprint::disc(0.26);
    Drivetrain { speed: 1e3, acceleration: 1e6, turn: 1e3, real, footprint, ..known }
}

/// An empty hall of 2 km.
fn hall(walls: &[[f64; 4]]) -> Segments {
    let corner = |it: f64| Point::new(it, it);
    let wall = |[a, b, c, d]: &[f64; 4]| Segment {
        from: Point::new(*a, *b),
        to: Point::new(*c, *d),
        kind: Kind::Wall,
    };
    let bounds = Bounds { least: corner(-400.0), most: corner(400.0) };
    let walls: Vec<_> = walls.iter().map(wall).collect();
    Segments::new(bounds, &walls, &[]).unwrap()
}

fn drive(vehicle: &mut Vehicle, of: &Drivetrain, floor: &Segments, commands: &[(f64, f64)]) {
    for (speed, turn) in commands {
        vehicle.step(of, floor, Command { speed: *speed, turn: *turn }, 0.1);
    }
}

#[test]
fn a_shift_is_driven_along_corridors_to_its_end() {
    let known = embedded::mission("shift").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let course = Course::of(&mission, 0).unwrap();
    let mut rover = Rover::new(&course, 0);
    let end = mission.path_length;
    let mut aside = 0.0_f64;
    while rover.x() < end {
        rover.go(MillimetresPerSecond(500), end, Millis(100));
        let at: Point = rover.pose().translation.vector.into();
        let along = rover.x().0 as f64 / 1_000.0;
        aside = aside.max(course.track().find(at, along - 1.0, along + 1.0).1);
    }
    assert!(aside < 0.05 && !rover.touches(), "{aside}");
    assert_eq!(rover.speed(), MillimetresPerSecond(0));
}

#[test]
fn a_way_that_is_owed_is_driven_back_and_forth() {
    let known = embedded::mission("shift").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let course = Course::of(&mission, 0).unwrap();
    let time = |owed: u64| {
        let mut rover = Rover::new(&course, 0);
        let (mut periods, mut least) = (0, f64::INFINITY);
        while rover.x() < Millimetres(8_000) {
            rover.go(MillimetresPerSecond(500), Millimetres(8_000), Millis(100));
            periods += 1;
            if rover.x() >= Millimetres(4_000) && periods < 1_000 && owed > 0 {
                if rover.owed().0 == 0 && least > 1e3 {
                    rover.owe(Millimetres(owed));
                }
                least = least.min(rover.pose().translation.x);
            }
        }
        (periods, least)
    };
    let ((plain, _), (with, least)) = (time(0), time(2_000));
    // The transport robot brakes within 0.25 m, and turns back for a metre; the path begins at 4 m.
    assert!((7.2..7.3).contains(&least), "{least}");
    assert!((plain + 40..plain + 120).contains(&with), "{plain} {with}"); // 4 s, and two turns
}

/// A mission that drives to places of the office, one after the other.
fn tour(robot: &str, places: &[&str]) -> Mission {
    let drive = |(number, to): (usize, &&str)| {
        format!("[[objective]]\nid = \"To{number}\"\ndoes = \"drive\"\nto = \"{to}\"\n")
    };
    let drives: String = places.iter().enumerate().skip(1).map(drive).collect();
    let text = format!(
        "format = \"panorama-mission/2\"\nname = \"tour\"\nrobot = \"{robot}\"\n\
         floor = \"office\"\nfrom = \"{}\"\nlimits = {{ order = [\"duration\", \"energy\"], \
         duration_ms = 3_000_000, energy_mj = 90_000_000 }}\n{drives}",
        places[0],
    );
    let asked = Asked::of(&text).unwrap();
    let office = OFFICE.floor().unwrap();
    let robot = RobotFile::shipped(robot).unwrap();
    let radius_m = robot.robot().body.as_ref().unwrap().radius.0 as f64 / 1_000.0;
    let needs = Needs { radius_m, ..Needs::default() };
    let way = Ground::Drawing(&office).way("office", OFFICE.text, asked, needs);
    Mission::parse_on("tour", &text, Some(robot), Some(&way)).unwrap()
}

/// A parcel and a bucket on the way are not on the map. There and back, as fast as each can.
#[test]
fn robots_come_to_all_places_of_the_office_that_they_fit_into_and_touch_nothing() {
    let office = OFFICE.floor().unwrap();
    let mut places: Vec<_> = office.places.iter().map(|it| it.name.as_str()).collect();
    places.retain(|it| *it != "office D"); // its door is closed
    let wide = ["store", "office B", "lab", "lounge", "corridor east"];
    for (robot, mut places) in [("p3dx-delivery", places), ("transport", wide.to_vec())] {
        for _ in 0..2 {
            let mission = tour(robot, &places);
            let course = Course::of(&mission, 0).unwrap();
            let speed = mission.robot().unwrap().robot().body.as_ref().unwrap().speed_max;
            let mut rover = Rover::new(&course, 0);
            for objective in &mission.objectives {
                for _ in 0..2_000 {
                    rover.go(speed, objective.x_end, Millis(100));
                    assert!(!rover.touches(), "{robot} at {:?}", rover.pose());
                }
                assert_eq!(rover.x(), objective.x_end);
            }
            places.reverse();
        }
    }
}

/// In the corridors of the shift, with people who meet the robot, stand in its way and give way.
#[test]
fn a_robot_among_people_comes_to_its_end_and_touches_nobody() {
    let known = embedded::mission("shift").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let course = Course::of(&mission, 12).unwrap();
    let mut waited = 0;
    for seed in 0..10 {
        let mut rover = Rover::new(&course, seed);
        let mut periods = 0;
        while rover.x() < mission.path_length {
            rover.go(MillimetresPerSecond(500), mission.path_length, Millis(100));
            waited += u64::from(rover.speed().0 == 0);
            periods += 1;
            assert!(periods < 20_000 && !rover.touches(), "seed {seed} at {:?}", rover.pose());
        }
    }
    assert!(waited > 100, "{waited} periods");
}

proptest! {
    /// Steps of any size and speed.
    #[test]
    fn a_robot_never_drives_through_a_wall(
        speed in 0.01_f64..500.0,
        heading in -1.2_f64..1.2,
        step in 0.001_f64..2.0,
        wall in 0.5_f64..50.0,
    ) {
        let (of, floor) = (drivetrain([1.0; 3]), hall(&[[wall, -300.0, wall, 300.0]]));
        let mut vehicle = Vehicle::new(Pose::new([0.0, 0.0].into(), heading));
        for _ in 0..50 {
            vehicle.step(&of, &floor, Command { speed, turn: 0.0 }, step);
            prop_assert!(vehicle.pose().translation.x <= wall - 0.26 + 1e-9);
            prop_assert!(floor.is_free(&of.footprint, vehicle.pose()));
        }
    }

    #[test]
    fn contact_stops_a_robot_and_turning_away_frees_it(heading in -1.0_f64..1.0) {
        let (of, floor) = (drivetrain([1.0; 3]), hall(&[[1.0, -300.0, 1.0, 300.0]]));
        let mut vehicle = Vehicle::new(Pose::new([0.0, 0.0].into(), heading));
        drive(&mut vehicle, &of, &floor, &[(0.5, 0.0); 100]);
        prop_assert!(vehicle.touches() && vehicle.speeds() == Command::default());
        prop_assert!((vehicle.pose().translation.x - 0.74).abs() < 2e-5);
        drive(&mut vehicle, &of, &floor, &[(-0.5, 0.0); 10]);
        prop_assert!(!vehicle.touches() && vehicle.pose().translation.x < 0.6);
    }

    /// To the rounding of an encoder: 125 counts a mm.
    #[test]
    fn odometry_of_wheels_without_errors_is_the_truth(
        commands in prop::collection::vec((-1.0_f64..1.0, -2.0_f64..2.0), 1..100),
    ) {
        let (of, floor) = (drivetrain([1.0; 3]), hall(&[]));
        let start = Pose::identity();
        let (mut vehicle, mut odometry) = (Vehicle::new(start), Odometry::new(start));
        for it in &commands {
            drive(&mut vehicle, &of, &floor, &[*it]);
            odometry.read(&of, vehicle.counts(&of));
        }
        let off = odometry.pose().translation.vector - vehicle.pose().translation.vector;
        prop_assert!(off.norm() < 0.005, "{off}");
    }

    #[test]
    fn a_left_wheel_that_is_larger_bends_the_way_to_the_right(error in 0.001_f64..0.05) {
        let (of, floor) = (drivetrain([1.0 + error, 1.0, 1.0]), hall(&[]));
        let mut vehicle = Vehicle::new(Pose::identity());
        drive(&mut vehicle, &of, &floor, &[(0.5, 0.0); 100]);
        let expected = -error * 5.0 / of.axle; // 5 m, but for the speeding up of the first step
        prop_assert!((vehicle.pose().rotation.angle() - expected).abs() < error / of.axle * 0.05);
    }

    #[test]
    fn a_mirrored_drive_is_mirrored(
        commands in prop::collection::vec((-1.0_f64..1.0, -2.0_f64..2.0), 1..60),
    ) {
        let (of, floor) = (drivetrain([1.0; 3]), hall(&[[3.0, -300.0, 3.0, 300.0]]));
        let mirrored: Vec<_> = commands.iter().map(|it| (it.0, -it.1)).collect();
        let mut both = [Vehicle::new(Pose::identity()), Vehicle::new(Pose::identity())];
        drive(&mut both[0], &of, &floor, &commands);
        drive(&mut both[1], &of, &floor, &mirrored);
        let [it, other] = both.map(|it| *it.pose());
        prop_assert_eq!(it.translation.x, other.translation.x);
        prop_assert_eq!(it.translation.y, -other.translation.y);
    }

    #[test]
    fn a_turned_drive_is_turned(
        commands in prop::collection::vec((-1.0_f64..1.0, -2.0_f64..2.0), 1..60),
        by in -3.0_f64..3.0,
    ) {
        let (of, floor) = (drivetrain([1.0; 3]), hall(&[]));
        let turned = Pose::new([0.0, 0.0].into(), by);
        let mut both = [Vehicle::new(Pose::identity()), Vehicle::new(turned)];
        both.iter_mut().for_each(|it| drive(it, &of, &floor, &commands));
        let [it, other] = both.map(|it| *it.pose());
        let off = (turned * it).translation.vector - other.translation.vector;
        prop_assert!(off.norm() < 1e-9);
    }
}

/// A hall of 12 m x 8 m in cells of 10 cm, with a wall across that leaves 2 m free.
fn cells() -> Grid {
    let cell = |at: usize| {
        let (x, y) = (at % 120, at / 120);
        let is_wall = x == 0 || y == 0 || x == 119 || y == 79 || (x == 60 && y < 60);
        if is_wall { Cell::Occupied } else { Cell::Free }
    };
    let cells: Vec<_> = (0..120 * 80).map(cell).collect();
    Grid::new(120, &cells, 0.1, Point::origin()).unwrap()
}

#[test]
fn a_robot_drives_over_a_map_of_cells_as_over_a_drawing() {
    let text = "format = \"panorama-mission/2\"\nname = \"hall\"\nrobot = \"p3dx-delivery\"\n\
        floor = \"hall.yaml\"\nfrom = \"2000,2000\"\nlimits = { order = [\"duration\", \
        \"energy\"], duration_ms = 900_000, energy_mj = 90_000_000 }\n[[objective]]\nid = \"To\"\n\
        does = \"drive\"\nto = \"10000,2000\"\n";
    let robot = RobotFile::shipped("p3dx-delivery").unwrap();
    let needs = Needs { radius_m: 0.26, ..Needs::default() };
    let way = Ground::Map(&cells()).way("hall.yaml", "", Asked::of(text).unwrap(), needs);
    let mission = Mission::parse_on("hall.toml", text, Some(robot), Some(&way)).unwrap();
    let course = Course::of(&mission, 2).unwrap();
    let mut rover = Rover::new(&course, 1);
    let end = mission.path_length;
    for _ in 0..2_000 {
        rover.go(MillimetresPerSecond(300), end, Millis(100));
        assert!(!rover.touches());
    }
    assert_eq!(rover.x(), end);
    let at = rover.pose().translation.vector;
    assert!((at.x - 10.0).abs() < 0.01 && (at.y - 2.0).abs() < 0.01, "{at}");
    assert!(end.0 > 12_000 && end.0 < 16_000, "{end:?}"); // around the wall
}
