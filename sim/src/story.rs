//! The story of a supervised run, from its trace: numbered points, each with what was found,
//! decided and done.
//!
//! Points are numbered as in the published run (Durand et al., TAROS 2010, Section VI): the start,
//! each failure, and what the operator does before the robot goes on alone. What he does until the
//! goal belongs to the failure he was asked about.

mod rung;

use crate::trace::supervised::{Autonomy, Configured, Decision, Diagnosis, Failure, Fired, Told};
use crate::trace::{Plan, Record};
use cotama_models::severity::Class;
pub use rung::Rung;
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
    /// The operator, who had been asked, did this: the name of an event, as `choose_Manual`.
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
    /// The mask that was made first, or is on the operator's order, if any.
    pub mask: Option<&'t Fired>,
    /// When the operator was asked about it, in µs.
    pub asked_us: Option<u64>,
    /// Words of the operator, if the robot did not go on alone after it.
    pub operator: Vec<&'t Told>,
    /// When what is left was planned again for it, in µs; `None` if it was not.
    pub planned_us: Option<u64>,
    /// For how long the robot moved without a module that it required, in ms.
    pub exposed_ms: u64,
}

/// The points of a trace, in the order of time; none if it is not of a supervised run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::story::points;
/// use cotama_sim::trace::Trace;
/// let delivery = embedded::mission("delivery").unwrap();
/// let options = Options::default();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let (trace, _) = Trace::record(&mission, &options).unwrap();
/// let points = points(&trace.records);
/// assert_eq!(points.len(), 7);
/// assert_eq!(points[1].title(), "RT1: MCL, deadline missed again and again");
/// let done = points[1].done().unwrap();
/// assert!(done.ends_with("the same modules run on, with MCL.particles 200"), "{done}");
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
            Record::Told(it) if it.event.starts_with("operator.") => self.said.push(it),
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
            }
            Record::Plan(it) => self.planned(it),
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
                if it.net == "ls" && it.place == "Waits" {
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
                if it.masks.is_some()
                    && let Some(chain) = it.cause.and_then(|it| self.chain(it))
                {
                    chain.mask.get_or_insert(it);
                }
                let acts = !["gom", "cs", "permit"].contains(&it.net.as_str());
                if let Some(chain) = it.cause.filter(|_| acts).and_then(|it| self.chain(it))
                    && chain.reaction.first().is_none_or(|first| first.t_us == it.t_us)
                {
                    chain.reaction.push(it);
                }
            }
            Record::Configuration(it) => {
                match (&it.configuration, it.mode) {
                    (Some(_), Autonomy::Autonomous) => self.alone_again(),
                    (None, Autonomy::Autonomous) => self.belongs(),
                    _ => {}
                }
                self.configurations.push(it);
            }
            _ => {}
        }
    }

    /// A plan belongs to the last failure that its cause names, as `no scan (LID1)`.
    fn planned(&mut self, plan: &Plan) {
        let Some(id) = plan.cause.rsplit_once('(').and_then(|it| it.1.strip_suffix(')')) else {
            return;
        };
        let chains = self.points.iter_mut().rev().filter_map(|it| match &mut it.what {
            What::Failure(chain) => Some(chain),
            _ => None,
        });
        let names = |it: &&mut Box<Chain<'_>>| {
            let taken = it.diagnosis.is_some_and(|it| it.candidates.iter().any(|it| it == id));
            it.failure.mode == id || taken
        };
        if let Some(chain) = { chains }.find(names) {
            chain.planned_us.get_or_insert(plan.t_us);
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

    /// The robot goes on alone after what the operator did: each thing that he chose is a point,
    /// the last one until he was done with it.
    fn alone_again(&mut self) {
        let said = std::mem::take(&mut self.said);
        let Some((last, chosen)) = said.split_last() else { return };
        let Some((edits, before)) = chosen.split_last() else { return };
        for it in before {
            self.point(it.t_us, it.x_mm, Some(it.t_us), What::Operator(answer(it)));
        }
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
            mask: None,
            asked_us: None,
            operator: Vec::new(),
            planned_us: None,
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
                match &chain.failure.what {
                    Some(what) => format!("{mode}: {what}"),
                    None => mode.clone(),
                }
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
            all if !all.contains(&chain.failure.mode) => format!("taken for {}", all.join(", ")),
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
            Class::Adapter => "the adapter takes another set of modules",
            Class::Local => "the operator is asked",
            Class::Global => "the mission is ended safely",
            Class::Record => "it is recorded only",
        };
        let by = decision.transition.as_ref().map_or_else(String::new, |it| format!(" ({it})"));
        // Names of its lines say whether a row asks first.
        let first = decision.transition.as_ref().is_some_and(|it| it.starts_with("ask_"));
        let why = chain.diagnosis.map_or_else(String::new, |it| {
            if first {
                return format!("{}, but its row asks first, so ", it.severity.name());
            }
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
            (None, Autonomy::HandOver) => "it stops and asks".into(),
            (None, _) => "nothing runs any more".into(),
        });
        let Some(chain) = self.chain() else { return runs };
        let first = chain.reaction.first().copied().or(chain.set).or(chain.mask)?;
        let by: Vec<_> = match &chain.reaction[..] {
            [] => vec![first.line()],
            all => all.iter().map(|it| it.line()).collect(),
        };
        let runs = runs.unwrap_or_else(|| "the same modules run on".into());
        let set = chain.set.and_then(|it| it.sets.as_deref());
        let set = set.map_or_else(String::new, |it| format!(", with {it}"));
        let mask = chain.mask.and_then(|it| it.masks.as_deref());
        let mask = mask.map_or_else(String::new, |it| format!("; {it}"));
        let again = if chain.planned_us.is_some() { "; the rest is planned again" } else { "" };
        let later = chain.asked_us.filter(|&it| it > first.t_us);
        let asked =
            later.map_or_else(String::new, |it| format!("; it asks after {}", self.since(it)));
        let said: Vec<_> = chain.operator.iter().map(|it| said(answer(it))).collect();
        let said: String = said.iter().flat_map(|it| ["; ", it.as_str()]).collect();
        Some(format!(
            "after {}, {}: {runs}{set}{mask}{again}{asked}{said}",
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
            Some("global_event") => vec![Rung::Mission],
            Some("local_event") => vec![Rung::Activity],
            Some(_) => vec![Rung::Set],
            None => vec![],
        };
        if chain.set.is_some() {
            rungs.push(Rung::Parameter);
        }
        if chain.planned_us.is_some() {
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
    let (chosen, done) = (answer.strip_prefix("choose_"), answer.strip_prefix("finish_"));
    match (chosen, done) {
        (Some(it), _) => format!("the operator chooses {it}"),
        (_, Some(it)) => format!("the operator is done with {it}"),
        _ if answer == "gives_up" => "the operator gives up, or is silent".to_owned(),
        _ => answer.to_owned(),
    }
}
