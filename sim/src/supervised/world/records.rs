//! The records of a supervised run in its trace: news of [`Run`](crate::supervised::Run), round
//! after round.

use super::objective::Objective;
use super::{CLOCKS, World};
use crate::body::PERIOD;
use crate::record::Recorder;
use crate::supervised::{self, Conduct};
use crate::trace::supervised::{Configured, Decision, Diagnosis, Exposure, Failure, Fired, Told};
use crate::trace::{Activity, End, Plan, Record, Request, ReturnMargin, Sample};
use cotama_core::net::{Net, Role, Transition};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{self, Flag};

/// How much of a run is recorded.
#[derive(Debug, Default)]
pub(in crate::supervised) struct Recorded {
    fired: usize,
    told: usize,
    configurations: usize,
    plans: usize,
    conduct: Vec<Noted>,
    activity: Option<usize>,
    next_sample: Millis,
}

/// How much of a failure is recorded.
#[derive(Clone, Copy, Debug, Default)]
struct Noted {
    diagnosis: bool,
    decision: bool,
    exposed: Millis,
    exposing: bool,
}

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Records what the last round brought.
    pub(in crate::supervised) fn record<R: Recorder>(
        &self,
        done: &mut Recorded,
        period: Millis,
        to: &mut R,
    ) {
        let (t_us, x_mm) = (self.now.0.saturating_sub(PERIOD.0) * 1000, self.robot.x().0);
        let run = &self.run;
        for (number, it) in run.conduct.iter().enumerate().skip(done.conduct.len()) {
            done.conduct.push(Noted::default());
            let (mode, during) = (it.mode.name().into(), format!("{:?}", it.during));
            to.record(Record::Failure(Failure {
                t_us,
                x_mm,
                failure: one_based(number),
                mode,
                what: None,
                during,
            }));
        }
        self.record_diagnoses(done, t_us, to);
        for plan in &self.planning.made[done.plans..] {
            to.record(Record::Plan(Box::new(self.plan_record(plan))));
            to.record(self.sample(plan.t_us, plan.used, plan.after));
        }
        done.plans = self.planning.made.len();
        let fired = &run.fired[done.fired..];
        for it in fired {
            to.record(Record::Fired(Fired {
                t_us,
                x_mm,
                net: it.net.into(),
                transition: it.transition.clone(),
                place: self.transition(it).map_or("", |(net, it)| place(net, it)).into(),
                cause: (it.cause.0 > 0).then_some(it.cause.0),
                sets: None,
            }));
        }
        done.fired = run.fired.len();
        for (number, (it, noted)) in run.conduct.iter().zip(&mut done.conduct).enumerate() {
            let Some((at, decided)) = it.decided.filter(|_| !noted.decision) else { continue };
            noted.decision = true;
            let by =
                fired.iter().find(|by| by.net == "cs" && usize::from(by.cause.0) == number + 1);
            to.record(Record::Decision(Decision {
                t_us,
                x_mm,
                failure: one_based(number),
                decision: decided,
                event: by.and_then(|by| self.first_output(by)).map(Into::into),
                transition: by.map(|by| by.transition.clone()),
                since_ms: at.0.saturating_sub(it.injected.0),
            }));
        }
        for &(round, told) in &run.told[done.told..] {
            to.record(Record::Told(Told { t_us, x_mm, round, event: self.event_name(told) }));
        }
        done.told = run.told.len();
        for it in fired.iter().filter(|it| self.says_also(it, "op_request")) {
            let conduct = usize::from(it.cause.0).checked_sub(1).and_then(|at| run.conduct.get(at));
            let cause =
                conduct.map_or_else(|| "no failure".into(), |it| candidates(it).join(" or "));
            let reason = "the robot cannot go on alone".into();
            to.record(Record::Request(Request { t_us, x_mm, cause, reason }));
        }
        for (_, it) in &run.configurations[done.configurations..] {
            let (configuration, mode) =
                (it.map(|it| it.name().into()), self.decider.situation().mode());
            to.record(Record::Configuration(Configured { t_us, x_mm, configuration, mode }));
        }
        done.configurations = run.configurations.len();
        self.record_exposures(done, t_us, to);
        self.record_progress(done, period, to);
    }

    /// A net of the supervisors: the global one is that of this mission.
    fn net(&self, name: &str) -> Option<&Net<'_>> {
        if name == "gs" {
            return Some(&self.global_net);
        }
        self.system.components.iter().find(|it| it.name == name).map(|it| it.net)
    }

    /// The transition that fired.
    fn transition(&self, fired: &supervised::Fired) -> Option<(&Net<'_>, &Transition<'_>)> {
        let net = self.net(fired.net)?;
        Some((net, net.transitions.iter().find(|it| it.name == fired.transition)?))
    }

    /// Returns the first output of a transition.
    fn first_output(&self, fired: &supervised::Fired) -> Option<&str> {
        let (net, transition) = self.transition(fired)?;
        let said = transition.emits.first()?;
        net.outputs.get(said.0 as usize).map(|it| it.name)
    }

    /// Whether a transition says something.
    fn says_also(&self, fired: &supervised::Fired, output: &str) -> bool {
        let Some((net, transition)) = self.transition(fired) else { return false };
        transition
            .emits
            .iter()
            .any(|it| net.outputs.get(it.0 as usize).is_some_and(|it| it.name == output))
    }

    /// An event of the supervisors: its net and its name.
    fn event_name(&self, told: cotama::Told) -> String {
        let event = told.event();
        let component =
            self.system.components.get(usize::from(event.component)).map_or("", |it| it.name);
        let name = self
            .net(component)
            .and_then(|net| net.events.get(event.id.0 as usize))
            .map_or("", |it| it.name);
        format!("{component}.{name}")
    }

    fn record_diagnoses<R: Recorder>(&self, done: &mut Recorded, t_us: u64, to: &mut R) {
        let x_mm = self.robot.x().0;
        // A failure that no available observer sees is diagnosed as nothing, and nobody learns of
        // it.
        let found = |it: &Conduct| it.detected.is_some_and(|it| it.1 != cotama::Diagnosis::None);
        let new = |(it, noted): (&Conduct, &Noted)| found(it) && !noted.diagnosis;
        let news: Vec<usize> = (0..done.conduct.len())
            .filter(|&at| new((&self.run.conduct[at], &done.conduct[at])))
            .collect();
        let Some(conduct) = news.first().map(|&at| &self.run.conduct[at]) else { return };
        // A diagnosis is judged in the round in which it is made.
        let Some(judged) = conduct.judged else { return };
        for &at in &news {
            done.conduct[at].diagnosis = true;
        }
        to.record(Record::Diagnosis(Diagnosis {
            t_us,
            x_mm,
            failures: news.into_iter().map(one_based).collect(),
            flags: conduct.flags.iter().map(|it: Flag| it.name().into()).collect(),
            candidates: candidates(conduct),
            report: judged.report.map(|it| it.name().into()),
            severity: judged.severity,
            by_severity: judged.severity.class(),
            by_availability: judged.by_availability,
        }));
    }

    fn record_exposures<R: Recorder>(&self, done: &mut Recorded, t_us: u64, to: &mut R) {
        for (number, (it, noted)) in self.run.conduct.iter().zip(&mut done.conduct).enumerate() {
            let grew = it.exposed > noted.exposed;
            if noted.exposing && !grew {
                self.record_exposure(number, t_us, to);
            }
            (noted.exposed, noted.exposing) = (it.exposed, grew);
        }
    }

    fn record_exposure<R: Recorder>(&self, number: usize, t_us: u64, to: &mut R) {
        let exposed_ms = self.run.conduct.get(number).map_or(0, |it| it.exposed.0);
        let (x_mm, failure) = (self.robot.x().0, one_based(number));
        to.record(Record::Exposure(Exposure { t_us, x_mm, failure, exposed_ms }));
    }

    /// Activities and samples: where the robot is after the round.
    fn record_progress<R: Recorder>(&self, done: &mut Recorded, period: Millis, to: &mut R) {
        let (t_us, x_mm) = (self.now.0 * 1000, self.robot.x().0);
        let at = self.progress();
        let under_way = matches!(self.objective(), Objective::Drives(_) | Objective::Stands(_));
        if under_way && done.activity != Some(at.activity) {
            done.activity = Some(at.activity);
            let (choice, speed, _) = self.planning.planned(at.activity);
            let activity = self.mission.scenario().activities[at.activity].id.clone();
            let (choice, speed_mm_s) = (choice.into(), speed.0);
            to.record(Record::Activity(Activity { t_us, x_mm, activity, choice, speed_mm_s }));
        }
        if self.now >= done.next_sample {
            done.next_sample = Millis(self.now.0.saturating_add(period.0));
            to.record(self.sample(t_us, self.used(), self.margins()));
        }
    }

    /// Limits less used less what is left of the plan in force, in ms and mJ.
    fn margins(&self) -> [i64; 2] {
        let (used, rest, limits) =
            (self.used(), self.planning.rest(self.progress()), self.mission.scenario().limits);
        std::array::from_fn(|axis| {
            let spent = u128::from(used[axis]) + u128::from(rest[axis]);
            let margin =
                i128::from(limits[axis]).saturating_sub(i128::try_from(spent).unwrap_or(i128::MAX));
            i64::try_from(margin).unwrap_or(i64::MIN)
        })
    }

    fn sample(&self, t_us: u64, used: [u64; 2], margins: [i64; 2]) -> Record {
        let activity = self.activity();
        let (_, _, planned) = self.planning.planned(activity);
        let real = self.power(activity, false);
        Record::Sample(Sample {
            t_us,
            x_mm: self.robot.x().0,
            used: used.into(),
            margins: margins.into(),
            planned_power_mw: planned.0,
            real_power_mw: real.0,
            speed_mm_s: self.robot.drive.speed().0,
        })
    }

    fn plan_record(&self, plan: &crate::run::PlanMade) -> Plan {
        let activity = self.mission.scenario().activities.get(plan.first_activity);
        Plan {
            t_us: plan.t_us,
            x_mm: plan.x_mm,
            cause: plan.cause.text(self.mission),
            first_activity: activity.map_or_else(String::new, |it| it.id.clone()),
            before: plan.before.map(Into::into),
            after: plan.after.into(),
            used: plan.used.into(),
            plan: plan.rows(self.mission),
            steps: plan.steps,
            allocator: plan.allocator.into(),
            return_margin: ReturnMargin::default(),
        }
    }

    /// Records the end.
    pub(in crate::supervised) fn record_end<R: Recorder>(&self, done: &mut Recorded, to: &mut R) {
        let t_us = self.now.0 * 1000;
        for number in 0..done.conduct.len() {
            if done.conduct[number].exposing {
                self.record_exposure(number, t_us, to);
            }
        }
        let mut run = self.run.clone();
        (run.time, run.x, run.used) = (self.now, self.robot.x(), self.used());
        run.plans.clone_from(&self.planning.made);
        let run = run.summary(self.mission);
        to.record(Record::End(End {
            t_us,
            x_mm: run.x_mm,
            outcome: run.outcome,
            reason: run.reason.map(|reason| reason.text(self.mission)),
            margins: run.margins.into(),
            used: run.used.into(),
            replans: run.replans,
            operator_requests: run.operator_requests,
        }));
    }
}

/// The number of a failure in a trace.
fn one_based(number: usize) -> u16 {
    u16::try_from(number + 1).unwrap_or(u16::MAX)
}

/// The rows of the FMECA that a failure was taken for.
fn candidates(conduct: &Conduct) -> Vec<String> {
    match conduct.detected {
        Some((_, cotama::Diagnosis::Unique(mode))) => vec![mode.name().into()],
        Some((_, cotama::Diagnosis::Ambiguous(modes))) => {
            modes.iter().map(|it| it.name().into()).collect()
        }
        _ => Vec::new(),
    }
}

/// The state that is marked after a transition.
fn place<'n>(net: &Net<'n>, transition: &Transition<'n>) -> &'n str {
    let places = transition.give.iter().filter_map(|it| net.places.get(it.place.0 as usize));
    { places }.find(|it| it.role == Role::State).map_or("", |it| it.name)
}
