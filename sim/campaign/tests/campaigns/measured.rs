//! How many runs each strategy takes to find each defect, and how small it gets.

use super::defects::{Defect, blind, defects};
use super::mission;
use cotama_campaign::plan::Plan;
use cotama_campaign::requirement::{Metric, Requirement};
use cotama_campaign::shrink::{MAX_RUNS, Shrunk, shrink, shrink_by};
use cotama_campaign::space::{Rates, Space};
use cotama_campaign::strategy::{BLOCK, StrategyName};
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::missions::Mission;
use std::fmt::Write;

const STRATEGIES: [StrategyName; 5] = [
    StrategyName::Uniform,
    StrategyName::Swarm,
    StrategyName::Pairwise,
    StrategyName::Guided,
    StrategyName::Races,
];

/// The first words of the defects in which two events come nearly together.
const RACES: [&str; 2] = ["F1", "follows"];

/// A mission ready to be run, and watched for a requirement.
fn watched<'m>(mission: &'m Mission, requirement: &Requirement) -> Subject<'m> {
    let subject = Subject::new(mission, Policy::default()).unwrap();
    subject.watching(std::slice::from_ref(requirement)).unwrap()
}

/// The run, from 1, that finds the defect first, and its plan made small.
fn found(
    defect: &Defect,
    shipped: &Mission,
    name: StrategyName,
    seed: u64,
    budget: u64,
) -> Option<(u64, Shrunk)> {
    let mission = defect.mission();
    let [subject, sound] = [&mission, shipped].map(|it| watched(it, &defect.breaks));
    let space = Space::of(shipped, Rates::Even, 1..=3);
    let strategy = name.strategy(&space);
    for first in (0..budget).step_by(BLOCK as usize) {
        let mut draws = strategy.block(&space, seed, first);
        for run in first..budget.min(first + BLOCK) {
            let plan = draws.next();
            let observed = subject.run(&plan);
            // A requirement that the sound system fails too is no sign of the defect.
            let fails = |plan: &Plan| {
                plan.is_within(subject.path_length())
                    && !defect.breaks.holds(&subject.run(plan))
                    && defect.breaks.holds(&sound.run(plan))
            };
            if !defect.breaks.holds(&observed) && fails(&plan) {
                return Some((run + 1, shrink_by(&plan, &mut |it| fails(it))));
            }
            draws.learn(&observed, defect.breaks.distance(&observed));
        }
    }
    None
}

#[test]
#[ignore = "a minute"]
fn the_blind_drive_is_found_and_is_three_faults() {
    let mission = mission("delivery");
    let (_, shrunk) = found(&blind(), &mission, StrategyName::Guided, 0, 40_000).unwrap();
    let text = shrunk.plan.compact(&mission);
    assert!(shrunk.plan.faults.len() <= 3 && shrunk.runs <= MAX_RUNS, "{text}");
    let names = shrunk.plan.named_signature(&mission);
    assert!(names.contains("SON2") && names.contains("CAM1"), "{text}");
}

#[test]
fn a_planted_defect_is_found_and_made_small() {
    let mission = mission("delivery");
    let late = defects().into_iter().find(|it| it.name == "ODO1 is seen 20 s late").unwrap();
    let (run, shrunk) = found(&late, &mission, StrategyName::Uniform, 0, 2_000).unwrap();
    let text = shrunk.plan.compact(&mission);
    assert!(run <= 200 && shrunk.minimal && shrunk.runs <= MAX_RUNS, "{run}");
    let expected = "format = \"panorama-faults/1\"\nevent = [\n  { x_mm = 5000, kind = \
                    \"failure\", mode = \"ODO1\" },\n]\n";
    assert_eq!((late.name, text.as_str()), ("ODO1 is seen 20 s late", expected));
}

/// Whether a mission may break it though its robot has no defect: motors that are too weak take it
/// past its limit, whatever is known of them, and some failures end it or need the operator.
const fn is_of_the_world(it: &Requirement) -> bool {
    matches!(
        it,
        Requirement::Completed | Requirement::NotFailed | Requirement::AtMost(Metric::Requests, _)
    )
}

/// Requirements that the sound robot breaks would find nothing.
#[test]
fn the_shipped_robot_breaks_no_requirement_of_supervisors_that_defects_do() {
    let mission = mission("delivery");
    let asked: std::collections::BTreeSet<_> = defects().into_iter().map(|it| it.breaks).collect();
    let asked: Vec<_> = asked.into_iter().filter(|it| !is_of_the_world(it)).collect();
    assert_eq!(asked.len(), 10);
    let subject = Subject::new(&mission, Policy::default()).unwrap().watching(&asked).unwrap();
    let space = Space::of(&mission, Rates::Even, 1..=3);
    for name in [StrategyName::Uniform, StrategyName::Races] {
        let strategy = name.strategy(&space);
        let mut draws = strategy.block(&space, 1, 0);
        for _ in 0..500 {
            let plan = draws.next();
            let observed = subject.run(&plan);
            let broken = asked.iter().find(|it| !it.holds(&observed));
            assert_eq!(broken, None, "{}\n{observed:?}", plan.to_toml(&mission));
        }
    }
}

#[test]
fn the_page_shows_the_table_of_defects() {
    let (page, table) =
        (include_str!("../../../../docs/campaigns.md"), include_str!("../golden/defects.txt"));
    assert!(page.contains(table), "docs/campaigns.md does not show\n{table}");
}

#[test]
fn a_plan_that_breaks_no_requirement_is_not_shrunk() {
    let mission = mission("delivery");
    let subject = Subject::new(&mission, Default::default()).unwrap();
    let plan = Plan::default();
    let shrunk = shrink(&subject, &blind().breaks, &plan);
    assert_eq!((shrunk.plan, shrunk.minimal), (plan, true));
}

/// Returns the broken requirement in a word.
fn broken(requirement: &Requirement) -> String {
    match requirement {
        Requirement::Always(_) => "a property".to_owned(),
        _ => requirement.to_string(),
    }
}

/// `cargo test --release -p cotama-campaign --test campaigns -- --ignored --nocapture`.
#[test]
#[ignore = "minutes"]
fn median_runs_to_find_each_defect() {
    const SEEDS: u64 = 5;
    const BUDGET: u64 = 2_000;
    let mission = &mission("delivery");
    let mut text = format!(
        "Runs until a defect is found: the median of {SEEDS} seeds, at most {BUDGET} runs each; -\n\
         where fewer than half of them found it. Then the most faults, lines of TOML and runs of\n\
         shrinking over all that was found.\n\n{:36}",
        "defect"
    );
    STRATEGIES.iter().for_each(|it| write!(text, "{:>10}", it.name()).unwrap());
    text += "  faults  lines  runs  broken\n";
    // The runs of each seed, by strategy and defect; a seed without a find counts its budget.
    let mut all = vec![Vec::new(); STRATEGIES.len()];
    for defect in &defects() {
        write!(text, "{:36}", defect.name).unwrap();
        let mut most = [0; 3];
        let of = |name| (0..SEEDS).map(move |seed| found(defect, mission, name, seed, BUDGET));
        let searches: [Vec<_>; STRATEGIES.len()] = std::thread::scope(|threads| {
            let all = STRATEGIES.map(|name| threads.spawn(move || of(name).collect()));
            all.map(|it| it.join().unwrap())
        });
        for (column, searched) in searches.into_iter().enumerate() {
            let counted = searched.into_iter().map(|it| {
                let Some((run, shrunk)) = it else { return u64::MAX };
                let lines = shrunk.plan.compact(mission).lines().count() as u64;
                let these = [shrunk.plan.faults.len() as u64, lines, shrunk.runs];
                most = std::array::from_fn(|at| most[at].max(these[at]));
                run
            });
            let mut runs: Vec<u64> = counted.collect();
            runs.sort_unstable();
            all[column].extend(runs.iter().map(|it| (*it).min(BUDGET) as f64));
            match runs[SEEDS as usize / 2] {
                u64::MAX => write!(text, "{:>10}", "-").unwrap(),
                median => write!(text, "{median:>10}").unwrap(),
            }
        }
        let ([faults, lines, runs], broken) = (most, broken(&defect.breaks));
        writeln!(text, "{faults:>8}{lines:>7}{runs:>6}  {broken}").unwrap();
        println!("{}", text.lines().last().unwrap());
    }
    text += "\nRuns of uniform over those of another strategy: the geometric mean over seeds and\n\
             defects, with its 95 % interval over defects; a run over budget counts as it. Then\n\
             the same without the two in which two events come nearly together: F1, and a drive\n\
             that follows whatever is lost.\n\n";
    let is_race = |name: &str| RACES.iter().any(|it| name.starts_with(it));
    let races: Vec<bool> = defects().iter().map(|it| is_race(it.name)).collect();
    assert_eq!(races.iter().filter(|it| **it).count(), 2);
    let log = |runs: &[f64]| runs.iter().map(|it| libm::log(*it)).sum::<f64>() / SEEDS as f64;
    for (column, name) in STRATEGIES.into_iter().enumerate().skip(1) {
        let ratio = |of_all: bool| {
            let of = |column: usize| all[column].chunks(SEEDS as usize);
            let pairs = of(0).zip(of(column)).zip(&races);
            let meant = pairs.filter(|(_, is_race)| of_all || !**is_race);
            let logs: Vec<f64> = meant.map(|((uniform, it), _)| log(uniform) - log(it)).collect();
            let it = cotama_campaign::statistics::mean_interval(&logs, 0.95);
            let [mean, low, high] = [it.estimate, it.low, it.high].map(libm::exp);
            format!("{mean:.2} ({low:.2} to {high:.2})")
        };
        writeln!(text, "{:10} {}   {}", name.name(), ratio(true), ratio(false)).unwrap();
    }
    println!("{text}");
    cotama_golden::compare("tests/golden/defects.txt", &text);
}
