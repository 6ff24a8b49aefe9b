//! Reading a `cotama-floor/1` file.

use super::sound::{Where, makes_sense};
use super::{Door, Floor, Furniture, Line, Mark, Outline, Place, PointMm, Zone};
use cotama_models::missions::MissionErrors;
use cotama_models::reading::{Diagnostic, Fields, Sink, Spanned, document, errors, quoted};
use std::ops::{Range, RangeInclusive};

/// Value of `format` in files of floors.
pub const FORMAT: &str = "cotama-floor/1";
/// The largest width and height, in mm.
pub const MAX_MM: i64 = 500_000;
/// The most points of a line or an outline.
pub const MAX_POINTS: usize = 500;
/// The most characters of a name.
pub const MAX_NAME: usize = 64;
/// The most entries of a kind.
const MAX_ENTRIES: usize = 1_000;

const COORDINATES: RangeInclusive<i64> = 0..=MAX_MM;
const ANGLES: RangeInclusive<i64> = -360..=360;
const SWINGS: RangeInclusive<i64> = -180..=180;
/// Widths of doors, in mm.
pub(super) const DOORS: RangeInclusive<i64> = 300..=5_000;

impl Floor {
    /// Reads a `cotama-floor/1` file. `source_name` is its name in messages.
    ///
    /// The keys are shown by the floor that ships, [`office`](crate::embedded::OFFICE). Lengths
    /// are whole numbers of mm, angles of degrees. At most 500 m x 500 m, 1,000 entries of a kind,
    /// [`MAX_POINTS`] points of a line, [`MAX_SEGMENTS`](crate::MAX_SEGMENTS) pieces in all (long
    /// ones less: [`Crowded`](crate::SegmentsError::Crowded)); names have at most [`MAX_NAME`]
    /// characters.
    ///
    /// # Errors
    /// All errors of the file, with their places: what cannot be read, and what makes no sense.
    ///
    /// ```
    /// use cotama_floor::Floor;
    /// let text = "format = 'cotama-floor/1'\nname = 'hall'\nsize_mm = [9000, 6000]\n\
    ///             [[place]]\nname = 'here'\nat_mm = [1000, 7000]\n";
    /// let said = Floor::parse("hall.toml", text).unwrap_err().to_string();
    /// let first = "hall.toml:6:9: the point [1000, 7000] is not on the floor of 9000 x 6000 mm";
    /// assert!(said.starts_with(first), "{said}");
    /// let floor = Floor::parse("hall.toml", &text.replace("7000", "5000")).unwrap();
    /// assert_eq!(floor.place("here").unwrap().at, [1000, 5000]);
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let floor = document(text, &sink, FORMAT, |fields| floor(fields, &sink));
        match floor.filter(|_| sink.is_empty()) {
            Some(floor) => Ok(floor),
            None => Err(errors(source_name, text, sink)),
        }
    }
}

/// Reads all entries of a kind, and notes where each stands.
fn all<T>(
    fields: &mut Fields<'_>,
    key: &'static str,
    places: &mut Vec<Range<usize>>,
    mut read: impl FnMut(&mut Fields<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let tables = fields.tables_up_to(key, false, MAX_ENTRIES)?;
    let mut entries = Vec::with_capacity(tables.len());
    for mut table in tables {
        let named = table.span_of("name");
        let entry = read(&mut table);
        table.finish();
        places.push(named);
        entries.push(entry);
    }
    entries.into_iter().collect()
}

fn floor(mut fields: Fields<'_>, sink: &Sink) -> Option<Floor> {
    let name = name(&mut fields);
    let title = fields.optional_text("title").ok().flatten();
    let size = fields.point("size_mm", &(1_000..=MAX_MM));
    // Without a size all points are on the floor.
    let on = On { size: size.as_ref().map_or([MAX_MM; 2], |it| it.value) };
    let mut at = Where::default();
    let walls = all(&mut fields, "wall", &mut at.walls, |it| line(it, &on));
    let glass = all(&mut fields, "glass", &mut at.glass, |it| line(it, &on));
    let doors = all(&mut fields, "door", &mut at.doors, |it| door(it, &on));
    let furniture = all(&mut fields, "furniture", &mut at.furniture, |it| piece(it, &on));
    let marks = all(&mut fields, "mark", &mut at.marks, |it| mark(it, &on));
    let places = all(&mut fields, "place", &mut at.places, |it| place(it, &on, false));
    let docks = all(&mut fields, "dock", &mut at.docks, |it| place(it, &on, true));
    let zones = all(&mut fields, "zone", &mut at.zones, |it| zone(it, &on));
    fields.finish();
    let floor = Floor {
        name: name?,
        title: title.map_or_else(String::new, |it| it.value),
        size: small(size?.value),
        walls: walls?,
        glass: glass?,
        doors: doors?,
        furniture: furniture?,
        marks: marks?,
        places: places?,
        docks: docks?,
        zones: zones?,
    };
    (sink.is_empty() && makes_sense(&floor, &at, sink)).then_some(floor)
}

fn small(at: [i64; 2]) -> PointMm {
    at.map(|it| it as i32)
}

/// The floor that points must be on.
struct On {
    size: [i64; 2],
}

impl On {
    fn check(&self, fields: &Fields<'_>, point: &Spanned<[i64; 2]>) -> Option<PointMm> {
        let [[x, y], [width, height]] = [point.value, self.size];
        if x <= width && y <= height {
            return Some(small(point.value));
        }
        let message = format!("the point [{x}, {y}] is not on the floor of {width} x {height} mm");
        let it = Diagnostic::new(point.span.clone(), message, "outside");
        fields.report(it.help("move the point, or make `size_mm` larger"));
        None
    }

    fn point(&self, fields: &mut Fields<'_>, key: &'static str) -> Option<PointMm> {
        let point = fields.point(key, &COORDINATES)?;
        self.check(fields, &point)
    }

    /// Checks the points of a line, of which no two that follow each other are the same.
    fn line(&self, fields: &Fields<'_>, all: &[Spanned<[i64; 2]>]) -> Option<Vec<PointMm>> {
        let next = all.iter().skip(1);
        let twice = all.iter().zip(next).find(|(one, two)| one.value == two.value);
        if let Some((_, two)) = twice {
            let [x, y] = two.value;
            let message = format!("the point [{x}, {y}] is there twice, one after the other");
            fields.report(Diagnostic::new(two.span.clone(), message, "twice").help("leave it out"));
        }
        let points: Vec<_> = all.iter().map(|it| self.check(fields, it)).collect();
        points.into_iter().collect::<Option<Vec<_>>>().filter(|_| twice.is_none())
    }

    /// Reads a polygon that does not cross itself.
    fn outline(&self, fields: &mut Fields<'_>) -> Option<Vec<PointMm>> {
        let all = fields.points("outline_mm", &COORDINATES, &(3..=MAX_POINTS))?;
        self.closed(fields, &all)
    }

    fn closed(&self, fields: &Fields<'_>, all: &[Spanned<[i64; 2]>]) -> Option<Vec<PointMm>> {
        let points = self.line(fields, all)?;
        let wrong = |at: usize, message: &str, help: &str| {
            let span = all.get(at).map(|it| it.span.clone()).unwrap_or_default();
            fields.report(Diagnostic::new(span, message, "here").help(help));
            None
        };
        if points.first() == points.last() {
            let message = "the last point is the first one again";
            return wrong(points.len() - 1, message, "leave it out: the outline closes by itself");
        }
        if let Some(at) = super::sound::crossing(&points) {
            let message = "the outline crosses or touches itself behind this point";
            return wrong(at, message, "give the corners in their order around");
        }
        Some(points)
    }
}

fn name(fields: &mut Fields<'_>) -> Option<String> {
    let Spanned { value, span } = fields.text("name")?;
    let count = value.chars().count();
    let plain = value.trim() == value && !value.chars().any(char::is_control);
    if (1..=MAX_NAME).contains(&count) && plain {
        return Some(value);
    }
    let message = format!("{} is no name", quoted(&value));
    let help = format!("use 1 to {MAX_NAME} characters, without a space at either end");
    fields.report(Diagnostic::new(span, message, "no name").help(help));
    None
}

fn degrees(fields: &mut Fields<'_>, key: &'static str) -> Option<i32> {
    fields.integer::<i32>(key, ANGLES)
}

fn line(fields: &mut Fields<'_>, on: &On) -> Option<Line> {
    let closed = fields.optional_flag("closed").ok().map(Option::unwrap_or_default);
    let least = if closed == Some(true) { 3 } else { 2 };
    let points = fields.points("points_mm", &COORDINATES, &(least..=MAX_POINTS));
    let points = points.and_then(|it| match closed {
        Some(true) => on.closed(fields, &it),
        _ => on.line(fields, &it),
    });
    Some(Line { points: points?, is_closed: closed? })
}

fn door(fields: &mut Fields<'_>, on: &On) -> Option<Door> {
    let name = name(fields);
    let span = fields.span_of("latch_mm");
    let (hinge, latch) = (on.point(fields, "hinge_mm"), on.point(fields, "latch_mm"));
    let swing = fields.optional_integer::<i32>("swing_deg", SWINGS);
    let glass = fields.optional_flag("glass");
    let state = fields.choice("state", "state of a door", &["open", "closed"]);
    let (hinge, latch) = (hinge?, latch?);
    let square = super::sound::square(hinge, latch);
    if !(DOORS.start().pow(2)..=DOORS.end().pow(2)).contains(&square) {
        let (least, most) = (DOORS.start(), DOORS.end());
        let wide = (square as f64).sqrt().round();
        let message = format!("this door is {wide} mm wide; {least} to {most} are allowed");
        let it = Diagnostic::new(span, message, "too near or too far");
        fields.report(it.help("change `hinge_mm` or `latch_mm`"));
        return None;
    }
    Some(Door {
        name: name?,
        hinge,
        latch,
        swing_deg: swing.ok()?,
        is_glass: glass.ok()?.unwrap_or_default(),
        is_open: state? == "open",
    })
}

fn piece(fields: &mut Fields<'_>, on: &On) -> Option<Furniture> {
    let name = name(fields);
    let charted = fields.optional_flag("charted");
    let radius = fields.optional_integer::<i32>("radius_mm", 10..=MAX_MM / 2);
    let outline = if matches!(radius, Ok(None)) {
        on.outline(fields).map(Outline::Corners)
    } else {
        let span = fields.span_of("radius_mm");
        let centre = on.point(fields, "centre_mm");
        let (centre, radius) = (centre?, radius.ok()??);
        let fits = |axis: usize| {
            let at = i64::from(centre[axis]);
            at >= i64::from(radius) && at + i64::from(radius) <= on.size[axis]
        };
        if !fits(0) || !fits(1) {
            let message = format!("a disc of {radius} mm around {centre:?} leaves the floor");
            let it = Diagnostic::new(span, message, "too large here");
            fields.report(it.help("move it, or make it smaller"));
            return None;
        }
        Some(Outline::Round { centre, radius })
    };
    Some(Furniture { name: name?, outline: outline?, is_charted: charted.ok()?.unwrap_or(true) })
}

fn mark(fields: &mut Fields<'_>, on: &On) -> Option<Mark> {
    let name = name(fields);
    let at = on.point(fields, "at_mm");
    let facing_deg = degrees(fields, "facing_deg");
    let size = fields.integer::<i32>("size_mm", 10..=2_000);
    Some(Mark { name: name?, at: at?, facing_deg: facing_deg?, size: size? })
}

fn place(fields: &mut Fields<'_>, on: &On, is_dock: bool) -> Option<Place> {
    let name = name(fields);
    let at = on.point(fields, "at_mm");
    let heading = if is_dock {
        degrees(fields, "heading_deg").map(Some)
    } else {
        fields.optional_integer::<i32>("heading_deg", ANGLES).ok()
    };
    Some(Place { name: name?, at: at?, heading_deg: heading? })
}

fn zone(fields: &mut Fields<'_>, on: &On) -> Option<Zone> {
    let name = name(fields);
    let outline = on.outline(fields);
    Some(Zone { name: name?, outline: outline? })
}
