//! Physical quantities as integers with their unit in the type.
//!
//! Every quantity is a `u64` in the unit its name says. Arithmetic is checked: what does not fit is
//! `None`, never a wrapped number. Two roundings occur, both *half up*, as in the mission files:
//! a duration from a length and a speed ([`Millis::to_travel`]) and an energy from a power and a
//! duration ([`Millijoules::spent`]).
//!
//! ```
//! use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
//!
//! let leg = Millimetres(31_000);
//! let duration = Millis::to_travel(leg, MillimetresPerSecond(410)).unwrap();
//! assert_eq!(duration, Millis(75_610)); // 75,609.76 ms, rounded half up
//! assert_eq!(Millijoules::spent(Milliwatts(18_224), duration), Some(Millijoules(1_377_917)));
//! assert_eq!(Millis::to_travel(leg, MillimetresPerSecond(0)), None);
//! ```

#[cfg(kani)]
pub mod proofs;

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $unit:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(pub u64);

        impl $name {
            /// Nothing of it.
            pub const ZERO: Self = Self(0);

            /// The sum, or `None` when it does not fit.
            #[must_use]
            pub const fn checked_add(self, other: Self) -> Option<Self> {
                match self.0.checked_add(other.0) {
                    Some(sum) => Some(Self(sum)),
                    None => None,
                }
            }

            /// The difference, or `None` when `other` is the larger.
            #[must_use]
            pub const fn checked_sub(self, other: Self) -> Option<Self> {
                match self.0.checked_sub(other.0) {
                    Some(rest) => Some(Self(rest)),
                    None => None,
                }
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, concat!("{} ", $unit), self.0)
            }
        }

        #[cfg(feature = "defmt")]
        impl defmt::Format for $name {
            fn format(&self, f: defmt::Formatter<'_>) {
                defmt::write!(f, "{} {}", self.0, defmt::intern!($unit));
            }
        }
    };
}

quantity!(
    /// A duration or a point in time, in milliseconds.
    Millis,
    "ms"
);
quantity!(
    /// A duration or a point in time, in microseconds.
    Micros,
    "us"
);
quantity!(
    /// An energy, in millijoules.
    Millijoules,
    "mJ"
);
quantity!(
    /// A length or a place along the path, in millimetres.
    Millimetres,
    "mm"
);
quantity!(
    /// A speed along the path, in millimetres per second.
    MillimetresPerSecond,
    "mm/s"
);
quantity!(
    /// A power, in milliwatts.
    Milliwatts,
    "mW"
);

/// `a * b / c`, rounded half up; `None` when `c` is zero or the result does not fit.
///
/// ```
/// use cotama_core::units::mul_div_half_up;
///
/// assert_eq!(mul_div_half_up(5, 1, 2), Some(3)); // 2.5
/// assert_eq!(mul_div_half_up(u64::MAX, 3, 3), Some(u64::MAX));
/// assert_eq!(mul_div_half_up(u64::MAX, 2, 1), None);
/// ```
#[must_use]
pub const fn mul_div_half_up(a: u64, b: u64, c: u64) -> Option<u64> {
    if c == 0 {
        return None;
    }
    // Products of real missions fit 64 bits, where a division is several times cheaper.
    if let Some(product) = a.checked_mul(b)
        && let Some(raised) = product.checked_add(c / 2)
    {
        return Some(raised / c);
    }
    let quotient = (a as u128 * b as u128 + (c / 2) as u128) / c as u128;
    if quotient > u64::MAX as u128 {
        return None;
    }
    Some(quotient as u64)
}

impl Millis {
    /// The time to travel `length` at `speed`, rounded half up; `None` at speed zero or when it
    /// does not fit.
    #[must_use]
    pub const fn to_travel(length: Millimetres, speed: MillimetresPerSecond) -> Option<Self> {
        match mul_div_half_up(length.0, 1000, speed.0) {
            Some(ms) => Some(Self(ms)),
            None => None,
        }
    }
}

impl Micros {
    /// The same duration in microseconds, or `None` when it does not fit.
    #[must_use]
    pub const fn from_millis(duration: Millis) -> Option<Self> {
        match duration.0.checked_mul(1000) {
            Some(us) => Some(Self(us)),
            None => None,
        }
    }
}

impl Millijoules {
    /// The energy that `power` takes in `duration`, rounded half up; `None` when it does not fit.
    #[must_use]
    pub const fn spent(power: Milliwatts, duration: Millis) -> Option<Self> {
        match mul_div_half_up(power.0, duration.0, 1000) {
            Some(mj) => Some(Self(mj)),
            None => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_round_up_and_less_rounds_down() {
        assert_eq!(mul_div_half_up(1, 1, 2), Some(1));
        assert_eq!(mul_div_half_up(1, 1, 3), Some(0));
        assert_eq!(mul_div_half_up(5, 1, 3), Some(2));
    }

    #[test]
    fn a_wide_product_is_exact_and_a_wide_quotient_is_refused() {
        assert_eq!(mul_div_half_up(u64::MAX, 1000, 1000), Some(u64::MAX));
        assert_eq!(mul_div_half_up(u64::MAX, 3, 6), Some(1 << 63)); // a half
        assert_eq!(mul_div_half_up(u64::MAX - 2, 4, 12), Some(0x5555_5555_5555_5554)); // less
        assert_eq!(mul_div_half_up(u64::MAX, 2, 1), None);
        assert_eq!(mul_div_half_up(1, 1, 0), None);
    }

    #[test]
    fn sums_that_do_not_fit_are_refused() {
        assert_eq!(Millis(u64::MAX).checked_add(Millis(1)), None);
        assert_eq!(Micros::from_millis(Millis(u64::MAX)), None);
        assert_eq!(Micros::from_millis(Millis(7)), Some(Micros(7_000)));
        assert_eq!(Millijoules(1).checked_sub(Millijoules(2)), None);
        assert_eq!(Millijoules(2).checked_sub(Millijoules(1)), Some(Millijoules(1)));
        assert_eq!(Millis(u64::MAX - 1).checked_add(Millis(1)), Some(Millis(u64::MAX)));
    }

    /// Speeds, lengths and powers up to all that fits: exact, or refused, never wrapped.
    #[test]
    fn huge_energies_and_times_are_exact_or_refused() {
        let most = Milliwatts(u64::MAX);
        assert_eq!(Millijoules::spent(most, Millis(1_000)), Some(Millijoules(u64::MAX)));
        assert_eq!(Millijoules::spent(most, Millis(1_001)), None);
        assert_eq!(Millijoules::spent(most, Millis(500)), Some(Millijoules(1 << 63)));
        let length = Millimetres(u64::MAX);
        let travel = |speed| Millis::to_travel(length, MillimetresPerSecond(speed));
        assert_eq!(travel(1_000), Some(Millis(u64::MAX)));
        assert_eq!((travel(999), travel(0)), (None, None));
        assert_eq!(
            Millis::to_travel(Millimetres(410), MillimetresPerSecond(410)),
            Some(Millis(1_000))
        );
    }
}
