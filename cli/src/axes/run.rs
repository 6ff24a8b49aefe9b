//! `cotama run` of a mission with performance axes of its own.

use super::File;
use crate::answers::axes::TotalRow;
use crate::answers::axes_run::{
    AxesOutcome, AxesPlanRow, AxesRunAnswer, ChoiceRow, MarginRow, MomentRow,
};
use crate::args::RunArgs;
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::render;
use cotama_axes::{Course, Kind, Mission, Script, label};
use cotama_tours::{Cause, NotRun, Outcome, Planned, Run, run as drive};

/// Runs a mission with axes: plans it, lets happen what its file says, plans again.
pub(crate) fn run(args: &RunArgs, screen: &Screen) -> Result<Exit, Failure> {
    refuse_others(args)?;
    let name = &args.mission.mission;
    let mut file = File::load(name)?;
    if args.faults == "none" {
        file.case.course = Course { script: Script::default(), ..file.case.course };
    }
    let mission = &file.case.mission;
    let mut no_return = None;
    let answer = match drive(&file.case) {
        Ok(run) => answer(mission, &run),
        Err(NotRun::Wrong(it)) => return Err(file.wrong(it)),
        Err(NotRun::Equality(at)) => {
            let id = constraint(mission, at);
            let message = format!("`{id}` asks for equality at the end, which no run keeps");
            return Err(Failure::new(message).help("write `<=` and `>=` with goals of their own"));
        }
        Err(why) => {
            if let NotRun::NoReturn(x_mm) = why {
                no_return = Some(x_mm);
            }
            stays(mission, &why)
        }
    };
    let exit = match answer.outcome {
        AxesOutcome::Completed => Exit::Success,
        AxesOutcome::Unknown => Exit::Unknown,
        _ => Exit::Violated,
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::axes_run::screen(&answer, no_return, screen.width()))?;
    }
    Ok(exit)
}

/// Refuses options of other missions.
fn refuse_others(args: &RunArgs) -> Result<(), Failure> {
    let seed = args.seed.map(|_| "--seed");
    let first = args.planning.first().or(args.recording.first()).or(args.team.first());
    match first.or(args.first_of_missions()).or(seed) {
        None => Ok(()),
        Some(option) => {
            let message = format!("{option}: a mission with axes is run as its file says");
            Err(Failure::new(message).help(format!("leave {option} out")))
        }
    }
}

fn constraint(mission: &Mission, at: usize) -> String {
    mission.constraints.get(at).map_or_else(String::new, |it| it.id.clone())
}

/// The robot stays where it is.
fn stays(mission: &Mission, why: &NotRun) -> AxesRunAnswer {
    AxesRunAnswer {
        schema: "cotama/run-axes/1",
        mission: mission.name.clone(),
        outcome: if *why == NotRun::Limit { AxesOutcome::Unknown } else { AxesOutcome::Infeasible },
        constraint: None,
        t_ms: 0,
        x_mm: mission.objectives.first().map_or(0, |it| it.x_start_mm),
        used: Vec::new(),
        margins: Vec::new(),
        plans: Vec::new(),
        turned: None,
        hurried: None,
    }
}

fn answer(mission: &Mission, run: &Run) -> AxesRunAnswer {
    let (outcome, broken) = match run.outcome {
        Outcome::Completed => (AxesOutcome::Completed, None),
        Outcome::Missed(it) => (AxesOutcome::Missed, Some(it)),
        Outcome::Returned => (AxesOutcome::Returned, None),
        Outcome::Stopped => (AxesOutcome::Stopped, None),
        Outcome::Stranded(it) => (AxesOutcome::Stranded, Some(it)),
    };
    let used = |at: usize| run.used.get(at).copied().unwrap_or(0);
    let sums = mission.indicators.iter().enumerate().filter(|it| it.1.adds_up);
    let moment = |(t_ms, x_mm)| MomentRow { t_ms, x_mm };
    let margin = |it: &cotama_axes::Constraint| MarginRow {
        constraint: it.id.clone(),
        unit: mission.indicators.get(it.indicator).map_or_else(String::new, |it| it.unit.clone()),
        value: it.relation.margin(used(it.indicator), it.goal),
    };
    AxesRunAnswer {
        schema: "cotama/run-axes/1",
        mission: mission.name.clone(),
        outcome,
        constraint: broken.map(|it| constraint(mission, it)),
        t_ms: run.t_ms,
        x_mm: run.x_mm,
        used: sums
            .map(|(at, it)| TotalRow {
                indicator: it.id.clone(),
                unit: it.unit.clone(),
                value: used(at),
            })
            .collect(),
        margins: mission.constraints.iter().filter(|it| it.kind == Kind::End).map(margin).collect(),
        plans: run.plans.iter().map(|it| plan(mission, it)).collect(),
        turned: run.turned.map(moment),
        hurried: run.hurried.map(moment),
    }
}

fn plan(mission: &Mission, it: &Planned) -> AxesPlanRow {
    let hardware = |at: usize| mission.hardware.get(at).map_or("", |it| it.id.as_str());
    let objective = |at: usize| mission.objectives.get(at).map_or("", |it| it.id.as_str());
    AxesPlanRow {
        t_ms: it.t_ms,
        x_mm: it.x_mm,
        cause: match it.cause {
            Cause::Start => "start".into(),
            Cause::Margin(at) => format!("margin of {}", constraint(mission, at)),
            Cause::Lost(at) => format!("{} lost", hardware(at)),
        },
        choices: it
            .choices
            .iter()
            .map(|it| ChoiceRow {
                objective: objective(it.objective).into(),
                x_start_mm: it.x_start_mm,
                options: label(mission, &it.options),
                speed_mm_s: it.speed_mm_s,
            })
            .collect(),
    }
}
