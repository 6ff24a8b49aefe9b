//! An analysis: its rows, the flags that show them, and probes that could be added.

use super::set::Set;
use crate::fmeca::Label;
use crate::severity::{Persistence, Severity};

/// The most failure modes of an analysis.
pub const MAX_MODES: usize = 4096;
/// The most flags of an analysis.
pub const MAX_FLAGS: usize = 4096;
/// The most probes of an analysis: every subset of them is tried.
pub const MAX_PROBES: usize = 16;

/// A checked FMECA: ids and names are unique, no row is without function, component, failure,
/// cause, effect, severity and rate, and all sets are of flags and rows that exist.
///
/// It is made by [`parse`](Self::parse), [`parse_csv`](Self::parse_csv) and
/// [`shipped`](Self::shipped).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Analysis {
    pub(super) title: String,
    pub(super) period_h: u32,
    pub(super) flags: Vec<Flag>,
    pub(super) probes: Vec<Probe>,
    pub(super) modes: Vec<Mode>,
}

/// Something that an observer sees.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flag {
    /// Name of the flag, unique.
    pub name: String,
    /// Meaning of the flag, in words; may be empty.
    pub doc: String,
    /// The observer that raises it, in words; may be empty.
    pub observer: String,
}

/// An observation that could be added.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Name of the probe, unique.
    pub name: String,
    /// The observer and its observation, in words; may be empty.
    pub doc: String,
    /// The places of the failure modes that it would show.
    pub shows: Set,
}

/// A failure mode: a row. Words that a file may leave out are empty then.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode {
    /// Id of the row, unique.
    pub id: String,
    /// The function that suffers.
    pub function: String,
    /// The component that fails.
    pub component: String,
    /// The failure, in words.
    pub failure: String,
    /// The cause, in words.
    pub cause: String,
    /// The effect, in words.
    pub effect: String,
    /// How severe it is; while the robot drives itself where there is a second severity.
    pub severity: Severity,
    /// How severe it is while an operator drives, where that differs.
    pub severity_operator: Option<Severity>,
    /// How long it stays.
    pub persistence: Option<Persistence>,
    /// The functions lost with it, in words.
    pub lost: String,
    /// The observer that sees it, in words.
    pub observer: String,
    /// How it is seen, in words.
    pub detection: String,
    /// How long its detection takes, in milliseconds.
    pub latency_ms: u32,
    /// The places of the flags that it always raises.
    pub flags: Set,
    /// The places of the flags that it may raise too.
    pub sometimes: Set,
    /// Why nothing sees it, where that is said.
    pub silent: Option<String>,
    /// Detection rank, from 1 to 10, in place of the one by the table.
    pub detection_rank: Option<u8>,
    /// Detection rank by runs, where they were made.
    pub measured_rank: Option<u8>,
    /// The receiver of its event, in words.
    pub event: String,
    /// The reaction, in words.
    pub reaction: String,
    /// The mean time between failures of this mode, or, with `alpha_permille`, of its component, in
    /// thousandths of an hour; at least 1.
    pub mtbf_mh: u64,
    /// The share of this mode in the failures of its component, in thousandths, from 1 to 1,000.
    pub alpha_permille: Option<u16>,
    /// The probability that the failure has its effect, in thousandths, up to 1,000.
    pub beta_permille: Option<u16>,
    /// How well the rate is known.
    pub rate_label: Label,
    /// Source of the rate.
    pub rate_source: String,
    /// How the failure is injected in tests.
    pub injection: String,
}

/// A rib of a cause-effect diagram: the failure modes of one component, for one function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rib<'a> {
    /// The component that fails.
    pub component: &'a str,
    /// The failure modes, in the order of the rows.
    pub modes: Vec<&'a Mode>,
}

impl Analysis {
    /// Returns the subject of the analysis.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The time of operation for which occurrence classes and criticality numbers count failures,
    /// in hours.
    pub fn period_h(&self) -> u32 {
        self.period_h
    }

    /// The flags.
    pub fn flags(&self) -> &[Flag] {
        &self.flags
    }

    /// The probes.
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// The rows.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// The ids of failure modes at these places.
    pub fn ids(&self, places: impl IntoIterator<Item = usize>) -> Vec<&str> {
        places.into_iter().filter_map(|at| self.modes.get(at)).map(|it| it.id.as_str()).collect()
    }

    /// The names of flags.
    pub fn names(&self, flags: &Set) -> Vec<&str> {
        flags.iter().filter_map(|at| self.flags.get(at)).map(|it| it.name.as_str()).collect()
    }

    /// The functions, in the order of the rows: one cause-effect diagram each.
    pub fn functions(&self) -> Vec<&str> {
        firsts(self.modes.iter().map(|it| it.function.as_str()))
    }

    /// The ribs of the diagram of a function, in the order of its rows; none for what is no
    /// function. The diagrams (Ishikawa) say which component takes a function away, and why
    /// (method: Durand et al., IROS 2010).
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// let robot = Analysis::shipped("p3dx-delivery").unwrap();
    /// let rib = &robot.ribs("supply energy")[0];
    /// let ids: Vec<_> = rib.modes.iter().map(|it| it.id.as_str()).collect();
    /// assert_eq!((rib.component, ids), ("battery", vec!["BAT1", "BAT2"]));
    /// ```
    pub fn ribs(&self, function: &str) -> Vec<Rib<'_>> {
        let modes = || self.modes.iter().filter(|it| it.function == function);
        let rib = |component| Rib {
            component,
            modes: modes().filter(|it| it.component == component).collect(),
        };
        firsts(modes().map(|it| it.component.as_str())).into_iter().map(rib).collect()
    }
}

/// The distinct ones, in the order in which they come first.
fn firsts<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = std::collections::HashSet::new();
    names.filter(|&it| seen.insert(it)).collect()
}

impl Mode {
    /// The worse of its severities.
    pub fn worst(&self) -> Severity {
        self.severity_operator.map_or(self.severity, |it| it.max(self.severity))
    }

    /// Whether it always raises a flag.
    pub fn is_detected(&self) -> bool {
        !self.flags.is_empty()
    }
}
