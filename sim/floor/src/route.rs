//! Planning of a way over a floor.

mod search;
mod shorten;

use crate::field::{Field, FieldError, Measure};
use crate::geometry::Point;
use crate::path::Path;
use crate::surface::Surface;
use cotama_core::units::Millimetres;

/// The robot for which a way is planned, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Needs {
    /// Radius of the disc that must find room everywhere, in metres.
    pub radius_m: f64,
    /// Room that is liked, in metres: closer to things, a way counts up to three times its length.
    pub liked_m: f64,
    /// Side of the cells of the search, in metres.
    pub cell_m: f64,
}

impl Default for Needs {
    /// A Pioneer 3-DX turns in a disc of 0.26 m (its manual, appendix B); cells of 0.05 m.
    fn default() -> Self {
        Self { radius_m: 0.26, liked_m: 0.6, cell_m: 0.05 }
    }
}

impl Needs {
    /// The same with so much more room than the radius.
    #[must_use]
    pub fn beyond(self, clearance: Millimetres) -> Self {
        Self { radius_m: self.radius_m + clearance.0 as f64 / 1_000.0, ..self }
    }
}

/// Reasons why there is no way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RouteError {
    /// Radius or liked room is not from 0 to 10 m.
    Needs(Needs),
    /// The cells are too small or too many.
    Field(FieldError),
    /// The robot finds no room at the start; the room that there is, in metres.
    Start(f64),
    /// The robot finds no room at the goal; the room that there is, in metres.
    Goal(f64),
    /// Nothing leads from the start to the goal: so many cells are reached.
    None(usize),
}

impl core::fmt::Display for RouteError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Needs(it) => {
                write!(f, "a radius of {} m and {} m of room", it.radius_m, it.liked_m)
            }
            Self::Field(it) => write!(f, "{it}"),
            Self::Start(it) => write!(f, "no room for the robot at the start: {it:.3} m around"),
            Self::Goal(it) => write!(f, "no room for the robot at the goal: {it:.3} m around"),
            Self::None(it) => write!(f, "no way from start to goal: {it} cells are reached"),
        }
    }
}

impl core::error::Error for RouteError {}

/// Plans ways on one floor.
///
/// A* over cells with eight neighbours: the cost of a step is its length, times 1 where the liked
/// room is and up to 3 where there is just enough; a diagonal step needs both cells beside it. Of
/// ways of the same cost it is always the same one. The way is then pulled straight wherever the
/// straight line has as much room as what it replaces, or the liked one.
///
/// ```
/// use cotama_floor::{Needs, Planner, Version, embedded, metres};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Charted, &[]).unwrap();
/// let planner = Planner::new(&surface, Needs::default()).unwrap();
/// let place = |name| metres(office.place(name).unwrap().at);
/// let path = planner.route(place("dock"), place("office B")).unwrap();
/// let corridor = &office.zones[0];
/// let spans = path.spans(&corridor.corners());
/// assert_eq!(spans.len(), 1);
/// // The door of office D is closed.
/// let none = planner.route(place("dock"), place("office D")).unwrap_err();
/// assert!(none.to_string().starts_with("no way from start to goal"));
/// ```
pub struct Planner<'s> {
    surface: &'s dyn Surface,
    needs: Needs,
    room: Field,
}

impl core::fmt::Debug for Planner<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Planner").field("needs", &self.needs).finish_non_exhaustive()
    }
}

impl<'s> Planner<'s> {
    /// Computes the room in each cell.
    ///
    /// # Errors
    /// Needs that are out of range, and cells that are too small or too many.
    pub fn new(surface: &'s dyn Surface, needs: Needs) -> Result<Self, RouteError> {
        let range = 0.0..=10.0;
        if !range.contains(&needs.radius_m) || !range.contains(&needs.liked_m) {
            return Err(RouteError::Needs(needs));
        }
        let most = needs.liked_m.max(needs.radius_m) + needs.cell_m;
        let room = Field::of(surface, needs.cell_m, most, Measure::Room);
        Ok(Self { surface, needs, room: room.map_err(RouteError::Field)? })
    }

    /// Returns the room in each cell.
    pub fn room(&self) -> &Field {
        &self.room
    }

    /// Plans a way.
    ///
    /// # Errors
    /// When the robot finds no room at an end, or there is no way.
    pub fn route(&self, from: Point, to: Point) -> Result<Path, RouteError> {
        let room = |at: Point| self.surface.clearance(at, self.needs.radius_m);
        let [start, goal] = [room(from), room(to)];
        if start < self.needs.radius_m {
            return Err(RouteError::Start(start));
        }
        if goal < self.needs.radius_m {
            return Err(RouteError::Goal(goal));
        }
        let ends = [self.cell_near(from), self.cell_near(to)];
        let [Some(first), Some(last)] = ends else { return Err(RouteError::None(0)) };
        let cells =
            search::search(&self.room, self.needs, first, last).map_err(RouteError::None)?;
        let centres = cells.iter().map(|it| self.room.centre(*it));
        let points: Vec<_> = core::iter::once(from).chain(centres).chain([to]).collect();
        let points = shorten::shorten(self.surface, self.needs, &points);
        // A robot that is there already has a way of 1 mm.
        let short = || Path::new(vec![from, from + nalgebra::Vector2::new(0.001, 0.0)]);
        Path::new(points).or_else(short).ok_or(RouteError::None(0))
    }

    /// Returns the nearest cell with enough room that a straight line leads to.
    fn cell_near(&self, at: Point) -> Option<usize> {
        let middle = self.room.index(at)?;
        let columns = self.room.columns().cast_signed();
        let mut near: Vec<(f64, usize)> = Vec::new();
        for y in -2..=2 {
            for x in -2..=2 {
                let cell = middle.checked_add_signed(y * columns + x);
                let Some(cell) = cell.filter(|it| *it < self.room.values().len()) else { continue };
                let enough = self.room.values().get(cell).copied().map_or(0.0, f64::from);
                let centre = self.room.centre(cell);
                let distance = (centre - at).norm();
                let radius = self.needs.radius_m;
                if enough >= radius && shorten::is_free(self.surface, at, centre, radius) {
                    near.push((distance, cell));
                }
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.first().map(|it| it.1)
    }
}
