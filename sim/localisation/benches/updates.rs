//! Times of an update: 500 particles around a robot that drives along the corridor of the office.
//!
//! `cargo bench -p cotama-localisation --bench updates [NAME]`: `field-60`, `field-240`, `beam-60`,
//! `sonars` or `field-60-2000` measures that alone; with `--test` all run briefly. Each is the
//! median of 21 rounds by the clock, and by the time on the processor where Linux tells it, as
//! others may work beside. An update is all of it: motion, weights, estimate, drawing anew.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Laser, LaserSettings, Rate, Ring, RingSettings, Scene, Streams};
use cotama_floor::{Point, Pose, Segments, Version, embedded};
use cotama_localisation::{Chart, Localiser, Model, Parameters, Sensor};
use nalgebra::Matrix3;
use std::hint::black_box;
use std::time::Instant;

const VIEW: f64 = 1.5 * std::f64::consts::PI;
const RANGE: f64 = 8.0;
/// Readings along the way, one each 0.3 m.
const READINGS: usize = 60;

/// A round is so many trips, as times on the processor are counted in steps of 4 ms.
const TRIPS: usize = 20;

/// The way: along the corridor from the west to the east, with a slight swing.
fn pose(at: usize) -> Pose {
    let x = 4.0 + 0.3 * at as f64;
    Pose::new(Point::new(x, 10.0).coords, 0.1 * libm::sin(x))
}

fn scans(floor: &Segments, rays: usize) -> Vec<Vec<f64>> {
    let rate = Rate { period: Millis(100), latency: Millis(0) };
    let settings = LaserSettings {
        view_rad: VIEW,
        rays,
        range_m: RANGE,
        rate,
        ..LaserSettings::sick_lms200()
    };
    let mut laser = Laser::new(&settings, &Streams::new(1), "laser").unwrap();
    let scan = |at: usize| {
        let now = Millis(100 * at as u64);
        laser.sense(now, &pose(at), &Scene::of(floor, &[]));
        laser.latest(now).unwrap().value.to_vec()
    };
    (0..READINGS).map(scan).collect()
}

fn sonar_readings(floor: &Segments, settings: &RingSettings) -> Vec<Vec<f64>> {
    let mut ring = Ring::new(settings, &Streams::new(1), "sonar").unwrap();
    let read = |at: usize| {
        let now = Millis(100 * at as u64);
        ring.sense(now, &pose(at), &Scene::of(floor, &[]));
        let read = ring.latest(now).unwrap();
        read.iter().map(|it| it.map_or(f64::NAN, |it| it.value)).collect()
    };
    (0..READINGS).map(read).collect()
}

/// Returns the seconds that the program has been on a processor.
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|it| it / 1e9)
}

fn measure(name: &str, rounds: usize, chart: &Chart, readings: &[Vec<f64>]) {
    let mut localiser = Localiser::new(chart, &Streams::new(1), "robot");
    let mut times: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    let spread = Matrix3::from_diagonal(&[0.04, 0.04, 0.01].into());
    let (mut off, mut effective) = (0.0, 0.0);
    for _ in 0..rounds {
        let (start, before) = (Instant::now(), on_processor());
        for _ in 0..TRIPS {
            localiser.start_at(&pose(0), &spread).unwrap();
            for (at, reading) in readings.iter().enumerate() {
                assert!(localiser.update(black_box(&pose(at)), black_box(reading)));
            }
        }
        let count = (TRIPS * readings.len()) as f64;
        times[0].push(start.elapsed().as_secs_f64() / count);
        let used = on_processor().zip(before).map(|(now, before)| now - before);
        times[1].extend(used.map(|it| it / count));
        let it = localiser.estimate();
        off = (it.pose.translation.vector - pose(READINGS - 1).translation.vector).norm();
        effective = it.effective;
    }
    for (kind, times) in ["by the clock", "on the processor"].iter().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        let at = |part: usize| {
            let it = times.get(part * times.len().saturating_sub(1) / 2);
            it.copied().unwrap_or(f64::NAN) * 1e3
        };
        let [least, median, most] = [0, 1, 2].map(at);
        println!("{name:14} {median:7.4} ms {kind}, from {least:.4} to {most:.4}");
    }
    let particles = localiser.estimate().particles;
    println!(
        "{name:14} {particles} particles, {effective:.0} effective, {off:.3} m off at the end"
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let brief = arguments.iter().any(|it| it == "--test");
    let is_wanted = |name: &str| {
        let mut names = arguments.iter().filter(|it| !it.starts_with('-')).peekable();
        names.peek().is_none() || names.any(|it| it == name)
    };
    let office = embedded::OFFICE.floor().unwrap();
    let real = office.surface(Version::Real, &[]).unwrap();
    let charted = office.surface(Version::Charted, &[]).unwrap();
    let rounds = if brief { 1 } else { 21 };
    for (name, model, cell_m, beams, particles) in [
        ("field-60", Model::LikelihoodField, 0.05, 60, 500),
        ("field-240", Model::LikelihoodField, 0.05, 240, 500),
        ("field-60-2000", Model::LikelihoodField, 0.05, 60, 2_000),
        ("beam-60", Model::Beam, 0.1, 60, 500),
    ] {
        if !is_wanted(name) {
            continue;
        }
        let parameters = Parameters {
            laser_model_type: model,
            max_beams: beams,
            min_particles: particles,
            max_particles: particles,
            ..Parameters::default()
        };
        let sensor = Sensor::laser(&Pose::identity(), VIEW, 240, RANGE).unwrap();
        let start = Instant::now();
        let chart = Chart::new(&charted, cell_m, &sensor, &parameters).unwrap();
        println!("{name:14} chart in {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
        measure(name, rounds, &chart, &scans(&real, 240));
    }
    if is_wanted("sonars") {
        let settings = RingSettings::pioneer().all_at_once(Millis(100));
        let parameters =
            Parameters { min_particles: 500, max_particles: 500, ..Parameters::default() };
        let sensor =
            Sensor::sonars(&settings.mounts, settings.cone_rad, 5, settings.range_m).unwrap();
        let chart = Chart::new(&charted, 0.05, &sensor, &parameters).unwrap();
        let readings = sonar_readings(
            &real,
            &RingSettings { rate: Rate { latency: Millis(0), ..settings.rate }, ..settings },
        );
        measure("sonars", rounds, &chart, &readings);
    }
}
