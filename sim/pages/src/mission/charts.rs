//! Speed, power and margins along the run, over the axis of the strip.

use super::events::power_error;
use super::path_axis::Axis;
use super::series::{Point, Scale, below_zero, line, steps, thinned};
use super::strip::{draw_end, draw_pins};
use super::view::View;
use crate::axis::{Layout, NARROW, WIDE, tick_label, ticks};
use crate::format::milli;
use crate::svg::{SMALL, Svg, text_box, text_width};
use cotama_core::text::markup;
use cotama_sim::trace::{Margins, Record};
use std::fmt::Write;

/// A value somewhere and at some time: place in mm, time in µs, value in thousandths.
type Measured = (u64, u64, i64);

/// One drawing.
struct Chart<'c> {
    title: &'c str,
    unit: &'c str,
    note: String,
    height: f64,
    /// Values that hold until the next one, with the class of their line.
    held: Vec<(&'c str, Vec<Measured>)>,
    /// A margin: values that change steadily, with zero as the line not to cross.
    margin: Vec<Measured>,
    /// The margins before and after each replan, with where and when.
    replans: Vec<(u64, u64, i64, i64)>,
}

const KEY_PLANNED: &str = "<span class=\"key\"><i class=\"swatch planned\"></i>planned</span> \
                           <span class=\"key\"><i class=\"swatch real\"></i>real</span>";

/// The height of what stands above a chart.
const TOP: f64 = 20.0;

/// The wide and the narrow layout of a run: every drawing over the axis of its path has the same,
/// with room for the numbers of all charts.
pub(super) fn layouts(view: &View<'_>) -> [Layout; 2] {
    let labels: Vec<String> = charts(view).iter().flat_map(Chart::numbers).collect();
    [WIDE, NARROW].map(|it| it.with_room(&labels, false))
}

impl Chart<'_> {
    /// Returns what is written beside the vertical axis.
    fn numbers(&self) -> Vec<String> {
        let scale = scale(self, TOP, TOP + self.height);
        let (numbers, step) = ticks(scale.low, scale.high, (self.height / 28.0) as i128);
        numbers.into_iter().map(|it| tick_label(it, step)).collect()
    }
}

/// Says how far the real power was from the model, zone by zone; empty where it was not.
fn power_note(view: &View<'_>) -> String {
    let errors: Vec<String> = view.power_errors().iter().map(power_error).collect();
    if errors.is_empty() {
        return String::new();
    }
    let shown: Vec<&str> = errors.iter().take(6).map(String::as_str).collect();
    let more = if errors.len() > 6 { ", …" } else { "" };
    format!(
        " · real against the model: {}{more} (<code>power_error_permille</code>)",
        markup(&shown.join(", "))
    )
}

/// All four charts.
fn charts<'v>(view: &'v View<'_>) -> [Chart<'v>; 4] {
    let sampled = |value: fn(&cotama_sim::trace::Sample) -> u64| -> Vec<Measured> {
        let samples = view.samples.iter();
        samples.map(|it| (it.x_mm, it.t_us, i64::try_from(value(it)).unwrap_or(i64::MAX))).collect()
    };
    let empty = || Chart {
        title: "",
        unit: "",
        note: String::new(),
        height: 0.0,
        held: Vec::new(),
        margin: Vec::new(),
        replans: Vec::new(),
    };
    let margin = |title, unit, value: fn(&Margins) -> i64| Chart {
        title,
        unit,
        note: "limit, less used, less planned rest".into(),
        height: 150.0,
        margin: margins(view, value),
        replans: replans(view, value),
        ..empty()
    };
    let powers = view.samples.iter().flat_map(|it| [it.planned_power_mw, it.real_power_mw]);
    let cut = if leaves_out_zero(powers.map(i128::from)) {
        " · the axis does not start at zero"
    } else {
        ""
    };
    [
        Chart {
            title: "Speed",
            unit: "m/s",
            note: "as planned; 0 where the robot stands".into(),
            height: 96.0,
            held: vec![("real", sampled(|it| it.speed_mm_s))],
            ..empty()
        },
        Chart {
            title: "Power",
            unit: "W",
            note: format!("{KEY_PLANNED}{}{cut}", power_note(view)),
            height: 120.0,
            held: vec![
                ("planned", sampled(|it| it.planned_power_mw)),
                ("real", sampled(|it| it.real_power_mw)),
            ],
            ..empty()
        },
        margin("Duration margin", "s", |it| it.duration_ms),
        margin("Energy margin", "J", |it| it.energy_mj),
    ]
}

/// The charts, one below the other.
pub(super) fn section(view: &View<'_>) -> String {
    let mut html = String::from(
        "<section class=\"charts\"><h2>Along the way</h2>\n<p class=\"note\">The axis is the one \
         of the corridor: metres of path and, in the shaded bands, the seconds of a stop or of a \
         wait. What makes the way longer takes time at one place as well. Vertical lines are the \
         numbered replans.</p>\n",
    );
    let [wide, narrow] = layouts(view);
    for chart in &charts(view) {
        let _ = write!(
            html,
            "<figure><figcaption><h3>{} <span class=\"unit\">{}</span></h3><span class=\"note\">{}\
             </span>\
             </figcaption>\n{}{}</figure>\n",
            chart.title,
            chart.unit,
            chart.note,
            draw(chart, view, wide),
            draw(chart, view, narrow)
        );
    }
    html.push_str("</section>\n");
    html
}

/// A margin wherever it was checked, after each plan, and at the end.
fn margins(view: &View<'_>, value: fn(&Margins) -> i64) -> Vec<Measured> {
    let records = view.trace.records.iter();
    records
        .filter_map(|record| {
            let margins = match record {
                Record::Plan(it) => &it.after,
                Record::Sample(it) => &it.margins,
                Record::End(it) => &it.margins,
                _ => return None,
            };
            Some((record, margins))
        })
        // A plan that was not carried out to the end has no margin there.
        .filter(|(record, _)| match record {
            Record::End(it) => it.outcome != cotama_sim::run::Outcome::Safe,
            _ => true,
        })
        .map(|(record, margins)| (record.x_mm(), record.t_us(), value(margins)))
        .collect()
}

fn replans(view: &View<'_>, value: fn(&Margins) -> i64) -> Vec<(u64, u64, i64, i64)> {
    let plans = view.plans.iter().skip(1).take(super::MAX_PINS);
    plans
        .filter_map(|plan| {
            Some((plan.x_mm, plan.t_us, value(plan.before.as_ref()?), value(&plan.after)))
        })
        .collect()
}

fn placed(measured: &[Measured], axis: &Axis) -> Vec<Point> {
    thinned(&measured.iter().map(|&(x, t, value)| (axis.at(x, t), value)).collect::<Vec<_>>())
}

/// Whether all values are so far from zero that the scale leaves it out.
fn leaves_out_zero(values: impl Iterator<Item = i128> + Clone) -> bool {
    let (low, high) = (values.clone().min().unwrap_or(0), values.max().unwrap_or(0));
    low > 0 && high < low * 2
}

/// The range of the values, zero included unless all are far from it, with some room.
fn scale(chart: &Chart<'_>, top: f64, bottom: f64) -> Scale {
    let held = chart.held.iter().flat_map(|(_, points)| points);
    let values = || held.clone().chain(&chart.margin).map(|&(_, _, value)| i128::from(value));
    let (low, high) = (values().min().unwrap_or(0), values().max().unwrap_or(0));
    let far = chart.margin.is_empty() && leaves_out_zero(values());
    let (low, high) = if far { (low, high) } else { (low.min(0), high.max(0)) };
    let room = ((high - low) / 12).max(1);
    let low = if low == 0 { 0 } else { low - room };
    Scale { low, high: if high == 0 { 1.max(room) } else { high + room }, top, bottom }
}

fn draw(chart: &Chart<'_>, view: &View<'_>, layout: Layout) -> String {
    let mut svg = Svg::new();
    let axis = Axis::new(view, layout);
    let top = TOP;
    let bottom = top + chart.height;
    let scale = scale(chart, top, bottom);
    axis.draw_stops(&mut svg, top, bottom);
    let (numbers, step) = ticks(scale.low, scale.high, (chart.height / 28.0) as i128);
    for number in numbers {
        let y = scale.y(number);
        let class = if number == 0 { "zero" } else { "grid" };
        svg.line(class, [layout.left, y], [layout.end(), y]);
        svg.text("e small muted", [layout.left - 6.0, y + 4.0], &tick_label(number, step));
    }
    axis.draw(&mut svg, bottom, bottom);
    draw_pins(&mut svg, &axis, view, 10.0, bottom);
    draw_end(&mut svg, &axis, view, [top, bottom], None);
    for (class, points) in &chart.held {
        svg.path(&format!("line {class}"), &steps(&placed(points, &axis), scale));
    }
    let points = placed(&chart.margin, &axis);
    svg.path("below", &below_zero(&points, scale));
    svg.path("line real", &line(&points, scale));
    let mut taken = Vec::new();
    if let (Some(&(_, _, value)), Some(&(x, _))) = (chart.margin.last(), points.last()) {
        let text = format!("{} {}", milli(value.into(), 1), chart.unit);
        let y = scale.y(value.into());
        svg.circle("after", [x, y], 3.0);
        let width = text_width(&text, SMALL) * 1.1;
        let (class, place) = if x + 8.0 + width < layout.width && x + 70.0 > layout.end() {
            ("small strong halo", [x + 8.0, y + 4.0])
        } else {
            // Above the line, and clear of the numbers on the left.
            let end = (x + 4.0).max(layout.left + width + 2.0).min(layout.width - 1.0);
            ("e small strong halo", [end, y - 8.0])
        };
        svg.text(class, place, &text);
        taken.push(text_box(class, place, &text));
    }
    draw_replans(&mut svg, chart, &axis, scale, layout, taken);
    if chart.margin.is_empty() && chart.held.iter().all(|(_, points)| points.is_empty()) {
        svg.text(
            "m small muted",
            [layout.width / 2.0, f64::midpoint(top, bottom)],
            "no samples in this trace",
        );
    }
    let label = format!("{} in {} along the path", chart.title, chart.unit);
    axis.draw_caption(&mut svg, bottom + 30.0);
    let end = bottom + if view.stops.is_empty() { 22.0 } else { 36.0 };
    svg.finish(layout.class, [layout.width, end], &label)
}

/// The margin before (hollow) and after (full) each replan; those below zero are written where
/// there is room. The list of replans has them all.
fn draw_replans(
    svg: &mut Svg,
    chart: &Chart<'_>,
    axis: &Axis,
    scale: Scale,
    layout: Layout,
    mut taken: Vec<[f64; 4]>,
) {
    for &(x_mm, t_us, before, after) in &chart.replans {
        let x = axis.at(x_mm, t_us);
        let text = |value: i64| format!("{} {}", milli(value.into(), 1), chart.unit);
        let title = format!("{} before, {} after", text(before), text(after));
        svg.titled(&title, |svg| {
            svg.circle("before", [x, scale.y(before.into())], 3.0);
            svg.circle("after", [x, scale.y(after.into())], 3.0);
        });
        if before < 0 {
            let (y, zero) = (scale.y(before.into()), scale.y(0));
            let y = if y - zero < 12.0 { zero + 14.0 } else { y + 4.0 };
            let sides = [("e small bad halo", x - 7.0), ("small bad halo", x + 7.0)];
            let free = sides.into_iter().find_map(|(class, x)| {
                let place = text_box(class, [x, y], &text(before));
                let [left, top, right, bottom] = place;
                let inside = left > layout.left && right < layout.width;
                let clear = taken
                    .iter()
                    .all(|it| right < it[0] || it[2] < left || bottom < it[1] || it[3] < top);
                (inside && clear).then_some((class, x, place))
            });
            if let Some((class, x, place)) = free {
                svg.text(class, [x, y], &text(before));
                taken.push(place);
            }
        }
    }
}
