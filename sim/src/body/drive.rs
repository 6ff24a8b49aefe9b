//! The robot at mission fidelity: how far along the path, and how fast.
//!
//! Within a step the speed changes evenly. Lengths are µm, so that a step of a whole number of ms
//! rounds nothing but the half of an odd sum of speeds.

use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};

/// The robot on its path: its position and its speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drive {
    x_um: u64,
    speed_mm_s: u64,
    /// In mm/s².
    acceleration: u64,
}

impl Drive {
    /// A robot that stands at the start of its path, and speeds up and slows down by so many mm/s².
    pub const fn new(acceleration: u64) -> Self {
        debug_assert!(acceleration > 0, "who never brakes has no braking distance");
        Self { x_um: 0, speed_mm_s: 0, acceleration }
    }

    /// Returns the position.
    pub const fn x(&self) -> Millimetres {
        Millimetres(self.x_um / 1000)
    }

    /// How fast it goes.
    pub const fn speed(&self) -> MillimetresPerSecond {
        MillimetresPerSecond(self.speed_mm_s)
    }

    /// Goes on for a time towards a speed, no further than an end: there it stands.
    pub fn go(&mut self, towards: MillimetresPerSecond, end: Millimetres, time: Millis) {
        let change = self.acceleration.saturating_mul(time.0) / 1000;
        let least = self.speed_mm_s.saturating_sub(change);
        let most = self.speed_mm_s.saturating_add(change);
        let after = towards.0.clamp(least, most);
        let way = (self.speed_mm_s.saturating_add(after)).saturating_mul(time.0) / 2;
        let end = end.0.saturating_mul(1000).max(self.x_um);
        let before = self.x_um;
        self.x_um = self.x_um.saturating_add(way).min(end);
        self.speed_mm_s = if self.x_um == end { 0 } else { after };
        debug_assert!(before <= self.x_um && self.x_um <= end, "it drives on, and no further");
    }

    /// Whether it has gone on evenly since it was as before, for this time.
    pub fn is_steady_since(&self, before: &Self, time: Millis) -> bool {
        let way = before.speed_mm_s.saturating_mul(time.0);
        self.speed_mm_s == before.speed_mm_s && self.x_um == before.x_um.saturating_add(way)
    }

    /// Goes on evenly for so many times this time.
    pub(crate) fn glide(&mut self, times: u64, time: Millis) {
        self.x_um += self.speed_mm_s * time.0 * times;
    }

    /// How often it can go on evenly for this time and still be before a place; no matter how often
    /// if it stands before it, and none if it is not before it now.
    pub(crate) fn times_before(&self, place: Millimetres, time: Millis) -> Option<u64> {
        let step = self.speed_mm_s.saturating_mul(time.0);
        let left = place.0.saturating_mul(1000).checked_sub(self.x_um + 1)?;
        Some(left.checked_div(step).unwrap_or(u64::MAX))
    }

    /// Puts it so far back along its path; the speed stays.
    pub(crate) fn set_back(&mut self, way: Millimetres) {
        debug_assert!(way.0 * 1000 <= self.x_um, "it is set back no further than it came");
        self.x_um = self.x_um.saturating_sub(way.0.saturating_mul(1000));
    }

    /// Counts the way from here on; the speed stays.
    pub(crate) fn restart(&mut self) {
        self.x_um = 0;
    }

    /// Stands at once: motors without power on a level floor.
    pub fn stand(&mut self) {
        self.speed_mm_s = 0;
    }

    /// How far it would still go if it braked now.
    pub const fn braking_distance(&self) -> Millimetres {
        Millimetres(self.speed_mm_s * self.speed_mm_s / (2 * self.acceleration))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const STEP: Millis = Millis(100);
    const FAR: Millimetres = Millimetres(1_000_000);

    #[test]
    fn it_reaches_the_speed_of_the_experiment_in_a_second_and_brakes_in_150_mm() {
        let mut drive = Drive::new(300);
        (0..10).for_each(|_| drive.go(MillimetresPerSecond(300), FAR, STEP));
        assert_eq!((drive.speed(), drive.x()), (MillimetresPerSecond(300), Millimetres(150)));
        assert_eq!(drive.braking_distance(), Millimetres(150));
        (0..10).for_each(|_| drive.go(MillimetresPerSecond(0), FAR, STEP));
        assert_eq!((drive.speed(), drive.x()), (MillimetresPerSecond(0), Millimetres(300)));
    }

    proptest! {
        #[test]
        fn it_brakes_within_its_braking_distance(
            speeds in prop::collection::vec(0u64..=1200, 1..60),
        ) {
            let mut drive = Drive::new(300);
            speeds.iter().for_each(|&it| drive.go(MillimetresPerSecond(it), FAR, STEP));
            // One step more, as the last one may brake by less than a whole step.
            let (from, within) =
                (drive.x().0, drive.braking_distance().0 + 3 + drive.speed().0 / 20);
            (0..60).for_each(|_| drive.go(MillimetresPerSecond(0), FAR, STEP));
            prop_assert_eq!(drive.speed(), MillimetresPerSecond(0));
            prop_assert!(drive.x().0 - from <= within);
        }
    }
}
