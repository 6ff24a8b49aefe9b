//! The fields of a mission under supervisors beyond those of a plain one: what each objective does.

use super::faults::TO_A_ROBOT;
use super::fields::{Fields, Reported};
use crate::missions::definition::Does;
use crate::missions::diagnostic::{Diagnostic, Spanned};

/// Reports `[supervision]`, which missions had before their robots had files; whether it is there.
pub(super) fn refuse(root: &Fields<'_>) -> bool {
    if !root.has("supervision") {
        return false;
    }
    let message = "supervisors are made of the file of a robot";
    let it = Diagnostic::new(root.span_of("supervision"), message, "no longer read");
    root.report(it.help(
        "write `format = \"panorama-mission/2\"` and `robot = \"p3dx-delivery\"`, and leave out \
         [supervision], [robot], [motion_power], [hardware] and the options of `MOV`",
    ));
    true
}

/// Reads what an objective does: a mission under supervisors says it, a plain one does not.
pub(super) fn does(
    fields: &mut Fields<'_>,
    supervised: bool,
) -> Result<Option<Spanned<Does>>, Reported> {
    if !supervised {
        let Some(found) = fields.optional_text("does")? else { return Ok(None) };
        let message = "`does` is for missions under the supervisors of a robot";
        let it = Diagnostic::new(found.span, message, "no supervisors");
        fields.report(it.help(TO_A_ROBOT));
        return Err(Reported);
    }
    let found = fields.text("does").ok_or(Reported)?;
    if let Some(value) = Does::own(&found.value) {
        return Ok(Some(Spanned { value, span: found.span }));
    }
    let index = fields.index_of(&found, "kind of objective", Does::NAMES.into_iter());
    let value = index.and_then(|index| Does::ALL.get(index).copied()).ok_or(Reported)?;
    Ok(Some(Spanned { value, span: found.span }))
}
