//! The decisional level of a robot: flags in, a round in each period, requests out.

use crate::error::{Done, cotama_error};
use crate::failures::{Found, cotama_failures};
use crate::firings::{COTAMA_NONE, Notes, cotama_firings, cotama_text};
use crate::memory::{Handle, Kept, Pieces};
use crate::robot::names::{FAILURES, FLAGS, MODULES};
use crate::robot::{self, Decider, LEVEL_BYTES, Program, ROBOT, Snapshot, TABLES, system};
use crate::told::cotama_told;
use core::ffi::c_void;
use cotama_core::player::{Checked, RestoreError};
use cotama_core::units::Millis;
use cotama_models::level::{Cause, Drive, Level, Perceived};

/// The decisional level, in the caller's memory: diagnosis, supervisors and settings.
pub struct cotama_level {
    _memory: [u8; 0],
}

impl Handle for cotama_level {
    type Value = Decider;
    const BYTES: usize = LEVEL_BYTES;
    const MARK: u64 = 0x0000_006c_6576_656c; // "level"
}

const _: () = assert!(Kept::<Decider>::fits(LEVEL_BYTES, 8));

crate::tables! { system::SYSTEM }

/// The news of observers and the scheduler in a period.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_perceived {
    /// Flags that are raised now: bit `n` is `COTAMA_FLAG_...` `n`.
    pub raised: u64,
    /// Flags that were raised and have gone back.
    pub lowered: u64,
    /// The modules that say that they work, in use or not: bit `n` is `COTAMA_MODULE_...` `n`.
    pub works: u64,
}

/// State of the drive: 0 says no, any other number yes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_drive {
    /// The goal of the drive is reached.
    pub at_goal: u8,
    /// The robot does not move.
    pub stands: u8,
}

/// The outcome of a round.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_round {
    /// The modules that are to be started anew now: bit `n` is `COTAMA_MODULE_...` `n`.
    pub restarts: u64,
    /// Word that the supervisors accepted; `COTAMA_WORD_NOTHING` where there was none.
    pub told: cotama_told,
}

/// The requests to the robot until the next round.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_requests {
    /// The fastest it may go, mm/s, as the configuration and the settings leave it.
    pub speed_mm_s: u64,
    /// The reports whose settings hold: bit `n` is `COTAMA_REPORT_...` `n`.
    pub settings: u64,
    /// The modules that are to run, a `COTAMA_CONFIGURATION_...`; `COTAMA_NONE` where nothing does.
    pub configuration: u32,
    /// Motion may be commanded.
    pub drive: bool,
    /// Motor power is to be cut for good.
    pub halt: bool,
    /// The operator is asked.
    pub ask: bool,
    /// The mission was given up and the robot stands: alarm.
    pub alarm: bool,
}

/// Whether the caller's numbers are those of this robot.
fn is_this(robot: u64) -> Done {
    if robot == ROBOT { Ok(()) } else { Err(cotama_error::OtherRobot) }
}

/// Starts the level of a robot at rest, all of which works, in `bytes` bytes of memory, which are
/// its from now on.
///
/// `robot` is `COTAMA_ROBOT`; a header of another robot or mission is refused.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_start(
    memory: *mut c_void,
    bytes: usize,
    robot: u64,
    level: *mut *mut cotama_level,
) -> cotama_error {
    let start = || {
        is_this(robot)?;
        // SAFETY: the caller promises the same.
        let place = unsafe { Pieces::new().place(memory, bytes, level) }?;
        place.start(robot::at_rest());
        Ok(())
    };
    Done::into(start())
}

/// Observers tell what they see. New flags are taken for failures, which wait to be told.
///
/// `failures` may be null.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_perceive(
    level: *mut cotama_level,
    now_ms: u64,
    seen: *const cotama_perceived,
    failures: *mut cotama_failures,
) -> cotama_error {
    let perceive = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, seen, failures) = unsafe {
            let started = pieces.started(level)?;
            let failures = Found::wanted(failures, &mut pieces)?;
            (started, pieces.read(seen)?, failures)
        };
        let cotama_perceived { raised, lowered, works } = seen;
        let beyond = |set: u64, count: usize| set.checked_shr(count as u32).unwrap_or(0) != 0;
        if beyond(raised | lowered, FLAGS.len()) || beyond(works, MODULES.len()) {
            return Err(cotama_error::BadNumber);
        }
        let seen = Perceived { raised, lowered, works };
        let found = started.with(|it| it.perceive(Millis(now_ms), seen));
        if let Some(it) = failures {
            it.put(found.count(), found.worst_first(TABLES.failures));
        }
        Ok(())
    };
    Done::into(perceive())
}

/// Lets a failure that no flag shows, such as that no plan is left, wait to be told: a
/// `COTAMA_FAILURE_...`.
///
/// # Safety
/// The pointer is null or points to a level that no other thread uses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_report(
    level: *mut cotama_level,
    failure: u32,
) -> cotama_error {
    let report = || {
        // SAFETY: the caller promises the same.
        let started = unsafe { Pieces::new().started(level) }?;
        let failure = failure as usize;
        if failure >= FAILURES.len() {
            return Err(cotama_error::BadNumber);
        }
        started.with(|it| it.report(failure, Cause(0)));
        Ok(())
    };
    Done::into(report())
}

/// Whether what is said in the coming round is heard: reports go first.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_listens(
    level: *const cotama_level,
    listens: *mut bool,
) -> cotama_error {
    let ask = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, listens) = unsafe {
            let started = pieces.started(level)?;
            let listens = pieces.out(listens)?;
            (started, listens)
        };
        listens.put(started.with(|it| it.listens()));
        Ok(())
    };
    Done::into(ask())
}

/// A round: the supervisors take their turns, and are told one thing: the oldest report, else what
/// the drive shows, else what is said. It is not heard unless the level listens.
///
/// `said` may be null, which says nothing, as do `round` and `firings`, which nobody wants then.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_round(
    level: *mut cotama_level,
    now_ms: u64,
    said: *const cotama_told,
    drive: *const cotama_drive,
    round: *mut cotama_round,
    firings: *mut cotama_firings,
) -> cotama_error {
    let take = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, drive, round, mut notes) = unsafe {
            let started = pieces.started(level)?;
            let round = pieces.wanted(round)?;
            let notes = Notes::new(SAYS, firings, &mut pieces)?;
            (started, pieces.read(drive)?, round, notes)
        };
        let said = if said.is_null() {
            None
        } else {
            // SAFETY: the caller promises the same.
            unsafe { pieces.read(said) }?.read()?
        };
        if said.is_some_and(|it| TABLES.event(it).is_none()) {
            return Err(cotama_error::BadNumber);
        }
        let drive = Drive { at_goal: drive.at_goal != 0, stands: drive.stands != 0 };
        let took = started.with(|it| it.period(Millis(now_ms), said, drive, &mut notes));
        notes.end();
        if let Some(it) = round {
            it.put(cotama_round { restarts: took.restarts, told: took.told.into() });
        }
        Ok(())
    };
    Done::into(take())
}

/// The requests to the robot until the next round.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_requests(
    level: *const cotama_level,
    now_ms: u64,
    requests: *mut cotama_requests,
) -> cotama_error {
    let ask = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, requests) = unsafe {
            let started = pieces.started(level)?;
            let requests = pieces.out(requests)?;
            (started, requests)
        };
        let asked = started.with(|it| it.requests(Millis(now_ms)));
        requests.put(cotama_requests {
            speed_mm_s: asked.speed.0,
            settings: asked.settings,
            configuration: asked.configuration.map_or(COTAMA_NONE, |it| it as u32),
            drive: asked.drive,
            halt: asked.halt,
            ask: asked.ask,
            alarm: asked.alarm,
        });
        Ok(())
    };
    Done::into(ask())
}

/// Stores the supervisors in `COTAMA_LEVEL_STORED_BYTES` bytes with a checksum; `written` may be
/// null.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given; no other thread
/// uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_store(
    level: *const cotama_level,
    bytes: *mut u8,
    room: usize,
    written: *mut usize,
) -> cotama_error {
    let store = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, written, bytes) = unsafe {
            let started = pieces.started(level)?;
            let written = pieces.wanted(written)?;
            (started, written, pieces.list_to_write(bytes, room)?)
        };
        let snapshot = started.with(|it| it.level().snapshot());
        let stored = snapshot.write(bytes).ok_or(cotama_error::TooSmall)?.len();
        if let Some(it) = written {
            it.put(stored);
        }
        Ok(())
    };
    Done::into(store())
}

/// Starts a level at `now_ms` where stored supervisors were. Flags that are still raised, reports
/// that were not told and settings are forgotten: observers tell again what they see.
///
/// `robot` is `COTAMA_ROBOT`.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_restore(
    memory: *mut c_void,
    bytes: usize,
    robot: u64,
    now_ms: u64,
    stored: *const u8,
    length: usize,
    level: *mut *mut cotama_level,
) -> cotama_error {
    let restore = || {
        is_this(robot)?;
        if stored.is_null() {
            return Err(cotama_error::NullPointer);
        }
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (stored, place) =
            unsafe { (pieces.list(stored, length)?, pieces.place(memory, bytes, level)?) };
        let snapshot = Snapshot::read(stored).ok_or(cotama_error::Damaged)?;
        let program: Program = Checked(system::Program);
        let restored = Level::restore(TABLES, program, Millis(now_ms), &snapshot);
        place.start(Decider::new(restored.map_err(|error| match error {
            RestoreError::OtherSystem { .. } => cotama_error::OtherNet,
            _ => cotama_error::Impossible,
        })?));
        Ok(())
    };
    Done::into(restore())
}

/// The names of a net of the level and of one of its transitions, as in a firing.
///
/// # Safety
/// The pointers are null or point to memory for texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_transition_names(
    net: u32,
    transition: u32,
    net_name: *mut cotama_text,
    transition_name: *mut cotama_text,
) -> cotama_error {
    let tell = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (first, second) = unsafe { (pieces.out(net_name)?, pieces.out(transition_name)?) };
        let (net, transition) = TRANSITIONS.of(net, transition)?;
        first.put(net.into());
        second.put(transition.into());
        Ok(())
    };
    Done::into(tell())
}
