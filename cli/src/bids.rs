//! `cotama explain` of teams: why each bid is what it is.

use crate::answers::explain::bids::{
    BidActionRow, BidPartsRow, BidPlanRow, BidRoleRow, BidRow, BidsAnswer, ContestRow, OfferRow,
    WithoutRow,
};
use crate::args::{ExplainArgs, STEPS};
use crate::exit::{Exit, Failure};
use crate::names::{near, quoted};
use crate::output::Screen;
use crate::render;
use crate::team::Chosen;
use cotama_core::team::Combine;
use cotama_models::team::scenario::{Contest, Counted, Lack, Offer, RoleSpec, Scenario};
use cotama_models::team::{CapabilitySet, Probability};

/// Says why the bids for tasks of a team are what they are.
pub(crate) fn explain(
    args: &ExplainArgs,
    chosen: &Chosen,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let idle = [("--candidate", args.candidate.is_some()), ("--steps", args.steps != STEPS)];
    if let Some((option, _)) = idle.into_iter().find(|it| it.1) {
        return Err(Failure::new(format!("{option} is for missions, and this is a team")));
    }
    let scenario = chosen.scenario();
    let asked = args.activity.as_deref().map(|it| task(&scenario, it)).transpose()?;
    let tasks = (0..scenario.tasks.len()).filter(|it| asked.is_none_or(|asked| asked == *it));
    let answer = BidsAnswer {
        schema: "cotama/explain-team/1",
        team: scenario.name.clone(),
        because: tasks.filter_map(|it| contest(&scenario, it)).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let name = &args.mission;
        let first = scenario.tasks.first().filter(|_| asked.is_none() && name != "-");
        let next = first.map(|it| format!("cotama explain {} {}", quoted(name), quoted(&it.name)));
        screen.print(&render::bids::screen(&answer, asked.is_some(), next, screen.width()))?;
    }
    Ok(Exit::Success)
}

/// The task of a name.
fn task(scenario: &Scenario, name: &str) -> Result<usize, Failure> {
    let names = || scenario.tasks.iter().map(|it| it.name.as_str());
    if let Some(found) = names().position(|it| it == name) {
        return Ok(found);
    }
    let guess =
        near(name, names()).map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
    let some: Vec<_> = names().take(8).collect();
    let more = if scenario.tasks.len() > some.len() { ", ..." } else { "" };
    Err(Failure::new(format!("the team has no task `{name}`{guess}"))
        .help(format!("its tasks: {}{more}", some.join(", "))))
}

fn contest(scenario: &Scenario, task: usize) -> Option<ContestRow> {
    let (spec, found) = (scenario.tasks.get(task)?, scenario.contest(task)?);
    let place = |it: cotama_models::team::scenario::Place| scenario.floor.name(it).to_owned();
    let row = |it: &Offer| offer(scenario, task, it);
    let plans = spec.plans.iter().zip(&found.plans).map(|(plan, best)| BidPlanRow {
        plan: plan.name.clone(),
        extra_ms: plan.extra_ms,
        best: best.as_ref().map(row),
        roles: plan.roles.iter().map(|it| role(scenario, task, it)).collect(),
    });
    let Contest { denominator, best, second, without, .. } = &found;
    let cost = best.as_ref().map(|it| it.cost);
    let more = |other: u64| cost.map(|it| other.saturating_sub(it));
    let skip = u64::from(spec.utility_ms) * u64::from(*denominator);
    Some(ContestRow {
        task: spec.name.clone(),
        from: place(spec.start),
        to: place(spec.goal),
        skip_ms: spec.utility_ms,
        combine: match spec.combine {
            Combine::Sum => "sum",
            Combine::Mean => "mean",
            Combine::Max => "max",
        },
        cost_denominator: *denominator,
        plans: plans.collect(),
        best: best.as_ref().map(row),
        worth_it: cost.is_some_and(|it| it < skip),
        pledge_ms: best.as_ref().and_then(|it| scenario.pledge(task, it)).map(|it| it.most),
        second: second.as_ref().map(row),
        second_costs_more: second.as_ref().and_then(|it| more(it.cost)),
        without: without
            .iter()
            .map(|(robot, cost)| WithoutRow {
                robot: robot_name(scenario, *robot),
                cost: *cost,
                more: cost.and_then(more),
            })
            .collect(),
    })
}

fn robot_name(scenario: &Scenario, robot: usize) -> String {
    scenario.robots.get(robot).map_or_else(String::new, |it| it.name.clone())
}

fn offer(scenario: &Scenario, task: usize, it: &Offer) -> OfferRow {
    let plan = scenario.tasks.get(task).and_then(|task| task.plans.get(it.plan));
    OfferRow {
        plan: plan.map_or_else(String::new, |it| it.name.clone()),
        robots: it.robots.iter().map(|it| robot_name(scenario, *it)).collect(),
        cost: it.cost,
    }
}

fn role(scenario: &Scenario, task: usize, spec: &RoleSpec) -> BidRoleRow {
    let bids = (0..scenario.robots.len()).map(|robot| bid(scenario, (robot, task), spec));
    BidRoleRow { role: spec.name.clone(), bids: bids.collect() }
}

fn bid(scenario: &Scenario, (robot, task): (usize, usize), spec: &RoleSpec) -> BidRow {
    let mut row = BidRow {
        robot: robot_name(scenario, robot),
        bid_ms: None,
        lacks: Vec::new(),
        why_not: None,
        counts: None,
        failures_ms: None,
        success_permille: None,
        actions: Vec::new(),
    };
    match scenario.reasons(robot, task, spec) {
        Err(Lack::Skills(missing)) => {
            row.lacks = missing.iter().map(|it| skills(scenario, *it).join(" | ")).collect();
        }
        Err(Lack::Away) => row.why_not = Some("it joins later"),
        Err(Lack::Way) => row.why_not = Some("no way leads there"),
        Err(Lack::Charge) => row.why_not = Some("its battery is too low for this and the way home"),
        Err(Lack::Cost) => row.why_not = Some("the cost is more than a bid can say"),
        Ok(it) => {
            let counts = BidPartsRow {
                ways_mm: it.parts.ways_mm,
                drives_ms: it.parts.drives_ms,
                delays_ms: it.parts.delays_ms,
                rounds_ms: it.parts.rounds_ms,
                take_ms: it.parts.take_ms,
                give_ms: it.parts.give_ms,
            };
            row.bid_ms = Some(it.quote.cost_ms);
            row.failures_ms = Some(u64::from(it.quote.cost_ms).saturating_sub(it.parts.sum_ms()));
            row.success_permille = Some(permille(it.quote.success));
            row.counts = Some(counts);
            row.actions = it.actions.iter().map(|it| action(scenario, it)).collect();
        }
    }
    row
}

fn action(scenario: &Scenario, it: &Counted) -> BidActionRow {
    let used = it.used.iter().flat_map(|it| skills(scenario, CapabilitySet::of(&[*it])));
    let mut uses: Vec<String> = Vec::new();
    used.for_each(|it| {
        if !uses.contains(&it) {
            uses.push(it);
        }
    });
    BidActionRow {
        uses,
        cost_ms: it.step.cost,
        success_permille: permille(it.step.success),
        repeated_ms: it.repeated.rounded_up(),
        failures_ms: it.surcharge_ms(),
    }
}

fn permille(it: Probability) -> u32 {
    it.parts() / (Probability::PARTS / 1_000)
}

/// The names of skills.
fn skills(scenario: &Scenario, set: CapabilitySet) -> Vec<String> {
    let name = |it: cotama_models::team::Capability| {
        let name = scenario.skills.get(usize::from(it.number()));
        name.cloned().unwrap_or_else(|| it.number().to_string())
    };
    set.iter().map(name).collect()
}
