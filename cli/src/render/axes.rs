//! The screen of `cotama plan` for a mission with axes: phases as Lambert et al. 2024 name them.

use super::numbers::{count, grouped, short_metres};
use super::plan::status;
use super::style::{BAD, FAINT, GOOD, HEADING, NAME};
use super::table::{Cell, Table};
use super::visible;
use crate::answers::Status;
use crate::answers::axes::{AxesAnswer, LiftRow};
use cotama_axes::{Constraint, Indicator, Inducer, Kind, Mission};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The most activities that are shown.
const SHOWN: usize = 200;

/// The screen; `next` is a command that suggests itself.
pub(crate) fn screen(
    mission: &Mission,
    answer: &AxesAnswer,
    next: Option<String>,
    width: usize,
) -> String {
    let activities = count(answer.activities.len() as u64, "activity");
    let mut text = format!(
        "{HEADING}{}{HEADING:#}: {}, {}, {} combinations\n",
        visible(&mission.name),
        count(mission.axes.len() as u64, "axis").replace("axiss", "axes"),
        activities.replace("activitys", "activities"),
        grouped(&answer.combinations),
    );
    let _ = writeln!(text, "\n{HEADING}P0{HEADING:#} axes, indicators, inducers, constraints");
    text += &axes(mission, width);
    let _ = writeln!(text, "\n{HEADING}P1{HEADING:#} activities, options, speeds");
    text += &activities_table(answer).render(width);
    if answer.activities.len() > SHOWN {
        let _ = writeln!(text, "  and {} more: see --json", answer.activities.len() - SHOWN);
    }
    text += &bounds(answer, width);
    text += &removed(answer, width);
    let _ = writeln!(text, "\n{HEADING}P2{HEADING:#} {}", status(answer.status));
    text += &totals(mission, answer).render(width);
    text + &reason(answer, width) + &super::next(next)
}

/// Names of axes with their indicators, the inducers that each reads, and its constraints.
fn axes(mission: &Mission, width: usize) -> String {
    let mut text = String::new();
    for (number, axis) in mission.axes.iter().enumerate() {
        let class = axis.is_major.map_or("", |it| if it { " (major)" } else { " (minor)" });
        let _ = writeln!(text, "  {}{FAINT}{class}{FAINT:#}", visible(&axis.id));
        for (place, it) in mission.indicators.iter().enumerate().filter(|it| it.1.axis == number) {
            text += &super::wrapped(&indicator(it), width, "    ");
            let own = mission.constraints.iter().filter(|it| it.indicator == place);
            for it in own {
                text += &super::wrapped(&constraint(mission, it), width, "      ");
            }
        }
    }
    text
}

fn indicator(it: &Indicator) -> String {
    let formulas = it.travel.iter().chain(&it.stand);
    let mut inducers: Vec<&Inducer> = formulas.flat_map(|it| it.inducers()).collect();
    inducers.sort();
    inducers.dedup();
    let inducers: Vec<_> = inducers.iter().map(|it| visible(&it.to_string())).collect();
    let combined = if it.adds_up { "sum" } else { "each" };
    let name = visible(&it.id);
    format!("{name} {FAINT}{}, {combined}; {}{FAINT:#}", visible(&it.unit), inducers.join(", "))
}

fn constraint(mission: &Mission, it: &Constraint) -> String {
    let zone = |zone: usize| mission.zones.get(zone).map_or("", |it| it.id.as_str());
    let goals = it.at.iter().map(|it| format!(", {} in {}", it.1, visible(zone(it.0))));
    let kind = match it.kind {
        Kind::Core => "core",
        Kind::End => "end",
        Kind::Running => "running",
    };
    let goals: String = goals.collect();
    format!("{NAME}{}{NAME:#} {kind} {} {}{goals}", visible(&it.id), it.relation.sign(), it.goal)
}

fn activities_table(answer: &AxesAnswer) -> Table {
    let metres = |mm: i64| short_metres(mm.unsigned_abs());
    let mut head = ["", "objective", "from m", "to m", "candidates", "most mm/s", "bounded by"]
        .map(Cell::faint)
        .to_vec();
    let is_planned = !answer.plan.is_empty();
    if is_planned {
        head.extend(["plan", "mm/s"].map(Cell::faint));
    }
    let mut table = Table::new(vec![head]).left(1).left(6).left(7);
    for (number, it) in answer.activities.iter().enumerate().take(SHOWN) {
        let candidates = match it.candidates {
            0 => Cell::new("none", BAD),
            all if all == it.candidates_before => Cell::plain(all.to_string()),
            some => Cell::plain(format!("{some}/{}", it.candidates_before)),
        };
        let speed = |speed: i64| match speed {
            0 => Cell::faint("\u{b7}"),
            speed => Cell::plain(speed.to_string()),
        };
        let bounds: Vec<_> = it.bounded_by.iter().map(|it| visible(&it.constraint)).collect();
        let mut row = vec![
            Cell::new(&it.id, HEADING),
            Cell::plain(visible(&it.objective)),
            Cell::plain(metres(it.x_start_mm)),
            Cell::plain(metres(it.x_end_mm)),
            candidates,
            speed(it.speed_max_mm_s),
            Cell::plain(bounds.join(", ")),
        ];
        if let (Some(plan), Some(at)) = (answer.plan.get(number), answer.speeds_mm_s.get(number)) {
            row.extend([Cell::new(visible(plan), NAME), speed(*at)]);
        }
        table.row(row);
    }
    table
}

/// Says which inducers bind in which activities, the speed aside, which binds in all.
fn bounds(answer: &AxesAnswer, width: usize) -> String {
    let mut by: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for activity in &answer.activities {
        for bound in &activity.bounded_by {
            let inducers = bound.inducers.iter().filter(|it| it.name != "speed_mm_s").map(|it| {
                let of = if it.of.is_empty() { String::new() } else { format!(" of {}", it.of) };
                visible(&format!("{} {}{of}", it.name, it.value))
            });
            let inducers = inducers.collect::<Vec<_>>().join(", ");
            let line = format!("{NAME}{}{NAME:#} binds by {inducers}", visible(&bound.constraint));
            by.entry(line).or_default().push(&activity.id);
        }
    }
    let line = |(line, places): (String, Vec<&str>)| {
        super::wrapped(&format!("{line}: {}", places.join(", ")), width, "  ")
    };
    by.into_iter().map(line).collect()
}

/// Says how many combinations each constraint removed, and where.
fn removed(answer: &AxesAnswer, width: usize) -> String {
    let mut by: BTreeMap<&str, (u64, Vec<&str>)> = BTreeMap::new();
    for activity in &answer.activities {
        for reason in activity.dropped.iter().flat_map(|it| &it.by) {
            let (times, places) = by.entry(reason).or_default();
            *times += 1;
            if places.last() != Some(&activity.id.as_str()) {
                places.push(&activity.id);
            }
        }
    }
    let mut text = String::new();
    for (reason, (times, places)) in by {
        let times = count(times, "combination");
        let line =
            format!("{NAME}{}{NAME:#} removed {times}: {}", visible(reason), places.join(", "));
        text += &super::wrapped(&line, width, "  ");
    }
    text
}

fn totals(mission: &Mission, answer: &AxesAnswer) -> Table {
    let mut table = Table::new(vec![]).left(2).left(3);
    for it in &answer.totals {
        let number = mission.indicator(&it.indicator);
        let limits = mission.constraints.iter().filter(|it| Some(it.indicator) == number);
        let limits = limits.filter(|it| it.kind == Kind::End);
        let limits: Vec<_> =
            limits.map(|it| format!("{} {}", it.relation.sign(), it.goal)).collect();
        table.row(vec![
            Cell::plain(visible(&it.indicator)),
            Cell::plain(it.value.to_string()),
            Cell::plain(visible(&it.unit)),
            Cell::new(limits.join(", "), GOOD),
        ]);
    }
    table
}

fn reason(answer: &AxesAnswer, width: usize) -> String {
    let names = |it: &[String]| it.iter().map(|it| visible(it)).collect::<Vec<_>>().join(", ");
    let lift = |it: &LiftRow| {
        let goals: Vec<_> = it.needed.iter().map(i64::to_string).collect();
        let goals = if goals.is_empty() {
            String::new()
        } else {
            format!("; a goal of {} suffices", goals.join(" or "))
        };
        let line = format!("without `{}` there is a plan{goals}", visible(&it.constraint));
        super::wrapped(&line, width, "  ")
    };
    let line = match (answer.status, &answer.blame) {
        (Status::Infeasible, Some(_)) => return answer.single.iter().map(lift).collect(),
        (Status::Infeasible, None) if !answer.correction.is_empty() => {
            format!("lifted together, these leave a plan: {}", names(&answer.correction))
        }
        (Status::Infeasible, None) => {
            "to lift constraints leaves no plan: zones require what no option has, or the steps \
             did not suffice to find some"
                .to_owned()
        }
        (Status::Unknown, _) => {
            format!("a limit was reached after {} steps: use more `--steps`", answer.steps)
        }
        _ => return String::new(),
    };
    super::wrapped(&line, width, "  ")
}
