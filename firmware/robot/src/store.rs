//! The last whole record, in two pages of flash.
//!
//! A record is its length and its number, the CRC-32 of both, the content, and the CRC-32 of all
//! before it. It is written to the page that does not hold the last one, its checksum at the very
//! end, so that at every instant at least one page holds a whole record, or none was ever written.
//! Whichever write or erase the power cut off, reading finds the last whole one: what is torn fails
//! a checksum (but for one in 2^32).

use cotama_core::checksum::crc32;
use embedded_storage::nor_flash::NorFlash;

/// The most bytes of content.
pub const LONGEST: usize = 240;
/// Length, number and their checksum.
const HEAD: usize = 12;
const TAIL: usize = 4;
/// The most bytes that a flash reads or writes at once.
const UNIT: usize = 16;
/// Room for a record, and for what is read or written behind it to fill a unit.
const ROOM: usize = HEAD + LONGEST + TAIL + UNIT;

/// A store in the first two pages of a flash.
#[derive(Debug)]
pub struct Store<F> {
    flash: F,
    /// The page and the number of the last whole record.
    last: Option<(u32, u32)>,
}

/// Why nothing was stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoreError<E> {
    /// The content is longer than [`LONGEST`] or than a page.
    TooLong,
    /// The flash says so.
    Flash(E),
}

/// A number is later than another when it is at most 2^31 ahead of it: numbers may wrap.
const fn later(number: u32, than: u32) -> bool {
    number.wrapping_sub(than) < 1 << 31
}

impl<F: NorFlash> Store<F> {
    const PAGE: u32 = {
        assert!(
            F::READ_SIZE <= UNIT && F::WRITE_SIZE <= UNIT,
            "the flash reads or writes more than 16 bytes at once"
        );
        assert!(
            F::ERASE_SIZE.is_multiple_of(F::READ_SIZE)
                && F::ERASE_SIZE.is_multiple_of(F::WRITE_SIZE),
            "a page of the flash is no whole number of what it reads or writes at once"
        );
        F::ERASE_SIZE as u32
    };

    /// Looks for the last whole record, and copies its content; `None` when there is none.
    #[inline(never)]
    pub fn open(flash: F, content: &mut [u8; LONGEST]) -> (Self, Option<usize>) {
        let mut store = Self { flash, last: None };
        let mut found = None;
        for page in [0, 1] {
            let mut read = [0; LONGEST];
            let Some((number, length)) = store.read(page, &mut read) else { continue };
            if store.last.is_none_or(|(_, last)| later(number, last)) {
                store.last = Some((page, number));
                *content = read;
                found = Some(length);
            }
        }
        (store, found)
    }

    /// The number of the last whole record, from 1 on.
    pub fn number(&self) -> Option<u32> {
        self.last.map(|it| it.1)
    }

    /// Gives the flash back.
    pub fn close(self) -> F {
        self.flash
    }

    /// Stores a record after the last one.
    ///
    /// # Errors
    /// A [`StoreError`]; the last record is still there.
    #[inline(never)]
    pub fn write(&mut self, content: &[u8]) -> Result<(), StoreError<F::Error>> {
        let whole = (HEAD + content.len() + TAIL).next_multiple_of(F::WRITE_SIZE);
        let mut bytes = [0; ROOM];
        if content.len() > LONGEST || whole > F::ERASE_SIZE || whole > bytes.len() {
            return Err(StoreError::TooLong);
        }
        let (page, number) = match self.last {
            Some((page, number)) => (1 - page, number.wrapping_add(1)),
            None => (0, 1),
        };
        bytes[..4].copy_from_slice(&(content.len() as u32).to_le_bytes());
        bytes[4..8].copy_from_slice(&number.to_le_bytes());
        let head = crc32(&bytes[..8]);
        bytes[8..HEAD].copy_from_slice(&head.to_le_bytes());
        let end = HEAD + content.len();
        bytes[HEAD..end].copy_from_slice(content);
        let checksum = crc32(&bytes[..end]);
        bytes[end..end + TAIL].copy_from_slice(&checksum.to_le_bytes());
        let start = page * Self::PAGE;
        self.flash.erase(start, start + Self::PAGE).map_err(StoreError::Flash)?;
        self.flash.write(start, &bytes[..whole]).map_err(StoreError::Flash)?;
        self.last = Some((page, number));
        Ok(())
    }

    /// The record of a page: its number, and the length of its content.
    fn read(&mut self, page: u32, content: &mut [u8; LONGEST]) -> Option<(u32, usize)> {
        let start = page * Self::PAGE;
        let mut bytes = [0; ROOM];
        let whole = |length: usize| length.next_multiple_of(F::READ_SIZE);
        self.flash.read(start, bytes.get_mut(..whole(HEAD))?).ok()?;
        let word = |bytes: &[u8], at: usize| {
            bytes.get(at..)?.first_chunk().map(|it| u32::from_le_bytes(*it))
        };
        if word(&bytes, 8)? != crc32(&bytes[..8]) {
            return None;
        }
        let (length, number) = (word(&bytes, 0)? as usize, word(&bytes, 4)?);
        if length > LONGEST || HEAD + length + TAIL > F::ERASE_SIZE {
            return None;
        }
        let end = HEAD + length;
        self.flash.read(start, bytes.get_mut(..whole(end + TAIL))?).ok()?;
        if word(&bytes, end)? != crc32(&bytes[..end]) {
            return None;
        }
        content[..length].copy_from_slice(&bytes[HEAD..end]);
        Some((number, length))
    }
}
