//! Whether a coalition can carry out a plan at all: before any bid is asked for (3.4.2).

use super::capability::{CapabilitySet, Robot};
use super::constraint::{Alternatives, Constraint};
use super::task::Role;
use super::thesis;
use cotama_core::team::{Cost, Fixed};

/// The most roles, robots, and smallest sets of capabilities of one role.
pub const MAX_PRUNED: usize = 16;

/// Results of three ever sharper conditions on a coalition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capable {
    /// All robots together could fill each role (cap1, def. 3.12).
    pub union: bool,
    /// Each role has a robot that can fill it (cap2, def. 3.17).
    pub roles: bool,
    /// Each role has a robot of its own that can fill it (cap3, def. 3.18).
    pub matching: bool,
}

/// Whether these robots can fill the roles of a plan. None where roles, robots or the smallest sets
/// of capabilities that fill a role are more than [`MAX_PRUNED`].
///
/// ```
/// use cotama_models::team::{capable, service::{BRING, EDDIE, FETCH, JIMMY, POPPY}};
/// let both = &[FETCH, BRING];
/// assert!(capable(both, &[EDDIE, POPPY]).unwrap().matching);
/// let mute = capable(both, &[JIMMY, POPPY]).unwrap();
/// assert!(!mute.union); // nobody can speak
/// ```
pub fn capable(plan: &[Role<'_>], robots: &[Robot<'_>]) -> Option<Capable> {
    let mut roles = [Alternatives::<MAX_PRUNED>::NONE; MAX_PRUNED];
    for (slot, role) in roles.iter_mut().zip(plan) {
        // Any of the action plans, all of its actions (3.6).
        for way in role.plans {
            let mut all = Constraint::NOTHING.alternatives()?;
            for action in way.actions {
                all = all.both(&action.needs.alternatives()?)?;
            }
            *slot = slot.either(&all)?;
        }
    }
    let mut sets = [CapabilitySet::NONE; MAX_PRUNED];
    sets.iter_mut().zip(robots).for_each(|(set, robot)| *set = robot.capabilities());
    let sets = sets.map(|it| u64::from(it.bits()));
    let (mut needed, mut entries) =
        ([&[][..]; MAX_PRUNED], [None::<Cost>; MAX_PRUNED * MAX_PRUNED]);
    needed.iter_mut().zip(&roles).for_each(|(slot, role)| *slot = role.bits());
    let (needed, sets) = (needed.get(..plan.len())?, sets.get(..robots.len())?);
    let mut fixed = Fixed::<i32, MAX_PRUNED, MAX_PRUNED>::new();
    Some(Capable {
        union: thesis::has_union(needed, sets),
        roles: thesis::has_roles(needed, sets),
        matching: thesis::has_matching(needed, sets, &mut entries, &mut fixed.memory())?,
    })
}
