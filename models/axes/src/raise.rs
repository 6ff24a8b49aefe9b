//! Changes of one number that let a candidate be faster.

use crate::fields::LARGEST;
use crate::formula::Inducer;
use crate::mission::{Attributes, Lifted, Mission};
use crate::steps::{Steps, Stop};
use crate::table::{Activity, Candidate, combination, holds_alone};

/// A number of the mission with which a constraint no longer holds a candidate back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raise {
    /// As `robot.mass_g`, `laser.detect_ms`, `H1-out.width_mm`, `L2.frames`, or `goal`.
    pub name: String,
    /// The number today.
    pub now: i64,
    /// The nearest number at which the constraint lets the next speed pass.
    pub needed: i64,
    /// The candidate's speed with it, mm/s; today's where another constraint holds it too, zero
    /// where one removes it then.
    pub speed_mm_s: i64,
}

/// A number that can be changed.
#[derive(Clone, Debug)]
enum Number {
    Goal(usize),
    Robot(String),
    Laptop(String),
    /// The least of some zones, which have it together.
    Zones(Vec<usize>, String),
    Hardware(usize, String),
    Tio(usize, String),
}

/// Returns the changes of one number after which a constraint that binds a candidate allows the
/// next speed; each is the nearest that steps of doubled size and halves between them find.
///
/// # Errors
/// [`Stop::Wrong`] for arithmetic that does not come out today; [`Stop::Limit`] for too many steps.
pub fn raises(
    mission: &Mission,
    activity: &Activity,
    candidate: &Candidate,
    constraint: usize,
    steps: &mut Steps,
) -> Result<Vec<Raise>, Stop> {
    let Some(next) = mission.speeds.above(candidate.speed_mm_s) else { return Ok(Vec::new()) };
    let mut raises = Vec::new();
    let mut changed = mission.clone();
    for number in numbers(mission, activity, candidate, constraint, next)? {
        let now = number.get(mission, activity);
        let least = if matches!(number, Number::Goal(_)) || now < 0 { -LARGEST } else { 0 };
        for (sign, end) in [(-1, least), (1, LARGEST)] {
            let mut holds = |value: i64, steps: &mut Steps| {
                number.set(&mut changed, activity, value);
                match holds_alone(&changed, activity, &candidate.options, constraint, next, steps) {
                    Err(Stop::Wrong(_)) => Ok(false),
                    held => held,
                }
            };
            let Some(needed) = nearest(now, sign, end, &mut holds, steps)? else { continue };
            number.set(&mut changed, activity, needed);
            let options = candidate.options.clone();
            let with = combination(&changed, activity, options, Lifted::default(), steps);
            let speed_mm_s = match with {
                Ok(with) => with.map_or(0, |it| it.speed_mm_s),
                // Numbers grow too large elsewhere: this is no change to name.
                Err(Stop::Wrong(_)) => continue,
                Err(Stop::Limit) => return Err(Stop::Limit),
            };
            raises.push(Raise { name: number.name(mission), now, needed, speed_mm_s });
        }
        number.undo(&mut changed, mission, activity, now);
    }
    debug_assert_eq!(changed, *mission);
    Ok(raises)
}

/// Returns the nearest value in a direction that holds, up to an end.
fn nearest(
    now: i64,
    sign: i64,
    end: i64,
    holds: &mut impl FnMut(i64, &mut Steps) -> Result<bool, Stop>,
    steps: &mut Steps,
) -> Result<Option<i64>, Stop> {
    let most = end.abs_diff(now);
    let at = |distance: u64| now + sign * i64::try_from(distance).unwrap_or(0);
    let (mut fails, mut distance) = (0, 1.min(most));
    loop {
        if distance == fails {
            return Ok(None);
        }
        if holds(at(distance), steps)? {
            break;
        }
        (fails, distance) = (distance, (2 * distance).min(most));
    }
    while distance - fails > 1 {
        let half = fails + (distance - fails) / 2;
        if holds(at(half), steps)? { distance = half } else { fails = half }
    }
    Ok(Some(at(distance)))
}

/// Returns the numbers on which the value of a constraint hangs at the next speed, its goal last.
fn numbers(
    mission: &Mission,
    activity: &Activity,
    candidate: &Candidate,
    constraint: usize,
    next: i64,
) -> Result<Vec<Number>, Stop> {
    let world = activity.world(mission, &candidate.options);
    let motion = world.at(next);
    let of = mission.constraints.get(constraint);
    let indicator = of.and_then(|it| mission.indicators.get(it.indicator));
    let Some((indicator, formula)) = indicator.and_then(|it| Some((it, it.formula(true)?))) else {
        return Ok(Vec::new());
    };
    let inducers = formula.binding(&|it| world.read(it, motion));
    let mut numbers = Vec::new();
    for inducer in inducers.map_err(|it| formula.wrong(&it, &indicator.id))? {
        match inducer {
            Inducer::Length | Inducer::Speed | Inducer::Duration | Inducer::MotionPower => {}
            Inducer::Robot(key) => numbers.push(Number::Robot(key.clone())),
            Inducer::Laptop(key) => numbers.push(Number::Laptop(key.clone())),
            Inducer::Options(key) => {
                let has = |&it: &usize| mission.options.get(it).is_some_and(|it| has(it, key));
                let options = candidate.options.iter().copied().filter(has);
                numbers.extend(options.map(|it| Number::Tio(it, key.clone())));
            }
            Inducer::Hardware(key) => {
                let on = mission.hardware.iter().zip(&world.needs).enumerate();
                let has = on.filter(|it| *it.1.1 > 0 && it.1.0.attributes.get(key).is_some());
                numbers.extend(has.map(|it| Number::Hardware(it.0, key.clone())));
            }
            Inducer::ZoneMin(key) => {
                let least = world.fixed(inducer);
                let value = |it: usize| mission.zones.get(it).and_then(|it| it.attributes.get(key));
                let all = activity.zones.iter().copied().filter(|&it| value(it) == least);
                let all: Vec<_> = all.collect();
                numbers.extend((!all.is_empty()).then(|| Number::Zones(all, key.clone())));
            }
            Inducer::Detector(key) => {
                numbers.extend(world.detector.map(|it| Number::Hardware(it, key.clone())));
            }
        }
    }
    numbers.push(Number::Goal(constraint));
    Ok(numbers)
}

fn has(option: &crate::mission::Tio, key: &str) -> bool {
    option.attributes.get(key).is_some()
}

impl Number {
    fn name(&self, mission: &Mission) -> String {
        match self {
            Self::Goal(_) => "goal".into(),
            Self::Robot(key) => format!("robot.{key}"),
            Self::Laptop(key) => format!("laptop.{key}"),
            Self::Zones(all, key) => {
                let names = all.iter().filter_map(|&it| mission.zones.get(it));
                let names: Vec<_> = names.map(|it| it.id.as_str()).collect();
                format!("{}.{key}", names.join(","))
            }
            Self::Hardware(it, key) => {
                let id = mission.hardware.get(*it).map_or("", |it| &it.id);
                format!("{id}.{key}")
            }
            Self::Tio(it, key) => {
                format!("{}.{key}", mission.options.get(*it).map_or("", |it| &it.id))
            }
        }
    }

    fn get(&self, mission: &Mission, activity: &Activity) -> i64 {
        let own = |of: Option<&Attributes>, key: &str| of.and_then(|it| it.get(key)).unwrap_or(0);
        match self {
            Self::Goal(it) => {
                mission.constraints.get(*it).map_or(0, |it| it.goal_in(&activity.zones))
            }
            Self::Robot(key) => own(Some(&mission.robot), key),
            Self::Laptop(key) => own(Some(&mission.laptop), key),
            Self::Zones(all, key) => {
                let first = all.first().and_then(|&it| mission.zones.get(it));
                own(first.map(|it| &it.attributes), key)
            }
            Self::Hardware(it, key) => own(mission.hardware.get(*it).map(|it| &it.attributes), key),
            Self::Tio(it, key) => own(mission.options.get(*it).map(|it| &it.attributes), key),
        }
    }

    /// Puts back what a mission had before.
    fn undo(&self, changed: &mut Mission, mission: &Mission, activity: &Activity, now: i64) {
        match self {
            // Goals of several zones may have been several.
            Self::Goal(_) => changed.constraints.clone_from(&mission.constraints),
            _ => self.set(changed, activity, now),
        }
    }

    fn set(&self, mission: &mut Mission, activity: &Activity, value: i64) {
        match self {
            Self::Goal(it) => {
                if let Some(it) = mission.constraints.get_mut(*it) {
                    let here = it.at.iter_mut().filter(|it| activity.zones.contains(&it.0));
                    let mut varies = false;
                    for goal in here {
                        (goal.1, varies) = (value, true);
                    }
                    if !varies {
                        it.goal = value;
                    }
                }
            }
            Self::Robot(key) => mission.robot.set(key, value),
            Self::Laptop(key) => mission.laptop.set(key, value),
            Self::Zones(all, key) => {
                for &it in all {
                    if let Some(zone) = mission.zones.get_mut(it) {
                        zone.attributes.set(key, value);
                    }
                }
            }
            Self::Hardware(it, key) => {
                if let Some(it) = mission.hardware.get_mut(*it) {
                    it.attributes.set(key, value);
                }
            }
            Self::Tio(it, key) => {
                if let Some(it) = mission.options.get_mut(*it) {
                    it.attributes.set(key, value);
                }
            }
        }
    }
}
