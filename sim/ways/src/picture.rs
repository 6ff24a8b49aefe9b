//! A map as a picture: the corridor, the lines of the discs, and the tracks of trials.

use crate::ring::{DISC_M, Ring};
use cotama_floor::Point;
use std::fmt::Write;

/// A track of a robot's centre, and whether it came to the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Places, one a period.
    pub places: Vec<Point>,
    /// Whether the goal was reached.
    pub is_success: bool,
}

/// Pixels of a metre.
const SCALE: f64 = 60.0;

/// Draws a ring with tracks as SVG. Tracks that failed end with a cross.
pub fn to_svg(ring: &Ring, tracks: &[Track]) -> String {
    let [wide, high] = ring.size.map(|it| it * SCALE);
    let at = |it: Point| (it.x * SCALE, high - it.y * SCALE);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide:.1} {high:.1}\">\n\
         <title>Two ways around an obstacle</title>\n<rect width=\"{wide:.1}\" \
         height=\"{high:.1}\" fill=\"#fff\" stroke=\"#1b1f24\" stroke-width=\"4\"/>\n"
    );
    let line = |points: &mut dyn Iterator<Item = Point>| {
        let points: Vec<_> = points
            .map(|it| {
                let (x, y) = at(it);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        points.join(" ")
    };
    let corners = line(&mut ring.obstacle.into_iter());
    let _ = writeln!(text, "<polygon points=\"{corners}\" fill=\"#8b96a3\"/>");
    for crossing in ring.all() {
        let ((x1, y1), (x2, y2)) = (at(crossing.from), at(crossing.to));
        let _ = writeln!(
            text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#2f6f9f\" \
             stroke-opacity=\".25\" stroke-linecap=\"round\" stroke-width=\"{:.1}\"/>",
            2.0 * DISC_M * SCALE
        );
    }
    for (way, dash) in ring.ways.iter().zip(["none", "6 6"]) {
        let points = line(&mut way.points().iter().copied());
        let _ = writeln!(
            text,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"#57606a\" \
             stroke-dasharray=\"{dash}\"/>"
        );
    }
    let ends = [ring.ways[0].points().first(), ring.ways[0].points().last()];
    for (end, name) in ends.into_iter().flatten().zip(["start", "goal"]) {
        let (x, y) = at(*end);
        let _ = writeln!(
            text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#1b1f24\"/><text x=\"{:.1}\" \
             y=\"{:.1}\" font-family=\"sans-serif\" font-size=\"14\">{name}</text>",
            x + 9.0,
            y - 9.0
        );
    }
    for track in tracks {
        let colour = if track.is_success { "#15803d" } else { "#c2410c" };
        let points = line(&mut track.places.iter().copied());
        let _ = writeln!(
            text,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"3\"/>"
        );
        if let Some(end) = track.places.last().filter(|_| !track.is_success) {
            let (x, y) = at(*end);
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {:.1}l16 16m0 -16l-16 16\" stroke=\"{colour}\" \
                 stroke-width=\"4\"/>",
                x - 8.0,
                y - 8.0
            );
        }
    }
    text + "</svg>\n"
}
