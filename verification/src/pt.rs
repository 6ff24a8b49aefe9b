//! A net without time and priorities, in the form in which engines read it.

use cotama_core::net::{Net, PlaceId, TransitionId};
use std::sync::OnceLock;

/// A place/transition net: every order in which enabled transitions can fire.
///
/// A transition is enabled when every place of its `needs` holds the weight; firing changes the
/// places of its `effects`. Reads are needs without an effect. Lists are sorted by place.
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
    /// What its structure says of bounds, once somebody has asked.
    pub bounds: Bounds,
}

/// What [`bounds`](crate::bounds::bounds) found of a net, so that it is looked for once. A copy of
/// the net may be changed, so it knows nothing yet; and what is known of two nets is no difference
/// between them.
#[derive(Debug, Default)]
pub struct Bounds(pub(crate) OnceLock<Vec<Option<u32>>>);

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

/// Lists of ids with a weight each, one list after the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lists<T> {
    starts: Vec<u32>,
    items: Vec<(u32, T)>,
}

impl<T: Copy> Lists<T> {
    /// Puts lists together.
    pub fn new<I: IntoIterator<Item = (u32, T)>>(lists: impl IntoIterator<Item = I>) -> Self {
        let mut all = Self { starts: vec![0], items: Vec::new() };
        for list in lists {
            all.items.extend(list);
            all.starts.push(all.items.len() as u32);
        }
        all
    }

    /// The list at this position; empty beyond the last.
    #[inline]
    pub fn of(&self, at: u32) -> &[(u32, T)] {
        match (self.starts.get(at as usize), self.starts.get(at as usize + 1)) {
            (Some(&start), Some(&end)) => {
                self.items.get(start as usize..end as usize).unwrap_or(&[])
            }
            _ => &[],
        }
    }

    /// Bytes.
    pub(crate) fn size(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.items[..])
    }

    /// How many lists there are.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no list.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same seen from the other side: for each of `count` ids the lists that it is in.
    #[must_use]
    pub fn reversed(&self, count: usize) -> Self {
        let mut sizes = vec![0_u32; count + 1];
        for &(id, _) in &self.items {
            sizes[id as usize + 1] += 1;
        }
        for at in 0..count {
            sizes[at + 1] += sizes[at];
        }
        let starts = sizes.clone();
        let Some(&first) = self.items.first() else { return Self { starts, items: Vec::new() } };
        let mut items = vec![first; self.items.len()];
        for list in 0..self.len() as u32 {
            for &(id, weight) in self.of(list) {
                let slot = &mut sizes[id as usize];
                items[*slot as usize] = (list, weight);
                *slot += 1;
            }
        }
        Self { starts, items }
    }
}

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
            bounds: Bounds::default(),
        }
    }
}

impl Pt {
    /// Whether a transition is enabled.
    pub fn enabled(&self, marking: &[u32], transition: u32) -> bool {
        self.needs.of(transition).iter().all(|&(place, tokens)| marking[place as usize] >= tokens)
    }

    /// Fires an enabled transition; `None` when a place would hold more than 4,294,967,295 tokens.
    pub fn fire(&self, marking: &[u32], transition: u32) -> Option<Vec<u32>> {
        let mut after = marking.to_vec();
        for &(place, change) in self.effects.of(transition) {
            let tokens = &mut after[place as usize];
            *tokens = u32::try_from(i64::from(*tokens) + change).ok()?;
        }
        Some(after)
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
