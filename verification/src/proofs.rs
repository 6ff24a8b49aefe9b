//! The executor and the explorer see the same steps.

use crate::explicit::{Graph, Limits};
use crate::pt::Pt;
use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::{Outcome, Packed, Player};
use cotama_core::system::{Component, Of, System};
use cotama_core::units::Millis;
use cotama_property::small::Small;

/// In every reachable marking of every small net, the executor fires on an event exactly where the
/// explorer has an arc, and comes to the marking where the arc leads.
#[kani::proof]
#[kani::unwind(14)]
pub fn executor_and_explorer_see_the_same_steps() {
    let small = Small::any();
    kani::assume(small.reachable().is_some());
    let owned = small.net();
    let view = owned.view();
    let net = view.net();
    let Ok(graph) = Graph::new(&Pt::from(&net), &Limits::default(), &|_| ()) else {
        unreachable!()
    };
    let components = [Component::alone(&net)];
    let system = System::alone(&components);
    let Ok(packed) = Packed::<1>::of(&system) else { unreachable!() };
    let event = |it| Of { component: 0, id: EventId(it) };
    let tokens = |player: &Player<_, 1>| vec![player.tokens(PlaceId(0)), player.tokens(PlaceId(1))];
    for state in 0..graph.states() as u32 {
        let mut player: Player<_, 1> = Player::start(packed.load(&system), Millis(0), &mut ());
        for it in graph.path(state) {
            assert!(player.offer_id(Millis(0), event(it.0), (), &mut ()).fired());
        }
        assert!(tokens(&player) == graph.marking(state));
        let arcs: Vec<_> =
            graph.transitions(state).into_iter().zip(graph.successors(state)).collect();
        for transition in 0..2 {
            let mut after = player;
            let arc = arcs.iter().find(|it| it.0.0 == transition);
            match (after.offer_id(Millis(0), event(transition), (), &mut ()), arc) {
                (Outcome::Fired { .. }, Some((_, to))) => {
                    assert!(tokens(&after) == graph.marking(**to));
                }
                (Outcome::Ignored { .. }, None) => {
                    assert!(after.marking() == player.marking());
                }
                _ => unreachable!(),
            }
        }
        kani::cover!(arcs.len() == 2 && state > 1, "both can fire");
    }
    kani::cover!(graph.states() > 3, "several markings");
}
