//! From a mission to its activities and their implementation alternatives.
//!
//! Lambert et al., J. Intell. Robot. Syst. 110, 2024: objectives that travel are cut at the borders
//! of the zones, so that the constraints are the same all along an activity; its alternatives are
//! the product of the options of its tasks, without those that a constraint excludes.

use super::definition::{Definition, Objective, Zone};
use super::diagnostic::Diagnostic;
use super::tables::{Activity, Alternative};
use cotama_core::hardware::Equipment;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Milliwatts};

mod derived;
pub(super) mod ends;
mod excluding;

pub use derived::Slowed;
pub(super) use derived::{Derived, slowed};
pub use ends::{End, Grows};
use excluding::{demand, emptied, excluding, too_expensive};

/// The most activities of a mission.
pub const MAX_ACTIVITIES: usize = 10_000;
/// The most alternatives of an activity, before constraints.
pub const MAX_ALTERNATIVES: usize = 1000;
/// The most alternatives of a mission, before constraints.
pub const MAX_ALTERNATIVES_TOTAL: usize = 200_000;

/// A constraint of a zone that excludes alternatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Constraint {
    /// The moving option must use a hardware.
    Hardware,
    /// A given option must be used.
    Tio,
}

/// A combination of options that constraints excluded.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let glass = &mission.scenario().activities[1];
/// assert_eq!((glass.alternatives.len(), glass.unconstrained()), (12, 21));
/// let reason = "zone `glass-out` requires the moving option to use 1 of `sonar`";
/// assert_eq!(glass.dropped[0].reason, reason);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// The ids of its options, as in [`PlannedActivity::labels`].
    pub label: String,
    /// Every constraint that excludes it, with the index of its zone; none where axes do.
    pub by: Vec<(usize, Constraint)>,
    /// The same for people.
    pub reason: String,
}

/// An activity and its alternatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedActivity {
    /// Id of the activity: `A1` and so on, in sequence.
    pub id: String,
    /// The index of the objective that it is a part of.
    pub objective: usize,
    /// Start on the path.
    pub x_start: Millimetres,
    /// End on the path; the same place when the activity does not travel.
    pub x_end: Millimetres,
    /// The lowest limit of robot, harmless impact and zones; zero when it does not travel.
    pub speed_max: MillimetresPerSecond,
    /// The alternatives: at least one.
    pub alternatives: Vec<Alternative>,
    /// For each alternative the ids of its options, in the order of the objective's tasks: `M5 L2`.
    pub labels: Vec<String>,
    /// The alternatives that the constraints excluded.
    pub dropped: Vec<Dropped>,
    /// For each alternative of a mission with axes the values of all indicators.
    pub derived: Vec<cotama_axes::Candidate>,
}

impl PlannedActivity {
    /// The activity as a borrowed table.
    pub fn table(&self) -> Activity<'_> {
        Activity { x_start: self.x_start, x_end: self.x_end, alternatives: &self.alternatives }
    }

    /// How many alternatives there were before constraints.
    pub fn unconstrained(&self) -> usize {
        self.alternatives.len() + self.dropped.len()
    }
}

/// The input of an allocator: activities in sequence, with their alternatives, and limits.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let scenario = mission.scenario();
/// let first = &scenario.activities[0];
/// assert_eq!((first.id.as_str(), first.x_end.0, first.alternatives.len()), ("A1", 31_000, 21));
/// assert_eq!(scenario.activities().len(), 17);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scenario {
    /// The activities, in sequence; at least one.
    pub activities: Vec<PlannedActivity>,
    /// The inclusive limit on each axis, in ms and mJ.
    pub limits: [u64; 2],
    /// The axes in their order of treatment.
    pub order: [usize; 2],
    /// All the hardware of the robot.
    pub available: Equipment,
    /// The end constraints of a mission with axes.
    pub ends: Vec<End>,
}

impl Scenario {
    /// The activities as borrowed tables, for [`remaining`](crate::missions::tables::remaining).
    pub fn activities(&self) -> Vec<Activity<'_>> {
        self.activities.iter().map(PlannedActivity::table).collect()
    }

    /// All the hardware of the robot.
    pub fn available(&self) -> Equipment {
        self.available
    }

    /// How many plans there are, feasible or not; `None` when the number passes 128 bits.
    pub fn combinations(&self) -> Option<u128> {
        let mut counts = self.activities.iter().map(|activity| activity.alternatives.len() as u128);
        counts.try_fold(1u128, u128::checked_mul)
    }

    /// The scenario of a definition, or what makes it impossible: nothing, for one that was a
    /// scenario before a constraint or an objective was taken away.
    pub(crate) fn generate(definition: &Definition) -> Result<Self, Vec<Diagnostic>> {
        let parts = cut(definition)?;
        let derived = Derived::of(definition, definition.available()).map_err(|it| vec![it])?;
        let mut activities = Vec::with_capacity(parts.len());
        let mut errors = Vec::new();
        let mut combinations = Vec::new();
        let mut total = 0;
        let mut combined = None;
        let mut too_expensive = None;
        for (place, part) in parts.iter().enumerate() {
            if combined != Some(part.objective) {
                combinations = combine(definition, part.task_objective)?;
                combined = Some(part.objective);
            }
            total += combinations.len();
            if total > MAX_ALTERNATIVES_TOTAL {
                let message =
                    format!("the mission has more than {MAX_ALTERNATIVES_TOTAL} alternatives");
                let help = "use fewer options or fewer zones";
                let span = part.task_objective.span.clone();
                return Err(vec![Diagnostic::new(span, message, "up to here").help(help)]);
            }
            match plan(definition, (place, part), &combinations, derived.as_ref()) {
                Ok(activity) => activities.push(activity),
                // One combination of an objective says it all.
                Err(Impossible::TooExpensive(_)) if too_expensive == Some(part.objective) => {}
                Err(Impossible::TooExpensive(error)) => {
                    too_expensive = Some(part.objective);
                    errors.push(error);
                }
                Err(Impossible::Empty(error)) => errors.push(error),
            }
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        let Definition { limits, order, .. } = *definition;
        let available = definition.available();
        let Some(derived) = derived else {
            return Ok(Self { activities, limits, order, available, ends: Vec::new() });
        };
        let ends = ends::of(&derived.mission, &activities)?;
        if !definition.plans_by_wishes() && ends::are_further(&ends) {
            let message = "`ask` is missing: nothing says what plans are chosen for";
            let help = "name wishes, the first counts most: ask = [[\"min\", \"energy.total\"]]";
            return Err(vec![Diagnostic::new(0..0, message, "").help(help)]);
        }
        let (limits, order) = ends::limits(&ends);
        Ok(Self { activities, limits, order, available, ends })
    }
}

/// A part of an objective in which no zone begins or ends.
struct Part<'d> {
    objective: usize,
    task_objective: &'d Objective,
    x_start: Millimetres,
    x_end: Millimetres,
}

/// Cuts objectives that travel at the borders of zones strictly inside them.
fn cut(definition: &Definition) -> Result<Vec<Part<'_>>, Vec<Diagnostic>> {
    let mut borders: Vec<Millimetres> =
        definition.zones.iter().flat_map(|zone| [zone.x_start, zone.x_end]).collect();
    borders.sort_unstable();
    borders.dedup();
    let mut parts = Vec::new();
    for (objective, it) in definition.objectives.iter().enumerate() {
        let inside =
            borders.iter().copied().filter(|&border| it.x_start < border && border < it.x_end);
        let mut x_start = it.x_start;
        for x_end in inside.chain([it.x_end]) {
            parts.push(Part { objective, task_objective: it, x_start, x_end });
            x_start = x_end;
        }
        if parts.len() > MAX_ACTIVITIES {
            let message = format!("the mission has more than {MAX_ACTIVITIES} activities");
            let help = "use fewer objectives or fewer zones";
            return Err(vec![Diagnostic::new(it.span.clone(), message, "up to here").help(help)]);
        }
    }
    Ok(parts)
}

/// Options for the tasks of an objective, one each, and what they come to.
struct Combination {
    tios: Vec<usize>,
    label: String,
    needs: Equipment,
    speed_max: Option<MillimetresPerSecond>,
    /// The option of the task that leads.
    lead: usize,
}

/// All combinations of an objective's options, in the order of the file, the first task outermost.
fn combine(
    definition: &Definition,
    objective: &Objective,
) -> Result<Vec<Combination>, Vec<Diagnostic>> {
    let empty = Combination {
        tios: Vec::new(),
        label: String::new(),
        needs: Equipment::NONE,
        speed_max: None,
        lead: usize::MAX,
    };
    let mut combinations = vec![empty];
    for &task in &objective.tasks {
        let options: Vec<_> =
            definition.tios.iter().enumerate().filter(|(_, tio)| tio.task == task).collect();
        if combinations.len() * options.len() > MAX_ALTERNATIVES {
            let message = format!(
                "the objective `{}` has more than {MAX_ALTERNATIVES} combinations of options",
                objective.id
            );
            let help = "use fewer options, or fewer tasks at the same time";
            return Err(vec![
                Diagnostic::new(objective.span.clone(), message, "too many").help(help),
            ]);
        }
        let with = |before: &Combination, index: usize| {
            let tio = &definition.tios[index];
            let separator = if before.tios.is_empty() { "" } else { " " };
            Combination {
                tios: [&before.tios[..], &[index]].concat(),
                label: format!("{}{separator}{}", before.label, tio.id),
                needs: before.needs.union(tio.needs),
                speed_max: before.speed_max.into_iter().chain(tio.speed_max).min(),
                lead: if task.leads() { index } else { before.lead },
            }
        };
        combinations = combinations
            .iter()
            .flat_map(|before| options.iter().map(move |&(index, _)| with(before, index)))
            .collect();
    }
    Ok(combinations)
}

enum Impossible {
    TooExpensive(Diagnostic),
    Empty(Diagnostic),
}

fn plan(
    definition: &Definition,
    (place, part): (usize, &Part<'_>),
    combinations: &[Combination],
    derived: Option<&Derived>,
) -> Result<PlannedActivity, Impossible> {
    let travels = part.task_objective.travels();
    let covers = |zone: &Zone| travels && zone.x_start <= part.x_start && part.x_end <= zone.x_end;
    let zones: Vec<_> =
        definition.zones.iter().enumerate().filter(|(_, zone)| covers(zone)).collect();
    let robot = &definition.robot;
    let slowest = zones.iter().filter_map(|(_, zone)| zone.speed_max);
    let slowest =
        slowest.fold(robot.speed_max.min(robot.speed_harmless), MillimetresPerSecond::min);
    let mut activity = PlannedActivity {
        id: format!("A{}", place + 1),
        objective: part.objective,
        x_start: part.x_start,
        x_end: part.x_end,
        speed_max: if travels { slowest } else { MillimetresPerSecond::ZERO },
        alternatives: Vec::new(),
        labels: Vec::new(),
        dropped: Vec::new(),
        derived: Vec::new(),
    };
    for combination in combinations {
        let by = excluding(definition, &zones, combination);
        let found = derived.map(|it| it.candidate(place, &combination.tios)).transpose();
        let speed = match &found {
            Ok(None) => combination.speed_max.into_iter().fold(slowest, MillimetresPerSecond::min),
            Ok(Some(it)) => MillimetresPerSecond(it.speed_mm_s.unsigned_abs()),
            Err(reason) => {
                let demands = by.iter().map(|&(zone, it)| demand(definition, zone, it));
                let reason = demands.chain(by.is_empty().then(|| reason.clone()));
                let reason = reason.collect::<Vec<_>>().join("; ");
                activity.dropped.push(Dropped { label: combination.label.clone(), by, reason });
                continue;
            }
        };
        let alternative = alternative(definition, speed, combination);
        let whole = Activity { x_start: part.x_start, x_end: part.x_end, alternatives: &[] }
            .whole(&alternative);
        // Excluded combinations are held to this too, so that lifting a constraint cannot fail.
        if alternative.candidate(whole, 0).is_none() {
            return Err(Impossible::TooExpensive(too_expensive(
                &activity,
                part,
                &combination.label,
            )));
        }
        if by.is_empty() {
            activity.alternatives.push(alternative);
            activity.labels.push(combination.label.clone());
            activity.derived.extend(found.ok().flatten().cloned());
        } else {
            let reasons: Vec<_> =
                by.iter().map(|&(zone, constraint)| demand(definition, zone, constraint)).collect();
            let reason = reasons.join("; ");
            activity.dropped.push(Dropped { label: combination.label.clone(), by, reason });
        }
    }
    if derived.is_some() && travels {
        let speeds = activity.alternatives.iter().map(|it| it.speed);
        activity.speed_max = speeds.max().unwrap_or(MillimetresPerSecond::ZERO);
    }
    if activity.alternatives.is_empty() {
        return Err(Impossible::Empty(emptied(definition, &activity, part)));
    }
    Ok(activity)
}

/// The options of a combination taken together: they move with the power of the speed, or take what
/// the leading one takes standing, and everything they need is on.
fn alternative(
    definition: &Definition,
    speed: MillimetresPerSecond,
    combination: &Combination,
) -> Alternative {
    let tios = || combination.tios.iter().filter_map(|&tio| definition.tios.get(tio));
    let hardware = definition.power_of(combination.needs);
    let together = |power: Milliwatts| power.0.saturating_add(hardware.0);
    let standing = definition.tios.get(combination.lead).and_then(|lead| lead.standing);
    if let Some(standing) = standing {
        let quality = tios().map(|tio| tio.quality).sum();
        return Alternative::standing(
            standing.duration.0,
            together(standing.power),
            combination.needs,
            quality,
        );
    }
    let quality = tios().map(|tio| tio.quality_per_dm).sum();
    Alternative::travelling(
        speed.0,
        together(definition.motion_power.at(speed)),
        combination.needs,
        quality,
    )
}
