//! Pruning of coalitions by capability (3.4.2, 3.5.2.3): three conditions that a coalition must
//! meet to carry out a plan, each within the one before it.
//!
//! Capabilities are bits. A role is any of some sets of which all capabilities are needed; so more
//! capabilities never make a robot less capable, and the conditions follow from one another.

use cotama_core::team::Memory;
use cotama_core::team::assign;
use cotama_core::team::{Cost, Costs};

/// Whether a robot with these capabilities can fill the role.
fn can(capabilities: u64, role: &[u64]) -> bool {
    role.iter().any(|needed| needed & !capabilities == 0)
}

/// cap1 (def. 3.12): all robots together could fill each role.
pub fn has_union(roles: &[&[u64]], robots: &[u64]) -> bool {
    let union = robots.iter().fold(0, |all, it| all | it);
    roles.iter().all(|it| can(union, it))
}

/// cap2 (def. 3.17): each role has a robot that can fill it.
pub fn has_roles(roles: &[&[u64]], robots: &[u64]) -> bool {
    roles.iter().all(|role| robots.iter().any(|it| can(*it, role)))
}

/// cap3 (def. 3.18): each role has a robot of its own that can fill it. None where `entries`, with
/// room for roles times robots, or `memory` is too small.
pub fn has_matching(
    roles: &[&[u64]],
    robots: &[u64],
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i32>,
) -> Option<bool> {
    let entries = entries.get_mut(..roles.len().saturating_mul(robots.len()))?;
    if robots.is_empty() {
        return Some(roles.is_empty());
    }
    for (row, role) in entries.chunks_mut(robots.len()).zip(roles) {
        for (entry, robot) in row.iter_mut().zip(robots) {
            *entry = if can(*robot, role) { Cost::new(0) } else { None };
        }
    }
    let costs = Costs::new(entries, robots.len())?;
    match assign(&costs, memory) {
        Ok(_) => Some(true),
        Err(cotama_core::team::AssignmentError::Infeasible { .. }) => Some(false),
        Err(_) => None,
    }
}
