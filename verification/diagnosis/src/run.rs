//! Transitions that can go on from a marking of a run.

use cotama_property::pt::Pt;

/// The transitions that are enabled.
pub(super) fn enabled<'a>(pt: &'a Pt, marking: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
    (0..pt.transitions.len() as u32).filter(|it| pt.enabled(marking, *it))
}
