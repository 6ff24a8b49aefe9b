//! Numbers for people: grouped digits, metres, seconds, joules.

/// A whole number with its digits in groups of three.
pub(crate) fn grouped(digits: &str) -> String {
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Thousandths with so many decimals, rounded half away from zero, and a unit.
pub(crate) fn milli(value: i128, decimals: u32, unit: &str) -> String {
    let divisor = 10i128.pow(3 - decimals.min(3));
    let rounded = (value.abs() + divisor / 2) / divisor;
    let scale = 10i128.pow(decimals.min(3));
    let sign = if value < 0 && rounded > 0 { "\u{2212}" } else { "" };
    let width = decimals.min(3) as usize;
    if width == 0 {
        return format!("{sign}{rounded}{unit}");
    }
    format!("{sign}{}.{:0width$}{unit}", rounded / scale, rounded % scale)
}

/// Seconds from ms.
pub(crate) fn seconds(ms: impl Into<i128>) -> String {
    milli(ms.into(), 1, " s")
}

/// Joules from mJ.
pub(crate) fn joules(mj: impl Into<i128>) -> String {
    milli(mj.into(), 1, " J")
}

/// Metres from mm.
pub(crate) fn metres(mm: u64) -> String {
    milli(mm.into(), 1, " m")
}

/// Metres from mm, in as few digits as they need.
pub(crate) fn short_metres(mm: u64) -> String {
    match (0..3).find(|&decimals| mm.is_multiple_of(10u64.pow(3 - decimals))) {
        Some(decimals) => milli(mm.into(), decimals, ""),
        None => milli(mm.into(), 3, ""),
    }
}

/// A count and its noun.
pub(crate) fn count(number: u64, noun: &str) -> String {
    let s = if number == 1 { "" } else { "s" };
    format!("{} {noun}{s}", grouped(&number.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousandths_are_rounded_half_away_from_zero() {
        assert_eq!(milli(-85_982, 1, " J"), "\u{2212}86.0 J");
        assert_eq!(milli(-49, 1, ""), "0.0");
        assert_eq!(milli(50, 1, ""), "0.1");
        assert_eq!(milli(72_076, 3, " s"), "72.076 s");
        assert_eq!(milli(1_500, 0, ""), "2");
    }

    #[test]
    fn lengths_take_as_few_digits_as_they_need() {
        assert_eq!([0, 187_000, 63_500, 1_234].map(short_metres), ["0", "187", "63.5", "1.234"]);
    }

    #[test]
    fn digits_are_grouped_from_the_right() {
        assert_eq!(grouped("768288795144192"), "768 288 795 144 192");
        assert_eq!(["1", "12", "123", "1234"].map(grouped), ["1", "12", "123", "1 234"]);
    }
}
