//! Maps that are wrong in a zone.

use cotama_floor::{Bounds, Footprint, Hit, Point, Pose, Ray, Sense, Surface, Vector, is_inside};

/// A map that is wrong inside a zone: everything there stands elsewhere, as after a survey that was
/// put together badly. It decorates the surface that a robot takes for its map; sensors see the
/// real one.
///
/// A question from a point of the zone is answered as from a point that is shifted; so rays that
/// begin outside see nothing of it.
///
/// ```
/// use cotama_devices::WrongMap;
/// use cotama_floor::{Point, Ray, Sense, Surface, Vector, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let map = office.surface(Version::Charted, &[]).unwrap();
/// let crossing = office.zones[3].corners();
/// let map = WrongMap::new(&map, crossing, Vector::new(0.0, 0.25));
/// let up = |x: f64| {
///     let ray = Ray { from: Point::new(x, 10.0), along: Vector::y() };
///     map.hit(&ray, 8.0, Sense::Sound).map(|it| it.distance)
/// };
/// // The north wall of the corridor, before the crossing and in it.
/// assert_eq!([up(12.5), up(13.5)], [Some(1.0), Some(1.25)]);
/// ```
#[derive(Clone)]
pub struct WrongMap<'s> {
    map: &'s dyn Surface,
    zone: Vec<Point>,
    shift: Vector,
}

impl core::fmt::Debug for WrongMap<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut it = f.debug_struct("WrongMap");
        it.field("zone", &self.zone).field("shift", &self.shift).finish_non_exhaustive()
    }
}

/// So many rays are shifted at a time.
const TOGETHER: usize = 64;

impl<'s> WrongMap<'s> {
    /// A map in which all that is in a zone is shifted, in metres.
    pub fn new(map: &'s dyn Surface, zone: Vec<Point>, shift: Vector) -> Self {
        Self { map, zone, shift }
    }

    /// Returns the point of the right map that a point of this one stands for.
    pub fn right(&self, at: Point) -> Point {
        if is_inside(&self.zone, at) { at - self.shift } else { at }
    }
}

impl Surface for WrongMap<'_> {
    fn bounds(&self) -> Bounds {
        self.map.bounds()
    }

    fn hit(&self, ray: &Ray, range: f64, sense: Sense) -> Option<Hit> {
        self.map.hit(&Ray { from: self.right(ray.from), ..*ray }, range, sense)
    }

    fn distances(&self, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
        let mut shifted = [Ray { from: Point::origin(), along: Vector::x() }; TOGETHER];
        for (rays, out) in rays.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
            for (shifted, ray) in shifted.iter_mut().zip(rays) {
                *shifted = Ray { from: self.right(ray.from), ..*ray };
            }
            let shifted = shifted.get(..rays.len()).unwrap_or_default();
            self.map.distances(shifted, range, sense, out);
        }
    }

    fn distance(&self, at: Point, most: f64, sense: Sense) -> f64 {
        self.map.distance(self.right(at), most, sense)
    }

    fn clearance(&self, at: Point, most: f64) -> f64 {
        self.map.clearance(self.right(at), most)
    }

    fn walls_between(&self, a: Point, b: Point) -> usize {
        self.map.walls_between(self.right(a), self.right(b))
    }

    fn is_free(&self, footprint: &Footprint, pose: &Pose) -> bool {
        let mut pose = *pose;
        pose.translation.vector = self.right(pose.translation.vector.into()).coords;
        self.map.is_free(footprint, &pose)
    }
}
