//! Writing values as CDR (OMG, DDS-RTPS 2.5, Section 10.2: `CDR_LE`): little-endian, each value at
//! a multiple of its size after the four bytes of the header.

/// A message while it is written.
#[derive(Debug)]
pub(crate) struct Cdr {
    bytes: Vec<u8>,
}

const HEADER: [u8; 4] = [0, 1, 0, 0];

impl Cdr {
    pub(crate) fn new() -> Self {
        Self { bytes: HEADER.to_vec() }
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    fn put<const N: usize>(&mut self, value: [u8; N]) {
        let end = (self.bytes.len() - HEADER.len()).next_multiple_of(N) + HEADER.len();
        self.bytes.resize(end, 0);
        self.bytes.extend(value);
    }

    pub(crate) fn u8(&mut self, it: u8) {
        self.put([it]);
    }

    pub(crate) fn u32(&mut self, it: u32) {
        self.put(it.to_le_bytes());
    }

    pub(crate) fn i32(&mut self, it: i32) {
        self.put(it.to_le_bytes());
    }

    /// Writes a single float. What is no number has the same bits everywhere.
    pub(crate) fn f32(&mut self, it: f64) {
        const NAN: u32 = 0x7fc0_0000;
        let bits = if it.is_nan() { NAN } else { (it as f32).to_bits() };
        self.put(bits.to_le_bytes());
    }

    pub(crate) fn f64(&mut self, it: f64) {
        self.put(it.to_le_bytes());
    }

    pub(crate) fn f64s<const N: usize>(&mut self, all: [f64; N]) {
        all.into_iter().for_each(|it| self.f64(it));
    }

    /// Writes the length of a sequence; its items follow.
    pub(crate) fn count(&mut self, it: usize) {
        debug_assert!(u32::try_from(it).is_ok(), "a sequence is shorter than a file may be");
        self.u32(u32::try_from(it).unwrap_or(u32::MAX));
    }

    pub(crate) fn bytes(&mut self, all: &[u8]) {
        self.count(all.len());
        self.bytes.extend(all);
    }

    /// Writes a text, which ends with a zero: another one in it would end it early, and is left
    /// out.
    pub(crate) fn text(&mut self, it: &str) {
        let bytes: Vec<u8> = it.bytes().filter(|it| *it != 0).chain([0]).collect();
        self.bytes(&bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_at_multiples_of_their_size() {
        let mut cdr = Cdr::new();
        cdr.u8(7);
        cdr.f64(1.0);
        cdr.text("a\0b");
        cdr.u32(9);
        let expected: Vec<u8> = [
            &[0, 1, 0, 0][..],
            &[7, 0, 0, 0, 0, 0, 0, 0],
            &[0, 0, 0, 0, 0, 0, 0xf0, 0x3f],
            &[3, 0, 0, 0, b'a', b'b', 0, 0],
            &[9, 0, 0, 0],
        ]
        .concat();
        assert_eq!(cdr.into_bytes(), expected);
    }
}
