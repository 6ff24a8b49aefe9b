//! A net without time, in the form in which engines read it.

mod lists;
mod special;

pub use lists::Lists;
pub use special::{Extras, Special};

use cotama_core::net::{Net, PlaceId, TransitionId};
use std::sync::OnceLock;

/// A place/transition net: every order in which enabled transitions can fire.
///
/// A transition is enabled when every place of its `needs` holds the weight; firing changes the
/// places of its `effects`. Reads are needs without an effect. Lists are sorted by place.
///
/// Files can have inhibitor arcs, reset arcs and priorities besides: then there is a [`Special`].
/// Without it `needs` and `effects` are those of a larger net, in which more is enabled and no
/// place holds fewer tokens: upper bounds of that net are bounds, and nothing else that is shown of
/// it is so. Engines that read only `needs` and `effects` ask [`Pt::is_plain`] first.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::pt::Pt;
/// let door = Pt::from(&door::NET);
/// let call = door.transition("call").unwrap();
/// assert!(door.enabled(&door.initial, call.0));
/// let next = door.fire(&door.initial, call.0).unwrap();
/// let opening = door.place("Opening").unwrap();
/// assert_eq!((door.initial[opening.0 as usize], next[opening.0 as usize]), (0, 1));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pt {
    /// The name of the net.
    pub name: String,
    /// Names of places.
    pub places: Vec<String>,
    /// Names of transitions.
    pub transitions: Vec<String>,
    /// Tokens at the start.
    pub initial: Vec<u32>,
    /// For each transition the tokens it needs.
    pub needs: Lists<u32>,
    /// For each transition how it changes places; never by zero.
    pub effects: Lists<i64>,
    /// For each place the transitions that need it, and how many tokens.
    pub consumers: Lists<u32>,
    /// For each place the transitions that change it, and by how much.
    pub changers: Lists<i64>,
    /// How many arcs the net has, a read counted as two, as in PNML.
    pub arcs: usize,
    /// Inhibitor arcs, reset arcs and priorities, if it has some.
    pub special: Option<Box<Special>>,
    /// Bounds from the structure, once they were asked for.
    pub bounds: Bounds,
}

/// The bounds of places that the structure of a net proves, so that they are computed once. A copy
/// of the net may be changed, so it knows nothing yet; and what is known of two nets is no
/// difference between them.
#[derive(Debug, Default)]
pub struct Bounds(OnceLock<Vec<Option<u32>>>);

impl Bounds {
    /// Returns the bounds by place, `None` where there is none, if they were computed.
    pub fn get(&self) -> Option<&[Option<u32>]> {
        self.0.get().map(Vec::as_slice)
    }

    /// Stores bounds by place, unless there are some, and returns those that are stored.
    pub fn get_or_store(&self, found: Vec<Option<u32>>) -> &[Option<u32>] {
        self.0.get_or_init(|| found)
    }
}

impl Clone for Bounds {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Bounds {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Bounds {}

impl From<&Net<'_>> for Pt {
    fn from(net: &Net<'_>) -> Self {
        let needs = Lists::new(net.transitions.iter().map(|it| {
            let mut needs: Vec<_> =
                it.take.iter().chain(it.read).map(|arc| (arc.place.0, arc.weight)).collect();
            needs.sort_unstable();
            // A place that is both taken and read needs the larger weight.
            needs.dedup_by(|later, kept| {
                later.0 == kept.0 && {
                    kept.1 = kept.1.max(later.1);
                    true
                }
            });
            needs
        }));
        let effects = Lists::new(net.transitions.iter().map(|it| {
            let taken = it.take.iter().map(|arc| (arc.place.0, -i64::from(arc.weight)));
            let mut effects: Vec<_> = taken
                .chain(it.give.iter().map(|arc| (arc.place.0, i64::from(arc.weight))))
                .collect();
            effects.sort_unstable_by_key(|&(place, _)| place);
            effects.dedup_by(|later, kept| {
                later.0 == kept.0 && {
                    kept.1 += later.1;
                    true
                }
            });
            effects.retain(|&(_, change)| change != 0);
            effects
        }));
        let (consumers, changers) =
            (needs.reversed(net.places.len()), effects.reversed(net.places.len()));
        Self {
            name: net.name.to_owned(),
            places: net.places.iter().map(|it| it.name.to_owned()).collect(),
            transitions: net.transitions.iter().map(|it| it.name.to_owned()).collect(),
            initial: net.places.iter().map(|it| it.initial).collect(),
            needs,
            effects,
            consumers,
            changers,
            arcs: net
                .transitions
                .iter()
                .map(|it| it.take.len() + 2 * it.read.len() + it.give.len())
                .sum(),
            special: None,
            bounds: Bounds::default(),
        }
    }
}

impl Pt {
    /// A net with what goes beyond it.
    pub fn extended(net: &Net<'_>, extras: &Extras) -> Self {
        let plain = Self::from(net);
        if extras.is_empty() {
            return plain;
        }
        let given = |transition: u32, place: u32| {
            let give = net.transitions.get(transition as usize).map_or(&[][..], |it| it.give);
            let weights = give.iter().filter(|it| it.place.0 == place).map(|it| it.weight);
            weights.fold(0, u32::saturating_add)
        };
        let special = Special::new(extras, net.transitions.len(), given);
        let arcs = plain.arcs + extras.inhibitors.len() + extras.resets.len();
        Self { arcs, special: Some(Box::new(special)), ..plain }
    }

    /// The same where no transition goes before another one; `None` where none does.
    pub fn without_priorities(&self) -> Option<Self> {
        let special = self.special.as_ref().filter(|it| it.has_priorities())?;
        let special = Some(Box::new(special.without_priorities())).filter(|it| !it.is_empty());
        Some(Self { special, ..self.clone() })
    }

    /// Whether needs and effects say all: it has no inhibitor arcs, reset arcs and priorities.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.special.is_none()
    }

    /// Whether a transition is enabled.
    #[inline]
    pub fn enabled(&self, marking: &[u32], transition: u32) -> bool {
        self.enables(&|place| marking[place as usize].into(), transition)
    }

    /// Whether a transition is enabled where places hold these tokens.
    pub fn enables(&self, tokens: &impl Fn(u32) -> u64, transition: u32) -> bool {
        let is_ready = |it: u32| {
            let needs = self.needs.of(it).iter();
            needs.into_iter().all(|&(place, need)| tokens(place) >= need.into())
        };
        is_ready(transition)
            && self.special.as_ref().is_none_or(|special| {
                let is_enabled = |it: u32| is_ready(it) && special.is_free(it, tokens);
                special.is_free(transition, tokens) && !special.before(transition).any(is_enabled)
            })
    }

    /// Fires an enabled transition; `None` when a place would hold more than 4,294,967,295 tokens.
    #[inline]
    pub fn fire(&self, marking: &[u32], transition: u32) -> Option<Vec<u32>> {
        let mut after = marking.to_vec();
        let resets = self.resets(transition);
        for &(place, change) in self.effects.of(transition) {
            if resets.iter().any(|it| it.0 == place) {
                continue;
            }
            let tokens = &mut after[place as usize];
            *tokens = u32::try_from(i64::from(*tokens) + change).ok()?;
        }
        for &(place, left) in resets {
            after[place as usize] = left;
        }
        Some(after)
    }

    /// The places that keep a transition from firing, and how many tokens do.
    #[inline]
    pub fn inhibits(&self, transition: u32) -> &[(u32, u32)] {
        self.special.as_ref().map_or(&[], |it| it.inhibits(transition))
    }

    /// The places that a transition empties, and the tokens that it then gives there.
    #[inline]
    pub fn resets(&self, transition: u32) -> &[(u32, u32)] {
        self.special.as_ref().map_or(&[], |it| it.resets(transition))
    }

    /// Whether a firing of some transition empties a place.
    #[inline]
    pub fn has_resets(&self) -> bool {
        self.special.as_ref().is_some_and(|it| it.has_resets())
    }

    /// The place of this name.
    pub fn place(&self, name: &str) -> Option<PlaceId> {
        self.places.iter().position(|it| it == name).map(|at| PlaceId(at as u32))
    }

    /// The transition of this name.
    pub fn transition(&self, name: &str) -> Option<TransitionId> {
        self.transitions.iter().position(|it| it == name).map(|at| TransitionId(at as u32))
    }
}
