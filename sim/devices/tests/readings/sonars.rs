//! Stories of sonars: a pane of glass is 2 m ahead of a robot at the origin, and nothing is around.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Disc, Rate, Ring, RingSettings, Scene, Streams};
use cotama_floor::{Bounds, Kind, Point, Pose, Segment, Segments, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

fn hall() -> Segments {
    let bounds = Bounds { least: Point::new(-9.0, -9.0), most: Point::new(9.0, 9.0) };
    let ends = [[2.0, -9.0], [2.0, 9.0]].map(Point::from);
    let pane = Segment { from: ends[0], to: ends[1], kind: Kind::Glass };
    Segments::new(bounds, &[pane], &[]).unwrap()
}

/// Sonars of a single ray at some headings, that fire together every 100 ms.
fn settings(headings: &[f64]) -> RingSettings {
    RingSettings {
        mounts: headings.iter().map(|it| Pose::new(Vector::zeros(), *it)).collect(),
        rays: 1,
        noise_m: 0.0,
        cross_talk: 0.0,
        rate: Rate { period: Millis(100), latency: Millis(0) },
        ..RingSettings::pioneer()
    }
    .all_at_once(Millis(100))
}

/// Returns the readings in mm of the first sonar.
fn readings(settings: &RingSettings, discs: &[Disc], count: u64) -> Vec<f64> {
    let floor = hall();
    let mut ring = Ring::new(settings, &Streams::new(7), "sonar").unwrap();
    let reading = |at: u64| {
        let now = Millis(100 * at);
        ring.sense(now, &Pose::identity(), &Scene::of(&floor, discs));
        let read = ring.latest(now).unwrap()[0].unwrap();
        assert_eq!(read.taken, now);
        (read.value * 1_000.0).round()
    };
    (0..count).map(reading).collect()
}

#[test]
fn a_pane_throws_sound_away_that_meets_it_aslant() {
    let at = |deg: f64| readings(&settings(&[deg.to_radians()]), &[], 4_000);
    assert!(at(0.0).iter().all(|it| *it == 2_000.0));
    assert!(at(24.0).iter().all(|it| *it == 2_189.0)); // 2 m / cos 24°
    assert!(at(61.0).iter().all(|it| *it == 5_000.0)); // 4.1 m away, but as good as not there
    // Between 25° and 60° the chance is linear in the cosine: 0.510 at 45°.
    let echoes = at(45.0).iter().filter(|it| **it == 2_828.0).count();
    assert!((1_940..2_140).contains(&echoes), "{echoes}");
}

#[test]
fn a_cone_reads_the_nearest_thing_that_sends_an_echo_back() {
    // Five rays from -15° to 15°, and a pane that only those up to 10° echo from.
    let wide = RingSettings {
        rays: 5,
        echo_rad: 10_f64.to_radians(),
        mirror_rad: 10_f64.to_radians(),
        ..settings(&[20_f64.to_radians()])
    };
    assert_eq!(readings(&wide, &[], 1), [2_008.0]); // 2 m / cos 5°: the rightmost ray
    let person = Disc { centre: Point::new(1.0, 0.5), radius: 0.25 };
    assert_eq!(readings(&wide, &[person], 1), [869.0]); // √1.25 m less 0.25 m, but for the angle
}

#[test]
fn a_sonar_with_cross_talk_takes_the_nearer_echo_for_its_own() {
    let away = settings(&[PI, 0.0]);
    assert_eq!(readings(&away, &[], 1), [5_000.0]);
    let talk = |chance| RingSettings { cross_talk: chance, ..away.clone() };
    assert_eq!(readings(&talk(1.0), &[], 1), [2_000.0]);
    let heard = readings(&talk(0.1), &[], 4_000).iter().filter(|it| **it == 2_000.0).count();
    assert!((340..460).contains(&heard), "{heard}");
}

#[test]
fn two_banks_fire_their_sonars_one_after_the_other() {
    let floor = hall();
    let mut ring = Ring::new(&RingSettings::pioneer(), &Streams::new(7), "sonar").unwrap();
    for now in (0..640).step_by(40).map(Millis) {
        assert_eq!(ring.due(), now);
        ring.sense(now, &Pose::identity(), &Scene::of(&floor, &[]));
    }
    let taken = |now| -> Vec<Option<u64>> {
        let read = ring.latest(Millis(now)).unwrap();
        read.iter().map(|it| it.map(|it| it.taken.0)).collect()
    };
    let expected: Vec<_> = (0..16).map(|it| Some(320 + 40 * (it % 8))).collect();
    assert_eq!(taken(640), expected);
    assert_eq!(taken(639)[6..9], [Some(560), Some(280), Some(320)]); // sonar 7 is on its way
}

#[test]
fn a_ring_whose_numbers_make_no_sense_is_refused() {
    let refused = |settings: &RingSettings| {
        Ring::new(settings, &Streams::new(7), "sonar").unwrap_err().to_string()
    };
    let three = RingSettings { banks: 3, ..RingSettings::pioneer() };
    assert!(refused(&three).starts_with("the number of sonars left over by equal banks is 1"));
    let narrow = RingSettings { mirror_rad: 0.1, ..RingSettings::pioneer() };
    assert!(refused(&narrow).starts_with("the angle without echoes in radians is 0.1"));
    let mut ring = Ring::new(&RingSettings::pioneer(), &Streams::new(7), "sonar").unwrap();
    let none = ring.set_faults(16, &[], &Streams::new(7), "sonar").unwrap_err();
    assert_eq!(none.to_string(), "the sonar is 16; give a number from 0 to 15");
    let deaf = RingSettings { echo_rad: f64::NAN, mirror_rad: FRAC_PI_2, ..three };
    assert!(Ring::new(&deaf, &Streams::new(7), "sonar").is_err());
}
