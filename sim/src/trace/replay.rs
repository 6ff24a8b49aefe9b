//! Recording a run, and running a recorded one again.

use super::{Header, Record, RunFaults, RunOptions, RunUpward, SCHEMA, Trace};
use crate::faults_text::faults_text;
use crate::options::{FaultChoice, Options};
use crate::run::{NoPlan, Run};
use crate::setup::{SetupError, Simulation};
use crate::supervised::{Script, Supervised, Unsupervised};
use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, MissionErrors};
use std::fmt;

/// Why a recorded run cannot be made.
///
/// ```
/// use cotama_models::missions::embedded;
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::{RecordError, Trace};
/// let patrol = embedded::mission("patrol").unwrap();
/// let poor = patrol.text.replace("energy_mj = 8640000", "energy_mj = 4320000");
/// let error = Trace::record("poor", &poor, &Options::default()).unwrap_err();
/// assert!(matches!(error, RecordError::Infeasible { .. }));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecordError {
    /// The mission or the faults have errors.
    Text(MissionErrors),
    /// The run cannot be set up.
    Setup(SetupError),
    /// The mission has supervisors that are not simulated.
    Unsupervised(Unsupervised),
    /// There is no plan at the start.
    Infeasible {
        /// Why.
        reason: NoPlan,
        /// The same in words.
        text: String,
    },
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(errors) => errors.fmt(f),
            Self::Setup(error) => error.fmt(f),
            Self::Unsupervised(error) => error.fmt(f),
            Self::Infeasible { text, .. } => write!(f, "infeasible from the start: {text}"),
        }
    }
}

impl std::error::Error for RecordError {}

/// A run made again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replayed {
    /// What it came to this time.
    pub run: Run,
    /// The trace it left this time.
    pub trace: Trace,
    /// Whether that trace is the given one byte for byte, but for the version of the program.
    pub identical: bool,
}

impl Trace {
    /// Runs a mission from its text and records everything: under supervisors if its file names
    /// them. Those deal with the incidents of the faults; other faults, the seed and the search for
    /// better plans change nothing there.
    ///
    /// # Errors
    /// A [`RecordError`] for a text with errors, options that do not fit it, or no plan at the
    /// start.
    ///
    /// ```
    /// use cotama_models::missions::embedded;
    /// use cotama_sim::{options::Options, trace::{Trace, replay}};
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let (trace, run) = Trace::record("patrol", patrol.text, &Options::default()).unwrap();
    /// assert_eq!(run.replans, 3);
    /// let read = Trace::parse("patrol.jsonl", &trace.to_json_lines()).unwrap();
    /// assert!(replay(&read).unwrap().identical);
    /// ```
    pub fn record(
        mission_source: &str,
        text: &str,
        options: &Options,
    ) -> Result<(Self, Run), RecordError> {
        let mission = Mission::parse(mission_source, text).map_err(RecordError::Text)?;
        let period = options.monitor_period.unwrap_or(mission.run.monitor_period);
        let mut records = Vec::new();
        let run = if mission.supervisor().is_some() {
            supervised(&mission, options, period, &mut records)
        } else {
            let simulation = Simulation::new(&mission, options).map_err(RecordError::Setup)?;
            simulation
                .run_recorded(options.seed, &mut records)
                .map_err(|reason| infeasible(&mission, reason))
        }?;
        let faults = match &options.faults {
            FaultChoice::Script => RunFaults::Script,
            FaultChoice::None => RunFaults::None,
            FaultChoice::Given { source, faults } => {
                RunFaults::File { source: source.clone(), text: faults_text(faults, &mission) }
            }
        };
        let upward = options.upward.map(|Upward { growth, reserve }| RunUpward {
            growth: growth.into(),
            reserve: reserve.into(),
        });
        let header = Header {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            mission_source: mission_source.into(),
            mission: text.into(),
            options: RunOptions {
                seed: options.seed,
                faults,
                monitor_period_ms: period.0,
                allocator: options.planner,
                upward,
            },
            limits: mission.limits.into(),
            path_length_mm: mission.path_length.0,
        };
        Ok((Self { header, records, canonical: true }, run))
    }

    /// The mission of this trace.
    ///
    /// # Errors
    /// All errors of its text.
    pub fn mission(&self) -> Result<Mission, MissionErrors> {
        Mission::parse(&self.header.mission_source, &self.header.mission)
    }

    /// The options of this trace, for its mission.
    ///
    /// # Errors
    /// All errors of the text of its faults.
    pub fn options(&self, mission: &Mission) -> Result<Options, MissionErrors> {
        let recorded = &self.header.options;
        let faults = match &recorded.faults {
            RunFaults::Script => FaultChoice::Script,
            RunFaults::None => FaultChoice::None,
            RunFaults::File { source, text } => {
                let faults = Faults::parse(source, text, mission)?;
                FaultChoice::Given { source: source.clone(), faults }
            }
        };
        let upward = recorded
            .upward
            .map(|upward| Upward { growth: upward.growth.into(), reserve: upward.reserve.into() });
        Ok(Options {
            seed: recorded.seed,
            faults,
            monitor_period: Some(Millis(recorded.monitor_period_ms)),
            planner: recorded.allocator,
            upward,
        })
    }
}

fn infeasible(mission: &Mission, reason: NoPlan) -> RecordError {
    RecordError::Infeasible { reason, text: reason.text(mission) }
}

/// Runs a mission under its supervisors.
fn supervised(
    mission: &Mission,
    options: &Options,
    period: Millis,
    records: &mut Vec<Record>,
) -> Result<Run, RecordError> {
    let ready =
        Supervised::new(mission).map_err(RecordError::Unsupervised)?.with_planner(options.planner);
    if period.0 == 0 {
        return Err(RecordError::Setup(SetupError::ZeroPeriod));
    }
    let script = match &options.faults {
        FaultChoice::Script => Script::from(&mission.run.faults),
        FaultChoice::None => Script::default(),
        FaultChoice::Given { faults, .. } => Script::from(faults),
    };
    let run = ready
        .run_recorded(&script, period, records)
        .map_err(|reason| infeasible(mission, reason))?;
    Ok(run.summary(mission))
}

/// Runs a recorded mission again, from nothing but its header, and compares.
///
/// # Errors
/// A [`RecordError`] when the header is not that of a run that can be made.
///
/// ```
/// use cotama_models::missions::embedded;
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::{Trace, replay};
/// let patrol = embedded::mission("patrol").unwrap();
/// let (mut trace, _) = Trace::record("patrol", patrol.text, &Options::default()).unwrap();
/// assert!(replay(&trace).unwrap().identical);
/// trace.records.pop();
/// assert!(!replay(&trace).unwrap().identical);
/// ```
pub fn replay(trace: &Trace) -> Result<Replayed, RecordError> {
    let mission = trace.mission().map_err(RecordError::Text)?;
    let options = trace.options(&mission).map_err(RecordError::Text)?;
    let header = &trace.header;
    let (again, run) = Trace::record(&header.mission_source, &header.mission, &options)?;
    let expected = Header { version: header.version.clone(), ..again.header.clone() };
    let identical = trace.canonical && *header == expected && trace.records == again.records;
    Ok(Replayed { run, trace: again, identical })
}
