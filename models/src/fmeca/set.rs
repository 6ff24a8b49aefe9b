//! Sets of places in a list, one bit each.

/// A set of places in a list: of the flags, the failure modes or the probes of an analysis.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Set(Vec<u64>);

impl Set {
    /// The empty set of places in a list of this length.
    #[must_use]
    pub fn none(length: usize) -> Self {
        Self(vec![0; length.div_ceil(64)])
    }

    /// All places in a list of this length.
    #[must_use]
    pub fn all(length: usize) -> Self {
        Self::of(length, 0..length)
    }

    /// These places in a list of this length; places behind its end are left out.
    #[must_use]
    pub fn of(length: usize, places: impl IntoIterator<Item = usize>) -> Self {
        let mut set = Self::none(length);
        places.into_iter().filter(|&it| it < length).for_each(|it| set.insert(it));
        set
    }

    /// Adds a place of the list.
    pub(super) fn insert(&mut self, place: usize) {
        if let Some(word) = self.0.get_mut(place / 64) {
            *word |= 1 << (place % 64);
        }
    }

    pub(super) fn remove(&mut self, place: usize) {
        if let Some(word) = self.0.get_mut(place / 64) {
            *word &= !(1 << (place % 64));
        }
    }

    /// Whether it holds a place.
    #[must_use]
    pub fn has(&self, place: usize) -> bool {
        self.0.get(place / 64).is_some_and(|word| word & (1 << (place % 64)) != 0)
    }

    /// Whether it holds all of another set.
    #[must_use]
    pub fn covers(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(one, other)| other & !one == 0)
    }

    fn with(&self, other: &Self, word: impl Fn(u64, u64) -> u64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(&one, &other)| word(one, other)).collect())
    }

    /// Returns the union.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        self.with(other, |one, other| one | other)
    }

    /// Returns the intersection.
    #[must_use]
    pub fn common(&self, other: &Self) -> Self {
        self.with(other, |one, other| one & other)
    }

    /// Returns the members of this set that are not in the other.
    #[must_use]
    pub fn without(&self, other: &Self) -> Self {
        self.with(other, |one, other| one & !other)
    }

    /// How many words it takes: what an operation costs.
    pub(super) fn words(&self) -> usize {
        self.0.len()
    }

    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }

    /// How many places it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Iterates over the places in the set, the first one first.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().enumerate().flat_map(|(at, &word)| {
            (0..64).filter(move |bit| word & (1 << bit) != 0).map(move |bit| at * 64 + bit)
        })
    }
}
