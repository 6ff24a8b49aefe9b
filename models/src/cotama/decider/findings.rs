//! From flags to reports.

use super::{Cause, Decider, Origin, Plans};
use crate::cotama::decisions::{Class, Losses, Report, Severity, by_availability, decide, judge};
use crate::cotama::dependability::{
    Diagnosis, FailureMode, FailureModes, Flag, Flags, Signature, diagnose,
};
use crate::cotama::level::Told;
use crate::cotama::modules::{Health, Module, Modules};
use crate::cotama::supervisors::faults;
use cotama_core::player::Program;

/// Flags, and what they were taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Number of the finding, from 1 on.
    pub cause: Cause,
    /// The flags raised.
    pub flags: Flags,
    /// The diagnosis of the flags.
    pub diagnosis: Diagnosis,
    /// How it was judged first; none for what no available observer sees.
    pub judged: Option<Judged>,
    /// A part of it at least is recorded only, and nobody has to decide.
    pub recorded: bool,
}

/// How a diagnosis was judged: the two rules of the contextual supervisor (Durand et al., TAROS
/// 2010, Sections III.C and V.B; that the worse class wins is inferred).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Judged {
    /// The report to the contextual supervisor; none for what is recorded only.
    pub report: Option<Report>,
    /// How severe it is in the autonomy mode of the robot.
    pub severity: Severity,
    /// The class by what is still available there.
    pub by_availability: Class,
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// Diagnoses new flags, plans around the damage, and reports it.
    pub(super) fn diagnose(
        &mut self,
        raised: Flags,
        part: Modules,
        plans: &mut impl Plans,
    ) -> Finding {
        let observing = self.observing();
        let diagnosis = diagnose(raised, observing);
        let cause = self.next_cause();
        let (judged, recorded) = (None, false);
        let mut finding = Finding { cause, flags: raised, diagnosis, judged, recorded };
        // Several at once: whatever always raises some of the flags may be among them, and is
        // taken to be. It may be about a module that is lost anyway: encoders break after they
        // lost ticks.
        let mut shown = FailureModes::NONE;
        if diagnosis == Diagnosis::Unexplained {
            for &mode in FailureMode::ALL {
                let Signature { always, absent, .. } = mode.rule().signature;
                let all_raised = !always.is_empty() && raised.covers(always);
                if all_raised && absent.common(observing).is_empty() {
                    shown = shown.with(mode);
                }
            }
        }
        if shown.is_empty() {
            self.conclude(diagnosis, part, &mut finding, plans);
        }
        for mode in shown.iter() {
            self.conclude(Diagnosis::Unique(mode), part, &mut finding, plans);
        }
        finding
    }

    /// The modules that work as far as is known: what has passed, or was set right, is not held
    /// against its observers.
    #[must_use]
    pub fn observing(&self) -> Modules {
        let shows = |it: &FailureMode| !it.rule().signature.always.common(self.up).is_empty();
        let under_way = self.found.iter().filter(shows);
        let broken = under_way.map(|it| it.health(self.origin[it as usize].part));
        broken.fold(Health::SOUND, Health::union).available()
    }

    /// Draws the consequences of a diagnosis.
    fn conclude(
        &mut self,
        diagnosis: Diagnosis,
        part: Modules,
        finding: &mut Finding,
        plans: &mut impl Plans,
    ) {
        let (before, cause) = (self.known.relied_on, finding.cause);
        let broken = diagnosis.health(part);
        self.known = self.known.health.union(broken).into();
        let left = self.known.relied_on;
        self.lose(Losses::lacking(left), cause);
        match diagnosis {
            Diagnosis::None => return,
            Diagnosis::Unique(mode) => {
                self.found = self.found.with(mode);
                self.origin[mode as usize] = Origin { cause, part };
            }
            Diagnosis::Ambiguous(_) | Diagnosis::Unexplained => {}
        }
        self.settings.found(diagnosis, finding.flags, cause);
        let (report, severity) = diagnosis.judged(finding.flags, self.situation.mode());
        let judged = self.judge(report, severity);
        finding.judged.get_or_insert(judged);
        let Some(report) = report else {
            finding.recorded = true;
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
        if let Some(event) = event {
            self.untold.push(Told::Failure(event), cause);
        }
        let gone = before.without(left);
        if left != before && self.plan_without(gone, broken, cause, plans).is_err() {
            // The adapter has nothing to switch to: the operator is asked.
            self.untold.push(Told::Failure(faults::Event::fail_hard), cause);
        }
    }

    /// The operator did not answer in time: the robot's own timer shows it (FMECA, row OPR1), once
    /// for each question.
    pub(super) fn finding_of_silence(&mut self) -> Option<Finding> {
        let mode = FailureMode::Opr1;
        if self.found.has(mode) {
            return None;
        }
        let (cause, flags) = (self.next_cause(), Flags::of(&[Flag::OperatorSilent]));
        self.found = self.found.with(mode);
        self.origin[mode as usize] = Origin { cause, part: Modules::NONE };
        let judged = Some(self.judge(mode.rule().report, mode.severity(self.situation.mode())));
        let (diagnosis, recorded) = (Diagnosis::Unique(mode), false);
        Some(Finding { cause, flags, diagnosis, judged, recorded })
    }

    fn next_cause(&mut self) -> Cause {
        self.findings = self.findings.saturating_add(1);
        Cause(self.findings)
    }

    fn judge(&self, report: Option<Report>, severity: Severity) -> Judged {
        let left = self.known.relied_on;
        let operator = left.has(Module::Lan) && report != Some(Report::Refusal);
        let situation = self.level.situation(self.lost);
        let by_availability = by_availability(situation, left, operator);
        Judged { report, severity, by_availability }
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
