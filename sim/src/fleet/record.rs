//! What a run leaves behind: its records, in the order of time, and its numbers.

use super::message::Kind;
use super::task::Stage;
use serde::Serialize;

/// Something that happened. Robots and tasks are numbers; the header of a trace has their names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
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
        /// Its number, from 1.
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
        /// What each role is to cost, in ms.
        costs_ms: Vec<u32>,
        /// What each role may cost, in ms.
        pledges_ms: Vec<u64>,
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
        stage: Stage,
    },
    /// Something went wrong.
    Fault {
        /// When, in ms.
        t_ms: u64,
        /// The robot that it is about.
        #[serde(skip_serializing_if = "Option::is_none")]
        robot: Option<usize>,
        /// The task whose object it is about.
        #[serde(skip_serializing_if = "Option::is_none")]
        task: Option<usize>,
        /// The failure mode of a robot; `shifted` or `turned` of an object.
        what: String,
    },
    /// The decisional component of a robot found a failure.
    Found {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The failure mode.
        mode: String,
    },
    /// The decisional component of a robot changed its configuration under way.
    Configured {
        /// When, in ms.
        t_ms: u64,
        /// The robot.
        robot: usize,
        /// The configuration.
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
        /// `recoverable`, `semi-recoverable` or `non-recoverable`.
        class: String,
        /// What happened.
        why: String,
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
        /// Why.
        why: String,
    },
}

/// How a task ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It is neither: the run was cut short. Never, or the protocol is wrong.
    #[default]
    Open,
    /// It is done.
    Done,
    /// It was reported as not to be done.
    Reported,
}

/// The numbers of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
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
    /// Messages that got lost.
    pub lost: u64,
    /// For how long robots worked for tasks, all together, in ms.
    pub busy_ms: u64,
    /// The same with the utility of what was not done.
    pub cost_ms: u64,
    /// From when tasks became known until they were done, all together, in ms.
    pub waited_ms: u64,
    /// When the last task ended.
    pub end_ms: u64,
    /// Robots that cannot work any more.
    pub out: usize,
}

impl Run {
    /// How many tasks ended this way.
    pub fn count(&self, fate: Fate) -> usize {
        self.fates.iter().filter(|it| **it == fate).count()
    }

    /// How many messages of this kind were sent.
    pub fn sent(&self, kind: Kind) -> u64 {
        self.messages[kind as usize]
    }

    /// Whether all that must hold holds: each task is done or reported, no object was delivered
    /// twice, and nobody worked for two awards of a task at once.
    pub fn is_sound(&self) -> bool {
        self.overlaps == 0
            && !self.fates.contains(&Fate::Open)
            && self.deliveries.iter().all(|it| *it <= 1)
            && self.fates.iter().zip(&self.deliveries).all(|it| *it.0 != Fate::Done || *it.1 == 1)
    }
}
