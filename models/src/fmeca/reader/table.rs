//! The tables of a TOML file beside its rows.

use super::row::{self, checked, words};
use crate::fmeca::analysis::Flag;
use crate::missions::Spanned;
use crate::missions::reader::fields::{Fields, Reported};

/// A probe whose failure modes are not looked up yet.
pub(super) struct ProbeDraft {
    pub(super) name: Spanned<String>,
    pub(super) doc: String,
    pub(super) shows: Vec<Spanned<String>>,
}

/// A name in one line; in lists it stands between `;`.
fn name(fields: &mut Fields<'_>) -> Option<Spanned<String>> {
    let found = fields.text("name")?;
    let span = found.span.clone();
    let value = row::name(|it| fields.report(it), "name", found)?;
    Some(Spanned { value, span })
}

/// Words that may be left out.
fn doc(fields: &mut Fields<'_>, key: &'static str) -> Result<String, Reported> {
    match fields.optional_text(key)? {
        None => Ok(String::new()),
        Some(text) if words(&text.value).is_empty() => Ok(String::new()),
        Some(text) => checked(|it| fields.report(it), key, text).ok_or(Reported),
    }
}

pub(super) fn flag(mut fields: Fields<'_>) -> Option<(Spanned<String>, Flag)> {
    let name = name(&mut fields);
    let words = doc(&mut fields, "doc");
    let observer = doc(&mut fields, "observer");
    fields.finish();
    let name = name?;
    let flag = Flag { name: name.value.clone(), doc: words.ok()?, observer: observer.ok()? };
    Some((name, flag))
}

pub(super) fn probe(mut fields: Fields<'_>) -> Option<ProbeDraft> {
    let name = name(&mut fields);
    let doc = doc(&mut fields, "doc");
    let shows = fields.texts("shows");
    fields.finish();
    Some(ProbeDraft { name: name?, doc: doc.ok()?, shows: shows? })
}
