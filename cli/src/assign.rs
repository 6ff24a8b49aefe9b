//! `cotama assign`: which robots do which tasks.

mod curves;

use crate::answers::assign::{
    AssignAnswer, AssignStatus, Certificate, DoneRow, Fraction, GreedyRow, ProofRow,
    PruningCondition, PruningRow, TeamRow, WhyInfeasible,
};
use crate::args::AssignArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::kind::{self, Kind};
use crate::names::quoted;
use crate::output::Screen;
use crate::render;
use crate::team::{self, Chosen};
use cotama_core::team::Team;
use cotama_models::team::Ratio;
use cotama_models::team::instance::{
    Assignment, Instance, InstancePlan, PlanProof, Proof, Verdict,
};
use cotama_models::team::scenario::{Figures, Scenario};

/// Solves one instance.
pub(crate) fn assign(args: &AssignArgs, screen: &Screen) -> Result<Exit, Failure> {
    let path = match (args.curves, &args.instance) {
        (None, Some(path)) => path,
        (robots, _) => return curves::curves(args, robots.unwrap_or(0), screen),
    };
    if args.report.is_some() {
        return Err(Failure::new("--report draws the curves of `cotama assign --curves`"));
    }
    let (instance, figures) = instance(path)?;
    let greedy = args.greedy.then(|| greedy(&instance)).transpose()?;
    let found = instance.solve(args.steps).map_err(|error| Failure::new(error.to_string()))?;
    let mut answer = answer(&instance, &found, greedy);
    answer.team = figures.as_ref().map(|it| team_row(it, &instance, answer.cost));
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let searched = matches!(answer.certificate, Certificate::Search { .. });
        let next = (answer.status == AssignStatus::Unknown && searched).then(|| {
            let steps = args.steps.saturating_mul(10);
            format!("cotama assign {} --steps {steps}", quoted(path))
        });
        screen.print(&render::assign::screen(&instance, &answer, next, screen.width()))?;
    }
    Ok(match answer.status {
        AssignStatus::Optimal => Exit::Success,
        AssignStatus::Infeasible => Exit::Violated,
        AssignStatus::Unknown => Exit::Unknown,
    })
}

/// The instance of a file; of a team at work all its tasks as it starts, with its figures.
fn instance(path: &str) -> Result<(Instance, Option<Figures>), Failure> {
    let at_work = |it: &Scenario| (Instance::from(it), Some(it.figures()));
    if let Some(team) = team::Team::named(path) {
        return Ok(at_work(&Chosen::Known(team).scenario()));
    }
    let what = "a team with its tasks";
    let wanted = [Kind::Team, Kind::TeamAtWork];
    let text = kind::text(path, what, input::INSTANCE_BYTES, &wanted)?;
    let name = input::name(path);
    if kind::is_of(&text, Kind::TeamAtWork) {
        return Ok(at_work(&team::read(path, name, &text)?));
    }
    Ok((Instance::parse(name, &text)?, None))
}

fn team_row(figures: &Figures, instance: &Instance, cost: Option<u64>) -> TeamRow {
    let permille = |it: Ratio| {
        u64::try_from(it.numerator().saturating_mul(1_000) / it.denominator()).unwrap_or(u64::MAX)
    };
    let fraction = |it: Ratio| Fraction { exact: it.to_string(), permille: permille(it) };
    // Costs are in parts of a ms.
    let utility = instance.tasks.iter().map(|it| it.skip.map(|it| u64::from(it.get())));
    let utility = utility.sum::<Option<u64>>().map(|it| it * u64::from(instance.denominator));
    let performance = cost.zip(utility).and_then(|(cost, utility)| {
        let left = (i128::from(utility) - i128::from(cost)) * 1_000;
        i64::try_from(left.checked_div_euclid(utility.into())?).ok()
    });
    TeamRow {
        performance_permille: performance,
        heterogeneity: figures.heterogeneity.map(fraction),
        bound: figures.bound.map(fraction),
        pruning: figures.pruning.map(|it| PruningRow {
            coalitions: it.coalitions,
            steps: it.steps,
            conditions: [
                ("cap1", it.union, it.steps_union),
                ("cap2", it.roles, it.steps_roles),
                ("cap3", it.matching, it.steps_matching),
            ]
            .map(|(name, passed, steps)| PruningCondition { name, passed, steps })
            .to_vec(),
        }),
    }
}

/// Returns the result of greedy rounds.
fn greedy(instance: &Instance) -> Result<GreedyRow, Failure> {
    let robots = instance.robots.len();
    let rounds = instance.greedy().ok_or_else(|| {
        let message = if robots > Team::MAX_ROBOTS {
            format!(
                "--greedy: rounds are for {} robots at most, and these are {robots}",
                Team::MAX_ROBOTS
            )
        } else {
            "--greedy: the costs of this team are too large for rounds".to_owned()
        };
        Failure::new(message).help("leave --greedy out: the least cost is found without it")
    })?;
    Ok(GreedyRow { cost: rounds.cost, unserved: rounds.unserved, rounds: rounds.rounds })
}

fn answer(instance: &Instance, found: &Assignment, greedy: Option<GreedyRow>) -> AssignAnswer {
    let robots = |list: &[usize]| names(&instance.robots, list);
    let done = found.done.iter().filter_map(|it| {
        let task = instance.tasks.get(it.task)?;
        let plan = task.plans.get(it.plan).filter(|_| task.is_for_several);
        Some(DoneRow {
            task: task.name.clone(),
            plan: plan.map(|it| it.name.clone()),
            robots: robots(&it.robots),
            cost: instance.cost_of(it).unwrap_or(0),
        })
    });
    let (status, why_infeasible) = match &found.verdict {
        Verdict::Optimal { .. } => (AssignStatus::Optimal, None),
        Verdict::Unknown { .. } => (AssignStatus::Unknown, None),
        Verdict::Infeasible(reason) => {
            let tasks = reason.tasks.iter().filter_map(|it| instance.tasks.get(*it));
            let tasks = tasks.map(|it| it.name.clone()).collect();
            let why = WhyInfeasible { tasks, robots: robots(&reason.robots) };
            (AssignStatus::Infeasible, Some(why))
        }
    };
    AssignAnswer {
        schema: "cotama/assign/1",
        name: instance.name.clone(),
        status,
        cost: found.cost(),
        cost_denominator: instance.denominator,
        lower_bound: found.bound(),
        assignment: done.collect(),
        why_infeasible,
        certificate: certificate(instance, &found.proof),
        greedy,
        team: None,
    }
}

fn certificate(instance: &Instance, proof: &Proof) -> Certificate {
    match proof {
        Proof::Prices(prices) => Certificate::Prices { robot_prices: prices.clone() },
        Proof::Hall => Certificate::Hall,
        Proof::Search { steps, nodes } => Certificate::Search { steps: *steps, nodes: *nodes },
        Proof::TooLarge { limit } => Certificate::Limit { limit: limit.clone() },
        Proof::Plans(proofs) => {
            let plans = instance.tasks.first().map_or(&[][..], |it| &it.plans);
            let plans = plans.iter().zip(proofs).map(|(plan, it)| row(instance, plan, it));
            Certificate::Plans { plans: plans.collect() }
        }
    }
}

fn row(instance: &Instance, plan: &InstancePlan, proof: &PlanProof) -> ProofRow {
    let conflict = |roles: &[usize], robots: &[usize]| {
        (Some(names(&plan.roles, roles)), Some(names(&instance.robots, robots)))
    };
    let row = ProofRow { plan: plan.name.clone(), cost: proof.cost(), ..ProofRow::default() };
    match proof {
        PlanProof::Prices { prices, .. } => ProofRow { robot_prices: Some(prices.clone()), ..row },
        PlanProof::Threshold { largest, roles, robots, .. } => {
            let (roles, robots) = conflict(roles, robots);
            ProofRow { threshold: Some(*largest), roles, robots, ..row }
        }
        PlanProof::Impossible { roles, robots } => {
            let (roles, robots) = conflict(roles, robots);
            ProofRow { roles, robots, ..row }
        }
    }
}

fn names(all: &[String], list: &[usize]) -> Vec<String> {
    list.iter().filter_map(|it| all.get(*it)).cloned().collect()
}
