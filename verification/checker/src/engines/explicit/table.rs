//! The set of markings that were reached: open addressing over packed markings, without anything
//! else.

/// How many tables there are, each with a lock and a size of its own: no growth doubles the whole
/// set.
pub(super) const TABLES: usize = 64;

/// Markings that are looked up at once: their loads overlap.
pub(super) const BATCH: usize = 256;

/// A hash whose upper bits say which table and where in it.
#[inline]
pub(super) fn hash<const S: usize>(marking: &[u64; S]) -> u64 {
    let mut hash = 0;
    for word in marking {
        let product = u128::from(hash ^ word) * 0x9e37_79b9_7f4a_7c15;
        hash = (product >> 64) as u64 ^ product as u64;
    }
    hash
}

/// The table of a marking.
#[inline]
pub(super) fn table_of(hash: u64) -> usize {
    (hash >> (64 - TABLES.trailing_zeros())) as usize
}

/// One of the tables. A slot is empty when its first word is zero.
#[derive(Debug)]
pub(super) struct Table<const S: usize> {
    slots: Vec<[u64; S]>,
    used: usize,
}

impl<const S: usize> Table<S> {
    /// Slots of the smallest table whose pages the system can remap: 128 KiB.
    const SMALL: usize = (1 << 17) / size_of::<[u64; S]>();

    pub(super) const fn new() -> Self {
        Self { slots: Vec::new(), used: 0 }
    }

    /// The table of these markings; those that cannot be one are left out.
    pub(super) fn of(mut markings: Vec<[u64; S]>) -> Self {
        markings.retain(|it| it[0] != 0);
        let mut table = Self::new();
        if table.grow(2 * markings.len() + 1) {
            markings.chunks(BATCH).for_each(|it| table.insert(it, |_| ()));
        }
        table
    }

    /// How many slots are needed for so many more markings, if there are not enough.
    pub(super) fn grown(&self, more: usize) -> Option<usize> {
        let used = self.used + more;
        // Few steps while tables are small: on Kanban(5) the process takes 4 MB less.
        let grown = if self.slots.len() < Self::SMALL {
            self.slots.len() * 4
        } else {
            self.slots.len() * 7 / 5
        };
        (used * 5 > self.slots.len() * 4).then(|| grown.max(used * 7 / 5).max(16))
    }

    /// Bytes of so many slots.
    pub(super) const fn bytes(slots: usize) -> usize {
        slots * size_of::<[u64; S]>()
    }

    pub(super) fn slots(&self) -> usize {
        self.slots.len()
    }

    /// Grows to so many slots, if the system has memory for them; returns whether it has.
    ///
    /// Slots grow where they are: a system that can remap pages copies nothing, and memory is not
    /// torn to pieces.
    pub(super) fn grow(&mut self, slots: usize) -> bool {
        let before = self.slots.len();
        debug_assert!(slots > self.used.max(before), "a table keeps a free slot, and grows only");
        if self.slots.try_reserve_exact(slots - before).is_err() {
            return false;
        }
        self.slots.resize(slots, [0; S]);
        // From the last one down, each moves up to where it belongs, past those that moved before.
        // Some wait: a few at the start, which belong where others have not moved yet, and those
        // that find no place before the end.
        let mut late = Vec::new();
        for from in (0..before).rev() {
            let marking = std::mem::replace(&mut self.slots[from], [0; S]);
            if marking[0] == 0 {
                continue;
            }
            let home = self.home(&marking);
            let free = (home.max(from)..slots).find(|at| self.slots[*at][0] == 0);
            match free.filter(|_| home >= from) {
                Some(at) => self.slots[at] = marking,
                None => late.push(marking),
            }
        }
        for marking in late {
            let mut at = self.home(&marking);
            while self.slots[at][0] != 0 {
                at = if at + 1 == slots { 0 } else { at + 1 };
            }
            self.slots[at] = marking;
        }
        debug_assert_eq!(self.slots.iter().filter(|it| it[0] != 0).count(), self.used);
        true
    }

    #[inline]
    fn home(&self, marking: &[u64; S]) -> usize {
        let within = hash(marking) << TABLES.trailing_zeros();
        ((u128::from(within) * self.slots.len() as u128) >> 64) as usize
    }

    /// Adds markings, at most [`BATCH`] of them, for which there is room, and calls `new` with the
    /// positions of those that were not there.
    pub(super) fn insert(&mut self, markings: &[[u64; S]], mut new: impl FnMut(usize)) {
        debug_assert!(markings.len() <= BATCH && markings.iter().all(|it| it[0] != 0));
        debug_assert!(self.used + markings.len() < self.slots.len(), "there is room");
        // Most markings are there already, and most of those where they belong: no branch on the
        // way.
        let mut open = [(0_u32, 0_u32); BATCH];
        let mut count = 0;
        for (at, marking) in markings.iter().enumerate().take(BATCH) {
            let home = self.home(marking);
            open[count] = (home as u32, at as u32);
            count += usize::from(self.slots[home] != *marking);
        }
        for &(home, at) in &open[..count] {
            let (mut slot, marking) = (home as usize, &markings[at as usize]);
            while self.slots[slot] != *marking {
                if self.slots[slot][0] == 0 {
                    self.slots[slot] = *marking;
                    self.used += 1;
                    new(at as usize);
                    break;
                }
                slot = if slot + 1 == self.slots.len() { 0 } else { slot + 1 };
            }
        }
    }

    /// Whether a marking is there.
    pub(super) fn contains(&self, marking: &[u64; S]) -> bool {
        if self.slots.is_empty() {
            return false;
        }
        let mut slot = self.home(marking);
        while self.slots[slot][0] != 0 {
            if self.slots[slot] == *marking {
                return true;
            }
            slot = if slot + 1 == self.slots.len() { 0 } else { slot + 1 };
        }
        false
    }
}
