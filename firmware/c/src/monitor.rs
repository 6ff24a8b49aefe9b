//! Margins on line: consumption against limits, and when a new plan is needed.

use crate::allocation::{COTAMA_AXES, order_of};
use crate::error::{Done, cotama_error};
use crate::firings::COTAMA_NONE;
use crate::memory::{Handle, Kept, Pieces};
use core::ffi::c_void;
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{MAX_AMOUNT, Monitor, Request, Trigger, Upward};

/// A monitor of the margins of a mission, in the caller's memory.
pub struct cotama_monitor {
    _memory: [u8; 0],
}

impl Handle for cotama_monitor {
    type Value = Monitor<COTAMA_AXES>;
    const BYTES: usize = COTAMA_MONITOR_BYTES;
    const MARK: u64 = 0x0072_6f74_696e_6f6d; // "monitor"
}

/// The bytes of a `cotama_monitor`, at an address that is a multiple of 8.
pub const COTAMA_MONITOR_BYTES: usize = 128;
const _: () = assert!(Kept::<Monitor<COTAMA_AXES>>::fits(COTAMA_MONITOR_BYTES, 8));

/// The request of a monitor.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_request {
    /// Nothing; go on.
    Keep = 0,
    /// A plan that needs less: the margin of the axis named is below zero.
    DownMargin = 1,
    /// A plan without hardware that is lost.
    DownHardware = 2,
    /// A better plan, as margins have grown.
    Up = 3,
}

/// An amount on each axis.
///
/// # Safety
/// `amounts` is null or points to [`COTAMA_AXES`] of them.
unsafe fn amounts(
    pieces: &mut Pieces,
    amounts: *const u64,
) -> Result<[u64; COTAMA_AXES], cotama_error> {
    // SAFETY: the caller promises the same.
    let list = unsafe { pieces.list(amounts, COTAMA_AXES) }?;
    list.try_into().map_err(|_| cotama_error::BadNumber)
}

/// Starts a monitor of these inclusive limits, with nothing used, that never asks for a better
/// plan; `order` are the axes in their order of treatment.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given; `limits` and
/// `order` to `COTAMA_AXES` numbers each. The memory is the monitor's from now on.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_start(
    memory: *mut c_void,
    bytes: usize,
    limits: *const u64,
    order: *const u32,
    monitor: *mut *mut cotama_monitor,
) -> cotama_error {
    let start = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (limits, order, place) = unsafe {
            let limits = amounts(&mut pieces, limits)?;
            let order = pieces.list(order, COTAMA_AXES)?;
            (limits, order, pieces.place(memory, bytes, monitor)?)
        };
        let made = Monitor::new(limits, order_of(order)?);
        place.start(made.map_err(|_| cotama_error::BadNumber)?);
        Ok(())
    };
    Done::into(start())
}

/// Asks for a better plan too: when some margin has grown by `growth` since the last plan (0: not
/// on this axis), with `reserve` left on each.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_ask_upward(
    monitor: *mut cotama_monitor,
    growth: *const u64,
    reserve: *const u64,
) -> cotama_error {
    let ask = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, upward) = unsafe {
            let started = pieces.started(monitor)?;
            let growth = amounts(&mut pieces, growth)?;
            (started, Upward { growth, reserve: amounts(&mut pieces, reserve)? })
        };
        if upward.growth.iter().chain(&upward.reserve).any(|it| *it > MAX_AMOUNT) {
            return Err(cotama_error::BadNumber);
        }
        started.with(|it| *it = it.with_upward(upward));
        Ok(())
    };
    ask().into()
}

/// Notes that hardware has come back: a reason to ask for a better plan.
///
/// # Safety
/// The pointer is null or points to a monitor that no other thread uses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_hardware_returned(
    monitor: *mut cotama_monitor,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    let started = unsafe { Pieces::new().started(monitor) };
    let done: Done = started.map(|it| it.with(Monitor::hardware_returned));
    done.into()
}

/// Notes that a plan which will cost `rest` is in force from now on.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_planned(
    monitor: *mut cotama_monitor,
    rest: *const u64,
) -> cotama_error {
    let planned = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, rest) = unsafe { (pieces.started(monitor)?, amounts(&mut pieces, rest)?) };
        started.with(|it| it.planned(&rest)).map_err(|_| cotama_error::BadNumber)
    };
    planned().into()
}

/// Adds what was used.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_spend(
    monitor: *mut cotama_monitor,
    cost: *const u64,
) -> cotama_error {
    let spend = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, cost) = unsafe { (pieces.started(monitor)?, amounts(&mut pieces, cost)?) };
        started.with(|it| it.spend(&cost)).map_err(|_| cotama_error::BadNumber)
    };
    spend().into()
}

/// The rest of each limit: the limits of the next problem.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_left(
    monitor: *const cotama_monitor,
    left: *mut u64,
) -> cotama_error {
    let left = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, left) = unsafe {
            let started = pieces.started(monitor)?;
            let left = pieces.out(left.cast::<[u64; COTAMA_AXES]>())?;
            (started, left)
        };
        left.put(started.with(|it| it.left()));
        Ok(())
    };
    left().into()
}

/// The margins: limit less used less what is planned for the rest, on each axis.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_margins(
    monitor: *const cotama_monitor,
    rest: *const u64,
    margins: *mut i64,
) -> cotama_error {
    let find = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, rest, margins) = unsafe {
            let started = pieces.started(monitor)?;
            let margins = pieces.out(margins.cast::<[i64; COTAMA_AXES]>())?;
            (started, amounts(&mut pieces, rest)?, margins)
        };
        let found = started.with(|it| it.margins(&rest)).map_err(|_| cotama_error::BadNumber)?;
        margins.put(found);
        Ok(())
    };
    find().into()
}

/// Whether the plan still holds, from what it will cost, the units that it needs and those that
/// there are. `axis` is the one whose margin is below zero, else `COTAMA_NONE`; it may be null.
///
/// # Safety
/// The pointers are null or point to what their types say, lists to `COTAMA_AXES` numbers; no other
/// thread uses the monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_monitor_assess(
    monitor: *const cotama_monitor,
    rest: *const u64,
    needs: u64,
    available: u64,
    request: *mut cotama_request,
    axis: *mut u32,
) -> cotama_error {
    let assess = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, rest, request, axis) = unsafe {
            let started = pieces.started(monitor)?;
            let request = pieces.out(request)?;
            let axis = pieces.wanted(axis)?;
            (started, amounts(&mut pieces, rest)?, request, axis)
        };
        let needs = Equipment::from_bits(needs).ok_or(cotama_error::BadNumber)?;
        let available = Equipment::from_bits(available).ok_or(cotama_error::BadNumber)?;
        let asked = started.with(|it| it.assess(&rest, needs, available));
        let (asked, short) = match asked.map_err(|_| cotama_error::BadNumber)? {
            Request::Keep => (cotama_request::Keep, COTAMA_NONE),
            Request::Down(Trigger::Margin { axis }) => (cotama_request::DownMargin, axis as u32),
            Request::Down(Trigger::Hardware) => (cotama_request::DownHardware, COTAMA_NONE),
            Request::Up => (cotama_request::Up, COTAMA_NONE),
        };
        request.put(asked);
        if let Some(it) = axis {
            it.put(short);
        }
        Ok(())
    };
    assess().into()
}
