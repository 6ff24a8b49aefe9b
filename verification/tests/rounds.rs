//! A system as a net that acts in rounds does what its player does.
#![allow(missing_docs)]

use cotama_models::cotama::decision;
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{Size, rounds};
use cotama_verification::pt::Pt;

#[test]
fn the_decisional_level_has_4166_states_between_rounds() {
    let rounds = rounds(&decision::SYSTEM).unwrap();
    let net = rounds.net().unwrap();
    assert_eq!(net.view().net().defect(), None);
    println!("{} places {} transitions", net.places.len(), net.transitions.len());
    let pt = Pt::from(&net.view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    println!("{} {}", graph.states(), graph.arcs());
    assert_eq!(rounds.size(&graph), Size { states: 4_166, edges: 22_810 });
}
