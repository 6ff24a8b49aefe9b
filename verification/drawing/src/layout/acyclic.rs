//! An order of the nodes that few edges go against.

use super::Graph;

/// By node: its position. An edge goes with the current when it leads to a higher position.
///
/// The roots come first, then what they reach; before or after that, as [`Graph::strays_last`]
/// says, the rest. Against the order go the edges into roots, and those that close a cycle of a
/// depth-first search.
pub(super) fn order(graph: &Graph) -> Vec<usize> {
    let mut is_root = vec![false; graph.nodes.len()];
    graph.roots.iter().for_each(|&root| is_root[root] = true);
    let mut next = vec![Vec::new(); graph.nodes.len()];
    for edge in graph.edges.iter().filter(|edge| !is_root[edge.to]) {
        next[edge.from].push(edge.to);
    }
    let mut seen = vec![false; graph.nodes.len()];
    let mut reached = finished(&next, graph.roots.iter().copied(), &mut seen);
    let mut rest = finished(&next, 0..graph.nodes.len(), &mut seen);
    // Turned around, every node comes after all that leads to it, cycles aside.
    reached.reverse();
    rest.reverse();
    let (middle, last) = if graph.strays_last { (reached, rest) } else { (rest, reached) };
    let others = middle.into_iter().chain(last).filter(|&node| !is_root[node]);
    let mut position = vec![0; graph.nodes.len()];
    for (at, node) in graph.roots.iter().copied().chain(others).enumerate() {
        position[node] = at;
    }
    position
}

/// Nodes in the order in which a depth-first search leaves them.
fn finished(
    next: &[Vec<usize>],
    starts: impl Iterator<Item = usize>,
    seen: &mut [bool],
) -> Vec<usize> {
    let mut finished = Vec::new();
    for start in starts {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut path = vec![(start, 0)];
        while let Some(&mut (node, ref mut at)) = path.last_mut() {
            if let Some(&to) = next[node].get(*at) {
                *at += 1;
                if !std::mem::replace(&mut seen[to], true) {
                    path.push((to, 0));
                }
            } else {
                finished.push(node);
                path.pop();
            }
        }
    }
    finished
}
