//! How often something works.

use core::cmp::Ordering;

/// A probability in parts per 10⁹, rounded down: never more than is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Probability(u32);

impl Probability {
    /// So many parts make 1.
    pub const PARTS: u32 = 1_000_000_000;
    /// Certain.
    pub const ONE: Self = Self(Self::PARTS);
    /// Impossible.
    pub const ZERO: Self = Self(0);

    /// So many thousandths, exactly; none above 1,000.
    #[must_use]
    pub const fn permille(number: u16) -> Option<Self> {
        match (number as u32).checked_mul(Self::PARTS / 1_000) {
            Some(parts) if parts <= Self::PARTS => Some(Self(parts)),
            _ => None,
        }
    }

    /// So many parts per 10⁹; none above 10⁹.
    #[must_use]
    pub const fn new(parts: u32) -> Option<Self> {
        if parts <= Self::PARTS { Some(Self(parts)) } else { None }
    }

    /// In parts per 10⁹.
    pub const fn parts(self) -> u32 {
        self.0
    }

    /// Returns the probability that both happen (3.11), rounded down.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(((self.0 as u64).wrapping_mul(other.0 as u64) / Self::PARTS as u64) as u32)
    }

    /// Returns the probability of the complement, in parts per 10⁹.
    pub const fn failing(self) -> u32 {
        Self::PARTS.saturating_sub(self.0)
    }
}

/// The value of a capability (def. 3.5): of the uses that the capability itself decided, how many
/// succeeded.
///
/// ```
/// use cotama_models::team::{Probability, Reliability};
/// let grasp = Reliability::Uses { succeeded: 19, failed: 1 };
/// assert_eq!(grasp.probability(), Probability::permille(950).unwrap());
/// assert_eq!(grasp.after(false).probability().parts(), 904_761_904); // 19/21
/// assert!(!Reliability::Permille(0).is_there()); // def. 3.6
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reliability {
    /// Stated, in thousandths; more than 1,000 are 1,000.
    Permille(u16),
    /// Counted. Uses that another capability made fail are not counted at all. Before the first
    /// use nothing is known against it: it counts as certain (our reading; the thesis leaves 0/0
    /// open).
    Uses {
        /// Uses that succeeded.
        succeeded: u32,
        /// Uses that failed by its own fault.
        failed: u32,
    },
}

impl Reliability {
    /// As certain as can be.
    pub const CERTAIN: Self = Self::Permille(1_000);

    /// The probability that its next use succeeds, rounded down.
    pub fn probability(self) -> Probability {
        match self {
            Self::Permille(number) => Probability::permille(number).unwrap_or(Probability::ONE),
            Self::Uses { succeeded, failed } => {
                let all = u64::from(succeeded).saturating_add(failed.into());
                let parts = u64::from(succeeded).saturating_mul(Probability::PARTS.into());
                parts.checked_div(all).map_or(Probability::ONE, |it| Probability(it as u32))
            }
        }
    }

    /// Whether a robot with this value has the capability at all (def. 3.6).
    pub const fn is_there(self) -> bool {
        match self {
            Self::Permille(number) => number > 0,
            Self::Uses { succeeded, failed } => succeeded > 0 || failed == 0,
        }
    }

    /// With one more use that the capability itself decided. What was stated stays.
    #[must_use]
    pub const fn after(self, success: bool) -> Self {
        match self {
            Self::Permille(_) => self,
            Self::Uses { succeeded, failed } if success => {
                Self::Uses { succeeded: succeeded.saturating_add(1), failed }
            }
            Self::Uses { succeeded, failed } => {
                Self::Uses { succeeded, failed: failed.saturating_add(1) }
            }
        }
    }
}

/// Which of two coalitions of equal cost is to be preferred (4.5.4): that whose least reliable
/// member is more reliable; of equal ones the second least decides, and so on; then the smaller
/// one. [`Ordering::Greater`] where it is the first. Both lists are sorted on the way.
///
/// ```
/// use cotama_models::team::{Probability, by_reliability};
/// use std::cmp::Ordering;
/// let of = |list: [u16; 2]| list.map(|it| Probability::permille(it).unwrap());
/// assert_eq!(by_reliability(&mut of([900, 700]), &mut of([990, 690])), Ordering::Greater);
/// assert_eq!(by_reliability(&mut of([900, 700]), &mut of([700, 950])), Ordering::Less);
/// ```
pub fn by_reliability(one: &mut [Probability], other: &mut [Probability]) -> Ordering {
    sort(one);
    sort(other);
    let order = one.iter().zip(other.iter()).map(|(a, b)| a.cmp(b)).find(|it| it.is_ne());
    order.unwrap_or_else(|| other.len().cmp(&one.len()))
}

/// Sorts the members of a coalition in rising order, by insertion: they are few, and the library's
/// sort can panic over an order that is none.
fn sort(list: &mut [Probability]) {
    for sorted in 1..list.len() {
        for at in (0..sorted).rev() {
            let pair = list.get_disjoint_mut([at, at.wrapping_add(1)]);
            let Ok([one, next]) = pair else { return };
            if *one <= *next {
                break;
            }
            core::mem::swap(one, next);
        }
    }
}
