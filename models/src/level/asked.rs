//! Reports for which the operator was asked before anything else is decided: once he is done, what
//! still shows itself is told again.

use super::sets::bits;
use super::tables::MAX_REPORTS;
use super::told::Cause;

/// The reports for which the operator was asked, each with its cause.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    reports: u64,
    causes: [Cause; MAX_REPORTS],
    /// Whether he is done since.
    answered: bool,
}

impl Default for Asked {
    fn default() -> Self {
        Self { reports: 0, causes: [Cause(0); MAX_REPORTS], answered: false }
    }
}

impl Asked {
    /// The operator is asked for a report.
    pub(super) fn ask(&mut self, report: usize, cause: Cause) {
        if let Some(of) = self.causes.get_mut(report) {
            self.reports |= 1 << report;
            *of = cause;
        }
    }

    /// The operator is done with what he chose.
    pub(super) const fn is_answered(&mut self) {
        self.answered = self.reports != 0;
    }

    /// Takes the reports for which he was asked, once he is done, of those that show themselves.
    pub(super) fn again(&mut self, shown: u64) -> impl Iterator<Item = (usize, Cause)> + use<> {
        let again = if self.answered { self.reports & shown } else { 0 };
        if self.answered {
            (self.reports, self.answered) = (0, false);
        }
        let causes = self.causes;
        bits(again).filter_map(move |it| Some((it, *causes.get(it)?)))
    }
}
