//! Findings in trees that people use, each with a run that the executor repeats.

use crate::folder::{folder, load, real};
use cotama_trees::explore::Limits;
use cotama_trees::findings::{Level, Report, Wishes, check};
use cotama_trees::replay::frames;
use cotama_trees::tree::Tree;

const WITH_RECOVERIES: [&str; 7] = [
    "nav_to_pose_with_consistent_replanning_and_if_path_becomes_invalid",
    "navigate_on_route_graph_w_recovery",
    "navigate_through_poses_w_replanning_and_recovery",
    "navigate_to_pose_w_replanning_and_recovery",
    "navigate_to_pose_w_replanning_goal_patience_and_recovery",
    "navigate_w_recovery_and_replanning_only_if_path_becomes_invalid",
    "navigate_w_routing_global_planning_and_control_w_recovery",
];

/// Returns the report about a tree; each run of it was repeated.
fn report(tree: &Tree, wishes: &Wishes) -> Report {
    let report = check(tree, wishes, Limits::default());
    for it in &report.findings {
        if let Some(run) = &it.run {
            let told = frames(tree, run);
            assert_eq!(told.map(|it| it.len()), Ok(run.steps.len()), "{}", it.message);
        }
    }
    report
}

fn said(report: &Report, level: Level) -> Vec<(&str, Option<usize>)> {
    let all = report.findings.iter().filter(|it| it.level == level);
    all.map(|it| (it.message.as_str(), it.run.as_ref().map(|it| it.steps.len()))).collect()
}

#[test]
fn seven_shipped_trees_lose_the_success_of_backup_and_never_see_a_new_goal() {
    let Some(folder) = folder() else { return };
    for name in WITH_RECOVERIES {
        let path = folder.join(format!("trees/nav2/{name}.xml"));
        let tree = load(&path, &real(&folder, None)).unwrap().tree;
        let report = report(&tree, &Wishes::default());
        let all = said(&report, Level::Warning);
        let has = |begin: &str, end: &str| {
            all.iter().any(|it| it.0.starts_with(begin) && it.0.ends_with(end))
        };
        assert!(has("SUCCESS of BackUp", "is lost: RecoveryActions answers FAILURE"), "{name}");
        assert!(has("GoalUpdated", "never answers SUCCESS"), "{name}");
    }
}

#[test]
fn no_success_is_lost_when_the_round_wraps_around() {
    let Some(folder) = folder() else { return };
    for name in WITH_RECOVERIES {
        let path = folder.join(format!("trees/nav2/{name}.xml"));
        let wraps = |bytes: Vec<u8>| {
            let text = String::from_utf8(bytes).unwrap();
            text.replace("<RoundRobin ", "<RoundRobin wrap_around=\"true\" ").into_bytes()
        };
        let mut files = |path: &str| std::fs::read(path).map(wraps).map_err(|it| it.to_string());
        let options = real(&folder, None);
        let loaded = cotama_trees::reader::read(path.to_str().unwrap(), &mut files, &options);
        let report = report(&loaded.unwrap().tree, &Wishes::default());
        assert_eq!(report.facts.success_lost, [], "{name}");
    }
}

#[test]
fn two_actions_together_are_an_error_where_that_is_forbidden() {
    let Some(folder) = folder() else { return };
    let name = "navigate_to_pose_w_replanning_goal_patience_and_recovery";
    let path = folder.join(format!("trees/nav2/{name}.xml"));
    let tree = load(&path, &real(&folder, None)).unwrap().tree;
    let exclusive = ["Wait", "BackUpRecovery"].map(|it| tree.find(it).unwrap()).to_vec();
    let report = report(&tree, &Wishes { exclusive, ..Wishes::default() });
    let errors = said(&report, Level::Error);
    assert!(errors.contains(&("Wait runs beside BackUpRecovery", Some(3))), "{errors:?}");
}

#[test]
fn docking_restarts_three_actions_and_services_that_fail_spin() {
    let Some(folder) = folder() else { return };
    let of = |name: &str| {
        let tree = load(&folder.join("trees").join(name), &real(&folder, None)).unwrap().tree;
        report(&tree, &Wishes::default())
    };
    let docking = of("as2fm/uc1_docking.xml");
    assert_eq!(docking.facts.restarted.len(), 3);
    assert!(of("suave/suave.xml").facts.spins);
    let smoke = of("forester/nav2_smoke.xml");
    let errors = said(&smoke, Level::Error);
    assert!(errors[0].0.starts_with("an exception is thrown in"), "{errors:?}");
}

#[test]
fn wrong_files_that_load_have_their_verdict() {
    let Some(folder) = folder() else { return };
    for (name, question) in [
        ("script_unknown_entry", "exception"),
        ("guard_unknown_entry", "exception"),
        ("guard_integer", "exception"),
        ("skipped_condition", "exception"),
        ("skipped_if", "exception"),
        ("skip_nonblocking", "exception"),
        ("onhalted_throws", "halt-exception"),
        ("endless_in_tick", "spins"),
    ] {
        let path = folder.join(format!("broken/{name}.xml"));
        let tree = load(&path, &Default::default()).unwrap().tree;
        let report = report(&tree, &Wishes::default());
        let found = report.findings.iter().any(|it| it.question == question);
        assert!(found, "{name}: {:?}", report.findings);
    }
}
