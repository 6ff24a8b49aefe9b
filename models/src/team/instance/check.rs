//! From what a file says to an instance: nothing is missing, and everything fits together.

use super::context::{Context, Step};
use super::draft::{Draft, DraftPlan, DraftRole, DraftTask, List, Skip};
use super::{FORMAT, Instance, InstancePlan, InstanceTask, Kind, MAX_INSTANCE_ENTRIES};
use crate::missions::Spanned;
use crate::names::quoted;
use cotama_core::team::{Combine, Cost};
use std::collections::HashMap;
use std::ops::Range;

const NAMES_HELP: &str = "give each a name of its own";

/// Turns a draft into an instance, if nothing of it is missing; reports the values that do not fit.
pub(super) fn complete(all: &mut Context, draft: Draft) -> Option<Instance> {
    let whole = draft.span.clone();
    if let Some(format) = draft.format.as_ref().filter(|it| it.value != FORMAT) {
        all.errors.clear(); // what follows may be meant otherwise
        let help = format!("write `{FORMAT}`");
        all.at(Step::Field("format"), |all| {
            all.wrong(format.span.clone(), "this is no format that is read here", &help);
        });
        return None;
    }
    let there = [
        ("format", draft.format.is_some(), FORMAT),
        ("name", draft.name.is_some(), "the name of the instance"),
        ("kind", draft.kind.is_some(), "single, coalition-mean, coalition-max or simultaneous"),
        ("cost_denominator", draft.denominator.is_some(), "1, unless means are to be exact"),
        ("robots", draft.robots.is_some(), "a list of names"),
        ("tasks", draft.tasks.is_some(), "a list of tasks"),
    ];
    all.unread = !all.errors.is_empty();
    for (name, _, help) in there.iter().filter(|it| !it.1) {
        all.missing(whole.clone(), name, help);
    }
    if draft.entries > MAX_INSTANCE_ENTRIES {
        let what = format!("{} costs, and at most {MAX_INSTANCE_ENTRIES} are read", draft.entries);
        all.wrong(whole, &what, "");
        return None;
    }
    let (robots, kind, denominator) = (draft.robots?, draft.kind?, draft.denominator?);
    all.at(Step::Field("robots"), |all| distinct(all, robots.iter().map(Some), None));
    let mut checked =
        Checked { robots: robots.len(), kind: kind.value, denominator: denominator.value };
    let drafts = draft.tasks?;
    if kind.value != Kind::Single && kind.value != Kind::Simultaneous && drafts.len() != 1 {
        let what = format!("{} tasks, and kind `{}` has one", drafts.len(), kind.value.name());
        let help = "of several tasks at once the kind is `simultaneous`";
        all.at(Step::Field("tasks"), |all| all.wrong(kind.span, &what, help));
    }
    let tasks = all.at(Step::Field("tasks"), |all| {
        distinct(all, drafts.iter().map(|it| it.name.as_ref()), Some("name"));
        let one = |(number, it)| all.at(Step::Number(number), |all| checked.task(all, it));
        drafts.into_iter().enumerate().map(one).collect::<Vec<_>>()
    });
    let tasks = tasks.into_iter().collect::<Option<Vec<_>>>()?;
    let most: u128 = tasks.iter().map(most_of).sum();
    if most * u128::from(denominator.value) > i64::MAX as u128 {
        all.at(Step::Field("cost_denominator"), |all| {
            all.wrong(denominator.span, "in such parts the cost may pass 63 bits", "");
        });
    }
    Some(Instance {
        name: draft.name?.value,
        kind: kind.value,
        denominator: denominator.value,
        robots: robots.into_iter().map(|it| it.value).collect(),
        tasks,
    })
}

/// The most that a task may cost, in units.
fn most_of(task: &InstanceTask) -> u128 {
    let plan = |it: &InstancePlan| {
        let largest = it.costs.iter().flatten().map(|it| it.get()).max().unwrap_or(0);
        u128::from(largest) * it.roles.len() as u128 + u128::from(it.extra)
    };
    let skip = task.skip.map_or(0, Cost::get);
    task.plans.iter().map(plan).max().unwrap_or(0).max(skip.into())
}

/// Names differ from one another; they stand at a field of the elements of the current path.
fn distinct<'n>(
    all: &mut Context,
    names: impl Iterator<Item = Option<&'n Spanned<String>>>,
    field: Option<&'static str>,
) {
    let mut known = HashMap::new();
    for (number, name) in names.enumerate() {
        let Some(name) = name else { continue };
        let Some(first) = known.insert(name.value.as_str(), number) else { continue };
        let what = format!("{} is already the name of number {first}", quoted(&name.value));
        all.at(Step::Number(number), |all| match field {
            Some(field) => {
                all.at(Step::Field(field), |all| all.wrong(name.span.clone(), &what, NAMES_HELP));
            }
            None => all.wrong(name.span.clone(), &what, NAMES_HELP),
        });
    }
}

/// The figures that tasks are checked against.
struct Checked {
    robots: usize,
    kind: Kind,
    denominator: u32,
}

impl Checked {
    fn task(&mut self, all: &mut Context, draft: DraftTask) -> Option<InstanceTask> {
        let span = draft.span;
        if draft.name.is_none() {
            all.missing(span.clone(), "name", "each task has a name");
        }
        if draft.skip.is_none() {
            let help = "null if the task must be done, else what it costs to leave it undone";
            all.missing(span.clone(), "skip_cost", help);
        }
        let plans = match (draft.cost, draft.plans) {
            (Some(_), Some(plans)) => {
                let help = "`cost` is of a task for one robot, `plans` of one for several";
                all.wrong(plans.span, "both `cost` and `plans`", help);
                return None;
            }
            (None, None) => {
                let help = "`cost` if it needs one robot, one entry each; else `plans`";
                all.missing(span, "cost", help);
                return None;
            }
            (Some(cost), None) => {
                if let Some(combine) = &draft.combine {
                    all.wrong(combine.span.clone(), "`combine` without `plans`", "leave it out");
                }
                if !matches!(self.kind, Kind::Single | Kind::Simultaneous) {
                    let what = format!("`cost`, and kind `{}` has `plans`", self.kind.name());
                    let help = "of tasks for one robot the kind is `single`";
                    all.wrong(cost.span.clone(), &what, help);
                }
                let costs = all.at(Step::Field("cost"), |all| self.costs(all, Some(cost)))?;
                vec![InstancePlan {
                    name: String::new(),
                    extra: 0,
                    roles: vec![String::new()],
                    costs,
                }]
            }
            (None, Some(plans)) => {
                return self.several(all, draft.name, draft.skip, draft.combine, plans, &span);
            }
        };
        Some(InstanceTask {
            name: draft.name?.value,
            skip: draft.skip?.0,
            combine: Combine::Sum,
            is_for_several: false,
            plans,
        })
    }

    fn several(
        &mut self,
        all: &mut Context,
        name: Option<Spanned<String>>,
        skip: Option<Skip>,
        combine: Option<Spanned<Combine>>,
        plans: Spanned<Vec<DraftPlan>>,
        span: &Range<usize>,
    ) -> Option<InstanceTask> {
        let wanted = match self.kind {
            Kind::CoalitionMean => Some((Combine::Mean, "mean")),
            Kind::CoalitionMax => Some((Combine::Max, "max")),
            Kind::Single | Kind::Simultaneous => None,
        };
        if self.kind == Kind::Single {
            let help = "of tasks for several robots the kind is `simultaneous`";
            all.wrong(plans.span.clone(), "`plans`, and kind `single` has none", help);
        }
        if plans.value.is_empty() {
            all.wrong(plans.span.clone(), "`plans` is empty", "give at least one plan");
        }
        match (&combine, wanted) {
            (None, _) => all.missing(span.clone(), "combine", "sum, mean or max"),
            (Some(said), Some((wanted, name))) if said.value != wanted => {
                let what = format!("kind `{}` needs `combine` to be `{name}`", self.kind.name());
                all.wrong(said.span.clone(), &what, "");
            }
            _ => {}
        }
        let is_mean = combine.as_ref().is_some_and(|it| it.value == Combine::Mean);
        let plans = all.at(Step::Field("plans"), |all| {
            distinct(all, plans.value.iter().map(|it| it.name.as_ref()), Some("name"));
            let one =
                |(number, it)| all.at(Step::Number(number), |all| self.plan(all, it, is_mean));
            plans.value.into_iter().enumerate().map(one).collect::<Vec<_>>()
        });
        let plans = plans.into_iter().collect::<Option<Vec<_>>>()?;
        let (name, combine) = (name?.value, combine?.value);
        Some(InstanceTask { name, skip: skip?.0, combine, is_for_several: true, plans })
    }

    fn plan(&mut self, all: &mut Context, draft: DraftPlan, is_mean: bool) -> Option<InstancePlan> {
        if draft.name.is_none() {
            all.missing(draft.span.clone(), "name", "each plan has a name");
        }
        let Some(roles) = draft.roles else {
            all.missing(draft.span, "roles", "each plan has at least one role");
            return None;
        };
        let count = roles.value.len();
        let rest = (self.denominator as usize).checked_rem(count);
        if count == 0 {
            all.wrong(roles.span, "`roles` is empty", "give at least one role");
            return None;
        } else if is_mean && rest != Some(0) {
            let what = format!(
                "{count} roles, whose mean is not whole in parts of 1/{}",
                self.denominator
            );
            let help = "let `cost_denominator` be a multiple of the number of roles of each plan";
            all.at(Step::Field("roles"), |all| all.wrong(roles.span, &what, help));
        }
        let (mut names, mut costs, mut whole) = (vec![], vec![], true);
        all.at(Step::Field("roles"), |all| {
            distinct(all, roles.value.iter().map(|it| it.name.as_ref()), Some("name"));
            for (number, role) in roles.value.into_iter().enumerate() {
                all.at(Step::Number(number), |all| {
                    let DraftRole { span, name, cost } = role;
                    if name.is_none() {
                        all.missing(span.clone(), "name", "each role has a name");
                    }
                    if cost.is_none() {
                        all.missing(span, "cost", "one entry a robot, null if it is not capable");
                    }
                    let own = all.at(Step::Field("cost"), |all| self.costs(all, cost));
                    whole &= own.is_some() && name.is_some();
                    names.extend(name.map(|it| it.value));
                    costs.extend(own.unwrap_or_default());
                });
            }
        });
        let name = draft.name?.value;
        whole.then_some(InstancePlan { name, extra: draft.extra, roles: names, costs })
    }

    /// A list with one entry a robot.
    fn costs(&mut self, all: &mut Context, list: Option<List>) -> Option<Vec<Option<Cost>>> {
        let Spanned { value, span } = list?;
        if value.len() != self.robots {
            let entries = if value.len() == 1 { "entry" } else { "entries" };
            let robots = if self.robots == 1 { "robot" } else { "robots" };
            let what = format!("{} {entries}, {} {robots}", value.len(), self.robots);
            all.wrong(span, &what, "give one entry a robot, null if it is not capable");
            return None;
        }
        Some(value)
    }
}
