//! A campaign over a team: strategies, shrinking and requirements are those of missions.

use cotama_campaign::findings::Findings;
use cotama_campaign::results::Tally;
use cotama_campaign::run::{Campaign, Settings};
use cotama_campaign::space::{Kind, Rates, Space};
use cotama_campaign::strategy::StrategyName;
use cotama_campaign::subject::Subject;
use cotama_models::team::scenario::Scenario;
use cotama_sim::fleet::Planted;
use cotama_sim::fleet::scenarios::{FleetOptions, fleet};

/// Six robots with eight deliveries, over a network that loses so many of a thousand messages.
fn team(loss_permille: u16) -> Scenario {
    let options = FleetOptions { robots: 6, tasks: 8, failures: 0, ..FleetOptions::default() };
    fleet(&FleetOptions { loss_permille, ..options })
}

/// Faults after which a robot goes on by itself. A collision is none: its flag may as well mean
/// that odometry has drifted, and then the robot asks.
const LESSER: [&str; 3] = ["HUM1", "P3D2", "COM2"];

/// A campaign of 300 runs: how many fail, and the causes.
fn found(
    team: &Scenario,
    planted: Option<Planted>,
    requirement: &str,
    strategy: StrategyName,
) -> (u64, Findings) {
    let requirements = [requirement.parse().unwrap()].into();
    let settings = Settings { runs: 300, requirements, strategy, ..Settings::new(false) };
    let mut space = Space::of_team(team, Rates::Even, 1..=3);
    if requirement == "completed" {
        let lesser = |it: Kind| match it {
            Kind::Robot { mode, .. } => LESSER.contains(&mode.name()),
            _ => true,
        };
        space.kinds.retain(|it| lesser(it.kind));
    }
    let subject = Subject::of_team(team.clone(), planted);
    let campaign = Campaign::within(subject, settings, space).unwrap();
    let mut tally = Tally::default();
    for line in campaign.block(0) {
        tally.add(&line, &serde_json::to_string(&line).unwrap());
    }
    let found = Findings::of(&campaign.subject, &campaign.settings.requirements, &tally, 3);
    (tally.failing, found)
}

#[test]
fn a_campaign_finds_three_defects_of_a_team_and_makes_each_small() {
    for (planted, team, requirement) in [
        (Planted::NoDeadline, team(50), "not-failed"),
        (Planted::NoLease, team(500), "not-failed"),
        (Planted::SaysOnce, team(200), "completed"),
    ] {
        let (failing, found) = found(&team, Some(planted), requirement, StrategyName::Uniform);
        assert!(failing >= 10, "{planted:?}: {failing}");
        for it in &found.clusters {
            let lines = it.scenario.lines().take_while(|it| *it != "[expected]");
            let lines = lines.filter(|it| !it.is_empty() && !it.starts_with('#')).count();
            assert!(lines <= 10, "{planted:?}:\n{}", it.scenario);
        }
        let sound = self::found(&team, None, requirement, StrategyName::Uniform);
        assert_eq!(sound.0, 0, "{planted:?}: {:?}", sound.1.clusters);
    }
}

#[test]
fn no_strategy_finds_a_task_that_is_neither_done_nor_reported() {
    for strategy in StrategyName::ALL {
        assert_eq!(found(&team(50), None, "not-failed", strategy).0, 0, "{strategy:?}");
    }
}
