//! Laws of capabilities, bids and errors, on random ones.

use cotama_models::team::{
    Action, ActionPlan, Bid, Capability, CapabilitySet, Constraint, ErrorClass, Pledge,
    Probability, Ratio, Reliability, Robot, Role, Skill, Step, by_reliability, capable, classify,
    failure_aware_cost, failure_cost, mutual_heterogeneity, service, team_heterogeneity,
};
use proptest::collection::vec;
use proptest::prelude::*;
use std::cmp::Ordering;

const KINDS: u8 = 6;

/// A constraint; its parts are never given back.
fn constraint() -> impl Strategy<Value = Constraint<'static>> {
    let one = (0..KINDS).prop_map(|it| Constraint::Has(Capability::new(it).unwrap()));
    one.prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            vec(inner.clone(), 0..=3).prop_map(|it| Constraint::All(it.leak())),
            vec(inner, 0..=3).prop_map(|it| Constraint::Any(it.leak())),
        ]
    })
}

fn set() -> impl Strategy<Value = CapabilitySet> {
    (0..1_u32 << KINDS).prop_map(CapabilitySet::from_bits)
}

fn skills(set: CapabilitySet) -> Vec<Skill> {
    let all = (0..Capability::COUNT).filter_map(Capability::new);
    all.filter(|it| set.has(*it)).map(Skill::certain).collect()
}

fn probability() -> impl Strategy<Value = Probability> {
    (0..=1_000_u16).prop_map(|it| Probability::permille(it).unwrap())
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let step = (0..=1_000_000_000_u32, probability());
    vec(step.prop_map(|(cost, success)| Step { cost, success }), 0..=32)
}

/// Whether some robots of their own fill the roles: all ways are tried.
fn matched(roles: &[Vec<bool>], taken: u32) -> bool {
    let [first, rest @ ..] = roles else { return true };
    let free = |at: &usize| first[*at] && taken & (1 << at) == 0;
    (0..first.len()).filter(free).any(|at| matched(rest, taken | (1 << at)))
}

proptest! {
    #[test]
    fn more_capabilities_never_break_a_constraint(it in constraint(), a in set(), b in set()) {
        prop_assert!(!it.holds(a) || it.holds(a.and(b)));
    }

    #[test]
    fn the_smallest_sets_say_the_same_as_the_constraint(it in constraint(), a in set()) {
        let Some(sets) = it.alternatives::<32>() else { return Ok(()) };
        prop_assert_eq!(sets.iter().any(|needed| a.has_all(needed)), it.holds(a));
        let all: Vec<_> = sets.iter().collect();
        for (number, one) in all.iter().enumerate() {
            for other in &all[..number] {
                prop_assert!(!one.has_all(*other) && !other.has_all(*one));
            }
        }
    }

    /// cap3 within cap2 within cap1 (3.4.2, 3.5.2.3), and cap3 is what trying all ways says.
    #[test]
    fn a_sharper_condition_lies_within_the_one_before(
        needs in vec(constraint(), 1..=4),
        sets in vec(set(), 0..=5),
    ) {
        let skills: Vec<_> = sets.iter().map(|it| skills(*it)).collect();
        let robots: Vec<_> = skills.iter().map(|skills| Robot { name: "", skills }).collect();
        let actions: Vec<_> = needs.iter().map(|it| [Action { name: "", needs: *it }]).collect();
        let plan = |actions| [ActionPlan { name: "", actions }];
        let plans: Vec<_> = actions.iter().map(|it| plan(it)).collect();
        let roles: Vec<_> = plans.iter().map(|it| Role { name: "", plans: it }).collect();
        let Some(found) = capable(&roles, &robots) else { return Ok(()) };
        let can = |it: &Constraint<'_>| sets.iter().map(|set| it.holds(*set)).collect();
        let table: Vec<Vec<bool>> = needs.iter().map(can).collect();
        prop_assert_eq!(found.matching, matched(&table, 0));
        prop_assert!(found.roles || !found.matching);
        prop_assert!(found.union || !found.roles);
    }

    /// Between the plain cost and that cost with everything repeated each time; and never more
    /// with more reliable actions.
    #[test]
    fn a_failure_aware_cost_lies_between_its_bounds(steps in steps(), better in 0..32_usize) {
        let cost = failure_aware_cost(&steps).unwrap();
        let plain: u64 = steps.iter().map(|it| u64::from(it.cost)).sum();
        prop_assert!(cost >= Ratio::from(plain));
        let worst: Vec<_> =
            steps.iter().map(|it| Step { success: Probability::ZERO, ..*it }).collect();
        prop_assert!(cost <= failure_aware_cost(&worst).unwrap());
        let sure: Vec<_> =
            steps.iter().map(|it| Step { success: Probability::ONE, ..*it }).collect();
        prop_assert_eq!(failure_aware_cost(&sure).unwrap(), Ratio::from(plain));
        let mut one = steps.clone();
        if let Some(it) = one.get_mut(better) {
            it.success = Probability::ONE;
        }
        prop_assert!(failure_aware_cost(&one).unwrap() <= cost);
        let up = cost.rounded_up();
        prop_assert!(Ratio::from(up) >= cost && (up == 0 || Ratio::from(up - 1) < cost));
    }

    /// The sum of `failure_cost` of each action, times its risk, is the whole (3.13).
    #[test]
    fn a_bid_is_the_sum_of_its_actions(steps in vec((0..1_000_u32, 0..=1_000_u16), 1..=6)) {
        let of = |it: &(u32, u16)| Step {
            cost: it.0,
            success: Probability::permille(it.1).unwrap(),
        };
        let all: Vec<_> = steps.iter().map(of).collect();
        let cost = failure_aware_cost(&all).unwrap();
        // In parts of 60 · 1,000: 60 is divisible by 1 to 6.
        let mut sum = 0_u128;
        for (at, (cost, permille)) in steps.iter().enumerate() {
            let again = failure_cost(steps[..=at].iter().map(|it| it.0)).unwrap();
            sum += 60_000 * u128::from(*cost);
            let again = again.numerator() * 60 / again.denominator();
            sum += u128::from(1_000 - permille) * again;
        }
        prop_assert_eq!(Some(cost), Ratio::new(sum, 60_000));
    }

    #[test]
    fn fractions_are_ordered_as_their_products(
        a in 0..u64::MAX, b in 1..u64::MAX, c in 0..u64::MAX, d in 1..u64::MAX,
    ) {
        let of = |a: u64, b: u64| Ratio::new(a.into(), b.into()).unwrap();
        let products = (u128::from(a) * u128::from(d)).cmp(&(u128::from(c) * u128::from(b)));
        prop_assert_eq!(of(a, b).cmp(&of(c, d)), products);
    }

    #[test]
    fn heterogeneity_is_from_0_to_1(a in set(), b in set(), more in vec(set(), 0..=6)) {
        let h = mutual_heterogeneity(a, b);
        prop_assert!(h <= Ratio::from(1));
        prop_assert_eq!(h, mutual_heterogeneity(b, a));
        prop_assert_eq!(h == Ratio::ZERO, a == b);
        let owned: Vec<_> = [a, b].into_iter().chain(more).map(skills).collect();
        let robots: Vec<_> = owned.iter().map(|skills| Robot { name: "", skills }).collect();
        let team = team_heterogeneity(&robots).unwrap();
        prop_assert!(team <= Ratio::from(1));
        prop_assert_eq!(team_heterogeneity(&robots[..2]), Some(h));
        prop_assert_eq!(team_heterogeneity(&robots[..1]), None);
    }

    /// Each error has one class; a kept pledge is never given back, and what nobody can do is
    /// never announced again.
    #[test]
    fn every_error_has_its_class(
        estimate in proptest::option::of(0..200_u64),
        most in 0..200_u64,
        others: bool,
        repeats in 0..6_u32,
    ) {
        let class = classify(estimate, Pledge { most }, others, repeats, 3);
        let kept = estimate.is_some_and(|it| it <= most);
        prop_assert_eq!(class == ErrorClass::Recoverable, kept && repeats < 3);
        prop_assert_eq!(class == ErrorClass::SemiRecoverable, !kept && others && repeats < 3);
    }

    #[test]
    fn a_pledge_is_at_least_the_cost_and_at_most_the_second_best(
        cost in 0..u64::MAX / 2, more in 0..1_000_000_u64, slack in 0..=u32::MAX,
    ) {
        let pledge = Pledge::of(cost, Some(cost + more), slack);
        prop_assert!(pledge.is_kept(cost) && pledge.most <= cost + more);
        prop_assert!(pledge <= Pledge::of(cost, None, slack));
    }

    #[test]
    fn of_two_coalitions_one_is_preferred_or_they_are_alike(
        a in vec(probability(), 0..=4), b in vec(probability(), 0..=4),
    ) {
        let (mut one, mut other) = (a.clone(), b.clone());
        let order = by_reliability(&mut one, &mut other);
        prop_assert_eq!(order, by_reliability(&mut b.clone(), &mut a.clone()).reverse());
        let least = |it: &[Probability]| it.iter().min().copied();
        if let (Some(x), Some(y)) = (least(&a), least(&b)) {
            prop_assert!(x == y || order == x.cmp(&y));
        }
        if order == Ordering::Equal {
            prop_assert_eq!(one, other);
        }
    }
}

/// The scenario's constraints are those of 3.6.1.2: who can do what.
#[test]
fn the_service_team_has_the_capabilities_of_the_thesis() {
    let able = |role: &Role<'_>| {
        let able = |it: &&Robot<'_>| role.possible(it.capabilities());
        service::ROBOTS.iter().filter(able).map(|it| it.name).collect::<Vec<_>>()
    };
    assert_eq!(able(&service::FETCH), ["eddie", "jimmy", "poppy"]);
    assert_eq!(able(&service::BRING), ["eddie"]);
    assert_eq!(able(&service::ORDER), ["eddie"]);
}

/// A robot takes the hand that costs least with what may go wrong (3.12), not the most reliable.
#[test]
fn of_alternatives_the_cheapest_with_its_risk_is_used() {
    let hands = [
        Skill { capability: service::GRASP_2F, reliability: Reliability::Permille(800) },
        Skill { capability: service::GRASP_3F, reliability: Reliability::Permille(900) },
    ];
    let robot = Robot { name: "both", skills: &hands };
    let grasp =
        Constraint::Any(&[Constraint::Has(service::GRASP_2F), Constraint::Has(service::GRASP_3F)]);
    let actions = [Action { name: "grasp", needs: grasp }];
    let plan = ActionPlan { name: "grasp", actions: &actions };
    let bid = |surcharge: u32| {
        let more = |_, it| if it == service::GRASP_3F { surcharge } else { 0 };
        Bid::for_plan(&robot, &plan, |_| 100, more).unwrap()
    };
    // 100 + 0.2 · 100 against 100 + s + 0.1 · (100 + s) later; the choice weighs s + 10 with 20.
    assert_eq!((bid(9).success, bid(9).price()), (Probability::permille(900).unwrap(), 120));
    assert_eq!((bid(11).success, bid(11).price()), (Probability::permille(800).unwrap(), 120));
}

/// A robot that cannot do one of the actions makes no bid; one that lost a capability neither.
#[test]
fn a_robot_without_the_capability_does_not_bid() {
    let role = &service::BRING;
    assert!(Bid::for_role(&service::JIMMY, role, |_, _| 10).is_none());
    let bid = Bid::for_role(&service::EDDIE, role, |_, _| 10).unwrap();
    assert_eq!((bid.price(), bid.success), (50, Probability::ONE));
    let mut lame = service::EDDIE.skills.to_vec();
    lame[0].reliability = Reliability::Permille(0);
    let lame = Robot { skills: &lame, ..service::EDDIE };
    assert!(Bid::for_role(&lame, role, |_, _| 10).is_none());
    assert_eq!(
        lame.capabilities(),
        service::EDDIE.capabilities().without(CapabilitySet::of(&[service::MOVE]))
    );
}

/// The largest bids do not overflow.
#[test]
fn the_largest_bid_is_exact() {
    let step = Step { cost: u32::MAX, success: Probability::ZERO };
    // Sum over m of c + c (1 + ... + m) / m = c (1 + (m + 1) / 2).
    let twice: u128 = (1..=32_u128).map(|m| 2 + (m + 1)).sum();
    let cost = failure_aware_cost(&[step; 32]).unwrap();
    assert_eq!(Some(cost), Ratio::new(u128::from(u32::MAX) * twice, 2));
    assert_eq!(failure_aware_cost(&[step; 33]), None);
}

#[test]
fn a_plan_has_so_many_steps_and_no_more() {
    // (1 + 2 + .. + 32) / 32
    assert_eq!(failure_cost([1; 32]), Ratio::new(33, 2));
    assert_eq!(failure_cost([1; 33]), None);
}

/// A plan without cost costs nothing when it fails: the bid is for the plan that fails less.
#[test]
fn of_bids_that_cost_the_same_the_most_reliable_is_made() {
    let [loose, firm] = [0, 1].map(|it| Capability::new(it).unwrap());
    let skills = [
        Skill { capability: loose, reliability: Reliability::Permille(500) },
        Skill::certain(firm),
    ];
    let robot = Robot { name: "two grippers", skills: &skills };
    let actions = [loose, firm].map(|it| [Action { name: "grasp", needs: Constraint::Has(it) }]);
    let plans = actions.each_ref().map(|it| ActionPlan { name: "grasp", actions: it });
    let role = Role { name: "grasp", plans: &plans };
    assert_eq!(Bid::for_role(&robot, &role, |_, _| 0).unwrap().plan, 1);
}

/// Half more than the cost, but no more than another robot asks; its own cost in any case.
#[test]
fn a_pledge_is_never_below_the_cost() {
    let most = |second| Pledge::of(100, second, 500).most;
    assert_eq!([None, Some(200), Some(120), Some(50)].map(most), [150, 150, 120, 100]);
}

#[test]
fn a_capability_has_the_number_that_it_was_made_of() {
    let numbers: Vec<_> =
        (0..=u8::MAX).filter_map(|it| Capability::new(it).map(Capability::number)).collect();
    assert_eq!(numbers, (0..32).collect::<Vec<_>>());
}
