//! Formulas about one marking, to be asked of many markings.

use super::{Atom, Formula, Linear};
use crate::pt::{Lists, Pt};
use cotama_core::net::PlaceId;

/// Something that says how many tokens each place holds.
pub trait Marking {
    /// The tokens of a place of the net; any number for other places.
    fn tokens(&self, place: PlaceId) -> u64;
}

/// By place; places beyond the end hold none.
impl Marking for [u32] {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        self.get(place.0 as usize).copied().map_or(0, u64::from)
    }
}

/// By place; places beyond the end hold none.
impl Marking for [u64] {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        self.get(place.0 as usize).copied().unwrap_or(0)
    }
}

/// A formula about one marking, made to be evaluated fast: a chain of tests, each of which says
/// where to go on.
///
/// ```
/// # use cotama_core::net::owned::{OwnedNet, OwnedPlace};
/// # use cotama_verification::property::{self, Condition, Question};
/// # use cotama_verification::pt::Pt;
/// let mut net = OwnedNet::new("net", "");
/// net.place(OwnedPlace::new("p", 0)).unwrap();
/// net.place(OwnedPlace::new("q", 0)).unwrap();
/// let net = Pt::from(&net.view().net());
/// let property = property::parse("p + q <= 3 & !q", &net).unwrap();
/// let Question::Formula(formula) = &property.question else { panic!("not a formula") };
/// let condition = Condition::new(formula, &net).unwrap();
/// assert!(condition.holds([3_u32, 0].as_slice()));
/// assert!(!condition.holds([2_u32, 1].as_slice()));
/// ```
#[derive(Clone, Debug)]
pub struct Condition<'n> {
    /// Each leads only to tests before it.
    tests: Vec<(Test<'n>, [u32; 2])>,
    first: u32,
}

/// Ends at which a formula is known to be false, or true.
const ENDS: [u32; 2] = [u32::MAX - 1, u32::MAX];

#[derive(Clone, Debug)]
enum Test<'n> {
    AtLeast(PlaceId, u64),
    AtMostZero(Linear),
    /// The needs of a transition.
    Fireable(&'n [(u32, u32)]),
    /// The needs of each transition.
    Deadlock(&'n Lists<u32>),
    /// A transition of a net in which more than what it needs decides.
    Enabled(&'n Pt, u32),
    /// Any of its transitions.
    AnyEnabled(&'n Pt),
}

impl<'n> Condition<'n> {
    /// Returns the condition; `None` when the formula has temporal operators or quantifiers. Its
    /// transitions are those of the net.
    pub fn new(formula: &Formula, net: &'n Pt) -> Option<Self> {
        Self::of(formula, Some(net))
    }

    /// The same of a formula about tokens alone, for any net that has its places; `None` also when
    /// it speaks of transitions or deadlocks.
    pub fn of_tokens(formula: &Formula) -> Option<Self> {
        let other = |it: &Formula| matches!(it, Formula::Atom(Atom::Fireable(_) | Atom::Deadlock));
        if formula.any(&other) { None } else { Self::of(formula, None) }
    }

    fn of(formula: &Formula, net: Option<&'n Pt>) -> Option<Self> {
        let mut condition = Self { tests: Vec::new(), first: 0 };
        condition.first = formula.is_state().then(|| condition.add(formula, ENDS, net))?;
        Some(condition)
    }

    /// Whether it holds in a marking. Tokens and weights may be as large as they like.
    #[inline]
    pub fn holds<M: Marking + ?Sized>(&self, marking: &M) -> bool {
        let mut at = self.first;
        while let Some((test, next)) = self.tests.get(at as usize) {
            let holds = match test {
                Test::AtLeast(place, tokens) => marking.tokens(*place) >= *tokens,
                Test::AtMostZero(linear) => linear.holds(marking),
                Test::Fireable(needs) => enabled(marking, needs),
                Test::Deadlock(all) => {
                    (0..all.len() as u32).all(|it| !enabled(marking, all.of(it)))
                }
                Test::Enabled(net, it) => enables(net, marking, *it),
                Test::AnyEnabled(net) => {
                    (0..net.transitions.len() as u32).any(|it| enables(net, marking, it))
                }
            };
            at = next[usize::from(holds)];
        }
        at == ENDS[1]
    }

    /// Adds the tests of a formula that lead to one of two tests that are there; where the first of
    /// them is.
    fn add(&mut self, formula: &Formula, [no, yes]: [u32; 2], net: Option<&'n Pt>) -> u32 {
        match formula {
            Formula::Not(inner) => self.add(inner, [yes, no], net),
            Formula::And(all) => {
                all.iter().rev().fold(yes, |next, part| self.add(part, [no, next], net))
            }
            Formula::Or(all) => {
                all.iter().rev().fold(no, |next, part| self.add(part, [next, yes], net))
            }
            Formula::Atom(Atom::AtMost(linear)) => self.compare(linear, [no, yes]),
            Formula::Atom(Atom::Fireable(transitions)) => {
                transitions.iter().rev().fold(no, |next, it| {
                    if let Some(net) = net.filter(|net| !net.is_plain()) {
                        return self.push(Test::Enabled(net, it.0), [next, yes]);
                    }
                    let needs = net.map_or(&[][..], |net| net.needs.of(it.0));
                    self.push(Test::Fireable(needs), [next, yes])
                })
            }
            Formula::Atom(Atom::Deadlock) => match net {
                Some(net) if net.is_plain() => self.push(Test::Deadlock(&net.needs), [no, yes]),
                Some(net) => self.push(Test::AnyEnabled(net), [yes, no]),
                None => no,
            },
            // `new` lets no other formula pass.
            _ => no,
        }
    }

    fn push(&mut self, test: Test<'n>, next: [u32; 2]) -> u32 {
        self.tests.push((test, next));
        self.tests.len() as u32 - 1
    }

    fn compare(&mut self, linear: &Linear, [no, yes]: [u32; 2]) -> u32 {
        let constant = i128::from(linear.constant);
        match linear.weights.as_slice() {
            [] => [no, yes][usize::from(constant <= 0)],
            // constant + weight * tokens <= 0: fewer tokens than the first number that is too large
            &[(place, weight @ 1..)] => {
                match u64::try_from((-constant).div_euclid(i128::from(weight)) + 1) {
                    Ok(tokens) => self.push(Test::AtLeast(place, tokens), [yes, no]),
                    Err(_) => no,
                }
            }
            // constant <= -weight * tokens: at least the quotient, rounded up
            &[(place, weight @ ..=-1)] => {
                let tokens = -(-constant).div_euclid(-i128::from(weight));
                self.push(Test::AtLeast(place, u64::try_from(tokens).unwrap_or(0)), [no, yes])
            }
            _ => self.push(Test::AtMostZero(linear.clone()), [no, yes]),
        }
    }
}

fn enables<M: Marking + ?Sized>(net: &Pt, marking: &M, transition: u32) -> bool {
    net.enables(&|place| marking.tokens(PlaceId(place)), transition)
}

fn enabled<M: Marking + ?Sized>(marking: &M, needs: &[(u32, u32)]) -> bool {
    needs.iter().all(|&(place, tokens)| marking.tokens(PlaceId(place)) >= u64::from(tokens))
}

impl Linear {
    /// Returns the value of the sum in a marking.
    pub fn value<M: Marking + ?Sized>(&self, marking: &M) -> i128 {
        let part = |&(place, weight): &(PlaceId, i64)| {
            i128::from(weight) * i128::from(marking.tokens(place))
        };
        self.weights.iter().map(part).fold(self.constant.into(), i128::saturating_add)
    }

    /// Whether the inequality holds in a marking.
    #[inline]
    pub fn holds<M: Marking + ?Sized>(&self, marking: &M) -> bool {
        // The sum in two parts, `high * 2^64 + low`, neither of which can overflow.
        let split = |value: i128| (value >> 64, value & i128::from(u64::MAX));
        let (mut high, mut low) = split(i128::from(self.constant));
        for &(place, weight) in &self.weights {
            let part = split(i128::from(weight) * i128::from(marking.tokens(place)));
            (high, low) = (high + part.0, low + part.1);
        }
        let (carried, low) = split(low);
        let high = high + carried;
        high < 0 || (high == 0 && low == 0)
    }
}
