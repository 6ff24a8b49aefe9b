//! `cotama campaign --compare`: policies over the same plans of faults.

use super::{asked, ended, jobs};
use crate::answers::campaign::{CampaignAnswer, Mean, Outcomes, PolicyRow};
use crate::args::{CampaignArgs, PolicyName};
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use cotama_campaign::compare::{Compared, compare};
use cotama_campaign::subject::Policy;
use cotama_models::missions::Mission;
use cotama_sim::options::Planner;

/// The same plans with each policy.
pub(super) fn compared(
    args: &CampaignArgs,
    mission: &Mission,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let of = asked::Of::mission(mission);
    let settings = asked::settings(args, of, mission.source(), Some(mission))?;
    let supervised = mission.is_supervised();
    let rule = ("rule", Policy { planner: Some(Planner::Panorama), ..Policy::default() });
    let own = Planner::of(mission);
    let mut named =
        PolicyName::ALL.map(|it| (it.name(), it.policy(supervised, args.steps))).to_vec();
    // The rule stands beside the planner that is usual for the mission, where it is another one; no
    // planner stands there twice.
    if own != Planner::Panorama {
        named.insert(1, rule);
    }
    named.retain(|it| it.0 != PolicyName::Exact.name() || it.1.of(mission) != own);
    let policies: Vec<_> = named.iter().map(|(name, it)| ((*name).to_owned(), *it)).collect();
    let found = compare(mission, &policies, &settings, args.confidence(), jobs(args))
        .map_err(|error| Failure::of(mission.source(), error.to_string()))?;
    let rows: Vec<_> = found.iter().zip(&named).map(|(it, (name, _))| row(it, name)).collect();
    let outcomes = rows.first().map_or([0; 3].into(), |it| it.outcomes);
    let answer = CampaignAnswer {
        schema: "cotama/campaign/1",
        mission: mission.name.clone(),
        // As many as there are: a strategy that counts its plans ends after these.
        runs: outcomes.completed + outcomes.safe + outcomes.failed,
        seed: settings.seed,
        strategy: settings.strategy.name().into(),
        policy: rows.first().map_or(String::new(), |it| it.policy.into()),
        planner: named.first().map_or(String::new(), |it| it.1.words(mission)),
        shard: None,
        outcomes,
        failing: 0,
        failure_probability: None,
        requirements: Vec::new(),
        failures: Vec::new(),
        shrunk: 0,
        shrinking_runs: 0,
        decision: None,
        held: None,
        digest: String::new(),
        policies: rows,
        report: None,
    };
    ended(args, &answer, screen)
}

fn row(it: &Compared, name: &'static str) -> PolicyRow {
    let mean = |axis: usize| {
        let interval = it.intervals.map(|it| it[axis]);
        Mean {
            estimate: it.means[axis],
            low: interval.map(|it| it.low),
            high: interval.map(|it| it.high),
            confidence: interval.map(|it| it.confidence),
        }
    };
    PolicyRow {
        policy: name,
        outcomes: Outcomes::from(it.outcomes),
        success: it.success.map(Into::into),
        success_difference: it.against.as_ref().map(|it| it.success.success.into()),
        p_value: it.against.as_ref().map(|it| it.success.p_value),
        duration_ms: mean(0),
        energy_mj: mean(1),
        operator_requests: mean(2),
        replans: mean(3),
    }
}
