//! Prices of robots that raise the bound: the volume algorithm (F. Barahona and R. Anbil, *The
//! volume algorithm*, Mathematical Programming 87, 2000) in integers.
//!
//! A robot that several tasks want becomes dearer, one that no task wants becomes cheaper. The
//! direction is a mean over the demands so far, and starts at the best prices; any prices that are
//! not negative give a valid bound, so rounding costs tightness only, never truth.

use super::{Budget, LIMIT};

/// The evaluation of a bound.
pub(super) trait Dual<const N: usize> {
    /// The bound at these prices, and how many tasks want each robot; [`LIMIT`] or more where some
    /// task cannot be done at all. None where the budget ends.
    fn evaluate(
        &mut self,
        prices: &[i64; N],
        wanted: &mut [i64; N],
        budget: &mut Budget,
    ) -> Option<i64>;
}

/// When to end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Until {
    /// A bound that would be enough.
    pub(super) enough: i64,
    /// So many evaluations at most.
    pub(super) evaluations: u32,
    /// The cost of the best solution.
    pub(super) target: i64,
    /// How many robots there are.
    pub(super) robots: usize,
    /// The bound may be this far from the best one, or a small part of itself.
    pub(super) gap: i64,
}

/// The unit of a direction.
const ONE: i64 = 256;
/// No price passes this.
const DEAREST: i64 = 1 << 50;

/// Raises the bound from these prices on, which are replaced by the best ones; returns the best
/// bound, none where the budget allows not even one evaluation.
pub(super) fn ascend<const N: usize>(
    dual: &mut impl Dual<N>,
    prices: &mut [i64; N],
    until: Until,
    budget: &mut Budget,
) -> Option<i64> {
    let mut wanted = [0; N];
    let mut best = dual.evaluate(prices, &mut wanted, budget)?;
    debug_assert!(until.robots <= N, "a price a robot");
    let mut mean = slope(&wanted);
    let (mut pace, mut failures, mut stale) = (ONE, 0_u32, 0_u32);
    for _ in 1..until.evaluations {
        if best >= until.enough || best >= LIMIT || pace < 6 || stale > 40 {
            break;
        }
        let counts = |price: i64, it: i64| if price == 0 && it < 0 { 0 } else { it };
        let norm = prices.iter().zip(mean).take(until.robots).map(|(price, it)| counts(*price, it));
        let norm =
            norm.map(i128::from).fold(0_i128, |sum, it| sum.wrapping_add(it.wrapping_mul(it)));
        if norm == 0 {
            break;
        }
        let least = (best.wrapping_abs() / 512).wrapping_add(16);
        let most = least.max(best.wrapping_abs() / 32).max(until.gap);
        let gap = until.target.wrapping_sub(best).min(most).max(least);
        let gap = i128::from(gap);
        debug_assert!(norm > 0 && gap > 0, "the direction leads up");
        // In 2^-16 of a price for each of the direction's 2^-8.
        let stride = (i128::from(pace).wrapping_mul(gap) << 16).checked_div(norm).unwrap_or(0);
        let mut next = *prices;
        for (price, it) in next.iter_mut().zip(mean).take(until.robots) {
            let change = stride.wrapping_mul(i128::from(it)) >> 16;
            let change = change.clamp(-i128::from(DEAREST), i128::from(DEAREST)) as i64;
            *price = price.wrapping_add(change).clamp(0, DEAREST);
        }
        let Some(bound) = dual.evaluate(&next, &mut wanted, budget) else { break };
        let slope = slope(&wanted);
        let along: i64 =
            slope.iter().zip(mean).take(until.robots).fold(0, |sum, (a, b)| add(sum, *a, b, 4));
        // The mean that is shortest, within limits (4.2 there).
        let (mut over, mut under) = (0_i64, 1_i64);
        for (own, new) in mean.iter().zip(slope).take(until.robots) {
            let apart = own.wrapping_sub(new);
            (over, under) = (add(over, *own, apart, 2), add(under, apart, apart, 2));
        }
        debug_assert!(under > 0, "a sum of squares, and one");
        let share = over.saturating_mul(ONE).checked_div(under).unwrap_or(0);
        let share = share.clamp(ONE / 32, ONE / 8);
        for (own, new) in mean.iter_mut().zip(slope).take(until.robots) {
            *own = own.wrapping_add(new.wrapping_sub(*own).wrapping_mul(share) / ONE);
        }
        if bound > best {
            // A gain that matters.
            let matters = (best.wrapping_abs() >> 14).wrapping_add(4);
            stale = if bound.wrapping_sub(best) > matters { 0 } else { stale.wrapping_add(1) };
            (*prices, best, failures) = (next, bound, 0);
            if along > 0 {
                pace = pace.wrapping_add(pace / 8).min(2 * ONE);
            }
        } else {
            (stale, failures) = (stale.wrapping_add(1), failures.wrapping_add(1));
            if failures >= 3 {
                (pace, failures) = (pace.wrapping_mul(2) / 3, 0);
            }
        }
    }
    Some(best)
}

/// How many tasks too many want each robot.
fn slope<const N: usize>(wanted: &[i64; N]) -> [i64; N] {
    wanted.map(|it| it.wrapping_sub(1).wrapping_mul(ONE))
}

/// A sum with the product of both, each without its last bits.
fn add(sum: i64, one: i64, other: i64, bits: u32) -> i64 {
    sum.wrapping_add(one.wrapping_shr(bits).wrapping_mul(other.wrapping_shr(bits)))
}
