//! Vertical coordinates and lines.

use super::{Graph, Layered, Layout, Node, Outline, Point, Route, Run, Vertex};

/// White space around the drawing.
const MARGIN: i64 = 4;

/// The least height between two layers.
const GAP: i64 = 20;

/// The most that a wide step of a line adds to it.
const STEP: i64 = 40;

/// Space that a layer adds above and below its nodes, so that arrow heads stand straight.
const HEAD: i64 = 9;

/// The distance of lines at a node, if there is room.
const PORTS: i64 = 16;

pub(super) fn layout(graph: &Graph, it: &Layered, x: &[i64]) -> Layout {
    let left = (0..x.len()).map(|at| x[at] - it.left[at]).min().unwrap_or(0);
    let right = (0..x.len()).map(|at| x[at] + it.right[at]).max().unwrap_or(0);
    let x: Vec<i64> = x.iter().map(|x| x - left + MARGIN).collect();
    let ends = ends(graph, it, &x);
    let bands = bands(graph, it, &x, &ends);
    let y = |vertex: usize| bands[it.layer[vertex]].centre;
    let nodes: Vec<Point> = (0..graph.nodes.len()).map(|at| Point { x: x[at], y: y(at) }).collect();
    let route = |edge: usize| {
        let chain = &it.chains[edge];
        let [Some(&upper), Some(&lower)] = [chain.first(), chain.last()] else {
            return Route::default();
        };
        let (start, end) = ends[edge];
        let foot = y(upper) + reach(&graph.nodes[upper], start - x[upper]);
        let mut line = vec![Run { x: start, from: foot, to: bands[it.layer[upper]].bottom }];
        let mut route = Route::default();
        for &vertex in &chain[1..chain.len() - 1] {
            let Band { top, bottom, centre } = bands[it.layer[vertex]];
            let x = x[vertex];
            let height = label_height(graph, it, edge, vertex);
            if it.kinds[vertex] == Vertex::Label {
                route.label = Some(Point { x, y: centre });
            }
            if height > 0 {
                line.push(Run { x, from: top, to: centre - height / 2 });
                route.lines.push(std::mem::take(&mut line));
                line.push(Run { x, from: centre + height - height / 2, to: bottom });
            } else {
                line.push(Run { x, from: top, to: bottom });
            }
        }
        let head = y(lower) - reach(&graph.nodes[lower], end - x[lower]);
        line.push(Run { x: end, from: bands[it.layer[lower]].top, to: head });
        route.lines.push(line);
        if it.backward[edge] {
            route.lines.reverse();
            for line in &mut route.lines {
                line.reverse();
                for run in line {
                    std::mem::swap(&mut run.from, &mut run.to);
                }
            }
        }
        route
    };
    Layout {
        routes: (0..graph.edges.len()).map(route).collect(),
        nodes,
        width: right - left + 2 * MARGIN,
        height: bands.last().map_or(0, |band| band.bottom) + MARGIN,
    }
}

/// The height that a vertex needs as the label of an edge.
fn label_height(graph: &Graph, it: &Layered, edge: usize, vertex: usize) -> i64 {
    let label = graph.edges[edge].label.filter(|_| it.kinds[vertex] == Vertex::Label);
    label.map_or(0, |(_, height)| height)
}

/// The vertical extent of a layer.
#[derive(Clone, Copy, Debug, Default)]
struct Band {
    top: i64,
    centre: i64,
    bottom: i64,
}

fn bands(graph: &Graph, it: &Layered, x: &[i64], ends: &[(i64, i64)]) -> Vec<Band> {
    let mut up = vec![0; it.layers.len()];
    let mut down = up.clone();
    let mut steps = up.clone();
    for (vertex, node) in graph.nodes.iter().enumerate() {
        let layer = it.layer[vertex];
        up[layer] = up[layer].max(node.up + HEAD);
        down[layer] = down[layer].max(node.down + HEAD);
    }
    for (edge, chain) in it.chains.iter().enumerate() {
        let last = chain.len() - 1;
        let at = |index: usize| match index {
            0 => ends[edge].0,
            index if index == last => ends[edge].1,
            index => x[chain[index]],
        };
        for index in 1..=last {
            let layer = it.layer[chain[index - 1]];
            steps[layer] = steps[layer].max((at(index) - at(index - 1)).abs());
        }
        for &vertex in chain {
            let height = label_height(graph, it, edge, vertex);
            let layer = it.layer[vertex];
            up[layer] = up[layer].max(height / 2);
            down[layer] = down[layer].max(height - height / 2);
        }
    }
    let mut next = MARGIN;
    let band = |layer: usize| {
        let (top, centre) = (next, next + up[layer]);
        let bottom = centre + down[layer];
        next = bottom + GAP + (steps[layer] / 7).min(STEP);
        Band { top, centre, bottom }
    };
    (0..it.layers.len()).map(band).collect()
}

/// By edge: the x at which it leaves its upper node and enters its lower node.
fn ends(graph: &Graph, it: &Layered, x: &[i64]) -> Vec<(i64, i64)> {
    let mut ends = vec![(0, 0); graph.edges.len()];
    let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes.len()];
    for (edge, chain) in it.chains.iter().enumerate() {
        at_node[chain[0]].push(edge);
    }
    for (node, edges) in at_node.iter_mut().enumerate() {
        let target = |edge: usize| x[it.chains[edge][1]];
        for (&edge, port) in spread(&graph.nodes[node], x[node], edges, target) {
            ends[edge].0 = port;
        }
        edges.clear();
    }
    for (edge, chain) in it.chains.iter().enumerate() {
        at_node[chain[chain.len() - 1]].push(edge);
    }
    let starts = ends.clone();
    for (node, edges) in at_node.iter_mut().enumerate() {
        let source = |edge: usize| match it.chains[edge].as_slice() {
            [_, _] => starts[edge].0,
            chain => x[chain[chain.len() - 2]],
        };
        for (&edge, port) in spread(&graph.nodes[node], x[node], edges, source) {
            ends[edge].1 = port;
        }
    }
    ends
}

/// Spreads the lines at one side of a node in the order of where they lead to, straight lines where
/// possible.
fn spread<'e>(
    node: &Node,
    centre: i64,
    edges: &'e mut [usize],
    target: impl Fn(usize) -> i64,
) -> impl Iterator<Item = (&'e usize, i64)> {
    edges.sort_by_key(|&edge| target(edge));
    let count: i64 = edges.iter().map(|_| 1).sum();
    // At a circle a line off the middle meets the rim at a slant, which is worth it for a small
    // step only.
    let (half, straight) = match node.outline {
        Outline::Rectangle(half, _) => ((half - 8).max(0), (half - 8).max(0)),
        Outline::Circle(radius) => (radius * 3 / 4, radius / 3),
    };
    let distance = PORTS.min(2 * half / (count - 1).max(1));
    let wanted = |(at, edge): (i64, &usize)| {
        let even = (2 * at - (count - 1)) * distance / 2;
        let offset = target(*edge) - centre;
        // A straight line keeps its place before others.
        let (wish, weight) = if offset.abs() <= straight { (offset, 1000) } else { (even, 1) };
        (wish - at * distance, weight)
    };
    let shifted = nearest_ascending((0..).zip(edges.iter()).map(wanted));
    let most = half - (count - 1) * distance;
    let port = move |(at, shifted): (i64, i64)| {
        centre + shifted.clamp(-half, most.max(-half)) + at * distance
    };
    let ports: Vec<i64> = (0..).zip(shifted).map(port).collect();
    edges.iter().zip(ports)
}

/// The ascending numbers nearest to given ones with weights, in least squares, by pooling adjacent
/// violators.
fn nearest_ascending(values: impl Iterator<Item = (i64, i64)>) -> Vec<i64> {
    let mut pools: Vec<(i64, i64, usize)> = Vec::new();
    for (value, weight) in values {
        pools.push((value * weight, weight, 1));
        while let [.., (sum, weight, count), (next_sum, next_weight, next_count)] =
            *pools.as_slice()
        {
            if sum * next_weight <= next_sum * weight {
                break;
            }
            pools.truncate(pools.len() - 2);
            pools.push((sum + next_sum, weight + next_weight, count + next_count));
        }
    }
    let rounded = |(sum, weight, _): (i64, i64, usize)| (2 * sum + weight).div_euclid(2 * weight);
    pools.into_iter().flat_map(|pool| std::iter::repeat_n(rounded(pool), pool.2)).collect()
}

/// How far a node reaches above and below its centre at an offset to the side.
fn reach(node: &Node, offset: i64) -> i64 {
    match node.outline {
        Outline::Rectangle(_, half) => half,
        Outline::Circle(radius) => (radius * radius - offset * offset).max(0).isqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::nearest_ascending;

    #[test]
    fn violators_are_pooled_at_their_mean() {
        let equal =
            |values: [i64; 3]| nearest_ascending(values.into_iter().map(|value| (value, 1)));
        assert_eq!(equal([1, 2, 3]), [1, 2, 3]);
        assert_eq!(equal([3, 1, 5]), [2, 2, 5]);
        assert_eq!(equal([9, 3, 0]), [4, 4, 4]);
        assert_eq!(nearest_ascending([(3, 1000), (1, 1)].into_iter()), [3, 3]);
    }
}
