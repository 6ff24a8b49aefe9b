//! Robots that avoid what they see: nothing is touched, and dead ends make them stand.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common;
use crate::common::{Robot, braking, clutter, drivetrain, hall, place};
use core::f64::consts::PI;
use cotama_core::units::Millis;
use cotama_floor::{Point, Pose};
use cotama_navigation::{
    Braking, Choice, DynamicWindow, Histogram, Limits, LocalMap, Patience, Progress, Retreat,
    Thresholds, Weights, Work,
};
use cotama_plane::Command;
use proptest::prelude::*;

/// Either avoidance.
#[allow(clippy::large_enum_variant)] // two of them live in a test
enum Avoidance {
    Window(DynamicWindow),
    Histogram(Histogram),
}

impl Avoidance {
    fn both(speed: f64) -> [Self; 2] {
        let braking = braking(&drivetrain(speed));
        [
            Self::Window(DynamicWindow::new(braking.clone(), Weights::default(), 3)),
            Self::Histogram(Histogram::new(braking, Thresholds::default())),
        ]
    }

    fn choose(&mut self, map: &LocalMap, now: Command, target: Point, speed: f64) -> Choice {
        match self {
            Self::Window(it) => it.choose(map, now, target, speed),
            Self::Histogram(it) => it.choose(map, now, target, speed),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn an_avoiding_robot_never_touches_static_things(
        boxes in clutter(),
        start in place(),
        target in place(),
        heading in -PI..PI,
        speed in 0.2..1.2,
    ) {
        for mut avoidance in Avoidance::both(speed) {
            let mut robot = Robot::new(hall(&boxes), speed, start, heading);
            prop_assume!(robot.has_room());
            for _ in 0..300 {
                let now = robot.vehicle.speeds();
                let target = robot.sees(target);
                let choice = avoidance.choose(&robot.map, now, target, speed);
                robot.go(choice.command());
                prop_assert!(!robot.vehicle.touches(), "at {}", robot.at());
            }
        }
    }

    #[test]
    fn a_way_back_is_bounded_and_touches_nothing(
        boxes in clutter(),
        start in place(),
        heading in -PI..PI,
        length in 0.0..3.0,
    ) {
        let mut robot = Robot::new(hall(&boxes), 0.3, start, heading);
        prop_assume!(robot.has_room());
        let mut retreat = Retreat::new(braking(&robot.drivetrain), length, 0.2, 150);
        let mut motion = cotama_floor::Pose::identity();
        for _ in 0..170 {
            let told = retreat.command(&robot.map, robot.vehicle.speeds(), &motion);
            motion = robot.go(told);
            prop_assert!(!robot.vehicle.touches());
        }
        prop_assert_ne!(retreat.progress(), Progress::Going);
        let gone = (robot.at() - start).norm();
        // A period of way more than asked at most.
        prop_assert!(gone <= length.min(Retreat::MOST_M) + 0.05, "{gone}");
        if retreat.progress() == Progress::Done {
            prop_assert!(gone >= length.min(Retreat::MOST_M) - 0.05, "{gone}");
        }
    }
}

/// The canary of the property above: it can fail.
#[test]
fn a_robot_that_believes_in_better_brakes_touches() {
    let lane = [[0.0, 0.0, 10.0, 4.6], [0.0, 5.4, 10.0, 4.6], [8.0, 4.7, 0.5, 0.6]];
    let wheels = drivetrain(1.0);
    let limits = Limits { acceleration: 3.0, ..Limits::of(&wheels) };
    let believed = Braking::new(limits, common::RADIUS, 0.05, 0.1);
    let mut window = DynamicWindow::new(believed, Weights::default(), 3);
    let mut robot = Robot::new(hall(&lane), 1.0, Point::new(1.0, 5.0), 0.0);
    let touches = (0..300).any(|_| {
        let (now, there) = (robot.vehicle.speeds(), robot.sees(Point::new(9.0, 5.0)));
        robot.go(window.choose(&robot.map, now, there, 1.0).command());
        robot.vehicle.touches()
    });
    assert!(touches, "{}", robot.at());
}

#[test]
fn a_robot_that_stands_has_the_room_beyond_its_radius_and_margin() {
    let mut braking = braking(&drivetrain(0.4));
    let own = braking.radius_m + braking.margin_m;
    assert!(braking.margin_m > 0.0);
    let mut room = |ahead: f64| {
        let mut map = LocalMap::new(10, Millis(1_000));
        map.take_scan(&Pose::identity(), 0.1, &[ahead]);
        let (stands, mut work) = (Command::default(), Work::default());
        braking.look(stands, &map, &mut work);
        braking.room(stands, stands, &mut work)
    };
    assert!((room(own + 0.005).unwrap() - 0.005).abs() < 1e-9);
    assert_eq!(room(own - 0.01), None);
}

#[test]
fn a_pillar_on_the_way_is_passed() {
    for mut avoidance in Avoidance::both(0.3) {
        let mut robot = Robot::new(hall(&[[4.8, 4.9, 0.4, 0.4]]), 0.3, Point::new(2.0, 5.0), 0.0);
        let target = Point::new(8.0, 5.0);
        let mut periods = 0;
        while (robot.at() - target).norm() > 0.3 && periods < 600 {
            let (now, there) = (robot.vehicle.speeds(), robot.sees(target));
            let choice = avoidance.choose(&robot.map, now, there, 0.3);
            robot.go(choice.command());
            periods += 1;
        }
        assert!(periods < 400, "{periods} {}", robot.at());
    }
}

/// Neither says that it gives up, and the window circles for ever: patience is the caller's.
#[test]
fn a_dead_end_makes_an_impatient_robot_stand() {
    let pocket = [[5.0, 4.0, 2.0, 0.2], [5.0, 5.8, 2.0, 0.2], [6.8, 4.2, 0.2, 1.6]];
    for mut avoidance in Avoidance::both(0.3) {
        let mut robot = Robot::new(hall(&pocket), 0.3, Point::new(5.3, 5.0), 0.0);
        let (target, mut patience) = (Point::new(9.0, 5.0), Patience::new(0.1, 50));
        let mut places = Vec::new();
        for _ in 0..600 {
            let (now, there) = (robot.vehicle.speeds(), robot.sees(target));
            let choice = avoidance.choose(&robot.map, now, there, 0.3);
            let lasts = patience.lasts(there.coords.norm());
            robot.go(if lasts { choice } else { Choice::Stand }.command());
            assert!(!robot.vehicle.touches());
            places.push(robot.at());
        }
        // At most 37 gains of 0.1 m lie before it: the walls of the pocket leave 12.
        assert!(places[400..].iter().all(|it| *it == robot.at()), "{}", robot.at());
    }
}
