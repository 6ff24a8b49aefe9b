//! The total cost of a sequence of ways, as a distribution.

use super::model::Model;
use super::{Measure, least};
use crate::quantile::{Convention, quantile};

/// A distribution: costs, rising, and their probabilities.
type Costs = Vec<(f64, f64)>;

/// Ways, each taken after a failure of those before it.
#[derive(Clone, Debug)]
struct Sequence {
    cost: f64,
    mean: f64,
    ways: Vec<usize>,
}

impl Sequence {
    fn is_better(&self, than: &Self) -> bool {
        match least(&[than.cost, self.cost]) {
            1 => true,
            _ if least(&[self.cost, than.cost]) == 1 => false,
            _ => least(&[than.mean, self.mean]) == 1,
        }
    }
}

impl Model {
    /// For each way the measure of the total cost of the best sequence that begins with it, and the
    /// best sequence of all. Quantiles fall on few values: of equal ones the least mean is best.
    pub(super) fn total(
        &self,
        belief: &[f64],
        trials: usize,
        measure: Measure,
    ) -> (Vec<f64>, Vec<usize>) {
        let ways = self.ways();
        let mut best: Vec<Option<Sequence>> = vec![None; ways];
        // In the order of their numbers; the first of equal ones is kept.
        let mut sequence = vec![0; trials];
        loop {
            let of = |measure| self.measure(&self.outcomes(belief, &sequence, measure), measure);
            let own =
                Sequence { cost: of(measure), mean: of(Measure::Mean), ways: sequence.clone() };
            let first = sequence.first().copied().unwrap_or(0);
            if best[first].as_ref().is_none_or(|it| own.is_better(it)) {
                best[first] = Some(own);
            }
            let Some(at) = sequence.iter().rposition(|it| it + 1 < ways) else { break };
            sequence[at] += 1;
            sequence[at + 1..].fill(0);
        }
        let cost = |it: &Option<Sequence>| it.as_ref().map_or(self.utility(), |it| it.cost);
        let costs = best.iter().map(cost).collect();
        let best = best.into_iter().flatten();
        let best = best.reduce(|best, it| if it.is_better(&best) { it } else { best });
        (costs, best.map_or_else(Vec::new, |it| it.ways))
    }

    fn measure(&self, costs: &Costs, measure: Measure) -> f64 {
        match measure {
            Measure::Mean => costs.iter().map(|(cost, p)| cost * p).sum(),
            Measure::Quantile(level) => {
                quantile(costs, level, Convention::Reached).unwrap_or(self.utility())
            }
        }
    }

    /// The distribution of the total cost: trials are independent given the hidden state, so their
    /// costs are convolved state by state.
    fn outcomes(&self, belief: &[f64], sequence: &[usize], measure: Measure) -> Costs {
        let value = |(low, high): &(f64, f64)| match measure {
            Measure::Mean => (low + high) / 2.0,
            Measure::Quantile(_) => *high,
        };
        let values: Vec<f64> = self.bounds().iter().map(value).collect();
        let mut all = Costs::new();
        for (hidden, weight) in belief.iter().enumerate().filter(|it| *it.1 > 0.0) {
            // What was spent in failed trials so far.
            let mut spent: Costs = vec![(0.0, *weight)];
            for way in sequence {
                let success = self.success(hidden, *way);
                let add = |is_success: bool, share: f64, to: &mut Costs| {
                    for (cost, p) in &spent {
                        let costs = self.costs(hidden, *way, is_success).iter().zip(&values);
                        to.extend(costs.map(|(own, value)| (cost + value, p * share * own)));
                    }
                };
                add(true, success, &mut all);
                let mut next = Costs::new();
                add(false, 1.0 - success, &mut next);
                spent = gathered(next);
            }
            all.extend(spent.iter().map(|(cost, p)| (cost + self.utility(), *p)));
            all = gathered(all);
        }
        all
    }
}

/// The distribution with each cost once, and without those that are impossible.
fn gathered(mut costs: Costs) -> Costs {
    costs.retain(|it| it.1 > 0.0);
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut all = Costs::new();
    for (cost, p) in costs {
        match all.last_mut() {
            Some(last) if cost - last.0 <= super::EQUAL => last.1 += p,
            _ => all.push((cost, p)),
        }
    }
    all
}
