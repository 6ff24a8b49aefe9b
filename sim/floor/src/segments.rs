//! A floor of stretches: what a drawing is.

mod cover;
mod march;

use crate::geometry::{Bounds, Point, Pose, Ray, Vector, cross, do_cross, is_inside, sides};
use crate::octants::{Octants, Walk};
use crate::surface::{Footprint, Hit, Kind, Sense, Surface};
use cover::Cover;

/// The largest number of stretches, those of furniture included.
pub const MAX_SEGMENTS: usize = 50_000;
/// The largest number of solids.
pub const MAX_SOLIDS: usize = 2_000;
/// The largest width and height, in metres.
pub const MAX_SIZE_M: f64 = 1_000.0;

/// A straight piece of something: it has no thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// The thing that it is a piece of.
    pub kind: Kind,
}

/// Reasons why stretches are no floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentsError {
    /// The box is not from 0.1 m to [`MAX_SIZE_M`] wide and high, or further than that away.
    Bounds(Bounds),
    /// More than [`MAX_SEGMENTS`] stretches, or more than [`MAX_SOLIDS`] solids.
    TooMany(usize),
    /// A stretch leaves the box, or is none: by number, those of solids last.
    Segment(usize),
    /// The stretches pass through more than 2²¹ cells, counted for each: they are many and long.
    Crowded,
}

impl core::fmt::Display for SegmentsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Bounds(it) => write!(f, "a floor of {} x {} m", it.width(), it.height()),
            Self::TooMany(it) => write!(f, "{it} stretches or solids are too many"),
            Self::Segment(it) => write!(f, "stretch {it} leaves the floor, or has no length"),
            Self::Crowded => {
                let most = cover::MOST;
                write!(f, "the stretches, cut into cells, make more than {most} pieces")
            }
        }
    }
}

impl core::error::Error for SegmentsError {}

/// A floor of stretches, and of solids: polygons in which a body must not be.
///
/// *Rays.* A ray hits a stretch if its ends are on two sides of it, or one of them is on it; the
/// sides of an end that two stretches share are computed once each from the same numbers, so that
/// no ray slips through between them. The distance is rounded: with ε = 2⁻⁵³, `L` the sum of the
/// distances from the start of the ray to both ends, and φ the angle at which the ray meets the
/// stretch, it is off by at most `8 ε L / sin φ` (shown in `tests/exact_rays.rs`). A ray that
/// passes an end of a stretch as closely as `4 ε L` may hit or miss it.
///
/// ```
/// use cotama_floor::{Bounds, Kind, Point, Ray, Segment, Segments, Sense, Surface};
/// let bounds = Bounds { least: Point::new(0.0, 0.0), most: Point::new(8.0, 6.0) };
/// let pane = [Point::new(4.0, 1.0), Point::new(4.0, 5.0)];
/// let pane = Segment { from: pane[0], to: pane[1], kind: Kind::Glass };
/// let pillar = [[6.0, 2.0], [7.0, 2.0], [7.0, 4.0], [6.0, 4.0]].map(Point::from);
/// let floor = Segments::new(bounds, &[pane], &[(&pillar, Kind::Furniture)]).unwrap();
/// let ray = Ray::at(Point::new(1.0, 3.0), 0.0);
/// let hit = |sense| floor.hit(&ray, 10.0, sense).map(|it| (it.distance, it.kind));
/// assert_eq!(hit(Sense::Sound), Some((3.0, Kind::Glass)));
/// assert_eq!(hit(Sense::Light), Some((5.0, Kind::Furniture)));
/// assert_eq!(floor.clearance(Point::new(3.0, 3.0), 9.0), 1.0);
/// assert_eq!(floor.clearance(Point::new(6.5, 3.0), 9.0), 0.0); // inside the pillar
/// ```
#[derive(Clone, Debug)]
pub struct Segments {
    bounds: Bounds,
    /// The left lower corner of the first cell.
    origin: Point,
    per_metre: f64,
    /// Cells that no stretch touches are empty.
    octants: Octants,
    cover: Cover,
    solids: Vec<(Bounds, Vec<Point>)>,
}

impl Segments {
    /// Makes a floor of stretches, and of solids with what they are made of.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        bounds: Bounds,
        segments: &[Segment],
        solids: &[(&[Point], Kind)],
    ) -> Result<Self, SegmentsError> {
        let sizes = 0.1..=MAX_SIZE_M;
        let near = |it: &Point| it.iter().all(|it| it.abs() <= MAX_SIZE_M);
        if !sizes.contains(&bounds.width())
            || !sizes.contains(&bounds.height())
            || !near(&bounds.least)
        {
            return Err(SegmentsError::Bounds(bounds));
        }
        let mut all = segments.to_vec();
        for (corners, kind) in solids {
            let kind = *kind;
            all.extend(sides(corners).map(|(from, to)| Segment { from, to, kind }));
        }
        if all.len() > MAX_SEGMENTS || solids.len() > MAX_SOLIDS {
            return Err(SegmentsError::TooMany(all.len().max(solids.len())));
        }
        let is_good =
            |it: &Segment| bounds.holds(it.from) && bounds.holds(it.to) && it.from != it.to;
        if let Some(bad) = all.iter().position(|it| !is_good(it)) {
            return Err(SegmentsError::Segment(bad));
        }
        let (cell, columns, rows) = cover::cells(&bounds);
        // A cell around all, so that what stands on the border is inside.
        let origin = bounds.least - Vector::repeat(cell);
        let cover = Cover::new(&all, origin, cell, columns, rows).ok_or(SegmentsError::Crowded)?;
        let octants = Octants::of(columns, rows, |x, y| cover.at(x, y).is_empty());
        let with_bounds = |it: &(&[Point], Kind)| Some((Bounds::around(it.0)?, it.0.to_vec()));
        let solids = solids.iter().filter_map(with_bounds).collect();
        let per_metre = cell.recip();
        Ok(Self { bounds, origin, per_metre, octants, cover, solids })
    }

    fn in_cells(&self, at: Point) -> Point {
        Point::from((at - self.origin) * self.per_metre)
    }

    fn is_in_solid(&self, at: Point) -> bool {
        self.solids.iter().any(|(around, corners)| around.holds(at) && is_inside(corners, at))
    }

    /// Looks at the stretches in the cell of a walk: returns how far the nearest is that is nearer
    /// than `best`, else that, and its number in the cell.
    #[inline]
    fn nearest_here(&self, walk: &Walk, ray: &Ray, sense: Sense, mut best: f64) -> (f64, usize) {
        let (mut nearest, looks_through) = (usize::MAX, sense == Sense::Light);
        for (at, segment) in self.cover.of(self.octants.cell(walk)).iter().enumerate() {
            let is_through = looks_through & segment.kind.is_glass();
            let distance = meets(ray, segment) + NO_OR_FAR[usize::from(is_through)];
            nearest = if distance < best { at } else { nearest };
            best = if distance < best { distance } else { best };
        }
        (best, nearest)
    }
}

/// Lengths that are added to a distance. Which rays hit is hard to foresee for a processor: to add
/// by place takes no branch.
const NO_OR_FAR: [f64; 2] = [0.0, f64::INFINITY];

/// Returns how far a ray goes before it meets a stretch; infinity, or no number, if it does not.
#[inline]
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator branches")]
fn meets(ray: &Ray, segment: &Segment) -> f64 {
    let (a, b) = (segment.from - ray.from, segment.to - ray.from);
    // The sides of the ends.
    let (side_a, side_b) = (cross(ray.along, a), cross(ray.along, b));
    let (ahead_a, ahead_b) = (ray.along.dot(&a), ray.along.dot(&b));
    let span = side_b - side_a;
    if span == 0.0 {
        return if side_a == 0.0 { meets_along(ahead_a, ahead_b) } else { f64::INFINITY };
    }
    // Between the two ends, each with a weight from 0 to 1.
    let distance = ahead_a * (side_b / span) + ahead_b * (-side_a / span);
    let is_beside = ((side_a > 0.0) & (side_b > 0.0)) | ((side_a < 0.0) & (side_b < 0.0));
    distance + NO_OR_FAR[usize::from(is_beside | (distance < 0.0))]
}

/// Returns how far a ray goes that goes along a stretch, by how far ahead its ends are: it begins
/// on the stretch, or meets the nearer end.
fn meets_along(a: f64, b: f64) -> f64 {
    let (near, far) = (a.min(b), a.max(b));
    match (near > 0.0, far < 0.0) {
        (true, _) => near,
        (_, true) => f64::INFINITY,
        _ => 0.0,
    }
}

impl Surface for Segments {
    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn hit(&self, ray: &Ray, range: f64, sense: Sense) -> Option<Hit> {
        let from = self.in_cells(ray.from);
        let inside = self.octants.holds(from);
        let before = if inside { 0.0 } else { self.octants.entry(from, ray.along)? };
        let mut walk = self.octants.walk(from + ray.along * before, ray.along);
        let (mut best, mut nearest) = (f64::INFINITY, None);
        // Until here something nearer may come, in cells.
        let mut most = range * self.per_metre;
        while walk.distance + before <= most {
            if walk.is_open() {
                self.octants.step(&mut walk);
                continue;
            }
            if !walk.has_hit() {
                break;
            }
            let (distance, at) = self.nearest_here(&walk, ray, sense, best);
            if distance < best {
                best = distance;
                nearest = self.cover.of(self.octants.cell(&walk)).get(at);
            }
            most = most.min(best * self.per_metre);
            self.octants.step_one(&mut walk);
        }
        let segment = nearest.filter(|_| best <= range)?;
        let along = segment.to - segment.from;
        let cosine = (cross(along, ray.along).abs() / along.norm()).min(1.0);
        Some(Hit { distance: best, kind: segment.kind, cosine })
    }

    fn distances(&self, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
        march::march(self, rays, range, sense, out);
    }

    fn distance(&self, at: Point, most: f64, sense: Sense) -> f64 {
        self.cover.nearest(&self.octants, self.in_cells(at), at, most, sense)
    }

    fn clearance(&self, at: Point, most: f64) -> f64 {
        let most = most.min(self.bounds.margin(at));
        if most <= 0.0 || self.is_in_solid(at) {
            return 0.0;
        }
        self.distance(at, most, Sense::Sound)
    }

    fn walls_between(&self, a: Point, b: Point) -> usize {
        let wanted = |it: &&Segment| matches!(it.kind, Kind::Wall | Kind::Door);
        let all = self.cover.segments().iter().filter(wanted);
        all.filter(|it| do_cross([it.from, it.to], [a, b])).count()
    }

    fn is_free(&self, footprint: &Footprint, pose: &Pose) -> bool {
        let mut corners = [Point::origin(); Footprint::MAX_CORNERS];
        let (corners, around) = match footprint.near(self, pose, &mut corners) {
            Ok(near) => near,
            Err(is_free) => return is_free,
        };
        let is_in = |it: &Segment| {
            is_inside(corners, it.from)
                || sides(corners).any(|(a, b)| do_cross([a, b], [it.from, it.to]))
        };
        let (low, high) = (self.in_cells(around.least), self.in_cells(around.most));
        let crossed = self.cover.cells_between(low, high).any(|it| it.iter().any(is_in));
        !crossed && !corners.iter().any(|it| self.is_in_solid(*it))
    }
}
