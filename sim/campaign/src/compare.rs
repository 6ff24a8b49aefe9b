//! Policies over the same fault plans.

use crate::run::{Campaign, Settings, Shard};
use crate::statistics::{Difference, Interval, mcnemar, mean_interval, paired_difference};
use crate::subject::{Policy, Subject, Unready};
use cotama_models::missions::Mission;
use cotama_sim::run::Outcome;
use std::ops::ControlFlow;

/// The result of a policy.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Name of the policy.
    pub name: String,
    /// How many runs were completed, ended safely, and failed.
    pub outcomes: [u64; 3],
    /// The probability that a mission is completed; none where nothing was
    /// [sampled](crate::sampling::Sampling).
    pub success: Option<Interval>,
    /// The means over these plans: time used in ms, energy in mJ, requests to the operator, plans
    /// made again.
    pub means: [f64; 4],
    /// Their intervals, of all plans drawn so; none where nothing was sampled, or one run only.
    pub intervals: Option<[Interval; 4]>,
    /// Against the first policy; none of the first, nor where nothing was sampled.
    pub against: Option<Against>,
}

/// The difference to the first policy.
#[derive(Clone, Debug, PartialEq)]
pub struct Against {
    /// In success.
    pub success: Difference,
    /// In the means.
    pub means: [Interval; 4],
}

/// Whether a run was completed, and its numbers.
type Row = (bool, [f64; 4]);

/// Runs the same plans with each policy, on so many threads. A strategy that counts its plans runs
/// no more than there are. Each interval holds the truth as often as `confidence` says, from 0 to
/// 1.
///
/// # Errors
/// An [`Unready`] for a mission that cannot be run by one of them.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::{compare::compare, run::Settings, subject::Policy};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let rigid = Policy { rigid: true, ..Policy::default() };
/// let policies = [("rigid".to_owned(), rigid), ("rule".to_owned(), Policy::default())];
/// let settings = Settings { runs: 200, ..Settings::new(false) };
/// let found = compare(&mission, &policies, &settings, 0.95, 2).unwrap();
/// assert!(found[1].outcomes[0] > found[0].outcomes[0]);
/// assert!(found[1].against.as_ref().unwrap().success.success.low > 0.0);
/// ```
pub fn compare(
    mission: &Mission,
    policies: &[(String, Policy)],
    settings: &Settings,
    confidence: f64,
    jobs: usize,
) -> Result<Vec<Compared>, Unready> {
    let mut first: Vec<Row> = Vec::new();
    let mut found = Vec::new();
    for (name, policy) in policies {
        let campaign = Campaign::new(Subject::new(mission, *policy)?, settings.clone())?;
        let (mut rows, mut outcomes) = (Vec::new(), [0; 3]);
        campaign.run(Shard::ALL, 0, jobs, &mut |lines| {
            for it in lines.into_iter().map(|it| it.observed) {
                outcomes[it.outcome as usize] += 1;
                let numbers = [it.time_ms, it.energy_mj, it.requests, it.replans];
                rows.push((it.outcome == Outcome::Completed, numbers.map(|it| it as f64)));
            }
            ControlFlow::Continue(())
        });
        let runs = rows.len() as u64;
        let column = |axis: usize| rows.iter().map(|it| it.1[axis]).collect::<Vec<_>>();
        let sampling = campaign.sampling(runs, false);
        let against = (!first.is_empty() && sampling.estimates()).then(|| {
            let only = |mine: bool| {
                let pairs = first.iter().zip(&rows);
                pairs.filter(|(a, b)| a.0 != b.0 && b.0 == mine).count() as u64
            };
            let pairs = |axis: usize| {
                let pairs = first.iter().zip(&rows);
                pairs.map(|(a, b)| (a.1[axis], b.1[axis])).collect::<Vec<_>>()
            };
            Against {
                success: mcnemar(only(false), only(true), runs, confidence),
                means: [0, 1, 2, 3].map(|axis| paired_difference(&pairs(axis), confidence)),
            }
        });
        found.push(Compared {
            name: name.clone(),
            outcomes,
            success: sampling.interval(outcomes[0], runs, confidence),
            means: [0, 1, 2, 3].map(|axis| column(axis).iter().sum::<f64>() / runs.max(1) as f64),
            intervals: (sampling.estimates() && runs > 1)
                .then(|| [0, 1, 2, 3].map(|axis| mean_interval(&column(axis), confidence))),
            against,
        });
        if first.is_empty() {
            first = rows;
        }
    }
    Ok(found)
}
