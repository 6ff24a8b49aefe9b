//! All tasks at once, against all sets of robots.

use crate::draw::Draw;
use crate::teams::{Kind, again, least_of_all, team};
use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{Combine, Cost, Costs, Plan, Task, Team, TeamError};

/// A small team, of one kind after another.
fn small(draw: &mut Draw) -> Kind {
    Kind {
        robots: draw.between(1, 8) as usize,
        tasks: draw.between(0, 5) as usize,
        roles: draw.between(2, 3),
        plans: draw.between(1, 3),
        most: [3, 20, 1_000_000][draw.between(0, 2) as usize],
        missing: draw.between(0, 70),
        must: [0, 50, 100][draw.between(0, 2) as usize],
        skip: [5, 30, 1_000_000][draw.between(0, 2) as usize],
        largest: draw.between(0, 4) == 0,
    }
}

/// So many random teams have the answer of all sets.
fn agree(seed: u64, count: usize) {
    let (mut draw, mut feasible, mut conflicts) = (Draw::new(seed), 0, 0);
    for _ in 0..count {
        let kind = small(&mut draw);
        let owned = team(&mut draw, kind);
        owned.with(|team| {
            let mut workspace = Workspace::<8>::new();
            let mut joint = workspace.winners(team, 4_096);
            let solved = joint.solve(team, 10_000_000).unwrap();
            match least_of_all(team) {
                Some(cost) => {
                    assert_eq!(solved.outcome, Outcome::Optimal { cost });
                    assert_eq!(again(team, &mut joint), cost);
                    feasible += 1;
                }
                None => {
                    let Outcome::Infeasible { robots } = solved.outcome else {
                        panic!("{:?}", solved.outcome)
                    };
                    // The tasks in conflict alone cannot be done either, nor by their robots among
                    // others.
                    let tasks = team.tasks().iter().enumerate();
                    let tasks = tasks.filter(|it| joint.in_conflict(it.0)).map(|it| *it.1);
                    let tasks: Vec<_> = tasks.collect();
                    assert!(tasks.iter().all(|it| it.skip.is_none()));
                    assert!(robots < 1 << team.robots());
                    // Each robot that is named can do something in one of them.
                    let roles = || tasks.iter().flat_map(|it| it.plans).map(|it| it.roles);
                    let can = |robot: usize| {
                        let cost = |it: Costs<'_>| {
                            (0..it.rows()).any(|role| it.cost(role, robot).is_some())
                        };
                        roles().any(cost)
                    };
                    let named = (0..team.robots()).filter(|it| robots >> it & 1 == 1);
                    assert!(named.clone().all(can), "{robots:b}");
                    let alone = Team::new(team.robots(), team.denominator(), &tasks).unwrap();
                    assert_eq!(least_of_all(&alone), None);
                    conflicts += 1;
                }
            }
        });
    }
    assert!(feasible > count / 3 && conflicts > count / 20, "{feasible} {conflicts}");
}

#[test]
fn all_tasks_at_once_cost_the_least_of_all_sets() {
    agree(2_011, 2_000);
}

#[test]
#[ignore = "five seconds; `all_tasks_at_once_cost_the_least_of_all_sets` has a tenth"]
fn twenty_thousand_teams_cost_the_least_of_all_sets() {
    agree(3_221, 20_000);
}

#[test]
fn whatever_the_budget_and_the_memory_the_bound_is_true() {
    let (mut draw, mut unknown) = (Draw::new(60), 0);
    for number in 0..300 {
        let kind = Kind { robots: 8, tasks: 6, must: 30, ..small(&mut draw) };
        let owned = team(&mut draw, kind);
        owned.with(|team| {
            let least = least_of_all(team);
            for (steps, columns) in [
                (0, 0),
                (200, 64),
                (1_000, 64),
                (5_000, 16),
                (100_000, 8),
                (100_000, 24),
                (100_000, 40),
                (100_000, 56),
            ] {
                let mut workspace = Workspace::<8>::new();
                let mut joint = workspace.winners(team, columns);
                let solved = joint.solve(team, steps).unwrap();
                assert!(solved.steps <= steps);
                match solved.outcome {
                    Outcome::Optimal { cost } => assert_eq!(Some(cost), least),
                    Outcome::Infeasible { .. } => assert_eq!(least, None),
                    Outcome::Unknown { cost, bound } => {
                        assert!(least.is_none_or(|it| bound <= it), "{number}");
                        if let Some(cost) = cost {
                            assert_eq!(again(team, &mut joint), cost);
                            assert!(least.is_some_and(|it| it <= cost));
                        }
                        unknown += 1;
                    }
                }
            }
        });
    }
    assert!(unknown > 100, "{unknown}");
}

#[test]
fn forty_robots_are_proven_twice_with_the_same_answer() {
    let kind = Kind {
        robots: 40,
        tasks: 22,
        roles: 3,
        plans: 3,
        most: 100,
        missing: 40,
        must: 50,
        skip: 120,
        largest: false,
    };
    let owned = team(&mut Draw::new(40), kind);
    owned.with(|team| {
        let solve = |columns| {
            let mut workspace = Workspace::<64>::new();
            let mut joint = workspace.winners(team, columns);
            let solved = joint.solve(team, 20_000_000).unwrap();
            let Outcome::Optimal { cost } = solved.outcome else { panic!("{solved:?}") };
            assert_eq!(again(team, &mut joint), cost);
            (solved, (0..22).map(|it| joint.chosen(it)).collect::<Vec<_>>())
        };
        assert_eq!(solve(50_000), solve(50_000));
    });
}

#[test]
fn a_workspace_that_served_other_teams_gives_the_same_answers_as_a_new_one() {
    let (mut draw, mut kept) = (Draw::new(77), Workspace::<8>::new());
    for _ in 0..200 {
        let columns = draw.between(16, 400) as usize;
        let kind = small(&mut draw);
        team(&mut draw, kind).with(|team| {
            let answer = |workspace: &mut Workspace<8>| {
                let mut joint = workspace.winners(team, columns);
                let solved = joint.solve(team, 2_000).unwrap();
                let chosen = |task| (joint.chosen(task), joint.robots(task).collect::<Vec<_>>());
                (solved, (0..team.tasks().len()).map(chosen).collect::<Vec<_>>())
            };
            assert_eq!(answer(&mut kept), answer(&mut Workspace::new()));
        });
    }
}

#[test]
fn memory_that_lacks_is_said() {
    let kind = Kind { robots: 8, tasks: 3, ..small(&mut Draw::new(1)) };
    let owned = team(&mut Draw::new(1), kind);
    owned.with(|team| {
        assert!(Workspace::<4>::new().winners(team, 10).solve(team, 100).is_err());
    });
}

#[test]
fn a_team_is_of_128_robots_at_most_and_its_means_divide_the_denominator() {
    assert_eq!(Team::new(129, 1, &[]).unwrap_err(), TeamError::TooManyRobots);
    assert_eq!(Team::new(128, 1, &[]).unwrap().robots(), 128);
    let entries = [Cost::new(3); 4];
    let roles = Costs::new(&entries, 2).unwrap();
    let plans = [Plan { roles, extra: 5 }];
    let task = |combine| [Task { skip: Cost::new(9), combine, plans: &plans }];
    let wrong = TeamError::Denominator { task: 0, plan: 0 };
    assert_eq!(Team::new(2, 3, &task(Combine::Mean)).unwrap_err(), wrong);
    assert_eq!(Team::new(2, 4, &task(Combine::Mean)).unwrap().most(), 4 * 9);
    // Two roles of 3 each and 5 for the plan are more than 9 for none.
    assert_eq!(Team::new(2, 3, &task(Combine::Sum)).unwrap().most(), 3 * 11);
}
