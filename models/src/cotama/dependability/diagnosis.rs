//! From flags to failure modes: the signature table of the GOM (Durand et al., TAROS 2010, Section
//! V.A; the table itself is inferred), and which failure modes it cannot tell apart.
//!
//! A failure mode is a candidate when it explains the raised flags exactly: all that it always
//! raises are there, and all that are there it raises always or sometimes. Flags of observers that
//! are unavailable count as not raised and are asked of nobody. So an intermittent fault with flags
//! that come and go is a candidate with any part of them (inferred), and two faults at once are
//! unexplained unless one of them covers both.

use super::adjustment::Adjustment;
use super::flags::{Flag, Flags};
use super::table::{FailureMode, FailureModes, RULES};
use crate::cotama::decisions::{Report, Severity};
use crate::cotama::members::members;
use crate::cotama::modules::{Health, Mode, Module, Modules, available};

/// The meaning of the raised flags.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Diagnosis {
    /// No flag is raised.
    None,
    /// One failure mode explains the flags.
    Unique(FailureMode),
    /// Several do; the operator must look.
    Ambiguous(FailureModes),
    /// No failure mode explains the flags: several faults at once, or one that the FMECA does not
    /// know. As an ambiguous one it is for the operator.
    Unexplained,
}

/// The failure modes that explain the raised flags while these modules are available.
///
/// ```
/// use cotama_models::cotama::FailureMode::{Loc1, Loc2, Odo2};
/// use cotama_models::cotama::{Diagnosis, FailureModes, Flag, Flags, Modules, diagnose};
/// // Point 3 of the published run: odometry noise, a lost filter, or an uncharted obstacle.
/// let raised = Flags::of(&[Flag::PoseGrowth, Flag::Backward]);
/// let candidates = FailureModes::of(&[Odo2, Loc1, Loc2]);
/// assert_eq!(diagnose(raised, Modules::ALL), Diagnosis::Ambiguous(candidates));
/// ```
pub const fn diagnose(raised: Flags, status: Modules) -> Diagnosis {
    let raised = raised.common(Flags::seen_by(status));
    if raised.is_empty() {
        return Diagnosis::None;
    }
    let candidates = candidates(raised, status);
    match (candidates.len(), candidates.first()) {
        (1, Some(mode)) => Diagnosis::Unique(mode),
        (_, Some(_)) => Diagnosis::Ambiguous(candidates),
        (_, None) => Diagnosis::Unexplained,
    }
}

const fn candidates(raised: Flags, status: Modules) -> FailureModes {
    let (mut set, mut at) = (FailureModes::NONE, 0);
    while at < RULES.len() {
        let mode = FailureMode::ALL[at];
        let (least, most) = bounds(mode, status);
        if is_detectable(mode, status) && raised.covers(least) && most.covers(raised) {
            set = set.with(mode);
        }
        at += 1;
    }
    set
}

/// The fewest and the most flags that a failure mode raises, as far as observers are available.
const fn bounds(mode: FailureMode, status: Modules) -> (Flags, Flags) {
    let (signature, seen) = (mode.rule().signature, Flags::seen_by(status));
    let least = signature.always.common(seen);
    (least, least.union(signature.sometimes.common(seen)))
}

/// Whether a failure mode can happen while these modules are available.
const fn is_possible(mode: FailureMode, status: Modules) -> bool {
    let signature = mode.rule().signature;
    status.covers(signature.present) && signature.absent.common(status).is_empty()
}

/// Whether a failure mode can happen, and always raises a flag, while these modules are available.
pub const fn is_detectable(mode: FailureMode, status: Modules) -> bool {
    is_possible(mode, status) && !bounds(mode, status).0.is_empty()
}

/// The failure modes that can happen and that no available observer is sure to see.
#[must_use]
pub const fn undetectable(status: Modules) -> FailureModes {
    let (mut set, mut at) = (FailureModes::NONE, 0);
    while at < RULES.len() {
        let mode = FailureMode::ALL[at];
        if is_possible(mode, status) && !is_detectable(mode, status) {
            set = set.with(mode);
        }
        at += 1;
    }
    set
}

/// Returns the parts that may break unseen, though an observer sees them on a sound robot: an
/// observer that stops observing is a known fact, and the parts that it alone watches are not known
/// to be sound (inferred). Faults of whichever module stand apart, since the scheduler sees those
/// that matter.
///
/// ```
/// use cotama_models::cotama::{Module, Modules, Resource, Resources, available, unwatched};
/// let blind = unwatched(Modules::ALL.without(Modules::of(&[Module::OSen])));
/// assert_eq!(blind.lost, Resources::of(&[Resource::SonarArrays, Resource::Camera]));
/// // Lost sonars take the checks on sonars along, and no other: the camera is watched as before.
/// let no_sonars = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
/// assert_eq!(unwatched(no_sonars).lost, Resources::NONE);
/// ```
#[must_use]
pub const fn unwatched(status: Modules) -> Health {
    let unseen = undetectable(status).without(undetectable(Modules::ALL));
    let (mut health, mut at) = (Health::SOUND, 0);
    while at < RULES.len() {
        if unseen.has(FailureMode::ALL[at]) {
            health = health.union(FailureMode::ALL[at].health(Modules::NONE));
        }
        at += 1;
    }
    health
}

impl Health {
    /// The modules that can be relied on: those that can be used, less what stands on something
    /// that nobody would see fail ([`unwatched`]).
    ///
    /// ```
    /// use cotama_models::cotama::{Configuration, Health, Losses, Module, Modules};
    /// let crashed = |it| Health { faulty: Modules::of(&[it]), ..Health::SOUND };
    /// let lost = |it| Losses::lacking(crashed(it).relied_on()).to_string();
    /// assert_eq!(lost(Module::OSen), "avoidance mcl sonar camera");
    /// assert_eq!(lost(Module::OLoc), "mcl");
    /// assert_eq!(lost(Module::OCom), "camera wifi");
    /// assert_eq!(lost(Module::OEff), "-"); // O-LOC, O-PF and the stall flag see what it saw
    /// ```
    #[must_use]
    pub const fn relied_on(self) -> Modules {
        self.union(unwatched(self.available())).available()
    }
}

/// Whether some flags leave it open which of two failure modes it is.
pub const fn are_confusable(a: FailureMode, b: FailureMode, status: Modules) -> bool {
    let ((least_a, most_a), (least_b, most_b)) = (bounds(a, status), bounds(b, status));
    is_detectable(a, status)
        && is_detectable(b, status)
        && a as u8 != b as u8
        && most_a.covers(least_b)
        && most_b.covers(least_a)
}

/// The groups of failure modes that share a set of flags: the largest ambiguous diagnoses, in the
/// order of [`FailureMode`]. Two modes are confusable exactly when some group holds both.
pub fn ambiguity_groups(status: Modules) -> impl Iterator<Item = FailureModes> {
    confusable_pairs(status).filter_map(move |(a, b)| {
        // Signatures are intervals of sets, and intervals that meet in pairs meet all at once. So a
        // group grown one by one from a pair is as large as it can be, and it is told where its
        // first pair is met.
        let group = FailureModes::ALL.iter().fold(FailureModes::of(&[a, b]), |group, next| {
            if group.iter().all(|it| it == next || are_confusable(it, next, status)) {
                group.with(next)
            } else {
                group
            }
        });
        let mut members = group.iter();
        (members.next() == Some(a) && members.next() == Some(b)).then_some(group)
    })
}

/// The flags that leave it open which of several failure modes it is: all of the first set are
/// raised, and some of the second, which holds the first. `None` when any flags rule one of them
/// out, or when one of them is not detectable.
///
/// ```
/// use cotama_models::cotama::FailureMode::{Loc1, Odo2, Son1};
/// use cotama_models::cotama::{FailureModes, Modules, shared_flags};
/// let (least, most) = shared_flags(FailureModes::of(&[Odo2, Loc1]), Modules::ALL).unwrap();
/// assert_eq!(least.to_string(), "pose growth");
/// assert_eq!(most.to_string(), "pose growth backward");
/// assert_eq!(shared_flags(FailureModes::of(&[Odo2, Son1]), Modules::ALL), None);
/// ```
#[must_use]
pub const fn shared_flags(modes: FailureModes, status: Modules) -> Option<(Flags, Flags)> {
    let (mut fewest, mut widest, mut at) = (Flags::NONE, Flags::ALL, 0);
    while at < RULES.len() {
        let mode = FailureMode::ALL[at];
        if modes.has(mode) {
            if !is_detectable(mode, status) {
                return None;
            }
            let (least, most) = bounds(mode, status);
            fewest = fewest.union(least);
            widest = widest.common(most);
        }
        at += 1;
    }
    if widest.covers(fewest) { Some((fewest, widest)) } else { None }
}

/// The pairs of confusable failure modes, the earlier one first.
pub fn confusable_pairs(status: Modules) -> impl Iterator<Item = (FailureMode, FailureMode)> {
    FailureModes::ALL.iter().flat_map(move |a| {
        FailureModes::ALL
            .iter()
            .filter(move |&b| a < b && are_confusable(a, b, status))
            .map(move |b| (a, b))
    })
}

impl Diagnosis {
    /// Returns the adjustment on this diagnosis: the one that the rows of all candidates share.
    ///
    /// ```
    /// use cotama_models::cotama::{Adjustment, Diagnosis, FailureMode, FailureModes};
    /// let late = Diagnosis::Ambiguous(FailureModes::of(&[FailureMode::Cam2, FailureMode::Com2]));
    /// assert_eq!(late.adjustment(), Some(Adjustment::FewerFrames));
    /// ```
    pub fn adjustment(self) -> Option<Adjustment> {
        match self {
            Self::Unique(mode) => mode.adjustment(),
            Self::Ambiguous(modes) => {
                let first = modes.first().and_then(FailureMode::adjustment);
                first.filter(|_| modes.iter().all(|it| it.adjustment() == first))
            }
            Self::None | Self::Unexplained => None,
        }
    }

    /// Returns the report to the contextual supervisor, and its severity in an autonomy mode.
    ///
    /// One failure mode is reported as its row says, and so are several whose rows say the same. Of
    /// others a closed bumper is reported as a collision, whatever closed it: in a degraded
    /// sub-objective that rule decides (stated, Durand et al., TAROS 2010, Section VI.A.4). What is
    /// left is for the operator, since no unique diagnosis can be made (stated, Section VI.A.2).
    ///
    /// ```
    /// use cotama_models::cotama::{Diagnosis, FailureMode, FailureModes, Flag, Flags};
    /// use cotama_models::cotama::{Mode::Autonomous, Report, Severity};
    /// let (bump, drift) = (Flags::of(&[Flag::Bumper]), Flags::of(&[Flag::PoseGrowth]));
    /// let several = |modes| Diagnosis::Ambiguous(FailureModes::of(modes));
    /// let wall_or_bumper = several(&[FailureMode::Bmp2, FailureMode::Loc3]);
    /// let collision = (Some(Report::Collision), Severity::Hard);
    /// assert_eq!(wall_or_bumper.judged(bump, Autonomous), collision);
    /// let lost = several(&[FailureMode::Odo2, FailureMode::Loc1]);
    /// assert_eq!(lost.judged(drift, Autonomous), (Some(Report::Ambiguous), Severity::Hard));
    /// ```
    pub fn judged(self, raised: Flags, mode: Mode) -> (Option<Report>, Severity) {
        match self {
            Self::None => (None, Severity::Weak),
            Self::Unique(it) => (it.rule().report, it.severity(mode)),
            Self::Ambiguous(candidates) => {
                let report = candidates.first().and_then(|it| it.rule().report);
                let worst = candidates.iter().map(|it| it.severity(mode)).max();
                if candidates.iter().all(|it| it.rule().report == report) {
                    (report, worst.unwrap_or(Severity::Hard))
                } else if raised.has(Flag::Bumper) {
                    (Some(Report::Collision), Severity::Hard)
                } else {
                    (Some(Report::Ambiguous), Severity::Hard)
                }
            }
            Self::Unexplained => (Some(Report::Ambiguous), Severity::Hard),
        }
    }

    /// Returns the parts that it breaks. `part` is the module of a fault of one module. An
    /// ambiguous one breaks nothing, but every module that a candidate would take is suspected. One
    /// broken sonar takes the arrays as a whole: the coarse rule of the publication, whose failure
    /// mode has the arrays as its loss.
    ///
    /// ```
    /// use cotama_models::cotama::{Flag, Flags, Module, Modules, Resource, Resources, diagnose};
    /// let one_sonar = diagnose(Flags::of(&[Flag::SonarFar]), Modules::ALL).health(Modules::NONE);
    /// assert_eq!(one_sonar.lost, Resources::of(&[Resource::SonarArrays]));
    /// assert!(!one_sonar.available().has(Module::Mcl));
    /// ```
    pub fn health(self, part: Modules) -> Health {
        match self {
            Self::Unique(mode) => mode.health(part),
            Self::Ambiguous(modes) => {
                let suspected = modes.iter().fold(Modules::NONE, |suspected, mode| {
                    let Health { faulty, lost, .. } = mode.health(part);
                    suspected.union(Modules::ALL.without(available(faulty, lost)))
                });
                Health { suspected, ..Health::SOUND }
            }
            Self::None | Self::Unexplained => Health::SOUND,
        }
    }
}

members! {
    /// An observation that the architecture does not make, and that would tell failure modes apart
    /// (all assumed).
    Probe,
    /// Observations that could be added.
    Probes(u8) {
        /// O-LOC: the spread of the particles above a limit that only a lost filter passes.
        SpreadLimit = "spread limit",
        /// New observer: ranges shorter than the map allows from the odometric pose.
        UnmappedObstacle = "unmapped obstacle",
        /// New sensor: a gyroscope that disagrees with the encoders.
        Gyroscope = "gyroscope",
        /// O-SEN: something near in front when the motors stall.
        ObstacleAtStall = "obstacle at stall",
        /// CAM: frames are late before they enter the radio link.
        FrameTimeAtSource = "frame time at source",
        /// NAV: the uncertainty of dead reckoning against the width of the corridor.
        ReckoningLimit = "reckoning limit",
    }
}

impl Probe {
    /// The failure modes that it would show.
    #[must_use]
    pub const fn shows(self) -> FailureModes {
        use FailureMode::{Bmp1, Cam2, Loc1, Loc2, Loc3, Odo1, Odo2, Odo3};
        FailureModes::of(match self {
            Self::SpreadLimit => &[Loc1],
            Self::UnmappedObstacle => &[Loc2],
            Self::Gyroscope => &[Odo1, Odo2, Odo3],
            Self::ObstacleAtStall => &[Bmp1],
            Self::FrameTimeAtSource => &[Cam2],
            Self::ReckoningLimit => &[Loc3],
        })
    }

    /// The modules without which it would see nothing; a new sensor needs none but itself.
    #[must_use]
    pub const fn needs(self) -> Modules {
        Modules::of(match self {
            Self::SpreadLimit => &[Module::OLoc, Module::Mcl],
            Self::UnmappedObstacle => &[Module::Ust],
            Self::ObstacleAtStall => &[Module::OSen, Module::Ust],
            Self::FrameTimeAtSource => &[Module::Cam],
            Self::ReckoningLimit => &[Module::Nav],
            Self::Gyroscope => &[],
        })
    }

    /// Whether it would tell two failure modes apart.
    pub const fn separates(self, a: FailureMode, b: FailureMode) -> bool {
        self.shows().has(a) != self.shows().has(b)
    }
}

impl Probes {
    /// Returns the flags of which each one would tell the two failure modes apart while these
    /// modules are available.
    #[must_use]
    pub fn that_separate(a: FailureMode, b: FailureMode, status: Modules) -> Self {
        let works = |probe: &Probe| status.covers(probe.needs()) && probe.separates(a, b);
        Self::ALL.iter().filter(works).fold(Self::NONE, Self::with)
    }

    /// The fewest that tell all confusable failure modes apart, the first in the order of [`Probe`]
    /// among equals; `None` when not even all of them do.
    ///
    /// ```
    /// use cotama_models::cotama::{Modules, Probes};
    /// let least = Probes::least(Modules::ALL).unwrap();
    /// let flags = "spread limit unmapped obstacle obstacle at stall frame time at source";
    /// assert_eq!(least.to_string(), flags);
    /// ```
    #[must_use]
    pub fn least(status: Modules) -> Option<Self> {
        let can = |(a, b)| !Self::that_separate(a, b, status).is_empty();
        confusable_pairs(status).all(can).then(|| Self::least_that_help(status))
    }

    /// The fewest that tell all those failure modes apart that any probe can, the first in the
    /// order of [`Probe`] among equals. Exact: every subset is tried.
    #[must_use]
    pub fn least_that_help(status: Modules) -> Self {
        let separates = |set: &Self| {
            confusable_pairs(status)
                .map(|(a, b)| Self::that_separate(a, b, status))
                .all(|probes| probes.is_empty() || !probes.common(*set).is_empty())
        };
        (0..=Self::ALL.bits())
            .filter_map(Self::from_bits)
            .filter(separates)
            .min_by_key(|set| (set.len(), set.bits()))
            .unwrap_or(Self::ALL)
    }
}
