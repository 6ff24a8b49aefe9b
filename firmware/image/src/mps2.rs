//! Arm's MPS2 with AN385 or AN386 (application notes of these names), as QEMU emulates it. Its
//! flash is RAM that keeps its content while the board resets.

use crate::mps2_line::UART;
use crate::received::{listen, received};
use crate::register::Register;
use core::mem::MaybeUninit;
use core::ptr::addr_of_mut;
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};

/// The clock of the core.
pub const CLOCK_HZ: u32 = 25_000_000;

const WATCHDOG: usize = 0x4000_8000;

/// Nothing to do: clock and pins are set.
pub fn set_up() {}

/// Ends the emulator with this status.
pub fn exit(status: i32) -> ! {
    semihosting::process::exit(status)
}

/// UART 0 (CMSDK APB UART).
#[derive(Debug)]
pub struct Uart {
    data: Register,
    state: Register,
}

impl Uart {
    /// Switches it on.
    pub fn start() -> Self {
        // SAFETY: the UART has these registers, and nothing else here uses it.
        let register = |offset| unsafe { Register::new(UART, offset) };
        register(0x10).write(16); // the fastest
        register(0x08).write(0b1011); // send, receive, and interrupt when a byte came
        listen();
        Self { data: register(0x00), state: register(0x04) }
    }

    /// Sends a byte, once the one before is gone.
    pub fn put(&mut self, byte: u8) {
        while self.state.read() & 1 != 0 {}
        self.data.write(byte.into());
    }

    /// The byte that came first of those that wait, if any.
    pub fn get(&mut self) -> Option<u8> {
        received()
    }
}

/// The hardware watchdog (CMSDK APB watchdog).
#[derive(Debug)]
pub struct Watchdog {
    feed: Register,
}

impl Watchdog {
    /// Starts it: without being fed for so long it resets the board.
    pub fn start(ms: u64) -> Self {
        // SAFETY: the watchdog has these registers, and nothing else here uses it.
        let register = |offset| unsafe { Register::new(WATCHDOG, offset) };
        register(0xC00).write(0x1ACC_E551); // unlock
        // The watchdog counts twice: at the end of the first time it interrupts, of the second it
        // resets.
        let half = ms * u64::from(CLOCK_HZ) / 2_000;
        register(0x00).write(u32::try_from(half).unwrap_or(u32::MAX));
        register(0x08).write(0b11);
        Self { feed: register(0x0C) }
    }

    /// So far all is well.
    pub fn feed(&mut self) {
        self.feed.write(1);
    }
}

const PAGE: usize = 256;

#[unsafe(link_section = ".uninit.FLASH")]
static mut FLASH: MaybeUninit<[u8; 2 * PAGE]> = MaybeUninit::uninit();

/// Two pages.
#[derive(Debug)]
pub struct Flash(&'static mut [u8; 2 * PAGE]);

impl Flash {
    /// The flash of the board; to be called once.
    pub fn take() -> Self {
        // SAFETY: the only reference to it, and bytes of RAM are initialised by being there:
        // any content is one.
        Self(unsafe { &mut *addr_of_mut!(FLASH).cast() })
    }
}

/// Beyond the end.
#[derive(Clone, Copy, Debug)]
pub struct Beyond;

impl NorFlashError for Beyond {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::OutOfBounds
    }
}

impl ErrorType for Flash {
    type Error = Beyond;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Beyond> {
        let start = offset as usize;
        bytes.copy_from_slice(self.0.get(start..start + bytes.len()).ok_or(Beyond)?);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.0.len()
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = PAGE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Beyond> {
        self.0.get_mut(from as usize..to as usize).ok_or(Beyond)?.fill(0xFF);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Beyond> {
        let start = offset as usize;
        let room = self.0.get_mut(start..start + bytes.len()).ok_or(Beyond)?;
        for (it, &byte) in room.iter_mut().zip(bytes) {
            *it &= byte;
        }
        Ok(())
    }
}
