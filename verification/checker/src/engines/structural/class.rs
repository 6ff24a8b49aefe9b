//! Classes of nets for which the structure says much.

use cotama_property::pt::Pt;

/// To which of the classical classes a net belongs. All of them ask that every weight is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "the classes overlap")]
pub struct Class {
    /// Every weight is one.
    pub ordinary: bool,
    /// Every transition takes one token and gives one.
    pub state_machine: bool,
    /// Every place has one transition that takes its tokens and one that gives them.
    pub marked_graph: bool,
    /// If two transitions share a place that they take tokens from, it is the only one of both.
    pub free_choice: bool,
    /// If two transitions share a place that they take tokens from, they share all.
    pub extended_free_choice: bool,
    /// If two places share a transition that takes from them, all those of one also take from the
    /// other.
    pub asymmetric_choice: bool,
}

/// The classes of a net. A read arc counts as one that takes a token and one that gives it back.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{pt::Pt, structural::class};
///
/// let mut lamp = OwnedNet::new("lamp", "");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("break").take(off, 1)).unwrap();
/// let class = class(&Pt::from(&lamp.view().net()));
/// assert!(class.free_choice && !class.state_machine && !class.marked_graph);
/// ```
pub fn class(pt: &Pt) -> Class {
    let transitions = 0..pt.transitions.len() as u32;
    let places = 0..pt.places.len() as u32;
    let needs = |transition| pt.needs.of(transition);
    // The tokens that a transition puts into a place: those it needs of it and the change.
    let gives = |transition: u32| {
        let needed = move |place| {
            needs(transition).iter().find(|it| it.0 == place).map_or(0, |it| i64::from(it.1))
        };
        let changed = move |place: u32| pt.effects.of(transition).iter().any(|it| it.0 == place);
        let kept = needs(transition)
            .iter()
            .filter(move |it| !changed(it.0))
            .map(|it| (it.0, i64::from(it.1)));
        let effects = pt.effects.of(transition).iter();
        effects
            .map(move |&(place, by)| (place, needed(place) + by))
            .chain(kept)
            .filter(|it| it.1 > 0)
    };
    let ordinary = transitions
        .clone()
        .all(|it| needs(it).iter().all(|arc| arc.1 == 1) && gives(it).all(|arc| arc.1 == 1));
    if !ordinary {
        return Class::default();
    }
    let mut producers = vec![0_u32; pt.places.len()];
    for (place, _) in transitions.clone().flat_map(gives) {
        producers[place as usize] += 1;
    }
    let choices = || places.clone().map(|it| pt.consumers.of(it)).filter(|it| it.len() > 1);
    let same =
        |a: &[(u32, u32)], b: &[(u32, u32)]| a.iter().map(|it| it.0).eq(b.iter().map(|it| it.0));
    let within = |a: &[(u32, u32)], b: &[(u32, u32)]| {
        a.iter().all(|it| b.binary_search_by_key(&it.0, |it| it.0).is_ok())
    };
    Class {
        ordinary,
        state_machine: transitions.clone().all(|it| needs(it).len() == 1 && gives(it).count() == 1),
        marked_graph: places
            .clone()
            .all(|it| pt.consumers.of(it).len() == 1 && producers[it as usize] == 1),
        free_choice: choices().all(|them| them.iter().all(|it| needs(it.0).len() == 1)),
        extended_free_choice: choices()
            .all(|them| them.iter().all(|it| same(needs(it.0), needs(them[0].0)))),
        asymmetric_choice: transitions.clone().all(|it| {
            let mut sets: Vec<_> = needs(it).iter().map(|arc| pt.consumers.of(arc.0)).collect();
            sets.sort_by_key(|it| it.len());
            sets.windows(2).all(|pair| within(pair[0], pair[1]))
        }),
    }
}
