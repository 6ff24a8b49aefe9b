//! Older mission files as files of the third format.

use super::definition::AXES;
use super::mission::Mission;
use super::scenario::{PlannedActivity, Scenario};
use super::under::FORMAT_3;
use std::fmt::Write;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Why a mission file is not written anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotUpgraded {
    /// Its format is the third one.
    AlreadyDone,
    /// Its limits are written in a form that is not changed here, as beside other keys of a line.
    Written,
}

impl std::fmt::Display for NotUpgraded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::AlreadyDone => write!(f, "its format is `{FORMAT_3}` already"),
            Self::Written => write!(f, "its limits are not a table of their own, `[limits]`"),
        }
    }
}

impl std::error::Error for NotUpgraded {}

impl Mission {
    /// Returns the text of the mission in [`FORMAT_3`]: limits become constraints on the sums of
    /// duration and energy, and all else stays as it is written, comments too. Activities,
    /// alternatives and limits are the same.
    ///
    /// # Errors
    /// A [`NotUpgraded`].
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let text = mission.upgraded().unwrap();
    /// assert!(text.contains("goal = 8640000  # paper: 2.4 Wh = 8640 J"));
    /// let again = Mission::parse("patrol.toml", &text).unwrap();
    /// assert_eq!(again.limits, mission.limits);
    /// assert_eq!(again.scenario().combinations(), mission.scenario().combinations());
    /// ```
    pub fn upgraded(&self) -> Result<String, NotUpgraded> {
        if self.axes.is_some() {
            return Err(NotUpgraded::AlreadyDone);
        }
        let text = self.text();
        let file = DeTable::parse(text).map_err(|_| NotUpgraded::Written)?;
        let format = file.get_ref().get("format").ok_or(NotUpgraded::Written)?.span();
        let limits = file.get_ref().get("limits").ok_or(NotUpgraded::Written)?;
        let DeValue::Table(table) = limits.get_ref() else { return Err(NotUpgraded::Written) };
        let (section, inner) = section(text).ok_or(NotUpgraded::Written)?;
        let comments = ["duration_ms", "energy_mj"]
            .map(|key| table.get(key).map_or("", |it| comment(text, it.span().end)));
        let mut changed = text.to_owned();
        let axes = inner + &axes(self, comments);
        let format_3 = format!("\"{FORMAT_3}\"");
        // The later one first, so that the place of the other stays right.
        let mut edits = [(format, format_3), (section, axes)];
        edits.sort_by_key(|it| std::cmp::Reverse(it.0.start));
        for (span, new) in edits {
            changed.replace_range(span, &new);
        }
        let again =
            Self::parse_on(self.source(), &changed, self.robot().cloned(), self.way.as_ref());
        match again {
            Ok(it) if is_same(it.scenario(), self.scenario()) => Ok(changed),
            _ => Err(NotUpgraded::Written),
        }
    }
}

/// Whether two scenarios have the same activities, alternatives and limits.
fn is_same(one: &Scenario, other: &Scenario) -> bool {
    let activities = |of: &Scenario| -> Vec<PlannedActivity> {
        let plain = |it: &PlannedActivity| PlannedActivity { derived: Vec::new(), ..it.clone() };
        of.activities.iter().map(plain).collect()
    };
    let rest = |of: &Scenario| (of.limits, of.order, of.available);
    rest(one) == rest(other) && activities(one) == activities(other)
}

/// Returns the lines of `[limits]`, without comments and empty lines at its end, and the comments
/// among them.
fn section(text: &str) -> Option<(Range<usize>, String)> {
    let mut at = 0;
    let (mut start, mut end) = (None, 0);
    let (mut comments, mut kept) = (String::new(), 0);
    for line in text.split_inclusive('\n') {
        let head = line.trim_start();
        match (start, head.starts_with("[limits]")) {
            (None, true) => (start, end) = (Some(at), at + line.len()),
            (Some(_), _) if head.starts_with('[') => break,
            (Some(_), _) if head.starts_with('#') => comments += line,
            (Some(_), _) if !head.is_empty() => (end, kept) = (at + line.len(), comments.len()),
            _ => {}
        }
        at += line.len();
    }
    comments.truncate(kept);
    start.map(|start| (start..end, comments))
}

/// Returns the comment behind a value, with its sign.
fn comment(text: &str, end: usize) -> &str {
    let rest = text.get(end..).and_then(|it| it.lines().next()).unwrap_or("").trim();
    if rest.starts_with('#') { rest } else { "" }
}

/// Writes the axes and the constraints of a mission.
fn axes(mission: &Mission, comments: [&str; 2]) -> String {
    let stands = mission.tios.iter().any(|it| it.standing.is_some());
    let sums = [
        (
            "ms",
            "travel = { form = \"length_over_speed\" }",
            "stand = { form = \"sum\", of = [\"option(stand_ms)\"] }",
        ),
        (
            "mJ",
            "travel = { form = \"power_times_time\", power = [\"motion_mw\", \
             \"hardware(power_mw)\"] }",
            "stand = { form = \"power_times_time\", power = [\"option(stand_mw)\", \
             \"hardware(power_mw)\"] }",
        ),
    ];
    let mut text = String::new();
    for (axis, (unit, travel, stand)) in AXES.into_iter().zip(sums) {
        let _ = write!(
            text,
            "[[axis]]\nid = \"{axis}\"\n[[axis.indicator]]\nid = \"total\"\nunit = \"{unit}\"\n\
             combine = \"sum\"\n{travel}\n"
        );
        if stands {
            let _ = writeln!(text, "{stand}");
        }
    }
    for &axis in &mission.order {
        let (name, goal) = (AXES[axis], mission.limits[axis]);
        let comment = if comments[axis].is_empty() { "" } else { &format!("  {}", comments[axis]) };
        let _ = write!(
            text,
            "[[constraint]]\nid = \"{name}\"\nindicator = \"{name}.total\"\nkind = \"end\"\n\
             op = \"<=\"\ngoal = {goal}{comment}\n"
        );
    }
    text
}
