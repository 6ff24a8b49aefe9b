//! Bytes that came, from the interrupt of the UART to the control loop.

use crate::{UART_INTERRUPT, take_byte};
use core::cell::RefCell;
use cortex_m::interrupt::{InterruptNumber, Mutex, free};
use cortex_m::peripheral::NVIC;
use cortex_m_rt::exception;

/// So many bytes may wait; then the UART is left alone. What it drops is missed by the numbers of
/// frames.
const ROOM: usize = 256;

struct Waiting {
    bytes: [u8; ROOM],
    first: usize,
    count: usize,
}

static WAITING: Mutex<RefCell<Waiting>> =
    Mutex::new(RefCell::new(Waiting { bytes: [0; ROOM], first: 0, count: 0 }));

#[derive(Clone, Copy)]
struct OfUart;

// SAFETY: the number is that of the board's UART.
unsafe impl InterruptNumber for OfUart {
    fn number(self) -> u16 {
        UART_INTERRUPT
    }
}

/// From now on bytes are taken as they come.
pub(crate) fn listen() {
    // SAFETY: the handler below is ready, and nobody relies on this interrupt being masked.
    unsafe { NVIC::unmask(OfUart) };
}

/// The byte that came first of those that wait.
pub(crate) fn received() -> Option<u8> {
    free(|token| {
        let mut waiting = WAITING.borrow(token).borrow_mut();
        waiting.count = waiting.count.checked_sub(1)?;
        let byte = waiting.bytes.get(waiting.first).copied();
        waiting.first = (waiting.first + 1) % ROOM;
        listen();
        byte
    })
}

// SAFETY: it is called for interrupts that are unmasked: that of the UART alone.
#[exception]
unsafe fn DefaultHandler(number: i16) {
    if number != UART_INTERRUPT.cast_signed() {
        crate::exit(104);
    }
    free(|token| {
        let mut waiting = WAITING.borrow(token).borrow_mut();
        while waiting.count < ROOM {
            let Some(byte) = take_byte() else { return };
            let end = (waiting.first + waiting.count) % ROOM;
            if let Some(free) = waiting.bytes.get_mut(end) {
                *free = byte;
            }
            waiting.count += 1;
        }
        NVIC::mask(OfUart); // until there is room
    });
}
