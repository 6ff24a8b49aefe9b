//! Quantiles of the normal and the chi-square distribution, by what lies above them.

/// Returns the chance that a normal number of mean 0 and deviation 1 is above `x`: erfc(x/√2)/2
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, 1964, 26.2.29).
pub fn normal_above(x: f64) -> f64 {
    libm::erfc(x * core::f64::consts::FRAC_1_SQRT_2) / 2.0
}

/// Returns the number that a normal one of mean 0 and deviation 1 exceeds with a chance.
///
/// Begins with Abramowitz and Stegun, 26.2.23 (wrong by at most 4.5·10⁻⁴), and goes on by Halley's
/// steps on [`normal_above`]. A chance outside of 10⁻³⁰⁰ to 1 - 10⁻¹⁶ counts as the nearest one.
///
/// ```
/// use cotama_observers::normal_quantile;
/// assert_eq!(format!("{:.6}", normal_quantile(0.025)), "1.959964");
/// assert_eq!(format!("{:.6}", normal_quantile(1e-9)), "5.997807");
/// ```
pub fn normal_quantile(chance: f64) -> f64 {
    let chance = chance.clamp(1e-300, 1.0 - 1e-16);
    if chance > 0.5 {
        return -normal_quantile(1.0 - chance);
    }
    let t = libm::sqrt(-2.0 * libm::log(chance));
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let mut x = t - above / below;
    for _ in 0..4 {
        let density = libm::exp(-x * x / 2.0) * 0.398_942_280_401_432_7;
        if density <= 0.0 {
            break;
        }
        let step = (normal_above(x) - chance) / density;
        x += step / (1.0 - x * step / 2.0);
    }
    x
}

/// The most terms of a series or of a continued fraction.
const TERMS: usize = 10_000;

/// Returns the chance that a chi-square number of some degrees of freedom is above `x`.
///
/// The incomplete gamma function Q(k/2, x/2): by its series (Abramowitz and Stegun, 6.5.29) up to
/// x = k + 2, beyond by its continued fraction (6.5.31, with Lentz's method as in Press et al.,
/// Numerical Recipes, 3rd ed., 2007, Section 6.2).
pub fn chi_square_above(degrees: u32, x: f64) -> f64 {
    let (half, x) = (f64::from(degrees.max(1)) / 2.0, x / 2.0);
    if x <= 0.0 {
        return 1.0;
    }
    let front = libm::exp(half * libm::log(x) - x - libm::lgamma(half));
    if x < half + 1.0 {
        let (mut term, mut sum) = (1.0 / half, 1.0 / half);
        for at in 1..TERMS {
            term *= x / (half + at as f64);
            sum += term;
            if term < sum * 1e-17 {
                break;
            }
        }
        return (1.0 - front * sum).max(0.0);
    }
    let mut denominator = x + 1.0 - half;
    let (mut above, mut below) = (1e300, 1.0 / denominator);
    let mut fraction = below;
    for at in 1..TERMS {
        let at = at as f64;
        let numerator = -at * (at - half);
        denominator += 2.0;
        below = 1.0 / (numerator * below + denominator);
        above = denominator + numerator / above;
        fraction *= below * above;
        if (below * above - 1.0).abs() < 1e-16 {
            break;
        }
    }
    front * fraction
}

/// Returns the number that a chi-square one of some degrees of freedom exceeds with a chance, by
/// bisection of [`chi_square_above`]. A chance outside of 10⁻³⁰⁰ to 1 counts as the nearest one.
///
/// ```
/// use cotama_observers::chi_square_quantile;
/// assert_eq!(format!("{:.3}", chi_square_quantile(3, 0.001)), "16.266");
/// ```
pub fn chi_square_quantile(degrees: u32, chance: f64) -> f64 {
    let chance = chance.clamp(1e-300, 1.0);
    let (mut low, mut high) = (0.0, f64::from(degrees.max(1)));
    while chi_square_above(degrees, high) > chance {
        low = high;
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if chi_square_above(degrees, middle) > chance {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, Table 26.8, and the table of NIST's e-Handbook, 1.3.6.7.4.
    #[test]
    fn chi_square_quantiles_are_those_of_printed_tables() {
        let printed = [
            (1, 0.05, "3.841"),
            (1, 0.001, "10.828"),
            (2, 0.05, "5.991"),
            (2, 0.01, "9.210"),
            (3, 0.05, "7.815"),
            (3, 0.01, "11.345"),
            (3, 0.001, "16.266"),
            (5, 0.05, "11.070"),
            (10, 0.05, "18.307"),
            (10, 0.001, "29.588"),
            (10, 0.95, "3.940"),
            (10, 0.99, "2.558"),
            (30, 0.05, "43.773"),
            (100, 0.05, "124.342"),
            (100, 0.001, "149.449"),
            (100, 0.95, "77.929"),
        ];
        for (degrees, chance, text) in printed {
            assert_eq!(format!("{:.3}", chi_square_quantile(degrees, chance)), text, "{degrees}");
        }
    }

    /// Abramowitz and Stegun, Table 26.5.
    #[test]
    fn normal_quantiles_are_those_of_printed_tables() {
        let printed = [
            (0.5, "0.00000"),
            (0.1, "1.28155"),
            (0.05, "1.64485"),
            (0.01, "2.32635"),
            (0.001, "3.09023"),
            (0.0001, "3.71902"),
            (0.975, "-1.95996"),
        ];
        for (chance, text) in printed {
            assert_eq!(
                format!("{:.5}", normal_quantile(chance)).replace("-0.00000", "0.00000"),
                text
            );
        }
    }

    /// With 2 degrees of freedom a chi-square number is above x with the chance exp(-x/2); with 1
    /// it is the square of a normal number.
    #[test]
    fn quantiles_agree_where_a_closed_form_is_known() {
        for chance in [0.5, 1e-3, 1e-6, 1e-12, 1e-100] {
            let two = chi_square_quantile(2, chance);
            assert!((two + 2.0 * libm::log(chance)).abs() < 1e-9 * two, "{chance}");
            let (one, z) = (chi_square_quantile(1, chance), normal_quantile(chance / 2.0));
            assert!((one - z * z).abs() < 1e-9 * one, "{chance}: {one} {}", z * z);
        }
    }
}
