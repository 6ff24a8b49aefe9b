//! Numbers of teams: fractions, probabilities, pledges.

use super::*;
use core::cmp::Ordering;
use cotama_core::proofs::few;

/// A fraction is in lowest terms, equal fractions are equal, and zero divides nothing.
#[kani::proof]
#[kani::unwind(8)]
pub fn a_fraction_is_in_lowest_terms() {
    let (a, b) = (u128::from(few::<5>()), u128::from(few::<5>()));
    let (c, d) = (u128::from(few::<5>()), u128::from(few::<5>()));
    let (one, other) = (Ratio::new(a, b), Ratio::new(c, d));
    assert!(one.is_some() == (b > 0));
    let (Some(one), Some(other)) = (one, other) else { return };
    assert!(one.numerator() * b == one.denominator() * a);
    assert!((one == other) == (a * d == c * b));
    kani::cover!(one == other && a != c && a > 0, "two that are equal");
}

/// Fractions are ordered as their cross products are.
#[kani::proof]
#[kani::unwind(12)]
pub fn fractions_are_ordered() {
    let (a, b) = (u128::from(few::<5>()), u128::from(few::<5>()));
    let (c, d) = (u128::from(few::<5>()), u128::from(few::<5>()));
    let (Some(one), Some(other)) = (Ratio::new(a, b), Ratio::new(c, d)) else { return };
    assert!(one.cmp(&other) == (a * d).cmp(&(c * b)));
    kani::cover!(a / b == c / d && one.cmp(&other) == Ordering::Less, "below each other by a rest");
}

/// A fraction is rounded up to the least whole number that is no less.
#[kani::proof]
#[kani::unwind(12)]
pub fn a_fraction_is_rounded_up() {
    let (a, b): (u8, u8) = (kani::any(), kani::any_where(|it| *it > 0));
    let Some(ratio) = Ratio::new(a.into(), b.into()) else { unreachable!() };
    let (up, a, b) = (ratio.rounded_up(), u64::from(a), u64::from(b));
    assert!(up * b >= a && (up == 0 || (up - 1) * b < a));
    kani::cover!(up * b > a, "up");
    kani::cover!(up * b == a && up > 1, "just so");
}

/// The probability of two things together is at most that of each, never above one, and rounded
/// down by less than one part.
#[kani::proof]
pub fn two_are_no_likelier_than_one() {
    let (a, b): (u32, u32) = (kani::any(), kani::any());
    let (one, other) = (Probability::new(a), Probability::new(b));
    assert!(one.is_some() == (a <= Probability::PARTS));
    let (Some(one), Some(other)) = (one, other) else { return };
    let both = one.and(other);
    assert!(both <= one && both <= other && one.and(Probability::ONE) == one);
    let (exact, parts) = (u128::from(a) * u128::from(b), u128::from(Probability::PARTS));
    let said = u128::from(both.parts()) * parts;
    assert!(said <= exact && exact < said + parts);
    kani::cover!(both.parts() > 0 && both < one && both < other, "less than each");
}

/// A pledge is at least the cost that it is made for, at most that with its slack, and never more
/// than the second best asks where that is dearer.
#[kani::proof]
pub fn a_pledge_is_within_its_slack() {
    let (cost, slack): (u32, u32) = (kani::any(), kani::any());
    let (cost, second): (u64, Option<u64>) = (cost.into(), kani::any());
    let pledge = Pledge::of(cost, second, slack);
    let slacked = u128::from(cost) * (1_000 + u128::from(slack));
    assert!(pledge.is_kept(cost) && u128::from(pledge.most) * 1_000 <= slacked);
    let bound = second.map_or(u64::MAX, |it| it.max(cost));
    assert!(pledge.most <= bound);
    assert!(pledge.most == bound || u128::from(pledge.most) * 1_000 + 1_000 > slacked);
    kani::cover!(second.is_some_and(|it| it > cost) && Some(pledge.most) == second, "the second");
    kani::cover!(second.is_some_and(|it| it < cost), "the second asks less");
}
