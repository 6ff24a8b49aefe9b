//! Numbers for people. Everything in a trace is counted in thousandths of what is shown: mm, ms,
//! mJ, mW, mm/s.

/// A number of thousandths with so many decimals (at most 3), rounded half away from zero.
///
/// From five digits on, thousands are set apart by a narrow space that does not break.
pub(crate) fn milli(value: i128, decimals: usize) -> String {
    const DIVISORS: [u128; 4] = [1000, 100, 10, 1];
    const SCALES: [u128; 4] = [1, 10, 100, 1000];
    let decimals = decimals.min(3);
    let rounded = value.unsigned_abs().saturating_add(DIVISORS[decimals] / 2) / DIVISORS[decimals];
    let (whole, part) = (rounded / SCALES[decimals], rounded % SCALES[decimals]);
    let sign = if value < 0 && rounded > 0 { "\u{2212}" } else { "" };
    let whole = grouped(whole);
    if decimals == 0 {
        format!("{sign}{whole}")
    } else {
        format!("{sign}{whole}.{part:0decimals$}")
    }
}

/// Thousandths without needless zeros: 0.41, 118, 63.4.
pub(crate) fn trimmed(value: u64) -> String {
    let text = milli(i128::from(value), 3);
    text.trim_end_matches('0').trim_end_matches('.').into()
}

/// A whole number, thousands set apart from five digits on.
pub(crate) fn grouped(value: u128) -> String {
    let digits = value.to_string();
    if digits.len() < 5 {
        return digits;
    }
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A place or a length: `63.4 m`.
pub(crate) fn metres(mm: u64) -> String {
    format!("{}\u{a0}m", milli(i128::from(mm), 1))
}

/// A duration in ms: `545.9 s`.
pub(crate) fn seconds(ms: u64) -> String {
    format!("{}\u{a0}s", milli(i128::from(ms), 1))
}

/// A point in time in µs: `545.9 s`.
pub(crate) fn moment(us: u64) -> String {
    seconds(us.saturating_add(500) / 1000)
}

/// An energy in mJ: `8563.6 J`.
pub(crate) fn joules(mj: u64) -> String {
    format!("{}\u{a0}J", milli(i128::from(mj), 1))
}

/// A speed: `0.41 m/s`.
pub(crate) fn speed(mm_s: u64) -> String {
    format!("{}\u{a0}m/s", trimmed(mm_s))
}

/// An energy in mJ as battery makers say it: `2.40 Wh`.
pub(crate) fn watt_hours(mj: u64) -> String {
    format!("{}\u{a0}Wh", milli(i128::from(mj) / 3600, 2))
}

/// A duration as clocks say it: `9 min 6 s`.
pub(crate) fn clock(ms: u64) -> String {
    let seconds = ms.saturating_add(500) / 1000;
    let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
    match (hours, minutes) {
        (0, 0) => format!("{seconds} s"),
        (0, _) => format!("{minutes} min {} s", seconds % 60),
        _ => format!("{hours} h {minutes} min"),
    }
}

/// A count with its noun: `1 replan`, `3 replans`, `no replans`.
pub(crate) fn count(number: u64, noun: &str) -> String {
    match number {
        0 => format!("no {noun}s"),
        1 => format!("1 {noun}"),
        _ => format!("{} {noun}s", grouped(u128::from(number))),
    }
}

/// A share of a whole in percent, with one decimal; 0 of nothing.
pub(crate) fn percent(part: u64, whole: u64) -> String {
    if whole == 0 {
        return "0.0".into();
    }
    milli(i128::from(part).saturating_mul(100_000) / i128::from(whole), 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousandths_are_rounded_half_away_from_zero() {
        assert_eq!(milli(1_250, 1), "1.3");
        assert_eq!(milli(-1_250, 1), "\u{2212}1.3");
        assert_eq!(milli(-49, 1), "0.0");
        assert_eq!(milli(8_563_613, 1), "8563.6");
        assert_eq!(milli(12_345_678_000, 0), "12\u{202f}345\u{202f}678");
        assert_eq!(milli(i128::MIN, 3).chars().next(), Some('\u{2212}'));
    }

    #[test]
    fn units_read_as_in_reports() {
        assert_eq!(
            (trimmed(410), trimmed(118_000), trimmed(0)),
            ("0.41".into(), "118".into(), "0".into())
        );
        assert_eq!((clock(545_900), clock(7_300_000)), ("9 min 6 s".into(), "2 h 1 min".into()));
        assert_eq!((watt_hours(8_640_000), percent(1, 8)), ("2.40\u{a0}Wh".into(), "12.5".into()));
        assert_eq!(
            (count(0, "replan"), count(1, "replan")),
            ("no replans".into(), "1 replan".into())
        );
    }
}
