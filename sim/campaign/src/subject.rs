//! The subject of a campaign: a mission or a team with everything ready, and the observations of
//! one run.

use crate::observed::{Observed, feature};
use crate::plan::{Fault, Plan};
use crate::requirement::Requirement;
use crate::space::{Rates, Space};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::margins::Calibration;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Definition, Mission};
use cotama_models::robots::Measurement;
use cotama_models::team::scenario::Scenario;
use cotama_sim::fleet;
use cotama_sim::options::{FaultChoice, Fidelity, Options, Planner, upward};
use cotama_sim::robots::{self, Driven, Monitor, Undriven, Unmonitored};
use cotama_sim::run::NoPlan;
use cotama_sim::setup::Simulation;
use std::ops::RangeInclusive;
use std::sync::Arc;

mod story;
mod unready;

pub use unready::Unready;

/// A mission or a team made ready to be run many times with faults that are drawn.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::{plan::Plan, subject::{Policy, Subject}};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// assert_eq!(subject.run(&Plan::default()).time_ms, 527_923);
/// ```
#[derive(Clone, Debug)]
pub struct Subject<'m> {
    name: String,
    policy: Policy,
    /// Name of the mission in the files of failures.
    source: Option<String>,
    robot: Robot<'m>,
}

#[derive(Clone, Debug)]
enum Robot<'m> {
    Plain(&'m Mission, Box<Simulation<'m>>),
    /// Under the supervisors of a robot's file.
    Driven(&'m Mission, Box<Driven<'m>>, Vec<Monitor>),
    Team(Box<Scenario>, Option<fleet::Planted>),
}

/// For how long a robot that is safe is watched: whether it moves again.
pub const AFTER: Millis = Millis(60_000);

/// The planner of the runs.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::plan::Plan;
/// use cotama_campaign::subject::{Policy, Subject};
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
    /// The planner; [that of the mission](Planner::of) if `None`, as in every command.
    pub planner: Option<Planner>,
    /// Whether better plans are looked for when margins have grown.
    pub upward: bool,
    /// The plan of the start is kept, whatever happens to the margins.
    pub rigid: bool,
    /// How closely the robot is modelled.
    pub fidelity: Fidelity,
}

impl Policy {
    /// Returns the planner of this mission.
    pub fn of(self, mission: &Definition) -> Planner {
        self.planner.unwrap_or_else(|| Planner::of(mission))
    }

    /// Returns the name: `usual`, `upward` or `rigid`.
    pub const fn name(self) -> &'static str {
        match (self.rigid, self.upward) {
            (true, _) => "rigid",
            (false, true) => "upward",
            (false, false) => "usual",
        }
    }

    /// Returns the planner and the adaptation of a mission, in words.
    pub fn words(self, mission: &Definition) -> String {
        let planner = if mission.plans_by_wishes() {
            "an exact search by the wishes of the mission".to_owned()
        } else {
            self.of(mission).words()
        };
        match (self.rigid, self.upward) {
            (true, _) => format!("{planner}; the plan of the start is kept"),
            (false, true) => format!("{planner}; better plans when margins have grown"),
            (false, false) => planner,
        }
    }

    /// How a mission is run by it.
    pub fn options(self, mission: &Definition, faults: FaultChoice) -> Options {
        Options {
            faults,
            planner: Some(self.of(mission)),
            rigid: self.rigid,
            upward: self.upward.then(|| upward(mission.limits)),
            fidelity: self.fidelity,
            ..Options::default()
        }
    }
}

impl<'m> Subject<'m> {
    /// Makes a mission ready.
    ///
    /// # Errors
    /// An [`Unready`] for a mission that cannot be run, or not by this policy.
    pub fn new(mission: &'m Mission, policy: Policy) -> Result<Self, Unready> {
        Self::holding(mission, policy, None)
    }

    /// Makes a mission ready whose plans hold something back for what remains.
    ///
    /// # Errors
    /// As [`new`](Self::new), and for margins of another mission.
    pub fn holding(
        mission: &'m Mission,
        policy: Policy,
        margins: Option<Arc<Calibration>>,
    ) -> Result<Self, Unready> {
        let no_plan = |why: NoPlan| Unready::NoPlan(why, why.text(mission));
        let robot = if mission.robot().is_some() {
            let options = Options { margins, ..policy.options(mission, FaultChoice::None) };
            let driven = Driven::with(mission, &options).map_err(Unready::Undriven)?;
            driven.run(&robots::Script::default()).map_err(no_plan)?;
            Robot::Driven(mission, Box::new(driven), Vec::new())
        } else if !policy.fidelity.is_line() {
            return Err(Unready::Undriven(Undriven::Plain));
        } else {
            let options = Options { margins, ..policy.options(mission, FaultChoice::None) };
            let simulation = Simulation::new(mission, &options).map_err(Unready::Setup)?;
            simulation.run(0).map_err(no_plan)?;
            Robot::Plain(mission, Box::new(simulation))
        };
        let policy = Policy { planner: Some(policy.of(mission)), ..policy };
        Ok(Self { name: mission.name.clone(), policy, source: None, robot })
    }

    /// The same, with the name of an embedded mission, or the path of a file, by which the files of
    /// its failures name it.
    #[must_use]
    pub fn named(self, source: &str) -> Self {
        Self { source: Some(source.to_owned()), ..self }
    }

    /// The same, with failures that are found as they were measured, in place of assumed latencies:
    /// each run draws by its failures and their times. A mission without supervisors, and a team,
    /// are left as they are.
    #[must_use]
    pub fn measured(self, measurement: Arc<Measurement>) -> Self {
        let Robot::Driven(mission, driven, monitors) = self.robot else { return self };
        let driven = Box::new(driven.measured(measurement));
        Self { robot: Robot::Driven(mission, driven, monitors), ..self }
    }

    /// Returns the policy: planner and adaptation.
    pub const fn policy(&self) -> Policy {
        self.policy
    }

    /// Returns the name of the mission in the files of its failures.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// A team at work; its own faults are replaced by those of each plan. It is completed when all
    /// tasks are done, failed when something does not hold that must hold of every run, and else
    /// it ended with tasks that were reported.
    ///
    /// ```
    /// use cotama_models::team::scenario::service;
    /// use cotama_campaign::{plan::Plan, subject::Subject};
    /// let run = Subject::of_team(service().unwrap(), None).run(&Plan::default());
    /// assert_eq!((run.outcome.name(), run.replans), ("completed", 0));
    /// ```
    pub fn of_team(team: Scenario, planted: Option<fleet::Planted>) -> Self {
        let (name, policy) = (team.name.clone(), Policy::default());
        Self { name, policy, source: None, robot: Robot::Team(Box::new(team), planted) }
    }

    /// The same, watched for these requirements: properties end the run that breaks them, and a
    /// robot that is safe is watched for [`AFTER`] more.
    ///
    /// # Errors
    /// When one of them is no property of the mission's supervisors, or none that can be watched.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_campaign::{plan::Plan, subject::{Policy, Subject}};
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
        let of_teams = requirements.iter().find(|it| it.needs_team());
        if let Some(it) = of_teams.filter(|_| !self.is_team()) {
            return Err(Unready::NoTeam(it.to_string()));
        }
        let Robot::Driven(mission, driven, _) = self.robot else {
            return match requirements.iter().find(|it| it.needs_supervisors()) {
                Some(it) => Err(Unready::Plain(it.to_string())),
                None => Ok(self),
            };
        };
        let monitors = watched(requirements, |text| driven.monitor(text))?;
        let stands = requirements.contains(&Requirement::StandsWhenSafe);
        let after = if stands { AFTER } else { Millis(0) };
        let driven = driven.with_monitors(monitors.clone()).watched_for(after);
        Ok(Self { robot: Robot::Driven(mission, Box::new(driven), monitors), ..self })
    }

    /// Returns the name of the mission or team.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the mission; `None` of a team.
    pub const fn mission(&self) -> Option<&'m Mission> {
        match &self.robot {
            Robot::Plain(mission, _) | Robot::Driven(mission, ..) => Some(mission),
            Robot::Team(..) => None,
        }
    }

    /// Whether it is a team.
    pub const fn is_team(&self) -> bool {
        matches!(self.robot, Robot::Team(..))
    }

    /// Returns a requirement in words, as it is meant of this subject.
    ///
    /// ```
    /// use cotama_models::team::scenario::service;
    /// use cotama_campaign::{requirement::Requirement, subject::Subject};
    /// let team = Subject::of_team(service().unwrap(), None);
    /// assert_eq!(team.meaning(&Requirement::Completed), "all tasks are done");
    /// ```
    pub fn meaning(&self, requirement: &Requirement) -> String {
        match (self.is_team(), requirement) {
            (true, Requirement::Completed) => "all tasks are done".into(),
            (true, Requirement::NotFailed) => {
                "each task is done once or reported, and none is worked for twice at once".into()
            }
            _ => requirement.words(),
        }
    }

    /// Returns the length of the path; 0 of a team.
    pub fn path_length(&self) -> Millimetres {
        self.mission().map_or(Millimetres(0), |it| it.path_length)
    }

    /// Returns the space of possible faults.
    pub fn space(&self, rates: Rates, faults: RangeInclusive<u64>) -> Space {
        match &self.robot {
            Robot::Plain(mission, _) | Robot::Driven(mission, ..) => {
                Space::of(mission, rates, faults)
            }
            Robot::Team(team, _) => Space::of_team(team, rates, faults),
        }
    }

    /// Returns the planner in words; of a team the allocation of its tasks.
    pub fn words(&self) -> String {
        match &self.robot {
            Robot::Plain(mission, _) | Robot::Driven(mission, ..) => self.policy.words(mission),
            Robot::Team(team, _) => format!("allocation {}", team.method.name()),
        }
    }

    /// Writes the faults of a plan as the text of a file, a line each.
    pub fn text(&self, plan: &Plan) -> String {
        match &self.robot {
            Robot::Plain(mission, _) | Robot::Driven(mission, ..) => plan.compact(mission),
            Robot::Team(team, _) => team.faults_to_toml(&plan.of_team()),
        }
    }

    /// Writes the faults of a plan as results store them.
    pub(super) fn stored(&self, plan: &Plan) -> String {
        self.mission().map_or_else(|| self.text(plan), |it| plan.to_toml(it))
    }

    /// Reads a plan from the text of its faults; `None` for another text.
    pub fn plan(&self, text: &str) -> Option<Plan> {
        match &self.robot {
            Robot::Plain(mission, _) | Robot::Driven(mission, ..) => {
                Some(Plan::from(&Faults::parse("a result", text, mission).ok()?))
            }
            Robot::Team(team, _) => {
                let read = team.faults_of("a result", text).ok()?;
                Some(Plan { faults: read.faults.into_iter().map(Fault::Team).collect() })
            }
        }
    }

    /// Returns the signature of a plan, with the names of the mission.
    pub fn signature(&self, plan: &Plan) -> String {
        match &self.robot {
            Robot::Team(team, _) => plan.signature_in(team),
            _ => self.mission().map_or_else(|| plan.signature(), |it| plan.named_signature(it)),
        }
    }

    /// Whether supervisors decide.
    pub const fn is_supervised(&self) -> bool {
        matches!(self.robot, Robot::Driven(..))
    }

    /// One run; a function of the plan alone.
    pub fn run(&self, plan: &Plan) -> Observed {
        match &self.robot {
            Robot::Plain(_, simulation) => plain(simulation, plan),
            Robot::Driven(mission, it, monitors) => {
                let run = it.run(&robots::Script::of(&Faults::from(plan), mission));
                match (run, mission.robot()) {
                    (Ok(run), Some(file)) => Observed::of_robot(&run, file.robot(), monitors),
                    _ => Observed::nothing(),
                }
            }
            Robot::Team(team, planted) => {
                let team = Scenario { faults: plan.of_team(), ..(**team).clone() };
                Observed::of_team(&fleet::run_with(&team, *planted))
            }
        }
    }
}

/// The monitors of the properties among requirements.
fn watched(
    requirements: &[Requirement],
    monitor: impl Fn(&str) -> Result<Monitor, Unmonitored>,
) -> Result<Vec<Monitor>, Unready> {
    let properties = requirements.iter().filter_map(|it| match it {
        Requirement::Always(text) => Some(text),
        _ => None,
    });
    let made =
        |text: &String| monitor(text).map_err(|error| Unready::Property(text.clone(), error));
    properties.map(made).collect()
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
        spent: run.spent,
        ..Observed::nothing()
    }
}
