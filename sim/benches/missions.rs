//! Missions per second on one core: patrols without and with a trace in memory, and patrols and
//! supervised deliveries under drawn faults, as a campaign runs them.
//!
//! `cargo bench -p cotama-sim --bench missions`; with any argument of its own it runs briefly.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_campaign::space::{Rates, Space};
use cotama_campaign::strategy::{Strategy, Uniform};
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::Options;
use cotama_sim::setup::Simulation;
use cotama_sim::trace::Record;
use std::hint::black_box;
use std::time::Instant;

/// The median over several rounds of how often a second `work` can be done.
fn per_second(rounds: usize, times: u32, mut work: impl FnMut()) -> f64 {
    let mut rates: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            (0..times).for_each(|_| work());
            f64::from(times) / start.elapsed().as_secs_f64()
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    rates[rounds / 2]
}

/// One to three faults a run, drawn uniformly.
fn campaign(name: &str, rounds: usize, times: u32) {
    let embedded = embedded::mission(name).unwrap();
    let mission = Mission::parse(embedded.name, embedded.text).unwrap();
    let subject = Subject::new(&mission, Policy::default()).unwrap();
    let space = Space::of(&mission, Rates::Even, 1..=3);
    let rate = per_second(rounds, 1, || {
        let mut draws = Uniform.block(&space, 0, 0);
        (0..times).for_each(|_| drop(black_box(subject.run(&draws.next()))));
    });
    println!("{name:9} drawn {:>9.0} missions/s", rate * f64::from(times));
}

fn main() {
    let brief = std::env::args().skip(1).any(|argument| argument == "--test");
    let (rounds, times) = if brief { (1, 10) } else { (7, 2_000) };
    let patrol = embedded::mission("patrol").unwrap();
    let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    let simulation = Simulation::new(&mission, &Options::default()).unwrap();
    let run = simulation.run(0).unwrap();
    println!("a patrol: {} checks, {} plans", run.checks, run.plans.len());
    let silent = per_second(rounds, times, || drop(black_box(simulation.run(0).unwrap())));
    let recorded = per_second(rounds, times / 10, || {
        let mut records: Vec<Record> = Vec::new();
        drop(black_box(simulation.run_recorded(0, &mut records).unwrap()));
        drop(black_box(records));
    });
    let ready = per_second(rounds, times, || {
        drop(black_box(Simulation::new(&mission, &Options::default()).unwrap()));
    });
    println!("without trace   {silent:>9.0} missions/s");
    println!("trace in memory {recorded:>9.0} missions/s");
    println!("made ready      {ready:>9.0} missions/s");
    for name in ["patrol", "delivery"] {
        campaign(name, rounds, times / 2);
    }
}
