//! The fields of a supervised mission beyond those of a plain one: its supervision, the kind of
//! each objective, and the modules of each moving option.

use super::entry::Entry;
use super::fields::{Fields, Reported};
use crate::cotama::{Configuration, Module};
use crate::missions::definition::{Does, Hardware, Supervision, Task};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::configurations;
use cotama_core::hardware::Equipment;

/// Whether the mission is supervised, and by supervisors that use again what returns, as far as it
/// could be read.
pub(super) struct Supervised(Result<Option<(Supervision, bool)>, Reported>, bool);

impl Supervised {
    /// Supervision by those of a robot that has a file of its own.
    pub(super) const fn by_robot() -> Self {
        Self(Ok(None), true)
    }

    /// Returns whether the supervisors are those of a robot's file.
    pub(super) const fn is_by_robot(&self) -> bool {
        self.1
    }

    /// Returns whether the mission is supervised; `None` when that could not be read.
    pub(super) fn known(&self) -> Option<bool> {
        self.0.as_ref().ok().map(|it| it.is_some() || self.1)
    }

    /// Returns the supervision, if any, and whether modules that return are used again.
    pub(super) fn get(self) -> Result<Option<(Supervision, bool)>, Reported> {
        self.0
    }
}

/// Reads `[supervision]`.
pub(super) fn read(root: &mut Fields<'_>) -> Supervised {
    let found = root.optional_table("supervision").and_then(|table| {
        let Some(mut table) = table else { return Ok(None) };
        let found = table.choice("decides", "supervision", &Supervision::NAMES);
        let recovery = table.optional_flag("recovery");
        table.finish();
        let recovery = recovery?.unwrap_or(false);
        found.map(|_| Some((Supervision::Cotama, recovery))).ok_or(Reported)
    });
    Supervised(found, false)
}

/// A key that belongs to supervised missions, there and only there.
fn supervised_text(
    fields: &mut Fields<'_>,
    key: &'static str,
    needed: Option<bool>,
) -> Result<Option<Spanned<String>>, Reported> {
    if needed == Some(true) {
        return fields.text(key).map(Some).ok_or(Reported);
    }
    let found = fields.optional_text(key)?;
    match (needed, found) {
        (Some(_), Some(found)) => {
            let message = format!("`{key}` is for missions that are supervised");
            let help = "leave it out, or add [supervision] with decides = \"cotama\"";
            fields.report(Diagnostic::new(found.span, message, "not supervised").help(help));
            Err(Reported)
        }
        (_, found) => Ok(found),
    }
}

/// Reads what an objective does.
pub(super) fn does(
    fields: &mut Fields<'_>,
    supervised: &Supervised,
) -> Result<Option<Spanned<Does>>, Reported> {
    let Some(found) = supervised_text(fields, "does", supervised.known())? else { return Ok(None) };
    if let Some(value) = Does::own(&found.value).filter(|_| supervised.is_by_robot()) {
        return Ok(Some(Spanned { value, span: found.span }));
    }
    let index = fields.index_of(&found, "kind of objective", Does::NAMES.into_iter());
    let value = index.and_then(|index| Does::ALL.get(index).copied()).ok_or(Reported)?;
    Ok(Some(Spanned { value, span: found.span }))
}

/// Reads the configuration of an option, and checks that the option needs its modules.
pub(super) fn configuration(
    fields: &mut Fields<'_>,
    supervised: &Supervised,
    task: Option<Task>,
    hardware: &[Entry<Hardware>],
    needs: Option<Equipment>,
) -> Result<Option<Configuration>, Reported> {
    if supervised.is_by_robot() || !matches!(task, None | Some(Task::Move)) {
        // Only moving options have one: elsewhere it is an unknown key.
        return Ok(None);
    }
    let needed = supervised.known().filter(|supervised| task.is_some() || !supervised);
    let Some(found) = supervised_text(fields, "configuration", needed)? else { return Ok(None) };
    let names = configurations().map(Configuration::name);
    let index = fields.index_of(&found, "configuration", names).ok_or(Reported)?;
    let configuration = configurations().nth(index).ok_or(Reported)?;
    for module in configuration.facts().required.iter().map(Module::name) {
        let kind = hardware.iter().position(|it| it.id == module);
        let (message, help) = match kind {
            None if hardware.iter().any(|it| it.id.is_empty()) => continue,
            None => (
                format!(
                    "`{}` runs the module {module}, which the robot does not have",
                    configuration.name()
                ),
                format!("add [hardware.{module}], or leave this option out"),
            ),
            Some(kind) if needs.is_some_and(|needs| needs.of(kind) == 0) => (
                format!(
                    "`{}` runs the module {module}, but the option does not need it",
                    configuration.name()
                ),
                format!(
                    "add `{module} = 1` to `needs`: without it a lost {module} would go unnoticed"
                ),
            ),
            Some(_) => continue,
        };
        fields.report(Diagnostic::new(found.span.clone(), message, "needs more").help(help));
    }
    Ok(Some(configuration))
}
