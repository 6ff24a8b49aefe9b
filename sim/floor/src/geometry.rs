//! Points, rays, boxes and polygons of the plane, in metres and radians.

use nalgebra::{Isometry2, Point2, Vector2};

/// A point in metres: x to the right, y up.
pub type Point = Point2<f64>;
/// A direction or a distance in metres.
pub type Vector = Vector2<f64>;
/// A position and a heading, counter-clockwise from the x axis.
pub type Pose = Isometry2<f64>;

/// Returns the cross product: positive where `b` is to the left of `a`.
pub(crate) fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The start of a ray and the way that it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The start.
    pub from: Point,
    /// The way, of length 1: distances along the ray are multiples of it.
    pub along: Vector,
}

impl Ray {
    /// A ray that goes at an angle, in radians counter-clockwise from the x axis.
    ///
    /// ```
    /// use cotama_floor::{Point, Ray};
    /// let ray = Ray::at(Point::new(2.0, 3.0), core::f64::consts::FRAC_PI_2);
    /// assert!((ray.point(4.0) - Point::new(2.0, 7.0)).norm() < 1e-15);
    /// ```
    pub fn at(from: Point, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { from, along: Vector::new(cos, sin) }
    }

    /// Returns the point after a distance.
    pub fn point(&self, distance: f64) -> Point {
        self.from + self.along * distance
    }
}

/// A box with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The left lower corner.
    pub least: Point,
    /// The right upper corner.
    pub most: Point,
}

impl Bounds {
    /// The smallest box around points; `None` around none.
    pub fn around(points: &[Point]) -> Option<Self> {
        let (first, rest) = points.split_first()?;
        let mut it = Self { least: *first, most: *first };
        for point in rest {
            it.least = it.least.inf(point);
            it.most = it.most.sup(point);
        }
        Some(it)
    }

    /// Whether a point is inside, or on the border.
    pub fn holds(&self, at: Point) -> bool {
        let Self { least, most } = self;
        (least.x..=most.x).contains(&at.x) && (least.y..=most.y).contains(&at.y)
    }

    /// Returns the distance from a point inside to the border; 0 outside.
    pub fn margin(&self, at: Point) -> f64 {
        let (least, most) = (at - self.least, self.most - at);
        least.x.min(least.y).min(most.x).min(most.y).max(0.0)
    }

    /// The width.
    pub fn width(&self) -> f64 {
        self.most.x - self.least.x
    }

    /// The height.
    pub fn height(&self) -> f64 {
        self.most.y - self.least.y
    }
}

/// Returns the sides of a closed polygon.
pub(crate) fn sides(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// Whether a point is inside a polygon, by the parity of the sides to its right.
///
/// ```
/// use cotama_floor::{Point, is_inside};
/// let corner = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0]].map(Point::from);
/// assert!(is_inside(&corner, Point::new(3.0, 1.0)));
/// assert!(!is_inside(&corner, Point::new(2.0, 2.0)));
/// ```
pub fn is_inside(corners: &[Point], at: Point) -> bool {
    let mut inside = false;
    for (a, b) in sides(corners) {
        if (a.y > at.y) != (b.y > at.y) {
            // The side of the point, so that no quotient is rounded.
            let left = cross(b - a, at - a);
            inside ^= if b.y > a.y { left > 0.0 } else { left < 0.0 };
        }
    }
    inside
}

/// Returns the point of a stretch from `a` to `b` that is nearest to another, as its part of it.
pub(crate) fn nearest_part(a: Point, b: Point, to: Point) -> f64 {
    let along = b - a;
    let square = along.norm_squared();
    if square > 0.0 { ((to - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns the distance from a point to a stretch.
pub(crate) fn distance_to(a: Point, b: Point, to: Point) -> f64 {
    (a + (b - a) * nearest_part(a, b, to) - to).norm()
}

/// Whether two stretches have a point in common.
pub(crate) fn do_cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let (along, other) = (b - a, d - c);
    let (c_side, d_side) = (cross(along, c - a), cross(along, d - a));
    let (a_side, b_side) = (cross(other, a - c), cross(other, b - c));
    if [c_side, d_side, a_side, b_side].iter().all(|it| *it == 0.0) {
        let ([la, lb], [lc, ld]) = ([a.inf(&b), a.sup(&b)], [c.inf(&d), c.sup(&d)]);
        return la.x <= ld.x && lc.x <= lb.x && la.y <= ld.y && lc.y <= lb.y;
    }
    let split = |one: f64, two: f64| one.min(two) <= 0.0 && one.max(two) >= 0.0;
    split(c_side, d_side) && split(a_side, b_side)
}

/// Whether a stretch has a point in common with a box, by the axes that could part them.
pub(crate) fn crosses_box([a, b]: [Point; 2], it: &Bounds) -> bool {
    let (low, high) = (a.inf(&b), a.sup(&b));
    if low.x > it.most.x || high.x < it.least.x || low.y > it.most.y || high.y < it.least.y {
        return false;
    }
    let along = b - a;
    let corners = [it.least, it.most, Point::new(it.least.x, it.most.y)];
    let last = Point::new(it.most.x, it.least.y);
    let first = cross(along, last - a);
    let (least, most) = corners.iter().fold((first, first), |(least, most), corner| {
        let side = cross(along, corner - a);
        (least.min(side), most.max(side))
    });
    least <= 0.0 && most >= 0.0
}

/// Whether a polygon and a box have a point in common.
pub(crate) fn meets_box(corners: &[Point], it: &Bounds) -> bool {
    sides(corners).any(|(a, b)| crosses_box([a, b], it)) || is_inside(corners, it.least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_cross_touch_or_miss() {
        let at = |x: i32, y: i32| Point::new(f64::from(x), f64::from(y));
        let long = [at(0, 0), at(10, 0)];
        assert!(do_cross(long, [at(5, -1), at(5, 1)]));
        assert!(do_cross(long, [at(5, 0), at(5, 1)])); // touches
        assert!(do_cross(long, [at(10, 0), at(12, 0)])); // end to end
        assert!(!do_cross(long, [at(11, 0), at(12, 0)])); // in one line
        assert!(!do_cross(long, [at(5, 1), at(7, 2)]));
    }

    #[test]
    fn a_box_inside_a_polygon_meets_it() {
        let square = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]].map(Point::from);
        let of = |x: f64, y: f64| Bounds { least: [x, y].into(), most: [x + 1.0, y + 1.0].into() };
        assert!(meets_box(&square, &of(4.0, 4.0)) && meets_box(&square, &of(8.5, 4.0)));
        assert!(!meets_box(&square, &of(9.5, 4.0)) && !meets_box(&square, &of(4.0, -1.5)));
    }
}
