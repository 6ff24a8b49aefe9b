//! One supervised mission, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise and
//! lower their flags; the [`Decider`], which the microcontroller runs as well, makes requests of
//! them. So a run is a run of the system that was checked, and the list of what was told, a round
//! each, is all that is needed to check that it is one.

use super::effect::{Ends, FIRMWARE_WATCHDOG, Motion, effect};
use super::laptop::{Disturbances, Laptop, Seen, jobs};
use super::monitor::Watching;
use super::operator::Operator;
use super::plan::{Planning, Progress};
use super::robot::Robot;
use super::{Conduct, Fired, Injection, Planted, Run, Script, Supervised, When, shipped};
use crate::options::Planner;
use crate::run::{LONGEST, NoPlan, Outcome, PlanCause};
use cotama_core::net::Net;
use cotama_core::player::Program;
use cotama_core::system::System;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{
    Configuration, Decider, DecisionalLevel, FailureMode, Flags, Health, Module, Modules, load,
    local, recovering,
};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Act;
use objective::Objective;

mod motion;
mod objective;
mod observers;
mod passing;
mod records;
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
    /// For how long an observer at work should have been.
    shown: Millis,
    since: Millis,
    over: bool,
    /// Its flags have gone back.
    lowered: bool,
}

impl Failure {
    /// What it does to motion; without the scheduler nothing is commanded.
    fn motion(&self) -> Motion {
        let scheduler = self.mode == FailureMode::Sw1 && self.part.has(Module::Sch);
        if scheduler && !self.over { Motion::Mindless } else { effect(self.mode).motion }
    }
}

/// When a transition fired for the first time.
fn first_fired(fired: &[Fired], act: Act) -> Option<Millis> {
    let is = |it: &&Fired| it.net == act.net && it.transition == act.transition;
    fired.iter().find(is).map(|it| it.at)
}

/// A mission under way.
#[derive(Clone)]
pub(super) struct World<'m, P, const W: usize, const S: usize> {
    mission: &'m Mission,
    /// The supervisors, and the net of the global one, which may be another one.
    system: System<'static>,
    global_net: Net<'m>,
    waiting: Vec<Injection>,
    decider: Decider<P, W, CLOCKS, S>,
    /// Which failure each finding of the decisional level goes back to, from 1; 0 for none.
    causes: Vec<u16>,
    now: Millis,
    robot: Robot,
    laptop: Laptop,
    /// Rounds since a report was told.
    quiet: u32,
    operator: Operator,
    failures: Vec<Failure>,
    /// What is broken, and what works in spite of it.
    works: (Health, Modules),
    planning: Planning<'m>,
    /// Since when the global supervisor is where it is, and when each place of the local one was
    /// first reached.
    global_since: Millis,
    first: Vec<(local::State, Millis)>,
    permitted: bool,
    /// The place at which the permit was withdrawn.
    withdrawn: Option<Millimetres>,
    exposed: Millis,
    energy_uj: u64,
    /// Quality of what was driven, in thousandths per mm.
    quality: u64,
    run: Run,
    /// Nothing happened in the last period: see `passing`.
    calm: bool,
    planted: &'m [Planted],
    watching: Watching<'m>,
    /// The shipped supervisors, which are told the same.
    shipped: Option<DecisionalLevel>,
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
        let objectives = mission.objectives.len() as u32;
        let decider = Decider::start(program, objectives, planning.next_drive(0));
        let decider = if mission.recovery { decider.with_returns() } else { decider };
        Ok(Self {
            mission,
            system: shipped(mission),
            global_net,
            waiting: script.injections.clone(),
            decider,
            causes: Vec::new(),
            now: Millis(0),
            robot: Robot::default(),
            laptop: Laptop::new(),
            quiet: 0,
            operator: Operator::new(script.answers.iter().cloned()),
            failures: Vec::new(),
            works: (Health::SOUND, Modules::ALL),
            planning,
            global_since: Millis(0),
            first: Vec::new(),
            permitted: false,
            withdrawn: None,
            exposed: Millis(0),
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
                oldest_pose: Millis(0),
                braked: Millimetres(0),
                moved_when_safe: false,
                unseen: Millis(0),
                planned_with_lost: false,
                violated: None,
                departed: None,
            },
            calm: false,
            planted: &[],
            watching: Watching::new(&[]),
            shipped: None,
        })
    }

    /// The same with the defects and monitors of a mission that is ready.
    pub(super) fn with(self, ready: &'m Supervised<'_>) -> Self {
        let (planted, watching) = (&ready.planted[..], Watching::new(&ready.monitors));
        let shipped = ready.compared.then(DecisionalLevel::default);
        Self { planted, watching, shipped, ..self }
    }

    /// The same with the names of these supervisors, whose program it runs.
    pub(super) fn under(self, system: System<'static>) -> Self {
        Self { system, ..self }
    }

    /// One period; whether the mission is over.
    pub(super) fn period(&mut self) -> bool {
        let (before, adjusted) = (self.robot, self.decider.requests().adjusted);
        self.calm = true;
        self.fail();
        self.travel();
        self.calm &= self.thinks() && self.robot.is_steady_since(&before, PERIOD);
        if self.thinks() {
            let seen = self.compute();
            self.observe(seen);
            self.take_a_round();
        }
        self.calm &= self.decider.requests().adjusted == adjusted;
        self.now.0 += PERIOD.0;
        let end = match self.objective() {
            _ if self.run.violated.is_some() || self.run.departed.is_some() => {
                Some(Outcome::Failed)
            }
            Objective::Done => Some(self.accomplished()),
            // Safe by itself.
            _ if self.is_left_standing() => Some(Outcome::Safe),
            Objective::Safe if self.robot.speed().0 == 0 => Some(Outcome::Safe),
            _ if self.now >= LONGEST => Some(Outcome::Failed),
            _ => None,
        };
        if let Some(outcome) = end {
            self.run.outcome = outcome;
        }
        end.is_some()
    }

    /// How far the robot goes in this time, and whether it moved though it was safe.
    pub(super) fn way_in(mut self, time: Millis) -> (Millimetres, bool) {
        let (from, until) = (self.robot.x(), Millis(self.now.0.saturating_add(time.0)));
        while self.now < until {
            self.period();
            if self.rests(until) {
                break;
            }
        }
        (Millimetres(self.robot.x().0 - from.0), self.run.moved_when_safe)
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

    /// Whether the laptop is up, and its scheduler.
    fn thinks(&self) -> bool {
        !self.failures.iter().any(|it| it.motion() == Motion::Mindless)
    }

    /// Whether the laptop is down and the robot stands: nothing was commanded, or the
    /// micro-controller commands nothing any more. Until then who is held up may go on.
    fn is_left_standing(&self) -> bool {
        let long_since = |it: &Failure| {
            it.motion() == Motion::Mindless && self.now.0 >= it.since.0 + FIRMWARE_WATCHDOG.0
        };
        let is_stopped = self.decider.permit().is_none() || self.failures.iter().any(long_since);
        !self.thinks() && self.robot.speed().0 == 0 && is_stopped
    }

    /// How a mission ends whose objectives are done.
    fn accomplished(&self) -> Outcome {
        let limits = self.mission.scenario().limits;
        let within = self.used().iter().zip(limits).all(|(used, limit)| *used <= limit);
        if within { Outcome::Completed } else { Outcome::Failed }
    }

    /// What is to fail now fails.
    fn fail(&mut self) {
        let (now, x, first, fired) = (self.now, self.robot.x(), &self.first, &self.run.fired);
        let due = |when: When| match when {
            When::At(at) => now >= at,
            When::Place(place) => x >= place,
            When::During(state, after) => {
                first.iter().any(|(it, since)| *it == state && now.0 >= since.0 + after.0)
            }
            When::Fired(act, after) => {
                first_fired(fired, act).is_some_and(|since| now.0 >= since.0 + after.0)
            }
        };
        let (fail, wait) = self.waiting.iter().partition::<Vec<_>, _>(|it| due(it.when));
        self.waiting = wait;
        for failure in &mut self.failures {
            let past = |time: Millis| now.0 >= failure.since.0 + time.0;
            let by_itself = matches!(effect(failure.mode).ends, Ends::After(time) if past(time));
            // A laptop that comes back has no mission any more.
            let returns = effect(failure.mode).motion != Motion::Mindless;
            failure.over |= returns && (by_itself || failure.until.is_some_and(due));
        }
        self.calm &= fail.is_empty();
        for Injection { mode, part, until, .. } in fail {
            let part = Modules::of(&[part]);
            self.failures.push(Failure {
                mode,
                part,
                until,
                seen: Millis(0),
                shown: Millis(0),
                since: now,
                over: false,
                lowered: false,
            });
            self.run.conduct.push(Conduct {
                mode,
                injected: now,
                x,
                during: self.decider.situation().local,
                detected: None,
                flags: Flags::NONE,
                judged: None,
                decided: None,
                answered: None,
                exposed: Millis(0),
            });
        }
    }

    /// The modules that were asked for compute for a period, disturbed by what fails.
    fn compute(&mut self) -> Seen {
        let situation = self.decider.situation();
        let runs = situation.configuration().unwrap_or(Configuration::Security);
        let wanted = runs.scheduled().common(self.decider.available());
        self.laptop.run(wanted, load::PARTICLES[usize::from(situation.level.min(2))]);
        let mut disturbed = Disturbances::default();
        for it in self.failures.iter().filter(|it| !it.over) {
            match it.mode {
                FailureMode::Rt1 => disturbed.programs += 1,
                FailureMode::Rt2 => disturbed.hiccup |= it.since == self.now,
                FailureMode::Rt3 => disturbed.slow = disturbed.slow.union(jobs(it.part)),
                FailureMode::Sw1 => disturbed.crashed = disturbed.crashed.union(jobs(it.part)),
                _ => {}
            }
        }
        let seen = self.laptop.work(disturbed);
        self.calm &= self.laptop.is_steady(disturbed) && !disturbed.hiccup;
        let used = runs.facts().required.has(Module::Mcl) && self.robot.speed().0 > 0;
        if let (true, Some(age)) = (used, self.laptop.age(Module::Mcl)) {
            self.run.oldest_pose = self.run.oldest_pose.max(age);
        }
        seen
    }

    /// What is broken, known or not.
    fn broken(&self) -> Health {
        let broken = self.failures.iter().filter(|it| !it.over).map(|it| it.mode.health(it.part));
        broken.fold(Health::SOUND, Health::union)
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
}
