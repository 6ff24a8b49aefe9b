//! The stretches of each cell of a uniform grid, in one list.

use super::Segment;
use crate::geometry::{Bounds, Point, Vector, crosses_box, distance_to};
use crate::octants::Octants;
use crate::surface::Sense;

/// About so many cells.
const CELLS: f64 = 65_536.0;
/// The smallest cell, in metres.
const SMALLEST: f64 = 0.05;
/// A stretch belongs to a cell that it misses by so much, in metres: rays are rounded by less.
const MARGIN: f64 = 1e-6;
/// The most entries of cells: of 40 bytes each.
pub(super) const MOST: usize = 1 << 21;

/// Returns the side of a cell, and the columns and rows with one around.
pub(super) fn cells(bounds: &Bounds) -> (f64, usize, usize) {
    let (width, height) = (bounds.width(), bounds.height());
    let cell = (width * height / CELLS).sqrt().max(SMALLEST).max(width.max(height) / 16_384.0);
    let count = |size: f64| (size / cell) as usize + 3;
    (cell, count(width), count(height))
}

/// Returns the least and the largest x of a stretch between two heights, about; of one that is
/// nearly level those of all of it.
fn across(segment: &Segment, low: f64, high: f64, cell: f64) -> (f64, f64) {
    let Segment { from, to, .. } = segment;
    let along = to - from;
    let at = |y: f64| from.x + along.x * ((y - from.y) / along.y).clamp(0.0, 1.0);
    let level = along.y.abs() <= 2.0 * cell;
    let (one, two) = if level { (from.x, to.x) } else { (at(low), at(high)) };
    (one.min(two), one.max(two))
}

#[derive(Clone, Debug)]
pub(super) struct Cover {
    columns: usize,
    rows: usize,
    cell: f64,
    /// Begin of the list of each cell; one more than cells.
    starts: Vec<u32>,
    /// Each stretch once for each of its cells, cell by cell.
    items: Vec<Segment>,
    segments: Vec<Segment>,
}

impl Cover {
    /// Makes the lists; `None` if they have more than [`MOST`] entries together.
    pub(super) fn new(
        segments: &[Segment],
        origin: Point,
        cell: f64,
        columns: usize,
        rows: usize,
    ) -> Option<Self> {
        let mut touched: Vec<(u32, u32)> = Vec::new();
        let margin = Vector::repeat(MARGIN);
        for (index, segment) in segments.iter().enumerate() {
            let low = (segment.from.inf(&segment.to) - margin - origin) / cell;
            let high = (segment.from.sup(&segment.to) + margin - origin) / cell;
            for y in low.y as usize..=(high.y as usize).min(rows - 1) {
                let floor = origin.y + y as f64 * cell - MARGIN;
                let (first, last) = across(segment, floor, floor + cell + 2.0 * MARGIN, cell);
                let column = |x: f64| ((x - origin.x) / cell) as usize;
                // One more on either side, as the ends are rounded.
                let xs = column(first).saturating_sub(1)..=(column(last) + 1).min(columns - 1);
                for x in xs {
                    let least = origin + Vector::new(x as f64, y as f64) * cell - margin;
                    let most = least + Vector::repeat(cell) + margin * 2.0;
                    let it = Bounds { least, most };
                    if crosses_box([segment.from, segment.to], &it) {
                        touched.push(((y * columns + x) as u32, index as u32));
                    }
                }
            }
            if touched.len() > MOST {
                return None;
            }
        }
        touched.sort_unstable();
        let mut starts = vec![0_u32; columns * rows + 1];
        for (cell, _) in &touched {
            starts[*cell as usize + 1] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let items = touched.iter().filter_map(|it| segments.get(it.1 as usize).copied());
        let items = items.collect();
        Some(Self { columns, rows, cell, starts, items, segments: segments.to_vec() })
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The stretches of a cell, by column and row.
    #[inline]
    pub(super) fn at(&self, x: usize, y: usize) -> &[Segment] {
        self.of(y * self.columns + x)
    }

    /// The stretches of a cell, by its number: row by row from the lowest.
    #[inline]
    pub(super) fn of(&self, cell: usize) -> &[Segment] {
        let start = |at: usize| self.starts.get(at).copied().unwrap_or(0) as usize;
        let (from, to) = (start(cell), start(cell + 1));
        self.items.get(from..to).unwrap_or_default()
    }

    /// The lists of the cells of a box, given in cells.
    pub(super) fn cells_between(
        &self,
        low: Point,
        high: Point,
    ) -> impl Iterator<Item = &[Segment]> {
        let xs = low.x as usize..=(high.x as usize).min(self.columns - 1);
        let ys = low.y as usize..=(high.y as usize).min(self.rows - 1);
        ys.flat_map(move |y| xs.clone().map(move |x| self.at(x, y)))
    }

    /// Returns the distance to the nearest stretch that a sense notices, and at most `most`, in
    /// metres: ring after ring of cells, from the first that is not known to be empty.
    pub(super) fn nearest(
        &self,
        octants: &Octants,
        in_cells: Point,
        at: Point,
        most: f64,
        sense: Sense,
    ) -> f64 {
        let limit = |it: f64, size: usize| (it.max(0.0) as usize).min(size - 1).cast_signed();
        let (x, y) = (limit(in_cells.x, self.columns), limit(in_cells.y, self.rows));
        let mut best = most.max(0.0);
        let mut look = |x: isize, y: isize| {
            let inside = (0..self.columns.cast_signed()).contains(&x);
            if inside && (0..self.rows.cast_signed()).contains(&y) {
                for it in self.at(x as usize, y as usize) {
                    if it.kind.is_seen_by(sense) {
                        best = best.min(distance_to(it.from, it.to, at));
                    }
                }
            }
            best
        };
        let first = octants.around(x as usize, y as usize).saturating_sub(1).cast_signed();
        for ring in first..self.columns.max(self.rows).cast_signed() {
            let mut now = look(x - ring, y - ring);
            for step in -ring..=ring {
                now = look(x + step, y - ring).min(look(x + step, y + ring));
            }
            for step in 1 - ring..ring {
                now = look(x - ring, y + step).min(look(x + ring, y + step));
            }
            // All in the next rings is at least so far away.
            if now <= ring as f64 * self.cell {
                break;
            }
        }
        best
    }
}
