//! The generator of the tests. Crates that depend on no other include this file by its path.

/// Returns the next 64 bits of `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014), the same on every
/// machine.
pub const fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let it = (*state ^ (*state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let it = (it ^ (it >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    it ^ (it >> 31)
}
