//! A floor as a picture: one SVG file, in light and dark, for screen and paper.

use crate::floor::{Door, Floor, Line, metres};
use crate::geometry::Point;
use crate::grid::{Cell, Grid};
use crate::path::Path;
use crate::surface::Surface;
use cotama_core::text::markup;
use cotama_drawing::elements::Elements;
use cotama_drawing::svg::width;
use std::fmt::{Display, Write as _};

/// Pixels of a metre of a drawing, its largest width in pixels, and the margin around.
const SCALE: f64 = 40.0;
const WIDE: f64 = 1_200.0;
const MARGIN: f64 = 24.0;
/// Width of a picture of a map, in pixels.
const MAP: f64 = 1_000.0;

/// The style sheet of pictures, with the colours of all drawings.
pub const STYLE: &str = concat!(
    cotama_drawing::palette!(".floor"),
    "\
.floor{--ground:#fbfaf6;--zone:#2f6f9f;--glass:#2b8fb8;--wood:#b7793a;--piece:#e3ddcf;\
--way:#c2410c;--mark:#1b1f24}
@media screen and (prefers-color-scheme:dark){.floor{--ground:#1a2027;--zone:#6cb2f5;\
--glass:#63c3e8;--wood:#d9a066;--piece:#38404a;--way:#fb923c;--mark:#e6eaef}}
.floor .paper{fill:#fff;fill:var(--paper)}
.floor .ground{fill:#fbfaf6;fill:var(--ground)}
.floor text{fill:#1b1f24;fill:var(--ink);font-size:12px;text-anchor:middle;paint-order:stroke;\
stroke:#fff;stroke:var(--paper);stroke-width:3;stroke-linejoin:round;stroke-opacity:.8}
.floor .small{fill:#57606a;fill:var(--quiet);font-size:10px}
.floor .rule{fill:none;stroke:#57606a;stroke:var(--quiet);stroke-width:1}
.floor .zone{fill:#2f6f9f;fill:var(--zone);fill-opacity:.07;stroke:#2f6f9f;stroke:var(--zone);\
stroke-opacity:.45;stroke-width:1;stroke-dasharray:2 4}
.floor .piece{fill:#e3ddcf;fill:var(--piece);stroke:#4b5561;stroke:var(--line);stroke-width:.8;\
stroke-linejoin:round}
.floor .surprise{stroke-dasharray:3 2;fill-opacity:.5}
.floor .wall{fill:none;stroke:#1b1f24;stroke:var(--ink);stroke-width:3.4;stroke-linecap:square}
.floor .glass{fill:none;stroke:#2b8fb8;stroke:var(--glass);stroke-width:2.4;\
stroke-dasharray:9 4}
.floor .leaf{fill:none;stroke:#b7793a;stroke:var(--wood);stroke-width:2.6;stroke-linecap:round}
.floor .leaf.glass{stroke:#2b8fb8;stroke:var(--glass)}
.floor .swing{fill:none;stroke:#b7793a;stroke:var(--wood);stroke-width:.7;\
stroke-dasharray:2 2.5}
.floor .mark{fill:#1b1f24;fill:var(--mark)}
.floor .place{fill:#fff;fill:var(--paper);stroke:#1b1f24;stroke:var(--ink);stroke-width:1.4}
.floor .heading{fill:none;stroke:#1b1f24;stroke:var(--ink);stroke-width:1.4}
.floor .halo{fill:none;stroke:#fff;stroke:var(--paper);stroke-width:7;stroke-opacity:.75;\
stroke-linejoin:round;stroke-linecap:round}
.floor .way{fill:none;stroke:#c2410c;stroke:var(--way);stroke-width:3;stroke-linejoin:round;\
stroke-linecap:round}
.floor .end{fill:#c2410c;fill:var(--way)}
.floor .occupied{fill:#1b1f24;fill:var(--ink)}
.floor .unknown{fill:#8b96a3;fill:var(--line);fill-opacity:.35}
@media print{.floor .zone{fill-opacity:0}.floor .piece{fill:#eee}.floor .way{stroke:#000}}
"
);

/// The pixels of a picture: to the right, and down.
#[derive(Clone, Copy, Debug)]
pub struct Pixels {
    least: Point,
    top: f64,
    /// The pixels of a metre.
    pub scale: f64,
}

/// A number of pixels, to a tenth, without a needless point.
struct Px(f64);

impl Display for Px {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let tenths = (self.0 * 10.0).round() as i64;
        let sign = if tenths < 0 { "-" } else { "" };
        let (whole, part) = (tenths.abs() / 10, tenths.abs() % 10);
        if part == 0 { write!(f, "{sign}{whole}") } else { write!(f, "{sign}{whole}.{part}") }
    }
}

impl Pixels {
    /// Returns the pixels of a point.
    pub fn at(&self, point: Point) -> [f64; 2] {
        [(point.x - self.least.x) * self.scale + MARGIN, (self.top - point.y) * self.scale + MARGIN]
    }

    fn px(&self, point: Point) -> [Px; 2] {
        self.at(point).map(Px)
    }

    /// The commands of a line through points.
    fn line(&self, points: impl IntoIterator<Item = Point>, is_closed: bool) -> String {
        let mut out = String::new();
        for (at, point) in points.into_iter().enumerate() {
            let [x, y] = self.px(point);
            let command = if at == 0 { 'M' } else { 'L' };
            // Writing into a string cannot fail.
            let _ = write!(out, "{command}{x} {y}");
        }
        if is_closed {
            out.push('Z');
        }
        out
    }
}

fn head(out: &mut Elements, size: [f64; 2], title: &str, words: &str) {
    let [wide, high] = size.map(Px);
    out.add(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"floor\" width=\"{wide}\" \
         height=\"{high}\" viewBox=\"0 0 {wide} {high}\" role=\"img\">\n"
    ));
    out.title(title);
    if !words.is_empty() {
        out.add(format_args!("<desc>{}</desc>\n", markup(words)));
    }
    out.add(format_args!("<style>\n{STYLE}</style>\n"));
    out.rect("paper", [0.0, 0.0].map(Px), size.map(Px));
    out.push_str("\n");
}

/// A rule of a few metres below the picture.
fn rule(out: &mut Elements, view: &Pixels, size: [f64; 2], metres: f64) {
    let (left, y) = (MARGIN, size[1] - 10.0);
    let right = left + metres * view.scale;
    out.path(
        "rule",
        format_args!("M{} {}v5h{}v-5", Px(left), Px(y - 5.0), Px(metres * view.scale)),
    );
    out.text("small", [Px(right + 16.0), Px(y + 1.0)], &format!("{metres} m"));
    out.push_str("\n");
}

fn way(out: &mut Elements, view: &Pixels, path: &Path) {
    let line = view.line(path.points().iter().copied(), false);
    out.path("halo", &line);
    out.path("way", &line);
    for end in [path.points().first(), path.points().last()].into_iter().flatten() {
        out.circle("end", view.px(*end), Px(4.5));
    }
    out.push_str("\n");
}

/// Draws a floor, and a way over it if there is one.
///
/// ```
/// let office = cotama_floor::embedded::OFFICE.floor().unwrap();
/// let picture = cotama_floor::picture::floor(&office, None);
/// assert!(picture.starts_with("<svg xmlns=") && picture.contains("office B"));
/// ```
pub fn floor(floor: &Floor, path: Option<&Path>) -> String {
    floor_under(floor, path, |_| String::new())
}

/// Draws the same under more markup, which is made with the pixels of points and those of a metre.
pub fn floor_under(
    floor: &Floor,
    path: Option<&Path>,
    over: impl FnOnce(&Pixels) -> String,
) -> String {
    let bounds = floor.bounds();
    let scale = SCALE.min(WIDE / bounds.width());
    let view = Pixels { least: bounds.least, top: bounds.most.y, scale };
    let ground = [bounds.width() * scale, bounds.height() * scale];
    let size = [ground[0] + 2.0 * MARGIN, ground[1] + 2.0 * MARGIN + 12.0];
    let mut out = Elements::default();
    head(&mut out, size, &floor.name, &floor.title);
    out.rect("ground", [MARGIN, MARGIN].map(Px), ground.map(Px));
    out.push_str("\n<g>");
    for zone in &floor.zones {
        out.push_str("<g>");
        out.title(&zone.name);
        out.path("zone", view.line(zone.corners(), true));
        out.push_str("</g>\n");
    }
    for piece in &floor.furniture {
        out.push_str("<g>");
        out.title(&piece.name);
        let class = if piece.is_charted { "piece" } else { "piece surprise" };
        out.path(class, view.line(piece.corners(), true));
        out.push_str("</g>\n");
    }
    out.push_str("</g>\n<g>");
    for (lines, class) in [(&floor.walls, "wall"), (&floor.glass, "glass")] {
        for Line { points, is_closed } in lines {
            out.path(class, view.line(points.iter().map(|it| metres(*it)), *is_closed));
        }
    }
    out.push_str("</g>\n");
    floor.doors.iter().for_each(|it| door(&mut out, &view, it));
    for mark in &floor.marks {
        let [x, y] = view.at(metres(mark.at));
        out.push_str("<g>");
        out.title(&mark.name);
        out.rect("mark", [Px(x - 3.0), Px(y - 3.0)], [Px(6.0), Px(6.0)]);
        out.push_str("</g>\n");
    }
    if let Some(path) = path {
        way(&mut out, &view, path);
    }
    places(&mut out, &view, floor);
    rule(&mut out, &view, size, 5.0);
    out.push_str(&over(&view));
    out.push_str("</svg>\n");
    out.into_string()
}

fn door(out: &mut Elements, view: &Pixels, door: &Door) {
    out.push_str("<g>");
    out.title(&door.name);
    if let (Some([_, closed]), Some([hinge, open])) = (door.leaf(false), door.leaf(true)) {
        let radius = Px((closed - hinge).norm() * view.scale);
        let ([x, y], [to_x, to_y]) = (view.px(closed), view.px(open));
        let turn = i32::from(door.swing_deg.unwrap_or(0) < 0);
        out.path("swing", format_args!("M{x} {y}A{radius} {radius} 0 0 {turn} {to_x} {to_y}"));
    }
    let class = if door.is_glass { "leaf glass" } else { "leaf" };
    if let Some(leaf) = door.leaf(door.is_open) {
        out.path(class, view.line(leaf, false));
    } else if let Some([hinge, latch]) = door.leaf(false) {
        // The leaf of a sliding door lies beside its opening.
        out.path(class, view.line([hinge, hinge - (latch - hinge) * 0.25], false));
    }
    out.push_str("</g>\n");
}

fn places(out: &mut Elements, view: &Pixels, floor: &Floor) {
    let all = floor.places.iter().map(|it| (it, false));
    for (place, is_dock) in all.chain(floor.docks.iter().map(|it| (it, true))) {
        let [x, y] = view.at(metres(place.at));
        out.push_str("<g>");
        if is_dock {
            out.rounded("place", [Px(x - 9.0), Px(y - 7.0)], [Px(18.0), Px(14.0)], Px(3.0));
            out.path("heading", format_args!("M{} {}l-3 5h4l-3 5", Px(x + 1.5), Px(y - 5.0)));
        } else {
            out.circle("place", [Px(x), Px(y)], Px(4.5));
            if let Some(degrees) = place.heading_deg {
                let (sin, cos) = libm::sincos(f64::from(degrees).to_radians());
                let from = [Px(x + 4.5 * cos), Px(y - 4.5 * sin)];
                out.line("heading", from, [Px(x + 12.0 * cos), Px(y - 12.0 * sin)]);
            }
        }
        // Near the sides of the picture the name moves inwards.
        let half = width(&place.name, 12) as f64 / 2.0;
        let right = floor.bounds().width() * view.scale + MARGIN;
        let middle = x.max(MARGIN + half + 4.0).min(right - half - 4.0);
        out.text("", [Px(middle), Px(y + 22.0)], &place.name);
        out.push_str("</g>\n");
    }
}

/// Draws a map, and a way over it if there is one.
///
/// ```
/// use cotama_floor::{Cell, Grid, Point, picture};
/// let cells = [Cell::Free, Cell::Occupied, Cell::Unknown, Cell::Unknown];
/// let grid = Grid::new(2, &cells, 0.5, Point::origin()).unwrap();
/// assert!(picture::grid("tiny", &grid, None).contains("class=\"unknown\""));
/// ```
pub fn grid(name: &str, grid: &Grid, path: Option<&Path>) -> String {
    grid_under(name, grid, path, |_| String::new())
}

/// Draws the same under more markup, which is made with the pixels of points and those of a metre.
pub fn grid_under(
    name: &str,
    grid: &Grid,
    path: Option<&Path>,
    over: impl FnOnce(&Pixels) -> String,
) -> String {
    let bounds = grid.bounds();
    let scale = MAP / bounds.width();
    let view = Pixels { least: bounds.least, top: bounds.most.y, scale };
    let size = [MAP + 2.0 * MARGIN, bounds.height() * scale + 2.0 * MARGIN + 12.0];
    let mut out = Elements::default();
    head(&mut out, size, name, "");
    out.rect("ground", [MARGIN, MARGIN].map(Px), [Px(MAP), Px(bounds.height() * scale)]);
    let side = grid.resolution() * scale;
    for (kind, class) in [(Cell::Unknown, "unknown"), (Cell::Occupied, "occupied")] {
        let mut runs = String::new();
        for y in 0..grid.height() {
            let mut x = 0;
            while x < grid.width() {
                let start = x;
                while x < grid.width() && grid.cell(x, y) == kind {
                    x += 1;
                }
                if x > start {
                    let left = MARGIN + start as f64 * side;
                    let top = MARGIN + (grid.height() - 1 - y) as f64 * side;
                    let wide = Px((x - start) as f64 * side);
                    let _ = write!(runs, "M{} {}h{wide}v{}h-{wide}Z", Px(left), Px(top), Px(side));
                }
                x += 1;
            }
        }
        out.path(class, runs);
        out.push_str("\n");
    }
    if let Some(path) = path {
        way(&mut out, &view, path);
    }
    let rules = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let metres = rules.into_iter().find(|it| it * scale >= 60.0).unwrap_or(200.0);
    rule(&mut out, &view, size, metres);
    out.push_str(&over(&view));
    out.push_str("</svg>\n");
    out.into_string()
}
