//! Each weak or medium failure that takes no module is answered by a setting, and what that does to
//! the drive; where nothing is done, the row says why.

use super::{delivery, golden};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{FailureMode, Report, local};
use cotama_sim::record::Recorder;
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};
use cotama_sim::trace::Record;
use std::fmt::Write;

/// The fastest samples between two times.
#[derive(Default)]
struct Speeds(Vec<(u64, u64)>);

impl Recorder for Speeds {
    const WANTED: bool = true;

    fn record(&mut self, record: Record) {
        if let Record::Sample(it) = record {
            self.0.push((it.t_us / 1_000, it.speed_mm_s));
        }
    }
}

impl Speeds {
    fn most(&self, from: u64, to: u64) -> u64 {
        let within = self.0.iter().filter(|it| (from..to).contains(&it.0));
        within.map(|it| it.1).max().unwrap_or(0)
    }
}

fn run(injections: Vec<Injection>) -> (Run, Speeds) {
    let mission = delivery();
    let script = Script { injections, answers: Vec::new() };
    let mut speeds = Speeds::default();
    let ready = Supervised::new(&mission).unwrap();
    let run = ready.run_recorded(&script, Millis(100), &mut speeds).unwrap();
    (run, speeds)
}

/// The row alone: while a path is followed, or, of what the operator sees, while he drives.
fn line(mode: FailureMode) -> String {
    let driven = [FailureMode::Cam2, FailureMode::Com2].contains(&mode);
    let row = if driven {
        Injection::new(When::During(local::State::Teleoperated, Millis(1_500)), mode)
    } else {
        Injection::new(When::Place(Millimetres(3_000)), mode)
    };
    let asks = Injection::new(When::Place(Millimetres(3_000)), FailureMode::Loc2);
    let before: Vec<_> = driven.then_some(asks).into_iter().collect();
    let (sound, _) = run(before.clone());
    let (run, speeds) = run(before.into_iter().chain([row]).collect());
    let conduct = run.conduct.iter().find(|it| it.mode == mode).unwrap();
    assert!(conduct.detected.is_some(), "{}", mode.name());
    let Some(adjustment) = mode.adjustment() else {
        return format!("{}: tolerated, {}", mode.name(), mode.description().tolerated.unwrap());
    };
    let shows = run.quality < sound.quality || run.time > sound.time;
    assert!(shows, "{}: neither quality nor time", mode.name());
    let answered = conduct.answered.unwrap().0;
    let by = run.fired.iter().find(|it| it.at.0 == answered && it.cause.0 > 0).unwrap();
    let rule = run.fired.iter().rfind(|it| it.at.0 <= answered && it.net == "cs").unwrap();
    format!(
        "{}: {} ({}, {}.{}): {} mm/s in the second before, {} from 1 to 7 s after; \
         quality {} of {}, {} s of {}",
        mode.name(),
        adjustment.name(),
        rule.transition,
        by.net,
        by.transition,
        speeds.most(answered - 1_000, answered),
        speeds.most(answered + 1_000, answered + 7_000),
        run.quality,
        sound.quality,
        run.time.0 / 1_000,
        sound.time.0 / 1_000,
    )
}

#[test]
fn each_weak_or_medium_failure_is_answered_by_a_setting_or_tolerated_with_a_reason() {
    let rows = FailureMode::ALL.iter().filter(|it| {
        it.rule().report == Some(Report::Minor)
            || it.adjustment().is_some()
            || it.description().tolerated.is_some()
    });
    let mut table = String::new();
    for &mode in rows {
        writeln!(table, "{}", line(mode)).unwrap();
    }
    golden("adjustments.txt", &table);
}
