//! Whether a property holds for a reason that is none.

use super::claim::claim;
use super::words::{Says, always, says, ticked};
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula};
use std::cell::Cell;

/// A part of a property, and a stronger property in which it stands no more: if that holds as well,
/// the part does not matter, and the property holds vacuously (Kupferman and Vardi, "Vacuity
/// detection in temporal model checking", STTT 4(2), 2003).
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Vacuity {
    /// The part.
    pub part: Formula,
    /// The property with the part replaced: by false, or by true below a negation. Simplified.
    pub formula: Formula,
}

/// Operators and atoms of all stronger properties together.
const NODES: usize = 1 << 18;

/// The stronger properties that are to be asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variants {
    /// The stronger properties: those that say that something never comes are first; else larger
    /// parts come before the parts they are made of.
    pub asked: Vec<Vacuity>,
    /// Whether these are for all parts; of a formula of more than some hundred parts only those of
    /// the outer ones are made.
    pub is_complete: bool,
}

/// The questions that tell whether a formula, which is known to hold, holds vacuously. Each is to
/// be checked; of one that holds, [`Vacuity::words`] says what that means.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace};
/// use cotama_verification::{diagnosis::vacuous, property::{self, Question}, pt::Pt};
///
/// let mut net = OwnedNet::new("motor", "");
/// ["fault", "stopped"].map(|it| net.place(OwnedPlace::new(it, 0)).unwrap());
/// let pt = Pt::from(&net.view().net());
/// let property = property::parse("AG (fault -> AF stopped)", &pt).unwrap();
/// let Question::Formula(formula) = &property.question else { panic!("not a formula") };
/// let asked = vacuous(formula).asked;
/// assert_eq!(asked[0].formula.display(&pt).to_string(), "AG fault <= 0");
/// let words = "`AG (fault -> AF stopped)` holds vacuously: `fault` is never marked, \
///              so `AF stopped` is never put to the test.";
/// assert_eq!(asked[0].words(&property.name, &pt), words);
/// ```
pub fn vacuous(formula: &Formula) -> Variants {
    let whole = formula.simplified();
    let most = (NODES / size(formula).max(1)).max(1);
    let mut found: Vec<Vacuity> = Vec::new();
    let mut is_complete = false;
    for number in 0..most {
        let Some((part, replaced)) = replaced(formula, true, &mut { number }) else {
            is_complete = true;
            break;
        };
        let formula = replaced.simplified();
        let says_nothing =
            formula == whole || formula == Formula::TRUE || formula == Formula::FALSE;
        if !says_nothing && found.iter().all(|it| it.formula != formula) {
            found.push(Vacuity { part, formula });
        }
    }
    // A condition that never comes is the better reason.
    found.sort_by_key(|it| it.never().is_none());
    Variants { asked: found, is_complete }
}

/// A part by its number, from the outside to the inside, and the formula with false (true, below a
/// negation) for it. `left` is the number, less the parts that were passed.
fn replaced(formula: &Formula, positive: bool, left: &mut usize) -> Option<(Formula, Formula)> {
    let constant = || if positive { Formula::FALSE } else { Formula::TRUE };
    match formula {
        Formula::Atom(_) => None,
        Formula::Not(a) => inside(a, !positive, left, Formula::Not),
        // The two inequalities of an equation are one thing.
        Formula::And(all) if is_equation(all) => None,
        Formula::And(all) | Formula::Or(all) => {
            let with = |at: usize, (part, it)| {
                let mut all = all.clone();
                all[at] = it;
                let is_and = matches!(formula, Formula::And(_));
                (part, if is_and { Formula::And(all) } else { Formula::Or(all) })
            };
            if let Some(part) = all.get(*left) {
                return Some(with(*left, (part.clone(), constant())));
            }
            *left -= all.len();
            let mut parts = all.iter().enumerate();
            parts.find_map(|(at, part)| Some(with(at, replaced(part, positive, left)?)))
        }
        Formula::Exists(a) => inside(a, positive, left, Formula::Exists),
        Formula::All(a) => inside(a, positive, left, Formula::All),
        Formula::Next(a) => inside(a, positive, left, Formula::Next),
        Formula::Finally(a) => inside(a, positive, left, Formula::Finally),
        Formula::Globally(a) => inside(a, positive, left, Formula::Globally),
        Formula::Within(limit, a) => inside(a, positive, left, |a| Formula::Within(*limit, a)),
        Formula::Until(a, b) => inside(a, positive, left, |a| Formula::Until(a, b.clone()))
            .or_else(|| inside(b, positive, left, |b| Formula::Until(a.clone(), b))),
    }
}

/// The same of a formula with one operand: that, and what is in it.
fn inside(
    inner: &Formula,
    positive: bool,
    left: &mut usize,
    wrap: impl Fn(Box<Formula>) -> Formula,
) -> Option<(Formula, Formula)> {
    let found = match left.checked_sub(1) {
        None => Some((inner.clone(), if positive { Formula::FALSE } else { Formula::TRUE })),
        Some(less) => {
            *left = less;
            replaced(inner, positive, left)
        }
    };
    found.map(|(part, it)| (part, wrap(Box::new(it))))
}

fn size(formula: &Formula) -> usize {
    let count = Cell::new(0);
    formula.any(&|_| {
        count.set(count.get() + 1);
        false
    });
    count.get()
}

fn is_equation(all: &[Formula]) -> bool {
    let [Formula::Atom(Atom::AtMost(a)), Formula::Atom(Atom::AtMost(b))] = all else {
        return false;
    };
    a.weights.len() == b.weights.len()
        && a.constant.checked_neg() == Some(b.constant)
        && a.weights
            .iter()
            .zip(&b.weights)
            .all(|(a, b)| a.0 == b.0 && a.1.checked_neg() == Some(b.1))
}

impl Vacuity {
    /// Returns the consequence of the stronger property's holding, in a sentence; `property` is the
    /// text of the one that it was made from.
    pub fn words(&self, property: &str, pt: &Pt) -> String {
        let show = |it: &Formula| ticked(&it.display(pt).to_string());
        let (property, part) = (ticked(property), show(&self.part));
        if let Some(never) = self.never() {
            let is_test = !matches!(self.part, Formula::Not(_));
            let so = if is_test { "is never put to the test" } else { "makes no difference" };
            return format!("{property} holds vacuously: {}, so {part} {so}.", always(pt, &never));
        }
        format!(
            "{property} holds vacuously: {} holds already, so {part} makes no difference.",
            show(&self.formula)
        )
    }

    /// Returns the condition that never comes by the stronger property, if it says so.
    fn never(&self) -> Option<Formula> {
        let Formula::All(path) = &self.formula else { return None };
        let Formula::Globally(state) = &**path else { return None };
        let state = state.is_state().then(|| claim(state, true))?;
        let is_never =
            |it: &Formula| matches!(says(it), Says::Empty(_) | Says::Disabled(_) | Says::Alive);
        let all = match &state {
            Formula::And(parts) if !parts.is_empty() => parts.iter().all(is_never),
            one => is_never(one),
        };
        all.then_some(state)
    }
}
