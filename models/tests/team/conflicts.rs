//! Tasks that cannot all be done: the reason that is given is looked up in the data again.

use cotama_models::team::instance::{Instance, Proof, Reason, Verdict};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Numbers that look random, the same each time.
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 33) % end
    }
}

fn parsed(robots: usize, tasks: &str) -> Instance {
    let names: Vec<_> = (0..robots).map(|it| format!("\"r{it}\"")).collect();
    let text = format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"t\", \"kind\": \"simultaneous\", \
         \"cost_denominator\": 1, \"robots\": [{}], \"tasks\": [{tasks}]}}",
        names.join(", ")
    );
    Instance::parse("t.json", &text).unwrap()
}

/// Tasks of one robot, and of several by one or two plans, of which few robots are capable.
fn random(draw: &mut Draw) -> Instance {
    let robots = 1 + draw.below(6) as usize;
    let capable = 20 + draw.below(60);
    let mut tasks = String::new();
    for task in 0..=draw.below(5) {
        let separator = if task > 0 { ", " } else { "" };
        let skip = if draw.below(4) == 0 { "7" } else { "null" };
        write!(tasks, "{separator}{{\"name\": \"t{task}\", \"skip_cost\": {skip}, ").unwrap();
        let row = |draw: &mut Draw| {
            let entry = |draw: &mut Draw| {
                if draw.below(100) < capable {
                    draw.below(9).to_string()
                } else {
                    "null".to_owned()
                }
            };
            let row: Vec<_> = (0..robots).map(|_| entry(draw)).collect();
            format!("[{}]", row.join(", "))
        };
        if draw.below(2) == 0 {
            write!(tasks, "\"cost\": {}}}", row(draw)).unwrap();
            continue;
        }
        let mut plans = Vec::new();
        for plan in 0..=draw.below(2) {
            let roles = 1 + draw.below(3);
            let role = |at| format!("{{\"name\": \"o{at}\", \"cost\": {}}}", row(draw));
            let roles: Vec<_> = (0..roles).map(role).collect();
            let roles = roles.join(", ");
            plans.push(format!(
                "{{\"name\": \"p{plan}\", \"extra_cost\": 0, \"roles\": [{roles}]}}"
            ));
        }
        write!(tasks, "\"combine\": \"sum\", \"plans\": [{}]}}", plans.join(", ")).unwrap();
    }
    parsed(robots, &tasks)
}

/// Whether these tasks can be staffed together, by trying all.
fn can_all(instance: &Instance, tasks: &[usize], free: &mut Vec<bool>) -> bool {
    let Some((first, rest)) = tasks.split_first() else { return true };
    let plans = instance.tasks[*first].plans.len();
    (0..plans).any(|plan| role(instance, *first, plan, 0, rest, free))
}

fn role(
    instance: &Instance,
    task: usize,
    plan: usize,
    at: usize,
    rest: &[usize],
    free: &mut Vec<bool>,
) -> bool {
    let own = &instance.tasks[task].plans[plan];
    if at == own.roles.len() {
        return can_all(instance, rest, free);
    }
    for robot in 0..instance.robots.len() {
        if free[robot] && own.table().unwrap().cost(at, robot).is_some() {
            free[robot] = false;
            let done = role(instance, task, plan, at + 1, rest, free);
            free[robot] = true;
            if done {
                return true;
            }
        }
    }
    false
}

/// Whether a robot is capable of a role in one of these tasks.
fn competes(instance: &Instance, tasks: &[usize], robot: usize) -> bool {
    let plans = tasks.iter().flat_map(|it| &instance.tasks[*it].plans);
    let mut tables = plans.map(|it| it.table().unwrap());
    tables.any(|it| (0..it.rows()).any(|role| it.cost(role, robot).is_some()))
}

#[test]
fn a_conflict_names_tasks_that_cannot_be_done_together_and_robots_that_compete_for_them() {
    let (mut draw, mut conflicts, mut counted, mut singles) = (Draw(7), 0, 0, 0);
    for number in 0..2_000 {
        let instance = random(&mut draw);
        let must: Vec<_> =
            (0..instance.tasks.len()).filter(|it| instance.tasks[*it].skip.is_none()).collect();
        let possible = can_all(&instance, &must, &mut vec![true; instance.robots.len()]);
        let found = instance.solve(1_000_000).unwrap();
        let Verdict::Infeasible(Reason { tasks, robots }) = &found.verdict else {
            assert!(possible, "{number}: {instance:?}");
            continue;
        };
        assert!(!possible && tasks.iter().all(|it| must.contains(it)), "{number}");
        let mut free = vec![true; instance.robots.len()];
        assert!(!can_all(&instance, tasks, &mut free), "{number}: {tasks:?} {instance:?}");
        for robot in robots {
            assert!(competes(&instance, tasks, *robot), "{number}: {robot} {instance:?}");
        }
        conflicts += 1;
        if found.proof == Proof::Hall {
            // All robots that can do one of them are named, where each is done by one robot: of
            // several roles only some may be those that too few can fill.
            let all: Vec<_> =
                (0..instance.robots.len()).filter(|it| competes(&instance, tasks, *it)).collect();
            if tasks.iter().all(|it| !instance.tasks[*it].is_for_several) {
                assert_eq!(*robots, all, "{number}: {instance:?}");
                singles += 1;
            }
            counted += 1;
        }
    }
    let counts = [conflicts, counted, singles];
    assert!(conflicts > 400 && counted > 300 && singles > 100, "{counts:?}");
}

/// So many tasks of one robot each.
fn many(robots: usize, tasks: usize, skip: &str) -> Instance {
    let row = vec!["1"; robots].join(",");
    let task = |at| format!("{{\"name\": \"t{at}\", \"skip_cost\": {skip}, \"cost\": [{row}]}}");
    let tasks: Vec<_> = (0..tasks).map(task).collect();
    parsed(robots, &tasks.join(", "))
}

#[test]
fn more_tasks_than_robots_are_counted_before_anything_is_searched_for() {
    for (robots, tasks) in [(1, 2), (3, 4), (40, 41), (40, 400), (128, 129), (200, 201)] {
        let found = many(robots, tasks, "null").solve(1).unwrap();
        let Verdict::Infeasible(Reason { tasks, robots: named }) = found.verdict else {
            panic!("{robots}: {:?}", found.verdict)
        };
        assert_eq!((tasks.len(), named.len(), found.proof), (robots + 1, robots, Proof::Hall));
    }
    let found = many(40, 40, "null").solve(1_000_000).unwrap();
    assert_eq!(found.verdict, Verdict::Optimal { cost: 40 });
}

#[test]
fn two_tasks_that_need_the_same_two_robots_are_named_with_them() {
    let task = |name: &str, roles: [&str; 2]| {
        let [a, b] = roles;
        format!(
            "{{\"name\": \"{name}\", \"skip_cost\": null, \"combine\": \"sum\", \"plans\": \
             [{{\"name\": \"p\", \"extra_cost\": 0, \"roles\": \
             [{{\"name\": \"a\", \"cost\": {a}}}, \
             {{\"name\": \"b\", \"cost\": {b}}}]}}]}}"
        )
    };
    let both = "[1, 1, null, null]";
    let tasks =
        [task("mop", ["[null, null, 1, 1]", "[null, null, 1, 1]"]), task("lift", [both; 2])];
    let tasks = [tasks.join(", "), task("carry", [both, "[1, null, null, 1]"])].join(", ");
    let found = parsed(4, &tasks).solve(1_000).unwrap();
    // `mop` has robots of its own.
    let reason = Reason { tasks: vec![1, 2], robots: vec![0, 1] };
    assert_eq!(found.verdict, Verdict::Infeasible(reason));
    assert_eq!(found.proof, Proof::Hall);
}

/// The bound is far above what it takes, and far below what it would take to look at all pairs.
#[test]
fn a_number_of_steps_bounds_the_time_however_many_tasks_there_are() {
    for tasks in [2_000, 20_000] {
        let instance = many(16, tasks, "3");
        let begun = Instant::now();
        let found = instance.solve(1_000).unwrap();
        let taken = begun.elapsed();
        assert!(matches!(found.verdict, Verdict::Unknown { .. } | Verdict::Optimal { .. }));
        assert!(taken < Duration::from_secs(10), "{tasks} tasks took {taken:?}");
    }
}
