//! The nearest cell of a kind, exactly: each cell knows how far up or down in its column the next
//! one is, so that a question looks at one row only.

use crate::geometry::Point;

/// The largest distance that is noted, in cells.
const MOST: u16 = (1 << 14) - 1;
/// Flags: the nearest is above, or below.
const ABOVE: u16 = 1 << 14;
const BELOW: u16 = 1 << 15;

#[derive(Clone, Debug)]
pub(super) struct Columns {
    width: usize,
    height: usize,
    /// The distance in rows, and the flags; without one of them there is none near.
    nearest: Vec<u16>,
}

impl Columns {
    pub(super) fn of(width: usize, height: usize, is_one: impl Fn(usize, usize) -> bool) -> Self {
        let mut nearest = vec![MOST; width * height];
        for x in 0..width {
            let mut last: Option<usize> = None;
            for y in 0..height {
                last = if is_one(x, y) { Some(y) } else { last };
                if let Some(below) = last.map(|it| y - it).filter(|it| *it < MOST as usize) {
                    nearest[y * width + x] = below as u16 | BELOW;
                }
            }
            last = None;
            for y in (0..height).rev() {
                last = if is_one(x, y) { Some(y) } else { last };
                let Some(above) = last.map(|it| it - y) else { continue };
                let one = &mut nearest[y * width + x];
                let below = (*one & MOST) as usize;
                if above < below {
                    *one = above as u16 | ABOVE;
                } else if above == below && above < MOST as usize {
                    *one |= ABOVE;
                }
            }
        }
        Self { width, height, nearest }
    }

    /// Returns the distance from a point to the nearest such cell, in cells, and at most `most`.
    pub(super) fn nearest(&self, at: Point, most: f64) -> f64 {
        // From outside the columns of the nearest row are asked.
        let limit = |it: f64, size: usize| (it.max(0.0) as usize).min(size - 1);
        let (column, row) = (limit(at.x, self.width), limit(at.y, self.height));
        let row_at = row * self.width;
        let Some(cells) = self.nearest.get(row_at..row_at + self.width) else { return most };
        let up = row as f64 - at.y;
        let most = most.max(0.0);
        let mut square = most * most;
        let mut look = |x: usize, aside: f64| {
            let it = cells.get(x).copied().unwrap_or(MOST);
            let rows = f64::from(it & MOST);
            let above = if it & ABOVE == 0 { f64::INFINITY } else { rows + up };
            let below = if it & BELOW == 0 { f64::INFINITY } else { rows - up - 1.0 };
            // Both sides of the own row count: the point may be outside.
            let own = up.max(-up - 1.0);
            let height = if it & MOST == 0 { own } else { above.min(below) }.max(0.0);
            square = square.min(aside * aside + height * height);
            square
        };
        let own = (column as f64 - at.x).max(at.x - column as f64 - 1.0).max(0.0);
        let mut now = look(column, own);
        for step in 1..self.width {
            let right = (column + step) as f64 - at.x;
            let left = at.x - column as f64 + step as f64 - 1.0;
            let nearer = right.min(left).max(0.0);
            if nearer * nearer >= now || (column + step >= self.width && step > column) {
                break;
            }
            now = look(column + step, right.max(0.0));
            if let Some(x) = column.checked_sub(step) {
                now = look(x, left.max(0.0));
            }
        }
        most.min(now.sqrt())
    }
}
