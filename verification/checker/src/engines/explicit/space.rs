//! A net made ready for search.

use super::Limit;
use super::enabling::Enabling;
use super::layout::{Layout, SIZES, Width};
use cotama_property::pt::Pt;

/// The most words of what transitions add.
const DELTAS: usize = 1 << 23;

/// The layout and tables of a net.
#[derive(Debug)]
pub(super) struct Space {
    pub(super) layout: Layout,
    pub(super) enabling: Enabling,
    /// For each transition what it adds to stored words.
    deltas: Vec<Vec<u64>>,
    /// For each transition the bits that it leaves before it adds; none without reset arcs.
    masks: Vec<Vec<u64>>,
}

/// How transitions change a marking of `S` words.
#[derive(Debug)]
pub(super) struct Firings<const S: usize> {
    deltas: Vec<[u64; S]>,
    masks: Vec<[u64; S]>,
}

impl<const S: usize> Firings<S> {
    /// The marking after a transition that is enabled.
    #[inline]
    pub(super) fn after(&self, marking: &[u64; S], transition: u32) -> [u64; S] {
        let delta = &self.deltas[transition as usize];
        match self.masks.get(transition as usize) {
            None => std::array::from_fn(|at| marking[at].wrapping_add(delta[at])),
            Some(mask) => {
                std::array::from_fn(|at| (marking[at] & mask[at]).wrapping_add(delta[at]))
            }
        }
    }

    /// For each transition the only marking that it can have fired in; `None` where reset arcs let
    /// it be any of several.
    pub(super) fn before(&self, marking: &[u64; S]) -> Option<Vec<[u64; S]>> {
        let before =
            |delta: &[u64; S]| std::array::from_fn(|at| marking[at].wrapping_sub(delta[at]));
        self.masks.is_empty().then(|| self.deltas.iter().map(before).collect())
    }
}

/// The guesses for these places were too small.
#[derive(Clone, Debug)]
pub(super) struct TooNarrow(pub(super) Vec<usize>);

impl Space {
    pub(super) fn new(pt: &Pt, widths: &[Width]) -> Option<Self> {
        let layout = Layout::new(pt, widths)?;
        if layout.stored * pt.transitions.len() > DELTAS {
            return None;
        }
        let enabling = Enabling::new(pt, &layout);
        let transitions = 0..pt.transitions.len() as u32;
        let deltas = transitions.clone().map(|it| layout.delta(pt, it)).collect();
        let resets = transitions.filter(|_| pt.has_resets());
        let masks = resets.map(|it| layout.mask(pt, it)).collect();
        Some(Self { layout, enabling, deltas, masks })
    }

    /// About how much memory it takes.
    pub(super) fn bytes(&self) -> u64 {
        let rows = self.deltas.len() + self.masks.len();
        let deltas = rows * (self.layout.stored * size_of::<u64>() + 24);
        self.enabling.bytes() + deltas as u64
    }

    /// How transitions change a marking of `S` words.
    pub(super) fn firings<const S: usize>(&self) -> Firings<S> {
        let array = |it: &Vec<u64>| std::array::from_fn(|at| it.get(at).copied().unwrap_or(0));
        Firings {
            deltas: self.deltas.iter().map(array).collect(),
            masks: self.masks.iter().map(array).collect(),
        }
    }

    /// The same for a marking of any number of words.
    pub(super) fn fire(&self, from: &[u64], transition: u32, after: &mut Vec<u64>) {
        let delta = &self.deltas[transition as usize];
        after.clear();
        match self.masks.get(transition as usize) {
            None => after.extend(from.iter().zip(delta).map(|(word, it)| word.wrapping_add(*it))),
            Some(mask) => {
                let kept = from.iter().zip(mask).map(|(word, mask)| word & mask);
                after.extend(kept.zip(delta).map(|(word, it)| word.wrapping_add(*it)));
            }
        }
    }

    /// The initial marking in `S` words.
    pub(super) fn initial<const S: usize>(&self) -> [u64; S] {
        std::array::from_fn(|at| self.layout.initial.get(at).copied().unwrap_or(0))
    }

    /// Whether some guess was too small for a marking in this union of all markings.
    pub(super) fn is_too_narrow(&self, union: &[u64]) -> bool {
        union.iter().zip(&self.layout.guards).any(|(union, guard)| union & guard != 0)
    }

    /// Whether a place has more tokens than are allowed in a marking of this union of all markings.
    ///
    /// # Errors
    /// Guesses were too small.
    pub(super) fn check(&self, union: &[u64]) -> Result<Option<Limit>, TooNarrow> {
        if !self.is_too_narrow(union) {
            return Ok(None);
        }
        let Layout { fields, guards, .. } = &self.layout;
        let hit = |&at: &usize| {
            let field = fields[at];
            guards.get(field.word).is_some_and(|guards| {
                union[field.word] & guards & (1 << (field.shift + field.width - 1)) != 0
            })
        };
        let places: Vec<usize> = (0..fields.len()).filter(hit).collect();
        let is_widest = |&at: &usize| fields[at].width > u32::BITS;
        if places.iter().any(is_widest) { Ok(Some(Limit::Tokens)) } else { Err(TooNarrow(places)) }
    }
}

/// A search in markings of some number of words.
pub(super) trait Search {
    /// The result of the search.
    type Found;

    /// Searches; or says that guesses were too small.
    fn search<const S: usize>(&mut self, space: Space) -> Result<Self::Found, TooNarrow>;
}

/// Searches with these widths, and widens places and starts again as long as guesses are too small.
///
/// # Errors
/// When a marking needs more words than there can be.
pub(super) fn search<T: Search>(
    pt: &Pt,
    mut widths: Vec<Width>,
    search: &mut T,
) -> Result<T::Found, Limit> {
    loop {
        let space = Space::new(pt, &widths).ok_or(Limit::Words)?;
        match sized(space, search) {
            Ok(found) => return Ok(found),
            Err(TooNarrow(places)) => {
                for place in places {
                    let bits = &mut widths[place].bits;
                    *bits = (2 * *bits).min(u32::BITS);
                }
            }
        }
    }
}

fn sized<T: Search>(space: Space, search: &mut T) -> Result<T::Found, TooNarrow> {
    let words = space.layout.stored;
    match words {
        _ if words <= SIZES[0] => search.search::<{ SIZES[0] }>(space),
        _ if words <= SIZES[1] => search.search::<{ SIZES[1] }>(space),
        _ if words <= SIZES[2] => search.search::<{ SIZES[2] }>(space),
        _ if words <= SIZES[3] => search.search::<{ SIZES[3] }>(space),
        _ if words <= SIZES[4] => search.search::<{ SIZES[4] }>(space),
        _ if words <= SIZES[5] => search.search::<{ SIZES[5] }>(space),
        _ if words <= SIZES[6] => search.search::<{ SIZES[6] }>(space),
        _ if words <= SIZES[7] => search.search::<{ SIZES[7] }>(space),
        _ if words <= SIZES[8] => search.search::<{ SIZES[8] }>(space),
        _ if words <= SIZES[9] => search.search::<{ SIZES[9] }>(space),
        _ if words <= SIZES[10] => search.search::<{ SIZES[10] }>(space),
        _ => search.search::<{ SIZES[11] }>(space),
    }
}
