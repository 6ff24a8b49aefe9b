//! What a campaign runs: a mission with everything ready, and what is observed of one run.

use super::observed::{Observed, feature};
use super::plan::Plan;
use super::requirement::Requirement;
use crate::options::{FaultChoice, Options, Planner};
use crate::run::NoPlan;
use crate::setup::{SetupError, Simulation};
use crate::supervised::{Monitor, Script, Supervised, Unmonitored, Unsupervised};
use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Faults;
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
    Supervised(Box<Supervised<'m>>, Watched),
}

/// What is looked at while a run goes on, and after.
#[derive(Clone, Debug, Default)]
struct Watched {
    monitors: Vec<Monitor>,
    /// For how long the robot must stand when it is safe.
    after: Millis,
}

/// For how long a robot that is safe is watched: whether it moves again.
pub const AFTER: Millis = Millis(60_000);

/// Who plans.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::campaign::plan::Plan;
/// use cotama_sim::campaign::subject::{Policy, Subject};
/// use cotama_sim::run::Outcome;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let plan = Plan::from(&mission.run.faults);
/// let ends = |policy| Subject::new(&mission, policy).unwrap().run(&plan).outcome;
/// assert_eq!(ends(Policy::default()), Outcome::Completed);
/// assert_ne!(ends(Policy { rigid: true, ..Policy::default() }), Outcome::Completed);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policy {
    /// The allocator; that of the kind of mission if none: the rule of PANORAMA, and under
    /// supervisors [`PLANNER`](crate::supervised::PLANNER).
    pub planner: Option<Planner>,
    /// Whether better plans are looked for when margins have grown: without supervisors only.
    pub upward: bool,
    /// The plan of the start is kept, whatever happens to the margins: without supervisors only.
    pub rigid: bool,
}

/// Why a mission cannot be the subject of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub enum Unready {
    /// It cannot be set up.
    Setup(SetupError),
    /// Its supervisors cannot be made.
    Unsupervised(Unsupervised),
    /// It has no plan, even if nothing fails.
    NoPlan(NoPlan),
    /// The policy is for missions without supervisors.
    Policy,
    /// A requirement is no property that can be watched: its text, and why.
    Property(String, Unmonitored),
    /// A requirement is about supervisors, and the mission has none: its text.
    Plain(String),
    /// Supervisors that are shipped are to be held against themselves.
    Shipped,
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
            Self::Property(text, why) => write!(f, "`{}`: {why}", text.escape_debug()),
            Self::Shipped => {
                f.write_str("`conforms` is for supervisors of your own: these are the shipped ones")
            }
            Self::Plain(text) => write!(
                f,
                "`{}` is about supervisors, and the mission has none",
                text.escape_debug()
            ),
        }
    }
}

impl std::error::Error for Unready {}

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
            Robot::Supervised(Box::new(supervised), Watched::default())
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
        Self { mission, robot: Robot::Supervised(Box::new(supervised), Watched::default()) }
    }

    /// The same, watched for these requirements: properties end the run that breaks them, and a
    /// robot that is safe is watched for [`AFTER`] more.
    ///
    /// # Errors
    /// When one of them is no property of the mission's supervisors, or none that can be watched.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_sim::campaign::{plan::Plan, subject::{Policy, Subject}};
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let subject = Subject::new(&mission, Policy::default()).unwrap();
    /// let asked = ["AG !gs.DriveB".parse().unwrap()];
    /// let run = subject.watching(&asked).unwrap().run(&Plan::default());
    /// let witness = run.witness.unwrap();
    /// assert_eq!(witness.requirement, "AG !gs.DriveB");
    /// assert_eq!((witness.at_ms, witness.seen), (166_200, vec!["gs.g3".to_owned()]));
    /// ```
    pub fn watching(self, requirements: &[Requirement]) -> Result<Self, Unready> {
        let about = |it: &&Requirement| it.needs_supervisors();
        let (supervised, watched) = match (self.robot, requirements.iter().find(about)) {
            (Robot::Plain(_), Some(it)) => return Err(Unready::Plain(it.to_string())),
            (robot @ Robot::Plain(_), None) => return Ok(Self { robot, ..self }),
            (Robot::Supervised(supervised, watched), _) => (supervised, watched),
        };
        let properties = requirements.iter().filter_map(|it| match it {
            Requirement::Always(text) => Some(text),
            _ => None,
        });
        let monitor = |text: &String| {
            supervised.monitor(text).map_err(|error| Unready::Property(text.clone(), error))
        };
        let monitors = properties.map(monitor).collect::<Result<Vec<_>, _>>()?;
        let supervised = supervised.with_monitors(monitors.clone());
        let conforms = requirements.contains(&Requirement::Conforms);
        let supervised = match conforms.then(|| supervised.clone().compared()) {
            Some(None) => return Err(Unready::Shipped),
            Some(Some(compared)) => compared,
            None => supervised,
        };
        let stands = requirements.contains(&Requirement::StandsWhenSafe);
        let after = if stands { AFTER } else { watched.after };
        let robot = Robot::Supervised(Box::new(supervised), Watched { monitors, after });
        Ok(Self { robot, ..self })
    }

    /// The mission.
    pub const fn mission(&self) -> &'m Mission {
        self.mission
    }

    /// Whether supervisors decide.
    pub const fn is_supervised(&self) -> bool {
        matches!(self.robot, Robot::Supervised(..))
    }

    /// One run; a function of the plan alone.
    pub fn run(&self, plan: &Plan) -> Observed {
        match &self.robot {
            Robot::Plain(simulation) => plain(simulation, plan),
            Robot::Supervised(it, watched) => {
                // There is a plan at the start: that does not depend on what fails later.
                let run = it.run_and_watch(&Script::from(plan), watched.after);
                run.map_or_else(
                    |_| Observed::nothing(),
                    |(run, _)| Observed::of(&run, &watched.monitors),
                )
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
