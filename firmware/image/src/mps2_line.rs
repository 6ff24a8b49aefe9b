//! The interrupt of the UART of the MPS2: of a byte that came.

use crate::register::Register;

/// The UART.
pub(crate) const UART: usize = 0x4000_4000;

/// The interrupt of a byte that came.
pub(crate) const UART_INTERRUPT: u16 = 0;

/// The byte that the UART holds, for its interrupt.
pub(crate) fn take_byte() -> Option<u8> {
    // SAFETY: the UART has these registers, and nothing else here reads this data or writes this
    // bit.
    let register = |offset| unsafe { Register::new(UART, offset) };
    register(0x0C).write(0b10); // the interrupt is answered
    (register(0x04).read() & 2 != 0).then(|| register(0x00).read() as u8)
}
