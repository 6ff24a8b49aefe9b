//! Whether a floor that was read makes sense.

use super::{Floor, Mark, Place, PointMm, Version, metres};
use crate::surface::{Sense, Surface};
use cotama_models::reading::{Diagnostic, Sink, quoted};
use std::collections::BTreeSet;
use std::ops::Range;

/// A mark hangs at most so far from something, in metres.
const HANGS_M: f64 = 0.1;
/// A place has at least so much room around it, in metres.
const ROOM_M: f64 = 0.05;

/// Position of the name of each entry in the file, or else the entry.
#[derive(Default)]
pub(super) struct Where {
    pub(super) walls: Vec<Range<usize>>,
    pub(super) glass: Vec<Range<usize>>,
    pub(super) doors: Vec<Range<usize>>,
    pub(super) furniture: Vec<Range<usize>>,
    pub(super) marks: Vec<Range<usize>>,
    pub(super) places: Vec<Range<usize>>,
    pub(super) docks: Vec<Range<usize>>,
    pub(super) zones: Vec<Range<usize>>,
}

/// Returns the square of the distance of two points, in mm².
pub(super) fn square(a: PointMm, b: PointMm) -> i64 {
    (0..2).map(|it| i64::from(a[it] - b[it]).pow(2)).sum()
}

/// On which side of the line from `a` to `b` a point is.
fn side(a: PointMm, b: PointMm, at: PointMm) -> i64 {
    let [ab, to] = [b, at].map(|it| [i64::from(it[0] - a[0]), i64::from(it[1] - a[1])]);
    (ab[0] * to[1] - ab[1] * to[0]).signum()
}

/// Whether a point that is in line with `a` and `b` is between them.
fn is_between(a: PointMm, b: PointMm, at: PointMm) -> bool {
    (0..2).all(|it| (a[it].min(b[it])..=a[it].max(b[it])).contains(&at[it]))
}

fn do_meet([a, b]: [PointMm; 2], [c, d]: [PointMm; 2]) -> bool {
    let sides = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
    (sides[0] != sides[1] && sides[2] != sides[3] && !sides.contains(&0))
        || (sides[0] == 0 && is_between(a, b, c))
        || (sides[1] == 0 && is_between(a, b, d))
        || (sides[2] == 0 && is_between(c, d, a))
        || (sides[3] == 0 && is_between(c, d, b))
}

/// Returns the first corner behind which a closed outline meets itself.
pub(super) fn crossing(corners: &[PointMm]) -> Option<usize> {
    let count = corners.len();
    let piece = |at: usize| [corners[at], corners[(at + 1) % count]];
    (0..count).find(|&one| {
        let [a, b] = piece(one);
        let after = piece((one + 1) % count)[1];
        // Pieces that follow each other share a corner, and must not go back.
        let folds = side(a, b, after) == 0 && (is_between(a, b, after) || is_between(b, after, a));
        let others = (one + 2..count).filter(|two| (two + 1) % count != one);
        folds || others.into_iter().any(|two| do_meet(piece(one), piece(two)))
    })
}

/// Reports a name that is there twice.
fn are_new<'n>(
    kind: &str,
    names: impl Iterator<Item = (&'n String, &'n Range<usize>)>,
    sink: &Sink,
) {
    let mut seen = BTreeSet::new();
    for (name, span) in names {
        if !seen.insert(name) {
            let message = format!("the {kind} {} is there twice", quoted(name));
            let it = Diagnostic::new(span.clone(), message, "not a new name");
            sink.report(it.help("give each a name of its own"));
        }
    }
}

/// Whether a floor makes sense; reports all that does not.
pub(super) fn makes_sense(floor: &Floor, at: &Where, sink: &Sink) -> bool {
    are_new("door", floor.doors.iter().map(|it| &it.name).zip(&at.doors), sink);
    are_new("piece", floor.furniture.iter().map(|it| &it.name).zip(&at.furniture), sink);
    are_new("mark", floor.marks.iter().map(|it| &it.name).zip(&at.marks), sink);
    are_new("zone", floor.zones.iter().map(|it| &it.name).zip(&at.zones), sink);
    let places = floor.places.iter().zip(&at.places);
    let docks = floor.docks.iter().zip(&at.docks);
    let all = places.chain(docks).map(|(place, span)| (&place.name, span));
    are_new("place", all, sink);
    for (door, span) in floor.doors.iter().zip(&at.doors) {
        let leaf = door.leaf(true).unwrap_or([metres(door.hinge); 2]);
        if !leaf.iter().all(|it| floor.bounds().holds(*it)) {
            let message = format!("the open door {} leaves the floor", quoted(&door.name));
            let it = Diagnostic::new(span.clone(), message, "too far");
            sink.report(it.help("change the sign of `swing_deg`"));
        }
    }
    if !sink.is_empty() {
        return false;
    }
    let surface = match floor.surface(Version::Real, &[]) {
        Ok(surface) => surface,
        Err(error) => {
            sink.report(Diagnostic::new(0..0, error.to_string(), "").help("leave some out"));
            return false;
        }
    };
    for (Place { name, at, .. }, span) in
        floor.places.iter().zip(&at.places).chain(floor.docks.iter().zip(&at.docks))
    {
        if surface.clearance(metres(*at), 1.0) < ROOM_M {
            let message = format!("{} stands at a wall, in furniture or in a door", quoted(name));
            let it = Diagnostic::new(span.clone(), message, "no room");
            sink.report(it.help("move it: a place has 50 mm of room around"));
        }
    }
    for (Mark { name, at, .. }, span) in floor.marks.iter().zip(&at.marks) {
        if surface.distance(metres(*at), 1.0, Sense::Sound) > HANGS_M {
            let message = format!("the mark {} hangs in the air", quoted(name));
            let it = Diagnostic::new(span.clone(), message, "nothing near");
            sink.report(it.help("move it to a wall: at most 100 mm away"));
        }
    }
    sink.is_empty()
}
