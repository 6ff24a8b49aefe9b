//! What a search through all reachable markings is to do.

use super::goal::Packed;
use super::{Limits, Progress};
use crate::pt::Pt;

/// What is done while markings are passed through.
#[derive(Clone, Copy)]
pub(super) struct Plan<'p> {
    pub(super) pt: &'p Pt,
    pub(super) limits: &'p Limits,
    pub(super) jobs: usize,
    pub(super) progress: &'p dyn Fn(Progress),
    /// Stop after the first level that has one of these.
    pub(super) goal: Option<&'p Packed<'p>>,
}
