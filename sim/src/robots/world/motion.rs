//! How a robot moves in a period, what it draws, and what of it must never happen.

use super::World;
use super::records::Recording;
use crate::body::Moves;
use crate::record::Recorder;
use crate::robots::failing::{Demand, mode};
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Milliwatts};
use cotama_models::robots::{Global, Mode, Module, Parts, Role, Where, members};
use cotama_plane::Met;
use cotama_senses::Uses;

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// The robot goes on for a period: who holds a permit moves it.
    pub(super) fn travel(&mut self) {
        let before = self.drive.x();
        let permitted = self.level().permits();
        let demand = self.demand();
        if self.hindered.waits() {
            self.drive.stand();
        }
        self.prepare();
        if self.drive.rover().is_some() {
            self.drive.power_hardware(self.power_beside());
        }
        self.failures.go(self.robot, self.now, &demand, &mut self.drive);
        let moved = self.drive.moved();
        if self.drive.touches() && self.run.touched.is_none() {
            self.run.touched = Some(self.drive.x());
        }
        let power = self.hindered.real(self.mission, before, self.power(moved));
        self.energy_uj = self.energy_uj.saturating_add(power.0.saturating_mul(self.body.period.0));
        self.run.moved_when_safe |= moved && self.global == Global::Safe;
        self.measure(before, permitted);
    }

    /// Meets a door that stands otherwise than the robot knew; returns whether it goes another way.
    pub(super) fn meet<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) -> bool {
        match self.drive.take_met() {
            None => false,
            Some(Met::Detour { door, extra }) => {
                self.record_detour(recording, door, extra);
                true
            }
            Some(Met::Blocked { door }) => {
                let before = self.mission.objectives.iter().take(self.objective);
                let drive = before.filter(|it| it.travels()).count();
                self.run.blocked = Some((drive, door));
                false
            }
        }
    }

    /// Tells a robot that is told nothing what runs, and what failures harm.
    fn prepare(&mut self) {
        if self.failures.signals.is_none() {
            return;
        }
        let works = self.robot.available(self.known);
        let runs = self.configuration().and_then(|it| self.robot.configurations.get(it));
        let modules = runs.map_or(0, |it| it.required | it.optional) & works;
        let is_led = mode(self.robot, self.place) == Some(Mode::Operator);
        let moves = self.demand().speed.0 > 0;
        let harms: Vec<_> = self.failures.harms(self.robot).collect();
        let uses = Uses {
            modules,
            is_led,
            moves,
            fastest: self.body.speed_max,
            is_halted: self.level().is_halted(),
            restarted: std::mem::take(&mut self.restarted),
            particles: self.particles(),
        };
        self.drive.prepare(uses, &harms);
    }

    /// Returns the most particles that settings leave to localisation.
    fn particles(&self) -> u64 {
        let holding = self.decider.adapted().holding(self.tables(), self.now);
        let reports = &self.robot.losses.reports;
        let sets = members(holding).filter_map(|it| reports.get(it)?.sets.as_ref());
        let values = sets.flat_map(|it| &it.values);
        let particles = values.filter(|it| {
            let module = self.robot.modules.get(it.module);
            let named = |it: &Module, at: usize| {
                it.parameters.get(at).is_some_and(|it| it.name == "particles")
            };
            module
                .is_some_and(|of| of.roles.contains(&Role::Localisation) && named(of, it.parameter))
        });
        particles.map(|it| it.value).min().unwrap_or(u64::MAX)
    }

    /// Returns what is demanded of the motors: the pace of what runs while it has a permit.
    pub(super) fn demand(&self) -> Demand {
        let goes = self.level().permits() && !self.hindered.waits();
        Demand {
            speed: if goes { self.pace().0 } else { MillimetresPerSecond(0) },
            most: self.body.speed_max,
            halt: self.level().is_halted(),
            end: self.goal(),
            led: mode(self.robot, self.place) == Some(Mode::Operator),
        }
    }

    /// Measures the conditions that must never hold, or not for long; the period began here.
    pub(super) fn measure(&mut self, before: Millimetres, permitted: bool) {
        if let Where::Runs { configuration, .. } = self.place
            && self.drive.speed().0 > 0
            && let Some(required) = self.robot.configurations.get(configuration)
        {
            let lacks = |lost: Parts| required.required & !self.robot.available(lost) != 0;
            if required.required & !self.failures.works(self.robot) != 0 {
                for (it, conduct) in self.failures.all.iter().zip(&mut self.run.conduct) {
                    let row = self.robot.failures.get(it.number);
                    if !it.over && row.is_some_and(|it| lacks(it.loses)) {
                        conduct.exposed.0 += self.body.period.0;
                        self.run.exposed = self.run.exposed.max(conduct.exposed);
                    }
                }
            }
        }
        if self.permitted && !permitted {
            self.withdrawn = Some(before);
        }
        if (permitted || self.drive.stands())
            && let Some(from) = self.withdrawn.take()
        {
            let way = Millimetres(self.drive.x().0.saturating_sub(from.0));
            self.run.braked = self.run.braked.max(way);
        }
        self.permitted = permitted;
    }

    /// Speed and power of what runs: as planned with it, and no faster than it allows.
    pub(super) fn pace(&self) -> (MillimetresPerSecond, Milliwatts) {
        let runs = self.configuration();
        let (speed, power) = self.planning.pace(self.activity(), runs);
        let allowed = runs.and_then(|it| self.robot.configurations.get(it)).map(|it| it.speed);
        let allowed = allowed.unwrap_or(MillimetresPerSecond(0));
        let (adapted, mode_now) = (self.decider.adapted(), mode(self.robot, self.place));
        let left = u64::from(adapted.speed(self.tables(), self.now, mode_now));
        let allowed = MillimetresPerSecond(allowed.0 * left / 1_000);
        // A drive by hand has no planned option.
        let by_hand = mode(self.robot, self.place) == Some(Mode::Operator);
        if by_hand {
            (allowed, self.body.motion_power.at(allowed))
        } else {
            (speed.min(allowed), power)
        }
    }

    /// Returns the power of the robot: that of its pace while it moves, or that of its task where
    /// it stands for one; else that of rest.
    pub(super) fn power(&self, moved: bool) -> Milliwatts {
        if matches!(self.global, Global::Does(_)) && self.objective_stands() {
            return self.planning.pace(self.activity(), None).1;
        }
        if moved || !self.drive.stands() {
            return self.pace().1;
        }
        self.planning.rest_power(self.activity(), self.configuration())
    }

    /// Returns the power of all but the motors: that of the task for which the robot stands, or
    /// else that of rest.
    fn power_beside(&self) -> Milliwatts {
        if self.objective_stands() {
            return self.power(false);
        }
        self.planning.rest_power(self.activity(), self.configuration())
    }

    pub(super) fn objective_stands(&self) -> bool {
        self.mission.objectives.get(self.objective).is_some_and(|it| !it.travels())
    }

    /// The end of the drive; where there is none, so far that the robot can brake.
    pub(super) fn goal(&self) -> Millimetres {
        let braked = Millimetres(self.drive.x().0 + self.drive.braking_distance().0 + 1);
        match self.mission.objectives.get(self.objective).filter(|_| self.drives()) {
            Some(it) => it.x_end,
            None => braked,
        }
    }

    pub(super) fn at_goal(&self) -> bool {
        let goal = self.mission.objectives.get(self.objective).map(|it| it.x_end);
        goal.is_some_and(|it| self.drive.x() >= it)
    }
}
