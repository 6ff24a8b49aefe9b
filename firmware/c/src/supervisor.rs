//! A net of yours in C: the recipe, and the functions that do the work.
//!
//! A file for a net, as `watchdog.rs` is one for the net of that name:
//!
//! 1. an opaque type, which is a [`Handle`] of the net's checked player, of so many bytes;
//! 2. enums with the net's events, outputs and places in the order of `net!`, for the header, and
//!    one line each that compares their names with the net's while compiling ([`same_names`]);
//! 3. a constant with the bytes of a handle and one with those of a stored state, for the header,
//!    and a line that compares them with what Rust needs;
//! 4. `tables!`, and the trait [`Alone`] for the net's program;
//! 5. one function for each operation, which hands its arguments to the one of this module.
//!
//! Such a file stands in a crate of yours that depends on this one, beside a panic handler as in
//! `library`; its `crate-type` is `staticlib`, and cbindgen makes its header with
//! `parse.parse_deps = true, parse.include = ["cotama-c"]`.
//!
//! C's memory may be overwritten by anybody, and a stored state may be any, so the player is one
//! that checks every firing ([`Checked`]) and takes nothing to be proven.
#![allow(clippy::missing_errors_doc, reason = "`cotama_error` says what each error is")]

use crate::error::{Done, cotama_error};
use crate::firings::{COTAMA_NEVER, Notes, cotama_firings, cotama_text};
use crate::memory::{Handle, Pieces};
use crate::tables::{NamesOf, Says};
use core::ffi::c_void;
use cotama_core::net::{EventId, Net, PlaceId, Signal};
use cotama_core::player::{
    Checked, Outcome, Player, Program, RestoreError, Snapshot, StateMachine, Why,
};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// The outcome of an event that was offered.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_outcome {
    /// A transition on it fired.
    Fired = 0,
    /// The event is ignored: a marked place does so on purpose.
    IgnoredOnPurpose = 1,
    /// The event is ignored: no transition on it has the tokens that it needs.
    NotEnabled = 2,
    /// The event is ignored: the interval of the transition on it has not begun.
    TooEarly = 3,
    /// The event is ignored: the interval of the transition on it is over.
    TooLate = 4,
    /// The event is ignored: a place would hold more than its bound.
    Full = 5,
    /// The event is ignored: there is more to catch up with first, so advance, and offer it again.
    Behind = 6,
    /// The event is refused: a mailbox on its path is full.
    Refused = 7,
}

impl<T> From<Outcome<T>> for cotama_outcome {
    fn from(outcome: Outcome<T>) -> Self {
        match outcome {
            Outcome::Fired { .. } => Self::Fired,
            Outcome::Refused { .. } => Self::Refused,
            Outcome::Ignored { why } => match why {
                Why::OnPurpose => Self::IgnoredOnPurpose,
                Why::NotEnabled | Why::NoSuchEvent => Self::NotEnabled,
                Why::TooEarly(_) => Self::TooEarly,
                Why::TooLate(_) => Self::TooLate,
                Why::Full(_) => Self::Full,
                Why::Behind => Self::Behind,
            },
        }
    }
}

/// The player that a handle of a net keeps.
///
/// cbindgen:ignore
pub type Playing<P, const W: usize, const C: usize> = Player<Checked<P>, W, C>;

/// A net alone whose program has no bytes, as `net!` makes one.
pub trait Alone: Sized + 'static {
    /// The program.
    const PROGRAM: Self;
    /// The outputs of its transitions: of [`tables!`](crate::tables!).
    const SAYS: Says<'static>;
    /// How many events it has.
    const EVENTS: u32;
    /// How many places it has.
    const PLACES: u32;
}

/// Starts a net at `now`; transitions that fire at once are noted.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given; `memory` belongs
/// to the handle from now on.
pub unsafe fn start<H, P, const W: usize, const C: usize>(
    memory: *mut c_void,
    bytes: usize,
    now: u64,
    firings: *mut cotama_firings,
    handle: *mut *mut H,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + Alone + Copy,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (place, mut notes) = unsafe {
        let place = pieces.place(memory, bytes, handle)?;
        (place, Notes::new(P::SAYS, firings, &mut pieces)?)
    };
    place.start(Player::start(Checked(P::PROGRAM), Millis(now), &mut notes));
    notes.end();
    Ok(())
}

/// Lets time pass up to `now`, then offers an event.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn offer<H, P, const W: usize, const C: usize>(
    handle: *mut H,
    now: u64,
    event: u32,
    outcome: *mut cotama_outcome,
    firings: *mut cotama_firings,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + Alone,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, outcome, mut notes) = unsafe {
        let started = pieces.started(handle)?;
        let outcome = pieces.wanted(outcome)?;
        let notes = Notes::new(P::SAYS, firings, &mut pieces)?;
        (started, outcome, notes)
    };
    if event >= P::EVENTS {
        return Err(cotama_error::BadNumber);
    }
    let event = Of { component: 0, id: EventId(event) };
    let became = started.with(|it| it.offer_id(Millis(now), event, (), &mut notes));
    notes.end();
    if let Some(it) = outcome {
        it.put(became.into());
    }
    Ok(())
}

/// Lets time pass up to `now`. `behind` is set when there is more to catch up with: call again.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn advance<H, P, const W: usize, const C: usize>(
    handle: *mut H,
    now: u64,
    behind: *mut bool,
    firings: *mut cotama_firings,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + Alone,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, behind, mut notes) = unsafe {
        let started = pieces.started(handle)?;
        let behind = pieces.wanted(behind)?;
        let notes = Notes::new(P::SAYS, firings, &mut pieces)?;
        (started, behind, notes)
    };
    let advanced = started.with(|it| it.advance_with(Millis(now), &mut notes));
    notes.end();
    if let Some(it) = behind {
        it.put(advanced.behind);
    }
    Ok(())
}

/// When it wants to be woken, ms; [`COTAMA_NEVER`] when nothing is due by itself.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn wake_at<H, P, const W: usize, const C: usize>(handle: *const H, at: *mut u64) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C>,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, at) = unsafe {
        let started = pieces.started(handle)?;
        let at = pieces.out(at)?;
        (started, at)
    };
    at.put(started.with(|it| it.wake_at()).map_or(COTAMA_NEVER, |it| it.0));
    Ok(())
}

/// How far `now` lies before the time last told, ms; 0 when it does not.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn went_back<H, P, const W: usize, const C: usize>(
    handle: *const H,
    now: u64,
    back: *mut u64,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C>,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, back) = unsafe {
        let started = pieces.started(handle)?;
        let back = pieces.out(back)?;
        (started, back)
    };
    back.put(started.with(|it| it.clock_went_back(Millis(now))).map_or(0, |it| it.0));
    Ok(())
}

/// The tokens of a place.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn tokens<H, P, const W: usize, const C: usize>(
    handle: *const H,
    place: u32,
    tokens: *mut u32,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + Alone,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, tokens) = unsafe {
        let started = pieces.started(handle)?;
        let tokens = pieces.out(tokens)?;
        (started, tokens)
    };
    if place >= P::PLACES {
        return Err(cotama_error::BadNumber);
    }
    let place = Of { component: 0, id: PlaceId(place) };
    tokens.put(started.with(|it| it.tokens(place)));
    Ok(())
}

/// The marked place of a state machine.
///
/// # Safety
/// The pointers are null or point to what their types say.
pub unsafe fn state<H, P, const W: usize, const C: usize>(handle: *const H, place: *mut u32) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + StateMachine,
{
    const { assert!(P::IS_ONE, "this net is no state machine: ask for `tokens` of its places") };
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, place) = unsafe {
        let started = pieces.started(handle)?;
        let place = pieces.out(place)?;
        (started, place)
    };
    let marked = started.with(|it| {
        let marks = |&id: &u32| it.tokens(Of { component: 0, id: PlaceId(id) }) > 0;
        (0..P::STATES.len() as u32).find(marks)
    });
    let marked = marked.ok_or(cotama_error::Impossible)?;
    place.put(marked);
    Ok(())
}

/// Stores the state, with a checksum, in [`Snapshot::BYTES`] bytes.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
pub unsafe fn store<H, P, const W: usize, const C: usize>(
    handle: *const H,
    bytes: *mut u8,
    room: usize,
    written: *mut usize,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C>,
{
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (started, written, bytes) = unsafe {
        let started = pieces.started(handle)?;
        let written = pieces.wanted(written)?;
        (started, written, pieces.list_to_write(bytes, room)?)
    };
    let snapshot = started.with(|it| it.snapshot());
    let stored = snapshot.write(bytes).ok_or(cotama_error::TooSmall)?.len();
    if let Some(it) = written {
        it.put(stored);
    }
    Ok(())
}

/// Starts a net at `now` where a stored one was; refuses bytes that are damaged, of another net, or
/// that say what cannot be.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given; `memory` belongs
/// to the handle from now on.
pub unsafe fn restore<H, P, const W: usize, const C: usize>(
    memory: *mut c_void,
    bytes: usize,
    now: u64,
    stored: *const u8,
    length: usize,
    handle: *mut *mut H,
) -> Done
where
    H: Handle<Value = Playing<P, W, C>>,
    P: Program<W, C> + Alone + Copy,
{
    if stored.is_null() {
        return Err(cotama_error::NullPointer);
    }
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (stored, place) =
        unsafe { (pieces.list(stored, length)?, pieces.place(memory, bytes, handle)?) };
    let snapshot = Snapshot::read(stored).ok_or(cotama_error::Damaged)?;
    let restored = Player::restore(Checked(P::PROGRAM), Millis(now), &snapshot);
    place.start(restored.map_err(|error| match error {
        RestoreError::OtherSystem { .. } => cotama_error::OtherNet,
        _ => cotama_error::Impossible,
    })?);
    Ok(())
}

/// The name of a transition.
///
/// # Safety
/// The pointer is null or points to memory for a text.
pub unsafe fn transition_name(
    names: NamesOf<'static>,
    transition: u32,
    name: *mut cotama_text,
) -> Done {
    // SAFETY: the caller promises the same.
    let name = unsafe { Pieces::new().out(name) }?;
    name.put(names.of(0, transition)?.1.into());
    Ok(())
}

/// Whether these are the names of a net's events, or outputs, in their order; while compiling.
pub const fn same_names(names: &[&str], signals: &[Signal<'_>]) -> bool {
    let mut at = 0;
    while at < names.len() && at < signals.len() {
        if !same(names[at], signals[at].name) {
            return false;
        }
        at += 1;
    }
    names.len() == signals.len()
}

/// Whether a net's places begin with these names, in their order; while compiling. Behind them are
/// those that `net!` adds.
pub const fn same_places(names: &[&str], net: &Net<'_>) -> bool {
    let mut at = 0;
    while at < names.len() && at < net.places.len() {
        if !same(names[at], net.places[at].name) {
            return false;
        }
        at += 1;
    }
    at == names.len()
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut at = 0;
    while at < a.len() && at < b.len() && a[at] == b[at] {
        at += 1;
    }
    at == a.len() && at == b.len()
}
