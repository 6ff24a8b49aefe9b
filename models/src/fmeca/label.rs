//! Sources of facts.

/// The source of a fact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Label {
    /// Said in a publication: Durand et al., TAROS 2010, where no other work is named.
    Stated,
    /// Not said, but needed to make the model executable, and consistent with what is said.
    Inferred,
    /// A free choice, mostly of timing and rates.
    Assumed,
}

impl Label {
    /// Returns the name in print.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::Inferred => "inferred",
            Self::Assumed => "assumed",
        }
    }
}
