//! Reading what a robot of a team can do, how reliable that is said to be, and how often it fails.

use super::{Names, PERMILLE};
use crate::missions::reader::fields::{Fields, TextOrTable};
use crate::missions::{Diagnostic, Spanned};
use crate::names::quoted;
use crate::team::scenario::FailureRates;
use crate::team::{Capability, Reliability, Skill};
use std::ops::RangeInclusive;

/// Counts of uses.
const USES: RangeInclusive<i64> = 0..=u32::MAX as i64;

/// The capability of a name, which is new or known.
pub(super) fn skill(
    fields: &Fields<'_>,
    name: &Spanned<String>,
    names: &mut Names,
) -> Option<Capability> {
    let known = names.skills.iter().position(|it| *it == name.value);
    let number = known.unwrap_or(names.skills.len());
    let capability = u8::try_from(number).ok().and_then(Capability::new);
    if name.value.is_empty() || name.value.contains(['|', ' ']) {
        let message = format!("{} is no name of a skill", quoted(&name.value));
        let help = "use a name without blanks and `|`";
        fields.report(Diagnostic::new(name.span.clone(), message, "no name").help(help));
        return None;
    }
    if capability.is_none() {
        let message = format!("there are more than {} skills", Capability::COUNT);
        fields.report(Diagnostic::new(name.span.clone(), message, "one too many"));
    } else if known.is_none() {
        names.skills.push(name.value.clone());
    }
    capability
}

/// The skills of a robot, with how often their uses fail.
pub(super) fn skills(
    fields: &mut Fields<'_>,
    names: &mut Names,
) -> Option<(Vec<Skill>, FailureRates)> {
    let entries = fields.optional_texts_and_tables("skills").ok()?;
    let read = |it| match it {
        TextOrTable::Text(text) => Some((stated(fields, &text, names)?, 0)),
        TextOrTable::Table(table) => described(table, names),
    };
    let all: Vec<_> = entries.into_iter().map(read).collect();
    let all: Vec<(Skill, u16)> = all.into_iter().collect::<Option<_>>()?;
    // Where a skill is named twice, the first one counts.
    let rates = all.iter().rev();
    let rates = rates.fold(FailureRates::NONE, |all, it| all.with(it.0.capability, it.1));
    Some((all.into_iter().map(|it| it.0).collect(), rates))
}

/// A skill and its reliability: `grasp`, `grasp 950/1000`, `grasp 19+1` (19 uses succeeded, one
/// failed).
fn stated(fields: &Fields<'_>, text: &Spanned<String>, names: &mut Names) -> Option<Skill> {
    let (name, reliability) = match text.value.split_once(' ') {
        None => (text.value.as_str(), Some(Reliability::CERTAIN)),
        Some((name, how)) => (name, reliability(how.trim())),
    };
    let Some(reliability) = reliability else {
        let message = format!("{} says no reliability", quoted(&text.value));
        let help = "write `grasp 950/1000` for a probability, `grasp 19+1` for 19 uses that \
                    succeeded and one that failed";
        fields.report(Diagnostic::new(text.span.clone(), message, "not a skill").help(help));
        return None;
    };
    let name = Spanned { value: name.to_owned(), span: text.span.clone() };
    let capability = skill(fields, &name, names)?;
    Some(Skill { capability, reliability })
}

fn reliability(text: &str) -> Option<Reliability> {
    if let Some(parts) = text.strip_suffix("/1000") {
        return parts.parse().ok().filter(|it| *it <= 1_000).map(Reliability::Permille);
    }
    let (succeeded, failed) = text.split_once('+')?;
    Some(Reliability::Uses { succeeded: succeeded.parse().ok()?, failed: failed.parse().ok()? })
}

/// A skill as a table: its `name`, what is known of it (`permille`, or `succeeded` and `failed`),
/// and how often a use fails (`fails_permille`).
fn described(mut table: Fields<'_>, names: &mut Names) -> Option<(Skill, u16)> {
    let name = table.text("name");
    let capability = name.and_then(|it| skill(&table, &it, names));
    let (stated, counted) = (table.has("permille"), table.has("succeeded") || table.has("failed"));
    if stated && counted {
        let message = "a reliability is stated, or counted";
        let help = "leave out `permille`, or `succeeded` and `failed`";
        let span = table.span_of("permille");
        table.report(Diagnostic::new(span, message, "both").help(help));
    }
    let permille = table.optional_integer("permille", PERMILLE);
    let succeeded = table.optional_integer("succeeded", USES);
    let failed = table.optional_integer("failed", USES);
    let fails = table.optional_integer("fails_permille", PERMILLE);
    table.finish();
    let (permille, succeeded, failed) = (permille.ok()?, succeeded.ok()?, failed.ok()?);
    let reliability = match permille {
        Some(it) => Reliability::Permille(it),
        None if counted => {
            Reliability::Uses { succeeded: succeeded.unwrap_or(0), failed: failed.unwrap_or(0) }
        }
        None => Reliability::CERTAIN,
    };
    Some((Skill { capability: capability?, reliability }, fails.ok()?.unwrap_or(0)))
}
