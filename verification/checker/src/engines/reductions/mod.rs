//! Smaller nets with the same answer.
//!
//! [`reduce`] takes places and transitions away from a net, and puts transitions together, as long
//! as what is asked has the same answer. A [`Trail`] leads back: [`Trail::place`] tells tokens of
//! the original net from those of the reduced one, and [`Trail::lift`] makes a run of the original
//! net of one of the reduced net.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_checker::reductions::{Goal, Keep, reduce};
//! use cotama_verification::pt::Pt;
//!
//! let mut net = OwnedNet::new("fall", "");
//! let [a, b, c] =
//!     ["a", "b", "c"].map(|it| net.place(OwnedPlace::new(it, (it == "a").into())).unwrap());
//! net.transition(OwnedTransition::new("slip").take(a, 1).give(b, 1)).unwrap();
//! net.transition(OwnedTransition::new("fall").take(b, 1).give(c, 1)).unwrap();
//! let net = Pt::from(&net.view().net());
//!
//! let reduced = reduce(&net, &Keep::new(Goal::Deadlock));
//! assert!(reduced.net.transitions.is_empty());
//! let dead = reduced.trail.lift(&net, &[]).unwrap();
//! assert_eq!(
//!     dead.iter().map(|it| net.transitions[it.0 as usize].as_str()).collect::<Vec<_>>(),
//!     ["slip", "fall"]
//! );
//! ```
//!
//! Every rule with its conditions and source is described at [`Rule`]. The sources:
//!
//! - Berthelot, "Checking properties of nets using transformations", 1986.
//! - Murata, "Petri nets: properties, analysis and applications", 1989.
//! - Rakow, "Safety slicing Petri nets", 2012.
//! - Bønneland et al., "Stubborn versus structural reductions for Petri nets", 2019.
//! - Thierry-Mieg, "Structural reductions revisited", 2020.

mod agglomerate;
mod draft;
mod filled;
mod implied;
mod lift;
mod places;
mod record;
mod rule;
mod slice;
mod supply;
mod trail;
mod transitions;

pub use cotama_property::limits::Limits;
pub use lift::LiftError;
pub use rule::Rule;
pub use trail::{Tokens, Trail};

use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;
use draft::Draft;
use std::collections::BTreeMap;

/// The question to the net, whose answer must stay the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Goal {
    /// Which markings of the visible places can be reached.
    Reachability,
    /// Which markings of the visible places can be reached in a deadlock; without visible places,
    /// whether there is one.
    Deadlock,
    /// Which sequences of markings the visible places pass through on maximal runs, where it does
    /// not count how long a marking lasts: formulas of LTL without a next operator.
    StutterInvariantLtl,
    /// Everything that CTL tells of the visible places, step by step, and of deadlocks.
    Ctl,
    /// How many tokens the visible places ever hold; as [`Reachability`](Self::Reachability).
    Bounds,
}

/// The parts of a net that reductions must preserve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keep {
    /// The places that are visible.
    pub places: Vec<PlaceId>,
    /// Transitions of which it must be seen whether they are enabled: the places that they need are
    /// visible.
    pub transitions: Vec<TransitionId>,
    /// The question about them.
    pub goal: Goal,
}

impl Keep {
    /// Nothing is visible yet.
    pub fn new(goal: Goal) -> Self {
        Self { places: Vec::new(), transitions: Vec::new(), goal }
    }

    fn visible(&self, pt: &Pt) -> Vec<bool> {
        let mut visible = vec![false; pt.places.len()];
        let needed = self.transitions.iter().flat_map(|it| pt.needs.of(it.0)).map(|it| it.0);
        for place in self.places.iter().map(|it| it.0).chain(needed) {
            if let Some(it) = visible.get_mut(place as usize) {
                *it = true;
            }
        }
        visible
    }
}

/// How much is done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effort {
    /// The rules that may be used; those that do not keep the goal are not.
    pub rules: Vec<Rule>,
    /// How many arcs may be looked at, roughly. When they have been, the net is left as far as it
    /// is reduced.
    pub work: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { rules: Rule::ALL.to_vec(), work: 100_000_000 }
    }
}

/// A reduced net.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The net. Places have the names that they had; a transition that stands for several has
    /// theirs.
    pub net: Pt,
    /// The way back.
    pub trail: Trail,
    /// For each rule, in the order of [`Rule::ALL`], how many places and transitions it changed or
    /// took away; rules that did nothing are not listed.
    pub counts: Vec<(Rule, usize)>,
}

/// Reduces a net as far as the rules go.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::pt::Pt;
/// use cotama_checker::reductions::{Goal, Keep, reduce};
/// let net = philosophers(5).unwrap();
/// let pt = Pt::from(&net.view().net());
/// let reduced = reduce(&pt, &Keep::new(Goal::Deadlock));
/// assert_eq!((pt.places.len(), reduced.net.places.len()), (25, 20));
/// ```
pub fn reduce(pt: &Pt, keep: &Keep) -> Reduced {
    reduce_within(pt, keep, &Limits::default(), &Effort::default())
}

/// Reduces a net with such an effort. When the time is over, the net is left as far as it is
/// reduced; the other limits matter to what is done with it. A net that [is not
/// plain](Pt::is_plain) stays as it is.
pub fn reduce_within(pt: &Pt, keep: &Keep, limits: &Limits, effort: &Effort) -> Reduced {
    let mut draft = Draft::new(pt, keep, limits, effort.work);
    let mut names = pt.transitions.clone();
    let mut counts: BTreeMap<Rule, usize> = BTreeMap::new();
    let usable: Vec<Rule> = Rule::ALL
        .into_iter()
        .filter(|it| pt.is_plain() && it.keeps(keep.goal) && effort.rules.contains(it))
        .collect();
    let mut changed = true;
    while std::mem::take(&mut changed) {
        for &rule in &usable {
            // The search for implied places is the dearest; it waits until nothing else is left to
            // do.
            if !draft.spend(draft.arcs + draft.present.len())
                || (rule == Rule::ImpliedPlace && changed)
            {
                continue;
            }
            let count = apply(rule, &mut draft, &mut names);
            changed |= count > 0;
            *counts.entry(rule).or_default() += count;
        }
    }
    let (mut net, trail) = draft.finished(pt, &names);
    net.special.clone_from(&pt.special);
    let listed = |rule: Rule| Some((rule, counts.get(&rule).copied().filter(|&it| it > 0)?));
    Reduced { net, trail, counts: Rule::ALL.into_iter().filter_map(listed).collect() }
}

/// How much a rule did.
fn apply(rule: Rule, draft: &mut Draft, names: &mut Vec<String>) -> usize {
    match rule {
        Rule::DeadTransition => transitions::dead(draft),
        Rule::ConstantPlace => places::constant(draft),
        Rule::UnlimitedPlace => places::unlimited(draft),
        Rule::ScaledPlace => places::scaled(draft),
        Rule::ProportionalPlace => places::proportional(draft),
        Rule::ImpliedPlace => implied::implied(draft),
        Rule::EqualTransition => transitions::equal(draft, false),
        Rule::RepeatedTransition => transitions::equal(draft, true),
        Rule::Slice => slice::slice(draft),
        Rule::Suffix => slice::suffix(draft),
        Rule::AlwaysEnabled => transitions::always_enabled(draft),
        Rule::Source => filled::sources(draft, names),
        Rule::FreeCycle => filled::free_cycles(draft, names),
        Rule::PostAgglomeration | Rule::PreAgglomeration | Rule::FreeAgglomeration => {
            agglomerate::agglomerate(draft, rule)
        }
    }
}
