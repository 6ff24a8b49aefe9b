//! PANORAMA under supervisors: which configuration each drive uses, within what is left of the
//! limits. Configurations are those of the robot's file, by number.
//!
//! Configurations of the adapter are task implementation options (Lambert et al., J. Intell. Robot.
//! Syst. 110, 2024, Section 6.2.2), modules are their hardware. A lost module removes options, and
//! the rest of the mission is planned again (Section 7.3.2).

use crate::options::Planner;
use crate::run::{NoPlan, PlanCause, PlanMade};
use crate::solver::{Left, Solver};
use cotama_core::hardware::Equipment;
use cotama_core::units::{MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::missions::Mission;
use cotama_models::missions::tables::{Activity, Alternative, Rest};

/// How far a mission has come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// The activity under way, or the next one.
    pub(crate) activity: usize,
    /// Rest of the current activity; `None` when it is whole.
    pub(crate) rest: Option<Rest>,
    /// When, where (mm), and what was used (ms, mJ).
    pub(crate) now: Millis,
    pub(crate) x_mm: u64,
    pub(crate) used: [u64; 2],
}

/// The plan of a mission under way.
#[derive(Clone, Debug)]
pub(crate) struct Planning<'m> {
    mission: &'m Mission,
    planner: Planner,
    activities: Vec<Activity<'m>>,
    /// The configuration of each alternative, for activities that drive.
    configurations: Vec<Vec<Option<usize>>>,
    choice: Vec<u16>,
    solver: Solver,
    pub(crate) made: Vec<PlanMade>,
}

impl<'m> Planning<'m> {
    /// The plan of a mission that is not made yet.
    pub(crate) fn new(mission: &'m Mission, planner: Planner) -> Self {
        let scenario = mission.scenario();
        let activities = scenario.activities();
        let named = |label: &String| {
            let option =
                label.split(' ').find_map(|id| mission.tios.iter().find(|tio| tio.id == id))?;
            let all = &mission.robot()?.robot().configurations;
            all.iter().position(|it| it.name == option.id)
        };
        let configurations =
            scenario.activities.iter().map(|it| it.labels.iter().map(named).collect()).collect();
        let choice = vec![0; activities.len()];
        Self {
            mission,
            planner,
            activities,
            configurations,
            choice,
            solver: Solver::default(),
            made: Vec::new(),
        }
    }

    /// Plans what is left with this hardware.
    pub(crate) fn plan(
        &mut self,
        cause: PlanCause,
        at: Progress,
        available: Equipment,
    ) -> Result<(), NoPlan> {
        let scenario = self.mission.scenario();
        let first = at.activity;
        let limits =
            std::array::from_fn(|axis| scenario.limits[axis].saturating_sub(at.used[axis]));
        let left = Left {
            activities: &self.activities,
            first,
            rest: at.rest,
            available,
            known: None,
            limits,
            order: scenario.order,
        };
        let proposal = self.solver.propose(self.planner, &left)?;
        let signed_left = limits.map(signed);
        let before = (!self.made.is_empty()).then(|| {
            let rest = self.rest(at).map(signed);
            [signed_left[0] - rest[0], signed_left[1] - rest[1]]
        });
        self.choice[first..].copy_from_slice(&proposal.choice);
        let margin = |axis: usize| signed_left[axis] - signed(proposal.planned.cost[axis]);
        self.made.push(PlanMade {
            cause,
            t_us: at.now.0.saturating_mul(1000),
            x_mm: at.x_mm,
            first_activity: first,
            choice: proposal.choice,
            before,
            after: [margin(0), margin(1)],
            used: at.used,
            first_cost: proposal.first_cost,
            steps: proposal.planned.steps,
            allocator: proposal.allocator,
        });
        Ok(())
    }

    /// Whether what is left of the plan in force needs no other hardware than this.
    pub(crate) fn needs_no_more(&self, at: Progress, units: Equipment) -> bool {
        let left = self.activities.iter().zip(&self.choice).skip(at.activity);
        { left }.all(|(it, &id)| units.covers(it.alternatives[usize::from(id)].needs))
    }

    /// Returns the cost of the rest of the plan in force, in ms and mJ.
    pub(crate) fn rest(&self, at: Progress) -> [u64; 2] {
        let mut sum = [0; 2];
        for (activity, &id) in
            (at.activity..).zip(self.choice.get(at.activity..).unwrap_or_default())
        {
            let activity_table = &self.activities[activity];
            let alternative = &activity_table.alternatives[usize::from(id)];
            let rest = at.rest.filter(|_| activity == at.activity);
            let cost = alternative.cost(rest.unwrap_or_else(|| activity_table.whole(alternative)));
            for (sum, part) in sum.iter_mut().zip(cost.unwrap_or_default()) {
                *sum += u64::from(part);
            }
        }
        sum
    }

    /// The name of the alternative that is planned for an activity, its speed and its power.
    pub(crate) fn planned(&self, activity: usize) -> (&'m str, MillimetresPerSecond, Milliwatts) {
        let id = usize::from(self.choice[activity]);
        let alternative = &self.activities[activity].alternatives[id];
        let label = self.mission.scenario().activities[activity].labels.get(id);
        (label.map_or("", String::as_str), alternative.speed, alternative.power)
    }

    /// The axis, the first in their order, on which the plan no longer keeps its limit.
    pub(crate) fn short(&self, at: Progress) -> Option<usize> {
        let (scenario, rest) = (self.mission.scenario(), self.rest(at));
        scenario.order.into_iter().find(|&axis| at.used[axis] + rest[axis] > scenario.limits[axis])
    }

    /// Returns the pace of an activity in a configuration: speed and power; that of the planned
    /// alternative when none has it.
    pub(crate) fn pace(
        &self,
        activity: usize,
        configuration: Option<usize>,
    ) -> (MillimetresPerSecond, Milliwatts) {
        let alternative = self.driven(activity, configuration);
        (alternative.speed, alternative.power)
    }

    /// Returns the power of standing in a configuration, with its hardware on.
    pub(crate) fn rest_power(&self, activity: usize, configuration: Option<usize>) -> Milliwatts {
        let standing = self.mission.motion_power.at(MillimetresPerSecond(0));
        let hardware = self.mission.power_of(self.driven(activity, configuration).needs);
        Milliwatts(standing.0.saturating_add(hardware.0))
    }

    fn driven(&self, activity: usize, configuration: Option<usize>) -> &Alternative {
        let with = self.configurations[activity]
            .iter()
            .position(|it| it.is_some() && *it == configuration);
        let at = with.unwrap_or_else(|| usize::from(self.choice[activity]));
        &self.activities[activity].alternatives[at]
    }

    /// The activity of an objective that holds a place of the path.
    pub(crate) fn activity(&self, objective: usize, x_mm: u64) -> usize {
        let of = |it: &usize| self.mission.scenario().activities[*it].objective == objective;
        let mut all = (0..self.activities.len()).filter(of);
        let first = all.next().unwrap_or(0);
        all.take_while(|&it| self.activities[it].x_start.0 <= x_mm).last().unwrap_or(first)
    }

    /// How long an activity takes that does not travel.
    pub(crate) fn standing(&self, activity: usize) -> Millis {
        self.activities[activity].alternatives[usize::from(self.choice[activity])].duration
    }
}

fn signed(amount: u64) -> i64 {
    i64::try_from(amount).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::missions::embedded;

    #[test]
    fn a_plan_that_fills_a_limit_to_the_last_unit_keeps_it() {
        let delivery = embedded::mission("delivery").unwrap();
        let mission = Mission::parse(delivery.name, delivery.text).unwrap();
        let mut planning = Planning::new(&mission, Planner::of(&mission));
        let start = Progress { activity: 0, rest: None, now: Millis(0), x_mm: 0, used: [0; 2] };
        planning.plan(PlanCause::Start, start, mission.available()).unwrap();
        let rest = planning.rest(start);
        let left = [0, 1].map(|axis| mission.limits[axis] - rest[axis]);
        let short = |used| planning.short(Progress { used, ..start });
        assert_eq!(short(left), None);
        assert_eq!(short([left[0] + 1, left[1]]), Some(0));
        assert_eq!(short([left[0], left[1] + 1]), Some(1));
        assert_eq!(short(left.map(|it| it + 1)), Some(mission.order[0]));
    }

    #[test]
    fn an_activity_is_under_way_at_its_start() {
        let delivery = embedded::mission("delivery").unwrap();
        let zone = "[[zone]]\nid = \"hall\"\nx_start_mm = 60000\nx_end_mm = 70000\n[run]";
        let text = delivery.text.replacen("[run]", zone, 1);
        let mission = Mission::parse(delivery.name, &text).unwrap();
        let planning = Planning::new(&mission, Planner::of(&mission));
        let at = |x_mm: u64| planning.activity(2, x_mm);
        // The first drive, the object, and three parts of the second drive.
        assert_eq!([40_000, 59_999, 60_000, 69_999, 70_000, 80_000].map(at), [2, 2, 3, 3, 4, 4]);
    }
}
