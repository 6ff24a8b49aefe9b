//! Whether all tasks that must be done can have robots at all, whatever they cost: counted and
//! matched (P. Hall, 1935) before anything is searched for.

use super::Instance;
use super::solve::Reason;
use std::collections::BTreeSet;

/// Larger teams are not asked.
const MOST_ROBOTS: usize = 1 << 12;

/// A robot that is needed, and the robots of which it can be one.
struct Need {
    task: usize,
    capable: Vec<usize>,
}

/// Needs that have a robot of their own each.
struct Staff {
    needs: Vec<Need>,
    /// The need that each robot is for.
    of_robot: Vec<Option<usize>>,
}

impl Instance {
    /// Tasks that must be done and need more robots than can do any of them, with these robots;
    /// nothing where each can have robots of its own.
    ///
    /// A task of one plan needs a robot for each role. One of several plans needs as many as its
    /// smallest, of those that are capable of a role in any: less than it needs, perhaps, and never
    /// more.
    pub(super) fn understaffed(&self) -> Option<Reason> {
        let robots = self.robots.len();
        if robots > MOST_ROBOTS {
            return None;
        }
        let mut staff = Staff { needs: vec![], of_robot: vec![None; robots] };
        for (task, it) in self.tasks.iter().enumerate().filter(|it| it.1.skip.is_none()) {
            let capable = |roles: &mut dyn Iterator<Item = usize>, costs: &[Option<_>]| {
                let roles: Vec<_> = roles.collect();
                let can = |robot: &usize| {
                    let cost = |role: &usize| costs.get(role * robots + robot).copied().flatten();
                    roles.iter().any(|role| cost(role).is_some())
                };
                (0..robots).filter(can).collect::<BTreeSet<_>>()
            };
            let rows: Vec<BTreeSet<usize>> = match it.plans.as_slice() {
                [plan] => {
                    let one = |role| capable(&mut std::iter::once(role), &plan.costs);
                    (0..plan.roles.len()).map(one).collect()
                }
                plans => {
                    let any =
                        |it: &super::InstancePlan| capable(&mut (0..it.roles.len()), &it.costs);
                    let any: BTreeSet<_> = plans.iter().flat_map(any).collect();
                    let least = plans.iter().map(|it| it.roles.len()).min().unwrap_or(0);
                    vec![any; least.min(robots + 1)]
                }
            };
            for capable in rows {
                let need = Need { task, capable: capable.into_iter().collect() };
                if let Some(conflict) = staff.takes(need) {
                    return Some(conflict);
                }
            }
        }
        None
    }
}

impl Staff {
    /// Gives one more need a robot, along a shortest path of exchanges; if none is left, the tasks
    /// and the robots that show it.
    fn takes(&mut self, need: Need) -> Option<Reason> {
        let added = self.needs.len();
        self.needs.push(need);
        // The robot before each that was looked at: the need that wants it.
        let mut wanted_by: Vec<Option<usize>> = vec![None; self.of_robot.len()];
        let (mut asked, mut looked) = (vec![added], 0);
        while let Some(&at) = asked.get(looked) {
            looked += 1;
            for &robot in &self.needs[at].capable {
                if wanted_by[robot].is_some() {
                    continue;
                }
                wanted_by[robot] = Some(at);
                let Some(other) = self.of_robot[robot] else {
                    self.exchange(robot, &wanted_by, added);
                    return None;
                };
                asked.push(other);
            }
        }
        let tasks: BTreeSet<_> = asked.iter().map(|it| self.needs[*it].task).collect();
        let robots = wanted_by.iter().enumerate().filter(|it| it.1.is_some());
        Some(Reason { tasks: tasks.into_iter().collect(), robots: robots.map(|it| it.0).collect() })
    }

    /// The last robot of a path is free: each need on it takes the robot that it wants.
    fn exchange(&mut self, free: usize, wanted_by: &[Option<usize>], added: usize) {
        let mut robot = free;
        while let Some(need) = wanted_by[robot] {
            let before = self.of_robot.iter().position(|it| *it == Some(need));
            self.of_robot[robot] = Some(need);
            if need == added {
                return;
            }
            let Some(before) = before else { return };
            robot = before;
        }
    }
}
