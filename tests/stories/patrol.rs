//! The patrol of the paper through the allocators.

use cotama_core::allocation::Answer;
use cotama_core::exact::Objective;
use cotama_core::front::{Front, Node};
use cotama_core::problem::Problem;
use cotama_models::missions::tables::{DURATION, ENERGY};
use cotama_tests::solve::{exact, panorama};
use cotama_tests::with_patrol;

fn best(problem: &Problem<2>, objective: Objective) -> ([u64; 2], u64) {
    match exact(problem, &[objective], u64::MAX).0 {
        Answer::Planned(planned) if planned.optimal => (planned.cost, planned.quality),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_rule_of_the_paper_gives_its_first_plan() {
    with_patrol(|problem| {
        assert_eq!(problem.combinations(), Some(768_288_795_144_192));
        let plan = panorama(problem).expect("Table 6");
        assert_eq!(
            problem.totals(&plan),
            Some((
                [
                    cotama_golden::figure("patrol.first-ms"),
                    cotama_golden::figure("patrol.first-mj")
                ],
                19_190
            ))
        );
    });
}

#[test]
#[ignore = "a minute: CI runs it"]
fn the_best_plans_are_proven() {
    with_patrol(|problem| {
        assert_eq!(
            best(problem, Objective::Least(ENERGY)).0[ENERGY],
            cotama_golden::figure::<u64>("patrol.least-mj")
        );
        assert_eq!(best(problem, Objective::Most(ENERGY)).0[ENERGY], 8_640_000);
        assert_eq!(
            best(problem, Objective::MostQuality).1,
            cotama_golden::figure::<u64>("patrol.most-quality")
        );
        let fastest = best(problem, Objective::Least(DURATION)).0[DURATION];
        assert_eq!(fastest, problem.least(DURATION));
    });
}

#[test]
fn its_front_has_607_plans() {
    with_patrol(|problem| {
        let mut nodes = vec![Node::EMPTY; 200_000];
        let mut front = Front::new(&mut nodes);
        let plans = front.find(problem).expect("enough memory");
        assert_eq!(plans.len(), 607);
        let most = (0..plans.len())
            .filter_map(|index| plans.totals(index))
            .map(|(_, quality)| quality)
            .max();
        assert_eq!(most, Some(cotama_golden::figure::<u64>("patrol.most-quality")));
    });
}
