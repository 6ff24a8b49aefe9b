//! Best first through as few markings as the answer needs.

use super::Closure;
use super::goal::Goal;
use crate::explicit::{self, Limit, Limits, Markings, Progress, Reached};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Markings between two looks at the clock.
const TICK: usize = 256;

/// How many markings are visited before the one that waits longest has its turn.
const PATIENCE: usize = 4;

/// Searches for a marking in which a formula holds, through markings that seem near to it first.
///
/// The path to it is a path, not always a shortest one; the numbers of markings are those that the
/// search met, of which there may be far fewer than are reachable. `None` when the formula speaks
/// of more than one marking, or the net [is not plain](Pt::is_plain). `progress` is called now and
/// then.
///
/// ```
/// use cotama_core::net::TransitionId;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::{Limits, Reached};
/// use cotama_verification::property::{Formula, Question, Reachability, parse};
/// use cotama_verification::pt::Pt;
/// use cotama_checker::stubborn::reach_reduced;
///
/// let mut lamps = OwnedNet::new("lamps", "Two lamps, and a third that nobody asks for.");
/// for lamp in ["a", "b", "c"] {
///     let off = lamps.place(OwnedPlace::new(&format!("{lamp} off"), 1)).unwrap();
///     let on = lamps.place(OwnedPlace::new(&format!("{lamp} on"), 0)).unwrap();
///     lamps.transition(OwnedTransition::new(lamp).take(off, 1).give(on, 1)).unwrap();
/// }
/// let lamps = Pt::from(&lamps.view().net());
/// let property = parse("EF ({a on} & {b on})", &lamps).unwrap();
/// let Question::Formula(formula) = property.question else { panic!("not a formula") };
/// let goal = Reachability::new(&formula).unwrap().goal;
/// let reached = reach_reduced(&lamps, &goal, &Limits::default(), &|_| ()).unwrap();
/// assert_eq!(
///     reached,
///     Reached::Trace { transitions: vec![TransitionId(0), TransitionId(1)], states: 3 }
/// );
/// ```
pub fn reach_reduced(
    pt: &Pt,
    goal: &Formula,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Option<Reached> {
    if !pt.is_plain() {
        return None;
    }
    let only_deadlock = matches!(goal, Formula::Atom(Atom::Deadlock));
    let goal = Goal::new(pt, goal, true)?;
    Some(search(pt, &goal, only_deadlock, limits, progress))
}

/// Searches for a deadlock. The answer is as that of [`reach_reduced`]; of a net that [is not
/// plain](Pt::is_plain) all markings are met.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::{Limits, Reached};
/// use cotama_verification::pt::Pt;
/// use cotama_checker::stubborn::deadlock;
///
/// let mut lamp = OwnedNet::new("lamp", "A lamp.");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// let lamp = Pt::from(&lamp.view().net());
/// assert_eq!(deadlock(&lamp, &Limits::default(), &|_| ()), Reached::Never { states: 2 });
/// ```
pub fn deadlock(pt: &Pt, limits: &Limits, progress: &dyn Fn(Progress)) -> Reached {
    if !pt.is_plain() {
        let deadlock = Formula::Atom(Atom::Deadlock);
        let goal = explicit::Goal::new(&deadlock);
        let unknown = Reached::Unknown { limit: Limit::Work, states: 0 };
        return goal.map_or(unknown, |it| explicit::reach(pt, it, limits, 1, progress));
    }
    let all = (0..pt.transitions.len() as u32).collect();
    search(pt, &Goal::Disabled(all), true, limits, progress)
}

fn search(
    pt: &Pt,
    goal: &Goal,
    only_deadlock: bool,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Reached {
    let mut search = match Search::new(pt, goal, only_deadlock, limits) {
        Ok(search) => search,
        Err(limit) => return Reached::Unknown { limit, states: 0 },
    };
    let found = search.run(progress);
    let states = search.markings.len() as u64;
    match found {
        Ok(Some(marking)) => Reached::Trace { transitions: search.path(marking), states },
        Ok(None) => Reached::Never { states },
        Err(limit) => Reached::Unknown { limit, states },
    }
}

struct Search<'s> {
    pt: &'s Pt,
    goal: &'s Goal,
    only_deadlock: bool,
    markings: Markings<'s>,
    closure: Closure<'s>,
    /// For each marking that from which it was met first, by which transition, and how many firings
    /// from the first one.
    from: Vec<(u32, u32, u32)>,
}

impl<'s> Search<'s> {
    fn new(
        pt: &'s Pt,
        goal: &'s Goal,
        only_deadlock: bool,
        limits: &Limits,
    ) -> Result<Self, Limit> {
        let (markings, closure) = (Markings::new(pt, limits)?, Closure::new(pt));
        Ok(Self { pt, goal, only_deadlock, markings, closure, from: vec![(0, 0, 0)] })
    }

    /// A marking in which the goal holds, if there is one.
    fn run(&mut self, progress: &dyn Fn(Progress)) -> Result<Option<u32>, Limit> {
        let distance = self.goal.distance(self.pt, self.markings.look(0));
        if distance == 0 {
            return Ok(Some(0));
        }
        // The nearest first, and of these the one that was met last; in between the one that waits
        // longest, so that a goal that is not far is found wherever the distance leads.
        let mut near = BinaryHeap::from([(Reverse(distance), 0_u32)]);
        let (mut visited, mut oldest, mut is_visited) = (0_usize, 0_u32, Vec::new());
        while let Some((_, mut marking)) = near.pop() {
            self.markings.memory.extend(&mut is_visited, self.from.len(), false)?;
            if is_visited[marking as usize] {
                continue;
            }
            // The work for a marking grows with the net.
            let tick = TICK.min((1 << 16) / (1 + self.pt.transitions.len())).max(1);
            if visited.is_multiple_of(tick) {
                self.markings.check_time()?;
                let (states, depth) =
                    (self.markings.len() as u64, self.from[marking as usize].2.into());
                progress(Progress { states, depth, waiting: near.len() as u64 });
            }
            visited += 1;
            if !self.only_deadlock && visited.is_multiple_of(PATIENCE) {
                while is_visited[oldest as usize] {
                    oldest += 1;
                }
                near.push((Reverse(0), marking));
                marking = oldest;
            }
            is_visited[marking as usize] = true;
            for transition in self.stubborn(marking) {
                let next = self.markings.fire(marking, transition)?;
                if (next as usize) < self.from.len() {
                    continue;
                }
                let depth = self.from[marking as usize].2.saturating_add(1);
                self.markings.memory.room(&mut self.from, 1)?;
                // The entry waits, once more after it was passed over, in a list that doubles.
                self.markings.memory.take(4 * size_of::<(Reverse<u64>, u32)>() as u64)?;
                self.from.push((marking, transition, depth));
                let distance = self.goal.distance(self.pt, self.markings.look(next));
                if distance == 0 {
                    return Ok(Some(next));
                }
                near.push((Reverse(distance), next));
            }
        }
        Ok(None)
    }

    /// The transitions to be fired in a marking in which the goal does not hold.
    fn stubborn(&mut self, marking: u32) -> Vec<u32> {
        let look = self.markings.look(marking);
        if self.only_deadlock {
            return self.closure.persistent(look, |_| true).unwrap_or_default();
        }
        let mut best: Option<Vec<u32>> = None;
        for needed in self.goal.needed(&self.closure, self.pt, look) {
            let set = self.closure.around(look, &needed);
            if best.as_ref().is_none_or(|best| set.len() < best.len()) {
                best = Some(set);
            }
        }
        best.unwrap_or_default()
    }

    fn path(&self, mut marking: u32) -> Vec<TransitionId> {
        let mut path = Vec::new();
        while marking != 0 {
            let (from, transition, _) = self.from[marking as usize];
            path.push(TransitionId(transition));
            marking = from;
        }
        path.reverse();
        path
    }
}
