//! Firing sequences that repeat themselves, and what they need and change.

use super::tokens::Tokens;
use cotama_certificate::Evidence;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;

/// A firing sequence of a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sequence {
    /// How many firings; 2^128 - 1 stands for that and more.
    pub length: u128,
    /// The transitions; `None` when there are more than
    /// [`FIRINGS`](super::FIRINGS).
    pub firings: Option<Vec<TransitionId>>,
}

/// Why a net is unbounded: after `stem` fires from the initial marking, `pump` can fire again and
/// again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// How to get there.
    pub stem: Sequence,
    /// The repeatable sequence; it takes tokens from no place.
    pub pump: Sequence,
    /// Places that grow, and by how much each time; sorted, never empty.
    pub grows: Vec<(PlaceId, u64)>,
}

impl Growth {
    /// Returns the evidence that sums of tokens grow beyond any number; `None` when a sequence is
    /// too long to be written out.
    pub fn evidence(&self, pt: &Pt) -> Option<Evidence> {
        let (stem, pump) = (self.stem.firings.as_ref()?, self.pump.firings.as_ref()?);
        Some(Evidence::growth(pt, stem, pump))
    }
}

/// A part of a sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Transition(u32),
    /// A sequence of [`Pumps`].
    Pump(u32),
}

/// Parts, and how often each is repeated.
pub(super) type Word = Vec<(Part, u64)>;

/// A sequence that can be repeated for ever from every marking that has what it needs, and does not
/// lose tokens but where there are ω of them.
#[derive(Debug)]
pub(super) struct Pump {
    pub(super) word: Word,
    length: u128,
    /// Sorted by place.
    pub(super) needs: Vec<(u32, u64)>,
    /// Sorted by place; never zero.
    pub(super) effects: Vec<(u32, i64)>,
}

impl Pump {
    /// Whether repeating it gives some place ω that has not.
    pub(super) fn raises(&self, marking: &[Tokens]) -> bool {
        let finite = |place: u32| !marking[place as usize].is_omega();
        self.effects.iter().any(|&(place, change)| change > 0 && finite(place))
            && !self.effects.iter().any(|&(place, change)| change < 0 && finite(place))
            && self.is_enabled(marking)
    }

    pub(super) fn is_enabled(&self, marking: &[Tokens]) -> bool {
        self.needs.iter().all(|&(place, tokens)| marking[place as usize] >= Tokens::new(tokens))
    }

    /// The limit of repeating it.
    pub(super) fn raise(&self, marking: &mut [Tokens]) {
        debug_assert!(self.is_enabled(marking));
        for &(place, _) in self.effects.iter().filter(|it| it.1 > 0) {
            marking[place as usize] = Tokens::OMEGA;
        }
    }

    /// How often it must be repeated from a marking, and what is needed before so that `demand` is
    /// there after.
    pub(super) fn before(&self, marking: &[Tokens], demand: &mut [u64]) -> Option<u64> {
        let mut times = 0;
        for &(place, change) in self.effects.iter().filter(|it| it.1 > 0) {
            let missing = marking[place as usize]
                .finite()
                .map_or(0, |it| demand[place as usize].saturating_sub(it));
            times = times.max(missing.div_ceil(change.unsigned_abs()));
        }
        if times > 0 {
            let mut effects = self.effects.iter().peekable();
            for &(place, change) in &self.effects {
                let demand = &mut demand[place as usize];
                let all = i128::from(change) * i128::from(times);
                *demand = u64::try_from((i128::from(*demand) - all).max(0)).ok()?;
            }
            for &(place, tokens) in &self.needs {
                while effects.next_if(|it| it.0 < place).is_some() {}
                let lost = effects.peek().filter(|it| it.0 == place).map_or(0, |it| (-it.1).max(0));
                let needed = i128::from(tokens) + i128::from(lost) * i128::from(times - 1);
                let demand = &mut demand[place as usize];
                *demand = u64::try_from(needed).ok()?.max(*demand);
            }
        }
        Some(times)
    }
}

/// The pumps known of a net.
#[derive(Debug, Default)]
pub(super) struct Pumps {
    pub(super) all: Vec<Pump>,
    pub(super) bytes: u64,
}

impl Pumps {
    /// Every transition that takes nothing away and gives something.
    pub(super) fn of(pt: &Pt) -> Self {
        let mut pumps = Self::default();
        for transition in 0..pt.transitions.len() as u32 {
            let effects = pt.effects.of(transition);
            if !effects.is_empty() && effects.iter().all(|it| it.1 > 0) {
                // One firing of a transition of the net always has a sum.
                pumps.add(pt, vec![(Part::Transition(transition), 1)]);
            }
        }
        pumps
    }

    /// Adds a sequence; `None` when a number passes 63 bits.
    pub(super) fn add(&mut self, pt: &Pt, word: Word) -> Option<&Pump> {
        let (needs, effects) = self.sum(pt, &word)?;
        let needs = (0..).zip(needs).filter(|it| it.1 > 0).collect::<Vec<_>>();
        let effects = (0..).zip(effects).filter(|it| it.1 != 0).collect::<Vec<_>>();
        self.bytes += 16 * (word.len() + needs.len() + effects.len()) as u64 + 100;
        self.all.push(Pump { length: self.length(&word), word, needs, effects });
        self.all.last()
    }

    /// Returns the needs and the changes of a sequence, by place; `None` when a number passes 63
    /// bits.
    pub(super) fn sum(&self, pt: &Pt, word: &Word) -> Option<(Vec<u64>, Vec<i64>)> {
        let mut needs = vec![0_u64; pt.places.len()];
        let mut effects = vec![0_i64; pt.places.len()];
        let mut need = |place: u32, tokens: i128, effect: i64| {
            let need = &mut needs[place as usize];
            *need = u64::try_from(tokens - i128::from(effect)).unwrap_or(0).max(*need);
            i64::try_from(*need).ok()
        };
        for &(part, times) in word {
            debug_assert!(!matches!(part, Part::Pump(it) if it as usize >= self.all.len()));
            let times = i64::try_from(times).ok().filter(|it| *it > 0)?;
            let owned: Vec<(u32, u64)>;
            let (part_needs, part_effects) = match part {
                Part::Transition(it) => {
                    owned = pt
                        .needs
                        .of(it)
                        .iter()
                        .map(|&(place, tokens)| (place, u64::from(tokens)))
                        .collect();
                    (owned.as_slice(), pt.effects.of(it))
                }
                Part::Pump(it) => (&*self.all[it as usize].needs, &*self.all[it as usize].effects),
            };
            let effect_on = |place| {
                part_effects
                    .binary_search_by_key(&place, |it| it.0)
                    .map_or(0, |at| part_effects[at].1)
            };
            for &(place, tokens) in part_needs {
                // The last of the repetitions finds the fewest tokens.
                let lost = i128::from((-effect_on(place)).max(0)) * i128::from(times - 1);
                need(place, i128::from(tokens) + lost, effects[place as usize])?;
            }
            for &(place, change) in part_effects {
                let sum = &mut effects[place as usize];
                *sum = sum.checked_add(change.checked_mul(times)?)?;
            }
        }
        Some((needs, effects))
    }

    fn length(&self, word: &Word) -> u128 {
        word.iter().fold(0, |sum, &(part, times)| {
            let length = match part {
                Part::Transition(_) => 1,
                Part::Pump(it) => self.all[it as usize].length,
            };
            sum.saturating_add(length.saturating_mul(u128::from(times)))
        })
    }

    /// The sequence transition by transition, if it has at most so many.
    pub(super) fn sequence(&self, word: &Word, most: u64) -> Sequence {
        let length = self.length(word);
        if length > u128::from(most) {
            return Sequence { length, firings: None };
        }
        let mut firings = Vec::with_capacity(length as usize);
        // Words within words: where we are in each, and how often its part is still to come.
        let mut open: Vec<(&Word, usize, u64)> = vec![(word, 0, 0)];
        while let Some((word, at, done)) = open.pop() {
            let Some(&(part, times)) = word.get(at) else { continue };
            if done == times {
                open.push((word, at + 1, 0));
                continue;
            }
            match part {
                Part::Transition(it) => {
                    firings.extend((done..times).map(|_| TransitionId(it)));
                    open.push((word, at + 1, 0));
                }
                Part::Pump(it) => {
                    open.push((word, at, done + 1));
                    open.push((&self.all[it as usize].word, 0, 0));
                }
            }
        }
        debug_assert_eq!(firings.len() as u128, length);
        Sequence { length, firings: Some(firings) }
    }
}
