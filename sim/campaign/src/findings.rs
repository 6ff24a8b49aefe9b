//! Failing runs made small and put together by their cause.

use crate::observed::Observed;
use crate::plan::{Fault, Plan};
use crate::recorded;
use crate::requirement::Requirement;
use crate::results::Tally;
use crate::shrink::shrink;
use crate::subject::Subject;
use cotama_models::missions::faults::EventKind;
use cotama_sim::run::Outcome;
use std::fmt::Write;

/// Failing runs with one cause: their shrunk plans have the same faults.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cluster {
    /// The requirement that they break.
    pub requirement: Requirement,
    /// The faults of the cause.
    pub signature: String,
    /// The runs, of those that were shrunk.
    pub runs: Vec<u64>,
    /// The smallest plan of any of them: the fewest faults, then the shortest text.
    pub plan: Plan,
    /// The scenario: a commented `panorama-faults/1` file, with who plans and how the run ends.
    pub scenario: String,
    /// The file that it was written to, if it was.
    pub file: Option<String>,
}

/// Failing runs by their causes.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::findings::Findings;
/// use cotama_campaign::results::Tally;
/// use cotama_campaign::run::{Campaign, Settings};
/// use cotama_campaign::subject::{Policy, Subject};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let requirements = ["requests<=1".parse().unwrap()].into();
/// let settings = Settings { runs: 40, requirements, ..Settings::new(true) };
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// let campaign = Campaign::new(subject, settings).unwrap();
/// let mut tally = Tally::default();
/// for line in campaign.block(0) {
///     tally.add(&line, &serde_json::to_string(&line).unwrap());
/// }
/// let found = Findings::of(&campaign.subject, &campaign.settings.requirements, &tally, 1);
/// assert_eq!(found.clusters.len(), 1);
/// assert!(found.clusters[0].scenario.starts_with("# Breaks `requests<=1`"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    /// The most frequent first.
    pub clusters: Vec<Cluster>,
    /// How many failing runs were shrunk.
    pub shrunk: u64,
    /// How many runs that took, and the most that one took.
    pub cost: (u64, u64),
}

impl Findings {
    /// Shrinks at most so many kept runs of each requirement.
    pub fn of(
        subject: &Subject<'_>,
        requirements: &[Requirement],
        kept: &Tally,
        most: usize,
    ) -> Self {
        let mut found = Self::default();
        for requirement in requirements {
            let lines = kept.kept.get(&requirement.to_string()).map_or(&[][..], Vec::as_slice);
            for line in lines.iter().take(most) {
                let Some(text) = &line.plan else { continue };
                let Some(plan) = subject.plan(text) else { continue };
                let shrunk = shrink(subject, requirement, &plan);
                found.shrunk += 1;
                found.cost = (found.cost.0 + shrunk.runs, found.cost.1.max(shrunk.runs));
                found.put(requirement, line.run, plan.faults.len(), shrunk.plan, subject);
            }
        }
        found.clusters.sort_by(|a, b| {
            let key = |it: &Cluster| (std::cmp::Reverse(it.runs.len()), it.runs[0]);
            a.requirement.cmp(&b.requirement).then(key(a).cmp(&key(b)))
        });
        found
    }

    fn put(
        &mut self,
        what: &Requirement,
        run: u64,
        from: usize,
        plan: Plan,
        subject: &Subject<'_>,
    ) {
        let signature = subject.signature(&plan);
        let size = |plan: &Plan| (plan.faults.len(), subject.text(plan).len());
        let scenario = |plan: &Plan| scenario(plan, what, subject, run, from);
        let same = |it: &&mut Cluster| it.requirement == *what && it.signature == signature;
        if let Some(cluster) = self.clusters.iter_mut().find(same) {
            cluster.runs.push(run);
            if size(&plan) < size(&cluster.plan) {
                (cluster.scenario, cluster.plan) = (scenario(&plan), plan);
            }
            return;
        }
        let (scenario, requirement) = (scenario(&plan), what.clone());
        self.clusters.push(Cluster {
            requirement,
            signature,
            runs: vec![run],
            plan,
            scenario,
            file: None,
        });
    }
}

/// A plan as a commented scenario: what it breaks, what happened, and the faults, a line each.
pub fn scenario(
    plan: &Plan,
    requirement: &Requirement,
    subject: &Subject<'_>,
    run: u64,
    from: usize,
) -> String {
    // A requirement broken beside this one ends no run: the file is held against this alone.
    let alone = subject.clone().watching(std::slice::from_ref(requirement));
    let alone = alone.as_ref().unwrap_or(subject);
    let observed = alone.run(plan);
    let mut text = comment(&format!("Breaks `{requirement}`: {}.", subject.meaning(requirement)));
    let fault = |count: usize| if count == 1 { "fault" } else { "faults" };
    let count = plan.faults.len();
    let _ = writeln!(text, "# Run {run}, {from} {}, made small: {count}.", fault(from));
    story(subject, plan, &observed).iter().for_each(|it| {
        text.push_str(&comment(&format!("- {it}")));
    });
    text + &subject.text(plan) + &recorded::tables(subject, requirement, &observed)
}

/// A text as lines of a comment, of at most 100 characters as far as its words allow.
fn comment(text: &str) -> String {
    let (mut lines, mut line) = (String::new(), "#".to_owned());
    for word in text.split(' ') {
        if line.chars().count() + 1 + word.chars().count() > 100 {
            lines = lines + &line + "\n";
            "#  ".clone_into(&mut line);
        }
        line = line + " " + word;
    }
    lines + &line + "\n"
}

/// Returns the story of the run, in a few sentences.
fn story(subject: &Subject<'_>, plan: &Plan, run: &Observed) -> Vec<String> {
    let mut lines = Vec::new();
    for fault in &plan.faults {
        if let Fault::Failure(it) = fault {
            let met = run.met.iter().find(|met| met.0 == it.failure);
            let during = met.map_or_else(
                || "it never comes to that".to_owned(),
                |met| format!("met in {}", met.1),
            );
            lines.push(format!("{} ({during})", subject.story_of_failure(it)));
        } else if let Fault::Event(it) = fault {
            let what = subject.signature(&Plan { faults: vec![fault.clone()] });
            let size = match it.kind {
                EventKind::Obstacle { delay } => format!(" of {} ms", delay.0),
                EventKind::Odometry { extra } => format!(" of {} mm", extra.0),
                _ => String::new(),
            };
            lines.push(format!("at {}.{} m, {what}{size}", it.x.0 / 1_000, it.x.0 / 100 % 10));
        } else if let Fault::Team(it) = fault {
            lines.push(subject.story_of(it));
        } else if let Fault::Power(it) = fault {
            let what = subject.signature(&Plan { faults: vec![fault.clone()] });
            lines.push(format!("{what} differs by {} ‰", it.permille));
        }
    }
    if let Some(it) = &run.witness {
        lines.push(format!(
            "at {}.{:03} s `{}` is broken; last there was {}",
            it.at_ms / 1_000,
            it.at_ms % 1_000,
            it.requirement,
            it.seen.join(", ")
        ));
    }
    let metres = |mm: u64| format!("{}.{} m", mm / 1_000, mm / 100 % 10);
    let seconds = |ms: u64| format!("{}.{:03} s", ms / 1_000, ms % 1_000);
    let (outcome, time) = (run.outcome.name(), seconds(run.time_ms));
    let mut end = match (subject.is_team(), run.outcome) {
        (true, Outcome::Safe) => format!("the last task is done or reported after {time}"),
        (true, _) => format!("the run is {outcome} after {time}"),
        (false, _) => format!("the run is {outcome} after {time} and {}", metres(run.x_mm)),
    };
    if run.exposed_ms > 0 {
        let _ = write!(end, "; it moved {} without a required module", seconds(run.exposed_ms));
    }
    if run.requests > 0 {
        let _ = write!(end, "; requests to the operator: {}", run.requests);
    }
    if run.replans > 0 {
        let what = if subject.is_team() { "tasks put up again" } else { "plans made again" };
        let _ = write!(end, "; {what}: {}", run.replans);
    }
    lines.push(end);
    lines
}
