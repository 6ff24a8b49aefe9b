//! The form of a mission, on which some of its keys depend.

use super::fields::Fields;
use crate::missions::known::ATTRIBUTES;
use crate::missions::numbers::Numbers;

/// The form of a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Form {
    /// Whether supervisors of a robot decide.
    pub(super) supervised: bool,
    /// Whether speeds and limits follow from axes.
    pub(super) axed: bool,
}

impl Form {
    /// Takes the attributes of a part of a mission with axes; any other one has none.
    pub(super) fn numbers(self, fields: &mut Fields<'_>) -> Numbers {
        if self.axed { fields.numbers(&ATTRIBUTES) } else { Numbers::default() }
    }
}
