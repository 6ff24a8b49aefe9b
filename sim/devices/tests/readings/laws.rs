//! Laws of devices, on floors that are drawn.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use crate::common::{Hall, Motion, halls};
use cotama_core::units::Millis;
use cotama_devices::{
    Disc, Fault, Laser, LaserSettings, Link, LinkSettings, Mode, Ring, RingSettings, Scene, Streams,
};
use cotama_floor::{Kind, Point, Pose, Ray, Segment, Surface, Vector};
use proptest::prelude::*;

const ALL: &[Kind] = &[Kind::Wall, Kind::Glass, Kind::Door, Kind::GlassDoor, Kind::Furniture];
const SOLID: &[Kind] = &[Kind::Wall, Kind::Door, Kind::Furniture];

/// A laser and a ring without noise; an echo comes back up to 40° aslant, and else does not.
fn settings() -> (LaserSettings, RingSettings) {
    let laser = LaserSettings { noise_m: 0.0, ..LaserSettings::hokuyo_urg(181) };
    let ring = RingSettings {
        noise_m: 0.0,
        cross_talk: 0.0,
        echo_rad: 0.7,
        mirror_rad: 0.7,
        ..RingSettings::pioneer()
    };
    (laser, ring.all_at_once(Millis(100)))
}

fn scan(floor: &dyn Surface, discs: &[Disc], pose: &Pose) -> Vec<f64> {
    let mut laser = Laser::new(&settings().0, &Streams::new(1), "laser").unwrap();
    laser.sense(Millis(0), pose, &Scene::of(floor, discs));
    laser.latest(Millis(1_000)).unwrap().value.to_vec()
}

fn sweep(floor: &dyn Surface, discs: &[Disc], pose: &Pose) -> Vec<f64> {
    let mut ring = Ring::new(&settings().1, &Streams::new(1), "sonar").unwrap();
    ring.sense(Millis(0), pose, &Scene::of(floor, discs));
    ring.latest(Millis(1_000)).unwrap().iter().map(|it| it.unwrap().value).collect()
}

fn readings(hall: &Hall, motion: Motion) -> (Vec<f64>, Vec<f64>) {
    let (floor, discs, pose) = (hall.floor(motion), hall.discs(motion), hall.pose(motion));
    (scan(&floor, &discs, &pose), sweep(&floor, &discs, &pose))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_mirrored_floor_gives_the_mirrored_readings_bit_for_bit(hall in halls(ALL, 24)) {
        let (scan, sweep) = readings(&hall, Motion::Stay);
        let (mut mirrored, mut other) = readings(&hall, Motion::Mirror);
        mirrored.reverse();
        other[..8].reverse();
        other[8..].reverse();
        prop_assert_eq!((scan, sweep), (mirrored, other));
    }

    #[test]
    fn a_turned_floor_gives_the_same_readings_bit_for_bit(hall in halls(ALL, 24)) {
        prop_assert_eq!(readings(&hall, Motion::Stay), readings(&hall, Motion::Turn));
    }

    #[test]
    fn a_laser_looks_through_glass_and_a_sonar_does_not(
        hall in halls(SOLID, 12),
        panes in halls(&[Kind::Glass], 6),
    ) {
        let with = |kind: Option<Kind>| {
            let panes = panes.segments.iter().filter_map(|it| Some(Segment { kind: kind?, ..*it }));
            let segments = hall.segments.iter().copied().chain(panes).collect();
            Hall { segments, ..hall.clone() }
        };
        let read = |kind| readings(&with(kind), Motion::Stay);
        prop_assert_eq!(read(Some(Kind::Glass)).0, read(None).0);
        prop_assert_eq!(read(Some(Kind::Glass)).1, read(Some(Kind::Wall)).1);
    }

    #[test]
    fn a_device_with_faults_of_no_effect_reads_the_same_bytes(hall in halls(ALL, 12)) {
        let without = run(7, &hall, &[], [true; 3]);
        prop_assert_eq!(run(7, &hall, &no_effect(), [true; 3]), without);
    }

    #[test]
    fn a_device_reads_the_same_whether_or_not_there_are_others(hall in halls(ALL, 12)) {
        let all = run(7, &hall, &[], [true; 3]);
        for device in 0..3 {
            let alone = run(7, &hall, &[], core::array::from_fn(|it| it == device));
            prop_assert_eq!(&alone[device], &all[device]);
        }
    }

    #[test]
    fn a_seed_gives_the_same_bytes_and_another_one_others(hall in halls(ALL, 12)) {
        let first = run(7, &hall, &[], [true; 3]);
        prop_assert_eq!(&run(7, &hall, &[], [true; 3]), &first);
        prop_assert_ne!(run(8, &hall, &[], [true; 3]), first);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_096))]

    /// The way is 3/5 ahead and 4/5 aside or the like, so whole numbers tell whether it meets.
    #[test]
    fn a_ray_meets_a_disc_where_the_closed_form_says(
        (x, y, radius) in (-1_000_i64..1_000, -1_000_i64..1_000, 1_i64..400),
        (a, b, c) in proptest::sample::select(&[(3_i64, 4_i64, 5_i64), (-5, 12, 13), (8, -15, 17)]),
    ) {
        let disc = Disc { centre: Point::new(x as f64, y as f64), radius: radius as f64 };
        let along = Vector::new(a as f64, b as f64) / c as f64;
        let ray = Ray { from: Point::origin(), along };
        let (aside, ahead, square) = (a * y - b * x, a * x + b * y, x * x + y * y);
        prop_assume!(aside.abs() != c * radius);
        let met = disc.meets(&ray);
        if square <= radius * radius {
            prop_assert_eq!(met, Some((0.0, 1.0)));
        } else if aside.abs() > c * radius || ahead < 0 {
            prop_assert_eq!(met, None);
        } else {
            // The smaller root of t² - 2 t ahead + (|centre|² - r²), without cancellation.
            let (distance, cosine) = met.unwrap();
            let ahead = ahead as f64 / c as f64;
            let rest = (square - radius * radius) as f64;
            let expected = rest / (ahead + (ahead * ahead - rest).max(0.0).sqrt());
            // Both lose half of the digits where the ray nearly touches.
            let error = 1e-15 * (square as f64 + 1.0) / (cosine * disc.radius);
            prop_assert!((distance - expected).abs() <= 8.0 * error, "{} {}", distance, expected);
            let normal = (ray.point(distance) - disc.centre) / disc.radius;
            prop_assert!((normal.norm() - 1.0).abs() <= 8.0 * error / disc.radius);
            prop_assert!((cosine + normal.dot(&along)).abs() <= 8.0 * error / disc.radius);
        }
    }
}

/// One fault of each effect that changes nothing, and some that are never there.
fn no_effect() -> Vec<Fault> {
    let all = [
        Mode::Bias(0.0),
        Mode::Drift { per_s: 0.0, most: 1.0 },
        Mode::Drift { per_s: 1.0, most: 0.0 },
        Mode::Noise(0.0),
        Mode::DropOut(0.0),
        Mode::Delay(Millis(0)),
        Mode::Saturation { least: f64::NEG_INFINITY, most: f64::INFINITY },
    ];
    let late = Fault::new(Mode::Stuck(1.0)).unwrap().from(Millis(1_000_000));
    let past = Fault::new(Mode::Frozen).unwrap().until(Millis(0));
    let all = all.map(|it| Fault::new(it).unwrap());
    all.into_iter().chain([late, past]).collect()
}

/// Returns the bits of all readings that arrive in three seconds on the spot, of a laser, a ring
/// and a link, each with noise: those that there are.
fn run(seed: u64, hall: &Hall, faults: &[Fault], are_there: [bool; 3]) -> [Vec<u64>; 3] {
    let streams = Streams::new(seed);
    let (floor, discs, pose) =
        (hall.floor(Motion::Stay), hall.discs(Motion::Stay), hall.pose(Motion::Stay));
    let scene = Scene::of(&floor, &discs);
    let mut laser = Laser::new(&LaserSettings::hokuyo_urg(16), &streams, "laser").unwrap();
    let mut ring = Ring::new(&RingSettings::pioneer(), &streams, "sonar").unwrap();
    let mut link = Link::new(&LinkSettings::wifi(), &[Point::origin()], &streams, "wifi").unwrap();
    laser.faults().replace(faults, &streams, "laser").unwrap();
    link.faults().replace(faults, &streams, "wifi").unwrap();
    for sonar in 0..16 {
        ring.set_faults(sonar, faults, &streams, "sonar").unwrap();
    }
    let mut read = [Vec::new(), Vec::new(), Vec::new()];
    for now in (0..3_000).step_by(20).map(Millis) {
        if are_there[0] {
            laser.sense(now, &pose, &scene);
            let scan = laser.latest(now).into_iter().flat_map(|it| it.value);
            read[0].extend(scan.map(|it| it.to_bits()));
        }
        if are_there[1] {
            ring.sense(now, &pose, &scene);
            let sweep = ring.latest(now).into_iter().flatten().flatten();
            read[1].extend(sweep.map(|it| it.value.to_bits() ^ it.taken.0));
        }
        if are_there[2] {
            link.sense(now, hall.robot, &floor);
            read[2].extend(link.latest(now).map(|it| it.value.to_bits()));
        }
    }
    read
}
