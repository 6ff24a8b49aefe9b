//! Figures that tests assert and pages print.

use std::fmt;

const TABLE: &str = include_str!("figures.txt");

/// All figures, by name, in the order of their file.
///
/// # Panics
/// When a line of the file is no name and number.
pub fn figures() -> impl Iterator<Item = (&'static str, u64)> {
    let lines = TABLE.lines().filter(|it| !it.starts_with('#'));
    lines.map(|it| {
        let (name, number) = it.split_once(' ').unwrap_or((it, ""));
        let number = number.trim().parse();
        (name, number.unwrap_or_else(|error| panic!("figures.txt: {name}: {error}")))
    })
}

/// The figure of this name: what a test asserts, and pages print.
///
/// # Panics
/// When there is none, or when the type is too small for it.
#[must_use]
#[track_caller]
pub fn figure<N: TryFrom<u64>>(name: &str) -> N
where
    N::Error: fmt::Debug,
{
    let found = figures().find(|it| it.0 == name);
    let (_, number) = found.unwrap_or_else(|| panic!("figures.txt has no `{name}`"));
    N::try_from(number).unwrap_or_else(|error| panic!("{name}: {error:?}"))
}
