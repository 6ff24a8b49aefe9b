//! Laws of path following.
#![allow(missing_docs)]

use core::f64::consts::PI;
use cotama_floor::{Path, Point, Pose};
use cotama_navigation::{Errors, Guidance, Law, Limits};
use proptest::prelude::*;

const WHEELS: Limits = Limits { speed: 0.5, acceleration: 0.3, turn: 1.0, turn_acceleration: 2.0 };

proptest! {
    /// Up to 3 m aside, at any heading, on bends down to a radius of 1 m: after
    /// 120 s it is within a millimetre and a milliradian, and V grows by no more than Euler errs.
    #[test]
    fn the_law_brings_a_robot_to_its_path_from_any_start(
        ahead in -1.0..1.0,
        aside in -3.0..3.0,
        heading in -PI..PI,
        curvature in -1.0..1.0,
    ) {
        let (law, time) = (Law::default(), 0.01);
        let mut it = Errors { ahead, aside, heading };
        let mut before = law.lyapunov(it);
        for _ in 0..12_000 {
            let steer = law.steer(it, curvature, 0.5, &WHEELS);
            prop_assert!(steer.command.turn.abs() <= 1.0 + 1e-12);
            prop_assert!((0.0..=0.5).contains(&steer.command.speed));
            // A point that runs along the path, and the robot in its frame.
            let (sin, cos) = libm::sincos(it.heading);
            let (runs, speed) = (steer.target * curvature, steer.command.speed);
            it = Errors {
                ahead: it.ahead + (speed * cos - steer.target + runs * it.aside) * time,
                aside: it.aside + (speed * sin - runs * it.ahead) * time,
                heading: it.heading + (steer.command.turn - runs) * time,
            };
            let now = law.lyapunov(it);
            // Steps of Euler add as much as the square of a step.
            prop_assert!(now <= before + 1e-3, "{before} {now}");
            before = now;
        }
        prop_assert!(it.aside.abs() < 1e-3 && it.heading.abs() < 1e-3, "{it:?}");
    }
}

#[test]
fn a_guided_robot_stands_at_the_end_of_its_path() {
    let path = [[0.0, 0.0], [3.0, 0.0], [5.0, 2.0]].map(Point::from).to_vec();
    let path = Path::new(path).unwrap();
    let (mut pose, mut guidance) =
        (Pose::new([0.0, 0.5].into(), 0.3), Guidance::new(Law::default(), 0.0));
    for _ in 0..3_000 {
        let told = guidance.command(&path, &pose, 0.3, &WHEELS, 0.01);
        let half = Pose::rotation(told.turn * 0.005);
        pose = pose * half * Pose::translation(told.speed * 0.01, 0.0) * half;
    }
    let off = (pose.translation.vector - Point::new(5.0, 2.0).coords).norm();
    assert!(off < 0.02, "{off}");
}
