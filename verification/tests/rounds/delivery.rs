//! The supervisors of the delivery that are written by hand, as a net of rounds.

use cotama_models::nets::by_hand::delivery;
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{Rounds, Size, rounds};
use cotama_verification::pt::Pt;

/// The net of these rounds, and all of its markings.
pub(crate) fn explored(rounds: &Rounds) -> (Pt, Graph) {
    let pt = Pt::from(&rounds.net().unwrap().view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    (pt, graph)
}

#[test]
fn the_supervisors_by_hand_have_110346_states_between_rounds() {
    let rounds = rounds(&delivery::SYSTEM).unwrap();
    let net = rounds.net().unwrap();
    assert_eq!(net.view().net().defect(), None);
    let (pt, graph) = explored(&rounds);
    assert_eq!((pt.places.len(), pt.transitions.len()), (253, 2_566));
    assert_eq!((graph.states(), graph.arcs()), (339_854, 446_584));
    assert_eq!(
        rounds.size(&graph),
        Size {
            states: cotama_golden::figure("delivery.states"),
            edges: cotama_golden::figure("delivery.steps")
        }
    );
}
