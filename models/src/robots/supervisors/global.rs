//! The global supervisor of a robot: its mission, objective after objective, or security (Durand et
//! al., TAROS 2010, Section V.C.1).

use super::draft::{Draft, Line};
use super::word;
use cotama_core::net::owned::OwnedNet;

/// An objective of a mission, for its global supervisor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Name of the objective.
    pub name: String,
    /// The event that ends it where the robot stands for it; `None` for a drive.
    pub ends: Option<String>,
}

/// The place before the objectives.
const WAIT: &str = "Wait";
/// The place behind them.
const DONE: &str = "Done";
/// The place of stopping for good.
const SECURITY: &str = "Security";
/// The place of having stopped for good.
const SAFE: &str = "Safe";
/// The names that no objective may have.
pub const RESERVED: [&str; 4] = [WAIT, DONE, SECURITY, SAFE];
/// The most objectives of one supervisor.
pub const MAX_STEPS: usize = 250;

impl Step {
    /// Returns the place that is marked while it is under way.
    pub fn place(&self) -> String {
        word(&self.name)
    }

    /// Whether the robot drives.
    pub const fn drives(&self) -> bool {
        self.ends.is_none()
    }
}

/// Makes the global supervisor of these objectives: a place each, one after the other, and from
/// each to security. Without objectives one drive follows another, whenever one is wanted.
pub(crate) fn global(steps: &[Step]) -> OwnedNet {
    let doc = match steps {
        [] => "Global supervisor: one drive after another, or security.",
        _ => "Global supervisor of a mission: which objective is under way, or security.",
    };
    let mut net = Draft::new("global", doc);
    net.place(WAIT, 1, if steps.is_empty() { "No drive." } else { "No mission yet." });
    if steps.is_empty() {
        net.place("Drive", 0, "A drive is under way.");
    }
    for it in steps {
        let doc = if it.drives() { "The robot drives." } else { "The robot stands for a task." };
        net.place(&it.place(), 0, doc);
    }
    if !steps.is_empty() {
        net.place(DONE, 0, "The mission is accomplished.");
    }
    net.place(SECURITY, 0, "Stopping for good.");
    net.place(SAFE, 0, "Stopped for good, alarm given.");
    net.event("global_event", "The objective cannot be managed, or something vital is lost.");
    net.event("no_way", "No configuration is left, and nobody can be asked.");
    net.event("drive_done", "The drive has reached its goal.");
    let begin = if steps.is_empty() { "A drive is wanted." } else { "The mission begins." };
    net.event(begins(steps), begin);
    net.event("stopped", "The robot stands.");
    let mut ends: Vec<_> = steps.iter().filter_map(|it| it.ends.as_deref()).collect();
    ends.sort_unstable();
    ends.dedup();
    ends.iter().for_each(|it| net.event(it, "The task for which the robot stands is done."));
    for it in ["start_drive", "gs_abort", "halt", "alarm"] {
        net.output(it, "");
    }

    let mut from = vec![WAIT.to_owned()];
    if steps.is_empty() {
        let start = Line::on("start", begins(steps)).goes(WAIT, "Drive");
        net.line(start.emits("start_drive"));
        net.line(Line::on("done", "drive_done").goes("Drive", WAIT));
        from.push("Drive".to_owned());
    }
    let mut on = begins(steps).to_owned();
    for (number, step) in steps.iter().enumerate() {
        let line = Line::on(format!("g{}", number + 1), &on);
        let line = line.goes(from.last().map_or(WAIT, String::as_str), &step.place());
        net.line(if step.drives() { line.emits("start_drive") } else { line });
        on = step.ends.clone().unwrap_or_else(|| "drive_done".to_owned());
        from.push(step.place());
    }
    if !steps.is_empty() {
        let line = Line::on(format!("g{}", steps.len() + 1), on);
        net.line(line.goes(from.last().map_or(WAIT, String::as_str), DONE));
        from.push(DONE.to_owned());
    }
    for from in &from {
        for (on, name) in [("global_event", "abort"), ("no_way", "give_up")] {
            let line = Line::on(format!("{name}_{from}"), on).goes(from, SECURITY);
            net.line(line.emits("gs_abort").emits("halt"));
        }
    }
    net.line(Line::on("secured", "stopped").goes(SECURITY, SAFE).emits("alarm"));
    net.done()
}

/// Returns the event with which a mission begins, or a drive of a robot without one.
pub(in crate::robots) const fn begins(steps: &[Step]) -> &'static str {
    if steps.is_empty() { "drive_wanted" } else { "mission_received" }
}
