//! Numbers of a mission's own, which formulas of axes read.

use super::diagnostic::Spanned;
use cotama_axes::Attributes;

/// Attributes of a part of a mission, which formulas read, with the places of their keys.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Numbers(pub(super) Vec<(Spanned<String>, i64)>);

impl Numbers {
    /// Returns the number of this name.
    pub fn get(&self, key: &str) -> Option<i64> {
        self.0.iter().find(|it| it.0.value == key).map(|it| it.1)
    }

    /// Adds a number that the reader knows.
    pub(super) fn add(&mut self, key: &str, span: std::ops::Range<usize>, value: i64) {
        self.0.push((Spanned { value: key.to_owned(), span }, value));
    }

    pub(super) fn with<const N: usize>(&self, known: [(&str, Option<u64>); N]) -> Attributes {
        let own = self.0.iter().map(|(key, value)| (key.value.clone(), *value));
        let known = known.into_iter().filter_map(|(key, it)| Some((key.to_owned(), whole(it?))));
        own.chain(known).collect()
    }

    pub(super) fn seen(&self) -> Vec<(String, usize)> {
        self.0.iter().map(|(key, _)| (key.value.clone(), key.span.start)).collect()
    }
}

/// Returns a number as formulas read it.
pub(super) fn whole(value: u64) -> i64 {
    i64::try_from(value).unwrap_or(i64::MAX)
}
