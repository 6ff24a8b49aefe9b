//! The smallest plan that still breaks a requirement.
//!
//! First whole faults are left out, in halves and smaller parts (delta debugging: Zeller,
//! Hildebrandt, IEEE TSE 28(2), 2002), then each fault is made plainer: it does not end, its moment
//! and its numbers are round. What is left cannot be made plainer by
//! any single one of these steps.

use crate::plan::{Fault, Plan};
use crate::requirement::Requirement;
use crate::subject::Subject;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::faults::EventKind;
use cotama_models::robots::Moment;
use cotama_models::team::scenario::{self, FaultTime};
use cotama_sim::robots;

/// The most runs that one plan is shrunk with.
pub const MAX_RUNS: u64 = 2_000;

/// A plan made small.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shrunk {
    /// The plan.
    pub plan: Plan,
    /// How many runs it took.
    pub runs: u64,
    /// Whether no single step makes it smaller; if not, [`MAX_RUNS`] were not enough.
    pub minimal: bool,
}

/// Makes a plan that breaks a requirement small.
///
/// ```
/// use cotama_core::units::{Millimetres, Millis};
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_models::robots::Moment;
/// use cotama_campaign::{plan::{Fault, Plan}, requirement::Requirement, shrink::shrink};
/// use cotama_campaign::subject::{Policy, Subject};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// let number = |id| mission.robot().unwrap().robot().failure(id).unwrap();
/// let at = |x, id| Fault::failure(Moment::Place(Millimetres(x)), number(id));
/// let faults = vec![at(3_211, "COM2"), at(17_935, "BAT2"), at(22_222, "SON2")];
/// let shrunk = shrink(&subject, &Requirement::Completed, &Plan { faults });
/// let only = Fault::failure(Moment::At(Millis(0)), number("BAT2"));
/// assert_eq!((shrunk.plan.faults, shrunk.minimal), (vec![only], true));
/// ```
pub fn shrink(subject: &Subject<'_>, requirement: &Requirement, plan: &Plan) -> Shrunk {
    // A place that was rounded up may lie behind the path, where nothing happens.
    let end = subject.path_length();
    shrink_by(plan, &mut |it| it.is_within(end) && !requirement.holds(&subject.run(it)))
}

/// Makes a plan small that fails by a judgement of the caller's, a function of the plan.
pub fn shrink_by(plan: &Plan, fails: &mut dyn FnMut(&Plan) -> bool) -> Shrunk {
    let mut search = Search { judge: fails, runs: 0 };
    let mut best = plan.clone();
    loop {
        let before = best.clone();
        search.fewer(&mut best);
        search.plainer(&mut best);
        if best == before || search.runs >= MAX_RUNS {
            return Shrunk { minimal: search.runs < MAX_RUNS, plan: best, runs: search.runs };
        }
    }
}

struct Search<'s> {
    judge: &'s mut dyn FnMut(&Plan) -> bool,
    runs: u64,
}

impl Search<'_> {
    fn fails(&mut self, plan: &Plan) -> bool {
        if self.runs >= MAX_RUNS {
            return false;
        }
        self.runs += 1;
        (self.judge)(plan)
    }

    /// Leaves out parts of the list, half of it at first, while it still fails.
    fn fewer(&mut self, best: &mut Plan) {
        let mut part = best.faults.len().div_ceil(2).max(1);
        loop {
            let mut at = 0;
            while at < best.faults.len() {
                let mut less = best.clone();
                let end = (at + part).min(less.faults.len());
                less.faults.drain(at..end);
                if self.fails(&less) {
                    *best = less;
                } else {
                    at = end;
                }
            }
            if part == 1 {
                return;
            }
            part = part.div_ceil(2);
        }
    }

    /// Makes each fault plainer, the plainest that still fails first.
    fn plainer(&mut self, best: &mut Plan) {
        for at in 0..best.faults.len() {
            for part in 0..PARTS {
                let fault = best.faults[at].clone();
                for plainer in simpler(&fault, part) {
                    let mut less = best.clone();
                    less.faults[at] = plainer;
                    if self.fails(&less) {
                        *best = less;
                        break;
                    }
                }
            }
        }
    }
}

/// The plans that one step makes of a plan: a part of it left out, or a fault made plainer.
#[cfg(feature = "proptest")]
pub(super) fn steps(plan: &Plan) -> Vec<Plan> {
    let count = plan.faults.len();
    let half = count.div_ceil(2);
    let halves = [0..half, half..count].into_iter().filter(|it| count > 2 && !it.is_empty());
    let without = |part: std::ops::Range<usize>| {
        let mut less = plan.clone();
        less.faults.drain(part);
        less
    };
    let mut steps: Vec<_> = halves.chain((0..count).map(|at| at..at + 1)).map(without).collect();
    for (at, fault) in plan.faults.iter().enumerate() {
        for plainer in (0..PARTS).flat_map(|part| simpler(fault, part)) {
            let mut less = plan.clone();
            less.faults[at] = plainer;
            steps.push(less);
        }
    }
    steps
}

/// How many parts of a fault are made plainer, one after the other.
const PARTS: usize = 4;

/// A part of a fault made plainer, the plainest first; nothing that is not plainer.
fn simpler(fault: &Fault, number: usize) -> Vec<Fault> {
    match (fault, number) {
        (Fault::Failure(it), 0) if it.until.is_some() => {
            vec![Fault::Failure(robots::Injection { until: None, ..*it })]
        }
        (Fault::Failure(it), 2) => {
            let with = |when| Fault::Failure(robots::Injection { when, ..*it });
            moments(it.when).into_iter().map(with).collect()
        }
        (Fault::Failure(robots::Injection { until: Some(until), .. }), 3) => {
            let Fault::Failure(it) = fault else { return Vec::new() };
            let with = |until| Fault::Failure(robots::Injection { until: Some(until), ..*it });
            moments(*until).into_iter().map(with).collect()
        }
        (Fault::Event(it), 0) => {
            let kind = |kind| Fault::Event(cotama_models::missions::faults::Event { kind, ..*it });
            match it.kind {
                EventKind::Obstacle { delay } => round(delay.0.max(1), 1)
                    .into_iter()
                    .map(|it| kind(EventKind::Obstacle { delay: Millis(it) }))
                    .collect(),
                EventKind::Odometry { extra } => round(extra.0.max(1), 1)
                    .into_iter()
                    .map(|it| kind(EventKind::Odometry { extra: Millimetres(it) }))
                    .collect(),
                EventKind::Fault { hardware, units } => {
                    (1..units).map(|units| kind(EventKind::Fault { hardware, units })).collect()
                }
                EventKind::Repair { .. } => Vec::new(),
            }
        }
        (Fault::Event(it), 2) => {
            let at = |x| Fault::Event(cotama_models::missions::faults::Event { x, ..*it });
            round(it.x.0, 0).into_iter().map(|x| at(Millimetres(x))).collect()
        }
        (Fault::Power(it), 0) => {
            let size = u64::from(it.permille.unsigned_abs());
            let with = |permille: u64| {
                let permille = i32::try_from(permille).unwrap_or(0) * it.permille.signum();
                Fault::Power(cotama_models::missions::faults::PowerError { permille, ..*it })
            };
            round(size, 1).into_iter().map(with).collect()
        }
        (Fault::Team(it), 2) => {
            let with = |when| Fault::Team(scenario::Fault { when, ..*it });
            let moments = match it.when {
                FaultTime::At(at) => round(at, 0).into_iter().map(FaultTime::At).collect(),
                FaultTime::During { .. } => Vec::new(),
            };
            moments.into_iter().map(with).collect()
        }
        _ => Vec::new(),
    }
}

/// Plainer moments: the start, then the same kind with a rounder number.
fn moments(when: Moment) -> Vec<Moment> {
    let start = (when != Moment::At(Millis(0))).then_some(Moment::At(Millis(0)));
    let (number, with): (u64, Box<dyn Fn(u64) -> Moment>) = match when {
        Moment::Place(x) => (x.0, Box::new(|it| Moment::Place(Millimetres(it)))),
        Moment::At(time) => (time.0, Box::new(|it| Moment::At(Millis(it)))),
        Moment::During(part, after) => {
            (after.0, Box::new(move |it| Moment::During(part, Millis(it))))
        }
        Moment::Waiting(after) => (after.0, Box::new(|it| Moment::Waiting(Millis(it)))),
    };
    start.into_iter().chain(round(number, 0).into_iter().map(with)).collect()
}

/// Rounder numbers near a number, the roundest first: fewer digits that are not zero, then smaller.
fn round(value: u64, least: u64) -> Vec<u64> {
    let mut found = vec![least];
    let mut unit = 10_u64.pow(value.checked_ilog10().unwrap_or(0));
    while unit > 0 {
        let below = value / unit * unit;
        found.extend([below, below + unit].into_iter().filter(|it| *it >= least));
        unit /= 10;
    }
    let digits = |it: u64| it.to_string().bytes().filter(|it| *it != b'0').count();
    let key = |it: u64| (digits(it), it);
    found.retain(|it| key(*it) < key(value));
    found.sort_unstable_by_key(|it| key(*it));
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::round;

    #[test]
    fn numbers_become_rounder_and_then_smaller() {
        assert_eq!(round(17_935, 0), [0, 10_000, 20_000, 17_000, 18_000, 17_900, 17_930, 17_940]);
        assert_eq!(round(20_000, 0), [0]);
        assert_eq!(round(20_000, 1), [1]);
        assert!(round(0, 0).is_empty() && round(1, 1).is_empty());
    }
}
