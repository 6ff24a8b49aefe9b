//! A row, wherever it is from: a table of TOML or a line of comma-separated values.

use super::amount::thousandths;
use crate::fmeca::Label;
use crate::fmeca::analysis::Mode;
use crate::fmeca::set::Set;
use crate::missions::reader::fields::{Fields, Reported, Sink};
use crate::missions::{Diagnostic, Spanned};
use crate::names::{quoted, unknown};
use crate::severity::{Persistence, Severity};
use cotama_core::text::marked;
use std::ops::Range;

/// The longest text, in characters.
const MAX_TEXT: usize = 1000;
/// The longest time to see a failure, in milliseconds: more than eleven days.
const MAX_LATENCY: u64 = 1_000_000_000;
/// The longest mean time between failures: a thousand million hours, in thousandths.
const MAX_MTBF: u64 = 1_000_000_000_000;

/// The source of a row. A method that returns nothing has reported why.
pub(super) trait Row {
    /// A required text.
    fn needed(&mut self, key: &'static str) -> Option<Spanned<String>>;
    /// A required id.
    fn id(&mut self) -> Option<Spanned<String>>;
    /// A text that may be left out.
    fn text(&mut self, key: &'static str) -> Result<Option<Spanned<String>>, Reported>;
    /// The digits of a number that may be left out.
    fn number(&mut self, key: &'static str) -> Result<Option<Spanned<String>>, Reported>;
    /// Names; none where the list is left out.
    fn list(&mut self, key: &'static str) -> Result<Vec<Spanned<String>>, Reported>;
    /// How long the detection takes, as digits in milliseconds or, where `true`, in seconds.
    fn latency(&mut self) -> Result<Option<(Spanned<String>, bool)>, Reported>;
    fn report(&self, diagnostic: Diagnostic);
    /// Returns the position of the row in the file, in bytes.
    fn place(&self) -> Range<usize>;
}

impl Row for Fields<'_> {
    fn needed(&mut self, key: &'static str) -> Option<Spanned<String>> {
        Fields::text(self, key)
    }

    fn id(&mut self) -> Option<Spanned<String>> {
        Fields::id(self, "id")
    }

    fn text(&mut self, key: &'static str) -> Result<Option<Spanned<String>>, Reported> {
        self.optional_text(key)
    }

    fn number(&mut self, key: &'static str) -> Result<Option<Spanned<String>>, Reported> {
        self.optional_number(key)
    }

    fn list(&mut self, key: &'static str) -> Result<Vec<Spanned<String>>, Reported> {
        self.optional_texts(key)
    }

    fn latency(&mut self) -> Result<Option<(Spanned<String>, bool)>, Reported> {
        Ok(self.optional_number("latency_ms")?.map(|it| (it, false)))
    }

    fn report(&self, diagnostic: Diagnostic) {
        Fields::report(self, diagnostic);
    }

    fn place(&self) -> Range<usize> {
        self.span_of("")
    }
}

/// A row whose flags are not looked up yet.
pub(super) struct Draft {
    pub(super) id: Spanned<String>,
    pub(super) always: Vec<Spanned<String>>,
    pub(super) sometimes: Vec<Spanned<String>>,
    mode: Mode,
}

impl Draft {
    /// The row with its flags among the names of all.
    pub(super) fn complete(self, sink: &Sink, names: &[&str]) -> Mode {
        let always = places(sink, &self.always, "flag", names);
        let sometimes = places(sink, &self.sometimes, "flag", names);
        for (name, place) in self.sometimes.iter().zip(&sometimes) {
            if always.contains(place) {
                let message = format!("the flag `{}` is raised always and sometimes", name.value);
                let both = Diagnostic::new(name.span.clone(), message, "in `flags` too");
                sink.report(both.help("leave it out of one of the two lists"));
            }
        }
        let set = |places: Vec<usize>| Set::of(names.len(), places);
        Mode { flags: set(always), sometimes: set(sometimes), ..self.mode }
    }
}

/// The places of names in a list; reports those that are not in it or named twice.
pub(super) fn places(
    sink: &Sink,
    names: &[Spanned<String>],
    what: &str,
    known: &[&str],
) -> Vec<usize> {
    let mut places = Vec::new();
    for name in names {
        let report = |message, label, help| {
            sink.report(Diagnostic::new(name.span.clone(), message, label).help(help));
        };
        match known.iter().position(|it| *it == name.value) {
            Some(place) if places.contains(&place) => report(
                format!("the {what} {} is named twice", quoted(&name.value)),
                "again",
                "leave it out".to_owned(),
            ),
            Some(place) => places.push(place),
            None => {
                let (message, help) = unknown(what, &name.value, known.iter().copied());
                report(message, "not known", help);
            }
        }
    }
    places
}

/// A text in one line, its words one space apart.
pub(super) fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A text in one line; reports one that is empty, too long, or has what a terminal would obey.
pub(super) fn checked(
    report: impl Fn(Diagnostic),
    key: &str,
    text: Spanned<String>,
) -> Option<String> {
    let line = words(&text.value);
    let (message, help) = if line.is_empty() {
        (format!("`{key}` is empty"), "write a few words".to_owned())
    } else if line.chars().count() > MAX_TEXT {
        (format!("`{key}` has more than {MAX_TEXT} characters"), "shorten it".to_owned())
    } else if marked(&line).any(|it| it.1) {
        (format!("`{key}` has a control character"), "leave it out".to_owned())
    } else {
        return Some(line);
    };
    report(Diagnostic::new(text.span, message, "this text").help(help));
    None
}

/// A text in one line that may be left out.
fn optional(row: &mut impl Row, key: &'static str) -> Result<Option<String>, Reported> {
    let Some(text) = row.text(key)? else { return Ok(None) };
    checked(|it| row.report(it), key, text).map(Some).ok_or(Reported)
}

/// One of a few words.
fn choice<T: Copy>(
    row: &impl Row,
    found: &Spanned<String>,
    what: &str,
    known: &[(&'static str, T)],
) -> Result<T, Reported> {
    let word = found.value.trim().to_lowercase();
    let names = known.iter().map(|it| it.0);
    known.iter().find(|it| it.0 == word).map(|it| it.1).ok_or_else(|| {
        let (message, _) = unknown(what, &found.value, names.clone());
        let help = format!("known: {}", names.collect::<Vec<_>>().join(", "));
        row.report(Diagnostic::new(found.span.clone(), message, "not known").help(help));
        Reported
    })
}

/// A number in thousandths, between bounds in thousandths.
fn amount(
    row: &impl Row,
    key: &str,
    found: &Spanned<String>,
    (least, most): (u64, u64),
    (says, unit): (&str, u64),
) -> Result<u64, Reported> {
    let number = thousandths(&found.value).filter(|it| it.is_multiple_of(unit));
    number.filter(|it| (least..=most).contains(it)).ok_or_else(|| {
        let message = format!("`{key}` must be {says}, not {}", quoted(&found.value));
        let wrong = Diagnostic::new(found.span.clone(), message, "not such a number");
        row.report(wrong.help("change the value"));
        Reported
    })
}

/// A whole number that may be left out.
fn whole(
    row: &mut impl Row,
    key: &'static str,
    (least, most): (u64, u64),
) -> Result<Option<u64>, Reported> {
    let Some(found) = row.number(key)? else { return Ok(None) };
    let says = format!("a whole number from {least} to {most}");
    let bounds = (least * 1000, most * 1000);
    amount(row, key, &found, bounds, (&says, 1000)).map(|it| Some(it / 1000))
}

const SEVERITIES: [(&str, Severity); 4] = [
    (Severity::Weak.name(), Severity::Weak),
    (Severity::Medium.name(), Severity::Medium),
    (Severity::Hard.name(), Severity::Hard),
    (Severity::Fatal.name(), Severity::Fatal),
];
const STAYS: [(&str, Persistence); 3] = [
    (Persistence::Permanent.name(), Persistence::Permanent),
    (Persistence::Transient.name(), Persistence::Transient),
    (Persistence::Intermittent.name(), Persistence::Intermittent),
];
const LABELS: [(&str, Label); 3] = [
    (Label::Stated.name(), Label::Stated),
    (Label::Inferred.name(), Label::Inferred),
    (Label::Assumed.name(), Label::Assumed),
];

/// The severity under a key.
fn severity(row: &impl Row, found: &Spanned<String>) -> Result<Severity, Reported> {
    choice(row, found, "severity", &SEVERITIES)
}

/// A word of a few that may be left out.
fn word<T: Copy>(
    row: &mut impl Row,
    key: &'static str,
    what: &str,
    known: &[(&'static str, T)],
) -> Result<Option<T>, Reported> {
    let Some(found) = row.text(key)? else { return Ok(None) };
    choice(row, &found, what, known).map(Some)
}

/// The names in a list.
fn names(row: &mut impl Row, key: &'static str) -> Result<Vec<Spanned<String>>, Reported> {
    let found = row.list(key)?;
    let name = |it: Spanned<String>| {
        let span = it.span.clone();
        name(|it| row.report(it), key, it).map(|value| Spanned { value, span })
    };
    let names: Vec<_> = found.into_iter().map(name).collect();
    names.into_iter().collect::<Option<_>>().ok_or(Reported)
}

/// A name in one line, without what stands between names in a list.
pub(super) fn name(
    report: impl Fn(Diagnostic),
    key: &str,
    text: Spanned<String>,
) -> Option<String> {
    let span = text.span.clone();
    let name = checked(&report, key, text)?;
    if name.contains(';') {
        let message = format!("the name {} has a `;`", quoted(&name));
        let wrong = Diagnostic::new(span, message, "it stands between names");
        report(wrong.help("leave it out, or write two names"));
        return None;
    }
    Some(name)
}

/// Reads a row. Everything is looked at before it is given up.
pub(super) fn read(row: &mut impl Row) -> Option<Draft> {
    let id = row.id();
    let mut needed = |key| {
        let text = row.needed(key)?;
        checked(|it| row.report(it), key, text)
    };
    let [function, component, failure, cause, effect] =
        ["function", "component", "failure", "cause", "effect"].map(&mut needed);
    let worst = row.needed("severity");
    let worst = worst.and_then(|it| severity(row, &it).ok());
    let operator = word(row, "severity_operator", "severity", &SEVERITIES);
    let persistence = word(row, "persistence", "persistence", &STAYS);
    let [lost, observer, detection, event, reaction] =
        ["lost", "observer", "detection", "event", "reaction"].map(|key| optional(row, key));
    let latency = latency(row);
    let always = names(row, "flags");
    let sometimes = names(row, "sometimes");
    let silent = silent(row, &always, &sometimes, &latency);
    let detection_rank = whole(row, "detection_rank", (1, 10));
    let mtbf_mh = interval(row);
    let alpha = whole(row, "alpha_permille", (1, 1000));
    let beta = whole(row, "beta_permille", (0, 1000));
    let rate_label = word(row, "rate_label", "label", &LABELS);
    let rate_source = optional(row, "rate_source");
    let injection = optional(row, "injection");
    let id = id?;
    let mode = Mode {
        id: id.value.clone(),
        function: function?,
        component: component?,
        failure: failure?,
        cause: cause?,
        effect: effect?,
        severity: worst?,
        severity_operator: operator.ok()?,
        persistence: persistence.ok()?,
        lost: lost.ok()?.unwrap_or_default(),
        observer: observer.ok()?.unwrap_or_default(),
        detection: detection.ok()?.unwrap_or_default(),
        latency_ms: u32::try_from(latency.ok()?.unwrap_or(0)).ok()?,
        flags: Set::none(0),
        sometimes: Set::none(0),
        silent: silent.ok()?,
        detection_rank: detection_rank.ok()?.map(|it| it as u8),
        measured_rank: None,
        event: event.ok()?.unwrap_or_default(),
        reaction: reaction.ok()?.unwrap_or_default(),
        mtbf_mh: mtbf_mh.ok()?,
        alpha_permille: alpha.ok()?.map(|it| it as u16),
        beta_permille: beta.ok()?.map(|it| it as u16),
        rate_label: rate_label.ok()?.unwrap_or(Label::Assumed),
        rate_source: rate_source.ok()?.unwrap_or_default(),
        injection: injection.ok()?.unwrap_or_default(),
    };
    Some(Draft { id, always: always.ok()?, sometimes: sometimes.ok()?, mode })
}

/// How long the detection takes, in milliseconds.
fn latency(row: &mut impl Row) -> Result<Option<u64>, Reported> {
    match row.latency()? {
        None => Ok(None),
        Some((found, true)) => {
            let says = "a number of seconds up to 1000000, with at most three decimals";
            amount(row, "latency_s", &found, (0, MAX_LATENCY), (says, 1)).map(Some)
        }
        Some((found, false)) => {
            let says = format!("a whole number from 0 to {MAX_LATENCY}");
            let found = amount(row, "latency_ms", &found, (0, MAX_LATENCY * 1000), (&says, 1000));
            found.map(|it| Some(it / 1000))
        }
    }
}

/// Why nothing sees it; what raises flags needs a latency in its place.
fn silent(
    row: &mut impl Row,
    always: &Result<Vec<Spanned<String>>, Reported>,
    sometimes: &Result<Vec<Spanned<String>>, Reported>,
    latency: &Result<Option<u64>, Reported>,
) -> Result<Option<String>, Reported> {
    let found = row.text("silent")?;
    let count = |list: &Result<Vec<_>, _>| list.as_ref().map_or(0, Vec::len);
    let (always, sometimes) = (count(always), count(sometimes));
    if always > 0 && matches!(latency, Ok(None)) {
        let message = "a failure mode that raises flags needs `latency_ms`";
        let late = Diagnostic::new(row.place(), message, "`latency_ms` is not here");
        row.report(late.help("say within how many milliseconds a flag is raised"));
    }
    let Some(found) = found else { return Ok(None) };
    if always + sometimes > 0 {
        let message = "a failure mode that raises flags is not `silent`";
        let both = Diagnostic::new(found.span, message, "and it has flags");
        row.report(both.help("leave out `silent`, or the flags"));
        return Err(Reported);
    }
    checked(|it| row.report(it), "silent", found).map(Some).ok_or(Reported)
}

/// The mean time between failures in thousandths of an hour, from itself or from the rate.
fn interval(row: &mut impl Row) -> Result<u64, Reported> {
    let mtbf = row.number("mtbf_h")?;
    let rate = row.number("failures_per_million_h")?;
    let says = "a number from 0.001 to 1000000000, with at most three decimals";
    match (mtbf, rate) {
        (Some(mtbf), None) => amount(row, "mtbf_h", &mtbf, (1, MAX_MTBF), (says, 1)),
        (None, Some(rate)) => {
            let rate = amount(row, "failures_per_million_h", &rate, (1, MAX_MTBF), (says, 1))?;
            // A million hours in thousandths, by a number of thousandths; rounded half up.
            Ok(((2 * MAX_MTBF + rate) / (2 * rate)).max(1))
        }
        (Some(_), Some(rate)) => {
            let message = "`mtbf_h` and `failures_per_million_h` say the same";
            let both = Diagnostic::new(rate.span, message, "one too many");
            row.report(both.help("leave one of them out"));
            Err(Reported)
        }
        (None, None) => {
            let message = "a failure mode needs `mtbf_h`, or `failures_per_million_h`";
            let none = Diagnostic::new(row.place(), message, "no rate is here");
            row.report(none.help("add `mtbf_h`, the mean time between failures in hours"));
            Err(Reported)
        }
    }
}
