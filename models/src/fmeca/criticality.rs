//! Criticality: ranks and the risk priority number, and the criticality matrix.
//!
//! IEC 60812:2018 has both: the risk priority number RPN = S × O × D of ranks from 1 to 10, and a
//! matrix of severity against likelihood. It leaves scales to the analyst; the tables here are
//! ours (assumed), and each says what it follows.

use super::analysis::{Analysis, Mode};
use super::priority::ActionPriority;
use crate::robots::Detection;
use crate::severity::Severity;

/// How critical a failure mode is.
///
/// ```
/// use cotama_models::fmeca::{Analysis, OccurrenceClass, SeverityClass};
/// let robot = Analysis::shipped("p3dx-delivery").unwrap();
/// // BAT2: fatal, every 400 h, seen after 1 s.
/// let bat2 = robot.modes().iter().find(|it| it.id == "BAT2").unwrap();
/// let it = robot.criticality(bat2);
/// assert_eq!((it.severity, it.severity_class), (10, SeverityClass::Catastrophic));
/// assert_eq!(it.rpn(), 10 * u16::from(it.occurrence) * u16::from(it.detection));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Criticality {
    /// The severity rank, from 1 to 10.
    pub severity: u8,
    /// The occurrence rank, from 1 to 10.
    pub occurrence: u8,
    /// The detection rank: 1 is seen for sure and at once, 10 is never seen.
    pub detection: u8,
    /// The [detection rank by runs](measured_rank), where they were made.
    pub measured: Option<u8>,
    /// The row of the criticality matrix.
    pub occurrence_class: OccurrenceClass,
    /// The column of the criticality matrix.
    pub severity_class: SeverityClass,
    /// The criticality number of the mode, C = β α λ t (MIL-STD-1629A, Task 102), in thousand
    /// millionths, rounded half up; only where the file gives α and β.
    pub number_e9: Option<u64>,
}

macro_rules! classes {
    ($(#[$doc:meta])* $class:ident { $($(#[$one:meta])* $member:ident = $name:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $class { $($(#[$one])* $member,)+ }

        impl $class {
            /// All of them, the best one first.
            pub const ALL: &'static [Self] = &[$(Self::$member),+];

            /// Returns the name in print.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$member => $name,)+ }
            }
        }
    };
}

classes! {
    /// Classes of severity (names after IEC 60812:2006; the severity word of each is ours).
    SeverityClass {
        /// Weak.
        Insignificant = "insignificant",
        /// Medium.
        Marginal = "marginal",
        /// Hard.
        Critical = "critical",
        /// Fatal.
        Catastrophic = "catastrophic",
    }
}

classes! {
    /// Classes of occurrence: how many failures are expected in the time of operation (names and
    /// bounds after IEC 60812:2006, and MIL-STD-1629A, Task 102, levels E to A). The expected
    /// number is an upper bound of the probability that there is one.
    OccurrenceClass {
        /// Below 0.001.
        Improbable = "improbable",
        /// From 0.001.
        Remote = "remote",
        /// From 0.01.
        Occasional = "occasional",
        /// From 0.1.
        Probable = "probable",
        /// From 0.2.
        Frequent = "frequent",
    }
}

classes! {
    /// Classes of criticality: the fields of the matrix (IV to I of the example in IEC 61508-5,
    /// informative annex on tolerable risk).
    CriticalityClass {
        /// Class IV.
        Negligible = "negligible",
        /// Class III: tolerable if improving it would cost more than it gains.
        Tolerable = "tolerable",
        /// Class II: only where the risk cannot be reduced with reasonable effort.
        Undesirable = "undesirable",
        /// Class I.
        Intolerable = "intolerable",
    }
}

impl SeverityClass {
    /// The class of a severity.
    pub const fn of(severity: Severity) -> Self {
        match severity {
            Severity::Weak => Self::Insignificant,
            Severity::Medium => Self::Marginal,
            Severity::Hard => Self::Critical,
            Severity::Fatal => Self::Catastrophic,
        }
    }
}

impl OccurrenceClass {
    /// The class of a mean time between failures in a time of operation, both in thousandths of an
    /// hour.
    fn of(interval_mh: u128, period_mh: u128) -> Self {
        match period_mh * 1000 {
            it if it >= interval_mh * 200 => Self::Frequent,
            it if it >= interval_mh * 100 => Self::Probable,
            it if it >= interval_mh * 10 => Self::Occasional,
            it if it >= interval_mh => Self::Remote,
            _ => Self::Improbable,
        }
    }
}

impl CriticalityClass {
    /// The field of the criticality matrix.
    ///
    /// ```
    /// use cotama_models::fmeca::{CriticalityClass, OccurrenceClass, SeverityClass};
    /// let field = CriticalityClass::of(OccurrenceClass::Occasional, SeverityClass::Critical);
    /// assert_eq!(field, CriticalityClass::Undesirable);
    /// ```
    pub const fn of(occurrence: OccurrenceClass, severity: SeverityClass) -> Self {
        use CriticalityClass::{Intolerable, Negligible, Tolerable, Undesirable};
        // Insignificant, marginal, critical, catastrophic.
        let row = match occurrence {
            OccurrenceClass::Frequent => [Undesirable, Intolerable, Intolerable, Intolerable],
            OccurrenceClass::Probable => [Tolerable, Undesirable, Intolerable, Intolerable],
            OccurrenceClass::Occasional => [Tolerable, Tolerable, Undesirable, Intolerable],
            OccurrenceClass::Remote => [Negligible, Tolerable, Tolerable, Undesirable],
            OccurrenceClass::Improbable => [Negligible, Negligible, Tolerable, Tolerable],
        };
        row[severity as usize]
    }
}

impl Criticality {
    /// The risk priority number, S × O × D, from 1 to 1,000.
    pub const fn rpn(self) -> u16 {
        self.rpn_by(self.detection)
    }

    /// The risk priority number with another detection rank, as [`measured`](Self::measured).
    pub const fn rpn_by(self, detection: u8) -> u16 {
        self.severity as u16 * self.occurrence as u16 * detection as u16
    }

    /// The Action Priority of the three ranks.
    pub fn priority(self) -> ActionPriority {
        self.priority_by(self.detection)
    }

    /// The Action Priority with another detection rank, as [`measured`](Self::measured).
    pub fn priority_by(self, detection: u8) -> ActionPriority {
        ActionPriority::of(self.severity, self.occurrence, detection)
    }

    /// Returns the field of the criticality matrix.
    pub const fn class(self) -> CriticalityClass {
        CriticalityClass::of(self.occurrence_class, self.severity_class)
    }
}

impl Analysis {
    /// How critical a failure mode is.
    pub fn criticality(&self, mode: &Mode) -> Criticality {
        let worst = mode.worst();
        // With α the rate is that of the component, and the mode has its share of it.
        let alpha = u128::from(mode.alpha_permille.unwrap_or(1000)).max(1);
        let interval_mh = u128::from(mode.mtbf_mh.max(1)) * 1000 / alpha;
        let period_mh = u128::from(self.period_h) * 1000;
        let number = mode.alpha_permille.zip(mode.beta_permille).map(|(_, beta)| {
            // Both shares are in thousandths, and 1e9 / 1e6 is left.
            let failures = alpha * u128::from(beta) * period_mh * 1000;
            let interval = u128::from(mode.mtbf_mh.max(1));
            u64::try_from((failures * 2 + interval) / (interval * 2)).unwrap_or(u64::MAX)
        });
        Criticality {
            severity: severity_rank(worst),
            occurrence: occurrence_rank(interval_mh),
            detection: mode.detection_rank.unwrap_or_else(|| detection_rank(mode)),
            measured: mode.measured_rank,
            occurrence_class: OccurrenceClass::of(interval_mh, period_mh),
            severity_class: SeverityClass::of(worst),
            number_e9: number,
        }
    }
}

/// Our scale (assumed), with the words of automotive handbooks in mind: 10 and 9 are for safety, 8
/// for the loss of the primary function, 5 for a secondary one, 3 for what is hardly noticed.
const fn severity_rank(severity: Severity) -> u8 {
    match severity {
        Severity::Weak => 3,
        Severity::Medium => 5,
        Severity::Hard => 8,
        Severity::Fatal => 10,
    }
}

/// Our scale (assumed): a rank is a decade of the mean time between failures. 10 is below 1 h, 9
/// below 10 h, down to 1 from 100 million hours on.
fn occurrence_rank(interval_mh: u128) -> u8 {
    let (mut rank, mut bound) = (10, 1000);
    while rank > 1 && interval_mh >= bound {
        (rank, bound) = (rank - 1, bound * 10);
    }
    rank
}

/// Our scale (assumed): a rank is a decade of the latency of what is always seen. 1 is up to 10 ms,
/// 2 up to 0.1 s, to 8, more than 10,000 s; 9 is seen sometimes, 10 never.
fn detection_rank(mode: &Mode) -> u8 {
    if !mode.is_detected() {
        return if mode.sometimes.is_empty() { 10 } else { 9 };
    }
    latency_rank(mode.latency_ms.into())
}

fn latency_rank(latency_ms: u64) -> u8 {
    let (mut rank, mut bound) = (1, 10);
    while rank < 8 && latency_ms > bound {
        (rank, bound) = (rank + 1, bound * 10);
    }
    rank
}

/// The detection rank of a failure of a robot as runs have shown it, on the scale of those that are
/// assumed: the decade of the longest delay where the failure is named in at least 95 % of the
/// runs, 9 where it is named in fewer, and 10 where it never is. A failure that is taken for
/// another one alone is not detected as what it is: what follows is the reaction to the other.
/// `None` without a run.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::fmeca::measured_rank;
/// use cotama_models::robots::Detection;
/// let mut it = Detection::default();
/// assert_eq!(measured_rank(&it, 3), None);
/// it.note(Some((vec![3, 4], Millis(800))));
/// assert_eq!((measured_rank(&it, 3), measured_rank(&it, 5)), (Some(3), Some(10)));
/// it.note(Some((vec![5], Millis(100))));
/// assert_eq!(measured_rank(&it, 3), Some(9));
/// ```
pub fn measured_rank(it: &Detection, failure: usize) -> Option<u8> {
    let named = it.named(failure);
    if it.runs == 0 {
        return None;
    }
    let is_sure = u128::from(named) * 100 >= u128::from(it.runs) * 95;
    Some(match it.worst_named(failure) {
        None => 10,
        Some(worst) if is_sure => latency_rank(worst.0),
        Some(_) => 9,
    })
}
