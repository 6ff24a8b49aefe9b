//! The floor of a run, as its trace holds it.

use crate::NoRecording;
use cotama_floor::{Bounds, Held, Point, metres};
use cotama_sim::trace::Header;

/// The floor of a run, and the path over it.
#[derive(Debug)]
pub(crate) struct Ground {
    /// The floor as sensors meet it.
    pub(crate) real: Held,
    /// The floor as the robot knows it.
    pub(crate) charted: Held,
    /// Corners of the path.
    pub(crate) path: Vec<Point>,
}

/// The map of a floor in cells, row after row from the left lower corner.
#[derive(Debug)]
pub(crate) struct Raster {
    /// The left lower corner.
    pub(crate) least: Point,
    pub(crate) cell_m: f64,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) cells: Vec<u8>,
}

/// Content of a cell of an occupancy grid.
const FREE: u8 = 0;
const OCCUPIED: u8 = 100;
/// The size of a cell; twice that, and so on, where a map had more cells than the most.
const CELL_M: f64 = 0.05;
const MOST_CELLS: f64 = 4_000_000.0;

impl Ground {
    /// Returns the floor of a run with its doors as the mission has them.
    pub(crate) fn of(header: &Header) -> Result<Self, NoRecording> {
        let way = header.floor.as_ref().ok_or(NoRecording::Line)?.way(&header.mission);
        let [real, charted] = Held::of(&way).map_err(NoRecording::Floor)?;
        let mut path: Vec<_> = way.points().iter().map(|it| metres(*it)).collect();
        path.dedup();
        Ok(Self { real, charted, path })
    }

    /// Returns the map of the robot. A cell is occupied if a disc in it cannot be free: it comes
    /// as near to something as half its width, so that no wall has a gap.
    pub(crate) fn raster(&self) -> Raster {
        let Bounds { least, .. } = self.charted.surface().bounds();
        let (width_m, height_m) =
            (self.charted.surface().bounds().width(), self.charted.surface().bounds().height());
        let mut cell_m = CELL_M;
        while (width_m / cell_m).ceil() * (height_m / cell_m).ceil() > MOST_CELLS {
            cell_m *= 2.0;
        }
        let [width, height] = [width_m, height_m].map(|it| (it / cell_m).ceil() as usize);
        // Half a cell is rounded: a wall between two cells is in both.
        let reach = cell_m / 2.0 + 1e-9;
        let mut cells = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let middle = [x, y].map(|it| (it as f64 + 0.5) * cell_m);
                let at = least + Point::from(middle).coords;
                let room = self.charted.surface().clearance(at, cell_m);
                cells.push(if room <= reach { OCCUPIED } else { FREE });
            }
        }
        Raster { least, cell_m, width, height, cells }
    }
}
