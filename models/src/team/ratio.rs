//! Exact fractions.

use core::cmp::Ordering;

/// A fraction in lowest terms, at least 0.
///
/// ```
/// use cotama_models::team::Ratio;
/// let bid = Ratio::new(410, 6).unwrap();
/// assert_eq!((bid.numerator(), bid.denominator(), bid.rounded_up()), (205, 3, 69));
/// assert!(bid > Ratio::from(68));
/// assert_eq!(Ratio::new(1, 0), None);
/// assert_eq!(bid.to_string(), "205/3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ratio {
    numerator: u128,
    denominator: u128,
}

impl Ratio {
    /// The ratio 0.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };

    /// A fraction; none with the denominator 0.
    #[must_use]
    pub const fn new(numerator: u128, denominator: u128) -> Option<Self> {
        let (mut a, mut b) = (numerator, denominator);
        while b != 0 {
            (a, b) = match a.checked_rem(b) {
                Some(rest) => (b, rest),
                None => return None,
            };
        }
        match (numerator.checked_div(a), denominator.checked_div(a)) {
            (Some(numerator), Some(denominator)) if denominator > 0 => {
                Some(Self { numerator, denominator })
            }
            _ => None,
        }
    }

    /// Returns the numerator.
    pub const fn numerator(self) -> u128 {
        self.numerator
    }

    /// By what; at least 1.
    pub const fn denominator(self) -> u128 {
        self.denominator
    }

    /// The least integer that is not less; the largest `u64` beyond it.
    pub fn rounded_up(self) -> u64 {
        let up = self.numerator.div_ceil(self.denominator.max(1));
        u64::try_from(up).unwrap_or(u64::MAX)
    }
}

impl From<u64> for Ratio {
    fn from(number: u64) -> Self {
        Self { numerator: number.into(), denominator: 1 }
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ratio {
    /// By continued fractions: cross products may pass 128 bits.
    fn cmp(&self, other: &Self) -> Ordering {
        let (mut left, mut right) = (*self, *other);
        let mut swapped = false;
        loop {
            let parts = |it: Self| {
                let divisor = it.denominator.max(1);
                (it.numerator / divisor, it.numerator % divisor)
            };
            let ((whole, rest), (others, other_rest)) = (parts(left), parts(right));
            let order = match (whole.cmp(&others), rest, other_rest) {
                (Ordering::Equal, 0, 0) => Ordering::Equal,
                (Ordering::Equal, 0, _) => Ordering::Less,
                (Ordering::Equal, _, 0) => Ordering::Greater,
                (Ordering::Equal, _, _) => {
                    // The remainder is below 1: the order of the inverses is the other way round.
                    left = Self { numerator: left.denominator, denominator: rest };
                    right = Self { numerator: right.denominator, denominator: other_rest };
                    swapped = !swapped;
                    continue;
                }
                (order, _, _) => order,
            };
            return if swapped { order.reverse() } else { order };
        }
    }
}

impl core::fmt::Display for Ratio {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.denominator {
            1 => write!(f, "{}", self.numerator),
            _ => write!(f, "{}/{}", self.numerator, self.denominator),
        }
    }
}
