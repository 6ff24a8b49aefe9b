//! Questions as claims of few operators: `A` is `!E!`, `F a` is `true U a`, `G a` is `!F !a`, `a | b` is `!(!a & !b)`, a
//! transition is enabled when `weight - tokens <= 0` for each place that it takes from.

use super::verify::Checked;
use super::verify::net::{Linear, Net, number};
use super::{Formula, Question};
use Claim::{And, AtMost, Exists, Next, Not, Successor, Unbounded, Until};
use std::collections::BTreeMap;

pub(super) enum Claim {
    AtMost(Linear),
    Not(Box<Claim>),
    And(Vec<Claim>),
    /// Of one of the markings that follow.
    Successor(Box<Claim>),
    /// Of one of the runs from here; what follows is about runs.
    Exists(Box<Claim>),
    Next(Box<Claim>),
    Until(Box<(Claim, Claim)>),
    /// This sum gets larger than any number.
    Unbounded(Linear),
}

fn not(claim: Claim) -> Claim {
    if let Not(inner) = claim { *inner } else { Not(Box::new(claim)) }
}

fn or(all: impl IntoIterator<Item = Claim>) -> Claim {
    not(And(all.into_iter().map(not).collect()))
}

fn finally(goal: Claim) -> Claim {
    Until(Box::new((And(Vec::new()), goal)))
}

fn reached(goal: Claim) -> Claim {
    Exists(Box::new(finally(goal)))
}

/// `constant + weight * tokens <= 0`
fn tokens(constant: i128, weight: i128, place: usize) -> Claim {
    AtMost(Linear { constant, weights: BTreeMap::from([(place, weight)]) })
}

impl Claim {
    /// The operands of `E[a U b]`.
    pub(super) fn until(&self) -> Option<&(Self, Self)> {
        match self {
            Exists(path) => match &**path {
                Until(both) => Some(both),
                _ => None,
            },
            _ => None,
        }
    }

    fn is_about_runs(&self) -> bool {
        match self {
            Not(a) => a.is_about_runs(),
            And(all) => all.iter().any(Self::is_about_runs),
            _ => matches!(self, Next(_) | Until(_)),
        }
    }
}

impl Net<'_> {
    /// What is asked.
    pub(super) fn question(&self, question: &Question) -> Checked<Claim> {
        let places = || self.initial.iter().map(|it| i128::from(*it)).enumerate();
        let sum = |constant, names: &[String], weight| {
            let mut weights = BTreeMap::new();
            for name in names {
                *weights.entry(number(&self.places, name)?).or_default() += weight;
            }
            Ok(Linear { constant, weights })
        };
        Ok(match question {
            Question::Formula(formula) => self.claim(formula)?,
            Question::Bound { places, most } => {
                let above = sum(i128::from(*most) + 1, places, -1)?;
                And(vec![not(reached(AtMost(above))), reached(AtMost(sum((*most).into(), places, -1)?))])
            }
            Question::Unbounded { places } => Unbounded(sum(0, places, 1)?),
            Question::Live => And(self.enabled(|it| not(reached(not(reached(it)))))?),
            Question::QuasiLive => And(self.enabled(reached)?),
            Question::Stable => or(places().map(|(place, start)| {
                not(reached(or([tokens(1 - start, 1, place), tokens(start + 1, -1, place)])))
            })),
            Question::OneSafe => not(reached(or(places().map(|it| tokens(2, -1, it.0))))),
        })
    }

    /// Something about the enabling of each transition.
    fn enabled(&self, claim: fn(Claim) -> Claim) -> Checked<Vec<Claim>> {
        (0..self.transitions.len()).map(|it| self.enabling(it).map(claim)).collect()
    }

    /// That a transition is enabled.
    pub(super) fn enabling(&self, transition: usize) -> Checked<Claim> {
        let take = &self.transitions[transition].take;
        self.spend(256 * (1 + take.len()))?; // memory is work too
        Ok(And(take.iter().map(|(place, weight)| tokens((*weight).into(), -1, *place)).collect()))
    }

    pub(super) fn claim(&self, formula: &Formula) -> Checked<Claim> {
        let list = |all: &[Formula]| all.iter().map(|it| self.claim(it)).collect::<Checked<Vec<_>>>();
        Ok(match formula {
            Formula::AtMost(linear) => AtMost(self.linear(linear)?),
            Formula::Fireable(names) => {
                let all = names.iter().map(|it| self.enabling(number(&self.names, it)?));
                or(all.collect::<Checked<Vec<_>>>()?)
            }
            Formula::Deadlock => And(self.enabled(not)?),
            Formula::Not(a) => not(self.claim(a)?),
            Formula::And(all) => And(list(all)?),
            Formula::Or(all) => or(list(all)?),
            Formula::Exists(path) => self.exists(path, |it| it)?,
            Formula::All(path) => not(self.exists(path, not)?),
            Formula::Next(a) => Next(Box::new(self.claim(a)?)),
            Formula::Finally(a) => finally(self.claim(a)?),
            Formula::Globally(a) => not(finally(not(self.claim(a)?))),
            Formula::Until(both) => Until(Box::new((self.claim(&both.0)?, self.claim(&both.1)?))),
        })
    }

    /// That there is a run of which this holds, as it is or turned around.
    fn exists(&self, path: &Formula, turned: fn(Claim) -> Claim) -> Checked<Claim> {
        Ok(match (path, self.claim(path)?) {
            (Formula::Next(_), Next(a)) if !a.is_about_runs() => Successor(Box::new(turned(*a))),
            (_, path) => Exists(Box::new(turned(path))),
        })
    }
}
