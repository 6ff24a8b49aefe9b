//! `cotama explain`: why candidates of a mission with axes are not faster.

use super::{dropped_row, inducer_row};
use crate::answers::explain::{
    BecauseRow, BindingRow, CandidateRow, ExplainAnswer, HeldRow, RaiseRow,
};
use crate::args::ExplainArgs;
use crate::bids;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::names::{near, quoted};
use crate::output::Screen;
use crate::render;
use crate::team::Chosen;
use cotama_axes::raise::{Raise, raises};
use cotama_axes::why::why;
use cotama_axes::{
    Activity, Candidate, Case, Kind, Lifted, Mission, Steps, Stop, Table, label, speed_alone,
};

/// Says why candidates are not faster.
pub(crate) fn explain(args: &ExplainArgs, screen: &Screen) -> Result<Exit, Failure> {
    let name = &args.mission;
    if let Some(chosen) = Chosen::of(name)? {
        return bids::explain(args, &chosen, screen);
    }
    let Some(file) = super::file(name)? else {
        // A plain mission, or no mission at all.
        let plain = mission::load(name, None)?;
        let message = format!("`{}` says its speeds itself, and has no axes", plain.name);
        return Err(Failure::new(message).help("explain a mission with axes, as `patrol-axes`"));
    };
    let mission = &file.case.mission;
    let steps = &mut Steps::new(args.steps);
    let mut answer = ExplainAnswer {
        schema: "cotama/explain/1",
        mission: mission.name.clone(),
        because: Vec::new(),
        limit_reached: false,
    };
    let explained = match Table::new(mission, Lifted::default(), steps) {
        Ok(table) => {
            let asked = Asked::of(args, &file.case, &table)?;
            because(mission, &table, &asked, &mut answer, steps)
        }
        Err(stop) => Err(stop),
    };
    match explained {
        Ok(()) => {}
        Err(Stop::Limit) => answer.limit_reached = true,
        Err(Stop::Wrong(it)) => return Err(file.wrong(it)),
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let is_full = args.activity.is_some();
        // What was read of standard input is gone.
        let next = (!is_full && name != "-").then(|| format!("cotama explain {} A1", quoted(name)));
        screen.print(&render::explain::screen(&answer, is_full, next, screen.width()))?;
    }
    Ok(if answer.limit_reached { Exit::Unknown } else { Exit::Success })
}

/// Parts of the table that are asked for.
struct Asked {
    activity: Option<usize>,
    /// Options by index.
    candidate: Option<Vec<usize>>,
}

impl Asked {
    fn of(args: &ExplainArgs, case: &Case, table: &Table) -> Result<Self, Failure> {
        let Some(id) = &args.activity else {
            return Ok(Self { activity: None, candidate: None });
        };
        let names: Vec<_> = (1..=table.activities.len()).map(|it| format!("A{it}")).collect();
        let found = names.iter().position(|it| it == id);
        let activity = found.and_then(|it| Some((it, table.activities.get(it)?)));
        let Some((number, activity)) = activity else {
            let guess = near(id, names.iter().map(String::as_str));
            let guess = guess.map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
            let message = format!("the mission has no activity `{id}`{guess}");
            let last = names.last().map_or("", String::as_str);
            return Err(Failure::new(message).help(format!("its activities: A1 to {last}")));
        };
        let candidate = args.candidate.as_ref().map(|it| options(it, id, case, activity));
        Ok(Self { activity: Some(number), candidate: candidate.transpose()? })
    }

    fn wants(&self, options: &[usize]) -> bool {
        self.candidate.as_ref().is_none_or(|it| it == options)
    }
}

/// Returns the combination that a text names, in whatever order.
fn options(text: &str, id: &str, case: &Case, activity: &Activity) -> Result<Vec<usize>, Failure> {
    let sorted = |text: &str| {
        let mut words: Vec<_> = text.split_whitespace().map(str::to_owned).collect();
        words.sort();
        words
    };
    let left = activity.candidates.iter().map(|it| &it.options);
    let all: Vec<_> = left.chain(activity.dropped.iter().map(|it| &it.options)).collect();
    let wanted = sorted(text);
    let is_wanted = |it: &&&Vec<usize>| sorted(&label(&case.mission, it)) == wanted;
    if let Some(found) = all.iter().find(is_wanted) {
        return Ok((*found).clone());
    }
    let mut labels: Vec<_> = all.iter().map(|it| label(&case.mission, it)).collect();
    let guess = near(text, labels.iter().map(String::as_str));
    let guess = guess.map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
    let more = if labels.len() > 8 { ", ..." } else { "" };
    labels.truncate(8);
    Err(Failure::new(format!("{id} has no combination `{text}`{guess}"))
        .help(format!("its combinations: {}{more}", labels.join(", "))))
}

fn because(
    mission: &Mission,
    table: &Table,
    asked: &Asked,
    answer: &mut ExplainAnswer,
    steps: &mut Steps,
) -> Result<(), Stop> {
    for (number, activity) in table.activities.iter().enumerate() {
        if asked.activity.is_some_and(|it| it != number) {
            continue;
        }
        let zones = activity.zones.iter().filter_map(|&it| mission.zones.get(it));
        let dropped = activity.dropped.iter().filter(|it| asked.wants(&it.options));
        let objective = mission.objectives.get(activity.objective);
        let mut row = BecauseRow {
            activity: format!("A{}", number + 1),
            objective: objective.map_or_else(String::new, |it| it.id.clone()),
            x_start_mm: activity.x_start_mm,
            x_end_mm: activity.x_end_mm,
            zones: zones.map(|it| it.id.clone()).collect(),
            candidates: Vec::new(),
            dropped: dropped.map(|it| dropped_row(mission, it)).collect(),
        };
        for it in activity.candidates.iter().filter(|it| asked.wants(&it.options)) {
            row.candidates.push(candidate(mission, activity, it, asked.activity.is_some(), steps)?);
        }
        answer.because.push(row);
    }
    Ok(())
}

fn candidate(
    mission: &Mission,
    activity: &Activity,
    candidate: &Candidate,
    in_full: bool,
    steps: &mut Steps,
) -> Result<CandidateRow, Stop> {
    let mut row = CandidateRow {
        options: label(mission, &candidate.options),
        speed_mm_s: candidate.speed_mm_s,
        next_mm_s: None,
        constraints: Vec::new(),
    };
    if !activity.travels() {
        return Ok(row);
    }
    row.next_mm_s = mission.speeds.above(candidate.speed_mm_s);
    let most = mission.speeds.highest();
    let bindings = why(mission, activity, candidate)?;
    for (number, it) in mission.constraints.iter().enumerate() {
        if it.kind != Kind::Core {
            continue;
        }
        let alone = speed_alone(mission, activity, &candidate.options, number, most, steps)?;
        let binding = bindings.iter().find(|it| it.constraint == number);
        if binding.is_none() && alone == Some(most) {
            continue;
        }
        let raises = match binding {
            Some(_) if in_full => raises(mission, activity, candidate, number, steps)?,
            _ => Vec::new(),
        };
        let unit = mission.indicators.get(it.indicator).map_or("", |it| &it.unit);
        let binding = binding.map(|it| BindingRow {
            unit: unit.to_owned(),
            value: it.value,
            value_next: it.value_next,
            relation: it.relation.sign(),
            goal: it.goal,
            inducers: it.inducers.iter().cloned().map(inducer_row).collect(),
            raises: raises.into_iter().map(raise_row).collect(),
        });
        row.constraints.push(HeldRow {
            constraint: it.id.clone(),
            alone_mm_s: alone.unwrap_or(0),
            binds: binding.is_some(),
            binding,
        });
    }
    Ok(row)
}

fn raise_row(Raise { name, now, needed, speed_mm_s }: Raise) -> RaiseRow {
    RaiseRow { name, now, needed, speed_mm_s }
}
