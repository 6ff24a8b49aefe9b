//! All shipped nets by name.

use super::families::{self, Family, OutOfRange};
use super::{ace, charger, crossing, door, watchdog};
use crate::names::{nearest, quoted};
use core::fmt;
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Known, Net};

/// A shipped net, or a family of them.
#[derive(Clone, Copy, Debug)]
pub struct ModelEntry {
    /// Name by which [`find`] knows the model.
    pub name: &'static str,
    /// Description in a sentence.
    pub description: &'static str,
    /// The net.
    pub model: Model,
}

/// The model that a name stands for.
///
/// ```
/// use cotama_models::nets::{Model, all};
/// let families = all().iter().filter(|it| matches!(it.model, Model::Family(_)));
/// let names: Vec<_> = families.map(|it| it.name).collect();
/// assert_eq!(names[..2], ["philosophers", "token_ring"]);
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Model {
    /// A net that was checked while compiling.
    Defined {
        /// The net.
        net: &'static Net<'static>,
        /// How it was checked.
        known: Known,
    },
    /// A net for each number.
    Family(&'static Family),
}

macro_rules! defined {
    ($($module:ident)::+) => {
        ModelEntry {
            name: $($module)::+::NET.name,
            description: $($module)::+::NET.doc,
            model: Model::Defined { net: &$($module)::+::NET, known: $($module)::+::KNOWN },
        }
    };
}

const fn family(family: &'static Family) -> ModelEntry {
    ModelEntry { name: family.name, description: family.description, model: Model::Family(family) }
}

/// All of them: first those to learn from, then the families.
///
/// ```
/// use cotama_models::nets::all;
/// let names: Vec<_> = all().iter().map(|it| it.name).collect();
/// assert_eq!(names[..4], ["door", "watchdog", "charger", "crossing"]);
/// ```
pub const fn all() -> &'static [ModelEntry] {
    const ALL: &[ModelEntry] = &[
        defined!(door),
        defined!(watchdog),
        defined!(charger),
        defined!(crossing),
        defined!(ace::request),
        defined!(ace::selection),
        defined!(ace::behaviour),
        defined!(ace::accuracy),
        family(&families::PHILOSOPHERS),
        family(&families::TOKEN_RING),
        family(&families::KANBAN),
        family(&families::FMS),
        family(&families::SWIMMING_POOL),
        family(&families::TEAM),
        family(&families::TEAM_OLD),
        family(&families::TEAM_TEXT),
    ];
    ALL
}

/// Why there is no net of this name.
///
/// ```
/// use cotama_models::nets::{FindError, find};
/// let message = |name| find(name).unwrap_err().to_string();
/// assert_eq!(message("kanban"), "`kanban` is a family of nets: say which one, as `kanban:5`");
/// assert_eq!(message("door:2"), "`door` is one net and takes no number: say `door`");
/// assert!(matches!(find("kanban:0"), Err(FindError::OutOfRange(_))));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FindError {
    /// No net or family has this name.
    Unknown {
        /// The name.
        name: String,
        /// A name that may have been meant.
        nearest: Option<&'static str>,
    },
    /// The model is a family, and wants a number.
    NumberMissing(&'static str),
    /// The model is one net, and takes no number.
    NoFamily(&'static str),
    /// The text after the colon is no number of 32 bits.
    NotANumber {
        /// The family.
        family: &'static str,
        /// The text found.
        found: String,
    },
    /// The family has no net for this number.
    OutOfRange(OutOfRange),
}

impl fmt::Display for FindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name, nearest: Some(nearest) } => {
                write!(f, "there is no net {}; did you mean `{nearest}`?", quoted(name))
            }
            Self::Unknown { name, nearest: None } => {
                write!(f, "there is no net {}; there are", quoted(name))?;
                all().iter().enumerate().try_for_each(|(at, it)| {
                    let number = if matches!(it.model, Model::Family(_)) { ":N" } else { "" };
                    write!(f, "{} {}{number}", if at > 0 { "," } else { "" }, it.name)
                })
            }
            Self::NumberMissing(family) => {
                write!(f, "`{family}` is a family of nets: say which one, as `{family}:5`")
            }
            Self::NoFamily(name) => {
                write!(f, "`{name}` is one net and takes no number: say `{name}`")
            }
            Self::NotANumber { family, found } => {
                let found = quoted(found);
                write!(
                    f,
                    "{found} is no number from 0 to {}: say which net of the family, as \
                     `{family}:5`",
                    u32::MAX
                )
            }
            Self::OutOfRange(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for FindError {}

/// The net of this name, as `watchdog` or `kanban:5`.
///
/// ```
/// use cotama_models::nets::find;
///
/// assert_eq!(find("watchdog").unwrap().places[0].name, "Idle");
/// assert_eq!(find("kanban:5").unwrap().places[0].initial, 5);
/// let misspelt = find("canban:5").unwrap_err().to_string();
/// assert_eq!(misspelt, "there is no net `canban`; did you mean `kanban`?");
/// ```
///
/// # Errors
/// When no net has this name, a number is missing, not wanted or none, or the family has no net for
/// it.
pub fn find(name: &str) -> Result<OwnedNet, FindError> {
    let (name, number) =
        name.split_once(':').map_or((name, None), |(name, number)| (name, Some(number)));
    let Some(entry) = all().iter().find(|entry| entry.name == name) else {
        let nearest = nearest(name, all().iter().map(|entry| entry.name));
        return Err(FindError::Unknown { name: name.to_owned(), nearest });
    };
    match (entry.model, number) {
        (Model::Defined { net, .. }, None) => Ok(OwnedNet::from(net)),
        (Model::Defined { .. }, Some(_)) => Err(FindError::NoFamily(entry.name)),
        (Model::Family(_), None) => Err(FindError::NumberMissing(entry.name)),
        (Model::Family(family), Some(text)) => {
            let not_a_number =
                |_| FindError::NotANumber { family: entry.name, found: text.to_owned() };
            family.net(text.parse().map_err(not_a_number)?).map_err(FindError::OutOfRange)
        }
    }
}
