//! Readings with the time when they were taken, on their way from a device to its reader.

use crate::settings::{SettingsError, within};
use cotama_core::units::Millis;

/// The longest latency of a device, and the longest time between two readings: 10 minutes.
pub const MAX_TIME: Millis = Millis(600_000);
/// The most values that are on their way from one device at a time.
pub const MAX_VALUES: usize = 1 << 20;

/// A reading and when it was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sensed<T> {
    /// The time when it was taken; it arrives a latency later.
    pub taken: Millis,
    /// The reading.
    pub value: T,
}

/// The times at which a device takes readings, and how long they are on their way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    /// The time between two readings.
    pub period: Millis,
    /// The time from taking a reading to its arrival.
    pub latency: Millis,
}

/// The next reading that a device takes.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    period: u64,
    next: u64,
}

impl Clock {
    pub(crate) fn new(period: Millis) -> Self {
        Self { period: period.0.max(1), next: 0 }
    }

    /// The time of the next reading.
    pub(crate) fn due(&self) -> Millis {
        Millis(self.next)
    }

    /// Whether a reading is due; then the next one is set, on the same grid of times. Readings that
    /// were missed are not taken later: a robot is elsewhere then.
    pub(crate) fn strikes(&mut self, now: Millis) -> bool {
        let is_due = now.0 >= self.next;
        if is_due {
            self.next = (now.0 / self.period).saturating_add(1).saturating_mul(self.period);
        }
        is_due
    }
}

/// Frames of readings on their way. All memory is taken when it is made.
///
/// Invariant: it has room for all that leave within a latency, and for the last that arrived.
#[derive(Clone, Debug)]
pub(crate) struct Pipe<T> {
    width: usize,
    latency: u64,
    values: Vec<T>,
    /// When each frame was taken, and how many values it has; `None` before the first one.
    taken: Vec<Option<(Millis, usize)>>,
    /// The place of the newest frame.
    newest: usize,
}

impl<T: Copy> Pipe<T> {
    /// A pipe for frames of up to `width` values.
    pub(crate) fn new(width: usize, empty: T, rate: Rate) -> Result<Self, SettingsError> {
        let most = MAX_TIME.0 as f64;
        within("a period in ms", rate.period.0 as f64, 1.0, most)?;
        within("a latency in ms", rate.latency.0 as f64, 0.0, most)?;
        let depth = (rate.latency.0 / rate.period.0) as usize + 3;
        let values = (width * depth) as f64;
        within("the number of values on their way", values, 0.0, MAX_VALUES as f64)?;
        Ok(Self {
            width,
            latency: rate.latency.0,
            values: vec![empty; width * depth],
            taken: vec![None; depth],
            newest: 0,
        })
    }

    /// Sends a frame, of which more than the width is left behind.
    pub(crate) fn push(&mut self, now: Millis, frame: &[T]) {
        debug_assert!(frame.len() <= self.width, "a frame is no wider than its pipe");
        let place = (self.newest + 1) % self.taken.len();
        let room = self.values.get_mut(place * self.width..(place + 1) * self.width);
        let length = frame.len().min(self.width);
        if let Some((room, taken)) = room.zip(self.taken.get_mut(place)) {
            room.iter_mut().zip(frame).for_each(|(room, it)| *room = *it);
            *taken = Some((now, length));
            self.newest = place;
        }
    }

    /// Returns the newest frame that has arrived.
    pub(crate) fn latest(&self, now: Millis) -> Option<Sensed<&[T]>> {
        let depth = self.taken.len();
        let back = (0..depth).map(|back| (self.newest + depth - back) % depth);
        let mut all = back.filter_map(|at| Some((at, self.taken.get(at).copied()??)));
        let (at, (taken, length)) =
            all.find(|(_, (taken, _))| taken.0.saturating_add(self.latency) <= now.0)?;
        let value = self.values.get(at * self.width..at * self.width + length)?;
        Some(Sensed { taken, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(period: u64, latency: u64) -> Rate {
        Rate { period: Millis(period), latency: Millis(latency) }
    }

    #[test]
    fn a_reading_arrives_a_latency_after_it_is_taken() {
        let mut pipe = Pipe::new(1, 0, rate(10, 25)).unwrap();
        for time in 0..40_u64 {
            if time % 10 == 0 {
                pipe.push(Millis(time), &[time]);
            }
            let arrived = pipe.latest(Millis(time)).map(|it| (it.taken.0, it.value[0]));
            let last = time.checked_sub(25).map(|it| it / 10 * 10);
            assert_eq!(arrived, last.map(|it| (it, it)), "{time}");
        }
    }

    #[test]
    fn a_clock_keeps_its_grid_when_it_is_asked_late() {
        let mut clock = Clock::new(Millis(10));
        let struck: Vec<_> =
            [0, 5, 17, 19, 20, 55, 59, 60].map(|it| clock.strikes(Millis(it))).into();
        assert_eq!(struck, [true, false, true, false, true, true, false, true]);
        assert_eq!(clock.due(), Millis(70));
    }

    #[test]
    fn more_memory_than_the_limit_is_refused() {
        let refused = Pipe::new(10_000, 0, rate(1, 600_000)).unwrap_err();
        assert_eq!(refused.name, "the number of values on their way");
        assert_eq!(Pipe::new(1, 0, rate(0, 1)).unwrap_err().name, "a period in ms");
    }
}
