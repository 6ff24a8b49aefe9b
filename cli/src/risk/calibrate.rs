//! `cotama risk calibrate`: margins learned from runs, and held against later ones.

use super::cells;
use crate::answers::risk::{CalibrateAnswer, DriftRow, PromiseRow};
use crate::args::CalibrateArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::margins::watch::{CONFIDENCE, Watch};
use crate::margins::{self, COLUMNS};
use crate::names::near;
use crate::output::{self, Screen};
use crate::render;
use cotama_campaign::statistics::Promise;
use cotama_models::margins::{Calibration, Spent};
use cotama_risk::Cells;

/// Runs of a mission: for each what its activities took.
struct Runs {
    mission: String,
    /// Ids of the activities, in their order.
    ids: Vec<String>,
    spent: Vec<Vec<Spent>>,
}

/// Learns margins, or holds those of a file against runs.
pub(super) fn calibrate(args: &CalibrateArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.out {
        output::place(path)?;
    }
    let (cells, _) = cells(&args.runs)?;
    let known = args.against.as_deref().map(margins::load).transpose()?;
    let ids = known.as_ref().map(|it| it.from.iter().map(|it| it.activity.clone()).collect());
    let runs = table(&args.runs, &cells, ids.unwrap_or_default())?;
    let answer = if let Some((known, file)) = known.as_ref().zip(args.against.as_deref()) {
        if known.mission != runs.mission {
            let (is, wants) = (render::visible(&runs.mission), render::visible(&known.mission));
            let message = format!("these are runs of `{is}`, the margins are of `{wants}`");
            return Err(Failure::of(input::name(&args.runs), message)
                .help("learn margins of these: leave --against out"));
        }
        watched(known, file, &runs)
    } else {
        let coverage = (args.coverage * 1e6).round();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // below a million
        let learned = Calibration::learn(&runs.mission, &runs.ids, &runs.spent, coverage as u32);
        if let Some(path) = &args.out {
            let origin = format!("{}, {} runs", input::name(&args.runs), runs.spent.len());
            super::written(path, &learned.to_toml(&origin), screen)?;
        }
        learnt(&learned, &runs)
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::calibrate::screen(&answer, screen.width()))?;
    }
    Ok(match (answer.holds, answer.promises.iter().all(|it| it.rank.is_some())) {
        (Some(false), _) => Exit::Violated,
        (None, false) => Exit::Unknown,
        _ => Exit::Success,
    })
}

fn learnt(learned: &Calibration, runs: &Runs) -> CalibrateAnswer {
    let alone = |coverage| Calibration::alone(&runs.mission, &runs.ids, &runs.spent, coverage);
    let (median, own) = (alone(500_000), alone(learned.coverage));
    let promises = learned.from.iter().enumerate().map(|(at, it)| {
        let coverage = it.rank.map(|rank| {
            Promise::new(u64::from(rank), u64::from(it.runs)).coverage(CONFIDENCE).into()
        });
        let axis = |axis: usize| DriftRow {
            rest: it.bounds[axis].map(ratio),
            median: median.from[at].bounds[axis].map(ratio),
            alone: own.from[at].bounds[axis].map(ratio),
        };
        PromiseRow {
            activity: it.activity.clone(),
            runs: it.runs,
            rank: it.rank,
            coverage,
            duration: axis(0),
            energy: axis(1),
        }
    });
    CalibrateAnswer {
        schema: "cotama/risk-calibrate/1",
        mission: runs.mission.clone(),
        runs: runs.spent.len() as u64,
        coverage: f64::from(learned.coverage) / 1e6,
        promises: promises.collect(),
        against: None,
        watched: Vec::new(),
        holds: None,
    }
}

/// Holds margins against runs, one after the other.
fn watched(known: &Calibration, file: &str, runs: &Runs) -> CalibrateAnswer {
    let mut watch = Watch::new(known);
    runs.spent.iter().for_each(|run| watch.add(run));
    let held = watch.held();
    CalibrateAnswer {
        schema: "cotama/risk-calibrate/1",
        mission: runs.mission.clone(),
        runs: runs.spent.len() as u64,
        coverage: held.coverage,
        promises: Vec::new(),
        against: Some(input::name(file).to_owned()),
        holds: Some(held.holds),
        watched: held.watched,
    }
}

fn ratio(ppm: u32) -> f64 {
    f64::from(ppm) / 1e6
}

/// Reads a table of runs; `ids` are the activities, or none, where the first run that comes to an
/// end has them all.
fn table(path: &str, cells: &Cells, ids: Vec<String>) -> Result<Runs, Failure> {
    let wrong = |row: usize, message: &str| {
        Failure::of(input::name(path), format!("row {}: {message}", row + 1))
    };
    let column = |name: &str| {
        let found = cells.header.iter().position(|it| it == name);
        found.and_then(|it| cells.columns.get(it)).ok_or_else(|| {
            let failure = Failure::of(input::name(path), format!("there is no column `{name}`"));
            let help = near(name, cells.header.iter().map(String::as_str)).map_or_else(
                || format!("the columns of a table of runs are {}", COLUMNS.join(", ")),
                |near| format!("did you mean `{name}` by `{near}`?"),
            );
            failure.help(help)
        })
    };
    let [missions, numbers, activities] = [column("mission")?, column("run")?, column("activity")?];
    let amounts = ["planned_ms", "used_ms", "planned_mj", "used_mj"].map(column);
    let [planned_ms, used_ms, planned_mj, used_mj] = amounts;
    let amounts = [planned_ms?, used_ms?, planned_mj?, used_mj?];
    let done = column("done")?;
    let mission = missions.first().cloned().unwrap_or_default();
    let (fixed, mut ids) = (!ids.is_empty(), ids);
    let mut runs: Vec<Vec<Spent>> = Vec::new();
    for row in 0..missions.len() {
        if missions[row] != mission {
            let help = "give each mission a table of its own";
            return Err(wrong(row, "this is a run of another mission").help(help));
        }
        let begins = row == 0 || numbers[row] != numbers[row - 1];
        if begins {
            runs.push(Vec::new());
        }
        let Some(run) = runs.last_mut() else { continue };
        let at = run.len();
        if !fixed && at == ids.len() {
            ids.push(activities[row].clone());
        }
        if ids.get(at) != Some(&activities[row]) {
            let named = render::visible(&activities[row]);
            let message = match ids.get(at) {
                Some(wanted) => {
                    let wanted = render::visible(wanted);
                    format!("the run goes on with {named}, and others with {wanted}")
                }
                None => format!("the run goes on with {named}, where others end"),
            };
            return Err(wrong(row, &message).help("a run has all activities in their order"));
        }
        if run.last().is_some_and(|it| !it.done) {
            let help = "an activity that is not done is the last of its run";
            return Err(wrong(row, "the run goes on after its end").help(help));
        }
        let number = |column: &[String]| {
            let most = 1_u64 << 40;
            column[row].parse().ok().filter(|it| *it <= most).ok_or_else(|| {
                let shown = render::visible(&column[row]);
                wrong(row, &format!("`{shown}` is no amount from 0 to {most}"))
            })
        };
        let [planned_ms, used_ms, planned_mj, used_mj] = amounts;
        let done = match done[row].as_str() {
            "yes" => true,
            "no" => false,
            other => {
                let shown = render::visible(other);
                return Err(wrong(row, &format!("`{shown}` is neither yes nor no")));
            }
        };
        let planned = [number(planned_ms)?, number(planned_mj)?];
        let used = [number(used_ms)?, number(used_mj)?];
        run.push(Spent { activity: at, planned, used, done });
    }
    Ok(Runs { mission, ids, spent: runs })
}
