//! The trace of a team's run: `cotama/team-trace/2`, a header, then a record a line. A report and a
//! replay need nothing else.

use super::record::{Record, Run};
use crate::trace::{Difference, FloorText, Head, RobotText, TraceOf};
use cotama_models::missions::MissionErrors;
use cotama_models::team::scenario::{On, Row, Scenario};
use serde::{Deserialize, Serialize};

/// The form of a trace.
pub const SCHEMA: &str = "cotama/team-trace/2";

/// A run with all that a report needs.
///
/// ```
/// use cotama_sim::fleet::{scenarios::{FleetOptions, fleet}, trace::{Trace, replay}};
/// let options = FleetOptions { robots: 4, tasks: 3, failures: 1, ..FleetOptions::default() };
/// let trace = Trace::of(&fleet(&options));
/// let read = Trace::parse("team.jsonl", &trace.to_json_lines()).unwrap();
/// assert_eq!(read, trace);
/// assert_eq!(replay(&read).unwrap().1, None); // the same, record by record
/// ```
pub type Trace = TraceOf<Header, Record>;

/// The settings of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// [`SCHEMA`].
    pub schema: String,
    /// The version of the program.
    pub version: String,
    /// The name of the scenario.
    pub scenario: String,
    /// The whole team, as the text of a `cotama-team/1` file.
    pub team: String,
    /// The floor on which the team stands, with the ways over it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<FloorText>,
    /// The files of its robots that are not shipped.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<RobotText>,
    /// The seed of the network.
    pub seed: u64,
    /// How tasks are given to robots.
    pub allocation: String,
    /// How many of a thousand messages get lost.
    pub loss_permille: u16,
    /// The names of the robots.
    pub robots: Vec<String>,
    /// The names of the tasks.
    pub tasks: Vec<String>,
}

impl Head for Header {
    const SCHEMA: &'static str = SCHEMA;

    fn schema(&self) -> &str {
        &self.schema
    }

    fn by_version_of(self, other: &Self) -> Self {
        Self { version: other.version.clone(), ..self }
    }
}

impl Trace {
    /// Runs a scenario.
    pub fn of(scenario: &Scenario) -> Self {
        let (run, mut records) = super::run_recorded(scenario);
        records.push(Record::End(Box::new(run)));
        let header = Header {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            scenario: scenario.name.clone(),
            team: scenario.to_toml(),
            floor: scenario.floor.on().and_then(On::ways).map(FloorText::of_team),
            files: RobotText::of_team(scenario),
            seed: scenario.seed,
            allocation: scenario.method.name().into(),
            loss_permille: scenario.network.loss_permille,
            robots: scenario.robots.iter().map(|it| it.name.clone()).collect(),
            tasks: scenario.tasks.iter().map(|it| it.name.clone()).collect(),
        };
        Self { header, records, foreign: None }
    }

    /// Returns the numbers of the run.
    ///
    /// # Panics
    /// Never: a trace ends with them.
    pub fn run(&self) -> &Run {
        match self.records.last() {
            Some(Record::End(run)) => run,
            _ => unreachable!("a trace ends with the numbers of its run"),
        }
    }

    /// Reads the team of this trace.
    ///
    /// # Errors
    /// All errors of its text.
    pub fn scenario(&self) -> Result<Scenario, MissionErrors> {
        let Header { scenario, team, floor, files, .. } = &self.header;
        let ways = floor.as_ref().map(|it| it.ways(team));
        let robots: Vec<_> = files.iter().map(RobotText::file).collect::<Result<_, _>>()?;
        let scenario = Scenario::parse_on(scenario, team, ways.as_ref(), &robots)?;
        Ok(Scenario { seed: self.header.seed, ..scenario })
    }

    /// The name of a robot.
    pub fn robot(&self, robot: usize) -> &str {
        self.header.robots.get(robot).map_or("?", |it| it)
    }

    /// The name of a task.
    pub fn task(&self, task: usize) -> &str {
        self.header.tasks.get(task).map_or("?", |it| it)
    }

    /// Returns the words of failures, by robot and short name: those of their rows in the robots'
    /// files.
    pub fn words(&self) -> impl Fn(usize, &str) -> String + use<> {
        let scenario = self.scenario().ok();
        move |robot, mode| {
            let file = scenario.as_ref().and_then(|it| Some(&it.robots.get(robot)?.file));
            let row = file.and_then(|it| Some((Row::named(it.robot(), mode)?, it.robot())));
            row.map_or_else(|| mode.to_owned(), |(row, robot)| row.words(robot))
        }
    }
}

/// Runs the team of a trace again; the trace of it, and the first record that differs.
///
/// # Errors
/// All errors of the text of its team.
pub fn replay(trace: &Trace) -> Result<(Trace, Option<Difference>), MissionErrors> {
    let again = Trace::of(&trace.scenario()?);
    let difference = trace.difference(&again);
    Ok((again, difference))
}
