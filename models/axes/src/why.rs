//! Reasons of a speed: the constraints that bind, and the inducers that bind in them.

use crate::formula::Inducer;
use crate::mission::{Mission, Relation};
use crate::steps::Stop;
use crate::table::{Activity, Candidate};
use crate::world::World;

/// A core constraint that the next speed breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The constraint, by index.
    pub constraint: usize,
    /// Value at the speed.
    pub value: i64,
    /// Value at the next speed.
    pub value_next: i64,
    /// Relation that the value must have to the goal here.
    pub relation: Relation,
    /// The goal here.
    pub goal: i64,
    /// Inducers that decide, with their values: of `min` and `max` only the part that counts.
    pub inducers: Vec<Cause>,
}

/// An inducer with its value and where that comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cause {
    /// As in formulas.
    pub name: String,
    /// At the next speed.
    pub value: i64,
    /// The zone, the hardware or the options that it is of; empty if that is clear.
    pub of: String,
}

/// Says why a candidate is not faster; without bindings the robot itself is no faster, or stands.
///
/// # Errors
/// [`Stop::Wrong`] for arithmetic that does not come out at the next speed.
pub fn why(
    mission: &Mission,
    activity: &Activity,
    candidate: &Candidate,
) -> Result<Vec<Binding>, Stop> {
    let world = activity.world(mission, &candidate.options);
    let Some(next) = mission.speeds.above(candidate.speed_mm_s) else { return Ok(Vec::new()) };
    let motion = world.at(next);
    let mut bindings = Vec::new();
    for &constraint in &candidate.bounded_by {
        let Some(it) = mission.constraints.get(constraint) else { continue };
        let Some(indicator) = mission.indicators.get(it.indicator) else { continue };
        let Some(formula) = indicator.formula(true) else { continue };
        let read = |it: &Inducer| world.read(it, motion);
        let inducers = formula.binding(&read).map_err(|it| formula.wrong(&it, &indicator.id))?;
        let cause =
            |it: &Inducer| Cause { name: it.to_string(), value: read(it), of: source(&world, it) };
        bindings.push(Binding {
            constraint,
            value: candidate.values.get(it.indicator).copied().flatten().unwrap_or(0),
            value_next: world.value(formula, motion, &indicator.id)?,
            relation: it.relation,
            goal: it.goal_in(&activity.zones),
            inducers: inducers.into_iter().map(cause).collect(),
        });
    }
    Ok(bindings)
}

/// Returns the names of the parts that an inducer is of.
fn source(world: &World<'_>, inducer: &Inducer) -> String {
    let mission = world.mission;
    let names: Vec<&str> = match inducer {
        Inducer::Detector(_) => {
            let detector = world.detector.and_then(|it| mission.hardware.get(it));
            detector.iter().map(|it| it.id.as_str()).collect()
        }
        Inducer::ZoneMin(key) => {
            let zones = world.zones.iter().filter_map(|&it| mission.zones.get(it));
            let least = world.fixed(inducer);
            zones.filter(|it| it.attributes.get(key) == least).map(|it| it.id.as_str()).collect()
        }
        Inducer::Options(key) => {
            let options = world.options.iter().filter_map(|&it| mission.options.get(it));
            let has = |it: &&crate::mission::Tio| it.attributes.get(key).is_some_and(|it| it != 0);
            options.filter(has).map(|it| it.id.as_str()).collect()
        }
        Inducer::Hardware(key) => {
            let on = mission.hardware.iter().zip(&world.needs).filter(|it| *it.1 > 0);
            let has =
                |it: &crate::mission::Hardware| it.attributes.get(key).is_some_and(|it| it != 0);
            on.map(|it| it.0).filter(|it| has(it)).map(|it| it.id.as_str()).collect()
        }
        _ => Vec::new(),
    };
    names.join(", ")
}
