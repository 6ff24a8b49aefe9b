//! Stories of a laser of three rays: to the right, ahead and to the left.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Disc, Laser, LaserSettings, Rate, Scene, Streams};
use cotama_floor::{Bounds, Kind, Point, Pose, Segment, Segments};

/// A wall 3 m ahead of the origin.
fn hall() -> Segments {
    let bounds = Bounds { least: Point::new(-9.0, -9.0), most: Point::new(9.0, 9.0) };
    let ends = [[3.0, -9.0], [3.0, 9.0]].map(Point::from);
    Segments::new(bounds, &[Segment { from: ends[0], to: ends[1], kind: Kind::Wall }], &[]).unwrap()
}

fn settings(noise_m: f64) -> LaserSettings {
    let rate = Rate { period: Millis(100), latency: Millis(0) };
    LaserSettings { rays: 3, noise_m, rate, ..LaserSettings::sick_lms200() }
}

/// Returns so many scans, one after the other.
fn scans(noise_m: f64, people: &[Disc], count: u64) -> Vec<[f64; 3]> {
    let floor = hall();
    let mut laser = Laser::new(&settings(noise_m), &Streams::new(7), "laser").unwrap();
    let scan = |at: u64| {
        laser.sense(Millis(100 * at), &Pose::identity(), &Scene::of(&floor, people));
        laser.latest(Millis(100 * at)).unwrap().value.try_into().unwrap()
    };
    (0..count).map(scan).collect()
}

#[test]
fn a_laser_sees_walls_and_people_and_else_nothing() {
    let person = Disc { centre: Point::new(0.0, 2.0), radius: 0.25 };
    assert_eq!(scans(0.0, &[person], 1), [[f64::INFINITY, 3.0, 1.75]]);
    let close = Disc { centre: Point::new(0.0, 0.0), radius: 0.25 };
    assert_eq!(scans(0.0, &[close], 1), [[0.0; 3]]);
}

#[test]
fn a_laser_has_noise_of_its_deviation_and_no_bias() {
    let errors: Vec<f64> = scans(0.1, &[], 20_000).iter().map(|it| it[1] - 3.0).collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let square = errors.iter().map(|it| it * it).sum::<f64>() / errors.len() as f64;
    assert!(mean.abs() < 0.002 && (square.sqrt() - 0.1).abs() < 0.002, "{mean} {square}");
}

#[test]
fn a_person_changes_the_noise_of_no_other_ray() {
    let person = Disc { centre: Point::new(0.0, 2.0), radius: 0.25 };
    let ahead =
        |people: &[Disc]| -> Vec<f64> { scans(0.1, people, 50).iter().map(|it| it[1]).collect() };
    assert_eq!(ahead(&[person]), ahead(&[]));
}

#[test]
fn a_laser_whose_numbers_make_no_sense_is_refused() {
    let refused = |settings: LaserSettings| {
        Laser::new(&settings, &Streams::new(7), "laser").unwrap_err().to_string()
    };
    let blind = LaserSettings { rays: 0, ..settings(0.0) };
    assert_eq!(refused(blind), "the number of rays is 0; give a number from 1 to 16384");
    let nowhere = LaserSettings { range_m: f64::NAN, ..settings(0.0) };
    assert_eq!(refused(nowhere), "the range in m is NaN; give a number from 0.01 to 1000");
}
