//! Whether a marking is reachable, and a shortest path to it.

use super::block::Block;
use super::explore::{End, explore};
use super::figures::OF_AN_UNBOUNDED_NET;
use super::goal::Goal;
use super::growth::growth;
use super::layout::Width;
use super::plan::Plan;
use super::reached::Reached;
use super::space::{Search, Space, TooNarrow, search};
use super::table::Table;
use super::{Limit, Limits, Progress, Unfinished, wide};
use cotama_core::net::TransitionId;
use cotama_property::Linear;
use cotama_property::pt::Pt;
use std::sync::atomic::AtomicI64;

/// Searches for a marking in which the goal holds, on so many threads.
///
/// The path to it is the same on any number of threads: of all markings of the first level that has
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
    let found = Width::of(pt, limits).and_then(|it| {
        // A plain net that grows has engines of its own.
        let grows = || !it.iter().all(|it| it.proved) && growth(pt, limits).is_some();
        let few = Limits { states: limits.states.min(OF_AN_UNBOUNDED_NET), ..*limits };
        let grows = !pt.is_plain() && grows();
        let limits = if grows { &few } else { limits };
        let found = search(pt, it, &mut Reach { pt, goal, limits, jobs, progress })?;
        Ok(match found {
            Reached::Unknown { limit: Limit::States, states } if grows => {
                Reached::Unknown { limit: Limit::Unbounded, states }
            }
            found => found,
        })
    });
    found
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
                Reached::Trace { transitions: path(&space, &explored.levels, first), states }
            }
        })
    }
}

/// The path from the only marking of the first of these levels to a marking that follows the last
/// one.
fn path<const S: usize>(
    space: &Space,
    levels: &[Vec<Block<S>>],
    mut to: [u64; S],
) -> Vec<TransitionId> {
    let firings = space.firings::<S>();
    let (mut view, mut seen) = (space.enabling.view(), space.enabling.unseen());
    let mut path = Vec::with_capacity(levels.len());
    for level in levels.iter().rev() {
        let candidates = firings.before(&to).map(Table::of);
        let may_lead = |it: &&[u64; S]| candidates.as_ref().is_none_or(|all| all.contains(it));
        let mut first: Option<(u32, [u64; S])> = None;
        for from in level.iter().flat_map(|it| &it.markings).filter(may_lead) {
            space.enabling.look(from, &mut view, &mut seen);
            let leads = |&it: &u32| firings.after(from, it) == to;
            if let Some(transition) = view.transitions().find(leads) {
                first = first.into_iter().chain([(transition, *from)]).min();
            }
        }
        let Some((transition, from)) = first else { break };
        path.push(TransitionId(transition));
        to = from;
    }
    path.reverse();
    path
}
