//! Questions that sensors, bodies and planners ask of a floor.

use crate::geometry::{Bounds, Point, Pose, Ray};

/// The way in which a sensor sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// Lasers and cameras: they look through glass.
    Light,
    /// Sonars, bumpers and bodies: glass stops them.
    Sound,
}

/// The thing that a ray hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A wall, or an occupied cell of a map.
    Wall,
    /// A pane of glass.
    Glass,
    /// A leaf of a door.
    Door,
    /// A leaf of a door of glass.
    GlassDoor,
    /// A desk, a shelf, a pillar.
    Furniture,
}

impl Kind {
    /// Whether a sense notices it.
    pub fn is_seen_by(self, sense: Sense) -> bool {
        sense == Sense::Sound || !self.is_glass()
    }

    /// Whether light goes through it.
    pub(crate) fn is_glass(self) -> bool {
        matches!(self, Self::Glass | Self::GlassDoor)
    }
}

/// The first thing in the way of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// How far away it is, in metres.
    pub distance: f64,
    /// The thing itself.
    pub kind: Kind,
    /// Cosine of the angle between the ray and the normal of what it hits, from 0 (along it) to 1
    /// (straight at it). A map of cells knows the sides of cells only.
    pub cosine: f64,
}

/// The shape that must find room.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    corners: Vec<Point>,
    radius: f64,
}

impl Footprint {
    /// The most corners.
    pub const MAX_CORNERS: usize = 64;

    /// A disc around the robot's centre.
    pub fn disc(radius_m: f64) -> Self {
        Self { corners: Vec::new(), radius: radius_m }
    }

    /// A polygon around the robot's centre, in metres: x ahead, y to the left. `None` if there are
    /// less than three corners, or more than [`MAX_CORNERS`](Self::MAX_CORNERS).
    pub fn polygon(corners: Vec<Point>) -> Option<Self> {
        let radius = corners.iter().map(|it| it.coords.norm()).fold(0.0, f64::max);
        (3..=Self::MAX_CORNERS).contains(&corners.len()).then_some(Self { corners, radius })
    }

    /// Returns the radius of the disc around the centre that holds all of it, in metres.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the corners; none of a disc.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// Writes the corners at a pose, and returns them.
    pub(crate) fn placed<'o>(
        &self,
        pose: &Pose,
        out: &'o mut [Point; Self::MAX_CORNERS],
    ) -> &'o [Point] {
        for (out, corner) in out.iter_mut().zip(&self.corners) {
            *out = pose * corner;
        }
        out.get(..self.corners.len()).unwrap_or_default()
    }

    /// Returns the corners at a pose and the box around them.
    ///
    /// # Errors
    /// Whether the pose is free, where the room around the centre or the border of the floor
    /// decides that.
    pub(crate) fn near<'o>(
        &self,
        floor: &impl Surface,
        pose: &Pose,
        out: &'o mut [Point; Self::MAX_CORNERS],
    ) -> Result<(&'o [Point], Bounds), bool> {
        let centre = Point::from(pose.translation.vector);
        if floor.clearance(centre, self.radius) >= self.radius {
            return Err(true);
        }
        let corners = self.placed(pose, out);
        let around = Bounds::around(corners).ok_or(false)?;
        let whole = floor.bounds();
        if whole.holds(around.least) && whole.holds(around.most) {
            Ok((corners, around))
        } else {
            Err(false)
        }
    }
}

/// A floor, drawn or mapped. People are not part of it.
///
/// Nothing here allocates, and the same question has the same answer, bit for bit, on every
/// machine.
pub trait Surface {
    /// The box that the floor lies in. Beyond it is nothing: no ray comes back from there, and no
    /// robot may be there.
    fn bounds(&self) -> Bounds;

    /// Returns the first thing that a ray hits within a range in metres.
    fn hit(&self, ray: &Ray, range: f64, sense: Sense) -> Option<Hit>;

    /// Writes how far each ray goes, in metres; infinity where nothing is within the range. It is
    /// the fastest way to many rays.
    fn distances(&self, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
        for (ray, out) in rays.iter().zip(out) {
            *out = self.hit(ray, range, sense).map_or(f64::INFINITY, |it| it.distance);
        }
    }

    /// Returns the distance from a point to the nearest thing that a sense notices, in metres, and
    /// at most `most`. It is 0 in an occupied cell; inside furniture it is that to its border.
    fn distance(&self, at: Point, most: f64, sense: Sense) -> f64;

    /// Returns how much room there is around a point, in metres, and at most `most`: the distance
    /// to the nearest place where a body must not be, which is 0 in such a place. The border of
    /// the floor counts.
    fn clearance(&self, at: Point, most: f64) -> f64;

    /// Returns how many walls and doors a straight line between two points passes, as radio waves
    /// do; on a map of cells, how many times it enters occupied ones.
    fn walls_between(&self, a: Point, b: Point) -> usize;

    /// Whether a body finds room at a pose. It may touch things.
    fn is_free(&self, footprint: &Footprint, pose: &Pose) -> bool;
}
