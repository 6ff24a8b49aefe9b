//! The corridor as a strip: zones, objectives, activities and what happened, along one axis.

use super::events::{glyph, short};
use super::path_axis::Axis;
use super::view::{Step, View, families, tint};
use super::{MAX_MARKS, MAX_PINS};
use crate::axis::Layout;
use crate::format::{metres, moment, speed};
use crate::svg::{SMALL, Svg, fitted, text_width};
use cotama_models::missions::{Mission, Zone};
use std::cmp::Reverse;
use std::fmt::Write;

/// The most rows of events that have their labels.
const EVENT_LANES: usize = 10;

/// The height of a bar.
pub(super) const BAR: f64 = 18.0;

/// The strip and its key.
pub(super) fn section(view: &View<'_>) -> String {
    let mut html = String::from("<section class=\"strip\"><h2>The corridor</h2>\n");
    if !view.stops.is_empty() {
        html.push_str(
            "<p class=\"note\">From left to right runs the path, in metres. A shaded band is a \
             place where time passes: it is as wide as its time, and what lies behind it is moved \
             on.</p>\n",
        );
    }
    html.push_str("<figure>\n");
    for layout in super::charts::layouts(view) {
        html.push_str(&draw(view, layout));
    }
    html.push_str("<figcaption class=\"keys\">");
    if view.plans.len() > 1 {
        html.push_str("<span class=\"key\"><b class=\"pin\">1</b>replan</span>");
    }
    for (kind, words) in [
        ("obstacle", "obstacle, time lost"),
        ("fault", "fault, units lost"),
        ("repair", "repair, units back"),
        ("odometry", "odometry, extra path"),
    ] {
        if view.events.iter().all(|event| short(event).0 != kind) {
            continue;
        }
        let mut svg = Svg::new();
        svg.path(&format!("mark {kind}"), &glyph(kind, 7.0, 7.0));
        let glyph = svg.finish("glyph", [14.0, 14.0], words);
        let _ = write!(html, "<span class=\"key\">{}{words}</span>", glyph.trim_end());
    }
    if !view.stops.is_empty() {
        html.push_str(
            "<span class=\"key\"><i class=\"swatch stop\"></i>stop or wait: time passes, no path\
             </span>",
        );
    }
    html.push_str("</figcaption></figure></section>\n");
    html
}

/// Rows of intervals that keep clear of each other.
pub(super) struct Lanes {
    lanes: Vec<Vec<(f64, f64)>>,
    most: usize,
}

impl Lanes {
    pub(super) fn new(most: usize) -> Self {
        Self { lanes: Vec::new(), most }
    }

    /// The first lane where an interval is free.
    pub(super) fn place(&mut self, from: f64, to: f64) -> Option<usize> {
        self.place_within(self.most, from, to)
    }

    /// The same in the first lanes only.
    fn place_within(&mut self, most: usize, from: f64, to: f64) -> Option<usize> {
        let clear =
            |lane: &Vec<(f64, f64)>| lane.iter().all(|&(start, end)| end <= from || to <= start);
        let lane = match self.lanes.iter().take(most).position(clear) {
            Some(lane) => lane,
            None if self.lanes.len() < self.most.min(most) => {
                self.lanes.push(Vec::new());
                self.lanes.len() - 1
            }
            None => return None,
        };
        self.lanes[lane].push((from, to));
        Some(lane)
    }

    pub(super) fn count(&self) -> usize {
        self.lanes.len()
    }
}

/// The numbered pins of the replans, with a line down to `bottom`; where they crowd, the line
/// alone.
pub(super) fn draw_pins(svg: &mut Svg, axis: &Axis, view: &View<'_>, y: f64, bottom: f64) {
    let mut free = f64::MIN;
    for (number, plan) in view.plans.iter().enumerate().skip(1).take(MAX_PINS) {
        let x = axis.at(plan.x_mm, plan.t_us);
        let radius = if number < 100 { 8.0 } else { 11.0 };
        let title = format!(
            "Plan {number} at {}, {}: {}",
            metres(plan.x_mm),
            moment(plan.t_us),
            plan.cause
        );
        svg.guide("replan", &title, x, [y, bottom]);
        if x - radius > free {
            svg.titled(&title, |svg| {
                svg.circle("pin", [x, y], radius);
                svg.text("m pin", [x, y + 4.0], &number.to_string());
            });
            free = x + radius + 1.0;
        }
    }
}

/// Draws the end of the run, if that is not the end of the path; in words too, with a layout to
/// write them in.
pub(super) fn draw_end(
    svg: &mut Svg,
    axis: &Axis,
    view: &View<'_>,
    [y, bottom]: [f64; 2],
    words: Option<Layout>,
) {
    let (x_mm, t_us) = view.last();
    if x_mm >= view.length_mm {
        return;
    }
    let x = axis.at(x_mm, t_us);
    svg.line("stopped", [x, y], [x, bottom]);
    if let Some(layout) = words {
        let leftwards = x > layout.width / 2.0;
        let (class, x) =
            if leftwards { ("e small bad halo", x - 12.0) } else { ("small bad halo", x + 12.0) };
        svg.text(class, [x, y + 4.0], "run ended");
    }
}

/// A bar of a row.
pub(super) struct Bar {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) class: String,
    pub(super) label: String,
    pub(super) title: String,
}

/// Rows from top to bottom, over an axis of any kind.
pub(super) struct Rows<A> {
    pub(super) svg: Svg,
    pub(super) layout: Layout,
    pub(super) axis: A,
    pub(super) y: f64,
    /// How many labels had no room.
    pub(super) unlabelled: usize,
}

impl<A> Rows<A> {
    pub(super) fn new(layout: Layout, axis: A, y: f64) -> Self {
        Self { svg: Svg::new(), layout, axis, y, unlabelled: 0 }
    }

    /// Says how many labels had no room, and where else they stand; the space that it takes.
    pub(super) fn confess(&self, svg: &mut Svg, y: f64) -> f64 {
        if self.unlabelled == 0 {
            return 0.0;
        }
        let what = crate::format::count(self.unlabelled as u64, "label");
        let words = format!("{what} without room: see the tables below");
        let half = text_width(&words, SMALL) / 2.0;
        let middle = f64::midpoint(self.layout.left, self.layout.end());
        svg.text("m small muted", [self.layout.within(middle, half), y], &words);
        14.0
    }

    /// Begins a row: beside it stands its name, or above it where it is narrow.
    pub(super) fn name(&mut self, name: &str) {
        if self.layout.names_beside {
            self.svg.text("small muted", [0.0, self.y + 13.0], name);
        } else {
            self.svg.text("small muted", [0.0, self.y + 10.0], name);
            self.y += 15.0;
        }
    }

    /// A row of bars, one after the other. What has no room for its label has it underneath; with
    /// `merge`, neighbours share one: `A2–A3`.
    pub(super) fn bars(&mut self, bars: &[Bar], merge: bool) {
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for (index, bar) in bars.iter().enumerate() {
            let Bar { from, to, class, label, title } = bar;
            let y = self.y;
            if to - from >= 0.2 {
                self.svg.titled(title, |svg| {
                    svg.rect(class, [*from + 0.5, y], [(to - from - 1.0).max(0.7), BAR]);
                });
            }
            if text_width(label, SMALL) + 5.0 <= to - from {
                self.svg.text("m small", [f64::midpoint(*from, *to), y + 13.0], label);
            } else {
                match runs.last_mut() {
                    Some((_, last)) if merge && *last + 1 == index => *last = index,
                    _ => runs.push((index, index)),
                }
            }
        }
        let mut lanes = Lanes::new(4);
        for (first, last) in runs {
            let (from, to) = (bars[first].from, bars[last].to);
            let label = match last - first {
                0 => bars[first].label.clone(),
                _ => format!("{}–{}", bars[first].label, bars[last].label),
            };
            let label = fitted(&label, SMALL, self.layout.width - 2.0);
            let half = text_width(&label, SMALL) / 2.0;
            let middle = self.layout.within(f64::midpoint(from, to), half);
            if let Some(lane) = lanes.place(middle - half - 3.0, middle + half + 3.0) {
                let y = self.y + BAR + 11.0 + lane as f64 * 14.0;
                self.svg.text("m small muted halo", [middle, y], &label);
            } else {
                self.unlabelled += 1;
            }
        }
        self.y += BAR + 8.0 + lanes.count() as f64 * 14.0;
    }
}

impl Rows<&Axis> {
    fn zones(&mut self, mission: &Mission) {
        self.name("Zones");
        let mut zones: Vec<&Zone> = mission.zones.iter().take(MAX_MARKS).collect();
        // The longest first: they share the upper rows, and the short ones hang below.
        zones.sort_by_key(|zone| (Reverse(zone.x_end.0 - zone.x_start.0), zone.x_start));
        let mut lanes = Lanes::new(60);
        for zone in zones {
            let (from, to) = (self.axis.after(zone.x_start.0), self.axis.before(zone.x_end.0));
            let demands = demands(zone, mission);
            let label = if demands.is_empty() {
                zone.id.clone()
            } else {
                format!("{}  {demands}", zone.id)
            };
            let label = fitted(&label, SMALL, self.layout.width - 4.0);
            let width = text_width(&label, SMALL) + 8.0;
            // The label stands inside, else on the right, else on the left, else where it can.
            let half = text_width(&label, SMALL) / 2.0;
            let middle = f64::midpoint(from, to);
            let (class, x, left, right) = if width <= to - from {
                ("m small halo", middle, from, to)
            } else if to + width <= self.layout.width {
                ("small halo", to + 4.0, from, to + width)
            } else if from - width >= 0.0 {
                ("e small halo", from - 4.0, from - width, to)
            } else {
                let middle = self.layout.within(middle, half);
                ("m small halo", middle, from.min(middle - half), to.max(middle + half))
            };
            let Some(lane) = lanes.place(left, right) else {
                self.unlabelled += 1;
                continue;
            };
            let y = self.y + lane as f64 * (BAR + 3.0);
            let title = format!(
                "{}: {} to {}, {demands}",
                zone.id,
                metres(zone.x_start.0),
                metres(zone.x_end.0)
            );
            self.svg.titled(&title, |svg| {
                svg.rect("zone", [from + 0.5, y], [(to - from - 1.0).max(1.0), BAR]);
                svg.text(class, [x, y + 13.0], &label);
            });
        }
        if mission.zones.is_empty() {
            self.svg.text("small muted", [self.layout.left, self.y + 13.0], "none");
        }
        self.y += lanes.count().max(1) as f64 * (BAR + 3.0) + 5.0;
    }

    fn events(&mut self, view: &View<'_>) {
        self.name("Events");
        let mut events: Vec<_> = view.events.iter().take(MAX_MARKS).collect();
        // Events that change the hardware are labelled first; where it is crowded, others lose
        // their labels.
        events.sort_by_key(|event| !matches!(short(event).0, "fault" | "repair"));
        if events.is_empty() {
            self.svg.text("small muted", [self.layout.left, self.y + 13.0], "none");
        }
        let mut lanes = Lanes::new(EVENT_LANES + 2);
        for event in events {
            let x = self.axis.at(event.x_mm, event.t_us);
            let (kind, label, words) = short(event);
            let label = fitted(&label, SMALL, self.layout.width / 2.0 - 20.0);
            let width = text_width(&label, SMALL) + 9.0;
            let leftwards = x + width > self.layout.width;
            let (left, right) = if leftwards { (x - width, x + 7.0) } else { (x - 7.0, x + width) };
            let labelled = lanes.place_within(EVENT_LANES, left, right + 4.0);
            let lane = labelled.or_else(|| lanes.place(x - 7.0, x + 7.0));
            let y = self.y + 9.0 + lane.unwrap_or(EVENT_LANES + 1) as f64 * 17.0;
            self.unlabelled += usize::from(labelled.is_none());
            let title = format!("{words} at {}, {}", metres(event.x_mm), moment(event.t_us));
            self.svg.titled(&title, |svg| {
                svg.path(&format!("mark {kind}"), &glyph(kind, x, y));
                match (labelled, leftwards) {
                    (None, _) => {}
                    (_, true) => svg.text("e small halo", [x - 8.0, y + 4.0], &label),
                    (_, false) => svg.text("small halo", [x + 8.0, y + 4.0], &label),
                }
            });
        }
        self.y += lanes.count().max(1) as f64 * 17.0 + 6.0;
    }
}

/// Returns the demands of a zone: `≤ 0.33 m/s, sonar`.
pub(super) fn demands(zone: &Zone, mission: &Mission) -> String {
    let mut demands: Vec<String> =
        zone.speed_max.iter().map(|it| format!("≤ {}", speed(it.0))).collect();
    if let Some(required) = &zone.require_hardware {
        let name = mission.hardware.get(required.value.hardware).map_or("?", |it| it.name.as_str());
        let units = required.value.units;
        demands.push(if units == 1 { name.into() } else { format!("{units} {name}") });
    }
    if let Some(required) = &zone.require_tio {
        demands.push(mission.tios.get(required.value).map_or("?", |it| it.id.as_str()).into());
    }
    demands.join(", ")
}

fn bar_of(step: &Step, axis: &Axis) -> (f64, f64) {
    if step.travels() {
        (axis.after(step.x_start_mm), axis.before(step.x_end_mm))
    } else {
        (axis.at(step.x_start_mm, step.start_us), axis.at(step.x_end_mm, step.end_us))
    }
}

fn objectives(view: &View<'_>, mission: &Mission, axis: &Axis) -> Vec<Bar> {
    let mut bars: Vec<Bar> = Vec::new();
    let mut last = None;
    for (step, planned) in view.activities.iter().zip(&mission.scenario().activities) {
        let (from, to) = bar_of(step, axis);
        if last == Some(planned.objective)
            && let Some(bar) = bars.last_mut()
        {
            bar.to = to;
            continue;
        }
        last = Some(planned.objective);
        let Some(objective) = mission.objectives.get(planned.objective) else { continue };
        let tasks: Vec<_> =
            objective.tasks.iter().map(|task| super::plans::task_name(*task)).collect();
        let class = if step.travels() { "bar" } else { "bar point" }.into();
        let title = format!("{}: {}", objective.id, tasks.join(", "));
        bars.push(Bar { from, to, class, label: objective.id.clone(), title });
    }
    bars
}

fn draw(view: &View<'_>, layout: Layout) -> String {
    let axis = Axis::new(view, layout);
    // Above the rows stand the pins, and below them where the run ended.
    let first = if view.last().0 < view.length_mm { 40.0 } else { 26.0 };
    let mut rows = Rows::new(layout, &axis, first);
    if let Ok(mission) = &view.mission {
        rows.zones(mission);
        rows.name("Objectives");
        rows.bars(&objectives(view, mission, &axis), true);
    }
    rows.name("Activities");
    let bars: Vec<Bar> = view
        .activities
        .iter()
        .map(|step| {
            let (from, to) = bar_of(step, &axis);
            let class = if step.started { "bar" } else { "bar todo" }.into();
            let title =
                format!("{}: {} to {}", step.id, metres(step.x_start_mm), metres(step.x_end_mm));
            Bar { from, to, class, label: step.id.clone(), title }
        })
        .collect();
    rows.bars(&bars, true);
    rows.name("Choices");
    let families = families(&view.plans);
    let bars: Vec<Bar> = view
        .stretches
        .iter()
        .map(|it| Bar {
            from: axis.at(it.from.0, it.from.1),
            to: axis.at(it.to.0, it.to.1),
            class: format!("tint {}", tint(&families, &it.choice)),
            label: it.choice.clone(),
            title: format!("{} from {} to {}", it.choice, metres(it.from.0), metres(it.to.0)),
        })
        .collect();
    rows.bars(&bars, false);
    rows.events(view);
    let bottom = rows.y;
    axis.draw(&mut rows.svg, bottom, bottom);
    let mut under = Svg::new();
    axis.draw_stops(&mut under, first, bottom);
    axis.draw_stop_labels(&mut under, bottom + 32.0);
    axis.draw_caption(&mut under, bottom + 46.0);
    let end = bottom + if view.stops.is_empty() { 38.0 } else { 52.0 };
    let end = end + rows.confess(&mut under, end + 4.0);
    draw_pins(&mut under, &axis, view, 10.0, bottom);
    draw_end(&mut under, &axis, view, [first - 16.0, bottom], Some(layout));
    let length = metres(view.length_mm);
    let label =
        format!("The path of {length} with its zones, objectives, activities, choices and events");
    under.append(&rows.svg);
    under.finish(layout.class, [layout.width, end], &label)
}
