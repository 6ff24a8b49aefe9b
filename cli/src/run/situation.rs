//! The situation in which an operator is asked, drawn for a terminal.

use crate::render::numbers::seconds;
use cotama_floor::{Held, Point, Surface, metres};
use cotama_sim::trace::{Pose, Record, Request, Trace};
use std::fmt::Write;

/// The floor that is drawn around the robot: characters, and how wide and high each is, in metres.
const COLUMNS: i32 = 60;
const ROWS: i32 = 15;
const WIDE: f64 = 0.2;
const HIGH: f64 = 0.4;

/// Returns the situation at a request, by its number, in words, and over a floor as a picture.
pub(super) fn words(trace: &Trace, number: usize, request: &Request, width: usize) -> String {
    let mut text = format!(
        "request {} after {}, at {}.{} m: {}; {}\n",
        number + 1,
        seconds(request.t_us / 1_000),
        request.x_mm / 1_000,
        request.x_mm % 1_000 / 100,
        request.cause,
        request.reason,
    );
    let before = trace.records.iter().take_while(|it| it.t_us() <= request.t_us);
    let pose = before.filter_map(|it| match it {
        Record::Pose(it) => Some(it),
        _ => None,
    });
    if let Some(picture) = pose.last().and_then(|it| picture(trace, it, width)) {
        text += &picture;
    }
    text.truncate(text.trim_end().len());
    text
}

/// Draws the floor as it is around the robot.
fn picture(trace: &Trace, pose: &Pose, width: usize) -> Option<String> {
    let way = trace.header.floor.as_ref()?.way(&trace.header.mission);
    let [real, _] = Held::of(&way).ok()?;
    let columns = COLUMNS.min(i32::try_from(width).unwrap_or(COLUMNS) - 2);
    let robot = metres(pose.at_mm);
    let path: Vec<_> = way.legs.iter().flatten().map(|it| &it.points).collect();
    let people: Vec<_> = pose.people_mm.iter().map(|it| metres(*it)).collect();
    let mut text = String::new();
    for row in 0..ROWS {
        let mut line = String::from("  ");
        for column in 0..columns {
            let (right, up) = (column - columns / 2, ROWS / 2 - row);
            let at = [f64::from(right) * WIDE, f64::from(up) * HIGH];
            let at = Point::new(robot.x + at[0], robot.y + at[1]);
            let is_here =
                |it: &Point| (it.x - at.x).abs() <= WIDE / 2.0 && (it.y - at.y).abs() <= HIGH / 2.0;
            line.push(match () {
                () if (right, up) == (0, 0) => arrow(pose.heading_mrad),
                () if people.iter().any(is_here) => 'o',
                () if is_wall(real.surface(), at) => '#',
                () if path.iter().any(|it| passes(it, at)) => '.',
                () => ' ',
            });
        }
        text += line.trim_end();
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "  {} the robot, # what stands there, . its path, o people and things; {} m by {} m",
        arrow(pose.heading_mrad),
        (f64::from(columns) * WIDE).round(),
        (f64::from(ROWS) * HIGH).round(),
    );
    Some(text)
}

/// Whether something stands in a cell around a point.
fn is_wall(surface: &dyn Surface, at: Point) -> bool {
    surface.clearance(at, HIGH) < WIDE / 2.0 * core::f64::consts::SQRT_2
}

/// Whether a path leads through a cell around a point.
fn passes(path: &[[i32; 2]], at: Point) -> bool {
    path.iter().zip(path.iter().skip(1)).any(|(from, to)| {
        let (from, to) = (metres(*from), metres(*to));
        let way = to - from;
        let part = ((at - from).dot(&way) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        let off = from + way * part - at;
        off.x.abs() <= WIDE / 2.0 && off.y.abs() <= HIGH / 2.0
    })
}

/// The character of a heading.
fn arrow(heading_mrad: i32) -> char {
    // Quarters of a turn, from half a quarter before the x axis on.
    match (f64::from(heading_mrad) / 1_000.0 / core::f64::consts::FRAC_PI_2).round() as i32 {
        0 => '>',
        1 => '^',
        -1 => 'v',
        _ => '<',
    }
}
