//! What the supervisors are told, and what they make of it.

use super::{CLOCKS, World};
use crate::run::{self, NoPlan};
use crate::supervised::effect::{Ends, effect, observable};
use crate::supervised::operator::View;
use crate::supervised::plan::Progress;
use crate::supervised::{Decided, Fired, Judged, PERIOD, PLANNING};

/// How long the planner may take beyond what it usually does (FMECA, row PPL1).
const PATIENCE_WITH_PLANNER: Millis = Millis(5_000);
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::{Firing, Names, Observer, Program};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Cause, Configuration, Diagnosis, FailureMode, Flags, Health, Loss, Losses, Mode, Module,
    Modules, Report, Severity, Told, by_availability, decide, diagnose, faults, global,
    is_detectable, judge, local, operator,
};
use cotama_models::missions::Does;
use cotama_models::missions::tables::Rest;

/// What the global supervisor is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Objective {
    /// It has no mission yet.
    Waits,
    /// It drives: the number of the objective.
    Drives(usize),
    /// It stands: the number of the objective.
    Stands(usize),
    /// The mission is accomplished.
    Done,
    /// The robot is to stop.
    Security,
    /// It has stopped for good.
    Safe,
}

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// What the global supervisor is about. Its places are: waiting, the objectives, done,
    /// security, safe.
    pub(super) fn objective(&self) -> Objective {
        let (place, count) = (self.global.0 as usize, self.mission.objectives.len());
        match place.checked_sub(1) {
            None => Objective::Waits,
            Some(it) if it < count && self.mission.objectives[it].travels() => {
                Objective::Drives(it)
            }
            Some(it) if it < count => Objective::Stands(it),
            Some(it) if it == count => Objective::Done,
            Some(it) if it == count + 1 => Objective::Security,
            Some(_) => Objective::Safe,
        }
    }

    /// Observers look; what they newly see is diagnosed.
    pub(super) fn observe(&mut self) {
        let moving = self.robot.speed().0 > 0;
        let mut raised = Flags::NONE;
        let mut seen = Vec::new();
        for (number, failure) in self.failures.iter_mut().enumerate() {
            let found = self.run.conduct[number].detected.is_some();
            if failure.over || found || !observable(failure.mode, self.situation, moving) {
                continue;
            }
            failure.seen.0 += PERIOD.0;
            if failure.seen >= Millis(u64::from(failure.mode.rule().latency_ms)) {
                raised = raised.union(failure.mode.rule().signature.always);
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
            self.conclude(diagnosis, cause);
        }
        for mode in modes {
            self.conclude(Diagnosis::Unique(mode), cause);
        }
    }

    /// The modules that work as far as is known: what the operator has set right is not held
    /// against its observers.
    fn observing(&self) -> Modules {
        let found = self.failures.iter().zip(&self.run.conduct).filter(|(it, _)| !it.over);
        let found = found
            .filter_map(|(it, conduct)| conduct.detected.map(|(_, what)| what.health(it.part)));
        found.fold(Health::SOUND, Health::union).available()
    }

    /// What follows from a diagnosis: what is lost is planned around, and reported.
    fn conclude(&mut self, diagnosis: Diagnosis, cause: Cause) {
        let before = self.known.available();
        let part = usize::from(cause.0).checked_sub(1).and_then(|it| self.failures.get(it));
        self.known = self.known.union(diagnosis.health(part.map_or(Modules::NONE, |it| it.part)));
        let left = self.known.available();
        self.lose(Losses::lacking(left), cause);
        let (report, severity) = match diagnosis {
            Diagnosis::None => return,
            Diagnosis::Unique(mode) => (mode.rule().report, self.severity(mode)),
            Diagnosis::Ambiguous(_) | Diagnosis::Unexplained => {
                (Some(Report::Ambiguous), Severity::Hard)
            }
        };
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

    /// Compares what was used with the plan, once a second; plans again when a margin is below
    /// zero, and asks the operator when there is no such plan (Lambert et al. 2024, Section 5:
    /// performance margins).
    pub(super) fn watch_margins(&mut self) {
        let at = self.progress();
        if self.resigned
            || !self.now.0.is_multiple_of(1_000)
            || !matches!(self.objective(), Objective::Drives(_))
        {
            return;
        }
        let Some(axis) = self.planning.short(at) else { return };
        if self.planning.plan(run::Cause::Margin { axis }, at, self.known.available()).is_ok() {
            self.do_without(Cause(0));
        } else {
            self.resigned = true;
            self.untold.push_back((Told::Failure(faults::Event::fail_hard), Cause(0)));
        }
    }

    /// Notes how what was detected now is judged.
    fn judge(&mut self, report: Option<Report>, severity: Severity) {
        let left = self.known.available();
        let operator = left.has(Module::Lan) && report != Some(Report::Refusal);
        let situation = self.level.situation(self.lost);
        let by_availability = by_availability(situation, left, operator);
        for it in
            self.run.conduct.iter_mut().filter(|it| it.detected.is_some_and(|it| it.0 == self.now))
        {
            it.judged.get_or_insert(Judged { report, severity, by_availability });
        }
    }

    /// How severe a failure is where the robot is.
    fn severity(&self, mode: FailureMode) -> Severity {
        match self.situation.mode() {
            Mode::Rest | Mode::Autonomous => mode.rule().autonomous,
            Mode::HandOver | Mode::Teleprogrammed | Mode::Teleoperated => mode.rule().operator,
        }
    }

    /// The supervisors learn of losses.
    fn lose(&mut self, lost: Losses, cause: Cause) {
        let new = lost.without(self.lost);
        self.lost = self.lost.union(new);
        // The most severe first; without vital parts nothing else matters.
        let mut new: Vec<Loss> = new.iter().collect();
        new.reverse();
        new.truncate(if new.first() == Some(&Loss::Vital) { 1 } else { new.len() });
        self.untold.extend(new.into_iter().map(|it| (Told::Failure(lost_event(it)), cause)));
    }

    /// Plans the rest of the mission with the modules that are left.
    fn plan_again(&mut self, gone: Modules, cause: Cause) -> Result<(), NoPlan> {
        let at = self.progress();
        if self.lost.has(Loss::Vital) || at.activity >= self.mission.scenario().activities.len() {
            return Ok(()); // nothing is left to be planned
        }
        let named =
            |it: &Module| self.mission.hardware.iter().position(|kind| kind.name == it.name());
        let Some(hardware) = gone.iter().find_map(|it| named(&it)) else { return Ok(()) };
        self.planning.plan(
            run::Cause::Hardware { hardware, units: 1 },
            at,
            self.known.available(),
        )?;
        self.do_without(cause);
        Ok(())
    }

    /// What the plan does without is withdrawn, so that the adapter comes to the configuration that
    /// is planned.
    pub(super) fn do_without(&mut self, cause: Cause) {
        self.lose(self.unused(), cause);
    }

    /// What the plan does without.
    pub(super) fn unused(&self) -> Losses {
        let at = self.progress();
        let drives = (at.activity..self.mission.scenario().activities.len())
            .find_map(|it| self.planning.configuration(it));
        match drives {
            Some(Configuration::FollowingOdometric) => Losses::of(&[Loss::Mcl]),
            Some(Configuration::FollowingDegraded) => Losses::of(&[Loss::Mcl, Loss::Sonar]),
            _ => Losses::NONE,
        }
    }

    /// How far the mission has come.
    pub(super) fn progress(&self) -> Progress {
        let x_mm = self.robot.x().0;
        let (activity, rest) = match self.objective() {
            Objective::Waits => (0, None),
            Objective::Drives(it) => {
                let activity = self.planning.activity(it, x_mm);
                let end = self.mission.scenario().activities[activity].x_end;
                let left = cotama_core::units::Millimetres(end.0.saturating_sub(x_mm).max(1));
                (activity, Some(Rest::Travel(left)))
            }
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, x_mm);
                let done = self.now.0.saturating_sub(self.global_since.0);
                let left = self.planning.standing(activity).0.saturating_sub(done);
                (activity, Some(Rest::Time(Millis(left))))
            }
            _ => (self.mission.scenario().activities.len(), None),
        };
        Progress { activity, rest, now: self.now, x_mm, used: self.used() }
    }

    /// The supervisors take a round, and are told one thing.
    pub(super) fn take_a_round(&mut self) {
        let mut seen = Vec::new();
        let _ = self.level.round(self.now, &mut Seeing(&mut seen));
        self.run.rounds += 1;
        // What the mission and the operator have to say waits for failures.
        let mut said = if self.untold.is_empty() { self.says() } else { None };
        while let Some((told, cause)) = self.untold.pop_front().or_else(|| said.take()) {
            let offered = self.level.tell(self.now, told, cause, &mut Seeing(&mut seen));
            if offered.fired() {
                self.run.told.push((self.run.rounds, told));
                break;
            }
        }
        for it in &seen {
            self.note(it);
        }
        self.arrive_at_places();
    }

    /// Notes what happened.
    fn note(&mut self, seen: &Seen) {
        let system = self.system;
        let conduct = |cause: Cause| usize::from(cause.0).checked_sub(1);
        match *seen {
            Seen::Fired(id, carries) => {
                let Some(component) = system.components.get(usize::from(id.component)) else {
                    return;
                };
                let (name, at) = (component.name, self.now);
                let net = if name == "gs" { &self.global_net } else { component.net };
                let Some(transition) = net.transitions.get(id.id.0 as usize) else { return };
                if name == "faults" || name == "operator" {
                    return;
                }
                let transition_name = transition.name.to_owned();
                self.run.fired.push(Fired {
                    at,
                    net: name,
                    transition: transition_name,
                    cause: carries,
                });
                let mut says =
                    transition.emits.iter().filter_map(|it| net.outputs.get(it.0 as usize));
                if name == "ls" && says.any(|it| it.name == "op_request") {
                    self.run.operator_requests += 1;
                }
                let Some(conduct) = conduct(carries).and_then(|it| self.run.conduct.get_mut(it))
                else {
                    return;
                };
                let said = transition.emits.first().and_then(|it| net.outputs.get(it.0 as usize));
                match (name, said) {
                    ("cs", Some(said)) => {
                        conduct.decided.get_or_insert((at, Decided::from(said.name)));
                    }
                    ("gom" | "permit", _) => {}
                    _ => {
                        conduct.answered.get_or_insert(at);
                    }
                }
            }
            Seen::Ignored(event, carries) => {
                let contextual = system
                    .components
                    .get(usize::from(event.component))
                    .is_some_and(|it| it.name == "cs");
                if let (true, Some(at)) = (contextual, conduct(carries)) {
                    let now = self.now;
                    if let Some(conduct) = self.run.conduct.get_mut(at) {
                        conduct.decided.get_or_insert((now, Decided::Record));
                    }
                }
            }
        }
    }

    /// Where the supervisors have come to.
    fn arrive_at_places(&mut self) {
        let before = (self.situation.local, self.situation.configuration());
        self.situation = self.level.situation(self.lost);
        let after = (self.situation.local, self.situation.configuration());
        if after.0 != before.0 {
            self.local_since = self.now;
            if !self.first.iter().any(|it| it.0 == after.0) {
                self.first.push((after.0, self.now));
            }
            let helped =
                matches!(before.0, local::State::Teleprogrammed | local::State::Teleoperated);
            if helped {
                for failure in
                    self.failures.iter_mut().filter(|it| effect(it.mode).ends == Ends::Helped)
                {
                    failure.over = true;
                }
            }
        }
        if after.1 != before.1 {
            self.run.configurations.push((self.now, after.1));
        }
        let global = self.level.global();
        if global != self.global {
            (self.global, self.global_since) = (global, self.now);
        }
    }

    /// What the mission or the operator has to say, if anything.
    fn says(&mut self) -> Option<(Told, Cause)> {
        let none = Cause(0);
        let waited = |since: Millis| self.now.0.saturating_sub(since.0);
        let at_goal = self.robot.x() >= self.end();
        match self.objective() {
            Objective::Waits => {
                return Some((Told::Mission(global::Event::mission_received), none));
            }
            Objective::Security if self.robot.speed().0 == 0 => {
                return Some((Told::Mission(global::Event::stopped), none));
            }
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, self.robot.x().0);
                if waited(self.global_since) < self.planning.standing(activity).0 {
                    return None;
                }
                let told = match self.mission.objectives[it].does.as_ref().map(|it| it.value) {
                    Some(Does::Deliver) => Told::Mission(global::Event::object_delivered),
                    Some(Does::Receive) => Told::Mission(global::Event::object_received),
                    _ => Told::WaitOver,
                };
                return Some((told, none));
            }
            Objective::Drives(_) => {}
            _ => return None,
        }
        match self.situation.local {
            local::State::Planning if waited(self.local_since) >= PLANNING.0 && self.can_plan() => {
                Some((Told::Drive(local::Event::path_ready), none))
            }
            local::State::Planning
                if waited(self.local_since) >= PLANNING.0 + PATIENCE_WITH_PLANNER.0 =>
            {
                self.local_since = self.now;
                self.plannings_failed += 1;
                Some((Told::Failure(faults::Event::no_path), none))
            }
            local::State::Following if at_goal => {
                Some((Told::Drive(local::Event::goal_reached), none))
            }
            local::State::HandOver | local::State::Teleprogrammed | local::State::Teleoperated => {
                let view = self.view(at_goal);
                let said = self.operator.says(self.now, view)?;
                let cause = if said == operator::Event::gives_up { self.silence() } else { none };
                Some((Told::Operator(said), cause))
            }
            _ => None,
        }
    }

    /// The operator's silence, if that is a failure under way: it is found when the patience of the
    /// robot ends.
    fn silence(&mut self) -> Cause {
        let Some(at) = self.failures.iter().position(|it| it.mode == FailureMode::Opr1) else {
            return Cause(0);
        };
        let (diagnosis, conduct) =
            (Diagnosis::Unique(FailureMode::Opr1), &mut self.run.conduct[at]);
        if conduct.detected.is_none() {
            (conduct.detected, conduct.flags) =
                (Some((self.now, diagnosis)), FailureMode::Opr1.rule().signature.always);
            self.judge(FailureMode::Opr1.rule().report, self.severity(FailureMode::Opr1));
        }
        Cause(at as u16 + 1)
    }

    /// Whether a path can be planned: the planner works.
    fn can_plan(&self) -> bool {
        self.broken().available().covers(Configuration::Planning.facts().required)
    }

    /// What the operator knows.
    fn view(&self, at_goal: bool) -> View {
        let left = self.broken().available();
        let asked_about = self.run.conduct.iter().rfind(|it| it.answered.is_some());
        let report = asked_about.and_then(|it| it.mode.rule().report);
        View {
            place: self.situation.local,
            x: self.robot.x(),
            link: left.has(Module::Lan)
                && !self.failures.iter().any(|it| it.mode == FailureMode::Opr1),
            camera: left.has(Module::Cam),
            planner_failed: report == Some(Report::Planner) && self.plannings_failed < 2,
            can_go_on: self.plannings_failed < 2
                && left.covers(Configuration::FollowingOdometric.facts().required),
            at_goal,
            moves: self.robot.speed().0 > 0,
        }
    }
}

/// What is seen of the supervisors, with the cause that it goes back to.
#[derive(Clone, Copy, Debug)]
enum Seen {
    Fired(Of<TransitionId>, Cause),
    Ignored(Of<EventId>, Cause),
}

/// Sees what fires and what is ignored.
struct Seeing<'s>(&'s mut Vec<Seen>);

impl<P: Names> Observer<P, Cause> for Seeing<'_> {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.0.push(Seen::Fired(firing.id, firing.carries));
    }

    fn on_ignore(&mut self, event: Of<EventId>, cause: Cause) {
        self.0.push(Seen::Ignored(event, cause));
    }
}

/// The event of a loss.
const fn lost_event(loss: Loss) -> faults::Event {
    match loss {
        Loss::Avoidance => faults::Event::lose_avoidance,
        Loss::Mcl => faults::Event::lose_mcl,
        Loss::Sonar => faults::Event::lose_sonar,
        Loss::Camera => faults::Event::lose_camera,
        Loss::Wifi => faults::Event::lose_wifi,
        Loss::Vital => faults::Event::lose_vital,
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
        _ => None,
    }
}
