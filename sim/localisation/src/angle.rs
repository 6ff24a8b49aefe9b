//! Angles in single precision, many at once.
//!
//! Nothing but sums, products and bits, which IEEE 754 fixes: the same on every machine, and
//! without a branch or a call, so that a compiler makes vectors of it.

use core::f32::consts::{FRAC_2_PI, TAU};

/// With so much added, a number is rounded to a whole one, which its lowest bits hold.
const ROUNDS: f32 = 12_582_912.0; // 1.5 · 2²³

/// Returns sine and cosine to 2⁻²³ for angles of up to some turns.
///
/// Reduction by a quarter of a turn in three parts (Cody, Waite, Software Manual for the Elementary
/// Functions, 1980, chapter 8), then the polynomials of Cephes (Moshier, `sinf.c`, 1992).
#[inline(always)]
#[expect(clippy::inline_always, reason = "a call in a loop would keep it from being vectors")]
pub(crate) fn sincos(angle: f32) -> (f32, f32) {
    let biased = angle * FRAC_2_PI + ROUNDS;
    let quarters = biased - ROUNDS;
    let bits = biased.to_bits();
    let rest = angle - quarters * 1.570_312_5;
    let rest = rest - quarters * 4.837_513e-4;
    let rest = rest - quarters * 7.549_79e-8;
    let square = rest * rest;
    let sine = (-1.951_529_6e-4 * square + 8.332_161e-3) * square - 1.666_665_5e-1;
    let sine = rest + rest * square * sine;
    let cosine = (2.443_315_7e-5 * square - 1.388_731_6e-3) * square + 4.166_664_6e-2;
    let cosine = 1.0 - 0.5 * square + cosine * square * square;
    let is_odd = bits & 1 == 1;
    let (one, two) = if is_odd { (cosine, sine) } else { (sine, cosine) };
    let sign = |it: f32, negative: u32| f32::from_bits(it.to_bits() ^ (negative & 2) << 30);
    (sign(one, bits), sign(two, bits.wrapping_add(1)))
}

/// Returns the angle from -π to π.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a call in a loop would keep it from being vectors")]
pub(crate) fn wrapped(angle: f32) -> f32 {
    angle - ((angle * (1.0 / TAU) + ROUNDS) - ROUNDS) * TAU
}

/// Returns the angle from -π to π, to double precision.
pub(crate) fn wrap(angle: f64) -> f64 {
    const TURN: f64 = core::f64::consts::TAU;
    const ROUNDS: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²
    angle - ((angle * (1.0 / TURN) + ROUNDS) - ROUNDS) * TURN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_are_those_of_libm() {
        let mut most = 0.0_f64;
        for at in -40_000..=40_000 {
            let angle = at as f32 * 2.5e-4; // up to 10 rad
            let (sin, cos) = sincos(angle);
            let exact = libm::sincos(f64::from(angle));
            most = most.max((f64::from(sin) - exact.0).abs().max((f64::from(cos) - exact.1).abs()));
        }
        assert!(most < 1.2e-7, "{most}");
        assert_eq!(sincos(0.0), (0.0, 1.0));
    }

    #[test]
    fn angles_are_wrapped_to_half_a_turn() {
        for at in -300..300 {
            let angle = at as f32 * 0.05;
            let it = wrapped(angle);
            assert!(it.abs() <= core::f32::consts::PI + 1e-6, "{angle}: {it}");
            let turns = (angle - it) / TAU;
            assert!((turns - turns.round()).abs() < 1e-6, "{angle}: {it}");
        }
    }
}
