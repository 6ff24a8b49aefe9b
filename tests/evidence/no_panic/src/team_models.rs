//! The roots of what robots can do together: capabilities, constraints, bids, errors.
//!
//! Robots and plans come as their caller can make them at worst: of any length, any depth, with
//! any costs.

use core::cmp::Ordering;
use cotama_models::team::{
    ActionPlan, Alternatives, Bid, Capability, CapabilitySet, Capable, Constraint, ErrorClass,
    MAX_PRUNED, Pledge, Probability, Ratio, Reliability, Robot, Role, Skill, Step, Used,
    by_reliability, capable, classify, failure_aware_cost, failure_cost, mutual_heterogeneity,
    team_heterogeneity,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_failure_cost(costs: &[u32]) -> Option<Ratio> {
    failure_cost(costs.iter().copied())
}

#[unsafe(no_mangle)]
fn root_failure_aware_cost(steps: &[Step]) -> Option<Ratio> {
    failure_aware_cost(steps)
}

#[unsafe(no_mangle)]
fn root_bid_for_plan(
    robot: &Robot<'_>,
    plan: &ActionPlan<'_>,
    costs: &[u32],
    surcharge: u32,
) -> Option<Bid> {
    let cost = |place: usize| costs.get(place).copied().unwrap_or(u32::MAX);
    Bid::for_plan(robot, plan, cost, |_, _| surcharge)
}

#[unsafe(no_mangle)]
fn root_bid_for_role(robot: &Robot<'_>, role: &Role<'_>, costs: &[u32]) -> Option<Bid> {
    let cost = |_, place: usize| costs.get(place).copied().unwrap_or(u32::MAX);
    Bid::for_role(robot, role, cost)
}

#[unsafe(no_mangle)]
fn root_bid_price(bid: &Bid) -> u64 {
    bid.price()
}

#[unsafe(no_mangle)]
fn root_pledge(cost: u64, second: Option<u64>, slack_permille: u32, pledge: Pledge) -> bool {
    pledge.is_kept(Pledge::of(cost, second, slack_permille).most)
}

#[unsafe(no_mangle)]
fn root_capability(number: u8, any: Capability) -> (Option<Capability>, u8, Skill) {
    (Capability::new(number), any.number(), Skill::certain(any))
}

#[unsafe(no_mangle)]
fn root_capabilities_made(
    list: &[Capability],
    one: Capability,
    bits: u32,
    other: CapabilitySet,
) -> [CapabilitySet; 5] {
    let (of, set) = (CapabilitySet::of(list), CapabilitySet::from_bits(bits));
    [of, set.with(one), set.without(other), set.and(other), set.difference(other)]
}

#[unsafe(no_mangle)]
fn root_capabilities_read(
    set: CapabilitySet,
    one: Capability,
    other: CapabilitySet,
) -> ([bool; 3], [u32; 2]) {
    ([set.has(one), set.has_all(other), set.is_empty()], [set.len(), set.bits()])
}

#[unsafe(no_mangle)]
fn root_robot_read(robot: &Robot<'_>, of: Capability) -> (CapabilitySet, Option<Probability>) {
    (robot.capabilities(), robot.reliability(of))
}

#[unsafe(no_mangle)]
fn root_constraint_holds(constraint: &Constraint<'_>, set: CapabilitySet) -> bool {
    constraint.holds(set)
}

#[unsafe(no_mangle)]
fn root_constraint_used(
    constraint: &Constraint<'_>,
    robot: &Robot<'_>,
    surcharges: &[u64],
    failure: Ratio,
) -> Option<Used> {
    let surcharge =
        |it: Capability| surcharges.get(usize::from(it.number())).copied().unwrap_or(u64::MAX);
    constraint.used(robot, &surcharge, failure)
}

#[unsafe(no_mangle)]
fn root_constraint_alternatives(constraint: &Constraint<'_>) -> Option<Alternatives<MAX_PRUNED>> {
    constraint.alternatives()
}

#[unsafe(no_mangle)]
fn root_alternatives_read(of: &Alternatives<MAX_PRUNED>) -> (Option<&u64>, Option<CapabilitySet>) {
    (of.bits().last(), of.iter().last())
}

#[unsafe(no_mangle)]
fn root_error_class(
    estimate: Option<u64>,
    pledge: Pledge,
    others: bool,
    repeats: [u32; 2],
    any: ErrorClass,
) -> (ErrorClass, &'static str) {
    (classify(estimate, pledge, others, repeats[0], repeats[1]), any.name())
}

#[unsafe(no_mangle)]
fn root_mutual_heterogeneity(one: CapabilitySet, other: CapabilitySet) -> Ratio {
    mutual_heterogeneity(one, other)
}

#[unsafe(no_mangle)]
fn root_team_heterogeneity(robots: &[Robot<'_>]) -> Option<Ratio> {
    team_heterogeneity(robots)
}

#[unsafe(no_mangle)]
fn root_capable(roles: &[Role<'_>], robots: &[Robot<'_>]) -> Option<Capable> {
    capable(roles, robots)
}

#[unsafe(no_mangle)]
fn root_ratio(numerator: u128, denominator: u128, any: Ratio) -> (Option<Ratio>, [u128; 2], u64) {
    let new = Ratio::new(numerator, denominator);
    (new, [any.numerator(), any.denominator()], any.rounded_up())
}

#[unsafe(no_mangle)]
fn root_ratio_order(one: Ratio, other: Ratio) -> Ordering {
    one.cmp(&other)
}

#[unsafe(no_mangle)]
fn root_probability_new(permille: u16, parts: u32) -> [Option<Probability>; 2] {
    [Probability::permille(permille), Probability::new(parts)]
}

#[unsafe(no_mangle)]
fn root_probability_read(one: Probability, other: Probability) -> (Probability, [u32; 2]) {
    (one.and(other), [one.parts(), one.failing()])
}

#[unsafe(no_mangle)]
fn root_reliability(of: Reliability, success: bool) -> (Reliability, bool, Probability) {
    (of.after(success), of.is_there(), of.probability())
}

#[unsafe(no_mangle)]
fn root_by_reliability(one: &mut [Probability], other: &mut [Probability]) -> Ordering {
    by_reliability(one, other)
}

#[unsafe(no_mangle)]
fn root_possible(plan: &ActionPlan<'_>, role: &Role<'_>, set: CapabilitySet) -> [bool; 2] {
    [plan.possible(set), role.possible(set)]
}
