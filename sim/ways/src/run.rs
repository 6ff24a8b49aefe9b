//! A run: 20 maps in both conditions, each tried up to three times.

use crate::learned::{Learned, Row, TRIALS, UTILITY};
use crate::maps::MAPS;
use crate::policy::{Condition, Policy, Rules, choose};
use crate::ring::Way;
use crate::world::{Place, Series, World};
use cotama_risk::{Model, Wrong};

/// The trials on a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Visit {
    /// The condition.
    pub condition: Condition,
    /// The map, from 0.
    pub map: usize,
    /// The trials, at least one, at most [`TRIALS`].
    pub rows: Vec<Row>,
    /// Estimate of the reward before each trial, of policies that estimate.
    pub estimates: Vec<f64>,
}

impl Visit {
    /// Whether the goal was reached.
    pub fn is_success(&self) -> bool {
        self.rows.last().is_some_and(|it| it.trial.is_success())
    }

    /// Number of failed trials.
    pub fn errors(&self) -> usize {
        self.rows.iter().filter(|it| !it.trial.is_success()).count()
    }

    /// The reward: the utility, if the goal was reached, less the seconds of all trials.
    pub fn reward(&self) -> f64 {
        self.reward_of(self.rows.len())
    }

    fn reward_of(&self, trials: usize) -> f64 {
        let costs: f64 = self.rows[..trials].iter().map(|it| it.trial.cost()).sum();
        let is_success = self.rows[..trials].last().is_some_and(|it| it.trial.is_success());
        f64::from(u8::from(is_success)) * UTILITY - costs
    }

    /// The reward, had the robot left the map before the first trial with an estimate below 0
    /// (section 4.5.3.3).
    pub fn reward_with_stops(&self) -> f64 {
        let stop = self.estimates.iter().position(|it| *it < 0.0);
        self.reward_of(stop.unwrap_or(self.rows.len()))
    }

    /// Whether the second trial took the other way; `None` without a second trial.
    pub fn switched(&self) -> Option<bool> {
        let [first, second, ..] = self.rows.as_slice() else { return None };
        Some(first.way != second.way)
    }
}

/// Makes a run. With `online`, its trials are added to what was learned, map after map.
///
/// # Errors
/// Never, with counts of this crate.
pub fn run(
    world: &mut World,
    series: Series,
    policy: Policy,
    rules: Rules,
    learned: &mut Learned,
    online: bool,
) -> Result<Vec<Visit>, Wrong> {
    let mut model = learned.model()?;
    let mut visits = Vec::with_capacity(2 * MAPS.len());
    for condition in Condition::ALL {
        for map in 0..MAPS.len() {
            let it = visit(world, (series, condition, map), policy, rules, &model);
            if online {
                it.rows.iter().try_for_each(|row| learned.add(row))?;
                model = learned.model()?;
            }
            visits.push(it);
        }
    }
    Ok(visits)
}

fn visit(
    world: &mut World,
    (series, condition, map): (Series, Condition, usize),
    policy: Policy,
    rules: Rules,
    model: &Model,
) -> Visit {
    let ratio = MAPS[map].ratio;
    let mut visit = Visit { condition, map, rows: Vec::new(), estimates: Vec::new() };
    let mut failed = Vec::new();
    for trial in 0..TRIALS {
        let place = Place { series, condition, map, trial };
        let mut chance = world.streams(place).stream("choice");
        let (way, estimate) =
            choose(policy, rules, model, (condition, ratio), &failed, &mut chance);
        visit.estimates.extend(estimate);
        let row = Row { ratio, way, trial: world.trial(place, way) };
        visit.rows.push(row);
        if row.trial.is_success() {
            break;
        }
        failed.push(row.seen());
    }
    visit
}

/// Learns from the four runs of training: two on the short way, two on the long one (section
/// 4.5.2).
///
/// # Errors
/// Never: there are trials.
pub fn train(world: &mut World) -> Result<(Learned, Vec<Row>), Wrong> {
    let mut rows = Vec::new();
    for (at, way) in [Way::Short, Way::Short, Way::Long, Way::Long].into_iter().enumerate() {
        let series = Series::Training(at as u64);
        for condition in Condition::ALL {
            for (map, its) in MAPS.iter().enumerate() {
                for trial in 0..TRIALS {
                    let made = world.trial(Place { series, condition, map, trial }, way);
                    rows.push(Row { ratio: its.ratio, way, trial: made });
                    if made.is_success() {
                        break;
                    }
                }
            }
        }
    }
    Ok((Learned::new(&rows)?, rows))
}
