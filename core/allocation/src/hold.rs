//! A reserve for what remains: the planned rest is a mean, what it takes is a bound of it.
//!
//! PANORAMA plans again when *limit - used - planned rest* is below zero (Lambert et al., J.
//! Intell. Robot. Syst. 110, 2024, eqs. 7 and 8). Runs take more than planned, so that such a
//! margin is missed often and late. A [`Hold`] says how many times the planned rest is kept back on
//! each axis, as past runs have shown it (split conformal prediction; see [`rank`]).
//!
//! ```
//! use cotama_core::hold::Hold;
//! let hold = Hold::new([1_050_000, 1_200_000]); // 5 % more time, 20 % more energy
//! assert_eq!(hold.of(&[60_000, 1_000]), [63_000, 1_200]);
//! // A plan that fits into these limits fits into what is left with its reserve.
//! assert_eq!(hold.within(&[63_000, 1_199]), [60_000, 999]);
//! ```

/// A ratio of one, in millionths.
pub const ONE: u32 = 1_000_000;

/// How many times the planned rest is kept back on each axis, in millionths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hold<const A: usize> {
    ratios: [u32; A],
}

impl<const A: usize> Hold<A> {
    /// Keeps back the planned rest alone, as the paper does.
    pub const NOTHING: Self = Self { ratios: [ONE; A] };

    /// Keeps back so many millionths of the planned rest; at least one.
    #[must_use]
    pub fn new(ratios: [u32; A]) -> Self {
        Self { ratios: ratios.map(|it| it.max(1)) }
    }

    /// Returns the ratios, in millionths.
    #[must_use]
    pub const fn ratios(self) -> [u32; A] {
        self.ratios
    }

    /// Returns the amount kept back for a planned rest, rounded up.
    #[must_use]
    pub fn of(&self, rest: &[u64; A]) -> [u64; A] {
        core::array::from_fn(|axis| {
            let kept = u128::from(rest[axis]) * u128::from(self.ratios[axis]);
            u64::try_from(kept.div_ceil(u128::from(ONE))).unwrap_or(u64::MAX)
        })
    }

    /// Returns the largest planned rest whose [amount](Self::of) fits into what is left.
    #[must_use]
    pub fn within(&self, left: &[u64; A]) -> [u64; A] {
        core::array::from_fn(|axis| {
            let most = u128::from(left[axis]) * u128::from(ONE);
            let ratio = u128::from(self.ratios[axis].max(1));
            u64::try_from(most.checked_div(ratio).unwrap_or(0)).unwrap_or(u64::MAX)
        })
    }
}

/// Returns which of `runs` past scores, from 1 for the smallest, bounds the next one at least as
/// often as `coverage` says, in millionths: the smallest k of at least (runs + 1) coverage. `None`
/// where so few runs bound nothing yet.
///
/// The runs and the next one must be exchangeable; then the share holds on average over all sets of
/// past runs, and given one set it is distributed as Beta(k, runs + 1 - k) if scores differ (Vovk,
/// Gammerman, Shafer, Algorithmic Learning in a Random World, 2005; Vovk, ACML 2012).
///
/// ```
/// use cotama_core::hold::rank;
/// assert_eq!(rank(19, 950_000), Some(19)); // the largest of 19
/// assert_eq!(rank(18, 950_000), None);
/// assert_eq!(rank(2_000, 990_000), Some(1_981));
/// ```
#[must_use]
pub fn rank(runs: u64, coverage: u32) -> Option<u64> {
    let wanted = (u128::from(runs) + 1) * u128::from(coverage.min(ONE));
    let rank = u64::try_from(wanted.div_ceil(u128::from(ONE))).ok()?.max(1);
    (rank <= runs).then_some(rank)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random numbers enough for a law (Steele, Lea, Flood, OOPSLA 2014: splitmix64).
    fn draws() -> impl FnMut() -> u64 {
        let mut state = 0_u64;
        move || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let it = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let it = (it ^ (it >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            it ^ (it >> 31)
        }
    }

    #[test]
    fn a_rest_fits_into_the_limits_just_when_its_reserve_fits_into_what_is_left() {
        let mut next = draws();
        for _ in 0..20_000 {
            let shift = next() % 62;
            let (left, ratio) = ((next() >> 3) >> shift, (next() % 5_000_000) as u32);
            let hold = Hold::new([ratio]);
            let [most] = hold.within(&[left]);
            if most < u64::MAX {
                assert!(hold.of(&[most])[0] <= left, "{left} {ratio}");
                assert!(hold.of(&[most + 1])[0] > left, "{left} {ratio}");
            }
        }
        assert_eq!(Hold::new([4, 0]).of(&[u64::MAX, 1]), [73_786_976_294_839, 1]);
        assert_eq!(Hold::<1>::NOTHING.of(&[7]), Hold::<1>::NOTHING.within(&[7]));
    }

    #[test]
    fn the_rank_is_the_least_that_keeps_the_promise() {
        for runs in 0..400_u64 {
            for coverage in [1, 500_000, 900_000, 950_000, 990_000, ONE] {
                let enough = |k: u64| k * u64::from(ONE) >= (runs + 1) * u64::from(coverage);
                let found = (1..=runs).find(|it| enough(*it));
                assert_eq!(rank(runs, coverage), found, "{runs} {coverage}");
            }
        }
    }
}
