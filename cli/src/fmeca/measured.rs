//! `cotama fmeca --measure`: how the signals of a robot in the plane detect its failures.

use crate::answers::fmeca::{MeasureAnswer, MeasureRow, RateRow, TakenRow};
use crate::args::FmecaArgs;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::names::quoted;
use crate::output::{self, Screen};
use crate::progress::Line;
use crate::render;
use crate::render::style::NAME;
use cotama_campaign::statistics::clopper_pearson;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::fmeca::measured_rank;
use cotama_models::missions::Mission;
use cotama_models::robots::{Detection, Measurement, Moment, Robot};
use cotama_sim::options::{Fidelity, Options};
use cotama_sim::robots::{Driven, WINDOW};
use std::collections::BTreeMap;
use std::time::Instant;

/// How often an interval of a rate holds the truth, at least.
const CONFIDENCE: f64 = 0.95;

/// Measures each failure that harms a device, and prints the table, or writes the measurement.
pub(crate) fn measure(name: &str, args: &FmecaArgs, screen: &Screen) -> Result<Exit, Failure> {
    args.output.as_deref().map_or(Ok(()), output::place)?;
    let mission = mission::load(name, Some(screen))?;
    let plain = || {
        Failure::of(name, "the mission names no robot, whose failures could be detected")
            .help("add `robot = \"p3dx-delivery\"`, or measure `delivery`")
    };
    let robot = mission.robot().ok_or_else(plain)?.robot();
    let measurement = measured(name, &mission, robot, args.seeds)?;
    if let Some(path) = &args.output {
        let origin =
            format!("cotama fmeca --measure {} --seeds {}", quoted(name), measurement.seeds);
        output::file(path, measurement.to_toml(robot, &origin).as_bytes())?;
    }
    shown(robot, &measurement, args, screen)?;
    if let Some(path) = &args.output {
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    }
    Ok(Exit::Success)
}

/// Shows how failures were detected.
pub(super) fn shown(
    robot: &Robot,
    measurement: &Measurement,
    args: &FmecaArgs,
    screen: &Screen,
) -> Result<(), Failure> {
    let answer = answer(robot, measurement);
    if args.json.json {
        return Screen::json(&answer);
    }
    screen.print(&render::measured::screen(&answer, screen.width()))
}

fn measured(
    name: &str,
    mission: &Mission,
    robot: &Robot,
    seeds: u64,
) -> Result<Measurement, Failure> {
    let options = Options { fidelity: Fidelity::Signal, ..Options::default() };
    let driven = Driven::with(mission, &options).map_err(|it| Failure::of(name, it.to_string()))?;
    // In the middle of the first drive: the robot goes on for a while, and turns nowhere.
    let drive = mission.objectives.iter().find(|it| it.travels());
    let x = Millimetres(drive.map_or(0, |it| u64::midpoint(it.x_start.0, it.x_end.0)));
    let (line, begun) = (Line::new(), Instant::now());
    let mut rows = BTreeMap::new();
    let sensed = robot.failures.iter().enumerate().filter(|it| it.1.harm.is_some());
    let count = sensed.clone().count();
    for (number, (failure, row)) in sensed.enumerate() {
        line.write(begun, |_| format!("{} of {count}: {}", number + 1, row.id));
        let detection = driven.measure(failure, Moment::Place(x), 0..seeds);
        let detection = detection.map_err(|why| Failure::of(name, why.text(mission)))?;
        rows.insert(failure, detection);
    }
    line.clear();
    let (robot, mission) = (robot.name.clone(), mission.name.clone());
    Ok(Measurement { robot, mission, seeds, x, window: WINDOW, rows })
}

fn answer(robot: &Robot, it: &Measurement) -> MeasureAnswer {
    let told = robot.failures.iter().filter(|it| it.harm.is_none() && !it.no_plan);
    MeasureAnswer {
        schema: "cotama/measure/1",
        mission: it.mission.clone(),
        robot: it.robot.clone(),
        seeds: it.seeds,
        x_mm: it.x.0,
        window_ms: it.window.0,
        rows: it.rows.iter().map(|(failure, it)| row(robot, *failure, it)).collect(),
        told: told.map(|it| it.id.clone()).collect(),
    }
}

/// The detection of a failure as a row.
fn row(robot: &Robot, failure: usize, it: &Detection) -> MeasureRow {
    let id = |at: &usize| robot.failures.get(*at).map_or_else(String::new, |it| it.id.clone());
    let row = robot.failures.get(failure);
    let assumed = row.map_or(Millis(0), |it| it.latency);
    let taken = it.taken_for.iter().map(|(all, delays)| TakenRow {
        rows: all.iter().map(id).collect(),
        runs: delays.len() as u64,
    });
    let mut taken: Vec<_> = taken.collect();
    taken.sort_by_key(|it| std::cmp::Reverse(it.runs));
    let named = it.named(failure);
    let why = why(robot, failure, it, assumed);
    MeasureRow {
        id: id(&failure),
        failure: row.map_or_else(String::new, |it| it.mode.clone()),
        runs: it.runs,
        found: it.found(),
        found_rate: rate(it.found(), it.runs),
        named,
        named_rate: rate(named, it.runs),
        median_ms: it.median().map(|it| it.0),
        worst_ms: it.worst().map(|it| it.0),
        assumed_ms: assumed.0,
        detection: measured_rank(it, failure),
        false_alarms: it.false_alarms,
        taken_for: taken,
        why,
    }
}

fn rate(hits: u64, runs: u64) -> RateRow {
    let it = clopper_pearson(hits, runs, CONFIDENCE);
    RateRow { low: permille(it.low), high: permille(it.high) }
}

/// A share in thousandths, to the nearest.
fn permille(share: f64) -> u64 {
    // A cast of a float keeps to the ends of the type.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let whole = (share * 1_000.0 + 0.5) as u64;
    whole
}

/// Why a row is not what the analysis assumes: it is named in less than 95 % of the runs, or found
/// later than assumed. `None` where it is.
fn why(robot: &Robot, failure: usize, it: &Detection, assumed: Millis) -> Option<String> {
    let runs = |count: u64| if count == 1 { "1 run".to_owned() } else { format!("{count} runs") };
    let ids = |rows: &[usize]| {
        let ids = rows.iter().filter_map(|it| robot.failures.get(*it)).map(|it| it.id.as_str());
        ids.collect::<Vec<_>>().join(" ")
    };
    let mut parts = Vec::new();
    if it.named(failure) * 100 < it.runs * 95 {
        let others = it.taken_for.iter().filter(|it| !it.0.contains(&failure));
        let mut others: Vec<_> = others.map(|(rows, it)| (it.len() as u64, ids(rows))).collect();
        others.sort_by_key(|it| std::cmp::Reverse(it.0));
        parts.extend(others.iter().map(|it| format!("taken for {} in {}", it.1, runs(it.0))));
        match it.missed() {
            0 => {}
            all if all == it.runs => parts.push("never raised".to_owned()),
            some => parts.push(format!("not raised in {}", runs(some))),
        }
    }
    let late = it.delays().iter().filter(|it| **it > assumed).count() as u64;
    if late > 0 {
        parts.push(format!("late in {}", runs(late)));
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}
