//! The screen of `cotama assign`: who does what, what it costs, and why it costs no less.

use super::numbers::{count, grouped, milli};
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{described, visible, wrapped};
use crate::answers::assign::{
    AssignAnswer, AssignStatus, Certificate, Fraction, GreedyRow, ProofRow, TeamRow,
};
use cotama_models::team::instance::Instance;
use std::fmt::Write;

/// The most tasks and plans that are shown, and the most names of a list.
const SHOWN: usize = 100;
const NAMES: usize = 8;

/// The screen; `next` is the command that suggests itself.
pub(crate) fn screen(
    instance: &Instance,
    answer: &AssignAnswer,
    next: Option<String>,
    width: usize,
) -> String {
    let parts = answer.cost_denominator;
    let (style, word) = match answer.status {
        AssignStatus::Optimal => (GOOD, "optimal"),
        AssignStatus::Infeasible => (BAD, "infeasible"),
        AssignStatus::Unknown => (NOTICE, "unknown"),
    };
    let mut text = format!(
        "{HEADING}{}{HEADING:#}: {}, {}; {style}{word}{style:#}\n",
        visible(&answer.name),
        count(instance.robots.len() as u64, "robot"),
        count(instance.tasks.len() as u64, "task"),
    );
    if answer.cost.is_some() {
        text.push('\n');
        text += &tasks(instance, answer).render(width);
        if instance.tasks.len() > SHOWN {
            let _ = writeln!(text, "  and {} more tasks: see --json", instance.tasks.len() - SHOWN);
        }
    }
    text.push('\n');
    let mut line = |name: &str, said: &str| text += &described(name, 6, FAINT, said, width);
    if let Some(cost) = answer.cost {
        line("cost", &amount(cost, parts));
    }
    if let (AssignStatus::Unknown, Some(bound)) = (answer.status, answer.lower_bound) {
        line("bound", &format!("no assignment costs less than {}", amount(bound, parts)));
    }
    if let Some(why) = &answer.why_infeasible {
        let (tasks, robots) = (listed(&why.tasks), listed(&why.robots));
        let must = match why.tasks.len() {
            1 => "must be done, and its roles",
            _ => "must all be done, and they",
        };
        line("reason", &format!("{tasks} {must} compete for {robots}"));
    }
    line("proof", &proof(instance, answer));
    if let Certificate::Plans { plans } = &answer.certificate {
        for plan in plans.iter().take(SHOWN) {
            text += &wrapped(&why(instance, plan, parts), width, "    ");
        }
    }
    if let Some(greedy) = &answer.greedy {
        text += &described("greedy", 6, FAINT, &greedy_rounds(greedy, answer, parts), width);
    }
    if let Some(team) = &answer.team {
        text += &figures(team, width);
    }
    text + &super::next(next)
}

/// Figures of a team at work, with what each means.
fn figures(team: &TeamRow, width: usize) -> String {
    let mut text = format!("\n{HEADING}the team{HEADING:#}\n");
    let mut line = |name: &str, said: &str| text += &described(name, 13, FAINT, said, width);
    if let Some(it) = team.performance_permille {
        let words = "of the utility of all tasks is left when the cost is taken away (2.7)";
        line("performance", &format!("{} {words}", milli(i128::from(it) * 100, 1, " %")));
    }
    if let Some(it) = &team.heterogeneity {
        let words = "of their capabilities two robots do not share, on average (3.5)";
        line("heterogeneity", &format!("{}: {} {words}", it.exact, percent(it)));
    }
    if let Some(it) = &team.bound {
        let words = "of the best reward is kept by greedy rounds at least, while enough capable \
                     coalitions are free (3.5.3)";
        line("bound", &format!("{} {words}", percent(it)));
    }
    if let Some(it) = team.pruning.as_ref().filter(|it| it.coalitions > 0) {
        let passed: Vec<String> = it
            .conditions
            .iter()
            .map(|it| format!("{} by {}", grouped(&it.passed.to_string()), it.name))
            .collect();
        let all = grouped(&it.coalitions.to_string());
        line("coalitions", &format!("{all}, of which pass {} (3.4.2)", passed.join(", ")));
        let steps: Vec<String> = it
            .conditions
            .iter()
            .map(|it| format!("{} with {}", grouped(&it.steps.to_string()), it.name))
            .collect();
        let all = grouped(&it.steps.to_string());
        line("steps", &format!("{all} to assign their roles, {}", steps.join(", ")));
    }
    text
}

fn percent(it: &Fraction) -> String {
    milli(i128::from(it.permille) * 100, 1, " %")
}

/// Tasks with who does them.
fn tasks(instance: &Instance, answer: &AssignAnswer) -> Table {
    let head = ["task", "by", "plan", "cost"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]).left(1).left(2);
    let mut done = answer.assignment.iter().peekable();
    for task in &instance.tasks {
        let own = done.next_if(|it| it.task == task.name);
        let name = Cell::new(visible(&task.name), NAME);
        let parts = answer.cost_denominator;
        let row = if let Some(row) = own {
            let plan = row.plan.as_deref().unwrap_or_default();
            let robots = row.robots.iter().take(NAMES).map(|it| visible(it)).collect::<Vec<_>>();
            let more = if row.robots.len() > NAMES { ", ..." } else { "" };
            let robots = format!("{}{more}", robots.join(", "));
            vec![name, Cell::plain(robots), Cell::plain(visible(plan)), cell(row.cost, parts)]
        } else {
            let skip = u64::from(task.skip.map_or(0, cotama_core::team::Cost::get));
            let cost = skip.saturating_mul(parts.into());
            vec![name, Cell::faint("left undone"), Cell::plain(""), cell(cost, parts)]
        };
        table.row(row);
        if table.len() > SHOWN {
            break;
        }
    }
    table
}

fn cell(cost: u64, parts: u32) -> Cell {
    Cell::plain(amount(cost, parts))
}

/// Parts as units, with a fraction in lowest terms.
pub(super) fn amount(cost: u64, parts: u32) -> String {
    let parts = u64::from(parts.max(1));
    let (whole, rest) = (cost / parts, cost % parts);
    let whole = grouped(&whole.to_string());
    if rest == 0 {
        return whole;
    }
    let (mut a, mut b) = (parts, rest);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    format!("{whole} {}/{}", rest / a, parts / a)
}

/// Names in words, not too many.
fn listed(names: &[String]) -> String {
    let shown: Vec<_> = names.iter().take(NAMES).map(|it| visible(it)).collect();
    match (shown.as_slice(), names.len()) {
        ([], _) => "nobody".into(),
        ([one], _) => one.clone(),
        ([first @ .., last], all) if all <= NAMES => format!("{} and {last}", first.join(", ")),
        (_, all) => format!("{} and {} more", shown.join(", "), all - NAMES),
    }
}

/// Why the answer is right, in a sentence.
fn proof(instance: &Instance, answer: &AssignAnswer) -> String {
    match &answer.certificate {
        Certificate::Prices { robot_prices } => match priced(instance, robot_prices) {
            None => "each task has its cheapest robot, or costs no more undone".into(),
            Some(prices) => {
                let sum: u64 = robot_prices.iter().sum();
                let all = answer.cost.unwrap_or(0) / u64::from(answer.cost_denominator.max(1));
                format!(
                    "give robots a price: {prices}. Each task then costs its cheapest robot with \
                     its price at least, or what it costs undone: {} in all. Less the prices, {}, \
                     no assignment costs below {}",
                    grouped(&all.saturating_add(sum).to_string()),
                    grouped(&sum.to_string()),
                    grouped(&all.to_string()),
                )
            }
        },
        Certificate::Plans { .. } if answer.why_infeasible.is_some() => {
            "no plan has a robot of its own for each role:".into()
        }
        Certificate::Plans { .. } => "no plan costs less than here:".into(),
        Certificate::Hall => {
            let why = answer.why_infeasible.as_ref();
            let (tasks, robots) = why.map_or((0, 0), |it| (it.tasks.len(), it.robots.len()));
            let named = |it: &&cotama_models::team::instance::InstanceTask| {
                why.is_some_and(|why| why.tasks.contains(&it.name))
            };
            let several = instance.tasks.iter().filter(named).any(|it| it.is_for_several);
            let few = match robots {
                0 => "no robot".to_owned(),
                it => format!("only {}", count(it as u64, "robot")),
            };
            let tasks = count(tasks as u64, "task");
            if several {
                let needed = count(robots as u64 + 1, "robot");
                format!("{tasks} with roles that need {needed}, and {few} can fill any of these")
            } else {
                format!("{tasks} need a robot each, and {few} can do any of them")
            }
        }
        Certificate::Search { steps, nodes } => {
            let left = match answer.status {
                AssignStatus::Optimal => "left nothing that costs less",
                AssignStatus::Infeasible => "left no way to serve all of them",
                AssignStatus::Unknown => "did not end",
            };
            let (nodes, steps) = (count(*nodes, "node"), grouped(&steps.to_string()));
            format!("a search of {nodes} and {steps} steps {left}")
        }
        Certificate::Limit { limit } => {
            format!("too large for all tasks at once ({limit}); each task alone costs so much")
        }
    }
}

/// The robots with a price, in words; none where nobody has one.
fn priced(instance: &Instance, prices: &[u64]) -> Option<String> {
    let priced = instance.robots.iter().zip(prices).filter(|it| *it.1 > 0);
    let said = |(robot, price): (&String, &u64)| {
        format!("{} {}", visible(robot), grouped(&price.to_string()))
    };
    let all: Vec<_> = priced.map(said).collect();
    (!all.is_empty()).then(|| listed(&all))
}

/// Why a plan costs no less.
fn why(instance: &Instance, plan: &ProofRow, parts: u32) -> String {
    let cost = plan.cost.map_or_else(|| "impossible".into(), |it| amount(it, parts));
    let name = format!("{NAME}{}{NAME:#} {cost}: ", visible(&plan.plan));
    let (roles, robots) = (plan.roles.as_deref(), plan.robots.as_deref());
    let (roles, robots) = (roles.unwrap_or_default(), robots.unwrap_or_default());
    let only = |robots: &[String]| match robots {
        [] => "nobody".into(),
        _ => format!("{} only", listed(robots)),
    };
    let said = match (&plan.robot_prices, plan.threshold) {
        (Some(prices), _) => match priced(instance, prices) {
            None => "each role has its cheapest robot".into(),
            Some(it) => format!("each role has its cheapest robot if robots have a price: {it}"),
        },
        (None, Some(limit)) if roles.is_empty() => format!("no role costs less than {limit}"),
        (None, Some(limit)) => {
            format!("below {limit} there is {} for {}", only(robots), listed(roles))
        }
        (None, None) => format!("there is {} for {}", only(robots), listed(roles)),
    };
    format!("{name}{said}")
}

/// Returns the cost and the loss of greedy rounds.
fn greedy_rounds(greedy: &GreedyRow, answer: &AssignAnswer, parts: u32) -> String {
    let cost = amount(greedy.cost, parts);
    let rounds = count(greedy.rounds as u64, "round");
    if greedy.unserved > 0 {
        let left = count(greedy.unserved as u64, "task");
        return format!("{left} that must be done is not, after {rounds}; the others cost {cost}")
            .replace("tasks that must be done is", "tasks that must be done are");
    }
    let more = match answer.cost {
        Some(best) if greedy.cost > best && best > 0 => {
            let permille = (u128::from(greedy.cost - best) * 1_000).div_ceil(best.into());
            format!(", {}.{} % more", permille / 10, permille % 10)
        }
        Some(best) if greedy.cost > best => " in place of 0".into(),
        Some(_) => ", no more".into(),
        None => String::new(),
    };
    format!("{cost}{more}, after {rounds}")
}
