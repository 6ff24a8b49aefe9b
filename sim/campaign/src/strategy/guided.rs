//! Plans guided by what runs came through.

use super::races::{answer, race};
use super::uniform::of_run;
use super::{Draws, Strategy};
use crate::observed::Observed;
use crate::plan::{Fault, Plan};
use crate::space::{Kind, Space};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::robots::Moment;
use cotama_models::team::scenario::FaultTime;
use cotama_sim::streams::{Stream, Streams};
use std::collections::BTreeMap;

/// Guided by coverage.
///
/// Half of the plans are drawn anew, with what was drawn least so far: kinds of faults and modules
/// come from decks that are shuffled when they are empty. The others are mutants of plans whose run
/// came through something new, or nearer to breaking a requirement than any before; those come
/// first that came through what few runs did (the power schedule of Böhme, Pham, Roychoudhury, CCS
/// 2016).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Guided;

/// How far the moment of a fault is moved at most, in mm or ms.
const MOVED: u64 = 10_000;

impl Strategy for Guided {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        Box::new(Corpus {
            space,
            streams: Streams::new(seed),
            run: first,
            kinds: Vec::new(),
            known: BTreeMap::new(),
            nearest: i64::MAX,
            kept: Vec::new(),
            tried: Plan::default(),
        })
    }
}

/// A plan that came through something new.
struct Kept {
    plan: Plan,
    /// Features that it was first to come through.
    new: Vec<u64>,
    /// How often it was mutated.
    mutated: u64,
}

struct Corpus<'s> {
    space: &'s Space,
    streams: Streams,
    run: u64,
    /// The deck: what is left of it.
    kinds: Vec<Kind>,
    /// How many runs came through each feature.
    known: BTreeMap<u64, u64>,
    nearest: i64,
    kept: Vec<Kept>,
    tried: Plan,
}

impl Draws for Corpus<'_> {
    fn next(&mut self) -> Plan {
        let mut stream = of_run(self.streams, self.run);
        self.run += 1;
        self.tried = if self.kept.is_empty() || stream.below(2) == 0 {
            self.fresh(&mut stream)
        } else {
            self.mutant(&mut stream)
        };
        self.tried.clone()
    }

    fn learn(&mut self, run: &Observed, distance: i64) {
        let mut new = Vec::new();
        for it in &run.features {
            let count = self.known.entry(*it).or_default();
            *count += 1;
            if *count == 1 {
                new.push(*it);
            }
        }
        let nearer = distance < self.nearest;
        self.nearest = self.nearest.min(distance);
        if !new.is_empty() || nearer {
            self.kept.push(Kept { plan: std::mem::take(&mut self.tried), new, mutated: 0 });
        }
    }
}

impl Corpus<'_> {
    /// A plan of what was drawn least.
    fn fresh(&mut self, stream: &mut Stream) -> Plan {
        let Space { least, most, .. } = *self.space;
        let count = most - stream.below(most - least + 1) / 2;
        let mut plan = Plan { faults: (0..count).map(|_| self.card(stream)).collect() };
        answer(&mut plan, self.space, stream);
        plan
    }

    /// A fault of the next kind.
    fn card(&mut self, stream: &mut Stream) -> Fault {
        if self.kinds.is_empty() {
            self.kinds = self.space.kinds.iter().map(|it| it.kind).collect();
            shuffle(&mut self.kinds, stream);
        }
        let kind = self.kinds.pop().unwrap_or(Kind::Obstacle);
        let when = self.space.moment(stream);
        let mut fault = self.space.with(kind, when, stream);
        if stream.below(4) == 0 {
            race(&mut fault, self.space, stream);
        }
        fault
    }

    /// A mutant of a plan that was kept: of three the one that came through what is rarest, then
    /// the one that was mutated least.
    fn mutant(&mut self, stream: &mut Stream) -> Plan {
        let count = self.kept.len() as u64;
        let three = [0; 3].map(|_| stream.below(count) as usize);
        let rarest = |it: &Kept| it.new.iter().map(|it| self.known[it]).min().unwrap_or(0);
        let key = |at: &usize| (rarest(&self.kept[*at]) + self.kept[*at].mutated, *at);
        let at = three.into_iter().min_by_key(key).unwrap_or(0);
        self.kept[at].mutated += 1;
        let mut plan = self.kept[at].plan.clone();
        for _ in 0..=stream.below(3) {
            self.mutate(&mut plan, stream);
        }
        plan
    }

    /// Changes one thing: a fault more or less, another kind or moment, one of another plan.
    fn mutate(&mut self, plan: &mut Plan, stream: &mut Stream) {
        let count = plan.faults.len() as u64;
        let any = |stream: &mut Stream| stream.below(count) as usize;
        let room = count < self.space.most.max(1);
        match stream.below(8) {
            0 | 1 if room => plan.faults.push(self.card(stream)),
            2 if count > self.space.least.max(1) => {
                plan.faults.remove(any(stream));
            }
            3 | 4 if count > 0 => plan.faults[any(stream)] = self.card(stream),
            5 if room => {
                let other = &self.kept[stream.below(self.kept.len() as u64) as usize].plan.faults;
                if !other.is_empty() {
                    plan.faults.push(other[stream.below(other.len() as u64) as usize].clone());
                }
            }
            6 if count > 0 => race(&mut plan.faults[any(stream)], self.space, stream),
            _ if count > 0 => move_it(&mut plan.faults[any(stream)], self.space, stream),
            _ => plan.faults.push(self.card(stream)),
        }
    }
}

/// In any order, each as likely (Durstenfeld, Comm. ACM 7(7), 1964).
fn shuffle<T>(deck: &mut [T], stream: &mut Stream) {
    for left in (1..deck.len()).rev() {
        deck.swap(left, stream.below(left as u64 + 1) as usize);
    }
}

/// A number near another one.
fn near(value: u64, most: u64, stream: &mut Stream) -> u64 {
    (value + stream.below(2 * MOVED + 1)).saturating_sub(MOVED).min(most)
}

/// Moves the moment of a failure.
fn moved(when: Moment, anywhere: bool, space: &Space, stream: &mut Stream) -> Moment {
    match when {
        _ if anywhere => space.moment(stream),
        Moment::Place(x) => Moment::Place(Millimetres(near(x.0, space.path_mm, stream))),
        Moment::At(it) => Moment::At(Millis(near(it.0, space.time_ms, stream))),
        Moment::During(part, it) => Moment::During(part, Millis(near(it.0, 60_000, stream))),
        Moment::Waiting(it) => Moment::Waiting(Millis(near(it.0, 60_000, stream))),
    }
}

/// Moves a fault a little, or anywhere.
fn move_it(fault: &mut Fault, space: &Space, stream: &mut Stream) {
    let anywhere = stream.below(3) == 0;
    match fault {
        Fault::Event(it) => {
            it.x.0 = if anywhere {
                stream.below(space.path_mm + 1)
            } else {
                near(it.x.0, space.path_mm, stream)
            };
        }
        Fault::Failure(it) => it.when = moved(it.when, anywhere, space, stream),
        Fault::Power(it) => it.permille = i32::try_from(stream.below(401)).unwrap_or(0) - 100,
        Fault::Operator(_) => *fault = space.answers(stream),
        Fault::Team(it) => {
            if let FaultTime::At(at) = &mut it.when {
                *at = if anywhere {
                    stream.below(space.time_ms)
                } else {
                    near(*at, space.time_ms, stream)
                };
            }
        }
    }
}
