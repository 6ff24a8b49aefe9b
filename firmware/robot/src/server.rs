//! The robot as it is reached over its UART: a period of the control loop for each frame that says
//! what is seen, a plan for each that asks for one.
//!
//! | first byte | content | answer |
//! | --- | --- | --- |
//! | [`PERIOD`] | a [`Period`] | [`PERIOD`], the requests |
//! | [`PLAN`] | what is left: [`Asked`] | [`PLAN`], first activity, and a plan where there is one |
//! | anything else | | [`UNKNOWN`] |
//!
//! A plan is an alternative for each activity left, and ms, mJ and quality, `u32` each.
//!
//! Before an answer to a frame before which some are missing stands a [`MISSING`] with how many.

use crate::control::PERIOD_MS;
use crate::link::{LONGEST, Received, Receiver, Sender};
use crate::message::{Period, REQUESTS_BYTES, requests_to_bytes};
use crate::patrol::{Patrol, Planner, STAGES, Tables, Workspace};
use crate::robots::delivery::Control;
use crate::trace::{Nowhere, Trace};
use cotama_core::hardware::Equipment;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::tables::Rest;
use cotama_models::missions::tables::patrol::ACTIVITIES;

/// A frame with the news of a period.
pub const PERIOD: u8 = 0;
/// A plan.
pub const PLAN: u8 = 1;
/// Frames are missing: their number, `u16`.
pub const MISSING: u8 = 2;
/// The received content stands for nothing.
pub const UNKNOWN: u8 = 3;

/// The robot behind its UART.
#[derive(Clone, Debug, Default)]
pub struct Server {
    /// The control loop.
    pub control: Control,
    receiver: Receiver,
    sender: Sender,
    now: Millis,
}

/// The action of the server on a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Served {
    /// A period went by: what is to be stored may have changed.
    Period,
    /// Something else was answered.
    Answered,
    /// A frame that the caller has to understand: its first byte.
    Other(u8),
}

impl Server {
    /// With this control loop, at the start.
    pub fn new(control: Control) -> Self {
        let (receiver, sender) = (Receiver::default(), Sender::default());
        Self { control, receiver, sender, now: Millis(0) }
    }

    /// Takes a byte; answers when it ends a frame. `exact` is the memory of the exact allocator;
    /// without it the rule of the paper plans.
    pub fn take(
        &mut self,
        byte: u8,
        tables: &mut Tables,
        exact: Option<&mut Workspace>,
        mut put: impl FnMut(u8),
    ) -> Option<Served> {
        let Some(Received::Frame { missing, content, .. }) = self.receiver.take(byte) else {
            return None; // of a refused frame the next one tells
        };
        if missing > 0 {
            let [low, high] = missing.to_le_bytes();
            self.sender.send(&[MISSING, low, high], &mut put);
        }
        let (&kind, content) = content.split_first()?;
        let period = if kind == PERIOD { Period::from_bytes(content) } else { None };
        let asked = if kind == PLAN { Asked::from_bytes(content) } else { None };
        match (period, asked) {
            (Some(period), _) => {
                let mut nowhere = Nowhere;
                let mut trace = Trace::new(&mut nowhere);
                let (requests, restarts) = self.control.period(self.now, &period, &mut trace);
                self.now = Millis(self.now.0 + PERIOD_MS);
                let mut answer = [PERIOD; 1 + REQUESTS_BYTES];
                answer[1..].copy_from_slice(&requests_to_bytes(&requests, restarts));
                self.sender.send(&answer, put);
                Some(Served::Period)
            }
            (_, Some(asked)) => {
                let (answer, length) = asked.answer(tables, exact);
                self.sender.send(answer.get(..length)?, put);
                Some(Served::Answered)
            }
            _ if kind > UNKNOWN => Some(Served::Other(kind)),
            _ => {
                self.sender.send(&[UNKNOWN], put);
                Some(Served::Answered)
            }
        }
    }
}

/// A plan that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The activity under way.
    pub first: u8,
    /// Rest of the activity, in mm of travel or ms.
    pub rest: u32,
    /// The hardware that there is: [`Equipment::to_bits`], of which this mission needs 32.
    pub hardware: u32,
    /// Amounts used, in ms and mJ.
    pub used: [u32; 2],
}

impl Asked {
    /// Length in bytes.
    pub const BYTES: usize = 17;

    /// As bytes, little endian.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        bytes[0] = self.first;
        let words = [self.rest, self.hardware, self.used[0], self.used[1]];
        for (bytes, word) in bytes[1..].chunks_exact_mut(4).zip(words) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    /// From bytes; `None` when they ask for no plan of this mission.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (&first, words) = bytes.split_first()?;
        let words: &[u8; Self::BYTES - 1] = words.try_into().ok()?;
        let word = |at: usize| words[4 * at..].first_chunk().map(|it| u32::from_le_bytes(*it));
        let (rest, hardware, used) = (word(0)?, word(1)?, [word(2)?, word(3)?]);
        let known = usize::from(first) < STAGES && Equipment::from_bits(hardware.into()).is_some();
        known.then_some(Self { first, rest, hardware, used })
    }

    #[inline(never)]
    fn answer(&self, tables: &mut Tables, exact: Option<&mut Workspace>) -> ([u8; LONGEST], usize) {
        let mut answer = [0; LONGEST];
        answer[..2].copy_from_slice(&[PLAN, self.first]);
        let first = usize::from(self.first);
        let rest = if ACTIVITIES[first].travels() {
            Rest::Travel(Millimetres(self.rest.into()))
        } else {
            Rest::Time(Millis(self.rest.into()))
        };
        let hardware = Equipment::from_bits(self.hardware.into()).unwrap_or(Equipment::NONE);
        let mut patrol = Patrol::at(first, rest, hardware, self.used.map(u64::from));
        let mut planner = exact.map_or(Planner::Rule, Planner::Exact);
        let Some((cost, quality)) = patrol.make(&mut planner, tables) else { return (answer, 2) };
        let mut length = 2;
        for &alternative in patrol.left() {
            answer[length] = alternative as u8;
            length += 1;
        }
        for number in [cost[0], cost[1], quality] {
            answer[length..length + 4].copy_from_slice(&(number as u32).to_le_bytes());
            length += 4;
        }
        (answer, length)
    }
}
