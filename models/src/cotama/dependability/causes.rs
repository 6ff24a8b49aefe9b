//! Cause-effect (Ishikawa) view of the FMECA: which component takes a function away, and why (the
//! method of Durand et al., IROS 2010, pairs each FMECA with such diagrams).

use super::table::{FailureMode, FailureModes};

/// A rib of a cause-effect diagram: the failure modes of one component, for one function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rib {
    /// The function that suffers: the head of the diagram.
    pub function: &'static str,
    /// The component that fails.
    pub component: &'static str,
    /// Its failure modes; each has its cause in its description.
    pub modes: FailureModes,
}

/// The functions of the FMECA in the order of its rows: one diagram each.
pub fn functions() -> impl Iterator<Item = &'static str> {
    firsts(|mode| mode.description().function).map(|(function, _)| function)
}

/// The ribs of the diagram of a function, in the order of its rows; none for what is no function of
/// the FMECA.
///
/// ```
/// use cotama_models::cotama::ribs;
/// let power = ribs("supply energy").map(|rib| format!("{}: {}", rib.component, rib.modes));
/// let power: Vec<_> = power.collect();
/// assert_eq!(power, ["battery: BAT1 BAT2", "battery or connector: BAT3", "laptop battery: PWR1"]);
/// ```
pub fn ribs(function: &str) -> impl Iterator<Item = Rib> {
    firsts(|mode| (mode.description().function, mode.description().component))
        .filter(move |((of, _), _)| *of == function)
        .map(|((function, component), modes)| Rib { function, component, modes })
}

/// The distinct keys of the rows, each with its rows, in the order of the rows.
fn firsts<K: PartialEq>(
    key: impl Fn(FailureMode) -> K + Copy,
) -> impl Iterator<Item = (K, FailureModes)> {
    FailureModes::ALL.iter().filter_map(move |mode| {
        let same = FailureModes::ALL.iter().filter(|&it| key(it) == key(mode));
        let modes = same.fold(FailureModes::NONE, FailureModes::with);
        (modes.first() == Some(mode)).then(|| (key(mode), modes))
    })
}
