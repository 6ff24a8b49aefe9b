//! The events for the supervisors, and their reactions.

use super::objective::Objective;
use super::{CLOCKS, World};
use crate::body::PLANNING;
use crate::supervised::operator::View;
use crate::supervised::{Fired, Violation};
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::{Firing, Names, Observer, Player, Program};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, Cause, Class, Configuration, FailureMode, Loss, Module, Report, Situation, Told, Word,
    delivery, local,
};
use cotama_models::missions::Does;

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// The supervisors take a round, and are told one thing.
    pub(super) fn take_a_round(&mut self) {
        // Words of the mission and the operator wait for failures.
        let said = if self.decider.listens() { self.says() } else { None };
        let mut seen = Vec::new();
        let before = (self.decider.situation(), self.decider.global());
        let round = self.decider.round(self.now, said, self.body(), &mut Seeing(&mut seen));
        self.run.rounds += 1;
        self.run.told.extend(round.told.map(|told| (self.run.rounds, told)));
        if let Some(finding) = round.finding {
            let silence: Vec<_> = self.silence().into_iter().collect();
            self.note_finding(&finding, &silence, silence.first().copied());
        }
        self.calm &= round.told.is_none() && round.finding.is_none() && seen.is_empty();
        for it in &seen {
            self.note(it);
        }
        self.arrive_at_places(before);
        self.watch(round.told);
        self.robot.took_a_round(self.decider.listens());
    }

    /// Monitors look at what has come of a round.
    fn watch(&mut self, told: Option<Told>) {
        let (now, player) = (self.now, self.decider.level().player());
        if let Some(monitor) = self.watching.look(now, player)
            && self.run.violated.is_none()
        {
            // A requirement is late because nothing fired: then the last firing stands for it.
            let last = self.run.fired.last().map(|it| it.at);
            let then = self.run.fired.iter().filter(|it| Some(it.at) == last);
            let fired = then.map(|it| format!("{}.{}", it.net, it.transition)).collect();
            self.run.violated = Some(Violation { at: now, monitor, fired });
        }
        let Some(shipped) = &mut self.shipped else { return };
        let _ = shipped.round(now, &mut ());
        if let Some(told) = told {
            let _ = shipped.tell(now, told, Cause(0), &mut ());
        }
        if self.run.departed.is_none()
            && let Some(place) = departs(&self.system, player, shipped.player())
        {
            self.run.departed = Some((now, place));
        }
    }

    /// Returns the state of the drive.
    fn body(&self) -> Body {
        Body { at_goal: self.robot.x() >= self.end(), stands: !self.robot.moves() }
    }

    /// The failure that a finding goes back to.
    fn failure(&self, cause: Cause) -> Cause {
        let finding = usize::from(cause.0).checked_sub(1);
        Cause(finding.and_then(|it| self.causes.get(it)).copied().unwrap_or(0))
    }

    /// Notes what happened.
    fn note(&mut self, seen: &Seen) {
        let system = self.system;
        let conduct = |cause: Cause| usize::from(cause.0).checked_sub(1);
        match *seen {
            Seen::Fired(id, finding) => {
                let carries = self.failure(finding);
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
                        conduct.decided.get_or_insert((at, Class::of_output(said.name)));
                    }
                    ("gom" | "permit", _) => {}
                    _ => {
                        conduct.answered.get_or_insert(at);
                    }
                }
            }
            Seen::Ignored(event, finding) => {
                let carries = self.failure(finding);
                let contextual = system
                    .components
                    .get(usize::from(event.component))
                    .is_some_and(|it| it.name == "cs");
                if let (true, Some(at)) = (contextual, conduct(carries)) {
                    let now = self.now;
                    if let Some(conduct) = self.run.conduct.get_mut(at) {
                        conduct.decided.get_or_insert((now, Class::Record));
                    }
                }
            }
        }
    }

    /// Notes the places that the supervisors have come to.
    fn arrive_at_places(&mut self, (before, global): (Situation, PlaceId)) {
        let after = self.decider.situation();
        if after.local != before.local {
            if !self.first.iter().any(|it| it.0 == after.local) {
                self.first.push((after.local, self.now));
            }
            let helped =
                matches!(before.local, local::State::Teleprogrammed | local::State::Teleoperated);
            if helped {
                self.robot.is_helped();
            }
        }
        if after.configuration() != before.configuration() {
            self.run.configurations.push((self.now, after.configuration()));
        }
        if self.decider.global() != global {
            self.global_since = self.now;
        }
    }

    /// Returns the word of the mission, the planner of paths or the operator, if any.
    fn says(&mut self) -> Option<Word> {
        let waited = |since: Millis| self.now.0.saturating_sub(since.0);
        match self.objective() {
            Objective::Waits => return Some(Word::MissionReceived),
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, self.robot.x().0);
                if waited(self.global_since) < self.planning.standing(activity).0 {
                    return None;
                }
                return Some(match self.mission.objectives[it].does.as_ref().map(|it| it.value) {
                    Some(Does::Deliver) => Word::ObjectDelivered,
                    Some(Does::Receive) => Word::ObjectReceived,
                    _ => Word::WaitOver,
                });
            }
            Objective::Drives(_) => {}
            _ => return None,
        }
        match self.decider.situation().local {
            local::State::Planning if waited(self.decider.since()) >= PLANNING.0 => {
                self.can_plan().then_some(Word::PathReady)
            }
            local::State::HandOver | local::State::Teleprogrammed | local::State::Teleoperated => {
                let view = self.view();
                self.operator.says(self.now, view).map(Word::Operator)
            }
            _ => None,
        }
    }

    /// Whether a path can be planned: the planner works.
    fn can_plan(&self) -> bool {
        self.robot.broken().available().covers(Configuration::Planning.facts().required)
    }

    /// Returns the operator's knowledge.
    fn view(&self) -> View {
        let left = self.robot.broken().available();
        let asked_about = self.run.conduct.iter().rfind(|it| it.answered.is_some());
        let report = asked_about.and_then(|it| it.mode.rule().report);
        View {
            place: self.decider.situation().local,
            x: self.robot.x(),
            link: left.has(Module::Lan)
                && !self.robot.failures.iter().any(|it| it.mode == FailureMode::Opr1),
            // Nor is he offered a camera that the robot does not rely on.
            camera: left.has(Module::Cam) && !self.decider.situation().lost.has(Loss::Camera),
            planner_failed: report == Some(Report::Planner) && self.decider.plannings_failed() < 2,
            can_go_on: self.decider.plannings_failed() < 2
                && (Configuration::FollowingOdometric.runs_on(left)
                    || Configuration::FollowingDvz.runs_on(left)),
            at_goal: self.body().at_goal,
        }
    }
}

/// The first place or mailbox in which two players of a system hold different tokens.
fn departs<P, Q, const W: usize, const V: usize, const S: usize, const R: usize>(
    system: &System<'_>,
    one: &Player<P, W, CLOCKS, S, Cause>,
    other: &Player<Q, V, { delivery::SIZE.clocks }, R, Cause>,
) -> Option<String>
where
    P: Program<W, CLOCKS, S>,
    Q: Program<V, { delivery::SIZE.clocks }, R>,
{
    for (it, component) in system.components.iter().zip(0..) {
        for (place, id) in it.net.places.iter().zip(0..) {
            let of = Of { component, id: PlaceId(id) };
            if one.tokens(of) != other.tokens(of) {
                return Some(format!("{}.{}", it.name, place.name));
            }
        }
        for (event, id) in it.net.events.iter().zip(0..) {
            let of = Of { component, id: EventId(id) };
            if one.waiting(&of) != other.waiting(&of) {
                return Some(format!("{}.{}.waiting", it.name, event.name));
            }
        }
    }
    None
}

/// An observation of the supervisors, with its cause.
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
