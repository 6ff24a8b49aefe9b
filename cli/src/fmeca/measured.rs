//! `cotama fmeca --measure`: how the signals of a robot in the plane detect its failures.

use crate::answers::fmeca::{MeasureAnswer, MeasureRow, TakenRow};
use crate::args::FmecaArgs;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::output::Screen;
use crate::progress::Line;
use crate::render;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::robots::{Moment, Robot};
use cotama_sim::options::{Fidelity, Options};
use cotama_sim::robots::{Driven, Measured};
use std::time::Instant;

/// Measures each failure that harms a device, and prints the table.
pub(crate) fn measure(name: &str, args: &FmecaArgs, screen: &Screen) -> Result<Exit, Failure> {
    let mission = mission::load(name, Some(screen))?;
    let plain = || {
        Failure::of(name, "the mission names no robot, whose failures could be detected")
            .help("add `robot = \"p3dx-delivery\"`, or measure `delivery`")
    };
    let robot = mission.robot().ok_or_else(plain)?.robot();
    let options = Options { fidelity: Fidelity::Signal, ..Options::default() };
    let driven =
        Driven::with(&mission, &options).map_err(|it| Failure::of(name, it.to_string()))?;
    // In the middle of the first drive: the robot goes on for a while, and turns nowhere.
    let drive = mission.objectives.iter().find(|it| it.travels());
    let at = drive.map_or(0, |it| u64::midpoint(it.x_start.0, it.x_end.0));
    let at = Millimetres(at);
    let (line, begun) = (Line::new(), Instant::now());
    let mut rows = Vec::new();
    let sensed = robot.failures.iter().enumerate().filter(|it| it.1.harm.is_some());
    let count = sensed.clone().count();
    for (number, (failure, row)) in sensed.enumerate() {
        line.write(begun, |_| format!("{} of {count}: {}", number + 1, row.id));
        let measured = driven.measure(failure, Moment::Place(at), 0..args.seeds);
        let measured = measured.map_err(|why| Failure::of(name, why.text(&mission)))?;
        rows.push(answer_row(robot, failure, &measured));
    }
    line.clear();
    let told = robot.failures.iter().filter(|it| it.harm.is_none() && !it.no_plan);
    let answer = MeasureAnswer {
        schema: "cotama/measure/1",
        mission: mission.name.clone(),
        robot: robot.name.clone(),
        seeds: args.seeds,
        x_mm: at.0,
        window_ms: cotama_sim::robots::WINDOW.0,
        rows,
        told: told.map(|it| it.id.clone()).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::fmeca::measured(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn answer_row(robot: &Robot, failure: usize, it: &Measured) -> MeasureRow {
    let id = |at: &usize| robot.failures.get(*at).map_or_else(String::new, |it| it.id.clone());
    let row = robot.failures.get(failure);
    let taken = it
        .taken_for
        .iter()
        .map(|(all, runs)| TakenRow { rows: all.iter().map(id).collect(), runs: *runs });
    MeasureRow {
        id: id(&failure),
        failure: row.map_or_else(String::new, |it| it.mode.clone()),
        runs: it.runs,
        found: it.delays.len() as u64,
        named: it.named(failure),
        median_ms: it.median().map(|it| it.0),
        worst_ms: it.worst().map(|it| it.0),
        assumed_ms: row.map_or(Millis(0), |it| it.latency).0,
        false_alarms: it.false_alarms,
        taken_for: taken.collect(),
    }
}
