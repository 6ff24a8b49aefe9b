//! Bounds of places that the structure of a net proves, whatever its behaviour.
//!
//! A weighted sum of tokens that no transition increases never exceeds its value at the start, and
//! no place in it its share of that. Such sums are found by the method of Farkas: start with each
//! place alone, and combine sums until no transition increases any of them.

use crate::explicit::{Limit, Limits};
use cotama_property::integer::gcd;
use cotama_property::pt::Pt;
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::rc::Rc;

/// The most sums that are kept at a time, and that one transition may add.
const SUMS: usize = 2_000;
/// Numbers that may be looked at: some tenths of a second.
const WORK: usize = 50_000_000;
/// Numbers between two looks at the clock: some milliseconds.
const TICK: usize = 1 << 18;
/// Bytes of a number in the two lists that have it, and of a sum beside its numbers.
const NUMBER: u64 = 20;
const SUM: u64 = 160;

/// For each place the most tokens that it can hold by the sums found; `None` where none was found.
///
/// What is found is proved. The search is cut off on nets with very many sums, so not everything
/// that is true is found.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_checker::bounds::bounds;
/// use cotama_verification::pt::Pt;
///
/// let mut net = OwnedNet::new("lamp", "A lamp that counts.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// let count = net.place(OwnedPlace::new("count", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1).give(count, 1)).unwrap();
/// net.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// assert_eq!(bounds(&Pt::from(&net.view().net())), [Some(1), Some(1), None]);
/// ```
pub fn bounds(pt: &Pt) -> &[Option<u32>] {
    bounds_within(pt, &Limits::default()).unwrap_or_default()
}

/// The same within a time and a memory. With less memory less is found; what was found first is
/// kept with the net.
///
/// # Errors
/// Time is up.
pub(crate) fn bounds_within<'p>(pt: &'p Pt, limits: &Limits) -> Result<&'p [Option<u32>], Limit> {
    if let Some(known) = pt.bounds.get() {
        return Ok(known);
    }
    let found = proved(pt, limits)?;
    Ok(pt.bounds.get_or_store(found))
}

fn proved(pt: &Pt, limits: &Limits) -> Result<Vec<Option<u32>>, Limit> {
    let mut bounds = single(pt);
    if bounds.iter().all(Option::is_some) {
        return Ok(bounds);
    }
    for sum in sums(pt, &bounds, limits)?.iter().filter(|it| it.grows.iter().all(|&(_, by)| by < 0))
    {
        let at_start = |&(place, weight): &(u32, i64)| {
            u128::from(weight.unsigned_abs()) * u128::from(pt.initial[place as usize])
        };
        let total: u128 = sum.weights.iter().map(at_start).sum();
        for &(place, weight) in &sum.weights {
            let bound = u32::try_from(total / u128::from(weight.unsigned_abs())).ok();
            let known = &mut bounds[place as usize];
            *known = match (*known, bound) {
                (Some(known), Some(bound)) => Some(bound.min(known)),
                (known, bound) => known.or(bound),
            };
        }
    }
    let holds = |(bound, tokens): (&Option<u32>, &u32)| bound.is_none_or(|it| it >= *tokens);
    debug_assert!(bounds.iter().zip(&pt.initial).all(holds), "the initial marking is within them");
    Ok(bounds)
}

/// Bounds of the places of each component of the net that has one token at most, and in which no
/// transition increases the number of tokens: no other sum says more.
fn single(pt: &Pt) -> Vec<Option<u32>> {
    let mut parts = Parts((0..pt.places.len() as u32).collect());
    let transitions = 0..pt.transitions.len() as u32;
    for transition in transitions.clone() {
        if let Some((first, others)) = pt.effects.of(transition).split_first() {
            others.iter().for_each(|it| parts.unite(first.0, it.0));
        }
    }
    let mut tokens = vec![0_u64; pt.places.len()];
    for place in 0..pt.places.len() as u32 {
        tokens[parts.of(place) as usize] += u64::from(pt.initial[place as usize]);
    }
    for transition in transitions {
        let effects = pt.effects.of(transition);
        if effects.iter().map(|it| i128::from(it.1)).sum::<i128>() > 0 {
            tokens[parts.of(effects[0].0) as usize] = u64::MAX;
        }
    }
    let mut bound =
        |place| u32::try_from(tokens[parts.of(place) as usize]).ok().filter(|it| *it <= 1);
    (0..pt.places.len() as u32).map(&mut bound).collect()
}

/// Sets without a common member, each with one that stands for it.
struct Parts(Vec<u32>);

impl Parts {
    fn of(&mut self, mut it: u32) -> u32 {
        while self.0[it as usize] != it {
            self.0[it as usize] = self.0[self.0[it as usize] as usize];
            it = self.0[it as usize];
        }
        it
    }

    fn unite(&mut self, one: u32, other: u32) {
        let (one, other) = (self.of(one), self.of(other));
        self.0[one.max(other) as usize] = one.min(other);
    }
}

/// A weighted sum of tokens, and by how much each transition changes it. Lists are sorted.
#[derive(Clone, Debug)]
struct Sum {
    weights: Vec<(u32, i64)>,
    grows: Vec<(u32, i64)>,
    /// A bit for each place modulo 64: a quick test whether places of one sum are among those of
    /// another.
    places: u64,
}

/// The sums that are kept, and what is known of them to find the next step fast.
struct Sums<'p> {
    /// For each place the tokens at the start.
    initial: &'p [u32],
    /// In the order in which they were made; `None` for those that were given up.
    all: Vec<Option<Rc<Sum>>>,
    kept: usize,
    /// For each transition the sums that it changes, and maybe some that were given up.
    changed: Vec<Vec<u32>>,
    /// For each place the sums whose first place it is, and maybe some that were given up.
    first: Vec<Vec<u32>>,
    costs: Vec<Cost>,
    /// The transitions that increase some sum, the cheapest first, with the costs under which they
    /// are listed.
    open: BTreeSet<(Cost, u32)>,
    listed: Vec<Cost>,
    /// Transitions whose costs have changed since they were listed.
    stale: Vec<u32>,
    /// Transitions that increase no sum any more.
    settled: Vec<bool>,
    /// Numbers that were looked at.
    work: usize,
    /// Bytes of the sums that are kept.
    bytes: u64,
}

/// The cost of a transition that may increase no sum: the number of pairs, and the length of all
/// their sums.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Cost {
    pairs: usize,
    length: usize,
    up: usize,
    down: usize,
}

/// Two sums to be combined: all combinations at once would take more memory than all that are kept.
struct Pair {
    up: Rc<Sum>,
    down: Rc<Sum>,
    /// How many places the combination has.
    length: usize,
    /// The inequality that this combination makes redundant, if any.
    replaces: Option<usize>,
}

fn sums(pt: &Pt, known: &[Option<u32>], limits: &Limits) -> Result<Vec<Rc<Sum>>, Limit> {
    let (places, transitions) = (pt.places.len(), pt.transitions.len());
    let mut sums = Sums {
        initial: &pt.initial,
        all: Vec::new(),
        kept: 0,
        changed: vec![Vec::new(); transitions],
        first: vec![Vec::new(); places],
        costs: vec![Cost::default(); transitions],
        open: BTreeSet::new(),
        listed: vec![Cost::default(); transitions],
        stale: Vec::new(),
        settled: vec![false; transitions],
        work: 0,
        bytes: 0,
    };
    let mut looked = 0;
    // No sum has places of more than one component.
    for place in (0..places as u32).filter(|&it| known[it as usize].is_none()) {
        let grows = pt.changers.of(place).to_vec();
        sums.keep(Sum { weights: vec![(place, 1)], grows, places: 1 << (place % 64) });
    }
    while let Some(transition) = sums.cheapest().filter(|_| sums.work < WORK) {
        for pair in sums.settle(transition) {
            if sums.work >= looked + TICK {
                looked = sums.work;
                if limits.is_over() {
                    return Err(Limit::Time);
                }
            }
            let Some(sum) = balanced(&pair.up, &pair.down, transition) else { continue };
            sums.work += sum.weights.len() + sum.grows.len();
            let has_room = sums.bytes + sum.bytes() <= limits.bytes / 2;
            if sums.kept < places + SUMS && has_room && !sums.has_within(&sum) {
                sums.keep(sum);
                sums.give_up(pair.replaces);
            }
        }
    }
    Ok(sums.all.into_iter().flatten().collect())
}

impl Sums<'_> {
    fn keep(&mut self, sum: Sum) {
        let number = self.all.len() as u32;
        debug_assert!(sum.weights.iter().all(|it| it.1 > 0), "sums have no negative weights");
        debug_assert!(sum.weights.is_sorted_by_key(|it| it.0));
        debug_assert!(sum.grows.is_sorted_by_key(|it| it.0));
        self.first[sum.weights[0].0 as usize].push(number);
        for &(transition, _) in &sum.grows {
            self.changed[transition as usize].push(number);
        }
        self.count(&sum, usize::wrapping_add);
        self.kept += 1;
        self.bytes += sum.bytes();
        self.all.push(Some(Rc::new(sum)));
    }

    /// Counts a sum in, or out, of the costs of the transitions that change it.
    fn count(&mut self, sum: &Sum, change: fn(usize, usize) -> usize) {
        self.work += sum.grows.len();
        for &(transition, by) in &sum.grows {
            let cost = &mut self.costs[transition as usize];
            // A step changes the costs of a transition many times: it is listed anew once, when the
            // next one is looked for.
            if *cost == self.listed[transition as usize] {
                self.stale.push(transition);
            }
            let side = if by > 0 { &mut cost.up } else { &mut cost.down };
            *side = change(*side, 1);
            cost.length = change(cost.length, sum.weights.len());
            cost.pairs = cost.up * cost.down;
        }
    }

    /// The transition that increases some sum and costs least.
    fn cheapest(&mut self) -> Option<u32> {
        for transition in self.stale.drain(..) {
            let (cost, listed) =
                (self.costs[transition as usize], &mut self.listed[transition as usize]);
            self.open.remove(&(*listed, transition));
            *listed = cost;
            if cost.up > 0 {
                self.open.insert((cost, transition));
            }
        }
        self.open.first().map(|it| it.1)
    }

    fn give_up(&mut self, number: Option<usize>) {
        if let Some(sum) = number.and_then(|it| self.all[it].take()) {
            self.kept -= 1;
            self.bytes -= sum.bytes();
            self.count(&sum, usize::wrapping_sub);
        }
    }

    /// Whether a sum that grows by one transition adds nothing to another one that it is added to:
    /// no tokens at the start, and no growth by other transitions. So a long chain of places is not
    /// added up from each of them.
    fn adds_nothing(&self, up: &Sum) -> bool {
        up.weights.iter().all(|it| self.initial[it.0 as usize] == 0)
            && up.grows.iter().filter(|it| it.1 > 0).count() == 1
    }

    /// Gives up the sums that a transition increases; returns what takes their place, short ones
    /// first.
    fn settle(&mut self, transition: u32) -> Vec<Pair> {
        self.settled[transition as usize] = true;
        let (mut grown, mut shrunk) = (Vec::new(), Vec::new());
        for number in std::mem::take(&mut self.changed[transition as usize]) {
            let slot = &mut self.all[number as usize];
            match slot.as_ref().map(|it| change(it, transition) > 0) {
                Some(true) => grown.extend(slot.take()),
                Some(false) => shrunk.push(number as usize),
                None => {}
            }
        }
        self.kept -= grown.len();
        for sum in &grown {
            self.bytes -= sum.bytes();
            self.count(sum, usize::wrapping_sub);
        }
        let length = |it: usize| self.all[it].as_ref().map(|it| it.weights.len());
        while grown.len() * shrunk.len() > SUMS {
            // The shortest ones say most.
            if grown.len() > shrunk.len() {
                grown.sort_by_key(|it| it.weights.len());
                grown.truncate(grown.len() / 2);
            } else {
                shrunk.sort_by_key(|&it| length(it));
                shrunk.truncate(shrunk.len() / 2);
            }
        }
        let mut new = Vec::new();
        for up in &grown {
            let adds_nothing = self.adds_nothing(up);
            for &number in &shrunk {
                let Some(down) = &self.all[number] else { continue };
                let length = union(&up.weights, &down.weights);
                let (up, down) = (Rc::clone(up), Rc::clone(down));
                new.push(Pair { up, down, length, replaces: adds_nothing.then_some(number) });
            }
        }
        new.sort_by_key(|it| it.length);
        new
    }

    /// Whether some sum that is kept says all that this one says.
    fn has_within(&mut self, sum: &Sum) -> bool {
        sum.weights.iter().any(|&(place, _)| {
            let numbers = &mut self.first[place as usize];
            numbers.retain(|&it| self.all[it as usize].is_some());
            self.work += numbers.len();
            numbers
                .iter()
                .filter_map(|&it| self.all[it as usize].as_ref())
                .any(|it| it.is_within(sum, &self.settled))
        })
    }
}

fn change(sum: &Sum, transition: u32) -> i64 {
    sum.grows.binary_search_by_key(&transition, |it| it.0).map_or(0, |at| sum.grows[at].1)
}

/// By what two sums are multiplied so that a transition changes them by the same.
fn factors(up: &Sum, down: &Sum, transition: u32) -> Option<[i64; 2]> {
    let (a, b) = (change(down, transition).checked_neg()?, change(up, transition));
    let divisor = gcd(a.unsigned_abs(), b.unsigned_abs()).cast_signed();
    Some([a / divisor, b / divisor])
}

/// The smallest combination of a sum that grows and one that shrinks that does neither; `None` when
/// numbers get too large.
fn balanced(up: &Sum, down: &Sum, transition: u32) -> Option<Sum> {
    let [a, b] = factors(up, down, transition)?;
    let mut weights = combined(&up.weights, a, &down.weights, b)?;
    let mut grows = combined(&up.grows, a, &down.grows, b)?;
    let mut all = 0;
    for (_, it) in weights.iter().chain(&grows) {
        all = gcd(it.unsigned_abs(), all);
        if all == 1 {
            break;
        }
    }
    let all = all.cast_signed();
    if all > 1 {
        weights.iter_mut().chain(&mut grows).for_each(|it| it.1 /= all);
    }
    weights.shrink_to_fit();
    grows.shrink_to_fit();
    Some(Sum { weights, grows, places: up.places | down.places })
}

/// How many ids are in one of the two lists.
fn union(first: &[(u32, i64)], second: &[(u32, i64)]) -> usize {
    let (mut at, mut common) = (0, 0);
    for (id, _) in first {
        while second.get(at).is_some_and(|it| it.0 < *id) {
            at += 1;
        }
        common += usize::from(second.get(at).is_some_and(|it| it.0 == *id));
    }
    first.len() + second.len() - common
}

/// `a` times the first list plus `b` times the second; `None` when a number passes 63 bits.
pub(crate) fn combined(
    first: &[(u32, i64)],
    a: i64,
    second: &[(u32, i64)],
    b: i64,
) -> Option<Vec<(u32, i64)>> {
    let mut all = Vec::with_capacity(first.len() + second.len());
    let (mut i, mut j) = (0, 0);
    while let (Some(&(x, one)), Some(&(y, two))) = (first.get(i), second.get(j)) {
        let sum = match x.cmp(&y) {
            Ordering::Less => a.checked_mul(one)?,
            Ordering::Greater => b.checked_mul(two)?,
            Ordering::Equal => a.checked_mul(one)?.checked_add(b.checked_mul(two)?)?,
        };
        i += usize::from(x <= y);
        j += usize::from(y <= x);
        if sum != 0 {
            all.push((x.min(y), sum));
        }
    }
    for (rest, by) in [(&first[i..], a), (&second[j..], b)] {
        for &(id, it) in rest.iter().filter(|_| by != 0) {
            all.push((id, it.checked_mul(by)?));
        }
    }
    Some(all)
}

impl Sum {
    fn bytes(&self) -> u64 {
        (self.weights.len() + self.grows.len()) as u64 * NUMBER + SUM
    }

    /// Whether the places of this sum, and the settled transitions that decrease it, are among
    /// those of the other one: then the other one says nothing new.
    fn is_within(&self, other: &Self, settled: &[bool]) -> bool {
        self.places & !other.places == 0
            && self.weights.len() <= other.weights.len()
            && among(self.weights.iter().map(|it| it.0), &other.weights)
            && among(
                self.grows.iter().map(|it| it.0).filter(|&it| settled[it as usize]),
                &other.grows,
            )
    }
}

fn among(mut ids: impl Iterator<Item = u32>, list: &[(u32, i64)]) -> bool {
    ids.all(|id| list.binary_search_by_key(&id, |it| it.0).is_ok())
}
