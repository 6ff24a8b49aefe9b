//! The return that is kept: the cheapest options that need nothing of what may be lost.

use crate::leg::up;
use crate::limits::Limit;
use crate::run::NotRun;
use cotama_axes::{Candidate, Lifted, Mission, Return, Steps, Stop, Table};

/// Returns the most that an indicator may be, in parts of a thousand of what is planned.
pub(crate) fn factor(stated: &Return, indicator: usize) -> i64 {
    let own = stated.errors.iter().filter(|it| it.0 == indicator);
    1_000 + own.map(|it| it.1.max(0)).max().unwrap_or(0)
}

/// A stretch of the path, or a task, with the options that are taken for safety.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stretch {
    pub(crate) activity: usize,
    objective: usize,
    from_mm: i64,
    to_mm: i64,
    /// The most that each indicator may be; `None` where no options are left.
    costs: Option<Vec<i64>>,
    pub(crate) choice: usize,
}

/// The whole mission by safe options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Safe {
    pub(crate) stated: Return,
    pub(crate) table: Table,
    pub(crate) stretches: Vec<Stretch>,
}

/// Returns the mission with units of hardware lost; options that need more are no choice any more.
pub(crate) fn without(mission: &Mission, units: &[i64]) -> Mission {
    let mut left = mission.clone();
    for (it, units) in left.hardware.iter_mut().zip(units) {
        it.units = *units;
    }
    let options = &mission.options;
    let is_left = |it: &usize| {
        let needs = options.get(*it).map_or(&[][..], |it| it.needs.as_slice());
        needs.iter().zip(units).all(|(need, units)| need <= units)
    };
    for tasks in left.objectives.iter_mut().flat_map(|it| &mut it.tasks) {
        tasks.retain(is_left);
    }
    left
}

impl Safe {
    pub(crate) fn new(
        mission: &Mission,
        stated: &Return,
        limits: &[Limit],
        steps: &mut Steps,
    ) -> Result<Self, NotRun> {
        let mut units: Vec<i64> = mission.hardware.iter().map(|it| it.units).collect();
        for (hardware, lost) in &stated.losses {
            if let Some(it) = units.get_mut(*hardware) {
                *it = (*it - lost).max(0);
            }
        }
        let left = without(mission, &units);
        let table = Table::new(&left, Lifted::default(), steps).map_err(|it| match it {
            Stop::Limit => NotRun::Limit,
            Stop::Wrong(it) => NotRun::Wrong(it),
        })?;
        let mut stretches = Vec::new();
        for (activity, it) in table.activities.iter().enumerate() {
            let all = it.candidates.iter().enumerate();
            let least = all.min_by_key(|(at, it)| (load(it, stated, limits), *at));
            if it.travels() && least.is_none() {
                return Err(NotRun::NoReturn(it.x_start_mm));
            }
            let costs = least.map(|(_, it)| {
                let sums = mission.indicators.iter().enumerate();
                let cost = |at: usize| up(it.value(at), factor(stated, at), 1_000);
                sums.map(|(at, it)| if it.adds_up { cost(at) } else { 0 }).collect()
            });
            stretches.push(Stretch {
                activity,
                objective: it.objective,
                from_mm: it.x_start_mm,
                to_mm: it.x_end_mm,
                costs,
                choice: least.map_or(0, |it| it.0),
            });
        }
        Ok(Self { stated: stated.clone(), table, stretches })
    }

    /// Returns the most that the way back from a place takes of an indicator.
    pub(crate) fn back(&self, x_mm: i64, indicator: usize) -> i64 {
        let driven = self.stretches.iter().filter(|it| it.from_mm < it.to_mm && it.from_mm < x_mm);
        let cost = |it: &Stretch| it.part(indicator, x_mm.min(it.to_mm) - it.from_mm);
        driven.map(cost).sum()
    }

    /// Returns the stretches from a place in an objective to the end.
    pub(crate) fn ahead(&self, objective: usize, x_mm: i64) -> impl Iterator<Item = &Stretch> {
        self.stretches.iter().filter(move |it| {
            let is_left = it.from_mm == it.to_mm || x_mm < it.to_mm;
            it.objective > objective || (it.objective == objective && is_left)
        })
    }

    /// Returns the most that the rest of the mission takes of an indicator; `None` where something
    /// has no options.
    pub(crate) fn onward(&self, objective: usize, x_mm: i64, indicator: usize) -> Option<i64> {
        let cost = |it: &Stretch| {
            it.costs.as_ref()?;
            Some(it.part(indicator, it.to_mm - it.from_mm.max(x_mm).min(it.to_mm)))
        };
        self.ahead(objective, x_mm).map(cost).sum()
    }
}

impl Stretch {
    /// Returns the most that so many mm of it take; of a task all. A part is rounded up twice.
    fn part(&self, indicator: usize, mm: i64) -> i64 {
        let whole = self.costs.as_ref().and_then(|it| it.get(indicator)).copied().unwrap_or(0);
        let length = self.to_mm - self.from_mm;
        if mm == length { whole } else { up(whole, mm, length) + 2 }
    }
}

/// Returns how much of the tightest limit a candidate takes, in parts of a million.
fn load(candidate: &Candidate, stated: &Return, limits: &[Limit]) -> i128 {
    let of = |it: &Limit| {
        let cost = up(candidate.value(it.indicator), factor(stated, it.indicator), 1_000);
        let most = i128::from(it.most()?.max(1));
        Some(i128::from(cost) * 1_000_000 / most)
    };
    limits.iter().filter_map(of).max().unwrap_or(0)
}
