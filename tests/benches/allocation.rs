//! Times the exact allocator on seeded instances: `cargo bench -p cotama-tests --bench allocation`.
//!
//! `--export DIR` also writes every instance and the results for
//! `tests/evidence/compare/compare.py`, which times other solvers on the same instances.
//! `--kind TEXT` keeps the kinds whose name contains the text.

#![allow(clippy::cast_precision_loss)] // a gap in percent needs no more than a double's digits

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Objective, Workspace};
use cotama_tests::families::{Correlation, correlated, robot_like};
use cotama_tests::instances::{Instance, Zones, paper_like};
use serde_json::json;
use std::time::Instant;

/// Steps after which a hard instance is reported with its gap: about one second.
const STEPS: u64 = 40_000_000;
/// Shares of the way from least to largest cost, in permille, at which limits are set.
const TIGHTNESS: [[u64; 2]; 4] = [[30, 100], [100, 300], [200, 150], [1000, 300]];

struct Timed {
    answer: Answer<2>,
    plan: Vec<u16>,
    seconds: f64,
}

/// Solves repeatedly for at least a few milliseconds; the median of the single times.
fn time(instance: &Instance<2>) -> Timed {
    let slices = instance.slices();
    let problem = instance.problem(&slices);
    let (mut workspace, mut plan) = (Workspace::new(), vec![0; slices.len()]);
    let mut seconds = Vec::new();
    let begin = Instant::now();
    loop {
        let start = Instant::now();
        let mut exact = workspace.exact(&problem, &[Objective::MostQuality], STEPS, 1 << 18);
        let answer =
            exact.allocate(&problem, &mut plan).expect("the memory is sized for the instance");
        seconds.push(start.elapsed().as_secs_f64());
        if seconds.len() >= 3 && begin.elapsed().as_secs_f64() > 0.02
            || begin.elapsed().as_secs_f64() > 2.0
        {
            seconds.sort_by(f64::total_cmp);
            return Timed { answer, plan, seconds: seconds[seconds.len() / 2] };
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let after = |flag: &str| {
        arguments
            .iter()
            .position(|a| a == flag)
            .and_then(|at| arguments.get(at + 1))
            .map(String::as_str)
    };
    let (export, only) = (after("--export"), after("--kind").unwrap_or(""));

    let mut kinds: Vec<(String, Vec<Instance<2>>)> = Vec::new();
    let patrol = cotama_tests::with_patrol(|problem| Instance {
        activities: problem.activities().iter().map(|c| c.to_vec()).collect(),
        limits: problem.limits(),
    });
    kinds.push(("patrol".into(), vec![patrol]));
    for (zones, suffix) in [(Zones::Varied, ""), (Zones::Three, " three speeds")] {
        for activities in [17, 50, 200, 1000] {
            let tight =
                |seed: u64| paper_like(activities, zones, TIGHTNESS[seed as usize % 4], seed);
            kinds.push((format!("paper-like {activities}{suffix}"), (1..=5).map(tight).collect()));
        }
        let tight = |seed: u64| robot_like(1000, zones, TIGHTNESS[seed as usize % 4], seed);
        kinds.push((format!("robot-like 1000x21{suffix}"), (1..=5).map(tight).collect()));
    }
    for (activities, name) in [(50, "weak 50x20"), (200, "weak 200x20")] {
        let weak = |seed| correlated(activities, 20, Correlation::Weak, seed);
        kinds.push((name.into(), (1..=5).map(weak).collect()));
    }
    let strong = |seed| correlated(100, 20, Correlation::Strong, seed);
    kinds.push(("strong 100x20".into(), (1..=5).map(strong).collect()));

    let mut rows = Vec::new();
    println!(
        "{:<32} {:>12} {:>12} {:>12}  proven  worst gap",
        "kind", "median ms", "worst ms", "worst steps"
    );
    for (kind, instances) in kinds.iter().filter(|(kind, _)| kind.contains(only)) {
        let timed: Vec<Timed> = instances.iter().map(time).collect();
        let mut seconds: Vec<f64> = timed.iter().map(|t| t.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        let (mut proven, mut worst_gap, mut worst_steps) = (0, 0.0f64, 0);
        for (number, (timed, instance)) in timed.iter().zip(instances).enumerate() {
            let Answer::Planned(planned) = timed.answer else {
                panic!("{kind} {number}: {:?}", timed.answer)
            };
            let bound = planned.bound.unwrap_or(u64::MAX);
            proven += usize::from(planned.optimal);
            worst_gap = worst_gap.max((bound - planned.quality) as f64 / bound as f64);
            worst_steps = worst_steps.max(planned.steps);
            let name = format!("{}-{}", kind.replace(' ', "-"), number + 1);
            if let Some(folder) = export {
                let activities: Vec<Vec<[u32; 3]>> = instance
                    .activities
                    .iter()
                    .map(|c| c.iter().map(|c| [c.quality, c.cost[0], c.cost[1]]).collect())
                    .collect();
                let limits =
                    json!({"duration_ms": instance.limits[0], "energy_mj": instance.limits[1]});
                let text = json!({"limits": limits, "activities": activities}).to_string();
                std::fs::write(format!("{folder}/{name}.json"), text)
                    .expect("the export folder is writable");
            }
            rows.push(json!({
                "name": name, "kind": kind, "seconds": timed.seconds,
                "status": if planned.optimal { "optimal" } else { "feasible" },
                "quality": planned.quality, "bound": bound, "steps": planned.steps,
                "plan": timed.plan,
            }));
        }
        println!(
            "{kind:<32} {:>12.4} {:>12.4} {worst_steps:>12}  {proven}/{}  {:.4} %",
            seconds[seconds.len() / 2] * 1e3,
            seconds[seconds.len() - 1] * 1e3,
            instances.len(),
            worst_gap * 100.0
        );
    }
    if let Some(folder) = export {
        let results = json!({"schema": "cotama/bench-allocation/1", "instances": rows});
        std::fs::write(format!("{folder}/results.json"), results.to_string())
            .expect("the export folder is writable");
    }
}
