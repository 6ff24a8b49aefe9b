//! Whole numbers on the command line, with the unit that they are in.

use clap::builder::TypedValueParser;

/// A unit in which people think, and how many of the unit that is read it has.
type Unit = (&'static str, f64);

const DURATIONS: [Unit; 4] = [("ms", 1.0), ("s", 1e3), ("min", 6e4), ("h", 3.6e6)];
const ENERGIES: [Unit; 4] = [("mJ", 1.0), ("J", 1e3), ("kJ", 1e6), ("Wh", 3.6e6)];

/// A number from `least` to `most`.
pub(super) fn whole(least: u64, most: u64) -> impl TypedValueParser<Value = u64> {
    move |text: &str| -> Result<u64, String> {
        let number = text.parse().ok().filter(|it| (least..=most).contains(it));
        number.ok_or_else(|| format!("a whole number from {least} to {most} is needed"))
    }
}

/// A duration in ms, at least one.
pub(super) fn duration(text: &str) -> Result<u64, String> {
    quantity(text, DURATIONS)
}

/// An energy in mJ, at least one.
pub(super) fn energy(text: &str) -> Result<u64, String> {
    quantity(text, ENERGIES)
}

/// A number of the first unit; one of another unit is not read, but it is said what to write.
fn quantity(text: &str, units: [Unit; 4]) -> Result<u64, String> {
    if let Some(number) = text.parse().ok().filter(|it| *it > 0) {
        return Ok(number);
    }
    let [(unit, _), ..] = units;
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, said) = text.split_at(end);
    let factor = units.into_iter().find(|it| it.0 == said.trim()).map(|it| it.1);
    let meant = factor.and_then(|factor| Some(number.parse::<f64>().ok()? * factor));
    let write = match meant.filter(|it| (1.0..1e15).contains(it)) {
        Some(meant) => format!(": write {meant:.0}"),
        None => String::new(),
    };
    Err(format!("a whole number of {unit}, at least 1, is needed{write}"))
}

#[cfg(test)]
mod tests {
    use super::{duration, energy};

    #[test]
    fn a_number_with_a_unit_is_not_read_but_converted() {
        assert_eq!((duration("180000"), energy("8640000")), (Ok(180_000), Ok(8_640_000)));
        let said = |write: &str| Err(format!("a whole number of ms, at least 1, is needed{write}"));
        for (text, write) in [
            ("3min", ": write 180000"),
            ("1.5 s", ": write 1500"),
            ("7ms", ": write 7"),
            ("0.0001s", ""),
            ("3 parsecs", ""),
            ("0", ""),
            ("-4", ""),
            ("", ""),
            ("s", ""),
            ("1.2.3s", ""),
            ("99999999999999999999h", ""),
        ] {
            assert_eq!(duration(text), said(write), "{text}");
        }
        assert!(energy("2.4Wh").unwrap_err().ends_with(": write 8640000"));
    }
}
