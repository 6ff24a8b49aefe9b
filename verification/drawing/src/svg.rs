//! A drawing of a net, complete in one SVG file.
//!
//! The layout is layered, with lines that pass no node and labels that stand in their lines.
//! Colours follow the reader's light or dark mode; hovering shows the documentation of what is
//! under the pointer. Up to 4,000 nodes, labels and bends of lines the order in the layers is
//! optimised; larger nets are drawn with more crossings, and from 20,000 on with long lines across
//! whatever is there.

mod legend;
mod palette;
mod scene;
mod style;
mod text;

use super::elements::Elements;
use super::figure::{Figure, Flow, Kind, Label, Style};
use super::layout::{Outline, Point, Run};
use cotama_core::net::{Net, Place, PlaceId, TransitionId};
use cotama_core::text::markup;
use scene::{ENTRY, INITIAL, LOOP, SPACE, Scene};
use std::fmt::Write as _;
use text::{Block, Face, NAME};

pub(crate) use legend::{Key, write_figure};
pub use scene::parts;
pub use style::STYLE;
pub use text::{bold_width, short, width};

/// The parts to point out in a drawing: the marking of a run, and the transition that has just
/// fired.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Highlight<'a> {
    /// Tokens by place, drawn instead of the initial ones; places that it does not reach are empty.
    pub marking: Option<&'a [u32]>,
    /// Transitions to colour.
    pub transitions: &'a [TransitionId],
    /// Places to colour, drawn as circles; without it those that are marked.
    pub places: Option<&'a [PlaceId]>,
}

/// Draws a net.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::drawing::{figure::Style, svg};
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// let picture = svg::write(&net.view().net(), Style::Auto);
/// assert!(picture.starts_with("<svg xmlns=") && picture.contains("A lamp."));
/// ```
pub fn write(net: &Net<'_>, style: Style) -> String {
    write_highlighted(net, style, &Highlight::default())
}

/// Draws a net with a marking and transitions pointed out.
///
/// ```
/// use cotama_core::net::TransitionId;
/// use cotama_models::nets::door;
/// use cotama_verification::drawing::figure::Style;
/// use cotama_verification::drawing::svg::{Highlight, write, write_highlighted};
/// let fired = [TransitionId(0)];
/// let highlight = Highlight { transitions: &fired, ..Highlight::default() };
/// let drawing = write_highlighted(&door::NET, Style::Net, &highlight);
/// assert!(drawing.starts_with("<svg") && drawing != write(&door::NET, Style::Net));
/// ```
pub fn write_highlighted(net: &Net<'_>, style: Style, highlight: &Highlight<'_>) -> String {
    let scene = Scene::of(net, Figure::of(net, style), highlight);
    let kind = if scene.figure.is_states { "State diagram" } else { "Petri net" };
    written(net, &scene, kind, highlight)
}

fn written(net: &Net<'_>, scene: &Scene<'_>, kind: &str, highlight: &Highlight<'_>) -> String {
    let mut out = Svg { out: Elements::default(), prefix: "" };
    out.head(scene, kind);
    out.body(net, scene, highlight);
    out.out.push_str("</svg>\n");
    out.out.into_string()
}

/// A drawing to be put into another one that has the [`STYLE`] and the class `cotama`.
#[derive(Clone, Debug)]
pub struct Part {
    /// Width in pixels.
    pub width: i64,
    /// Height in pixels.
    pub height: i64,
    /// The elements of SVG.
    pub text: String,
}

/// Draws a net as a part of another drawing. Identifiers begin with a prefix.
pub fn part(net: &Net<'_>, style: Style, highlight: &Highlight<'_>, prefix: &str) -> Part {
    let scene = Scene::of(net, Figure::of(net, style), highlight);
    let mut out = Svg { out: Elements::default(), prefix };
    out.body(net, &scene, highlight);
    Part { width: scene.layout.width, height: scene.layout.height, text: out.out.into_string() }
}

struct Svg<'p> {
    out: Elements,
    /// Prefix of identifiers.
    prefix: &'p str,
}

impl Svg<'_> {
    fn head(&mut self, scene: &Scene<'_>, kind: &str) {
        let (width, height) = (scene.layout.width, scene.layout.height);
        let figure = &scene.figure;
        let doc =
            if figure.doc.is_empty() { kind.to_owned() } else { format!("{kind}. {}", figure.doc) };
        self.out.add(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cotama\" width=\"{width}\" \
             height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"title desc\">\n\
             <title id=\"title\">{}</title>\n<desc id=\"desc\">{}</desc>\n<style>\n{STYLE}\
             </style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n",
            markup(figure.name),
            markup(&doc),
        ));
    }

    fn body(&mut self, net: &Net<'_>, scene: &Scene<'_>, highlight: &Highlight<'_>) {
        self.out.push_str("<g class=\"edges\">\n");
        for edge in 0..scene.figure.edges.len() {
            self.edge(net, scene, edge, highlight);
        }
        self.out.push_str("</g>\n<g class=\"nodes\">\n");
        for node in 0..scene.figure.nodes.len() {
            self.node(net, scene, node);
        }
        self.out.push_str("</g>\n");
    }

    fn edge(&mut self, net: &Net<'_>, scene: &Scene<'_>, at: usize, highlight: &Highlight<'_>) {
        let edge = &scene.figure.edges[at];
        let class = match edge.flow {
            Flow::Move => "edge",
            Flow::Borrow => "edge borrow",
            Flow::Read => "edge read",
        };
        let hot = if scene.is_hot(at, highlight) { " hot" } else { "" };
        let prefix = self.prefix;
        self.out.add(format_args!("<g id=\"{prefix}edge-{at}\" class=\"{class}{hot}\">"));
        self.out.title(&labels_title(net, &edge.labels));
        let label = &scene.labels[at];
        let Some(route) = scene.route_of[at].map(|route| &scene.layout.routes[route]) else {
            self.loop_at(scene, edge.from);
            self.out.push_str("</g>\n");
            return;
        };
        let last = route.lines.len().saturating_sub(1);
        for (part, runs) in route.lines.iter().enumerate() {
            let start = if part == 0 && edge.flow == Flow::Borrow { Tip::Arrow } else { Tip::None };
            let end = match edge.flow {
                _ if part != last => Tip::None,
                Flow::Move | Flow::Borrow => Tip::Arrow,
                Flow::Read => Tip::Dot,
            };
            self.line(runs, start, end);
        }
        if let Some(centre) = route.label {
            self.block(label, Point { x: centre.x, y: centre.y - label.height / 2 }, "middle");
        }
        self.out.push_str("</g>\n");
    }

    /// A line along its runs. It ends where the tips begin.
    fn line(&mut self, runs: &[Run], start: Tip, end: Tip) {
        let [Some(first), Some(last)] = [runs.first(), runs.last()] else { return };
        let (away, onward) = ((first.to - first.from).signum(), (last.to - last.from).signum());
        let mut path = String::new();
        let mut before: Option<Point> = None;
        for (at, run) in runs.iter().enumerate() {
            let from = if at == 0 { run.from + away * start.length() } else { run.from };
            let to = if at + 1 == runs.len() { run.to - onward * end.length() } else { run.to };
            match before {
                None => put(&mut path, format_args!("M{} {from}", run.x)),
                Some(point) if point.x == run.x => {}
                Some(point) => {
                    let middle = i64::midpoint(point.y, from);
                    put(
                        &mut path,
                        format_args!(
                            "V{}C{} {middle} {} {middle} {} {from}",
                            point.y, point.x, run.x, run.x
                        ),
                    );
                }
            }
            before = Some(Point { x: run.x, y: to });
        }
        if let Some(point) = before {
            put(&mut path, format_args!("V{}", point.y));
        }
        self.out.path("line", path);
        self.tip(Point { x: first.x, y: first.from }, (0, -away), start);
        self.tip(Point { x: last.x, y: last.to }, (0, onward), end);
    }

    /// The tip of a line that ends at a point in a direction.
    fn tip(&mut self, at: Point, (right, down): (i64, i64), tip: Tip) {
        let back = |along: i64, aside: i64| {
            format!(
                "{} {}",
                at.x - right * along + down * aside,
                at.y - down * along + right * aside
            )
        };
        match tip {
            Tip::None => {}
            Tip::Arrow => {
                let outline = [back(0, 0), back(9, 4), back(7, 0), back(9, -4)].join("L");
                self.out.path("head", format_args!("M{outline}Z"));
            }
            Tip::Dot => {
                self.out.circle("head", [at.x - right * 3, at.y - down * 3], 3);
            }
        }
    }

    /// The edge of a state to itself, at its right side.
    fn loop_at(&mut self, scene: &Scene<'_>, node: usize) {
        let Point { x, y } = scene.layout.nodes[node];
        let side = x + half_width(scene, node);
        let (near, far) = (side + 7, side + LOOP);
        let (top, bottom) = (y - 9, y + 9);
        self.out.path(
            "line",
            format_args!("M{side} {top}H{near}C{far} {top} {far} {bottom} {near} {bottom}"),
        );
        self.tip(Point { x: side, y: y + 9 }, (-1, 0), Tip::Arrow);
        let label = &scene.signs[node].to_itself;
        self.block(label, Point { x: side + LOOP, y: y - label.height / 2 }, "begin");
    }

    fn node(&mut self, net: &Net<'_>, scene: &Scene<'_>, at: usize) {
        let (node, sign) = (&scene.figure.nodes[at], &scene.signs[at]);
        let Point { x, y } = scene.layout.nodes[at];
        let half = half_width(scene, at);
        let (id, class, index) = match node.kind {
            Kind::State(place) => ("place", "state", place),
            Kind::Place { place, shared: false } => ("place", "place", place),
            Kind::Place { place, shared: true } => ("place", "place shared", place),
            Kind::Transition(at) => ("transition", "transition", at),
        };
        let hot = if sign.is_hot { " hot" } else { "" };
        let prefix = self.prefix;
        self.out.add(format_args!("<g id=\"{prefix}{id}-{index}\" class=\"{class}{hot}\">"));
        let beside = Point { x: x + half + SPACE, y: y - sign.text.height / 2 };
        match node.kind {
            Kind::State(place) => {
                self.out.title(&place_title(&net.places[place], sign.tokens));
                let Outline::Rectangle(_, high) = scene.graph.nodes[at].outline else { return };
                self.rectangle(Point { x, y }, half, high, 9);
                self.out.text("name middle", [x, y + NAME / 3], &text::short(node.name));
                self.arrivals(net, scene, at);
            }
            Kind::Place { place, .. } => {
                self.out.title(&place_title(&net.places[place], sign.tokens));
                self.out.circle("rim", [x, y], half);
                self.tokens(sign.tokens, Point { x, y });
                self.block(&sign.text, beside, "begin");
            }
            Kind::Transition(_) => {
                let labels: Vec<Label<'_>> =
                    node.label.iter().chain(node.also.iter().map(|it| &it.1)).cloned().collect();
                self.out.title(&labels_title(net, &labels));
                let Outline::Rectangle(_, high) = scene.graph.nodes[at].outline else { return };
                self.rectangle(Point { x, y }, half, high, 1);
                self.block(&sign.text, beside, "begin");
            }
        }
        self.out.push_str("</g>\n");
    }

    /// Draws the arrivals at a state that are no edges: the start of the net, and lines from many
    /// states.
    fn arrivals(&mut self, net: &Net<'_>, scene: &Scene<'_>, at: usize) {
        let (node, sign) = (&scene.figure.nodes[at], &scene.signs[at]);
        let Point { x, y } = scene.layout.nodes[at];
        let Outline::Rectangle(wide, high) = scene.graph.nodes[at].outline else { return };
        if sign.is_initial {
            let (length, radius) = INITIAL;
            let (top, from) = (y - high, y - high - length);
            self.out.circle("start", [x, from - radius], radius);
            self.line(&[Run { x, from, to: top }], Tip::None, Tip::Arrow);
        }
        if !sign.entries.lines.is_empty() {
            let hot = if sign.entries.lines.iter().any(|line| line.hot) { " hot" } else { "" };
            let (from, to) = (x - wide - ENTRY, x - wide);
            let labels: Vec<Label<'_>> =
                node.entries.iter().map(|entry| entry.label.clone()).collect();
            self.out.add(format_args!("<g class=\"entry{hot}\">"));
            self.out.title(&labels_title(net, &labels));
            self.out.path("line", format_args!("M{from} {y}H{}", to - Tip::Arrow.length()));
            self.tip(Point { x: to, y }, (1, 0), Tip::Arrow);
            self.block(
                &sign.entries,
                Point { x: from - SPACE, y: y - sign.entries.height / 2 },
                "end",
            );
            self.out.push_str("</g>");
        }
    }

    fn rectangle(&mut self, centre: Point, wide: i64, high: i64, radius: i64) {
        let corner = [centre.x - wide, centre.y - high];
        self.out.rounded("", corner, [2 * wide, 2 * high], radius);
    }

    /// Tokens as dots, from five on as a number.
    fn tokens(&mut self, tokens: u32, Point { x, y }: Point) {
        let dots: &[(i64, i64)] = match tokens {
            0 => &[],
            1 => &[(0, 0)],
            2 => &[(-5, 0), (5, 0)],
            3 => &[(0, -5), (-5, 4), (5, 4)],
            4 => &[(-5, -5), (5, -5), (-5, 5), (5, 5)],
            more => {
                // Ten digits do not fit at the usual size.
                let size = if more < 10_000 { NAME - 2 } else { 5 };
                let style = format!("font-size:{size}px");
                let base = y + size / 3;
                return self.out.add(format_args!(
                    "<text class=\"count middle\" style=\"{style}\" x=\"{x}\" y=\"{base}\">{more}\
                     </text>"
                ));
            }
        };
        let radius = if tokens == 1 { 5 } else { 4 };
        for (right, down) in dots {
            self.out.circle("token", [x + right, y + down], radius);
        }
    }

    fn block(&mut self, block: &Block, top: Point, anchor: &str) {
        for line in &block.lines {
            let mut said = String::new();
            for span in &line.spans {
                let text = markup(&span.text);
                let class = match span.face {
                    Face::Plain => {
                        said += &text;
                        continue;
                    }
                    Face::Strong => "strong",
                    Face::Quiet => "quiet",
                    Face::Sources => "sources",
                };
                put(&mut said, format_args!("<tspan class=\"{class}\">{text}</tspan>"));
            }
            let class = if line.hot { &format!("{anchor} hot") } else { anchor };
            self.out.rich_text(class, [top.x, top.y + line.base], &said);
        }
    }
}

fn put(out: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing into a string cannot fail.
    let _ = out.write_fmt(text);
}

/// How a line ends.
#[derive(Clone, Copy, Debug)]
enum Tip {
    None,
    Arrow,
    Dot,
}

impl Tip {
    /// How much shorter it makes the line.
    fn length(self) -> i64 {
        match self {
            Self::None => 0,
            Self::Arrow => 7,
            Self::Dot => 4,
        }
    }
}

fn half_width(scene: &Scene<'_>, node: usize) -> i64 {
    match scene.graph.nodes[node].outline {
        Outline::Rectangle(half, _) | Outline::Circle(half) => half,
    }
}

/// Name, documentation and tokens of a place.
fn place_title(place: &Place<'_>, tokens: u32) -> String {
    let doc = if place.doc.is_empty() { String::new() } else { format!(": {}", place.doc) };
    let bound = if place.bound == Place::UNBOUNDED {
        String::new()
    } else {
        format!(" of at most {}", place.bound)
    };
    let noun = if tokens == 1 && bound.is_empty() { "token" } else { "tokens" };
    format!("{}{doc}\n{tokens}{bound} {noun}", place.name)
}

/// Names, labels and documentations of transitions.
fn labels_title(net: &Net<'_>, labels: &[Label<'_>]) -> String {
    let line = |label: &Label<'_>| {
        let name = |&at: &u32| {
            let it = net.transitions[at as usize];
            if it.doc.is_empty() { it.name.to_owned() } else { format!("{}: {}", it.name, it.doc) }
        };
        let mut lines: Vec<String> = label.transitions.iter().map(name).collect();
        lines.insert(0, label.to_string());
        lines.retain(|line| !line.is_empty());
        lines.dedup();
        lines.join("\n")
    };
    labels.iter().map(line).collect::<Vec<_>>().join("\n")
}
