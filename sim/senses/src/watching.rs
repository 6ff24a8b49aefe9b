//! The observers of lasers, marks and the gyro, and what they raise.

use crate::bench::Bench;
use crate::gyro;
use cotama_core::units::Millis;
use cotama_devices::{Rate, Sensed, SettingsError};
use cotama_models::robots::{Sensing, Watch};
use cotama_observers::{
    Age, Deadlines, FalseAlarms, Flag, Job, Lasting, OdometryErrors, Turn, Turns,
};

/// The chance that a mark is not found that is in the picture: somebody stands before it (assumed).
const HIDDEN: f64 = 0.1;
/// The window over which turns are compared.
const WINDOW: Millis = Millis(2_000);

/// Signals that are raised, a bit for each laser.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Raised {
    silent: u64,
    blind: u64,
    apart: u64,
    marks: bool,
    gyro_silent: bool,
    gyro_apart: bool,
}

impl Raised {
    /// Whether a signal of these devices is raised; no other is.
    pub(crate) fn is_up(&self, watch: Watch) -> bool {
        let of = |set: u64, laser: Option<u8>| laser.map_or(set != 0, |it| set >> it & 1 == 1);
        match watch {
            Watch::LaserSilent(it) => of(self.silent, it),
            Watch::LaserBlind(it) => of(self.blind, it),
            Watch::LaserApart(it) => of(self.apart, it),
            Watch::MarksMissing => self.marks,
            Watch::GyroSilent => self.gyro_silent,
            Watch::GyroApart => self.gyro_apart,
            _ => false,
        }
    }
}

/// Signals of one laser: when its newest scan was taken, whether it sees nothing, and whether it
/// does not match the map.
pub(crate) struct Scan {
    pub(crate) taken: Option<Millis>,
    pub(crate) is_blind: Option<Sensed<bool>>,
    pub(crate) is_apart: Option<Sensed<bool>>,
}

#[derive(Clone, Debug)]
struct Scanner {
    silent: Age,
    blind: Lasting,
    apart: Lasting,
}

/// The observers.
#[derive(Clone, Debug)]
pub(crate) struct Watching {
    lasers: Vec<Scanner>,
    marks: Option<Deadlines>,
    gyro: Option<(Age, Turns)>,
}

fn age(rate: Rate, promise: FalseAlarms) -> Result<Age, SettingsError> {
    Age::new(rate, Millis(10), 0.05, promise)
}

impl Watching {
    pub(crate) fn new(
        of: &Sensing,
        bench: &Bench,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        let all = of.lasers.iter().zip(&bench.scans);
        let lasers = all.map(|(it, [blind, apart])| {
            let rate = Rate { period: it.times[0], latency: it.times[1] };
            Ok(Scanner {
                silent: age(rate, promise)?,
                blind: Lasting::new(*blind, promise),
                apart: Lasting::new(*apart, promise),
            })
        });
        let lasers = lasers.collect::<Result<_, SettingsError>>()?;
        let marks = of.camera.map(|it| Deadlines::new(it.times[0], HIDDEN, promise)).transpose()?;
        let gyro = of.gyro.map(|it| {
            let errors = OdometryErrors::pioneer();
            let turns = Turns::new(errors, gyro::deviations(&it), WINDOW, promise)?;
            Ok((age(gyro::RATE, promise)?, turns))
        });
        Ok(Self { lasers, marks, gyro: gyro.transpose()? })
    }

    /// Looks at the signals of a period; a picture that is new is a job of the marks.
    pub(crate) fn look(
        &mut self,
        now: Millis,
        scans: impl Iterator<Item = Scan>,
        marks: Option<Job>,
        turn: Option<Sensed<Turn>>,
    ) -> Raised {
        let is_up = |it: Flag| it == Flag::Raised;
        let bit = |flag: Flag, at: usize| u64::from(is_up(flag)) << at;
        let mut raised = Raised::default();
        for ((at, it), scan) in self.lasers.iter_mut().enumerate().zip(scans) {
            raised.silent |= bit(it.silent.observe(now, scan.taken), at);
            raised.blind |= bit(it.blind.observe(scan.is_blind), at);
            raised.apart |= bit(it.apart.observe(scan.is_apart), at);
        }
        raised.marks = self.marks.as_mut().is_some_and(|it| is_up(it.observe(marks)));
        if let Some((age, turns)) = &mut self.gyro {
            raised.gyro_silent = is_up(age.observe(now, turn.map(|it| it.taken)));
            raised.gyro_apart = is_up(turns.observe(turn));
        }
        raised
    }
}
