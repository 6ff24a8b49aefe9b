//! The trace of a run: records of bytes, the same on every machine.
//!
//! A record is a byte for its kind and fields of fixed width, little endian:
//!
//! | kind | fields |
//! | --- | --- |
//! | `S` scene | number `u8` |
//! | `F` fired | time ms `u32`, net `u16`, transition `u16`, cause `u16` |
//! | `T` told | time ms `u32`, net `u16`, event `u16` |
//! | `D` diagnosed | time ms `u32`, flags `u64`, how many failures `u8`, a failure `u8` each |
//! | `R` requests | time ms `u32`, the bytes of [`message`](crate::message) |
//! | `P` plan | first activity `u8`, an alternative `u8` each; ms, mJ and quality `u64` each |
//! | `N` no plan | first activity `u8` |
//! | `H` happening | time us `u64`, task `u8`, what `u8` |
//! | `O` outcome | net `u8`, what `u8`, state `u8` |
//! | `B` restored | what `u8`, number `u32` |
//! | `L` frame | what `u8`, number `u32` |
//!
use cotama_core::net::{EventId, TransitionId};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// A destination of bytes: a UART, a file.
pub trait Sink {
    /// Nobody reads it: no record is made.
    const IGNORES: bool = false;

    /// Takes these bytes, in order.
    fn put(&mut self, bytes: &[u8]);
}

/// A sink without reader: a robot at work.
#[derive(Clone, Copy, Debug)]
pub struct Nowhere;

impl Sink for Nowhere {
    const IGNORES: bool = true;

    fn put(&mut self, _: &[u8]) {}
}

/// Forgets the bytes; their digest is made.
impl Sink for () {
    fn put(&mut self, _: &[u8]) {}
}

/// Sends records to a sink, and keeps their digest.
#[derive(Debug)]
pub struct Trace<'s, S> {
    sink: &'s mut S,
    /// FNV-1a, 64 bits (Fowler, Noll and Vo).
    digest: u64,
    bytes: u64,
}

impl<'s, S: Sink> Trace<'s, S> {
    /// Nothing recorded yet.
    pub fn new(sink: &'s mut S) -> Self {
        Self { sink, digest: 0xcbf2_9ce4_8422_2325, bytes: 0 }
    }

    /// The digest of all bytes so far, and how many they are.
    pub const fn digest(&self) -> (u64, u64) {
        (self.digest, self.bytes)
    }

    fn put(&mut self, bytes: &[u8]) -> &mut Self {
        if S::IGNORES {
            return self;
        }
        for &byte in bytes {
            self.digest = (self.digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        self.bytes += bytes.len() as u64;
        self.sink.put(bytes);
        self
    }

    /// Bytes of another trace.
    pub(crate) fn raw(&mut self, bytes: &[u8]) {
        self.put(bytes);
    }

    fn at(&mut self, kind: u8, at: Millis) -> &mut Self {
        self.put(&[kind]).put(&(at.0 as u32).to_le_bytes())
    }

    /// A scene begins.
    pub fn scene(&mut self, number: u8) {
        self.put(&[b'S', number]);
    }

    /// A transition fired, because of this.
    pub fn fired(&mut self, at: Millis, transition: Of<TransitionId>, cause: u16) {
        self.at(b'F', at)
            .put(&transition.component.to_le_bytes())
            .put(&(transition.id.0 as u16).to_le_bytes())
            .put(&cause.to_le_bytes());
    }

    /// An event was told to the supervisors.
    pub fn told(&mut self, at: Millis, event: Of<EventId>) {
        self.at(b'T', at)
            .put(&event.component.to_le_bytes())
            .put(&(event.id.0 as u16).to_le_bytes());
    }

    /// Flags were diagnosed: these failures, so many, it may be.
    pub fn diagnosed(
        &mut self,
        at: Millis,
        flags: u64,
        count: u32,
        failures: impl Iterator<Item = usize>,
    ) {
        self.at(b'D', at).put(&flags.to_le_bytes()).put(&[count as u8]);
        for it in failures {
            self.put(&[it as u8]);
        }
    }

    /// Records that the requests have changed.
    pub fn requests(&mut self, at: Millis, requests: &[u8]) {
        self.at(b'R', at).put(requests);
    }

    /// A plan from this activity on.
    pub fn plan(&mut self, first: usize, plan: &[u16], cost: [u64; 2], quality: u64) {
        self.put(&[b'P', first as u8]);
        for &alternative in plan {
            self.put(&[alternative as u8]);
        }
        self.put(&cost[0].to_le_bytes()).put(&cost[1].to_le_bytes()).put(&quality.to_le_bytes());
    }

    /// No plan from this activity on.
    pub fn no_plan(&mut self, first: usize) {
        self.put(&[b'N', first as u8]);
    }

    /// Something happened to a task.
    pub fn happening(&mut self, at_us: u64, task: usize, what: u8) {
        self.put(b"H").put(&at_us.to_le_bytes()).put(&[task as u8, what]);
    }

    /// Records the outcome of an event in a net of ACE, and its state then.
    pub fn outcome(&mut self, net: u8, what: u8, state: u8) {
        self.put(&[b'O', net, what, state]);
    }

    /// Records the state found in flash.
    pub fn restored(&mut self, what: u8, number: u32) {
        self.put(&[b'B', what]).put(&number.to_le_bytes());
    }

    /// Records the receiver's result of bytes.
    pub fn frame(&mut self, what: u8, number: u32) {
        self.put(&[b'L', what]).put(&number.to_le_bytes());
    }
}
