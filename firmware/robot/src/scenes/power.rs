//! Power that fails while the state is stored: the board restarts with the last whole record or
//! from the start.
//!
//! The flash is a model: writing clears bits, erasing sets them, and the power may go in the middle
//! of either, which leaves any of the bits that were to change. A record that was whole may be
//! damaged later as well.

use crate::control::PERIOD_MS;
use crate::dice::Dice;
use crate::robots::delivery::{Control, STORED_BYTES, TABLES};
use crate::store::{LONGEST, Store};
use crate::surroundings::Noise;
use crate::trace::{Sink, Trace};
use cotama_core::units::Millis;
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};

/// So often the power fails.
pub const CUTS: u32 = 500;
/// A page of the model, in bytes.
pub const PAGE: usize = 256;

/// Two pages of flash, and the power that is left for them.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct FlashModel {
    bytes: [u8; 2 * PAGE],
    /// So many words can still be written or erased.
    power: u32,
    dice: Dice,
}

/// The power is gone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PowerCut;

impl NorFlashError for PowerCut {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

impl ErrorType for FlashModel {
    type Error = PowerCut;
}

impl ReadNorFlash for FlashModel {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), PowerCut> {
        let start = offset as usize;
        let from = self.bytes.get(start..start + bytes.len()).ok_or(PowerCut)?;
        bytes.copy_from_slice(from);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl NorFlash for FlashModel {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = PAGE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), PowerCut> {
        for at in from as usize..to as usize {
            // A page is erased at once: a cut leaves any of its bits.
            let whole = at % 4 != 0 || self.spend();
            let mask = if whole { 0xFF } else { self.dice.bits() as u8 };
            self.bytes[at] |= mask;
            if !whole {
                for it in &mut self.bytes[at..to as usize] {
                    *it |= self.dice.bits() as u8;
                }
                return Err(PowerCut);
            }
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), PowerCut> {
        for (at, word) in (offset as usize..).step_by(4).zip(bytes.chunks_exact(4)) {
            let whole = self.spend();
            for (it, &byte) in self.bytes[at..at + 4].iter_mut().zip(word) {
                *it &= if whole { byte } else { byte | self.dice.bits() as u8 };
            }
            if !whole {
                return Err(PowerCut);
            }
        }
        Ok(())
    }
}

impl FlashModel {
    /// As it comes from the factory.
    pub const fn erased(seed: u64) -> Self {
        Self { bytes: [0xFF; 2 * PAGE], power: u32::MAX, dice: Dice::new(seed) }
    }

    /// Power for so many more words.
    pub const fn powered(&mut self, words: u32) {
        self.power = words;
    }

    /// Damages a bit.
    pub const fn flip(&mut self, bit: usize) {
        self.bytes[bit / 8 % (2 * PAGE)] ^= 1 << (bit % 8);
    }

    const fn spend(&mut self) -> bool {
        let had = self.power > 0;
        self.power = self.power.saturating_sub(1);
        had
    }
}

/// A number, zero for no record, and content.
type Record = (u32, [u8; STORED_BYTES]);
const NO_RECORD: Record = (0, [0; STORED_BYTES]);

/// State that survives between two boots: the flash, and the test's notes on it.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct Power {
    flash: FlashModel,
    dice: Dice,
    /// How often the board has booted.
    pub boots: u32,
    /// Number and content of the record under way when the power failed.
    torn: Record,
    /// The last two records that were written whole, the newest first.
    whole: [Record; 2],
    /// Restored from a whole record, started anew; wrong: restored from anything else, or started
    /// anew although a whole record was there.
    pub counts: [u32; 3],
    damaged: bool,
}

impl Power {
    /// Before the first boot.
    pub const NEW: Self = Self {
        flash: FlashModel::erased(17),
        dice: Dice::new(12),
        boots: 0,
        torn: NO_RECORD,
        whole: [NO_RECORD; 2],
        counts: [0; 3],
        damaged: false,
    };

    /// Boots, goes on, stores after each period until the power fails; false when the power has
    /// failed often enough.
    pub fn boot(&mut self, trace: &mut Trace<'_, impl Sink>) -> bool {
        let mut content = [0; LONGEST];
        let (mut store, length) = Store::open(self.flash.clone(), &mut content);
        let number = store.number().unwrap_or(0);
        let mut control = Control::default();
        let restored = length
            .is_some_and(|it| content.get(..it).is_some_and(|it| control.restore(it, Millis(0))));
        let is = |it: &Record| {
            it.0 == number && number != 0 && content.get(..STORED_BYTES) == Some(&it.1[..])
        };
        let [last, before] = &self.whole;
        let what = match restored {
            // The last word may have been written just before the power failed.
            true if is(last) || is(&self.torn) || self.damaged && is(before) => 0,
            false if length.is_none() && (last.0 == 0 || self.damaged) => 1,
            _ => 2,
        };
        // From here on that is the last one.
        self.whole = match length {
            Some(_) if is(&self.torn) => [self.torn, *last],
            Some(_) if is(last) => self.whole,
            Some(_) => [*before, NO_RECORD],
            None => [NO_RECORD; 2],
        };
        self.counts[what] += 1;
        trace.restored(what as u8, number);
        self.boots += 1;
        if self.boots >= CUTS {
            return false;
        }

        let mut noise = Noise::new(u64::from(self.boots), TABLES);
        let words = self.dice.roll(600);
        self.damaged = false;
        let mut flash = store.close();
        flash.powered(words);
        (store, _) = Store::open(flash, &mut content);
        for now in (0..).map(|it| Millis(it * PERIOD_MS)) {
            let _ = control.period(now, &noise.period(), trace);
            let mut bytes = [0; STORED_BYTES];
            let _ = control.store(&mut bytes); // the room is its length
            let next = store.number().unwrap_or(0).wrapping_add(1);
            self.torn = (next, bytes);
            if store.write(&bytes).is_err() {
                break;
            }
            self.whole = [self.torn, self.whole[0]];
        }
        self.flash = store.close();
        if self.dice.once_in(10) {
            self.damaged = true;
            self.flash.flip(self.dice.roll(2 * 8 * PAGE as u32) as usize);
        }
        true
    }
}

pub(super) fn play(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let mut power = Power::NEW;
    while power.boot(trace) {}
    [power.counts[0], power.counts[1]]
}
