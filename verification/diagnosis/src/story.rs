//! The story of a run in words: the conditions that come to be true, when, and by which firing.

use super::Case;
use super::Run;
use super::claim::Along;
use super::run::enabled;
use super::words::{self, Says, counted, name, ticked};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use cotama_property::{Formula, Question};
use std::collections::BTreeSet;

/// The story of a run.
#[derive(Default)]
pub(super) struct Story {
    /// The condition shown by the run: "after 2 firings both `a` and `b` are marked".
    pub(super) what: String,
    /// How that came about.
    pub(super) cause: String,
    pub(super) notes: Vec<String>,
    /// Places to point at.
    pub(super) culprits: BTreeSet<u32>,
}

/// A story that is being told.
pub(super) struct Teller<'a> {
    pub(super) case: &'a Case<'a>,
    pub(super) along: Along<'a>,
    pub(super) clauses: Vec<String>,
    /// The position that the last clause spoke of.
    pub(super) said: Option<usize>,
    /// The conditions that came to be true at one position, and those true for ever after, as they
    /// were met.
    pub(super) moment: Option<(usize, Vec<Formula>)>,
    pub(super) forever: Option<Formula>,
    pub(super) culprits: BTreeSet<u32>,
}

pub(super) fn told(case: &Case<'_>, along: Along<'_>) -> Story {
    let teller = Teller {
        case,
        along,
        clauses: Vec::new(),
        said: None,
        moment: None,
        forever: None,
        culprits: BTreeSet::new(),
    };
    match &case.property.question {
        Question::Formula(formula) | Question::Fair(formula, _) => teller.formula(formula),
        Question::Bound(places) => teller.bound(&places.iter().map(|it| it.0).collect::<Vec<_>>()),
        Question::Response { from, to } => teller.response(*from, *to),
        Question::OneSafe => teller.one_safe(),
        Question::Liveness | Question::QuasiLiveness | Question::StableMarking => teller.end(),
    }
}

impl Teller<'_> {
    pub(super) fn pt(&self) -> &Pt {
        self.along.pt
    }

    pub(super) fn run(&self) -> &Run {
        self.along.run
    }

    pub(super) fn marking(&self, at: usize) -> Vec<u32> {
        self.run().marking(self.pt(), at)
    }

    /// The transition of a firing, counted from 1.
    pub(super) fn fired(&self, firing: usize) -> Option<TransitionId> {
        self.run().firings().nth(firing.checked_sub(1)?)
    }

    pub(super) fn transition(&self, transition: TransitionId) -> String {
        let name = name(&self.pt().transitions, transition.0);
        let net = self.case.net;
        let event = net.and_then(|net| {
            net.events
                .get(net.transitions.get(transition.0 as usize)?.on?.0 as usize)
                .map(|it| it.name)
        });
        event.map_or_else(|| name.clone(), |event| format!("{name} (on {})", ticked(event)))
    }

    /// When: "after 2 firings, at 300 ms,".
    pub(super) fn when(&self, at: usize) -> String {
        let Some(firing) = at.checked_sub(1) else { return "at the start".to_owned() };
        let date = self
            .along
            .dates
            .get(firing)
            .map_or_else(String::new, |date| format!(", at {date} ms,"));
        format!("after {}{date}", counted(at, "firing"))
    }

    fn formula(mut self, formula: &Formula) -> Story {
        let claim = super::claim::claim(formula, self.case.holds);
        if !self.along.truth(&claim)[0] {
            let story = self.end();
            let part = "this run is a part of the reason: one run does not show all of it.";
            return Story { cause: part.to_owned(), ..story };
        }
        self.explain(&claim, 0);
        let what = self.clauses.join(", and ");
        let what = match (self.run().cycle(), self.said) {
            (Some([]), None) => {
                format!("on a run that ends in a deadlock {what}")
            }
            (Some(_), None) => format!("on a run that goes on for ever {what}"),
            _ => what,
        };
        let (cause, mut notes) = self.reason();
        if let Some((at, literals)) = &self.moment {
            self.culprits.extend(words::places(literals));
            notes.extend(self.growth(*at, literals));
            notes.extend(self.clocks(*at));
        }
        if let Some(forever) = &self.forever {
            let literals: Vec<_> =
                super::claim::atoms(forever).into_iter().map(Formula::Atom).collect();
            self.culprits.extend(words::places(&literals));
        }
        let last = self.run().len();
        let is_dead = self.speaks_of_deadlock() || self.run().cycle().is_some_and(<[_]>::is_empty);
        if is_dead && enabled(self.pt(), &self.marking(last)).next().is_none() {
            notes.extend(self.stuck());
        }
        Story { what, cause, notes, culprits: self.culprits }
    }

    fn speaks_of_deadlock(&self) -> bool {
        let Some((_, literals)) = &self.moment else { return false };
        literals.iter().any(|it| matches!(words::says(it), Says::Dead))
    }

    /// Says how a claim that is true from a position on comes to be so.
    fn explain(&mut self, claim: &Formula, at: usize) {
        if claim.is_state() {
            let marking = self.marking(at);
            let literals = words::literals(self.pt(), claim, &marking);
            let sentence = words::sentence(self.pt(), &literals, &marking, false);
            let clause = if self.said == Some(at) {
                sentence
            } else {
                format!("{} {sentence}", self.when(at))
            };
            self.clauses.push(clause);
            self.said = Some(at);
            if self.moment.is_none() {
                self.moment = Some((at, literals));
            }
            return;
        }
        match claim {
            Formula::And(parts) => {
                // The conditions on this marking come first, in one sentence.
                let (now, later): (Vec<_>, Vec<_>) =
                    parts.iter().cloned().partition(Formula::is_state);
                if !now.is_empty() {
                    self.explain(&Formula::And(now), at);
                }
                for part in &later {
                    self.explain(part, at);
                }
            }
            Formula::Or(parts) => {
                if let Some(part) = parts.iter().find(|it| self.along.truth(it)[at]) {
                    self.explain(part, at);
                }
            }
            Formula::Next(next) => {
                let after = (at + 1).min(self.run().len());
                self.explain(next, after);
            }
            Formula::Finally(goal) | Formula::Within(_, goal) => self.explain_first(goal, at),
            Formula::Until(before, goal) => {
                self.explain_first(goal, at);
                if !before.is_state() || **before != Formula::TRUE {
                    let before = ticked(&before.display(self.pt()).to_string());
                    self.clauses.push(format!("until then {before} holds"));
                }
            }
            Formula::Globally(inner) => {
                let always = match &**inner {
                    Formula::Finally(goal) if goal.is_state() => {
                        format!(
                            "again and again {} holds",
                            ticked(&goal.display(self.pt()).to_string())
                        )
                    }
                    inner => words::always(self.pt(), inner),
                };
                self.lasting(at, always);
                self.forever = Some((**inner).clone());
            }
            Formula::Not(inner) => {
                let text = match &**inner {
                    Formula::Within(limit, goal) => {
                        let goal = ticked(&goal.display(self.pt()).to_string());
                        format!("within {limit} ms {goal} does not come to hold")
                    }
                    Formula::Until(a, b) => {
                        let [a, b] = [a, b].map(|it| ticked(&it.display(self.pt()).to_string()));
                        format!("{a} does not hold until {b} comes")
                    }
                    other => {
                        format!("{} does not hold", ticked(&other.display(self.pt()).to_string()))
                    }
                };
                self.lasting(at, text);
                if let Formula::Within(_, goal) = &**inner {
                    self.forever = Some(Formula::Not(goal.clone()));
                }
            }
            other => {
                let text = format!("{} holds", ticked(&other.display(self.pt()).to_string()));
                self.lasting(at, text);
            }
        }
    }

    /// A clause about all that follows a position.
    fn lasting(&mut self, at: usize, text: String) {
        let clause = match self.said {
            Some(said) if said == at => format!("from then on {text}"),
            None if at == 0 => text,
            _ => format!(
                "from {} on {text}",
                if at == 0 { "the start".to_owned() } else { format!("step {at}") }
            ),
        };
        self.clauses.push(clause);
    }

    fn explain_first(&mut self, goal: &Formula, from: usize) {
        let truth = self.along.truth(goal);
        let later = (from..truth.len()).find(|it| truth[*it]);
        // In a cycle the first position can come after the last.
        if let Some(at) = later.or_else(|| truth.iter().position(|it| *it)) {
            self.explain(goal, at);
        }
    }
}
