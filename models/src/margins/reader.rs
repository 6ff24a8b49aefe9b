//! Reading a file of margins.

use super::{Calibration, MARGINS_FORMAT, MAX_RUNS, Promise};
use crate::missions::reader::fields::{self, Fields, Sink};
use crate::missions::{Diagnostic, MAX_ACTIVITIES, MissionErrors};
use crate::names::quoted;

impl Calibration {
    /// Reads a file of margins. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// use cotama_models::margins::Calibration;
    /// let text = "format = 'cotama-margins/1'\nmission = 'patrol'\ncoverage_ppm = 950000
    /// [[from]]\nactivity = 'A1'\nruns = 50\nrank = 49\nduraton_ppm = 1100000";
    /// let errors = Calibration::parse("margins.toml", text).unwrap_err().to_string();
    /// assert!(errors.contains("margins.toml:8:1: unknown key `duraton_ppm`"), "{errors}");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let read = fields::document(text, &sink, MARGINS_FORMAT, read);
        match read {
            Some(it) if sink.is_empty() => Ok(it),
            _ => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

fn read(mut root: Fields<'_>) -> Option<Calibration> {
    let mission = root.text("mission");
    let coverage = root.integer("coverage_ppm", 1..=999_999);
    let mut from: Vec<Promise> = Vec::new();
    for mut it in root.tables_up_to("from", true, MAX_ACTIVITIES).into_iter().flatten() {
        let at = it.span_of("activity");
        let promise = promise(&mut it);
        it.finish();
        let Some(promise) = promise else { continue };
        if from.iter().any(|it| it.activity == promise.activity) {
            let message = format!("the activity {} stands twice", quoted(&promise.activity));
            root.report(Diagnostic::new(at, message, "again").help("leave one of them out"));
        }
        from.push(promise);
    }
    root.finish();
    Some(Calibration { mission: mission?.value, coverage: coverage?, from })
}

fn promise(it: &mut Fields<'_>) -> Option<Promise> {
    let activity = it.text("activity");
    let runs = it.integer("runs", 0..=i64::from(MAX_RUNS));
    let most = runs.map_or_else(|| i64::from(MAX_RUNS), i64::from);
    let rank = it.optional_integer("rank", 1..=most.max(1));
    let bounds = ["duration_ppm", "energy_ppm"]
        .map(|key| it.optional_integer::<u32>(key, 1..=i64::from(u32::MAX)).ok());
    let [Some(duration), Some(energy)] = bounds else { return None };
    Some(Promise {
        activity: activity?.value,
        runs: runs?,
        rank: rank.ok()?,
        bounds: [duration, energy],
    })
}
