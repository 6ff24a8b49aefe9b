//! What observers raise, and what the decisional level makes of it.

use super::{CLOCKS, Failure, World};
use crate::run::{Part, PlanCause};
use crate::supervised::effect::{observable, raises};
use crate::supervised::laptop::{Seen, jobs};
use crate::supervised::plan::{Planning, Progress};
use crate::supervised::{Decided, PERIOD, Planted};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Configuration, FailureMode, Finding, Flag, Flags, Module, Modules, NoPlanLeft, Perceived,
    Plans, Situation, Why,
};
use cotama_models::missions::Mission;

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Observers look; the decisional level diagnoses what they and the scheduler newly see.
    pub(super) fn observe(&mut self, scheduler: Seen) {
        let seen = self.newly_seen(scheduler);
        let by_observers = seen.iter().map(|&it| &self.failures[it]);
        let by_observers = by_observers.filter(|it| !is_shown(it, scheduler));
        let flags = by_observers.map(|it| raises(it.mode, self.decider.observing()));
        let raised = flags.fold(scheduler.flags, Flags::union);
        let first = seen.first().map_or(Modules::NONE, |&it| self.failures[it].part);
        let part = if scheduler.part.is_empty() { first } else { scheduler.part };
        let works = self.works();
        let perceived = Perceived { raised, lowered: self.newly_lowered(), part, works };
        self.calm &= raised.is_empty() && perceived.lowered.is_empty();
        let at = self.progress();
        let mut rest = Rest {
            drives: matches!(self.objective(), super::Objective::Drives(_)),
            mission: self.mission,
            planning: &mut self.planning,
            at,
            with_lost: self.planted.contains(&Planted::PlansWithLost),
            planned_with_lost: &mut self.run.planned_with_lost,
        };
        if let Some(finding) = self.decider.perceive(self.now, perceived, &mut rest) {
            // What the scheduler sees again goes back to what it was before.
            let again = || self.failures.iter().rposition(|it| is_shown(it, scheduler));
            let cause = seen.first().copied().or_else(again);
            self.note_finding(&finding, &seen, cause);
        }
    }

    /// The modules that work, and that somebody would see fail.
    fn works(&mut self) -> Modules {
        let broken = self.broken();
        if self.works.0 != broken {
            self.works = (broken, broken.relied_on());
        }
        self.works.1
    }

    /// Whether an observer at work should see a failure now, whatever is wrong with observers.
    pub(super) fn is_shown(&self, it: &Failure, situation: Situation, moving: bool) -> bool {
        observable(it.mode, situation, moving)
            && !raises(it.mode, self.decider.observing()).is_empty()
    }

    /// A failure that is not seen was shown for longer.
    pub(super) fn show(&mut self, number: usize, time: Millis) {
        let it = &mut self.failures[number];
        it.shown.0 += time.0;
        let late = it.shown.0.saturating_sub(u64::from(it.mode.rule().latency_ms).max(PERIOD.0));
        self.run.unseen = self.run.unseen.max(Millis(late));
    }

    /// Whether an observer can see a failure now.
    pub(super) fn is_observable(
        &self,
        mode: FailureMode,
        situation: Situation,
        moving: bool,
    ) -> bool {
        let hides = |it: &Planted| match *it {
            Planted::Unseen(unseen) => unseen == mode,
            Planted::UnseenWhile(first, unseen) => {
                unseen == mode && self.failures.iter().any(|it| it.mode == first && !it.over)
            }
            _ => false,
        };
        observable(mode, situation, moving) && !self.planted.iter().any(hides)
    }

    /// How long an observer takes to see a failure, in ms.
    pub(super) fn latency_ms(&self, mode: FailureMode) -> u64 {
        let later = self.planted.iter().filter_map(|it| match *it {
            Planted::Late(late, by) if late == mode => Some(by.0),
            _ => None,
        });
        u64::from(mode.rule().latency_ms) + later.sum::<u64>()
    }

    /// The failures that are seen from now on.
    fn newly_seen(&mut self, scheduler: Seen) -> Vec<usize> {
        let (moving, situation) = (self.robot.speed().0 > 0, self.decider.situation());
        let mut seen = Vec::new();
        for number in 0..self.failures.len() {
            let (failure, found) = (self.failures[number], self.run.conduct[number].detected);
            if found.is_none() && is_shown(&failure, scheduler) {
                seen.push(number);
            }
            let is_open = !failure.over && found.is_none();
            if is_open && self.is_shown(&failure, situation, moving) {
                self.show(number, PERIOD);
            }
            if !is_open || !self.is_observable(failure.mode, situation, moving) {
                continue;
            }
            let so_far = Millis(failure.seen.0 + PERIOD.0);
            self.failures[number].seen = so_far;
            if so_far >= Millis(self.latency_ms(failure.mode)) {
                seen.push(number);
            }
        }
        seen
    }

    /// The flags of failures that are over since they were seen, but for those that others hold.
    fn newly_lowered(&mut self) -> Flags {
        let (mut lowered, mut held) = (Flags::NONE, Flags::NONE);
        for (failure, conduct) in self.failures.iter_mut().zip(&self.run.conduct) {
            let flags = failure.mode.rule().signature.always;
            match (conduct.detected, failure.over) {
                (Some(_), false) => held = held.union(flags),
                (Some(_), true) if !failure.lowered => {
                    failure.lowered = true;
                    lowered = lowered.union(flags);
                }
                _ => {}
            }
        }
        lowered.without(held)
    }

    /// Notes what these failures were taken for.
    pub(super) fn note_finding(
        &mut self,
        finding: &Finding,
        failures: &[usize],
        cause: Option<usize>,
    ) {
        self.causes.push(cause.map_or(0, |it| it as u16 + 1));
        for &number in failures {
            let conduct = &mut self.run.conduct[number];
            conduct.detected = Some((self.now, finding.diagnosis));
            conduct.flags = finding.flags;
            conduct.judged = finding.judged;
        }
        if let (true, Some(&first)) = (finding.recorded, failures.first()) {
            self.run.conduct[first].decided = Some((self.now, Decided::Record));
        }
    }

    /// The operator's silence, if that is a failure under way.
    pub(super) fn silence(&self) -> Option<usize> {
        self.failures.iter().position(|it| it.mode == FailureMode::Opr1)
    }
}

/// Whether a failure is what the scheduler sees.
fn is_shown(failure: &Failure, seen: Seen) -> bool {
    let of_part = |flag| seen.flags.has(flag) && !seen.part.common(jobs(failure.part)).is_empty();
    match failure.mode {
        FailureMode::Rt1 => seen.flags.has(Flag::MclLate),
        FailureMode::Rt2 => seen.flags.has(Flag::OneLate),
        FailureMode::Rt3 if failure.part.has(Module::Mcl) => seen.flags.has(Flag::MclLate),
        FailureMode::Rt3 => of_part(Flag::ModuleLate),
        FailureMode::Sw1 => of_part(Flag::ModuleSilent),
        _ => false,
    }
}

/// What is left of the mission, planned by PANORAMA.
struct Rest<'w, 'm> {
    mission: &'m Mission,
    planning: &'w mut Planning<'m>,
    at: Progress,
    drives: bool,
    /// A defect that was planted.
    with_lost: bool,
    planned_with_lost: &'w mut bool,
}

impl Plans for Rest<'_, '_> {
    fn is_over(&self) -> bool {
        self.at.activity >= self.mission.scenario().activities.len()
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        // Modules that the mission does not plan with change no plan.
        let plans_with =
            |it: &Module| self.mission.hardware.iter().any(|kind| kind.name == it.name());
        let part = |modules: Modules, broken| {
            let first = modules.iter().find(plans_with)?;
            Some(Part::of(broken).unwrap_or(Part::Module(first)))
        };
        let cause = match why {
            Why::Margin(axis) => Some(PlanCause::Margin { axis }),
            Why::Lost { modules, broken } => part(modules, broken).map(PlanCause::Lost),
            Why::Returned { modules, broken } => part(modules, broken).map(PlanCause::Back),
        };
        let Some(cause) = cause else { return Ok(false) };
        let used = if self.with_lost { Modules::ALL } else { available };
        let planned = self.planning.plan(cause, self.at, used);
        *self.planned_with_lost |=
            planned.is_ok() && !self.planning.needs_no_more(self.at, available);
        planned.map(|()| true).map_err(|_| NoPlanLeft)
    }

    fn configuration(&self) -> Option<Configuration> {
        self.planning.next_drive(self.at.activity)
    }

    fn short(&self) -> Option<usize> {
        if self.drives { self.planning.short(self.at) } else { None }
    }
}
