//! The robot behind its UART, as it is flashed; `loop.rs` and `exact.rs` choose who plans.

use board::{Flash, Timer, Uart, Watchdog, every_tick};
use core::cell::RefCell;
use core::mem::MaybeUninit;
use cortex_m::Peripherals;
use cortex_m::interrupt::{Mutex, free};
use cotama_core::units::Millis;
use robot::control::PERIOD_MS;
use robot::guard::{Guard, STARVES_AFTER_MS};
use robot::patrol::{Tables, Workspace};
use robot::robots::delivery::{Control, STORED_BYTES, Supervisors, at_rest};
use robot::server::{Served, Server};
use robot::store::{LONGEST, Store};

/// A frame that ends the emulator, and one that makes the control loop hang: for tests.
#[cfg(feature = "mps2")]
const END: u8 = 0xFE;
#[cfg(feature = "mps2")]
const HANG: u8 = 0xFD;

static GUARD: Mutex<RefCell<Option<(Guard, Watchdog)>>> = Mutex::new(RefCell::new(None));

/// In the interrupt of each millisecond: periods are released, and the hardware watchdog is fed as
/// long as the checked watchdog net is in no fault.
fn tick(now: u64) {
    free(|token| {
        let Some((guard, watchdog)) = &mut *GUARD.borrow(token).borrow_mut() else { return };
        if now % PERIOD_MS == 0 {
            guard.begin(Millis(now));
        }
        if guard.feeds(Millis(now)) {
            watchdog.feed();
        }
    });
}

/// Starts with the last whole state that is in flash, or at rest. Each step is a function that is
/// not inlined, so that its copies of the state do not stay on the stack.
#[inline(never)]
fn boot(server: &mut Server) -> Store<Flash> {
    let mut content = [0; LONGEST];
    let (store, length) = Store::open(Flash::take(), &mut content);
    if let Some(stored) = length.and_then(|it| content.get(..it)) {
        let _ = server.control.restore(stored, Millis(0)); // damaged: at rest
    }
    store
}

#[inline(never)]
fn with(place: &'static mut MaybeUninit<Server>, supervisors: Supervisors) -> &'static mut Server {
    place.write(Server::new(Control::new(supervisors)))
}

/// Stores the state, where it is another than the one that is stored.
#[inline(never)]
fn keep(store: &mut Store<Flash>, server: &Server, stored: &mut [u8; STORED_BYTES]) {
    let mut state = [0; STORED_BYTES];
    let _ = server.control.store(&mut state); // the room is its length
    if state != *stored && store.write(&state).is_ok() {
        *stored = state;
    }
}

/// Serves for ever.
pub(crate) fn serve(tables: &mut Tables, mut exact: Option<&mut Workspace>) -> ! {
    board::set_up();
    let Some(core) = Peripherals::take() else { board::exit(103) };
    let place = cortex_m::singleton!(: MaybeUninit<Server> = MaybeUninit::uninit());
    let Some(place) = place else { board::exit(103) };
    let mut uart = Uart::start();
    let server = with(place, at_rest());
    let mut store = boot(server);
    let stored = cortex_m::singleton!(: [u8; STORED_BYTES] = [0; STORED_BYTES]);
    let Some(stored) = stored else { board::exit(103) };
    let watchdog = Watchdog::start(STARVES_AFTER_MS);
    free(|token| GUARD.borrow(token).replace(Some((Guard::default(), watchdog))));
    every_tick(tick);
    let _timer = Timer::start(core.SYST);
    loop {
        let byte = uart.get();
        let served = byte.and_then(|byte| {
            server.take(byte, tables, exact.as_deref_mut(), |byte| uart.put(byte))
        });
        match served {
            Some(Served::Period) => keep(&mut store, server, stored),
            #[cfg(feature = "mps2")]
            Some(Served::Other(END)) => {
                semihosting::eprintln!("stack: {} bytes", board::stack_used());
                board::exit(0)
            }
            #[cfg(feature = "mps2")]
            Some(Served::Other(HANG)) => loop {
                cortex_m::asm::nop();
            },
            _ => {}
        }
        free(|token| {
            if let Some((guard, _)) = &mut *GUARD.borrow(token).borrow_mut() {
                guard.end(Millis(Timer::now()));
            }
        });
        if byte.is_none() {
            cortex_m::asm::wfi();
        }
    }
}
