//! Plans a mission file: `cargo run -p cotama-models --example allocate_patrol`.
//!
//! The patrol of Lambert et al. 2024 comes with the program; any file of `panorama-mission/1` does.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Objective, Workspace};
use cotama_core::problem::{Candidate, Problem};
use cotama_models::missions::infeasible::amount;
use cotama_models::missions::tables::{DURATION, EMPTY, ENERGY, buffer_sizes, remaining};
use cotama_models::missions::{Mission, embedded};
use std::error::Error;
use std::io::{self, Write};

/// Runs the program.
pub(crate) fn run(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    // 1. Read: the whole file is checked here, and nothing after it fails because of the file.
    let file = embedded::mission("patrol").ok_or("the patrol comes with the program")?;
    let mission = Mission::parse(file.name, file.text)?;

    // 2. Split: objectives are cut at the borders of zones into activities, and each activity can
    //    be done in some ways.
    let scenario = mission.scenario();
    let (activities, objectives) = (scenario.activities(), mission.objectives.len());
    let plans = scenario.combinations().ok_or("too many")?;
    writeln!(out, "{objectives} objectives, {} activities, {plans} plans", activities.len())?;

    // 3. Allocate: from the start on, with all hardware, in memory of known size.
    let (most, count) = buffer_sizes(&activities);
    let (mut candidates, mut lists) = (vec![EMPTY; most], vec![&[] as &[Candidate<2>]; count]);
    let first = activities[0].whole(&activities[0].alternatives[0]);
    let rest =
        remaining(&activities, Some(first), scenario.available, &mut candidates, &mut lists)?;
    let problem = Problem::new(rest, scenario.limits, scenario.order)?;
    // The most quality; of these plans the one that needs the least energy.
    let wish = [Objective::MostQuality, Objective::Least(ENERGY)];
    let (mut workspace, mut plan) = (Workspace::new(), vec![0; count]);
    let mut exact = workspace.exact(&problem, &wish, 100_000, 0);
    let Answer::Planned(planned) = exact.allocate(&problem, &mut plan)? else {
        return Err("no plan is within the limits".into());
    };

    // 4. Print: neighbours that are done alike share a line.
    let rows = scenario.activities.iter().zip(&plan);
    let rows: Vec<_> = rows.map(|(it, &choice)| (it, &it.labels[usize::from(choice)])).collect();
    for alike in rows.chunk_by(|a, b| a.1 == b.1) {
        let ((from, label), (to, _)) = (alike[0], alike[alike.len() - 1]);
        writeln!(out, "{:>3} to {:<3} {label:<5} up to {}", from.id, to.id, to.x_end)?;
    }
    let [duration, energy] = [DURATION, ENERGY].map(|axis| amount(axis, planned.cost[axis]));
    let proven = if planned.optimal { "no plan is better" } else { "a better one may exist" };
    writeln!(out, "{duration}, {energy}, quality {}: {proven}", planned.quality)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
