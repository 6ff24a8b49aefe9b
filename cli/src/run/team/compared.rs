//! One team under many seeds, with each allocation, or with each trust in skills.

use super::Variant;
use crate::answers::team::{Compared, ComparedRow, Interval, TeamAnswer, TrustRow};
use crate::args::{Compare, RunArgs};
use crate::exit::{Exit, Failure};
use crate::names::quoted;
use crate::output::Screen;
use crate::render;
use cotama_campaign::methods::{Results, Spread, compare};
use cotama_models::team::scenario::{Method, Scenario, Trust};
use std::thread;

/// Uses of skills are counted in so many groups of ten; the last has all that are more.
const TENS: usize = 6;

/// Many seeds, with each variant.
pub(super) fn compared(
    args: &RunArgs,
    made: &(impl Fn(u64, Variant) -> Scenario + Sync),
    seeds: u64,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let seed = args.seed.unwrap_or(0);
    let (mut allocations, mut trusts) = (Vec::new(), Vec::new());
    match args.team.compare {
        Compare::Allocation => {
            let scenario =
                |seed, method| made(seed, Variant { method: Some(method), ..Variant::default() });
            let results = compare(&scenario, seed, seeds, &Method::ALL, threads);
            allocations = results.iter().map(row).collect();
        }
        Compare::Trust => {
            let scenario =
                |seed, trust| made(seed, Variant { trust: Some(trust), ..Variant::default() });
            let results = compare(&scenario, seed, seeds, &Trust::ALL, threads);
            trusts = results.iter().map(trust_row).collect();
        }
    }
    let ends = allocations.iter().map(|it| (it.unsound, it.reported));
    let ends = ends.chain(trusts.iter().map(|it| (it.unsound, it.reported)));
    let (unsound, reported) = ends.fold((0, 0), |all, it| (all.0 + it.0, all.1 + it.1));
    let first = made(seed, Variant::default());
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
        compared: Some(Compared { seeds, confidence_permille: 950, allocations, trusts }),
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

fn row(it: &Results<Method>) -> ComparedRow {
    ComparedRow {
        allocation: it.variant.name(),
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

fn trust_row(it: &Results<Trust>) -> TrustRow {
    let mut undue_by_uses = vec![0; TENS];
    for uses in &it.skills.undue_after {
        undue_by_uses[(*uses as usize / 10).min(TENS - 1)] += 1;
    }
    TrustRow {
        trust: it.variant.name(),
        cost_ms: it.cost_ms.into(),
        more_ms: it.more_ms.into(),
        more_permille: it.more_permille.into(),
        mean_time_ms: it.waited_ms.into(),
        more_time_ms: it.more_waited_ms.into(),
        uses_milli: it.skills.uses_milli.into(),
        failed_milli: it.skills.failed_milli.into(),
        more_failed_milli: it.skills.more_failed_milli.into(),
        undue_milli: it.skills.undue_milli.into(),
        undue_by_uses,
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
