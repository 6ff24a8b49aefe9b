//! Decimal numbers in thousandths, exactly.

/// A decimal number without sign, as `400`, `0.5` or `1.2e6`, in thousandths; `None` for what is no
/// such number, has more than three decimals, or is too large.
pub(crate) fn thousandths(text: &str) -> Option<u64> {
    let text = text.trim();
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: String = whole.chars().chain(fraction.chars()).filter(|&c| c != '_').collect();
    if digits.is_empty() || digits.len() > 18 || !digits.chars().all(|c| c.is_ascii_digit()) {
        return None;
    }
    let number: u64 = digits.parse().ok()?;
    let decimals = fraction.chars().filter(|&c| c != '_').count();
    let shift = exponent.checked_add(3)?.checked_sub(i32::try_from(decimals).ok()?)?;
    let power = 10_u64.checked_pow(shift.unsigned_abs());
    if shift >= 0 {
        return if number == 0 { Some(0) } else { number.checked_mul(power?) };
    }
    // Digits beyond the third decimal must be zero.
    match power {
        Some(power) if number.is_multiple_of(power) => Some(number / power),
        None if number == 0 => Some(0),
        _ => None,
    }
}
