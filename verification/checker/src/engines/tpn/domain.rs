//! The times left of the enabled transitions of a class: difference bound matrices, numbered.
//!
//! A matrix over n transitions has n + 1 rows and columns, the first of which stands for zero.
//! Entry (i, j) is the upper bound of xᵢ - xⱼ, as tight as it can be: the shortest path from i to
//! j. This form is canonical, so two sets of times are equal iff their matrices are.

use super::bound::Bound;
use super::index::{Index, hash, room, taken};
use super::markings::{ANEW, Rules};

/// Matrices so large are looked at when invariants are checked; larger ones take too long.
const LOOKED_AT: usize = 6;

/// A matrix in work.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Domain {
    /// One more than there are transitions.
    pub(super) size: usize,
    entries: Vec<Bound>,
}

impl Domain {
    /// The times of transitions that all became enabled just now.
    pub(super) fn of_new(rules: &Rules, enabled: &[u32]) -> Self {
        let intervals: Vec<_> = enabled.iter().map(|&it| rules.intervals[it as usize]).collect();
        let mut domain = Self::default();
        domain.fill(&[&[(Bound::ZERO, Bound::ZERO)], &*intervals].concat());
        domain
    }

    /// How many bytes it takes to fire in a domain of so many transitions; `None`: too many to
    /// count.
    pub(super) fn bytes(transitions: usize) -> Option<usize> {
        let size = transitions.checked_add(1)?;
        size.checked_mul(size)?.checked_mul(3 * size_of::<Bound>())
    }

    /// Bounds of each time alone, as if they had nothing to do with each other.
    fn fill(&mut self, bounds: &[(Bound, Bound)]) {
        self.size = bounds.len();
        self.entries.clear();
        for (row, &(_, upper)) in bounds.iter().enumerate() {
            self.entries.extend(bounds.iter().map(|&(lower, _)| upper.plus(lower)));
            self.entries[row * bounds.len() + row] = Bound::ZERO;
        }
    }

    /// The upper bounds of the time in a row minus each time.
    #[inline]
    pub(super) fn row(&self, row: usize) -> &[Bound] {
        &self.entries[row * self.size..][..self.size]
    }

    /// The upper bound of the time of a row minus that of a column.
    #[inline]
    pub(super) fn at(&self, row: usize, column: usize) -> Bound {
        self.entries[row * self.size + column]
    }

    /// For each column the least entry but for the first row: bounds of the first firing minus each
    /// time. The transition of a column can fire first iff its bound is zero.
    pub(super) fn first(&self, least: &mut Vec<Bound>) {
        least.clear();
        least.resize(self.size, Bound::INFINITE);
        for row in 1..self.size {
            for (least, &entry) in least.iter_mut().zip(self.row(row)) {
                *least = entry.min(*least);
            }
        }
    }

    /// The times after a firing at position `fired`, counted from 1. `first` is of the domain
    /// before, `kept` and `enabled` of the step.
    ///
    /// Let f fire first: xf <= xₖ for all k, so a shortest path may use an edge of weight 0 from f
    /// to any k, once. With times counted from f on, f is the new zero. So the bound of xᵢ from
    /// above is that of xᵢ - xf, from below the shortest path from f, which is `first`; a
    /// difference keeps its bound, or its path goes through f. This takes a step for each entry,
    /// and no search for shortest paths.
    pub(super) fn fire(
        &self,
        rules: &Rules,
        (fired, first): (usize, &[Bound]),
        (kept, enabled): (&[u32], &[u32]),
        bounds: &mut Vec<(Bound, Bound)>,
        after: &mut Self,
    ) {
        debug_assert_eq!(kept.len(), enabled.len());
        debug_assert!(first[fired] == Bound::ZERO, "it can fire first");
        bounds.clear();
        bounds.push((Bound::ZERO, Bound::ZERO));
        bounds.extend(kept.iter().zip(enabled).map(|(&before, &transition)| {
            if before == ANEW {
                rules.intervals[transition as usize]
            } else {
                (first[before as usize + 1], self.at(before as usize + 1, fired))
            }
        }));
        after.fill(bounds);
        for (row, &row_before) in (1..).zip(kept).filter(|&(_, &before)| before != ANEW) {
            let old = self.row(row_before as usize + 1);
            let new = &mut after.entries[row * after.size + 1..][..kept.len()];
            for (entry, &before) in new.iter_mut().zip(kept) {
                if before != ANEW {
                    *entry = old[before as usize + 1].min(*entry);
                }
            }
        }
        debug_assert!(after.size > LOOKED_AT || after.is_tight());
    }

    /// Whether there are such times, and no bound can be tighter.
    fn is_tight(&self) -> bool {
        let rows = || 0..self.size;
        rows().all(|row| self.at(row, row) == Bound::ZERO)
            && rows().all(|row| {
                rows().all(|to| {
                    rows().all(|by| self.at(row, to) <= self.at(row, by).plus(self.at(by, to)))
                })
            })
    }
}

/// Matrices that were met so far, stored in as few bytes as the bounds of the net allow.
#[derive(Debug)]
pub(super) struct Domains {
    index: Index,
    starts: Vec<usize>,
    entries: Entries,
}

#[derive(Debug)]
enum Entries {
    Short(Vec<i16>),
    Middle(Vec<i32>),
    Long(Vec<i64>),
}

/// An integer that bounds are stored in; its largest value stands for no bound.
trait Stored: Copy + PartialEq + TryFrom<i64> + Into<i64> {
    const MAX: Self;
}

impl Stored for i16 {
    const MAX: Self = i16::MAX;
}

impl Stored for i32 {
    const MAX: Self = i32::MAX;
}

impl Stored for i64 {
    const MAX: Self = i64::MAX;
}

fn stored<T: Stored>(bound: Bound) -> T {
    T::try_from(bound.code()).unwrap_or(T::MAX)
}

fn bound<T: Stored>(stored: T) -> Bound {
    if stored == T::MAX { Bound::INFINITE } else { Bound::from_code(stored.into()) }
}

impl Domains {
    /// Makes an empty store, of a net with these intervals.
    pub(super) fn new(rules: &Rules) -> Self {
        let bounds = rules.intervals.iter().flat_map(|&(lower, upper)| [lower, upper]);
        let finite =
            bounds.filter_map(|it| it.value().map(|_| it.code().unsigned_abs())).max().unwrap_or(0);
        let entries = match finite {
            0..0x7fff => Entries::Short(Vec::new()),
            0x7fff..0x7fff_ffff => Entries::Middle(Vec::new()),
            _ => Entries::Long(Vec::new()),
        };
        Self { index: Index::new(), starts: vec![0], entries }
    }

    /// The number of a domain.
    pub(super) fn number(&mut self, domain: &Domain) -> u32 {
        let hash = hash(domain.entries.iter().map(|it| it.code().cast_unsigned()));
        let next = self.starts.len() as u32 - 1;
        let Self { starts, entries, index } = self;
        let range = |number: u32| starts[number as usize]..starts[number as usize + 1];
        let found = match entries {
            Entries::Short(all) => {
                index.find_or_insert(hash, next, |it| same(&all[range(it)], domain))
            }
            Entries::Middle(all) => {
                index.find_or_insert(hash, next, |it| same(&all[range(it)], domain))
            }
            Entries::Long(all) => {
                index.find_or_insert(hash, next, |it| same(&all[range(it)], domain))
            }
        };
        if let Some(found) = found {
            return found;
        }
        room(starts, 1);
        starts.push(match entries {
            Entries::Short(all) => push(all, domain),
            Entries::Middle(all) => push(all, domain),
            Entries::Long(all) => push(all, domain),
        });
        next
    }

    /// The domain of a number, over this many transitions.
    pub(super) fn load(&self, number: u32, transitions: usize, into: &mut Domain) {
        let range = self.starts[number as usize]..self.starts[number as usize + 1];
        into.size = transitions + 1;
        into.entries.clear();
        match &self.entries {
            Entries::Short(all) => into.entries.extend(all[range].iter().map(|&it| bound(it))),
            Entries::Middle(all) => into.entries.extend(all[range].iter().map(|&it| bound(it))),
            Entries::Long(all) => into.entries.extend(all[range].iter().map(|&it| bound(it))),
        }
        debug_assert_eq!(into.entries.len(), into.size * into.size);
    }

    pub(super) fn bytes(&self) -> usize {
        let entries = match &self.entries {
            Entries::Short(all) => taken(all),
            Entries::Middle(all) => taken(all),
            Entries::Long(all) => taken(all),
        };
        entries + taken(&self.starts) + self.index.bytes()
    }
}

fn same<T: Stored>(entries: &[T], domain: &Domain) -> bool {
    entries.len() == domain.entries.len()
        && entries.iter().zip(&domain.entries).all(|(&a, &b)| a == stored(b))
}

fn push<T: Stored>(entries: &mut Vec<T>, domain: &Domain) -> usize {
    debug_assert!(domain.entries.iter().all(|&it| bound(stored::<T>(it)) == it), "none is cut");
    room(entries, domain.entries.len());
    entries.extend(domain.entries.iter().map(|&it| stored::<T>(it)));
    entries.len()
}
