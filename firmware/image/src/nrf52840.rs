//! Nordic's nRF52840 development kit (PCA10056). Registers are those of the product specification,
//! version 1.7; section numbers are its. Built, not run: there is no such board in the tests.

use crate::register::Register;
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};

/// The clock of the core.
pub const CLOCK_HZ: u32 = 64_000_000;

/// Starts the crystal, for the rate of the UART (section 5.4).
pub fn set_up() {
    // SAFETY: the clock control has these registers, and nothing else here uses it.
    let register = |offset| unsafe { Register::new(0x4000_0000, offset) };
    register(0x000).write(1); // TASKS_HFCLKSTART
    while register(0x100).read() == 0 {} // EVENTS_HFCLKSTARTED
}

/// Nothing can be told any more: starts again.
pub fn exit(_: i32) -> ! {
    cortex_m::peripheral::SCB::sys_reset()
}

/// Pins of the kit's USB serial port: P0.06 sends, P0.08 receives.
pub(crate) const UART_PINS: (u32, u32) = (6, 8);

/// The hardware watchdog (section 6.36).
#[derive(Debug)]
pub struct Watchdog {
    feed: Register,
}

impl Watchdog {
    /// Starts it: without being fed for so long it resets the board.
    pub fn start(ms: u64) -> Self {
        // SAFETY: the watchdog has these registers, and nothing else here uses it.
        let register = |offset| unsafe { Register::new(0x4001_0000, offset) };
        let ticks = ms * 32_768 / 1_000;
        register(0x504).write(u32::try_from(ticks).unwrap_or(u32::MAX)); // CRV
        register(0x508).write(1); // RREN: channel 0
        register(0x000).write(1); // TASKS_START
        Self { feed: register(0x600) } // RR[0]
    }

    /// So far all is well.
    pub fn feed(&mut self) {
        self.feed.write(0x6E52_4635);
    }
}

const PAGE: usize = 4_096;
/// The last two pages, which `memory/nrf52840.x` leaves free.
const START: usize = 0x000F_E000;

/// Two pages of the flash, through its controller (section 4.3).
#[derive(Debug)]
pub struct Flash {
    ready: Register,
    mode: Register,
    erase: Register,
}

/// Beyond the end.
#[derive(Clone, Copy, Debug)]
pub struct Beyond;

impl NorFlashError for Beyond {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::OutOfBounds
    }
}

impl Flash {
    /// The flash of the board; to be called once.
    pub fn take() -> Self {
        // SAFETY: the controller has these registers, and nothing else here uses it.
        let register = |offset| unsafe { Register::new(0x4001_E000, offset) };
        Self { ready: register(0x400), mode: register(0x504), erase: register(0x508) }
    }

    fn wait(&self) {
        while self.ready.read() == 0 {}
    }

    /// The words from an offset on.
    fn words(from: u32, count: usize) -> Result<usize, Beyond> {
        let start = from as usize;
        if start % 4 == 0 && start + count <= 2 * PAGE { Ok(START + start) } else { Err(Beyond) }
    }
}

impl ErrorType for Flash {
    type Error = Beyond;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Beyond> {
        let start = START + offset as usize;
        if offset as usize + bytes.len() > 2 * PAGE {
            return Err(Beyond);
        }
        for (it, at) in bytes.iter_mut().zip(start..) {
            // SAFETY: within the two pages of flash, which is memory that can be read.
            *it = unsafe { (at as *const u8).read_volatile() };
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        2 * PAGE
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = PAGE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Beyond> {
        let start = Self::words(from, (to - from) as usize)?;
        self.mode.write(2); // CONFIG.WEN: erase
        for page in (start..start + (to - from) as usize).step_by(PAGE) {
            self.erase.write(page as u32);
            self.wait();
        }
        self.mode.write(0);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Beyond> {
        let start = Self::words(offset, bytes.len())?;
        self.mode.write(1); // CONFIG.WEN: write
        for (word, at) in bytes.as_chunks::<4>().0.iter().zip((start..).step_by(4)) {
            // SAFETY: a word of the two pages, which no code or constant of the program is in.
            unsafe { (at as *mut u32).write_volatile(u32::from_le_bytes(*word)) };
            self.wait();
        }
        self.mode.write(0);
        Ok(())
    }
}
