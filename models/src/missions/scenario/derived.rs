//! Speeds of alternatives that follow from axes, with the hardware that works.

use super::PlannedActivity;
use crate::missions::axed::ground;
use crate::missions::definition::Definition;
use crate::missions::diagnostic::Diagnostic;
use crate::missions::tables::Alternative;
use cotama_axes::{Candidate, DetectBy, Lifted, Reason, Steps, Stop, Table};
use cotama_core::hardware::Equipment;
use cotama_core::units::{MillimetresPerSecond, Milliwatts};

/// A mission's axes with the candidates of all its activities.
#[derive(Debug)]
pub(in crate::missions) struct Derived {
    pub(in crate::missions) mission: cotama_axes::Mission,
    table: Table,
}

impl Derived {
    /// Derives the speeds of a mission with axes from the hardware that works; `None` for one
    /// without axes.
    pub(in crate::missions) fn of(
        definition: &Definition,
        available: Equipment,
    ) -> Result<Option<Self>, Diagnostic> {
        let Some(case) = &definition.axes else { return Ok(None) };
        let own = &case.mission;
        let mission = cotama_axes::Mission {
            laptop: own.laptop.clone(),
            detect_by: own.detect_by,
            axes: own.axes.clone(),
            indicators: own.indicators.clone(),
            constraints: own.constraints.clone(),
            ..ground(definition, available)
        };
        match Table::new(&mission, Lifted::default(), &mut Steps::default()) {
            Ok(table) => Ok(Some(Self { mission, table })),
            Err(Stop::Wrong(it)) => {
                let message = format!("line {}, column {}: {}", it.line, it.column, it.message);
                Err(Diagnostic { help: it.help, ..Diagnostic::new(0..0, message, "") })
            }
            Err(Stop::Limit) => {
                let message = "the speeds of this mission take too many steps to derive";
                let it = Diagnostic::new(0..0, message, "");
                Err(it.help("use fewer zones or options, or a larger `speed_step_mm_s`"))
            }
        }
    }

    /// Returns the candidate of an activity, by its number, with these options.
    ///
    /// # Errors
    /// All that axes say against it.
    pub(in crate::missions) fn candidate(
        &self,
        activity: usize,
        options: &[usize],
    ) -> Result<&Candidate, String> {
        let activity = self.table.activities.get(activity);
        let found = activity.and_then(|it| it.candidates.iter().find(|it| it.options == options));
        if let Some(found) = found {
            return Ok(found);
        }
        let dropped = activity.and_then(|it| it.dropped.iter().find(|it| it.options == options));
        let by = dropped.into_iter().flat_map(|it| &it.by).map(|it| self.reason(*it));
        Err(by.collect::<Vec<_>>().join("; "))
    }

    fn reason(&self, reason: Reason) -> String {
        let name = reason.name(&self.mission);
        match reason {
            Reason::RequiredTio(_) | Reason::RequiredHardware(_) => format!("`{name}` is not met"),
            Reason::Blind => "no detector of the moving option sees here".to_owned(),
            Reason::NoDetector => "no detector sees here".to_owned(),
            Reason::Core(_) => format!("the constraint `{name}` holds at no speed"),
        }
    }
}

/// Alternatives of all activities with the speeds that axes allow when only some hardware works, in
/// the order of the scenario's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slowed {
    /// By activity; one that axes exclude needs all hardware of the robot.
    pub alternatives: Vec<Vec<Alternative>>,
    /// The values of their indicators.
    pub derived: Vec<Vec<Candidate>>,
}

/// Returns the alternatives as some hardware slows them down; `None` where speeds do not follow
/// from the hardware of others.
pub(in crate::missions) fn slowed(
    definition: &Definition,
    activities: &[PlannedActivity],
    available: Equipment,
) -> Option<Slowed> {
    let case = definition.axes.as_ref()?;
    if case.mission.detect_by != DetectBy::Zone {
        return None;
    }
    let derived = Derived::of(definition, available).ok().flatten();
    let mut all = Slowed { alternatives: Vec::new(), derived: Vec::new() };
    for (place, activity) in activities.iter().enumerate() {
        let rows = activity.alternatives.iter().zip(&activity.derived);
        let again = |(it, before): (&Alternative, &Candidate)| {
            let now = derived.as_ref().and_then(|all| all.candidate(place, &before.options).ok());
            if let Some(now) = now {
                (with_speed(definition, *it, now), now.clone())
            } else {
                let needs = it.needs.union(definition.available());
                (Alternative { needs, ..*it }, before.clone())
            }
        };
        let (alternatives, derived) = rows.map(again).unzip();
        all.alternatives.push(alternatives);
        all.derived.push(derived);
    }
    Some(all)
}

/// Returns an alternative at the speed of a candidate.
fn with_speed(definition: &Definition, it: Alternative, now: &Candidate) -> Alternative {
    let speed = MillimetresPerSecond(now.speed_mm_s.unsigned_abs());
    if it.speed == MillimetresPerSecond::ZERO || it.speed == speed {
        return it;
    }
    let motion = definition.motion_power;
    let others = it.power.0.saturating_sub(motion.at(it.speed).0);
    Alternative { speed, power: Milliwatts(others.saturating_add(motion.at(speed).0)), ..it }
}
