//! Faults of wheels, encoders, motors and the battery, as data.

use cotama_core::units::Millis;
use cotama_devices::{Disc, Intermittent, MAX_TIME, SettingsError};

/// A side of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// The effect of a fault of the drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Defect {
    /// A wheel does not turn.
    Jam(Side),
    /// The counts of an encoder stop.
    EncoderDead(Side),
    /// An encoder misses this share of the way, from 0 to 1.
    EncoderLossy(Side, f64),
    /// A motor turns its wheel with this share of the speed that it is told, from 0 to 1.
    Weak(Side, f64),
    /// Wheels slip.
    Slip(Slip),
    /// A cell of the battery gives no voltage.
    DeadCell,
}

/// A share of the way of the wheels that is lost: encoders count it, the robot does not go it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// The least share, from 0.
    pub least: f64,
    /// The largest share, up to 1; a number between both is drawn for each wheel each 10 ms.
    pub most: f64,
    /// The part of the floor where they slip; `None` for all of it.
    pub patch: Option<Disc>,
}

/// A fault of the drive: its effect, when, and whether it comes and goes, as a
/// [fault of readings](cotama_devices::Fault) does.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_plane::{Defect, DriveFault, Side};
/// let jam = DriveFault::new(Defect::Jam(Side::Left)).unwrap().from(Millis(500));
/// assert!(!jam.is_due(Millis(499)) && jam.until(Millis(700)).is_due(Millis(500)));
/// let refused = DriveFault::new(Defect::Weak(Side::Left, 2.0)).unwrap_err();
/// assert_eq!(refused.to_string(), "the share of the speed is 2; give a number from 0 to 1");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveFault {
    defect: Defect,
    from: Millis,
    until: Option<Millis>,
    intermittent: Option<Intermittent>,
}

impl DriveFault {
    /// A fault from the beginning on, for good.
    ///
    /// # Errors
    /// Shares that are not from 0 to 1, and a patch that is none.
    pub fn new(defect: Defect) -> Result<Self, SettingsError> {
        match defect {
            Defect::Jam(_) | Defect::EncoderDead(_) | Defect::DeadCell => {}
            Defect::EncoderLossy(_, it) => within("the share of the counts", it, 0.0, 1.0)?,
            Defect::Weak(_, it) => within("the share of the speed", it, 0.0, 1.0)?,
            Defect::Slip(Slip { least, most, patch }) => {
                within("the least slip", least, 0.0, 1.0)?;
                within("the largest slip", most, least, 1.0)?;
                if let Some(Disc { centre, radius }) = patch {
                    within("the patch's x in metres", centre.x, -1e6, 1e6)?;
                    within("the patch's y in metres", centre.y, -1e6, 1e6)?;
                    within("the patch's radius in metres", radius, 0.0, 1e6)?;
                }
            }
        }
        Ok(Self { defect, from: Millis::ZERO, until: None, intermittent: None })
    }

    /// Returns the fault, beginning at a time since the start of the robot.
    #[must_use]
    pub fn from(self, from: Millis) -> Self {
        Self { from, ..self }
    }

    /// Returns the fault, gone at a time.
    #[must_use]
    pub fn until(self, until: Millis) -> Self {
        Self { until: Some(until), ..self }
    }

    /// Returns the fault, coming and going while it lasts.
    ///
    /// # Errors
    /// Times that are not from 1 ms to [`MAX_TIME`].
    pub fn intermittent(self, there: Millis, away: Millis) -> Result<Self, SettingsError> {
        let most = MAX_TIME.0 as f64;
        within("the mean time with the fault in ms", there.0 as f64, 1.0, most)?;
        within("the mean time without the fault in ms", away.0 as f64, 1.0, most)?;
        Ok(Self { intermittent: Some(Intermittent { there, away }), ..self })
    }

    /// Returns the effect.
    pub const fn defect(&self) -> Defect {
        self.defect
    }

    /// Returns whether and how it comes and goes.
    pub const fn pattern(&self) -> Option<Intermittent> {
        self.intermittent
    }

    /// Whether it has begun, and has not ended, at a time.
    pub fn is_due(&self, now: Millis) -> bool {
        self.from <= now && self.until.is_none_or(|until| now < until)
    }
}

/// Says whether a number is in its range; what is no number never is.
pub(crate) fn within(
    name: &'static str,
    given: f64,
    least: f64,
    most: f64,
) -> Result<(), SettingsError> {
    let is_good = (least..=most).contains(&given);
    if is_good { Ok(()) } else { Err(SettingsError { name, given, least, most }) }
}
