//! `cotama plan`: a mission split into activities and planned, without running it.

use crate::allocate::exit;
use crate::answers::{ActivityRow, FrontRow, PlanAnswer, PlanRow, Reason, Status};
use crate::args::{Objective as Wanted, PlanArgs, STEPS};
use crate::axes;
use crate::exit::{Exit, Failure};
use crate::infeasible;
use crate::mission;
use crate::output::Screen;
use crate::render;
use crate::solve::{Method, Solution, Verdict, solve};
use crate::words::Words;
use cotama_core::front::{Front, Node};
use cotama_core::problem::{Candidate, Problem};
use cotama_models::missions::tables::{DURATION, ENERGY};
use cotama_models::missions::{Mission, PlannedActivity, Remaining};
use cotama_sim::options::{Aim, Planner};
use cotama_sim::solver::{MIN_ENERGY, QUALITY};

/// Splits a mission into activities and plans it.
pub(crate) fn plan(args: &PlanArgs, screen: &Screen) -> Result<Exit, Failure> {
    if axes::is(&args.mission.mission) {
        return axes::plan(args, screen);
    }
    mission::pursued(args.objective, args.planning.allocator)?;
    if args.objective == Some(Wanted::Front) && args.planning.steps != STEPS {
        let message = "--steps with --objective front: its search is bounded by partial plans";
        return Err(Failure::new(message).help("leave --steps out"));
    }
    let mission = mission::load_for(&args.mission.mission, &args.planning, Some(screen))?;
    if mission.plans_by_wishes() {
        return axes::plan_of(args, &mission, screen);
    }
    let answer = answer(args, &mission)?;
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let supervised = mission.is_supervised();
        let next = Words::of_plan(args).after_plan(&answer, args.planning.steps, supervised);
        screen.print(&render::plan::screen(&answer, next, screen.width()))?;
    }
    Ok(exit(answer.status))
}

fn answer(args: &PlanArgs, mission: &Mission) -> Result<PlanAnswer, Failure> {
    let objective = mission::objective(args.objective, args.planning.allocator, mission);
    let lost = mission::lost(mission, &args.planning.lost)?;
    let available = mission::available(mission, &lost);
    let scenario = mission.scenario();
    let counts: Vec<usize> = scenario
        .activities
        .iter()
        .map(|it| it.alternatives.iter().filter(|it| available.covers(it.needs)).count())
        .collect();
    let mut answer = PlanAnswer {
        schema: "cotama/plan/1",
        mission: mission.name.clone(),
        activities: scenario
            .activities
            .iter()
            .zip(&counts)
            .map(|(activity, &left)| activity_row(mission, activity, left))
            .collect(),
        speed_robot_mm_s: mission.robot.speed_max.0,
        speed_harmless_mm_s: mission.robot.speed_harmless.0,
        combinations: counts
            .iter()
            .try_fold(1u128, |product, &left| product.checked_mul(left as u128))
            .map_or_else(|| "more than 2^128".into(), |product| product.to_string()),
        objective: objective.name(),
        allocator: None,
        status: Status::Infeasible,
        plan: Vec::new(),
        duration_ms: None,
        energy_mj: None,
        quality: None,
        duration_limit_ms: mission.limits[DURATION],
        energy_limit_mj: mission.limits[ENERGY],
        duration_margin_ms: None,
        energy_margin_mj: None,
        bound: None,
        steps: 0,
        front: None,
        reason: None,
    };
    let candidates = Remaining::new(&scenario.activities(), None, available);
    let lists = candidates.as_ref().map(Remaining::lists).unwrap_or_default();
    // Without candidates there is no problem, but a reason.
    if let Ok(problem) = Problem::new(&lists, scenario.limits, scenario.order)
        && !lists.is_empty()
    {
        if objective == Wanted::Front {
            front(&mut answer, mission, &problem);
        } else {
            let solution = solve_for(objective, args, &problem)?;
            fill(&mut answer, mission, &problem, &solution, args.planning.steps);
        }
    }
    if answer.status == Status::Infeasible {
        answer.reason = infeasible::explain(mission, mission.limits, available).or(answer.reason);
    }
    Ok(answer)
}

fn activity_row(mission: &Mission, activity: &PlannedActivity, left: usize) -> ActivityRow {
    ActivityRow {
        id: activity.id.clone(),
        objective: mission
            .objectives
            .get(activity.objective)
            .map_or_else(String::new, |it| it.id.clone()),
        x_start_mm: activity.x_start.0,
        x_end_mm: activity.x_end.0,
        candidates: left as u64,
        candidates_before: activity.unconstrained() as u64,
        speed_max_mm_s: activity.speed_max.0,
    }
}

fn solve_for(
    objective: Wanted,
    args: &PlanArgs,
    problem: &Problem<'_, 2>,
) -> Result<Solution, Failure> {
    let allocator = args.planning.allocator;
    let method = match mission::planner(objective, allocator, args.planning.steps)? {
        Planner::Panorama => Method::Rule,
        Planner::PanoramaThenExact { .. } => Method::RuleThenExact,
        Planner::Exact { aim: Aim::MinEnergy, .. } => Method::Exact(&MIN_ENERGY),
        Planner::Exact { aim: Aim::Quality, .. } => Method::Exact(&QUALITY),
    };
    solve(problem, method, args.planning.steps).map_err(|error| Failure::new(error.to_string()))
}

fn fill(
    answer: &mut PlanAnswer,
    mission: &Mission,
    problem: &Problem<'_, 2>,
    solution: &Solution,
    steps: u64,
) {
    answer.status = solution.status();
    answer.bound = solution.bound();
    answer.steps = solution.steps;
    match solution.verdict {
        Verdict::Planned { planned, allocator } => {
            answer.allocator = Some(allocator);
            answer.duration_ms = Some(planned.cost[DURATION]);
            answer.energy_mj = Some(planned.cost[ENERGY]);
            answer.quality = Some(planned.quality);
            let margin = |axis: usize| {
                let [limit, cost] = [problem.limits()[axis], planned.cost[axis]].map(i64::try_from);
                limit.ok()?.checked_sub(cost.ok()?)
            };
            answer.duration_margin_ms = margin(DURATION);
            answer.energy_margin_mj = margin(ENERGY);
            let rows =
                mission.scenario().activities.iter().zip(problem.activities()).zip(&solution.plan);
            answer.plan = rows
                .filter_map(|((activity, candidates), &place)| {
                    plan_row(activity, candidates.get(usize::from(place))?)
                })
                .collect();
        }
        Verdict::Infeasible { shortfall } => {
            answer.reason = Some(infeasible::short(shortfall, steps));
        }
        Verdict::Missed => answer.reason = Some(infeasible::missed("use `--allocator exact`")),
        Verdict::Unknown { .. } => {
            let text = format!(
                "neither a plan nor the proof that there is none was found in {steps} steps: \
                 use more `--steps`"
            );
            answer.reason = Some(Reason { text, ..Reason::default() });
        }
    }
}

fn plan_row(activity: &PlannedActivity, candidate: &Candidate<2>) -> Option<PlanRow> {
    let alternative = usize::from(candidate.id);
    Some(PlanRow {
        activity: activity.id.clone(),
        choice: activity.labels.get(alternative)?.clone(),
        speed_mm_s: activity.alternatives.get(alternative)?.speed.0,
        duration_ms: candidate.cost[DURATION].into(),
        energy_mj: candidate.cost[ENERGY].into(),
        quality: Some(candidate.quality.into()),
    })
}

/// The most partial plans that a search for a front may keep, and how many it is given at first.
const MOST_NODES: usize = 1 << 20;
const FIRST_NODES: usize = 1 << 16;

/// All plans of which none is better in duration, energy and quality.
fn front(answer: &mut PlanAnswer, mission: &Mission, problem: &Problem<'_, 2>) {
    let mut size = FIRST_NODES;
    loop {
        let mut nodes = vec![Node::EMPTY; size];
        let mut front = Front::new(&mut nodes);
        let plans = match front.find(problem) {
            Ok(plans) => plans,
            Err(_) if size < MOST_NODES => {
                size *= 4;
                continue;
            }
            Err(_) => {
                let text = format!(
                    "the front needs more than {MOST_NODES} partial plans: too many to search"
                );
                answer.status = Status::Unknown;
                answer.reason = Some(Reason { text, ..Reason::default() });
                return;
            }
        };
        let mut choice = vec![0; problem.activities().len()];
        let rows = (0..plans.len()).filter_map(|index| {
            let ([duration_ms, energy_mj], quality) = plans.totals(index)?;
            plans.plan(index, &mut choice);
            let choice = labels(mission, problem, &choice);
            Some(FrontRow { duration_ms, energy_mj, quality, choice })
        });
        answer.front = Some(rows.collect());
        answer.status = if plans.is_empty() { Status::Infeasible } else { Status::Optimal };
        answer.allocator = (!plans.is_empty()).then_some("exact");
        return;
    }
}

fn labels(mission: &Mission, problem: &Problem<'_, 2>, choice: &[u16]) -> Vec<String> {
    let rows = mission.scenario().activities.iter().zip(problem.activities()).zip(choice);
    let label = |((activity, candidates), &place): ((&PlannedActivity, &&[Candidate<2>]), &u16)| {
        let candidate = candidates.get(usize::from(place))?;
        activity.labels.get(usize::from(candidate.id)).cloned()
    };
    rows.filter_map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;

    /// The answer for the front of two activities with so many ways each, none better than another.
    fn front_of(ways: u32) -> PlanAnswer {
        let Command::Plan(args) = Cli::parse_from(["cotama", "plan", "patrol"]).command else {
            unreachable!("`plan` is the command")
        };
        let mission = mission::load_for(&args.mission.mission, &args.planning, None).unwrap();
        let mut answer = answer(&args, &mission).unwrap();
        let candidate =
            |it| Candidate { cost: [it, ways - 1 - it], quality: 0, id: (it % 2) as u16 };
        let ways: Vec<_> = (0..ways).map(candidate).collect();
        let activities = [&ways[..]; 2];
        let problem = Problem::new(&activities, [1 << 20; 2], [0, 1]).unwrap();
        front(&mut answer, &mission, &problem);
        answer
    }

    /// 300 ways and then 300 x 300 are more than 65,536 partial plans.
    #[test]
    fn a_front_takes_more_memory_up_to_a_limit() {
        let answer = front_of(300);
        assert_eq!(answer.status, Status::Optimal);
        let rows = answer.front.unwrap();
        let ends = [&rows[0], &rows[598]].map(|it| (it.duration_ms, it.energy_mj));
        assert_eq!((rows.len(), ends), (599, [(0, 598), (598, 0)]));
        assert!(rows.iter().any(|it| it.choice != rows[0].choice));
        // 1,100 x 1,100 are more than a million.
        let answer = front_of(1_100);
        assert_eq!((answer.status, answer.front), (Status::Unknown, None));
        let text = "the front needs more than 1048576 partial plans: too many to search";
        assert_eq!(answer.reason.unwrap().text, text);
    }
}
