//! Firings and outputs that a model has made and the recording has not shown yet.

use super::allowed::Allowed;
use super::departure::Refused;
use super::names::OutputNumber;
use super::rules::Rules;
use cotama_core::net::TransitionId;
use cotama_core::units::Millis;

/// Why a way goes no further.
pub(super) enum Stop {
    /// For this reason, where this was allowed.
    Departs(String, Allowed),
    Refused(Refused),
}

/// A firing or an output that is not recorded yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Pending {
    pub(super) by: u32,
    /// The output; `None`: the firing.
    pub(super) output: Option<OutputNumber>,
    pub(super) at: u64,
}

impl Pending {
    /// Reports a firing or an output that is not recorded.
    pub(super) fn missing(&self, rules: &Rules<'_>, before: &str) -> Stop {
        let id = TransitionId(self.by);
        let name = rules.numbered.transition(id);
        let on = rules.numbered.needs_event(id);
        let on = on.map_or_else(String::new, |it| format!(" on `{it}`"));
        let had = match self.output {
            None => "had to fire".to_owned(),
            Some(output) => format!("had to say `{}`", rules.names.said(output)),
        };
        let reason = format!("{before}`{name}` {had}{on} at {} ms", self.at);
        Stop::Departs(reason, self.must(rules))
    }

    /// Returns the dates at which it had to come.
    pub(super) fn must(&self, rules: &Rules<'_>) -> Allowed {
        let latest = Millis(self.at.saturating_add(rules.tolerance));
        let name = rules.numbered.transition(TransitionId(self.by));
        Allowed::only(name, Millis(self.at), latest)
    }
}
