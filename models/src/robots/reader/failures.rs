//! Reading the failures of a robot.

use super::{Names, parts, signals, words};
use crate::fmeca::thousandths;
use crate::missions::reader::fields::Fields;
use crate::missions::{Diagnostic, Spanned};
use crate::names::quoted;
use crate::robots::known::{PERSISTENCES, RESTARTS, SEVERITIES, TIMES};
use crate::robots::{Failure, Motion, Parts, Restarts, Try};
use crate::severity::{Persistence, Severity};
use cotama_core::units::Millis;

/// The longest mean time: a million years.
const MOST_MH: u64 = 8_766_000_000_000;

/// The failures of a row: one, or one for each module of `each`, which is lost with it.
pub(super) fn failures(mut fields: Fields<'_>, names: &mut Names) -> Option<Vec<Failure>> {
    let span = fields.span_of("id");
    let mask = if fields.has("mask") { fields.span_of("mask") } else { span.clone() };
    let ask = if fields.has("ask") { fields.span_of("ask") } else { span.clone() };
    let each = fields.optional_texts("each").ok();
    let each = each.and_then(|all| {
        let known = || names.modules.iter().map(String::as_str);
        let all: Vec<_> = all.iter().map(|it| fields.index_of(it, "module", known())).collect();
        all.into_iter().collect::<Option<Vec<_>>>()
    });
    let has_each = each.as_ref().is_none_or(|it| !it.is_empty());
    let row = failure(fields, names, has_each);
    let count = each.as_ref().map_or(1, |it| it.len().max(1));
    names.at.failures.extend(std::iter::repeat_n(span, count));
    names.at.masks.extend(std::iter::repeat_n(mask, count));
    names.at.asks.extend(std::iter::repeat_n(ask, count));
    let ((row, own), each) = (row?, each?);
    if each.is_empty() {
        return Some(vec![row]);
    }
    let of = |module: usize| Failure {
        id: format!("{}.{}", row.id, names.modules.get(module).map_or("", |it| it)),
        loses: row.loses.union(Parts { hardware: 0, modules: 1 << module }),
        restarts: row.restarts.or(own.map(|it| Restarts { module, ..it })),
        harm: row.harm.map(|it| signals::harm_of(it, module)),
        ..row.clone()
    };
    Some(each.into_iter().map(of).collect())
}

/// A row, and the restart of the module of each of its failures, in which that module is left open.
fn failure(
    mut fields: Fields<'_>,
    names: &mut Names,
    has_each: bool,
) -> Option<(Failure, Option<Restarts>)> {
    let id = fields.id("id");
    let function = words(&mut fields, "function");
    let item = words(&mut fields, "item");
    let mode = fields.text("mode");
    let cause = words(&mut fields, "cause");
    let effect = words(&mut fields, "effect");
    let severity = fields.table("severity").and_then(severity);
    let persistence = match fields.optional_text("persistence") {
        Ok(None) => Some(Persistence::Permanent),
        Ok(Some(it)) => fields.index_of(&it, "persistence", PERSISTENCES.into_iter()).map(|it| {
            [Persistence::Permanent, Persistence::Intermittent, Persistence::Transient][it.min(2)]
        }),
        Err(_) => None,
    };
    let no_plan = fields.optional_flag("no_plan");
    let unanswered = fields.optional_flag("unanswered");
    let unseen = fields.optional_text("unseen");
    let flags = match &unseen {
        _ if no_plan == Ok(Some(true)) => fields.optional_texts("flags").ok(),
        Ok(Some(_)) => fields.optional_texts("flags").ok(),
        _ => fields.texts("flags"),
    };
    let flags = flags.and_then(|all| self::flags(&fields, &all, names));
    let sometimes = fields.optional_texts("sometimes").ok();
    let sometimes = sometimes.and_then(|all| self::flags(&fields, &all, names));
    if let (Ok(Some(true)), Some(true)) = (&no_plan, flags.as_ref().map(|it| !it.is_empty())) {
        let it = Diagnostic::new(
            fields.span_of("no_plan"),
            "the planner tells this, no flag",
            "and `flags` too",
        );
        fields.report(it.help("leave out `no_plan` or `flags`"));
    }
    if let (Ok(Some(it)), Some(true)) = (&unseen, flags.as_ref().map(|it| !it.is_empty())) {
        let message = "a failure that flags show is seen";
        let it = Diagnostic::new(it.span.clone(), message, "and `flags` too");
        fields.report(it.help("leave out `unseen` or `flags`"));
    }
    let latency = fields.optional_integer("latency_ms", TIMES);
    let loses = parts(&mut fields, "loses", names);
    let motion = super::body::motion(&mut fields);
    let is_fatal = |it: &(Severity, Severity)| [it.0, it.1] == [Severity::Fatal; 2];
    if motion == Some(Motion::Runaway) && severity.as_ref().is_some_and(|it| !is_fatal(it)) {
        let message = "a motor that runs away is stopped by a halt alone, and this is not fatal";
        let it = Diagnostic::new(fields.span_of("motion"), message, "nobody stops it");
        fields.report(it.help("call it `fatal` in both modes, or name another motion"));
    }
    let harm = signals::harm(&mut fields, names, has_each);
    let ends = fields.optional_integer("ends_ms", TIMES);
    let helped = fields.optional_flag("helped");
    let restarts = match fields.optional_table("restart") {
        Ok(it) => Some(it.map(|it| restart(it, names, has_each))),
        Err(_) => None,
    };
    let sets = super::settings::setting(&mut fields, names);
    let asks = super::reactions::asks(&mut fields);
    let own: Vec<_> = flags.iter().chain(&sometimes).flatten().copied().collect();
    let masks = super::reactions::masks(&mut fields, names, &own);
    let tried = [
        matches!(restarts, Some(Some(_))).then_some(Try::Restart),
        matches!(&sets, Ok(Some(it)) if it.times.is_some()).then_some(Try::Set),
        matches!(asks, Ok(Some(_))).then_some(Try::Ask),
    ];
    let tried: Vec<_> = tried.into_iter().flatten().collect();
    let tries = super::reactions::order(&mut fields, &tried);
    let mean = match fields.optional_number("mean_hours") {
        Ok(None) => Some(None),
        Ok(Some(it)) => mean(&fields, &it).map(Some),
        Err(_) => None,
    };
    let source = words(&mut fields, "source");
    fields.finish();
    let (restarts, own) = match restarts? {
        Some(it) => it?,
        None => (None, None),
    };
    let (autonomous, operator) = severity?;
    let failure = Failure {
        id: id?.value,
        function,
        item,
        mode: mode?.value,
        cause,
        effect,
        autonomous,
        operator,
        persistence: persistence?,
        flags: flags?,
        sometimes: sometimes?,
        unseen: unseen.ok()?.map(|it| it.value),
        latency: Millis(latency.ok()?.unwrap_or(0)),
        loses: loses?,
        motion: motion?,
        harm: harm.ok()?,
        ends: ends.ok()?.map(Millis),
        helped: helped.ok()?.unwrap_or(false),
        no_plan: no_plan.ok()?.unwrap_or(false),
        unanswered: unanswered.ok()?.unwrap_or(false),
        restarts,
        sets: sets.ok()?,
        asks: asks.ok()?,
        masks: masks.ok()?,
        tries: tries?,
        mean_mh: mean?,
        source,
    };
    Some((failure, own))
}

/// The severity by mode; in that of the operator it is the same where nothing else is said.
fn severity(mut fields: Fields<'_>) -> Option<(Severity, Severity)> {
    let named = |it: &str| SEVERITIES.iter().position(|known| *known == it).unwrap_or(3);
    let autonomous = fields.choice("autonomous", "severity", &SEVERITIES);
    let operator = match fields.optional_text("operator") {
        Ok(None) => autonomous,
        Ok(Some(it)) => {
            fields.index_of(&it, "severity", SEVERITIES.into_iter()).map(|it| SEVERITIES[it])
        }
        Err(_) => None,
    };
    fields.finish();
    Some((Severity::ALL[named(autonomous?)], Severity::ALL[named(operator?)]))
}

fn flags(fields: &Fields<'_>, all: &[Spanned<String>], names: &Names) -> Option<Vec<usize>> {
    let known = || names.flags.iter().map(String::as_str);
    let all: Vec<_> = all.iter().map(|it| fields.index_of(it, "flag", known())).collect();
    all.into_iter().collect()
}

/// A mean time in thousandths of an hour.
fn mean(fields: &Fields<'_>, text: &Spanned<String>) -> Option<u64> {
    let mean = thousandths(&text.value).filter(|it| (1..=MOST_MH).contains(it));
    if mean.is_none() {
        let message = format!("{} is no mean time in hours", quoted(&text.value));
        let it = Diagnostic::new(text.span.clone(), message, "not hours");
        fields.report(it.help("write a positive number with three decimals at most"));
    }
    mean
}

/// A restart of the module that it names, or else of that of each failure of the row.
fn restart(
    mut fields: Fields<'_>,
    names: &mut Names,
    has_each: bool,
) -> Option<(Option<Restarts>, Option<Restarts>)> {
    let known = || names.modules.iter().map(String::as_str);
    let module = if has_each && !fields.has("module") {
        Some(None)
    } else {
        let module = fields.text("module");
        module.and_then(|it| fields.index_of(&it, "module", known())).map(Some)
    };
    let times = fields.integer("times", RESTARTS);
    let mends = fields.optional_flag("mends");
    fields.knows("shared");
    let shared = if fields.has("shared") {
        fields.id("shared").zip(times).map(|it| Some(shared(&fields, it, names)))
    } else {
        Some(None)
    };
    fields.finish();
    let (times, shared, mends) = (times?, shared?, mends.ok()?.unwrap_or(false));
    Some(match module? {
        Some(module) => (Some(Restarts { module, times, shared, mends }), None),
        None => (None, Some(Restarts { module: 0, times, shared, mends })),
    })
}

/// The name under which restarts count together: all of one name allow as many.
fn shared(fields: &Fields<'_>, (name, times): (Spanned<String>, u8), names: &mut Names) -> usize {
    let known = names.shared.iter().position(|it| it.0 == name.value);
    match known.and_then(|it| names.shared.get(it)) {
        None => names.shared.push((name.value, times)),
        Some((_, before)) if *before != times => {
            let name = quoted(&name.value);
            let message = format!("{name} is counted to {before} before, and to {times} here");
            let it = Diagnostic::new(fields.span_of("times"), message, "another number");
            fields.report(it.help("write the same number, or another name"));
        }
        Some(_) => {}
    }
    known.unwrap_or(names.shared.len().saturating_sub(1))
}
