//! Faults of wheels, encoders, motors and the battery, as data.

use cotama_devices::{Disc, Effect, Fault, SettingsError, within};

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
    /// A wheel is smaller by this share of its radius, which odometry does not know, from 0 to 1.
    Worn(Side, f64),
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

/// A fault of the drive: what of it is broken, when, and whether it comes and goes. Its times count
/// from the start of the robot.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_plane::{Defect, DriveFault, Side};
/// let jam = DriveFault::new(Defect::Jam(Side::Left)).unwrap().from(Millis(500));
/// assert!(!jam.is_due(Millis(499)) && jam.until(Millis(700)).is_due(Millis(500)));
/// let refused = DriveFault::new(Defect::Weak(Side::Left, 2.0)).unwrap_err();
/// assert_eq!(refused.to_string(), "the share of the speed is 2; give a number from 0 to 1");
/// ```
pub type DriveFault = Fault<Defect>;

impl Effect for Defect {
    fn check(self) -> Result<(), SettingsError> {
        match self {
            Self::Jam(_) | Self::EncoderDead(_) | Self::DeadCell => Ok(()),
            Self::EncoderLossy(_, it) => within("the share of the counts", it, 0.0, 1.0),
            Self::Weak(_, it) => within("the share of the speed", it, 0.0, 1.0),
            Self::Worn(_, it) => within("the share of the radius", it, 0.0, 1.0),
            Self::Slip(Slip { least, most, patch }) => {
                within("the least slip", least, 0.0, 1.0)?;
                within("the largest slip", most, least, 1.0)?;
                let Some(Disc { centre, radius }) = patch else { return Ok(()) };
                within("the patch's x in metres", centre.x, -1e6, 1e6)?;
                within("the patch's y in metres", centre.y, -1e6, 1e6)?;
                within("the patch's radius in metres", radius, 0.0, 1e6)
            }
        }
    }
}
