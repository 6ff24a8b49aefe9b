//! The answer of `cotama floor`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama floor`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FloorAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/floor/1")))]
    pub(crate) schema: &'static str,
    /// Name of the floor.
    pub(crate) name: String,
    /// The floor in a few words; may be empty.
    pub(crate) title: String,
    pub(crate) width_mm: u64,
    pub(crate) height_mm: u64,
    /// Parts of a drawing; none of a map.
    pub(crate) drawing: Option<Drawn>,
    /// Cells of a map; none of a drawing.
    pub(crate) map: Option<Mapped>,
    /// The path that was asked for; none without, or where there is none.
    pub(crate) path: Option<PathRow>,
    /// Why there is no path; none where there is one, or none was asked for.
    pub(crate) no_path: Option<String>,
}

/// The parts of a drawing.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Drawn {
    /// How many walls there are.
    pub(crate) walls: usize,
    /// How many panes of glass there are.
    pub(crate) glass: usize,
    /// How many pieces of furniture there are.
    pub(crate) furniture: usize,
    /// How many of them are not on the map of the robot.
    pub(crate) uncharted: usize,
    /// How many QR marks there are.
    pub(crate) marks: usize,
    pub(crate) doors: Vec<DoorRow>,
    pub(crate) places: Vec<PlaceRow>,
    pub(crate) zones: Vec<String>,
}

/// A door.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DoorRow {
    pub(crate) name: String,
    pub(crate) open: bool,
}

/// A place.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PlaceRow {
    pub(crate) name: String,
    pub(crate) x_mm: i32,
    pub(crate) y_mm: i32,
    /// Whether it is a docking station.
    pub(crate) dock: bool,
}

/// The cells of a map.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Mapped {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// The side of a cell, in mm.
    pub(crate) cell_mm: f64,
    pub(crate) free: usize,
    pub(crate) occupied: usize,
    pub(crate) unknown: usize,
}

/// A path.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PathRow {
    pub(crate) from: String,
    pub(crate) to: String,
    /// The radius of the robot, in mm.
    pub(crate) radius_mm: u64,
    pub(crate) length_mm: u64,
    /// The corners of the path: x and y in mm.
    pub(crate) corners_mm: Vec<[i32; 2]>,
    /// The zones on the path, as a mission has them.
    pub(crate) zones: Vec<SpanRow>,
}

/// A zone on a path.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct SpanRow {
    pub(crate) zone: String,
    pub(crate) x_start_mm: u64,
    pub(crate) x_end_mm: u64,
}
