//! The budget of the checker: work, about as many arcs and terms as are examined, and memory in
//! bytes.

use crate::read::{Numbered, marking_bytes, most_markings};
use crate::{Case, Fact, Formula, Inductive, Linear, Net, Refutation, Transition};
use Formula::{And, AtMost, Exists, Finally};

type Arcs<'a> = &'a [(&'a str, u32)];

fn net(places: Arcs<'_>, transitions: &[(&str, Arcs<'_>, Arcs<'_>)]) -> Net {
    let arcs = |list: Arcs<'_>| list.iter().map(|it| (it.0.to_owned(), it.1)).collect::<Vec<_>>();
    let transitions = transitions.iter().map(|(name, take, give)| Transition {
        name: (*name).to_owned(),
        take: arcs(take),
        give: arcs(give),
        inhibit: Vec::new(),
        reset: Vec::new(),
        priority: 0,
    });
    Net { name: "net".to_owned(), places: arcs(places), transitions: transitions.collect() }
}

/// One token goes from `p` to `q` and back.
fn turn() -> Net {
    net(
        &[("p", 1), ("q", 0)],
        &[("go", &[("p", 1)], &[("q", 1)]), ("back", &[("q", 1)], &[("p", 1)])],
    )
}

/// `constant + sum of weight * tokens <= 0`
fn sum(constant: i64, weights: &[(&str, i64)]) -> Linear {
    Linear { constant, weights: weights.iter().map(|it| (it.0.to_owned(), it.1)).collect() }
}

/// Work and memory of what is done with a net.
fn counted(net: &Net, check: impl FnOnce(&Numbered<'_>)) -> (u64, u64) {
    let net = Numbered::new(net).unwrap();
    assert_eq!(net.counted(), (0, 0));
    check(&net);
    net.counted()
}

#[test]
fn a_marking_takes_160_bytes_and_4_for_each_place() {
    assert_eq!((marking_bytes(0), marking_bytes(10)), (160, 200));
    // 2^30 bytes, and 328 for each marking of nine places and the constant.
    assert_eq!(most_markings(9), 3_273_603);
}

#[test]
fn a_firing_costs_its_arcs_and_the_marking_before_it() {
    let net = net(&[("p", 3), ("q", 5)], &[("fire", &[("p", 2)], &[("p", 1), ("q", 4)])]);
    let fire = ["fire".to_owned()];
    let spent = counted(&net, |net| {
        let (way, end) = net.path(&net.initial, &fire).unwrap();
        assert_eq!((way, end), (vec![vec![1, 3, 5]], vec![1, 2, 9]));
    });
    // Whether it is enabled: 1 and one arc. The marking: 4 for each number and two arcs.
    assert_eq!(spent, (2 + 14 + 172, 172));
}

#[test]
fn passing_through_a_graph_costs_its_firings_and_its_markings() {
    let spent = counted(&turn(), |net| drop(net.graph(&net.initial, 2).unwrap()));
    // In both markings one transition is enabled, one is not; each firing is an arrow, the first
    // one leads to a new marking too.
    assert_eq!(spent, (2 * (2 + 1 + 13) + 2 * 16 + 172, 2 * 16 + 172));
}

#[test]
fn a_formula_costs_its_terms_in_each_marking() {
    let net = turn();
    let graph = counted(&net, |net| drop(net.graph(&net.initial, 2).unwrap()));
    let asked = |formula: Formula| {
        let all = counted(&net, |net| {
            let space = net.graph(&net.initial, 2).unwrap();
            net.shows(&space, (&formula, true)).unwrap();
        });
        (all.0 - graph.0, all.1 - graph.1)
    };
    // 1 and two markings; three terms in each.
    assert_eq!(asked(AtMost(sum(-1, &[("p", 1), ("q", 1)]))), (3 + 6, 0));
    // The same for the operator and for its operand of two terms; then each arrow backwards, and
    // one for looking at it.
    let there = AtMost(sum(1, &[("q", -1)]));
    assert_eq!(asked(Exists(Box::new(Finally(Box::new(there))))), (3 + 3 + 4 + 2 * 2, 0));
}

#[test]
fn a_refutation_costs_its_arcs_its_inequalities_and_its_sums() {
    let start: Arcs<'_> = &[("a", 1), ("b", 1), ("c", 0)];
    let net = net(
        start,
        &[
            ("count", &[("a", 1), ("b", 1)], &[("a", 1), ("b", 1), ("c", 1)]),
            ("never", &[("a", 2), ("b", 1)], &[]),
        ],
    );
    let by = Refutation {
        dead: vec![("never".to_owned(), vec![Case::Contradiction(vec![(0, 1), (1, 1), (2, 1)])])],
        facts: vec![Fact::AtMost(sum(-2, &[("a", 1), ("b", 1)]))],
        cases: vec![Case::Contradiction(vec![(0, 1), (1, 1)])],
    };
    let goal = AtMost(sum(3, &[("a", -1)]));
    let spent = counted(&net, |net| net.refute(&net.initial, (&goal, true), &by).unwrap());
    // The fact: for each transition 1, its arcs, the transitions that never fire. What enables
    // `never`: 256 bytes for each place and 256 more. Three inequalities of one place: 128 bytes
    // each. Adding up: 1 and the terms of each.
    let (fact, enabling, assumed, sums) = (7 + 4, 768, 3 * 128, (4 + 3 + 3) + (4 + 3));
    assert_eq!(spent, (fact + enabling + assumed + sums, enabling + assumed));
}

#[test]
fn a_kept_formula_costs_its_size_before_each_transition() {
    let one =
        And(vec![AtMost(sum(-1, &[("p", 1), ("q", 1)])), AtMost(sum(1, &[("p", -1), ("q", -1)]))]);
    let by = Refutation {
        dead: Vec::new(),
        facts: vec![Fact::Inductive(Inductive { holds: one, kept: Vec::new() })],
        cases: vec![Case::Contradiction(vec![(0, 1), (2, 1)])],
    };
    let goal = AtMost(sum(2, &[("p", -1)]));
    let spent = counted(&turn(), |net| net.refute(&net.initial, (&goal, true), &by).unwrap());
    // At the start: 2 for the `and`, for each part 2 and three terms. Before each transition: 192
    // for each part. Assumed: 192 bytes for each part, 128 for the goal. Adding up: 4 and 3.
    let (start, before, assumed, sums) = (2 + 2 * 5, 2 * 2 * 192, 2 * 192 + 128, 4 + 3);
    assert_eq!(spent, (start + before + assumed + sums, assumed));
}
