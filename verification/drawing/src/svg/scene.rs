//! A figure with the size and the position of everything in it.

use super::Highlight;
use super::text::{self, Block, Face};
use crate::figure::{Figure, Flow, Kind, Label, Node, Style};
use crate::layout::{self, Graph, Layout, Outline};
use cotama_core::net::{Net, TransitionId};

/// The least half width and the half height of a state.
const STATE: (i64, i64) = (34, 17);

/// The radius of a place.
const RADIUS: i64 = 16;

/// The least half width and the half height of the bar of a transition.
const BAR: (i64, i64) = (17, 4);

/// The width that a node has for each line at its more crowded side.
const PORT: i64 = 16;

/// The distance of text from what it belongs to.
pub(super) const SPACE: i64 = 6;

/// How far an edge from a state to itself reaches to the side.
pub(super) const LOOP: i64 = 26;

/// The length of the arrow of an entry.
pub(super) const ENTRY: i64 = 26;

/// The length of the arrow into the initial state, and the radius of the dot that it starts at.
pub(super) const INITIAL: (i64, i64) = (22, 5);

/// A figure with the size and the position of everything in it.
#[derive(Debug)]
pub(super) struct Scene<'n> {
    pub(super) figure: Figure<'n>,
    /// By node.
    pub(super) signs: Vec<Sign>,
    /// By edge: its label.
    pub(super) labels: Vec<Block>,
    /// By edge: its position among the routes; `None` for an edge from a state to itself.
    pub(super) route_of: Vec<Option<usize>>,
    pub(super) graph: Graph,
    pub(super) layout: Layout,
}

/// The text at a node, and its look.
#[derive(Clone, Debug, Default)]
pub(super) struct Sign {
    /// In the node for states, to its right for others.
    pub(super) text: Block,
    /// At the edge of a state to itself.
    pub(super) to_itself: Block,
    /// At the arrow from many states.
    pub(super) entries: Block,
    pub(super) tokens: u32,
    /// Whether the net starts here.
    pub(super) is_initial: bool,
    pub(super) is_hot: bool,
}

impl<'n> Scene<'n> {
    pub(super) fn of(net: &Net<'n>, figure: Figure<'n>, highlight: &Highlight<'_>) -> Self {
        let is_hot = |label: &Label<'_>| label.transitions.iter().any(|&at| highlight.has(at));
        let mut signs: Vec<Sign> =
            figure.nodes.iter().map(|node| sign(net, node, highlight)).collect();
        let mut labels = Vec::new();
        let mut route_of = Vec::new();
        // A state that only entries lead to is where trouble ends: its edges lead back. A place
        // that nothing marks is a source.
        let mut graph = Graph { strays_last: figure.is_states, ..Graph::default() };
        for edge in &figure.edges {
            let mut label = Block::default();
            for it in &edge.labels {
                label.pause();
                label.label(it, is_hot(it));
            }
            if edge.weight > 1 {
                label.text(Face::Plain, &edge.weight.to_string(), false);
            }
            if edge.from == edge.to {
                signs[edge.from].to_itself = label.clone();
                route_of.push(None);
            } else {
                // All edges between states span two layers, so that states and labels never share
                // one.
                let size = (figure.is_states || !label.lines.is_empty())
                    .then_some((label.width + 4, label.height));
                route_of.push(Some(graph.edges.len()));
                graph.edges.push(layout::Edge { from: edge.from, to: edge.to, label: size });
            }
            labels.push(label);
        }
        let mut lines = vec![(0, 0); figure.nodes.len()];
        for edge in figure.edges.iter().filter(|edge| edge.from != edge.to) {
            lines[edge.from].0 += 1;
            lines[edge.to].1 += 1;
        }
        let more = lines.into_iter().map(|(out, into): (i64, i64)| out.max(into));
        graph.nodes = figure
            .nodes
            .iter()
            .zip(&signs)
            .zip(more)
            .map(|((it, sign), lines)| node(it, sign, lines))
            .collect();
        graph.roots = (0..signs.len()).filter(|&at| signs[at].is_initial).collect();
        let layout = layout::arrange(&graph);
        Self { figure, signs, labels, route_of, graph, layout }
    }

    /// Whether the edge stands for something that is pointed out.
    pub(super) fn is_hot(&self, edge: usize, highlight: &Highlight<'_>) -> bool {
        let it = &self.figure.edges[edge];
        let of = |node: usize| self.figure.nodes[node].transitions().any(|at| highlight.has(at));
        let labelled =
            it.labels.iter().flat_map(|label| &label.transitions).any(|&at| highlight.has(at));
        labelled || (it.flow != Flow::Read && (of(it.from) || of(it.to)))
    }
}

/// Returns the parts of a drawing that are coloured for transitions: ids of its elements, each with
/// its transitions.
pub fn parts(net: &Net<'_>, style: Style) -> Vec<(String, Vec<u32>)> {
    let figure = Figure::of(net, style);
    let edges = figure.edges.iter().enumerate().map(|(at, it)| {
        let labelled = it.labels.iter().flat_map(|label| &label.transitions).copied();
        let ends = [it.from, it.to].into_iter().filter(|_| it.flow != Flow::Read);
        let moved = ends.flat_map(|node| figure.nodes[node].transitions());
        (format!("edge-{at}"), labelled.chain(moved).collect())
    });
    let bars = figure.nodes.iter().filter_map(|it| match it.kind {
        Kind::Transition(at) => Some((format!("transition-{at}"), it.transitions().collect())),
        Kind::State(_) | Kind::Place { .. } => None,
    });
    edges.chain(bars).collect()
}

impl Highlight<'_> {
    pub(super) fn has(&self, transition: u32) -> bool {
        self.transitions.contains(&TransitionId(transition))
    }

    fn tokens(&self, net: &Net<'_>, place: usize) -> u32 {
        match self.marking {
            Some(marking) => marking.get(place).copied().unwrap_or(0),
            None => net.places[place].initial,
        }
    }
}

fn sign(net: &Net<'_>, node: &Node<'_>, highlight: &Highlight<'_>) -> Sign {
    let mut sign = Sign::default();
    let name = text::short(node.name);
    match node.kind {
        Kind::State(place) | Kind::Place { place, .. } => {
            sign.tokens = highlight.tokens(net, place);
            sign.is_initial = net.places[place].initial > 0;
            let is_marked = highlight.marking.is_some() && sign.tokens > 0;
            let is_state = matches!(node.kind, Kind::State(_));
            let chosen = highlight.places.filter(|_| !is_state);
            sign.is_hot = chosen.map_or(is_marked, |it| it.iter().any(|id| id.0 as usize == place));
            sign.text.text(Face::Plain, &name.replace(' ', "\u{a0}"), sign.is_hot);
        }
        Kind::Transition(_) => {
            sign.is_hot = node.transitions().any(|at| highlight.has(at));
            sign.text.text(Face::Strong, &name.replace(' ', "\u{a0}"), sign.is_hot);
            // An event of the same name need not be said twice.
            if let Some(label) = node.label.as_ref().filter(|label| label.to_string() != node.name)
            {
                sign.text.label(label, sign.is_hot);
            }
            for (name, label) in &node.also {
                let is_hot = label.transitions.iter().any(|&at| highlight.has(at));
                sign.text.pause();
                sign.text.text(Face::Strong, &text::short(name).replace(' ', "\u{a0}"), is_hot);
                sign.text.label(label, is_hot);
            }
        }
    }
    for entry in &node.entries {
        let is_hot = entry.label.transitions.iter().any(|&at| highlight.has(at));
        sign.entries.pause();
        sign.entries.text(Face::Sources, &entry.sources, is_hot);
        sign.entries.label(&entry.label, is_hot);
    }
    sign
}

/// The size of a node at which so many lines start, or end.
fn node(node: &Node<'_>, sign: &Sign, lines: i64) -> layout::Node {
    let crowd = (lines - 1) * PORT / 2 + 8;
    let beside = |block: &Block, arrow: i64| {
        if block.lines.is_empty() { 0 } else { arrow + SPACE + block.width }
    };
    let half = |block: &Block| (block.height + 1) / 2;
    match node.kind {
        Kind::State(_) => {
            let (least, half_height) = STATE;
            let name = text::bold_width(&text::short(node.name), text::NAME);
            let half_width = least.max(name / 2 + 14).max(crowd);
            let sides = half_height.max(half(&sign.to_itself)).max(half(&sign.entries));
            let initial = if sign.is_initial { half_height + INITIAL.0 + 2 * INITIAL.1 } else { 0 };
            layout::Node {
                outline: Outline::Rectangle(half_width, half_height),
                left: half_width + beside(&sign.entries, ENTRY),
                right: half_width + beside(&sign.to_itself, LOOP),
                up: sides.max(initial),
                down: sides,
            }
        }
        Kind::Place { .. } => layout::Node {
            outline: Outline::Circle(RADIUS),
            left: RADIUS,
            right: RADIUS + beside(&sign.text, 0),
            up: RADIUS,
            down: RADIUS,
        },
        Kind::Transition(_) => {
            let half_width = BAR.0.max(crowd);
            let half_height = BAR.1.max(half(&sign.text));
            layout::Node {
                outline: Outline::Rectangle(half_width, BAR.1),
                left: half_width,
                right: half_width + beside(&sign.text, 0),
                up: half_height,
                down: half_height,
            }
        }
    }
}
