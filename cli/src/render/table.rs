//! Tables that are wrapped in blocks of columns where the screen is narrower than they are.

use super::style::{FAINT, PLAIN, Style};
use std::fmt::Write;

/// A cell.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    text: String,
    style: Style,
}

impl Cell {
    /// A cell with a style.
    pub(crate) fn new(text: impl Into<String>, style: Style) -> Self {
        Self { text: text.into(), style }
    }

    /// A cell without a style.
    pub(crate) fn plain(text: impl Into<String>) -> Self {
        Self::new(text, PLAIN)
    }

    /// A cell that explains.
    pub(crate) fn faint(text: impl Into<String>) -> Self {
        Self::new(text, FAINT)
    }

    fn width(&self) -> usize {
        self.text.chars().count()
    }

    fn write(&self, text: &mut String, width: usize, left: bool) {
        let Self { text: own, style } = self;
        let space = " ".repeat(width.saturating_sub(self.width()));
        let _ = if left {
            write!(text, "{style}{own}{style:#}{space}")
        } else {
            write!(text, "{space}{style}{own}{style:#}")
        };
    }
}

/// How much stands left of a table, and between its columns.
const INDENT: &str = "  ";
const GAP: &str = "  ";

/// A table: rows of cells. The first column has the names of the rows and is repeated in each
/// block.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<Cell>>,
    /// The rows before this one are the head: they do not make a block worth printing.
    head: usize,
    /// The columns, from the first on, that are written to the left.
    left: Vec<usize>,
}

impl Table {
    /// A table with these rows as head.
    pub(crate) fn new(head: Vec<Vec<Cell>>) -> Self {
        Self { head: head.len(), rows: head, left: vec![0] }
    }

    /// Also writes this column to the left.
    pub(crate) fn left(mut self, column: usize) -> Self {
        self.left.push(column);
        self
    }

    /// One more row; it may be shorter than others.
    pub(crate) fn row(&mut self, cells: Vec<Cell>) {
        self.rows.push(cells);
    }

    /// How many rows it has without its head.
    pub(crate) fn len(&self) -> usize {
        self.rows.len() - self.head
    }

    /// The table, in blocks no wider than `width` as far as that can be, with a line break at the
    /// end of each line.
    pub(crate) fn render(&self, width: usize) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let cell = |row: usize, column: usize| {
            self.rows[row].get(column).filter(|cell| !cell.text.is_empty())
        };
        let widths: Vec<usize> = (0..columns)
            .map(|column| {
                (0..self.rows.len())
                    .filter_map(|row| cell(row, column))
                    .map(Cell::width)
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let name = widths.first().copied().unwrap_or(0);
        let mut text = String::new();
        let mut start = 1;
        while start < columns {
            let mut end = start;
            let mut used = INDENT.len() + name;
            while end < columns && (end == start || used + GAP.len() + widths[end] <= width) {
                used += GAP.len() + widths[end];
                end += 1;
            }
            if !text.is_empty() {
                text.push('\n');
            }
            for row in 0..self.rows.len() {
                if row >= self.head && (start..end).all(|column| cell(row, column).is_none()) {
                    continue;
                }
                let mut line = INDENT.to_owned();
                let empty = Cell::plain("");
                for column in std::iter::once(0).chain(start..end) {
                    if column > 0 {
                        line += GAP;
                    }
                    let left = self.left.contains(&column);
                    cell(row, column).unwrap_or(&empty).write(&mut line, widths[column], left);
                }
                text += line.trim_end();
                text.push('\n');
            }
            start = end;
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &[&str]) -> Vec<Cell> {
        cells.iter().map(|&text| Cell::plain(text)).collect()
    }

    #[test]
    fn a_table_that_is_too_wide_is_wrapped_in_blocks() {
        let mut table = Table::new(vec![row(&["", "A1", "A2", "A3"])]);
        table.row(row(&["RAS0", "M5 L2", "M5 L2", "D2"]));
        table.row(row(&["RAS1", "", "", "D1"]));
        assert_eq!(
            table.render(80),
            "           A1     A2  A3\n  RAS0  M5 L2  M5 L2  D2\n  RAS1                D1\n"
        );
        assert_eq!(
            table.render(20),
            "           A1     A2\n  RAS0  M5 L2  M5 L2\n\n        A3\n  RAS0  D2\n  RAS1  D1\n"
        );
    }
}
