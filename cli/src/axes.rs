//! `cotama plan` of a mission with performance axes of its own.

pub(crate) mod explain;
pub(crate) mod run;

use crate::allocate::exit;
use crate::answers::Status;
use crate::answers::axes::{
    AxesActivity, AxesAnswer, BoundRow, DroppedRow, InducerRow, LiftRow, TotalRow,
};
use crate::args::PlanArgs;
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::mission;
use crate::names::quoted;
use crate::output::Screen;
use crate::render;
use cotama_axes::why::{Binding, Cause, why};
use cotama_axes::{
    Activity, Case, Dropped, Infeasible, Lifted, Mission, Plan, Problem, Single, Steps, Stop,
    Table, Wrong, Wrongs, label,
};
use cotama_models::missions::{self, embedded};

/// Plans a mission with axes.
pub(crate) fn plan(args: &PlanArgs, screen: &Screen) -> Result<Exit, Failure> {
    planned(args, &File::load(&args.mission.mission)?, screen)
}

/// Plans a mission on its robot and its floor, whose axes limit further sums.
pub(crate) fn plan_of(
    args: &PlanArgs,
    mission: &missions::Mission,
    screen: &Screen,
) -> Result<Exit, Failure> {
    match File::of(&args.mission.mission, mission) {
        Some(file) => planned(args, &file, screen),
        None => Err(Failure::new("the speeds of this mission cannot be derived")),
    }
}

fn planned(args: &PlanArgs, file: &File, screen: &Screen) -> Result<Exit, Failure> {
    refuse_others(args)?;
    let case = &file.case;
    let mut steps = Steps::new(args.planning.steps);
    let mut answer = answer(case, &mut steps).map_err(|it| file.wrong(it))?;
    answer.steps = steps.used();
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = Some(format!("cotama explain {}", quoted(&args.mission.mission)));
        screen.print(&render::axes::screen(&case.mission, &answer, next, screen.width()))?;
    }
    Ok(exit(answer.status))
}

/// Whether a word of the command line means a mission with axes: by its name, or as a file.
pub(crate) fn is(name: &str) -> bool {
    cotama_axes::embedded(name).is_some() || kind::is(name, Kind::Axes)
}

/// Returns the axes of a mission: of one with axes alone, or on its robot and its floor; `None` of
/// one that has none, or is no mission.
pub(crate) fn file(name: &str) -> Result<Option<File>, Failure> {
    if is(name) {
        return File::load(name).map(Some);
    }
    let is_mission = embedded::mission(name).is_some() || kind::is(name, Kind::Mission);
    if !is_mission {
        return Ok(None);
    }
    Ok(File::of(name, &mission::load(name, None)?))
}

/// A mission with axes and its text.
#[derive(Debug)]
pub(crate) struct File {
    name: String,
    text: String,
    pub(crate) case: Case,
}

impl File {
    /// Reads the mission of this name, or of the file at this path.
    pub(crate) fn load(name: &str) -> Result<Self, Failure> {
        let text = match cotama_axes::embedded(name) {
            Some(it) => it.text.to_owned(),
            None => kind::text(name, "a mission with axes", input::MISSION_BYTES, &[Kind::Axes])?,
        };
        let case = Case::parse(&text).map_err(|it| wrongs(name, &text, it))?;
        Ok(Self { name: name.to_owned(), text, case })
    }

    /// Returns the axes of a mission on its robot and its floor, if it has some.
    fn of(name: &str, mission: &missions::Mission) -> Option<Self> {
        let case = mission.case()?;
        Some(Self { name: name.to_owned(), text: mission.text().to_owned(), case })
    }

    /// Says that arithmetic of a formula does not come out.
    fn wrong(&self, it: Wrong) -> Failure {
        wrongs(&self.name, &self.text, Wrongs { all: vec![it], omitted: 0 })
    }
}

fn wrongs(name: &str, text: &str, Wrongs { all, omitted }: Wrongs) -> Failure {
    let all = all.into_iter().map(|it| ((it.line, it.column), it.message, it.help));
    let errors = FileErrors::at_characters(input::name(name), text.to_owned(), all);
    FileErrors { omitted, ..errors }.folded().into()
}

/// Refuses options of other missions.
fn refuse_others(args: &PlanArgs) -> Result<(), Failure> {
    let objective = args.objective.map(|_| "--objective");
    match objective.or(args.planning.first()) {
        None => Ok(()),
        Some(option) => {
            let message = format!("{option}: a mission with axes says all of this in its file");
            Err(Failure::new(message).help(format!("leave {option} out")))
        }
    }
}

/// Plans a case; a limit that is reached is an answer.
fn answer(case: &Case, steps: &mut Steps) -> Result<AxesAnswer, Wrong> {
    let mission = &case.mission;
    let mut answer = AxesAnswer {
        schema: "cotama/plan-axes/1",
        mission: mission.name.clone(),
        activities: Vec::new(),
        combinations: String::new(),
        status: Status::Unknown,
        plan: Vec::new(),
        speeds_mm_s: Vec::new(),
        totals: Vec::new(),
        single: Vec::new(),
        blame: None,
        needed: None,
        correction: Vec::new(),
        corrections: Vec::new(),
        steps: 0,
    };
    match solve(case, &mut answer, steps) {
        Ok(()) | Err(Stop::Limit) => Ok(answer),
        Err(Stop::Wrong(wrong)) => Err(wrong),
    }
}

fn solve(case: &Case, answer: &mut AxesAnswer, steps: &mut Steps) -> Result<(), Stop> {
    let mission = &case.mission;
    let table = Table::new(mission, Lifted::default(), steps)?;
    for (number, it) in table.activities.iter().enumerate() {
        answer.activities.push(activity_row(mission, number, it)?);
    }
    let combinations = table.combinations();
    answer.combinations =
        combinations.map_or_else(|| "more than 2^128".into(), |it| it.to_string());
    let problem = Problem::new(mission, &table, Lifted::default());
    if let Some(plan) = problem.best(&case.ask, steps)? {
        answer.status = Status::Optimal;
        fill(answer, mission, &table, &plan);
        return Ok(());
    }
    // That there is none is proven, even if the reasons take too long to find.
    answer.status = Status::Infeasible;
    let found = match Infeasible::of(mission, &table, steps) {
        Err(Stop::Limit) => return Ok(()),
        found => found?,
    };
    let name = |it: usize| mission.constraints.get(it).map_or("", |it| it.id.as_str()).to_owned();
    let names = |it: &Lifted| it.iter().map(name).collect::<Vec<_>>();
    answer.corrections = found.corrections.iter().map(names).collect();
    let lift = |it: &Single| LiftRow {
        constraint: name(it.constraint),
        needed: it.needed.iter().flatten().copied().collect(),
    };
    answer.single = found.single.iter().map(lift).collect();
    let Some(blame) = found.blame else {
        answer.correction = answer.corrections.first().cloned().unwrap_or_default();
        return Ok(());
    };
    answer.blame = Some(name(blame));
    let goal = mission.constraints.get(blame).map_or(0, |it| it.goal);
    let single = found.single.iter().find(|it| it.constraint == blame);
    answer.needed = single.and_then(|it| it.nearest(goal));
    Ok(())
}

fn activity_row(
    mission: &Mission,
    number: usize,
    activity: &Activity,
) -> Result<AxesActivity, Stop> {
    let objective = mission.objectives.get(activity.objective);
    let speed_max_mm_s = activity.speed_max_mm_s();
    let fastest = activity.candidates.iter().find(|it| it.speed_mm_s == speed_max_mm_s);
    let bounds = fastest.map(|it| why(mission, activity, it)).transpose()?.unwrap_or_default();
    Ok(AxesActivity {
        id: format!("A{}", number + 1),
        objective: objective.map_or_else(String::new, |it| it.id.clone()),
        x_start_mm: activity.x_start_mm,
        x_end_mm: activity.x_end_mm,
        candidates: activity.candidates.len() as u64,
        candidates_before: activity.before() as u64,
        speed_max_mm_s,
        bounded_by: bounds.into_iter().map(|it| bound_row(mission, it)).collect(),
        dropped: activity.dropped.iter().map(|it| dropped_row(mission, it)).collect(),
    })
}

fn bound_row(mission: &Mission, bound: Binding) -> BoundRow {
    let constraint = mission.constraints.get(bound.constraint);
    BoundRow {
        constraint: constraint.map_or_else(String::new, |it| it.id.clone()),
        value: bound.value,
        value_next: bound.value_next,
        goal: bound.goal,
        inducers: bound.inducers.into_iter().map(inducer_row).collect(),
    }
}

fn inducer_row(Cause { name, value, of }: Cause) -> InducerRow {
    InducerRow { name, value, of }
}

fn dropped_row(mission: &Mission, it: &Dropped) -> DroppedRow {
    let by = it.by.iter().map(|it| it.name(mission)).collect();
    DroppedRow { options: label(mission, &it.options), by }
}

fn fill(answer: &mut AxesAnswer, mission: &Mission, table: &Table, plan: &Plan) {
    let rows = table.activities.iter().zip(&plan.choices);
    for candidate in rows.filter_map(|(it, &choice)| it.candidates.get(choice)) {
        answer.plan.push(label(mission, &candidate.options));
        answer.speeds_mm_s.push(candidate.speed_mm_s);
    }
    let sums = mission.indicators.iter().zip(&plan.totals).filter(|it| it.0.adds_up);
    answer.totals = sums
        .map(|(it, &value)| TotalRow { indicator: it.id.clone(), unit: it.unit.clone(), value })
        .collect();
}
