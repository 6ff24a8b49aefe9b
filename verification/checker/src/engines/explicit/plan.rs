//! The plan of a search through all reachable markings.

use super::goal::Packed;
use super::{Limits, Progress};
use cotama_property::pt::Pt;

/// The plan for the markings that a search passes through.
#[derive(Clone, Copy)]
pub(super) struct Plan<'p> {
    pub(super) pt: &'p Pt,
    pub(super) limits: &'p Limits,
    pub(super) jobs: usize,
    pub(super) progress: &'p dyn Fn(Progress),
    /// Stop after the first level that has one of these.
    pub(super) goal: Option<&'p Packed<'p>>,
}
