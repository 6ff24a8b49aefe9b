//! A round of the supervisors: what they are told, and what comes of it.

use super::World;
use super::records::Recording;
use crate::record::Recorder;
use crate::robots::failing::{mode, moves};
use crate::robots::monitor::Violation;
use crate::robots::operator::View;
use cotama_core::net::TransitionId;
use cotama_core::player::{Firing, Names, Observer, Program};
use cotama_core::system::Of;
use cotama_models::level::Cause;
use cotama_models::robots::{Decision, Global, Mode, Told, Where, fired};

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// The supervisors take a round, and are told one thing.
    pub(super) fn round<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let mut seen = Seen::default();
        self.decider.round(self.now, &mut seen);
        self.run.rounds += 1;
        self.note_all(recording, &mut seen);
        self.follow();
        let (told, cause) = match self.decider.next_untold() {
            Some((told, cause)) => (Some(told), cause),
            None => self.says(),
        };
        if let Some(told) = told {
            self.calm = false;
            if self.decider.tell(self.now, told, cause, &mut seen).0 {
                self.run.told.push((self.run.rounds, told));
                self.record_told(recording, told);
                if let Told::Back(loss) = told {
                    self.regain(loss, recording);
                }
            }
        }
        self.note_all(recording, &mut seen);
        self.follow();
        self.arrive(recording);
        if let Some(monitor) = self.watching.look(self.now, self.decider.level().player())
            && self.run.violated.is_none()
        {
            let fired = self.last.1.clone();
            self.run.violated = Some(Violation { at: self.now, monitor, fired });
        }
    }

    /// Notes all that fired.
    fn note_all<R: Recorder>(&mut self, recording: &mut Recording<'_, R>, seen: &mut Seen) {
        for (id, cause) in std::mem::take(&mut seen.fired) {
            self.calm = false;
            self.note(recording, id, cause);
        }
    }

    /// Returns the word of the mission or the operator, if any.
    fn says(&mut self) -> (Option<Told>, Cause) {
        let stands = self.drive.stands();
        let none = (None, Cause(0));
        match self.global {
            Global::Secures => (stands.then_some(Told::Stopped), Cause(0)),
            Global::Safe | Global::Done => none,
            Global::Waits => (Some(Told::Begins), Cause(0)),
            Global::Does(objective) if self.objective_stands() => {
                let activity = self.planning.activity(self.objective, self.drive.x().0);
                let stood = self.now.0.saturating_sub(self.objective_since.0);
                let is_over = stood >= self.planning.standing(activity).0;
                (is_over.then_some(Told::Over(objective)), Cause(0))
            }
            Global::Does(_) => (self.drive_says(), Cause(0)),
        }
    }

    fn drive_says(&mut self) -> Option<Told> {
        // Nobody looks at the rest while the robot goes on alone.
        let his = mode(self.robot, self.place) == Some(Mode::Operator);
        let asked = self.place == Where::Waits || his;
        let view = View {
            place: self.place,
            x: self.drive.x(),
            lost: if asked { self.robot.lost(self.known) } else { 0 },
            link: asked && self.link(),
            at_goal: self.at_goal() && self.drive.stands(),
        };
        if let Some(word) = self.operator.says(self.robot, self.now, view) {
            return Some(word);
        }
        let Where::Runs { sub_objective, configuration } = self.place else { return None };
        if mode(self.robot, self.place) != Some(Mode::Autonomous) {
            return None;
        }
        let takes = self.robot.configurations.get(configuration).map_or(0, |it| it.takes.0);
        let reached = if moves(self.robot, self.place) {
            view.at_goal
        } else {
            self.now.0 - self.place_since.0 >= takes
        };
        reached.then_some(Told::Reached(sub_objective))
    }

    /// Whether the operator is reached.
    fn link(&self) -> bool {
        let available = self.robot.available(self.failures.broken(self.robot));
        let reached = self.robot.operator.is_some_and(|needs| needs & !available == 0);
        reached && !self.failures.is_unanswered(self.robot)
    }

    /// Follows the global supervisor to its objective.
    fn follow(&mut self) {
        let global = self.level().global();
        if global == self.global {
            return;
        }
        self.global = global;
        self.objective = match global {
            Global::Waits => 0,
            Global::Does(it) => it,
            Global::Done => self.mission.objectives.len(),
            Global::Secures | Global::Safe => self.objective,
        };
        self.objective_since = self.now;
        self.calm = false;
    }

    /// Notes what fired.
    fn note<R: Recorder>(
        &mut self,
        recording: &mut Recording<'_, R>,
        id: Of<TransitionId>,
        cause: Cause,
    ) {
        let system = self.decider.level().player().program().system();
        let Some(fired) = fired(self.robot, &system, id) else { return };
        let (net, asks) = (fired.net, fired.outputs.contains(&"op_request"));
        if net == "faults" || net == "operator" {
            return;
        }
        let name = format!("{net}.{}", fired.transition);
        let (now, conduct) = (self.now, usize::from(cause.0).checked_sub(1));
        let said = fired.outputs.first().copied().unwrap_or("");
        let (restart, sets, tells) = (fired.restarts, fired.sets, fired.tells);
        let decision = match said {
            "global_event" => Some(Decision::Stop),
            "local_event" => Some(Decision::Ask),
            _ if net == "cs" => Some(Decision::Adapt),
            _ => None,
        };
        let ends = net == "gs" && fired.outputs.contains(&"halt");
        self.record_fired(recording, id, cause);
        if self.last.0 != now {
            self.last = (now, Vec::new());
        }
        self.last.1.push(name.clone());
        self.run.fired.insert(name);
        let mut known = None;
        if let Some(it) = conduct.and_then(|it| self.run.conduct.get_mut(it)) {
            match net {
                "cs" => {
                    if let (Some(decision), None) = (decision, it.decided) {
                        it.decided = Some((now, decision));
                    }
                }
                "gom" if tells => known = Some(it.taken_for.clone()),
                "gom" | "permit" => {}
                _ => {
                    it.answered.get_or_insert(now);
                }
            }
        }
        if let (true, Some(decision), Some(at)) = (net == "cs", decision, conduct) {
            self.record_decision(recording, at, decision, id);
        }
        // The loss of a report is known when it was told, not when a module is started anew first.
        for failure in known.into_iter().flatten() {
            self.lose(failure, recording);
        }
        if let Some(module) = restart {
            self.failures.restart(self.robot, module);
            self.restarted |= 1 << module;
        }
        if let Some(report) = sets {
            self.set(report);
        }
        if asks {
            self.run.operator_requests += 1;
            self.record_request(recording, conduct);
        }
        if ends {
            self.run.ended_by = conduct;
        }
    }

    /// A setting answers a report.
    fn set(&mut self, report: usize) {
        let of = self.robot.losses.reports.get(report);
        if let Some((of, setting)) = of.and_then(|it| Some((it, it.sets.as_ref()?))) {
            self.failures.set(&of.failures, setting);
        }
    }

    /// Notes where the supervisors have come to.
    fn arrive<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let place = self.level().place();
        if place == self.place {
            return;
        }
        self.calm = false;
        let before = std::mem::replace(&mut self.place, place);
        if before.is_left_for(place) {
            self.place_since = self.now;
        }
        if place != Where::Rests && !self.first.iter().any(|it| it.0 == place.sub_objective()) {
            self.first.push((place.sub_objective(), self.now));
        }
        let helped = mode(self.robot, before) == Some(Mode::Operator)
            && before.sub_objective() != place.sub_objective();
        if helped {
            self.failures.is_helped(self.robot);
        }
        let runs = self.configuration();
        self.run.configurations.push((self.now, runs));
        self.record_configuration(recording);
    }
}

/// The transitions that fired, with their cause.
#[derive(Debug, Default)]
struct Seen {
    fired: Vec<(Of<TransitionId>, Cause)>,
}

impl<P: Names> Observer<P, Cause> for Seen {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.fired.push((firing.id, firing.carries));
    }
}
