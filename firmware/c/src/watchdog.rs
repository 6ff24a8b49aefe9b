//! The watchdog of a periodic module in C: a net by the recipe of [`supervisor`].

use crate::error::cotama_error;
use crate::firings::{cotama_firings, cotama_text};
use crate::memory::{self, Handle};
use crate::supervisor::{self, Alone, Playing, cotama_outcome, same_names, same_places};
use crate::tables::Says;
use core::ffi::c_void;
use cotama_core::player::Snapshot;
use cotama_core::system::{Component, System};
use cotama_models::nets::watchdog::{NET, Program};

/// The watchdog of one module, in the caller's memory.
pub struct cotama_watchdog {
    _memory: [u8; 0],
}

/// cbindgen:ignore
const WORDS: usize = 1;
/// cbindgen:ignore
const CLOCKS: usize = 3;
/// cbindgen:ignore
type Player = Playing<Program, WORDS, CLOCKS>;

impl Handle for cotama_watchdog {
    type Value = Player;
    const BYTES: usize = COTAMA_WATCHDOG_BYTES;
    const MARK: u64 = 0x676f_6468_6374_6177; // "watchdog"
}

crate::tables! { System::alone(&[Component::alone(&NET)]) }

impl Alone for Program {
    const PROGRAM: Self = Self;
    const SAYS: Says<'static> = SAYS;
    const EVENTS: u32 = NET.events.len() as u32;
    const PLACES: u32 = NET.places.len() as u32;
}

/// The bytes of a `cotama_watchdog`, at an address that is a multiple of 8.
pub const COTAMA_WATCHDOG_BYTES: usize = 48;
/// The bytes of a stored one.
pub const COTAMA_WATCHDOG_STORED_BYTES: usize = 32;
const _: () = {
    assert!(memory::Kept::<Player>::fits(COTAMA_WATCHDOG_BYTES, 8));
    assert!(Snapshot::<WORDS, CLOCKS>::BYTES == COTAMA_WATCHDOG_STORED_BYTES);
};

/// The events of a watchdog.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_watchdog_event {
    /// The scheduler starts a job.
    Release = 0,
    /// The job is done.
    Done = 1,
    /// The supervisor has dealt with the fault.
    CsAck = 2,
}

/// The outputs of a watchdog: the bits of `outputs` in a firing, by their numbers.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_watchdog_output {
    /// The job is stopped.
    SkipJob = 0,
    /// The module misses its deadlines persistently.
    RtFault = 1,
}

/// The places of a watchdog; one of the first four is marked.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_watchdog_place {
    /// No job of the module runs.
    Idle = 0,
    /// A job runs, and its deadline is ahead.
    Run = 1,
    /// A job runs on in its extra time.
    Extra = 2,
    /// The fault was reported; the module stands still.
    Fault = 3,
    /// Deadlines missed in a row: ask for its tokens.
    Misses = 4,
}

const _: () = {
    assert!(same_names(&["Release", "Done", "CsAck"], NET.events));
    assert!(same_names(&["SkipJob", "RtFault"], NET.outputs));
    assert!(same_places(&["Idle", "Run", "Extra", "Fault", "misses"], &NET));
};

/// Starts a watchdog at `now_ms` in `bytes` bytes of memory, which are its from now on.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_start(
    memory: *mut c_void,
    bytes: usize,
    now_ms: u64,
    watchdog: *mut *mut cotama_watchdog,
) -> cotama_error {
    let none = core::ptr::null_mut();
    // SAFETY: the caller promises the same.
    unsafe { supervisor::start(memory, bytes, now_ms, none, watchdog) }.into()
}

/// Lets time pass up to `now_ms`, then offers a `cotama_watchdog_event`.
///
/// `outcome` and `firings` may be null.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_offer(
    watchdog: *mut cotama_watchdog,
    now_ms: u64,
    event: u32,
    outcome: *mut cotama_outcome,
    firings: *mut cotama_firings,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::offer(watchdog, now_ms, event, outcome, firings) }.into()
}

/// Lets time pass up to `now_ms`: what was due fires at the time when it was due.
///
/// `behind` is set when there is more to catch up with: call again. It and `firings` may be null.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_advance(
    watchdog: *mut cotama_watchdog,
    now_ms: u64,
    behind: *mut bool,
    firings: *mut cotama_firings,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::advance(watchdog, now_ms, behind, firings) }.into()
}

/// When the watchdog wants to be woken, ms; `COTAMA_NEVER` when nothing is due by itself.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_wake_at(
    watchdog: *const cotama_watchdog,
    at_ms: *mut u64,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::wake_at(watchdog, at_ms) }.into()
}

/// How far `now_ms` lies before the time that the watchdog was last told, ms; 0 when it does not.
///
/// A clock that goes back is no error of `cotama_watchdog_offer` and `cotama_watchdog_advance`:
/// time stands still until the clock has caught up. Ask before them.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_went_back(
    watchdog: *const cotama_watchdog,
    now_ms: u64,
    back_ms: *mut u64,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::went_back(watchdog, now_ms, back_ms) }.into()
}

/// The marked one of the first four of `cotama_watchdog_place`.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_state(
    watchdog: *const cotama_watchdog,
    place: *mut u32,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::state(watchdog, place) }.into()
}

/// The tokens of a `cotama_watchdog_place`.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_tokens(
    watchdog: *const cotama_watchdog,
    place: u32,
    tokens: *mut u32,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::tokens(watchdog, place, tokens) }.into()
}

/// Stores the watchdog in `COTAMA_WATCHDOG_STORED_BYTES` bytes with a checksum; `written` may be
/// null.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given; no other thread
/// uses the watchdog.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_store(
    watchdog: *const cotama_watchdog,
    bytes: *mut u8,
    room: usize,
    written: *mut usize,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::store(watchdog, bytes, room, written) }.into()
}

/// Starts a watchdog at `now_ms` where a stored one was, with what its clocks had left.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_restore(
    memory: *mut c_void,
    bytes: usize,
    now_ms: u64,
    stored: *const u8,
    length: usize,
    watchdog: *mut *mut cotama_watchdog,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::restore(memory, bytes, now_ms, stored, length, watchdog) }.into()
}

/// The name of a transition in a firing.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_watchdog_transition_name(
    transition: u32,
    name: *mut cotama_text,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { supervisor::transition_name(TRANSITIONS, transition, name) }.into()
}
