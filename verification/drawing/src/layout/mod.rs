//! Layered drawings of directed graphs, after Sugiyama, Tagawa and Toda (1981).
//!
//! | step | module | by |
//! | --- | --- | --- |
//! | edges against the current | [`acyclic`] | depth-first search from the roots |
//! | layers | [`rank`] | longest paths, then shorter edges |
//! | order in the layers | [`order`] | barycentres and exchanges of neighbours |
//! | places in the layers | [`coordinates`] | Brandes and Köpf (2001) |
//! | lines | [`route`] | vertical through the layers, curved between them |
//!
//! Labels are vertices of their own in a layer between the ends of their edge, so they get the
//! space they need. All lengths are pixels, downwards and to the right.

mod acyclic;
mod coordinates;
#[cfg(test)]
mod laws;
mod order;
mod rank;
mod route;

/// A graph to be laid out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    pub(crate) nodes: Vec<Node>,
    pub(crate) edges: Vec<Edge>,
    /// The nodes where reading starts; the first one is put into the first layer.
    pub(crate) roots: Vec<usize>,
    /// Whether edges from what the roots do not reach to what they reach lead upwards. Else they
    /// lead downwards.
    pub(crate) strays_last: bool,
}

/// A node with the space around its centre that nothing else may enter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) outline: Outline,
    pub(crate) left: i64,
    pub(crate) right: i64,
    pub(crate) up: i64,
    pub(crate) down: i64,
}

/// The outline of a node, at which lines end.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Outline {
    /// By half the width and half the height.
    Rectangle(i64, i64),
    /// By the radius.
    Circle(i64),
}

/// An edge, of two different nodes; edges from a node to itself are left out by the caller.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// Width and height of its label.
    pub(crate) label: Option<(i64, i64)>,
}

/// The coordinates of everything.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    /// The centres of the nodes.
    pub(crate) nodes: Vec<Point>,
    pub(crate) routes: Vec<Route>,
    pub(crate) width: i64,
    pub(crate) height: i64,
}

/// A point of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Point {
    pub(crate) x: i64,
    pub(crate) y: i64,
}

/// The way of an edge from its start to its end.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Route {
    /// One line, or two when a label stands between them.
    pub(crate) lines: Vec<Vec<Run>>,
    /// The centre of the label.
    pub(crate) label: Option<Point>,
}

/// A vertical piece of a line. The next one follows over a curve that is vertical at both ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) x: i64,
    pub(crate) from: i64,
    pub(crate) to: i64,
}

/// Above so many vertices, layers are ordered in two passes without exchanges of neighbours.
const OPTIMISED: usize = 4_000;

/// Above so many vertices, edges over several layers are drawn as one curve, across whatever is
/// there.
const SPLIT: usize = 20_000;

/// A node, or a place where an edge crosses a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Vertex {
    Node,
    Bend,
    Label,
}

/// The graph in layers: every edge is a chain of vertices, one a layer.
#[derive(Debug)]
struct Layered {
    kinds: Vec<Vertex>,
    /// By vertex: its layer.
    layer: Vec<usize>,
    /// Space to the left and to the right of each vertex, including the distance to the next one.
    left: Vec<i64>,
    right: Vec<i64>,
    /// The vertices of each layer, from left to right.
    layers: Vec<Vec<usize>>,
    /// By vertex: its neighbours in the layer above, and in the layer below. Both lists of two
    /// vertices agree.
    above: Vec<Vec<usize>>,
    below: Vec<Vec<usize>>,
    /// By edge: its vertices from the upper end to the lower end.
    chains: Vec<Vec<usize>>,
    /// By edge: whether it points upwards.
    backward: Vec<bool>,
}

/// Lays a graph out.
pub(crate) fn arrange(graph: &Graph) -> Layout {
    let position = acyclic::order(graph);
    let backward: Vec<bool> =
        graph.edges.iter().map(|edge| position[edge.from] > position[edge.to]).collect();
    let ranks = rank::ranks(graph, &position);
    let mut layered = layered(graph, &ranks, backward);
    order::reduce_crossings(&mut layered);
    let x = coordinates::assign(&layered);
    route::layout(graph, &layered, &x)
}

/// Half the least distance to what stands beside a node.
const NODE_MARGIN: i64 = 14;

/// The same beside a line or a label.
const LINE_MARGIN: i64 = 8;

fn layered(graph: &Graph, ranks: &[usize], backward: Vec<bool>) -> Layered {
    let ends =
        |edge: &Edge| (ranks[edge.from].min(ranks[edge.to]), ranks[edge.from].max(ranks[edge.to]));
    let bends: usize = graph.edges.iter().map(|edge| ends(edge).1 - ends(edge).0 - 1).sum();
    let split = graph.nodes.len() + bends <= SPLIT;
    let count = ranks.iter().max().map_or(0, |last| last + 1);
    let mut it = Layered {
        kinds: vec![Vertex::Node; graph.nodes.len()],
        layer: ranks.to_vec(),
        left: graph.nodes.iter().map(|node| node.left + NODE_MARGIN).collect(),
        right: graph.nodes.iter().map(|node| node.right + NODE_MARGIN).collect(),
        layers: vec![Vec::new(); count],
        above: Vec::new(),
        below: Vec::new(),
        chains: Vec::with_capacity(graph.edges.len()),
        backward,
    };
    let mut label_widths = vec![0; count];
    for (edge, &backward) in graph.edges.iter().zip(&it.backward) {
        let (first, last) = ends(edge);
        let label_rank = edge.label.map(|(width, _)| {
            let rank = label_rank(first, last, backward, &label_widths);
            label_widths[rank] += width;
            rank
        });
        let (upper, lower) = if backward { (edge.to, edge.from) } else { (edge.from, edge.to) };
        let mut chain = vec![upper];
        for rank in first + 1..last {
            let is_label = label_rank == Some(rank);
            if split || is_label {
                let half = edge.label.filter(|_| is_label).map_or(0, |(width, _)| (width + 1) / 2);
                chain.push(it.kinds.len());
                it.kinds.push(if is_label { Vertex::Label } else { Vertex::Bend });
                it.layer.push(rank);
                it.left.push(half + LINE_MARGIN);
                it.right.push(half + LINE_MARGIN);
            }
        }
        chain.push(lower);
        it.chains.push(chain);
    }
    it.above.resize(it.kinds.len(), Vec::new());
    it.below.resize(it.kinds.len(), Vec::new());
    for pair in it.chains.iter().flat_map(|chain| chain.windows(2)) {
        if it.layer[pair[0]] + 1 == it.layer[pair[1]] {
            it.below[pair[0]].push(pair[1]);
            it.above[pair[1]].push(pair[0]);
        }
    }
    it
}

/// Returns the layer of a label: of those that only labels stand in, the one with the fewest,
/// nearest to the start.
fn label_rank(first: usize, last: usize, backward: bool, widths: &[i64]) -> usize {
    let crossed = (first + 1..last).step_by(2);
    let by_width =
        |rank: &usize| (widths[*rank], if backward { last - rank } else { rank - first });
    crossed.min_by_key(by_width).unwrap_or(first)
}
