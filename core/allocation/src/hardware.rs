//! Switchable hardware, counted in units: what the robot has, and what an alternative needs.

#[cfg(kani)]
pub mod proofs;

/// How many kinds of hardware a robot may have.
pub const MAX_KINDS: usize = 16;
/// How many units of one kind a robot may have.
pub const MAX_UNITS: u8 = 7;

/// The guard bit of each four-bit field.
const GUARDS: u64 = 0x8888_8888_8888_8888;

/// A number of units of each kind of hardware, 0 to 7 of each of 16 kinds, packed in eight bytes.
///
/// *Invariant:* the top bit of each four-bit field is clear, so that one subtraction compares all
/// kinds.
///
/// ```
/// use cotama_core::hardware::Equipment;
/// let sonar_and_two_lasers = Equipment::NONE.with(0, 1).unwrap().with(1, 2).unwrap();
/// let one_laser = Equipment::NONE.with(1, 1).unwrap();
/// assert!(sonar_and_two_lasers.covers(one_laser));
/// assert!(!one_laser.covers(sonar_and_two_lasers));
/// assert_eq!(sonar_and_two_lasers.of(1), 2);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Equipment(u64);

impl Equipment {
    /// No hardware at all.
    pub const NONE: Self = Self(0);

    /// The same with `count` units of `kind`; `None` beyond [`MAX_KINDS`] or [`MAX_UNITS`].
    #[must_use]
    pub const fn with(self, kind: usize, count: u8) -> Option<Self> {
        if kind >= MAX_KINDS || count > MAX_UNITS {
            return None;
        }
        let shift = 4 * kind as u32;
        Some(Self((self.0 & !(0xF << shift)) | ((count as u64) << shift)))
    }

    /// The units of `kind`; none beyond [`MAX_KINDS`].
    #[must_use]
    pub const fn of(self, kind: usize) -> u8 {
        if kind >= MAX_KINDS { 0 } else { (self.0 >> (4 * kind as u32)) as u8 & 0xF }
    }

    /// Whether there are at least `needs` units of every kind.
    #[must_use]
    pub const fn covers(self, needs: Self) -> bool {
        debug_assert!((self.0 | needs.0) & GUARDS == 0, "no kind borrows from the next");
        (self.0 | GUARDS).wrapping_sub(needs.0) & GUARDS == GUARDS
    }

    /// Per kind the larger number: what two options that run together need.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        let mut kind = 0;
        let mut packed = 0;
        while kind < MAX_KINDS {
            let (a, b) = (self.of(kind), other.of(kind));
            let larger = if a > b { a } else { b };
            packed |= (larger as u64) << (4 * kind as u32);
            kind += 1;
        }
        debug_assert!(packed & GUARDS == 0, "the larger of two counts is a count");
        Self(packed)
    }

    /// The same less `count` units of `kind`, and none where fewer were left.
    #[must_use]
    pub const fn without(self, kind: usize, count: u8) -> Self {
        match self.with(kind, self.of(kind).saturating_sub(count)) {
            Some(rest) => {
                debug_assert!(self.covers(rest), "what is left was there");
                rest
            }
            None => self,
        }
    }

    /// The packed fields, four bits a kind, for a table in flash.
    #[must_use]
    pub const fn to_bits(self) -> u64 {
        self.0
    }

    /// From packed fields; `None` when a guard bit is set.
    #[must_use]
    pub const fn from_bits(bits: u64) -> Option<Self> {
        if bits & GUARDS == 0 { Some(Self(bits)) } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn equipment() -> impl Strategy<Value = Equipment> {
        any::<u64>().prop_map(|bits| Equipment(bits & !GUARDS))
    }

    proptest! {
        #[test]
        fn covering_is_comparing_every_kind(have in equipment(), need in equipment()) {
            let each = (0..MAX_KINDS).all(|kind| have.of(kind) >= need.of(kind));
            prop_assert_eq!(have.covers(need), each);
        }

        #[test]
        fn a_union_is_the_least_that_covers_both(a in equipment(), b in equipment()) {
            let both = a.union(b);
            prop_assert!(both.covers(a) && both.covers(b));
            prop_assert!((0..MAX_KINDS).all(|k| both.of(k) == a.of(k) || both.of(k) == b.of(k)));
        }

        #[test]
        fn losing_units_never_touches_another_kind(
            a in equipment(), kind in 0..MAX_KINDS, count in 0..=MAX_UNITS
        ) {
            let rest = a.without(kind, count);
            prop_assert_eq!(rest.of(kind), a.of(kind).saturating_sub(count));
            prop_assert!((0..MAX_KINDS).all(|k| k == kind || rest.of(k) == a.of(k)));
        }
    }

    #[test]
    fn fields_beyond_the_packing_are_refused() {
        assert_eq!(Equipment::NONE.with(MAX_KINDS, 1), None);
        assert_eq!(Equipment::NONE.with(0, MAX_UNITS + 1), None);
        assert_eq!(Equipment::from_bits(8), None);
        assert_eq!(Equipment::from_bits(GUARDS), None);
        assert_eq!(Equipment::from_bits(0x7), Equipment::NONE.with(0, 7));
        assert_eq!(Equipment::NONE.of(MAX_KINDS), 0);
    }
}
