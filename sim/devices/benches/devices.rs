//! How many times faster than real time a robot senses: a robot that wanders over the office.
//!
//! `cargo bench -p cotama-devices --bench devices [NAME]`: `laser`, `sonars` or `robots` measures
//! that alone; with `--test` all run briefly. Each is the median of 11 rounds: by the clock, and by
//! the time on the processor where Linux tells it, as others may work beside. The robot goes ahead,
//! and turns towards the side with more room; its pose is integrated in steps of 100 ms.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Disc, Laser, LaserSettings, Ring, RingSettings, Scene, Streams};
use cotama_floor::{Point, Pose, Segments, Surface, Version, embedded};
use nalgebra::Isometry2;
use std::hint::black_box;
use std::time::Instant;

const STEP: Millis = Millis(100);
const SPEED_M_S: f64 = 0.3;

/// A robot that goes ahead where there is room, and turns where there is more.
struct Wanderer {
    pose: Pose,
    /// Metres and radians a second.
    speed: (f64, f64),
}

impl Wanderer {
    fn new(at: Point, heading: f64) -> Self {
        Self { pose: Pose::new(at.coords, heading), speed: (0.0, 0.0) }
    }

    fn at(&self) -> Point {
        self.pose.translation.vector.into()
    }

    /// Moves along an arc, but never into something: then it turns in place.
    fn move_on(&mut self, floor: &Segments) {
        let seconds = STEP.0 as f64 / 1_000.0;
        let (ahead, turn) = (self.speed.0 * seconds, self.speed.1 * seconds);
        let half = Isometry2::rotation(turn / 2.0);
        let moved = self.pose * half * Isometry2::translation(ahead, 0.0) * half;
        let is_free = floor.clearance(moved.translation.vector.into(), 0.3) >= 0.25;
        self.pose = if is_free { moved } else { self.pose * Isometry2::rotation(turn + 0.05) };
    }

    /// Decides by the room to the right, ahead and to the left.
    fn decide(&mut self, [right, ahead, left]: [f64; 3]) {
        let is_blocked = ahead < 0.6;
        let side = if left >= right { 1.0 } else { -1.0 };
        self.speed = if is_blocked { (0.0, side) } else { (SPEED_M_S, 0.2 * side) };
    }
}

fn least(ranges: impl Iterator<Item = f64>) -> f64 {
    ranges.fold(f64::INFINITY, f64::min)
}

fn with_laser(floor: &Segments, seconds: u64) -> Point {
    let mut robot = Wanderer::new(Point::new(12.0, 10.0), 0.3);
    let settings =
        LaserSettings { view_rad: std::f64::consts::PI, ..LaserSettings::hokuyo_urg(180) };
    let mut laser = Laser::new(&settings, &Streams::new(1), "laser").unwrap();
    for now in (0..seconds * 1_000).step_by(STEP.0 as usize).map(Millis) {
        laser.sense(now, &robot.pose, &Scene::of(floor, &[]));
        if let Some(scan) = laser.latest(now) {
            let third = |at: usize| least(scan.value[at * 60..(at + 1) * 60].iter().copied());
            robot.decide([0, 1, 2].map(third));
        }
        robot.move_on(floor);
    }
    robot.at()
}

fn with_sonars(floor: &Segments, seconds: u64) -> Point {
    let mut robot = Wanderer::new(Point::new(12.0, 10.0), 0.3);
    let settings = RingSettings::pioneer().all_at_once(STEP);
    let mut ring = Ring::new(&settings, &Streams::new(1), "sonar").unwrap();
    for now in (0..seconds * 1_000).step_by(STEP.0 as usize).map(Millis) {
        ring.sense(now, &robot.pose, &Scene::of(floor, &[]));
        if let Some(read) = ring.latest(now) {
            let of = |sonars: std::ops::Range<usize>| {
                least(read[sonars].iter().flatten().map(|it| it.value))
            };
            robot.decide([of(5..8), of(2..6), of(0..3)]);
        }
        robot.move_on(floor);
    }
    robot.at()
}

/// Forty robots with a laser each, which see each other.
fn many(floor: &Segments, seconds: u64) -> Point {
    const ROBOTS: usize = 40;
    let settings =
        LaserSettings { view_rad: std::f64::consts::PI, ..LaserSettings::hokuyo_urg(180) };
    let mut robots: Vec<(Wanderer, Laser)> = (0..ROBOTS)
        .map(|at| {
            let place = Point::new(1.0 + 0.7 * at as f64, if at % 2 == 0 { 9.6 } else { 10.4 });
            let laser = Laser::new(&settings, &Streams::new(1), &format!("laser {at}"));
            (Wanderer::new(place, at as f64), laser.unwrap())
        })
        .collect();
    let mut discs = vec![Disc { centre: Point::origin(), radius: 0.25 }; ROBOTS];
    for now in (0..seconds * 1_000).step_by(STEP.0 as usize).map(Millis) {
        for (disc, (robot, _)) in discs.iter_mut().zip(&robots) {
            disc.centre = robot.at();
        }
        for (at, (robot, laser)) in robots.iter_mut().enumerate() {
            laser.sense(now, &robot.pose, &Scene::of(floor, &[]).among(&discs, at));
            if let Some(scan) = laser.latest(now) {
                let third = |at: usize| least(scan.value[at * 60..(at + 1) * 60].iter().copied());
                robot.decide([0, 1, 2].map(third));
            }
            robot.move_on(floor);
        }
    }
    robots[0].0.at()
}

/// Returns the seconds that the program has been on a processor.
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|it| it / 1e9)
}

fn measure(name: &str, seconds: u64, rounds: usize, run: impl Fn(u64) -> Point) {
    let mut rates: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        let (start, before) = (Instant::now(), on_processor());
        let _ = black_box(run(black_box(seconds)));
        rates[0].push(seconds as f64 / start.elapsed().as_secs_f64());
        let used = on_processor().zip(before).map(|(now, before)| now - before);
        rates[1].extend(used.map(|it| seconds as f64 / it));
    }
    for (kind, rates) in ["by the clock", "on the processor"].iter().zip(&mut rates) {
        rates.sort_by(f64::total_cmp);
        let at = |part: usize| rates.get(part * rounds.saturating_sub(1) / 2).unwrap_or(&f64::NAN);
        let [least, median, most] = [0, 1, 2].map(at);
        println!("{name:8} {median:7.0} x real time {kind}, from {least:.0} to {most:.0}");
    }
    let end = run(seconds);
    println!("{name:8} {seconds} s a round, ends at {:.3}, {:.3} m", end.x, end.y);
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let brief = arguments.iter().any(|it| it == "--test");
    let is_wanted = |name: &str| {
        let mut names = arguments.iter().filter(|it| !it.starts_with('-')).peekable();
        names.peek().is_none() || names.any(|it| it == name)
    };
    let office = embedded::OFFICE.floor().unwrap().surface(Version::Real, &[]).unwrap();
    let rounds = if brief { 1 } else { 11 };
    let time = |seconds: u64| if brief { 10 } else { seconds };
    if is_wanted("laser") {
        measure("laser", time(3_600), rounds, |seconds| with_laser(&office, seconds));
    }
    if is_wanted("sonars") {
        measure("sonars", time(3_600), rounds, |seconds| with_sonars(&office, seconds));
    }
    if is_wanted("robots") {
        measure("robots", time(120), rounds, |seconds| many(&office, seconds));
    }
}
