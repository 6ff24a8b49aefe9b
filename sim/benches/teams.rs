//! How much faster than real time a fleet on its floor runs: 40 robots, 200 deliveries, one core.
//!
//! `cargo bench -p cotama-sim --bench teams`; with `--test` it runs once.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_sim::fleet::scenarios::{FleetOptions, fleet};
use cotama_sim::fleet::{run, run_recorded};
use std::hint::black_box;
use std::time::Instant;

/// The median over several rounds of the seconds that the work takes.
fn seconds(rounds: usize, mut work: impl FnMut()) -> f64 {
    let mut all: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all[rounds / 2]
}

fn main() {
    let brief = std::env::args().skip(1).any(|it| it == "--test");
    let rounds = if brief { 1 } else { 9 };
    let start = Instant::now();
    let scenario = fleet(&FleetOptions::default());
    println!("ways planned on the floor  {:>8.3} s", start.elapsed().as_secs_f64());
    assert!(scenario.floor.is_drawn());
    let simulated = run(&scenario).end_ms as f64 / 1_000.0;
    let silent = seconds(rounds, || drop(black_box(run(&scenario))));
    let recorded = seconds(rounds, || drop(black_box(run_recorded(&scenario))));
    let queue = fleet(&FleetOptions { takeover: true, kills: 3, ..FleetOptions::default() });
    let taken_over = run(&queue).end_ms as f64 / 1_000.0;
    let copied = seconds(rounds, || drop(black_box(run(&queue))));
    for (name, simulated, took) in [
        ("without trace", simulated, silent),
        ("trace in memory", simulated, recorded),
        ("with takeovers", taken_over, copied),
    ] {
        println!("{name:15}  {simulated:>8.1} s in {took:>6.3} s, {:>7.0} x", simulated / took);
    }
}
