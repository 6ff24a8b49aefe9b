//! All that rays meet at one moment: the floor, and the discs that move on it.

use cotama_floor::{Point, Ray, Sense, Surface, Vector};

/// A person, or a robot as others see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The centre.
    pub centre: Point,
    /// The radius in metres.
    pub radius: f64,
}

impl Disc {
    /// Returns how far a ray goes before it meets the disc, in metres, and the cosine of the angle
    /// between the ray and the normal there. A ray that begins inside meets it at once.
    ///
    /// With `c` the centre as the ray sees it, `a` ahead and `s` aside: `a - √(r² - s²)`.
    ///
    /// ```
    /// use cotama_devices::Disc;
    /// use cotama_floor::{Point, Ray, Vector};
    /// let disc = Disc { centre: Point::new(10.0, 3.0), radius: 5.0 };
    /// let ray = Ray { from: Point::new(0.0, 0.0), along: Vector::new(1.0, 0.0) };
    /// assert_eq!(disc.meets(&ray), Some((6.0, 0.8))); // a right triangle of 3, 4 and 5 m
    /// ```
    #[inline]
    pub fn meets(&self, ray: &Ray) -> Option<(f64, f64)> {
        let to = self.centre - ray.from;
        let aside = (ray.along.x * to.y - ray.along.y * to.x).abs();
        if aside > self.radius {
            return None;
        }
        let ahead = ray.along.dot(&to);
        if to.norm_squared() <= self.radius * self.radius {
            return Some((0.0, 1.0));
        }
        let half = ((self.radius - aside) * (self.radius + aside)).sqrt();
        let distance = ahead - half;
        (distance >= 0.0).then(|| (distance, half / self.radius))
    }

    /// Returns the room between the borders of two discs, in metres; less than 0 if they overlap.
    pub fn gap(&self, other: &Self) -> f64 {
        (self.centre - other.centre).norm() - self.radius - other.radius
    }
}

/// The first thing that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Echo {
    pub(crate) distance: f64,
    /// Cosine of the angle of incidence.
    pub(crate) cosine: f64,
}

/// The floor and what moves on it, at one moment.
///
/// ```
/// use cotama_devices::{Disc, Scene};
/// use cotama_floor::{Point, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Real, &[]).unwrap();
/// let people = [Disc { centre: Point::new(5.0, 10.0), radius: 0.25 }];
/// let scene = Scene::of(&surface, &people);
/// assert!(!scene.is_clear(Point::new(3.0, 10.0), Point::new(7.0, 10.0))); // a person between
/// assert!(scene.is_clear(Point::new(3.0, 10.5), Point::new(7.0, 10.5)));
/// // A robot does not see itself, but another one does.
/// let robots = [4.0, 6.0].map(|x| Disc { centre: Point::new(x, 10.5), radius: 0.25 });
/// let from = robots[0].centre;
/// assert!(scene.among(&robots, 0).is_clear(from, Point::new(5.5, 10.5)));
/// assert!(!scene.among(&robots, 1).is_clear(from, Point::new(5.5, 10.5)));
/// ```
#[derive(Clone, Copy)]
pub struct Scene<'s> {
    surface: &'s dyn Surface,
    people: &'s [Disc],
    robots: &'s [Disc],
    /// The number of the robot that carries the device, which does not see it.
    own: usize,
}

impl core::fmt::Debug for Scene<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut it = f.debug_struct("Scene");
        it.field("people", &self.people).field("robots", &self.robots).field("own", &self.own);
        it.finish_non_exhaustive()
    }
}

impl<'s> Scene<'s> {
    /// A floor with people, and no other robot. The surface is the real one, uncharted furniture
    /// with it.
    pub fn of(surface: &'s dyn Surface, people: &'s [Disc]) -> Self {
        Self { surface, people, robots: &[], own: 0 }
    }

    /// Returns the scene with robots, as the one of a number sees it.
    #[must_use]
    pub fn among(self, robots: &'s [Disc], own: usize) -> Self {
        Self { robots, own, ..self }
    }

    /// Whether light goes straight from a point to another.
    pub fn is_clear(&self, from: Point, to: Point) -> bool {
        let way = to - from;
        let length = way.norm();
        let ray = Ray { from, along: if length > 0.0 { way / length } else { Vector::x() } };
        self.echo(&ray, length, Sense::Light).is_none()
    }

    fn others(&self) -> impl Iterator<Item = &Disc> {
        let (before, rest) = self.robots.split_at(self.own.min(self.robots.len()));
        self.people.iter().chain(before).chain(rest.iter().skip(1))
    }

    /// Returns the first thing that a ray meets within a range.
    pub(crate) fn echo(&self, ray: &Ray, range: f64, sense: Sense) -> Option<Echo> {
        let hit = self.surface.hit(ray, range, sense);
        let mut best = hit.map(|it| Echo { distance: it.distance, cosine: it.cosine });
        for disc in self.others() {
            let most = best.map_or(range, |it| it.distance);
            if let Some((distance, cosine)) = disc.meets(ray).filter(|it| it.0 <= most) {
                best = Some(Echo { distance, cosine });
            }
        }
        best
    }

    /// Writes how far each ray goes, infinity where nothing is within the range. The rays begin
    /// within `reach` of a point: discs that are far from it are asked but once.
    pub(crate) fn distances(
        &self,
        (centre, reach): (Point, f64),
        rays: &[Ray],
        range: f64,
        sense: Sense,
        out: &mut [f64],
    ) {
        self.surface.distances(rays, range, sense, out);
        for disc in self.others() {
            let most = range + reach + disc.radius;
            if (disc.centre - centre).norm_squared() > most * most {
                continue;
            }
            for (ray, out) in rays.iter().zip(out.iter_mut()) {
                if let Some((distance, _)) = disc.meets(ray)
                    && distance <= range
                {
                    *out = out.min(distance);
                }
            }
        }
    }
}
