//! One team under many seeds, with each allocation.

use crate::answers::team::{Compared, ComparedRow, Interval, TeamAnswer};
use crate::args::RunArgs;
use crate::exit::{Exit, Failure};
use crate::names::quoted;
use crate::output::Screen;
use crate::render;
use cotama_campaign::methods::{Results, Spread, compare};
use cotama_models::team::scenario::{Method, Scenario};
use std::thread;

/// Many seeds, with each allocation.
pub(super) fn compared(
    args: &RunArgs,
    made: &(impl Fn(u64, Option<Method>) -> Scenario + Sync),
    seeds: u64,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let scenario = |seed, method| made(seed, Some(method));
    let seed = args.seed.unwrap_or(0);
    let results = compare(&scenario, seed, seeds, &Method::ALL, threads);
    let unsound: usize = results.iter().map(|it| it.unsound).sum();
    let reported: usize = results.iter().map(|it| it.reported).sum();
    let first = made(seed, None);
    let answer = TeamAnswer {
        schema: "cotama/run-team/1",
        scenario: first.name.clone(),
        outcome: match (unsound, reported) {
            (0, 0) => "completed",
            (0, _) => "reported",
            _ => "failed",
        },
        seed,
        robots: first.robots.len() as u64,
        tasks: first.tasks.len() as u64,
        loss_permille: first.network.loss_permille,
        run: None,
        compared: Some(Compared {
            seeds,
            confidence_permille: 950,
            allocations: results.iter().map(row).collect(),
        }),
        identical: None,
        difference: None,
        returns: None,
        failure: None,
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = format!("cotama run {} --seed {}", quoted(&args.mission.mission), seed);
        let faults = first.faults.len();
        screen.print(&render::team::compared(&answer, faults, &next, screen.width()))?;
    }
    Ok(if unsound == 0 { Exit::Success } else { Exit::Violated })
}

fn row(it: &Results) -> ComparedRow {
    ComparedRow {
        allocation: it.method.name(),
        cost_ms: it.cost_ms.into(),
        mean_time_ms: it.waited_ms.into(),
        more_ms: it.more_ms.into(),
        more_permille: it.more_permille.into(),
        done: it.done as u64,
        reported: it.reported as u64,
        reopened: it.reopened,
        unsound: it.unsound as u64,
    }
}

impl From<Spread> for Interval {
    fn from(it: Spread) -> Self {
        let half = i64::try_from(it.half_width).unwrap_or(i64::MAX);
        let (low, high) = (it.mean.saturating_sub(half), it.mean.saturating_add(half));
        Self { mean: it.mean, low, high }
    }
}
