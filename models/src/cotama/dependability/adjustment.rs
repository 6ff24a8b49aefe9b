//! The changes that an adapter makes on a failure that is weak or medium and takes no module: the
//! reaction column of the FMECA, as far as it is a setting.
//!
//! Stated (Durand et al., TAROS 2010) is that the sub-objective stays and its modules are set up
//! differently (Section V.B), by other parameters for instance (Section V.C.3). Which parameters,
//! and all numbers, are assumed.
//!
//! | adjustment | rows | speed | quality |
//! | --- | --- | --- | --- |
//! | reject readings | SON4 | | 750 ‰: that of fewer particles |
//! | trust localisation | ODO2 | 800 ‰ | 900 ‰ |
//! | widen noise | ODO3 | | 900 ‰ |
//! | recalibrate | ODO4 | | 950 ‰ |
//! | fewer frames | CAM2, COM2 | 500 ‰ while the operator drives | 800 ‰ then |
//! | lower limits | MOT2 | 500 ‰ | |
//! | widen tolerance | P3D2 | 700 ‰: data are older | |
//! | give way | HUM1 | 500 ‰ | |
//! | go carefully | COL1 | 500 ‰ | |

use crate::cotama::members::members;
use crate::cotama::modules::Mode;

members! {
    /// A change that an adapter makes while a weak or medium failure lasts.
    Adjustment,
    /// Adjustments.
    Adjustments(u16) {
        /// Sonar readings that do not fit are rejected sooner, and weigh less in localisation.
        RejectReadings = "reject readings",
        /// The pose is that of localisation; odometry counts as noisy.
        TrustLocalisation = "trust localisation",
        /// Odometry counts as noisy for a while.
        WidenNoise = "widen noise",
        /// The drift of odometry is estimated and taken off.
        Recalibrate = "recalibrate",
        /// Fewer frames are sent; while the operator drives by them, slower.
        FewerFrames = "fewer frames",
        /// Lower limits of speed and acceleration.
        LowerLimits = "lower limits",
        /// The watchdog of the link to the robot tolerates more; slower.
        WidenTolerance = "widen tolerance",
        /// Waits, then goes on slowly.
        GiveWay = "give way",
        /// Slower after a contact.
        GoCarefully = "go carefully",
    }
}

/// How much is left of speed and quality, in thousandths.
///
/// ```
/// use cotama_models::cotama::{Adjusted, Adjustment, Mode};
/// let slower = Adjusted { speed: 500, quality: 1_000 };
/// assert_eq!(Adjustment::GiveWay.effect(Mode::Autonomous), slower);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Adjusted {
    /// Factor of the speed limit of the configuration, in thousandths.
    pub speed: u16,
    /// Factor of the quality of driven activities, in thousandths.
    pub quality: u16,
}

impl Adjustment {
    /// For how long, in milliseconds, it outlasts its failure: assumed.
    pub const HOLD_MS: u32 = 5_000;

    /// Returns the factors that the adjustment leaves in an autonomy mode.
    pub const fn effect(self, mode: Mode) -> Adjusted {
        let driven = matches!(mode, Mode::Teleoperated);
        let (speed, quality) = match self {
            Self::RejectReadings => (1_000, 750),
            Self::TrustLocalisation => (800, 900),
            Self::WidenNoise => (1_000, 900),
            Self::Recalibrate => (1_000, 950),
            Self::FewerFrames if driven => (500, 800),
            Self::FewerFrames => (1_000, 1_000),
            Self::LowerLimits | Self::GiveWay | Self::GoCarefully => (500, 1_000),
            Self::WidenTolerance => (700, 1_000),
        };
        Adjusted { speed, quality }
    }
}

impl Adjustments {
    /// Returns the factors that the adjustments leave together: the least of each.
    ///
    /// ```
    /// use cotama_models::cotama::{Adjusted, Adjustment, Adjustments, Mode};
    /// let both = Adjustments::of(&[Adjustment::WidenTolerance, Adjustment::FewerFrames]);
    /// assert_eq!(both.effect(Mode::Autonomous), Adjusted { speed: 700, quality: 1_000 });
    /// assert_eq!(both.effect(Mode::Teleoperated), Adjusted { speed: 500, quality: 800 });
    /// ```
    pub fn effect(self, mode: Mode) -> Adjusted {
        self.iter().map(|it| it.effect(mode)).fold(
            Adjusted { speed: 1_000, quality: 1_000 },
            |left, it| Adjusted {
                speed: left.speed.min(it.speed),
                quality: left.quality.min(it.quality),
            },
        )
    }
}
