//! Reading what a robot computes, watches and suffers in the plane.

use super::Names;
use crate::missions::Diagnostic;
use crate::missions::reader::fields::Fields;
use crate::robots::known::{HARM_UNITS, HARMED, LENGTHENED};
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
pub(super) fn watches(fields: &mut Fields<'_>, flags: usize) -> Option<Vec<Option<Watch>>> {
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
    Some(read.into_iter().map(|it| WATCHES.get(it).map(|it| it.1)).collect())
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
    let is_sonar = matches!(harm, Some(Harm::SonarFar | Harm::SonarNear));
    if !is_sonar && harm.is_some() && matches!(unit, Ok(Some(2_u8..))) {
        let it = Diagnostic::new(fields.span_of("unit"), "there are two sides", "no side");
        fields.report(it.help("write 0 for the left one, or 1 for the right one"));
    }
    fields.finish();
    let harm = harm?;
    let (unit, permille) = (unit.ok()?.unwrap_or(0), permille.ok()?.unwrap_or(500));
    Some(Harmed { harm, unit, permille })
}
