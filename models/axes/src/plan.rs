//! Phase P2: one candidate for each activity, within all limits on sums (Lambert et al. 2024,
//! Section 7), exactly.

use crate::mission::{Ask, Constraint, Kind, Lifted, Mission, Relation, Sense};
use crate::search::{Column, FREE, Found, undominated, within_width};
use crate::steps::{Steps, Stop};
use crate::surrogate::surrogate;
use crate::table::Table;
use std::collections::BTreeMap;

/// Wishes are weighed together as long as the weights stay below this.
const MOST_WEIGHT: i128 = 600_000_000_000_000_000;

/// States that searches go on with after each activity, one search after the other.
const WIDTHS: [usize; 5] = [1 << 5, 1 << 9, 1 << 12, 1 << 16, usize::MAX];

/// A plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// For each activity its candidate, by index.
    pub choices: Vec<usize>,
    /// For each indicator the sum over the mission, if it adds up (equation 3); else zero.
    pub totals: Vec<i64>,
}

/// A plan of a front.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Sums in the order of what was asked.
    pub values: Vec<i64>,
    /// A plan that has them.
    pub plan: Plan,
}

/// A table, and the constraints on sums over it.
#[derive(Clone, Debug)]
pub struct Problem<'m> {
    mission: &'m Mission,
    table: &'m Table,
    /// By indicator and sense: of a sum to be small the limits, of one to be large those of its
    /// negative.
    limits: BTreeMap<(usize, bool), Vec<i64>>,
}

impl<'m> Problem<'m> {
    /// Puts the constraints on sums over a table, without the lifted ones.
    pub fn new(mission: &'m Mission, table: &'m Table, lifted: Lifted) -> Self {
        let mut problem = Self { mission, table, limits: BTreeMap::new() };
        for (number, it) in mission.constraints.iter().enumerate() {
            if !lifted.has(number) {
                problem.add(it);
            }
        }
        problem
    }

    fn add(&mut self, constraint: &Constraint) {
        let last = self.table.activities.len().saturating_sub(1);
        match constraint.kind {
            Kind::Core => {}
            Kind::End => {
                self.limit(constraint.indicator, constraint.relation, constraint.goal, last);
            }
            Kind::Running => {
                for (number, activity) in self.table.activities.iter().enumerate() {
                    let goal = constraint.goal_in(&activity.zones);
                    self.limit(constraint.indicator, constraint.relation, goal, number);
                }
            }
        }
    }

    fn limit(&mut self, indicator: usize, relation: Relation, goal: i64, after: usize) {
        let count = self.table.activities.len();
        let small = relation.most(goal).map(|it| (true, it));
        let large = relation.least(goal).map(|it| (false, -it));
        for (is_small, most) in small.into_iter().chain(large) {
            let limits =
                self.limits.entry((indicator, is_small)).or_insert_with(|| vec![FREE; count]);
            if let Some(it) = limits.get_mut(after) {
                *it = most.min(*it);
            }
        }
    }

    /// The same with one more limit on the sum at the end of the mission.
    #[must_use]
    pub fn and(mut self, indicator: usize, relation: Relation, goal: i64) -> Self {
        let last = self.table.activities.len().saturating_sub(1);
        self.limit(indicator, relation, goal, last);
        self
    }

    fn counts(&self) -> Vec<usize> {
        self.table.activities.iter().map(|it| it.candidates.len()).collect()
    }

    /// Returns the values of an indicator, signed so that little is good.
    fn values(&self, indicator: usize, is_small: bool) -> Vec<Vec<i64>> {
        let activities = self.table.activities.iter();
        let signed = |it: i64| if is_small { it } else { -it };
        activities
            .map(|it| it.candidates.iter().map(|it| signed(it.value(indicator))).collect())
            .collect()
    }

    fn columns(&self) -> Vec<Column> {
        let column = |(&(indicator, is_small), limits): (&(usize, bool), &Vec<i64>)| Column {
            values: self.values(indicator, is_small),
            limits: limits.clone(),
            wanted: false,
        };
        self.limits.iter().map(column).collect()
    }

    fn found(&self, choices: &[u16]) -> Plan {
        let choices: Vec<_> = choices.iter().map(|&it| usize::from(it)).collect();
        let mut totals = vec![0; self.mission.indicators.len()];
        let rows = self.table.activities.iter().zip(&choices);
        for candidate in rows.filter_map(|(it, &choice)| it.candidates.get(choice)) {
            for (number, (total, it)) in totals.iter_mut().zip(&self.mission.indicators).enumerate()
            {
                *total += if it.adds_up { candidate.value(number) } else { 0 };
            }
        }
        Plan { choices, totals }
    }

    /// Returns the best plan within the limits, the first wish counting most; none if there is no
    /// plan. Without wishes some plan.
    ///
    /// # Errors
    /// [`Stop::Limit`] if the steps do not suffice.
    pub fn best(&self, ask: &[Ask], steps: &mut Steps) -> Result<Option<Plan>, Stop> {
        let mut columns = self.columns();
        let mut rest = ask;
        loop {
            let (weighed, left) = self.weighed(rest);
            let bound = weighed.as_ref().map_or(0, |it| it.1);
            columns.extend(weighed.map(|it| it.0));
            let found = self.least(&mut columns, bound, steps)?;
            let Some((values, choices)) = found else { return Ok(None) };
            if left.is_empty() {
                return Ok(Some(self.found(&choices)));
            }
            // The wishes up to here are kept at their best.
            if let (Some(it), Some(&best)) = (columns.last_mut(), values.first()) {
                it.wanted = false;
                if let Some(it) = it.limits.last_mut() {
                    *it = best;
                }
            }
            rest = left;
        }
    }

    /// Returns the least sum of the wanted column, if there is one, or else some plan; the sum is
    /// never below the bound.
    ///
    /// Narrow searches come first: they are quick, and the wider ones need only look for less.
    fn least(
        &self,
        columns: &mut [Column],
        bound: i64,
        steps: &mut Steps,
    ) -> Result<Option<Found>, Stop> {
        let counts = self.counts();
        let mut best: Option<Found> = None;
        for width in WIDTHS {
            let mut all = Vec::new();
            // A bound on what is wanted itself is as good as all weights.
            if width > WIDTHS[0] && bound == 0 {
                let most = best.as_ref().and_then(|it| it.0.first()).map(|it| it - 1);
                all.extend(surrogate(columns, &counts, most));
            }
            let is_guided = !all.is_empty();
            all.extend_from_slice(columns);
            let width = (width, is_guided);
            let (found, was_cut) = within_width(&all, &counts, width, steps)?;
            let found = found.into_iter().next();
            let value = found.as_ref().and_then(|it| it.0.first().copied());
            let is_done = found.is_some() && value.is_none_or(|it| it <= bound);
            best = found.or(best);
            if !was_cut || is_done {
                break;
            }
            let last = columns.last_mut().and_then(|it| it.limits.last_mut());
            if let (Some(limit), Some(value)) = (last, value) {
                *limit = value - 1;
            }
        }
        Ok(best)
    }

    /// Returns one column for the first wishes, weighed so that an earlier one counts for more than
    /// all later ones, and the wishes that are left.
    ///
    /// The sums of the column are at least the number beside it. A wish for much of a sum that is
    /// limited, or for little of one that has a least, stays alone: there the limit is a bound.
    fn weighed<'a>(&self, ask: &'a [Ask]) -> (Option<(Column, i64)>, &'a [Ask]) {
        let counts = self.counts();
        let mut values: Vec<Vec<i64>> = counts.iter().map(|&it| vec![0; it]).collect();
        let mut weight = 1_i128;
        let mut taken = 0;
        let mut bound = 0;
        for wish in ask {
            let is_small = wish.sense == Sense::Min;
            let against = self.limits.get(&(wish.indicator, !is_small));
            if against.is_some() && taken > 0 {
                break;
            }
            let own = self.values(wish.indicator, is_small);
            let spread = |it: &Vec<i64>| {
                let (least, most) = (it.iter().min().copied(), it.iter().max().copied());
                i128::from(most.unwrap_or(0)) - i128::from(least.unwrap_or(0))
            };
            let range = own.iter().map(spread).sum::<i128>() + 1;
            if taken > 0 && weight * range > MOST_WEIGHT {
                break;
            }
            for (sums, own) in values.iter_mut().zip(&own) {
                let least = own.iter().min().copied().unwrap_or(0);
                for (sum, it) in sums.iter_mut().zip(own) {
                    *sum = *sum * range as i64 + (it - least);
                }
            }
            weight *= range;
            taken += 1;
            if let Some(&limit) = against.and_then(|it| it.last()) {
                let least = own.iter().filter_map(|it| it.iter().min()).sum::<i64>();
                bound = 0.max(-limit - least);
                break;
            }
        }
        let limits = vec![FREE; counts.len()];
        let column = Column { values, limits, wanted: true };
        ((taken > 0).then_some((column, bound)), ask.get(taken..).unwrap_or(&[]))
    }

    /// Returns all undominated sums of what is asked, within the limits, with a plan for each; in
    /// the order of the first wish.
    ///
    /// # Errors
    /// [`Stop::Limit`] if the steps do not suffice.
    pub fn front(&self, ask: &[Ask], steps: &mut Steps) -> Result<Vec<Point>, Stop> {
        let mut limits = self.limits.clone();
        let key = |it: &Ask| (it.indicator, it.sense == Sense::Min);
        let count = self.table.activities.len();
        for it in ask {
            limits.entry(key(it)).or_insert_with(|| vec![FREE; count]);
        }
        let columns: Vec<_> = limits
            .iter()
            .map(|(at, limits)| Column {
                values: self.values(at.0, at.1),
                limits: limits.clone(),
                wanted: ask.iter().any(|it| key(it) == *at),
            })
            .collect();
        let found = undominated(&columns, &self.counts(), steps)?;
        let point = |choices: &[u16]| {
            let plan = self.found(choices);
            let total = |it: &Ask| plan.totals.get(it.indicator).copied().unwrap_or(0);
            Point { values: ask.iter().map(total).collect(), plan }
        };
        let mut points: Vec<_> = found.iter().map(|it| point(&it.1)).collect();
        let signed = |point: &Point| -> Vec<i64> {
            let sign = |it: &Ask| if it.sense == Sense::Min { 1 } else { -1 };
            point.values.iter().zip(ask).map(|(value, it)| value * sign(it)).collect()
        };
        points.sort_by_cached_key(signed);
        Ok(points)
    }

    /// Returns how many plans are within the limits; none beyond 128 bits.
    ///
    /// # Errors
    /// [`Stop::Limit`] if the steps do not suffice.
    pub fn count(&self, steps: &mut Steps) -> Result<Option<u128>, Stop> {
        crate::count::count(&self.columns(), &self.counts(), steps)
    }
}
