//! Indicators of the runs of a campaign in the plane, as one table.

use super::progress::Progress;
use crate::exit::Failure;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use cotama_campaign::plan::Plan;
use cotama_campaign::run::Campaign;
use cotama_core::units::Millis;
use cotama_models::margins::Calibration;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Faults;
use cotama_models::robots::Measurement;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::trace::Trace;
use std::path::Path;
use std::sync::Arc;

/// The most runs whose indicators are written.
const MOST_RUNS: u64 = 1_000;
/// Time from sample to sample, as in the thesis: two a second.
const PERIOD: Millis = Millis(500);

/// Settings that the runs of a campaign hold besides their faults.
pub(super) struct Held {
    pub(super) measured: Option<Arc<Measurement>>,
    pub(super) margins: Option<Arc<Calibration>>,
}

/// Refuses indicators that cannot be written, before the work begins.
pub(super) fn may_be_written(path: &Path, campaign: &Campaign<'_>) -> Result<(), Failure> {
    output::place(path)?;
    if campaign.settings.runs > MOST_RUNS {
        let message = format!("--indicators writes at most {MOST_RUNS} runs");
        return Err(Failure::new(message).help("ask for fewer --runs"));
    }
    if campaign.subject.policy().fidelity.is_line() {
        let message = "--indicators needs poses, and a robot on a line has none";
        return Err(Failure::new(message).help("--fidelity plane drives it over its floor"));
    }
    Ok(())
}

/// Runs the campaign's plans again, and writes the indicators of all runs one after the other.
pub(super) fn write(
    path: &Path,
    (mission, campaign): (&Mission, &Campaign<'_>),
    held: &Held,
    screen: &Screen,
) -> Result<(), Failure> {
    let mut table = String::new();
    let progress = Progress::new(campaign.settings.runs);
    for (run, plan) in (1..).zip(campaign.drawn()) {
        let rows = rows(mission, campaign, held, &plan)?;
        // The names of the columns stand once.
        let rows =
            if table.is_empty() { &rows } else { rows.split_once('\n').unwrap_or_default().1 };
        table.push_str(rows);
        progress.show(run, 0);
    }
    progress.clear();
    output::file(path, table.as_bytes())?;
    screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    Ok(())
}

fn rows(
    mission: &Mission,
    campaign: &Campaign<'_>,
    held: &Held,
    plan: &Plan,
) -> Result<String, Failure> {
    let refused = |it: String| Failure::of(mission.source(), it);
    let faults = FaultChoice::Given { source: "a campaign".to_owned(), faults: Faults::from(plan) };
    let options = Options {
        monitor_period: Some(PERIOD),
        measured: held.measured.clone(),
        margins: held.margins.clone(),
        ..campaign.subject.policy().options(mission, faults)
    };
    let (trace, _) = Trace::record(mission, &options).map_err(|it| refused(it.to_string()))?;
    cotama_recording::indicators(&trace).map_err(|it| refused(it.to_string()))
}
