//! A failure as a file that is run again and compared: who plans, what broke, how the run ended.

use crate::observed::Observed;
use crate::plan::Plan;
use crate::requirement::{NoRequirement, Requirement};
use crate::subject::{Policy, Subject, Unready};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Adapts, Ending, Expected, FaultsFile, PlannedBy};
use cotama_models::missions::known::OBJECTIVES;
use cotama_models::toml_text::quoted;
use cotama_sim::options::{By, Fidelity, Planner, STEPS};
use cotama_sim::run::Outcome;
use std::fmt::{self, Write};

/// How a run ended, as a file notes it; `requirement` is the one that it broke.
pub fn ending(run: &Observed, requirement: &Requirement) -> Ending {
    let broken = run.witness.as_ref().filter(|it| it.requirement == requirement.to_string());
    Ending {
        outcome: run.outcome.name(),
        time_ms: run.time_ms,
        energy_mj: run.energy_mj,
        x_mm: run.x_mm,
        replans: Some(run.replans),
        requests: Some(run.requests),
        exposed_ms: Some(run.exposed_ms),
        broken_ms: broken.map(|it| it.at_ms),
    }
}

/// The tables `[planner]` and `[expected]` of a file of faults; a team has the latter alone.
pub fn tables(subject: &Subject<'_>, requirement: &Requirement, run: &Observed) -> String {
    let mut text = String::new();
    if let Some(mission) = subject.mission() {
        let (objective, by, steps) = subject.policy().of(mission).parts();
        let name = OBJECTIVES.iter().find(|it| it.1 == objective).map_or("", |it| it.0);
        // Writing to a string cannot fail.
        let by = by.name();
        let _ = write!(text, "\n[planner]\nobjective = \"{name}\"\nallocator = \"{by}\"\n");
        if let Some(steps) = steps {
            let _ = writeln!(text, "steps = {}", steps.min(i64::MAX as u64));
        }
        let _ = writeln!(text, "policy = \"{}\"", subject.policy().name());
        let fidelity = subject.policy().fidelity;
        if !fidelity.is_line() {
            let _ = writeln!(text, "fidelity = \"{}\"", fidelity.name());
        }
    }
    text.push_str("\n[expected]\n");
    if let Some(source) = subject.source() {
        let _ = writeln!(text, "mission = {}", quoted(source));
    }
    let given = |it: &&Mission| Mission::robot_of(it.text()).is_none();
    if let Some(robot) = subject.mission().filter(given).and_then(|it| it.robot()) {
        let _ = writeln!(text, "robot = {}", quoted(robot.source()));
    }
    let end = ending(run, requirement);
    let _ = writeln!(
        text,
        "seed = 0\nrequirement = {}\noutcome = \"{}\"\ntime_ms = {}\nenergy_mj = {}\nx_mm = {}",
        quoted(&requirement.to_string()),
        end.outcome,
        end.time_ms,
        end.energy_mj,
        end.x_mm
    );
    let more = [
        ("replans", end.replans),
        ("requests", end.requests),
        ("exposed_ms", end.exposed_ms),
        ("broken_ms", end.broken_ms),
    ];
    for (key, value) in more {
        if let Some(value) = value {
            let _ = writeln!(text, "{key} = {value}");
        }
    }
    text
}

impl From<&PlannedBy> for Policy {
    fn from(it: &PlannedBy) -> Self {
        let by = if it.exact { By::Exact } else { By::Panorama };
        Self {
            planner: Some(Planner::chosen(it.objective, Some(by), it.steps.unwrap_or(STEPS))),
            upward: it.policy == Adapts::Upward,
            rigid: it.policy == Adapts::Rigid,
            fidelity: Fidelity::ALL.get(it.fidelity).copied().unwrap_or_default(),
        }
    }
}

/// A failure run again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Again {
    /// The requirement that it is about.
    pub requirement: Requirement,
    /// Whether it is broken again.
    pub breaks: bool,
    /// How the run ended when it was recorded, and how it ends now.
    pub ends: [Ending; 2],
    /// Whether it is the run of a team, which has no path.
    pub of_team: bool,
}

impl Again {
    /// Whether the run ended as it was recorded, in all that is.
    pub fn is_identical(&self) -> bool {
        self.differences().is_empty()
    }

    /// Whether the failure comes back: the requirement is broken again, in the same run.
    pub fn returns(&self) -> bool {
        self.breaks && self.is_identical()
    }

    /// Returns both ends in words: `completed after 30.0 m and 91.652 s`, of a team `some tasks
    /// reported after 91.652 s`.
    pub fn in_words(&self) -> [String; 2] {
        self.ends.each_ref().map(|end| {
            let safe = if self.of_team { "some tasks reported" } else { "stopped safely" };
            let outcome = if end.outcome == Outcome::Safe.name() { safe } else { end.outcome };
            let way = format!("{}.{} m and ", end.x_mm / 1_000, end.x_mm / 100 % 10);
            let way = if self.of_team { "" } else { &way };
            format!("{outcome} after {way}{}.{:03} s", end.time_ms / 1_000, end.time_ms % 1_000)
        })
    }

    /// Returns the differences between the recorded end and the present one: the name, then, and
    /// now.
    pub fn differences(&self) -> Vec<(&'static str, String, String)> {
        let [then, now] = &self.ends;
        let mut found = Vec::new();
        if then.outcome != now.outcome {
            found.push(("outcome", then.outcome.to_owned(), now.outcome.to_owned()));
        }
        let some = Some;
        for (name, then, now) in [
            ("time_ms", some(then.time_ms), some(now.time_ms)),
            ("energy_mj", some(then.energy_mj), some(now.energy_mj)),
            ("x_mm", some(then.x_mm), some(now.x_mm)),
            ("replans", then.replans, now.replans),
            ("requests", then.requests, now.requests),
            ("exposed_ms", then.exposed_ms, now.exposed_ms),
            ("broken_ms", then.broken_ms, now.broken_ms),
        ] {
            if let Some(was) = then.filter(|_| then != now) {
                let is = now.map_or_else(|| "nothing".to_owned(), |it| it.to_string());
                found.push((name, was.to_string(), is));
            }
        }
        found
    }
}

/// Why a file of faults cannot be compared with what it records.
#[derive(Clone, Debug, PartialEq)]
pub enum NotCompared {
    /// The file records no end.
    NothingRecorded,
    /// The broken requirement of the file is no requirement.
    NoRequirement(NoRequirement),
    /// The file has random events, which no recorded failure has.
    Random,
    /// The mission cannot be run so.
    Unready(Unready),
}

impl fmt::Display for NotCompared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingRecorded => f.write_str("no end is recorded to compare with"),
            Self::NoRequirement(error) => error.fmt(f),
            Self::Random => f.write_str("a recorded failure has no random events"),
            Self::Unready(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for NotCompared {}

/// Runs a recorded failure once more, by the planner of the file, and compares.
///
/// # Errors
/// [`NotCompared`] for a file that records no end, or one that is none of this mission's.
///
/// ```
/// use cotama_models::missions::{Mission, embedded, faults::FaultsFile};
/// use cotama_campaign::recorded::again;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let text = "format = 'panorama-faults/1'
/// [expected]
/// requirement = 'time<=500000'
/// outcome = 'completed'
/// time_ms = 527_923
/// energy_mj = 8_563_598
/// x_mm = 187_000";
/// let file = FaultsFile::parse("001.toml", text, &mission).unwrap();
/// assert!(again(&mission, &file).unwrap().returns());
/// let later = text.replace("500000", "527923"); // a requirement that holds
/// let file = FaultsFile::parse("001.toml", &later, &mission).unwrap();
/// let found = again(&mission, &file).unwrap();
/// assert_eq!((found.breaks, found.is_identical(), found.returns()), (false, true, false));
/// ```
pub fn again(mission: &Mission, file: &FaultsFile) -> Result<Again, NotCompared> {
    let expected = file.expected.as_ref().ok_or(NotCompared::NothingRecorded)?;
    let policy = file.planner.as_ref().map_or_else(Policy::default, Policy::from);
    let subject = Subject::new(mission, policy).map_err(NotCompared::Unready)?;
    again_of(&subject, file, expected)
}

/// The same of a mission that is ready, whose supervisors may be the caller's.
///
/// # Errors
/// As [`again`].
pub fn again_of(
    subject: &Subject<'_>,
    file: &FaultsFile,
    expected: &Expected,
) -> Result<Again, NotCompared> {
    if !file.faults.random.is_empty() {
        return Err(NotCompared::Random);
    }
    again_by(subject, &Plan::from(&file.faults), expected)
}

/// The same of a plan, whatever file it is from.
///
/// # Errors
/// As [`again`].
pub fn again_by(
    subject: &Subject<'_>,
    plan: &Plan,
    expected: &Expected,
) -> Result<Again, NotCompared> {
    let requirement: Requirement =
        expected.requirement.parse().map_err(NotCompared::NoRequirement)?;
    let asked = std::slice::from_ref(&requirement);
    let subject = subject.clone().watching(asked).map_err(NotCompared::Unready)?;
    let run = subject.run(plan);
    let breaks = !requirement.holds(&run);
    let ends = [expected.end.clone(), ending(&run, &requirement)];
    Ok(Again { requirement, breaks, ends, of_team: subject.is_team() })
}
