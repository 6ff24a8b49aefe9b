//! Drawn capabilities, plans, bids and errors of a team.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::{below, chance, pick};
use cotama_models::team::{
    Action, ActionPlan, Bid, Capability, CapabilitySet, Constraint, Pledge, Probability, Ratio,
    Reliability, Robot, Role, Skill, Step, TaskPlan, by_reliability, capable, classify,
    failure_aware_cost, failure_cost, mutual_heterogeneity, team_heterogeneity,
};

/// A constraint of these capabilities; its parts are never given back.
fn constraint(draw: &mut Draw, kinds: u64, depth: u32) -> Constraint<'static> {
    let parts = |draw: &mut Draw| -> &'static [Constraint<'static>] {
        let count = draw.between(0, 3);
        (0..count).map(|_| constraint(draw, kinds, depth - 1)).collect::<Vec<_>>().leak()
    };
    match draw.between(0, 3) {
        0 if depth > 0 => Constraint::All(parts(draw)),
        1 if depth > 0 => Constraint::Any(parts(draw)),
        _ => Constraint::Has(Capability::new(draw.between(0, kinds - 1) as u8).unwrap()),
    }
}

fn set(draw: &mut Draw, kinds: u64) -> CapabilitySet {
    CapabilitySet::from_bits(((draw.bits() | draw.bits()) & ((1 << kinds) - 1)) as u32)
}

fn probability(draw: &mut Draw) -> Probability {
    Probability::permille(*pick(
        draw,
        &[0, 1, 500, 800, 999, 1_000, draw.clone().between(0, 1_000) as u16],
    ))
    .unwrap()
}

fn skills(draw: &mut Draw, set: CapabilitySet) -> Vec<Skill> {
    let all = (0..Capability::COUNT).filter_map(Capability::new);
    all.filter(|it| set.has(*it))
        .map(|capability| {
            let reliability = Reliability::Permille(draw.between(0, 1_000) as u16);
            let sure = chance(draw, 30);
            if sure { Skill::certain(capability) } else { Skill { capability, reliability } }
        })
        .collect()
}

#[test]
fn drawn_sets_and_constraints_hold_and_cost_the_same() {
    let (mut draw, mut effort) = (Draw::new(121), Effort::new(500));
    for _ in 0..5_000 {
        let kinds = [4, 6, 32][below(&mut draw, 3)];
        let (a, b) = (set(&mut draw, kinds), set(&mut draw, kinds));
        let one = Capability::new(draw.between(0, kinds - 1) as u8).unwrap();
        effort.note(&(a, b, a.and(b), a.without(b), a.difference(b), a.with(one), a.has(one)));
        effort.note(&(a.has_all(b), a.len(), a.is_empty(), a.bits(), one.number()));
        effort.note(&(mutual_heterogeneity(a, b), CapabilitySet::of(&[one, one])));
        let needs = constraint(&mut draw, kinds, 3);
        let skills = skills(&mut draw, a);
        let robot = Robot { name: "robot", skills: &skills };
        effort.count("holds", u64::from(needs.holds(a)));
        effort.note(&(needs, needs.holds(a), robot.capabilities(), robot.reliability(one)));
        let (surcharge, failure) = (draw.between(0, 50), draw.between(0, 900));
        let more = |it: Capability| u64::from(it.number()) * surcharge;
        let failure = Ratio::new(failure.into(), 7).unwrap();
        effort.note(&needs.used(&robot, &more, failure));
        let few = needs.alternatives::<4>().map(|it| (it.bits().to_vec(), it.iter().count()));
        let many = needs.alternatives::<64>().map(|it| it.iter().collect::<Vec<_>>());
        effort.note(&(few, many));
        effort.next();
    }
    effort.compare("tests/golden/changed_constraints.txt");
}

#[test]
fn drawn_costs_bids_and_errors_are_the_same() {
    let (mut draw, mut effort) = (Draw::new(122), Effort::new(500));
    for _ in 0..5_000 {
        let most = [5, 1_000, u64::from(u32::MAX)][below(&mut draw, 3)];
        let longest = if chance(&mut draw, 10) { 33 } else { 6 };
        let count = draw.between(0, longest);
        let step = |draw: &mut Draw| Step {
            cost: draw.between(0, most) as u32,
            success: probability(draw),
        };
        let steps: Vec<_> = (0..count).map(|_| step(&mut draw)).collect();
        let whole = failure_aware_cost(&steps);
        effort.note(&(failure_cost(steps.iter().map(|it| it.cost)), whole));
        if let Some(it) = whole {
            effort.note(&(it.numerator(), it.denominator(), it.rounded_up(), it.to_string()));
        }
        let (a, b) = (draw.between(0, most), draw.between(0, 3));
        effort.note(&(Ratio::new(a.into(), b.into()), Ratio::from(a)));
        let (second, slack) = (draw.between(0, most), draw.between(0, 2_000) as u32);
        let pledge = Pledge::of(a, chance(&mut draw, 60).then_some(second), slack);
        let estimate = chance(&mut draw, 80).then(|| draw.between(0, most * 2));
        let class = classify(
            estimate,
            pledge,
            chance(&mut draw, 50),
            draw.between(0, 4) as u32,
            draw.between(0, 4) as u32,
        );
        effort.note(&(pledge, pledge.is_kept(second), class, class.name()));
        let mut reliability = match draw.between(0, 2) {
            0 => Reliability::Permille(draw.between(0, 1_000) as u16),
            _ => Reliability::Uses {
                succeeded: *pick(&mut draw, &[0, 1, 19, u32::MAX]),
                failed: *pick(&mut draw, &[0, 1, 3, u32::MAX]),
            },
        };
        for _ in 0..draw.between(0, 5) {
            reliability = reliability.after(chance(&mut draw, 50));
            effort.note(&(reliability, reliability.probability(), reliability.is_there()));
        }
        let (p, q) = (probability(&mut draw), probability(&mut draw));
        effort.note(&(p.and(q), p.failing(), p.parts(), Probability::new(p.parts() + 1)));
        let some = |draw: &mut Draw| -> Vec<Probability> {
            (0..draw.between(0, 4)).map(|_| probability(draw)).collect()
        };
        let (mut one, mut other) = (some(&mut draw), some(&mut draw));
        effort.note(&(by_reliability(&mut one, &mut other), one, other));
        effort.next();
    }
    effort.compare("tests/golden/changed_bids.txt");
}

#[test]
fn drawn_teams_can_do_the_same_plans() {
    let (mut draw, mut effort) = (Draw::new(123), Effort::new(200));
    for _ in 0..2_000 {
        let sets: Vec<_> = (0..draw.between(0, 6)).map(|_| set(&mut draw, 6)).collect();
        let skills: Vec<_> = sets.iter().map(|it| skills(&mut draw, *it)).collect();
        let robots: Vec<_> = skills.iter().map(|skills| Robot { name: "", skills }).collect();
        let count = draw.between(1, 5);
        let actions: Vec<Vec<Action<'_>>> = (0..count)
            .map(|_| {
                let all = draw.between(1, 3);
                let action = |draw: &mut Draw| Action { name: "", needs: constraint(draw, 6, 2) };
                (0..all).map(|_| action(&mut draw)).collect()
            })
            .collect();
        let plans: Vec<_> =
            actions.iter().map(|it| [ActionPlan { name: "", actions: it }]).collect();
        let roles: Vec<_> = plans.iter().map(|it| Role { name: "", plans: it }).collect();
        let plan = TaskPlan { name: "", roles: &roles, extra: 0 };
        let found = capable(&plan, &robots);
        effort.count("capable", u64::from(found.is_some_and(|it| it.matching)));
        effort.note(&(found, team_heterogeneity(&robots)));
        for robot in &robots {
            for role in &roles {
                let cost = draw.between(0, 500) as u32;
                let bid = Bid::for_role(robot, role, |plan, at| cost + (7 * plan + at) as u32);
                effort.note(&(role.possible(robot.capabilities()), bid, bid.map(|it| it.price())));
                let more = |at: usize, it: Capability| at as u32 * 3 + u32::from(it.number());
                effort.note(&Bid::for_plan(robot, &role.plans[0], |_| cost, more));
            }
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_capable.txt");
}
