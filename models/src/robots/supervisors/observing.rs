//! The observation module of a robot, and the surroundings that it observes.

use super::draft::{Draft, Line};
use super::nets::lost;
use super::{told, told_as, word};
use crate::robots::Robot;
use cotama_core::net::owned::OwnedNet;

/// The global observation module: from flags to reports, and which losses are known (Durand et
/// al., TAROS 2010, Section V.A). A module that may be started anew is, before anything is told.
pub(super) fn observation(robot: &Robot) -> OwnedNet {
    let doc = "Global observation module: what is known to be lost, and what is told of it.";
    let mut net = Draft::new("observation", doc);
    net.place("Ready", 1, "Diagnoses at once.");
    for (number, it) in robot.losses.losses.iter().enumerate() {
        net.flag(&lost(robot, number), &format!("{} is known to be lost.", it.name));
    }
    for (number, report) in robot.losses.reports.iter().enumerate() {
        let name = word(&report.name);
        let tells = told_as(robot, number);
        net.event(&format!("flag_{name}"), &told(robot, &report.failures));
        net.output(&tells, "");
        let mut line = Line::on(name.clone(), format!("flag_{name}")).goes("Ready", "Ready");
        if let Some(it) = report.restarts {
            let module = robot.modules.get(it.module).map_or("", |it| it.name.as_str());
            let shared = it.shared.and_then(|it| robot.shared.get(it)).map(|it| word(it));
            let doc = match &shared {
                Some(_) => "How often a module may still be started anew.".to_owned(),
                None => format!("How often {module} may still be started anew."),
            };
            let of = shared.unwrap_or_else(|| name.clone());
            let restart = format!("restart_{}", word(module));
            let it = Tried { output: restart, done: "restarts", of, times: it.times, doc };
            line = it.before(line, &mut net, &name);
        }
        if let Some(it) = &report.sets {
            let set = format!("set_{name}");
            line = if let Some(times) = it.times {
                let doc = "How often a setting alone may still be the answer.".to_owned();
                let of = name.clone();
                Tried { output: set, done: "sets", of, times, doc }.before(line, &mut net, &name)
            } else {
                net.output(&set, "");
                line.emits(set)
            };
        }
        let Some(loss) = report.loss else {
            net.line(line.emits(tells));
            continue;
        };
        let flag = lost(robot, loss);
        let again = line.clone().when(&flag, true).emits(tells.clone());
        net.line(line.raises(&flag).emits(tells));
        // Known already, but worse than what told of it, or answered by a setting too.
        let worst = report.autonomous.max(report.operator);
        if worst >= crate::severity::Severity::Hard || report.sets.is_some() {
            net.line(again.named(format!("{name}_again")));
        }
    }
    for (number, it) in robot.losses.losses.iter().enumerate().filter(|it| it.1.returns) {
        let (flag, back) = (lost(robot, number), format!("back_{}", word(&it.name)));
        net.event(&back, &format!("{} works again.", it.name));
        let line = Line::on(back.clone(), back).goes("Ready", "Ready");
        net.line(line.lowers(&flag));
    }
    net.done()
}

/// A reaction that is tried so many times before anything is told.
struct Tried {
    output: String,
    done: &'static str,
    /// The name under which it is counted.
    of: String,
    times: u8,
    doc: String,
}

impl Tried {
    /// Tries it under the conditions of a line; returns the line with the condition that it was
    /// tried as often as it may.
    fn before(self, line: Line, net: &mut Draft, name: &str) -> Line {
        let Self { output, done, of, times, doc } = self;
        let (left, spent) = (format!("{done}_{of}"), format!("{done}_spent_{of}"));
        net.store(&left, &spent, u32::from(times), &doc);
        net.output(&output, "");
        let first = line.clone().named(format!("{name}_{done}"));
        net.line(first.goes(&left, &spent).emits(output));
        line.when_at_least(&spent, u32::from(times))
    }
}

/// The surroundings of the supervisors: whatever can fail does, and what can come back does, at any
/// time, again and again.
pub(super) fn faults(robot: &Robot) -> OwnedNet {
    let mut net = Draft::new("faults", "All failures and returns, at any time.");
    net.place("Ready", 1, "Anything may fail.");
    for it in &robot.losses.reports {
        let name = word(&it.name);
        net.event(&format!("fail_{name}"), &told(robot, &it.failures));
        net.output(&format!("flag_{name}"), "");
        let line = Line::on(format!("fail_{name}"), format!("fail_{name}"));
        net.line(line.goes("Ready", "Ready").emits(format!("flag_{name}")));
    }
    for it in robot.losses.losses.iter().filter(|it| it.returns) {
        let name = word(&it.name);
        let (works, back) = (format!("works_{name}"), format!("back_{name}"));
        net.event(&works, &format!("{} works again.", it.name));
        net.output(&back, "");
        net.line(Line::on(works.clone(), works).goes("Ready", "Ready").emits(back));
    }
    net.done()
}
