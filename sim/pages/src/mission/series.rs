//! Values along the run as paths: no more points than a screen can show.

use crate::svg::fixed;
use std::fmt::Write;

/// A point of a series: where it is drawn along the axis, and its value in thousandths.
pub(super) type Point = (f64, i64);

/// At most four points for each column of a screen: the first, the lowest, the highest and the last
/// one.
///
/// The order of the points is kept, so that what is drawn covers the same pixels as all points
/// would.
pub(super) fn thinned(points: &[Point]) -> Vec<Point> {
    let mut kept = Vec::new();
    let mut start = 0;
    while let Some(&(x, _)) = points.get(start) {
        let column = x.round();
        let length =
            points[start..].iter().take_while(|point| point.0.round() <= column).count().max(1);
        let piece = &points[start..start + length];
        let places = 0..piece.len();
        let lowest = places.clone().min_by_key(|&place| piece[place].1).unwrap_or(0);
        let highest = places.max_by_key(|&place| piece[place].1).unwrap_or(0);
        let mut places = [0, lowest, highest, piece.len() - 1];
        places.sort_unstable();
        for (index, &place) in places.iter().enumerate() {
            if index == 0 || places[index - 1] != place {
                kept.push(piece[place]);
            }
        }
        start += length;
    }
    kept
}

/// From values to heights on the page.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    /// The lowest value.
    pub(super) low: i128,
    /// The highest value, above the lowest.
    pub(super) high: i128,
    /// The highest value.
    pub(super) top: f64,
    /// The lowest value.
    pub(super) bottom: f64,
}

impl Scale {
    pub(super) fn y(&self, value: i128) -> f64 {
        let share = (value - self.low) as f64 / (self.high - self.low).max(1) as f64;
        self.bottom - share.clamp(0.0, 1.0) * (self.bottom - self.top)
    }
}

/// Values that hold until the next one.
pub(super) fn steps(points: &[Point], scale: Scale) -> String {
    let mut path = String::new();
    let mut last = String::new();
    let Some(&(first_x, first_value)) = points.first() else { return path };
    let y = fixed(scale.y(first_value.into()));
    let _ = write!(path, "M{} {y}", fixed(first_x));
    let mut drawn = fixed(first_x);
    last.push_str(&y);
    for &(x, value) in &points[1..] {
        let (x, y) = (fixed(x), fixed(scale.y(value.into())));
        if y != last {
            if x != drawn {
                let _ = write!(path, "H{x}");
                drawn = x;
            }
            let _ = write!(path, "V{y}");
            last = y;
        }
    }
    if let Some(&(x, _)) = points.last()
        && fixed(x) != drawn
    {
        let _ = write!(path, "H{}", fixed(x));
    }
    path
}

/// Values that change steadily to the next one.
pub(super) fn line(points: &[Point], scale: Scale) -> String {
    let mut path = String::new();
    let mut last = String::new();
    for &(x, value) in points {
        let point = format!("{} {}", fixed(x), fixed(scale.y(value.into())));
        if point != last {
            path.push(if path.is_empty() { 'M' } else { 'L' });
            path.push_str(&point);
            last = point;
        }
    }
    path
}

/// The area between zero and the values below it.
pub(super) fn below_zero(points: &[Point], scale: Scale) -> String {
    let zero = fixed(scale.y(0));
    let mut path = String::new();
    let mut inside = false;
    for (index, &(x, value)) in points.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| points[before]);
        let crossing = before.map_or(x, |(x_before, value_before)| {
            let whole = (i128::from(value) - i128::from(value_before)) as f64;
            if whole == 0.0 {
                x
            } else {
                x_before + (x - x_before) * (-(value_before as f64) / whole).clamp(0.0, 1.0)
            }
        });
        if value < 0 {
            if !inside {
                let _ = write!(path, "M{} {zero}", fixed(crossing));
            }
            let _ = write!(path, "L{} {}", fixed(x), fixed(scale.y(value.into())));
        } else if inside {
            let _ = write!(path, "L{} {zero}Z", fixed(crossing));
        }
        inside = value < 0;
    }
    if let (true, Some(&(x, _))) = (inside, points.last()) {
        let _ = write!(path, "L{} {zero}Z", fixed(x));
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALE: Scale = Scale { low: -10, high: 10, top: 0.0, bottom: 20.0 };

    #[test]
    fn a_column_keeps_its_first_lowest_highest_and_last_point() {
        let points: Vec<Point> = [5, 9, 3, 4, 4].iter().map(|&value| (1.0, value)).collect();
        let kept: Vec<i64> = thinned(&points).into_iter().map(|point| point.1).collect();
        assert_eq!(kept, [5, 9, 3, 4]);
        let many: Vec<Point> =
            (0..100_000).map(|it| (f64::from(it) / 1000.0, i64::from(it % 7))).collect();
        assert!(thinned(&many).len() <= 4 * 101);
    }

    #[test]
    fn values_that_hold_are_drawn_as_steps_and_equal_ones_once() {
        assert_eq!(steps(&[(0.0, 0), (1.0, 0), (2.0, 5), (3.0, 5)], SCALE), "M0 10H2V5H3");
        assert_eq!(steps(&[], SCALE), "");
    }

    #[test]
    fn the_area_below_zero_begins_and_ends_where_the_line_crosses_it() {
        assert_eq!(below_zero(&[(0.0, 10), (2.0, -10), (4.0, 10)], SCALE), "M1 10L2 20L3 10Z");
        assert_eq!(below_zero(&[(0.0, -5), (2.0, -5)], SCALE), "M0 10L0 15L2 15L2 10Z");
        assert_eq!(line(&[(0.0, 10), (2.0, -10)], SCALE), "M0 0L2 20");
    }
}
