//! Questions that one marking answers.

use super::Formula;

/// What a formula asks of reachable markings: it holds exactly when whether some reachable marking
/// meets the goal is as `expected`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reachability {
    /// What is looked for: a formula about one marking.
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
