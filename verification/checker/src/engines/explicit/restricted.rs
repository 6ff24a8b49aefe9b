//! Inhibitor arcs and priorities, asked of a packed marking.

use super::layout::{Field, Layout};
use super::view::View;
use cotama_property::pt::{Pt, Special};

/// Inhibitor arcs and priorities of a net, and where its places lie.
#[derive(Debug)]
pub(super) struct Restricted {
    special: Box<Special>,
    fields: Vec<Field>,
    stored: usize,
}

impl Restricted {
    /// `None` for a net without them.
    pub(super) fn new(pt: &Pt, layout: &Layout) -> Option<Self> {
        let special = pt.special.clone()?;
        Some(Self { special, fields: layout.fields.clone(), stored: layout.stored })
    }

    /// Leaves the enabled ones of the transitions that have what they need.
    pub(super) fn restrict(&self, marking: &[u64], view: &mut View) {
        let View { enabled, computed, .. } = view;
        self.special.restrict(enabled, &|place| {
            let field = self.fields[place as usize];
            let word = marking.get(field.word).copied();
            field.tokens(word.unwrap_or_else(|| computed[field.word - self.stored]))
        });
    }
}
