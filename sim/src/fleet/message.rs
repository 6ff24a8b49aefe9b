//! Messages between robots and auctioneers (F. Rohrmueller, dissertation, TU München 2011,
//! Algorithms 3.1 and 3.2; `Release` and the terms of an award are ours).

pub(super) use crate::fleet::award::{Award, AwardId};
use crate::fleet::bid::{Offer, Share};
use crate::fleet::ledger::Ledger;
use cotama_models::team::ErrorClass;
use std::rc::Rc;

/// The sender or the receiver of a message: each robot has a broker, and one address an auctioneer
/// too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Party {
    /// The broker of a robot, with its bidder.
    Robot(usize),
    /// The auctioneer at an address: that of a robot, or one more than all of them.
    Auctioneer(usize),
}

impl Party {
    pub(super) const fn address(self) -> usize {
        match self {
            Self::Robot(it) | Self::Auctioneer(it) => it,
        }
    }
}

/// How it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Status {
    Progress,
    Completed,
    Failed(ErrorClass),
}

/// Why an award ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ending {
    /// The award is withdrawn: everyone goes back to idle and says so by `Nack`.
    Withdrawn,
    /// The news that the task is completed or failed has been heard.
    Heard,
}

/// A message.
#[derive(Clone, Debug)]
pub(super) enum Message {
    /// A robot is there. `fit` says whether it can work; it `asks` who gives tasks out where it
    /// has not heard of that for long.
    Alive { busy: bool, fit: bool, asks: bool },
    /// From the auctioneer: it has heard of the award, which holds until then. `complete` says
    /// that all members have acknowledged it.
    Prolong { award: AwardId, until_ms: u64, complete: bool },
    /// These tasks are open.
    Announce { round: u32, tasks: Rc<[usize]> },
    /// A broker asks a bidder for its costs.
    Request { round: u32, tasks: Rc<[usize]> },
    /// The answer of a bidder.
    Reply { round: u32, offers: Rc<[Offer]> },
    /// Costs of the robot in roles, or the best coalition that the broker answers for.
    Bid { round: u32, offers: Rc<[Offer]>, coalition: Option<Share> },
    /// An award of which the robot is a member, or the news that it is in none of this round.
    Assign { award: Option<Rc<Award>>, until_ms: u64 },
    /// The award is accepted.
    Ack { award: AwardId },
    /// The robot is not, or no longer, bound by the award.
    Nack { award: AwardId },
    /// How a role goes.
    Status { award: AwardId, status: Status },
    /// The end of an award.
    Release { award: AwardId, ending: Ending },
    /// From an auctioneer that may be replaced: it gives tasks out.
    Leads,
    /// The knowledge of the auctioneer at a time, for the robot that is so many places behind it.
    Copy { version: u64, sent_ms: u64, place: u64, ledger: Rc<Ledger> },
    /// The copy has come; until some time after it was sent the robot does not take over.
    Copied { term: u32, version: u64, sent_ms: u64 },
}

/// A message under way.
#[derive(Clone, Debug)]
pub(super) struct Letter {
    pub(super) from: Party,
    pub(super) to: Party,
    /// Takeovers before an auctioneer began; 0 of a robot.
    pub(super) term: u32,
    pub(super) message: Message,
}

/// The kinds of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Robots report that they are there, and for how long an award holds.
    Alive,
    /// Open tasks are announced.
    Announce,
    /// A broker asks a bidder.
    Request,
    /// A bidder answers.
    Reply,
    /// A broker bids.
    Bid,
    /// A coalition is awarded a task.
    Assign,
    /// Accepted.
    Ack,
    /// Not accepted, or given back on demand.
    Nack,
    /// How a role goes.
    Status,
    /// An award is withdrawn, or its end was heard.
    Release,
    /// Knowledge of an auctioneer is copied, and who gives tasks out is said.
    Copy,
}

impl Kind {
    /// All kinds but [`Copy`](Self::Copy), which is where one robot takes over from another.
    pub const ALL: [Self; 10] = [
        Self::Alive,
        Self::Announce,
        Self::Request,
        Self::Reply,
        Self::Bid,
        Self::Assign,
        Self::Ack,
        Self::Nack,
        Self::Status,
        Self::Release,
    ];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alive => "Alive",
            Self::Announce => "Announce",
            Self::Request => "Request",
            Self::Reply => "Reply",
            Self::Bid => "Bid",
            Self::Assign => "Assign",
            Self::Ack => "Ack",
            Self::Nack => "Nack",
            Self::Status => "Status",
            Self::Release => "Release",
            Self::Copy => "Copy",
        }
    }
}

impl Message {
    pub(super) const fn kind(&self) -> Kind {
        match self {
            Self::Alive { .. } | Self::Prolong { .. } => Kind::Alive,
            Self::Announce { .. } => Kind::Announce,
            Self::Request { .. } => Kind::Request,
            Self::Reply { .. } => Kind::Reply,
            Self::Bid { .. } => Kind::Bid,
            Self::Assign { .. } => Kind::Assign,
            Self::Ack { .. } => Kind::Ack,
            Self::Nack { .. } => Kind::Nack,
            Self::Status { .. } => Kind::Status,
            Self::Release { .. } => Kind::Release,
            Self::Leads | Self::Copy { .. } | Self::Copied { .. } => Kind::Copy,
        }
    }
}
