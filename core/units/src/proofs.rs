//! Small numbers for proof harnesses. Harnesses stand beside the code that they are about, in
//! modules called `proofs`; `docs/proofs.md` lists them all.

/// Any number of so many bits, eight at most. Kani and the engines here try each of them; of a `u8`
/// with an assumption they would try all 256.
#[must_use]
pub fn few<const BITS: usize>() -> u8 {
    let bits: [bool; BITS] = kani::any();
    bits.iter().fold(0, |number, &bit| 2 * number + u8::from(bit))
}
