//! Arithmetic of quantities: nothing wraps, and rounding goes where it is said to go.

use super::*;
use crate::proofs::few;

/// A sum of quantities that fits is the sum, and one that does not is refused: it never wraps.
#[kani::proof]
pub fn sums_never_wrap() {
    let (a, b): (u64, u64) = (kani::any(), kani::any());
    let sum = Millis(a).checked_add(Millis(b));
    match sum {
        Some(Millis(sum)) => assert!(sum >= a && sum - a == b),
        None => assert!(b > u64::MAX - a),
    }
    kani::cover!(sum.is_none(), "refused");
    kani::cover!(sum.is_some() && a > 0 && b > 0, "a sum");
}

/// A difference of quantities is refused when it would be below zero, and exact otherwise.
#[kani::proof]
pub fn differences_never_wrap() {
    let (a, b): (u64, u64) = (kani::any(), kani::any());
    let rest = Millijoules(a).checked_sub(Millijoules(b));
    match rest {
        Some(Millijoules(rest)) => assert!(b <= a && rest <= a && rest + b == a),
        None => assert!(b > a),
    }
    kani::cover!(rest.is_none(), "refused");
    kani::cover!(rest.is_some() && b > 0, "a difference");
}

/// Milliseconds become a thousand times as many microseconds, or are refused.
#[kani::proof]
pub fn microseconds_are_a_thousand_to_the_millisecond() {
    let ms: u64 = kani::any();
    let us = Micros::from_millis(Millis(ms));
    match us {
        Some(Micros(us)) => assert!(ms <= u64::MAX / 1000 && us == ms * 1000),
        None => assert!(ms > u64::MAX / 1000),
    }
    kani::cover!(us.is_none(), "refused");
    kani::cover!(us.is_some(), "converted");
}

/// A quotient of small numbers is the nearest whole number, a half goes up, and zero divides
/// nothing.
#[kani::proof]
pub fn quotients_of_small_numbers_are_rounded_half_up() {
    let (a, b) = (u64::from(few::<6>()), u64::from(few::<4>()));
    let c = u64::from(kani::any::<u8>());
    match mul_div_half_up(a, b, c) {
        None => assert!(c == 0),
        Some(it) => assert!(2 * c * it <= 2 * a * b + c && 2 * a * b + c < 2 * c * (it + 1)),
    }
    kani::cover!(c > 0 && 2 * a * b == c, "a half");
    kani::cover!(c == 0, "by zero");
}

/// A quotient of any three numbers is what 128 bits say, and is refused exactly when it does not
/// fit 64.
#[kani::proof]
pub fn quotients_of_wide_numbers_are_rounded_half_up() {
    let (a, b, c): (u64, u64, u64) = (kani::any(), kani::any(), kani::any_where(|it| *it > 0));
    let (product, c) = (u128::from(a) * u128::from(b), u128::from(c));
    // Rounded up when what is left is at least what lacks to the next whole number.
    let (down, rest) = (product / c, product % c);
    let exact = if rest >= c - rest { down + 1 } else { down };
    let said = mul_div_half_up(a, b, c as u64);
    assert!(said.map(u128::from) == (exact <= u128::from(u64::MAX)).then_some(exact));
    kani::cover!(said.is_none(), "refused");
    kani::cover!(said.is_some() && a.checked_mul(b).is_none(), "a product beyond 64 bits");
}

/// To go slower, or further, never takes less time.
#[kani::proof]
pub fn slower_or_further_takes_no_less_time() {
    let (near, slow) = (u64::from(few::<4>()), u64::from(few::<5>()));
    let (more, faster) = (u64::from(few::<3>()), u64::from(few::<5>()));
    let time = |length, speed| Millis::to_travel(Millimetres(length), MillimetresPerSecond(speed));
    kani::assume(slow > 0);
    let Some(taken) = time(near, slow) else { unreachable!() };
    assert!(time(near, slow + faster) <= Some(taken) && time(near + more, slow) >= Some(taken));
    assert!(time(near, 0).is_none());
    kani::cover!(time(near, slow + faster) < Some(taken), "faster");
}

/// Energy is power times time in millijoules, at most half of one away, and fits for every power
/// and time of 32 bits.
#[kani::proof]
pub fn energy_is_power_times_time() {
    let (power, time): (u32, u32) = (kani::any(), kani::any());
    let (power, time) = (u64::from(power), u64::from(time));
    let Some(Millijoules(spent)) = Millijoules::spent(Milliwatts(power), Millis(time)) else {
        unreachable!()
    };
    let exact = u128::from(power) * u128::from(time);
    assert!(u128::from(spent) * 1000 <= exact + 500 && exact < u128::from(spent) * 1000 + 500);
    kani::cover!(exact % 1000 == 500, "a half");
}
