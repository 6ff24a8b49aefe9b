//! Skills that fail: what is repeated, what is learned of it, and who gets the tasks.

use crate::fleet::allocate::Allocator;
use crate::fleet::bid::Offer;
use crate::fleet::record::{Fate, Record};
use crate::fleet::scenarios::{FleetOptions, Worst, fleet, worst};
use crate::fleet::skills::Skills;
use crate::fleet::trace::{Trace, replay};
use crate::fleet::{run, run_recorded};
use crate::streams::Streams;
use cotama_core::team::Combine;
use cotama_models::team::scenario::{
    FailureRates, Fault, FaultKind, FaultTime, Floor, Give, Needs, Place, PlanSpec, RobotSpec,
    RoleSpec, Scenario, Stage, Stay, Take, TaskSpec, Trust, usual,
};
use cotama_models::team::service::{GRASP_2F, MOVE};
use cotama_models::team::{CapabilitySet, Probability, Reliability, Skill};

const TESTED: Reliability = Reliability::Uses { succeeded: 10, failed: 0 };

/// A robot whose gripper fails so often, and what is known of it.
fn robot(name: &str, start: usize, fails: u16, known: Reliability) -> RobotSpec {
    let grasps = Skill { capability: GRASP_2F, reliability: known };
    RobotSpec {
        name: name.into(),
        file: usual(),
        skills: vec![Skill::certain(MOVE), grasps],
        fails: FailureRates::NONE.with(GRASP_2F, fails),
        start: Place(start),
        stay: Stay::default(),
        supply: None,
    }
}

/// The near robot stands where things are taken and given, one after the other; the far one stands
/// a metre and a half away, and its gripper never fails.
fn near_and_far(tasks: usize, fails: u16, known: Reliability) -> Scenario {
    let needs = [[MOVE], [GRASP_2F], [MOVE], [GRASP_2F]].map(|it| Needs::all(&it)).to_vec();
    let role = RoleSpec {
        name: "carry".into(),
        actions: needs,
        take: Take::Object,
        give: Give::Goal,
        take_ms: 20_000,
        give_ms: 20_000,
    };
    let task = |number: usize| TaskSpec {
        name: format!("t{number}"),
        arrival_ms: 300_000 * number as u64,
        after: None,
        start: Place(0),
        goal: Place(0),
        utility_ms: 1_800_000,
        combine: Combine::Sum,
        plans: vec![PlanSpec { name: "carry".into(), extra_ms: 0, roles: vec![role.clone()] }],
    };
    Scenario {
        name: "near and far".into(),
        floor: Floor::new(&["here", "there"], &[(0, 1, 1_500)]),
        robots: vec![robot("near", 0, fails, known), robot("far", 1, 0, Reliability::CERTAIN)],
        tasks: (0..tasks).map(task).collect(),
        slack_permille: 3_000,
        ..worst(Worst::Singles, 1)
    }
}

/// The robots of the awards, in their order, with the probability that each promised.
fn awards(records: &[Record]) -> Vec<(usize, Option<u32>)> {
    let award = |it: &Record| match it {
        Record::Awarded { robots, success, .. } => Some((robots[0], success.first().copied())),
        _ => None,
    };
    records.iter().filter_map(award).collect()
}

#[test]
fn a_gripper_that_fails_one_time_in_five_loses_the_bids_that_it_should() {
    let certain = Scenario { trust: Trust::Certain, ..near_and_far(40, 200, TESTED) };
    let learned = Scenario { trust: Trust::Learned, ..certain.clone() };
    let known = Scenario { trust: Trust::Known, ..certain.clone() };
    let winners = |scenario: &Scenario| {
        let (run, records) = run_recorded(scenario);
        assert!(run.is_sound(), "{run:?}");
        awards(&records).iter().map(|it| it.0).collect::<Vec<_>>()
    };
    // Whoever takes it as certain keeps it, whoever knows the truth never takes it.
    assert_eq!(winners(&certain), [0; 40]);
    assert_eq!(winners(&known), [1; 40]);
    // With ten good uses before it, it takes some uses to see: how many tasks it wins before the
    // other robot has all, how often it used its gripper for them, how often that failed.
    let seen = (0..20).map(|seed| {
        let (run, records) = run_recorded(&Scenario { seed, ..learned.clone() });
        assert!(run.is_sound(), "{run:?}");
        let winners: Vec<usize> = awards(&records).iter().map(|it| it.0).collect();
        let won = winners.iter().filter(|it| **it == 0).count();
        assert!(winners.is_sorted(), "{winners:?}");
        assert_eq!(run.undue.len(), won);
        (won, run.skills[0].uses, run.skills[0].failed)
    });
    let mut seen: Vec<_> = seen.collect();
    let expected = [
        (24, 54, 6),
        (10, 24, 4),
        (2, 8, 4),
        (3, 9, 3),
        (5, 13, 3),
        (2, 6, 2),
        (11, 27, 5),
        (6, 15, 3),
        (7, 18, 4),
        (3, 10, 5),
        (1, 4, 2),
        (8, 19, 3),
        (13, 30, 4),
        (4, 10, 2),
        (13, 32, 6),
        (3, 8, 2),
        (3, 8, 2),
        (3, 8, 2),
        (9, 21, 3),
        (6, 16, 4),
    ];
    assert_eq!(seen, expected);
    seen.sort_by_key(|it| it.1);
    assert_eq!((seen[0].1, seen[9].1, seen[19].1), (4, 13, 54), "uses before all bids are lost");
}

/// Each use has its outcome, whatever was learned and whoever else has won: seeds are paired.
#[test]
fn the_use_of_a_number_fails_or_not_whatever_is_learned() {
    let scenario = fleet(&FleetOptions {
        robots: 4,
        tasks: 20,
        failures: 0,
        gripper_fails_permille: 300,
        ..FleetOptions::default()
    });
    let numbers = |trust| {
        let (run, records) = run_recorded(&Scenario { trust, ..scenario.clone() });
        let number = |it: &Record| match it {
            Record::Failed { robot: 0, number, .. } => Some(*number),
            _ => None,
        };
        (run.skills[0].uses, records.iter().filter_map(number).collect::<Vec<_>>())
    };
    let [(one, certain), (other, learned)] = [Trust::Certain, Trust::Learned].map(numbers);
    let both = one.min(other);
    let first = |all: &[u32]| all.iter().copied().filter(|it| *it <= both).collect::<Vec<_>>();
    assert!(!certain.is_empty());
    assert_eq!(first(&certain), first(&learned));
}

#[test]
fn a_failed_use_is_tried_again_for_the_time_of_the_action_and_counts_once() {
    // A seed in which the first use fails, and the two after it do not.
    let base = near_and_far(1, 500, TESTED);
    let fails = |seed: u64| {
        let mut skills =
            Skills::new(&base.robots[0], &base.skills, Trust::Learned, Streams::new(seed));
        [0; 3].map(|_| skills.act(&base.tasks[0].plans[0].roles[0].actions[1..2]).is_err())
    };
    let seed = (0..100).find(|it| fails(*it) == [true, false, false]).unwrap();
    let scenario = Scenario { seed, ..base.clone() };
    let (failing, records) = run_recorded(&scenario);
    let never = run(&Scenario { seed, ..near_and_far(1, 0, TESTED) });
    assert_eq!((failing.failed_uses, failing.skills[0].uses, failing.skills[0].failed), (1, 3, 1));
    assert_eq!(failing.end_ms - never.end_ms, 20_000);
    assert_eq!(failing.skills[0].reliability, 923_076_923); // 12 of 13
    let errors = records.iter().filter_map(|it| match it {
        Record::Error { class, why, .. } => Some((class.name(), why.as_str())),
        _ => None,
    });
    assert!(errors.eq([("recoverable", "grasp-2f fails, and tries again")]));
    // A cup that is shifted is no fault of the gripper.
    let mut shifted = Scenario { seed, ..near_and_far(1, 0, TESTED) };
    let (robot, task, stage, time, after_ms) = (0, 0, Stage::Takes, 1, 5_000);
    let when = FaultTime::During { robot, task, stage, time, after_ms };
    shifted.faults.push(Fault { when, what: FaultKind::Shifted(0) });
    let shifted = run(&shifted);
    assert_eq!((shifted.skills[0].uses, shifted.skills[0].failed), (2, 0));
    assert!(shifted.end_ms > never.end_ms);
}

#[test]
fn a_skill_that_always_fails_is_reported_and_one_that_never_worked_is_none() {
    // Four failures in a row are too many, for who takes it as certain.
    let hopeless = Scenario { trust: Trust::Certain, ..near_and_far(1, 1_000, TESTED) };
    let run_certain = run(&hopeless);
    assert_eq!((run_certain.fates[0], run_certain.failed_uses), (Fate::Reported, 4));
    // Without a use before it, one failure is all that is known (def. 3.6): the other robot goes.
    let fresh = Reliability::Uses { succeeded: 0, failed: 0 };
    let (run, records) = run_recorded(&near_and_far(1, 1_000, fresh));
    assert_eq!((run.fates[0], run.failed_uses), (Fate::Done, 1));
    assert_eq!(awards(&records).iter().map(|it| it.0).collect::<Vec<_>>(), [0, 1]);
}

/// Two skills of one action: the first that fails ends it, and those behind it are not used.
#[test]
fn a_skill_does_not_count_the_failure_of_another_one() {
    let uses = Reliability::Uses { succeeded: 0, failed: 0 };
    let skill = |capability| Skill { capability, reliability: uses };
    let spec = RobotSpec {
        skills: vec![skill(MOVE), skill(GRASP_2F)],
        fails: FailureRates::NONE.with(MOVE, 1_000),
        ..robot("r", 0, 0, uses)
    };
    let names = ["move", "detect", "grasp-2f"].map(str::to_owned);
    let mut skills = Skills::new(&spec, &names, Trust::Learned, Streams::new(0));
    let action = [Needs(vec![CapabilitySet::of(&[MOVE]), CapabilitySet::of(&[GRASP_2F])])];
    assert!(skills.act(&action).is_err());
    let seen: Vec<_> = skills.used().map(|it| (it.0, it.1, it.2)).collect();
    assert_eq!(seen, [(MOVE, 1, 1), (GRASP_2F, 0, 0)]);
    assert!(!skills.capabilities().has(MOVE) && skills.capabilities().has(GRASP_2F));
}

/// Fleets in which a gripper fails at any rate keep all that holds of every run, and their traces
/// are replayed record by record.
#[test]
fn fleets_whose_grippers_fail_are_sound_and_replayed() {
    for (seed, rate) in [100, 500, 900, 1_000].into_iter().enumerate() {
        for trust in Trust::ALL {
            let options = FleetOptions {
                robots: 5,
                tasks: 12,
                failures: 1,
                gripper_fails_permille: rate,
                seed: seed as u64,
                ..FleetOptions::default()
            };
            let trace = Trace::of(&Scenario { trust, ..fleet(&options) });
            assert!(trace.run().is_sound(), "{options:?}: {:?}", trace.run());
            let read = Trace::parse("t.jsonl", &trace.to_json_lines()).unwrap();
            assert_eq!(replay(&read).unwrap(), (trace, None));
        }
    }
}

/// Of equal costs the coalition is taken whose least reliable member is more reliable (4.5.4).
#[test]
fn of_coalitions_of_equal_cost_the_more_reliable_one_is_taken() {
    let scenario = worst(Worst::Together, 2);
    let offers = |success: [u16; 2]| {
        let offer = |(role, permille): (usize, u16)| Offer {
            task: 0,
            plan: 0,
            role,
            cost_ms: 1_000,
            success: Probability::permille(permille).unwrap(),
            known_ms: 1_000,
        };
        [(0, success[0]), (1, success[1])].map(offer)
    };
    // By robot: how reliable it is in each role.
    let all = [offers([700, 600]), offers([900, 950]), offers([990, 800]), offers([999, 650])];
    let bids: Vec<(usize, &[Offer])> = all.iter().enumerate().map(|it| (it.0, &it.1[..])).collect();
    let chosen = Allocator::default().choose(&scenario, &[0], &[0], &bids);
    let robots: Vec<usize> = chosen[0].robots.iter().map(|it| it.robot).collect();
    // The third robot, 990, and the second, 950; the fourth, 999, would have the same partner and
    // more: 950 decides between both, then 999 over 990.
    assert_eq!(robots, [3, 1]);
    let cost = chosen[0].cost;
    let certain: Vec<_> =
        all.map(|it| it.map(|it| Offer { success: Probability::ONE, ..it })).into_iter().collect();
    let bids: Vec<(usize, &[Offer])> =
        certain.iter().enumerate().map(|it| (it.0, &it.1[..])).collect();
    let first = Allocator::default().choose(&scenario, &[0], &[0], &bids);
    assert_eq!(first[0].cost, cost, "reliability decides only where costs are equal");
}
