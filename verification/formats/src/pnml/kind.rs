//! Kinds of arcs, by all the words that tools have for them.

/// The effect of an arc from a place to a transition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Takes tokens.
    #[default]
    Normal,
    /// Needs tokens and does not take them; there is no arc back.
    Test,
    /// Needs that fewer tokens are there.
    Inhibitor,
    /// Empties the place.
    Reset,
}

/// A word in lower case, without what is neither a letter nor a digit.
fn plain(word: &str) -> String {
    word.chars().filter(char::is_ascii_alphanumeric).map(|it| it.to_ascii_lowercase()).collect()
}

/// Whether an element or attribute of this name says of which kind an arc is.
pub(super) fn says_kind(name: &str) -> bool {
    matches!(plain(name).as_str(), "type" | "arctype" | "kind" | "arckind")
}

impl Kind {
    /// The kind of this name.
    pub(super) fn of(word: &str) -> Option<Self> {
        Some(match plain(word).as_str() {
            "" | "normal" | "ordinary" | "regular" | "default" | "standard" | "pt" => Self::Normal,
            "test" | "read" | "testarc" | "readarc" | "tapntest" => Self::Test,
            "inhibitor" | "inhibitorarc" | "inhibit" | "inhib" | "tapninhibitor" => Self::Inhibitor,
            "reset" | "resetarc" => Self::Reset,
            _ => return None,
        })
    }

    /// The kind of an element of a net that is an arc of this kind, as `<inhibitorArc>`.
    pub(super) fn of_element(name: &str) -> Option<Self> {
        Self::named(name).filter(|_| plain(name).ends_with("arc"))
    }

    /// The kind that the name of an element or attribute says by itself.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::of(name).filter(|it| *it != Self::Normal)
    }
}
