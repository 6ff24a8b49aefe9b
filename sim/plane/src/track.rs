//! The path of a mission in the plane, with the lengths along it that the mission counts.

use crate::drivetrain::Drivetrain;
use cotama_floor::{Point, Pose, Vector, metres};
use cotama_models::missions::Way;
use nalgebra::{Complex, UnitComplex};

/// A path of straight pieces. Lengths along it are metres, those of the mission: each leg is as
/// long as the mission says, to the mm, and corners between lie in proportion.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    corners: Vec<Corner>,
    pieces: Vec<Piece>,
}

/// A corner of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The point.
    pub at: Point,
    /// The length up to there.
    pub along: f64,
    /// Whether there is so little room that a robot does not cut the corner.
    pub is_tight: bool,
}

/// A straight piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    /// The heading, as a turn from the x axis.
    heading: UnitComplex<f64>,
    /// Whether its end is a corner so sharp that a robot turns on the spot there.
    is_sharp: bool,
    /// The length up to the next place where a robot has to stand.
    stop: f64,
    /// The highest speed at its end, in m/s, for the bend there and for all that comes.
    speed: f64,
}

/// A place near a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Number of the piece.
    pub piece: usize,
    /// The length along the path.
    pub along: f64,
}

/// A part of a path: the corners behind its start, each with the length from there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rest {
    pub(crate) corners: Vec<(Point, f64, bool)>,
}

impl Rest {
    /// A way from its first point; `is_tight` says where there is little room.
    pub(crate) fn of(points: &[Point], is_tight: impl Fn(Point) -> bool) -> Self {
        let mut gone = 0.0;
        let ways = points.iter().zip(points.iter().skip(1));
        let corner = |(from, to): (&Point, &Point)| {
            gone += (to - from).norm();
            (*to, gone, is_tight(*to))
        };
        Self { corners: ways.map(corner).collect() }
    }

    /// Returns the length.
    pub(crate) fn length(&self) -> f64 {
        self.corners.last().map_or(0.0, |it| it.1)
    }

    /// The same, counted as no shorter than a length.
    pub(crate) fn no_shorter_than(self, length: f64) -> Self {
        let scale = (length / self.length().max(1e-9)).max(1.0);
        Self { corners: self.corners.iter().map(|it| (it.0, it.1 * scale, it.2)).collect() }
    }
}

/// Lengths along a track that are the same, in metres.
const SAME: f64 = 1e-6;

/// The way in which a robot takes a bend, in metres.
const BEND: f64 = 0.5;
/// The angles from which a robot turns on the spot, in radians: at corners with little room, 3
/// degrees, and at others, 50.
const SHARP: [f64; 2] = [core::f64::consts::PI / 60.0, core::f64::consts::PI / 3.6];

impl Track {
    /// Returns the path of a way; `None` where it has none, or less than two different points.
    /// `is_tight` says where there is little room.
    pub fn of(
        way: &Way,
        drivetrain: &Drivetrain,
        is_tight: impl Fn(Point) -> bool,
    ) -> Option<Self> {
        let (mut corners, mut before) = (Vec::<Corner>::new(), 0.0);
        for leg in way.legs.iter().flatten() {
            let points: Vec<Point> = leg.points.iter().map(|it| metres(*it)).collect();
            let ways =
                points.iter().zip(points.iter().skip(1)).map(|(from, to)| (to - from).norm());
            let ways: Vec<f64> = std::iter::once(0.0).chain(ways).collect();
            let whole: f64 = ways.iter().sum();
            let length = leg.length.0 as f64 / 1_000.0;
            let mut gone = 0.0;
            for (at, way) in points.iter().zip(&ways) {
                gone += way;
                let along = before + if whole > 0.0 { gone / whole * length } else { 0.0 };
                if corners.last().is_none_or(|it| it.at != *at) {
                    corners.push(Corner { at: *at, along, is_tight: is_tight(*at) });
                }
            }
            before += length;
        }
        (corners.len() > 1).then(|| Self::through(corners, drivetrain))
    }

    fn through(corners: Vec<Corner>, drivetrain: &Drivetrain) -> Self {
        let ends = corners.iter().zip(corners.iter().skip(1));
        let angles: Vec<f64> = ends.map(|(from, to)| angle(to.at - from.at)).collect();
        let piece = |(at, angle): (usize, &f64)| {
            let next = angles.get(at + 1);
            let tight = corners.get(at + 1).is_some_and(|it| it.is_tight);
            let most = if tight { SHARP[0] } else { SHARP[1] };
            let bend = next.map_or(0.0, |next| wrapped(next - angle).abs());
            let is_sharp = bend > most;
            // The time in which it turns as much, speeding up and slowing down evenly.
            let time = 2.0 * (bend / drivetrain.turn_acceleration).sqrt();
            let is_end = next.is_none() || is_sharp;
            let speed = if is_end { 0.0 } else { (BEND / time.max(1e-9)).min(drivetrain.speed) };
            let (sin, cos) = libm::sincos(*angle);
            let heading = UnitComplex::new_unchecked(Complex::new(cos, sin));
            Piece { heading, is_sharp, stop: 0.0, speed }
        };
        let mut pieces: Vec<_> = angles.iter().enumerate().map(piece).collect();
        let mut stop = corners.last().map_or(0.0, |it| it.along);
        let mut speed = f64::INFINITY;
        let starts = corners.iter().zip(corners.iter().skip(1));
        for (piece, (start, end)) in pieces.iter_mut().zip(starts).rev() {
            stop = if piece.is_sharp { end.along } else { stop };
            piece.stop = stop;
            piece.speed = piece.speed.min(speed);
            speed = braking(piece.speed, end.along - start.along, drivetrain);
        }
        Self { corners, pieces }
    }

    /// The same path the other way: lengths count from its end.
    #[must_use]
    pub fn back(&self, drivetrain: &Drivetrain) -> Self {
        let length = self.length();
        let turned = self.corners.iter().rev();
        let turned = turned.map(|it| Corner { along: length - it.along, ..*it }).collect();
        Self::through(turned, drivetrain)
    }

    /// Returns the place after a length.
    pub(crate) fn at(&self, along: f64) -> Near {
        let pieces = self.corners.len().saturating_sub(2);
        let ends = |it: &usize| self.end(*it).0 + SAME >= along;
        Near { piece: (0..pieces).find(ends).unwrap_or(pieces), along }
    }

    /// Returns the part from a place up to a length.
    pub(crate) fn part(&self, from: Near, to: f64) -> Rest {
        let behind = self.corners.iter().skip(from.piece + 1);
        let behind = behind.filter(|it| it.along > from.along + SAME && it.along < to - SAME);
        let mut corners: Vec<_> =
            behind.map(|it| (it.at, it.along - from.along, it.is_tight)).collect();
        let end = self.corners.iter().find(|it| (it.along - to).abs() <= SAME);
        let at =
            end.map_or_else(|| self.pose(from.piece, to).translation.vector.into(), |it| it.at);
        corners.push((at, to - from.along, end.is_some_and(|it| it.is_tight)));
        Rest { corners }
    }

    /// The same up to a place, and then these parts, one after the other; with that place.
    pub(crate) fn onto(&self, near: Near, rests: &[Rest], drivetrain: &Drivetrain) -> (Self, Near) {
        let before = self.corners.iter().take_while(|it| it.along < near.along - SAME);
        let mut corners: Vec<_> = before.copied().collect();
        let at = self.pose(near.piece, near.along).translation.vector.into();
        let piece = corners.len();
        corners.push(Corner { at, along: near.along, is_tight: true });
        let mut start = near.along;
        for rest in rests {
            for (at, along, is_tight) in &rest.corners {
                if corners.last().is_none_or(|it| it.at != *at) {
                    corners.push(Corner { at: *at, along: start + along, is_tight: *is_tight });
                }
            }
            start += rest.length();
        }
        (Self::through(corners, drivetrain), Near { piece, along: near.along })
    }

    /// Returns the corners.
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// Returns the length in metres.
    pub fn length(&self) -> f64 {
        self.corners.last().map_or(0.0, |it| it.along)
    }

    /// Returns the pose at the start: the heading is that of the first piece.
    pub fn start(&self) -> Pose {
        self.pose(0, 0.0)
    }

    /// Returns the ends of a piece.
    fn ends(&self, piece: usize) -> Option<[Corner; 2]> {
        Some([*self.corners.get(piece)?, *self.corners.get(piece + 1)?])
    }

    /// Returns the place after a length, on this piece or one behind it, with the heading there;
    /// the ends of the path for lengths beyond them.
    pub fn pose(&self, piece: usize, along: f64) -> Pose {
        let pieces = self.corners.len().saturating_sub(2);
        let ends = |it: &usize| self.ends(*it).is_some_and(|it| along <= it[1].along);
        let piece = (piece..=pieces).find(ends).unwrap_or(pieces);
        let Some([from, to]) = self.ends(piece) else { return Pose::identity() };
        let part = ((along - from.along) / (to.along - from.along)).clamp(0.0, 1.0);
        let heading = self.pieces.get(piece).map_or(UnitComplex::identity(), |it| it.heading);
        Pose::from_parts((from.at + (to.at - from.at) * part).into(), heading)
    }

    /// Returns the place on a piece that is nearest to a point.
    pub fn project(&self, piece: usize, at: Point) -> Near {
        let Some([from, to]) = self.ends(piece) else {
            return Near { piece, along: self.length() };
        };
        let way = to.at - from.at;
        let part = ((at - from.at).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        // The end is the end, to the last bit.
        let along = if part < 1.0 { from.along + (to.along - from.along) * part } else { to.along };
        Near { piece, along }
    }

    /// Returns the place that is nearest to a point between two lengths, and its distance.
    pub fn find(&self, at: Point, from: f64, to: f64) -> (Near, f64) {
        let pieces = 0..self.corners.len().saturating_sub(1);
        let is_near = |it: &[Corner; 2]| it[1].along >= from && it[0].along <= to;
        let near = pieces.filter(|it| self.ends(*it).is_some_and(|it| is_near(&it)));
        let places = near.map(|piece| {
            let along = self.project(piece, at).along.clamp(from, to.max(from));
            let there = self.pose(piece, along).translation.vector;
            (Near { piece, along }, (there - at.coords).norm())
        });
        let best = places.min_by(|a, b| a.1.total_cmp(&b.1));
        best.unwrap_or((Near { piece: 0, along: 0.0 }, f64::INFINITY))
    }

    /// Returns the end of a piece, and whether the corner there is so sharp that a robot turns on
    /// the spot; the end of the path is not.
    pub fn end(&self, piece: usize) -> (f64, bool) {
        let along = self.corners.get(piece + 1).map_or(0.0, |it| it.along);
        (along, self.pieces.get(piece).is_some_and(|it| it.is_sharp))
    }

    /// Returns the highest speed at a place of a piece, for what comes.
    pub fn speed(&self, near: Near, drivetrain: &Drivetrain) -> f64 {
        let (end, at_end) = (self.end(near.piece).0, self.pieces.get(near.piece));
        braking(at_end.map_or(0.0, |it| it.speed), end - near.along, drivetrain)
    }

    /// Returns the place where a robot on a piece has to stand next: a sharp corner, or the end.
    pub fn stop(&self, piece: usize) -> f64 {
        self.pieces.get(piece).map_or(0.0, |it| it.stop)
    }
}

/// Returns the highest speed from which a robot brakes to another within a length.
fn braking(to: f64, within: f64, drivetrain: &Drivetrain) -> f64 {
    (to * to + 2.0 * drivetrain.acceleration * within.max(0.0)).sqrt()
}

fn angle(way: Vector) -> f64 {
    libm::atan2(way.y, way.x)
}

/// Returns the same angle between -π and π.
pub(crate) fn wrapped(angle: f64) -> f64 {
    use core::f64::consts::{PI, TAU};
    angle - TAU * ((angle + PI) / TAU).floor()
}
