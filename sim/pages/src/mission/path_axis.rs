//! The axis along the path that all drawings of a mission share.

use super::view::{Stop, View};
use crate::axis::{Layout, draw_tick_labels, tick_label, ticks};
use crate::format::seconds;
use crate::svg::{SMALL, Svg, text_width};

/// A stop on the axis, or a wait on the way.
///
/// *Invariant:* of the bands of an axis, each lies behind the one before.
struct Band {
    x_mm: u64,
    start_us: u64,
    end_us: u64,
    left: f64,
    width: f64,
    /// The widths of all stops up to this one.
    stopped: f64,
    reached: bool,
    /// Whether activities are done there.
    has_activities: bool,
}

/// The axis along the path: distance, and at each stop and each wait a piece of time in between.
///
/// The pieces of time get the share of the width that they have of the time of the run, but at most
/// six tenths when there is a path to show, and never less than so much for an activity.
pub(super) struct Axis {
    left: f64,
    per_mm: f64,
    bands: Vec<Band>,
    length_mm: u64,
    layout: Layout,
}

impl Axis {
    pub(super) fn new(view: &View<'_>, layout: Layout) -> Self {
        let whole = layout.end() - layout.left;
        let total_us =
            view.last().1.max(view.activities.iter().map(|step| step.end_us).max().unwrap_or(0));
        let total_us = total_us.max(1) as f64;
        let duration = |start: u64, end: u64| end.saturating_sub(start) as f64;
        let wish = |stop: &Stop| {
            let share = duration(stop.start_us, stop.end_us) / total_us * whole;
            share.max(stop.count as f64 * layout.stop_width)
        };
        let wishes: f64 = view.stops.iter().map(wish).sum();
        let most = if view.length_mm == 0 { whole } else { 0.6 * whole };
        let shrink = if wishes > most || (view.length_mm == 0 && wishes > 0.0) {
            most / wishes
        } else {
            1.0
        };
        let per_mm = (whole - wishes * shrink).max(0.0) / (view.length_mm.max(1) as f64);
        let mut bands = Vec::new();
        let mut before = 0.0;
        for stop in &view.stops {
            let width = wish(stop) * shrink;
            let left = layout.left + stop.x_mm as f64 * per_mm + before;
            let &Stop { x_mm, start_us, end_us, reached, count } = stop;
            before += width;
            let has_activities = count > 0;
            bands.push(Band {
                x_mm,
                start_us,
                end_us,
                left,
                width,
                stopped: before,
                reached,
                has_activities,
            });
        }
        Self { left: layout.left, per_mm, bands, length_mm: view.length_mm, layout }
    }

    /// Returns the position of a place on the axis, before the band that stops there, and that
    /// band.
    fn find(&self, x_mm: u64) -> (f64, Option<&Band>) {
        let next = self.bands.partition_point(|band| band.x_mm < x_mm);
        let stopped = next.checked_sub(1).map_or(0.0, |last| self.bands[last].stopped);
        let here = self.bands.get(next).filter(|band| band.x_mm == x_mm);
        (self.left + x_mm as f64 * self.per_mm + stopped, here)
    }

    /// Returns the position of a place on the axis, before the band that stops there.
    pub(super) fn before(&self, x_mm: u64) -> f64 {
        self.find(x_mm).0
    }

    /// Returns the position of a place on the axis, after the band that stops there.
    pub(super) fn after(&self, x_mm: u64) -> f64 {
        let (before, band) = self.find(x_mm);
        before + band.map_or(0.0, |band| band.width)
    }

    /// Returns the position of a place on the axis at a time.
    pub(super) fn at(&self, x_mm: u64, t_us: u64) -> f64 {
        let (before, band) = self.find(x_mm);
        let within = band.map_or(0.0, |band| {
            let whole = band.end_us.saturating_sub(band.start_us);
            let passed = t_us.saturating_sub(band.start_us).min(whole);
            passed as f64 / whole.max(1) as f64 * band.width
        });
        before + within
    }

    /// Stops as bands from `top` to `bottom`.
    pub(super) fn draw_stops(&self, svg: &mut Svg, top: f64, bottom: f64) {
        for band in &self.bands {
            svg.ground("stop", [band.left, top], [band.width, bottom - top]);
        }
    }

    /// The durations of the stops, written with this base line.
    pub(super) fn draw_stop_labels(&self, svg: &mut Svg, y: f64) {
        let mut free = f64::MIN;
        for band in self.bands.iter().filter(|it| it.has_activities) {
            let duration =
                seconds(band.end_us.saturating_sub(band.start_us).saturating_add(500) / 1000);
            let planned = if band.reached { "" } else { " planned" };
            let label = format!("stop {duration}{planned}");
            let half = text_width(&label, SMALL) / 2.0;
            let middle = self.layout.within(band.left + band.width / 2.0, half);
            if middle - half > free {
                svg.text("m small muted", [middle, y], &label);
                free = middle + half + 6.0;
            }
        }
    }

    /// Says what the axis is made of, where it is not of metres alone.
    pub(super) fn draw_caption(&self, svg: &mut Svg, y: f64) {
        if !self.bands.is_empty() {
            let words = "metres of path; shaded: seconds at one place";
            let half = text_width(words, SMALL) / 2.0;
            let middle = f64::midpoint(self.left, self.layout.end());
            svg.text("m small muted", [self.layout.within(middle, half), y], words);
        }
    }

    /// The axis line and its ticks, with grid lines up to `top`.
    pub(super) fn draw(&self, svg: &mut Svg, top: f64, bottom: f64) {
        let (numbers, step) = ticks(0, i128::from(self.length_mm), self.layout.x_ticks);
        svg.line("axis", [self.left, bottom], [self.layout.end(), bottom]);
        let mut labels = Vec::new();
        for number in numbers {
            let x = self.before(u64::try_from(number).unwrap_or(0));
            if number > 0 && top < bottom {
                svg.line("grid", [x, top], [x, bottom]);
            }
            svg.line("axis", [x, bottom], [x, bottom + 4.0]);
            labels.push((x, tick_label(number, step)));
        }
        draw_tick_labels(svg, self.layout, labels, " m", bottom + 16.0);
    }
}
