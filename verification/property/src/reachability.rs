//! Questions that one marking answers.

use super::Formula;

/// A formula reduced to reachability: true exactly when (some reachable marking satisfies `goal`)
/// == `expected`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reachability {
    /// The goal: a formula about one marking.
    pub goal: Formula,
    /// Whether finding it makes the formula true.
    pub expected: bool,
}

impl Reachability {
    /// `EF`, `AG`, and negations of them; `None` for any other formula.
    pub fn new(formula: &Formula) -> Option<Self> {
        match formula {
            Formula::Not(inner) => Self::new(inner).map(|it| Self { expected: !it.expected, ..it }),
            Formula::Exists(path) => match &**path {
                Formula::Finally(goal) if goal.is_state() => {
                    Some(Self { goal: goal.simplified(), expected: true })
                }
                _ => None,
            },
            Formula::All(path) => match &**path {
                Formula::Globally(law) if law.is_state() => {
                    Some(Self { goal: law.simplified().negated(), expected: false })
                }
                _ => None,
            },
            _ => None,
        }
    }
}
