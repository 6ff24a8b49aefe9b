//! Time of the patrol with five limited axes: read and its table made, planned exactly,
//! fronts, and least corrections where it has no plan.
//!
//! `cargo bench -p cotama-axes --bench plan`; with any argument of its own it runs briefly.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_axes::{Ask, Case, Infeasible, Lifted, PATROL, Problem, Sense, Steps, Table};
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

/// The median over several rounds of how many milliseconds `work` takes.
fn milliseconds(rounds: usize, mut work: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[rounds / 2]
}

fn made(text: &str) -> (Case, Table) {
    let case = Case::parse(text).unwrap();
    let table = Table::new(&case.mission, Lifted::default(), &mut Steps::default()).unwrap();
    (case, table)
}

/// The patrol with more objectives on its way back.
fn longer(objectives: usize) -> String {
    let (head, rest) = PATROL.split_once("x_start_mm = 93500\nx_end_mm = 187000").unwrap();
    let mut text = head.to_owned();
    let step = 93_500 / (objectives - 8);
    for number in 9..objectives {
        let start = 93_500 + (number - 9) * step;
        let _ = writeln!(text, "x_start_mm = {start}\nx_end_mm = {}", start + step);
        let _ = writeln!(text, "tasks = [\"MOV\", \"LOC\"]\n[[objective]]\nid = \"more{number}\"");
    }
    let start = 93_500 + (objectives - 9) * step;
    text + &format!("x_start_mm = {start}\nx_end_mm = 187000") + rest
}

fn main() {
    let brief = std::env::args().skip(1).any(|argument| argument == "--test");
    let rounds = if brief { 1 } else { 15 };
    for objectives in [9, 20] {
        let text = longer(objectives);
        let read = milliseconds(rounds, || drop(black_box(Case::parse(&text).unwrap())));
        println!("{objectives:>2} objectives: read alone                   {read:>8.2} ms");
        let load = milliseconds(rounds, || drop(black_box(made(&text))));
        println!("{objectives:>2} objectives: read, candidates and speeds  {load:>8.2} ms");
    }
    let (case, table) = made(PATROL);
    let mission = &case.mission;
    let problem = Problem::new(mission, &table, Lifted::default());
    let best = milliseconds(rounds, || {
        black_box(problem.best(&case.ask, &mut Steps::default())).unwrap().unwrap();
    });
    println!("least energy, five axes, exact            {best:>8.2} ms");
    let wish = |name: &str| {
        let sense = if name == "localisation.located" { Sense::Max } else { Sense::Min };
        Ask { sense, indicator: mission.indicator(name).unwrap() }
    };
    for names in [
        &["energy.RC", "localisation.located"][..],
        &["energy.RC", "localisation.located", "data.volume"],
        &["duration.MD", "energy.RC", "energy.LC", "localisation.located", "data.volume"],
    ] {
        let ask: Vec<_> = names.iter().map(|it| wish(it)).collect();
        let mut points = 0;
        let front = milliseconds(rounds, || {
            points = problem.front(&ask, &mut Steps::default()).unwrap().len();
        });
        println!("front of {} axes, {points:>4} points              {front:>8.2} ms", ask.len());
    }
    let (case, table) = made(&PATROL.replace("goal = 450000", "goal = 90000"));
    let why = milliseconds(rounds, || {
        let mut steps = Steps::default();
        black_box(Infeasible::of(&case.mission, &table, &mut steps)).unwrap();
    });
    println!("no plan: corrections of ten constraints   {why:>8.2} ms");
}
