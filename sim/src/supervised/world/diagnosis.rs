//! What observers see, and what follows from it.

use super::{CLOCKS, World};
use crate::supervised::effect::{observable, raises};
use crate::supervised::{Decided, Judged, PERIOD};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Cause, Diagnosis, FailureMode, Flags, Health, Losses, Module, Modules, Report, Severity, Told,
    by_availability, decide, diagnose, faults, is_detectable, judge,
};

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Observers look; what they newly see is diagnosed.
    pub(super) fn observe(&mut self) {
        let moving = self.robot.speed().0 > 0;
        let can_see = Flags::seen_by(self.observing());
        let mut raised = Flags::NONE;
        let mut seen = Vec::new();
        for (number, failure) in self.failures.iter_mut().enumerate() {
            let found = self.run.conduct[number].detected.is_some();
            if failure.over || found || !observable(failure.mode, self.situation, moving) {
                continue;
            }
            failure.seen.0 += PERIOD.0;
            if failure.seen >= Millis(u64::from(failure.mode.rule().latency_ms)) {
                raised = raised.union(raises(failure.mode, can_see));
                seen.push(number);
            }
        }
        let Some(&first) = seen.first() else { return };
        let diagnosis = diagnose(raised, self.observing());
        for &number in &seen {
            self.run.conduct[number].detected = Some((self.now, diagnosis));
            self.run.conduct[number].flags = raised;
        }
        let cause = Cause(first as u16 + 1);
        // Several at once: whatever always raises some of the flags may be among them, and is taken
        // to be.
        let status = self.observing();
        let shown = |it: &FailureMode| {
            raised.covers(it.rule().signature.always) && is_detectable(*it, status)
        };
        let modes: Vec<_> = match diagnosis {
            Diagnosis::Unexplained => FailureMode::ALL.iter().copied().filter(shown).collect(),
            _ => Vec::new(),
        };
        if modes.is_empty() {
            self.conclude(diagnosis, raised, cause);
        }
        for mode in modes {
            self.conclude(Diagnosis::Unique(mode), raised, cause);
        }
    }

    /// The modules that work as far as is known: what the operator has set right is not held
    /// against its observers.
    pub(super) fn observing(&self) -> Modules {
        let found = self.failures.iter().zip(&self.run.conduct).filter(|(it, _)| !it.over);
        let found = found
            .filter_map(|(it, conduct)| conduct.detected.map(|(_, what)| what.health(it.part)));
        found.fold(Health::SOUND, Health::union).available()
    }

    /// What follows from a diagnosis: what is lost is planned around, and reported.
    pub(super) fn conclude(&mut self, diagnosis: Diagnosis, raised: Flags, cause: Cause) {
        let before = self.known.relied_on();
        let part = usize::from(cause.0).checked_sub(1).and_then(|it| self.failures.get(it));
        self.known = self.known.union(diagnosis.health(part.map_or(Modules::NONE, |it| it.part)));
        let left = self.known.relied_on();
        self.lose(Losses::lacking(left), cause);
        if diagnosis == Diagnosis::None {
            return;
        }
        let (report, severity) = diagnosis.judged(raised, self.situation.mode());
        self.judge(report, severity);
        let Some(report) = report else {
            // It is recorded, and nobody has to decide.
            let conduct =
                usize::from(cause.0).checked_sub(1).and_then(|it| self.run.conduct.get_mut(it));
            if let Some(it) = conduct {
                it.decided = Some((self.now, Decided::Record));
            }
            return;
        };
        // A failure that is worse here than the event of its report says asks for the operator by
        // itself.
        let situation = self.level.situation(self.lost);
        let (by_report, by_row) = (decide(report, situation), judge(report, severity, situation));
        let event = match passing_event(report) {
            Some(event) if by_report.class() >= by_row.class() => Some(event),
            _ if by_report.class() < by_row.class() => Some(faults::Event::fail_hard),
            other => other,
        };
        self.untold.extend(event.map(|it| (Told::Failure(it), cause)));
        if left != before && self.plan_again(before.without(left), cause).is_err() {
            // The adapter has nothing to switch to: the operator is asked.
            self.untold.push_back((Told::Failure(faults::Event::fail_hard), cause));
        }
    }

    /// Notes how what was detected now is judged.
    pub(super) fn judge(&mut self, report: Option<Report>, severity: Severity) {
        let left = self.known.relied_on();
        let operator = left.has(Module::Lan) && report != Some(Report::Refusal);
        let situation = self.level.situation(self.lost);
        let by_availability = by_availability(situation, left, operator);
        for it in
            self.run.conduct.iter_mut().filter(|it| it.detected.is_some_and(|it| it.0 == self.now))
        {
            it.judged.get_or_insert(Judged { report, severity, by_availability });
        }
    }
}

/// The event of a report that is no loss.
const fn passing_event(report: Report) -> Option<faults::Event> {
    match report {
        Report::Slow => Some(faults::Event::overload),
        Report::Ambiguous => Some(faults::Event::drift),
        Report::Collision => Some(faults::Event::bump),
        Report::Planner => Some(faults::Event::no_path),
        Report::Hard => Some(faults::Event::fail_hard),
        Report::Minor => Some(faults::Event::fail_slightly),
        _ => None,
    }
}
