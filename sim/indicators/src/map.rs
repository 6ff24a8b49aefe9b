//! The map that a robot makes of its scans: cells with a probability to be occupied.

use cotama_floor::{Bounds, Point, Pose};

/// Side of a cell in metres.
pub const CELL_M: f64 = 0.1;
/// Half the side of the map around the robot that is looked at, in metres (Rohrmueller 2011,
/// section 4.4.2.1).
const HALF_M: f64 = 5.0;
/// The most cells.
pub const MAX_CELLS: usize = 1 << 22;
/// Probability that a cell is occupied where a ray ends, and where one passes.
const ENDS: f64 = 0.7;
const PASSES: f64 = 0.4;
/// Probabilities are kept at least this far from 0 and 1, as divergences would be infinite.
const LEAST: f64 = 1e-3;

/// Occupancy of a floor in log odds, 0 where nothing was seen.
#[derive(Clone, Debug)]
pub struct Map {
    origin: Point,
    columns: usize,
    rows: usize,
    odds: Vec<f64>,
    /// Odds at the last sample.
    before: Vec<f64>,
}

/// Entropy and information of the map around a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Around {
    /// Entropy of the cells that were seen, times the area of a cell (eq. 4.10, with the signs and
    /// the logarithm that entropy has), in nats m².
    pub entropy: f64,
    /// Information since the last sample (eqs. 4.12 to 4.14), per cell that was seen.
    pub information: f64,
}

impl Map {
    /// A map of a floor where nothing was seen; `None` where that takes too many cells.
    pub fn new(bounds: &Bounds) -> Option<Self> {
        let cells = |it: f64| (it / CELL_M).ceil().max(1.0) as usize;
        let (columns, rows) = (cells(bounds.width()), cells(bounds.height()));
        let count = columns.checked_mul(rows).filter(|it| *it <= MAX_CELLS)?;
        let odds = vec![0.0; count];
        Some(Self { origin: bounds.least, columns, rows, before: odds.clone(), odds })
    }

    fn cell(&self, at: Point) -> Option<usize> {
        let it = (at - self.origin) / CELL_M;
        let is_in = it.x >= 0.0 && it.y >= 0.0;
        let (x, y) = (it.x as usize, it.y as usize);
        (is_in && x < self.columns && y < self.rows).then(|| y * self.columns + x)
    }

    /// Takes a scan from a believed pose: rays spread evenly over the view from the right to the
    /// left; those without end pass their whole range.
    pub fn take(&mut self, pose: &Pose, view_rad: f64, range_m: f64, ranges: &[f64]) {
        let step = view_rad / ranges.len().saturating_sub(1).max(1) as f64;
        let most = libm::log((1.0 - LEAST) / LEAST);
        for (at, range) in ranges.iter().enumerate() {
            let (sin, cos) = libm::sincos(at as f64 * step - view_rad / 2.0);
            let along = pose.rotation * cotama_floor::Vector::new(cos, sin);
            let from = Point::from(pose.translation.vector);
            let length = range.min(range_m);
            let mut add = |it: Option<usize>, p: f64| {
                if let Some(odds) = it.and_then(|it| self.odds.get_mut(it)) {
                    *odds = (*odds + libm::log(p / (1.0 - p))).clamp(-most, most);
                }
            };
            let mut last = None;
            let end = range.is_finite().then(|| self_cell(self.origin, from + along * length));
            for step in 0..(length / CELL_M) as usize {
                let at = from + along * ((step as f64 + 0.5) * CELL_M);
                let it = self_cell(self.origin, at);
                if Some(it) != last && Some(it) != end {
                    let cell = numbered(it, self.columns, self.rows);
                    add(cell, PASSES);
                    last = Some(it);
                }
            }
            if let Some(end) = end {
                add(numbered(end, self.columns, self.rows), ENDS);
            }
        }
    }

    /// Sums over 10 m by 10 m around a place, and begins to count information anew.
    pub fn around(&mut self, at: Point) -> Around {
        let mut found = Around::default();
        let mut seen = 0_u32;
        let side = (2.0 * HALF_M / CELL_M) as usize;
        for row in 0..side {
            for column in 0..side {
                let off = [column, row].map(|it| (it as f64 + 0.5) * CELL_M - HALF_M);
                let Some(cell) = self.cell(at + cotama_floor::Vector::from(off)) else { continue };
                let (now, before) = (self.odds[cell], self.before[cell]);
                if now == 0.0 && before == 0.0 {
                    continue;
                }
                seen += 1;
                let p = probability(now);
                found.entropy -= p * libm::log(p) + (1.0 - p) * libm::log(1.0 - p);
                if now.to_bits() != before.to_bits() {
                    let q = probability(before);
                    // (q ln(q/p) + p ln(p/q)) / 2.
                    found.information += (q - p) * libm::log(q / p) / 2.0;
                }
            }
        }
        found.entropy *= CELL_M * CELL_M;
        found.information /= f64::from(seen.max(1));
        self.before.copy_from_slice(&self.odds);
        found
    }
}

fn self_cell(origin: Point, at: Point) -> [i64; 2] {
    let it = (at - origin) / CELL_M;
    [it.x.floor() as i64, it.y.floor() as i64]
}

fn numbered([x, y]: [i64; 2], columns: usize, rows: usize) -> Option<usize> {
    let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
    (x < columns && y < rows).then(|| y * columns + x)
}

fn probability(odds: f64) -> f64 {
    (1.0 / (1.0 + libm::exp(-odds))).clamp(LEAST, 1.0 - LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> Map {
        Map::new(&Bounds { least: Point::origin(), most: Point::new(20.0, 20.0) }).unwrap()
    }

    #[test]
    fn a_cell_that_was_seen_often_adds_less_than_one_seen_once() {
        let mut map = map();
        let at = Point::new(10.0, 10.0);
        assert_eq!(map.around(at), Around::default());
        let pose = Pose::new(at.coords, 0.0);
        map.take(&pose, 0.0, 8.0, &[3.0]);
        let once = map.around(at);
        assert!(once.entropy > 0.0 && once.information > 0.0);
        // 30 cells that a ray passes, and the one where it ends.
        let h = |p: f64| -(p * libm::log(p) + (1.0 - p) * libm::log(1.0 - p)) * 0.01;
        assert!((once.entropy - 30.0 * h(0.4) - h(0.7)).abs() < 1e-9, "{once:?}");
        (0..9).for_each(|_| map.take(&pose, 0.0, 8.0, &[3.0]));
        assert!(map.around(at).entropy < once.entropy / 2.0);
        assert_eq!(map.around(at).information, 0.0); // nothing new since
    }

    #[test]
    fn a_map_too_large_is_none() {
        let most = Point::new(500.0, 500.0);
        assert!(Map::new(&Bounds { least: Point::origin(), most }).is_none());
    }
}
