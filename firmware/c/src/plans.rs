//! The mission's plan, made by C: functions that the decisional level calls while it perceives.

use crate::error::cotama_error;
use crate::firings::COTAMA_NONE;
use crate::memory::Pieces;
use crate::names::configuration_of;
use core::ffi::c_void;
use cotama_models::cotama::{Configuration, Modules, NoPlanLeft, Plans, Why};

/// Why a plan is needed.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_why {
    /// Modules are lost: `detail` is their set.
    Lost = 0,
    /// Modules have returned: `detail` is their set.
    Returned = 1,
    /// The margin of an axis is below zero: `detail` is the axis.
    Margin = 2,
}

/// The outcome of a plan that was asked for.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_replanned {
    /// There is a plan, and the one in force had to be looked at.
    Planned = 0,
    /// The plan in force was not touched by it.
    NotTouched = 1,
    /// No plan is left that keeps the limits; the one in force stays.
    NoPlanLeft = 2,
}

/// The plan of a mission: which configuration each drive uses. Where a function is null, the
/// mission has no limits and each drive uses the best that works.
///
/// The functions are called while the level perceives, and may not use that level, nor start it
/// anew: it answers `COTAMA_ERROR_BUSY`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cotama_plans {
    /// Handed to the functions.
    pub context: *mut c_void,
    /// Whether nothing is left to be planned: 0 no, any other number yes.
    pub is_over: Option<unsafe extern "C" fn(context: *mut c_void) -> u8>,
    /// Plans what is left with these modules, because of a `cotama_why`; answers with a
    /// `cotama_replanned`, and any other number says that no plan is left.
    pub plan: Option<
        unsafe extern "C" fn(context: *mut c_void, why: u32, detail: u32, available: u32) -> u32,
    >,
    /// The `cotama_configuration` that is planned for the drive under way or the next one, or
    /// `COTAMA_NONE`.
    pub configuration: Option<unsafe extern "C" fn(context: *mut c_void) -> u32>,
    /// The axis on which the drive under way no longer keeps its limit, or `COTAMA_NONE`.
    pub short_axis: Option<unsafe extern "C" fn(context: *mut c_void) -> u32>,
}

/// The plan in terms of the level.
pub(crate) struct Planning(Option<cotama_plans>);

impl Planning {
    /// # Safety
    /// `plans` is null or points to such a value, whose functions may be called with its context.
    pub(crate) unsafe fn of(
        plans: *const cotama_plans,
        pieces: &mut Pieces,
    ) -> Result<Self, cotama_error> {
        if plans.is_null() {
            return Ok(Self(None));
        }
        // SAFETY: it is promised that such a value is there.
        unsafe { pieces.read(plans) }.map(|it| Self(Some(it)))
    }
}

impl Plans for Planning {
    fn is_over(&self) -> bool {
        let Some(plans) = self.0 else { return false };
        // SAFETY: it is promised that the function may be called so.
        plans.is_over.is_some_and(|ask| unsafe { ask(plans.context) } != 0)
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        let (why, detail) = match why {
            Why::Lost { modules, .. } => (cotama_why::Lost, modules.bits()),
            Why::Returned { modules, .. } => (cotama_why::Returned, modules.bits()),
            Why::Margin(axis) => (cotama_why::Margin, axis as u32),
        };
        let Some(plans) = self.0 else { return Ok(false) };
        let Some(plan) = plans.plan else { return Ok(false) };
        // SAFETY: it is promised that the function may be called so.
        match unsafe { plan(plans.context, why as u32, detail, available.bits()) } {
            0 => Ok(true),
            1 => Ok(false),
            _ => Err(NoPlanLeft),
        }
    }

    fn configuration(&self) -> Option<Configuration> {
        let plans = self.0?;
        // SAFETY: it is promised that the function may be called so.
        configuration_of(plans.configuration.map(|ask| unsafe { ask(plans.context) })?)
    }

    fn short(&self) -> Option<usize> {
        let plans = self.0?;
        // SAFETY: it is promised that the function may be called so.
        let axis = plans.short_axis.map(|ask| unsafe { ask(plans.context) })?;
        (axis != COTAMA_NONE).then_some(axis as usize)
    }
}
