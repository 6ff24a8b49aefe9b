//! Siphons, which stay empty once they are, and traps, which stay marked once they are.

use super::certificate::{DeadTransitions, Trap};
use super::work::{Cost, Work};
use super::{Effort, Limit, Limits};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::{Lists, Pt};

/// Which places transitions leave tokens in, beside what [`Pt`] knows.
#[derive(Clone, Debug)]
pub(super) struct Graph<'a> {
    pub(super) pt: &'a Pt,
    /// For each transition the places that hold a token after it has fired, whatever they held
    /// before.
    gives: Lists<i64>,
    /// The same seen from the places.
    producers: Lists<i64>,
    can_fire: Vec<bool>,
}

/// Places that have something to do with each other.
pub(super) type Places = Vec<bool>;

impl<'a> Graph<'a> {
    pub(super) fn new(pt: &'a Pt, dead: &DeadTransitions) -> Self {
        let transitions = 0..pt.transitions.len() as u32;
        let gives = Lists::new(transitions.clone().map(|transition| {
            let (needs, effects) = (pt.needs.of(transition), pt.effects.of(transition));
            let find = |list: &[(u32, u32)], place| {
                list.binary_search_by_key(&place, |it: &(u32, u32)| it.0).map_or(0, |at| list[at].1)
            };
            let mut left: Vec<_> = effects
                .iter()
                .map(|&(place, by)| (place, i64::from(find(needs, place)) + by))
                .collect();
            let changed = |place| effects.binary_search_by_key(&place, |it| it.0).is_ok();
            left.extend(
                needs.iter().filter(|it| !changed(it.0)).map(|&(place, need)| (place, need.into())),
            );
            left.retain(|it| it.1 > 0);
            left.sort_unstable();
            left
        }));
        let producers = gives.reversed(pt.places.len());
        let can_fire = transitions.map(|it| dead.can_fire(TransitionId(it))).collect();
        Self { pt, gives, producers, can_fire }
    }

    /// The greatest trap among these places: the places that are no part of it are taken out.
    pub(super) fn greatest_trap(&self, places: &mut Places) {
        let needless = |transition: u32, places: &Places| {
            !self.gives.of(transition).iter().any(|it| places[it.0 as usize])
        };
        let mut suspects: Vec<u32> =
            (0..places.len() as u32).filter(|&it| places[it as usize]).collect();
        // A place is no part if a transition takes tokens from it and leaves none in the trap.
        suspects.retain(|&place| {
            self.pt.changers.of(place).iter().any(|&(transition, by)| {
                by < 0 && self.can_fire[transition as usize] && needless(transition, places)
            })
        });
        while let Some(place) = suspects.pop() {
            if !std::mem::take(&mut places[place as usize]) {
                continue;
            }
            for &(transition, _) in self.producers.of(place) {
                if self.can_fire[transition as usize] && needless(transition, places) {
                    let taken =
                        self.pt.effects.of(transition).iter().filter(|it| it.1 < 0).map(|it| it.0);
                    suspects.extend(taken.filter(|&it| places[it as usize]));
                }
            }
        }
        debug_assert!(
            (0..self.pt.transitions.len() as u32).all(|it| {
                let takes = |it: &(u32, i64)| it.1 < 0 && places[it.0 as usize];
                let effects = self.pt.effects.of(it);
                !self.can_fire[it as usize] || !effects.iter().any(takes) || !needless(it, places)
            }),
            "what takes tokens from a trap leaves some in it"
        );
    }

    /// The greatest siphon among these places: the places that are no part of it are taken out.
    pub(super) fn greatest_siphon(&self, places: &mut Places) {
        let free = |transition: u32, places: &Places| {
            !self.pt.needs.of(transition).iter().any(|it| places[it.0 as usize])
        };
        let mut suspects: Vec<u32> =
            (0..places.len() as u32).filter(|&it| places[it as usize]).collect();
        // A place is no part if a transition adds tokens to it and needs none of the siphon.
        suspects.retain(|&place| {
            self.pt.changers.of(place).iter().any(|&(transition, by)| {
                by > 0 && self.can_fire[transition as usize] && free(transition, places)
            })
        });
        while let Some(place) = suspects.pop() {
            if !std::mem::take(&mut places[place as usize]) {
                continue;
            }
            for &(transition, _) in self.pt.consumers.of(place) {
                if self.can_fire[transition as usize] && free(transition, places) {
                    let added =
                        self.pt.effects.of(transition).iter().filter(|it| it.1 > 0).map(|it| it.0);
                    suspects.extend(added.filter(|&it| places[it as usize]));
                }
            }
        }
    }

    fn marked(&self, places: &Places) -> bool {
        self.pt.initial.iter().zip(places).any(|(&tokens, &within)| within && tokens > 0)
    }

    /// A trap among these places that is marked at the start, and no marked trap within it has
    /// fewer places.
    ///
    /// # Errors
    /// Time is up; when work is, the trap may be larger than need be.
    pub(super) fn marked_trap(
        &self,
        mut places: Places,
        work: &mut Work,
    ) -> Result<Option<Trap>, Limit> {
        work.pass(self.pt.arcs + places.len())?;
        self.greatest_trap(&mut places);
        if !self.marked(&places) {
            return Ok(None);
        }
        let mut end = Ok(());
        let order: Vec<usize> = (0..places.len()).filter(|&it| places[it]).collect();
        shrink(&mut places, &order, |fewer| {
            end = work.spend(self.pt.arcs);
            end.as_ref().ok()?;
            self.greatest_trap(fewer);
            Some(self.marked(fewer))
        });
        match end {
            Err(Limit::Time) => Err(Limit::Time),
            _ => Ok(Some(Trap { places: ids(&places) })),
        }
    }
}

/// Takes places out in this order as long as what is left, made smaller by `close`, is still what
/// is wanted: first many at once, then single ones. `None` from `close` ends it early, and so does
/// this.
fn shrink(
    places: &mut Places,
    order: &[usize],
    mut close: impl FnMut(&mut Places) -> Option<bool>,
) -> Option<()> {
    let mut open = vec![order];
    while let Some(some) = open.pop() {
        if !some.iter().any(|&it| places[it]) {
            continue;
        }
        let mut fewer = places.clone();
        for &place in some {
            fewer[place] = false;
        }
        if close(&mut fewer)? {
            *places = fewer;
        } else if some.len() > 1 {
            let (first, second) = some.split_at(some.len() / 2);
            open.extend([second, first]);
        }
    }
    Some(())
}

fn ids(places: &Places) -> Vec<PlaceId> {
    (0..places.len()).filter(|&it| places[it]).map(|it| PlaceId(it as u32)).collect()
}

/// The places that are empty at the start and stay so: the greatest siphon without a token.
///
/// ```
/// use cotama_core::net::PlaceId;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_checker::structural;
/// use cotama_verification::pt::Pt;
///
/// let mut net = OwnedNet::new("two keys", "Each is locked in behind the other.");
/// let one = net.place(OwnedPlace::new("one", 0)).unwrap();
/// let other = net.place(OwnedPlace::new("other", 0)).unwrap();
/// net.transition(OwnedTransition::new("use one").take(one, 1).give(other, 1)).unwrap();
/// net.transition(OwnedTransition::new("use other").take(other, 1).give(one, 1)).unwrap();
/// assert_eq!(structural::never_marked(&Pt::from(&net.view().net())), [PlaceId(0), PlaceId(1)]);
/// ```
pub fn never_marked(pt: &Pt) -> Vec<PlaceId> {
    let mut places = pt.initial.iter().map(|&it| it == 0).collect();
    Graph::new(pt, &DeadTransitions::default()).greatest_siphon(&mut places);
    ids(&places)
}

/// The greatest trap among these places.
pub fn greatest_trap(pt: &Pt, among: &[PlaceId]) -> Vec<PlaceId> {
    let mut places = flags(pt, among);
    Graph::new(pt, &DeadTransitions::default()).greatest_trap(&mut places);
    ids(&places)
}

/// The greatest siphon among these places.
///
/// ```
/// use cotama_checker::structural::{greatest_siphon, greatest_trap};
/// use cotama_verification::tina;
/// // Nothing is put into `tank`, and nothing is taken out of `sea`.
/// let net = tina::read("rain.net", b"tr leak tank ->  tr rain -> sea  pl tank (1)").unwrap();
/// let net = net.untimed();
/// let [tank, sea] = ["tank", "sea"].map(|name| net.place(name).unwrap());
/// assert_eq!(greatest_siphon(&net, &[tank, sea]), [tank]);
/// assert_eq!(greatest_trap(&net, &[tank, sea]), [sea]);
/// ```
pub fn greatest_siphon(pt: &Pt, among: &[PlaceId]) -> Vec<PlaceId> {
    let mut places = flags(pt, among);
    Graph::new(pt, &DeadTransitions::default()).greatest_siphon(&mut places);
    ids(&places)
}

fn flags(pt: &Pt, among: &[PlaceId]) -> Places {
    let mut places = vec![false; pt.places.len()];
    for place in among {
        if let Some(it) = places.get_mut(place.0 as usize) {
            *it = true;
        }
    }
    places
}

/// A minimal siphon: it is not empty, and no other siphon lies within it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Siphon {
    /// The places of the siphon, sorted.
    pub places: Vec<PlaceId>,
    /// A trap within it that is marked at the start; then the siphon never gets empty.
    pub trap: Option<Trap>,
}

/// Minimal siphons.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Siphons {
    /// The siphons found.
    pub siphons: Vec<Siphon>,
    /// Whether these are all; otherwise a limit was reached.
    pub complete: bool,
}

impl Siphons {
    /// Whether every siphon contains a marked trap: what Commoner's theorem asks for. `None` when
    /// not all are known and those that are known do.
    pub fn controlled(&self) -> Option<bool> {
        let all = self.siphons.iter().all(|it| it.trap.is_some());
        if all && !self.complete { None } else { Some(all) }
    }
}

/// The minimal siphons of a net. `limit` is the most siphons to find, `work` the most arcs to look
/// at.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_checker::structural;
/// use cotama_verification::pt::Pt;
///
/// let mut lamp = OwnedNet::new("lamp", "");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// let found = structural::minimal_siphons(&Pt::from(&lamp.view().net()), 100, 1_000_000);
/// assert_eq!(found.siphons[0].places, [off, on]);
/// assert_eq!(found.controlled(), Some(true));
/// ```
pub fn minimal_siphons(pt: &Pt, limit: usize, work: u64) -> Siphons {
    siphons(pt, limit, Work::new(work, None), u64::MAX)
}

/// The same with the usual effort within limits.
pub(crate) fn minimal_siphons_within(pt: &Pt, limit: usize, limits: &Limits) -> Siphons {
    siphons(pt, limit, Cost::new(Effort::default(), limits).into(), limits.bytes)
}

fn siphons(pt: &Pt, limit: usize, mut work: Work, mut bytes: u64) -> Siphons {
    let graph = Graph::new(pt, &DeadTransitions::default());
    let cost = pt.arcs + pt.places.len();
    let mut found = Siphons { siphons: Vec::new(), complete: false };
    // Siphons within the first places that contain the second ones. Whichever has not all places of
    // a siphon that was found lacks a first one and contains those before it.
    let mut open: Vec<(Places, Vec<usize>)> = vec![(vec![true; pt.places.len()], Vec::new())];
    let size = |required: &[usize]| (pt.places.len() + size_of_val(required) + 48) as u64;
    bytes = bytes.saturating_sub(size(&[]));
    while let Some((mut places, mut required)) = open.pop() {
        graph.greatest_siphon(&mut places);
        bytes = bytes.saturating_add(size(&required));
        if work.spend(cost).is_err() {
            return found;
        }
        if !places.contains(&true) || required.iter().any(|&it| !places[it]) {
            continue;
        }
        let whole = places.clone();
        // Required places go last: a siphon without one of them has been found elsewhere.
        let mut is_required = vec![false; places.len()];
        required.iter().for_each(|&it| is_required[it] = true);
        let others: Vec<_> =
            (0..places.len()).filter(|&it| places[it] && !is_required[it]).collect();
        for order in [&others, &required] {
            let shrunk = shrink(&mut places, order, |fewer| {
                work.spend(cost).ok()?;
                graph.greatest_siphon(fewer);
                Some(fewer.contains(&true))
            });
            if shrunk.is_none() {
                return found;
            }
        }
        if required.iter().all(|&it| places[it]) {
            if found.siphons.len() == limit {
                return found;
            }
            let Ok(trap) = graph.marked_trap(places.clone(), &mut work) else { return found };
            found.siphons.push(Siphon { places: ids(&places), trap });
        }
        // Cases with the fewest requirements go first.
        let at = open.len();
        for place in (0..places.len()).filter(|&it| places[it]) {
            if !is_required[place] {
                let Some(left) = bytes.checked_sub(size(&required)) else { return found };
                bytes = left;
                let mut without = whole.clone();
                without[place] = false;
                open.push((without, required.clone()));
                required.push(place);
            }
        }
        open[at..].reverse();
    }
    found.complete = true;
    found
}
