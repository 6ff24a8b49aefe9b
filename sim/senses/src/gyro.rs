//! The gyro.

use cotama_core::units::Millis;
use cotama_devices::{Fault, Gyro, GyroSettings, Mode, Rate, SettingsError, Streams};
use cotama_models::robots::sensing::Gyro as Told;
use cotama_models::robots::{Harm, Harmed};

/// Times of readings: one a period of the observers, at once.
pub(crate) const RATE: Rate = Rate { period: Millis(100), latency: Millis(0) };
/// The time in which a gyro that drifts does so, in seconds.
const DRIFTS_S: f64 = 10.0;

/// Returns the deviations of its bias and of a reading, in rad/s.
pub(crate) fn deviations(of: &Told) -> [f64; 2] {
    [of.bias_urad_s, of.noise_urad_s].map(|it| it as f64 / 1e6)
}

pub(crate) fn gyro(of: &Told, streams: Streams) -> Result<Gyro, SettingsError> {
    let [bias, noise] = deviations(of);
    Gyro::new(&GyroSettings { bias, noise, rate: RATE }, &streams, "gyro")
}

/// Harms the gyro, or mends it.
pub(crate) fn harm(gyro: &mut Gyro, harms: &[Harmed], now: Millis, streams: Streams) {
    let mode = |it: &Harmed| match it.harm {
        Harm::GyroDead => Some(Mode::DropOut(1.0)),
        Harm::GyroDrift => {
            let most = f64::from(it.permille) / 1_000.0;
            Some(Mode::Drift { per_s: most / DRIFTS_S, most })
        }
        _ => None,
    };
    let modes = harms.iter().filter_map(mode);
    let faults: Vec<_> =
        modes.filter_map(|it| Fault::new(it).ok()).map(|it| it.from(now)).collect();
    let set = gyro.faults().replace(&faults, &streams, "gyro");
    debug_assert!(set.is_ok(), "faults of a turn");
}
