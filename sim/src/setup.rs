//! A mission made ready to be run many times: everything that does not depend on the seed.

use crate::options::{FaultChoice, Options};
use crate::plan::{NM_PER_MM, Plannable};
use crate::streams::Streams;
use cotama_core::hardware::Equipment;
use cotama_core::monitor::MonitorError;
use cotama_core::units::Millis;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults};
use std::borrow::Cow;

/// The most draws for random events in a run: metres of path times kinds of random events.
pub const MAX_DRAWS: u64 = 10_000_000;

/// A mission made ready to be run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::{options::Options, run::Outcome, setup::Simulation};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let simulation = Simulation::new(&mission, &Options::default()).unwrap();
/// let run = simulation.run(0).unwrap();
/// assert_eq!((run.outcome, run.replans), (Outcome::Completed, 3));
/// ```
#[derive(Clone, Debug)]
pub struct Simulation<'m> {
    pub(crate) plannable: Plannable<'m>,
    pub(crate) period_us: u64,
    /// Places in nm from which the real power is this many parts per thousand of the modelled one.
    /// *Invariant:* sorted, strictly rising, the first one at 0.
    pub(crate) segments: Vec<(u64, u64)>,
    pub(crate) faults: Faults,
    events: Vec<Pending>,
}

/// The events that a run meets on its path.
#[derive(Clone, Debug)]
pub(crate) struct Course<'s> {
    pub(crate) events: Cow<'s, [Pending]>,
    /// As [`Simulation::segments`].
    pub(crate) segments: Cow<'s, [(u64, u64)]>,
}

/// An event that waits for the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pending {
    /// In nm.
    pub(crate) x_nm: u64,
    pub(crate) kind: EventKind,
    /// The index of the random event that it comes from.
    pub(crate) random: Option<usize>,
}

/// Why a mission cannot be made ready.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::{options::Options, setup::{SetupError, Simulation}};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let options = Options { monitor_period: Some(Millis(0)), ..Options::default() };
/// assert_eq!(Simulation::new(&mission, &options).unwrap_err(), SetupError::ZeroPeriod);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetupError {
    /// The monitor period is zero.
    ZeroPeriod,
    /// The random events would take more than [`MAX_DRAWS`] draws.
    TooManyDraws {
        /// Number of draws.
        draws: u64,
    },
    /// The limits cannot be watched.
    Unwatchable(MonitorError),
    /// The faults name a zone or a hardware that the mission does not have: they were read for
    /// another one.
    ForeignFaults,
    /// The margins were learned from runs of another mission.
    ForeignMargins {
        /// Name of that mission.
        mission: String,
    },
}

impl std::fmt::Display for SetupError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ZeroPeriod => f.write_str("the monitor period is 0 ms; it must be at least 1 ms"),
            Self::TooManyDraws { draws } => write!(
                f,
                "the random events need {draws} draws, at most {MAX_DRAWS} are made; name fewer of \
                 them"
            ),
            Self::Unwatchable(why) => write!(f, "the limits cannot be watched: {why}"),
            Self::ForeignFaults => {
                f.write_str("the faults name a zone or hardware that the mission does not have")
            }
            Self::ForeignMargins { mission } => {
                let name = mission.escape_debug();
                write!(f, "the margins were learned from runs of `{name}`, or of other activities")
            }
        }
    }
}

impl std::error::Error for SetupError {}

impl<'m> Simulation<'m> {
    /// Makes a mission ready. The seed of the options is not used here: it is given to each run.
    ///
    /// # Errors
    /// A [`SetupError`] for a period of zero, too many random events, or faults of another mission.
    pub fn new(mission: &'m Mission, options: &Options) -> Result<Self, SetupError> {
        let faults = match &options.faults {
            FaultChoice::Script => mission.run.faults.clone(),
            FaultChoice::None => Faults::default(),
            FaultChoice::Given { faults, .. } => faults.clone(),
        };
        let Millis(period_ms) = options.monitor_period.unwrap_or(mission.run.monitor_period);
        if period_ms == 0 {
            return Err(SetupError::ZeroPeriod);
        }
        if !belongs(&faults, mission) {
            return Err(SetupError::ForeignFaults);
        }
        belong(options, mission)?;
        let draws = mission.path_length.0.div_ceil(1000).saturating_mul(faults.random.len() as u64);
        if draws > MAX_DRAWS {
            return Err(SetupError::TooManyDraws { draws });
        }
        let mut simulation = Self {
            plannable: Plannable::new(mission, options).map_err(SetupError::Unwatchable)?,
            period_us: period_ms.saturating_mul(1000),
            segments: segments(&faults, mission),
            events: Vec::new(),
            faults,
        };
        let scripted = simulation.faults.events.iter();
        let pending =
            |x_mm: u64, kind| Pending { x_nm: x_mm.saturating_mul(NM_PER_MM), kind, random: None };
        simulation.events = scripted.map(|event| pending(event.x.0, event.kind)).collect();
        simulation.events.sort_by_key(|event| event.x_nm);
        Ok(simulation)
    }

    /// The mission.
    pub fn mission(&self) -> &'m Mission {
        self.plannable.mission
    }

    /// The monitor period.
    pub fn monitor_period(&self) -> Millis {
        Millis(self.period_us / 1000)
    }

    /// All hardware of the robot.
    pub(crate) fn all_hardware(&self) -> Equipment {
        self.mission().scenario().available
    }

    /// Returns the course of a run with other scripted faults: its events, and the real power along
    /// its path.
    ///
    /// # Errors
    /// [`SetupError::ForeignFaults`] for faults of another mission.
    pub(crate) fn course(&self, faults: &Faults) -> Result<Course<'_>, SetupError> {
        if !belongs(faults, self.mission()) {
            return Err(SetupError::ForeignFaults);
        }
        let pending = |it: &Event| Pending {
            x_nm: it.x.0.saturating_mul(NM_PER_MM),
            kind: it.kind,
            random: None,
        };
        let mut events: Vec<_> = faults.events.iter().map(pending).collect();
        events.sort_by_key(|it| it.x_nm);
        let segments = segments(faults, self.mission());
        Ok(Course { events: Cow::Owned(events), segments: Cow::Owned(segments) })
    }

    /// The events of a run, sorted by place; of equal places the scripted first, then the random
    /// ones in the order of the file. Each random event is drawn from its own stream, named `event`
    /// and its name: for each metre of path whether it happens there, then at which millimetre.
    pub(crate) fn events(&self, seed: u64) -> Cow<'_, [Pending]> {
        if self.faults.random.is_empty() {
            return Cow::Borrowed(&self.events);
        }
        let streams = Streams::new(seed);
        let mut events = self.events.clone();
        let length = self.mission().path_length.0;
        for (index, random) in self.faults.random.iter().enumerate() {
            let mut stream = streams.stream(&format!("event {}", random.name));
            for metre in (0..length).step_by(1000) {
                if stream.below(1000) < u64::from(random.per_km) {
                    let x_mm = metre + stream.below(1000);
                    if x_mm < length {
                        let x_nm = x_mm * NM_PER_MM;
                        events.push(Pending { x_nm, kind: random.kind, random: Some(index) });
                    }
                }
            }
        }
        events.sort_by_key(|event| event.x_nm);
        Cow::Owned(events)
    }
}

/// Looks whether the margins of the options are those of this mission.
///
/// # Errors
/// [`SetupError::ForeignMargins`].
pub(crate) fn belong(options: &Options, mission: &Mission) -> Result<(), SetupError> {
    let Some(margins) = &options.margins else { return Ok(()) };
    let ids = mission.scenario().activities.iter().map(|it| it.id.as_str());
    if margins.mission == mission.name && ids.eq(margins.from.iter().map(|it| it.activity.as_str()))
    {
        return Ok(());
    }
    Err(SetupError::ForeignMargins { mission: margins.mission.clone() })
}

fn belongs(faults: &Faults, mission: &Mission) -> bool {
    let known = |kind: EventKind| match kind {
        EventKind::Fault { hardware, .. } | EventKind::Repair { hardware, .. } => {
            hardware < mission.hardware.len()
        }
        EventKind::Obstacle { .. } | EventKind::Odometry { .. } => true,
    };
    faults.power_errors.iter().all(|error| error.zone < mission.zones.len())
        && faults.events.iter().all(|event| known(event.kind) && event.x <= mission.path_length)
        && faults.random.iter().all(|random| known(random.kind))
}

/// The real power along the path. Zones are half-open, but the last place of the path belongs to
/// the zones that end there; the errors of zones that overlap add up, and no power falls below
/// zero.
fn segments(faults: &Faults, mission: &Mission) -> Vec<(u64, u64)> {
    let zone_ends = |index: usize| {
        let zone = &mission.zones[index];
        let end = if zone.x_end >= mission.path_length { u64::MAX } else { zone.x_end.0 };
        (zone.x_start.0, end)
    };
    let errors: Vec<_> = faults
        .power_errors
        .iter()
        .map(|error| (zone_ends(error.zone), i64::from(error.permille)))
        .collect();
    let mut borders: Vec<u64> =
        errors.iter().flat_map(|&((start, end), _)| [start, end]).chain([0]).collect();
    borders.sort_unstable();
    borders.dedup();
    borders.retain(|&border| border < u64::MAX);
    let factor = |x: u64| {
        let inside = errors.iter().filter(|&&((start, end), _)| start <= x && x < end);
        1000i64.saturating_add(inside.map(|&(_, permille)| permille).sum()).max(0).unsigned_abs()
    };
    borders.into_iter().map(|x| (x.saturating_mul(NM_PER_MM), factor(x))).collect()
}
