//! Markings as they are looked at, whatever way they are stored.

use super::space::Space;
use super::view::View;
use cotama_core::net::PlaceId;
use cotama_property::Marking;

/// A marking as it is looked at.
#[derive(Clone, Copy)]
pub(crate) struct Look<'m> {
    tokens: Held<'m>,
    pub(super) view: &'m View,
}

/// The source of its tokens.
#[derive(Clone, Copy)]
enum Held<'m> {
    Packed(&'m Space, &'m [u64]),
    Plain(&'m [u32]),
}

impl<'m> Look<'m> {
    pub(super) fn packed(space: &'m Space, packed: &'m [u64], view: &'m View) -> Self {
        Self { tokens: Held::Packed(space, packed), view }
    }

    pub(super) fn plain(tokens: &'m [u32], view: &'m View) -> Self {
        Self { tokens: Held::Plain(tokens), view }
    }
}

impl Look<'_> {
    /// The transitions that are enabled, in their order.
    pub(crate) fn transitions(&self) -> impl Iterator<Item = u32> + '_ {
        self.view.transitions()
    }

    /// Whether a transition is enabled.
    pub(crate) fn enables(&self, transition: u32) -> bool {
        self.view
            .enabled
            .get(transition as usize / 64)
            .is_some_and(|it| it >> (transition % 64) & 1 == 1)
    }
}

impl Marking for Look<'_> {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        let at = place.0 as usize;
        match self.tokens {
            Held::Plain(tokens) => tokens.get(at).copied().unwrap_or(0).into(),
            Held::Packed(space, packed) => space.layout.fields.get(at).map_or(0, |field| {
                let at = field.word;
                field.tokens(
                    packed
                        .get(at)
                        .copied()
                        .unwrap_or_else(|| self.view.computed[at - packed.len()]),
                )
            }),
        }
    }
}
