//! Values of keys: their units, what to write for a quantity in another one, and their few words.

use super::Sink;
use crate::missions::Does;
use toml::de::DeValue;

/// The unit that a key ends with, the unit of files, and how many of that it is.
const UNITS: [(&str, &str, u64); 20] = [
    ("m", "mm", 1_000),
    ("cm", "mm", 10),
    ("km", "mm", 1_000_000),
    ("s", "ms", 1_000),
    ("sec", "ms", 1_000),
    ("min", "ms", 60_000),
    ("h", "ms", 3_600_000),
    ("j", "mj", 1_000),
    ("kj", "mj", 1_000_000),
    ("wh", "mj", 3_600_000),
    ("w", "mw", 1_000),
    ("kw", "mw", 1_000_000),
    ("kg", "g", 1_000),
    ("t", "g", 1_000_000),
    ("m_s", "mm_s", 1_000),
    ("cm_s", "mm_s", 10),
    ("m_per_s", "mm_s", 1_000),
    ("percent", "permille", 10),
    ("dm", "mm", 100),
    ("mwh", "mj", 3_600),
];

/// The line to write where a key is one that is known, in another unit.
pub(super) fn in_its_unit(
    found: &str,
    known: &str,
    value: &DeValue<'_>,
    sink: &Sink,
) -> Option<String> {
    let found = found.to_lowercase();
    let stem_of =
        |key: &str, unit: &str| Some(key.strip_suffix(unit)?.strip_suffix('_')?.to_owned());
    let same = |it: &&(&str, &str, u64)| {
        let stem = stem_of(&found, it.0);
        stem.is_some() && stem == stem_of(known, it.1)
    };
    let &(unit, wanted, factor) = UNITS.iter().find(same)?;
    let digits = match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().to_owned(),
        DeValue::Float(float) => float.as_str().to_owned(),
        _ => String::new(),
    };
    Some(match times(&digits, factor) {
        Some(number) => format!("write `{}`", sink.entry(known, &number.to_string())),
        None => format!("write `{known}`: one {unit} is {factor} {wanted}"),
    })
}

/// A decimal number times a whole one, if that is whole.
fn times(digits: &str, factor: u64) -> Option<u64> {
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let fraction = fraction.trim_end_matches('0');
    let number: u64 = [whole, fraction].concat().parse().ok()?;
    let parts = 10_u64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    let product = number.checked_mul(factor)?;
    product.is_multiple_of(parts).then_some(product / parts)
}

/// The units with which keys end.
const ENDS: [&str; 9] = ["mm_s", "per_dm", "permille", "deg", "mm", "ms", "mj", "mw", "g"];

/// Whether a key is one that is known, without its unit.
pub(super) fn is_without_unit(found: &str, known: &str) -> bool {
    let unit = known.strip_prefix(found).and_then(|it| it.strip_prefix('_'));
    unit.is_some_and(|it| ENDS.contains(&it))
}

/// Says in which unit the value of a key is, as its name ends; empty where it has none.
pub(super) fn unit(key: &str) -> String {
    let ends = |unit: &&str| key.strip_suffix(*unit).is_some_and(|it| it.ends_with('_'));
    let said = match ENDS.into_iter().find(ends) {
        Some("mm_s") => "mm/s",
        Some("per_dm") => "a whole number for each 100 mm of way",
        Some("permille") => "\u{2030}",
        Some("mj") => "mJ",
        Some("mw") => "mW",
        Some(unit) => unit,
        None => return String::new(),
    };
    format!(", in {said}").replace(", in a whole", ", a whole")
}

/// Lists what the value of a key may be, where it is one of few words; else empty.
pub(super) fn values(key: &str) -> String {
    if key == "does" { format!(": one of {}", Does::NAMES.join(", ")) } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::times;

    #[test]
    fn decimals_are_multiplied_exactly() {
        for (digits, factor, product) in [
            ("120", 1_000, Some(120_000)),
            ("0.5", 1_000, Some(500)),
            ("1.25", 10, None),
            ("1.250", 1_000, Some(1_250)),
            ("2.4", 3_600_000, Some(8_640_000)),
            ("-3", 10, None),
            ("1e3", 10, None),
            ("", 10, None),
            ("99999999999999999999", 10, None),
        ] {
            assert_eq!(times(digits, factor), product, "{digits}");
        }
    }
}
