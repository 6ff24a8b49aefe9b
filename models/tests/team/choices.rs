//! Which of several is taken when they are alike, and what counts to the last.

use cotama_models::team::instance::{Instance, Verdict};
use cotama_models::team::{
    Action, ActionPlan, Bid, Capability, Constraint, Probability, Reliability, Robot, Role, Skill,
    by_reliability, capable,
};
use std::cmp::Ordering;

/// Two capabilities, the first of which works every second time.
fn half_and_sure() -> [Skill; 2] {
    let [half, sure] = [0, 1].map(|it| Capability::new(it).unwrap());
    [Skill { capability: half, reliability: Reliability::Permille(500) }, Skill::certain(sure)]
}

#[test]
fn a_capability_that_always_failed_is_not_there() {
    let uses = |succeeded, failed| Reliability::Uses { succeeded, failed }.is_there();
    assert_eq!([uses(0, 0), uses(0, 1), uses(1, 0), uses(1, 9)], [true, false, true, true]);
}

#[test]
fn of_two_coalitions_that_are_alike_the_smaller_is_preferred() {
    let of = |list: &[u16]| list.iter().map(|it| Probability::permille(*it).unwrap()).collect();
    let (mut pair, mut three): (Vec<_>, Vec<_>) = (of(&[900, 950]), of(&[900, 990, 950]));
    assert_eq!(by_reliability(&mut pair, &mut three), Ordering::Greater);
    assert_eq!(by_reliability(&mut three, &mut pair), Ordering::Less);
}

/// Both are needed, in either order: the plan works as often as the worse one.
#[test]
fn all_parts_of_a_constraint_must_succeed() {
    let skills = half_and_sure();
    let robot = Robot { name: "it", skills: &skills };
    for order in [[0, 1], [1, 0]] {
        let parts = order.map(|it| Constraint::Has(skills[it].capability));
        let actions = [Action { name: "both", needs: Constraint::All(&parts) }];
        let plan = ActionPlan { name: "both", actions: &actions };
        let bid = Bid::for_plan(&robot, &plan, |_| 100, |_, _| 0).unwrap();
        assert_eq!(bid.success, Probability::permille(500).unwrap(), "{order:?}");
    }
}

/// The robot has what the first way to fill a role needs, and not what the last one does.
#[test]
fn any_of_several_action_plans_fills_a_role() {
    let [has, lacks] = [0, 1].map(|it| Capability::new(it).unwrap());
    let skills = [Skill::certain(has)];
    let robot = Robot { name: "it", skills: &skills };
    let actions = [has, lacks].map(|it| [Action { name: "do", needs: Constraint::Has(it) }]);
    let ways = actions.each_ref().map(|it| ActionPlan { name: "way", actions: it });
    for ways in [ways, [ways[1], ways[0]]] {
        let roles = [Role { name: "role", plans: &ways }];
        let able = capable(&roles, &[robot]).unwrap();
        assert!(able.union && able.roles && able.matching);
    }
}

fn instance(kind: &str, robots: usize, task: &str) -> Result<Instance, String> {
    let names: Vec<_> = (0..robots).map(|it| format!("\"r{it}\"")).collect();
    let text = format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"it\", \"kind\": \"{kind}\", \
         \"cost_denominator\": 2, \"robots\": [{}], \"tasks\": [{{\"name\": \"t\", {task}}}]}}",
        names.join(", ")
    );
    Instance::parse("it.json", &text).map_err(|it| it.to_string())
}

/// Two robots for 4 each, 4 in the mean, or one alone for 4: the second plan has fewer roles.
#[test]
fn of_plans_that_cost_the_same_the_one_with_fewer_roles_is_taken() {
    let roles = |names: &[&str]| {
        let role = |it: &&str| format!("{{\"name\": \"{it}\", \"cost\": [4, 4]}}");
        names.iter().map(role).collect::<Vec<_>>().join(", ")
    };
    let plan =
        |name, names: &[&str]| format!("{{\"name\": \"{name}\", \"roles\": [{}]}}", roles(names));
    let both = [plan("pair", &["left", "right"]), plan("alone", &["all"])];
    for (order, taken) in [([0, 1], 1), ([1, 0], 0)] {
        let plans = order.map(|it: usize| both[it].clone()).join(", ");
        let task = format!("\"skip_cost\": null, \"combine\": \"mean\", \"plans\": [{plans}]");
        let answer = instance("coalition-mean", 2, &task).unwrap().solve(1).unwrap();
        assert_eq!(answer.verdict, Verdict::Optimal { cost: 8 });
        assert_eq!(answer.done[0].plan, taken);
    }
}

/// The cost of a plan besides its robots counts in the bound of an instance that is too large.
#[test]
fn the_bound_of_a_too_large_instance_has_the_extra_cost_of_plans() {
    let costs = (0..200).map(|it| (it + 5).to_string()).collect::<Vec<_>>().join(", ");
    let task = format!(
        "\"skip_cost\": null, \"combine\": \"mean\", \"plans\": [{{\"name\": \"p\", \
         \"extra_cost\": 7, \"roles\": [{{\"name\": \"r\", \"cost\": [{costs}]}}]}}]"
    );
    let answer = instance("simultaneous", 200, &task).unwrap().solve(1_000).unwrap();
    assert_eq!(answer.verdict, Verdict::Unknown { cost: None, bound: 2 * (5 + 7) });
}

#[test]
fn a_cost_is_a_thousand_millions_at_most() {
    let cost = |it: &str| {
        instance("single", 1, &format!("\"skip_cost\": null, \"cost\": [{it}]"))
            .map(|it| it.solve(1).unwrap().cost())
    };
    assert_eq!(cost("1000000000"), Ok(Some(2_000_000_000)));
    assert_eq!(cost("0"), Ok(Some(0)));
    assert!(cost("1000000001").unwrap_err().contains("`1000000001` is out of range"));
}
