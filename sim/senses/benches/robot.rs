//! How many times faster than real time a whole robot runs, and what its modules take of that.
//!
//! A Pioneer 3-DX drives from place to place of the office, with two lasers of 240 rays and 16
//! sonars at 10 Hz, Monte Carlo localisation with 500 particles, and observers of its signals.
//! `cargo bench -p cotama-senses --bench robot`; with `--test` it runs briefly. Localisation takes
//! a reading by Nav2's numbers (60 beams, each 0.25 m or 0.2 rad), and then 240 beams of each scan.
//!
//! The ratio is the median of the rounds, by the time on the processor where Linux tells it, else
//! by the clock. In the table each moment of a module is the shortest of the rounds, so that what
//! runs beside does not count; the sum of them is a little less than a median round.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss, clippy::cast_sign_loss)]

use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_devices::{Laser, LaserSettings, Rate, Ring, RingSettings, Scene, Sensed, Streams};
use cotama_floor::embedded::OFFICE;
use cotama_floor::{Ground, Needs, Pose};
use cotama_localisation::{Chart, Localiser, Parameters, Sensor};
use cotama_models::missions::{Asked, Mission};
use cotama_models::robots::RobotFile;
use cotama_observers::{
    Age, Apart, Battery, Blame, Coherence, Convergence, Deadlines, FalseAlarms, FarSonars,
    Interval, Item, Job, Module, Motion, Needs as Needing, Observer, OdometryErrors, OnPath, Port,
    Poses, Progress, Signals, SonarSurvey, Spread, Stall, Status, StatusVector, Supply, Tail,
    Value, Watch, WheelObserver, WheelRates, WheelSettings, Wheels, round,
};
use cotama_plane::{Course, Rover};
use nalgebra::Matrix3;
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

const PERIOD: Millis = Millis(100);
const SECONDS: f64 = 0.1;
const RAYS: usize = 240;
const PLACES: [&str; 6] = ["dock", "office A", "lab", "kitchen", "lounge", "corridor east"];
const MODULES: [&str; 5] = ["physics", "lasers", "sonars", "localisation", "observers"];

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
    let way = Ground::Drawing(&office).way(
        "office",
        OFFICE.text,
        asked,
        Needs { radius_m, ..Needs::default() },
    );
    Mission::parse_on("tour", &text, Some(robot), Some(&way)).unwrap()
}

fn scanner(turned: f64) -> LaserSettings {
    let rate = Rate { period: PERIOD, latency: Millis(0) };
    let mount = Pose::new([0.0, 0.0].into(), turned);
    LaserSettings { mount, rate, ..LaserSettings::hokuyo_urg(RAYS) }
}

fn observers() -> Vec<Box<dyn Observer>> {
    let promise = FalseAlarms::per_hour(0.01).unwrap();
    let rate = Rate { period: PERIOD, latency: Millis(20) };
    let mut all: Vec<Box<dyn Observer>> = vec![];
    for at in 0..20 {
        let age = Age::new(rate, Millis(10), 0.01, promise).unwrap();
        all.push(Box::new(Port(at, age)));
        let late = Deadlines::new(PERIOD, 0.01, promise).unwrap();
        all.push(Box::new(Module(at, late)));
        let within = Interval::new([0.0, 1.0], 0.1, PERIOD, promise).unwrap();
        all.push(Box::new(Value(at, within)));
    }
    let mut survey = SonarSurvey::new(5.0, 1.0).unwrap();
    survey.look(&[None; 16], 0.0, Millis(3_600_000));
    let errors = OdometryErrors::pioneer();
    let tail = Tail::new(2.0, 6.0, 1.5).unwrap();
    let times = [PERIOD, Millis(1_000)];
    let rates = WheelRates::rare(0.01).unwrap();
    all.push(Box::new(FarSonars::new(&survey, 16, promise).unwrap()));
    all.push(Box::new(Apart::new(errors, Millis(5_000), promise).unwrap()));
    all.push(Box::new(Apart::new(errors, PERIOD, promise).unwrap()));
    all.push(Box::new(Spread::new([0.1, 0.1], 500, PERIOD, promise).unwrap()));
    all.push(Box::new(Progress::new(tail, 0.1, promise).unwrap()));
    all.push(Box::new(Convergence::new(Millis(2_000), Millis(4_000), 0.02, promise).unwrap()));
    all.push(Box::new(Coherence::new([0.3, 1.7], [0.02, 0.05], times, promise).unwrap()));
    all.push(Box::new(Battery::new(11.5, 0.05, PERIOD, promise).unwrap()));
    all.push(Box::new(Stall::new(PERIOD, 0.01, promise).unwrap()));
    all.push(Box::new(WheelObserver::new(WheelSettings::pioneer(), rates).unwrap()));
    all
}

/// The end of a trip: the pose there, and how often the robot was located.
struct End {
    periods: usize,
    updates: usize,
    off: f64,
}

/// Drives the course to its end; `lap` is told a module when it has done its part of a period.
fn drive(course: &Course, chart: &Chart, periods: usize, mut lap: impl FnMut(usize)) -> End {
    let streams = Streams::new(1);
    let mut rover = Rover::new(course, 1);
    let goal = Millimetres((1_000.0 * course.track().length()) as u64);
    let [mut front, mut back] = [("front", 0.0), ("back", PI)]
        .map(|it| Laser::new(&scanner(it.1), &streams, it.0).unwrap());
    let settings = RingSettings::pioneer().all_at_once(PERIOD);
    let mut ring = Ring::new(&settings, &streams, "sonar").unwrap();
    let mut localiser = Localiser::new(chart, &streams, "robot");
    let spread = Matrix3::from_diagonal(&[0.04, 0.04, 0.01].into());
    localiser.start_at(rover.pose(), &spread).unwrap();
    let mut observers = observers();
    let item = Item::new(0).unwrap();
    let blames = [Blame { flags: 1, item, raised: Status::Lost, missing: Status::Suspect }];
    let pairs = (1..20).filter_map(|it| Item::new(it).zip(Item::new(it - 1)));
    let mut vector = StatusVector::new(Needing::of(pairs));
    let mut watches: Vec<_> =
        observers.iter_mut().map(|it| Watch { observer: it.as_mut(), blames: &blames }).collect();
    let mut end = End { periods: 0, updates: 0, off: 0.0 };
    lap(MODULES.len());
    while rover.x() < goal && end.periods < periods {
        rover.go(MillimetresPerSecond(300), goal, PERIOD);
        lap(0);
        let now = rover.now();
        let scene = Scene::of(course.surface(), &[]);
        front.sense(now, rover.pose(), &scene);
        back.sense(now, rover.pose(), &scene);
        lap(1);
        ring.sense(now, rover.pose(), &scene);
        lap(2);
        if let Some(scan) = front.latest(now) {
            end.updates += usize::from(localiser.update(rover.odometry(), scan.value));
        }
        let located = localiser.pose_at(rover.odometry());
        lap(3);
        let sent = rover.signals();
        let speeds = rover.vehicle().speeds();
        let wheels = Wheels {
            dt: SECONDS,
            commanded: sent.commanded,
            encoder: sent.commanded,
            current: sent.motors.map_or([0.19; 2], |it| it.current_a),
            gyro: Some(speeds.turn),
        };
        let poses = Poses {
            odometry: *rover.odometry(),
            located,
            covariance: localiser.estimate().covariance,
        };
        let told = [speeds.speed, speeds.turn];
        let volts = sent.battery.map_or(12.1, |it| it.voltage_v);
        let signals = Signals {
            jobs: &[Some(Job::Kept); 20],
            taken: &[Some(now); 20],
            values: &[Some(0.5); 20],
            sonars: ring.latest(now).unwrap_or(&[]),
            way_m: Some(rover.along()),
            wheels: Some(Sensed { taken: now, value: wheels }),
            motion: Some(Sensed { taken: now, value: Motion { told, measured: told } }),
            supply: Some(Sensed { taken: now, value: Supply { volts, amperes: 2.0 } }),
            stalled: Some(Sensed { taken: now, value: [false; 2] }),
            poses: Some(Sensed { taken: now, value: poses }),
            place: Some(Sensed {
                taken: now,
                value: OnPath { along_m: rover.along(), lateral_m: 0.0 },
            }),
            is_told_to_move: true,
            ..Signals::default()
        };
        black_box(round(&mut watches, now, &signals, &mut vector));
        lap(4);
        end.periods += 1;
        end.off = (located.translation.vector - rover.pose().translation.vector).norm();
    }
    end
}

/// Returns the seconds that the program has been on a processor.
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|it| it / 1e9)
}

fn measure(name: &str, course: &Course, parameters: &Parameters, brief: bool) {
    let view = LaserSettings::hokuyo_urg(RAYS);
    let sensor = Sensor::laser(&view.mount, view.view_rad, RAYS, view.range_m).unwrap();
    let chart = Chart::new(course.charted(), 0.05, &sensor, parameters).unwrap();
    let (rounds, periods) = if brief { (1, 20) } else { (11, usize::MAX) };
    let mut ratios = [Vec::new(), Vec::new()];
    let mut end = drive(course, &chart, periods, |_| ());
    let simulated = end.periods as f64 * SECONDS;
    for _ in 0..rounds {
        let (start, before) = (Instant::now(), on_processor());
        end = drive(course, &chart, periods, |_| ());
        ratios[0].push(simulated / start.elapsed().as_secs_f64());
        let used = on_processor().zip(before).map(|(now, before)| now - before);
        ratios[1].extend(used.map(|it| simulated / it));
    }
    println!("{name}: {simulated:.0} s, {} updates, {:.3} m off at the end", end.updates, end.off);
    for (kind, ratios) in ["by the clock", "on the processor"].iter().zip(&mut ratios) {
        ratios.sort_by(f64::total_cmp);
        let at = |part: usize| {
            ratios.get(part * ratios.len().saturating_sub(1) / 2).unwrap_or(&f64::NAN)
        };
        let [least, median, most] = [0, 1, 2].map(at);
        println!("  {median:6.0} x real time {kind}, from {least:.0} to {most:.0}");
    }
    let mut shortest = vec![f64::INFINITY; end.periods * MODULES.len()];
    for _ in 0..rounds {
        let (mut last, mut places) = (Instant::now(), 0..shortest.len());
        drive(course, &chart, periods, |module| {
            let taken = last.elapsed().as_secs_f64();
            // The first lap is before all periods.
            if let Some(place) = (module < MODULES.len()).then(|| places.next()).flatten() {
                shortest[place] = shortest[place].min(taken);
            }
            last = Instant::now();
        });
    }
    let of = |module: usize| shortest.iter().skip(module).step_by(MODULES.len()).sum::<f64>();
    let all: f64 = (0..MODULES.len()).map(of).sum();
    println!("  module            µs a period   part");
    for (at, module) in MODULES.iter().enumerate() {
        let time = of(at);
        let each = time / end.periods as f64 * 1e6;
        println!("  {module:16} {each:12.2} {:5.0} %", 100.0 * time / all);
    }
    println!(
        "  {:16} {:12.2}         {:.0} x",
        "all",
        all / end.periods as f64 * 1e6,
        simulated / all
    );
}

fn main() {
    let brief = std::env::args().any(|it| it == "--test");
    let course = Course::of(&tour(), 0).unwrap();
    let particles = Parameters { min_particles: 500, max_particles: 500, ..Parameters::default() };
    measure("60 beams at Nav2's rate", &course, &particles, brief);
    let each = Parameters { max_beams: RAYS, update_min_d: 0.0, update_min_a: 0.0, ..particles };
    measure("240 beams of each scan", &course, &each, brief);
}
