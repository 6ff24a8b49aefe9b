//! Firings with their dates.

use cotama_core::net::TransitionId;
use std::fmt;

/// A time since the start, in the unit of the net: a fraction in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Date {
    /// Numerator, in parts of a unit.
    pub parts: u64,
    /// How many parts are one unit: a power of two, and 1 when no open bound asks for more.
    pub per_unit: u64,
}

impl fmt::Display for Date {
    /// The exact decimal: `3`, `2.5`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.parts / self.per_unit)?;
        let mut rest = u128::from(self.parts % self.per_unit);
        if rest > 0 {
            f.write_str(".")?;
        }
        while rest > 0 {
            rest *= 10;
            write!(f, "{}", rest / u128::from(self.per_unit))?;
            rest %= u128::from(self.per_unit);
        }
        Ok(())
    }
}

/// A firing at its date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The transition fired.
    pub transition: TransitionId,
    /// Time of the firing.
    pub date: Date,
}

/// A timed run: the firings in their order, each as early as the whole sequence allows in steps of
/// one part.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Schedule {
    /// The firings.
    pub steps: Vec<Step>,
}
