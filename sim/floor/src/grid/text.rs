//! Grids as text: a map in one piece, without its image beside it.

use super::{Cell, Grid};
use crate::geometry::Point;
use std::fmt::Write;

/// First word of a grid as text.
const FORMAT: &str = "cotama-grid/1";
/// Letters of cells: free, occupied, unknown.
const LETTERS: [(char, Cell); 3] = [('f', Cell::Free), ('o', Cell::Occupied), ('u', Cell::Unknown)];

impl Grid {
    /// Returns the grid as text: its format, the number of columns, the side of a cell and the
    /// origin in metres, then the cells from the lowest row on, as runs: `12f3o` are 12 free cells
    /// and three occupied ones.
    ///
    /// ```
    /// use cotama_floor::{Cell, Grid, Point};
    /// let cells = [Cell::Free, Cell::Free, Cell::Occupied, Cell::Unknown];
    /// let grid = Grid::new(2, &cells, 0.05, Point::new(-1.0, 0.5)).unwrap();
    /// assert_eq!(grid.to_text(), "cotama-grid/1 2 0.05 -1 0.5\n2f1o1u");
    /// let again = Grid::parse(&grid.to_text()).unwrap();
    /// assert_eq!((again.cells(), again.resolution()), (&cells[..], 0.05));
    /// assert!(Grid::parse("cotama-grid/1 2 0.05 -1 0.5\n2f1o").is_none()); // a row and a half
    /// ```
    pub fn to_text(&self) -> String {
        let (x, y) = (self.origin.x, self.origin.y);
        // Floats are written so that they are read back to the last bit.
        let mut text = format!("{FORMAT} {} {} {x} {y}\n", self.width, self.resolution);
        let mut rest = self.cells.as_slice();
        while let Some(first) = rest.first() {
            let count = rest.iter().take_while(|it| *it == first).count();
            let letter = LETTERS.iter().find(|it| it.1 == *first).map_or('u', |it| it.0);
            let _ = write!(text, "{count}{letter}");
            rest = rest.get(count..).unwrap_or_default();
        }
        text
    }

    /// Reads a grid from its text; `None` if it is none, or larger than a grid may be.
    pub fn parse(text: &str) -> Option<Self> {
        let (head, runs) = text.split_once('\n')?;
        let mut words = head.split(' ');
        if words.next()? != FORMAT {
            return None;
        }
        let width: usize = words.next()?.parse().ok()?;
        let mut number = || words.next()?.parse::<f64>().ok();
        let (resolution, x, y) = (number()?, number()?, number()?);
        let mut cells = Vec::new();
        let mut count = 0_usize;
        for letter in runs.chars() {
            if let Some(digit) = letter.to_digit(10) {
                count = count.checked_mul(10)?.checked_add(digit as usize)?;
                continue;
            }
            let cell = LETTERS.iter().find(|it| it.0 == letter)?.1;
            if cells.len().checked_add(count)? > super::MAX_CELLS {
                return None;
            }
            cells.resize(cells.len() + count, cell);
            count = 0;
        }
        Self::new(width, &cells, resolution, Point::new(x, y)).ok()
    }
}
