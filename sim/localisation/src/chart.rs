//! A floor prepared for a sensor and its model, once for all robots that have them.

mod casts;
mod field;
mod mixture;
mod reading;

pub(crate) use reading::Reading;

use crate::parameters::{Model, Parameters, ParametersError};
use crate::particles::Particles;
use crate::sensor::{Sensor, evenly};
use casts::Casts;
use cotama_floor::{Bounds, Point, Surface, Vector};
use cotama_streams::Stream;
use field::Likelihoods;
use reading::OnRobot;

/// The most cells of a likelihood field.
pub const MAX_FIELD_CELLS: usize = 1 << 22;
/// The most cells of the ranges of the beam model.
pub const MAX_CAST_CELLS: usize = 1 << 19;

/// Reasons why there is no chart.
#[derive(Clone, Debug, PartialEq)]
pub enum ChartError {
    /// A parameter makes no sense.
    Parameters(ParametersError),
    /// The side of a cell is not from 1 cm to 1 m.
    Cell(f64),
    /// There would be so many cells, more than [`MAX_FIELD_CELLS`] or [`MAX_CAST_CELLS`].
    TooMany {
        /// The number of cells.
        cells: f64,
        /// The most.
        most: usize,
    },
    /// No cell of the floor has room for a robot.
    NoRoom,
}

impl core::fmt::Display for ChartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Parameters(it) => it.fmt(f),
            Self::Cell(it) => write!(f, "a cell of {it} m; give 0.01 to 1 m"),
            Self::TooMany { cells, most } => {
                write!(f, "{cells} cells; at most {most}: use larger ones")
            }
            Self::NoRoom => f.write_str("no cell has room for a robot; use smaller ones"),
        }
    }
}

impl core::error::Error for ChartError {}

/// The cells of a chart.
#[derive(Clone, Copy, Debug)]
struct Cells {
    columns: usize,
    rows: usize,
    size: f64,
    origin: Point,
}

impl Cells {
    fn of(bounds: &Bounds, size: f64, most: usize) -> Result<Self, ChartError> {
        if !(0.01..=1.0).contains(&size) {
            return Err(ChartError::Cell(size));
        }
        // A hair less, as ten cells of 0.1 m are ten, not eleven.
        let count = |length: f64| (length / size - 1e-6).ceil().max(1.0);
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        if columns * rows > most as f64 {
            return Err(ChartError::TooMany { cells: columns * rows, most });
        }
        Ok(Self { columns: columns as usize, rows: rows as usize, size, origin: bounds.least })
    }

    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// The centre of a cell, row by row from the lowest.
    fn centre(&self, at: usize) -> Point {
        let (x, y) = (at % self.columns, at / self.columns);
        self.origin + Vector::new(x as f64 + 0.5, y as f64 + 0.5) * self.size
    }
}

#[derive(Clone, Debug)]
enum Table {
    Field(Likelihoods),
    Casts(Casts),
}

/// A floor prepared for a sensor and its model: the likelihood of each cell, or the range of each
/// cell and way, and where robots may be. Robots of the same sensor and parameters share it.
///
/// A likelihood field takes 4 bytes a cell, the beam model 256; each free cell takes 4 more.
#[derive(Clone, Debug)]
pub struct Chart {
    parameters: Parameters,
    sensor: Sensor,
    cells: Cells,
    /// Numbers of the cells in which a robot may be.
    free: Vec<u32>,
    /// Rays of the beams that are looked at: the first ones of all, then the second, and so on.
    rays: Vec<OnRobot>,
    table: Table,
}

impl Chart {
    /// Prepares a floor, as the robot knows it, in cells of a size: 0.05 m for a likelihood field
    /// and 0.1 m for the beam model do well.
    ///
    /// # Errors
    /// Parameters that make no sense, and cells that are too small or too many.
    pub fn new(
        surface: &dyn Surface,
        cell_m: f64,
        sensor: &Sensor,
        parameters: &Parameters,
    ) -> Result<Self, ChartError> {
        parameters.check().map_err(ChartError::Parameters)?;
        let is_beam = parameters.laser_model_type == Model::Beam;
        let most = if is_beam { MAX_CAST_CELLS } else { MAX_FIELD_CELLS };
        let cells = Cells::of(&surface.bounds(), cell_m, most)?;
        let is_free = |at: &u32| surface.clearance(cells.centre(*at as usize), cell_m) > 0.0;
        let free: Vec<u32> = (0..cells.count() as u32).filter(is_free).collect();
        if free.is_empty() {
            return Err(ChartError::NoRoom);
        }
        let taken = sensor.beams().min(parameters.max_beams);
        let rays = (0..sensor.rays()).flat_map(|ray| {
            let beams = (0..taken).map(|it| evenly(it, taken, sensor.beams()));
            beams.filter_map(move |it| OnRobot::of(sensor, it, ray))
        });
        let rays: Vec<_> = rays.collect();
        let range_m = range_of(parameters, sensor);
        let table = if is_beam {
            Table::Casts(Casts::of(surface, &cells, &free, sensor, parameters, range_m))
        } else {
            Table::Field(Likelihoods::of(surface, &cells, sensor, parameters, range_m))
        };
        let (parameters, sensor) = (parameters.clone(), sensor.clone());
        Ok(Self { parameters, sensor, cells, free, rays, table })
    }

    /// Returns the parameters.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Returns the sensor.
    pub fn sensor(&self) -> &Sensor {
        &self.sensor
    }

    /// Returns the left lower corner of the floor.
    pub(crate) fn origin(&self) -> Point {
        self.cells.origin
    }

    /// An empty reading with room for all beams that are looked at.
    pub(crate) fn reading(&self) -> Reading {
        Reading::with_capacity(self.rays.len(), self.sensor.rays())
    }

    /// Makes a reading of ranges, one a beam; returns how many beams say something.
    pub(crate) fn look(&self, ranges: &[f64], reading: &mut Reading) -> usize {
        let range_m = range_of(&self.parameters, &self.sensor);
        let mixture = match &self.table {
            Table::Field(_) => None,
            Table::Casts(it) => Some(it.mixture()),
        };
        reading.look(ranges, &self.rays, &self.parameters, range_m, mixture);
        reading.beams()
    }

    /// Writes the likelihood of a reading at each particle: 1 + Σ p³ over the beams, or for
    /// products Σ ln p.
    pub(crate) fn weigh(&self, reading: &Reading, particles: &Particles, out: &mut [f32]) {
        match &self.table {
            Table::Field(it) => it.weigh(reading, particles, out),
            Table::Casts(it) => it.weigh(reading, particles, out),
        }
    }

    /// Draws a pose evenly from the free cells, in metres from the left lower corner.
    pub(crate) fn anywhere(&self, stream: &mut Stream) -> [f32; 3] {
        let at = stream.below(self.free.len() as u64) as usize;
        let at = self.free.get(at).map_or(0, |it| *it as usize);
        let size = self.cells.size;
        let x = ((at % self.cells.columns) as f64 + stream.part()) * size;
        let y = ((at / self.cells.columns) as f64 + stream.part()) * size;
        let heading = (stream.part() - 0.5) * core::f64::consts::TAU;
        [x as f32, y as f32, heading as f32]
    }
}

/// The range up to which beams are looked at, in metres.
fn range_of(parameters: &Parameters, sensor: &Sensor) -> f64 {
    let most = parameters.laser_max_range;
    if most > 0.0 { sensor.range_m().min(most) } else { sensor.range_m() }
}
