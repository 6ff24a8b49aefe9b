//! The interrupt of the UART of the nRF51 and nRF52: of a byte that came.

use crate::register::Register;

/// The UART.
pub(crate) const UART: usize = 0x4000_2000;

/// The interrupt of a byte that came.
pub(crate) const UART_INTERRUPT: u16 = 2;

/// The byte that the UART holds, for its interrupt. It keeps six.
pub(crate) fn take_byte() -> Option<u8> {
    // SAFETY: the UART has these registers, and nothing else here uses them.
    let register = |offset| unsafe { Register::new(UART, offset) };
    (register(0x108).read() != 0).then(|| {
        register(0x108).write(0); // EVENTS_RXDRDY
        register(0x518).read() as u8 // RXD
    })
}
