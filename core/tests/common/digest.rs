//! A sum of what is written, so that a golden file need not hold all of it.

use std::fmt::{self, Write};

/// A sum of bits of a text (FNV-1a, 64 bits: Fowler, Noll, Vo).
pub struct Digest(pub u64);

impl Digest {
    /// Of nothing.
    pub const EMPTY: Self = Self(0xCBF2_9CE4_8422_2325);
}

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
        }
        Ok(())
    }
}
