//! Time of the observers of a robot for one period, in nanoseconds.
//!
//! `cargo bench -p cotama-observers`; with `--test` it runs briefly. Each is the median of 11
//! rounds, by the time on the processor where Linux tells it, else by the clock.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Rate, Sensed};
use cotama_observers::{
    Age, Apart, Backward, Battery, Blame, Braking, Bumper, Coherence, Contact, Convergence,
    Deadlines, FalseAlarms, FarSonars, Interval, Item, Job, LinkLevel, Module, Motion, Needs,
    Observer, OdometryErrors, OnPath, Port, Poses, Progress, Signals, SonarSurvey, Spread, Stall,
    Status, StatusVector, Supply, Tail, Value, Watch, WheelObserver, WheelRates, WheelSettings,
    Wheels, round,
};
use nalgebra::{Isometry2, Matrix3, Vector2};
use std::hint::black_box;
use std::time::Instant;

const PERIOD: Millis = Millis(100);

fn observers() -> Vec<(&'static str, Box<dyn Observer>)> {
    let promise = FalseAlarms::per_hour(0.01).unwrap();
    let rate = Rate { period: PERIOD, latency: Millis(20) };
    let mut all: Vec<(&'static str, Box<dyn Observer>)> = vec![];
    for at in 0..20 {
        let age = Age::new(rate, Millis(10), 0.01, promise).unwrap();
        all.push(("20 ports", Box::new(Port(at, age))));
        let late = Deadlines::new(PERIOD, 0.01, promise).unwrap();
        all.push(("20 modules", Box::new(Module(at, late))));
        let within = Interval::new([0.0, 1.0], 0.1, PERIOD, promise).unwrap();
        all.push(("20 values", Box::new(Value(at, within))));
    }
    let mut survey = SonarSurvey::new(5.0, 1.0).unwrap();
    survey.look(&[None; 16], 0.0, Millis(3_600_000));
    all.push(("16 sonars", Box::new(FarSonars::new(&survey, 16, promise).unwrap())));
    let errors = OdometryErrors::pioneer();
    let times = [PERIOD, Millis(1_000)];
    let tail = Tail::new(2.0, 6.0, 1.5).unwrap();
    let grows = Apart::new(errors, Millis(5_000), promise).unwrap();
    all.push(("growth", Box::new(grows)));
    all.push(("jump", Box::new(Apart::new(errors, PERIOD, promise).unwrap())));
    all.push(("spread", Box::new(Spread::new([0.1, 0.1], 500, PERIOD, promise).unwrap())));
    all.push(("backward", Box::new(Backward::new(tail, 0.02, PERIOD, promise).unwrap())));
    all.push(("progress", Box::new(Progress::new(tail, 0.1, promise).unwrap())));
    let converges = Convergence::new(Millis(2_000), Millis(4_000), 0.02, promise).unwrap();
    all.push(("convergence", Box::new(converges)));
    let coherent = Coherence::new([0.3, 1.7], [0.02, 0.05], times, promise).unwrap();
    all.push(("coherence", Box::new(coherent)));
    let link = [Millis(500), Millis(20_000)];
    all.push(("link", Box::new(LinkLevel::new(-80.0, 2.0, 20, link, promise).unwrap())));
    let braking = Braking { speed: 0.3, deceleration: 0.3, latency: 0.1, deviation: 0.002 };
    all.push(("bumper", Box::new(Bumper::new(tail, 0.3, braking, PERIOD, promise).unwrap())));
    all.push(("battery", Box::new(Battery::new(11.5, 0.05, PERIOD, promise).unwrap())));
    all.push(("stall", Box::new(Stall::new(PERIOD, 0.01, promise).unwrap())));
    let rates = WheelRates::rare(0.01).unwrap();
    all.push(("wheels", Box::new(WheelObserver::new(WheelSettings::pioneer(), rates).unwrap())));
    all
}

/// Runs some observers over periods in which all signals come; returns what is lost at the end.
fn run(of: &mut [(&'static str, Box<dyn Observer>)], periods: u64) -> usize {
    let item = Item::new(0).unwrap();
    let blames = [Blame { flags: 1, item, raised: Status::Lost, missing: Status::Suspect }];
    let pairs = (1..20).filter_map(|it| Item::new(it).zip(Item::new(it - 1)));
    let mut vector = StatusVector::new(Needs::of(pairs));
    let mut watches: Vec<_> =
        of.iter_mut().map(|it| Watch { observer: it.1.as_mut(), blames: &blames }).collect();
    let mut events = 0;
    for period in 1..=periods {
        let now = Millis(period * PERIOD.0);
        let way = 0.03 * period as f64;
        let error = if period % 2 == 0 { 0.01 } else { -0.01 };
        let sonars: [_; 16] = core::array::from_fn(|at| {
            let value = if at < 4 && period % 40 > 20 { 5.0 } else { 1.0 + error };
            Some(Sensed { taken: now, value })
        });
        let pose = |error: f64| Isometry2::new(Vector2::new(way + error, 0.0), error / 2.0);
        let wheels = Wheels {
            dt: 0.1,
            commanded: [3.08; 2],
            encoder: [3.08 + error, 3.08 - error],
            current: [0.19 + error, 0.19],
            gyro: Some(error),
        };
        let poses = Poses {
            odometry: pose(0.0),
            located: pose(error),
            covariance: Matrix3::identity() * 4e-4,
        };
        let place = OnPath { along_m: way, lateral_m: error };
        let motion = Motion { told: [0.3, 0.0], measured: [0.3 + error, error] };
        let contact = Contact { pressed: 0, way_m: way, free_m: Some(1.0) };
        let signals = Signals {
            jobs: &[Some(Job::Kept); 20],
            taken: &[Some(now); 20],
            values: &[Some(0.5); 20],
            sonars: &sonars,
            way_m: Some(way),
            wheels: Some(Sensed { taken: now, value: wheels }),
            motion: Some(Sensed { taken: now, value: motion }),
            contact: Some(Sensed { taken: now, value: contact }),
            supply: Some(Sensed { taken: now, value: Supply { volts: 12.1, amperes: 2.0 } }),
            stalled: Some(Sensed { taken: now, value: [false; 2] }),
            poses: Some(Sensed { taken: now, value: poses }),
            place: Some(Sensed { taken: now, value: place }),
            is_told_to_move: true,
            level_dbm: Some(Sensed { taken: now, value: -60.0 + error }),
            ..Signals::default()
        };
        let event = round(&mut watches, now, black_box(&signals), &mut vector);
        events += usize::from(black_box(event).is_some());
    }
    events
}

/// Returns the seconds that the program has been on a processor.
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|it| it / 1e9)
}

fn measure(name: &str, is_wanted: impl Fn(&str) -> bool, periods: u64, rounds: usize) {
    let mut times = vec![];
    for _ in 0..rounds {
        let mut some: Vec<_> = observers().into_iter().filter(|it| is_wanted(it.0)).collect();
        let (start, before) = (Instant::now(), on_processor());
        assert_eq!(run(&mut some, periods), 0, "sound signals change nothing");
        let used = on_processor().zip(before).map(|(now, before)| now - before);
        times.push(used.unwrap_or(start.elapsed().as_secs_f64()) * 1e9 / periods as f64);
    }
    times.sort_by(f64::total_cmp);
    let at = |part: usize| times.get(part * (rounds - 1) / 2).unwrap_or(&f64::NAN);
    let [least, median, most] = [0, 1, 2].map(at);
    println!("{name:12} {median:7.0} ns a period, from {least:.0} to {most:.0}");
}

fn main() {
    let is_brief = std::env::args().any(|it| it == "--test");
    let (periods, rounds) = if is_brief { (100, 1) } else { (100_000, 11) };
    measure("signals", |_| false, periods, rounds);
    let mut names: Vec<_> = observers().iter().map(|it| it.0).collect();
    names.sort_unstable();
    names.dedup();
    for name in names {
        measure(name, |it| it == name, periods, rounds);
    }
    measure("all", |_| true, periods, rounds);
}
