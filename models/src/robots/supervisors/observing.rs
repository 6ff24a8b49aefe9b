//! The observation module of a robot, and the surroundings that it observes.

use super::draft::{Draft, Line};
use super::nets::lost;
use super::{told, told_as, word};
use crate::robots::{Report, Robot, Try};
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
        let flag = report.loss.map(|it| lost(robot, it));
        let mask = report.masks.as_ref().map(|it| (format!("mask_{name}"), it.on_order));
        if let Some((mask, _)) = &mask {
            net.output(mask, "");
        }
        for it in &report.tries {
            line = tried(robot, report, *it).before(line, &mut net, &name, |asks| {
                // The operator may order a mask when he is asked.
                let order = mask.as_ref().filter(|it| it.1).map(|it| it.0.clone());
                let asks = order.into_iter().fold(asks, Line::emits);
                known(asks, flag.as_deref())
            });
        }
        if report.sets.as_ref().is_some_and(|it| it.times.is_none()) {
            let set = format!("set_{name}");
            net.output(&set, "");
            line = line.emits(set);
        }
        line = mask.into_iter().fold(line, |line, it| line.emits(it.0));
        // Known already, but worse than what told of it, or answered by more than that.
        let worst = report.autonomous.max(report.operator);
        let more = report.sets.is_some() || report.asks.is_some() || report.masks.is_some();
        let again = worst >= crate::severity::Severity::Hard || more;
        let lines = known(line.emits(tells), flag.as_deref());
        lines.into_iter().take(if again { 2 } else { 1 }).for_each(|it| net.line(it));
    }
    for (number, it) in robot.losses.losses.iter().enumerate().filter(|it| it.1.returns) {
        let (flag, back) = (lost(robot, number), format!("back_{}", word(&it.name)));
        net.event(&back, &format!("{} works again.", it.name));
        let line = Line::on(back.clone(), back).goes("Ready", "Ready");
        net.line(line.lowers(&flag));
    }
    net.done()
}

/// A line that makes a loss known, and the same where it is known already; of none, the line.
fn known(line: Line, flag: Option<&str>) -> Vec<Line> {
    let Some(flag) = flag else { return vec![line] };
    let again = format!("{}_again", line.name());
    vec![line.clone().raises(flag), line.when(flag, true).named(again)]
}

/// A reaction that is tried so many times before anything is decided.
struct Tried {
    output: String,
    done: &'static str,
    /// The name under which it is counted.
    of: String,
    times: u8,
    doc: String,
}

/// A step of the reaction to a report.
fn tried(robot: &Robot, report: &Report, it: Try) -> Tried {
    let name = word(&report.name);
    match it {
        Try::Restart => {
            let it = report.restarts;
            let module = it.and_then(|it| robot.modules.get(it.module));
            let module = module.map_or("", |it| it.name.as_str());
            let shared = it.and_then(|it| it.shared).and_then(|it| robot.shared.get(it));
            let doc = match shared {
                Some(_) => "How often a module may still be started anew.".to_owned(),
                None => format!("How often {module} may still be started anew."),
            };
            Tried {
                output: format!("restart_{}", word(module)),
                done: "restarts",
                of: shared.map_or(name, |it| word(it)),
                times: it.map_or(0, |it| it.times),
                doc,
            }
        }
        Try::Set => Tried {
            output: format!("set_{name}"),
            done: "sets",
            of: name,
            times: report.sets.as_ref().and_then(|it| it.times).unwrap_or(0),
            doc: "How often a setting alone may still be the answer.".to_owned(),
        },
        Try::Ask => Tried {
            output: format!("ask_{name}"),
            done: "asks",
            of: name,
            times: report.asks.unwrap_or(0),
            doc: "How often the operator may still be asked first.".to_owned(),
        },
    }
}

/// Returns the condition under which a report asks the operator first: what comes before is spent,
/// and he may be asked once more.
pub(in crate::robots) fn asks_now(robot: &Robot, report: usize) -> String {
    let Some(report) = robot.losses.reports.get(report) else { return String::new() };
    let before = report.tries.iter().take_while(|it| **it != Try::Ask);
    let before = before.map(|it| tried(robot, report, *it));
    let spent = before.map(|it| format!("gom.{}_spent_{} >= {}", it.done, it.of, it.times));
    let asks = format!("gom.asks_{} >= 1", word(&report.name));
    spent.chain([asks]).collect::<Vec<_>>().join(" & ")
}

impl Tried {
    /// Tries it under the conditions of a line; returns the line with the condition that it was
    /// tried as often as it may. `asks` makes known what is lost when the operator is asked.
    fn before(
        self,
        line: Line,
        net: &mut Draft,
        name: &str,
        asks: impl Fn(Line) -> Vec<Line>,
    ) -> Line {
        let Self { output, done, of, times, doc } = self;
        let (left, spent) = (format!("{done}_{of}"), format!("{done}_spent_{of}"));
        net.store(&left, &spent, u32::from(times), &doc);
        net.output(&output, "");
        let first = line.clone().named(format!("{name}_{done}"));
        let first = first.goes(&left, &spent).emits(output);
        let lines = if done == "asks" { asks(first) } else { vec![first] };
        lines.into_iter().for_each(|it| net.line(it));
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
