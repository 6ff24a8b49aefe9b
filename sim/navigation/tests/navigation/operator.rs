//! An operator who drives by the camera.
#![allow(missing_docs)]

use crate::common::{Robot, hall};
use cotama_floor::Point;
use cotama_navigation::{Habits, Image, Limits, Operator};
use cotama_plane::Command;
use cotama_streams::Streams;

const HABITS: Habits = Habits {
    view_rad: 1.0,
    sees_after: 3,
    acts_after: 2,
    blind_after: 10,
    period_s: 0.1,
    speed: 0.3,
    room_m: 0.5,
    hand: 0.1,
};

fn drive(robot: &mut Robot, target: Point, seed: u64, lost_from: usize) -> Vec<Command> {
    let mut operator = Operator::new(HABITS, Limits::of(&robot.drivetrain), &Streams::new(seed));
    let mut told = Vec::new();
    for now in 0..600 {
        let image = Image::of(&robot.map, HABITS.view_rad, 0.6, 5.0, robot.sees(target));
        let command = operator.command((now < lost_from).then_some(image));
        robot.go(command);
        told.push(command);
    }
    told
}

#[test]
fn an_operator_turns_to_a_way_out_of_view_and_comes_there() {
    let target = Point::new(2.0, 8.0);
    let mut robot = Robot::new(hall(&[]), 0.3, Point::new(8.0, 3.0), 0.0);
    let told = drive(&mut robot, target, 7, usize::MAX);
    // Five periods of delay in which the wheels are told nothing.
    assert!(told[..5].iter().all(|it| *it == Command::default()));
    assert!(told[5].speed == 0.0 && told[5].turn > 0.0);
    assert!((robot.at() - target).norm() < 0.3, "{}", robot.at());
    let mut again = Robot::new(hall(&[]), 0.3, Point::new(8.0, 3.0), 0.0);
    assert_eq!(drive(&mut again, target, 7, usize::MAX), told);
}

#[test]
fn an_operator_stops_before_a_wall_and_when_blind() {
    let mut robot = Robot::new(hall(&[[6.0, 0.0, 0.5, 10.0]]), 0.3, Point::new(2.0, 5.0), 0.0);
    drive(&mut robot, Point::new(9.0, 5.0), 7, usize::MAX);
    assert!(!robot.vehicle.touches());
    assert!((5.3..5.7).contains(&robot.at().x), "{}", robot.at());
    let mut robot = Robot::new(hall(&[]), 0.3, Point::new(2.0, 5.0), 0.0);
    let told = drive(&mut robot, Point::new(9.0, 5.0), 7, 50);
    // The last image arrives 3 periods after it was taken, and the stop 2 after it was told.
    let first = (50..told.len()).find(|it| told[*it] == Command::default());
    assert_eq!(first, Some(50 + 3 + 10 - 1 + 2));
    assert!(told[first.unwrap_or(0)..].iter().all(|it| *it == Command::default()));
}
