//! An instance as far as it was read: parts may be missing, and each knows its place.

use super::Kind;
use crate::missions::Spanned;
use cotama_core::team::{Combine, Cost};
use std::ops::Range;

/// Value of `format` in instances.
pub const FORMAT: &str = "cotama-team-assignment/1";
/// The largest cost of a file, and the largest denominator.
pub const MAX_COST: u32 = 1_000_000_000;
/// The most entries of all lists of costs together.
pub const MAX_INSTANCE_ENTRIES: usize = 1 << 25;

/// A list of costs, and where it stands.
pub(super) type List = Spanned<Vec<Option<Cost>>>;

/// An instance as far as it was read.
#[derive(Default)]
pub(super) struct Draft {
    pub(super) span: Range<usize>,
    pub(super) format: Option<Spanned<String>>,
    pub(super) name: Option<Spanned<String>>,
    pub(super) kind: Option<Spanned<Kind>>,
    pub(super) denominator: Option<Spanned<u32>>,
    pub(super) robots: Option<Vec<Spanned<String>>>,
    pub(super) tasks: Option<Vec<DraftTask>>,
    pub(super) entries: usize,
}

/// Value of `skip_cost`: `None` where the task must be done.
#[derive(Clone, Copy)]
pub(super) struct Skip(pub(super) Option<Cost>);

#[derive(Default)]
pub(super) struct DraftTask {
    pub(super) span: Range<usize>,
    pub(super) name: Option<Spanned<String>>,
    pub(super) skip: Option<Skip>,
    pub(super) cost: Option<List>,
    pub(super) combine: Option<Spanned<Combine>>,
    pub(super) plans: Option<Spanned<Vec<DraftPlan>>>,
}

#[derive(Default)]
pub(super) struct DraftPlan {
    pub(super) span: Range<usize>,
    pub(super) name: Option<Spanned<String>>,
    pub(super) extra: u32,
    pub(super) roles: Option<Spanned<Vec<DraftRole>>>,
}

#[derive(Default)]
pub(super) struct DraftRole {
    pub(super) span: Range<usize>,
    pub(super) name: Option<Spanned<String>>,
    pub(super) cost: Option<List>,
}
