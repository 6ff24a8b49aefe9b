//! Frames over a UART: nothing is accepted that the checksum does not cover, nothing is lost
//! without being counted.
//!
//! A frame is its number (`u16`), its content (at most [`LONGEST`] bytes) and the CRC-32 of both,
//! little endian, between two [`END`] bytes as in SLIP (RFC 1055), where a byte that means
//! something else is escaped. A receiver accepts a frame whose checksum is right, and tells from
//! the numbers how many are missing before it. Of damaged frames the checksum lets one in 2^32
//! pass.

use cotama_core::checksum::crc32;

/// Ends a frame.
pub const END: u8 = 0xC0;
const ESCAPE: u8 = 0xDB;
const ESCAPED_END: u8 = 0xDC;
const ESCAPED_ESCAPE: u8 = 0xDD;

/// The most bytes of content.
pub const LONGEST: usize = 32;
/// Number, content and checksum.
const WHOLE: usize = 2 + LONGEST + 4;
/// The most bytes of a frame as it is sent.
pub const SENT: usize = 2 * WHOLE + 2;

/// Numbers and sends frames.
#[derive(Clone, Debug, Default)]
pub struct Sender {
    number: u16,
}

impl Sender {
    /// Sends a frame, byte by byte; false, and nothing is sent, when it is too long.
    pub fn send(&mut self, content: &[u8], mut put: impl FnMut(u8)) -> bool {
        let mut whole = [0; WHOLE];
        let length = content.len();
        let Some(room) = whole.get_mut(2..2 + length).filter(|_| length <= LONGEST) else {
            return false;
        };
        room.copy_from_slice(content);
        whole[..2].copy_from_slice(&self.number.to_le_bytes());
        self.number = self.number.wrapping_add(1);
        let checksum = crc32(&whole[..2 + length]);
        whole[2 + length..6 + length].copy_from_slice(&checksum.to_le_bytes());
        put(END); // ends what noise has begun
        for &byte in &whole[..6 + length] {
            match byte {
                END => [ESCAPE, ESCAPED_END].map(&mut put),
                ESCAPE => [ESCAPE, ESCAPED_ESCAPE].map(&mut put),
                it => [put(it); 2],
            };
        }
        put(END);
        true
    }
}

/// The result of a received byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Received<'r> {
    /// A frame.
    Frame {
        /// Number of the frame.
        number: u16,
        /// So many frames before it did not come, or came damaged.
        missing: u16,
        /// Content of the frame.
        content: &'r [u8],
    },
    /// Bytes that are no frame: too long or too short, a wrong escape, a wrong checksum.
    Refused,
}

/// Puts frames together again.
#[derive(Clone, Debug)]
pub struct Receiver {
    bytes: [u8; WHOLE],
    length: usize,
    escaped: bool,
    /// Whether the bytes since the last end are no frame.
    spoilt: bool,
    /// The number of the next frame.
    next: u16,
}

impl Default for Receiver {
    fn default() -> Self {
        Self { bytes: [0; WHOLE], length: 0, escaped: false, spoilt: false, next: 0 }
    }
}

impl Receiver {
    /// Takes a byte; says so when it ends a frame, or what should be one.
    pub fn take(&mut self, byte: u8) -> Option<Received<'_>> {
        if byte == END {
            return self.end();
        }
        let byte = match (self.escaped, byte) {
            (false, ESCAPE) => {
                self.escaped = true;
                return None;
            }
            (false, it) => it,
            (true, ESCAPED_END) => END,
            (true, ESCAPED_ESCAPE) => ESCAPE,
            (true, _) => {
                self.spoilt = true;
                return None;
            }
        };
        self.escaped = false;
        match self.bytes.get_mut(self.length) {
            Some(free) => (*free, self.length) = (byte, self.length + 1),
            None => self.spoilt = true,
        }
        None
    }

    fn end(&mut self) -> Option<Received<'_>> {
        let (length, spoilt) = (self.length, self.spoilt || self.escaped);
        (self.length, self.spoilt, self.escaped) = (0, false, false);
        if length == 0 && !spoilt {
            return None; // between two frames
        }
        let whole = self.bytes.get(..length).filter(|_| !spoilt);
        let checked = whole
            .and_then(|it| it.split_last_chunk::<4>())
            .filter(|(content, sum)| crc32(content) == u32::from_le_bytes(**sum));
        let Some((number, content)) = checked.and_then(|it| it.0.split_first_chunk::<2>()) else {
            return Some(Received::Refused);
        };
        let number = u16::from_le_bytes(*number);
        let missing = number.wrapping_sub(self.next);
        self.next = number.wrapping_add(1);
        Some(Received::Frame { number, missing, content })
    }
}
