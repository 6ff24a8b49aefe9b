//! How different robots are.

use super::capability::{CapabilitySet, Robot};
use super::ratio::Ratio;

/// The least common multiple of 1 to 64: two robots have at most 64 capabilities together.
const COMMON: u128 = {
    let (mut all, mut number) = (1_u128, 2_u128);
    while number <= 64 {
        let (mut a, mut b) = (all, number);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        all *= number / a;
        number += 1;
    }
    all
};

/// How different two robots are (def. 3.7): the capabilities that only one has over those of both,
/// each counted for itself. 0 where they are equal, 1 where they share nothing.
///
/// ```
/// use cotama_models::team::{Ratio, mutual_heterogeneity, service::{EDDIE, POPPY}};
/// let h = mutual_heterogeneity(EDDIE.capabilities(), POPPY.capabilities());
/// assert_eq!(Some(h), Ratio::new(3, 7));
/// ```
pub fn mutual_heterogeneity(one: CapabilitySet, other: CapabilitySet) -> Ratio {
    let (differ, all) = differ(one, other);
    Ratio::new(differ.into(), all.into()).unwrap_or(Ratio::ZERO)
}

/// Symmetric difference, and the sum of both sizes.
fn differ(one: CapabilitySet, other: CapabilitySet) -> (u32, u32) {
    (one.difference(other).len(), one.len().saturating_add(other.len()))
}

/// How different the robots of a team are (3.5): the mean over all pairs, exactly. None where there
/// is no pair, or where there are more than 65,535 robots.
///
/// ```
/// use cotama_models::team::{Ratio, service, team_heterogeneity};
/// assert_eq!(team_heterogeneity(&service::ROBOTS), Ratio::new(1, 3));
/// ```
pub fn team_heterogeneity(robots: &[Robot<'_>]) -> Option<Ratio> {
    let count = u128::from(u16::try_from(robots.len()).ok()?);
    let mut sum = 0_u128;
    for (number, one) in robots.iter().enumerate() {
        for other in robots.iter().take(number) {
            let (differ, all) = differ(one.capabilities(), other.capabilities());
            let part = COMMON.checked_div(all.into()).unwrap_or(0);
            sum = sum.saturating_add(part.saturating_mul(differ.into()));
        }
    }
    let pairs = count.checked_mul(count.checked_sub(1)?)? / 2;
    Ratio::new(sum, COMMON.checked_mul(pairs)?)
}
