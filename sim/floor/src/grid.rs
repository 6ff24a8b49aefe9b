//! A floor of cells: what a ROS map is.

mod columns;
mod march;
mod text;

use crate::geometry::{Bounds, Point, Pose, Ray, Vector, meets_box};
use crate::octants::{MAX_SIDE, Octants, Walk};
use crate::surface::{Footprint, Hit, Kind, Sense, Surface};
use columns::Columns;

/// The largest number of cells.
pub const MAX_CELLS: usize = 1 << 24;

/// A cell of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Cell {
    /// A body may be there.
    Free,
    /// Stops rays and bodies.
    Occupied,
    /// Stops bodies; rays pass, as nothing is known to be there.
    Unknown,
}

/// Reasons why cells are no floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GridError {
    /// The number of cells is none, more than [`MAX_CELLS`], or not that of width times height; or
    /// a side has more than 32,768 of them.
    Cells(usize),
    /// A side of a cell is not from 1 mm to 10 m.
    Resolution(f64),
    /// The origin is further than 1,000 km away.
    Origin(f64),
}

impl core::fmt::Display for GridError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Cells(cells) => {
                write!(f, "{cells} cells are not width times height, each at most {MAX_SIDE}, ")?;
                write!(f, "and {MAX_CELLS} at most")
            }
            Self::Resolution(it) => write!(f, "a cell of {it} m; it has 0.001 to 10 m"),
            Self::Origin(it) => write!(f, "an origin at {it} m; it is within 1,000,000 m"),
        }
    }
}

impl core::error::Error for GridError {}

/// A floor of square cells; row 0 is the lowest.
///
/// A ray hits the first occupied cell that it enters, at the side over which it enters it; one that
/// begins in such a cell hits it at once. A ray that passes a corner of four cells enters the one
/// above or below before the one beside.
///
/// ```
/// use cotama_floor::{Cell, Grid, Kind, Point, Ray, Sense, Surface};
/// let mut cells = [Cell::Free; 12];
/// cells[7] = Cell::Occupied; // the last of the second row
/// let grid = Grid::new(4, &cells, 0.5, Point::origin()).unwrap();
/// let ray = Ray::at(Point::new(0.25, 0.75), 0.0);
/// let hit = grid.hit(&ray, 8.0, Sense::Light).unwrap();
/// assert_eq!((hit.distance, hit.kind, hit.cosine), (1.25, Kind::Wall, 1.0));
/// assert_eq!(grid.hit(&ray, 1.0, Sense::Light), None);
/// assert_eq!(grid.clearance(Point::new(1.0, 0.75), 8.0), 0.5);
/// let walls = |x: f64| grid.walls_between(ray.from, Point::new(x, 0.75));
/// assert_eq!([walls(1.4), walls(1.6), walls(9.0)], [0, 1, 1]);
/// ```
#[derive(Clone, Debug)]
pub struct Grid {
    width: usize,
    height: usize,
    resolution: f64,
    per_metre: f64,
    origin: Point,
    cells: Vec<Cell>,
    /// Cells without a wall.
    octants: Octants,
    walls: Columns,
    blocked: Columns,
}

impl Grid {
    /// Makes a floor of cells, row by row from the lowest; `resolution` is the side of a cell, and
    /// `origin` the left lower corner of the first, in metres.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        width: usize,
        cells: &[Cell],
        resolution: f64,
        origin: Point,
    ) -> Result<Self, GridError> {
        let height = cells.len().checked_div(width).unwrap_or(0);
        let sides = width.max(height);
        let is_large = cells.len() > MAX_CELLS || sides > MAX_SIDE;
        if cells.is_empty() || is_large || width * height != cells.len() {
            return Err(GridError::Cells(cells.len()));
        }
        if !(0.001..=10.0).contains(&resolution) {
            return Err(GridError::Resolution(resolution));
        }
        if let Some(it) = origin.iter().find(|it| !(-1e6..=1e6).contains(*it)) {
            return Err(GridError::Origin(*it));
        }
        let is_wall = |x: usize, y: usize| cells[y * width + x] == Cell::Occupied;
        Ok(Self {
            width,
            height,
            resolution,
            per_metre: resolution.recip(),
            origin,
            cells: cells.to_vec(),
            octants: Octants::of(width, height, |x, y| !is_wall(x, y)),
            walls: Columns::of(width, height, is_wall),
            blocked: Columns::of(width, height, |x, y| cells[y * width + x] != Cell::Free),
        })
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The side of a cell in metres.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// All cells, row by row from the lowest.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Returns the cell of a column and a row; unknown outside.
    pub fn cell(&self, x: usize, y: usize) -> Cell {
        let inside = x < self.width && y < self.height;
        let cell = inside.then(|| self.cells.get(y * self.width + x)).flatten();
        cell.copied().unwrap_or(Cell::Unknown)
    }

    /// Returns a point in cells.
    #[inline]
    fn in_cells(&self, at: Point) -> Point {
        Point::from((at - self.origin) * self.per_metre)
    }

    /// Begins a ray, and says how far it went before that, in cells.
    #[inline]
    fn start(&self, ray: &Ray) -> Option<(Walk, f64)> {
        let from = self.in_cells(ray.from);
        let inside = self.octants.holds(from);
        let before = if inside { 0.0 } else { self.octants.entry(from, ray.along)? };
        Some((self.octants.walk(from + ray.along * before, ray.along), before))
    }
}

impl Surface for Grid {
    fn bounds(&self) -> Bounds {
        let size = Vector::new(self.width as f64, self.height as f64) * self.resolution;
        Bounds { least: self.origin, most: self.origin + size }
    }

    fn hit(&self, ray: &Ray, range: f64, _: Sense) -> Option<Hit> {
        let (mut walk, before) = self.start(ray)?;
        let most = range * self.per_metre;
        while walk.distance + before <= most {
            if walk.is_open() {
                self.octants.step(&mut walk);
                continue;
            }
            if !walk.has_hit() {
                break;
            }
            let distance = (walk.distance + before) * self.resolution;
            let cosine = ray.along[walk.axis()].abs();
            return Some(Hit { distance, kind: Kind::Wall, cosine });
        }
        None
    }

    fn distances(&self, rays: &[Ray], range: f64, _: Sense, out: &mut [f64]) {
        march::march(self, rays, range, out);
    }

    fn distance(&self, at: Point, most: f64, _: Sense) -> f64 {
        self.walls.nearest(self.in_cells(at), most * self.per_metre) * self.resolution
    }

    fn clearance(&self, at: Point, most: f64) -> f64 {
        let most = most.min(self.bounds().margin(at));
        self.blocked.nearest(self.in_cells(at), most * self.per_metre) * self.resolution
    }

    fn walls_between(&self, a: Point, b: Point) -> usize {
        let (from, to) = (self.in_cells(a), self.in_cells(b));
        let along = to - from;
        // Two looks in the length of a cell, and of lines from afar no more than the map has.
        let most = 4 * (self.width + self.height);
        let steps = ((2.0 * along.norm()).ceil() as usize).clamp(1, most);
        let is_wall = |step: usize| {
            let at = from + along * (step as f64 / steps as f64);
            let inside = at.x >= 0.0 && at.y >= 0.0;
            inside && self.cell(at.x as usize, at.y as usize) == Cell::Occupied
        };
        (1..=steps).filter(|step| is_wall(*step) && !is_wall(step - 1)).count()
    }

    fn is_free(&self, footprint: &Footprint, pose: &Pose) -> bool {
        let mut corners = [Point::origin(); Footprint::MAX_CORNERS];
        let (corners, around) = match footprint.near(self, pose, &mut corners) {
            Ok(near) => near,
            Err(is_free) => return is_free,
        };
        let (low, high) = (self.in_cells(around.least), self.in_cells(around.most));
        for y in low.y as usize..=(high.y as usize).min(self.height - 1) {
            for x in low.x as usize..=(high.x as usize).min(self.width - 1) {
                if self.cell(x, y) == Cell::Free {
                    continue;
                }
                let corner = Vector::new(x as f64, y as f64) * self.resolution;
                let least = self.origin + corner;
                let most = least + Vector::repeat(self.resolution);
                if meets_box(corners, &Bounds { least, most }) {
                    return false;
                }
            }
        }
        true
    }
}
