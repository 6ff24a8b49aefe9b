//! From text to what an instance says, field by field.

use super::check::complete;
use super::context::Context;
use super::draft::{
    Draft, DraftPlan, DraftRole, DraftTask, List, MAX_COST, MAX_INSTANCE_ENTRIES, Skip,
};
use super::{Instance, Kind};
use crate::json::{Advice, Broken, Json};
use crate::missions::{MissionErrors, Spanned};
use crate::names::unknown;
use cotama_core::team::{Combine, Cost};

/// Advice on a file that is no JSON.
const ADVICE: Advice = Advice {
    help: "an instance is one JSON object; `cotama help assign` shows one",
    no_number: "this is no number of JSON: write `null` where a robot is not capable",
};

impl Instance {
    /// Reads a `cotama-team-assignment/1` file. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places; one where it is no JSON.
    ///
    /// ```
    /// use cotama_models::team::instance::Instance;
    /// let text = r#"{"format": "cotama-team-assignment/1", "name": "mine", "kind": "single",
    ///  "cost_denominator": 1, "robots": ["anna", "ben"],
    ///  "tasks": [{"name": "mop", "skip_cost": null, "cost": [3, 2, 4]}]}"#;
    /// let errors = Instance::parse("mine.json", text).unwrap_err().to_string();
    /// let first = "mine.json:3:55: tasks[0].cost: 3 entries, 2 robots";
    /// assert_eq!(errors.lines().next(), Some(first));
    /// let right = Instance::parse("mine.json", &text.replace(", 4]", "]")).unwrap();
    /// assert_eq!(right.solve(1_000).unwrap().cost(), Some(2));
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let mut all = Context::default();
        let mut draft = Draft::default();
        let read = document(text, &mut all, &mut draft);
        let instance = match read {
            Ok(()) => complete(&mut all, draft),
            Err(broken) => {
                all.errors.push(broken);
                None
            }
        };
        match instance {
            Some(instance) if all.errors.is_empty() => Ok(instance),
            _ => Err(MissionErrors::new(source_name, text, all.errors)),
        }
    }
}

fn document(text: &str, all: &mut Context, draft: &mut Draft) -> Result<(), Broken> {
    let json = &mut Json::new(text, &ADVICE);
    let start = json.start();
    let keys =
        ["format", "name", "kind", "cost_denominator", "robots", "tasks", "note", "expected"];
    all.object(json, &keys, |all, json, key, _| {
        match key {
            0 => draft.format = all.text(json)?,
            1 => draft.name = all.name(json)?,
            2 => {
                let names = Kind::ALL.map(|it| (it.name(), it));
                draft.kind = choice(all, json, "kind", &names)?;
            }
            3 => {
                let start = json.start();
                let value = all.whole(json, 1, MAX_COST)?;
                let span = json.since(start);
                draft.denominator = value.map(|value| Spanned { value, span });
            }
            4 => {
                let mut robots = vec![];
                let is = all.list(json, |all, json| {
                    robots.extend(all.name(json)?);
                    Ok(())
                })?;
                draft.robots = is.then_some(robots);
            }
            5 => {
                let (mut tasks, entries) = (vec![], &mut draft.entries);
                let is = all.list(json, |all, json| {
                    tasks.push(task(all, json, entries)?);
                    Ok(())
                })?;
                draft.tasks = is.then_some(tasks);
            }
            _ => json.skip()?,
        }
        Ok(())
    })?;
    draft.span = json.since(start);
    json.end()
}

fn task(all: &mut Context, json: &mut Json<'_>, entries: &mut usize) -> Result<DraftTask, Broken> {
    let mut task = DraftTask::default();
    let start = json.start();
    let keys = ["name", "skip_cost", "cost", "combine", "plans"];
    all.object(json, &keys, |all, json, key, span| {
        match key {
            0 => task.name = all.name(json)?,
            1 => task.skip = Some(Skip(cost(all, json)?)),
            2 => task.cost = costs(all, json, entries)?,
            3 => {
                let names = [("sum", Combine::Sum), ("mean", Combine::Mean), ("max", Combine::Max)];
                task.combine = choice(all, json, "way to combine costs", &names)?;
            }
            _ => {
                let mut plans = vec![];
                let is = all.list(json, |all, json| {
                    plans.push(plan(all, json, entries)?);
                    Ok(())
                })?;
                task.plans = is.then_some(Spanned { value: plans, span });
            }
        }
        Ok(())
    })?;
    task.span = json.since(start);
    Ok(task)
}

fn plan(all: &mut Context, json: &mut Json<'_>, entries: &mut usize) -> Result<DraftPlan, Broken> {
    let mut plan = DraftPlan::default();
    let start = json.start();
    all.object(json, &["name", "extra_cost", "roles"], |all, json, key, span| {
        match key {
            0 => plan.name = all.name(json)?,
            1 => plan.extra = all.whole(json, 0, MAX_COST)?.unwrap_or(0),
            _ => {
                let mut roles = vec![];
                let is = all.list(json, |all, json| {
                    roles.push(role(all, json, entries)?);
                    Ok(())
                })?;
                plan.roles = is.then_some(Spanned { value: roles, span });
            }
        }
        Ok(())
    })?;
    plan.span = json.since(start);
    Ok(plan)
}

fn role(all: &mut Context, json: &mut Json<'_>, entries: &mut usize) -> Result<DraftRole, Broken> {
    let mut role = DraftRole::default();
    let start = json.start();
    all.object(json, &["name", "cost"], |all, json, key, _| {
        match key {
            0 => role.name = all.name(json)?,
            _ => role.cost = costs(all, json, entries)?,
        }
        Ok(())
    })?;
    role.span = json.since(start);
    Ok(role)
}

/// One of these names.
fn choice<T: Copy>(
    all: &mut Context,
    json: &mut Json<'_>,
    what: &str,
    names: &[(&str, T)],
) -> Result<Option<Spanned<T>>, Broken> {
    let Some(Spanned { value, span }) = all.text(json)? else { return Ok(None) };
    let found = names.iter().find(|it| it.0 == value);
    if found.is_none() {
        let (message, help) = unknown(what, &value, names.iter().map(|it| it.0));
        all.wrong(span.clone(), &message, &help);
    }
    Ok(found.map(|it| Spanned { value: it.1, span }))
}

/// A cost, or `null`.
fn cost(all: &mut Context, json: &mut Json<'_>) -> Result<Option<Cost>, Broken> {
    if json.null() {
        return Ok(None);
    }
    Ok(all.whole(json, 0, MAX_COST)?.and_then(Cost::new))
}

/// A list of costs; nothing where it is none.
fn costs(
    all: &mut Context,
    json: &mut Json<'_>,
    entries: &mut usize,
) -> Result<Option<List>, Broken> {
    let start = json.start();
    let mut list = vec![];
    let is = all.list(json, |all, json| {
        let cost = cost(all, json)?;
        *entries += 1;
        if *entries <= MAX_INSTANCE_ENTRIES {
            list.push(cost);
        }
        Ok(())
    })?;
    Ok(is.then_some(Spanned { value: list, span: json.since(start) }))
}
