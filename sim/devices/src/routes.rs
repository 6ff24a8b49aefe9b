//! Ways between places, on which people walk.

use crate::settings::{SettingsError, within};
use cotama_floor::{Path, Planner, Point};

/// The most places.
pub const MAX_PLACES: usize = 64;

/// The ways between each two of some places; there may be none between two.
#[derive(Clone, Debug)]
pub struct Routes {
    places: Vec<Point>,
    /// The ways, row by row of where they begin.
    ways: Vec<Option<Path>>,
}

impl Routes {
    /// Plans the ways: there and back on the same one. Between places that nothing leads to there
    /// is none.
    ///
    /// # Errors
    /// No place, or more than [`MAX_PLACES`].
    ///
    /// ```
    /// use cotama_devices::Routes;
    /// use cotama_floor::{Needs, Planner, Point, Version, embedded, metres};
    /// let office = embedded::OFFICE.floor().unwrap();
    /// let surface = office.surface(Version::Real, &[]).unwrap();
    /// let needs = Needs { radius_m: 0.25, ..Needs::default() };
    /// let planner = Planner::new(&surface, needs).unwrap();
    /// let place = |name| metres(office.place(name).unwrap().at);
    /// let places = ["lab", "kitchen", "office D"].map(place);
    /// let routes = Routes::plan(&planner, &places).unwrap();
    /// assert!(routes.way(0, 1).is_some() && routes.way(0, 2).is_none()); // D is closed
    /// ```
    pub fn plan(planner: &Planner<'_>, places: &[Point]) -> Result<Self, SettingsError> {
        Self::by(places, |from, to| planner.route(from, to).ok())
    }

    /// Takes the way from each place to each later one as a function gives it.
    ///
    /// # Errors
    /// No place, or more than [`MAX_PLACES`].
    pub fn by(
        places: &[Point],
        mut way: impl FnMut(Point, Point) -> Option<Path>,
    ) -> Result<Self, SettingsError> {
        let count = places.len();
        within("the number of places", count as f64, 1.0, MAX_PLACES as f64)?;
        let mut ways = vec![None; count * count];
        for (one, from) in places.iter().enumerate() {
            for (two, to) in places.iter().enumerate().skip(one + 1) {
                let Some(path) = way(*from, *to) else { continue };
                let back = path.points().iter().rev().copied().collect();
                ways[two * count + one] = Path::new(back);
                ways[one * count + two] = Some(path);
            }
        }
        Ok(Self { places: places.to_vec(), ways })
    }

    /// The places.
    pub fn places(&self) -> &[Point] {
        &self.places
    }

    /// Returns the way from a place to another.
    pub fn way(&self, from: usize, to: usize) -> Option<&Path> {
        let count = self.places.len();
        if to >= count {
            return None;
        }
        self.ways.get(from.checked_mul(count)?.checked_add(to)?)?.as_ref()
    }

    /// Returns the places that a way leads to.
    pub(crate) fn from(&self, from: usize) -> impl Iterator<Item = usize> {
        (0..self.places.len()).filter(move |to| self.way(from, *to).is_some())
    }
}
