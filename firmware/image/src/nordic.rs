//! The UART that Nordic's nRF51 and nRF52 have in common (nRF52840 product specification 1.7,
//! section 6.33; nRF51 reference manual 3.0, chapter 29).

use crate::UART_PINS;
use crate::nordic_line::UART;
use crate::received::{listen, received};
use crate::register::Register;

/// UART 0 at 115,200 baud.
#[derive(Debug)]
pub struct Uart {
    sent: Register,
    data_out: Register,
    sending: bool,
}

impl Uart {
    /// Switches it on.
    pub fn start() -> Self {
        // SAFETY: the UART has these registers, and nothing else here uses it.
        let register = |offset| unsafe { Register::new(UART, offset) };
        let (sends, receives) = UART_PINS;
        register(0x50C).write(sends); // PSEL.TXD
        register(0x514).write(receives); // PSEL.RXD
        register(0x524).write(0x01D7_E000); // BAUDRATE
        register(0x500).write(4); // ENABLE
        register(0x304).write(1 << 2); // INTENSET: RXDRDY
        listen();
        register(0x000).write(1); // TASKS_STARTRX
        register(0x008).write(1); // TASKS_STARTTX
        Self { sent: register(0x11C), data_out: register(0x51C), sending: false }
    }

    /// Sends a byte, once the one before is gone.
    pub fn put(&mut self, byte: u8) {
        while self.sending && self.sent.read() == 0 {}
        self.sent.write(0);
        self.data_out.write(byte.into());
        self.sending = true;
    }

    /// The byte that came first of those that wait, if any.
    pub fn get(&mut self) -> Option<u8> {
        received()
    }
}
