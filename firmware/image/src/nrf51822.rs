//! A Cortex-M0: Nordic's nRF51822 as QEMU has it in the micro:bit, with the 32 KB of RAM of its
//! variant AC. The emulator adds SysTick, which this chip lacks, and has no flash controller and no
//! watchdog: scenes are played, nothing else.

/// The clock of the core.
pub const CLOCK_HZ: u32 = 16_000_000;

/// Pins of the micro:bit's USB serial port: P0.24 sends, P0.25 receives.
pub(crate) const UART_PINS: (u32, u32) = (24, 25);

/// Nothing to do: the clock runs.
pub fn set_up() {}

/// Ends the emulator with this status.
pub fn exit(status: i32) -> ! {
    semihosting::process::exit(status)
}
