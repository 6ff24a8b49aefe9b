//! What the images share: a board, its timer, and what a measurement needs.
//!
//! A board has a UART, a hardware watchdog and flash. `mps2` is Arm's MPS2 with the images AN385
//! (Cortex-M3) and AN386 (Cortex-M4F), as QEMU has it; `nrf52840` is Nordic's development kit.
#![no_std]

#[cfg(not(any(feature = "mps2", feature = "nrf52840")))]
compile_error!("choose a board: --features mps2 or --features nrf52840");
#[cfg(all(feature = "mps2", feature = "nrf52840"))]
compile_error!("choose one board");

mod measure;
#[cfg(feature = "mps2")]
mod mps2;
#[cfg(feature = "nrf52840")]
mod nrf52840;
mod received;
mod register;
mod timer;

pub use measure::{icount_mark, stack_used};
#[cfg(feature = "mps2")]
pub use mps2::{CLOCK_HZ, Flash, Uart, Watchdog, exit, set_up};
#[cfg(feature = "mps2")]
use mps2::{UART_INTERRUPT, take_byte};
#[cfg(feature = "nrf52840")]
pub use nrf52840::{CLOCK_HZ, Flash, Uart, Watchdog, exit, set_up};
#[cfg(feature = "nrf52840")]
use nrf52840::{UART_INTERRUPT, take_byte};
pub use timer::{Timer, every_tick};

use core::panic::PanicInfo;
use cortex_m_rt::{ExceptionFrame, exception};

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    exit(101)
}

/// The default handler loops for ever; a fault must end the run.
// SAFETY: nothing is assumed of the state in which the processor is.
#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    exit(102)
}

/// The first warning of the hardware watchdog, on boards where it gives one: its second resets.
// SAFETY: nothing is assumed of the state in which the processor is.
#[exception]
unsafe fn NonMaskableInt() -> ! {
    loop {
        cortex_m::asm::nop();
    }
}
