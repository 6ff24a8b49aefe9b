//! Reading the floor of a team: its places, and the ways between them.

use super::{Names, among};
use crate::missions::reader::fields::{Fields, Reported};
use crate::missions::{Diagnostic, Refusal, Spanned};
use crate::names::quoted;
use crate::team::scenario::{
    Crowd, Floor, MANY, MOST_DELAYS, MOST_PAIRED, MOST_PLANNED, On, Place, Ways,
};
use std::cell::RefCell;
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

/// Lengths of ways in mm, up to 10 km.
const LENGTHS: RangeInclusive<i64> = 1..=10_000_000;

/// Delays in ms, up to an hour.
const DELAYS: RangeInclusive<i64> = 0..=3_600_000;

/// The names of places, with what a floor has against them.
#[derive(Default)]
pub(super) struct Places {
    names: Vec<String>,
    /// Told once, where the place is first named.
    refused: RefCell<Vec<Option<Refusal>>>,
}

impl Places {
    /// The place of a name; reports it when there is none, or when nothing leads there.
    pub(super) fn place(
        &self,
        fields: &Fields<'_>,
        name: Option<&Spanned<String>>,
    ) -> Option<Place> {
        // A list of places that could not be read is the error.
        if self.names.is_empty() {
            return None;
        }
        let at = among(fields, name, "place", &self.names)?;
        self.told(fields, at, name?.span.clone());
        Some(Place(at))
    }

    /// Reports what a floor has against a place, if nobody has yet.
    fn told(&self, fields: &Fields<'_>, at: usize, span: Range<usize>) {
        if let Some(why) = self.refused.borrow_mut().get_mut(at).and_then(Option::take) {
            report(fields, &why, span);
        }
    }
}

fn report(fields: &Fields<'_>, why: &Refusal, span: Range<usize>) {
    let it = Diagnostic::new(span, &why.message, "not on this floor");
    fields.report(match &why.help {
        Some(help) => it.help(help),
        None => it,
    });
}

/// The floor of a team: a name, or a table.
pub(super) fn floor(
    fields: &mut Fields<'_>,
    ways: Option<&Ways>,
    names: &mut Names,
) -> Option<(Floor, Vec<Crowd>)> {
    if fields.is_table("floor") {
        return fields.table("floor").and_then(|it| of_table(it, ways, names));
    }
    let name = fields.text("floor")?;
    let ways = answer(fields, &name, ways)?;
    names.places.names.clone_from(&ways.asked.places);
    *names.places.refused.borrow_mut() = ways.refused();
    let floor = complete(fields, ways, name.span)?;
    let on = On::new(name.value, Default::default(), None, Some(ways.clone().into()));
    Some((floor.standing_on(on), Vec::new()))
}

/// The answer of a floor of this name; reports that there is none.
fn answer<'w>(
    fields: &Fields<'_>,
    floor: &Spanned<String>,
    ways: Option<&'w Ways>,
) -> Option<&'w Ways> {
    let found = ways.filter(|it| it.asked.floor == floor.value);
    let Some(ways) = found else {
        let message =
            format!("there is no floor {}, and no file of this name", quoted(&floor.value));
        let help = "give `office`, or the path of a floor beside this file; `cotama new floor \
                    NAME` begins one";
        fields.report(Diagnostic::new(floor.span.clone(), message, "not known").help(help));
        return None;
    };
    if let Some(why) = ways.unusable() {
        report(fields, why, floor.span.clone());
    }
    Some(ways)
}

/// A floor on which each place leads to each.
fn complete(fields: &Fields<'_>, ways: &Ways, span: Range<usize>) -> Option<Floor> {
    let names = &ways.asked.places;
    if names.len() > MOST_PAIRED {
        let message = format!(
            "there are {} places, and a way between each two of at most {MOST_PAIRED} is planned",
            names.len()
        );
        let help = "name the ways that robots take, each as `[[floor.way]]` with `between`";
        fields.report(Diagnostic::new(span, message, "too many").help(help));
        return None;
    }
    let lengths = ways.asked.pairs().into_iter().zip(&ways.legs);
    let lengths = lengths.filter_map(|((a, b), leg)| Some((a, b, leg.as_ref().ok()?.length.0)));
    let lengths: Vec<_> = lengths.collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Some(Floor::direct(&names, &lengths))
}

/// The floor of a table: places, and ways with lengths, which a floor of walls and rooms may give.
fn of_table(
    mut fields: Fields<'_>,
    ways: Option<&Ways>,
    names: &mut Names,
) -> Option<(Floor, Vec<Crowd>)> {
    let on = fields.optional_text("on").ok()?;
    let doors = match &on {
        Some(_) => ["open", "close"].map(|key| fields.optional_texts(key)),
        None => [Ok(Vec::new()), Ok(Vec::new())],
    };
    let ways = match &on {
        // A floor that only draws may be somewhere else.
        Some(it) if ways.is_some() || !fields.has("way") || !fields.has("places") => {
            Some(answer(&fields, it, ways)?)
        }
        _ => None,
    };
    if let Some((why, key)) = ways
        .and_then(|it| it.doors.as_ref().err())
        .zip(["open", "close"].into_iter().find(|it| fields.has(it)))
    {
        report(&fields, why, fields.span_of(key));
    }
    if let Some(ways) = ways {
        *names.places.refused.borrow_mut() = ways.refused();
    }
    let places = if on.is_some() && !fields.has("places") {
        names.places.names.clone_from(&ways.map_or_else(Vec::new, |it| it.asked.places.clone()));
        Some(())
    } else {
        fields.texts("places").map(|it| listed(&fields, &it, names))
    };
    let span = fields.whole();
    let has_ways = fields.has("way");
    let most = if on.is_some() { MOST_PLANNED } else { MANY };
    let read = fields.tables_up_to("way", false, most).unwrap_or_default();
    let (mut all, mut crowded) = (Vec::new(), Vec::new());
    for it in read {
        let way = way(it, on.is_some(), ways, names, &crowded);
        crowded.extend(way.as_ref().and_then(|it| it.crowd.as_ref()).map(|it| it.between));
        all.push(way);
    }
    let complete = match ways {
        Some(ways) if !has_ways => Some(complete(&fields, ways, span)?),
        _ => None,
    };
    fields.finish();
    places?;
    let read = all.into_iter().collect::<Option<Vec<_>>>()?;
    let given = read.iter().filter(|it| it.given).map(|it| it.ends).collect();
    let lengths: Vec<_> = read.iter().map(|it| (it.ends.0, it.ends.1, it.length)).collect();
    let crowds = read.into_iter().filter_map(|it| it.crowd).collect();
    let known: Vec<&str> = names.places.names.iter().map(String::as_str).collect();
    let floor = complete.unwrap_or_else(|| Floor::new(&known, &lengths));
    let Some(on) = on else { return Some((floor, crowds)) };
    let [open, close] = doors;
    let words = |all: Vec<Spanned<String>>| all.into_iter().map(|it| it.value).collect();
    let doors = [words(open.ok()?), words(close.ok()?)];
    let ways = ways.cloned().map(Arc::new);
    let on = On::new(on.value, doors, has_ways.then_some(given), ways);
    Some((floor.standing_on(on), crowds))
}

/// The places of a list.
fn listed(fields: &Fields<'_>, places: &[Spanned<String>], names: &mut Names) {
    for it in places {
        if names.places.names.contains(&it.value) {
            let message = format!("the place {} is there twice", quoted(&it.value));
            fields.report(Diagnostic::new(it.span.clone(), message, "twice"));
        }
        names.places.told(fields, names.places.names.len(), it.span.clone());
        names.places.names.push(it.value.clone());
    }
}

/// A way between two places.
struct Way {
    ends: (usize, usize),
    length: u64,
    /// Whether the file says its length.
    given: bool,
    crowd: Option<Crowd>,
}

/// The delays of a way.
fn crowd(
    fields: &mut Fields<'_>,
    ends: Option<(usize, usize)>,
    others: &[(usize, usize)],
) -> Result<Option<Crowd>, Reported> {
    if !fields.has("delays_ms") {
        fields.knows("delays_ms");
        // Delays that were seen say nothing of those that will be.
        if fields.has("seen_ms") {
            let message = "`seen_ms` is of a way that has `delays_ms`";
            let help = "say with `delays_ms` what may happen to a drive";
            let span = fields.span_of("seen_ms");
            fields.report(Diagnostic::new(span, message, "no delays").help(help));
            fields.knows("seen_ms");
            return Err(Reported);
        }
        fields.knows("seen_ms");
        return Ok(None);
    }
    let delays = fields.integers_up_to("delays_ms", DELAYS, MOST_DELAYS);
    let seen = if fields.has("seen_ms") {
        Some(fields.integers_or_none("seen_ms", DELAYS, MOST_DELAYS).ok_or(Reported)?)
    } else {
        fields.knows("seen_ms");
        None
    };
    let (a, b) = ends.ok_or(Reported)?;
    let between = (a.min(b), a.max(b));
    if others.contains(&between) {
        let message = "a way between these places has `delays_ms` already";
        let help = "leave them out here, or make one list of both";
        fields.report(Diagnostic::new(fields.span_of("delays_ms"), message, "twice").help(help));
        return Err(Reported);
    }
    let delays_ms = delays.ok_or(Reported)?;
    Ok(Some(Crowd { between, delays_ms, seen_ms: seen }))
}

/// Reads a way, with its length and its delays.
fn way(
    mut fields: Fields<'_>,
    on_floor: bool,
    ways: Option<&Ways>,
    names: &Names,
    crowded: &[(usize, usize)],
) -> Option<Way> {
    let between = fields.texts("between");
    let ends = between.as_ref().and_then(|it| match &it[..] {
        [a, b] if a.value != b.value => {
            let ends = [a, b].map(|it| names.places.place(&fields, Some(it)));
            Some((ends[0]?.0, ends[1]?.0))
        }
        _ => {
            let span = fields.span_of("between");
            let message = "a way leads from one place to another";
            let help = "write two places, as `[\"hall\", \"kitchen\"]`";
            fields.report(Diagnostic::new(span, message, "not two places").help(help));
            None
        }
    });
    let leg = ends.and_then(|(a, b)| ways?.leg(a, b));
    if let Some(why) = leg.and_then(|it| it.as_ref().err()).and_then(|it| it.refusal("open"))
        && ways.is_some_and(|it| it.unusable().is_none())
    {
        report(&fields, &why, fields.span_of("between"));
    }
    let given = fields.has("length_mm") || !on_floor;
    let length = if given {
        fields.integer("length_mm", LENGTHS)
    } else {
        fields.knows("length_mm");
        let planned = leg.and_then(|it| it.as_ref().ok()).map(|it| it.length.0);
        // A misspelt `length_mm` is one error, not two.
        if ways.is_none() && !fields.has_unknown() {
            let span = fields.span_of("between");
            let message = "the length of this way is that of a path over a floor that is not here";
            let help = "say its `length_mm`, or read the file where its floor is";
            fields.report(Diagnostic::new(span, message, "no length").help(help));
        }
        planned
    };
    let crowd = crowd(&mut fields, ends, crowded);
    fields.finish();
    Some(Way { ends: ends?, length: length?, given, crowd: crowd.ok()? })
}
