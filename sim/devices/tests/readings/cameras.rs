//! Stories of a camera and a mark of 100 mm, which faces it from a wall at x = 4 m.
#![allow(clippy::unwrap_used)]

use cotama_core::units::Millis;
use cotama_devices::{Camera, CameraSettings, Disc, Fault, Mode, QrMark, Scene, Sighting, Streams};
use cotama_floor::{Bounds, Kind, Point, Pose, Segment, Segments, Vector};

fn hall(between: Option<Kind>) -> Segments {
    let bounds = Bounds { least: Point::new(0.0, -4.0), most: Point::new(9.0, 4.0) };
    let wall = |x: f64, kind| {
        let ends = [[x, -3.0], [x, 3.0]].map(Point::from);
        Segment { from: ends[0], to: ends[1], kind }
    };
    let segments: Vec<_> =
        std::iter::once(wall(4.0, Kind::Wall)).chain(between.map(|it| wall(3.75, it))).collect();
    Segments::new(bounds, &segments, &[]).unwrap()
}

fn camera() -> Camera {
    let mark = QrMark { at: Point::new(4.0, 0.0), facing: -Vector::x(), size_m: 0.1 };
    let settings = CameraSettings { noise_part: 0.0, noise_rad: 0.0, ..CameraSettings::kinect() };
    Camera::new(&settings, &[mark], &Streams::new(7), "camera").unwrap()
}

/// Returns the sightings in so many pictures from a pose.
fn seen(pose: [f64; 3], speed: f64, scene: &Scene<'_>, count: u64) -> Vec<Sighting> {
    let mut camera = camera();
    let mut picture = |at: u64| {
        camera.sense(Millis(33 * at), &Pose::new([pose[0], pose[1]].into(), pose[2]), speed, scene);
        camera.latest(Millis(33 * at + 100)).unwrap().value.to_vec()
    };
    (0..count).flat_map(&mut picture).collect()
}

#[test]
fn a_mark_is_seen_from_the_front_and_neither_from_behind_nor_from_the_side() {
    let floor = hall(None);
    let count = |pose| seen(pose, 0.0, &Scene::of(&floor, &[]), 1).len();
    assert_eq!(count([3.5, 0.0, 0.0]), 1);
    assert_eq!(count([3.5, 0.0, 0.5]), 0); // beyond half of 57°
    assert_eq!(count([4.5, 0.0, std::f64::consts::PI]), 0); // behind the wall
    assert_eq!(count([3.75, 0.4, -1.01]), 1); // 58° aslant
    assert_eq!(count([3.75, 0.5, -1.11]), 0); // 63° aslant
}

#[test]
fn a_sighting_says_where_the_mark_is() {
    let floor = hall(None);
    let all = seen([3.6, 0.3, -0.5], 0.0, &Scene::of(&floor, &[]), 1);
    let [Sighting { mark: 0, distance, bearing }] = all[..] else { panic!("{all:?}") };
    // The mark is 0.4 m to the east and 0.3 m to the south of the robot, which looks 0.5 rad south.
    assert!((distance - 0.5).abs() < 1e-12);
    assert!((bearing - (0.5 - libm::atan2(0.3, 0.4))).abs() < 1e-12);
}

#[test]
fn walls_and_people_hide_a_mark_and_glass_does_not() {
    let count = |between, discs: &[Disc]| {
        seen([3.5, 0.0, 0.0], 0.0, &Scene::of(&hall(between), discs), 1).len()
    };
    assert_eq!(count(Some(Kind::Wall), &[]), 0);
    assert_eq!(count(Some(Kind::Glass), &[]), 1);
    let person = |y| Disc { centre: Point::new(3.75, y), radius: 0.2 };
    assert_eq!(count(None, &[person(0.1)]), 0);
    assert_eq!(count(None, &[person(0.3)]), 1);
}

#[test]
fn a_fast_robot_sees_no_mark() {
    let floor = hall(None);
    let count = |speed| seen([3.5, 0.0, 0.0], speed, &Scene::of(&floor, &[]), 1).len();
    assert_eq!([0.45, -0.45, 0.46, -0.46].map(count), [1, 1, 0, 0]);
}

#[test]
fn a_mark_is_found_more_seldom_the_further_it_is() {
    let floor = hall(None);
    let count =
        |distance: f64| seen([4.0 - distance, 0.0, 0.0], 0.0, &Scene::of(&floor, &[]), 2_000).len();
    assert_eq!(count(0.76), 2_000);
    assert!((940..1_060).contains(&count(1.145)), "{}", count(1.145)); // half of the way
    assert_eq!(count(1.53), 0);
}

#[test]
fn a_frozen_picture_shows_a_mark_that_is_no_more_there() {
    let (floor, mut camera) = (hall(None), camera());
    let frozen = Fault::new(Mode::Frozen).unwrap().from(Millis(33));
    camera.faults().replace(&[frozen], &Streams::new(7), "camera").unwrap();
    let mut count = |now: u64, heading| {
        let pose = Pose::new([3.5, 0.0].into(), heading);
        camera.sense(Millis(now), &pose, 0.0, &Scene::of(&floor, &[]));
        camera.latest(Millis(now + 100)).unwrap().value.len()
    };
    assert_eq!([count(0, 0.0), count(33, 3.0), count(66, 3.0)], [1, 1, 1]);
}
