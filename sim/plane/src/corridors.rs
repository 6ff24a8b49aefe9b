//! A floor for a mission that names none.

use cotama_core::units::Millimetres;
use cotama_models::missions::{Asked, Leg, Way};
use std::fmt::Write;

/// The width of a corridor, and how wide its bends are, in mm.
const WIDE: i32 = 4_000;
/// The longest straight piece, in mm, and the most corridors.
const LONGEST: i32 = 400_000;
const MOST: i32 = 200;
/// The most corridors whose ends have names, where people stay.
const MAX_PLACES: i32 = 8;
/// The pieces of a bend, which are straight.
const PIECES: i32 = 16;

/// Returns a way along corridors side by side, with wide bends from one to the next, as long as a
/// path; `None` for a path so long that no floor holds it.
///
/// ```
/// use cotama_core::units::Millimetres;
/// use cotama_plane::{Track, corridors};
/// let way = corridors::along(Millimetres(187_000)).unwrap();
/// assert_eq!(way.length(), Millimetres(187_000));
/// assert!(corridors::along(Millimetres(u64::MAX)).is_none());
/// ```
pub fn along(length: Millimetres) -> Option<Way> {
    let length = i32::try_from(length.0).ok().filter(|it| *it > 0)?;
    let half = WIDE / 2;
    let bend: Vec<[i32; 2]> = (0..=PIECES).map(|it| corner(it, half)).collect();
    let bends = bend.iter().zip(bend.iter().skip(1)).map(|(a, b)| {
        let [x, y] = [0, 1].map(|axis| f64::from(b[axis] - a[axis]));
        (x * x + y * y).sqrt()
    });
    let bend_mm: f64 = bends.sum();
    // As wide as high: as many corridors as fit their length.
    let mut rows = 1;
    let straight =
        |rows: i32| (f64::from(length) - f64::from(rows - 1) * bend_mm) / f64::from(rows);
    while straight(rows) > f64::from(rows * WIDE).max(10_000.0) {
        rows += 1;
    }
    if rows > MOST || straight(rows) > f64::from(LONGEST) {
        return None;
    }
    let row = whole(straight(rows).floor().max(1.0));
    // Rounding is in the last piece.
    let last =
        whole((f64::from(length) - f64::from(rows - 1) * (bend_mm + f64::from(row))).round());
    let (left, right) = (WIDE, WIDE + row);
    let mut points = Vec::new();
    for it in 0..rows {
        let y = half + it * WIDE;
        let row = if it + 1 == rows { last } else { row };
        let (from, to) = if it % 2 == 0 { (left, left + row) } else { (right, right - row) };
        points.push([from, y]);
        points.push([to, y]);
        if it + 1 < rows {
            let side = if it % 2 == 0 { 1 } else { -1 };
            points.extend(bend.iter().map(|[x, up]| [to + side * x, y + up]));
        }
    }
    points.dedup();
    let text = drawing(rows, row.max(last));
    let leg = Leg { points, length: Millimetres(u64::from(length.unsigned_abs())) };
    Some(Way {
        source: "corridors".into(),
        text: text.into(),
        asked: Asked::default(),
        start: Ok(()),
        doors: Ok(Vec::new()),
        legs: vec![Ok(leg)],
        zones: Vec::new(),
        people: Vec::new(),
    })
}

/// A corner of a half circle, from its lower end.
fn corner(number: i32, radius: i32) -> [i32; 2] {
    let angle = core::f64::consts::PI * f64::from(number) / f64::from(PIECES);
    let (sin, cos) = libm::sincos(angle);
    let radius = f64::from(radius);
    [whole((radius * sin).round()), whole((radius * (1.0 - cos)).round())]
}

/// The floor: walls between corridors, open at one end or the other.
fn drawing(rows: i32, row: i32) -> String {
    let (width, height) = (row + 2 * WIDE, rows * WIDE);
    let mut text = format!(
        "format = \"cotama-floor/1\"\nname = \"corridors\"\n\
         title = \"Corridors as long as the path of a mission that names no floor\"\n\
         size_mm = [{width}, {height}]\n\n[[wall]]\n\
         points_mm = [[0, 0], [{width}, 0], [{width}, {height}], [0, {height}], [0, 0]]\n"
    );
    for it in 1..rows {
        let y = it * WIDE;
        let (from, to) = if it % 2 == 1 { (0, row + WIDE) } else { (WIDE, width) };
        let _ = write!(text, "[[wall]]\npoints_mm = [[{from}, {y}], [{to}, {y}]]\n");
    }
    for it in 0..rows.min(MAX_PLACES) {
        let (y, name) = (it * WIDE + WIDE / 2, it + 1);
        for (side, x) in [("west", WIDE), ("east", row + WIDE)] {
            let _ = write!(text, "[[place]]\nname = \"{name} {side}\"\nat_mm = [{x}, {y}]\n");
        }
    }
    text
}

#[allow(clippy::cast_possible_truncation)] // lengths of a floor in mm
fn whole(it: f64) -> i32 {
    it as i32
}
