//! Formulas of bounded response.

use cotama_property::Formula;

/// `AG (cause -> AF<=limit effect)`, or `AF<=limit effect` at the start.
pub(super) struct InTime {
    pub(super) cause: Formula,
    /// In milliseconds.
    pub(super) limit: u64,
    pub(super) effect: Formula,
    pub(super) at_start: bool,
}

impl InTime {
    pub(super) fn new(formula: &Formula) -> Option<Self> {
        let of = |all: &Formula, cause, at_start| {
            let Formula::All(path) = all else { return None };
            let Formula::Within(limit, effect) = &**path else { return None };
            let effect = (**effect).clone();
            effect.is_state().then_some(Self { cause, limit: *limit, effect, at_start })
        };
        let Formula::All(path) = formula else { return None };
        let Formula::Globally(inner) = &**path else {
            return of(formula, Formula::TRUE, true);
        };
        let Formula::Or(parts) = &**inner else { return of(inner, Formula::TRUE, false) };
        let (state, open): (Vec<_>, Vec<_>) = parts.iter().partition(|it| it.is_state());
        let [open] = open[..] else { return None };
        let safe = Formula::Or(state.into_iter().cloned().collect());
        let cause = Formula::Not(safe.into());
        of(open, cause, false)
    }
}
