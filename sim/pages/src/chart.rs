//! Curves over a whole number: of a team's robots, for example.

use crate::axis::{Layout, NARROW, WIDE, draw_tick_labels, tick_label, ticks};
use crate::format::{grouped, trimmed};
use crate::svg::{Svg, fixed};
use cotama_core::text::markup;
use std::fmt::Write;

const TOP: f64 = 12.0;
const BOTTOM: f64 = 232.0;

/// A scale of the vertical axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    /// From zero, in thousandths.
    Linear,
    /// By the logarithm of whole numbers, from 1; what is 0 is not drawn.
    Log,
}

/// A line of a chart.
pub(crate) struct Series {
    pub(crate) name: String,
    /// The style of the line: one of `s0` to `s7`.
    pub(crate) style: usize,
    /// Points, by rising places.
    pub(crate) points: Vec<(u64, u64)>,
}

/// Curves with a common axis.
pub(crate) struct Chart<'c> {
    pub(crate) title: &'c str,
    /// Quantity on the vertical axis.
    pub(crate) unit: &'c str,
    /// Quantity on the horizontal axis.
    pub(crate) along: &'c str,
    pub(crate) scale: Scale,
    pub(crate) series: Vec<Series>,
}

/// A drawing for wide screens and one for narrow ones, under a title.
pub(crate) fn figure(title: &str, unit: &str, draw: impl Fn(Layout) -> String) -> String {
    format!(
        "<figure><figcaption><h3>{title} <span class=\"unit\">{unit}</span></h3></figcaption>\n\
         {}{}</figure>\n",
        draw(WIDE),
        draw(NARROW)
    )
}

impl Chart<'_> {
    /// The figure with the names of its lines; nothing where there are no points.
    pub(crate) fn figure(&self) -> String {
        if self.series.iter().all(|it| it.points.is_empty()) {
            return String::new();
        }
        let drawn = figure(self.title, self.unit, |layout| self.draw(layout));
        let mut keys = String::from("<p class=\"keys boxes\">");
        for it in &self.series {
            let (style, name) = (it.style, markup(&it.name));
            let _ =
                write!(keys, "<span class=\"key\"><i class=\"swatch k{style}\"></i>{name}</span> ");
        }
        drawn + &keys + "</p>\n"
    }

    fn draw(&self, layout: Layout) -> String {
        let points = || self.series.iter().flat_map(|it| &it.points);
        let most = points().map(|it| it.1).max().unwrap_or(1).max(1);
        let (first, last) = (points().map(|it| it.0).min(), points().map(|it| it.0).max());
        let (first, last) = (first.unwrap_or(0), last.unwrap_or(1));
        let marks = self.marks(most);
        let labels: Vec<String> = marks.iter().map(|it| it.1.clone()).collect();
        let layout = layout.with_room(&labels, false);
        let (left, right) = (layout.left + 6.0, layout.end() - 6.0);
        let wide = last.saturating_sub(first).max(1) as f64;
        let x = |at: u64| left + (right - left) * at.saturating_sub(first) as f64 / wide;
        let height = |it: u64| match self.scale {
            Scale::Linear => it as f64,
            Scale::Log => libm::log10(it.max(1) as f64),
        };
        let top = height(most).max(1e-9);
        let y = |it: u64| BOTTOM - (BOTTOM - TOP) * height(it) / top;
        let mut svg = Svg::new();
        for (number, (at, label)) in marks.iter().enumerate() {
            let class = if number == 0 { "zero" } else { "grid" };
            svg.line(class, [layout.left, y(*at)], [layout.end(), y(*at)]);
            svg.text("e small muted", [layout.left - 6.0, y(*at) + 4.0], label);
        }
        for it in &self.series {
            let drawn = it.points.iter().filter(|it| self.scale == Scale::Linear || it.1 > 0);
            let mut line = String::new();
            for (at, value) in drawn.clone() {
                let command = if line.is_empty() { 'M' } else { 'L' };
                let _ = write!(line, "{command}{} {}", fixed(x(*at)), fixed(y(*value)));
            }
            svg.path(&format!("line s{}", it.style), &line);
            for (at, value) in drawn {
                let title = format!("{}: {}; {}: {at}", it.name, self.value(*value), self.along);
                let (style, place) = (format!("dot d{}", it.style), [x(*at), y(*value)]);
                svg.titled(&title, |svg| svg.circle(&style, place, 3.0));
            }
        }
        let places = ticks(first.into(), last.into(), layout.x_ticks.max(7)).0;
        let mut labels = Vec::new();
        for at in places.into_iter().filter_map(|it| u64::try_from(it).ok()) {
            svg.line("axis", [x(at), BOTTOM], [x(at), BOTTOM + 4.0]);
            labels.push((x(at), grouped(at.into())));
        }
        draw_tick_labels(&mut svg, layout, labels, "", BOTTOM + 17.0);
        svg.text("e small muted", [layout.end(), BOTTOM + 32.0], self.along);
        svg.finish(layout.class, [layout.width, BOTTOM + 38.0], self.title)
    }

    /// The places of the vertical axis that have a label.
    fn marks(&self, most: u64) -> Vec<(u64, String)> {
        match self.scale {
            Scale::Linear => {
                let (places, step) = ticks(0, most.into(), 6);
                let places = places.into_iter().filter_map(|it| u64::try_from(it).ok());
                places.map(|it| (it, tick_label(it.into(), step))).collect()
            }
            Scale::Log => {
                let decades = most.ilog10();
                let step = decades / 6 + 1;
                let label = |power: u32| match power {
                    0..5 => grouped(10_u128.pow(power)),
                    _ => format!("10{}", raised(power)),
                };
                let powers = (0..=decades).step_by(step as usize);
                powers.map(|it| (10_u64.pow(it), label(it))).collect()
            }
        }
    }

    fn value(&self, value: u64) -> String {
        match self.scale {
            Scale::Linear => trimmed(value),
            Scale::Log => grouped(value.into()),
        }
    }
}

/// A number as it stands raised.
fn raised(number: u32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |it: char| it.to_digit(10).and_then(|it| DIGITS.get(it as usize)).copied();
    number.to_string().chars().filter_map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithmic_axis_names_decades_and_leaves_out_nothing_but_zeros() {
        let points = vec![(1, 0), (2, 1), (3, 1_000_000)];
        let series = vec![Series { name: "a".into(), style: 0, points }];
        let chart = Chart { title: "t", unit: "u", along: "robots", scale: Scale::Log, series };
        let labels: Vec<_> = chart.marks(1_000_000).into_iter().map(|it| it.1).collect();
        assert_eq!(labels, ["1", "100", "10\u{202f}000", "10⁶"]);
        let drawn = chart.draw(WIDE);
        assert_eq!(drawn.matches("<circle").count(), 2);
        assert!(drawn.contains("a: 1\u{202f}000\u{202f}000; robots: 3"), "{drawn}");
    }
}
