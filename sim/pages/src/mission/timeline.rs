//! The timeline of a mission's supervisors, one lane each, with speed, position and margin below.

use super::MAX_POINTS;
use super::lanes::{COLOURS, Lane, Lanes as Nets};
use super::series::{Point, Scale, below_zero, line, steps, thinned};
use super::strip::{BAR, Bar, Lanes, Rows};
use super::view::View;
use crate::axis::{Layout, NARROW, WIDE, draw_tick_labels, tick_label, ticks};
use crate::format::{clock, metres, moment, seconds};
use crate::svg::{Svg, fixed};
use cotama_sim::trace::{Record, Sample};
use std::fmt::Write;

/// The timeline and its key: the whole mission and, under it, its part from the first point to the
/// last with all lanes, if that is short.
pub(super) fn section(view: &View<'_>) -> String {
    let whole = Span { from_us: 0, to_us: view.last().1.max(1) };
    let close = close(view, whole);
    let mut html = String::from(
        "<section class=\"timeline\"><h2>Who was where, when</h2>\n<p class=\"note\">A lane is a \
         supervisor, a bar a place of its net; where it rests there is none. ",
    );
    if close.is_some() {
        html.push_str(
            "Above is the whole mission; its framed part is drawn below with the lanes of all \
             supervisors. ",
        );
    }
    let drawn = format!("{}{}", draw(view, whole, close, WIDE), draw(view, whole, close, NARROW));
    let _ = write!(html, "</p>\n<figure>\n{drawn}<figcaption class=\"keys\">");
    html.push_str("<span class=\"key\"><b class=\"pin point\">1</b>point of the story</span>");
    if drawn.contains("class=\"open\"") {
        html.push_str(
            "<span class=\"key\"><i class=\"swatch tint open\"></i>from a failure to the first \
             reaction</span>",
        );
    }
    for (class, words) in COLOURS {
        if drawn.contains(&format!("class=\"tint {class}\"")) {
            let _ = write!(
                html,
                "<span class=\"key\"><i class=\"swatch tint {class}\"></i>{words}</span>"
            );
        }
    }
    html.push_str("</figcaption></figure></section>\n");
    html
}

/// From the first point to the last, and what that led to; none if it is most of the mission.
fn close(view: &View<'_>, whole: Span) -> Option<Span> {
    let (first, last) = (view.points.first()?.t_us, view.points.last()?.t_us);
    let room = (last - first) / 12 + 1_000_000;
    let to_us = last.saturating_add(room).min(whole.to_us);
    let from_us = first.saturating_sub(room);
    let is_short = to_us.saturating_sub(from_us) < whole.to_us / 3 * 2;
    (view.points.len() > 1 && is_short).then_some(Span { from_us, to_us })
}

/// A part of the time of a run, in µs; not empty.
#[derive(Clone, Copy)]
struct Span {
    from_us: u64,
    to_us: u64,
}

/// The axis of time.
#[derive(Clone, Copy)]
struct Time {
    span: Span,
    layout: Layout,
}

impl Time {
    /// Returns the position of a time; those outside of the span stand at its ends.
    fn at(&self, t_us: u64) -> f64 {
        let Span { from_us, to_us } = self.span;
        let share = (t_us.clamp(from_us, to_us) - from_us) as f64 / (to_us - from_us).max(1) as f64;
        self.layout.left + share * (self.layout.end() - self.layout.left)
    }

    fn shows(&self, t_us: u64) -> bool {
        (self.span.from_us..=self.span.to_us).contains(&t_us)
    }

    /// The axis line and its ticks in seconds, with grid lines up to `top`.
    fn draw(&self, svg: &mut Svg, top: f64, bottom: f64) {
        let ms = |us: u64| i128::from(us / 1000);
        let (numbers, step) =
            ticks(ms(self.span.from_us), ms(self.span.to_us), self.layout.x_ticks);
        svg.line("axis", [self.layout.left, bottom], [self.layout.end(), bottom]);
        let mut labels = Vec::new();
        for number in numbers {
            let x = self.at(u64::try_from(number).unwrap_or(0).saturating_mul(1000));
            svg.line("grid", [x, top], [x, bottom]);
            svg.line("axis", [x, bottom], [x, bottom + 4.0]);
            labels.push((x, tick_label(number, step)));
        }
        draw_tick_labels(svg, self.layout, labels, " s", bottom + 16.0);
    }
}

/// The space between the whole mission and its part.
const BETWEEN: f64 = 58.0;

fn draw(view: &View<'_>, whole: Span, close: Option<Span>, layout: Layout) -> String {
    let mut all = Svg::new();
    let title = |svg: &mut Svg, y: f64, words: &str, span: Span| {
        let length = clock((span.to_us - span.from_us) / 1000);
        svg.text("strong", [0.0, y], &format!("{words}, {length}"));
    };
    title(&mut all, 12.0, "The whole mission", whole);
    let time = Time { span: whole, layout };
    let Some(close) = close else {
        let end = panel(&mut all, view, time, 20.0, true, true);
        return finish(all, layout, end);
    };
    let end = panel(&mut all, view, time, 20.0, true, false);
    let next = end + BETWEEN;
    // The frame around the part, and what leads from it to the ends of the axis below.
    let (left, right) = (time.at(close.from_us), time.at(close.to_us));
    all.ground("part", [left, 20.0], [right - left, end - 20.0]);
    let at = |x: f64, y: f64| format!("{} {}", fixed(x), fixed(y));
    let lead = [
        at(left, end),
        at(right, end),
        at(layout.end(), next - 22.0),
        at(layout.left, next - 22.0),
    ];
    all.ground_path("part", &format!("M{}Z", lead.join("L")));
    title(&mut all, next - 8.0, "The framed part", close);
    let end = panel(&mut all, view, Time { span: close, layout }, next, false, true);
    finish(all, layout, end)
}

fn finish(svg: Svg, layout: Layout, end: f64) -> String {
    let label = "Places of the supervisors over time, with speed, position and margin";
    svg.finish(layout.class, [layout.width, end], label)
}

/// Lanes and curves over an axis of time, from `top` on: those of the `whole` mission, those of
/// `every` supervisor, or both. Returns where it ends.
fn panel(all: &mut Svg, view: &View<'_>, time: Time, top: f64, whole: bool, every: bool) -> f64 {
    let layout = time.layout;
    let pins = pins(view, time);
    let first = top + 14.0 + pins.len() as f64 * 18.0;
    let mut rows = Rows::new(layout, time, first + 6.0);
    lane(&mut rows, "Failures", &failures(view, time));
    let nets = Nets::of(view.mission.as_ref().ok());
    let configured = |mode: bool| {
        stretches(view, time, &nets, move |it| match it {
            Record::Configuration(it) if mode => Some(it.mode.name()),
            Record::Configuration(it) => Some(it.configuration.as_deref().unwrap_or("")),
            _ => None,
        })
    };
    lane(&mut rows, "Mode", &configured(true));
    lane(&mut rows, "Runs", &configured(false));
    for it in nets.all.iter().filter(|_| every) {
        lane(&mut rows, &it.label, &places(view, time, &nets, it));
    }
    rows.y += 4.0;
    let signed = |value: u64| i64::try_from(value).unwrap_or(i64::MAX);
    let sampled = |value: &dyn Fn(&Sample) -> i64| -> Vec<(u64, i64)> {
        view.samples.iter().map(|it| (it.t_us, value(it))).collect()
    };
    if every {
        curve(&mut rows, "Speed m/s", 44.0, &sampled(&|it| signed(it.speed_mm_s)), true);
    }
    curve(&mut rows, "Position m", 60.0, &sampled(&|it| signed(it.x_mm)), false);
    if whole {
        curve(&mut rows, "Margin s", 60.0, &sampled(&|it| it.margins.duration_ms), false);
    }
    let bottom = rows.y;
    let mut under = Svg::new();
    time.draw(&mut under, first, bottom);
    for (row, pins) in pins.iter().enumerate() {
        for &(number, x) in pins {
            let Some(point) = view.points.get(number - 1) else { continue };
            let title = format!(
                "{number}: {} at {}, {}",
                point.title(),
                metres(point.x_mm),
                moment(point.t_us)
            );
            let y = top + 12.0 + row as f64 * 18.0;
            all.guide("replan point", &title, x, [y, bottom]);
            under.titled(&title, |svg| {
                svg.circle("pin point", [x, y], 8.0);
                svg.text("m pin", [x, y + 4.0], &number.to_string());
            });
        }
    }
    if whole && view.is_on_floor() {
        under.cursor([time.layout.left, time.layout.end()], [first, bottom]);
    }
    let end = bottom + 22.0;
    let end = end + rows.confess(&mut under, end + 10.0);
    all.append(&under);
    all.append(&rows.svg);
    end
}

/// The numbered pins of the points: rows from top to bottom, in each the numbers with their places.
fn pins(view: &View<'_>, time: Time) -> Vec<Vec<(usize, f64)>> {
    let mut lanes = Lanes::new(3);
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
    for point in view.points.iter().take(MAX_POINTS).filter(|it| time.shows(it.t_us)) {
        let x = time.at(point.t_us);
        let Some(row) = lanes.place(x - 8.5, x + 8.5) else { continue };
        rows.resize(rows.len().max(row + 1), Vec::new());
        rows[row].push((point.number, x));
    }
    rows
}

/// A row of bars; one without any says so.
fn lane(rows: &mut Rows<Time>, name: &str, bars: &[Bar]) {
    rows.name(name);
    if bars.is_empty() {
        rows.svg.text("small muted", [rows.layout.left, rows.y + 13.0], "–");
    }
    rows.bars(bars, false);
}

/// The time from each failure to the first reaction.
fn failures(view: &View<'_>, time: Time) -> Vec<Bar> {
    let mut bars: Vec<Bar> = Vec::new();
    for point in view.points.iter().take(MAX_POINTS) {
        let Some(chain) = point.chain() else { continue };
        let to_us = chain
            .reaction
            .first()
            .map_or(chain.diagnosis.map_or(u64::MAX, |it| it.t_us), |it| it.t_us);
        if !time.shows(point.t_us) {
            continue;
        }
        let from = time.at(point.t_us).max(bars.last().map_or(0.0, |it| it.to));
        let title = format!("{}, {}", point.title(), point.done().unwrap_or_default());
        let to = time.at(to_us).max(from + 2.5);
        bars.push(Bar { from, to, class: "open".into(), label: chain.failure.mode.clone(), title });
    }
    bars
}

/// Returns the stretches from each record on until the next one that says so; where it is empty
/// there is no bar.
fn stretches<'t>(
    view: &View<'t>,
    time: Time,
    nets: &Nets,
    what: impl Fn(&'t Record) -> Option<&'t str>,
) -> Vec<Bar> {
    let mut bars: Vec<Bar> = Vec::new();
    let mut add = |name: &str, from_us: u64, to_us: u64| {
        let (from, to) = (time.at(from_us), time.at(to_us));
        if name.is_empty()
            || to_us <= time.span.from_us
            || from_us >= time.span.to_us
            || to - from < 0.2
        {
            return;
        }
        let title = format!(
            "{name}: {} to {}, {}",
            moment(from_us),
            moment(to_us),
            seconds((to_us - from_us) / 1000)
        );
        let class = format!("tint {}", nets.tint(name));
        bars.push(Bar { from, to, class, label: name.into(), title });
    };
    let (mut name, mut since) = ("", 0);
    for record in &view.trace.records {
        let Some(next) = what(record).filter(|next| *next != name) else { continue };
        add(name, since, record.t_us());
        (name, since) = (next, record.t_us());
    }
    add(name, since, view.last().1);
    bars
}

/// The places of a net, but for that where it rests: the one it starts in.
fn places(view: &View<'_>, time: Time, nets: &Nets, lane: &Lane) -> Vec<Bar> {
    stretches(view, time, nets, |record| match record {
        Record::Fired(it) if it.net == lane.net => {
            Some(if it.place == lane.rest { "" } else { it.place.as_str() })
        }
        _ => None,
    })
}

/// A curve with its own scale; values hold until the next one, or change steadily.
fn curve(rows: &mut Rows<Time>, name: &str, height: f64, values: &[(u64, i64)], held: bool) {
    rows.name(name);
    let time = rows.axis;
    let (top, bottom) = (rows.y + 2.0, rows.y + height);
    let shown: Vec<(u64, i64)> = values.iter().filter(|it| time.shows(it.0)).copied().collect();
    let of = |pick: fn(i64, i64) -> i64| shown.iter().map(|it| it.1).fold(0, pick);
    let scale =
        Scale { low: of(i64::min).into(), high: i128::from(of(i64::max)).max(1), top, bottom };
    let (numbers, step) = ticks(scale.low, scale.high, (height / 18.0) as i128);
    for number in numbers {
        let y = scale.y(number);
        rows.svg.line(
            if number == 0 { "zero" } else { "grid" },
            [rows.layout.left, y],
            [rows.layout.end(), y],
        );
        // The numbers stand on the other side where names stand beside the rows.
        let (class, x) = if rows.layout.names_beside {
            ("small muted", rows.layout.end() + 4.0)
        } else {
            ("e small muted", rows.layout.left - 4.0)
        };
        rows.svg.text(class, [x, y + 4.0], &tick_label(number, step));
    }
    let drawn: Vec<Point> =
        thinned(&shown.iter().map(|&(t, value)| (time.at(t), value)).collect::<Vec<_>>());
    if !held {
        rows.svg.path("below", &below_zero(&drawn, scale));
    }
    rows.svg.path("line real", &if held { steps(&drawn, scale) } else { line(&drawn, scale) });
    rows.y += height + BAR / 2.0;
}
