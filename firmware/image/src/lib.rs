//! The common parts of the images: a board, its timer, and measurement.
//!
//! A board has a UART, a hardware watchdog and flash. `mps2` is Arm's MPS2 with the images AN385
//! (Cortex-M3) and AN386 (Cortex-M4F), as QEMU has it; `nrf52840` is Nordic's development kit.
//! `nrf51822` is a Cortex-M0 as QEMU has it, with its UART alone.
#![no_std]

#[cfg(not(any(feature = "mps2", feature = "nrf51822", feature = "nrf52840")))]
compile_error!("choose a board: --features mps2, nrf51822 or nrf52840");
#[cfg(any(
    all(feature = "mps2", any(feature = "nrf51822", feature = "nrf52840")),
    all(feature = "nrf51822", feature = "nrf52840")
))]
compile_error!("choose one board");

mod measure;
#[cfg(feature = "mps2")]
mod mps2;
#[cfg(feature = "mps2")]
mod mps2_line;
#[cfg(any(feature = "nrf51822", feature = "nrf52840"))]
mod nordic;
#[cfg(any(feature = "nrf51822", feature = "nrf52840"))]
mod nordic_line;
#[cfg(feature = "nrf51822")]
mod nrf51822;
#[cfg(feature = "nrf52840")]
mod nrf52840;
mod received;
mod register;
mod timer;

pub use measure::{icount_mark, stack_used};
#[cfg(feature = "mps2")]
pub use mps2::{CLOCK_HZ, Flash, Uart, Watchdog, exit, set_up};
#[cfg(feature = "mps2")]
use mps2_line::{UART_INTERRUPT, take_byte};
#[cfg(any(feature = "nrf51822", feature = "nrf52840"))]
pub use nordic::Uart;
#[cfg(any(feature = "nrf51822", feature = "nrf52840"))]
use nordic_line::{UART_INTERRUPT, take_byte};
#[cfg(feature = "nrf51822")]
use nrf51822::UART_PINS;
#[cfg(feature = "nrf51822")]
pub use nrf51822::{CLOCK_HZ, exit, set_up};
#[cfg(feature = "nrf52840")]
use nrf52840::UART_PINS;
#[cfg(feature = "nrf52840")]
pub use nrf52840::{CLOCK_HZ, Flash, Watchdog, exit, set_up};
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
