//! Names of the robot's parts, by the numbers of `cotama_robot.h`.

use crate::error::{Done, cotama_error};
use crate::firings::cotama_text;
use crate::memory::Pieces;
use crate::robot::names::{
    CONFIGURATIONS, FAILURES, FLAGS, LOSSES, MODULES, REPORTS, SUB_OBJECTIVES,
};

/// Puts the name of a number where C wants it.
///
/// # Safety
/// The pointer is null or points to memory for a text.
unsafe fn tell(names: &[&'static str], number: u32, to: *mut cotama_text) -> Done {
    // SAFETY: the caller promises the same.
    let to = unsafe { Pieces::new().out(to) }?;
    let name = names.get(number as usize).copied().ok_or(cotama_error::BadNumber)?;
    to.put(name.into());
    Ok(())
}

/// The name of a `COTAMA_FLAG_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_flag_name(flag: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&FLAGS, flag, name) }.into()
}

/// The name of a `COTAMA_MODULE_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_module_name(module: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&MODULES, module, name) }.into()
}

/// The name of a `COTAMA_SUB_OBJECTIVE_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_sub_objective_name(
    sub_objective: u32,
    name: *mut cotama_text,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&SUB_OBJECTIVES, sub_objective, name) }.into()
}

/// The name of a `COTAMA_CONFIGURATION_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_configuration_name(
    configuration: u32,
    name: *mut cotama_text,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&CONFIGURATIONS, configuration, name) }.into()
}

/// The name of a `COTAMA_FAILURE_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_failure_name(failure: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&FAILURES, failure, name) }.into()
}

/// The name of a `COTAMA_REPORT_...` in print: that of its first failure.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_report_name(report: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&REPORTS, report, name) }.into()
}

/// The name of a `COTAMA_LOSS_...` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_loss_name(loss: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(&LOSSES, loss, name) }.into()
}
