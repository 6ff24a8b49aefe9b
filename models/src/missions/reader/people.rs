//! Reading the people on the floor of a mission.

use super::fields::Fields;
use super::ground::{Ground, reported, without_floor};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::{AT_LEAST_ZERO, MAX_PERSONS, MAX_WALKS, PEOPLE, WALKING_SPEEDS};
use crate::missions::people::{People, Walker};
use crate::missions::way::{Leg, NoLeg};
use cotama_core::units::{MillimetresPerSecond, Millis};

type Ways<'w> = &'w [Result<Leg, NoLeg>];

/// Reads `people` and `[[person]]`; where the mission names no floor, nobody.
pub(super) fn people(root: &mut Fields<'_>, ground: Option<&Ground<'_>>) -> Option<People> {
    let Some(ground) = ground else {
        without_floor(root, &["people", "person"]);
        return Some(People::default());
    };
    let drawn = root.optional_integer("people", PEOPLE);
    let tables = root.tables_up_to("person", false, MAX_PERSONS)?;
    let mut seen = Vec::new();
    let person = |(number, fields)| walker(fields, ground.walks(number), &mut seen);
    let walkers: Vec<_> = tables.into_iter().enumerate().map(person).collect();
    let walkers = walkers.into_iter().collect::<Option<_>>()?;
    Some(People { drawn: drawn.ok()?.unwrap_or(0), walkers })
}

fn walker(
    mut fields: Fields<'_>,
    ways: Option<Ways<'_>>,
    seen: &mut Vec<String>,
) -> Option<Walker> {
    let id = fields.id("id");
    let walks = fields.texts("walks");
    let speed = fields.optional_integer("speed_mm_s", WALKING_SPEEDS);
    let stays = fields.optional_integer("stays_ms", AT_LEAST_ZERO);
    let from = fields.optional_integer("from_ms", AT_LEAST_ZERO);
    let gives_way = fields.optional_flag("gives_way");
    if let Some(id) = &id {
        if seen.contains(&id.value) {
            let message = format!("the person `{}` is defined twice", id.value);
            let it = Diagnostic::new(id.span.clone(), message, "again");
            fields.report(it.help("rename one of them"));
        }
        seen.push(id.value.clone());
    }
    let ways = walks.and_then(|walks| {
        go_somewhere(&fields, &walks)?;
        led(&fields, &walks, ways?)
    });
    fields.finish();
    Some(Walker {
        id: id?.value,
        ways: ways?,
        speed: speed.ok()?.map(MillimetresPerSecond),
        stays: stays.ok()?.map(Millis),
        from: Millis(from.ok()?.unwrap_or(0)),
        gives_way: gives_way.ok()?.unwrap_or(true),
    })
}

/// Reports more places than there may be, and walks from a place to itself.
fn go_somewhere(fields: &Fields<'_>, walks: &[Spanned<String>]) -> Option<()> {
    if walks.len() > MAX_WALKS {
        let message =
            format!("`walks` has {} places; at most {MAX_WALKS} are allowed", walks.len());
        let it = Diagnostic::new(fields.span_of("walks"), message, "too many");
        fields.report(it.help("leave some out"));
        return None;
    }
    let next = walks.iter().skip(1).chain(walks.first());
    let same = walks.iter().zip(next).find(|it| it.0.value == it.1.value);
    let Some((_, again)) = same.filter(|_| walks.len() > 1) else { return Some(()) };
    let message = format!("this person walks from `{0}` to `{0}`", again.value);
    let it = Diagnostic::new(again.span.clone(), message, "nowhere");
    fields.report(it.help("name each place once; from the last one they walk to the first"));
    None
}

/// Returns the ways between the places; reports those that there are not.
fn led(fields: &Fields<'_>, walks: &[Spanned<String>], ways: Ways<'_>) -> Option<Vec<Leg>> {
    let mut all = Vec::new();
    for (place, way) in walks.iter().zip(ways) {
        match way {
            Ok(leg) => all.push(leg.clone()),
            Err(why) => {
                if let Some(why) = why.refusal("open") {
                    reported(fields, place.span.clone(), &why);
                }
            }
        }
    }
    (all.len() == walks.len()).then_some(all)
}
