//! What it takes to find who does what: steps, nodes, and all that is answered.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::tables::{below, table};
use crate::teams::{Kind, Room, team};
use cotama_core::team::joint::Outcome;
use cotama_core::team::thesis::{State, all_coalitions, all_orderings, greedy};
use cotama_core::team::{Amount, Cost, Costs, Fixed, Memory, Team, assign, bottleneck, coalition};

/// Notes the answer within so many steps, with room for so many coalitions.
fn solve<const N: usize>(effort: &mut Effort, team: &Team<'_>, columns: usize, steps: u64) {
    let mut room = Room::<N>::new(team, columns);
    let mut joint = room.joint();
    let solved = joint.solve(team, steps).unwrap();
    effort.note(&solved);
    effort.count("steps", solved.steps);
    effort.count("nodes", solved.nodes);
    effort.count(
        match solved.outcome {
            Outcome::Optimal { .. } => "optimal",
            Outcome::Infeasible { .. } => "infeasible",
            Outcome::Unknown { .. } => "unknown",
        },
        1,
    );
    for task in 0..team.tasks().len() {
        effort.note(&(joint.chosen(task), joint.in_conflict(task)));
        effort.note(&joint.robots(task).collect::<Vec<_>>());
    }
}

/// Small and large costs, few and many ways, tasks that may be left undone or not.
fn drawn(draw: &mut Draw, robots: (u64, u64), tasks: (u64, u64)) -> Kind {
    Kind {
        robots: draw.between(robots.0, robots.1) as usize,
        tasks: draw.between(tasks.0, tasks.1) as usize,
        roles: draw.between(2, 4),
        plans: draw.between(1, 3),
        most: [3, 20, 100, 1_000_000][draw.between(0, 3) as usize],
        missing: [0, 20, 40, 70][draw.between(0, 3) as usize],
        must: [0, 30, 100][draw.between(0, 2) as usize],
        skip: [5, 30, 120, 1_000_000][draw.between(0, 3) as usize],
        largest: draw.between(0, 4) == 0,
    }
}

#[test]
fn small_teams_take_so_many_steps_whatever_the_budget_and_the_memory() {
    let (mut draw, mut effort) = (Draw::new(71), Effort::new(100));
    for _ in 0..2_000 {
        let kind = drawn(&mut draw, (1, 8), (0, 6));
        team(&mut draw, kind).with(|team| {
            for (columns, steps) in
                [(4_096, 10_000_000), (64, 1_000), (16, 100_000), (56, 8_000), (30, 300)]
            {
                solve::<8>(&mut effort, team, columns, steps);
            }
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_small_teams.txt");
}

#[test]
fn teams_of_up_to_twenty_robots_take_so_many_steps() {
    let (mut draw, mut effort) = (Draw::new(72), Effort::new(10));
    for _ in 0..200 {
        let kind = drawn(&mut draw, (9, 20), (5, 12));
        team(&mut draw, kind).with(|team| {
            solve::<20>(&mut effort, team, 2_000, 400_000);
            solve::<20>(&mut effort, team, 200, 50_000);
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_teams.txt");
}

/// More tasks that must be done than robots can do: who competes for whom.
#[test]
fn conflicts_take_so_many_steps_and_name_the_same_tasks_and_robots() {
    let (mut draw, mut effort) = (Draw::new(73), Effort::new(50));
    for _ in 0..600 {
        let kind = Kind { must: 90, largest: false, ..drawn(&mut draw, (4, 12), (3, 8)) };
        team(&mut draw, kind).with(|team| {
            solve::<12>(&mut effort, team, 1_000, 1_000_000);
            solve::<12>(&mut effort, team, 100, 20_000);
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_conflicts.txt");
}

/// As many robots as roles, or hardly more, and most of them can do little: a first solution is
/// hard to find.
#[test]
fn tasks_that_need_nearly_all_robots_take_so_many_steps() {
    let (mut draw, mut effort) = (Draw::new(76), Effort::new(50));
    for _ in 0..1_000 {
        let tasks = draw.between(3, 6) as usize;
        let kind = Kind {
            robots: 2 * tasks + draw.between(0, 2) as usize,
            tasks,
            must: [100, 100, 80][draw.between(0, 2) as usize],
            missing: draw.between(40, 75),
            plans: draw.between(1, 2),
            largest: false,
            ..drawn(&mut draw, (4, 12), (3, 8))
        };
        team(&mut draw, kind).with(|team| {
            solve::<14>(&mut effort, team, 1_000, 300_000);
            solve::<14>(&mut effort, team, 60, 5_000);
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_tight_teams.txt");
}

/// All that memory tells after an assignment.
fn told<N: Amount>(effort: &mut Effort, costs: &Costs<'_>, memory: &Memory<'_, N>) {
    for row in 0..costs.rows() {
        effort.note(&(memory.column(row), memory.in_conflict(row)));
    }
    for column in 0..costs.columns() {
        effort.note(&(memory.row(column), memory.price(column)));
    }
}

/// An assignment and a bottleneck in 32 bits, and an assignment in 64.
fn assigned<const R: usize, const C: usize>(
    effort: &mut Effort,
    costs: &Costs<'_>,
    narrow: &mut Fixed<i32, R, C>,
    wide: &mut Fixed<i64, R, C>,
) {
    let mut memory = narrow.memory();
    effort.note(&assign(costs, &mut memory));
    told(effort, costs, &memory);
    effort.note(&bottleneck(costs, &mut memory));
    told(effort, costs, &memory);
    let mut memory = wide.memory();
    effort.note(&assign(costs, &mut memory));
    told(effort, costs, &memory);
    effort.next();
}

#[test]
fn assignments_bottlenecks_and_coalitions_are_the_same_with_prices_and_conflicts() {
    let (mut draw, mut effort) = (Draw::new(74), Effort::new(500));
    let (mut narrow, mut wide) = (Fixed::<i32, 9, 12>::new(), Fixed::<i64, 9, 12>::new());
    for _ in 0..10_000 {
        let (rows, columns) = (1 + below(&mut draw, 9) as usize, 1 + below(&mut draw, 12) as usize);
        let most = [3, 100, 1_000_000][below(&mut draw, 3) as usize];
        let missing = below(&mut draw, 70);
        let entries = table(&mut draw, rows, columns, most, missing);
        let costs = Costs::new(&entries, columns).unwrap();
        assigned(&mut effort, &costs, &mut narrow, &mut wide);
    }
    effort.compare("tests/golden/effort_assignments.txt");
}

/// Wide enough for columns to be looked at block by block.
#[test]
fn large_assignments_are_the_same_with_prices_and_conflicts() {
    let (mut draw, mut effort) = (Draw::new(77), Effort::new(10));
    let (mut narrow, mut wide) = (Fixed::<i32, 90, 300>::new(), Fixed::<i64, 90, 300>::new());
    for _ in 0..100 {
        let rows = 10 + below(&mut draw, 80) as usize;
        let columns = rows + below(&mut draw, 200) as usize;
        let most = [2, 30, 1_000_000][below(&mut draw, 3) as usize];
        let missing = [0, 50, 90][below(&mut draw, 3) as usize];
        let mut entries = table(&mut draw, rows, columns, most, missing);
        // In some the last rows have few columns among themselves, just enough or too few.
        if below(&mut draw, 2) == 0 {
            let own = rows / 8 - (below(&mut draw, 2) as usize).min(rows / 8);
            for row in rows - rows / 8..rows {
                for column in 0..columns {
                    entries[row * columns + column] = Cost::new(1).filter(|_| column < own);
                }
            }
        }
        let costs = Costs::new(&entries, columns).unwrap();
        assigned(&mut effort, &costs, &mut narrow, &mut wide);
    }
    effort.compare("tests/golden/effort_large_assignments.txt");
}

#[test]
fn coalitions_and_greedy_rounds_are_the_same_robot_by_robot() {
    let (mut draw, mut effort) = (Draw::new(75), Effort::new(100));
    let mut half = Fixed::<i32, 16, 32>::new();
    for _ in 0..3_000 {
        let kind = drawn(&mut draw, (2, 7), (1, 6));
        team(&mut draw, kind).with(|team| {
            let mut states = vec![State::Open; team.tasks().len()];
            let mut fixed = Fixed::<i64, 16, 32>::new();
            let mut entries = vec![None; 16 * 32];
            let rounds = greedy(team, &mut states, &mut entries, &mut fixed.memory());
            effort.note(&(rounds, states));
            for task in team.tasks() {
                let mut memory = fixed.memory();
                let parts = team.denominator();
                let best = coalition(task, parts, &mut memory);
                effort.note(&best);
                if let Ok(best) = best {
                    let roles = 0..task.plans[best.plan].roles.rows();
                    effort.note(&roles.map(|it| memory.column(it)).collect::<Vec<_>>());
                }
                let mut memory = half.memory();
                effort.note(&all_coalitions(task, parts, &mut [None; 64], &mut memory));
                effort.note(&all_orderings(task, parts, &mut [0; 8]));
            }
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_rounds.txt");
}
