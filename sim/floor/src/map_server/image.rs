//! Images as greys, whatever their file.

use crate::grid::MAX_CELLS;
use crate::octants::MAX_SIDE;
use cotama_models::reading::Position;
use std::fmt;

/// The greys of an image, row by row from the top, and how opaque they are if the file says it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Image {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) greys: Vec<u8>,
    pub(super) opacities: Option<Vec<u8>>,
}

/// An image that cannot be read.
///
/// Its `Display` is `file:line:column: message` where the file has lines, else `file: message`, and
/// a line of help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageError {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The place, in a file that has lines.
    pub position: Option<Position>,
    /// The cause.
    pub message: String,
    /// The remedy.
    pub help: &'static str,
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source_name, position, message, help } = self;
        write!(f, "{source_name}:")?;
        if let Some(Position { line, column }) = position {
            write!(f, "{line}:{column}:")?;
        }
        write!(f, " {message}\n  help: {help}")
    }
}

impl std::error::Error for ImageError {}

/// A cause, and where it stands in the bytes if that can be said in lines.
pub(super) struct Broken {
    pub(super) at: Option<usize>,
    pub(super) message: String,
    pub(super) help: &'static str,
}

/// Checks the size of an image; `at` is where it is said.
pub(super) fn cells(width: u64, height: u64, at: Option<usize>) -> Result<usize, Broken> {
    let cells = width.checked_mul(height).and_then(|it| usize::try_from(it).ok());
    if cells == Some(0) {
        let message = format!("an image of {width} x {height} pixels has none");
        return Err(Broken { at, message, help: "save the map again" });
    }
    let fits = width.max(height) <= MAX_SIDE as u64;
    cells.filter(|it| *it <= MAX_CELLS && fits).ok_or_else(|| Broken {
        at,
        message: format!(
            "{width} x {height} pixels: at most {MAX_SIDE} a side, {MAX_CELLS} in all"
        ),
        help: "crop the map, or save it with larger cells",
    })
}

/// Returns the grey of a colour whose channels have 16 bits.
pub(super) fn grey([red, green, blue]: [u16; 3]) -> u8 {
    let sum = 299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue);
    ((sum + 500) / 1_000 / 257) as u8
}
