//! What an adapter changes on a failure that is weak or medium and takes no module: the reaction
//! column of the FMECA, as far as it is a setting.
//!
//! Stated is that such a failure goes on "with an adapted configuration of the low level modules"
//! (Durand et al., TAROS 2010, Section V.B), and that the adapter may change parameters of modules
//! (Section V.C.3). Which parameters, and all numbers, are assumed.
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

use super::diagnosis::Diagnosis;
use super::table::FailureMode;
use crate::cotama::members::members;
use crate::cotama::modules::Mode;

members! {
    /// What an adapter changes while a weak or medium failure lasts.
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
    /// Of the speed limit of the configuration.
    pub speed: u16,
    /// Of the quality of what is driven.
    pub quality: u16,
}

impl Adjustment {
    /// For how long, in milliseconds, it outlasts its failure: assumed.
    pub const HOLD_MS: u32 = 5_000;

    /// What it leaves in an autonomy mode.
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
    /// What they leave together: the least of each.
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

impl FailureMode {
    /// What an adapter changes on it, if that is a setting.
    pub const fn adjustment(self) -> Option<Adjustment> {
        self.rule().adjustment
    }
}

impl Diagnosis {
    /// What an adapter changes: what the rows of all candidates say alike.
    ///
    /// ```
    /// use cotama_models::cotama::{Adjustment, Diagnosis, FailureMode, FailureModes};
    /// let late = Diagnosis::Ambiguous(FailureModes::of(&[FailureMode::Cam2, FailureMode::Com2]));
    /// assert_eq!(late.adjustment(), Some(Adjustment::FewerFrames));
    /// ```
    pub fn adjustment(self) -> Option<Adjustment> {
        match self {
            Self::Unique(mode) => mode.adjustment(),
            Self::Ambiguous(modes) => {
                let first = modes.first().and_then(FailureMode::adjustment);
                first.filter(|_| modes.iter().all(|it| it.adjustment() == first))
            }
            Self::None | Self::Unexplained => None,
        }
    }
}
