//! The ring corridor of a map: walls, both ways, and the lines on which discs move.

use crate::maps::Map;
use cotama_devices::Disc;
use cotama_floor::{Bounds, Kind, Path, Point, Segment, Segments, Vector};

/// Outer measures in metres (Rohrmueller 2011, section 4.5.2).
pub const SIZE_M: [f64; 2] = [10.88, 6.8];
/// Width of the corridor in metres; the thesis draws it.
pub const CORRIDOR_M: f64 = 2.0;
/// Radius of a disc in metres (section 4.5.2).
pub const DISC_M: f64 = 0.3;
/// Length of the short way in metres; the place of start and goal is a drawing in the thesis.
const SHORT_M: f64 = 10.0;

/// The way that a robot takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// The short one, clockwise from the start in a map that is not mirrored.
    Short,
    /// The long one.
    Long,
}

impl Way {
    /// Both ways, the short one first.
    pub const ALL: [Self; 2] = [Self::Short, Self::Long];

    /// The name of its state in networks.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Short => "short",
            Self::Long => "long",
        }
    }

    /// The other way.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Short => Self::Long,
            Self::Long => Self::Short,
        }
    }
}

/// A line across the corridor on which the centre of a disc moves to and fro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// One end.
    pub from: Point,
    /// The other end.
    pub to: Point,
}

impl Crossing {
    /// The disc after a time in seconds, at a speed in m/s. Its phase is the part of a whole way
    /// to and fro that lay behind it at first.
    ///
    /// ```
    /// use cotama_floor::Point;
    /// use cotama_ways::Crossing;
    /// let crossing = Crossing { from: Point::new(0.0, 0.0), to: Point::new(0.0, 2.0) };
    /// let y = |time| crossing.disc(0.25, 0.5, time).centre.y;
    /// assert_eq!([y(0.0), y(2.0), y(6.0), y(8.0)], [1.0, 2.0, 0.0, 1.0]);
    /// ```
    pub fn disc(&self, phase: f64, speed: f64, time: f64) -> Disc {
        let way = self.to - self.from;
        let whole = 2.0 * way.norm();
        let turn = (phase + speed * time / whole).rem_euclid(1.0);
        let part = if turn <= 0.5 { 2.0 * turn } else { 2.0 - 2.0 * turn };
        Disc { centre: self.from + way * part, radius: DISC_M }
    }
}

/// The corridor of a map.
#[derive(Clone, Debug)]
pub struct Ring {
    /// Walls: the border and the obstacle in the middle.
    pub surface: Segments,
    /// Outer measures as the map is turned.
    pub size: [f64; 2],
    /// Corners of the obstacle.
    pub obstacle: [Point; 4],
    /// The short and the long way, each from the start to the goal.
    pub ways: [Path; 2],
    /// Lines of the discs on the short and on the long way, in the order of each way.
    pub crossings: [Vec<Crossing>; 2],
}

impl Ring {
    /// The ring of a map, with a corridor of a width in metres from 1.0 to 3.0; `None` for another
    /// width.
    pub fn new(map: &Map, corridor: f64) -> Option<Self> {
        if !(1.0..=3.0).contains(&corridor) {
            return None;
        }
        let [wide, high] = SIZE_M;
        let place = |it: Point| placed(it, *map);
        let inner = [
            [corridor, corridor],
            [wide - corridor, corridor],
            [wide - corridor, high - corridor],
            [corridor, high - corridor],
        ];
        let obstacle = inner.map(|it| place(Point::from(it)));
        let size = if map.quarters.is_multiple_of(2) { [wide, high] } else { [high, wide] };
        let bounds = Bounds { least: Point::origin(), most: Point::from(size) };
        let border = [[0.0, 0.0], [wide, 0.0], [wide, high], [0.0, high]];
        let border = border.map(|it| place(Point::from(it)));
        let wall =
            |it: usize| Segment { from: border[it], to: border[(it + 1) % 4], kind: Kind::Wall };
        let solid: (&[Point], Kind) = (&obstacle, Kind::Furniture);
        let surface = Segments::new(bounds, &[0, 1, 2, 3].map(wall), &[solid]).ok()?;
        let line = Line { corridor };
        let shift = f64::from(map.shift_percent) / 100.0 * line.length();
        let from = line.start() + shift;
        let short = line.between(from, SHORT_M);
        let long = line.between(from, SHORT_M - line.length());
        let path = |points: Vec<Point>| Path::new(points.into_iter().map(place).collect());
        let ways = [path(short)?, path(long)?];
        let count = map.ratio.discs();
        let half = corridor / 2.0 - DISC_M;
        let crossings = [0, 1].map(|way: usize| {
            let path: &Path = &ways[way];
            let at = |it: usize| {
                let pose = path.pose(path.length() * (it + 1) as f64 / (count[way] + 1) as f64);
                let across = pose.rotation * Vector::new(0.0, half);
                let middle = Point::from(pose.translation.vector);
                Crossing { from: middle - across, to: middle + across }
            };
            (0..count[way]).map(at).collect()
        });
        Some(Self { surface, size, obstacle, ways, crossings })
    }

    /// The path of a way.
    pub const fn path(&self, way: Way) -> &Path {
        match way {
            Way::Short => &self.ways[0],
            Way::Long => &self.ways[1],
        }
    }

    /// All crossings, those of the short way first.
    pub fn all(&self) -> impl Iterator<Item = &Crossing> {
        self.crossings.iter().flatten()
    }
}

/// The middle line of the corridor, clockwise from its left lower corner.
struct Line {
    corridor: f64,
}

impl Line {
    fn sides(&self) -> [f64; 2] {
        [SIZE_M[1] - self.corridor, SIZE_M[0] - self.corridor]
    }

    fn length(&self) -> f64 {
        2.0 * (self.sides()[0] + self.sides()[1])
    }

    /// The start: the middle of the left side.
    fn start(&self) -> f64 {
        self.sides()[0] / 2.0
    }

    /// Corners with their length along the line, and the first again at its end.
    fn corners(&self) -> [(f64, Point); 5] {
        let (half, [up, right]) = (self.corridor / 2.0, self.sides());
        let (x, y) = (SIZE_M[0] - half, SIZE_M[1] - half);
        [
            (0.0, Point::new(half, half)),
            (up, Point::new(half, y)),
            (up + right, Point::new(x, y)),
            (2.0 * up + right, Point::new(x, half)),
            (self.length(), Point::new(half, half)),
        ]
    }

    fn at(&self, along: f64) -> Point {
        let along = along.rem_euclid(self.length());
        let corners = self.corners();
        let next = (1..4).find(|it| along <= corners[*it].0).unwrap_or(4);
        let ((before, from), (after, to)) = (corners[next - 1], corners[next]);
        from + (to - from) * ((along - before) / (after - before))
    }

    /// Points from a place over a length, clockwise, or the other way round if it is below 0.
    fn between(&self, from: f64, length: f64) -> Vec<Point> {
        let whole = self.length();
        let sign = if length < 0.0 { -1.0 } else { 1.0 };
        let mut corners: Vec<f64> = self.corners()[..4]
            .iter()
            .map(|it| (sign * (it.0 - from)).rem_euclid(whole))
            .filter(|it| *it > 1e-9 && *it < length.abs() - 1e-9)
            .collect();
        corners.sort_by(f64::total_cmp);
        let all = std::iter::once(0.0).chain(corners).chain([length.abs()]);
        all.map(|it| self.at(from + sign * it)).collect()
    }
}

/// A point of the drawing as it lies in a map: mirrored, then turned, within the quarter of the
/// plane where both coordinates are at least 0.
fn placed(at: Point, map: Map) -> Point {
    let [wide, high] = SIZE_M;
    let (x, y) = if map.is_mirrored { (wide - at.x, at.y) } else { (at.x, at.y) };
    match map.quarters % 4 {
        0 => Point::new(x, y),
        1 => Point::new(high - y, x),
        2 => Point::new(wide - x, high - y),
        _ => Point::new(y, wide - x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::{MAPS, Ratio};
    use cotama_floor::Surface;

    #[test]
    fn both_ways_of_all_maps_lead_from_one_start_to_one_goal_around_the_obstacle() {
        for map in &MAPS {
            let ring = Ring::new(map, CORRIDOR_M).unwrap();
            let [short, long] = &ring.ways;
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b} {map:?}");
            near(short.length(), SHORT_M);
            near(short.length() + long.length(), 2.0 * (8.88 + 4.8));
            near((short.points()[0] - long.points()[0]).norm(), 0.0);
            let ends = [short, long].map(|it| *it.points().last().unwrap());
            near((ends[0] - ends[1]).norm(), 0.0);
            for path in [short, long] {
                for at in 0..=100 {
                    let pose = path.pose(path.length() * f64::from(at) / 100.0);
                    let at = Point::from(pose.translation.vector);
                    near(ring.surface.clearance(at, 1.0), 1.0);
                }
            }
        }
    }

    #[test]
    fn discs_keep_between_the_walls_and_their_number_is_the_ratio() {
        for map in &MAPS {
            let ring = Ring::new(map, CORRIDOR_M).unwrap();
            assert_eq!(ring.crossings.each_ref().map(Vec::len), map.ratio.discs());
            for crossing in ring.all() {
                for time in 0..40 {
                    let disc = crossing.disc(0.3, 0.6, f64::from(time) / 4.0);
                    let room = ring.surface.clearance(disc.centre, 2.0);
                    assert!(room >= DISC_M - 1e-9, "{room} {map:?}");
                }
            }
        }
        assert_eq!(MAPS[0].ratio, Ratio::R51);
    }
}
