//! Whether a marking is reachable, and a shortest way to it.

use super::block::Block;
use super::explore::{End, explore};
use super::goal::Goal;
use super::growth::growth;
use super::layout::Width;
use super::plan::Plan;
use super::space::{Search, Space, TooNarrow, search};
use super::table::Table;
use super::{Limit, Limits, Progress, Unfinished, wide};
use crate::property::Linear;
use crate::pt::Pt;
use cotama_core::net::TransitionId;
use std::sync::atomic::AtomicI64;

/// What a search for a marking found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reached {
    /// There is one.
    Trace {
        /// A shortest way from the initial marking to one.
        transitions: Vec<TransitionId>,
        /// How many markings were reached: those of all levels up to the one that has it.
        states: u64,
    },
    /// There is none.
    Never {
        /// How many markings are reachable.
        states: u64,
    },
    /// None was found before a limit was reached.
    Unknown {
        /// The limit.
        limit: Limit,
        /// How many markings were reached; none of them is one.
        states: u64,
    },
}

impl Reached {
    /// How many markings were reached.
    pub fn states(&self) -> u64 {
        match *self {
            Self::Trace { states, .. } | Self::Never { states } | Self::Unknown { states, .. } => {
                states
            }
        }
    }
}

/// Searches for a marking in which the goal holds, on so many threads.
///
/// The way to it is the same on any number of threads: of all markings of the first level that has
/// one the least as it is packed, and from there back at each step the transition that comes first
/// in the net. `progress` is called by this thread now and then.
///
/// ```
/// use cotama_core::net::TransitionId;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::{Goal, Limits, Reached, reach};
/// use cotama_verification::property::{Atom, Formula};
/// use cotama_verification::pt::Pt;
///
/// let mut fuse = OwnedNet::new("fuse", "A fuse that blows.");
/// let whole = fuse.place(OwnedPlace::new("whole", 1)).unwrap();
/// fuse.transition(OwnedTransition::new("blow").take(whole, 1)).unwrap();
/// let fuse = Pt::from(&fuse.view().net());
///
/// let deadlock = Formula::Atom(Atom::Deadlock);
/// let goal = Goal::new(&deadlock).expect("it speaks of one marking");
/// let reached = reach(&fuse, goal, &Limits::default(), 1, &|_| ());
/// assert_eq!(reached, Reached::Trace { transitions: vec![TransitionId(0)], states: 2 });
/// ```
pub fn reach(
    pt: &Pt,
    goal: Goal<'_>,
    limits: &Limits,
    jobs: usize,
    progress: &dyn Fn(Progress),
) -> Reached {
    Width::of(pt, limits)
        .and_then(|it| search(pt, it, &mut Reach { pt, goal, limits, jobs, progress }))
        .or_else(|limit| match limit {
            Limit::Words => wide::reach(pt, goal, limits, progress),
            limit => Err(limit),
        })
        .unwrap_or_else(|limit| Reached::Unknown { limit, states: 0 })
}

/// The most that a sum of tokens ever is, and how many markings are reachable.
///
/// # Errors
/// The limit that was reached; [`Limit::Unbounded`] when tokens were seen to grow without end.
pub(crate) fn most(
    pt: &Pt,
    sum: &Linear,
    limits: &Limits,
    jobs: usize,
    progress: &dyn Fn(Progress),
) -> Result<(i64, u64), Unfinished> {
    let none = |limit| Unfinished { limit, states: 0 };
    let widths = Width::of(pt, limits).map_err(none)?;
    if !widths.iter().all(|it| it.proved) && growth(pt, limits).is_some() {
        return Err(none(Limit::Unbounded));
    }
    let seen = AtomicI64::new(i64::MIN);
    match reach(pt, Goal::most(sum, &seen), limits, jobs, progress) {
        Reached::Unknown { limit, states } => Err(Unfinished { limit, states }),
        it => Ok((seen.into_inner(), it.states())),
    }
}

struct Reach<'r> {
    pt: &'r Pt,
    goal: Goal<'r>,
    limits: &'r Limits,
    jobs: usize,
    progress: &'r dyn Fn(Progress),
}

impl Search for Reach<'_> {
    type Found = Reached;

    fn search<const S: usize>(&mut self, space: Space) -> Result<Reached, TooNarrow> {
        let goal = self.goal.packed();
        let Self { pt, limits, jobs, progress, .. } = *self;
        let explored =
            explore::<S>(&space, Plan { pt, limits, jobs, progress, goal: Some(&goal) })?;
        let states = explored.states;
        Ok(match explored.end {
            End::Exhausted => Reached::Never { states },
            End::Limit(limit) => Reached::Unknown { limit, states },
            End::Found => {
                let first = explored.goals.into_iter().min().unwrap_or_else(|| space.initial());
                Reached::Trace { transitions: way(&space, &explored.levels, first), states }
            }
        })
    }
}

/// The way from the only marking of the first of these levels to a marking that follows the last
/// one.
fn way<const S: usize>(
    space: &Space,
    levels: &[Vec<Block<S>>],
    mut to: [u64; S],
) -> Vec<TransitionId> {
    let deltas = space.deltas::<S>();
    let (mut view, mut seen) = (space.enabling.view(), space.enabling.unseen());
    let mut way = Vec::with_capacity(levels.len());
    for level in levels.iter().rev() {
        let before = |delta: &[u64; S]| std::array::from_fn(|at| to[at].wrapping_sub(delta[at]));
        let candidates = Table::of(deltas.iter().map(before).collect());
        let mut first: Option<(u32, [u64; S])> = None;
        for from in level.iter().flat_map(|it| &it.markings).filter(|it| candidates.contains(it)) {
            space.enabling.look(from, &mut view, &mut seen);
            let leads = |&it: &u32| before(&deltas[it as usize]) == *from;
            if let Some(transition) = view.transitions().find(leads) {
                first = first.into_iter().chain([(transition, *from)]).min();
            }
        }
        let Some((transition, from)) = first else { break };
        way.push(TransitionId(transition));
        to = from;
    }
    way.reverse();
    way
}
