//! Recording a run, and running a recorded one again.

use super::{
    Difference, FloorText, Header, Record, RobotText, RunFaults, RunOptions, RunUpward, SCHEMA,
    Trace,
};
use crate::faults_text::faults_text;
use crate::options::{FaultChoice, Fidelity, Options, Planner};
use crate::robots::{self, Driven, Undriven};
use crate::run::{NoPlan, Run};
use crate::setup::{SetupError, Simulation};
use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::margins::Calibration;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, MissionErrors};
use cotama_models::robots::Measurement;
use std::fmt;
use std::sync::Arc;

/// Why a recorded run cannot be made.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::Trace;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let poor = mission.with_limits([None, Some(4_320_000)]).unwrap();
/// let error = Trace::record(&poor, &Options::default()).unwrap_err();
/// let why = "infeasible from the start: no plan within the energy limit: 355.896 J short";
/// assert_eq!(error.to_string(), why);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecordError {
    /// The mission or the faults have errors.
    Text(MissionErrors),
    /// The run cannot be set up.
    Setup(SetupError),
    /// The supervisors of the robot's file are not simulated.
    Undriven(Undriven),
    /// There is no plan at the start.
    Infeasible {
        /// The reason.
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
            Self::Undriven(error) => error.fmt(f),
            Self::Infeasible { text, .. } => write!(f, "infeasible from the start: {text}"),
        }
    }
}

impl std::error::Error for RecordError {}

/// A run made again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replayed {
    /// The mission of the trace.
    pub mission: Mission,
    /// The result of this run.
    pub run: Run,
    /// The trace it left this time.
    pub trace: Trace,
    /// Whether that trace is the given one, record by record, but for the version of the program.
    pub identical: bool,
    /// The first record that differs; none when they are identical.
    pub difference: Option<Difference>,
}

impl Trace {
    /// Runs a mission and records everything: under the supervisors of its robot, if it names one;
    /// the seed draws people alone there.
    ///
    /// # Errors
    /// A [`RecordError`] for options that do not fit the mission, or no plan at the start.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_sim::{options::Options, trace::{Trace, replay}};
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let (trace, run) = Trace::record(&mission, &Options::default()).unwrap();
    /// assert_eq!(run.replans, 3);
    /// let read = Trace::parse("patrol.jsonl", &trace.to_json_lines()).unwrap();
    /// assert!(replay(&read).unwrap().identical);
    /// ```
    pub fn record(mission: &Mission, options: &Options) -> Result<(Self, Run), RecordError> {
        let period = options.monitor_period.unwrap_or(mission.run.monitor_period);
        let mut records = Vec::new();
        let mut floor = mission.way.as_ref().map(FloorText::of);
        let run = if mission.robot().is_some() {
            let ready = Driven::with(mission, options).map_err(RecordError::Undriven)?;
            floor = floor.or_else(|| ready.course().map(|it| FloorText::of(it.way())));
            driven(&ready, mission, options, period, &mut records)
        } else if options.fidelity != Fidelity::Line {
            return Err(RecordError::Undriven(Undriven::Plain));
        } else {
            let simulation = Simulation::new(mission, options).map_err(RecordError::Setup)?;
            simulation
                .run_recorded(options.seed, &mut records)
                .map_err(|reason| infeasible(mission, reason))
        }?;
        let faults = match &options.faults {
            FaultChoice::Script => RunFaults::Script,
            FaultChoice::None => RunFaults::None,
            FaultChoice::Given { source, faults } => {
                RunFaults::File { source: source.clone(), text: faults_text(faults, mission) }
            }
        };
        let upward = options.upward.map(|Upward { growth, reserve }| RunUpward {
            growth: growth.into(),
            reserve: reserve.into(),
        });
        let header = Header {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            mission_source: mission.source().into(),
            mission: mission.text().into(),
            robot: mission.robot().map(RobotText::of),
            floor,
            options: RunOptions {
                seed: options.seed,
                faults,
                monitor_period_ms: period.0,
                allocator: options.planner.unwrap_or_else(|| Planner::of(mission)),
                rigid: options.rigid,
                upward,
                fidelity: options.fidelity,
                people: options.people,
                measured: options.measured.as_ref().and_then(|it| {
                    let robot = mission.robot()?.robot();
                    Some(it.to_toml(robot, "see the file that the run was given"))
                }),
                margins: options.margins.as_ref().map(|it| it.to_toml("the file of the run")),
            },
            limits: mission.limits.into(),
            path_length_mm: mission.path_length.0,
        };
        Ok((Self { header, records, foreign: None }, run))
    }

    /// The mission of this trace.
    ///
    /// # Errors
    /// All errors of its text.
    pub fn mission(&self) -> Result<Mission, MissionErrors> {
        self.header.mission()
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
        let measured = recorded.measured.as_ref().zip(mission.robot());
        let measured = measured.map(|(text, it)| Measurement::parse("measured", text, it.robot()));
        let measured = measured.transpose()?;
        let margins = recorded.margins.as_ref().map(|it| Calibration::parse("margins", it));
        let margins = margins.transpose()?;
        Ok(Options {
            seed: recorded.seed,
            faults,
            monitor_period: Some(Millis(recorded.monitor_period_ms)),
            planner: Some(recorded.allocator),
            rigid: recorded.rigid,
            upward,
            fidelity: recorded.fidelity,
            people: recorded.people,
            measured: measured.map(Arc::new),
            margins: margins.map(Arc::new),
        })
    }
}

impl Header {
    /// The mission of a trace, under the robot that it names.
    ///
    /// # Errors
    /// All errors of its text, or of the robot's.
    pub fn mission(&self) -> Result<Mission, MissionErrors> {
        let robot = self.robot.as_ref().map(RobotText::file).transpose()?;
        let way = self.floor.as_ref().map(|it| it.way(&self.mission));
        Mission::parse_on(&self.mission_source, &self.mission, robot, way.as_ref())
    }
}

fn infeasible(mission: &Mission, reason: NoPlan) -> RecordError {
    RecordError::Infeasible { reason, text: reason.text(mission) }
}

/// Runs a mission under the supervisors of a robot's file.
fn driven(
    ready: &Driven<'_>,
    mission: &Mission,
    options: &Options,
    period: Millis,
    records: &mut Vec<Record>,
) -> Result<Run, RecordError> {
    if period.0 == 0 {
        return Err(RecordError::Setup(SetupError::ZeroPeriod));
    }
    let script = match &options.faults {
        FaultChoice::Script => robots::Script::of(&mission.run.faults, mission),
        FaultChoice::None => robots::Script::default(),
        FaultChoice::Given { faults, .. } => robots::Script::of(faults, mission),
    };
    let run = ready.run_recorded(&script, period, records);
    Ok(run.map_err(|reason| infeasible(mission, reason))?.summary(mission))
}

/// Runs a recorded mission again, from nothing but its header, and compares.
///
/// # Errors
/// A [`RecordError`] when the header is not that of a run that can be made.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::{Trace, replay};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (mut trace, _) = Trace::record(&mission, &Options::default()).unwrap();
/// assert!(replay(&trace).unwrap().identical);
/// trace.records.pop();
/// assert!(!replay(&trace).unwrap().identical);
/// ```
pub fn replay(trace: &Trace) -> Result<Replayed, RecordError> {
    let mission = trace.mission().map_err(RecordError::Text)?;
    let options = trace.options(&mission).map_err(RecordError::Text)?;
    let (again, run) = Trace::record(&mission, &options)?;
    let difference = trace.difference(&again);
    Ok(Replayed { mission, run, trace: again, identical: difference.is_none(), difference })
}
