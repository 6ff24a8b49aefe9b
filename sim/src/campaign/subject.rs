//! What a campaign runs: a mission with everything ready, and what is observed of one run.

use super::plan::Plan;
use crate::options::{FaultChoice, Options, Planner};
use crate::run::{NoPlan, Outcome};
use crate::setup::{SetupError, Simulation};
use crate::streams::fnv1a;
use crate::supervised::{self, Motion, Script, Supervised, Unsupervised, effect};
use cotama_core::monitor::Upward;
use cotama_models::cotama::{Diagnosis, FailureMode, local};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Faults, Moment};
use std::fmt;

/// A mission made ready to be run many times with faults that are drawn.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::campaign::{plan::Plan, subject::{Policy, Subject}};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// assert_eq!(subject.run(&Plan::default()).time_ms, 527_923);
/// ```
#[derive(Clone, Debug)]
pub struct Subject<'m> {
    mission: &'m Mission,
    robot: Robot<'m>,
}

#[derive(Clone, Debug)]
enum Robot<'m> {
    Plain(Box<Simulation<'m>>),
    Supervised(Box<Supervised<'m>>),
}

/// Who plans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policy {
    /// The allocator; that of the kind of mission if none: the rule of PANORAMA, and under
    /// supervisors [`PLANNER`](supervised::PLANNER).
    pub planner: Option<Planner>,
    /// Whether better plans are looked for when margins have grown: without supervisors only.
    pub upward: bool,
    /// The plan of the start is kept, whatever happens to the margins: without supervisors only.
    pub rigid: bool,
}

/// Why a mission cannot be the subject of a campaign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unready {
    /// It cannot be set up.
    Setup(SetupError),
    /// Its supervisors cannot be made.
    Unsupervised(Unsupervised),
    /// It has no plan, even if nothing fails.
    NoPlan(NoPlan),
    /// The policy is for missions without supervisors.
    Policy,
}

impl fmt::Display for Unready {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setup(error) => error.fmt(f),
            Self::Unsupervised(error) => error.fmt(f),
            Self::NoPlan(_) => f.write_str("there is no plan even if nothing fails"),
            Self::Policy => {
                f.write_str("upward and rigid policies are for missions without supervisors")
            }
        }
    }
}

impl std::error::Error for Unready {}

/// What is observed of one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observed {
    /// How it ended.
    pub outcome: Outcome,
    /// The time used, in ms, rounded half up.
    pub time_ms: u64,
    /// The energy used, in mJ, rounded half up.
    pub energy_mj: u64,
    /// How far the robot came, in mm.
    pub x_mm: u64,
    /// How often the operator was asked.
    pub requests: u64,
    /// How many plans there were after the first.
    pub replans: u64,
    /// The longest time in ms that the robot moved without a module that it required.
    pub exposed_ms: u64,
    /// The longest way in mm that it went on after the permit to move was gone.
    pub braked_mm: u64,
    /// Whether it moved after it was safe.
    pub moved_when_safe: bool,
    /// Whether a motor ran away, so that it could not brake as it was told.
    pub ran_away: bool,
    /// What failed, and where the local supervisor was then: rows of the FMECA by state.
    pub met: Vec<(FailureMode, local::State)>,
    /// What the run came through: hashes of transitions, of diagnoses, of decisions, of plans; each
    /// once, sorted.
    pub features: Vec<u64>,
    /// The supervisors' transitions that fired, as `ls.l5`, each once, sorted.
    pub fired: Vec<String>,
}

impl<'m> Subject<'m> {
    /// Makes a mission ready.
    ///
    /// # Errors
    /// An [`Unready`] for a mission that cannot be run, or not by this policy.
    pub fn new(mission: &'m Mission, policy: Policy) -> Result<Self, Unready> {
        let robot = if mission.supervisor().is_some() {
            if policy.upward || policy.rigid {
                return Err(Unready::Policy);
            }
            let supervised = Supervised::new(mission).map_err(Unready::Unsupervised)?;
            let supervised = match policy.planner {
                Some(planner) => supervised.with_planner(planner),
                None => supervised,
            };
            supervised.run(&Script::default()).map_err(Unready::NoPlan)?;
            Robot::Supervised(Box::new(supervised))
        } else {
            let limits = mission.limits;
            let upward = Upward {
                growth: limits.map(|limit| (limit / 100).max(1)),
                reserve: limits.map(|limit| limit / 200),
            };
            let options = Options {
                faults: FaultChoice::None,
                planner: policy.planner.unwrap_or_default(),
                upward: policy.upward.then_some(upward),
                ..Options::default()
            };
            let simulation = Simulation::new(mission, &options).map_err(Unready::Setup)?;
            simulation.run(0).map_err(Unready::NoPlan)?;
            let simulation =
                if policy.rigid { simulation.without_adaptation() } else { simulation };
            Robot::Plain(Box::new(simulation))
        };
        Ok(Self { mission, robot })
    }

    /// A supervised mission whose supervisors or planner were chosen by the caller.
    pub fn of(mission: &'m Mission, supervised: Supervised<'m>) -> Self {
        Self { mission, robot: Robot::Supervised(Box::new(supervised)) }
    }

    /// The mission.
    pub const fn mission(&self) -> &'m Mission {
        self.mission
    }

    /// Whether supervisors decide.
    pub const fn is_supervised(&self) -> bool {
        matches!(self.robot, Robot::Supervised(_))
    }

    /// One run; a function of the plan alone.
    pub fn run(&self, plan: &Plan) -> Observed {
        match &self.robot {
            Robot::Plain(simulation) => plain(simulation, plan),
            Robot::Supervised(it) => {
                // There is a plan at the start: that does not depend on what fails later.
                it.run(&Script::from(plan))
                    .map_or_else(|_| Observed::nothing(), |it| Observed::of(&it))
            }
        }
    }
}

fn plain(simulation: &Simulation<'_>, plan: &Plan) -> Observed {
    let Ok(Ok(run)) = simulation.run_with(&Faults::from(plan)) else { return Observed::nothing() };
    let mut features = vec![feature("outcome", &[run.outcome as u64])];
    for it in &run.plans {
        let cause = it.cause.text(simulation.mission());
        features.push(feature(&cause, &[it.first_activity as u64]));
    }
    features.sort_unstable();
    features.dedup();
    Observed {
        outcome: run.outcome,
        time_ms: run.used[0],
        energy_mj: run.used[1],
        x_mm: run.x_mm,
        requests: run.operator_requests,
        replans: run.replans,
        features,
        ..Observed::nothing()
    }
}

impl Observed {
    /// Of a run that never began.
    const fn nothing() -> Self {
        Self {
            outcome: Outcome::Failed,
            time_ms: 0,
            energy_mj: 0,
            x_mm: 0,
            requests: 0,
            replans: 0,
            exposed_ms: 0,
            braked_mm: 0,
            moved_when_safe: false,
            ran_away: false,
            met: Vec::new(),
            features: Vec::new(),
            fired: Vec::new(),
        }
    }

    /// Of a run under supervisors.
    pub fn of(run: &supervised::Run) -> Self {
        let mut features = vec![feature("outcome", &[run.outcome as u64])];
        let mut fired: Vec<(&str, &str)> =
            run.fired.iter().map(|it| (it.net, it.transition.as_str())).collect();
        // Which transition of a net follows which.
        for net in ["gs", "ls", "cs", "pf", "to"] {
            let mut before = 0;
            for it in run.fired.iter().filter(|it| it.net == net) {
                let this = fnv1a(it.transition.as_bytes());
                features.push(feature(net, &[before, this]));
                before = this;
            }
        }
        fired.sort_unstable();
        fired.dedup();
        for it in &run.conduct {
            let found = match it.detected {
                None => 0,
                Some((_, Diagnosis::None)) => 1,
                Some((_, Diagnosis::Unexplained)) => 2,
                Some((_, Diagnosis::Ambiguous(_))) => 3,
                Some((_, Diagnosis::Unique(mode))) => 4 + u64::from(mode != it.mode),
            };
            let decided = it.decided.map_or(9, |it| it.1 as u64);
            features.push(feature("failure", &[it.mode as u64, it.during as u64]));
            features.push(feature("found", &[it.mode as u64, found, decided]));
            features.push(feature("exposed", &[it.mode as u64, it.exposed.0.ilog2_or_zero()]));
        }
        features.sort_unstable();
        features.dedup();
        let runs_away = |it: &supervised::Conduct| effect(it.mode).motion == Motion::Runaway;
        Self {
            outcome: run.outcome,
            time_ms: run.used[0],
            energy_mj: run.used[1],
            x_mm: run.x.0,
            requests: run.operator_requests,
            replans: run.plans.len().saturating_sub(1) as u64,
            exposed_ms: run.exposed.0,
            braked_mm: run.braked.0,
            moved_when_safe: run.moved_when_safe,
            ran_away: run.conduct.iter().any(runs_away),
            met: run.conduct.iter().map(|it| (it.mode, it.during)).collect(),
            features,
            fired: fired.into_iter().map(|(net, it)| format!("{net}.{it}")).collect(),
        }
    }
}

/// The name of a state in results: that of the net.
pub fn state_name(state: local::State) -> &'static str {
    match state {
        local::State::Idle => "Idle",
        local::State::End => "End",
        other => Moment::state_name(other).unwrap_or("Idle"),
    }
}

fn feature(kind: &str, numbers: &[u64]) -> u64 {
    numbers.iter().fold(fnv1a(kind.as_bytes()), |hash, it| {
        (hash ^ it.wrapping_mul(0x9e37_79b9_7f4a_7c15))
            .rotate_left(23)
            .wrapping_mul(0x0100_0000_01b3)
    })
}

trait Log {
    fn ilog2_or_zero(self) -> u64;
}

impl Log for u64 {
    fn ilog2_or_zero(self) -> u64 {
        self.checked_ilog2().map_or(0, |it| u64::from(it) + 1)
    }
}
