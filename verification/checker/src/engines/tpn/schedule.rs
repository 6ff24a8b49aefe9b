//! When to fire what: dates for a firing sequence.

use super::bound::Bound;
use super::classes::Classes;
use super::domain::Domain;
use super::markings::{ANEW, Rules};
use super::{Limit, Limits};
use cotama_core::net::TransitionId;
use cotama_property::schedule::{Date, Schedule, Step};
use cotama_property::time::{Interval, TimeNet};
use std::fmt;

/// Why a sequence has no dates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSchedule {
    /// The firing at this position, from 0, is not enabled, or there is no such transition.
    Disabled(usize),
    /// The firing at this position is enabled, but never in time: others must fire before.
    TooLate(usize),
    /// A place would hold too many tokens, or a date is too far away.
    Overflow,
}

impl fmt::Display for NoSchedule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Disabled(at) => write!(f, "firing {} of the sequence is not enabled", at + 1),
            Self::TooLate(at) => {
                write!(f, "before firing {} of the sequence another one is due", at + 1)
            }
            Self::Overflow => f.write_str("a number of tokens or a time is too large"),
        }
    }
}

impl std::error::Error for NoSchedule {}

/// Dates for a firing sequence.
///
/// ```
/// use cotama_verification::{tina, tpn};
///
/// let net =
///     tina::read("lamp.net", b"pl off (1)  tr press [3,5] off -> on  tr fade ]2,3[ on -> off")
///         .unwrap();
/// let [press, fade] = ["press", "fade"].map(|it| net.transition(it).unwrap());
/// let run = tpn::schedule(&net, &[press, fade, press]).unwrap();
/// let dates: Vec<_> = run.steps.iter().map(|step| step.date.to_string()).collect();
/// assert_eq!(dates, ["3", "5.5", "8.5"]);
/// assert_eq!(tpn::schedule(&net, &[press, press]), Err(tpn::NoSchedule::Disabled(1)));
/// ```
///
/// # Errors
/// When no run of the net fires these transitions in this order.
pub fn schedule(net: &TimeNet, sequence: &[TransitionId]) -> Result<Schedule, NoSchedule> {
    let dates = Constraints::new(net, sequence)?.dates().ok_or(NoSchedule::Overflow)?;
    let steps = sequence.iter().zip(dates).map(|(&transition, date)| Step { transition, date });
    Ok(Schedule { steps: steps.collect() })
}

/// Whether a marking can be reached.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reach {
    /// By this run, one of those with the fewest firings.
    Reached(Schedule),
    /// The formula holds in no reachable class; so many classes were explored.
    Unreachable {
        /// Number of classes.
        classes: usize,
    },
    /// The work was cut short.
    Unknown {
        /// The limit that was reached.
        limit: Limit,
        /// How many classes were met.
        classes: usize,
    },
}

/// Whether a marking that `goal` accepts can be reached. It gets the tokens of each place, and each
/// marking once.
///
/// ```
/// use cotama_verification::{tina, tpn};
///
/// let net = tina::read(
///     "race.net",
///     b"tr fast [1,2] idle -> won  tr slow ]2,3] idle -> lost  pl idle (1)",
/// )
/// .unwrap();
/// let lost = net.place("lost").unwrap().0 as usize;
/// let reach = tpn::reach(&net, |tokens| tokens[lost] > 0, &tpn::Limits::default());
/// assert_eq!(reach, tpn::Reach::Unreachable { classes: 2 }); // without time it can
/// ```
pub fn reach(net: &TimeNet, mut goal: impl FnMut(&[u32]) -> bool, limits: &Limits) -> Reach {
    let mut classes = Classes::none(net);
    let found = match classes.explore(limits, false, |tokens| goal(tokens)) {
        Ok(Some(found)) => found,
        Ok(None) => return Reach::Unreachable { classes: classes.classes() },
        Err(limit) => return Reach::Unknown { limit, classes: classes.classes() },
    };
    // The path is one of the net, so only an overflow can keep it from having dates.
    schedule(net, &classes.path(found))
        .map_or(Reach::Unknown { limit: Limit::Tokens, classes: classes.classes() }, Reach::Reached)
}

/// Whether a marking can be reached that enables nothing.
///
/// ```
/// use cotama_verification::tina;
/// use cotama_verification::tpn::{Limits, Reach, deadlock};
/// let net = tina::read("egg.net", b"tr boil [300,360] raw -> hard  pl raw (1)").unwrap();
/// let Reach::Reached(schedule) = deadlock(&net, &Limits::default()) else { panic!("it ends") };
/// assert_eq!(schedule.steps[0].date.to_string(), "300");
/// ```
pub fn deadlock(net: &TimeNet, limits: &Limits) -> Reach {
    let pt = net.untimed();
    let transitions = pt.transitions.len() as u32;
    reach(net, |tokens| (0..transitions).all(|it| !pt.enabled(tokens, it)), limits)
}

/// How often all constraints are looked at before a finer time is tried.
const ROUNDS: usize = 64;

/// Bounds of differences between dates. Date 0 is the start, date k the one of the k-th firing,
/// from 1.
struct Constraints {
    /// (earlier, later, the least and the most between them), sorted by the later date.
    between: Vec<(usize, usize, Interval)>,
    count: usize,
}

impl Constraints {
    fn new(net: &TimeNet, sequence: &[TransitionId]) -> Result<Self, NoSchedule> {
        let rules = Rules::new(net);
        let mut markings = super::markings::Markings::new(&rules);
        let mut marking = 0;
        let (mut domain, mut after) =
            (Domain::of_new(&rules, markings.enabled(0)), Domain::default());
        // For each enabled transition the date since when it is.
        let mut since = vec![0; markings.enabled(0).len()];
        let (mut first, mut bounds, mut between) = (Vec::new(), Vec::new(), Vec::new());
        for (at, fired) in sequence.iter().enumerate() {
            let position = markings.enabled(marking).binary_search(&fired.0);
            let position = position.map_err(|_| NoSchedule::Disabled(at))?;
            domain.first(&mut first);
            if first[position + 1] != Bound::ZERO {
                return Err(NoSchedule::TooLate(at));
            }
            let step = markings.step(&rules, marking, position).ok_or(NoSchedule::Overflow)?;
            let enabled = markings.enabled(marking);
            let kept = markings.kept(step);
            let date = at + 1;
            between.push((date - 1, date, Interval::ANY));
            for (position, (&transition, &since)) in enabled.iter().zip(&since).enumerate() {
                let interval = net.transitions()[transition as usize].interval;
                if transition == fired.0 {
                    between.push((since, date, interval));
                } else if interval.upper.is_some()
                    && (!kept.contains(&(position as u32)) || date == sequence.len())
                {
                    // Dates do not decrease: the last one that it sees is enough.
                    between.push((
                        since,
                        date,
                        Interval { lower: 0, lower_strict: false, ..interval },
                    ));
                }
            }
            let old = since;
            since =
                kept.iter().map(|&it| if it == ANEW { date } else { old[it as usize] }).collect();
            domain.fire(
                &rules,
                (position + 1, &first),
                (kept, markings.enabled(step.target)),
                &mut bounds,
                &mut after,
            );
            std::mem::swap(&mut domain, &mut after);
            marking = step.target;
        }
        Ok(Self { between, count: sequence.len() })
    }

    /// The earliest dates, in a time as coarse as is found with little work; `None` when one is too
    /// large.
    ///
    /// With closed bounds there are integers. Else let a unit have n parts, and let each strict
    /// bound be a part tighter. Where dates exist, the bounds along a cycle through strict ones
    /// leave at least a unit of slack, and a cycle has no more bounds than there are dates, the
    /// start included: n need not be larger than their number.
    fn dates(&self) -> Option<Vec<Date>> {
        let mut per_unit = 1_u64;
        loop {
            let last = per_unit > self.count as u64;
            let rounds = if last { self.count + 2 } else { ROUNDS };
            if let Some(dates) = self.earliest(i128::from(per_unit), rounds) {
                let date = |parts: i128| {
                    let parts = u64::try_from(parts).ok()?;
                    let common = parts.trailing_zeros().min(per_unit.trailing_zeros());
                    Some(Date { parts: parts >> common, per_unit: per_unit >> common })
                };
                return dates[1..].iter().map(|&parts| date(parts)).collect();
            }
            if last {
                return None;
            }
            per_unit *= 2;
        }
    }

    /// The least solution in parts of a unit; `None` when it is not found in so many rounds. As
    /// many as there are dates, and one to see it, find it if there is one.
    fn earliest(&self, per_unit: i128, rounds: usize) -> Option<Vec<i128>> {
        let mut dates = vec![0_i128; self.count + 1];
        // Forwards and backwards, as lower bounds push later dates and upper bounds earlier ones.
        // With a solution every round settles a date; without one the dates grow for ever.
        for _ in 0..rounds {
            let mut changed = false;
            for &(early, late, interval) in &self.between {
                let least =
                    i128::from(interval.lower) * per_unit + i128::from(interval.lower_strict);
                let pushed = dates[late].max(dates[early].checked_add(least)?);
                changed |= std::mem::replace(&mut dates[late], pushed) != pushed;
            }
            for &(early, late, interval) in self.between.iter().rev() {
                let Some(upper) = interval.upper else { continue };
                let most = i128::from(upper) * per_unit - i128::from(interval.upper_strict);
                let pushed = dates[early].max(dates[late].checked_sub(most)?);
                changed |= std::mem::replace(&mut dates[early], pushed) != pushed;
            }
            if dates[0] > 0 {
                return None;
            }
            if !changed {
                return Some(dates);
            }
        }
        None
    }
}
