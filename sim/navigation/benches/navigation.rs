//! Ways, avoidance and guidance side by side, in the office.
//!
//! `cargo bench -p cotama-navigation --bench navigation [NAME]`: `ways`, `avoidance` or `guidance`
//! measures that alone; with `--test` all run briefly. A time is the shortest of the rounds, so
//! that what runs beside does not count; then the median and the longest of all questions or
//! moments.
//! Lengths and errors are the same on every machine.
//!
//! *Ways*: A* over cells of 5 cm and the lazy roadmap, between all pairs of places that both join.
//! A roadmap keeps what it has found out: asked *in turn*, and all of that *again*. *Avoidance*: a
//! period of VFH+ and of the dynamic window, with the points of a laser of 240 rays, along a way.
//! *Guidance*: the same path by pure pursuit and by the path following law, a command each 10 ms,
//! over an empty floor; how far the robot was from it, and how often the office had had no room.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss, clippy::cast_sign_loss)]

use core::f64::consts::PI;
use cotama_core::units::Millis;
use cotama_floor::embedded::OFFICE;
use cotama_floor::{
    Ground, Needs, Path, Planner, Point, Pose, Ray, Segments, Sense, Version, metres,
};
use cotama_models::missions::{Asked, Mission};
use cotama_models::robots::RobotFile;
use cotama_navigation::{
    Braking, DynamicWindow, Guidance, Histogram, Law, Limits, LocalMap, Roadmap, Sampling,
    Thresholds, Weights,
};
use cotama_plane::{Command, Course, Drivetrain, Follower, Near, Vehicle};
use cotama_streams::Streams;
use std::hint::black_box;
use std::time::Instant;

const RADIUS_M: f64 = 0.26;
const SAMPLING: Sampling = Sampling { samples: 2_500, near_m: 2.0, radius_m: RADIUS_M };
const SPEED: f64 = 0.3;
const PLACES: [&str; 6] = ["dock", "office A", "lab", "kitchen", "lounge", "corridor east"];

fn milliseconds<T>(of: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let it = black_box(of());
    (start.elapsed().as_secs_f64() * 1e3, it)
}

/// Keeps the shorter time.
fn shorten(time: &mut f64, other: f64) {
    *time = time.min(other);
}

/// The median and the largest.
fn median(mut all: Vec<f64>) -> [f64; 2] {
    all.sort_by(f64::total_cmp);
    [all[all.len() / 2], all[all.len() - 1]]
}

fn ways(charted: &Segments, rounds: usize) {
    let office = OFFICE.floor().unwrap();
    let places: Vec<Point> = office.places.iter().map(|it| metres(it.at)).collect();
    let all = places.iter().flat_map(|from| places.iter().map(move |to| (*from, *to)));
    let needs = Needs { radius_m: RADIUS_M, ..Needs::default() };
    let streams = Streams::new(7);
    let begin =
        || (Planner::new(charted, needs).unwrap(), Roadmap::new(charted, SAMPLING, &streams));
    let (planner, mut known) = begin();
    let of_grid: Vec<_> =
        all.clone().filter(|it| it.0 != it.1 && planner.route(it.0, it.1).is_ok()).collect();
    let pairs: Vec<_> = of_grid.iter().filter(|it| known.route(it.0, it.1).is_ok()).collect();
    let longer = |(from, to): &&(Point, Point)| {
        let [by, over] = [known.route(*from, *to).unwrap(), planner.route(*from, *to).unwrap()];
        by.length() / over.length()
    };
    let [ratio, most] = median(pairs.iter().map(longer).collect());
    // To begin: the grid, the roadmap. For each pair: A*, the roadmap in turn, and that again.
    let mut begun = [f64::INFINITY; 2];
    let mut times = vec![[f64::INFINITY; 3]; pairs.len()];
    for _ in 0..rounds {
        shorten(&mut begun[0], milliseconds(|| Planner::new(charted, needs)).0);
        let (time, mut roadmap) = milliseconds(|| Roadmap::new(charted, SAMPLING, &streams));
        shorten(&mut begun[1], time);
        for (times, (from, to)) in times.iter_mut().zip(&pairs) {
            shorten(&mut times[0], milliseconds(|| planner.route(*from, *to)).0);
            shorten(&mut times[1], milliseconds(|| roadmap.route(*from, *to)).0);
        }
        for (times, (from, to)) in times.iter_mut().zip(&pairs) {
            shorten(&mut times[2], milliseconds(|| roadmap.route(*from, *to)).0);
        }
    }
    let first = |(from, to): &&(Point, Point)| {
        let mut time = f64::INFINITY;
        for _ in 0..rounds.min(3) {
            let mut fresh = Roadmap::new(charted, SAMPLING, &streams);
            shorten(&mut time, milliseconds(|| fresh.route(*from, *to)).0);
        }
        time
    };
    let first = median(pairs.iter().step_by(6).copied().map(|it| first(&it)).collect());
    println!(
        "ways: {} of both, {} of A* alone   median    most",
        pairs.len(),
        of_grid.len() - pairs.len(),
    );
    println!("  {:32} {:7.2} ms", "A*, to begin: the room in cells", begun[0]);
    println!("  {:32} {:7.2} ms", "roadmap, to begin", begun[1]);
    let of = |kind: usize| median(times.iter().map(|it| it[kind]).collect());
    let kinds = [("A*", of(0)), ("roadmap, its first question", first)];
    let kinds = kinds.into_iter().chain([("roadmap, in turn", of(1)), ("roadmap, again", of(2))]);
    for (name, [median, most]) in kinds {
        println!("  {name:32} {median:7.2} {most:7.2} ms");
    }
    println!("  {:32} {ratio:7.3} {most:7.3}", "its length over that of A*");
}

/// A mission that drives to places of the office, one after the other.
fn tour() -> Mission {
    let drive = |(number, to): (usize, &&str)| {
        format!("[[objective]]\nid = \"To{number}\"\ndoes = \"drive\"\nto = \"{to}\"\n")
    };
    let drives: String = PLACES.iter().enumerate().skip(1).map(drive).collect();
    let text = format!(
        "format = \"panorama-mission/2\"\nname = \"tour\"\nrobot = \"p3dx-delivery\"\n\
         floor = \"office\"\nfrom = \"{}\"\nlimits = {{ order = [\"duration\", \"energy\"], \
         duration_ms = 3_000_000, energy_mj = 90_000_000 }}\n{drives}",
        PLACES[0],
    );
    let asked = Asked::of(&text).unwrap();
    let office = OFFICE.floor().unwrap();
    let robot = RobotFile::shipped("p3dx-delivery").unwrap();
    let radius_m = robot.robot().body.as_ref().unwrap().radius.0 as f64 / 1_000.0;
    let needs = Needs { radius_m, ..Needs::default() };
    let way = Ground::Drawing(&office).way("office", OFFICE.text, asked, needs);
    Mission::parse_on("tour", &text, Some(robot), Some(&way)).unwrap()
}

fn path(course: &Course) -> Path {
    Path::new(course.track().corners().iter().map(|it| it.at).collect()).unwrap()
}

fn braking(of: &Drivetrain) -> Braking {
    Braking::new(Limits::of(of), of.footprint.radius(), 0.05, 0.1)
}

fn avoidance(course: &Course, rounds: usize) {
    const VIEW: f64 = 1.5 * PI;
    let (path, drivetrain) = (path(course), course.drivetrain());
    let mut window = DynamicWindow::new(braking(drivetrain), Weights::default(), 3);
    let mut fine = DynamicWindow::new(braking(drivetrain), Weights::default(), 10);
    let mut histogram = Histogram::new(braking(drivetrain), Thresholds::default());
    let now = Command { speed: SPEED, turn: 0.0 };
    let moments = (path.length() / 0.25) as u32;
    let mut times = vec![[f64::INFINITY; 3]; moments as usize];
    let mut points = 0;
    for (moment, times) in (0..moments).zip(&mut times) {
        let pose = path.pose(f64::from(moment) * 0.25);
        let angle = |at: u32| pose.rotation.angle() + VIEW * (f64::from(at) / 239.0 - 0.5);
        let rays: Vec<_> =
            (0..240).map(|it| Ray::at(pose.translation.vector.into(), angle(it))).collect();
        let mut ranges = vec![0.0; rays.len()];
        course.surface().distances(&rays, 5.6, Sense::Light, &mut ranges);
        let mut map = LocalMap::new(240, Millis(200));
        map.take_scan(&Pose::identity(), VIEW, &ranges);
        points += map.points().count();
        let target = path.pose((f64::from(moment) + 6.0) * 0.25).translation.vector;
        let target = pose.inverse() * Point::from(target);
        for _ in 0..rounds {
            shorten(&mut times[0], milliseconds(|| histogram.choose(&map, now, target, SPEED)).0);
            shorten(&mut times[1], milliseconds(|| window.choose(&map, now, target, SPEED)).0);
            shorten(&mut times[2], milliseconds(|| fine.choose(&map, now, target, SPEED)).0);
        }
    }
    println!("avoidance: {moments} moments, {} points each", points / moments as usize);
    let names = ["VFH+", "dynamic window, 7 x 7", "dynamic window, 21 x 21"];
    for (kind, name) in names.iter().enumerate() {
        let [median, most] = median(times.iter().map(|it| it[kind] * 1e3).collect());
        println!("  {name:32} {median:7.1} µs, at most {most:.0}");
    }
}

/// A robot's way along a course.
struct Driven {
    /// How far it was from its path, in metres, each 10 ms.
    errors: Vec<f64>,
    /// How often there had been no room for it.
    touches: usize,
    /// The time of a command, in µs.
    command: f64,
}

/// Drives to the end of a course, or for half an hour, over an empty floor.
fn follow(course: &Course, mut command: impl FnMut(&Vehicle) -> Command) -> Driven {
    let (path, drivetrain) = (path(course), course.drivetrain());
    let empty = Segments::new(course.surface().bounds(), &[], &[]).unwrap();
    let mut vehicle = Vehicle::new(course.track().start());
    let mut driven = Driven { errors: Vec::new(), touches: 0, command: 0.0 };
    let mut along = 0.0;
    while driven.errors.len() < 180_000 {
        let (time, told) = milliseconds(|| command(&vehicle));
        driven.command += time * 1e3;
        vehicle.step(drivetrain, &empty, told, 0.01);
        driven.touches +=
            usize::from(!course.surface().is_free(&drivetrain.footprint, vehicle.pose()));
        let at = Point::from(vehicle.pose().translation.vector);
        let place = path.project_between(at, along - 0.5, along + 0.5);
        along = place.along;
        driven.errors.push(place.aside.abs());
        if path.length() - along < 0.02 && vehicle.speeds().speed < 0.01 {
            break;
        }
    }
    driven.command /= driven.errors.len() as f64;
    driven
}

fn guidance(course: &Course) {
    let (path, drivetrain, track) = (path(course), course.drivetrain(), course.track());
    println!("guidance: {:.1} m, {} corners", path.length(), path.points().len() - 2);
    println!("  {:16}    most 95 of 100    mean     time  no room  a command", "across the path");
    let mut follower = Follower::new(Near { piece: 0, along: 0.0 });
    let pursuit = follow(course, |vehicle| {
        follower.see(track, vehicle.pose());
        let (pose, now) = (vehicle.pose(), vehicle.speeds());
        follower.command(track, pose, now, drivetrain, SPEED, track.length()).0
    });
    let mut guidance = Guidance::new(Law::default(), 0.0);
    let limits = Limits::of(drivetrain);
    let law =
        follow(course, |vehicle| guidance.command(&path, vehicle.pose(), SPEED, &limits, 0.01));
    for (name, Driven { mut errors, touches, command }) in [("pure pursuit", pursuit), ("law", law)]
    {
        let time = errors.len() as f64 * 0.01;
        let mean = 1e3 * errors.iter().sum::<f64>() / errors.len() as f64;
        let none = 100.0 * touches as f64 / errors.len() as f64;
        errors.sort_by(f64::total_cmp);
        let at = |part: usize| 1e3 * errors[part * (errors.len() - 1) / 100];
        println!(
            "  {name:16} {:4.0} mm {:6.0} mm {mean:4.1} mm {time:6.1} s {none:5.1} % \
             {command:8.2} µs",
            at(100),
            at(95),
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let brief = arguments.iter().any(|it| it == "--test");
    let is_wanted = |name: &str| {
        let mut names = arguments.iter().filter(|it| !it.starts_with('-')).peekable();
        names.peek().is_none() || names.any(|it| it == name)
    };
    let rounds = if brief { 1 } else { 11 };
    if is_wanted("ways") {
        let charted = OFFICE.floor().unwrap().surface(Version::Charted, &[]).unwrap();
        ways(&charted, rounds);
    }
    let course = Course::of(&tour(), 0).unwrap();
    if is_wanted("avoidance") {
        avoidance(&course, rounds);
    }
    if is_wanted("guidance") {
        guidance(&course);
    }
}
