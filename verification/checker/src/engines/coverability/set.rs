//! The minimal coverability set.

use super::search::{Order, Search};
use super::{FIRINGS, Limits, Sequence, Tokens, Unfinished};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;

/// The maximal ω-markings of a net, its minimal coverability set: for every reachable marking one
/// with at least as many tokens in each place, and for each of them and every number there is a
/// reachable marking with at least its tokens, and at least that number of them where it has ω.
///
/// ```
/// use cotama_verification::coverability::{CoverabilitySet, Limits};
/// use cotama_verification::tina;
/// let belt = tina::read("belt.net", b"tr put on -> on full  tr go on -> off  pl on (1)").unwrap();
/// let pt = belt.untimed();
/// let set = CoverabilitySet::new(&pt, &Limits::default()).unwrap();
/// let place = |name| pt.place(name).unwrap();
/// assert_eq!(set.bound(&[place("on"), place("off")]), Some(1));
/// assert_eq!(set.bound(&[place("full")]), None); // the belt fills for ever
/// assert_eq!(set.covers(&[(place("full"), 1_000), (place("off"), 1)]).unwrap().length, 1_001);
/// ```
#[derive(Debug)]
pub struct CoverabilitySet<'n> {
    search: Search<'n>,
    /// By marking.
    maximal: Vec<u32>,
}

impl<'n> CoverabilitySet<'n> {
    /// Finds it.
    ///
    /// # Errors
    /// When a limit is reached; of a net that [is not plain](Pt::is_plain) at once.
    pub fn new(pt: &'n Pt, limits: &Limits) -> Result<Self, Unfinished> {
        if !pt.is_plain() {
            return Err(Unfinished::UNSUITED);
        }
        let mut search = Search::new(pt, Order::Greatest);
        search.run(limits, &mut |_| false)?;
        Ok(Self { maximal: search.maximal(), search })
    }

    /// The maximal ω-markings, each by place, in ascending order.
    pub fn markings(&self) -> impl ExactSizeIterator<Item = &[Tokens]> {
        self.maximal.iter().map(|&it| self.search.marking(it))
    }

    /// How many ω-markings were met to find it.
    pub fn met(&self) -> u64 {
        self.search.nodes()
    }

    /// The most tokens that places, each named once, ever hold together; `None` when there is no
    /// most.
    pub fn bound(&self, places: &[PlaceId]) -> Option<u128> {
        let sum = |marking: &[Tokens]| {
            let tokens = places
                .iter()
                .map(|it| marking.get(it.0 as usize).copied().unwrap_or(Tokens::new(0)));
            tokens.map(|it| it.finite().map(u128::from)).sum::<Option<u128>>()
        };
        self.markings().map(sum).try_fold(0, |most, it| Some(it?.max(most)))
    }

    /// For each place the most tokens that it ever holds; ω when there is no most.
    pub fn bounds(&self) -> Vec<Tokens> {
        let places = 0..self.search.pt.places.len();
        places
            .map(|place| self.markings().map(|it| it[place]).max().unwrap_or(Tokens::new(0)))
            .collect()
    }

    /// A path to a marking with at least so many tokens; `None` when there is no such marking.
    pub fn covers(&self, target: &[(PlaceId, u64)]) -> Option<Sequence> {
        let demand = demand(self.search.pt, target)?;
        let is_covered = |it: &&u32| {
            self.search
                .marking(**it)
                .iter()
                .zip(&demand)
                .all(|(has, &needs)| *has >= Tokens::new(needs))
        };
        let id = *self.maximal.iter().find(is_covered)?;
        Some(
            self.search
                .sequence(id, demand, FIRINGS)
                .unwrap_or(Sequence { length: u128::MAX, firings: None }),
        )
    }

    /// A path to a marking that enables a transition; `None` when it can never fire.
    pub fn enables(&self, transition: TransitionId) -> Option<Sequence> {
        let needs = self.search.pt.needs.of(transition.0).iter();
        self.covers(
            &needs.map(|&(place, tokens)| (PlaceId(place), u64::from(tokens))).collect::<Vec<_>>(),
        )
    }

    /// Transitions that can never fire. A net without them is quasi-live.
    pub fn dead_transitions(&self) -> Vec<TransitionId> {
        let pt = self.search.pt;
        let is_enabled = |marking: &[Tokens], it: u32| {
            pt.needs
                .of(it)
                .iter()
                .all(|&(place, tokens)| marking[place as usize] >= Tokens::from(tokens))
        };
        let all = 0..pt.transitions.len() as u32;
        all.filter(|&it| !self.markings().any(|marking| is_enabled(marking, it)))
            .map(TransitionId)
            .collect()
    }
}

/// Tokens by place; `None` when a place is not of the net, or more tokens are asked for than can be
/// counted.
pub(super) fn demand(pt: &Pt, target: &[(PlaceId, u64)]) -> Option<Vec<u64>> {
    let mut demand = vec![0; pt.places.len()];
    for &(place, tokens) in target {
        let slot: &mut u64 = demand.get_mut(place.0 as usize)?;
        *slot = tokens.max(*slot);
    }
    Some(demand)
}
