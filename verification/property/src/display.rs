//! Formulas and questions as texts of the language.

use super::lexer::written;
use super::{Assumptions, Atom, Formula, Linear, Question};
use crate::pt::Pt;
use cotama_core::net::{PlaceId, TransitionId};
use std::fmt::{self, Display, Formatter};

impl Formula {
    /// This formula as a text of the language, with the names of a net. Reading it gives this
    /// formula back if conjunctions and disjunctions have no or several parts, lists of transitions
    /// are not empty, and temporal operators stand inside of quantifiers, as in every formula that
    /// was read; if no place is called `true`, `false` or `deadlock`; and if its text is nested no
    /// deeper than [`MAX_DEPTH`](super::MAX_DEPTH).
    pub fn display<'a>(&'a self, net: &'a Pt) -> impl Display + 'a {
        Written { net, what: self }
    }
}

impl Question {
    /// This question as a text of the language, with the names of a net.
    pub fn display<'a>(&'a self, net: &'a Pt) -> impl Display + 'a {
        Written { net, what: self }
    }
}

impl Assumptions {
    /// These assumptions, of which there are some, as they stand behind a formula.
    pub fn display<'a>(&'a self, net: &'a Pt) -> impl Display + 'a {
        Written { net, what: self }
    }
}

struct Written<'a, T> {
    net: &'a Pt,
    what: &'a T,
}

impl<T> Written<'_, T> {
    fn place(&self, place: PlaceId) -> String {
        name(&self.net.places, place.0)
    }

    fn names(names: &[String], positions: impl Iterator<Item = u32>, separator: &str) -> String {
        positions.map(|at| name(names, at)).collect::<Vec<_>>().join(separator)
    }
}

/// The name at this position; of another net it may have none.
fn name(names: &[String], at: u32) -> String {
    names.get(at as usize).map_or_else(|| format!("\"{at}?\""), |name| written(name))
}

impl Display for Written<'_, Question> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.what {
            Question::Formula(formula) => formula.display(self.net).fmt(f),
            Question::Fair(formula, assumed) => {
                write!(f, "{} {}", formula.display(self.net), assumed.display(self.net))
            }
            Question::Bound(places) => {
                write!(
                    f,
                    "bounds({})",
                    Self::names(&self.net.places, places.iter().map(|it| it.0), " + ")
                )
            }
            Question::Response { from, to } => {
                write!(f, "bound({} -> {})", name(&self.net.transitions, from.0), self.place(*to))
            }
            Question::Liveness => f.write_str("live"),
            Question::QuasiLiveness => f.write_str("quasi_live"),
            Question::StableMarking => f.write_str("stable"),
            Question::OneSafe => f.write_str("one_safe"),
        }
    }
}

impl Display for Written<'_, Assumptions> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let named = |word, list: &[TransitionId]| {
            let names = Self::names(&self.net.transitions, list.iter().map(|it| it.0), ", ");
            (!list.is_empty()).then(|| format!("{word}({names})"))
        };
        let often = self.what.often.iter().map(|it| format!("often({})", it.display(self.net)));
        let fair = [named("weak", &self.what.weak), named("strong", &self.what.strong)];
        let all: Vec<_> = fair.into_iter().flatten().chain(often).collect();
        write!(f, "assuming {}", all.join(", "))
    }
}

/// How tightly the outermost operator binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    /// Stands alone or between brackets.
    Until,
    Or,
    And,
    Unary,
    Comparison,
    Name,
}

impl Display for Written<'_, Formula> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.formula(f, self.what, (Level::Until, false))
    }
}

/// The place of a formula: only what binds at least as tightly needs no parentheses there, and
/// whether an operator follows, before which a quantifier has to be closed.
type Place = (Level, bool);

impl Written<'_, Formula> {
    fn formula(&self, f: &mut Formatter<'_>, formula: &Formula, place: Place) -> fmt::Result {
        if let Formula::And(all) | Formula::Or(all) = formula
            && let [only] = all.as_slice()
        {
            return self.formula(f, only, place);
        }
        let (loosest, followed) = place;
        let is_open = followed && matches!(formula, Formula::Exists(_) | Formula::All(_));
        if level(formula) >= loosest && !is_open {
            return self.bare(f, formula, followed);
        }
        f.write_str("(")?;
        self.bare(f, formula, false)?;
        f.write_str(")")
    }

    fn bare(&self, f: &mut Formatter<'_>, formula: &Formula, followed: bool) -> fmt::Result {
        if let Some(linear) = equality(formula) {
            return self.linear(f, linear, "=");
        }
        match formula {
            Formula::Atom(Atom::AtMost(linear)) => self.linear(f, linear, "<="),
            Formula::Atom(Atom::Fireable(transitions)) => {
                let names =
                    Self::names(&self.net.transitions, transitions.iter().map(|it| it.0), ", ");
                write!(f, "fireable({names})")
            }
            Formula::Atom(Atom::Deadlock) => f.write_str("deadlock"),
            Formula::And(all) if all.is_empty() => f.write_str("true"),
            Formula::Or(all) if all.is_empty() => f.write_str("false"),
            Formula::And(all) => self.joined(f, all, " & ", (Level::Unary, followed)),
            Formula::Or(all) => self.joined(f, all, " | ", (Level::And, followed)),
            Formula::Not(inner) => {
                if let Some(linear) = equality(inner) {
                    return self.linear(f, linear, "!=");
                }
                f.write_str("!")?;
                let comparison = level(inner) == Level::Comparison;
                let loosest = if comparison { Level::Name } else { Level::Unary };
                self.formula(f, inner, (loosest, followed))
            }
            Formula::Exists(path) => self.quantified(f, "E", path),
            Formula::All(path) => self.quantified(f, "A", path),
            Formula::Until(a, b) => {
                self.formula(f, a, (Level::Unary, true))?;
                f.write_str(" U ")?;
                self.formula(f, b, (Level::Unary, followed))
            }
            Formula::Next(_) | Formula::Finally(_) | Formula::Globally(_) | Formula::Within(..) => {
                self.temporal(f, formula, followed)
            }
        }
    }

    fn quantified(&self, f: &mut Formatter<'_>, quantifier: &str, path: &Formula) -> fmt::Result {
        f.write_str(quantifier)?;
        match path {
            Formula::Next(_) | Formula::Finally(_) | Formula::Globally(_) | Formula::Within(..) => {
                self.temporal(f, path, false)
            }
            Formula::Until(..) => {
                f.write_str("[")?;
                self.bare(f, path, false)?;
                f.write_str("]")
            }
            _ => {
                f.write_str(" ")?;
                self.formula(f, path, (Level::Unary, false))
            }
        }
    }

    fn temporal(&self, f: &mut Formatter<'_>, formula: &Formula, followed: bool) -> fmt::Result {
        let inner = match formula {
            Formula::Next(inner) => (f.write_str("X ")?, inner).1,
            Formula::Finally(inner) => (f.write_str("F ")?, inner).1,
            Formula::Globally(inner) => (f.write_str("G ")?, inner).1,
            Formula::Within(limit, inner) => (write!(f, "F<={limit}ms ")?, inner).1,
            other => return self.bare(f, other, followed),
        };
        self.formula(f, inner, (Level::Unary, followed))
    }

    fn joined(
        &self,
        f: &mut Formatter<'_>,
        all: &[Formula],
        separator: &str,
        (loosest, followed): Place,
    ) -> fmt::Result {
        for (index, part) in all.iter().enumerate() {
            if index > 0 {
                f.write_str(separator)?;
            }
            self.formula(f, part, (loosest, followed || index + 1 < all.len()))?;
        }
        Ok(())
    }

    /// A comparison with 0, written without negative numbers: what is positive on the left, the
    /// rest on the right.
    fn linear(&self, f: &mut Formatter<'_>, linear: &Linear, comparison: &str) -> fmt::Result {
        if let ([(place, -1)], 1, "<=") = (linear.weights.as_slice(), linear.constant, comparison) {
            return f.write_str(&self.place(*place));
        }
        let side = |sign: i128| {
            let mut terms = Vec::new();
            for &(place, weight) in &linear.weights {
                match i128::from(weight) * sign {
                    1 => terms.push(self.place(place)),
                    weight @ 2.. => terms.push(format!("{weight} * {}", self.place(place))),
                    _ => {}
                }
            }
            let constant = i128::from(linear.constant) * sign;
            if constant > 0 || terms.is_empty() {
                terms.push(constant.max(0).to_string());
            }
            terms.join(" + ")
        };
        let turned = comparison == "<=" && linear.weights.iter().all(|&(_, weight)| weight < 0);
        if turned && !linear.weights.is_empty() {
            return write!(f, "{} >= {}", side(-1), side(1));
        }
        write!(f, "{} {comparison} {}", side(1), side(-1))
    }
}

fn level(formula: &Formula) -> Level {
    if equality(formula).is_some() {
        return Level::Comparison;
    }
    match formula {
        Formula::Atom(Atom::AtMost(linear))
            if linear.constant == 1 && matches!(linear.weights[..], [(_, -1)]) =>
        {
            Level::Name
        }
        Formula::Atom(Atom::AtMost(_)) => Level::Comparison,
        Formula::Atom(_) => Level::Name,
        Formula::And(all) | Formula::Or(all) if all.is_empty() => Level::Name,
        Formula::And(_) => Level::And,
        Formula::Or(_) => Level::Or,
        Formula::Until(..) => Level::Until,
        Formula::Not(inner) if equality(inner).is_some() => Level::Comparison,
        Formula::Not(_)
        | Formula::Exists(_)
        | Formula::All(_)
        | Formula::Next(_)
        | Formula::Finally(_)
        | Formula::Globally(_)
        | Formula::Within(..) => Level::Unary,
    }
}

/// Returns the sum that is 0, if the formula is an equation: an inequality and the one of its
/// negative.
fn equality(formula: &Formula) -> Option<&Linear> {
    let Formula::And(all) = formula else { return None };
    let [Formula::Atom(Atom::AtMost(first)), Formula::Atom(Atom::AtMost(second))] = all.as_slice()
    else {
        return None;
    };
    let negative = |(a, b): (i64, i64)| a.checked_neg() == Some(b);
    let same = first.weights.len() == second.weights.len()
        && negative((first.constant, second.constant))
        && first
            .weights
            .iter()
            .zip(&second.weights)
            .all(|(a, b)| a.0 == b.0 && negative((a.1, b.1)));
    same.then_some(first)
}
