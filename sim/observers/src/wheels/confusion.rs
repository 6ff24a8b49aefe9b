//! Faults of wheels against what is told of them, beside a test of residuals without models.

use super::bank::{Filter, READINGS};
use super::model::Period;
use super::simulated::{Course, Plant};
use super::*;
use crate::flag::Flag;
use crate::measured::Measured;

const SETTINGS: WheelSettings = WheelSettings::pioneer();

/// A false alarm in 1,000 s: so often that it can be measured.
fn often() -> WheelRates {
    WheelRates::rare(3.6).unwrap()
}

fn observer(rates: WheelRates) -> WheelObserver {
    WheelObserver::new(SETTINGS, rates).unwrap()
}

type Watch = Box<dyn FnMut(&Wheels) -> Flag>;

/// Counts the false alarms of a watch on a sound robot, which begins anew after each.
fn false_alarms(
    mut plant: Plant,
    promised: f64,
    periods: u64,
    new: &dyn Fn() -> Watch,
) -> Measured {
    let (mut course, mut watch, mut measured) = (Course::new(5), new(), Measured::of(promised));
    for _ in 0..periods {
        let flag = watch(&plant.step(course.step()));
        measured.decision(flag);
        if flag == Flag::Raised {
            watch = new();
        }
    }
    measured
}

fn sound() -> Plant {
    Plant::new(SETTINGS, 5, "sound")
}

fn by_models(rates: WheelRates) -> Watch {
    let mut observer = observer(rates);
    Box::new(move |it| observer.judge(it))
}

/// Cumulated sums on the innovations of the nominal filter, both ways (Page, Biometrika 41, 1954),
/// each with an equal share of the rate. The level is that of Siegmund's approximation of the mean
/// time to a false alarm (Sequential Analysis, Springer 1985): (exp(2kb) - 2kb - 1) / 2k², with
/// b = h + 1.166 and k = 0.5.
fn by_sums(rates: WheelRates) -> Watch {
    let charts = 2.0 * READINGS as f64;
    let mean_time = charts / rates.false_alarms.per_decision(rates.period);
    let mut h = 1.0_f64;
    while 2.0 * (libm::exp(h + 1.166) - (h + 1.166) - 1.0) < mean_time {
        h += 0.001;
    }
    let mut filter = Filter::new();
    let mut sums = [[0.0_f64; 2]; READINGS];
    Box::new(move |wheels| {
        let period = Period::of(&SETTINGS, wheels);
        let (_, innovations) = filter.step(Mode::Nominal, &SETTINGS, &period, wheels);
        let mut is_high = false;
        for (sums, innovation) in sums.iter_mut().zip(innovations) {
            sums[0] = (sums[0] + innovation - 0.5).max(0.0);
            sums[1] = (sums[1] - innovation - 0.5).max(0.0);
            is_high |= sums[0] > h || sums[1] > h;
        }
        Flag::raised_if(is_high)
    })
}

/// Filters that do not exchange their states (Magill, IEEE Transactions on Automatic Control 10(4),
/// 1965), with the same models, chances and level.
fn by_separate(rates: WheelRates) -> impl FnMut(&Wheels) -> (Flag, Option<Mode>) {
    let chance = rates.false_alarms.per_decision(rates.period);
    let breaks = rates.faults_per_hour * rates.period.0 as f64 / 3_600_000.0;
    let hold = crate::promise::in_a_row(SETTINGS.outliers, chance);
    let (mut bank, mut in_a_row) = (Bank::new(SETTINGS, breaks, 0.02), 0);
    move |wheels| {
        bank.weigh(wheels);
        let [sound, faults @ ..] = bank.probabilities();
        in_a_row = if 1.0 - sound >= breaks / chance * sound { in_a_row + 1 } else { 0 };
        let most = (1..MODES.len()).max_by(|a, b| faults[a - 1].total_cmp(&faults[b - 1])).unwrap();
        let is_raised = in_a_row >= hold;
        let is_sure = is_raised && faults[most - 1] >= (1.0 - rates.wrong) * (1.0 - sound);
        (Flag::raised_if(is_raised), is_sure.then_some(MODES[most]))
    }
}

#[test]
fn sound_wheels_alarm_no_more_often_than_promised() {
    let rates = WheelRates::rare(360.0).unwrap();
    let promised = rates.false_alarms.per_decision(rates.period);
    let measured = false_alarms(sound(), promised, 50_000, &|| by_models(rates));
    measured.is_at_most_promised("wheels");
}

/// An outlier of an encoder in 1,000 periods, of which most stand far out.
#[test]
fn outliers_are_no_faults() {
    let rates = often();
    let promised = rates.false_alarms.per_decision(rates.period);
    let mut plant = sound();
    plant.outliers = 1e-3;
    false_alarms(plant, promised, 60_000, &|| by_models(rates)).is_at_most_promised("outliers");
}

#[test]
fn each_fault_of_wheels_is_told_by_its_name_within_a_second() {
    for fault in MODES.into_iter().skip(1) {
        for (name, speeds) in MOTIONS.into_iter().skip(1) {
            let mut plant = Plant::new(SETTINGS, 11, "named");
            plant.size = 0.3;
            let mut observer = observer(WheelRates::rare(0.036).unwrap());
            for period in 0..60 {
                plant.fault = if period < 50 { Mode::Nominal } else { fault };
                observer.judge(&plant.step(speeds));
                assert!(period >= 50 || observer.diagnosis().is_none(), "{fault:?} {name}");
            }
            assert_eq!(observer.diagnosis().map(|it| it.mode), Some(fault), "{name}");
        }
    }
}

/// Prints false alarms at other rates, of other tests, with outliers, of wheels that are others.
#[test]
#[ignore = "prints tables; takes a minute"]
fn false_alarms_are_printed() {
    for per_hour in [3_600.0, 360.0] {
        let rates = WheelRates::rare(per_hour).unwrap();
        let promised = rates.false_alarms.per_decision(rates.period);
        let count = |new: &dyn Fn() -> Watch| false_alarms(sound(), promised, 300_000, new);
        count(&|| by_models(rates)).tell("models");
        count(&|| by_sums(rates)).tell("sums");
        count(&|| {
            let mut it = by_separate(rates);
            Box::new(move |wheels| it(wheels).0)
        })
        .tell("separate");
    }
    let rates = often();
    let promised = rates.false_alarms.per_decision(rates.period);
    let mut all = vec![];
    let mut other = |name: &'static str, settings, outliers| {
        let mut plant = Plant::new(settings, 5, "sound");
        plant.outliers = outliers;
        all.push((name, plant));
    };
    other("as assumed", SETTINGS, 0.0);
    other("outliers", SETTINGS, 1e-3);
    other("friction + 20 %", WheelSettings { viscous: 0.036, dry: 0.12, ..SETTINGS }, 0.0);
    other("lag + 20 %", WheelSettings { lag_s: 0.18, ..SETTINGS }, 0.0);
    other("lag - 20 %", WheelSettings { lag_s: 0.12, ..SETTINGS }, 0.0);
    other("tyres 2 %", WheelSettings { turn: SETTINGS.turn * 1.02, ..SETTINGS }, 0.0);
    for (name, plant) in all {
        let again = || plant.clone();
        false_alarms(again(), promised, 300_000, &|| by_models(rates)).tell(name);
        false_alarms(again(), promised, 300_000, &|| by_sums(rates)).tell(&format!("{name}, sums"));
    }
}

/// Outcomes of a fault over runs.
#[derive(Default)]
struct Row {
    /// Counts of the modes that were told; the last is none.
    told: [u32; MODES.len() + 1],
    delays: Vec<u32>,
    sums: Vec<u32>,
    separate: Vec<u32>,
    /// Count of right faults of filters that do not exchange.
    separate_right: u32,
    /// Periods before the fault in which models, sums, and filters apart raised their flags.
    early: [u32; 3],
}

const RUNS: u64 = 100;
/// Periods before a fault, and of it.
const BEFORE: u32 = 50;
const AFTER: u32 = 50;

fn run(row: &mut Row, seed: u64, fault: Mode, speeds: [f64; 2], rates: WheelRates) {
    let mut luck = cotama_devices::Streams::new(seed).stream("size");
    let mut plant = Plant::new(another(&mut luck), seed, "fault");
    let (low, high) = match fault {
        Mode::EncoderLossy(_) => (0.05, 0.3),
        Mode::MotorWeak(_) => (0.2, 0.5),
        _ => (0.3, 0.8),
    };
    plant.size = low + (high - low) * luck.part();
    let (mut observer, mut sums) = (observer(rates), by_sums(rates));
    let mut separate = by_separate(rates);
    let (mut raised, mut told, mut summed, mut alone) = (None, None, None, None);
    let mut alone_told = None;
    for period in 0..BEFORE + AFTER {
        plant.fault = if period < BEFORE { Mode::Nominal } else { fault };
        let part = (f64::from(period) / 10.0).min(1.0);
        let wheels = plant.step(speeds.map(|it| it * part));
        let (flag, mode) = separate(&wheels);
        let flags = [observer.judge(&wheels), sums(&wheels), flag];
        if period < BEFORE {
            row.early.iter_mut().zip(flags).for_each(|it| *it.0 += u32::from(it.1 == Flag::Raised));
            continue;
        }
        let after = period - BEFORE + 1;
        let [by_models, by_sums, by_separate] =
            flags.map(|it| (it == Flag::Raised).then_some(after));
        alone = alone.or(by_separate);
        alone_told = alone_told.or(mode);
        raised = raised.or(by_models);
        summed = summed.or(by_sums);
        told = told.or(observer.diagnosis().map(|it| it.mode));
    }
    let place = told.and_then(|it| MODES.iter().position(|mode| *mode == it));
    row.told[place.unwrap_or(MODES.len())] += 1;
    row.separate_right += u32::from(alone_told == Some(fault));
    row.separate.extend(alone);
    row.delays.extend(raised);
    row.sums.extend(summed);
}

/// A robot that is not quite as its filters take it to be: friction, lag and currents are up to a
/// tenth more or less.
fn another(luck: &mut cotama_devices::Stream) -> WheelSettings {
    let mut about = |it: f64| it * (0.9 + 0.2 * luck.part());
    WheelSettings {
        lag_s: about(SETTINGS.lag_s),
        viscous: about(SETTINGS.viscous),
        dry: about(SETTINGS.dry),
        acceleration: about(SETTINGS.acceleration),
        stalled: about(SETTINGS.stalled),
        ..SETTINGS
    }
}

/// Motions: a name, and the speeds of the wheels in rad/s.
const MOTIONS: [(&str, [f64; 2]); 4] = [
    ("0.1 m/s", [1.03, 1.03]),
    ("0.2 m/s", [2.05, 2.05]),
    ("0.3 m/s", [3.08, 3.08]),
    ("turn", [1.23, 2.87]),
];

fn row(fault: Mode, speeds: [f64; 2]) -> Row {
    let mut row = Row::default();
    let rates = WheelRates::rare(0.036).unwrap();
    (0..RUNS).for_each(|seed| run(&mut row, seed, fault, speeds, rates));
    row.delays.sort_unstable();
    row.sums.sort_unstable();
    row.separate.sort_unstable();
    row
}

fn median(of: &[u32]) -> String {
    of.get(of.len() / 2).map_or("-".to_owned(), |it| format!("{:.1} s", f64::from(*it) / 10.0))
}

/// Why filters exchange their states: apart, the nominal one has to find its speed again first.
#[test]
fn filters_that_exchange_see_sooner_that_a_blocked_wheel_turns_again() {
    let rates = WheelRates::rare(0.036).unwrap();
    let mut lasts = [vec![], vec![]];
    for seed in 0..21 {
        let mut plant = Plant::new(SETTINGS, seed, "recovers");
        let (mut one, mut other) = (observer(rates), by_separate(rates));
        let mut last = [0, 0];
        for period in 0..150_u32 {
            let is_blocked = (50..100).contains(&period);
            plant.fault = if is_blocked { Mode::Blocked(Side::Left) } else { Mode::Nominal };
            let wheels = plant.step([2.05; 2]);
            let flags = [one.judge(&wheels), other(&wheels).0];
            for (last, flag) in last.iter_mut().zip(flags) {
                *last = if flag == Flag::Raised { period + 1 } else { *last };
            }
        }
        lasts.iter_mut().zip(last).for_each(|(all, it)| all.push(it));
    }
    lasts.iter_mut().for_each(|it| it.sort_unstable());
    assert_eq!(lasts.map(|it| median(&it)), ["10.0 s", "10.3 s"]);
}

/// Prints the tables of the documentation: which fault was told of 400 runs each, and how often and
/// how soon in each motion, beside cumulated sums.
#[test]
#[ignore = "prints tables; takes a minute"]
fn confusion_is_printed() {
    let short = |it: Mode| format!("{it:?}").replace("Left", "L").replace("Right", "R");
    let mut matrix = [[0; MODES.len() + 1]; MODES.len()];
    let mut early = [0; 3];
    for (at, fault) in MODES.into_iter().enumerate() {
        let [mut models, mut sums, mut separate] = [const { String::new() }; 3];
        for (_, speeds) in MOTIONS {
            let row = row(fault, speeds);
            models += &format!(" {}, {} |", row.told[at], median(&row.delays));
            sums += &format!(" {}, {} |", row.sums.len(), median(&row.sums));
            separate += &format!(" {}, {} |", row.separate_right, median(&row.separate));
            early.iter_mut().zip(row.early).for_each(|(all, one)| *all += one);
            matrix[at].iter_mut().zip(row.told).for_each(|(all, one)| *all += one);
        }
        let name = short(fault);
        println!("| {name} |{models}\n| - sums |{sums}\n| - separate |{separate}");
    }
    for (row, mode) in matrix.iter().zip(MODES) {
        let cells: Vec<_> =
            row.iter().map(|it| if *it == 0 { String::new() } else { it.to_string() }).collect();
        println!("| {} | {} |", short(mode), cells.join(" | "));
    }
    let all = BEFORE as u64 * RUNS * (MOTIONS.len() * MODES.len()) as u64;
    println!("| early | {early:?} of {all} |");
}
