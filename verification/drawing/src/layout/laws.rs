//! Properties of the layout of any graph.

use super::{Edge, Graph, Layout, Node, Outline, Point, Run, arrange};
use proptest::prelude::*;

/// Left, top, right, bottom.
type Area = [i64; 4];

fn apart(one: Area, other: Area) -> bool {
    one[2] <= other[0] || other[2] <= one[0] || one[3] <= other[1] || other[3] <= one[1]
}

fn around(node: &Node, at: Point) -> Area {
    [at.x - node.left, at.y - node.up, at.x + node.right, at.y + node.down]
}

fn labels(graph: &Graph, layout: &Layout) -> Vec<Area> {
    let sizes = graph.edges.iter().map(|edge| edge.label);
    let area = |(size, at): (Option<(i64, i64)>, Option<Point>)| {
        let ((width, height), Point { x, y }) = (size?, at?);
        Some([x - width / 2, y - height / 2, x + width / 2, y + height / 2])
    };
    sizes.zip(layout.routes.iter().map(|route| route.label)).filter_map(area).collect()
}

fn check(graph: &Graph, layout: &Layout) {
    let nodes: Vec<Area> =
        graph.nodes.iter().zip(&layout.nodes).map(|(node, &at)| around(node, at)).collect();
    let labels = labels(graph, layout);
    assert_eq!(labels.len(), graph.edges.iter().filter(|edge| edge.label.is_some()).count());
    let areas: Vec<Area> = nodes.iter().chain(&labels).copied().collect();
    for (at, &one) in areas.iter().enumerate() {
        assert!(
            one[0] >= 0 && one[1] >= 0 && one[2] <= layout.width && one[3] <= layout.height,
            "{one:?} is outside"
        );
        areas[..at]
            .iter()
            .for_each(|&other| assert!(apart(one, other), "{one:?} and {other:?} overlap"));
    }
    for (edge, route) in graph.edges.iter().zip(&layout.routes) {
        let own = |at: &usize| *at != edge.from && *at != edge.to;
        let foreign: Vec<Area> = (0..nodes.len())
            .filter(own)
            .map(|at| nodes[at])
            .chain(labels.iter().copied())
            .collect();
        let free = |area: Area| {
            for &it in &foreign {
                assert!(apart(area, it), "a line crosses {it:?}");
            }
        };
        for line in &route.lines {
            for &Run { x, from, to } in line {
                free([x, from.min(to), x, from.max(to)]);
            }
            for pair in line.windows(2) {
                let (one, other) = (pair[0], pair[1]);
                free([
                    one.x.min(other.x),
                    one.to.min(other.from),
                    one.x.max(other.x),
                    one.to.max(other.from),
                ]);
            }
        }
        touches(&graph.nodes[edge.from], layout.nodes[edge.from], route.lines[0][0], |run| {
            run.from
        });
        let last = route.lines.last().and_then(|line| line.last()).copied().unwrap();
        touches(&graph.nodes[edge.to], layout.nodes[edge.to], last, |run| run.to);
    }
}

/// A line ends at the outline of its node, to within the rounding of a root.
fn touches(node: &Node, at: Point, run: Run, end: fn(Run) -> i64) {
    let (aside, along) = ((run.x - at.x).abs(), (end(run) - at.y).abs());
    match node.outline {
        Outline::Rectangle(wide, high) => assert!(aside <= wide && along == high),
        Outline::Circle(radius) => {
            let square = |it: i64| it * it + aside * aside;
            assert!(square(along) <= radius * radius && square(along + 1) > radius * radius);
        }
    }
}

fn any_graph() -> impl Strategy<Value = Graph> {
    let outline = prop_oneof![
        (17..80_i64, 4..20_i64).prop_map(|(wide, high)| Outline::Rectangle(wide, high)),
        (10..20_i64).prop_map(Outline::Circle),
    ];
    let node = (outline, 0..90_i64, 0..90_i64, 0..30_i64, 0..30_i64).prop_map(
        |(outline, left, right, up, down)| {
            let (wide, high) = match outline {
                Outline::Rectangle(wide, high) => (wide, high),
                Outline::Circle(radius) => (radius, radius),
            };
            Node {
                outline,
                left: wide + left,
                right: wide + right,
                up: high + up,
                down: high + down,
            }
        },
    );
    proptest::collection::vec(node, 1..25).prop_flat_map(|nodes| {
        let count = nodes.len();
        let label = proptest::option::of(
            (1..80_i64, 1..40_i64).prop_map(|(wide, high)| (2 * wide, 2 * high)),
        );
        let edge =
            (0..count, 0..count, label).prop_map(|(from, to, label)| Edge { from, to, label });
        let edges = proptest::collection::vec(edge, 0..60);
        let roots = proptest::collection::btree_set(0..count, 0..4);
        (Just(nodes), edges, roots, any::<bool>()).prop_map(
            |(nodes, mut edges, roots, strays_last)| {
                edges.retain(|edge| edge.from != edge.to);
                Graph { nodes, edges, roots: roots.into_iter().collect(), strays_last }
            },
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn nothing_overlaps_and_no_line_crosses_a_node_or_a_label(graph in any_graph()) {
        check(&graph, &arrange(&graph));
    }
}
