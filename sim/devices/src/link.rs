//! Radio links.

use crate::faults::Faults;
use crate::sensed::{Clock, Pipe, Rate, Sensed};
use crate::settings::{SettingsError, within};
use cotama_core::units::Millis;
use cotama_floor::{Point, Surface};
use cotama_streams::{Stream, Streams};

/// Properties of a radio link to access points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkSettings {
    /// Level at 1 m from an access point, in dBm.
    pub at_1_m_dbm: f64,
    /// Exponent of the loss: 2 in free space, less along corridors, more among furniture.
    pub exponent: f64,
    /// Loss of a wall, in dB.
    pub wall_db: f64,
    /// More walls than these lose no more: waves go around.
    pub most_walls: usize,
    /// Deviation of a level, in dB.
    pub noise_db: f64,
    /// Times of measurements.
    pub rate: Rate,
}

impl LinkSettings {
    /// Radio in an office: 3.1 dB for each wall up to 4 (Bahl and Padmanabhan, "RADAR", INFOCOM
    /// 2000, the wall attenuation factor model). Assumed: an exponent of 3, -40 dBm at 1 m, a
    /// deviation of 2 dB, a level every 500 ms, no latency.
    pub fn wifi() -> Self {
        Self {
            at_1_m_dbm: -40.0,
            exponent: 3.0,
            wall_db: 3.1,
            most_walls: 4,
            noise_db: 2.0,
            rate: Rate { period: Millis(500), latency: Millis(0) },
        }
    }

    /// Returns the level at a point without noise, in dBm: `P₁ - 10 n log₁₀ d - min(w, C) W`, with
    /// `n` the exponent, `d` the distance in metres and at least 1, `w` walls of `W` dB each, of
    /// which `C` count.
    ///
    /// The log-distance path loss model (Rappaport, Wireless Communications, 2nd edition, 2002,
    /// Section 4.9.1) with the walls of RADAR.
    pub fn level(&self, floor: &dyn Surface, access_point: Point, at: Point) -> f64 {
        let distance = (at - access_point).norm().max(1.0);
        let walls = floor.walls_between(access_point, at).min(self.most_walls);
        self.at_1_m_dbm - 10.0 * self.exponent * libm::log10(distance) - walls as f64 * self.wall_db
    }
}

/// The most access points.
pub const MAX_ACCESS_POINTS: usize = 256;

/// A link to the access point that is heard best: its level.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Link, LinkSettings, Streams};
/// use cotama_floor::{Point, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Real, &[]).unwrap();
/// let settings = LinkSettings { noise_db: 0.0, ..LinkSettings::wifi() };
/// let points = [Point::new(15.0, 10.5)];
/// let mut link = Link::new(&settings, &points, &Streams::new(7), "wifi").unwrap();
/// let mut level = |time, x, y| {
///     link.sense(Millis(time), Point::new(x, y), &surface);
///     link.latest(Millis(time)).unwrap().value
/// };
/// assert_eq!(level(0, 5.0, 10.5), -70.0); // 10 m along the corridor
/// assert!(level(500, 24.0, 14.0) < -72.0); // less far in office C, but behind a wall
/// ```
#[derive(Clone, Debug)]
pub struct Link {
    settings: LinkSettings,
    access_points: Vec<Point>,
    clock: Clock,
    noise: Stream,
    faults: Faults,
    pipe: Pipe<f64>,
}

impl Link {
    /// A link of a name, after which its random numbers are named.
    ///
    /// # Errors
    /// Numbers that are out of range; there is one access point at least.
    pub fn new(
        settings: &LinkSettings,
        access_points: &[Point],
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        let count = access_points.len() as f64;
        within("the number of access points", count, 1.0, MAX_ACCESS_POINTS as f64)?;
        within("the level at 1 m in dBm", settings.at_1_m_dbm, -200.0, 100.0)?;
        within("the exponent of the loss", settings.exponent, 0.0, 10.0)?;
        within("the loss of a wall in dB", settings.wall_db, 0.0, 200.0)?;
        within("the deviation of a level in dB", settings.noise_db, 0.0, 100.0)?;
        Ok(Self {
            settings: *settings,
            access_points: access_points.to_vec(),
            clock: Clock::new(settings.rate.period),
            noise: streams.stream(name),
            faults: Faults::none(1, settings.rate.period),
            pipe: Pipe::new(1, 0.0, settings.rate)?,
        })
    }

    /// Returns the faults of its level, to be replaced; [`Mode::fading`] is one.
    ///
    /// [`Mode::fading`]: crate::Mode::fading
    pub fn faults(&mut self) -> &mut Faults {
        &mut self.faults
    }

    /// The time of the next measurement.
    pub fn due(&self) -> Millis {
        self.clock.due()
    }

    /// Measures the level if it is due, for a robot at a point.
    pub fn sense(&mut self, now: Millis, robot: Point, floor: &dyn Surface) {
        if !self.clock.strikes(now) {
            return;
        }
        let levels = self.access_points.iter().map(|it| self.settings.level(floor, *it, robot));
        let best = levels.fold(f64::NEG_INFINITY, f64::max);
        let mut level = [best + self.noise.error() * self.settings.noise_db];
        if self.faults.apply(now, &mut level) {
            self.pipe.push(now, &level);
        }
    }

    /// Returns the newest level that has arrived, in dBm.
    pub fn latest(&self, now: Millis) -> Option<Sensed<f64>> {
        let it = self.pipe.latest(now)?;
        Some(Sensed { taken: it.taken, value: it.value.first().copied()? })
    }
}
