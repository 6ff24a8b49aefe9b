//! Plans mutated from those that came through something new.

use super::uniform::of_run;
use super::{Draws, Strategy};
use crate::campaign::observed::Observed;
use crate::campaign::plan::{Fault, Plan};
use crate::campaign::space::Space;
use crate::streams::{Stream, Streams};
use crate::supervised::When;
use cotama_core::units::{Millimetres, Millis};
use std::collections::BTreeSet;

/// Guided by coverage: a plan whose run came through something new, or nearer to breaking a
/// requirement than any before, is kept, and most plans are mutants of plans that were kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Guided;

/// One plan in so many is drawn anew.
const FRESH: u64 = 4;
/// How far the moment of a fault is moved at most, in mm or ms.
const MOVED: u64 = 10_000;

impl Strategy for Guided {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        Box::new(Corpus {
            space,
            streams: Streams::new(seed),
            run: first,
            known: BTreeSet::new(),
            nearest: i64::MAX,
            kept: Vec::new(),
            tried: Plan::default(),
        })
    }
}

struct Corpus<'s> {
    space: &'s Space,
    streams: Streams,
    run: u64,
    known: BTreeSet<u64>,
    nearest: i64,
    kept: Vec<Plan>,
    tried: Plan,
}

impl Draws for Corpus<'_> {
    fn next(&mut self) -> Plan {
        let mut stream = of_run(self.streams, self.run);
        self.run += 1;
        self.tried = if self.kept.is_empty() || stream.below(FRESH) == 0 {
            self.space.draw(&mut stream, &self.space.kinds)
        } else {
            // Of two the later one: what is new was found on the way there.
            let count = self.kept.len() as u64;
            let at = stream.below(count).max(stream.below(count));
            let mut plan = self.kept[at as usize].clone();
            for _ in 0..=stream.below(2) {
                mutate(&mut plan, self.space, &self.kept, &mut stream);
            }
            plan
        };
        self.tried.clone()
    }

    fn learn(&mut self, run: &Observed, distance: i64) {
        let before = self.known.len();
        self.known.extend(&run.features);
        let nearer = distance < self.nearest;
        self.nearest = self.nearest.min(distance);
        if self.known.len() > before || nearer {
            self.kept.push(std::mem::take(&mut self.tried));
        }
    }
}

/// Changes one thing: a fault more or less, another kind or moment, one of another plan.
fn mutate(plan: &mut Plan, space: &Space, kept: &[Plan], stream: &mut Stream) {
    let count = plan.faults.len() as u64;
    let any = |stream: &mut Stream| stream.below(count) as usize;
    let room = count < space.most.max(1);
    match stream.below(6) {
        0 if room => plan.faults.push(space.fault(stream, &space.kinds)),
        1 if count > space.least.max(1) => {
            plan.faults.remove(any(stream));
        }
        2 if count > 0 => {
            let at = any(stream);
            plan.faults[at] = space.fault(stream, &space.kinds);
        }
        3 if room => {
            let other = &kept[stream.below(kept.len() as u64) as usize];
            if !other.faults.is_empty() {
                let it = stream.below(other.faults.len() as u64) as usize;
                plan.faults.push(other.faults[it].clone());
            }
        }
        _ if count > 0 => {
            let at = any(stream);
            move_it(&mut plan.faults[at], space, stream);
        }
        _ => plan.faults.push(space.fault(stream, &space.kinds)),
    }
}

/// Moves a fault a little, or anywhere.
fn move_it(fault: &mut Fault, space: &Space, stream: &mut Stream) {
    let anywhere = stream.below(3) == 0;
    let near = |value: u64, most: u64, stream: &mut Stream| {
        (value + stream.below(2 * MOVED + 1)).saturating_sub(MOVED).min(most)
    };
    match fault {
        Fault::Failure { when, part, .. } => {
            if part.is_some() && stream.below(3) == 0 {
                *part = Some(space.part(stream));
                return;
            }
            *when = match *when {
                _ if anywhere => space.moment(stream),
                When::Place(x) => When::Place(Millimetres(near(x.0, space.path_mm, stream))),
                When::At(it) => When::At(Millis(near(it.0, space.time_ms, stream))),
                When::During(state, it) => When::During(state, Millis(near(it.0, 60_000, stream))),
            };
        }
        Fault::Event(it) => {
            it.x.0 = if anywhere {
                stream.below(space.path_mm + 1)
            } else {
                near(it.x.0, space.path_mm, stream)
            };
        }
        Fault::Power(it) => it.permille = i32::try_from(stream.below(401)).unwrap_or(0) - 100,
        Fault::Operator(_) => {}
    }
}
