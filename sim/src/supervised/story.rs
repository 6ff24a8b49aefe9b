//! The story of a supervised run, from its trace: numbered points, each with what was found,
//! decided and done.
//!
//! Points are numbered as in the published run (Durand et al., TAROS 2010, Section VI): the start,
//! each failure, and what the operator does before the robot goes on alone. What he does until the
//! goal belongs to the failure he was asked about.

pub use super::rung::Rung;
use crate::trace::Record;
use crate::trace::supervised::{Configured, Decision, Diagnosis, Failure, Fired, Told};
use cotama_models::cotama::{Class, FailureMode, Mode};
use std::collections::HashMap;

/// A point of the story.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point<'t> {
    /// From 1.
    pub number: usize,
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The event.
    pub what: What<'t>,
    /// When the operator, or who gave the mission, had acted, in µs; none for a failure.
    pub acted_us: Option<u64>,
    /// The configuration that ran from then on; none if it stayed.
    pub configured: Option<&'t Configured>,
}

/// The event at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum What<'t> {
    /// The mission was received, or the object, with the name of that event: where the drive
    /// begins on which something happens first.
    Start(&'t str),
    /// Something failed.
    Failure(Box<Chain<'t>>),
    /// The operator, who had been asked, did this; the last answer is the event's name, as
    /// `new_path`.
    Operator(&'t str),
}

/// From a failure to the reaction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain<'t> {
    /// The failure.
    pub failure: &'t Failure,
    /// The diagnosis; `None` if nobody noticed the failure.
    pub diagnosis: Option<&'t Diagnosis>,
    /// The decision.
    pub decision: Option<&'t Decision>,
    /// The transitions of the supervisors that acted first, all of one round.
    pub reaction: Vec<&'t Fired>,
    /// The setting that was made first, if any.
    pub set: Option<&'t Fired>,
    /// When the operator was asked about it, in µs.
    pub asked_us: Option<u64>,
    /// Words of the operator, if the robot did not go on alone after it.
    pub operator: Vec<&'t Told>,
    /// Whether what is left was planned again.
    pub planned_again: bool,
    /// For how long the robot moved without a module that it required, in ms.
    pub exposed_ms: u64,
}

/// The points of a trace, in the order of time; none if it is not of a supervised run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::supervised::story::points;
/// use cotama_sim::trace::Trace;
/// let delivery = embedded::mission("delivery").unwrap();
/// let options = Options::default();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let (trace, _) = Trace::record(&mission, &options).unwrap();
/// let points = points(&trace.records);
/// assert_eq!(points.len(), 7);
/// assert_eq!(points[1].title(), "RT1: MCL, deadline missed again and again");
/// assert_eq!(
///     points[1].decided().unwrap(),
///     "after 0.4 s: medium, so the adapter takes fewer particles (slow1)"
/// );
/// ```
pub fn points(records: &[Record]) -> Vec<Point<'_>> {
    let mut story = Story::default();
    for record in records {
        story.hear(record);
    }
    story.belongs();
    let quiet = story.points.is_empty();
    if let Some(it) = if quiet { story.starts.first() } else { story.starts.last() }.copied() {
        story.point(it.t_us, it.x_mm, Some(it.t_us), What::Start(&it.event));
    }
    let Story { mut points, configurations, .. } = story;
    for point in &mut points {
        // A path is planned first where the robot starts, or was given way-points.
        let (from, within) = match &point.what {
            What::Failure(chain) => (chain.reaction.first().map(|it| it.t_us), 1),
            _ => (point.acted_us, 3_000_000),
        };
        let Some(from) = from else { continue };
        let end = configurations.partition_point(|it| it.t_us < from.saturating_add(within));
        point.configured = configurations[..end].last().copied().filter(|it| it.t_us >= from);
    }
    points.sort_by_key(|it| it.t_us);
    points.iter_mut().zip(1..).for_each(|(it, number)| it.number = number);
    points
}

/// Events that begin a drive.
const STARTS: [&str; 2] = ["gs.mission_received", "gs.object_received"];

/// A story while it is heard.
#[derive(Default)]
struct Story<'t> {
    /// Events that began before anything happened.
    starts: Vec<&'t Told>,
    points: Vec<Point<'t>>,
    configurations: Vec<&'t Configured>,
    /// The place in `points` of each failure.
    failures: HashMap<u16, usize>,
    /// The failures of the last diagnosis.
    diagnosed: Vec<u16>,
    diagnosed_us: u64,
    /// Words of the operator since he was asked, and the failure asked about.
    said: Vec<&'t Told>,
    asked: Option<u16>,
}

impl<'t> Story<'t> {
    fn hear(&mut self, record: &'t Record) {
        match record {
            Record::Told(it) if STARTS.contains(&it.event.as_str()) && self.points.is_empty() => {
                self.starts.push(it);
            }
            Record::Told(it) if it.event.starts_with("operator.") => {
                self.said.push(it);
                if matches!(answer(it), "new_path" | "waypoints") {
                    self.alone_again();
                }
            }
            Record::Failure(it) => {
                self.failures.insert(it.failure, self.points.len());
                self.point(it.t_us, it.x_mm, None, What::Failure(Box::new(Chain::new(it))));
            }
            Record::Diagnosis(it) => {
                for &failure in &it.failures {
                    if let Some(chain) = self.chain(failure) {
                        chain.diagnosis = Some(it);
                    }
                }
                (self.diagnosed, self.diagnosed_us) = (it.failures.clone(), it.t_us);
            }
            Record::Plan(it) if it.t_us == self.diagnosed_us => {
                for failure in std::mem::take(&mut self.diagnosed) {
                    if let Some(chain) = self.chain(failure) {
                        chain.planned_again = true;
                    }
                }
            }
            Record::Decision(it) => {
                if let Some(chain) = self.chain(it.failure) {
                    chain.decision = Some(it);
                }
            }
            Record::Exposure(it) => {
                if let Some(chain) = self.chain(it.failure) {
                    chain.exposed_ms = it.exposed_ms;
                }
            }
            Record::Fired(it) => {
                if it.place == "HandOver" || it.net == "ls" && it.place == "Waits" {
                    self.belongs();
                    self.asked = it.cause;
                    if let Some(chain) = it.cause.and_then(|it| self.chain(it)) {
                        chain.asked_us = Some(it.t_us);
                    }
                }
                if it.sets.is_some()
                    && let Some(chain) = it.cause.and_then(|it| self.chain(it))
                {
                    chain.set.get_or_insert(it);
                }
                let acts = !["gom", "cs", "permit"].contains(&it.net.as_str());
                if let Some(chain) = it.cause.filter(|_| acts).and_then(|it| self.chain(it))
                    && chain.reaction.first().is_none_or(|first| first.t_us == it.t_us)
                {
                    chain.reaction.push(it);
                }
            }
            Record::Configuration(it) => self.configurations.push(it),
            _ => {}
        }
    }

    fn point(&mut self, t_us: u64, x_mm: u64, acted_us: Option<u64>, what: What<'t>) {
        self.points.push(Point { number: 0, t_us, x_mm, what, acted_us, configured: None });
    }

    fn chain(&mut self, failure: u16) -> Option<&mut Chain<'t>> {
        match &mut self.points.get_mut(*self.failures.get(&failure)?)?.what {
            What::Failure(chain) => Some(chain),
            _ => None,
        }
    }

    /// Assigns the words of the operator to the failure that he was asked about.
    fn belongs(&mut self) {
        let said = std::mem::take(&mut self.said);
        if let Some(chain) = self.asked.and_then(|it| self.chain(it)) {
            chain.operator.extend(said);
        }
    }

    /// The robot goes on alone after what the operator did: driving is a point, and so is the path
    /// or the way-points he gave, from when he began to edit.
    fn alone_again(&mut self) {
        let said = std::mem::take(&mut self.said);
        let Some(last) = said.last() else { return };
        if let Some(it) = said.iter().find(|it| answer(it) == "teleoperate") {
            self.point(it.t_us, it.x_mm, Some(it.t_us), What::Operator(answer(it)));
        }
        let edits = said.iter().find(|it| answer(it) == "teleprogram").unwrap_or(last);
        self.point(edits.t_us, edits.x_mm, Some(last.t_us), What::Operator(answer(last)));
    }
}

impl<'t> Chain<'t> {
    const fn new(failure: &'t Failure) -> Self {
        Self {
            failure,
            diagnosis: None,
            decision: None,
            reaction: Vec::new(),
            set: None,
            asked_us: None,
            operator: Vec::new(),
            planned_again: false,
            exposed_ms: 0,
        }
    }
}

impl Point<'_> {
    /// Returns the event, in words.
    pub fn title(&self) -> String {
        match &self.what {
            What::Start(event) => {
                let received = if *event == STARTS[0] { "mission" } else { "object" };
                format!("the {received} is received")
            }
            What::Failure(chain) => {
                let mode = &chain.failure.mode;
                if let Some(what) = &chain.failure.what {
                    return format!("{mode}: {what}");
                }
                FailureMode::named(mode).map_or_else(
                    || mode.clone(),
                    |it| {
                        format!(
                            "{mode}: {}, {}",
                            it.description().component,
                            it.description().failure
                        )
                    },
                )
            }
            What::Operator(answer) => said(answer),
        }
    }

    /// Returns the finding of the observers; `None` but for failures.
    pub fn found(&self) -> Option<String> {
        let chain = self.chain()?;
        let Some(it) = chain.diagnosis else { return Some("nobody noticed it".into()) };
        let taken = match &it.candidates[..] {
            [] => "unexplained".into(),
            [one] => format!("it is {one}"),
            several => format!("one of {}, not unique", several.join(", ")),
        };
        let flags = match &it.flags[..] {
            [] => String::new(),
            all => format!(", {}", all.join(" and ")),
        };
        Some(format!("after {}{flags}: {taken}", self.since(it.t_us)))
    }

    /// Returns the decision, with its reason; `None` but for failures on which something was
    /// decided.
    pub fn decided(&self) -> Option<String> {
        let chain = self.chain()?;
        let decision = chain.decision?;
        let what = match decision.decision {
            Class::Adapter => match decision.event.as_deref() {
                Some("adapt_rt") => "the adapter takes fewer particles",
                Some("adapt_mcl") => "the adapter takes odometry",
                Some("adapt_bump") => "the adapter slows down",
                Some("adapt_smz") => "the adapter takes the other avoidance",
                Some("adapt_avoidance") => "the adapter does without avoidance",
                Some("adapt_minor" | "adapt_minor_teleoperation") => {
                    "the adapter changes a setting"
                }
                Some("adapt_sonar") => "the adapter does without sonars",
                _ => "the adapter takes another set of modules",
            },
            Class::Local => "the operator is asked",
            Class::Global => "the mission is ended safely",
            Class::Record => "it is recorded only",
        };
        let by = decision.transition.as_ref().map_or_else(String::new, |it| format!(" ({it})"));
        let why = chain.diagnosis.map_or_else(String::new, |it| {
            let left = match it.by_availability {
                Class::Adapter => ", and another set of modules is left",
                Class::Local => ", and only another autonomy mode is left",
                Class::Global => ", and no autonomy mode is left",
                Class::Record => "",
            };
            format!("{}{left}, so ", it.severity.name())
        });
        Some(format!("after {}: {why}{what}{by}", self.since(decision.t_us)))
    }

    /// Returns the reaction of the robot.
    pub fn done(&self) -> Option<String> {
        let runs = self.configured.map(|it| match (&it.configuration, it.mode) {
            (Some(configuration), mode) => format!("{configuration} runs, {}", mode.name()),
            (None, Mode::HandOver) => "it stops and asks".into(),
            (None, _) => "nothing runs any more".into(),
        });
        let Some(chain) = self.chain() else { return runs };
        let first = chain.reaction.first().copied().or(chain.set)?;
        let by: Vec<_> = match &chain.reaction[..] {
            [] => vec![first.line()],
            all => all.iter().map(|it| it.line()).collect(),
        };
        let runs = runs.unwrap_or_else(|| "the same modules run on".into());
        let set = chain.set.and_then(|it| it.sets.as_deref());
        let set = set.map_or_else(String::new, |it| format!(", with {it}"));
        let again = if chain.planned_again { "; the rest is planned again" } else { "" };
        let later = chain.asked_us.filter(|&it| it > first.t_us);
        let asked =
            later.map_or_else(String::new, |it| format!("; it asks after {}", self.since(it)));
        let said: Vec<_> = chain.operator.iter().map(|it| said(answer(it))).collect();
        let said: String = said.iter().flat_map(|it| ["; ", it.as_str()]).collect();
        Some(format!(
            "after {}, {}: {runs}{set}{again}{asked}{said}",
            self.since(first.t_us),
            by.join(" ")
        ))
    }

    /// The rungs of the ladder that were taken, the lowest first.
    pub fn rungs(&self) -> Vec<Rung> {
        let Some(chain) = self.chain() else {
            return if matches!(self.what, What::Operator(_)) {
                vec![Rung::Activity]
            } else {
                vec![]
            };
        };
        let event = chain.decision.and_then(|it| it.event.as_deref());
        let mut rungs = match event {
            Some("adapt_rt" | "adapt_bump" | "adapt_minor" | "adapt_minor_teleoperation") => {
                vec![Rung::Parameter]
            }
            Some("global_event") => vec![Rung::Mission],
            Some("local_event") => vec![Rung::Activity],
            Some(_) => vec![Rung::Set],
            None => vec![],
        };
        if chain.set.is_some() {
            rungs.push(Rung::Parameter);
        }
        if chain.planned_again {
            rungs.push(Rung::Objective);
        }
        if chain.asked_us.is_some() {
            rungs.push(Rung::Activity);
        }
        rungs.sort_unstable();
        rungs.dedup();
        rungs
    }

    /// From the failure to the reaction, if it is one.
    pub fn chain(&self) -> Option<&Chain<'_>> {
        match &self.what {
            What::Failure(chain) => Some(chain),
            _ => None,
        }
    }

    /// A time since the point, in seconds.
    fn since(&self, t_us: u64) -> String {
        let tenths = t_us.saturating_sub(self.t_us) / 100_000;
        format!("{}.{} s", tenths / 10, tenths % 10)
    }
}

/// Returns the answer of the operator.
fn answer(told: &Told) -> &str {
    told.event.strip_prefix("operator.").unwrap_or(&told.event)
}

/// Returns the action of the operator, in words.
fn said(answer: &str) -> String {
    let known = match answer {
        "teleoperate" => "the operator drives",
        "teleprogram" => "the operator edits the path",
        "waypoints" => "the operator gives way-points",
        "new_path" => "the operator gives a path",
        "arrived" => "the operator has reached the goal",
        "gives_up" => "the operator gives up, or is silent",
        other => {
            let (chosen, done) = (other.strip_prefix("choose_"), other.strip_prefix("finish_"));
            return match (chosen, done) {
                (Some(it), _) => format!("the operator chooses {it}"),
                (_, Some(it)) => format!("the operator is done with {it}"),
                _ => other.to_owned(),
            };
        }
    };
    known.to_owned()
}
