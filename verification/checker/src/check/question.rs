//! A question in its parts, and their findings as an answer.

use super::strategy::Strategy;
use super::{Answer, Options, Verdict};
use crate::coverability::growth;
use crate::engines::{Engine, Extent, Found, Known, Reason, Task};
use crate::explicit::{Explicit, Goal, Limits, certified, evidence};
use crate::temporal::{Rest, Run, of_runs};
use crate::tpn::{self, Schedule};
use cotama_certificate::{Evidence, One};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_diagnosis::shrink;
use cotama_property::{Assumptions, Atom, Condition, Ctl, Formula, Linear, Question, Reachability};

/// The longest way of which it is tried to leave firings out.
const SHRUNK: usize = 500;

/// Markings of a net that is looked at once more for a shortest path.
const SHOWN: u64 = 20_000;

pub(super) fn answer(net: &Known<'_>, question: &Question, options: &Options<'_>) -> Answer {
    let mut asked = Strategy::new(net, options);
    let Shown { verdict, run, mut evidence } = asked.question(question);
    let is_known = !matches!(verdict, Verdict::Unknown(_));
    if evidence == Evidence::None && options.evidence && is_known && net.time().is_none() {
        evidence = asked.all_markings(question, &verdict);
    }
    let techniques = if is_known { asked.techniques } else { asked.tried };
    let schedule = net.time().zip(run.as_ref()).and_then(|(net, run)| dates(net, run));
    let run = run.filter(|_| net.time().is_none() || schedule.is_some());
    Answer { verdict, run, schedule, evidence, techniques, states: asked.states }
}

/// Dates for a run; a loop has those of going round once. There are none where they are too large
/// to write, which is no reason to hold a verdict back.
fn dates(net: &tpn::TimeNet, run: &Run) -> Option<Schedule> {
    let mut all = run.stem.clone();
    if let Rest::Cycle(cycle) = &run.rest {
        all.extend(cycle);
    }
    tpn::schedule(net, &all).ok()
}

/// A verdict with a run and evidence.
pub(super) struct Shown {
    pub(super) verdict: Verdict,
    pub(super) run: Option<Run>,
    pub(super) evidence: Evidence,
}

impl Shown {
    pub(super) fn bare(verdict: Verdict) -> Self {
        Self { verdict, run: None, evidence: Evidence::None }
    }

    pub(super) fn unknown(reason: Reason) -> Self {
        Self::bare(Verdict::Unknown(reason))
    }
}

impl Strategy<'_, '_> {
    fn question(&mut self, question: &Question) -> Shown {
        match question {
            Question::Formula(formula) => self.formula(&formula.simplified()),
            // As it is: what is the same on all runs need not be on fair ones, of which there may
            // be none.
            Question::Fair(formula, assumed) => self.holds(formula, assumed),
            Question::Bound(places) => self.bound(places),
            Question::OneSafe => self.one_safe(),
            Question::QuasiLiveness => self.dead(&|_, dead| dead.is_empty()),
            // Only markings tell whether a place that is emptied held something.
            Question::StableMarking if self.net.pt().has_resets() => self.stable(),
            Question::StableMarking => self.dead(&|net, dead| {
                let never = |it: u32| dead.binary_search(&TransitionId(it)).is_ok();
                let changers = |place| net.pt().changers.of(place).iter();
                (0..net.pt().places.len() as u32).any(|place| changers(place).all(|it| never(it.0)))
            }),
            Question::Liveness => self.told(Task::Live),
            Question::Response { from, to } => self.told(Task::Response(*from, *to)),
        }
    }

    fn formula(&mut self, formula: &Formula) -> Shown {
        if let Some(condition) = Condition::new(formula, self.net.pt()) {
            self.used("initial");
            let holds = condition.holds(self.net.pt().initial.as_slice());
            return Shown { evidence: Evidence::State, ..Shown::bare(Verdict::Holds(holds)) };
        }
        if let Some(asked) = Reachability::new(formula) {
            return self.reachability(&asked);
        }
        match formula {
            Formula::Not(inner) => match self.formula(inner) {
                Shown { verdict: Verdict::Holds(holds), run, evidence } => {
                    Shown { verdict: Verdict::Holds(!holds), run, evidence }
                }
                unknown => unknown,
            },
            Formula::And(parts) => self.parts(parts, false),
            Formula::Or(parts) => self.parts(parts, true),
            _ => self.holds(formula, &Assumptions::default()),
        }
    }

    /// Parts one of which decides if it is `decisive`; those that ask for one marking come first.
    fn parts(&mut self, parts: &[Formula], decisive: bool) -> Shown {
        let mut order: Vec<usize> = (0..parts.len()).collect();
        order.sort_by_key(|&it| Reachability::new(&parts[it]).is_none());
        let (mut open, mut each) = (None, vec![Evidence::None; parts.len()]);
        for part in order {
            let shown = self.formula(&parts[part]);
            match shown.verdict {
                Verdict::Holds(holds) if holds == decisive => {
                    return Shown { evidence: one(shown.evidence, part), ..shown };
                }
                Verdict::Unknown(reason) => open = open.or(Some(reason)),
                _ => each[part] = shown.evidence,
            }
        }
        match open {
            Some(reason) => Shown::unknown(reason),
            None => Shown { evidence: each_of(each), ..Shown::bare(Verdict::Holds(!decisive)) },
        }
    }

    /// Whether a place holds as many tokens as at the start in all markings.
    fn stable(&mut self) -> Shown {
        let graph = match self.net.graph(&self.budget) {
            Ok(graph) => graph,
            Err(it) => return Shown::unknown(Reason::Limit(it.limit)),
        };
        self.used(Explicit.name());
        self.states = self.states.max(graph.states() as u64);
        let mut all = (0..).zip(&self.net.pt().initial);
        let stays = all.any(|(place, start)| graph.tokens(PlaceId(place)).all(|it| it == *start));
        let evidence = evidence(self.net, &graph);
        Shown { evidence, ..Shown::bare(Verdict::Holds(stays)) }
    }

    /// Returns the verdict of a task, with its run and evidence.
    fn told(&mut self, task: Task<'_>) -> Shown {
        match self.solve(task).found {
            Found::Holds(holds, run, evidence) => {
                Shown { verdict: Verdict::Holds(holds), run, evidence }
            }
            Found::Most(most, path, evidence) => {
                let run = path.map(|stem| Run { stem, rest: Rest::Any });
                Shown { verdict: Verdict::Bound(most), run, evidence }
            }
            Found::Response(times) => Shown::bare(Verdict::Response(times)),
            Found::Nothing(reason) => Shown::unknown(reason),
            _ => Shown::unknown(Reason::Unsuited),
        }
    }

    /// A formula about runs. One run is evidence for what is said of runs; it is one of the whole
    /// net.
    fn holds(&mut self, formula: &Formula, assumed: &Assumptions) -> Shown {
        let shown = self.told(Task::Holds(formula, assumed));
        if of_runs(formula).is_none() || !assumed.is_empty() || self.net.time().is_some() {
            return shown;
        }
        let run = shown.run.map(|it| it.closed(self.net.pt()));
        let evidence = run.as_ref().and_then(|it| Evidence::run(self.net.pt(), it));
        Shown { evidence: evidence.unwrap_or(shown.evidence), run, ..shown }
    }

    fn reachability(&mut self, asked: &Reachability) -> Shown {
        match self.solve(Task::Reach(&asked.goal)).found {
            Found::Path(path) => {
                let path = self.shortened(&asked.goal, path);
                let fire: Vec<u32> = path.iter().map(|it| it.0).collect();
                let evidence = match self.net.time() {
                    None => Evidence::trace(self.net.pt(), &fire),
                    Some(_) => Evidence::None,
                };
                let run = Some(Run { stem: path, rest: Rest::Any });
                Shown { verdict: Verdict::Holds(asked.expected), run, evidence }
            }
            Found::Reached => Shown::bare(Verdict::Holds(asked.expected)),
            Found::Never(evidence) => {
                Shown { evidence, ..Shown::bare(Verdict::Holds(!asked.expected)) }
            }
            Found::Nothing(reason) => Shown::unknown(reason),
            _ => Shown::unknown(Reason::Unsuited),
        }
    }

    /// A shortest path, if the net is small; otherwise one without firings that are not needed.
    fn shortened(&self, goal: &Formula, path: Vec<TransitionId>) -> Vec<TransitionId> {
        let pt = self.net.pt();
        if self.net.time().is_some() {
            return path;
        }
        if let Some(graph) = self.net.made() {
            let first = Goal::new(goal).and_then(|it| graph.first(it));
            return first.map_or(path, |it| graph.path(it));
        }
        let limits = Limits { states: self.budget.limits.states.min(SHOWN), ..self.budget.limits };
        let found = Explicit.find(self.net, Task::Reach(goal), &self.budget.with(limits)).found;
        match (found, Condition::new(goal, pt)) {
            (Found::Path(shortest), _) => shortest,
            (_, Some(condition)) if path.len() <= SHRUNK => {
                shrink(pt, &path, |it| condition.holds(it))
            }
            _ => path,
        }
    }

    fn one_safe(&mut self) -> Shown {
        if let Found::Never(evidence) = self.solve(Task::OneSafe).found {
            return Shown { evidence, ..Shown::bare(Verdict::Holds(true)) };
        }
        let two =
            |place| Formula::Atom(Atom::AtMost(Linear { constant: 2, weights: vec![(place, -1)] }));
        let places = 0..self.net.pt().places.len() as u32;
        let goal = Formula::Or(places.map(|it| two(PlaceId(it))).collect());
        self.reachability(&Reachability { goal, expected: false })
    }

    fn bound(&mut self, places: &[PlaceId]) -> Shown {
        let mut sum = Linear::default();
        for &place in places {
            match sum.weights.binary_search_by_key(&place, |it| it.0) {
                Ok(at) => sum.weights[at].1 += 1,
                Err(at) => sum.weights.insert(at, (place, 1)),
            }
        }
        self.told(Task::Bound(&sum))
    }

    /// Returns the evidence of a passage through all markings, if they are few enough for the small
    /// checker, and if it knows such questions.
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
            return evidence(self.net, &graph);
        }
        let states = self.budget.limits.states.min(certified(self.net));
        let few = self.budget.with(Limits { states, ..self.budget.limits });
        self.net.graph(&few).map_or(Evidence::None, |it| Evidence::Graph(it.states()))
    }
}

/// Evidence for one part of several.
fn one(evidence: Evidence, part: usize) -> Evidence {
    match evidence {
        Evidence::None => Evidence::None,
        evidence => Evidence::One(One { part, by: Box::new(evidence) }),
    }
}

/// Evidence for all parts.
fn each_of(evidence: Vec<Evidence>) -> Evidence {
    if evidence.contains(&Evidence::None) { Evidence::None } else { Evidence::Each(evidence) }
}
