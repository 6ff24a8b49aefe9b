//! Values of cells, from pixels.

use super::image::{Image, ImageError};
use super::kinds::read;
use super::metadata::{Metadata, Mode};
use crate::geometry::Point;
use crate::grid::{Cell, Grid, GridError};

/// A map as a ROS `OccupancyGrid` has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    metadata: Metadata,
    width: usize,
    height: usize,
    values: Vec<i8>,
}

const UNKNOWN: i8 = -1;
const OCCUPIED: i8 = 100;

impl Map {
    /// Reads the image of a map: a PNG or a PGM, whatever its name. `source_name` is its name in
    /// messages.
    ///
    /// # Errors
    /// An image that is broken, too large or of another kind.
    pub fn read(metadata: &Metadata, source_name: &str, image: &[u8]) -> Result<Self, ImageError> {
        let Image { width, height, greys, opacities } = read(source_name, image)?;
        let table = table(metadata);
        let mut values = Vec::with_capacity(greys.len());
        for row in (0..height).rev() {
            let row = row * width..(row + 1) * width;
            let greys = greys.get(row.clone()).unwrap_or_default();
            values.extend(greys.iter().map(|it| table[*it as usize]));
            if let (Some(all), true) = (&opacities, metadata.mode != Mode::Raw) {
                let start = values.len() - greys.len();
                let opaque = all.get(row).unwrap_or_default();
                let hidden = values[start..].iter_mut().zip(opaque).filter(|it| *it.1 < u8::MAX);
                hidden.for_each(|it| *it.0 = UNKNOWN);
            }
        }
        Ok(Self { metadata: metadata.clone(), width, height, values })
    }

    /// The text that the map came with.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The values, row by row from the lowest: -1 is unknown, 0 free, 100 occupied.
    pub fn values(&self) -> &[i8] {
        &self.values
    }

    /// Makes a floor: 0 is free, 100 is occupied, all between and -1 are unknown, as AMCL takes
    /// them (`nav2_amcl`, `convertMap`). The yaw is not used.
    ///
    /// # Errors
    /// None of a map that was read: its numbers are in range.
    pub fn grid(&self) -> Result<Grid, GridError> {
        let cell = |it: &i8| match it {
            0 => Cell::Free,
            &OCCUPIED => Cell::Occupied,
            _ => Cell::Unknown,
        };
        let cells: Vec<Cell> = self.values.iter().map(cell).collect();
        let [x, y, _] = self.metadata.origin;
        Grid::new(self.width, &cells, self.metadata.resolution, Point::new(x, y))
    }
}

/// The value of each grey.
fn table(metadata: &Metadata) -> [i8; 256] {
    let Metadata { mode, negate, free_thresh, occupied_thresh, .. } = metadata;
    let (free, occupied) = (*free_thresh as f32, *occupied_thresh as f32);
    let span = (occupied_thresh - free_thresh) as f32;
    core::array::from_fn(|grey| {
        if *mode == Mode::Raw {
            return if grey <= OCCUPIED as usize { grey as i8 } else { UNKNOWN };
        }
        let light = grey as f32 / 255.0;
        let it = if *negate { light } else { 1.0 - light };
        if it <= free {
            0
        } else if it >= occupied {
            OCCUPIED
        } else if *mode == Mode::Scale {
            ((it - free) / span * 100.0).round() as i8
        } else {
            UNKNOWN
        }
    })
}
