//! One supervised mission, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise their
//! flags, which are diagnosed; the supervisors take one round and are then told *one* thing, the
//! oldest failure first, else what the mission or the operator has to say. So a run is a run of the
//! system that was checked: [`Told`] is its alphabet, and the list of what was told, a round each,
//! is all that is needed to check that it is one.

use super::effect::{Ends, FIRMWARE_WATCHDOG, Motion, effect, observable};
use super::operator::Operator;
use super::plan::{Planning, Progress};
use super::robot::Robot;
use super::{Conduct, Injection, Run, Script, When, shipped};
use crate::options::Planner;
use crate::run::{LONGEST, NoPlan, Outcome, PlanCause};
use cotama_core::net::{Net, PlaceId};
use cotama_core::player::Program;
use cotama_core::system::System;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::cotama::{
    Cause, FailureMode, Flags, Health, Level, Losses, Modules, Situation, Told, local, recovering,
};
use cotama_models::missions::Mission;
use objective::Objective;
use recovery::Recovery;
use std::collections::VecDeque;

mod adaptation;
mod adjusting;
mod diagnosis;
mod objective;
mod records;
mod recovery;
mod telling;

pub(super) use records::Recorded;

/// The period of the control loop, of rounds, and of the steps of the robot (stated: below 0.1 s a
/// loop).
pub const PERIOD: Millis = Millis(100);
/// How long planning a path takes: assumed.
pub const PLANNING: Millis = Millis(2_000);
/// No supervisor has an interval, whatever the objectives.
pub(super) const CLOCKS: usize = recovering::SIZE.clocks;

/// A failure under way; its number is its place in [`Run::conduct`].
#[derive(Clone, Copy, Debug)]
struct Failure {
    mode: FailureMode,
    part: Modules,
    until: Option<When>,
    /// For how long its observer has been able to see it.
    seen: Millis,
    since: Millis,
    over: bool,
    /// An adapter has changed a setting on it, and for how long it has been over.
    adjusted: bool,
    past: Millis,
}

/// A mission under way.
pub(super) struct World<'m, P, const W: usize, const S: usize> {
    mission: &'m Mission,
    /// The supervisors, and the net of the global one, which may be another one.
    system: System<'static>,
    global_net: Net<'m>,
    waiting: Vec<Injection>,
    level: Level<P, W, CLOCKS, S>,
    now: Millis,
    robot: Robot,
    operator: Operator,
    failures: Vec<Failure>,
    /// What is diagnosed.
    known: Health,
    /// The hysteresis of what may return; none where nothing does.
    recovery: Option<Recovery>,
    /// What the supervisors take for lost: what is diagnosed, and what the plan does without.
    lost: Losses,
    /// What the supervisors are still to be told.
    untold: VecDeque<(Told, Cause)>,
    planning: Planning<'m>,
    situation: Situation,
    /// Since when the local supervisor and the global one are where they are, and when each place
    /// was first reached.
    local_since: Millis,
    global: PlaceId,
    global_since: Millis,
    first: Vec<(local::State, Millis)>,
    permitted: bool,
    /// The place at which the permit was withdrawn.
    withdrawn: Option<Millimetres>,
    exposed: Millis,
    /// How often the planner gave no answer.
    plannings_failed: u32,
    /// A limit cannot be kept, and the operator knows.
    resigned: bool,
    energy_uj: u64,
    /// Quality of what was driven, in thousandths per mm.
    quality: u64,
    run: Run,
}

impl<'m, P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'m, P, W, S> {
    /// A robot at the start of its mission, with its plan.
    pub(super) fn start(
        mission: &'m Mission,
        global_net: Net<'m>,
        program: P,
        script: &Script,
        planner: Planner,
    ) -> Result<Self, NoPlan> {
        let mut planning = Planning::new(mission, planner);
        let start = Progress { activity: 0, rest: None, now: Millis(0), x_mm: 0, used: [0; 2] };
        planning.plan(PlanCause::Start, start, Modules::ALL)?;
        let level = Level::start(program);
        let mut world = Self {
            mission,
            system: shipped(mission),
            global_net,
            waiting: script.injections.clone(),
            situation: level.situation(Losses::NONE),
            global: level.global(),
            level,
            now: Millis(0),
            robot: Robot::default(),
            operator: Operator::new(script.answers.iter().cloned()),
            failures: Vec::new(),
            known: Health::SOUND,
            recovery: mission.recovery.then(Recovery::default),
            lost: Losses::NONE,
            untold: VecDeque::new(),
            planning,
            local_since: Millis(0),
            global_since: Millis(0),
            first: Vec::new(),
            permitted: false,
            withdrawn: None,
            exposed: Millis(0),
            plannings_failed: 0,
            resigned: false,
            energy_uj: 0,
            quality: 0,
            run: Run {
                outcome: Outcome::Failed,
                time: Millis(0),
                x: Millimetres(0),
                used: [0; 2],
                quality: 0,
                operator_requests: 0,
                told: Vec::new(),
                rounds: 0,
                fired: Vec::new(),
                conduct: Vec::new(),
                configurations: Vec::new(),
                plans: Vec::new(),
                exposed: Millis(0),
                braked: Millimetres(0),
                moved_when_safe: false,
            },
        };
        world.do_without(Cause(0));
        Ok(world)
    }

    /// One period; whether the mission is over.
    pub(super) fn period(&mut self) -> bool {
        self.fail();
        self.outlast();
        self.travel();
        if self.thinks() {
            self.observe();
            self.recover();
            self.watch_margins();
            self.take_a_round();
        }
        self.now.0 += PERIOD.0;
        let end = match self.objective() {
            Objective::Done => Some(self.accomplished()),
            // The micro-controller has stopped it: safe by itself.
            _ if !self.thinks() && self.robot.speed().0 == 0 => Some(Outcome::Safe),
            Objective::Safe if self.robot.speed().0 == 0 => Some(Outcome::Safe),
            _ if self.now >= LONGEST => Some(Outcome::Failed),
            _ => None,
        };
        if let Some(outcome) = end {
            self.run.outcome = outcome;
        }
        end.is_some()
    }

    /// The run, when it is over.
    pub(super) fn into_run(mut self) -> Run {
        self.run.time = self.now;
        self.run.x = self.robot.x();
        self.run.used = self.used();
        self.run.quality = self.quality / 100_000;
        self.run.plans = self.planning.made;
        self.run
    }

    /// Whether the laptop is up.
    fn thinks(&self) -> bool {
        !self.failures.iter().any(|it| effect(it.mode).motion == Motion::Mindless)
    }

    /// How a mission ends whose objectives are done.
    fn accomplished(&self) -> Outcome {
        let limits = self.mission.scenario().limits;
        let within = self.used().iter().zip(limits).all(|(used, limit)| *used <= limit);
        if within { Outcome::Completed } else { Outcome::Failed }
    }

    /// What is to fail now fails.
    fn fail(&mut self) {
        let (now, x, first) = (self.now, self.robot.x(), &self.first);
        let due = |when: When| match when {
            When::At(at) => now >= at,
            When::Place(place) => x >= place,
            When::During(state, after) => {
                first.iter().any(|(it, since)| *it == state && now.0 >= since.0 + after.0)
            }
        };
        let (fail, wait) = self.waiting.iter().partition::<Vec<_>, _>(|it| due(it.when));
        self.waiting = wait;
        for failure in &mut self.failures {
            let past = |time: Millis| now.0 >= failure.since.0 + time.0;
            let by_itself = matches!(effect(failure.mode).ends, Ends::After(time) if past(time));
            failure.over |= by_itself || failure.until.is_some_and(due);
        }
        for Injection { mode, part, until, .. } in fail {
            let part = Modules::of(&[part]);
            self.failures.push(Failure {
                mode,
                part,
                until,
                seen: Millis(0),
                since: now,
                over: false,
                adjusted: false,
                past: Millis(0),
            });
            self.run.conduct.push(Conduct {
                mode,
                injected: now,
                x,
                during: self.situation.local,
                detected: None,
                flags: Flags::NONE,
                judged: None,
                decided: None,
                answered: None,
                exposed: Millis(0),
            });
        }
    }

    /// What is broken, known or not.
    fn broken(&self) -> Health {
        let broken = self.failures.iter().filter(|it| !it.over).map(|it| it.mode.health(it.part));
        broken.fold(Health::SOUND, Health::union)
    }

    /// The robot goes on for a period.
    fn travel(&mut self) {
        let (Objective::Stands(_) | Objective::Drives(_)) = self.objective() else {
            let before = self.robot;
            self.robot.go(MillimetresPerSecond(0), self.end(), PERIOD);
            self.run.moved_when_safe |=
                matches!(self.objective(), Objective::Safe) && before.speed().0 > 0;
            return;
        };
        let activity = self.activity();
        let (pace, power) = self.planning.pace(activity, self.situation.configuration());
        // Only who holds a permit may command motion.
        let command =
            self.level.permit().map_or(MillimetresPerSecond(0), |_permit| self.speed(pace));
        let free = self.limited(pace);
        let mut towards = command;
        let mut blocked = false;
        for failure in self.failures.iter().filter(|it| !it.over) {
            match effect(failure.mode).motion {
                Motion::Blocked => blocked |= observable(failure.mode, self.situation, true),
                // What is asked of it is more, or already less.
                Motion::Slowed(parts) => {
                    towards = towards.min(MillimetresPerSecond(free.0 * u64::from(parts) / 1000));
                }
                Motion::Runaway if !self.level.halted() => towards = self.mission.robot.speed_max,
                Motion::Silent | Motion::Mindless
                    if self.now.0 >= failure.since.0 + FIRMWARE_WATCHDOG.0 =>
                {
                    towards = MillimetresPerSecond(0);
                }
                Motion::Free | Motion::Runaway | Motion::Silent | Motion::Mindless => {}
                Motion::Dead => {
                    self.robot.stand();
                    towards = MillimetresPerSecond(0);
                }
            }
        }
        let end = if blocked && self.situation.local != local::State::Teleoperated {
            self.robot.x()
        } else {
            self.end()
        };
        let before = self.robot.x().0;
        self.robot.go(towards, end, PERIOD);
        self.drive_well(activity, self.robot.x().0 - before);
        self.energy_uj += power.0 * PERIOD.0;
        self.measure();
    }

    /// The end of the drive, or where the robot stands.
    pub(super) fn end(&self) -> Millimetres {
        match self.objective() {
            Objective::Drives(it) => self.mission.objectives[it].x_end,
            _ => self
                .robot
                .x()
                .max(Millimetres(self.robot.x().0 + self.robot.braking_distance().0 + 1)),
        }
    }

    /// The activity under way.
    fn activity(&self) -> usize {
        let last = self.mission.scenario().activities.len() - 1;
        self.progress().activity.min(last)
    }

    /// Duration and energy used, in ms and mJ.
    pub(super) fn used(&self) -> [u64; 2] {
        [self.now.0, self.energy_uj / 1000]
    }

    /// How fast the running configuration goes, as it is adjusted.
    fn speed(&self, pace: MillimetresPerSecond) -> MillimetresPerSecond {
        MillimetresPerSecond(self.limited(pace).0 * u64::from(self.adjusted().speed) / 1000)
    }

    /// How fast it could go.
    fn limited(&self, pace: MillimetresPerSecond) -> MillimetresPerSecond {
        let limit =
            self.situation.configuration().map_or(MillimetresPerSecond(0), |it| it.facts().speed);
        pace.min(limit)
    }

    /// What must never happen, or not for long.
    fn measure(&mut self) {
        let moving = self.robot.speed().0 > 0;
        let required =
            self.situation.configuration().map_or(Modules::NONE, |it| it.facts().required);
        let exposed = moving && !self.broken().available().covers(required);
        self.exposed = if exposed { Millis(self.exposed.0 + PERIOD.0) } else { Millis(0) };
        self.run.exposed = self.run.exposed.max(self.exposed);
        if exposed {
            let breaks =
                |it: &Failure| !it.over && !it.mode.health(it.part).available().covers(required);
            let conducts = self.failures.iter().zip(&mut self.run.conduct);
            for (_, it) in conducts.filter(|(it, _)| breaks(it)) {
                it.exposed.0 += PERIOD.0;
            }
        }
        let permitted = self.level.permit().is_some();
        if self.permitted && !permitted {
            self.withdrawn = Some(self.robot.x());
        }
        if (permitted || self.robot.speed().0 == 0)
            && let Some(from) = self.withdrawn.take()
        {
            let way = Millimetres(self.robot.x().0 - from.0);
            self.run.braked = self.run.braked.max(way);
        }
        self.permitted = permitted;
    }
}
