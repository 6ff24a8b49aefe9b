//! A way over a floor, and what lies along it.

use crate::geometry::{Point, Pose, Vector, cross, is_inside, nearest_part, sides};
use std::ops::Range;

/// A way of straight pieces. Places on it are lengths along it, in metres.
///
/// ```
/// use cotama_floor::{Path, Point};
/// let path = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]].map(Point::from).to_vec();
/// let path = Path::new(path).unwrap();
/// assert_eq!((path.length(), path.length_mm()), (7.0, 7_000));
/// assert_eq!(path.pose(5.0).translation.vector, Point::new(4.0, 1.0).coords);
/// let place = path.project(Point::new(1.0, 0.5));
/// assert_eq!((place.along, place.aside), (1.0, 0.5));
/// let zone = [[2.0, -1.0], [5.0, -1.0], [5.0, 2.0], [2.0, 2.0]].map(Point::from);
/// assert_eq!(path.spans(&zone), [2.0..6.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    points: Vec<Point>,
    /// The length up to each point.
    lengths: Vec<f64>,
}

/// The place on a path that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// The length along the path, in metres.
    pub along: f64,
    /// How far the point is from it, in metres: positive to the left.
    pub aside: f64,
}

impl Path {
    /// A way through points; of those that follow each other and are the same one is kept. `None`
    /// without two different ones, or with one that is not finite.
    pub fn new(mut points: Vec<Point>) -> Option<Self> {
        points.dedup();
        if points.len() < 2 || points.iter().any(|it| !it.iter().all(|it| it.is_finite())) {
            return None;
        }
        let mut lengths = Vec::with_capacity(points.len());
        let mut length = 0.0;
        let mut last = points.first().copied()?;
        for point in &points {
            length += (point - last).norm();
            lengths.push(length);
            last = *point;
        }
        Some(Self { points, lengths })
    }

    /// The points.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The length in metres.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The length in mm, as missions count: to the nearest one.
    pub fn length_mm(&self) -> u64 {
        (self.length() * 1_000.0).round() as u64
    }

    /// Each piece with the length before it.
    fn pieces(&self) -> impl Iterator<Item = (f64, Point, Point)> {
        let ends = self.points.iter().zip(self.points.iter().skip(1));
        self.lengths.iter().zip(ends).map(|(before, (from, to))| (*before, *from, *to))
    }

    /// Returns the place after a length, with the heading there; the ends for lengths beyond them.
    pub fn pose(&self, along: f64) -> Pose {
        let last = self.lengths.len().saturating_sub(2);
        let piece = self.lengths.partition_point(|it| *it <= along).saturating_sub(1).min(last);
        let Some((before, from, to)) = self.pieces().nth(piece) else { return Pose::identity() };
        let way = to - from;
        let part = ((along - before) / way.norm()).clamp(0.0, 1.0);
        Pose::new((from + way * part).coords, libm::atan2(way.y, way.x))
    }

    /// Returns the place that is nearest to a point; of several the first.
    pub fn project(&self, at: Point) -> Projection {
        self.project_between(at, 0.0, self.length())
    }

    /// Returns the place that is nearest to a point between two lengths: where a path comes near
    /// itself, whoever follows it knows about where it is.
    pub fn project_between(&self, at: Point, from: f64, to: f64) -> Projection {
        let mut best = Projection { along: 0.0, aside: f64::INFINITY };
        for (before, a, b) in self.pieces() {
            let way = b - a;
            let length = way.norm();
            if before > to || before + length < from {
                continue;
            }
            let limit = |it: f64| ((it - before) / length).clamp(0.0, 1.0);
            let part = nearest_part(a, b, at).clamp(limit(from), limit(to));
            let off: Vector = at - (a + way * part);
            let distance = off.norm();
            if distance < best.aside.abs() {
                let aside = if cross(way, off) < 0.0 { -distance } else { distance };
                best = Projection { along: before + length * part, aside };
            }
        }
        best
    }

    /// Returns the stretches of the path inside a polygon, in their order.
    pub fn spans(&self, corners: &[Point]) -> Vec<Range<f64>> {
        let mut spans: Vec<Range<f64>> = Vec::new();
        let mut cuts = Vec::new();
        for (before, from, to) in self.pieces() {
            let way = to - from;
            cuts.clear();
            cuts.extend([0.0, 1.0]);
            for (a, b) in sides(corners) {
                let side = b - a;
                let turn = cross(way, side);
                let part = cross(a - from, side) / turn;
                let other = cross(a - from, way) / turn;
                if turn != 0.0 && (0.0..=1.0).contains(&part) && (0.0..=1.0).contains(&other) {
                    cuts.push(part);
                }
            }
            cuts.sort_by(f64::total_cmp);
            let length = way.norm();
            for (start, end) in cuts.iter().zip(cuts.iter().skip(1)) {
                if end <= start || !is_inside(corners, from + way * f64::midpoint(*start, *end)) {
                    continue;
                }
                let span = before + start * length..before + end * length;
                match spans.last_mut() {
                    Some(last) if span.start - last.end < 1e-9 => last.end = span.end,
                    _ => spans.push(span),
                }
            }
        }
        spans
    }
}
