//! Counters of ticks that begin anew at 2³², widened to times that do not.
//!
//! A counter of milliseconds of 32 bits begins anew after 49.7 days. A player that is told the bare
//! count stands still from then on, until the count has come back to where it was.
//!
//! ```
//! use cotama_core::{net, ticks::Ticks32, units::Millis};
//! net! {
//!     mod lamp {
//!         places { Off: 1, On }
//!         events { press }
//!         outputs { dark }
//!         transitions { on on press: Off => On; off: On => Off emit dark after 1000 ms; }
//!     }
//! }
//! let mut ticks = Ticks32::starting_at(u32::MAX - 99); // 100 ms before it begins anew
//! let mut lamp = lamp::Player::start(lamp::Program, ticks.latest(), &mut ());
//! assert!(lamp.offer(ticks.widen(u32::MAX - 99), &lamp::Event::press).fired());
//! assert_eq!(lamp.advance(ticks.widen(899)).fired, 0);
//! assert_eq!(lamp.advance(ticks.widen(900)).fired, 1); // one second later
//! ```

use crate::units::Millis;

/// Widens the counts of a counter of milliseconds of 32 bits to [`Millis`].
///
/// A count stands for the time nearest to the latest one that has these low 32 bits: up to 2³¹ - 1
/// ms after it, or up to 2³¹ ms before it. So it is told a count at least every 2³¹ - 1 ms, which
/// is 24.8 days; and a count that was read before another one and is told after it has its own
/// time, which is earlier.
///
/// A counter of other ticks is widened in the same way; the result is ticks, to be converted
/// afterwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticks32 {
    latest: Millis,
}

impl Ticks32 {
    /// Starts with a first count, which stands for itself.
    #[must_use]
    pub const fn starting_at(count: u32) -> Self {
        Self { latest: Millis(count as u64) }
    }

    /// Starts at a time that was [latest](Self::latest) before, as after a restart.
    #[must_use]
    pub const fn going_on_at(latest: Millis) -> Self {
        Self { latest }
    }

    /// Returns the time of a count; the latest one if it is later. Times stay within `u64`: they
    /// are zero before it and stand still at its end.
    #[must_use]
    pub const fn widen(&mut self, count: u32) -> Millis {
        #[allow(clippy::cast_possible_truncation, reason = "the low bits are meant")]
        let after = count.wrapping_sub(self.latest.0 as u32).cast_signed();
        if after < 0 {
            return Millis(self.latest.0.saturating_sub(after.unsigned_abs() as u64));
        }
        self.latest = Millis(self.latest.0.saturating_add(after.unsigned_abs() as u64));
        self.latest
    }

    /// Returns the latest time so far.
    #[must_use]
    pub const fn latest(&self) -> Millis {
        self.latest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRAP: u64 = 1 << 32;
    const HALF: u64 = 1 << 31;

    #[test]
    fn every_instant_around_three_wraps_is_itself_however_long_the_steps() {
        for step in [1, 2, 3, 7, 10, 999] {
            for wrap in 1..=3 {
                let first = wrap * WRAP - 3_000;
                let mut ticks = Ticks32::going_on_at(Millis(first));
                for at in (first..first + 6_000).step_by(step) {
                    assert_eq!(ticks.widen(at as u32), Millis(at), "steps of {step} ms");
                    assert_eq!(ticks.latest(), Millis(at));
                }
            }
        }
    }

    #[test]
    fn long_steps_up_to_half_a_turn_are_followed_over_many_wraps() {
        for step in [1 << 20, 3_600_000, 86_400_000, WRAP / 3, HALF - 2, HALF - 1] {
            let (mut ticks, mut at) = (Ticks32::starting_at(0), 0);
            while at < 20 * WRAP {
                at += step;
                assert_eq!(ticks.widen(at as u32), Millis(at), "steps of {step} ms");
            }
        }
    }

    #[test]
    fn every_pair_of_counts_near_the_edges_is_apart_by_its_nearest_distance() {
        let edges = [0, 1, 2, HALF - 2, HALF - 1, HALF, HALF + 1, WRAP - 2, WRAP - 1];
        for latest in edges.map(|it| 5 * WRAP + it) {
            for count in edges {
                let mut ticks = Ticks32::going_on_at(Millis(latest));
                let near = [4, 5, 6].map(|turn| turn * WRAP + count);
                let fits = |it: &u64| (latest - HALF..latest + HALF).contains(it);
                let [Some(time), None] = ({
                    let mut times = near.into_iter().filter(fits);
                    [times.next(), times.next()]
                }) else {
                    panic!("one time is nearest")
                };
                assert_eq!(ticks.widen(count as u32), Millis(time), "{count} at {latest}");
                assert_eq!(ticks.latest(), Millis(time.max(latest)));
            }
        }
    }

    #[test]
    fn a_count_told_late_has_its_own_time_and_moves_nothing() {
        let mut ticks = Ticks32::starting_at(u32::MAX);
        assert_eq!(ticks.widen(4), Millis(WRAP + 4));
        assert_eq!(ticks.widen(u32::MAX - 1), Millis(WRAP - 2));
        assert_eq!(ticks.latest(), Millis(WRAP + 4));
        assert_eq!(ticks.widen(4), Millis(WRAP + 4));
        assert_eq!(ticks.widen(5), Millis(WRAP + 5));
    }

    #[test]
    fn times_before_zero_are_zero_and_those_after_the_end_are_the_end() {
        let mut ticks = Ticks32::starting_at(10);
        assert_eq!(ticks.widen(u32::MAX), Millis(0));
        assert_eq!(ticks.latest(), Millis(10));
        let mut ticks = Ticks32::going_on_at(Millis(u64::MAX - 1));
        assert_eq!(ticks.widen(u32::MAX), Millis(u64::MAX));
        assert_eq!(ticks.widen(7), Millis(u64::MAX));
        assert_eq!(ticks.widen(8), Millis(u64::MAX));
    }
}
