//! Command lines for the hints: what was typed, with something changed.

use crate::answers::{Outcome, PlanAnswer, Reason, Relaxation, RunBody, Status};
use crate::args::{Lost, Objective, PlanArgs, Planning, ReplayArgs, RunArgs, STEPS};
use crate::names::quoted;
use clap::ValueEnum;

/// The options of a command about a mission, as far as they are not the usual ones.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    mission: String,
    options: Vec<(&'static str, Option<String>)>,
}

impl Words {
    /// As `cotama plan` was called.
    pub(crate) fn of_plan(args: &PlanArgs) -> Self {
        let objective = args.objective.map(|it| it.name().to_owned());
        Self::new(&args.mission.mission, objective, &args.planning)
    }

    /// As `cotama run` was called; where its trace goes is left out.
    pub(crate) fn of_run(args: &RunArgs) -> Self {
        let objective = args.objective.map(|it| it.name().to_owned());
        let mut words = Self::new(&args.mission.mission, objective, &args.planning);
        let options = &mut words.options;
        let mut add = |name, value: Option<String>| {
            options.extend(value.map(|it| (name, Some(it))));
        };
        add("--seed", args.seed.map(|it| it.to_string()));
        add("--faults", Some(args.faults.clone()).filter(|it| it != "script"));
        add("--monitor-period", args.monitor_period.map(|it| it.to_string()));
        let fidelity = args.fidelity.to_possible_value().map(|it| it.get_name().to_owned());
        add("--fidelity", fidelity.filter(|it| it != "line"));
        add("--measured", args.measured.clone());
        add("--margins", args.margins.clone());
        add("--report", args.report.as_ref().map(|it| it.display().to_string()));
        options.extend(args.upward.then_some(("--upward", None)));
        let people = Some(args.people).filter(|it| *it > 0).map(|it| it.to_string());
        options.extend(people.map(|it| ("--people", Some(it))));
        let robot = args.planning.supervised.as_ref();
        let robot = robot.map(|it| ("--supervised", Some(it.clone()).filter(|it| !it.is_empty())));
        options.extend(robot);
        options.extend(args.no_report.then_some(("--no-report", None)));
        words
    }

    fn new(mission: &str, objective: Option<String>, planning: &Planning) -> Self {
        let mut options = Vec::new();
        let mut add = |name, value: Option<String>| {
            options.extend(value.map(|it| (name, Some(it))));
        };
        add("--objective", objective);
        let allocator = planning.allocator.and_then(|it| it.to_possible_value());
        add("--allocator", allocator.map(|it| it.get_name().to_owned()));
        add("--steps", Some(planning.steps).filter(|&it| it != STEPS).map(|it| it.to_string()));
        for Lost { kind, units } in &planning.lost {
            let lost = units.map_or_else(|| kind.clone(), |units| format!("{kind}:{units}"));
            add("--lost", Some(lost));
        }
        add("--duration-limit", planning.duration_limit.map(|it| it.to_string()));
        add("--energy-limit", planning.energy_limit.map(|it| it.to_string()));
        Self { mission: mission.to_owned(), options }
    }

    fn has(&self, name: &str) -> bool {
        self.options.iter().any(|it| it.0 == name)
    }

    fn without(mut self, name: &str) -> Self {
        self.options.retain(|it| it.0 != name);
        self
    }

    fn with(self, name: &'static str, value: impl Into<String>) -> Self {
        let mut words = self;
        let value = Some(value.into());
        match words.options.iter_mut().find(|it| it.0 == name) {
            Some(found) => found.1 = value,
            None => words.options.push((name, value)),
        }
        words
    }

    /// The command; none for a mission from standard input, which is gone.
    fn line(&self, command: &str) -> Option<String> {
        if self.mission == "-" {
            return None;
        }
        let mut line = format!("cotama {command} {}", quoted(&self.mission));
        for (name, value) in &self.options {
            line += " ";
            line += name;
            if let Some(value) = value {
                line += " ";
                line += &quoted(value);
            }
        }
        Some(line)
    }

    /// With limits that allow a plan, if that is one of the ways out.
    fn raised(self, reason: Option<&Reason>) -> Option<Self> {
        let relaxations = reason.map_or(&[][..], |it| &it.relaxations);
        let (duration, energy) = relaxations.iter().find_map(Relaxation::raised)?;
        let words = match duration {
            Some(limit) => self.with("--duration-limit", limit.to_string()),
            None => self,
        };
        Some(match energy {
            Some(limit) => words.with("--energy-limit", limit.to_string()),
            None => words,
        })
    }

    /// With twenty times as many steps.
    fn longer(self, steps: u64) -> Self {
        self.with("--steps", steps.saturating_mul(20).to_string())
    }

    /// Returns the next step after a plan.
    pub(crate) fn after_plan(
        self,
        answer: &PlanAnswer,
        steps: u64,
        supervised: bool,
    ) -> Option<String> {
        let reason = answer.reason.as_ref();
        match (answer.status, answer.objective) {
            // Neither a limit nor an activity is the cause: the rule missed the plan.
            (Status::Infeasible, _)
                if reason.is_some_and(|it| it.axis.is_none() && it.activity.is_none()) =>
            {
                self.with("--allocator", "exact").line("plan")
            }
            (Status::Infeasible, _) => self.raised(reason)?.line("plan"),
            (Status::Unknown, "front") => self.with("--objective", "quality").line("plan"),
            (Status::Unknown, "paper") => {
                self.with("--allocator", "exact").longer(steps).line("plan")
            }
            (Status::Unknown, _) => self.longer(steps).line("plan"),
            // Supervisors are told of a loss; it is not there from the start.
            _ if supervised && self.has("--lost") => None,
            (_, "front") => self.without("--objective").line("run"),
            _ => self.line("run"),
        }
    }
}

/// Returns what to do after a run, of which no trace was written: one that `helps`, which is
/// tried: it is completed, or comes further where this one never left. `objective` is what its
/// plans were chosen for.
pub(crate) fn after_run(
    args: &RunArgs,
    body: &RunBody,
    objective: &str,
    helps: impl Fn(&RunArgs) -> bool,
) -> Option<String> {
    if body.outcome == Outcome::Completed {
        let line = Words::of_run(args).line("run")?;
        return Some(format!("{line} --trace run.jsonl && cotama replay run.jsonl"));
    }
    if args.mission.mission == "-" {
        return None;
    }
    let changed = |change: &dyn Fn(&mut RunArgs)| {
        let mut args = args.clone();
        change(&mut args);
        args
    };
    let mut tries = Vec::new();
    let relaxations = body.infeasible.as_ref().map_or(&[][..], |it| &it.relaxations);
    if let Some((duration, energy)) = relaxations.iter().find_map(Relaxation::raised) {
        tries.push(changed(&|it| {
            it.planning.duration_limit = duration.or(it.planning.duration_limit);
            it.planning.energy_limit = energy.or(it.planning.energy_limit);
        }));
    } else if body.infeasible.is_none() && body.supervised.is_none() && objective != "min-energy" {
        // With less used from the start, more is left when something goes wrong.
        tries.push(changed(&|it| {
            it.planning.allocator = None;
            it.objective = Some(Objective::MinEnergy);
        }));
    }
    if args.faults != "none" && body.infeasible.is_none() {
        tries.push(changed(&|it| "none".clone_into(&mut it.faults)));
    }
    let found = tries.into_iter().find(helps)?;
    Words::of_run(&found).line("run")
}

/// Returns the next step after a run was made again.
pub(crate) fn after_replay(args: &ReplayArgs) -> Option<String> {
    if args.report.is_some() || args.file == "-" {
        return None;
    }
    let mission = args.mission.as_ref().map(|it| format!(" --mission {}", quoted(it)));
    let seed = args.seed.map(|it| format!(" --seed {it}"));
    Some(format!(
        "cotama replay {}{}{} --report replayed",
        quoted(&args.file),
        mission.unwrap_or_default(),
        seed.unwrap_or_default()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_option_stands_beside_the_typed_ones() {
        let words =
            Words { mission: "m".to_owned(), options: vec![("--seed", Some("1".to_owned()))] };
        let line = words.with("--steps", "9").with("--seed", "2").line("run");
        assert_eq!(line.as_deref(), Some("cotama run m --seed 2 --steps 9"));
    }
}
