//! Stored bytes: every damaged bit is refused, and a flash of any unit finds what it stored.

use cotama_core::units::Millis;
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};
use robot::robots::delivery::{Control, STORED_BYTES, TABLES};
use robot::store::{LONGEST, Store};
use robot::surroundings::Noise;
use robot::trace::Trace;
use std::collections::BTreeSet;

/// The control of a robot after so many periods of noise.
fn lived(seed: u64, periods: u64) -> Control {
    let (mut control, mut noise) = (Control::default(), Noise::new(seed, TABLES));
    for now in (0..periods).map(|it| Millis(it * 100)) {
        let _ = control.period(now, &noise.period(), &mut Trace::new(&mut ()));
    }
    control
}

/// The bytes of a stored state.
fn state(control: &Control) -> [u8; STORED_BYTES] {
    let mut bytes = [0; STORED_BYTES];
    assert!(control.store(&mut bytes).is_some());
    bytes
}

#[test]
fn a_state_with_any_bit_flipped_is_refused_and_nothing_changes() {
    let mut states = BTreeSet::new();
    for (seed, periods) in [(0, 0), (1, 40), (2, 80), (3, 120), (4, 200), (5, 500)] {
        let bytes = state(&lived(seed, periods));
        states.insert(bytes);
        let mut other = Control::default();
        assert!(other.restore(&bytes, Millis(0)));
        assert_eq!(state(&other), bytes);
        // In the memory of one that has seen much, nothing of that is left.
        let mut used = lived(seed, periods);
        assert!(used.restore(&bytes, Millis(0)));
        assert_eq!(format!("{used:?}"), format!("{other:?}"));
        for bit in 0..8 * STORED_BYTES {
            let mut damaged = bytes;
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(!used.restore(&damaged, Millis(0)), "{periods} periods of {seed}, bit {bit}");
            assert_eq!(state(&used), bytes);
        }
        for length in (0..STORED_BYTES).chain([STORED_BYTES + 1]) {
            let mut longer = bytes.to_vec();
            longer.resize(length, 0);
            assert!(!used.restore(&longer, Millis(0)), "{length}");
        }
    }
    assert_eq!(states.len(), 6, "each is another state");
}

/// Flash that reads and writes so many bytes at once, and refuses any others.
struct Flash<const UNIT: usize>(Vec<u8>);

impl<const UNIT: usize> ErrorType for Flash<UNIT> {
    type Error = NorFlashErrorKind;
}

fn fits(unit: usize, offset: u32, length: usize) -> Result<(), NorFlashErrorKind> {
    let whole = (offset as usize).is_multiple_of(unit) && length.is_multiple_of(unit);
    whole.then_some(()).ok_or(NorFlashErrorKind::NotAligned)
}

impl<const UNIT: usize> ReadNorFlash for Flash<UNIT> {
    const READ_SIZE: usize = UNIT;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        fits(UNIT, offset, bytes.len())?;
        let from = self.0.get(offset as usize..).ok_or(NorFlashErrorKind::OutOfBounds)?;
        bytes.copy_from_slice(from.get(..bytes.len()).ok_or(NorFlashErrorKind::OutOfBounds)?);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.0.len()
    }
}

impl<const UNIT: usize> NorFlash for Flash<UNIT> {
    const WRITE_SIZE: usize = UNIT;
    const ERASE_SIZE: usize = 256 * UNIT;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        fits(Self::ERASE_SIZE, from, (to - from) as usize)?;
        self.0[from as usize..to as usize].fill(0xFF);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        fits(UNIT, offset, bytes.len())?;
        self.0[offset as usize..][..bytes.len()].copy_from_slice(bytes);
        Ok(())
    }
}

/// Stores every length, and finds it again; how many.
fn stored<const UNIT: usize>() -> usize {
    let content: Vec<u8> = (0..LONGEST as u8).map(|it| it.wrapping_mul(31)).collect();
    let mut flash = Flash::<UNIT>(vec![0xFF; 2 * 256 * UNIT]);
    for length in 0..=LONGEST {
        let mut found = [0; LONGEST];
        let (mut store, _) = Store::open(flash, &mut found);
        store.write(&content[..length]).unwrap();
        let (again, it) = Store::open(store.close(), &mut found);
        assert_eq!(it, Some(length), "unit {UNIT}");
        assert_eq!(found[..length], content[..length]);
        flash = again.close();
    }
    LONGEST + 1
}

#[test]
fn a_stored_state_is_found_with_every_unit_of_a_flash_and_every_length() {
    macro_rules! all {
        ($($unit:literal)*) => { [$(stored::<$unit>()),*] };
    }
    let found = all!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    assert_eq!(found.iter().sum::<usize>(), 16 * 241);
}
