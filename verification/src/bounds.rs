//! Bounds of places that the structure of a net proves, whatever its behaviour.
//!
//! A weighted sum of tokens that no transition increases never exceeds its value at the start, and no place in it its
//! share of that. Such sums are found by the method of Farkas: start with each place alone, and combine sums until no
//! transition increases any of them.

use crate::pt::Pt;
use std::cmp::Ordering;

/// The most sums that are kept at a time, and that one transition may add.
const SUMS: usize = 2_000;
/// Numbers that may be looked at: some tenths of a second.
const WORK: usize = 50_000_000;

/// For each place the most tokens that it can hold by the sums found; `None` where none was found.
///
/// What is found is proved. The search is cut off on nets with very many sums, so not everything that is true is found.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{bounds::bounds, pt::Pt};
///
/// let mut net = OwnedNet::new("lamp", "A lamp that counts.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// let count = net.place(OwnedPlace::new("count", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1).give(count, 1)).unwrap();
/// net.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// assert_eq!(bounds(&Pt::from(&net.view().net())), [Some(1), Some(1), None]);
/// ```
pub fn bounds(pt: &Pt) -> Vec<Option<u32>> {
    let mut bounds = vec![None; pt.places.len()];
    for sum in sums(pt).iter().filter(|it| it.grows.iter().all(|&(_, by)| by < 0)) {
        let at_start = |&(place, weight): &(u32, i64)| weight as u128 * pt.initial[place as usize] as u128;
        let total: u128 = sum.weights.iter().map(at_start).sum();
        for &(place, weight) in &sum.weights {
            let bound = u32::try_from(total / weight as u128).ok();
            let known = &mut bounds[place as usize];
            *known = match (*known, bound) {
                (Some(known), Some(bound)) => Some(bound.min(known)),
                (known, bound) => known.or(bound),
            };
        }
    }
    bounds
}

/// A weighted sum of tokens, and by how much each transition changes it. Lists are sorted.
#[derive(Clone, Debug)]
struct Sum {
    weights: Vec<(u32, i64)>,
    grows: Vec<(u32, i64)>,
    /// A bit for each place modulo 64: a quick test whether places of one sum are among those of another.
    places: u64,
}

fn sums(pt: &Pt) -> Vec<Sum> {
    let mut sums: Vec<Sum> = (0..pt.places.len() as u32)
        .map(|place| Sum {
            weights: vec![(place, 1)],
            grows: pt.changers.of(place).to_vec(),
            places: 1 << (place % 64),
        })
        .collect();
    let mut settled = vec![false; pt.transitions.len()];
    let mut work = 0;
    while work < WORK {
        let Some(transition) = cheapest(&sums, settled.len(), &mut work) else { break };
        settled[transition as usize] = true;
        let (mut grown, mut kept): (Vec<_>, Vec<_>) =
            sums.into_iter().partition(|it| change(it, transition) > 0);
        let mut shrunk: Vec<usize> = (0..kept.len()).filter(|&at| change(&kept[at], transition) < 0).collect();
        while grown.len() * shrunk.len() > SUMS {
            // The shortest ones say most.
            if grown.len() > shrunk.len() {
                grown.sort_by_key(|it| it.weights.len());
                grown.truncate(grown.len() / 2);
            } else {
                shrunk.sort_by_key(|&it| kept[it].weights.len());
                shrunk.truncate(shrunk.len() / 2);
            }
        }
        let mut new: Vec<Sum> = grown
            .iter()
            .flat_map(|up| shrunk.iter().map(move |&down| (up, down)))
            .filter_map(|(up, down)| balanced(up, &kept[down], transition))
            .collect();
        new.sort_by_key(|it| it.weights.len());
        for sum in new {
            work += sum.weights.len() + sum.grows.len() + kept.len();
            if kept.len() < pt.places.len() + SUMS && !kept.iter().any(|it| it.is_within(&sum, &settled)) {
                kept.push(sum);
            }
        }
        sums = kept;
    }
    sums
}

/// The transition that increases some sum and needs the fewest combinations.
fn cheapest(sums: &[Sum], transitions: usize, work: &mut usize) -> Option<u32> {
    let mut counts = vec![(0_usize, 0_usize); transitions];
    for &(transition, by) in sums.iter().flat_map(|it| &it.grows) {
        let (up, down) = &mut counts[transition as usize];
        *if by > 0 { up } else { down } += 1;
        *work += 1;
    }
    let growing = (0..transitions).filter(|&it| counts[it].0 > 0);
    growing.min_by_key(|&it| counts[it].0 * counts[it].1).map(|it| it as u32)
}

fn change(sum: &Sum, transition: u32) -> i64 {
    sum.grows.binary_search_by_key(&transition, |it| it.0).map_or(0, |at| sum.grows[at].1)
}

/// The smallest combination of a sum that grows and one that shrinks that does neither; `None` when numbers get too
/// large.
fn balanced(up: &Sum, down: &Sum, transition: u32) -> Option<Sum> {
    let (a, b) = (change(down, transition).checked_neg()?, change(up, transition));
    let divisor = gcd(a as u64, b as u64) as i64;
    let (a, b) = (a / divisor, b / divisor);
    let mut weights = combined(&up.weights, a, &down.weights, b)?;
    let mut grows = combined(&up.grows, a, &down.grows, b)?;
    let all = weights.iter().chain(&grows).fold(0, |all, &(_, it)| gcd(all, it.unsigned_abs())) as i64;
    if all > 1 {
        weights.iter_mut().chain(&mut grows).for_each(|it| it.1 /= all);
    }
    Some(Sum { weights, grows, places: up.places | down.places })
}

/// `a` times the first list plus `b` times the second; `None` when a number passes 63 bits.
pub(crate) fn combined(
    first: &[(u32, i64)],
    a: i64,
    second: &[(u32, i64)],
    b: i64,
) -> Option<Vec<(u32, i64)>> {
    let mut all = Vec::with_capacity(first.len() + second.len());
    let (mut first, mut second) = (first.iter().peekable(), second.iter().peekable());
    loop {
        let order = match (first.peek(), second.peek()) {
            (Some((x, _)), Some((y, _))) => x.cmp(y),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (None, None) => return Some(all),
        };
        let one = if order == Ordering::Greater { None } else { first.next() };
        let two = if order == Ordering::Less { None } else { second.next() };
        let id = one.or(two)?.0;
        let scaled = |it: Option<&(u32, i64)>, by| it.map_or(Some(0), |it| it.1.checked_mul(by));
        match scaled(one, a)?.checked_add(scaled(two, b)?)? {
            0 => {}
            sum => all.push((id, sum)),
        }
    }
}

pub(crate) fn gcd(mut a: u64, mut b: u64) -> u64 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

impl Sum {
    /// Whether the places of this sum, and the settled transitions that decrease it, are among those of the other one: then
    /// the other one says nothing new.
    fn is_within(&self, other: &Self, settled: &[bool]) -> bool {
        self.places & !other.places == 0
            && self.weights.len() <= other.weights.len()
            && among(self.weights.iter().map(|it| it.0), &other.weights)
            && among(self.grows.iter().map(|it| it.0).filter(|&it| settled[it as usize]), &other.grows)
    }
}

fn among(mut ids: impl Iterator<Item = u32>, list: &[(u32, i64)]) -> bool {
    ids.all(|id| list.binary_search_by_key(&id, |it| it.0).is_ok())
}
