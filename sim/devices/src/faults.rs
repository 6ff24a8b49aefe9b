//! Faults at work on a stream of readings.

use crate::fault::{Fault, Mode, Phase};
use crate::sensed::{Pipe, Rate};
use crate::settings::{SettingsError, within};
use cotama_core::units::Millis;
use cotama_streams::{Stream, Streams};

/// The most faults of one stream of readings.
pub const MAX_FAULTS: usize = 64;

/// Faults of a device, which change each frame of its readings one after the other: a scan has a
/// frame of its ranges, a level, a counter or a sonar one of a single number.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Fault, Faults, Mode, Streams};
/// let bias = Fault::new(Mode::Bias(0.5)).unwrap().from(Millis(200));
/// let most = Fault::new(Mode::Saturation { least: 0.0, most: 4.0 }).unwrap();
/// let all = [bias, most];
/// let mut faults = Faults::new(&all, 1, Millis(100), &Streams::new(7), "level").unwrap();
/// let mut read = |time| {
///     let mut frame = [3.75];
///     faults.apply(Millis(time), &mut frame).then_some(frame[0])
/// };
/// assert_eq!([read(100), read(200)], [Some(3.75), Some(4.0)]);
/// ```
#[derive(Clone, Debug)]
pub struct Faults {
    all: Vec<Active>,
    /// The most readings of a frame.
    width: usize,
    /// The least time between two frames.
    period: Millis,
    /// So many readings of a frame are numbers that effects change; all are frozen and late.
    numbers: usize,
}

#[derive(Clone, Debug)]
struct Active {
    fault: Fault,
    chance: Stream,
    phase: Phase,
    memory: Memory,
}

/// The readings that a fault keeps.
#[derive(Clone, Debug)]
enum Memory {
    None,
    /// The last frame, and whether there was one.
    Last(Vec<f64>, bool),
    /// Readings that are delayed.
    Late(Pipe<f64>),
}

impl Faults {
    /// No faults of frames of `width` readings, which come after each `period` or less often:
    /// readings stay as they are.
    pub fn none(width: usize, period: Millis) -> Self {
        Self { all: Vec::new(), width, period, numbers: width }
    }

    /// Puts faults in place of those that there are, for the same frames. Random numbers are named
    /// as by [`new`](Self::new).
    ///
    /// # Errors
    /// As of `new`; the faults stay as they were.
    pub fn replace(
        &mut self,
        faults: &[Fault],
        streams: &Streams,
        name: &str,
    ) -> Result<(), SettingsError> {
        let new = Self::new(faults, self.width, self.period, streams, name)?;
        *self = new.on_first(self.numbers);
        Ok(())
    }

    /// Faults of frames of `width` readings, which come after each `period` or less often. Each
    /// has random numbers of its own, named after `name` and its place in the list.
    ///
    /// # Errors
    /// More than [`MAX_FAULTS`], and delays that need too much memory.
    pub fn new(
        faults: &[Fault],
        width: usize,
        period: Millis,
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        within("the number of faults", faults.len() as f64, 0.0, MAX_FAULTS as f64)?;
        let active = |(at, fault): (usize, &Fault)| {
            let memory = match fault.effect() {
                Mode::Frozen => Memory::Last(vec![0.0; width], false),
                Mode::Delay(by) => {
                    Memory::Late(Pipe::new(width, 0.0, Rate { period, latency: by })?)
                }
                _ => Memory::None,
            };
            let chance = streams.stream(&format!("{name} fault {at}"));
            let phase = Phase::of(fault);
            Ok(Active { fault: *fault, chance, phase, memory })
        };
        let all = faults.iter().enumerate().map(active).collect::<Result<_, _>>()?;
        Ok(Self { all, width, period, numbers: width })
    }

    /// Returns faults whose effects on numbers change only so many readings of each frame; as a
    /// whole it is still lost, frozen or late.
    #[must_use]
    pub fn on_first(self, numbers: usize) -> Self {
        Self { numbers, ..self }
    }

    /// Changes the readings of a frame, but for those beyond the width; returns whether the frame
    /// arrives.
    #[must_use]
    pub fn apply(&mut self, now: Millis, frame: &mut [f64]) -> bool {
        let frame = frame.split_at_mut(self.width.min(frame.len())).0;
        let numbers = self.numbers.min(frame.len());
        self.all.iter_mut().all(|it| it.apply(now, frame, numbers))
    }
}

impl Active {
    fn apply(&mut self, now: Millis, frame: &mut [f64], numbers: usize) -> bool {
        let is_there = self.phase.is_there(&self.fault, &mut self.chance, now);
        match (&mut self.memory, self.fault.effect()) {
            (Memory::Last(last, known), _) => {
                if is_there && *known {
                    copy(last, frame);
                } else {
                    copy(frame, last);
                    *known = true;
                }
            }
            (Memory::Late(pipe), _) => {
                pipe.push(now, frame);
                if is_there {
                    let Some(late) = pipe.latest(now) else { return false };
                    copy(late.value, frame);
                }
            }
            (Memory::None, mode) if is_there => {
                let (numbers, _) = frame.split_at_mut(numbers);
                return self.change(mode, now, numbers);
            }
            (Memory::None, _) => {}
        }
        true
    }

    /// Changes a frame by an effect that needs no memory.
    fn change(&mut self, mode: Mode, now: Millis, frame: &mut [f64]) -> bool {
        match mode {
            Mode::Stuck(value) => frame.fill(value),
            Mode::Bias(by) => frame.iter_mut().for_each(|it| *it += by),
            Mode::Drift { per_s, most } => {
                let since = now.0.saturating_sub(self.fault.begins().0) as f64 / 1_000.0;
                let by = (per_s * since).clamp(-most, most);
                frame.iter_mut().for_each(|it| *it += by);
            }
            Mode::Noise(deviation) => {
                frame.iter_mut().for_each(|it| *it += self.chance.error() * deviation);
            }
            Mode::DropOut(chance) => return self.chance.part() >= chance,
            Mode::Saturation { least, most } => {
                frame.iter_mut().for_each(|it| *it = it.clamp(least, most));
            }
            Mode::Frozen | Mode::Delay(_) => debug_assert!(false, "{mode:?} has a memory"),
        }
        true
    }
}

/// Copies as many readings as both have.
fn copy(from: &[f64], to: &mut [f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}
