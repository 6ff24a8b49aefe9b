//! Reading the incidents of a script: failures, repairs, and what the operator answers.

use super::entry::Names;
use super::fields::{Fields, Reported};
use super::moments;
use crate::cotama::{FailureMode, Module};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::faults::{Answer, IncidentKind};
use crate::missions::known::{AT_LEAST_ZERO, INCIDENTS};
use cotama_core::units::Millis;

/// Whether an event of this kind is an incident: `repair` is one when it names a failure mode, and
/// else about hardware.
pub(super) fn is_incident(fields: &Fields<'_>, kind: &str) -> bool {
    INCIDENTS.contains(&kind) || (kind == "repair" && fields.has("mode"))
}

/// Whether an event says a time or what the supervisors do, not a place of the path.
pub(super) fn is_timed(fields: &Fields<'_>) -> bool {
    ["t_ms", "during", "fired"].into_iter().any(|key| fields.has(key))
}

/// The module of a failure of one module, if it is named.
fn part(fields: &mut Fields<'_>, mode: FailureMode) -> Result<Option<Module>, Reported> {
    let Some(name) = fields.optional_text("module")? else { return Ok(None) };
    let names = Module::ALL.iter().map(|it| it.name());
    fields.index_of(&name, "module", names).ok_or(Reported)?;
    if !mode.rule().one_module {
        let message = format!("{} is no failure of one module, whichever it is", mode.name());
        let help = "leave `module` out: the row of the FMECA says what fails";
        fields.report(Diagnostic::new(name.span, message, "not one module").help(help));
        return Err(Reported);
    }
    Ok(Module::named(&name.value))
}

/// Reads what is left of an incident of this kind.
pub(super) fn incident(
    fields: &mut Fields<'_>,
    kind: &str,
    names: &Names<'_>,
) -> Option<IncidentKind> {
    if names.supervised == Some(false) {
        let message = format!("events of the kind `{kind}` are for missions that are supervised");
        let help = "leave it out, or add [supervision] with decides = \"cotama\"";
        fields
            .report(Diagnostic::new(fields.span_of("kind"), message, "not supervised").help(help));
    }
    if kind != "operator" {
        let mode = fields.text("mode")?;
        fields.index_of(&mode, "failure mode", FailureMode::ALL.iter().map(|it| it.name()))?;
        let mode = FailureMode::named(&mode.value)?;
        if kind == "repair" {
            return Some(IncidentKind::Repair(mode));
        }
        let part = part(fields, mode);
        let until = moments::end(fields, names);
        return Some(IncidentKind::Failure { mode, part: part.ok()?, until: until.ok()? });
    }
    let delay = fields.integer("delay_ms", AT_LEAST_ZERO).map(Millis);
    let found = fields.texts("answers");
    let answers = found.and_then(|found| {
        let known = found.iter().map(|name| {
            let index = fields.index_of(name, "answer", Answer::NAMES.into_iter())?;
            Answer::ALL.get(index).copied()
        });
        let answers = known.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?;
        (follow(fields, &answers, &found) & can(fields, &answers, &found, names)).then_some(answers)
    });
    Some(IncidentKind::Operator { answers: answers?, delay: delay? })
}

/// Whether each answer can follow the one before, and the last one ends it; reports it if not.
fn follow(fields: &Fields<'_>, answers: &[Answer], names: &[Spanned<String>]) -> bool {
    let said = |answers: &[Answer]| {
        let names: Vec<_> = answers.iter().map(|answer| format!("`{}`", answer.name())).collect();
        names.join(", ")
    };
    let (mut possible, mut before) = (Answer::FIRST, "a request".to_owned());
    for (answer, name) in answers.iter().zip(names) {
        if !possible.contains(answer) {
            let message = format!("after {before} the operator cannot answer `{}`", answer.name());
            let help = if possible.is_empty() {
                "leave it out: the robot asks again when it needs him again".to_owned()
            } else {
                format!("possible: {}", said(possible))
            };
            fields.report(Diagnostic::new(name.span.clone(), message, "not possible").help(help));
            return false;
        }
        (possible, before) = (answer.next(), format!("`{}`", answer.name()));
    }
    if !possible.is_empty() {
        let message =
            format!("the operator's answers end with {before}, and the robot would wait for ever");
        let help = format!("add one of: {}", said(possible));
        fields
            .report(Diagnostic::new(fields.span_of("answers"), message, "not the end").help(help));
    }
    possible.is_empty()
}

/// Whether the robot has the modules for the answers; reports it if not.
fn can(
    fields: &Fields<'_>,
    answers: &[Answer],
    found: &[Spanned<String>],
    names: &Names<'_>,
) -> bool {
    if names.hardware.iter().any(|kind| kind.id.is_empty()) {
        return true;
    }
    let mut can = true;
    for (answer, name) in answers.iter().zip(found) {
        let Some(configuration) = answer.needs() else { continue };
        let has = |module: &Module| names.hardware.iter().any(|kind| kind.id == module.name());
        if let Some(lacking) = configuration.facts().required.iter().find(|module| !has(module)) {
            let (id, lacking) = (configuration.name(), lacking.name());
            let message = format!(
                "the operator cannot `{}`: `{id}` runs the module {lacking}, which the robot does \
                 not have",
                answer.name()
            );
            let help = format!("add [hardware.{lacking}], or another answer");
            fields.report(Diagnostic::new(name.span.clone(), message, "not possible").help(help));
            can = false;
        }
    }
    can
}
