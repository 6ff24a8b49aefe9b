//! The position of a place's tokens in a marking.

/// The largest bound of a field; a place without a bound gets it.
pub const LARGEST: u32 = 65_535;

/// The position of a place in a marking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The word.
    pub word: u16,
    /// The lowest bit.
    pub shift: u8,
    /// Bits for tokens; the guard bit is above them.
    pub width: u8,
}

impl Field {
    /// A field that stands for no place yet.
    pub(super) const NOWHERE: Self = Self { word: 0, shift: 0, width: 1 };

    /// This many tokens in the word of the field.
    pub const fn tokens(self, tokens: u32) -> u64 {
        debug_assert!(self.shift < 64 && tokens as u64 <= self.mask() + 1, "tokens fit the field");
        // A shift is below 64, but the compiler does not know that of a field that is looked up.
        (tokens as u64).wrapping_shl(self.shift as u32)
    }

    /// Returns the tokens in a marking; 0 when the field lies beyond the marking.
    ///
    /// ```
    /// # use cotama_core::player::Field;
    /// let two_bits = |word| Field { word, shift: 4, width: 2 };
    /// assert_eq!(two_bits(0).of(&[0x7F, 0]), 3);
    /// assert_eq!(two_bits(1).of(&[0x7F, 0]), 0);
    /// assert_eq!(two_bits(2).of(&[0x7F, 0]), 0);
    /// ```
    #[inline]
    pub const fn of<const W: usize>(self, marking: &[u64; W]) -> u32 {
        if (self.word as usize) < W {
            (marking[self.word as usize].wrapping_shr(self.shift as u32) & self.mask()) as u32
        } else {
            0
        }
    }

    /// All tokens that it can hold, at the lowest bits.
    pub(super) const fn mask(self) -> u64 {
        debug_assert!(self.shift as u32 + (self.width as u32) < u64::BITS, "a field and its guard");
        1_u64.wrapping_shl(self.width as u32).wrapping_sub(1)
    }
}

/// The bound that a field has for a place of this bound.
pub(super) const fn clamped(bound: u32) -> u32 {
    match bound {
        0 => 1,
        1..=LARGEST => bound,
        _ => LARGEST,
    }
}
