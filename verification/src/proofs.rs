//! The executor and the explorer see the same steps; and the small nets of all harnesses here.

use crate::explicit::{Graph, Limits};
use crate::pt::Pt;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::{Outcome, Packed, Player};
use cotama_core::proofs::few;
use cotama_core::system::{Component, Of, System};
use cotama_core::units::Millis;

/// The most markings that are looked at.
const MOST: usize = 12;

/// A net of two places and two transitions, each on an event of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Small {
    /// Tokens at the start.
    pub(crate) initial: [u32; 2],
    /// What each transition takes of each place, and what it gives.
    pub(crate) take: [[u32; 2]; 2],
    /// What each transition gives to each place.
    pub(crate) give: [[u32; 2]; 2],
}

fn bit() -> u32 {
    u32::from(few::<1>())
}

impl Small {
    /// Any of those with weights of one, and of two where the first transition takes from the first
    /// place.
    pub(crate) fn any() -> Self {
        let heavy = bit() + 1;
        Self {
            initial: [heavy, bit()],
            take: [[heavy * bit(), bit()], [bit(), bit()]],
            give: [[bit(), bit()], [bit(), bit()]],
        }
    }

    /// The marking after a transition: the rule of the textbook.
    pub(crate) fn fire(&self, tokens: [u32; 2], transition: usize) -> Option<[u32; 2]> {
        let (take, give) = (self.take[transition], self.give[transition]);
        let after = |place: usize| Some(tokens[place].checked_sub(take[place])? + give[place]);
        Some([after(0)?, after(1)?])
    }

    /// All reachable markings; none when there are more than a few.
    pub(crate) fn reachable(&self) -> Option<Vec<[u32; 2]>> {
        let (mut all, mut next) = (vec![self.initial], 0);
        while let Some(&marking) = all.get(next) {
            next += 1;
            for after in [0, 1].into_iter().filter_map(|it| self.fire(marking, it)) {
                if !all.contains(&after) {
                    all.push(after);
                }
            }
            if all.len() > MOST {
                return None;
            }
        }
        Some(all)
    }

    /// As a net with names.
    pub(crate) fn net(&self) -> OwnedNet {
        let mut net = OwnedNet::new("small", "");
        for (name, initial) in ["a", "b"].into_iter().zip(self.initial) {
            net.place(OwnedPlace::new(name, initial)).expect("a place");
        }
        for (at, name) in ["t", "u"].into_iter().enumerate() {
            let event = net.event(name, "").expect("an event");
            let mut transition = OwnedTransition::new(name).on(event);
            for place in 0..2 {
                let id = PlaceId(place as u32);
                if self.take[at][place] > 0 {
                    transition = transition.take(id, self.take[at][place]);
                }
                if self.give[at][place] > 0 {
                    transition = transition.give(id, self.give[at][place]);
                }
            }
            net.transition(transition).expect("a transition");
        }
        net
    }
}

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
        for it in graph.way(state) {
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
