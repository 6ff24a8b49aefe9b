//! The styles of the screens; where they are not wanted, they are left out as the text is written.

use anstyle::{AnsiColor, Style};

/// Titles.
pub(crate) const HEADING: Style = Style::new().bold();
/// Names and commands.
pub(crate) const NAME: Style = AnsiColor::Cyan.on_default();
/// What went well.
pub(crate) const GOOD: Style = AnsiColor::Green.on_default().bold();
/// What did not.
pub(crate) const BAD: Style = AnsiColor::Red.on_default().bold();
/// What is to be noticed.
pub(crate) const NOTICE: Style = AnsiColor::Yellow.on_default();
/// What explains the rest.
pub(crate) const FAINT: Style = Style::new().dimmed();
/// Nothing.
pub(crate) const PLAIN: Style = Style::new();

/// Styles for families of choices, one after the other.
const FAMILIES: [AnsiColor; 6] = [
    AnsiColor::Green,
    AnsiColor::Cyan,
    AnsiColor::Yellow,
    AnsiColor::Magenta,
    AnsiColor::Blue,
    AnsiColor::Red,
];

/// Gives each family of choices a style, by the order in which they come: `M5 L2` and `M5 L1` are
/// of the family `M5`.
#[derive(Debug, Default)]
pub(crate) struct Families(Vec<String>);

impl Families {
    /// The style of a choice.
    pub(crate) fn style(&mut self, choice: &str) -> Style {
        let family = choice.split(' ').next().unwrap_or(choice);
        let place = self.0.iter().position(|known| known == family).unwrap_or_else(|| {
            self.0.push(family.to_owned());
            self.0.len() - 1
        });
        FAMILIES[place % FAMILIES.len()].on_default()
    }
}
