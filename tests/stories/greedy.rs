//! The savings of the best assignment, as in `docs/teams.md`.

use crate::draw::Draw;
use crate::team_tables::{Kind, again, team};
use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{Cost, Costs, Fixed, Memory, Team, assign};
use cotama_models::team::thesis::{State, greedy};
use std::fmt::Write;

const PAGE: &str = include_str!("../../docs/teams.md");

/// The table is in the page as it is.
fn is_told(table: &str) {
    assert!(PAGE.contains(table), "docs/teams.md is to have:\n{table}");
}

/// Tenths of a percent, rounded.
fn percent(part: u64, whole: u64) -> String {
    let permille = (part * 1_000 + whole / 2) / whole.max(1);
    format!("{}.{} %", permille / 10, permille % 10)
}

/// Robots and pickups anywhere on a floor of 100 m by 100 m; the way between them in m.
fn deliveries(draw: &mut Draw, robots: usize, tasks: usize) -> Vec<Option<Cost>> {
    let mut place = |_| (draw.between(0, 100), draw.between(0, 100));
    let robots: Vec<_> = (0..robots).map(&mut place).collect();
    let tasks: Vec<_> = (0..tasks).map(&mut place).collect();
    let way =
        |a: &(u64, u64), b: &(u64, u64)| Cost::new((a.0.abs_diff(b.0) + a.1.abs_diff(b.1)) as u32);
    tasks.iter().flat_map(|task| robots.iter().map(move |it| way(it, task))).collect()
}

/// One delivery after another goes to the lowest bid among the robots that are free.
fn one_after_another(costs: &Costs<'_>) -> u64 {
    let mut free = vec![true; costs.columns()];
    let mut sum = 0;
    for row in 0..costs.rows() {
        let bids = costs.row(row).enumerate().filter(|it| free[it.0]);
        let (robot, cost) = bids.min_by_key(|it| it.1.map(Cost::get)).expect("a robot is free");
        free[robot] = false;
        sum += u64::from(cost.expect("each can").get());
    }
    sum
}

#[test]
fn one_auction_after_another_drives_further_than_the_best_assignment() {
    let mut table = String::from(
        "| robots | deliveries | lowest bids, m each | best, m each | more | worst of 200 |\n\
         | --- | --- | --- | --- | --- | --- |\n",
    );
    for (robots, tasks) in [(5, 5), (10, 10), (20, 20), (40, 40), (10, 5), (20, 10), (40, 20)] {
        let (mut bids, mut best, mut worst) = (0, 0, (0, 1));
        for seed in 0..200 {
            let entries = deliveries(&mut Draw::new(seed), robots, tasks);
            let costs = Costs::new(&entries, robots).expect("a table");
            let mut fixed = Fixed::<i32, 40, 40>::new();
            let least = assign(&costs, &mut fixed.memory()).expect("each can");
            let greedy = one_after_another(&costs);
            assert!(greedy >= least);
            (bids, best) = (bids + greedy, best + least);
            if (greedy - least) * worst.1 > worst.0 * least {
                worst = (greedy - least, least);
            }
        }
        let each = |sum: u64| {
            format!(
                "{}.{}",
                sum * 10 / (200 * tasks as u64) / 10,
                sum * 10 / (200 * tasks as u64) % 10
            )
        };
        let (more, worst) = (percent(bids - best, best), percent(worst.0, worst.1));
        writeln!(
            table,
            "| {robots} | {tasks} | {} | {} | {more} | {worst} |",
            each(bids),
            each(best)
        )
        .expect("a text takes everything");
    }
    is_told(&table);
}

/// Returns the result of greedy rounds with this team, and the best answer; `None` where nobody can
/// serve all.
fn rounds(team: &Team<'_>) -> Option<(u64, usize, u64)> {
    let mut workspace = Workspace::<20>::new();
    let mut joint = workspace.winners(team, 40_000);
    let Outcome::Optimal { cost } = joint.solve(team, 5_000_000).expect("there is memory").outcome
    else {
        return None;
    };
    assert_eq!(again(team, &mut joint), cost);
    let mut states = vec![State::Open; team.tasks().len()];
    let (mut words, mut amounts) =
        (vec![0; Memory::<i64>::words(40, 40)], vec![0; Memory::<i64>::amounts(40)]);
    let mut memory = Memory::new(40, 40, &mut words, &mut amounts).expect("there is memory");
    let rounds = greedy(team, &mut states, &mut [None; 1_600], &mut memory).expect("so here");
    Some((rounds.cost, rounds.unserved, cost))
}

#[test]
fn greedy_rounds_of_teams_lose_more_the_fewer_robots_are_free() {
    let mut table = String::from(
        "| robots | tasks | a mandatory task is not done | best found | more, where all are |\n\
         | --- | --- | --- | --- | --- |\n",
    );
    for (robots, tasks) in [(8, 3), (12, 4), (20, 6), (6, 4), (8, 5), (12, 8), (20, 11)] {
        let (mut teams, mut unserved, mut best, mut more, mut least) = (0, 0, 0, 0, 0);
        for seed in 0..40 {
            let kind = Kind {
                robots,
                tasks,
                roles: 3,
                plans: 3,
                most: 100,
                missing: 40,
                must: 50,
                skip: 120,
                largest: false,
            };
            let owned = team(&mut Draw::new(seed * 1_000 + robots as u64), kind);
            let Some((greedy, left, cost)) = owned.with(rounds) else { continue };
            teams += 1;
            if left > 0 {
                unserved += 1;
            } else {
                best += u64::from(greedy == cost);
                (more, least) = (more + greedy - cost, least + cost);
            }
        }
        let more = percent(more, least);
        writeln!(
            table,
            "| {robots} | {tasks} | {unserved} of {teams} | {best} of {teams} | {more} |"
        )
        .expect("a text takes everything");
    }
    is_told(&table);
}
