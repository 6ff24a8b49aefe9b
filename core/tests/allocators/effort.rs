//! What it takes to find plans: steps, nodes, and all that is answered.

use crate::efforts::Effort;
use crate::instances::{Draw, Instance, Zones, paper_like, random_mission, small};
use cotama_core::allocation::{Allocator, Answer, MemoryError};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::panorama::Panorama;

/// Notes what an allocator answers.
fn answered<const A: usize>(
    effort: &mut Effort,
    answer: &Result<Answer<A>, MemoryError>,
    plan: &[u16],
) {
    effort.note(answer);
    let (kind, steps) = match answer {
        Ok(Answer::Planned(it)) if it.optimal => ("best", it.steps),
        Ok(Answer::Planned(it)) => ("planned", it.steps),
        Ok(Answer::Infeasible { steps, .. }) => ("infeasible", *steps),
        Ok(Answer::Unknown { steps, .. }) => ("unknown", *steps),
        Err(_) => ("short of memory", 0),
    };
    effort.count(kind, 1);
    effort.count("steps", steps);
    if let Ok(Answer::Planned(_)) = answer {
        effort.note(&plan);
    }
}

/// Notes the answer of the exact allocator within so many steps, with memory for so many nodes.
fn exactly<const A: usize>(
    effort: &mut Effort,
    instance: &Instance<A>,
    objectives: &[Objective],
    steps: u64,
    memory: usize,
) {
    let slices = instance.slices();
    let problem = instance.problem(&slices);
    let items = slices.iter().map(|it| it.len()).sum();
    let (mut items, mut stages) = (vec![Item::EMPTY; items], vec![Stage::EMPTY; slices.len()]);
    let (mut seen, mut plan) = (vec![Seen::EMPTY; memory], vec![0; slices.len()]);
    let answer = Exact::new(objectives, steps, &mut items, &mut stages)
        .with_memory(&mut seen)
        .allocate(&problem, &mut plan);
    answered(effort, &answer, &plan);
}

fn small_problems<const A: usize>(effort: &mut Effort, seed: u64) {
    let instance = small::<A>(seed);
    let both = [Objective::MostQuality, Objective::Least(0), Objective::Most(A - 1)];
    for objectives in [&both[..1], &both[1..2], &both[2..], &both, &[]] {
        exactly(effort, &instance, objectives, u64::MAX, 0);
    }
    for steps in [0, 1, 5, 10, 20, 30, 50, 80, 130] {
        exactly(effort, &instance, &both, steps, 8);
    }
}

#[test]
fn small_problems_take_so_many_steps_whatever_the_budget() {
    let mut effort = Effort::new(200);
    for seed in 50_000..54_000 {
        match seed % 3 {
            0 => small_problems::<2>(&mut effort, seed),
            1 => small_problems::<3>(&mut effort, seed),
            _ => small_problems::<4>(&mut effort, seed),
        }
        effort.next();
    }
    effort.compare("tests/golden/effort_small_problems.txt");
}

#[test]
fn missions_take_so_many_steps_with_memory_for_nodes_or_without() {
    let mut effort = Effort::new(10);
    for seed in 50_000..50_200 {
        let instance = random_mission(seed);
        let best = [Objective::MostQuality];
        for (steps, memory) in [(6_000, 0), (6_000, 37), (12_000, 512), (700, 16)] {
            exactly(&mut effort, &instance, &best, steps, memory);
        }
        let fair = [Objective::MostQuality, Objective::Least(1)];
        exactly(&mut effort, &instance, &fair, 8_000, 100);
        exactly(&mut effort, &instance, &[Objective::Least(1)], 4_000, 0);
        effort.next();
    }
    effort.compare("tests/golden/effort_missions.txt");
}

#[test]
fn long_missions_take_so_many_steps() {
    let mut effort = Effort::new(5);
    for seed in 0..40 {
        let mut draw = Draw::new(seed);
        let zones = [Zones::Varied, Zones::Three][(seed % 2) as usize];
        let permille = [draw.between(200, 800), draw.between(200, 800)];
        let instance = paper_like(30 + 2 * seed as usize, zones, permille, seed);
        exactly(&mut effort, &instance, &[Objective::MostQuality], 20_000, 200);
        effort.next();
    }
    effort.compare("tests/golden/effort_long_missions.txt");
}

#[test]
fn the_rule_of_the_paper_looks_at_so_many_candidates() {
    let mut effort = Effort::new(500);
    let rule = |effort: &mut Effort, instance: &Instance<2>| {
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let (mut caps, mut plan) = (vec![[0; 2]; slices.len()], vec![0; slices.len()]);
        let answer = Panorama::new(&mut caps).allocate(&problem, &mut plan);
        answered(effort, &answer, &plan);
    };
    for seed in 50_000..55_000 {
        rule(&mut effort, &small::<2>(seed));
        if seed % 10 == 0 {
            rule(&mut effort, &random_mission(seed));
        }
        effort.next();
    }
    effort.compare("tests/golden/effort_rule.txt");
}

/// With memory that is enough and with memory that is not: how much it lacks.
#[test]
fn the_front_has_the_same_plans_in_the_same_order() {
    let mut effort = Effort::new(200);
    let found = |effort: &mut Effort, instance: &Instance<2>, memory: usize| {
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let (mut nodes, mut plan) = (vec![Node::EMPTY; memory], vec![0; slices.len()]);
        let mut front = Front::new(&mut nodes);
        match front.find(&problem) {
            Ok(plans) => {
                effort.count("plans", plans.len() as u64);
                for index in 0..=plans.len() {
                    effort.note(&(plans.totals(index), plans.plan(index, &mut plan)));
                    effort.note(&plan);
                }
                effort.note(&plans.is_empty());
            }
            Err(error) => {
                effort.note(&error);
                effort.count("lacking", error.needed as u64);
            }
        }
    };
    for seed in 50_000..52_000 {
        let instance = small::<2>(seed);
        for memory in [0, 1, 10, 30, 100, 1_000] {
            found(&mut effort, &instance, memory);
        }
        effort.next();
    }
    effort.compare("tests/golden/effort_front.txt");
}
