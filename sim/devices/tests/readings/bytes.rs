//! The same bytes on every machine and by every compiler: all devices and people over the office.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{
    Camera, CameraSettings, Disc, Fault, Habits, Laser, LaserSettings, Link, LinkSettings, Mode,
    People, QrMark, Ring, RingSettings, Routes, Scene, Streams,
};
use cotama_floor::{Needs, Planner, Version, embedded, metres};
use cotama_streams::fnv1a;

/// Returns a number of all readings of a robot that goes from the dock to office B at 0.4 m/s.
fn digest(seed: u64) -> u64 {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Real, &[]).unwrap();
    let planner = Planner::new(&surface, Needs { cell_m: 0.1, ..Needs::default() }).unwrap();
    let place = |name| metres(office.place(name).unwrap().at);
    let path = planner.route(place("dock"), place("office B")).unwrap();
    let places = ["lab", "kitchen", "lounge", "corridor west"].map(place);
    let routes = Routes::plan(&planner, &places).unwrap();

    let streams = Streams::new(seed);
    let mut people = People::new(6, &Habits::default(), routes, &streams, "people").unwrap();
    let mut laser = Laser::new(&LaserSettings::hokuyo_urg(60), &streams, "laser").unwrap();
    let mut ring = Ring::new(&RingSettings::pioneer(), &streams, "sonar").unwrap();
    let marks = QrMark::of(&office);
    let mut camera = Camera::new(&CameraSettings::kinect(), &marks, &streams, "camera").unwrap();
    let mut link = Link::new(&LinkSettings::wifi(), &[places[2]], &streams, "wifi").unwrap();
    let drift = Fault::new(Mode::Drift { per_s: 0.01, most: 0.2 }).unwrap();
    let loose = Fault::new(Mode::DropOut(0.5)).unwrap();
    let loose = loose.intermittent(Millis(400), Millis(900)).unwrap();
    laser.faults().replace(&[drift, loose], &streams, "laser").unwrap();
    let fading = Fault::new(Mode::fading(30.0, Millis(20_000))).unwrap();
    link.faults().replace(&[fading], &streams, "wifi").unwrap();

    let mut bytes = Vec::new();
    let mut write = |it: f64| bytes.extend(it.to_bits().to_le_bytes());
    for now in (0..36_000).step_by(20).map(Millis) {
        let pose = path.pose(0.000_4 * now.0 as f64);
        let own = Disc { centre: pose.translation.vector.into(), radius: 0.25 };
        let scene = Scene::of(&surface, people.advance(now, &[own]));
        laser.sense(now, &pose, &scene);
        ring.sense(now, &pose, &scene);
        camera.sense(now, &pose, 0.4, &scene);
        link.sense(now, own.centre, &surface);
        laser.latest(now).into_iter().flat_map(|it| it.value).for_each(|it| write(*it));
        ring.latest(now).into_iter().flatten().flatten().for_each(|it| write(it.value));
        let seen = camera.latest(now).into_iter().flat_map(|it| it.value);
        seen.for_each(|it| [it.distance, it.bearing].into_iter().for_each(&mut write));
        link.latest(now).into_iter().for_each(|it| write(it.value));
    }
    fnv1a(&bytes)
}

/// Found in debug and in release builds; seeds that are stored do not replay if it changes.
#[test]
fn a_seed_gives_the_same_readings_everywhere() {
    assert_eq!(digest(7), 13_124_014_865_512_400_766);
    assert_ne!(digest(7), digest(8));
}
