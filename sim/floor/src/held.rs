//! A floor as a mission holds it: a drawing, or a map of cells, in one text.

use crate::floor::{Floor, Version};
use crate::grid::Grid;
use crate::segments::Segments;
use crate::surface::Surface;
use cotama_models::missions::Way;

/// A surface that is drawn, or made of cells.
#[derive(Clone, Debug)]
pub enum Held {
    /// Surface of a drawing.
    Drawing(Box<Segments>),
    /// Surface of a map.
    Map(Box<Grid>),
}

impl Held {
    /// Returns the floor of a way as it is, and as the robot's map has it: for a map the same.
    ///
    /// # Errors
    /// The reason why its text is no floor, in words.
    pub fn of(way: &Way) -> Result<[Self; 2], String> {
        if let Some(grid) = Grid::parse(&way.text) {
            let map = Self::Map(Box::new(grid));
            return Ok([map.clone(), map]);
        }
        let floor = Floor::parse(&way.source, &way.text).map_err(|it| it.to_string())?;
        let floor = floor.with_doors(&way.asked.open, &way.asked.close).map_err(|it| it.message)?;
        let drawn = |version| {
            let it = floor.surface(version, &[]).map_err(|it| it.to_string())?;
            Ok::<_, String>(Self::Drawing(Box::new(it)))
        };
        Ok([drawn(Version::Real)?, drawn(Version::Charted)?])
    }

    /// Returns the surface.
    pub fn surface(&self) -> &dyn Surface {
        match self {
            Self::Drawing(it) => &**it,
            Self::Map(it) => &**it,
        }
    }
}
