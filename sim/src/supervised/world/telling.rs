//! What the supervisors are told, and what they make of it.

use super::objective::Objective;
use super::{CLOCKS, World};
use crate::supervised::effect::{Ends, effect};
use crate::supervised::operator::View;
use crate::supervised::{Decided, Fired, PLANNING};
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::{Firing, Names, Observer, Program};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Cause, Configuration, Diagnosis, FailureMode, Loss, Module, Report, Told, faults, global,
    local, operator,
};
use cotama_models::missions::Does;

/// How long the planner may take beyond what it usually does (FMECA, row PPL1).
const PATIENCE_WITH_PLANNER: Millis = Millis(5_000);

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
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
                if name == "pf" || name == "to" {
                    self.adjust(carries);
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
            self.start_adjusted();
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
            let mode = self.situation.mode();
            self.judge(FailureMode::Opr1.rule().report, FailureMode::Opr1.severity(mode));
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
            // Nor is he offered a camera that the robot does not rely on.
            camera: left.has(Module::Cam) && !self.lost.has(Loss::Camera),
            planner_failed: report == Some(Report::Planner) && self.plannings_failed < 2,
            can_go_on: self.plannings_failed < 2
                && (Configuration::FollowingOdometric.runs_on(left)
                    || Configuration::FollowingDvz.runs_on(left)),
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
