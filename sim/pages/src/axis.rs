//! Ticks at round numbers, and the widths that drawings are made for.

use crate::format::milli;
use crate::svg::{SMALL, Svg, text_width};

/// The numbers from `low` to `high` that are multiples of 1, 2 or 5 times a power of ten: at most
/// `most` of them, as many as can be. Also the step between them.
pub(crate) fn ticks(low: i128, high: i128, most: i128) -> (Vec<i128>, i128) {
    let mut step: i128 = 1;
    let mut factors = [2, 5, 10].iter().cycle();
    let mut power: i128 = 1;
    let count = |step: i128| {
        high.div_euclid(step) - low.div_euclid(step) + i128::from(low.rem_euclid(step) == 0)
    };
    while count(step) > most.max(1) && power < 1_000_000_000_000_000_000_000 {
        let factor = *factors.next().unwrap_or(&10);
        step = power * factor;
        if factor == 10 {
            power = step;
        }
    }
    let first = low + (-low).rem_euclid(step);
    let numbers = (0..most.max(1)).map(|index| first + index * step);
    (numbers.take_while(|&number| number <= high).collect(), step)
}

/// How a tick is written: thousandths with the decimals that the step needs.
pub(crate) fn tick_label(value: i128, step: i128) -> String {
    let decimals = match step {
        1000.. => 0,
        100.. => 1,
        10.. => 2,
        _ => 3,
    };
    milli(value, decimals)
}

/// The labels of ticks below an axis: the last one with the unit, and of the others those that have
/// room.
pub(crate) fn draw_tick_labels(
    svg: &mut Svg,
    layout: Layout,
    labels: Vec<(f64, String)>,
    unit: &str,
    y: f64,
) {
    let (mut free, mut unit) = (f64::MAX, unit);
    for (x, label) in labels.into_iter().rev() {
        let label = format!("{label}{unit}");
        let half = text_width(&label, SMALL) / 2.0;
        let middle = layout.within(x, half);
        if middle + half < free {
            svg.text("m small muted", [middle, y], &label);
            (free, unit) = (middle - half - 3.0, "");
        }
    }
}

/// A width that drawings are made for. Pages show the one that suits the screen.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) class: &'static str,
    pub(crate) width: f64,
    pub(crate) left: f64,
    pub(crate) right: f64,
    /// The narrowest activity in a stop.
    pub(crate) stop_width: f64,
    pub(crate) x_ticks: i128,
    /// Whether rows have their names beside them, not above.
    pub(crate) names_beside: bool,
}

/// For screens and paper.
pub(crate) const WIDE: Layout = Layout {
    class: "wide",
    width: 960.0,
    left: 78.0,
    right: 62.0,
    stop_width: 21.0,
    x_ticks: 11,
    names_beside: true,
};

/// For phones.
pub(crate) const NARROW: Layout = Layout {
    class: "narrow",
    width: 360.0,
    left: 38.0,
    right: 8.0,
    stop_width: 9.0,
    x_ticks: 5,
    names_beside: false,
};

impl Layout {
    /// The right end of the axis.
    pub(crate) fn end(&self) -> f64 {
        self.width - self.right
    }

    /// The same with room for the widest of these labels of a vertical axis on its left, or on its
    /// right, up to a third of the width.
    pub(crate) fn with_room(self, labels: &[String], on_the_right: bool) -> Self {
        let widths = labels.iter().map(|it| text_width(it, SMALL));
        let room = widths.fold(0.0, f64::max).min(self.width / 3.0) + 10.0;
        if on_the_right {
            Self { right: self.right.max(room), ..self }
        } else {
            Self { left: self.left.max(room), ..self }
        }
    }

    /// A place for the middle of a text, moved so that the text stands within the drawing.
    pub(crate) fn within(&self, middle: f64, half: f64) -> f64 {
        middle.min(self.width - half - 1.0).max(half + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_no_more_than_asked() {
        assert_eq!(ticks(0, 187_000, 11), ((0..10).map(|it| it * 20_000).collect(), 20_000));
        assert_eq!(ticks(-86, 240, 5), (vec![0, 100, 200], 100));
        assert_eq!(ticks(0, 0, 5), (vec![0], 1));
        assert_eq!(ticks(-7, 7, 1), (vec![0], 10));
        assert!(ticks(i128::from(i64::MIN), i128::from(i64::MAX), 6).0.len() <= 6);
    }

    #[test]
    fn ticks_have_the_decimals_of_their_step() {
        assert_eq!(tick_label(20_000, 20_000), "20");
        assert_eq!(tick_label(100, 100), "0.1");
        assert_eq!(tick_label(-50, 50), "\u{2212}0.05");
    }
}
