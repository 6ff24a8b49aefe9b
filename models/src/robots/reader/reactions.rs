//! Reading what is tried first, what masks flags, and in which order.

use super::Names;
use crate::missions::reader::fields::{Fields, Reported};
use crate::missions::{Diagnostic, Spanned};
use crate::names::quoted;
use crate::robots::known::{ASKS, MASKS, TIMES, TRIES};
use crate::robots::{Mask, Try};
use cotama_core::units::Millis;

/// Reads how often the operator is asked before anything is decided.
pub(super) fn asks(fields: &mut Fields<'_>) -> Result<Option<u8>, Reported> {
    let Some(mut it) = fields.optional_table("ask")? else { return Ok(None) };
    let times = it.integer("times", ASKS);
    it.finish();
    times.map(Some).ok_or(Reported)
}

/// Reads the flags of a row that are masked once it is told, if any are; `own` are those of the
/// row.
pub(super) fn masks(
    fields: &mut Fields<'_>,
    names: &Names,
    own: &[usize],
) -> Result<Option<Mask>, Reported> {
    let Some(mut it) = fields.optional_table("mask")? else { return Ok(None) };
    let flags = it.texts("flags");
    let lasts = it.optional_integer("lasts_ms", TIMES);
    let on = it.optional_text("on")?;
    let on = on.map(|name| it.index_of(&name, "occasion", MASKS.into_iter()).ok_or(Reported));
    let on_order = on.transpose()?.is_some_and(|at| MASKS.get(at) == Some(&"order"));
    let flags: Option<Vec<_>> =
        flags.and_then(|all| all.iter().map(|name| flag(&it, name, names, own)).collect());
    it.finish();
    let lasts = lasts?.map(Millis);
    flags.map(|flags| Some(Mask { flags, lasts, on_order })).ok_or(Reported)
}

/// A flag of the row by its name.
fn flag(
    fields: &Fields<'_>,
    name: &Spanned<String>,
    names: &Names,
    own: &[usize],
) -> Option<usize> {
    let flag = fields.index_of(name, "flag", names.flags.iter().map(String::as_str))?;
    if !own.contains(&flag) {
        let message = format!("{} is no flag of this failure", quoted(&name.value));
        let it = Diagnostic::new(name.span.clone(), message, "of another one");
        fields.report(it.help("a failure masks what it holds up itself: name one of its flags"));
    }
    Some(flag)
}

/// Reads the order of what is tried: that of the known ones where the file says none.
pub(super) fn order(fields: &mut Fields<'_>, tried: &[Try]) -> Option<Vec<Try>> {
    let usual = || TRIES.iter().map(|it| it.1).filter(|it| tried.contains(it));
    fields.knows("order");
    if !fields.has("order") {
        return Some(usual().collect());
    }
    let all = fields.texts("order")?;
    let known = || TRIES.iter().map(|it| it.0);
    let order: Option<Vec<_>> = all
        .iter()
        .map(|name| TRIES.get(fields.index_of(name, "reaction", known())?).map(|it| it.1))
        .collect();
    let order = order?;
    let is_each_once = order.len() == tried.len() && usual().all(|it| order.contains(&it));
    if !is_each_once {
        let of = |it: &Try| TRIES.iter().find(|known| known.1 == *it).map_or("", |it| it.0);
        let tried: Vec<_> = usual().map(|it| quoted(of(&it))).collect();
        let what = if tried.is_empty() { "nothing".to_owned() } else { tried.join(", ") };
        let message = format!("this failure tries {what}, and `order` says otherwise");
        let it = Diagnostic::new(fields.span_of("order"), message, "not each of them once");
        fields.report(it.help("name each reaction once; `set` is tried where it has `times`"));
    }
    Some(order)
}
