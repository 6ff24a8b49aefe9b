//! The explorer against the textbook, for all nets of a small family.

use super::{Graph, Limits};
use cotama_property::pt::Pt;
use cotama_property::small::Small;

/// The explorer finds the reachable markings of the textbook and no others, each once, and from
/// each of them the steps of the textbook.
#[kani::proof]
#[kani::unwind(14)]
pub fn the_explorer_has_the_steps_of_the_textbook() {
    let small = Small::any();
    let pt = Pt::from(&small.net().view().net());
    let limits = Limits { states: 40, ..Limits::default() };
    let (graph, reachable) = (Graph::new(&pt, &limits, &|_| ()), small.reachable());
    let Ok(graph) = graph else {
        assert!(reachable.is_none());
        kani::cover!(true, "without end");
        return;
    };
    let mut found = Vec::new();
    for state in 0..graph.states() as u32 {
        let [a, b] = graph.marking(state)[..] else { unreachable!() };
        assert!(!found.contains(&[a, b]));
        found.push([a, b]);
        let mut after: Vec<_> = (0..2).filter_map(|it| small.fire([a, b], it)).collect();
        let mut arcs: Vec<_> =
            graph.successors(state).iter().map(|it| graph.marking(*it)).collect();
        after.sort_unstable();
        arcs.sort_unstable();
        assert!(after.iter().map(|it| it.to_vec()).collect::<Vec<_>>() == arcs);
    }
    assert!(found[0] == small.initial);
    if let Some(mut reachable) = reachable {
        found.sort_unstable();
        reachable.sort_unstable();
        assert!(found == reachable);
        kani::cover!(found.len() > 4, "several markings");
    }
}
