//! The network: it delays, loses, copies and so reorders what robots say to each other.

use super::message::{Kind, Letter};
use crate::streams::{Stream, Streams};
use cotama_models::team::scenario::Quality;

/// A network, and what it was given.
#[derive(Clone, Debug)]
pub(super) struct Network {
    quality: Quality,
    loss: Stream,
    delay: Stream,
    copies: Stream,
    sent: [u64; Kind::ALL.len()],
    copied: u64,
    lost: u64,
}

impl Network {
    pub(super) fn new(quality: Quality, streams: Streams) -> Self {
        Self {
            quality,
            loss: streams.stream("network loss"),
            delay: streams.stream("network delay"),
            copies: streams.stream("network copies"),
            sent: [0; Kind::ALL.len()],
            copied: 0,
            lost: 0,
        }
    }

    /// When a letter arrives, each time that it does. Who writes to itself needs no network.
    pub(super) fn carry(&mut self, now_ms: u64, letter: &Letter) -> impl Iterator<Item = u64> {
        let Quality { delay_ms, jitter_ms, loss_permille, copies_permille } = self.quality;
        let kind = letter.message.kind() as usize;
        *self.sent.get_mut(kind).unwrap_or(&mut self.copied) += 1;
        let own = letter.from.address() == letter.to.address();
        let lost = !own && self.loss.below(1_000) < u64::from(loss_permille);
        let copied = !own && self.copies.below(1_000) < u64::from(copies_permille);
        self.lost += u64::from(lost);
        let mut takes = || {
            if own { now_ms } else { now_ms + delay_ms + self.delay.below(jitter_ms + 1) }
        };
        let arrivals = [(!lost).then(&mut takes), (!lost && copied).then(&mut takes)];
        arrivals.into_iter().flatten()
    }

    /// How many messages of each kind were sent, in the order of [`Kind::ALL`].
    pub(super) const fn sent(&self) -> [u64; Kind::ALL.len()] {
        self.sent
    }

    /// Number of copies, their answers, and words about who gives tasks out.
    pub(super) const fn copied(&self) -> u64 {
        self.copied
    }

    pub(super) const fn lost(&self) -> u64 {
        self.lost
    }
}
