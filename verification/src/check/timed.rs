//! Questions to time nets.

use super::auto;
use super::engine::{Extent, Reason};
use super::known::Known;
use super::{Answer, Choice, Options, Verdict};
use crate::certificate::Evidence;
use crate::explicit::{self, Limit};
use crate::property::{Assumptions, Atom, Condition, Ctl, Formula, Linear, Question, Reachability};
use crate::temporal::{self, Fairness, Rest, Run, Successors, is_of_runs};
use crate::tpn::{
    self, ClassGraph, Classes, Limits, Reach, Response, Schedule, Stop, Time, TimeNet,
};
use cotama_core::net::PlaceId;

pub(super) fn answer(
    net: &Known<'_>,
    time: &TimeNet,
    question: &Question,
    options: &Options<'_>,
) -> Answer {
    let stop = || options.limits.is_over();
    Asked { net, time, limits: limits(options, &stop), options }.question(question)
}

pub(super) fn limits<'s>(options: &Options<'_>, stop: &'s dyn Fn() -> bool) -> Limits<'s> {
    Limits {
        classes: usize::try_from(options.limits.states).unwrap_or(usize::MAX),
        bytes: usize::try_from(options.limits.bytes).unwrap_or(usize::MAX),
        stop,
    }
}

struct Asked<'a, 'n> {
    net: &'a Known<'n>,
    time: &'a TimeNet,
    limits: Limits<'a>,
    options: &'a Options<'a>,
}

impl Asked<'_, '_> {
    fn question(&self, question: &Question) -> Answer {
        match question {
            Question::Formula(formula) => self.formula(&formula.simplified()),
            Question::Response { from, to } => {
                response(tpn::measured(self.time, Some(*from), *to, &self.limits))
            }
            Question::Fair(formula, assumed) => self.fair(formula, assumed),
            Question::Liveness => match self.net.atomic(self.time, &self.limits) {
                Ok(graph) => known(Verdict::Holds(graph.is_live()), graph.states() as u64),
                Err(it) => unfinished(it),
            },
            Question::OneSafe => {
                let two = |place| {
                    Formula::Atom(Atom::AtMost(Linear { constant: 2, weights: vec![(place, -1)] }))
                };
                let places = 0..self.net.pt().places.len() as u32;
                let goal = Formula::Or(places.map(|it| two(PlaceId(it))).collect());
                self.reachability(&Reachability { goal, expected: false })
            }
            Question::Bound(places) => self.bound(places),
            Question::QuasiLiveness => self.fired(|_, fires| fires.iter().all(|&it| it)),
            Question::StableMarking => self.fired(|net, fires| {
                let changers = |place| net.pt().changers.of(place).iter();
                (0..net.pt().places.len() as u32)
                    .any(|it| changers(it).all(|it| !fires[it.0 as usize]))
            }),
        }
    }

    fn formula(&self, formula: &Formula) -> Answer {
        if formula.is_state() {
            return auto::answer(self.net, &Question::Formula(formula.clone()), self.options);
        }
        if let Some(asked) = Reachability::new(formula) {
            return self.reachability(&asked);
        }
        match formula {
            Formula::Not(inner) => {
                let answer = self.formula(inner);
                let verdict = match answer.verdict {
                    Verdict::Holds(holds) => Verdict::Holds(!holds),
                    verdict => verdict,
                };
                Answer { verdict, ..answer }
            }
            Formula::And(parts) => self.parts(parts, false),
            Formula::Or(parts) => self.parts(parts, true),
            Formula::All(path) | Formula::Exists(path) if is_of_runs(path) => {
                self.runs(path, &Assumptions::default(), matches!(formula, Formula::All(_)))
            }
            _ => match InTime::new(formula) {
                Some(asked) => self.responds(&asked),
                None => self.branching(formula, &Fairness::default()),
            },
        }
    }

    fn fair(&self, formula: &Formula, assumed: &Assumptions) -> Answer {
        if let Formula::All(path) | Formula::Exists(path) = formula
            && is_of_runs(path)
        {
            return self.runs(path, assumed, matches!(formula, Formula::All(_)));
        }
        match Fairness::of(assumed) {
            Some(fairness) => self.branching(formula, &fairness),
            None => known(Verdict::Unknown(Reason::Unsuited), 0),
        }
    }

    /// A formula about single runs, by linear classes: these have the firing sequences of the net.
    fn runs(&self, path: &Formula, assumed: &Assumptions, all: bool) -> Answer {
        let classes = match self.net.classes(self.time, &self.limits) {
            Ok(classes) => ClassGraph::from(&*classes),
            Err(it) => return unfinished(it),
        };
        let limits = self.left(&classes);
        let (asked, progress) = ((path, assumed), self.options.progress);
        let jobs = self.options.jobs;
        self.found(temporal::stored_runs(&classes, asked, all, (&limits, jobs), progress))
    }

    /// A formula of CTL, by atomic classes: all states of one go on in the same way.
    fn branching(&self, formula: &Formula, fairness: &Fairness<'_>) -> Answer {
        if Ctl::new(formula).is_none() {
            return known(Verdict::Unknown(Reason::Unsuited), 0);
        }
        match self.net.atomic(self.time, &self.limits) {
            Ok(graph) => {
                let (bytes, jobs) = (self.left(&graph).bytes, self.options.jobs);
                self.found(temporal::branching(&*graph, formula, fairness, bytes, jobs))
            }
            Err(it) => unfinished(it),
        }
    }

    /// What may be used beside a graph.
    fn left(&self, graph: &ClassGraph) -> explicit::Limits {
        let limits = self.options.limits;
        explicit::Limits { bytes: limits.bytes.saturating_sub(graph.bytes()), ..limits }
    }

    /// A verdict with its run, and dates for it; a loop has those of going round once.
    fn found(&self, verdict: temporal::Verdict) -> Answer {
        let (verdict, run, states) = match verdict {
            temporal::Verdict::Known { holds, run, states } => (Verdict::Holds(holds), run, states),
            temporal::Verdict::Unknown { reason, states } => {
                (Verdict::Unknown(reason.into()), None, states)
            }
        };
        let dates = |run: &Run| {
            let mut all = run.stem.clone();
            if let Rest::Cycle(cycle) = &run.rest {
                all.extend(cycle);
            }
            tpn::schedule(self.time, &all).ok()
        };
        // Dates that are too large to write are no reason to hold a verdict back.
        let schedule = run.as_ref().and_then(dates);
        Answer { run: run.filter(|_| schedule.is_some()), schedule, ..known(verdict, states) }
    }

    fn parts(&self, parts: &[Formula], decisive: bool) -> Answer {
        let mut all = known(Verdict::Holds(!decisive), 0);
        for (number, part) in parts.iter().enumerate() {
            let answer = self.formula(part);
            all.states = all.states.max(answer.states);
            match answer.verdict {
                Verdict::Holds(holds) if holds == decisive => {
                    let evidence = auto::one(answer.evidence, number);
                    return Answer { evidence, ..answer };
                }
                Verdict::Holds(_) => {}
                verdict => all.verdict = verdict,
            }
        }
        all
    }

    /// What is never reached without intervals is never reached with them.
    fn reachability(&self, asked: &Reachability) -> Answer {
        if self.options.engine == Choice::Auto {
            let never = Formula::All(Box::new(Formula::Globally(Box::new(Formula::Not(
                Box::new(asked.goal.clone()),
            )))));
            let few = Options { engine: Choice::Structural, ..*self.options };
            let answer = auto::answer(self.net, &Question::Formula(never), &few);
            if answer.verdict == Verdict::Holds(true) {
                return Answer { verdict: Verdict::Holds(!asked.expected), ..answer };
            }
        }
        let reach = match &asked.goal {
            Formula::Atom(Atom::Deadlock) => tpn::deadlock(self.time, &self.limits),
            goal => match Condition::new(goal, self.net.pt()) {
                Some(condition) => {
                    tpn::reach(self.time, |marking| condition.holds(marking), &self.limits)
                }
                None => return known(Verdict::Unknown(Reason::Unsuited), 0),
            },
        };
        match reach {
            Reach::Reached(schedule) => shown(asked.expected, schedule),
            Reach::Unreachable { classes } => {
                known(Verdict::Holds(!asked.expected), classes as u64)
            }
            Reach::Unknown { stop, classes } => {
                known(Verdict::Unknown(reason(stop)), classes as u64)
            }
        }
    }

    fn bound(&self, places: &[PlaceId]) -> Answer {
        let sum = |marking: &[u32]| {
            places.iter().map(|it| u64::from(marking[it.0 as usize])).sum::<u64>()
        };
        self.counted(|classes| {
            let most = (0..classes.classes() as u32).map(|it| sum(classes.marking(it))).max();
            Verdict::Bound(Extent::Finite(most.unwrap_or(0)))
        })
    }

    /// A question about the transitions that fire at some time.
    fn fired(&self, holds: impl Fn(&Known<'_>, &[bool]) -> bool) -> Answer {
        let transitions = self.net.pt().transitions.len();
        self.counted(|classes| Verdict::Holds(holds(self.net, &fired(classes, transitions))))
    }

    /// What all linear classes tell.
    fn counted(&self, verdict: impl FnOnce(&Classes) -> Verdict) -> Answer {
        match self.net.classes(self.time, &self.limits) {
            Ok(classes) => known(verdict(&classes), classes.classes() as u64),
            Err(it) => unfinished(it),
        }
    }

    fn responds(&self, asked: &InTime) -> Answer {
        let pt = self.net.pt();
        let conditions = Condition::new(&asked.cause, pt).zip(Condition::new(&asked.effect, pt));
        let Some((cause, effect)) = conditions else {
            return known(Verdict::Unknown(Reason::Unsuited), 0);
        };
        self.counted(|classes| {
            let [cause, effect] = [cause, effect].map(|it| move |at: &[u32]| it.holds(at));
            match tpn::longest(classes, cause, effect, asked.at_start, &self.limits) {
                Ok(most) => Verdict::Holds(most <= Time::Finite(asked.limit)),
                Err(stop) => Verdict::Unknown(reason(stop)),
            }
        })
    }
}

/// For each transition whether some class fires it.
pub(super) fn fired(classes: &Classes, transitions: usize) -> Vec<bool> {
    let mut fires = vec![false; transitions];
    for class in 0..classes.classes() as u32 {
        for (transition, _) in classes.successors(class) {
            fires[transition.0 as usize] = true;
        }
    }
    fires
}

/// `AG (cause -> AF<=limit effect)`, or `AF<=limit effect` at the start.
struct InTime {
    cause: Formula,
    /// In milliseconds.
    limit: u64,
    effect: Formula,
    at_start: bool,
}

impl InTime {
    fn new(formula: &Formula) -> Option<Self> {
        let of = |all: &Formula, cause, at_start| {
            let Formula::All(path) = all else { return None };
            let Formula::Within(limit, effect) = &**path else { return None };
            let effect = (**effect).clone();
            effect.is_state().then_some(Self { cause, limit: *limit, effect, at_start })
        };
        let Formula::All(path) = formula else { return None };
        let Formula::Globally(inner) = &**path else {
            return of(formula, Formula::TRUE, true);
        };
        let Formula::Or(parts) = &**inner else { return of(inner, Formula::TRUE, false) };
        let (state, open): (Vec<_>, Vec<_>) = parts.iter().partition(|it| it.is_state());
        let [open] = open[..] else { return None };
        let safe = Formula::Or(state.into_iter().cloned().collect());
        let cause = Formula::Not(safe.into());
        of(open, cause, false)
    }
}

fn known(verdict: Verdict, states: u64) -> Answer {
    let (techniques, evidence) = (vec!["classes"], Evidence::None);
    Answer { verdict, run: None, schedule: None, evidence, techniques, states }
}

fn shown(holds: bool, schedule: Schedule) -> Answer {
    let stem = schedule.steps.iter().map(|it| it.transition).collect();
    let states = schedule.steps.len() as u64 + 1;
    Answer {
        run: Some(Run { stem, rest: Rest::Any }),
        schedule: Some(schedule),
        ..known(Verdict::Holds(holds), states)
    }
}

/// An answer of so many classes.
fn response((response, classes): (Response, usize)) -> Answer {
    let verdict = match response {
        Response::NeverFires => Verdict::Response(None),
        Response::Between { min, max } => Verdict::Response(Some((min, max))),
        Response::Unknown { stop, .. } => Verdict::Unknown(reason(stop)),
    };
    known(verdict, classes as u64)
}

/// Classes that are not all known.
fn unfinished((stop, classes): (Stop, usize)) -> Answer {
    known(Verdict::Unknown(reason(stop)), classes as u64)
}

fn reason(stop: Stop) -> Reason {
    Reason::Limit(match stop {
        Stop::Unbounded => Limit::Unbounded,
        Stop::Classes => Limit::States,
        Stop::Bytes => Limit::Bytes,
        Stop::Interrupt => Limit::Time,
        Stop::Overflow => Limit::Tokens,
    })
}
