//! The methods of the thesis: the same optimum where it promises one, its counts and its tables.

use crate::draw::Draw;
use crate::tables::table;
use crate::teams::{Kind, OwnedPlan, OwnedTask, OwnedTeam, again, least_of_all, team};
use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{
    Combine, Cost, Costs, Fixed, Plan, RobotSet, Task, Team, bottleneck, coalition,
};
use cotama_models::team::thesis::{
    Shares, State, all_coalitions, all_orderings, greedy, has_matching, has_roles, has_union,
};

/// A task with a plan for each number of robots, as the thesis measures.
fn all_sizes(draw: &mut Draw, n: usize, missing: u64) -> OwnedTask {
    let plan =
        |k| OwnedPlan { extra: draw.between(0, 30) as u32, costs: table(draw, k, n, 100, missing) };
    OwnedTask { skip: None, combine: Combine::Mean, plans: (1..=n).map(plan).collect() }
}

#[test]
fn all_coalitions_and_all_orderings_have_the_same_optimum_and_the_counts_of_the_thesis() {
    // Table 3.2: 2^R coalitions and the sum of R! / (R - k)! orderings, less the empty ones.
    let orderings = [(4, 64), (5, 325), (6, 1_956), (7, 13_699), (8, 109_600)];
    let mut draw = Draw::new(2011);
    for (n, orderings) in orderings {
        for missing in [0, 30, 80] {
            let parts = (1..=n as u32).product();
            let task = all_sizes(&mut draw, n, missing);
            OwnedTeam { robots: n, denominator: parts, tasks: vec![task] }.with(|team| {
                let task = &team.tasks()[0];
                let mut fixed = Fixed::<i32, 8, 8>::new();
                let mut memory = fixed.memory();
                let ours = coalition(task, parts, &mut memory).ok().map(|it| it.cost);
                let coalitions = all_coalitions(task, parts, &mut [None; 64], &mut memory);
                assert_eq!(coalitions.best.map(|it| it.0), ours);
                assert_eq!(coalitions.looked_at, (1 << n) - 1);
                if n < 8 || missing == 0 {
                    let all = all_orderings(task, parts, &mut [0; 8]);
                    assert_eq!((all.best.map(|it| it.0), all.looked_at), (ours, orderings));
                    // As many robots as the plan has roles.
                    for (_, plan, robots) in all.best.into_iter().chain(coalitions.best) {
                        let roles = task.plans[plan].roles.rows();
                        assert_eq!(robots.count_ones() as usize, roles);
                    }
                }
            });
        }
    }
}

#[test]
fn two_phases_are_not_the_best_where_the_largest_cost_counts() {
    // The table that four robots carry: the least sum 25 has the largest cost 14.
    let costs = [10, 1, 50, 60, 9, 8, 50, 60, 50, 50, 7, 1, 50, 50, 14, 9].map(Cost::new);
    let roles = Costs::new(&costs, 4).unwrap();
    let plans = [Plan { roles, extra: 0 }];
    let task = Task { skip: None, combine: Combine::Max, plans: &plans };
    let mut fixed = Fixed::<i32, 4, 4>::new();
    let theirs = all_coalitions(&task, 1, &mut [None; 16], &mut fixed.memory());
    assert_eq!(theirs.best, Some((14, 0, 0b1111)));
    let best = bottleneck(&roles, &mut fixed.memory()).unwrap();
    let ours = coalition(&task, 1, &mut fixed.memory()).unwrap();
    assert_eq!((best.largest, ours.cost), (Cost::new(9), 9));
}

#[test]
fn shares_of_coalitions_are_table_a_2() {
    let order: [RobotSet; 15] = [
        0b1111, 0b0111, 0b1011, 0b1101, 0b1110, 0b0011, 0b0101, 0b1001, 0b0110, 0b1010, 0b1100,
        0b0001, 0b0010, 0b0100, 0b1000,
    ];
    let robots = [0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3, 0, 1, 2, 3];
    assert!(Shares::<4>::new().eq(order.into_iter().zip(robots)));
}

/// Each robot answers for coalitions of half of all members.
fn shares_are_even<const N: usize>() {
    let (mut loads, mut count) = ([0_u64; N], 0_u64);
    for (set, robot) in Shares::<N>::new() {
        loads[robot] += u64::from(set.count_ones());
        count += 1;
    }
    assert_eq!((loads, count), ([1 << (N - 1); N], (1 << N) - 1));
}

#[test]
fn all_robots_have_the_same_share() {
    shares_are_even::<1>();
    shares_are_even::<2>();
    shares_are_even::<3>();
    shares_are_even::<5>();
    shares_are_even::<8>();
    shares_are_even::<12>();
    shares_are_even::<16>();
}

#[test]
fn a_team_with_a_matching_has_a_robot_for_each_role_and_then_all_capabilities() {
    let (mut draw, mut counts) = (Draw::new(22), [0; 4]);
    let mut fixed = Fixed::<i32, 4, 5>::new();
    for _ in 0..20_000 {
        let set = |draw: &mut Draw| draw.bits() & draw.bits() & 0xFF;
        let roles: Vec<Vec<u64>> = (0..draw.between(1, 4))
            .map(|_| (0..draw.between(1, 2)).map(|_| set(&mut draw) & draw.bits()).collect())
            .collect();
        let roles: Vec<&[u64]> = roles.iter().map(Vec::as_slice).collect();
        let robots: Vec<u64> =
            (0..draw.between(1, 5)).map(|_| set(&mut draw) | set(&mut draw)).collect();
        let third = has_matching(&roles, &robots, &mut [None; 20], &mut fixed.memory()).unwrap();
        let (first, second) = (has_union(&roles, &robots), has_roles(&roles, &robots));
        assert!(!third || second);
        assert!(!second || first);
        counts[[first, second, third].iter().filter(|it| **it).count()] += 1;
    }
    assert!(counts.iter().all(|it| *it > 500), "{counts:?}");
}

/// The answer of greedy rounds, checked, and how many tasks stay unserved.
fn rounds(team: &Team<'_>) -> (u64, usize) {
    let mut states = vec![State::Open; team.tasks().len()];
    let (rows, columns) = (team.tasks().len().max(8), team.robots() + team.tasks().len());
    let (mut words, mut amounts) = (vec![0; 2 * rows + 3 * columns], vec![0_i64; 3 * columns]);
    let mut memory =
        cotama_core::team::Memory::new(rows, columns, &mut words, &mut amounts).unwrap();
    let mut entries = vec![None; rows * columns];
    let result = greedy(team, &mut states, &mut entries, &mut memory).unwrap();
    let mut taken: RobotSet = 0;
    for (state, task) in states.iter().zip(team.tasks()) {
        assert_ne!(*state, State::Open);
        if let State::Done { plan, robots } = state {
            assert_eq!(taken & robots, 0);
            assert_eq!(robots.count_ones() as usize, task.plans[*plan].roles.rows());
            taken |= robots;
        }
    }
    (result.cost, result.unserved)
}

/// Tasks of two robots whose three coalitions cost what Table 3.3 has them reward, less than 10.
fn table_3_3() -> OwnedTeam {
    // Pairs of robots 0 and 1, 2 and 3, 4 and 5: the first role costs all, the second nothing.
    let rewards = [[10, 10, 10], [10, 1, 1], [10, 10, 1]];
    let task = |of: [u32; 3]| {
        let plan = |(pair, reward): (usize, u32)| {
            let mut costs = vec![None; 12];
            costs[2 * pair] = Cost::new(10 - reward);
            costs[6 + 2 * pair + 1] = Cost::new(0);
            OwnedPlan { extra: 0, costs }
        };
        let plans = of.into_iter().enumerate().map(plan).collect();
        OwnedTask { skip: None, combine: Combine::Sum, plans }
    };
    OwnedTeam { robots: 6, denominator: 1, tasks: rewards.map(task).into() }
}

#[test]
fn greedy_rounds_lose_18_of_30_where_the_optimum_loses_nothing() {
    table_3_3().with(|team| {
        assert_eq!(rounds(team), (18, 0));
        let mut workspace = Workspace::<6>::new();
        let mut joint = workspace.winners(team, 100);
        assert_eq!(joint.solve(team, 10_000).unwrap().outcome, Outcome::Optimal { cost: 0 });
        assert_eq!(again(team, &mut joint), 0);
    });
}

#[test]
fn greedy_rounds_are_never_better_than_the_optimum() {
    let (mut draw, mut worse, mut unserved) = (Draw::new(35), 0, 0);
    for _ in 0..500 {
        let kind = Kind {
            robots: 7,
            tasks: 5,
            roles: 3,
            plans: 2,
            most: 50,
            missing: 30,
            must: 30,
            skip: 60,
            largest: false,
        };
        team(&mut draw, kind).with(|team| {
            let (cost, lost) = rounds(team);
            match least_of_all(team) {
                Some(least) if lost == 0 => {
                    assert!(least <= cost);
                    worse += usize::from(least < cost);
                }
                Some(_) => unserved += 1,
                None => assert!(lost > 0),
            }
        });
    }
    assert!(worse > 50 && unserved > 5, "{worse} {unserved}");
}

#[test]
fn one_way_to_fill_a_role_is_enough_and_needs_no_more_than_it_says() {
    let role: &[u64] = &[0b01, 0b110];
    for (capabilities, can) in [(0b01, true), (0b110, true), (0b111, true), (0b100, false)] {
        assert_eq!(has_roles(&[role], &[capabilities]), can, "{capabilities:b}");
    }
}

/// A set of robots is a word of 64 bits, of which one is for the end.
#[test]
fn coalitions_of_63_robots_are_looked_at_and_of_more_are_not() {
    let entries: Vec<_> = (0..65).map(|it| Cost::new(70 - it)).collect();
    let mut fixed = Fixed::<i32, 1, 1>::new();
    for (robots, best) in [(62, 9), (63, 8), (64, 0), (65, 0)] {
        let plans = [Plan { roles: Costs::new(&entries[..robots], robots).unwrap(), extra: 0 }];
        let task = Task { skip: None, combine: Combine::Sum, plans: &plans };
        let found = all_coalitions(&task, 1, &mut [None; 1], &mut fixed.memory());
        let looked = if robots > 63 { 0 } else { robots as u64 };
        assert_eq!(found.looked_at, looked, "{robots}");
        let expected = (robots < 64).then(|| (best, 0, 1 << (robots - 1)));
        assert_eq!(found.best, expected, "{robots}");
    }
}

#[test]
fn of_coalitions_that_cost_the_same_the_first_plan_and_the_first_robots_are_kept() {
    let entries = [Cost::new(4); 3];
    let plan = Plan { roles: Costs::new(&entries, 3).unwrap(), extra: 0 };
    let task = Task { skip: None, combine: Combine::Sum, plans: &[plan, plan] };
    let mut fixed = Fixed::<i32, 3, 3>::new();
    let best = all_coalitions(&task, 1, &mut [None; 9], &mut fixed.memory()).best;
    assert_eq!(best, Some((4, 0, 0b001)));
}

/// Ten over four roles is less than eight over two.
#[test]
fn greedy_rounds_announce_the_task_of_most_utility_for_the_size_of_its_plans() {
    let free = [Cost::new(0); 16];
    let plan = |roles: usize| Plan { roles: Costs::new(&free[..4 * roles], 4).unwrap(), extra: 0 };
    let (four, two) = ([plan(4)], [plan(2)]);
    let task = |skip, plans| Task { skip: Cost::new(skip), combine: Combine::Sum, plans };
    let tasks = [task(10, &four[..]), task(8, &two[..])];
    let team = Team::new(4, 1, &tasks).unwrap();
    let (mut states, mut entries) = ([State::Open; 2], [None; 64]);
    let mut fixed = Fixed::<i64, 8, 8>::new();
    let rounds = greedy(&team, &mut states, &mut entries, &mut fixed.memory()).unwrap();
    assert_eq!((rounds.cost, states[0]), (10, State::Undone));
    assert!(matches!(states[1], State::Done { plan: 0, .. }), "{states:?}");
}
