//! Layers: every edge leads downwards, and not farther than it must.

use super::Graph;

/// How often nodes are moved towards their neighbours.
const ROUNDS: usize = 16;

/// By node: its layer. An edge with a label spans two layers at least, others one.
pub(super) fn ranks(graph: &Graph, position: &[usize]) -> Vec<usize> {
    let mut above = vec![Vec::new(); graph.nodes.len()];
    let mut below = vec![Vec::new(); graph.nodes.len()];
    for edge in &graph.edges {
        let span = if edge.label.is_some() { 2 } else { 1 };
        let is_forward = position[edge.from] < position[edge.to];
        let (upper, lower) = if is_forward { (edge.from, edge.to) } else { (edge.to, edge.from) };
        above[lower].push((upper, span));
        below[upper].push((lower, span));
    }
    let mut order: Vec<usize> = (0..graph.nodes.len()).collect();
    order.sort_unstable_by_key(|&node| position[node]);
    let mut ranks = vec![0_usize; graph.nodes.len()];
    let lowest =
        |node: usize, ranks: &[usize]| above[node].iter().map(|&(it, span)| ranks[it] + span).max();
    for &node in &order {
        ranks[node] = lowest(node, &ranks).unwrap_or(0);
    }
    // A node with more edges downwards than upwards shortens more than it lengthens by moving down.
    for _ in 0..ROUNDS {
        let before = ranks.clone();
        for &node in order.iter().rev().chain(&order) {
            let least = lowest(node, &ranks);
            let most = below[node].iter().map(|&(it, span)| ranks[it] - span).min();
            ranks[node] = match (least, most) {
                _ if graph.roots.first() == Some(&node) => ranks[node],
                (least, Some(most)) if below[node].len() > above[node].len() => {
                    most.max(least.unwrap_or(0))
                }
                (Some(least), _) if above[node].len() > below[node].len() => least,
                _ => ranks[node],
            };
        }
        if ranks == before {
            break;
        }
    }
    ranks
}
