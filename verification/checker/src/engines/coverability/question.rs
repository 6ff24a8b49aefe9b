//! Questions about one marking that more tokens never make false.

use super::growth::FIRST;
use super::search::{Order, Search};
use super::set::demand;
use super::tokens::OmegaMarking;
use super::{FIRINGS, Limit, Limits, Sequence, Tokens, Unfinished};
use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Condition, Formula};

/// Whether some reachable marking is as asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Coverable {
    /// One is; how to get there.
    Yes(Sequence),
    /// No such marking is reachable.
    No,
    /// A limit was reached before either was shown.
    Unknown(Unfinished),
}

/// Whether a marking with at least so many tokens is reachable. Places that are not named may hold
/// any number, those that the net does not have hold none.
///
/// ```
/// use cotama_verification::coverability::{Coverable, Limits, coverable};
/// use cotama_verification::tina;
/// let belt = tina::read("belt.net", b"tr put on -> on full  tr go on -> off  pl on (1)").unwrap();
/// let pt = belt.untimed();
/// let place = |name| pt.place(name).unwrap();
/// let found = coverable(&pt, &[(place("full"), 2), (place("off"), 1)], &Limits::default());
/// assert!(matches!(found, Coverable::Yes(way) if way.length == 3));
/// let both = coverable(&pt, &[(place("on"), 1), (place("off"), 1)], &Limits::default());
/// assert!(matches!(both, Coverable::No));
/// ```
pub fn coverable(pt: &Pt, target: &[(PlaceId, u64)], limits: &Limits) -> Coverable {
    let known = |it: &&(PlaceId, u64)| (it.0.0 as usize) < pt.places.len();
    if target.iter().any(|it| !known(&it) && it.1 > 0) {
        return Coverable::No;
    }
    let known: Vec<_> = target.iter().filter(known).copied().collect();
    let Some(demand) = demand(pt, &known) else { return Coverable::No };
    find(pt, limits, &|marking| {
        let is_met = marking.iter().zip(&demand).all(|(has, &needs)| *has >= Tokens::new(needs));
        is_met.then(|| demand.clone())
    })
}

/// Whether a marking is reachable that meets a goal, a formula about one marking as in
/// [`Reachability`](cotama_property::Reachability); `None` unless it [is upward
/// closed](is_upward_closed).
///
/// ```
/// # use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// # use cotama_core::net::TransitionId;
/// # use cotama_verification::coverability::{Coverable, Limits, reaches};
/// # use cotama_verification::property::{self, Question};
/// # use cotama_verification::pt::Pt;
/// let mut net = OwnedNet::new("source", "");
/// let heap = net.place(OwnedPlace::new("heap", 0)).unwrap();
/// net.transition(OwnedTransition::new("deliver").give(heap, 2)).unwrap();
/// let net = Pt::from(&net.view().net());
/// let goal = |text| match property::parse(text, &net).unwrap().question {
///     Question::Formula(goal) => goal,
///     _ => panic!("not a formula"),
/// };
/// let Some(Coverable::Yes(way)) = reaches(&net, &goal("heap >= 5"), &Limits::default()) else {
///     panic!()
/// };
/// assert_eq!(way.firings, Some(vec![TransitionId(0); 3]));
/// assert_eq!(reaches(&net, &goal("heap = 5"), &Limits::default()), None);
/// ```
pub fn reaches(pt: &Pt, goal: &Formula, limits: &Limits) -> Option<Coverable> {
    let condition = Condition::new(goal, pt).filter(|_| is_upward_closed(goal))?;
    Some(find(pt, limits, &|marking| {
        condition.holds(&OmegaMarking(marking)).then(|| smallest(&condition, marking))
    }))
}

/// Whether a formula about one marking stays true when tokens are added, as its form shows.
pub fn is_upward_closed(formula: &Formula) -> bool {
    is_monotone(formula, true)
}

fn is_monotone(formula: &Formula, up: bool) -> bool {
    match formula {
        Formula::Not(inner) => is_monotone(inner, !up),
        Formula::And(all) | Formula::Or(all) => all.iter().all(|it| is_monotone(it, up)),
        Formula::Atom(Atom::AtMost(linear)) => linear.weights.iter().all(|it| (it.1 < 0) == up),
        Formula::Atom(Atom::Fireable(some)) => up || some.is_empty(),
        Formula::Atom(Atom::Deadlock) => !up,
        _ => false,
    }
}

/// Tokens that meet a condition, few of them, at most those of an ω-marking that meets it.
fn smallest(condition: &Condition<'_>, marking: &[Tokens]) -> Vec<u64> {
    // ω reads as 2^64 - 1: try smaller numbers in its place, then fewer tokens everywhere.
    let with =
        |omega: u64| marking.iter().map(|it| it.finite().unwrap_or(omega)).collect::<Vec<u64>>();
    let powers = (0..63).map(|power| with(1 << power));
    let mut tokens = powers
        .into_iter()
        .find(|it| condition.holds(it.as_slice()))
        .unwrap_or_else(|| with(u64::MAX));
    for place in 0..tokens.len() {
        let (mut less, mut enough) = (0, tokens[place]);
        while less < enough {
            let middle = less + (enough - less) / 2;
            tokens[place] = middle;
            if condition.holds(tokens.as_slice()) { enough = middle } else { less = middle + 1 }
        }
        tokens[place] = enough;
    }
    tokens
}

/// Looks for an ω-marking that is as asked; then also for the tokens that matter.
fn find(pt: &Pt, limits: &Limits, meets: &dyn Fn(&[Tokens]) -> Option<Vec<u64>>) -> Coverable {
    if !pt.is_plain() {
        return Coverable::Unknown(Unfinished::UNSUITED);
    }
    let run = |limits: &Limits, order| {
        let mut search = Search::new(pt, order);
        let mut demand = None;
        let found = search.run(limits, &mut |marking| {
            demand = meets(marking);
            demand.is_some()
        });
        match (found, demand) {
            (Ok(Some(id)), Some(demand)) => {
                let unwritten = Sequence { length: u128::MAX, firings: None };
                Coverable::Yes(search.sequence(id, demand, FIRINGS).unwrap_or(unwritten))
            }
            (Ok(_), _) => Coverable::No,
            (Err(unfinished), _) => Coverable::Unknown(unfinished),
        }
    };
    let few = Limits { states: limits.states.min(FIRST), ..*limits };
    match run(&few, Order::First) {
        Coverable::Unknown(Unfinished { limit: Limit::States, .. }) if limits.states > FIRST => {
            run(limits, Order::Greatest)
        }
        answer => answer,
    }
}
