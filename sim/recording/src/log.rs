//! The run in lines, for a log.

use crate::messages::Weight;
use cotama_sim::run::Outcome;
use cotama_sim::story::{self, What};
use cotama_sim::trace::{Record, Trace};

/// A line.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Line {
    pub(crate) t_us: u64,
    pub(crate) weight: Weight,
    pub(crate) text: String,
}

/// Returns the lines of a run in the order of time: the points of its story, each with what was
/// found, decided and done at its time, plans, activities and the end.
pub(crate) fn lines(trace: &Trace) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut say = |t_us: u64, weight, text: String| lines.push(Line { t_us, weight, text });
    for record in &trace.records {
        let t_us = record.t_us();
        match record {
            Record::Plan(it) => say(t_us, Weight::Info, format!("plan: {}", it.cause)),
            Record::Activity(it) => {
                say(t_us, Weight::Info, format!("activity {}: {}", it.activity, it.choice));
            }
            Record::Request(it) => {
                say(t_us, Weight::Warn, format!("the operator is asked: {}", it.reason));
            }
            Record::Abort(it) => say(t_us, Weight::Error, format!("aborted: {}", it.reason)),
            Record::End(it) => match (it.outcome, it.reason.as_deref()) {
                (Outcome::Completed, _) => say(t_us, Weight::Info, "completed".into()),
                (_, why) => {
                    let why = why.unwrap_or("the mission is not completed");
                    say(t_us, Weight::Error, format!("ended: {why}"));
                }
            },
            _ => {}
        }
    }
    for point in story::points(&trace.records) {
        let number = point.number;
        let weight = match point.what {
            What::Failure(_) => Weight::Warn,
            What::Start(_) | What::Operator(_) => Weight::Info,
        };
        say(point.t_us, weight, format!("point {number}: {}", point.title()));
        let chain = point.chain();
        let found = chain.and_then(|it| it.diagnosis).map(|it| it.t_us);
        let decided = chain.and_then(|it| it.decision).map(|it| it.t_us);
        let acted = chain.and_then(|it| it.reaction.first().copied().or(it.set)).map(|it| it.t_us);
        let parts = [
            ("found", found, point.found()),
            ("decided", decided, point.decided()),
            ("done", acted.or(point.acted_us), point.done()),
        ];
        for (what, at, text) in parts {
            if let Some(text) = text {
                let at = at.unwrap_or(point.t_us);
                say(at, Weight::Info, format!("point {number}, {what}: {text}"));
            }
        }
    }
    lines.sort_by_key(|it| it.t_us);
    lines
}
