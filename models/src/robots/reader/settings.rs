//! Reading the parameters of modules, and the settings that answer failures.

use super::{Names, words};
use crate::missions::reader::fields::{Fields, Reported};
use crate::missions::{Diagnostic, Spanned};
use crate::names::quoted;
use crate::robots::known::{COSTS, HOLDS, MAX_PARAMETERS, MODES, SETTINGS, SLOWED, VALUES};
use crate::robots::{Mode, Module, Parameter, Setting, Value};
use cotama_core::units::{Micros, Millis};
use std::ops::RangeInclusive;

/// How long a setting outlasts its failure where nothing is said (assumed, as for the delivery).
const HELD: Millis = Millis(5_000);

/// A parameter by the name that settings give it, `MODULE.PARAMETER`.
pub(in crate::robots) struct Named {
    name: String,
    module: usize,
    parameter: usize,
    range: RangeInclusive<u64>,
}

/// Returns the parameters of all modules; those that could not be read have none.
pub(super) fn named<'m>(modules: impl Iterator<Item = Option<&'m Module>>) -> Vec<Named> {
    let mut all = Vec::new();
    for (module, of) in modules.enumerate() {
        let Some(of) = of else { continue };
        for (parameter, it) in of.parameters.iter().enumerate() {
            let name = format!("{}.{}", of.name, it.name);
            all.push(Named { name, module, parameter, range: it.range.clone() });
        }
    }
    all
}

/// Reads the parameters of a module.
pub(super) fn parameters(fields: &mut Fields<'_>) -> Option<Vec<Parameter>> {
    let all = super::named(fields, "parameter", MAX_PARAMETERS);
    all.into_iter().map(|(name, fields)| parameter(name.value, fields?)).collect()
}

fn parameter(name: String, mut fields: Fields<'_>) -> Option<Parameter> {
    let title = words(&mut fields, "title");
    let default = fields.integer::<u64>("default", VALUES);
    let least = fields.optional_integer::<u64>("least", VALUES);
    let most = fields.optional_integer::<u64>("most", VALUES);
    let cost = fields.optional_integer("cost_us", COSTS);
    let source = words(&mut fields, "source");
    let (default, least, most) = (default?, least.ok()?, most.ok()?);
    let range = least.unwrap_or(0)..=most.unwrap_or(VALUES.end().unsigned_abs());
    if !range.contains(&default) {
        let message = format!("{default} is not from {} to {}", range.start(), range.end());
        let it = Diagnostic::new(fields.span_of("default"), message, "not one of its values");
        fields.report(it.help("give `least` and `most` with `default` between them"));
    }
    fields.finish();
    let title = if title.is_empty() { source } else { title };
    Some(Parameter { name, title, default, range, cost: Micros(cost.ok()?.unwrap_or(0)) })
}

/// Reads the setting that answers a failure, if there is one.
pub(super) fn setting(fields: &mut Fields<'_>, names: &Names) -> Result<Option<Setting>, Reported> {
    let Some(mut it) = fields.optional_table("set")? else { return Ok(None) };
    let values = match it.optional_table("values")? {
        Some(table) => {
            let all = table.named_integers(&VALUES).ok_or(Reported)?;
            let all = all.into_iter().map(|(name, of)| value(&it, &name, of, names));
            all.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>().ok_or(Reported)?
        }
        None => Vec::new(),
    };
    let speed = it.optional_integer::<u16>("speed_permille", SLOWED);
    let mode = it.optional_text("mode")?;
    let mode = mode.map(|name| it.index_of(&name, "mode", MODES.into_iter()).ok_or(Reported));
    let mode = mode.transpose()?.map(|at| [Mode::Autonomous, Mode::Operator][at.min(1)]);
    let holds = it.optional_integer("holds_ms", HOLDS);
    let mends = it.optional_flag("mends");
    let times = it.optional_integer("times", SETTINGS);
    if values.is_empty() && speed == Ok(None) {
        let label = "no `values`, no `speed_permille`";
        let wrong = Diagnostic::new(it.whole(), "this sets nothing", label);
        it.report(wrong.help("say which values change, or how much of the speed is left"));
    }
    it.finish();
    Ok(Some(Setting {
        values,
        speed: speed?.unwrap_or(1_000),
        mode,
        holds: holds?.map_or(HELD, Millis),
        mends: mends?.unwrap_or(false),
        times: times?,
    }))
}

/// The value of a parameter, which has to be one of its values.
fn value(fields: &Fields<'_>, name: &Spanned<String>, value: u64, names: &Names) -> Option<Value> {
    let known = names.parameters.iter().map(|it| it.name.as_str());
    let it = names.parameters.get(fields.index_of(name, "parameter", known)?)?;
    if !it.range.contains(&value) {
        let (least, most) = (it.range.start(), it.range.end());
        let message = format!("{value} is no value of {}: {least} to {most}", quoted(&it.name));
        let it = Diagnostic::new(name.span.clone(), message, "beyond its values");
        fields.report(it.help("change it, or `least` and `most` of the parameter"));
    }
    Some(Value { module: it.module, parameter: it.parameter, value })
}
