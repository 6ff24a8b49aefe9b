//! Questions to time nets.

use super::auto;
use super::engine::{Extent, Reason};
use super::known::Known;
use super::{Answer, Choice, Options, Verdict};
use crate::certificate::Evidence;
use crate::explicit::Limit;
use crate::property::{Atom, Condition, Formula, Linear, Question, Reachability};
use crate::temporal::{Rest, Run};
use crate::tpn::{self, Classes, Limits, Reach, Response, Schedule, Stop, Time, TimeNet};
use cotama_core::net::{PlaceId, TransitionId};

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
            Question::Fair(..) | Question::Liveness => known(Verdict::Unknown(Reason::Unsuited), 0),
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
            _ => match answered_in_time(formula) {
                Some((cause, limit, effect)) => self.responds(cause, limit, effect),
                None => known(Verdict::Unknown(Reason::Unsuited), 0),
            },
        }
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
        let classes = tpn::classes(self.time, &self.limits);
        let verdict = match classes.stopped() {
            None => {
                let most = (0..classes.classes() as u32).map(|it| sum(classes.marking(it))).max();
                Verdict::Bound(Extent::Finite(most.unwrap_or(0)))
            }
            Some(stop) => Verdict::Unknown(reason(stop)),
        };
        known(verdict, classes.classes() as u64)
    }

    /// A question about the transitions that fire at some time.
    fn fired(&self, holds: impl Fn(&Known<'_>, &[bool]) -> bool) -> Answer {
        let classes = tpn::classes(self.time, &self.limits);
        let fires = fired(&classes, self.net.pt().transitions.len());
        let verdict = match classes.stopped() {
            None => Verdict::Holds(holds(self.net, &fires)),
            Some(stop) => Verdict::Unknown(reason(stop)),
        };
        known(verdict, classes.classes() as u64)
    }

    /// `AG (cause -> AF<=limit effect)`. The clock of the answer starts when the cause becomes
    /// marked, and when the effect ends while the cause is marked.
    fn responds(&self, cause: PlaceId, limit: u64, effect: PlaceId) -> Answer {
        let pt = self.net.pt();
        let starts = |it: u32| {
            let change = |place: PlaceId| {
                pt.effects
                    .of(it)
                    .iter()
                    .find(|(at, _)| *at == place.0)
                    .map_or(0, |(_, change)| *change)
            };
            (change(cause) > 0, change(effect) < 0)
        };
        let (mut states, mut open) = (0, None);
        let mut ask = |found: (Response, usize), certain: bool| {
            let answer = response(found);
            states = answer.states.max(states);
            match answer.verdict {
                Verdict::Response(Some((_, max))) if max > Time::Finite(limit) => {
                    if certain {
                        return false;
                    }
                    open = Some(Reason::Undecided);
                }
                Verdict::Unknown(reason) => open = open.or(Some(reason)),
                _ => {}
            }
            true
        };
        let marked = pt.initial[cause.0 as usize] > 0;
        let mut holds = !marked || ask(tpn::measured(self.time, None, effect, &self.limits), true);
        for transition in 0..pt.transitions.len() as u32 {
            let (begins, ends) = starts(transition);
            if holds && (begins || ends) {
                holds = ask(
                    tpn::measured(self.time, Some(TransitionId(transition)), effect, &self.limits),
                    begins,
                );
            }
        }
        let verdict = match (holds, open) {
            (false, _) => Verdict::Holds(false),
            (true, Some(reason)) => Verdict::Unknown(reason),
            (true, None) => Verdict::Holds(true),
        };
        known(verdict, states)
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

/// The places and the limit of `AG (cause -> AF<=limit effect)`, in milliseconds.
fn answered_in_time(formula: &Formula) -> Option<(PlaceId, u64, PlaceId)> {
    let Formula::All(path) = formula else { return None };
    let Formula::Globally(inner) = &**path else { return None };
    let Formula::Or(parts) = &**inner else { return None };
    let [a, b] = &parts[..] else { return None };
    let cause = |it: &Formula| match it {
        Formula::Not(inner) => marked(inner),
        Formula::Atom(Atom::AtMost(linear)) => {
            marked(&Formula::Atom(Atom::AtMost(linear.negated()?)))
        }
        _ => None,
    };
    let effect = |it: &Formula| {
        let Formula::All(path) = it else { return None };
        let Formula::Within(limit, goal) = &**path else { return None };
        Some((*limit, marked(goal)?))
    };
    let (cause, (limit, effect)) = cause(a).zip(effect(b)).or_else(|| cause(b).zip(effect(a)))?;
    Some((cause, limit, effect))
}

/// The place of which a formula says that it is marked.
fn marked(formula: &Formula) -> Option<PlaceId> {
    match formula {
        Formula::Atom(Atom::AtMost(linear)) => match linear.weights[..] {
            [(place, -1)] if linear.constant == 1 => Some(place),
            _ => None,
        },
        _ => None,
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

fn reason(stop: Stop) -> Reason {
    Reason::Limit(match stop {
        Stop::Unbounded => Limit::Unbounded,
        Stop::Classes => Limit::States,
        Stop::Bytes => Limit::Bytes,
        Stop::Interrupt => Limit::Time,
        Stop::Overflow => Limit::Tokens,
    })
}
