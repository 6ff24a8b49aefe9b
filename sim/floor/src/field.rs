//! Distances of a floor, computed once on a grid.

use crate::geometry::{Point, Vector};
use crate::grid::MAX_CELLS;
use crate::surface::{Sense, Surface};

/// The distance that is noted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// [`Surface::distance`]: to what a sense notices.
    Seen(Sense),
    /// [`Surface::clearance`]: the room that a body has.
    Room,
}

/// Reasons why there is no field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldError {
    /// The side of a cell is not from 1 mm to 10 m.
    Cell(f64),
    /// So many cells are more than [`MAX_CELLS`].
    TooMany(f64),
}

impl core::fmt::Display for FieldError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Cell(it) => write!(f, "a cell of {it} m; it has 0.001 to 10 m"),
            Self::TooMany(it) => write!(f, "{it} cells; at most {MAX_CELLS}: use larger ones"),
        }
    }
}

impl core::error::Error for FieldError {}

/// The distance at the centre of each cell, in metres, to single precision.
///
/// ```
/// use cotama_floor::{Field, Measure, Point, Sense, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Charted, &[]).unwrap();
/// let field = Field::of(&surface, 0.1, 2.0, Measure::Seen(Sense::Light)).unwrap();
/// // In the middle of a corridor of 2 m; the cell's centre is 0.05 m beside.
/// assert!((field.at(Point::new(6.51, 10.01)) - 0.95).abs() < 1e-6);
/// assert!(field.likelihood(Point::new(6.51, 10.99), 0.1) > 0.8);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    values: Vec<f32>,
}

impl Field {
    /// Asks a floor at the centre of each cell; distances beyond `most_m` are `most_m`.
    ///
    /// # Errors
    /// Cells that are too small or too many.
    pub fn of(
        surface: &dyn Surface,
        cell_m: f64,
        most_m: f64,
        measure: Measure,
    ) -> Result<Self, FieldError> {
        if !(0.001..=10.0).contains(&cell_m) {
            return Err(FieldError::Cell(cell_m));
        }
        let bounds = surface.bounds();
        // A hair less, as ten cells of 0.1 m are ten, not eleven.
        let count = |size: f64| (size / cell_m - 1e-6).ceil().max(1.0);
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        if columns * rows > MAX_CELLS as f64 {
            return Err(FieldError::TooMany(columns * rows));
        }
        let (columns, rows) = (columns as usize, rows as usize);
        let mut it = Self { origin: bounds.least, cell: cell_m, columns, rows, values: vec![] };
        let distance = |at: usize| {
            let centre = it.centre(at);
            let it = match measure {
                Measure::Seen(sense) => surface.distance(centre, most_m, sense),
                Measure::Room => surface.clearance(centre, most_m),
            };
            it as f32
        };
        it.values = (0..columns * rows).map(distance).collect();
        Ok(it)
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The side of a cell in metres.
    pub fn cell(&self) -> f64 {
        self.cell
    }

    /// All distances, row by row from the lowest.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// Returns the centre of a cell, by number.
    pub fn centre(&self, at: usize) -> Point {
        let (x, y) = (at % self.columns, at / self.columns);
        self.origin + Vector::new(x as f64 + 0.5, y as f64 + 0.5) * self.cell
    }

    /// Returns the number of the cell that holds a point; `None` outside.
    pub fn index(&self, at: Point) -> Option<usize> {
        let it = (at - self.origin) / self.cell;
        let inside = it.x >= 0.0 && it.y >= 0.0;
        let (x, y) = (it.x as usize, it.y as usize);
        (inside && x < self.columns && y < self.rows).then_some(y * self.columns + x)
    }

    /// Returns the distance of the cell that holds a point; 0 outside.
    pub fn at(&self, at: Point) -> f64 {
        let it = self.index(at).and_then(|it| self.values.get(it));
        it.copied().map_or(0.0, f64::from)
    }

    /// Returns how likely it is that a ray ends at a point, up to a factor: 1 on something, less
    /// with the distance, by a normal distribution. (Thrun, Burgard, Fox, Probabilistic Robotics,
    /// 2005, section 6.4)
    pub fn likelihood(&self, at: Point, sigma_m: f64) -> f64 {
        let it = self.at(at) / sigma_m;
        libm::exp(-it * it / 2.0)
    }
}
