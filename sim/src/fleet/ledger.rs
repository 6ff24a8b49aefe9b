//! Knowledge of an auctioneer of its tasks: whoever takes over from it goes on with a copy.

use crate::fleet::award::Award;
use cotama_core::team::RobotSet;
use std::rc::Rc;

/// The state of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Unknown,
    Open,
    Announced,
    Awarded,
    Executing,
    /// The award is withdrawn: members confirm, or its time runs out.
    Withdrawn,
    Done,
    Reported,
}

/// The auctioneer's knowledge of a task.
#[derive(Clone, Debug)]
pub(super) struct Ticket {
    pub(super) state: State,
    pub(super) known_since: u64,
    pub(super) award: Option<Rc<Award>>,
    pub(super) acked: RobotSet,
    pub(super) completed: RobotSet,
    pub(super) gone: RobotSet,
    /// Until when the award holds for each member, by its place.
    pub(super) until: Vec<u64>,
    pub(super) resend: u64,
    pub(super) deadline: u64,
    pub(super) awards: u32,
    pub(super) vain: u32,
    /// An earlier award of it turned out to be completed.
    pub(super) finished: bool,
    /// Why it is to be reported.
    pub(super) report: Option<&'static str>,
    /// Awards before this one, with who completed.
    pub(super) past: Vec<(Rc<Award>, RobotSet)>,
}

/// Knowledge of an auctioneer that whoever takes over from it needs.
#[derive(Clone, Debug)]
pub(super) struct Ledger {
    pub(super) round: u32,
    pub(super) tickets: Vec<Rc<Ticket>>,
}
