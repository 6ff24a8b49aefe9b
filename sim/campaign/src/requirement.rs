//! Requirements of every run, whatever fails.

use crate::observed::Observed;
use cotama_sim::run::Outcome;
use std::fmt;

/// A requirement of a run.
///
/// ```
/// use cotama_campaign::requirement::Requirement;
/// let texts = ["completed", "in-time", "energy<=8640000", "never gs.abort_DriveA", "AG !gs.Safe"];
/// for text in texts {
///     assert_eq!(text.parse::<Requirement>().unwrap().to_string(), text);
/// }
/// let error = "time < 5".parse::<Requirement>().unwrap_err();
/// assert!(error.to_string().starts_with("`time < 5` is no requirement"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Requirement {
    /// The mission is completed within its limits.
    Completed,
    /// The run is completed, or the robot stands safely.
    NotFailed,
    /// The robot never moves after it is safe.
    StandsWhenSafe,
    /// The robot brakes within the braking distance of its file when the permit to move is gone,
    /// unless a motor ran away.
    Brakes,
    /// The robot never moves without a module that it requires for longer than the failures of the
    /// run take to be detected, decided and answered, one after the other.
    InTime,
    /// A number of the run is at most so much.
    AtMost(Metric, u64),
    /// A transition of the supervisors, as `gs.abort_DriveA`, never fires.
    Never(String),
    /// Every failure is seen within the latency of its row of the FMECA while flags show it.
    SeenInTime,
    /// No plan is made with modules that are known to be lost.
    PlansWithWhatWorks,
    /// A property in the language of `cotama check` that a single run can break:
    /// [`Monitor`](cotama_sim::robots::Monitor). It ends the run that breaks it.
    Always(String),
}

/// A number of a run.
///
/// ```
/// use cotama_campaign::requirement::{Metric, Requirement};
/// let asked: Requirement = "requests<=2".parse().unwrap();
/// assert_eq!(asked, Requirement::AtMost(Metric::Requests, 2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Metric {
    /// The time used, in ms.
    Time,
    /// The energy used, in mJ.
    Energy,
    /// How often the operator was asked.
    Requests,
    /// The longest time in ms that the robot moved without a module that it required.
    Exposed,
    /// For how long robots of a team worked, all together, in ms.
    RobotTime,
    /// Number of times that a task of a team was put up again.
    PutUpAgain,
    /// Number of uses of a skill that failed in a team.
    FailedUses,
}

impl Metric {
    const ALL: [Self; 7] = [
        Self::Time,
        Self::Energy,
        Self::Requests,
        Self::Exposed,
        Self::RobotTime,
        Self::PutUpAgain,
        Self::FailedUses,
    ];

    /// Whether it is of teams only.
    const fn is_of_teams(self) -> bool {
        matches!(self, Self::RobotTime | Self::PutUpAgain | Self::FailedUses)
    }

    /// Returns the name: `time`, `energy`, `requests`, `exposed`, `robot-time`, `put-up-again`,
    /// `failed-uses`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Energy => "energy",
            Self::Requests => "requests",
            Self::Exposed => "exposed",
            Self::RobotTime => "robot-time",
            Self::PutUpAgain => "put-up-again",
            Self::FailedUses => "failed-uses",
        }
    }

    /// Returns the value in a run.
    pub const fn of(self, run: &Observed) -> u64 {
        match self {
            Self::Time => run.time_ms,
            Self::Energy => run.energy_mj,
            Self::Requests => run.requests,
            Self::Exposed => run.exposed_ms,
            Self::RobotTime => run.robot_time_ms,
            Self::PutUpAgain => run.replans,
            Self::FailedUses => run.failed_uses,
        }
    }
}

impl Requirement {
    /// Whether it holds of a run.
    pub fn holds(&self, run: &Observed) -> bool {
        self.distance(run) > 0
    }

    /// How far a run is from breaking it: a level for searches, in its own unit; 0 or less when it
    /// is broken.
    pub fn distance(&self, run: &Observed) -> i64 {
        let left = |limit: u64, value: u64| {
            let left = i128::from(limit) - i128::from(value) + 1;
            i64::try_from(left).unwrap_or(i64::MIN)
        };
        match self {
            // A run ended by a broken property says nothing of its end.
            Self::Completed | Self::NotFailed if run.witness.is_some() => 1,
            Self::Completed => i64::from(run.outcome == Outcome::Completed),
            Self::NotFailed => i64::from(run.outcome != Outcome::Failed),
            Self::StandsWhenSafe => i64::from(!run.moved_when_safe),
            Self::Brakes if run.ran_away => 1,
            Self::Brakes => left(run.allowed.1, run.braked_mm),
            Self::InTime => left(run.allowed.0, run.exposed_ms),
            Self::AtMost(metric, limit) => left(*limit, metric.of(run)),
            Self::Never(transition) => i64::from(run.fired.binary_search(transition).is_err()),
            Self::SeenInTime => left(0, run.unseen_ms),
            Self::PlansWithWhatWorks => i64::from(!run.planned_with_lost),
            Self::Always(text) => Self::unbroken(run, text),
        }
    }

    /// Whether it says what another one says: blanks of a property are none of its words.
    pub(super) fn says_what(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Always(one), Self::Always(other)) => unspaced(one) == unspaced(other),
            _ => self == other,
        }
    }

    fn unbroken(run: &Observed, text: &str) -> i64 {
        i64::from(run.witness.as_ref().is_none_or(|it| it.requirement != text))
    }

    /// Whether it speaks of supervisors.
    pub const fn needs_supervisors(&self) -> bool {
        matches!(
            self,
            Self::StandsWhenSafe
                | Self::Brakes
                | Self::InTime
                | Self::Never(_)
                | Self::SeenInTime
                | Self::PlansWithWhatWorks
                | Self::Always(_)
                | Self::AtMost(Metric::Requests | Metric::Exposed, _)
        )
    }

    /// Whether it speaks of teams only.
    pub const fn needs_team(&self) -> bool {
        matches!(self, Self::AtMost(metric, _) if metric.is_of_teams())
    }

    /// Returns the requirement in words.
    pub fn words(&self) -> String {
        match self {
            Self::Completed => "the mission is completed within its limits".into(),
            Self::NotFailed => "the mission is completed, or the robot stands safely".into(),
            Self::StandsWhenSafe => "the robot never moves after it is safe".into(),
            Self::Brakes => {
                "the robot stands within its braking distance after its permit to move is gone, \
                 unless a motor runs away"
                    .into()
            }
            Self::InTime => "the robot never moves without a module that it requires for longer \
                             than its failures take to be answered"
                .into(),
            Self::AtMost(metric, limit) => {
                let (what, unit) = match metric {
                    Metric::Time => ("the time used", " ms"),
                    Metric::Energy => ("the energy used", " mJ"),
                    Metric::Requests => ("the requests to the operator", ""),
                    Metric::Exposed => ("the longest motion without a required module", " ms"),
                    Metric::RobotTime => ("the time that robots work, all together,", " ms"),
                    Metric::PutUpAgain => ("how often tasks are put up again", ""),
                    Metric::FailedUses => ("how often uses of skills fail", ""),
                };
                let verb = if *metric == Metric::Requests { "are" } else { "is" };
                format!("{what} {verb} at most {limit}{unit}")
            }
            Self::Never(transition) => format!("`{transition}` never fires"),
            Self::SeenInTime => {
                "every failure is seen within the latency of its row while flags show it".into()
            }
            Self::PlansWithWhatWorks => {
                "no plan is made with modules that are known to be lost".into()
            }
            Self::Always(_) => "it holds of the supervisors at the end of every round".into(),
        }
    }
}

/// A property without blanks, but for those inside of names and between two words.
fn unspaced(text: &str) -> String {
    let is_word = |it: char| it.is_alphanumeric() || "_'.".contains(it);
    let (mut out, mut closes, mut escaped, mut blank) = (String::new(), None, false, false);
    for letter in text.chars() {
        if let Some(close) = closes {
            out.push(letter);
            closes = closes.filter(|_| escaped || letter != close);
            escaped = !escaped && letter == '\\';
            continue;
        }
        if letter.is_whitespace() {
            blank = true;
            continue;
        }
        if blank && is_word(letter) && out.ends_with(is_word) {
            out.push(' ');
        }
        closes = match letter {
            '"' => Some('"'),
            '{' => Some('}'),
            _ => None,
        };
        (blank, escaped) = (false, false);
        out.push(letter);
    }
    out
}

const PLAIN: [(&str, Requirement); 7] = [
    ("completed", Requirement::Completed),
    ("not-failed", Requirement::NotFailed),
    ("stands-when-safe", Requirement::StandsWhenSafe),
    ("brakes", Requirement::Brakes),
    ("in-time", Requirement::InTime),
    ("seen-in-time", Requirement::SeenInTime),
    ("plans-with-what-works", Requirement::PlansWithWhatWorks),
];

impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(metric, limit) => write!(f, "{}<={limit}", metric.name()),
            Self::Never(transition) => write!(f, "never {transition}"),
            Self::Always(text) => f.write_str(text),
            _ => {
                let name = PLAIN.iter().find(|it| it.1 == *self).map_or("", |it| it.0);
                f.write_str(name)
            }
        }
    }
}

/// A text that is no requirement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoRequirement(String);

impl fmt::Display for NoRequirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = PLAIN.iter().map(|it| it.0).collect();
        write!(
            f,
            "`{}` is no requirement; there are {}, METRIC<=NUMBER with time (ms), energy (mJ), \
             requests, exposed (ms), and of teams robot-time (ms), put-up-again or failed-uses, \
             `never NET.TRANSITION`, and `AG` of what is marked",
            self.0.escape_debug(),
            names.join(", ")
        )
    }
}

impl std::error::Error for NoRequirement {}

impl std::str::FromStr for Requirement {
    type Err = NoRequirement;

    fn from_str(text: &str) -> Result<Self, NoRequirement> {
        let no = || NoRequirement(text.to_owned());
        if let Some((_, it)) = PLAIN.iter().find(|it| it.0 == text) {
            return Ok(it.clone());
        }
        if let Some(transition) = text.strip_prefix("never ") {
            let name = |it: &str| {
                !it.is_empty() && it.bytes().all(|it| it.is_ascii_graphic() && it != b'"')
            };
            let parts = transition.split_once('.');
            let fits = parts.is_some_and(|(net, it)| name(net) && name(it));
            return if fits { Ok(Self::Never(transition.to_owned())) } else { Err(no()) };
        }
        if text.trim_start().starts_with("AG") {
            return Ok(Self::Always(text.trim().to_owned()));
        }
        let (name, limit) = text.split_once("<=").ok_or_else(no)?;
        let metric = Metric::ALL.into_iter().find(|it| it.name() == name).ok_or_else(no)?;
        if !limit.bytes().all(|it| it.is_ascii_digit()) {
            return Err(no());
        }
        Ok(Self::AtMost(metric, limit.parse().map_err(|_| no())?))
    }
}
