//! The decisional level of the delivery robot: flags in, a round in each period, requests out.

use crate::error::{Done, cotama_error};
use crate::firings::{COTAMA_NONE, Notes, cotama_firings, cotama_text};
use crate::memory::{Handle, Kept, Pieces};
use crate::names::{configuration_of, word_of};
use crate::plans::{Planning, cotama_plans};
use core::ffi::c_void;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, DeliveryDecider, Diagnosis, FailureModes, Finding, Flags, Modules, Perceived, delivery,
};
use cotama_models::missions::tables::delivery::ACTIVITIES;

/// The decisional level, in the caller's memory: supervisors, diagnosis and decisions.
pub struct cotama_level {
    _memory: [u8; 0],
}

impl Handle for cotama_level {
    type Value = DeliveryDecider;
    const BYTES: usize = COTAMA_LEVEL_BYTES;
    const MARK: u64 = 0x0000_006c_6576_656c; // "level"
}

/// The bytes of a `cotama_level`, at an address that is a multiple of 8.
pub const COTAMA_LEVEL_BYTES: usize = 960;
const _: () = assert!(Kept::<DeliveryDecider>::fits(COTAMA_LEVEL_BYTES, 8));

crate::tables! { delivery::SYSTEM }

/// Each activity of the mission is an objective.
///
/// cbindgen:ignore
const OBJECTIVES: u32 = ACTIVITIES.len() as u32;

/// The news of observers and the scheduler in a period.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_perceived {
    /// Flags that are raised now: bit `n` is `cotama_flag` `n`.
    pub raised: u64,
    /// Flags that were raised and have gone back.
    pub lowered: u64,
    /// The module that raised flags are about, where they are about one whichever it is: bit `n` is
    /// `cotama_module` `n`.
    pub part: u32,
    /// The modules that say that they work, in use or not.
    pub works: u32,
}

/// The diagnosis of raised flags.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct cotama_finding {
    /// The flags raised.
    pub flags: u64,
    /// The rows of the FMECA that explain it, bit `n` for mode `n`: one where the diagnosis is
    /// unique, none where nothing explains it.
    pub modes: u64,
    /// Number of the finding, from 1 on; 0 where nothing was found.
    pub number: u32,
    /// A part of it at least is recorded only, and nobody has to decide.
    pub recorded: bool,
}

impl From<Option<Finding>> for cotama_finding {
    fn from(found: Option<Finding>) -> Self {
        found.map_or(Self::default(), |it| Self {
            flags: it.flags.bits(),
            modes: match it.diagnosis {
                Diagnosis::None | Diagnosis::Unexplained => 0,
                Diagnosis::Unique(mode) => FailureModes::of(&[mode]).bits(),
                Diagnosis::Ambiguous(modes) => modes.bits(),
            },
            number: u32::from(it.cause.0),
            recorded: it.recorded,
        })
    }
}

/// State of the drive: 0 says no, any other number yes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_body {
    /// The goal of the drive is reached.
    pub at_goal: u8,
    /// The robot does not move.
    pub stands: u8,
}

/// The outcome of a round.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_round {
    /// The finding about the silence of the operator.
    pub finding: cotama_finding,
    /// The net that was told something, else `COTAMA_NONE`;
    pub net: u32,
    /// and the event of that net.
    pub event: u32,
}

/// The requests to the robot until the next round.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_requests {
    /// The fastest it may go, mm/s.
    pub speed_mm_s: u64,
    /// The modules that are to run, a `cotama_configuration`; `COTAMA_NONE` where nothing does.
    pub configuration: u32,
    /// Factor that adapted settings leave of the speed, in thousandths,
    pub speed_permille: u16,
    /// and of the quality of what is driven.
    pub quality_permille: u16,
    /// Motion may be commanded.
    pub drive: bool,
    /// Motor power is to be cut for good.
    pub halt: bool,
    /// The operator is asked.
    pub ask: bool,
    /// The mission was given up and the robot stands: alarm.
    pub alarm: bool,
}

/// Starts the level of a robot at rest, all of which works, in `bytes` bytes of memory, which are
/// its from now on.
///
/// `planned` is the `cotama_configuration` of the first drive by the plan, or `COTAMA_NONE`. In a
/// callback the level that is in use cannot be started anew: `COTAMA_ERROR_BUSY`. So the first
/// eight bytes of memory are looked at: set them to 0 before the first start, and after a reset
/// that has kept them.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_start(
    memory: *mut c_void,
    bytes: usize,
    planned: u32,
    level: *mut *mut cotama_level,
) -> cotama_error {
    let planned = match (planned, configuration_of(planned)) {
        (COTAMA_NONE, _) => None,
        (_, Some(it)) => Some(it),
        (_, None) => return cotama_error::BadNumber,
    };
    let start = || {
        // SAFETY: the caller promises the same.
        let place = unsafe { Pieces::new().place(memory, bytes, level)?.unless_in_use() }?;
        place.start(DeliveryDecider::start(delivery::Program, OBJECTIVES, planned));
        Ok(())
    };
    Done::into(start())
}

/// Observers tell what they see. At most one finding comes of it.
///
/// `plans` is how the mission is planned, and may be null: then each drive uses the best that
/// works. `finding` may be null.
///
/// # Safety
/// The pointers are null or point to what their types say; the functions of `plans` may be called
/// with its context; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_perceive(
    level: *mut cotama_level,
    now_ms: u64,
    seen: *const cotama_perceived,
    plans: *const cotama_plans,
    finding: *mut cotama_finding,
) -> cotama_error {
    let perceive = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, seen, mut plans, finding) = unsafe {
            let started = pieces.started(level)?;
            let finding = pieces.wanted(finding)?;
            (started, pieces.read(seen)?, Planning::of(plans, &mut pieces)?, finding)
        };
        let flags = |it| Flags::from_bits(it).ok_or(cotama_error::BadNumber);
        let modules = |it| Modules::from_bits(it).ok_or(cotama_error::BadNumber);
        let seen = Perceived {
            raised: flags(seen.raised)?,
            lowered: flags(seen.lowered)?,
            part: modules(seen.part)?,
            works: modules(seen.works)?,
        };
        let found = started.with(|it| it.perceive(Millis(now_ms), seen, &mut plans));
        if let Some(it) = finding {
            it.put(found.into());
        }
        Ok(())
    };
    Done::into(perceive())
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
/// the body shows, else `word`, a `cotama_word`. It is not heard unless the level listens.
///
/// `round` and `firings` may be null.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the level.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_round(
    level: *mut cotama_level,
    now_ms: u64,
    word: u32,
    body: *const cotama_body,
    round: *mut cotama_round,
    firings: *mut cotama_firings,
) -> cotama_error {
    let take = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let (started, body, round, mut notes) = unsafe {
            let started = pieces.started(level)?;
            let round = pieces.wanted(round)?;
            let notes = Notes::new(SAYS, firings, &mut pieces)?;
            (started, pieces.read(body)?, round, notes)
        };
        let said = word_of(word)?;
        let body = Body { at_goal: body.at_goal != 0, stands: body.stands != 0 };
        let took = started.with(|it| it.round(Millis(now_ms), said, body, &mut notes));
        notes.end();
        let told = took.told.map(|it| it.event());
        let (net, event) = told.map_or((COTAMA_NONE, 0), |it| (u32::from(it.component), it.id.0));
        let took = cotama_round { finding: took.finding.into(), net, event };
        if let Some(it) = round {
            it.put(took);
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
        let asked = started.with(|it| it.requests());
        requests.put(cotama_requests {
            speed_mm_s: asked.speed.0,
            configuration: asked.configuration.map_or(COTAMA_NONE, |it| it as u32),
            speed_permille: asked.adjusted.speed,
            quality_permille: asked.adjusted.quality,
            drive: asked.drive,
            halt: asked.halt,
            ask: asked.ask,
            alarm: asked.alarm,
        });
        Ok(())
    };
    Done::into(ask())
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
    let names = TRANSITIONS.of(net, transition);
    // SAFETY: the caller promises the same.
    unsafe { tell(names, net_name, transition_name) }.into()
}

/// The names of a net of the level and of one of its events, as in a round.
///
/// # Safety
/// The pointers are null or point to memory for texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_level_event_names(
    net: u32,
    event: u32,
    net_name: *mut cotama_text,
    event_name: *mut cotama_text,
) -> cotama_error {
    let names = EVENTS.of(net, event);
    // SAFETY: the caller promises the same.
    unsafe { tell(names, net_name, event_name) }.into()
}

/// Puts two names where C wants them.
///
/// # Safety
/// The pointers are null or point to memory for texts.
unsafe fn tell(
    names: Result<(&'static str, &'static str), cotama_error>,
    first: *mut cotama_text,
    second: *mut cotama_text,
) -> Done {
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let (first, second) = unsafe { (pieces.out(first)?, pieces.out(second)?) };
    let (one, other) = names?;
    first.put(one.into());
    second.put(other.into());
    Ok(())
}
