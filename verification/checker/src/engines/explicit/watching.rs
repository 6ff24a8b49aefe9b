//! A net with watches, described by the net without.

use super::goal::Goal;
use cotama_core::net::PlaceId;
use cotama_property::pt::Lists;
use cotama_property::{Atom, Formula, Linear};

/// How a net with watches follows from the net without: a watch looks at the marking now and then,
/// and counts. Its graph is made of that of the net without, with the same numbers as if it were
/// explored from nothing.
///
/// ```
/// use cotama_models::nets::by_hand::delivery;
/// use cotama_verification::check::{Checker, Model, Options};
/// use cotama_verification::flat::{self, Looks};
/// use cotama_verification::property;
///
/// let rounds = flat::rounds(&delivery::SYSTEM)?;
/// let mut watched = rounds.clone();
/// watched.watch("safe", Looks::AtEnd, ("gs.Safe", "!gs.Safe"), 1)?;
/// let [net, watched_net] = [rounds.net()?, watched.net()?];
/// let [plain, model] = [&net, &watched_net].map(|it| Model::from(&it.view().net()));
/// // The graph of the plain net is made where evidence asks for it.
/// let options = Options::default();
/// let checker = Checker::new(&plain).watched(&model, watched.watching(), &options);
/// let start = property::parse("safe = 0", model.pt()).unwrap();
/// assert_eq!(checker.answer(&start, &options).engine(), "initial");
/// # Ok::<(), cotama_verification::flat::FlatError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Watching {
    /// For each place of the net with watches where its tokens come from.
    pub(crate) places: Vec<Tokens>,
    /// The watches in the order in which they look.
    pub(crate) watches: Vec<Watch>,
}

/// The source of the tokens of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tokens {
    pub(crate) of: Of,
    /// So many less those tokens, for a complement.
    pub(crate) lacks: Option<u32>,
}

/// The parts that hold tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// A place of the net without watches.
    Place(PlaceId),
    /// The same, but nothing while a watch is to look.
    Turn(PlaceId),
    /// Whether this watch is to look.
    Looks(usize),
    /// The count of this watch.
    Counts(usize),
}

/// A watch, which looks and counts.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    /// The place of the net without watches at each marking of which the watch looks.
    pub(crate) then: PlaceId,
    /// How its count goes on: the first of these that is from it and whose formula, about the net
    /// with watches, is true; without one it stays.
    pub(crate) steps: Vec<(u32, Formula, u32)>,
}

/// The counts of watches beside a marking of the net without.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Counts {
    /// The watch that is to look.
    pub(super) looks: Option<usize>,
    pub(super) counts: Vec<u32>,
}

impl Watching {
    /// The first watch that looks when a place becomes marked, or the next one after another.
    pub(super) fn next(&self, then: PlaceId, after: Option<usize>) -> Option<usize> {
        let from = after.map_or(0, |it| it + 1);
        (from..self.watches.len()).find(|&it| self.watches[it].then == then)
    }

    /// The tokens of a place; those of the net without watches are told.
    #[inline]
    pub(super) fn tokens(
        &self,
        place: PlaceId,
        held: &Counts,
        tokens: impl Fn(PlaceId) -> u64,
    ) -> u64 {
        let Some(it) = self.places.get(place.0 as usize) else { return 0 };
        let now = match it.of {
            Of::Turn(_) if held.looks.is_some() => 0,
            Of::Place(place) | Of::Turn(place) => tokens(place),
            Of::Looks(watch) => u64::from(held.looks == Some(watch)),
            Of::Counts(watch) => u64::from(held.counts[watch]),
        };
        it.lacks.map_or(now, |all| u64::from(all).saturating_sub(now))
    }

    /// A formula about a marking in which the watches hold this, as one about the marking of the
    /// net without. `None` when numbers would be too large, or it has temporal operators.
    pub(super) fn told(&self, formula: &Formula, held: &Counts, needs: &Needs) -> Option<Formula> {
        let told = formula.with_atoms(&mut |atom| {
            Some(match atom {
                Atom::AtMost(linear) => Formula::Atom(Atom::AtMost(self.linear(linear, held)?)),
                Atom::Deadlock if held.looks.is_some() => Formula::FALSE,
                Atom::Deadlock => Formula::Atom(Atom::Deadlock),
                Atom::Fireable(all) => {
                    let (own, looks): (Vec<_>, Vec<_>) =
                        all.iter().copied().partition(|it| it.0 < needs.own);
                    let mut any = Vec::new();
                    if held.looks.is_none() && !own.is_empty() {
                        any.push(Formula::Atom(Atom::Fireable(own)));
                    }
                    for it in looks {
                        let enough = needs.of(it.0).iter().map(|&(place, tokens)| {
                            let weights = vec![(PlaceId(place), -1)];
                            let linear = Linear { constant: tokens.into(), weights };
                            Some(Formula::Atom(Atom::AtMost(self.linear(&linear, held)?)))
                        });
                        any.push(Formula::And(enough.collect::<Option<_>>()?));
                    }
                    Formula::Or(any)
                }
            })
        })?;
        Goal::new(&told).is_some().then(|| told.simplified())
    }

    fn linear(&self, linear: &Linear, held: &Counts) -> Option<Linear> {
        let mut told = Linear { constant: linear.constant, weights: Vec::new() };
        for &(place, weight) in &linear.weights {
            let it = self.places.get(place.0 as usize)?;
            let mut weight = weight;
            if let Some(all) = it.lacks {
                told.constant = told.constant.checked_add(weight.checked_mul(all.into())?)?;
                weight = weight.checked_neg()?;
            }
            let known = match it.of {
                Of::Turn(_) if held.looks.is_some() => 0,
                Of::Place(place) | Of::Turn(place) => {
                    add(&mut told, place, weight)?;
                    0
                }
                Of::Looks(watch) => i64::from(held.looks == Some(watch)),
                Of::Counts(watch) => held.counts[watch].into(),
            };
            told.constant = told.constant.checked_add(weight.checked_mul(known)?)?;
        }
        Some(told)
    }
}

/// Adds so many times the tokens of a place; `None` beyond what can be counted with.
fn add(sum: &mut Linear, place: PlaceId, weight: i64) -> Option<()> {
    match sum.weights.binary_search_by_key(&place, |it| it.0) {
        Ok(at) => sum.weights[at].1 = sum.weights[at].1.checked_add(weight)?,
        Err(at) => sum.weights.insert(at, (place, weight)),
    }
    sum.weights.retain(|it| it.1 != 0);
    Some(())
}

/// The needs of the transitions by which watches look; those of the net without come before them.
#[derive(Debug)]
pub(super) struct Needs {
    pub(super) own: u32,
    pub(super) looks: Lists<u32>,
}

impl Needs {
    pub(super) fn of(&self, transition: u32) -> &[(u32, u32)] {
        transition.checked_sub(self.own).map_or(&[], |it| self.looks.of(it))
    }
}
