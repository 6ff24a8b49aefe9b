//! A run as a file: a header, then a record a line.

use super::message::Kind;
use super::record::{Fate, Record, Run};
use super::task::Scenario;
use cotama_models::cotama::FailureMode;
use serde::Serialize;
use std::fmt::Write;

/// The form of a trace.
pub const SCHEMA: &str = "cotama/team-trace/1";

/// A run with all that a report needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// What was run.
    pub header: Header,
    /// What happened.
    pub records: Vec<Record>,
    /// What it came to.
    pub run: Run,
}

/// What was run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Header {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The version of the program.
    pub version: &'static str,
    /// The name of the scenario.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// How tasks are given to robots.
    pub allocation: &'static str,
    /// How many of a thousand messages get lost.
    pub loss_permille: u16,
    /// The names of the robots.
    pub robots: Vec<String>,
    /// The names of the tasks.
    pub tasks: Vec<String>,
}

/// The last line.
#[derive(Serialize)]
struct End<'r> {
    record: &'static str,
    fates: &'r [Fate],
    messages: Vec<(&'static str, u64)>,
    messages_lost: u64,
    busy_ms: u64,
    cost_ms: u64,
}

impl Trace {
    /// Runs a scenario.
    pub fn of(scenario: &Scenario) -> Self {
        let (run, records) = super::run_recorded(scenario);
        let header = Header {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            scenario: scenario.name.clone(),
            seed: scenario.seed,
            allocation: scenario.method.name(),
            loss_permille: scenario.network.loss_permille,
            robots: scenario.robots.iter().map(|it| it.name.clone()).collect(),
            tasks: scenario.tasks.iter().map(|it| it.name.clone()).collect(),
        };
        Self { header, records, run }
    }

    /// The name of a robot.
    pub fn robot(&self, robot: usize) -> &str {
        self.header.robots.get(robot).map_or("?", |it| it)
    }

    /// The name of a task.
    pub fn task(&self, task: usize) -> &str {
        self.header.tasks.get(task).map_or("?", |it| it)
    }

    /// A fault in words: of a failure mode its row in the FMECA.
    pub fn words(what: &str) -> String {
        FailureMode::named(what).map_or_else(
            || what.to_owned(),
            |it| {
                let row = it.description();
                format!("{what}, {}: {}", row.component, row.failure)
            },
        )
    }

    /// As JSON lines.
    pub fn to_json_lines(&self) -> String {
        let mut text = String::new();
        let mut line = |it: serde_json::Result<String>| {
            let _ = writeln!(text, "{}", it.unwrap_or_default());
        };
        line(serde_json::to_string(&self.header));
        self.records.iter().for_each(|it| line(serde_json::to_string(it)));
        let run = &self.run;
        line(serde_json::to_string(&End {
            record: "end",
            fates: &run.fates,
            messages: Kind::ALL.iter().map(|it| (it.name(), run.sent(*it))).collect(),
            messages_lost: run.lost,
            busy_ms: run.busy_ms,
            cost_ms: run.cost_ms,
        }));
        text
    }
}
