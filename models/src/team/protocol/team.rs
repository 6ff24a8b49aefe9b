//! The team for which the net of a protocol is made.

use std::collections::BTreeSet;

/// The largest team that there is a net for.
pub const MOST_ROBOTS: usize = 6;

/// A task: its first auctioneer, and the robots that can fill each role of each plan, by their
/// numbers from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Job {
    pub(super) received: usize,
    pub(super) plans: Vec<Vec<Vec<usize>>>,
}

impl Job {
    /// Returns the robots that can fill a role, by their numbers.
    pub(super) fn capable(&self) -> Vec<usize> {
        let all: BTreeSet<_> = self.plans.iter().flatten().flatten().copied().collect();
        all.into_iter().collect()
    }

    /// The most robots that work for it at once.
    pub(super) fn most_roles(&self) -> usize {
        self.plans.iter().map(Vec::len).max().unwrap_or(0)
    }
}

/// Robots, tasks, failures, and where the protocol departs from the repaired one.
///
/// ```
/// use cotama_models::team::protocol::{Defect, Team};
/// let team = Team::new(3, 1);
/// assert_eq!(team.robots(), 3);
/// assert_eq!(team.with(&[Defect::NoRelease]).defects(), [Defect::NoRelease]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Team {
    pub(super) robots: usize,
    pub(super) failures: u32,
    pub(super) tasks: Vec<Job>,
    pub(super) defects: Vec<Defect>,
    pub(super) keeps_old: bool,
}

impl Team {
    /// Two tasks: one of two roles that everybody can fill, received by the first robot, and one of
    /// a single role that the last half of the robots can fill (of three the last one), received by
    /// the second one. There are from 2 to [`MOST_ROBOTS`] robots (else the nearest number), and at
    /// most so many failures: a robot breaks down or gives its role up.
    pub fn new(robots: usize, failures: u32) -> Self {
        let robots = robots.clamp(2, MOST_ROBOTS);
        let all: Vec<_> = (0..robots).collect();
        let pair = Job { received: 0, plans: vec![vec![all.clone(), all]] };
        let last = (robots - robots / 2..robots).collect();
        let alone = Job { received: 1, plans: vec![vec![last]] };
        let failures = failures.min(robots as u32);
        Self::of(robots, failures, vec![pair, alone])
    }

    /// A team of the repaired protocol.
    pub(super) const fn of(robots: usize, failures: u32, tasks: Vec<Job>) -> Self {
        Self { robots, failures, tasks, defects: Vec::new(), keeps_old: true }
    }

    /// Two robots that never fail, each with a task of two roles: two auctioneers that want the
    /// same coalition.
    pub fn rivals() -> Self {
        let pair = |received| Job { received, plans: vec![vec![vec![0, 1]; 2]] };
        Self { tasks: vec![pair(0), pair(1)], ..Self::new(2, 0) }
    }

    /// The same with these defects.
    #[must_use]
    pub fn with(self, defects: &[Defect]) -> Self {
        Self { defects: defects.to_vec(), ..self }
    }

    /// The same, where messages of older rounds leave no trace. The repaired protocol never looks
    /// at them, so that nothing else changes but the number of states.
    #[must_use]
    pub fn without_old_messages(self) -> Self {
        Self { keeps_old: false, ..self }
    }

    /// How many robots there are.
    pub const fn robots(&self) -> usize {
        self.robots
    }

    /// How many tasks there are.
    pub const fn tasks(&self) -> usize {
        self.tasks.len()
    }

    /// How often a robot fails at most.
    pub const fn failures(&self) -> u32 {
        self.failures
    }

    /// Returns the departures from the repaired protocol.
    pub fn defects(&self) -> &[Defect] {
        &self.defects
    }
}

/// A departure from the repaired protocol.
///
/// ```
/// use cotama_models::team::protocol::{Defect, TEXT};
/// assert_eq!((Defect::ALL.len(), TEXT.len()), (26, 10));
/// assert!(TEXT.iter().all(|it| Defect::ALL.contains(it)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Defect {
    /// The auctioneer awards when all who were alive have answered, and has no deadline (P1).
    WaitsForAllBids,
    /// The auctioneer has no deadline for acknowledgements: it notices no silence (P2).
    NoDeadlineForAcks,
    /// The auctioneer does not notice that a member died while it executed.
    NoDeadlineForWork,
    /// The auctioneer sends no Release to a robot from which it withdrew an award (P2).
    NoRelease,
    /// A withdrawn award is announced again before its members have left (P2).
    ReopensAtOnce,
    /// All members are asked at once, so two auctioneers can each get one of them (P3).
    AsksAllAtOnce,
    /// The next auctioneer knows the task as open at most (P4).
    TasksNotCopied,
    /// The next auctioneer does not know the task (P4).
    TasksForgotten,
    /// The auctioneer counts an Ack of an older round (P5).
    CountsOldAcks,
    /// A partner starts on an Ack of an older round.
    StartsOnOldAck,
    /// A robot follows an Assign of an older round.
    FollowsOldAssign,
    /// An award names who bid in an older round.
    NamesOldBidders,
    /// A robot starts on its own Ack.
    StartsAlone,
    /// A robot says yes without looking whether it is free.
    AcksWhileBusy,
    /// The auctioneer does not look at capabilities.
    NamesIncapable,
    /// The auctioneer takes the silence of a dead robot for a yes.
    SilenceIsConsent,
    /// A "no" that comes late opens a task that is done.
    OpensDone,
    /// A robot that completed its role says so by "no" when it is released.
    CompletedIsLeft,
    /// The next auctioneer takes over though the first one is alive.
    TakesOverEarly,
    /// Nobody takes over.
    NobodyTakesOver,
    /// A robot that executes does not hear a Release.
    ExecutesOn,
    /// A robot that completed its role stays reserved.
    StaysReserved,
    /// A robot obeys a Release of an older round.
    ObeysOldRelease,
    /// Tasks that no robot can do are not reported.
    NeverReports,
    /// A task is reported while its award stands.
    ReportsAwarded,
    /// A robot that gave its role up does not say so.
    FailureUnsaid,
}

/// The protocol as the thesis's text has it, where it is read as it stands: no deadlines (P1), no
/// rule for a Nack or a dead partner (P2), two auctioneers that ask for the same robots at once
/// (P3), tasks that no other robot knows (P4), acknowledgements without a round (P5).
pub const TEXT: &[Defect] = &[
    Defect::WaitsForAllBids,
    Defect::NoDeadlineForAcks,
    Defect::NoDeadlineForWork,
    Defect::NoRelease,
    Defect::ReopensAtOnce,
    Defect::AsksAllAtOnce,
    Defect::TasksNotCopied,
    Defect::TasksForgotten,
    Defect::CountsOldAcks,
    Defect::StartsOnOldAck,
];

impl Defect {
    /// All defects.
    pub const ALL: &[Self] = &[
        Self::WaitsForAllBids,
        Self::NoDeadlineForAcks,
        Self::NoDeadlineForWork,
        Self::NoRelease,
        Self::ReopensAtOnce,
        Self::AsksAllAtOnce,
        Self::TasksNotCopied,
        Self::TasksForgotten,
        Self::CountsOldAcks,
        Self::StartsOnOldAck,
        Self::FollowsOldAssign,
        Self::NamesOldBidders,
        Self::StartsAlone,
        Self::AcksWhileBusy,
        Self::NamesIncapable,
        Self::SilenceIsConsent,
        Self::OpensDone,
        Self::CompletedIsLeft,
        Self::TakesOverEarly,
        Self::NobodyTakesOver,
        Self::ExecutesOn,
        Self::StaysReserved,
        Self::ObeysOldRelease,
        Self::NeverReports,
        Self::ReportsAwarded,
        Self::FailureUnsaid,
    ];
}
