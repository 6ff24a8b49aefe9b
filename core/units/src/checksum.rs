//! Whether bytes that were stored or sent are still those that were written.

/// CRC-32 as Ethernet and ZIP have it (ISO 3309): polynomial 0xEDB88320, reflected.
///
/// Bytes that differ in one burst of at most 32 bits never have the same; others do once in 2^32.
///
/// ```
/// use cotama_core::checksum::crc32;
/// assert_eq!(crc32(b"123456789"), 0xCBF4_3926); // the check value of the standard
/// ```
#[must_use]
pub fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            let carry = 0_u32.wrapping_sub(crc & 1);
            crc = (crc >> 1) ^ (0xEDB8_8320 & carry);
        }
    }
    !crc
}

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn a_checksum_is_that_of_the_standard() {
        assert_eq!(crc32(b""), 0);
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
    }
}
