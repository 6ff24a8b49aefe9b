//! One task with several plans, against all sets of robots.

use crate::draw::Draw;
use crate::tables::table;
use crate::teams::{OwnedPlan, OwnedTask, OwnedTeam, least_of_all};
use cotama_core::team::{Combine, Fixed, coalition};

#[test]
fn one_task_with_several_plans_is_the_best_of_all_sets() {
    let mut draw = Draw::new(21);
    for number in 0..2_000 {
        let combine = [Combine::Sum, Combine::Mean, Combine::Max][number % 3];
        let robots = draw.between(2, 6) as usize;
        let missing = draw.between(0, 60);
        let plan = |_| {
            let roles = draw.between(1, 4) as usize;
            let costs = table(&mut draw, roles, robots, 40, missing);
            OwnedPlan { extra: draw.between(0, 20) as u32, costs }
        };
        let task = OwnedTask { skip: None, combine, plans: (0..3).map(plan).collect() };
        OwnedTeam { robots, denominator: 12, tasks: vec![task] }.with(|team| {
            let (mut small, mut large) = (Fixed::<i32, 4, 6>::new(), Fixed::<i64, 4, 6>::new());
            let task = &team.tasks()[0];
            let narrow = coalition(task, 12, &mut small.memory());
            let mut memory = large.memory();
            let wide = coalition(task, 12, &mut memory);
            assert_eq!(narrow, wide);
            assert_eq!(wide.ok().map(|it| it.cost), least_of_all(team));
            if let Ok(best) = wide {
                let plan = &task.plans[best.plan];
                let cost = |role| plan.roles.cost(role, memory.column(role).unwrap()).unwrap();
                let costs = (0..plan.roles.rows()).map(cost);
                assert_eq!(task.cost(plan, 12, costs), best.cost);
            }
        });
    }
}
