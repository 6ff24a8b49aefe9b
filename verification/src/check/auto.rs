//! Which engine is asked what, and how their findings become an answer.

use super::budget::Budget;
use super::engine::{Engine, Extent, Finding, Found, Reason, Task};
use super::engines::{Coverability, Explicit, Structural, Stubborn, Temporal, growth};
use super::known::Known;
use super::reduced::Smaller;
use super::{Answer, Choice, Options, Verdict};
use crate::certificate::{Evidence, One, most_markings};
use crate::diagnosis::shrink;
use crate::explicit::{Goal, Limit, Limits};
use crate::property::{Condition, Ctl, Formula, Question, Reachability};
use crate::reductions::LiftError;
use crate::structural::Structure;
use crate::temporal::{Rest, Run};
use cotama_core::net::TransitionId;
use std::cell::RefMut;
use std::time::{Duration, Instant};

/// Markings that are few enough to be met before anything cleverer is tried.
const FEW: u64 = 600_000;

/// Markings of a net whose graph is evidence: those that the small checker passes through in less
/// than a minute.
pub(super) const CERTIFIED: u64 = 500_000;

/// The longest way of which it is tried to leave firings out.
const SHRUNK: usize = 500;

/// Markings of a net that is looked at once more for a run.
const SHOWN: u64 = 20_000;

/// Markings of a first look.
const GLANCE: u64 = 1_000;

pub(super) fn answer(net: &Known<'_>, question: &Question, options: &Options<'_>) -> Answer {
    let budget = Budget::from(options);
    let mut asked = Asked {
        net,
        engine: options.engine,
        budget,
        techniques: Vec::new(),
        tried: Vec::new(),
        states: 0,
    };
    let (verdict, run, mut evidence) = asked.question(question);
    if evidence == Evidence::None && budget.evidence && !matches!(verdict, Verdict::Unknown(_)) {
        evidence = asked.all_markings(question, &verdict);
    }
    let is_known = !matches!(verdict, Verdict::Unknown(_));
    let techniques = if is_known { asked.techniques } else { asked.tried };
    Answer { verdict, run, schedule: None, evidence, techniques, states: asked.states }
}

/// A verdict with a run and evidence.
pub(super) type Shown = (Verdict, Option<Run>, Evidence);

/// A question that is being answered.
pub(super) struct Asked<'a, 'n> {
    pub(super) net: &'a Known<'n>,
    pub(super) engine: Choice,
    pub(super) budget: Budget<'a>,
    techniques: Vec<&'static str>,
    /// Engines that were asked, also in vain.
    tried: Vec<&'static str>,
    states: u64,
}

impl<'a, 'n> Asked<'a, 'n> {
    fn question(&mut self, question: &Question) -> Shown {
        match question {
            Question::Formula(formula) => self.formula(&formula.simplified()),
            Question::Fair(formula, assumed) => {
                let task = Task::Fair(formula, assumed);
                match self.ask(&Temporal, self.net, task, self.budget.limits).found {
                    Found::Holds(holds, run, evidence) => (Verdict::Holds(holds), run, evidence),
                    Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
                    _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
                }
            }
            Question::Bound(places) => self.bound(places),
            Question::OneSafe => self.one_safe(),
            Question::QuasiLiveness => self.dead(|_, dead| dead.is_empty()),
            Question::StableMarking => self.dead(|net, dead| {
                let never = |it: u32| dead.binary_search(&TransitionId(it)).is_ok();
                let changers = |place| net.pt().changers.of(place).iter();
                (0..net.pt().places.len() as u32).any(|place| changers(place).all(|it| never(it.0)))
            }),
            Question::Liveness => self.live(),
            Question::Response { .. } => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }

    /// That all markings were looked at, if they are few enough for the small checker, and if it
    /// knows such questions.
    fn all_markings(&self, question: &Question, verdict: &Verdict) -> Evidence {
        if let (Question::Bound(places), Verdict::Bound(Extent::Infinite)) = (question, verdict) {
            return growth(self.net.pt(), places, &self.budget).unwrap_or(Evidence::None);
        }
        let known = match question {
            Question::Formula(formula) => Ctl::new(&formula.simplified()).is_some(),
            Question::Fair(..) | Question::Response { .. } => false,
            _ => true,
        };
        if !known {
            return Evidence::None;
        }
        if let Some(graph) = self.net.made() {
            return self.shown_by(&graph);
        }
        let few = CERTIFIED.min(most_markings(self.net.pt().places.len()));
        let states = self.budget.limits.states.min(few);
        let few = Budget { limits: Limits { states, ..self.budget.limits }, ..self.budget };
        self.net.graph(&few).map_or(Evidence::None, |it| Evidence::graph(&it))
    }

    /// The structure of the net, within half of what is left: others may be asked afterwards.
    pub(super) fn structure(&self) -> Option<RefMut<'a, Structure<'n>>> {
        let limits = half(self.budget.limits);
        let bytes = limits.bytes.saturating_sub(self.net.bytes());
        let limits = Limits { bytes, ..limits };
        self.net.structure(&Budget { limits, ..self.budget })
    }

    fn formula(&mut self, formula: &Formula) -> Shown {
        if let Some(condition) = Condition::new(formula, self.net.pt()) {
            self.used("initial");
            let holds = condition.holds(self.net.pt().initial.as_slice());
            return (Verdict::Holds(holds), None, Evidence::State);
        }
        if let Some(asked) = Reachability::new(formula) {
            return self.reachability(&asked);
        }
        match formula {
            Formula::Not(inner) => match self.formula(inner) {
                (Verdict::Holds(holds), run, evidence) => (Verdict::Holds(!holds), run, evidence),
                unknown => unknown,
            },
            Formula::And(parts) => self.parts(parts, false),
            Formula::Or(parts) => self.parts(parts, true),
            _ => self.temporal(formula),
        }
    }

    /// Parts one of which decides if it is `decisive`; those that ask for one marking come first.
    fn parts(&mut self, parts: &[Formula], decisive: bool) -> Shown {
        let mut order: Vec<usize> = (0..parts.len()).collect();
        order.sort_by_key(|&it| Reachability::new(&parts[it]).is_none());
        let (mut open, mut each) = (None, vec![Evidence::None; parts.len()]);
        for part in order {
            match self.formula(&parts[part]) {
                (Verdict::Holds(holds), run, evidence) if holds == decisive => {
                    return (Verdict::Holds(decisive), run, one(evidence, part));
                }
                (Verdict::Unknown(reason), ..) => open = open.or(Some(reason)),
                (.., evidence) => each[part] = evidence,
            }
        }
        match open {
            Some(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            None => (Verdict::Holds(!decisive), None, each_of(each)),
        }
    }

    pub(super) fn reachability(&mut self, asked: &Reachability) -> Shown {
        match self.reach(&asked.goal).found {
            Found::Way(way) => {
                let way = self.shortened(&asked.goal, way);
                let fire: Vec<u32> = way.iter().map(|it| it.0).collect();
                let evidence = Evidence::trace(self.net.pt(), &fire);
                (Verdict::Holds(asked.expected), Some(Run { stem: way, rest: Rest::Any }), evidence)
            }
            Found::Reached => (Verdict::Holds(asked.expected), None, Evidence::None),
            Found::Never(evidence) => (Verdict::Holds(!asked.expected), None, evidence),
            Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }

    /// A shortest way, if the net is small; otherwise one without firings that are not needed.
    fn shortened(&self, goal: &Formula, way: Vec<TransitionId>) -> Vec<TransitionId> {
        let pt = self.net.pt();
        if let Some(graph) = self.net.made() {
            let first = Goal::new(goal).and_then(|it| graph.first(it));
            return first.map_or(way, |it| graph.way(it));
        }
        let limits = Limits { states: self.budget.limits.states.min(SHOWN), ..self.budget.limits };
        let found =
            Explicit.find(self.net, Task::Reach(goal), &Budget { limits, ..self.budget }).found;
        match (found, Condition::new(goal, pt)) {
            (Found::Way(shortest), _) => shortest,
            (_, Some(condition)) if way.len() <= SHRUNK => {
                shrink(pt, &way, |it| condition.holds(it))
            }
            _ => way,
        }
    }

    /// Looks for a marking: by the structure, on a smaller net, among few markings, with few
    /// firings in each, among all.
    pub(super) fn reach(&mut self, goal: &Formula) -> Finding {
        let task = Task::Reach(goal);
        if self.engine != Choice::Auto {
            return self.chosen(task);
        }
        let limits = self.budget.limits;
        if self.net.made().is_none() {
            // A way that a glance finds; that there is none is shown better by others.
            let limits = Limits { states: GLANCE, ..limits };
            let first = Stubborn.find(self.net, task, &Budget { limits, ..self.budget });
            self.states = self.states.max(first.states);
            if matches!(first.found, Found::Way(_)) {
                self.used(Stubborn.name());
                return first;
            }
        }
        if !self.is_seen_sooner(goal) {
            let first = self.ask(&Structural, self.net, task, limits);
            if first.is_something() {
                return first;
            }
        }
        if let Some(graph) = self.graph() {
            return self.reach_in(&graph, goal);
        }
        let (pt, smaller) = (self.net.pt(), Smaller::for_goal(self.net.pt(), goal, &limits));
        let Some(smaller) = smaller else { return self.search(self.net, goal) };
        let known = Known::new(&smaller.reduced.net);
        self.used("reductions");
        let mut found =
            self.ask(&Structural, &known, Task::Reach(&smaller.goal), self.budget.limits);
        if !found.is_something() {
            found = self.search(&known, &smaller.goal);
        }
        match found.found {
            Found::Way(way) => match smaller.reduced.trail.lift(pt, &way) {
                Ok(way) => Finding { found: Found::Way(way), ..found },
                Err(LiftError::TooLong) => Finding { found: Found::Reached, ..found },
                Err(LiftError::NotARun) => Finding::nothing(Reason::Undecided, found.states),
            },
            // What was shown of the smaller net says nothing to who does not believe the
            // reductions.
            Found::Never(_) => Finding { found: Found::Never(Evidence::None), ..found },
            _ => found,
        }
    }

    fn search(&mut self, net: &Known<'_>, goal: &Formula) -> Finding {
        let limits = self.budget.limits;
        let few = Limits { states: limits.states.min(FEW), ..limits };
        let found = self.ask(&Explicit, net, Task::Reach(goal), few);
        let Found::Nothing(reason) = found.found else { return found };
        if reason == Reason::Limit(Limit::Unbounded) {
            let found = self.ask(&Coverability, net, Task::Reach(goal), half(limits));
            if found.is_something() {
                return found;
            }
            return self.ask(&Stubborn, net, Task::Reach(goal), limits);
        }
        if limits.states <= FEW || limits.is_over() {
            return found;
        }
        let found = self.ask(&Stubborn, net, Task::Reach(goal), half(limits));
        if found.is_something() {
            return found;
        }
        self.ask(&Explicit, net, Task::Reach(goal), limits)
    }

    fn temporal(&mut self, formula: &Formula) -> Shown {
        let pt = self.net.pt();
        let stored = self.on_graph(formula);
        let smaller = (self.engine == Choice::Auto && stored.is_none())
            .then(|| Smaller::for_formula(pt, formula, &self.budget.limits))
            .flatten();
        let found = match (stored, &smaller) {
            (Some(found), _) => found,
            (None, None) => {
                self.ask(&Temporal, self.net, Task::Temporal(formula), self.budget.limits)
            }
            (None, Some(smaller)) => {
                self.used("reductions");
                let known = Known::new(&smaller.reduced.net);
                self.ask(&Temporal, &known, Task::Temporal(&smaller.goal), self.budget.limits)
            }
        };
        match found.found {
            Found::Holds(holds, run, evidence) => {
                let run = match &smaller {
                    None => run,
                    Some(smaller) => run
                        .and_then(|it| smaller.lifted(pt, it))
                        .or_else(|| self.shown_in_full(formula, holds)),
                };
                // One run is evidence for what is said of runs; it is one of the whole net.
                let run = if is_of_runs(formula) { run.map(|it| it.closed(pt)) } else { run };
                let shown = run
                    .as_ref()
                    .filter(|_| is_of_runs(formula))
                    .and_then(|it| Evidence::run(pt, it));
                let evidence =
                    shown.unwrap_or(if smaller.is_none() { evidence } else { Evidence::None });
                (Verdict::Holds(holds), run, evidence)
            }
            Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }

    /// A run of the whole net for a verdict that was found on a smaller one, if that can have a run
    /// and the net is small.
    fn shown_in_full(&self, formula: &Formula, holds: bool) -> Option<Run> {
        if holds != matches!(formula, Formula::Exists(_)) {
            return None;
        }
        let limits = Limits { states: self.budget.limits.states.min(SHOWN), ..self.budget.limits };
        let task = Task::Temporal(formula);
        match Temporal.find(self.net, task, &Budget { limits, ..self.budget }).found {
            Found::Holds(again, run, _) if again == holds => run,
            _ => None,
        }
    }

    pub(super) fn chosen(&mut self, task: Task<'_>) -> Finding {
        let engine: &dyn Engine = match self.engine {
            Choice::Structural => &Structural,
            Choice::Stubborn => &Stubborn,
            Choice::Explicit | Choice::Auto => &Explicit,
        };
        self.ask(engine, self.net, task, self.budget.limits)
    }

    pub(super) fn ask(
        &mut self,
        engine: &dyn Engine,
        net: &Known<'_>,
        task: Task<'_>,
        limits: Limits,
    ) -> Finding {
        if !self.tried.contains(&engine.name()) {
            self.tried.push(engine.name());
        }
        if limits.is_over() {
            return Finding::nothing(Reason::Limit(Limit::Time), 0);
        }
        // What is there already takes its part of the memory.
        let bytes = limits.bytes.saturating_sub(self.net.bytes());
        let limits = Limits { bytes, ..limits };
        let found = engine.find(net, task, &Budget { limits, ..self.budget });
        self.states = self.states.max(found.states);
        if found.is_something() {
            self.used(engine.name());
        }
        found
    }

    /// An engine that decided, and how many states it met.
    pub(super) fn met(&mut self, engine: &'static str, states: u64) {
        self.states = self.states.max(states);
        self.used(engine);
    }

    pub(super) fn used(&mut self, technique: &'static str) {
        self.techniques.retain(|&it| it != technique);
        self.techniques.push(technique);
    }
}

/// Whether a formula speaks of single runs: one quantifier, and not of successors.
fn is_of_runs(formula: &Formula) -> bool {
    let quantified = |it: &Formula| matches!(it, Formula::All(_) | Formula::Exists(_));
    match formula {
        Formula::All(path) | Formula::Exists(path) => {
            !path.any(&quantified) && !matches!(&**path, Formula::Next(inner) if !inner.needs_run())
        }
        _ => false,
    }
}

/// Half of the memory and of the time that is left.
pub(super) fn half(limits: Limits) -> Limits {
    let now = Instant::now();
    let left = |it: Instant| now + it.saturating_duration_since(now) / 2 + Duration::from_millis(1);
    Limits { bytes: limits.bytes / 2, deadline: limits.deadline.map(left), ..limits }
}

/// Evidence for one part of several.
pub(super) fn one(evidence: Evidence, part: usize) -> Evidence {
    match evidence {
        Evidence::None => Evidence::None,
        evidence => Evidence::One(One { part, by: Box::new(evidence) }),
    }
}

/// Evidence for all parts.
fn each_of(evidence: Vec<Evidence>) -> Evidence {
    if evidence.contains(&Evidence::None) { Evidence::None } else { Evidence::Each(evidence) }
}
