//! One supervised mission, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise and
//! lower their flags; the [`Decider`], which the microcontroller runs as well, makes requests of
//! them. So a run is a run of the system that was checked, and the list of what was told, a round
//! each, is all that is needed to check that it is one.

use super::monitor::Watching;
use super::operator::Operator;
use super::{Conduct, Fired, Injection, Run, Script, Supervised, When, shipped};
use crate::body::{PERIOD, Planted, Robot, Watch};
use crate::options::Planner;
use crate::plan::{Planning, Progress};
use crate::run::{LONGEST, NoPlan, Outcome, PlanCause};
use cotama_core::hardware::Equipment;
use cotama_core::net::Net;
use cotama_core::player::Program;
use cotama_core::system::System;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{
    Configuration, Decider, DecisionalLevel, Flags, Module, Modules, local, recovering,
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

/// No supervisor has an interval, whatever the objectives.
pub(super) const CLOCKS: usize = recovering::SIZE.clocks;

/// Returns modules as hardware of the mission.
fn units(mission: &Mission, available: Modules) -> Equipment {
    let works = |name: &str| available.iter().any(|it| it.name() == name);
    let kinds = mission.hardware.iter().enumerate();
    kinds.fold(Equipment::NONE, |all, (kind, it)| {
        let is_module = Module::ALL.iter().any(|module| module.name() == it.name);
        let count = if is_module && !works(&it.name) { 0 } else { it.units };
        all.with(kind, count).unwrap_or(all)
    })
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
    /// The failures of the robot have the numbers of [`Run::conduct`].
    robot: Robot,
    /// When each failure ends, if not by itself.
    until: Vec<Option<When>>,
    operator: Operator,
    planning: Planning<'m, Configuration>,
    /// Since when the global supervisor is where it is, and when each place of the local one was
    /// first reached.
    global_since: Millis,
    first: Vec<(local::State, Millis)>,
    permitted: bool,
    /// The place at which the permit was withdrawn.
    withdrawn: Option<Millimetres>,
    exposed: Millis,
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
        let mut planning = Planning::new(mission, planner, |it| it.configuration);
        let start = Progress { activity: 0, rest: None, now: Millis(0), x_mm: 0, used: [0; 2] };
        planning.plan(PlanCause::Start, start, units(mission, Modules::ALL))?;
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
            robot: Robot::new(),
            until: Vec::new(),
            operator: Operator::new(script.answers.iter().cloned()),
            planning,
            global_since: Millis(0),
            first: Vec::new(),
            permitted: false,
            withdrawn: None,
            exposed: Millis(0),
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
        let (before, adjusted) = (self.robot.drive, self.decider.requests().adjusted);
        self.calm = true;
        self.fail();
        self.travel();
        self.calm &= self.robot.thinks() && self.robot.drive.is_steady_since(&before, PERIOD);
        if self.robot.thinks() {
            let (situation, available) = (self.decider.situation(), self.decider.available());
            let (seen, steady) = self.robot.compute(self.now, situation, available);
            self.calm &= steady;
            self.observe(seen);
            self.take_a_round();
        }
        self.calm &= self.decider.requests().adjusted == adjusted;
        self.now.0 += PERIOD.0;
        let end = match self.objective() {
            _ if self.run.violated.is_some() || self.run.departed.is_some() => {
                Some(Outcome::Failed)
            }
            Objective::Done => Some(self.within(Outcome::Completed)),
            // Safe by itself.
            _ if self.is_left_standing() => Some(self.within(Outcome::Safe)),
            Objective::Safe if !self.robot.moves() => Some(self.within(Outcome::Safe)),
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
        self.run.unseen = self.robot.unseen;
        self.run.oldest_pose = self.robot.oldest_pose;
        self.run.quality = self.quality / 100_000;
        self.run.plans = self.planning.made;
        self.run
    }

    /// Whether the laptop is down and the robot stands: nothing was commanded, or the
    /// micro-controller commands nothing any more. Until then who is held up may go on.
    fn is_left_standing(&self) -> bool {
        let is_stopped = self.decider.permit().is_none() || self.robot.is_abandoned(self.now);
        !self.robot.thinks() && !self.robot.moves() && is_stopped
    }

    /// The state of the decisional level that observers depend on.
    fn watch_of(&self) -> Watch<'m> {
        // Observers are looked up only where there is something to see.
        let sound = self.robot.failures.is_empty();
        let observing = if sound { Modules::ALL } else { self.decider.observing() };
        Watch { situation: self.decider.situation(), observing, planted: self.planted }
    }

    /// How a mission ends that ends so within its limits.
    fn within(&self, outcome: Outcome) -> Outcome {
        let limits = self.mission.scenario().limits;
        let within = self.used().iter().zip(limits).all(|(used, limit)| *used <= limit);
        if within { outcome } else { Outcome::Failed }
    }

    /// Injects the failures that are due.
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
        let until = &self.until;
        self.robot.end_failures(now, |it| until[it].is_some_and(due));
        self.calm &= fail.is_empty();
        for Injection { mode, part, until, .. } in fail {
            self.robot.fail(now, mode, part);
            self.until.push(until);
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

    /// The activity under way.
    fn activity(&self) -> usize {
        let last = self.mission.scenario().activities.len() - 1;
        self.progress().activity.min(last)
    }

    /// Duration and energy used, in ms and mJ.
    pub(super) fn used(&self) -> [u64; 2] {
        [self.now.0, self.robot.energy_uj / 1000]
    }
}
