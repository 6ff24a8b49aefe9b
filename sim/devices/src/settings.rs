//! Numbers of a device that are out of range.

/// A number that no device has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettingsError {
    /// The name of the number, with its unit.
    pub name: &'static str,
    /// The number that was given.
    pub given: f64,
    /// The least that may be given.
    pub least: f64,
    /// The most that may be given.
    pub most: f64,
}

impl core::fmt::Display for SettingsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { name, given, least, most } = self;
        write!(f, "{name} is {given}; give a number from {least} to {most}")
    }
}

impl core::error::Error for SettingsError {}

/// Says whether a number is in its range; what is no number never is. Names have the unit.
///
/// ```
/// use cotama_devices::within;
/// assert!(within("a period in ms", 100.0, 1.0, 600_000.0).is_ok());
/// let refused = within("a period in ms", f64::NAN, 1.0, 600_000.0).unwrap_err();
/// assert_eq!(refused.to_string(), "a period in ms is NaN; give a number from 1 to 600000");
/// ```
///
/// # Errors
/// A number that is not.
pub fn within(name: &'static str, given: f64, least: f64, most: f64) -> Result<(), SettingsError> {
    let is_good = (least..=most).contains(&given);
    if is_good { Ok(()) } else { Err(SettingsError { name, given, least, most }) }
}
