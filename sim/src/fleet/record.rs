//! The records of a run, in the order of time, and its numbers.

use super::message::Kind;
use crate::trace::Line;
use cotama_models::team::ErrorClass;
use cotama_models::team::scenario::Stage;
use serde::{Deserialize, Serialize};

/// Something that happened. Robots and tasks are numbers; the header of a trace has their names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "record", rename_all = "snake_case")]
pub enum Record {
    /// A task became known.
    Opened {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
    },
    /// An auction ended.
    Round {
        /// When, in ms.
        t_ms: u64,
        /// Number of the round, from 1.
        round: u32,
        /// The tasks that were announced.
        tasks: Vec<usize>,
        /// How many robots bid.
        bids: usize,
        /// How many of the tasks were awarded.
        awards: usize,
    },
    /// A task was awarded.
    Awarded {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
        /// The round.
        round: u32,
        /// The name of the plan.
        plan: String,
        /// The robot of each role.
        robots: Vec<usize>,
        /// Planned cost of each role, in ms.
        costs_ms: Vec<u32>,
        /// Largest cost of each role, in ms.
        pledges_ms: Vec<u64>,
        /// Probability that no action of each role fails, as its robot takes it to be, in parts
        /// per 10⁹; empty where all are certain.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        success: Vec<u32>,
    },
    /// A robot came to another stage of its task.
    Stage {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The task; none where it rests.
        task: Option<usize>,
        /// The stage.
        #[serde(with = "crate::named")]
        stage: Stage,
    },
    /// The spot of a robot on a floor: where it stands, and every two seconds of a drive.
    At {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The place that it is coming from.
        from: usize,
        /// The next place.
        to: usize,
        /// The way that it has come, in mm.
        done_mm: u64,
    },
    /// A robot fails.
    Fails {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The short name of the row of the robot's file.
        mode: String,
    },
    /// The object of a task moves under the hand.
    Shifted {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
    },
    /// The object of a task turns: some capabilities can no longer take it.
    Turned {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
    },
    /// The decisional component of a robot found a failure.
    Found {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The short name of the row of the robot's file.
        mode: String,
    },
    /// The decisional component of a robot changed its configuration under way.
    Configured {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The name of the configuration.
        configuration: String,
    },
    /// An error in a task, by its class.
    Error {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The task.
        task: usize,
        /// The class.
        #[serde(with = "crate::named")]
        class: ErrorClass,
        /// The reason, in words.
        why: String,
    },
    /// The use of a skill failed.
    Failed {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The task.
        task: usize,
        /// The name of the skill.
        skill: String,
        /// The number of the use of it by this robot in the run, from 1.
        number: u32,
        /// What the robot takes its reliability to be from now on, in parts per 10⁹.
        reliability: u32,
    },
    /// The auctioneer has not heard of a robot for too long, and withdraws the award.
    Silent {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The task.
        task: usize,
    },
    /// A task was put up again.
    Reopened {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
    },
    /// A task was done.
    Done {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
        /// The robots of the award.
        robots: Vec<usize>,
    },
    /// A task was reported to who gave it to the team: it is not done.
    Reported {
        /// When, in ms.
        t_ms: u64,
        /// The task.
        task: usize,
        /// The reason, in words.
        why: String,
    },
    /// A robot gives tasks out from now on, as it heard nothing more of who did.
    TakesOver {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// Whether it had a copy of what the auctioneer before knew.
        copied: bool,
    },
    /// A free robot drives home to be charged, or is there.
    GoesHome {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The energy that is left, in mJ.
        charge_mj: u64,
    },
    /// The battery of a robot is full.
    Charged {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
    },
    /// The battery of a robot is empty: nothing of it works any more.
    Empty {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
    },
    /// All tasks have ended: the numbers of the run.
    End(Box<Run>),
}

impl Line for Record {
    fn time(&self) -> u64 {
        match self {
            Self::Opened { t_ms, .. }
            | Self::Round { t_ms, .. }
            | Self::Awarded { t_ms, .. }
            | Self::Stage { t_ms, .. }
            | Self::At { t_ms, .. }
            | Self::Fails { t_ms, .. }
            | Self::Shifted { t_ms, .. }
            | Self::Turned { t_ms, .. }
            | Self::Found { t_ms, .. }
            | Self::Configured { t_ms, .. }
            | Self::Error { t_ms, .. }
            | Self::Failed { t_ms, .. }
            | Self::Silent { t_ms, .. }
            | Self::Reopened { t_ms, .. }
            | Self::Done { t_ms, .. }
            | Self::TakesOver { t_ms, .. }
            | Self::GoesHome { t_ms, .. }
            | Self::Charged { t_ms, .. }
            | Self::Empty { t_ms, .. }
            | Self::Reported { t_ms, .. } => *t_ms,
            Self::End(_) => u64::MAX,
        }
    }

    fn is_end(&self) -> bool {
        matches!(self, Self::End(_))
    }
}

/// How a task ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// The task is neither done nor reported: the run was cut short. Never, or the protocol is
    /// wrong.
    #[default]
    Open,
    /// The task is done.
    Done,
    /// The task was reported as not to be done.
    Reported,
}

/// The numbers of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Run {
    /// How each task ended.
    pub fates: Vec<Fate>,
    /// When, in ms.
    pub ended_ms: Vec<u64>,
    /// How often the object of each task was delivered, or its words were said: at most once.
    pub deliveries: Vec<u32>,
    /// How often a robot began a role of a task while another one still worked for an older award
    /// of it: never.
    pub overlaps: u32,
    /// How often each task was awarded.
    pub awards: Vec<u32>,
    /// How often it was put up again.
    pub reopened: u32,
    /// Auctions.
    pub rounds: u32,
    /// Messages sent, of each kind, in the order of [`Kind::ALL`].
    pub messages: [u64; Kind::ALL.len()],
    /// Messages by which robots are ready to take over, and do.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub copies: u64,
    /// Number of times that a robot took over from an auctioneer that was silent.
    #[serde(default, skip_serializing_if = "is_none")]
    pub takeovers: u32,
    /// Number of times that the one before still gave tasks out then: none.
    #[serde(default, skip_serializing_if = "is_none")]
    pub rivals: u32,
    /// Messages that got lost.
    pub lost: u64,
    /// For how long robots worked for tasks, all together, in ms.
    pub busy_ms: u64,
    /// The same with the utility of what was not done.
    pub cost_ms: u64,
    /// Energy that the robots drew until the end, all together, in mJ.
    pub energy_mj: u64,
    /// From when tasks became known until they were done, all together, in ms.
    pub waited_ms: u64,
    /// When the last task ended.
    pub end_ms: u64,
    /// Robots that cannot work any more.
    pub out: usize,
    /// Number of times that a battery was charged.
    #[serde(default, skip_serializing_if = "is_none")]
    pub charges: u32,
    /// Uses of skills that failed.
    #[serde(default, skip_serializing_if = "is_none")]
    pub failed_uses: u32,
    /// Awards to robots of which a skill may fail that would have gone to others had all known how
    /// often: for each, how often the robot had used such skills before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub undue: Vec<u32>,
    /// The uses of skills that may fail or are counted, robot by robot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skills: Vec<SkillUses>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_none(count: &u32) -> bool {
    *count == 0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// The uses of a skill of a robot in a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SkillUses {
    /// The robot.
    pub robot: usize,
    /// The name of the skill.
    pub skill: String,
    /// Uses that the skill decided.
    pub uses: u32,
    /// Those of them that failed.
    pub failed: u32,
    /// What the robot takes its reliability to be at the end, in parts per 10⁹.
    pub reliability: u32,
}

impl Run {
    /// How many tasks ended this way.
    pub fn count(&self, fate: Fate) -> usize {
        self.fates.iter().filter(|it| **it == fate).count()
    }

    /// How many messages of this kind were sent.
    pub fn sent(&self, kind: Kind) -> u64 {
        self.messages.get(kind as usize).copied().unwrap_or(self.copies)
    }

    /// Whether all that must hold holds: each task is done or reported, no object was delivered
    /// twice, nobody worked for two awards of a task at once, and one at most gave tasks out.
    pub fn is_sound(&self) -> bool {
        self.overlaps == 0
            && self.rivals == 0
            && !self.fates.contains(&Fate::Open)
            && self.deliveries.iter().all(|it| *it <= 1)
            && self.fates.iter().zip(&self.deliveries).all(|it| *it.0 != Fate::Done || *it.1 == 1)
    }
}
