//! Batteries: what is left, the way home, the charger.

use super::{Event, World};
use crate::fleet::charge::Errand;
use crate::fleet::message::{Message, Party};
use crate::fleet::record::Record;
use crate::fleet::world::robot::Duty;
use cotama_models::team::ErrorClass;
use cotama_models::team::scenario::{Outlook, RoleSpec, Spot, Stage};

/// A battery with less than this, in thousandths, is worth a way home.
const NEARLY_FULL: u64 = 950;

impl World<'_> {
    /// Returns what is left in the battery of a robot, in mJ; `None` where nobody counts it.
    fn left_mj(&self, robot: usize) -> Option<u64> {
        let agent = &self.robots[robot];
        let charge = agent.charge.as_ref()?;
        let left = charge.left_mj(self.now, &agent.driver);
        debug_assert!(left <= charge.full_mj, "a battery holds no more than it can");
        Some(left)
    }

    /// Whether the charge of a robot is too little for a role and the way home.
    pub(super) fn is_short(&self, robot: usize, role: &RoleSpec, outlook: &Outlook<'_>) -> bool {
        let Some(charge) = &self.robots[robot].charge else { return false };
        let needs = self.scenario.needs_mj(role, outlook);
        let short = needs.is_none_or(|it| self.left_mj(robot).is_some_and(|left| left < it));
        charge.declined.set(charge.declined.get() || short);
        short
    }

    /// A robot looks at its battery: it may be empty, or be needed for the way home.
    pub(super) fn looks_at_charge(&mut self, robot: usize) {
        let agent = &self.robots[robot];
        let (Some(left), Some(supply)) = (self.left_mj(robot), self.scenario.robots[robot].supply)
        else {
            return;
        };
        let declined = agent.charge.as_ref().is_some_and(|it| it.declined.take());
        if !agent.driver.thinks() || agent.errand == Some(Errand::Charges) {
            return;
        }
        if left == 0 {
            self.note(|t_ms| Record::Empty { t_ms, robot });
            let now = self.now;
            self.dies(robot);
            self.robots[robot].driver.runs_empty(now);
            return;
        }
        let (Some(pace), None) = (agent.driver.pace(), agent.errand) else { return };
        let spec = &self.scenario.robots[robot];
        let Some(home) = self.scenario.home_mj(spec, self.spot(robot), pace) else { return };
        let full = spec.full_mj();
        let reserve = full / 1_000 * u64::from(supply.reserve_permille);
        match agent.duty {
            Duty::Executing(_) if left < home + reserve / 2 => {
                let (class, why) = (ErrorClass::SemiRecoverable, "its battery needs the way home");
                self.give_back(robot, class, why);
                self.drives_home(robot, Spot::at(supply.home));
            }
            Duty::Free
                if left / NEARLY_FULL < full / 1_000 && (declined || left < home + 2 * reserve) =>
            {
                self.drives_home(robot, Spot::at(supply.home));
            }
            _ => {}
        }
    }

    /// A free robot drives home.
    fn drives_home(&mut self, robot: usize, home: Spot) {
        let Some(way) = self.scenario.floor.distance(self.robots[robot].spot, home) else { return };
        let charge_mj = self.left_mj(robot).unwrap_or(0);
        self.note(|t_ms| Record::GoesHome { t_ms, robot, charge_mj });
        let (now, agent) = (self.now, &mut self.robots[robot]);
        agent.errand = Some(Errand::Home);
        let fit = agent.is_fit();
        self.send(
            Party::Robot(robot),
            self.desk(robot),
            Message::Alive { busy: true, fit, asks: false },
        );
        if way == 0 {
            self.charges(robot);
            return;
        }
        let agent = &mut self.robots[robot];
        agent.goals = [home; 2];
        agent.driver.begin(now, [way, 0], [0; 2]);
        self.enter(robot, Stage::ToTake);
        self.wake(robot);
    }

    /// A robot without a task has come to another stage.
    pub(super) fn on_its_own(&mut self, robot: usize, stage: Stage) {
        if self.robots[robot].errand == Some(Errand::Home) {
            match stage {
                Stage::Takes => {
                    let (now, agent) = (self.now, &mut self.robots[robot]);
                    agent.driver.forget(now);
                    self.enter(robot, Stage::Rests);
                    self.charges(robot);
                    return;
                }
                Stage::Stops | Stage::Safe => {
                    self.stop_short(robot);
                    self.robots[robot].errand = None;
                }
                _ => {}
            }
        }
        self.enter(robot, stage);
    }

    /// A robot at home is charged until it is full.
    fn charges(&mut self, robot: usize) {
        let spec = &self.scenario.robots[robot];
        let (Some(left), Some(supply)) = (self.left_mj(robot), spec.supply) else { return };
        let mw = supply.charger_mw();
        let (now, agent) = (self.now, &mut self.robots[robot]);
        agent.errand = Some(Errand::Charges);
        let Some(charge) = &mut agent.charge else { return };
        charge.charger = Some((now, mw));
        let lacks = charge.full_mj.saturating_sub(left).saturating_mul(1_000);
        let until = now + lacks.div_ceil(mw.saturating_sub(spec.power_mw(0)).max(1));
        // Others may wait for it.
        self.stirred = self.stirred.max(until);
        self.queue.push(until, 1, Event::Charged(robot));
    }

    /// The battery of a robot is full.
    pub(super) fn charged(&mut self, robot: usize) {
        let left = self.left_mj(robot).unwrap_or(0);
        let (now, agent) = (self.now, &mut self.robots[robot]);
        let used = agent.driver.energy_mj(now);
        if let Some(charge) = &mut agent.charge {
            (charge.charger, charge.gained_mj) = (None, left + used);
        }
        agent.errand = None;
        self.run.charges += 1;
        self.note(|t_ms| Record::Charged { t_ms, robot });
    }
}
