//! The coalitions that can do a task, and the robots without which none can.

use super::draft::Draft;
use super::team::{Defect, Job};
use cotama_core::net::PlaceId;

/// All subsets of so many, smallest first.
pub(super) fn subsets(of: &[usize], sizes: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let all = (0_u32..1 << of.len()).map(|bits| {
        of.iter().enumerate().filter(|it| bits >> it.0 & 1 == 1).map(|it| *it.1).collect()
    });
    let mut all: Vec<Vec<usize>> = all.filter(|it: &Vec<usize>| sizes(it.len())).collect();
    all.sort_by_key(Vec::len);
    all
}

/// The smallest sets of these robots without which no coalition is left, smallest first.
pub(super) fn blockers(robots: &[usize], coalitions: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    for set in subsets(robots, |_| true) {
        let blocks = coalitions.iter().all(|it| it.iter().any(|r| set.contains(r)));
        let is_least = !found.iter().any(|it| it.iter().all(|r| set.contains(r)));
        if blocks && is_least {
            found.push(set);
        }
    }
    found
}

/// Whether each of these roles can have one of as many robots of its own, along paths of exchanges.
fn staffs(roles: &[Vec<usize>], robots: &[usize]) -> bool {
    fn finds(role: usize, of: &[Vec<usize>], looked: &mut [bool], fills: &mut [Free]) -> bool {
        for at in 0..fills.len() {
            if !looked[at] && of[role].contains(&fills[at].robot) {
                looked[at] = true;
                let free = match fills[at].role {
                    None => true,
                    Some(other) => finds(other, of, looked, fills),
                };
                if free {
                    fills[at].role = Some(role);
                    return true;
                }
            }
        }
        false
    }
    let mut fills: Vec<_> = robots.iter().map(|&robot| Free { robot, role: None }).collect();
    let each = |role| finds(role, roles, &mut vec![false; robots.len()], &mut fills);
    roles.len() == robots.len() && (0..roles.len()).all(each)
}

/// A robot, and the role that it has so far.
struct Free {
    robot: usize,
    role: Option<usize>,
}

impl Job {
    /// The sets of robots of which each can have a role of its own in one of the plans, smallest
    /// first.
    pub(super) fn coalitions(&self) -> Vec<Vec<usize>> {
        let sizes = |size| self.plans.iter().any(|it| it.len() == size);
        let mut all = subsets(&self.capable(), sizes);
        all.retain(|set| self.plans.iter().any(|it| staffs(it, set)));
        all
    }
}

impl Draft<'_> {
    /// The coalitions that an auctioneer considers.
    pub(super) fn coalitions(&self, task: usize) -> Vec<Vec<usize>> {
        let job = &self.team.tasks[task];
        if self.has(Defect::NamesIncapable) {
            let sizes = |size| job.plans.iter().any(|it| it.len() == size);
            return subsets(&self.bidders(task), sizes);
        }
        job.coalitions()
    }

    /// The coalitions that a robot is in, each without it.
    pub(super) fn partners(&self, task: usize, r: usize) -> Vec<Vec<usize>> {
        let all = self.coalitions(task).into_iter().filter(|it| it.contains(&r));
        all.map(|it| it.into_iter().filter(|p| *p != r).collect()).collect()
    }

    /// Returns the robots that bid for a task.
    pub(super) fn bidders(&self, task: usize) -> Vec<usize> {
        if self.has(Defect::NamesIncapable) {
            return (0..self.team.robots).collect();
        }
        self.team.tasks[task].capable()
    }

    /// Returns what tells that an award names this coalition and not a larger one: the others of
    /// those are silent.
    pub(super) fn others_silent(&self, task: usize, coalition: &[usize]) -> Vec<PlaceId> {
        let is_of = |it: &&Vec<usize>| coalition.iter().all(|r| it.contains(r));
        let all = self.coalitions(task);
        let others = all.iter().filter(is_of).flatten().filter(|r| !coalition.contains(r));
        others.map(|&r| self.tasks[task].answers[r].silent).collect()
    }
}
