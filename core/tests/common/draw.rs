//! Numbers for tests, of a seed or steered by bytes. Integers only, so that the same seed or bytes
//! give the same on every machine.

#[allow(unreachable_pub, reason = "the file is public where it is a crate's")]
#[path = "../../../tests/fuzz/split_mix.rs"]
mod split_mix;

#[cfg(not(target_os = "none"))]
use std::sync::Arc;

/// A small deterministic generator (`SplitMix64`: Steele, Lea, Flood, OOPSLA 2014).
#[derive(Clone, Debug)]
pub struct Draw {
    state: u64,
    /// Bytes that are drawn first, and how many of them were; a board draws of seeds alone.
    #[cfg(not(target_os = "none"))]
    bytes: Option<(Arc<[u8]>, usize)>,
}

impl Draw {
    /// A generator for this seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self {
            state: seed,
            #[cfg(not(target_os = "none"))]
            bytes: None,
        }
    }

    /// Numbers of these bytes, each of as few as it needs, so that a change of one byte changes one
    /// number; when they are used up, those of the seed 0.
    #[cfg(not(target_os = "none"))]
    #[must_use]
    #[allow(dead_code)] // only the tests across the crates are steered
    pub fn steered(bytes: &[u8]) -> Self {
        Self { state: 0, bytes: Some((bytes.into(), 0)) }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        if let Some(given) = self.given(u64::MAX) {
            return given;
        }
        split_mix::split_mix(&mut self.state)
    }

    /// A number from `low` to `high`, both included.
    pub fn between(&mut self, low: u64, high: u64) -> u64 {
        let count = u128::from(high - low + 1);
        if let Some(given) = self.given(high - low) {
            return low + (u128::from(given) % count) as u64;
        }
        low + ((u128::from(self.bits()) * count) >> 64) as u64
    }

    /// So many of the bytes as a number up to `most` has, the lowest first; none when too few are
    /// left.
    #[cfg(not(target_os = "none"))]
    fn given(&mut self, most: u64) -> Option<u64> {
        let (bytes, drawn) = self.bytes.as_mut()?;
        let length = most.checked_ilog2().map_or(0, |it| it as usize / 8 + 1);
        let Some(given) = bytes.get(*drawn..*drawn + length) else {
            self.bytes = None;
            return None;
        };
        *drawn += length;
        Some(given.iter().rev().fold(0, |sum, &byte| sum << 8 | u64::from(byte)))
    }

    #[cfg(target_os = "none")]
    const fn given(&mut self, _most: u64) -> Option<u64> {
        None
    }
}
