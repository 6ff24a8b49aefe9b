//! Random numbers that are the same on every machine.

/// `SplitMix64` (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA
/// 2014).
#[derive(Clone, Copy, Debug)]
pub struct Dice(u64);

impl Dice {
    /// A sequence of its own for each seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut it = self.0;
        it = (it ^ it >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        it = (it ^ it >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        it ^ it >> 31
    }

    /// One of 0 to `sides` - 1; 0 when there are no sides.
    pub const fn roll(&mut self, sides: u32) -> u32 {
        // The high half of a product of 32 by 32 bits: below `sides`.
        ((self.bits() >> 32).wrapping_mul(sides as u64) >> 32) as u32
    }

    /// Whether a die of so many sides shows its first.
    pub const fn once_in(&mut self, sides: u32) -> bool {
        self.roll(sides) == 0
    }
}
