//! Reading what a robot computes, watches and suffers in the plane.

use super::Names;
use crate::missions::Diagnostic;
use crate::missions::reader::fields::Fields;
use crate::robots::known::{HARM_UNITS, HARMED, LENGTHENED};
use crate::robots::sensing::Sensing;
use crate::robots::signals::{HARMS, Harm, Harmed, ROLES, Role, TOLD, WATCHES, Watch};

/// The algorithms of a module.
pub(super) fn roles(fields: &mut Fields<'_>) -> Option<Vec<Role>> {
    let all = fields.optional_texts("roles").ok()?;
    let known = || ROLES.iter().map(|it| it.0);
    let all: Vec<_> = all.iter().map(|it| fields.index_of(it, "role", known())).collect();
    let role = |it: usize| ROLES.get(it).map(|it| it.1);
    all.into_iter().map(|it| it.and_then(role)).collect()
}

/// The signals of the flags of an observer: of none, or of each.
pub(super) fn watches(
    fields: &mut Fields<'_>,
    flags: usize,
    of: &Sensing,
) -> Option<Vec<Option<Watch>>> {
    let all = fields.optional_texts("watches").ok()?;
    let known = || WATCHES.iter().map(|it| it.0).chain([TOLD]);
    let read: Vec<_> = all.iter().map(|it| fields.index_of(it, "signal", known())).collect();
    let read = read.into_iter().collect::<Option<Vec<_>>>()?;
    if !read.is_empty() && read.len() != flags {
        let (flags, signals) = (flags, read.len());
        let message = format!("{flags} flags have {signals} signals");
        let it = Diagnostic::new(fields.span_of("watches"), message, "not one for each");
        fields.report(it.help(format!("write {TOLD:?} for a flag that no signal raises")));
        return None;
    }
    let read = read.into_iter().map(|it| WATCHES.get(it).map(|it| it.1));
    let read: Vec<_> = read.collect();
    for (word, watch) in all.iter().zip(&read) {
        if let Some(device) = watch.and_then(|it| missing(it, of)) {
            let message = format!("no {device} of the robot gives this signal");
            let it = Diagnostic::new(word.span.clone(), message, "no such device");
            fields.report(it.help(DEVICES));
        }
    }
    Some(read)
}

/// The remedy for a device that is not there.
const DEVICES: &str = "`[body]` has the devices: `[[body.laser]]`, from 0 on, `[body.camera]`, \
                       `[body.gyro]`, `sonars`";

/// Returns the device of a signal, if the robot has none such.
fn missing(watch: Watch, of: &Sensing) -> Option<&'static str> {
    let (is_there, device) = match watch {
        Watch::LaserSilent(it) | Watch::LaserBlind(it) | Watch::LaserApart(it) => {
            (usize::from(it.unwrap_or(0)) < of.lasers.len(), "laser")
        }
        Watch::MarksMissing => (of.camera.is_some(), "camera"),
        Watch::GyroSilent | Watch::GyroApart => (of.gyro.is_some(), "gyro"),
        Watch::LargestRange | Watch::ShortestRange | Watch::NoRanges => (!of.no_sonars, "sonar"),
        _ => (true, ""),
    };
    (!is_there).then_some(device)
}

/// The harm of a failure, if it has one; where the failure is one of each of some modules, that of
/// a module names none.
///
/// # Errors
/// None to tell: they are reported.
pub(super) fn harm(
    fields: &mut Fields<'_>,
    names: &Names,
    has_each: bool,
) -> Result<Option<Harmed>, ()> {
    let Some(fields) = fields.optional_table("harm").map_err(|_| ())? else { return Ok(None) };
    harmed(fields, names, has_each).map(Some).ok_or(())
}

/// Returns the harm of a failure of a module among several.
pub(super) fn harm_of(it: Harmed, module: usize) -> Harmed {
    let unit =
        if it.harm.is_of_module() { u8::try_from(module).unwrap_or(it.unit) } else { it.unit };
    Harmed { unit, ..it }
}

fn harmed(mut fields: Fields<'_>, names: &Names, has_each: bool) -> Option<Harmed> {
    let harm = fields.text("is");
    let harm = harm.and_then(|it| fields.index_of(&it, "harm", HARMS.iter().map(|it| it.0)));
    let harm = harm.and_then(|it| HARMS.get(it)).map(|it| it.1);
    let parts = if harm.is_some_and(Harm::lengthens) { LENGTHENED } else { HARMED };
    let permille = fields.optional_integer("permille", parts);
    if harm.is_some_and(Harm::is_of_module) {
        let known = || names.modules.iter().map(String::as_str);
        let module = if has_each {
            Some(0) // each names its own
        } else {
            fields.text("module").and_then(|it| fields.index_of(&it, "module", known()))
        };
        fields.finish();
        let unit = u8::try_from(module?).ok()?;
        return Some(Harmed { harm: harm?, unit, permille: permille.ok()?.unwrap_or(500) });
    }
    let unit = fields.optional_integer("unit", HARM_UNITS);
    let of = &names.sensing;
    let is_numbered = matches!(harm, Some(Harm::SonarFar | Harm::SonarNear));
    let is_of_laser = harm.is_some_and(Harm::is_of_laser);
    let number = unit.as_ref().ok().copied().flatten().unwrap_or(0);
    let (lasers, has_marks) = (of.lasers.len(), of.camera.is_some());
    let is_there = match harm {
        Some(Harm::MarksCovered) => has_marks,
        Some(Harm::GyroDead | Harm::GyroDrift) => of.gyro.is_some(),
        Some(it) if it.is_of_laser() => usize::from(number) < lasers,
        _ => true,
    };
    if !is_there {
        let key = if is_of_laser && lasers > 0 { "unit" } else { "is" };
        let message = "the robot has no such device";
        let it = Diagnostic::new(fields.span_of(key), message, "not in `[body]`");
        fields.report(it.help(DEVICES));
    }
    if !is_numbered && !is_of_laser && harm.is_some() && matches!(unit, Ok(Some(2_u8..))) {
        let it = Diagnostic::new(fields.span_of("unit"), "there are two sides", "no side");
        fields.report(it.help("write 0 for the left one, or 1 for the right one"));
    }
    fields.finish();
    let harm = harm?;
    let (unit, permille) = (unit.ok()?.unwrap_or(0), permille.ok()?.unwrap_or(500));
    Some(Harmed { harm, unit, permille })
}
