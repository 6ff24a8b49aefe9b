//! Rules by which what always can fire together does so.

use super::draft::{Draft, Move};
use super::rule::Rule;

/// The transitions around a place that is neither read nor both taken from and given to.
struct Around {
    producers: Vec<(u32, u32)>,
    consumers: Vec<(u32, u32)>,
}

impl Around {
    fn new(draft: &Draft, place: u32) -> Option<Self> {
        let (mut producers, mut consumers) = (Vec::new(), Vec::new());
        for (at, it) in draft.users(place) {
            let (need, by) = (it.need(place), it.effect(place));
            let tokens = u32::try_from(by.unsigned_abs()).ok()?;
            if by > 0 && need == 0 {
                producers.push((at, tokens));
            } else if by < 0 && need == tokens {
                consumers.push((at, tokens));
            } else {
                return None;
            }
        }
        // As many as before at most.
        let (new, old) = (producers.len() * consumers.len(), producers.len() + consumers.len());
        (!consumers.is_empty() && new <= old).then_some(Self { producers, consumers })
    }

    fn moves<'a>(draft: &'a Draft, of: &'a [(u32, u32)]) -> impl Iterator<Item = &'a Move> {
        of.iter().filter_map(|it| draft.moves[it.0 as usize].as_ref())
    }

    /// Whether what takes can fire right after what gives.
    fn post(&self, draft: &Draft, place: u32) -> bool {
        let mut consumers = Self::moves(draft, &self.consumers);
        let alone = self.consumers.len() == 1;
        consumers.all(|it| it.needs == [(place, 1)] && !draft.is_visible(it))
            && (alone
                || draft.initial[place as usize] == 0 && self.producers.iter().all(|it| it.1 == 1))
    }

    /// Whether what gives can fire right before what takes: always if it may lose its tokens to
    /// others before (`free`).
    fn pre(&self, draft: &Draft, place: u32, free: bool) -> bool {
        let mut producers = Self::moves(draft, &self.producers);
        let alone =
            |from: u32| draft.users(from).filter(|(_, it)| it.need(from) > 0).nth(1).is_none();
        draft.initial[place as usize] == 0
            && !self.producers.is_empty()
            && (self.producers.len() == 1 || self.consumers.iter().all(|it| it.1 == 1))
            && producers.all(|it| {
                it.effects.len() == it.needs.len() + 1
                    && it.effect(place) == 1
                    && it.needs.iter().all(|&(from, need)| it.effect(from) == -i64::from(need))
                    && !draft.is_visible(it)
                    && (free || !it.needs.is_empty() && it.needs.iter().all(|it| alone(it.0)))
            })
    }

    /// Each producer and consumer as often as a token needs it, with the steps that they stand for.
    fn joined(&self, draft: &mut Draft) -> Option<Vec<Move>> {
        let mut all = Vec::new();
        for &(producer, given) in &self.producers {
            for &(consumer, taken) in &self.consumers {
                let (gives, takes) = (
                    draft.moves[producer as usize].clone()?,
                    draft.moves[consumer as usize].clone()?,
                );
                // One of the two is 1.
                let step = draft.record.step((gives.step, taken), (takes.step, given));
                all.push(gives.times(taken)?.then(&takes.times(given)?, step)?);
            }
        }
        Some(all)
    }

    /// Puts the joined transitions in the place of these and of the place.
    fn join(&self, draft: &mut Draft, place: u32) -> bool {
        let arcs = |of| Self::moves(draft, of).map(Move::arcs).sum::<usize>();
        let old = arcs(&self.producers) + arcs(&self.consumers);
        let Some(joined) = self.joined(draft) else { return false };
        let new: usize = joined.iter().map(Move::arcs).sum();
        let enough = draft.spend(old + new);
        if !enough || draft.arcs - old + new > draft.most_arcs || !self.emptied(draft, place) {
            return false;
        }
        for &(at, _) in self.producers.iter().chain(&self.consumers) {
            draft.remove(at);
        }
        draft.drop_place(place);
        for it in joined {
            draft.add(it);
        }
        true
    }

    /// Lets the only consumer take what the place has at the start.
    fn emptied(&self, draft: &mut Draft, place: u32) -> bool {
        let tokens = draft.initial[place as usize];
        let Some(consumer) =
            Self::moves(draft, &self.consumers).next().filter(|_| tokens > 0).cloned()
        else {
            return true;
        };
        let Some(marking) = consumer.times(tokens).and_then(|all| {
            let after = |&(at, by): &(u32, i64)| {
                Some((at, u32::try_from(by.checked_add(draft.initial[at as usize].into())?).ok()?))
            };
            all.effects.iter().map(after).collect::<Option<Vec<_>>>()
        }) else {
            return false;
        };
        for (at, tokens) in marking {
            draft.initial[at as usize] = tokens;
        }
        draft.record.at_start(consumer.step, tokens);
        true
    }
}

/// Agglomerates around every place that one of these rules allows it for.
pub(super) fn agglomerate(draft: &mut Draft, rule: Rule) -> usize {
    let mut count = 0;
    for place in draft.places() {
        // A visible place is excluded by its consumers or producers, which are visible then.
        let Some(around) = Around::new(draft, place) else { continue };
        let allowed = match rule {
            Rule::PostAgglomeration => around.post(draft, place),
            rule => around.pre(draft, place, rule == Rule::FreeAgglomeration),
        };
        let steps = Around::moves(draft, &around.producers).map(|it| it.step).collect();
        if allowed && around.join(draft, place) {
            if rule == Rule::PreAgglomeration {
                draft.record.at_rest(steps);
            }
            count += 1;
        }
    }
    count
}
