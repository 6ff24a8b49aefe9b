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
    modes: Option<&[&str]>,
) -> (u64, Findings) {
    let requirements = [requirement.parse().unwrap()].into();
    let settings = Settings { runs: 300, requirements, strategy, ..Settings::new(false) };
    let mut space = Space::of_team(team, Rates::Even, 1..=3);
    space.kinds.retain(|it| match it.kind {
        Kind::Robot { robot, mode } => {
            let name = mode.name(team.robots[robot].file.robot());
            modes.is_none_or(|all| all.contains(&name))
        }
        _ => true,
    });
    let subject = Subject::of_team(team.clone(), planted);
    let campaign = Campaign::within(subject, settings, space).unwrap();
    let mut tally = Tally::default();
    for line in campaign.block(0) {
        tally.add(&line, &serde_json::to_string(&line).unwrap());
    }
    let found = Findings::of(&campaign.subject, &campaign.settings.requirements, &tally, 3);
    (tally.failing, found)
}

/// Failures with which a robot goes on, more slowly.
const SLOWER: [&str; 2] = ["SON2", "CAM1"];

/// A defect of which a campaign is to find something: the team, the requirement that it breaks, and
/// the failures of robots that are drawn.
type Defect = (Planted, Scenario, &'static str, Option<&'static [&'static str]>);

/// Each breaks its requirement in some of 300 runs, and shrinks to ten lines; without it none does.
fn finds(defects: Vec<Defect>, least: u64) {
    for (planted, team, requirement, modes) in defects {
        let uniform = StrategyName::Uniform;
        let (failing, found) = found(&team, Some(planted), requirement, uniform, modes);
        assert!(failing >= least, "{planted:?}: {failing}");
        for it in &found.clusters {
            let lines = it.scenario.lines().take_while(|it| *it != "[expected]");
            let lines = lines.filter(|it| !it.is_empty() && !it.starts_with('#')).count();
            assert!(lines <= 10, "{planted:?}:\n{}", it.scenario);
        }
        let sound = self::found(&team, None, requirement, uniform, modes);
        assert_eq!(sound.0, 0, "{planted:?}: {:?}", sound.1.clusters);
    }
}

#[test]
fn a_campaign_finds_three_defects_of_a_team_and_makes_each_small() {
    let defects = vec![
        (Planted::NoDeadline, team(50), "not-failed", None),
        (Planted::NoLease, team(500), "not-failed", None),
        (Planted::SaysOnce, team(200), "completed", Some(&LESSER[..])),
    ];
    finds(defects, 10);
}

/// A team of somebody's own, in a file, over a network that loses so many of a thousand messages.
fn crew(loss_permille: u16) -> Scenario {
    let mut crew = Scenario::parse("crew.toml", include_str!("crew.toml")).unwrap();
    crew.network.loss_permille = loss_permille;
    crew
}

#[test]
fn a_campaign_over_a_team_of_ones_own_finds_wrong_units_endless_leases_and_stale_reliability() {
    let defects = vec![
        (Planted::BidsInSeconds, crew(0), "put-up-again<=6", Some(&SLOWER[..])),
        (Planted::NoLease, crew(500), "not-failed", None),
        (Planted::StaleReliability, crew(0), "failed-uses<=5", Some(&LESSER[..])),
    ];
    finds(defects, 10);
}

#[test]
fn no_strategy_finds_a_task_that_is_neither_done_nor_reported() {
    for strategy in StrategyName::ALL {
        assert_eq!(found(&team(50), None, "not-failed", strategy, None).0, 0, "{strategy:?}");
    }
}
