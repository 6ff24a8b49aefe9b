//! The small nets of all proof harnesses.

use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::proofs::few;

/// The most markings that are looked at.
const MOST: usize = 12;

/// A net of two places and two transitions, each on an event of its own.
#[derive(Clone, Copy, Debug)]
pub struct Small {
    /// Tokens at the start.
    pub initial: [u32; 2],
    /// Tokens that each transition takes of each place.
    pub take: [[u32; 2]; 2],
    /// Tokens that each transition gives to each place.
    pub give: [[u32; 2]; 2],
}

fn bit() -> u32 {
    u32::from(few::<1>())
}

impl Small {
    /// Any of those with weights of one, and of two where the first transition takes from the first
    /// place.
    pub fn any() -> Self {
        let heavy = bit() + 1;
        Self {
            initial: [heavy, bit()],
            take: [[heavy * bit(), bit()], [bit(), bit()]],
            give: [[bit(), bit()], [bit(), bit()]],
        }
    }

    /// The marking after a transition: the rule of the textbook.
    pub fn fire(&self, tokens: [u32; 2], transition: usize) -> Option<[u32; 2]> {
        let (take, give) = (self.take[transition], self.give[transition]);
        let after = |place: usize| Some(tokens[place].checked_sub(take[place])? + give[place]);
        Some([after(0)?, after(1)?])
    }

    /// All reachable markings; none when there are more than a few.
    pub fn reachable(&self) -> Option<Vec<[u32; 2]>> {
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
    pub fn net(&self) -> OwnedNet {
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
