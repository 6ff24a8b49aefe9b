//! Observations of one run.

use cotama_models::margins::Spent;
use cotama_models::robots::{self as row, Body, Motion, Robot, Where};
use cotama_sim::body::FIRMWARE_WATCHDOG;
use cotama_sim::fleet::{self, record::Fate};
use cotama_sim::robots::{self, Monitor};
use cotama_sim::run::Outcome;
use cotama_sim::streams::fnv1a;
use serde::{Deserialize, Serialize};

/// The observations of one run. A [`Line`](crate::run::Line) of the results holds the serialised
/// ones.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::{plan::Plan, subject::{Policy, Subject}};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let run = Subject::new(&mission, Policy::default()).unwrap().run(&Plan::default());
/// assert_eq!((run.outcome.name(), run.requests, run.exposed_ms), ("completed", 0, 0));
/// assert!(run.fired.contains(&"gs.g3".to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    /// For how long robots of a team worked, all together, in ms.
    #[serde(skip)]
    pub robot_time_ms: u64,
    /// Number of uses of skills that failed in a team.
    #[serde(skip)]
    pub failed_uses: u64,
    /// The longest way in mm that it went on after the permit to move was gone.
    #[serde(skip)]
    pub braked_mm: u64,
    /// Whether it moved after it was safe.
    #[serde(skip)]
    pub moved_when_safe: bool,
    /// The longest time in ms that a failure was to be seen, beyond its latency, and was not.
    #[serde(skip)]
    pub unseen_ms: u64,
    /// Whether a plan was made with modules that were known to be lost.
    #[serde(skip)]
    pub planned_with_lost: bool,
    /// Whether a motor ran away, so that it could not brake as it was told.
    #[serde(skip)]
    pub ran_away: bool,
    /// How long in ms the robot may have moved without a required module, and how far in mm it may
    /// have gone on without a permit.
    #[serde(skip)]
    pub allowed: (u64, u64),
    /// Failures, by number, and the place of the robot in its drive then, in a word.
    #[serde(skip)]
    pub met: Vec<(usize, String)>,
    /// Features that the run came through: hashes of transitions, of diagnoses, of decisions, of
    /// plans; each once, sorted.
    #[serde(skip)]
    pub features: Vec<u64>,
    /// The supervisors' transitions that fired, as `ls.ask_Following`, each once, sorted.
    #[serde(skip)]
    pub fired: Vec<String>,
    /// Amounts of each activity that the run came to, in their order.
    #[serde(skip)]
    pub spent: Vec<Spent>,
    /// The requirement that was broken while the run went on, which ended it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub witness: Option<Witness>,
}

/// A broken requirement, seen while a run went on.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::{plan::Plan, subject::{Policy, Subject}};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// let subject = subject.watching(&["AG !ls.End".parse().unwrap()]).unwrap();
/// let witness = subject.run(&Plan::default()).witness.unwrap();
/// assert!(witness.seen.contains(&"ls.Following_done".to_owned()), "{witness:?}");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Witness {
    /// The requirement, as a text.
    pub requirement: String,
    /// When, in ms.
    pub at_ms: u64,
    /// The last actions of the supervisors, in one round, as `gs.g2`.
    pub seen: Vec<String>,
}

impl Observed {
    /// Returns the observations of a run that never began.
    pub(super) const fn nothing() -> Self {
        Self {
            outcome: Outcome::Failed,
            time_ms: 0,
            energy_mj: 0,
            x_mm: 0,
            requests: 0,
            replans: 0,
            exposed_ms: 0,
            robot_time_ms: 0,
            failed_uses: 0,
            braked_mm: 0,
            moved_when_safe: false,
            unseen_ms: 0,
            planned_with_lost: false,
            ran_away: false,
            allowed: (0, 0),
            met: Vec::new(),
            features: Vec::new(),
            fired: Vec::new(),
            spent: Vec::new(),
            witness: None,
        }
    }

    /// Returns the observations of a team's run.
    pub(super) fn of_team(run: &fleet::record::Run) -> Self {
        let reported = run.count(Fate::Reported) as u64;
        let outcome = match (run.is_sound(), reported) {
            (false, _) => Outcome::Failed,
            (true, 0) => Outcome::Completed,
            (true, _) => Outcome::Safe,
        };
        let rounds = u64::from(run.rounds).ilog2_or_zero();
        let mut features = vec![
            feature("outcome", &[outcome as u64]),
            feature("reported", &[reported.ilog2_or_zero()]),
            feature("reopened", &[u64::from(run.reopened).ilog2_or_zero()]),
            feature("rounds", &[rounds, run.out as u64]),
        ];
        features.sort_unstable();
        Self {
            outcome,
            time_ms: run.end_ms,
            energy_mj: run.energy_mj,
            replans: u64::from(run.reopened),
            robot_time_ms: run.busy_ms,
            failed_uses: u64::from(run.failed_uses),
            features,
            ..Self::nothing()
        }
    }

    /// Returns the observations of a run under the supervisors of a robot's file.
    pub(super) fn of_robot(run: &robots::Run, robot: &Robot, monitors: &[Monitor]) -> Self {
        let mut features = vec![feature("outcome", &[run.outcome as u64])];
        features.extend(run.fired.iter().map(|it| feature("fired", &[fnv1a(it.as_bytes())])));
        let runs = run.configurations.iter().map(|it| it.1.map_or(0, |it| it as u64 + 1));
        let runs: Vec<u64> = runs.collect();
        features.extend(runs.windows(2).map(|it| feature("runs", it)));
        for it in &run.conduct {
            let taken = it.taken_for.first().map_or(0, |it| *it as u64 + 1);
            let decided = it.decided.map_or(9, |it| it.1 as u64);
            let at = place(it.during);
            features.push(feature("failure", &[it.failure as u64, at]));
            features.push(feature("found", &[it.failure as u64, taken, decided]));
            features.push(feature("exposed", &[it.failure as u64, it.exposed.0.ilog2_or_zero()]));
        }
        features.sort_unstable();
        features.dedup();
        let row = |it: &robots::Conduct| robot.failures.get(it.failure);
        let runs_away =
            |it: &robots::Conduct| row(it).is_some_and(|it| it.motion == Motion::Runaway);
        Self {
            outcome: run.outcome,
            time_ms: run.used[0],
            energy_mj: run.used[1],
            x_mm: run.x.0,
            requests: run.operator_requests,
            replans: run.plans.len().saturating_sub(1) as u64,
            robot_time_ms: 0,
            failed_uses: 0,
            exposed_ms: run.exposed.0,
            braked_mm: run.braked.0,
            moved_when_safe: run.moved_when_safe,
            unseen_ms: run.unseen.0,
            planned_with_lost: run.planned_with_lost,
            ran_away: run.conduct.iter().any(runs_away),
            met: run
                .conduct
                .iter()
                .map(|it| (it.failure, robot.place_name(it.during).to_owned()))
                .collect(),
            allowed: robot.body.as_ref().map_or((0, 0), |body| {
                let rows = run.conduct.iter().filter_map(row);
                (rows.map(|it| allowed_ms(it, body)).sum(), braking_mm(body))
            }),
            features,
            fired: run.fired.iter().cloned().collect(),
            spent: run.spent.clone(),
            witness: run.violated.as_ref().map(|it| Witness {
                requirement: monitors.get(it.monitor).map_or("", Monitor::text).to_owned(),
                at_ms: it.at.0,
                seen: it.fired.clone(),
            }),
        }
    }
}

/// How long a failure lets the robot move without a required module: until it is seen, also after
/// each time that a module is started anew for it; told, decided and answered, a round each; and
/// until the robot stands. A computer that is down sees nothing: the micro-controller stops then.
fn allowed_ms(row: &row::Failure, body: &Body) -> u64 {
    let sets = row.sets.as_ref().and_then(|it| it.times);
    let times = 1 + row.restarts.map_or(0, |it| u64::from(it.times)) + u64::from(sets.unwrap_or(0));
    let seen = match row.motion {
        Motion::Mindless => row.latency.max(FIRMWARE_WATCHDOG),
        _ => row.latency,
    };
    let rounds = 5 * body.period.0;
    let brakes = body.speed_max.0.saturating_mul(1_000) / body.acceleration.max(1);
    times.saturating_mul(seen.0 + rounds).saturating_add(brakes)
}

/// The braking distance from the largest speed, with a period before it begins.
fn braking_mm(body: &Body) -> u64 {
    let v = body.speed_max.0;
    v * v / (2 * body.acceleration.max(1)) + v * body.period.0 / 1_000 + 1
}

/// A number for a place of the robot in its drive.
const fn place(at: Where) -> u64 {
    match at {
        Where::Rests => 0,
        Where::Waits => 1,
        Where::Runs { sub_objective, .. } => 2 + sub_objective as u64,
    }
}

pub(super) fn feature(kind: &str, numbers: &[u64]) -> u64 {
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
