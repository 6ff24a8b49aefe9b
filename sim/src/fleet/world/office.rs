//! Data of takeovers: whom a robot follows, and what an auctioneer does before it acts.

use crate::fleet::ledger::Ledger;
use crate::fleet::message::Letter;
use cotama_core::team::RobotSet;
use std::collections::VecDeque;
use std::rc::Rc;

/// A successor does not take over for so long after a copy was sent, in ms.
pub(super) const HOLD: u64 = 5_000;

/// The auctioneer that a robot follows.
#[derive(Clone, Debug)]
pub(super) struct Follows {
    pub(super) term: u32,
    pub(super) address: usize,
    /// When it last heard of it.
    pub(super) heard_ms: u64,
    pub(super) copy: Option<Copy>,
}

impl Follows {
    pub(super) const fn new(address: usize) -> Self {
        Self { term: 0, address, heard_ms: 0, copy: None }
    }
}

/// A copy of what the auctioneer knew, and the place of the robot in the queue.
#[derive(Clone, Debug)]
pub(super) struct Copy {
    pub(super) version: u64,
    pub(super) sent_ms: u64,
    pub(super) place: u64,
    pub(super) ledger: Rc<Ledger>,
}

/// Work of an auctioneer with successors before it acts.
#[derive(Clone, Debug, Default)]
pub(super) struct Office {
    pub(super) term: u32,
    /// The version of its knowledge that was last copied, with the copy.
    pub(super) version: u64,
    pub(super) copy: Option<Rc<Ledger>>,
    pub(super) successors: Vec<Successor>,
    /// Letters that leave when the version is copied.
    pub(super) held: VecDeque<(u64, Letter)>,
    /// The robots that it has heard of.
    pub(super) met: RobotSet,
}

#[derive(Clone, Debug)]
pub(super) struct Successor {
    pub(super) robot: usize,
    /// The newest version that it has, and when the copy that it last answered was sent.
    pub(super) version: u64,
    pub(super) sent_ms: u64,
}

impl Office {
    /// A robot has a copy.
    pub(super) fn copied(&mut self, robot: usize, term: u32, version: u64, sent_ms: u64) {
        let mut all = self.successors.iter_mut();
        if let Some(it) = all.find(|it| it.robot == robot && term == self.term) {
            it.version = it.version.max(version);
            it.sent_ms = it.sent_ms.max(sent_ms);
        }
    }

    /// Whether no successor can have taken over.
    pub(super) fn may_act(&self, now: u64) -> bool {
        self.successors.iter().all(|it| now < it.sent_ms + HOLD)
    }
}
