//! Certificates from what engines hold.

use super::{
    Certificate, Evidence, Fact, Formula, Growth, Lasso, Linear, Net, Question, SCHEMA, Trace,
    Transition,
};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use cotama_property::run::{Rest, Run};
use cotama_property::{self as property, Atom, Property};
use std::collections::BTreeMap;
use std::fmt;

/// An answer to a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Truth of the formula.
    Holds(bool),
    /// The most tokens, to [`Bound`](property::Question::Bound).
    Bound(u64),
    /// The sum has no largest value, an answer to [`Bound`](property::Question::Bound).
    Unbounded,
}

/// Why there is no certificate for a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Uncertifiable {
    /// The question speaks of milliseconds.
    Time,
    /// The question speaks of fair runs.
    Fairness,
    /// The answer does not fit the question, or is larger than 9,223,372,036,854,775,807.
    Answer,
}

impl fmt::Display for Uncertifiable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Time => "properties of time nets have no certificates",
            Self::Fairness => "properties with assumptions about runs have no certificates",
            Self::Answer => "the answer does not fit the question",
        })
    }
}

impl std::error::Error for Uncertifiable {}

impl Certificate {
    /// A certificate for the answer to a property.
    ///
    /// # Errors
    ///
    /// When the property is about time, or the answer is of another kind than the question.
    pub fn new(
        pt: &Pt,
        property: &Property,
        answer: Answer,
        evidence: Evidence,
    ) -> Result<Self, Uncertifiable> {
        let question = Question::new(pt, &property.question, answer)?;
        let verdict = !matches!(answer, Answer::Holds(false));
        Ok(Self::of(pt, &property.name, question, verdict, evidence))
    }

    /// A certificate for the verdict on a question.
    pub fn of(
        pt: &Pt,
        property: &str,
        question: Question,
        verdict: bool,
        evidence: Evidence,
    ) -> Self {
        Self {
            schema: SCHEMA.to_owned(),
            net: Net::from(pt),
            property: property.to_owned(),
            question,
            verdict,
            evidence,
        }
    }

    /// The file: one line of JSON.
    pub fn text(&self) -> String {
        // Strings, numbers, lists and maps with strings as keys: there is nothing that JSON cannot
        // say.
        serde_json::to_string(self).map_or_else(|_| String::new(), |it| it + "\n")
    }
}

impl From<&Pt> for Net {
    fn from(pt: &Pt) -> Self {
        let name = |place: u32| pt.places[place as usize].clone();
        let transitions = pt.transitions.iter().zip(0..).map(|(transition, id)| {
            let needs = pt.needs.of(id);
            let mut give: Vec<_> =
                needs.iter().map(|&(place, tokens)| (place, i64::from(tokens))).collect();
            let resets = pt.resets(id);
            for &(place, change) in pt.effects.of(id) {
                match give.binary_search_by_key(&place, |it| it.0) {
                    Ok(at) => give[at].1 += change,
                    Err(at) => give.insert(at, (place, change)),
                }
            }
            // A transition that gives more than a place can hold never fires, nor with the most
            // that fits.
            let most = |it: i64| u32::try_from(it).unwrap_or(u32::MAX);
            give.retain(|it| it.1 > 0 && resets.iter().all(|reset| reset.0 != it.0));
            let left = resets.iter().filter(|it| it.1 > 0).map(|it| (it.0, i64::from(it.1)));
            give.extend(left);
            give.sort_unstable_by_key(|it| it.0);
            let inhibit = pt.inhibits(id);
            Transition {
                name: transition.clone(),
                take: needs.iter().map(|&(place, tokens)| (name(place), tokens)).collect(),
                give: give.into_iter().map(|it| (name(it.0), most(it.1))).collect(),
                inhibit: inhibit.iter().map(|&(place, below)| (name(place), below)).collect(),
                reset: resets.iter().map(|it| name(it.0)).collect(),
                priority: pt.special.as_ref().map_or(0, |it| it.priority(id)),
            }
        });
        Self {
            name: pt.name.clone(),
            places: pt.places.iter().cloned().zip(pt.initial.iter().copied()).collect(),
            transitions: transitions.collect(),
        }
    }
}

impl Question {
    /// The question of a property, with the answer where it is a number.
    ///
    /// # Errors
    ///
    /// As [`Certificate::new`].
    pub fn new(
        pt: &Pt,
        question: &property::Question,
        answer: Answer,
    ) -> Result<Self, Uncertifiable> {
        use property::Question as Asked;
        Ok(match (question, answer) {
            (Asked::Response { .. }, _) => return Err(Uncertifiable::Time),
            (Asked::Fair(..), _) => return Err(Uncertifiable::Fairness),
            (Asked::Bound(places), Answer::Bound(most)) => Self::Bound {
                places: places.iter().map(|it| pt.places[it.0 as usize].clone()).collect(),
                most: i64::try_from(most).map_err(|_| Uncertifiable::Answer)?,
            },
            (Asked::Bound(places), Answer::Unbounded) => Self::Unbounded {
                places: places.iter().map(|it| pt.places[it.0 as usize].clone()).collect(),
            },
            (Asked::Bound(_), Answer::Holds(_)) | (_, Answer::Bound(_) | Answer::Unbounded) => {
                return Err(Uncertifiable::Answer);
            }
            (Asked::Formula(formula), _) => Self::Formula(Formula::new(pt, formula)?),
            (Asked::Liveness, _) => Self::Live,
            (Asked::QuasiLiveness, _) => Self::QuasiLive,
            (Asked::StableMarking, _) => Self::Stable,
            (Asked::OneSafe, _) => Self::OneSafe,
        })
    }
}

/// Whether a formula needs a run to speak of.
fn speaks_of_runs(formula: &property::Formula) -> bool {
    use property::Formula as Asked;
    match formula {
        Asked::Not(a) => speaks_of_runs(a),
        Asked::And(all) | Asked::Or(all) => all.iter().any(speaks_of_runs),
        Asked::Atom(_) | Asked::Exists(_) | Asked::All(_) => false,
        Asked::Next(_)
        | Asked::Finally(_)
        | Asked::Globally(_)
        | Asked::Until(..)
        | Asked::Within(..) => true,
    }
}

impl Formula {
    /// `AG`: always, whatever happens.
    pub fn always(a: Self) -> Self {
        Self::All(Box::new(Self::Globally(Box::new(a))))
    }

    /// `EF`: it can be reached.
    pub fn reached(a: Self) -> Self {
        Self::Exists(Box::new(Self::Finally(Box::new(a))))
    }

    /// Returns the claim that these places hold so many tokens together, or more; one that is named
    /// twice counts twice.
    pub fn at_least(tokens: i64, places: &[String]) -> Self {
        let mut weights = BTreeMap::new();
        for it in places {
            *weights.entry(it.clone()).or_default() -= 1;
        }
        Self::AtMost(Linear { constant: tokens, weights: weights.into_iter().collect() })
    }

    /// Returns the claim that these places hold so many tokens together, or fewer.
    pub fn at_most(tokens: i64, places: &[String]) -> Self {
        // No file has enough places to hold as many tokens as do not fit.
        Self::Not(Box::new(Self::at_least(tokens.saturating_add(1), places)))
    }

    /// A formula of the property language.
    ///
    /// # Errors
    ///
    /// When it speaks of milliseconds.
    pub fn new(pt: &Pt, formula: &property::Formula) -> Result<Self, Uncertifiable> {
        use property::Formula as Asked;
        let boxed = |it: &Asked| Self::new(pt, it).map(Box::new);
        let list = |all: &[Asked]| all.iter().map(|it| Self::new(pt, it)).collect::<Result<_, _>>();
        Ok(match formula {
            Asked::Atom(Atom::AtMost(linear)) => {
                let weights = linear.weights.iter().map(|&(place, weight)| (place.0, weight));
                Self::AtMost(Linear::new(pt, linear.constant, weights))
            }
            Asked::Atom(Atom::Fireable(some)) => Self::Fireable(
                some.iter().map(|it| pt.transitions[it.0 as usize].clone()).collect(),
            ),
            Asked::Atom(Atom::Deadlock) => Self::Deadlock,
            Asked::Not(a) => Self::Not(boxed(a)?),
            Asked::And(all) => Self::And(list(all)?),
            Asked::Or(all) => Self::Or(list(all)?),
            Asked::Exists(path) => match &**path {
                Asked::Next(a) if !speaks_of_runs(a) => Self::ExistsNext(boxed(a)?),
                path => Self::Exists(boxed(path)?),
            },
            Asked::All(path) => match &**path {
                Asked::Next(a) if !speaks_of_runs(a) => Self::AllNext(boxed(a)?),
                path => Self::All(boxed(path)?),
            },
            Asked::Next(a) => Self::Next(boxed(a)?),
            Asked::Finally(a) => Self::Finally(boxed(a)?),
            Asked::Globally(a) => Self::Globally(boxed(a)?),
            Asked::Until(a, b) => Self::Until(Box::new((Self::new(pt, a)?, Self::new(pt, b)?))),
            Asked::Within(..) => return Err(Uncertifiable::Time),
        })
    }
}

impl Linear {
    /// `constant + sum of weight * tokens <= 0`, by numbers of places.
    pub fn new(pt: &Pt, constant: i64, weights: impl IntoIterator<Item = (u32, i64)>) -> Self {
        let named =
            weights.into_iter().map(|(place, weight)| (pt.places[place as usize].clone(), weight));
        Self { constant, weights: named.collect() }
    }

    /// `1 - sum of tokens <= 0`: one of these places is marked.
    pub fn trap(places: &[String]) -> Self {
        Self { constant: 1, weights: places.iter().map(|it| (it.clone(), -1)).collect() }
    }
}

impl Fact {
    /// Returns the fact that this weighted sum of tokens is never larger than at a marking; `None`
    /// when its value there needs more than 64 bits.
    pub fn sum(pt: &Pt, weights: &[(u32, i64)], from: &[u32]) -> Option<Self> {
        let value = weights.iter().try_fold(0_i64, |sum, &(place, weight)| {
            sum.checked_sub(weight.checked_mul(from[place as usize].into())?)
        })?;
        Some(Self::AtMost(Linear::new(pt, value, weights.iter().copied())))
    }

    /// Returns the fact that one of these places is always marked.
    pub fn trap(pt: &Pt, places: &[u32]) -> Self {
        Self::Trap(places.iter().map(|&it| pt.places[it as usize].clone()).collect())
    }
}

fn names(pt: &Pt, transitions: &[u32]) -> Vec<String> {
    transitions.iter().map(|&it| pt.transitions[it as usize].clone()).collect()
}

impl Evidence {
    /// The path to a marking that shows by itself what is looked for.
    pub fn trace(pt: &Pt, fire: &[u32]) -> Self {
        Self::trace_then(pt, fire, Self::State)
    }

    /// The path to a marking, and why it is the one looked for.
    pub fn trace_then(pt: &Pt, fire: &[u32], then: Self) -> Self {
        Self::Trace(Trace { fire: names(pt, fire), then: Box::new(then) })
    }

    /// A run that goes on for ever.
    pub fn lasso(pt: &Pt, stem: &[u32], cycle: &[u32]) -> Self {
        Self::Lasso(Lasso { stem: names(pt, stem), cycle: names(pt, cycle) })
    }

    /// Returns the evidence that sums of tokens grow beyond any number: after the stem the pump can
    /// fire again and again.
    pub fn growth(pt: &Pt, stem: &[TransitionId], pump: &[TransitionId]) -> Self {
        let names = |it: &[TransitionId]| names(pt, &numbers(it));
        Self::Growth(Growth { stem: names(stem), pump: names(pump) })
    }

    /// The run that a search for runs has found; `None` when it may go on in any way, see
    /// [`Run::closed`].
    pub fn run(pt: &Pt, run: &Run) -> Option<Self> {
        let cycle = match &run.rest {
            Rest::Any => return None,
            Rest::Stays => Vec::new(),
            Rest::Cycle(cycle) => numbers(cycle),
        };
        Some(Self::lasso(pt, &numbers(&run.stem), &cycle))
    }
}

fn numbers(transitions: &[TransitionId]) -> Vec<u32> {
    transitions.iter().map(|it| it.0).collect()
}
