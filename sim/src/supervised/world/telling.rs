//! What the supervisors are told, and what they make of it.

use super::World;
use crate::run;
use crate::supervised::effect::{Ends, effect, observable};
use crate::supervised::operator::View;
use crate::supervised::plan::Progress;
use crate::supervised::{Decided, Fired, PERIOD, PLANNING};
use cotama_core::system::{Happening, Offered};
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Cause, Configuration, Diagnosis, Flags, Loss, Losses, Module, Modules, Report, Told, delivery, diagnose,
    faults, global, local,
};
use cotama_models::mission::Does;
use cotama_models::tables::Rest;

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

impl World<'_> {
    /// What the global supervisor is about. Its places are: waiting, the objectives, done, security, safe.
    pub(super) fn objective(&self) -> Objective {
        let (place, count) = (self.global.0 as usize, self.mission.objectives.len());
        match place.checked_sub(1) {
            None => Objective::Waits,
            Some(it) if it < count && self.mission.objectives[it].travels() => Objective::Drives(it),
            Some(it) if it < count => Objective::Stands(it),
            Some(it) if it == count => Objective::Done,
            Some(it) if it == count + 1 => Objective::Security,
            Some(_) => Objective::Safe,
        }
    }

    /// Observers look; what they newly see is diagnosed.
    pub(super) fn observe(&mut self) {
        let moving = self.robot.speed().0 > 0;
        let asked = self.situation.local == local::State::HandOver;
        let mut raised = Flags::NONE;
        let mut seen = Vec::new();
        for (number, failure) in self.failures.iter_mut().enumerate() {
            let found = self.run.conduct[number].detected.is_some();
            if failure.over || found || !observable(failure.mode, self.situation, moving, asked) {
                continue;
            }
            failure.seen.0 += PERIOD.0;
            if failure.seen >= Millis(u64::from(failure.mode.rule().latency_ms)) {
                raised = raised.union(failure.mode.rule().signature.always);
                seen.push(number);
            }
        }
        let Some(&first) = seen.first() else { return };
        let diagnosis = diagnose(raised, self.known.available());
        for &number in &seen {
            self.run.conduct[number].detected = Some((self.now, diagnosis));
        }
        self.conclude(diagnosis, Cause(first as u16 + 1));
    }

    /// What follows from a diagnosis: what is lost is planned around, and reported.
    fn conclude(&mut self, diagnosis: Diagnosis, cause: Cause) {
        let before = Losses::from(self.known);
        let part = usize::from(cause.0).checked_sub(1).and_then(|it| self.failures.get(it));
        self.known = self.known.union(diagnosis.health(part.map_or(Modules::NONE, |it| it.part)));
        let report = match diagnosis {
            Diagnosis::None => return,
            Diagnosis::Unique(mode) => mode.rule().report,
            Diagnosis::Ambiguous(_) | Diagnosis::Unexplained => Some(Report::Ambiguous),
        };
        let lost = Losses::from(self.known).without(before);
        for loss in lost.iter() {
            self.untold.push_back((Told::Failure(lost_event(loss)), cause));
        }
        if let Some(event) = report.and_then(passing_event) {
            self.untold.push_back((Told::Failure(event), cause));
        }
        if !lost.is_empty() {
            self.plan_again(lost, cause);
        }
    }

    /// Plans the rest of the mission with the modules that are left. Without a plan the adapter has nothing to switch to.
    fn plan_again(&mut self, lost: Losses, cause: Cause) {
        if lost.has(Loss::Vital) {
            return; // the mission is given up
        }
        let module = lost.first().map_or(Module::P3d, module_of);
        let hardware = self.mission.hardware.iter().position(|it| it.name == module.name()).unwrap_or(0);
        let why = run::Cause::Hardware { hardware, units: 1 };
        let at = self.progress();
        if at.activity < self.mission.scenario().activities.len()
            && self.planning.plan(why, at, self.known.available()).is_err()
        {
            self.untold.push_back((Told::Failure(faults::Event::fail_hard), cause));
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
        let _ = self.level.round(self.now, &mut |it: &Happening<Cause>| seen.push(*it));
        self.run.rounds += 1;
        let mut said = self.says();
        while let Some((told, cause)) = self.untold.pop_front().or_else(|| said.take()) {
            let offered = self.level.tell(self.now, told, cause, &mut |it: &Happening<Cause>| seen.push(*it));
            if let Offered::Fired(_) = offered {
                self.run.told.push((self.run.rounds, told));
                break;
            }
        }
        seen.iter().for_each(|it| self.note(it));
        self.arrive_at_places();
    }

    /// Notes what happened.
    fn note(&mut self, happening: &Happening<Cause>) {
        let system = delivery::SYSTEM;
        let conduct = |cause: Cause| usize::from(cause.0).checked_sub(1);
        match *happening {
            Happening::Fired { transition: id, carries, .. } => {
                let Some(component) = system.components.get(usize::from(id.component)) else { return };
                let Some(transition) = component.net.transitions.get(id.id.0 as usize) else { return };
                let (net, at) = (component.name, self.now);
                if net == "faults" || net == "operator" {
                    return;
                }
                self.run.fired.push(Fired { at, net, transition: transition.name, cause: carries });
                if net == "ls"
                    && transition
                        .emits
                        .iter()
                        .any(|it| component.net.outputs[it.0 as usize].name == "op_request")
                {
                    self.run.operator_requests += 1;
                }
                let Some(conduct) = conduct(carries).and_then(|it| self.run.conduct.get_mut(it)) else {
                    return;
                };
                let said = transition.emits.first().and_then(|it| component.net.outputs.get(it.0 as usize));
                match (net, said) {
                    ("cs", Some(said)) => {
                        conduct.decided.get_or_insert((at, Decided::from(said.name)));
                    }
                    ("gom" | "permit", _) => {}
                    _ => {
                        conduct.answered.get_or_insert(at);
                    }
                }
            }
            Happening::Ignored { event, carries } => {
                let contextual =
                    system.components.get(usize::from(event.component)).is_some_and(|it| it.name == "cs");
                if let (true, Some(at)) = (contextual, conduct(carries)) {
                    let now = self.now;
                    if let Some(conduct) = self.run.conduct.get_mut(at) {
                        conduct.decided.get_or_insert((now, Decided::Record));
                    }
                }
            }
            _ => {}
        }
    }

    /// Where the supervisors have come to.
    fn arrive_at_places(&mut self) {
        let before = (self.situation.local, self.situation.configuration());
        self.situation = self.level.situation(Losses::from(self.known));
        let after = (self.situation.local, self.situation.configuration());
        if after.0 != before.0 {
            self.local_since = self.now;
            if !self.first.iter().any(|it| it.0 == after.0) {
                self.first.push((after.0, self.now));
            }
            let helped = matches!(before.0, local::State::Teleprogrammed | local::State::Teleoperated);
            if helped {
                for failure in self.failures.iter_mut().filter(|it| effect(it.mode).ends == Ends::Helped) {
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
            Objective::Waits => return Some((Told::Mission(global::Event::mission_received), none)),
            Objective::Security if self.robot.speed().0 == 0 => {
                return Some((Told::Mission(global::Event::stopped), none));
            }
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, self.robot.x().0);
                if waited(self.global_since) < self.planning.standing(activity).0 {
                    return None;
                }
                let event = match self.mission.objectives[it].does.as_ref().map(|it| it.value) {
                    Some(Does::Deliver) => global::Event::object_delivered,
                    _ => global::Event::object_received,
                };
                return Some((Told::Mission(event), none));
            }
            Objective::Drives(_) => {}
            _ => return None,
        }
        match self.situation.local {
            local::State::Planning if waited(self.local_since) >= PLANNING.0 && self.can_plan() => {
                Some((Told::Drive(local::Event::path_ready), none))
            }
            local::State::Following if at_goal => Some((Told::Drive(local::Event::goal_reached), none)),
            local::State::HandOver | local::State::Teleprogrammed | local::State::Teleoperated => {
                let view = self.view(at_goal);
                self.operator.says(self.now, view).map(|it| (Told::Operator(it), none))
            }
            _ => None,
        }
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
            link: left.has(Module::Lan),
            camera: left.has(Module::Cam),
            planner_failed: report == Some(Report::Planner),
            can_go_on: left.covers(Configuration::FollowingOdometric.facts().required),
            at_goal,
        }
    }
}

/// The event of a loss.
const fn lost_event(loss: Loss) -> faults::Event {
    match loss {
        Loss::Mcl => faults::Event::lose_mcl,
        Loss::Sonar => faults::Event::lose_sonar,
        Loss::Camera => faults::Event::lose_camera,
        Loss::Wifi => faults::Event::lose_wifi,
        Loss::Vital => faults::Event::lose_vital,
    }
}

/// A module that a loss takes away.
const fn module_of(loss: Loss) -> Module {
    match loss {
        Loss::Mcl => Module::Mcl,
        Loss::Sonar => Module::Ust,
        Loss::Camera => Module::Cam,
        Loss::Wifi => Module::Lan,
        Loss::Vital => Module::P3d,
    }
}

/// The event of a report that is no loss.
const fn passing_event(report: Report) -> Option<faults::Event> {
    match report {
        Report::Slow => Some(faults::Event::overload),
        Report::Ambiguous => Some(faults::Event::drift),
        Report::Collision => Some(faults::Event::bump),
        Report::Planner => Some(faults::Event::no_path),
        _ => None,
    }
}
