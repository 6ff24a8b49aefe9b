//! A floor as it is drawn: the data of a `cotama-floor/1` file.

mod reader;
mod sound;

pub use reader::{FORMAT, MAX_MM, MAX_NAME, MAX_POINTS};

use crate::geometry::{Bounds, Point, Pose, Vector};
use crate::segments::{Segment, Segments, SegmentsError};
use crate::surface::Kind;

/// A point in mm: to the right, and up.
pub type PointMm = [i32; 2];

/// Returns a point in metres.
pub fn metres(at: PointMm) -> Point {
    Point::new(f64::from(at[0]) / 1_000.0, f64::from(at[1]) / 1_000.0)
}

/// A wall or a pane of glass: straight pieces from point to point, without thickness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The points, in mm.
    pub points: Vec<PointMm>,
    /// Whether a last piece leads back to the first point.
    pub is_closed: bool,
}

/// A door: a leaf that is an obstacle where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Door {
    /// Name in the file.
    pub name: String,
    /// Hinge of the leaf, in mm.
    pub hinge: PointMm,
    /// End of the leaf when it is closed, in mm.
    pub latch: PointMm,
    /// By how much the open leaf is turned, counter-clockwise; without it the leaf slides away.
    pub swing_deg: Option<i32>,
    /// Whether the leaf is of glass.
    pub is_glass: bool,
    /// Whether the door is open at first.
    pub is_open: bool,
}

impl Door {
    /// Returns where the leaf stands, in metres; `None` if it is out of the way.
    pub fn leaf(&self, is_open: bool) -> Option<[Point; 2]> {
        let (hinge, latch) = (metres(self.hinge), metres(self.latch));
        if !is_open {
            return Some([hinge, latch]);
        }
        let (sin, cos) = libm::sincos(f64::from(self.swing_deg?).to_radians());
        let leaf = latch - hinge;
        let turned = Vector::new(leaf.x * cos - leaf.y * sin, leaf.x * sin + leaf.y * cos);
        Some([hinge, hinge + turned])
    }
}

/// The outline of a piece of furniture, in mm.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outline {
    /// A polygon.
    Corners(Vec<PointMm>),
    /// A disc; for rays and bodies it has [`ROUND`] sides, whose corners lie on the circle.
    Round {
        /// The centre.
        centre: PointMm,
        /// The radius.
        radius: i32,
    },
}

/// The number of sides of what is round.
pub const ROUND: usize = 24;

/// A desk, a shelf, a pillar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Furniture {
    /// Name in the file.
    pub name: String,
    /// Outline, corner after corner.
    pub outline: Outline,
    /// Whether it is on the map of the robot; the rest is a surprise.
    pub is_charted: bool,
}

impl Furniture {
    /// Returns the corners in metres.
    pub fn corners(&self) -> Vec<Point> {
        match &self.outline {
            Outline::Corners(all) => all.iter().map(|it| metres(*it)).collect(),
            Outline::Round { centre, radius } => {
                let (centre, radius) = (metres(*centre), f64::from(*radius) / 1_000.0);
                let corner = |at: usize| {
                    let angle = core::f64::consts::TAU * at as f64 / ROUND as f64;
                    let (sin, cos) = libm::sincos(angle);
                    centre + Vector::new(cos, sin) * radius
                };
                (0..ROUND).map(corner).collect()
            }
        }
    }
}

/// A QR mark at a wall.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Name, and text of the mark.
    pub name: String,
    /// Middle, in mm.
    pub at: PointMm,
    /// Direction that it faces, in degrees counter-clockwise from the x axis.
    pub facing_deg: i32,
    /// The side of the square, in mm.
    pub size: i32,
}

/// A place with a name, or a docking station.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name in the file.
    pub name: String,
    /// Position, in mm.
    pub at: PointMm,
    /// The heading that a robot has there, in degrees counter-clockwise from the x axis.
    pub heading_deg: Option<i32>,
}

impl Place {
    /// Returns the pose there, in metres and radians; along the x axis if no heading is said.
    pub fn pose(&self) -> Pose {
        let angle = f64::from(self.heading_deg.unwrap_or(0)).to_radians();
        Pose::new(metres(self.at).coords, angle)
    }
}

/// A part of the floor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Zone {
    /// Name in the file.
    pub name: String,
    /// Corners, in mm.
    pub outline: Vec<PointMm>,
}

impl Zone {
    /// Returns the corners in metres.
    pub fn corners(&self) -> Vec<Point> {
        self.outline.iter().map(|it| metres(*it)).collect()
    }
}

/// A floor: see [`Floor::parse`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Floor {
    /// Name in the file.
    pub name: String,
    /// A few words about it; may be empty.
    pub title: String,
    /// Width and height in mm; the left lower corner is the origin.
    pub size: PointMm,
    /// The walls.
    pub walls: Vec<Line>,
    /// The panes of glass.
    pub glass: Vec<Line>,
    /// The doors.
    pub doors: Vec<Door>,
    /// The furniture.
    pub furniture: Vec<Furniture>,
    /// The QR marks.
    pub marks: Vec<Mark>,
    /// The places with names.
    pub places: Vec<Place>,
    /// The docking stations.
    pub docks: Vec<Place>,
    /// The zones.
    pub zones: Vec<Zone>,
}

/// The floor that a sensor meets, or the one that a robot knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// All that is there.
    Real,
    /// Without furniture that is not charted.
    Charted,
}

impl Floor {
    /// The box of the floor, in metres.
    pub fn bounds(&self) -> Bounds {
        Bounds { least: Point::origin(), most: metres(self.size) }
    }

    /// Returns the place or the docking station of a name.
    pub fn place(&self, name: &str) -> Option<&Place> {
        self.places.iter().chain(&self.docks).find(|it| it.name == name)
    }

    /// Whether each door is open at first.
    pub fn doors_at_first(&self) -> Vec<bool> {
        self.doors.iter().map(|it| it.is_open).collect()
    }

    /// Makes the surface that rays, bodies and planners ask. `are_open` says of each door whether
    /// it is open; those that it does not reach are as at first.
    ///
    /// # Errors
    /// None of a floor that was read, but for an open leaf that leaves the floor in a state that
    /// the file does not have.
    pub fn surface(&self, version: Version, are_open: &[bool]) -> Result<Segments, SegmentsError> {
        let mut segments = Vec::new();
        for (lines, kind) in [(&self.walls, Kind::Wall), (&self.glass, Kind::Glass)] {
            for line in lines {
                let ends = line.points.iter().zip(line.points.iter().skip(1));
                let last = line.points.last().zip(line.points.first());
                for (from, to) in ends.chain(last.filter(|_| line.is_closed)) {
                    segments.push(Segment { from: metres(*from), to: metres(*to), kind });
                }
            }
        }
        for (at, door) in self.doors.iter().enumerate() {
            let is_open = are_open.get(at).copied().unwrap_or(door.is_open);
            let kind = if door.is_glass { Kind::GlassDoor } else { Kind::Door };
            segments.extend(door.leaf(is_open).map(|[from, to]| Segment { from, to, kind }));
        }
        let real = version == Version::Real;
        let there = self.furniture.iter().filter(|it| real || it.is_charted);
        let solids: Vec<_> = there.map(Furniture::corners).collect();
        let solids: Vec<_> = solids.iter().map(|it| (it.as_slice(), Kind::Furniture)).collect();
        Segments::new(self.bounds(), &segments, &solids)
    }
}
