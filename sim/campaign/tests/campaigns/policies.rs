//! Planners over the same plans of faults: the table of `docs/campaigns.md`.

use super::mission;
use cotama_campaign::compare::{Compared, compare};
use cotama_campaign::run::Settings;
use cotama_campaign::statistics::{Difference, Interval};
use cotama_campaign::subject::Policy;
use cotama_sim::options::Planner;
use std::fmt::Write;

const TABLE: &str = include_str!("../golden/policies.md");

/// The policies, each with its name in the table: from none on, each does more.
fn policies() -> [(String, Policy); 4] {
    let planner = Some(Planner::PanoramaThenExact { steps: 100_000 });
    [
        ("no adaptation", Policy { rigid: true, ..Policy::default() }),
        ("PANORAMA's rule", Policy::default()),
        ("exact", Policy { planner, ..Policy::default() }),
        ("exact, and upward", Policy { planner, upward: true, ..Policy::default() }),
    ]
    .map(|(name, it)| (name.to_owned(), it))
}

fn share(it: Interval) -> String {
    format!("{:.1} ({:.1} to {:.1})", 100.0 * it.estimate, 100.0 * it.low, 100.0 * it.high)
}

/// How many plans only the one and only the other completes, what that is in points, and how likely
/// it is if both are alike.
fn points(it: &Difference) -> String {
    let p = if it.p_value < 0.001 { "< 0.001".into() } else { format!("{:.3}", it.p_value) };
    let [low, high] = [it.success.low, it.success.high].map(|it| 100.0 * it);
    format!("{} | {} | {low:.1} to {high:.1} | {p}", it.only_second, it.only_first)
}

/// A mean with its interval, which reaches as far to either side.
fn mean(it: Interval, unit: f64, digits: usize) -> String {
    let [value, half] = [it.estimate, (it.high - it.low) / 2.0].map(|it| it / unit);
    format!("{value:.digits$} ± {half:.digits$}")
}

/// Writes the differences of the others to the first: paired.
fn differences(text: &mut String, all: &[Compared]) {
    let first = &all[0].name;
    for it in &all[1..] {
        let against = it.against.as_ref().unwrap();
        let [time, energy, asked, _] = against.means;
        let success = points(&against.success);
        let (time, energy) = (mean(time, 1_000.0, 1), mean(energy, 1_000.0, 1));
        let asked = mean(asked, 1.0, 3);
        let line =
            format!("| {} against {first} | {success} | {time} | {energy} | {asked} |", it.name);
        writeln!(text, "{}", line.replace('-', "−")).unwrap();
    }
}

fn rows(text: &mut String, name: &str, all: &[Compared]) {
    writeln!(text, "| {name} | completed, % | safe | past a limit | time, s | energy, J | asked |")
        .unwrap();
    *text += "| --- | --- | --- | --- | --- | --- | --- |\n";
    for it in all {
        let [completed, safe, failed] = it.outcomes;
        assert_eq!(completed + safe + failed, RUNS);
        let [time, energy, asked, _] = it.intervals.unwrap();
        let (name, share, asked) = (&it.name, share(it.success.unwrap()), mean(asked, 1.0, 3));
        let (time, energy) = (mean(time, 1_000.0, 1), mean(energy, 1_000.0, 1));
        let line =
            format!("| {name} | {share} | {safe} | {failed} | {time} | {energy} | {asked} |");
        writeln!(text, "{line}").unwrap();
    }
    text.push('\n');
}

const RUNS: u64 = 20_000;

/// `cargo test --release -p cotama-campaign --test campaigns -- --ignored policies`.
#[test]
#[ignore = "half a minute"]
fn policies_over_the_same_20_000_plans() {
    let (patrol, delivery) = (mission("patrol"), mission("delivery"));
    let settings = |supervised| Settings { runs: RUNS, ..Settings::new(supervised) };
    let of = |mission, policies: &[_], supervised| {
        compare(mission, policies, &settings(supervised), 0.95, 2).unwrap()
    };
    let rule = Policy { planner: Some(Planner::Panorama), ..Policy::default() };
    let named = |(name, it): (&str, Policy)| (name.to_owned(), it);
    let supervised = [("PANORAMA's rule", rule), ("most quality, exact", Policy::default())];
    let supervised = supervised.map(named);
    let (all, of_rule) = (of(&patrol, &policies(), false), of(&patrol, &policies()[1..], false));
    let delivery = of(&delivery, &supervised, true);
    let mut text = String::new();
    rows(&mut text, "patrol", &all);
    text += "| over the same plans | only it | only other | points | p | time, s | energy, J \
             | asked |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    differences(&mut text, &all);
    differences(&mut text, &of_rule);
    // The delivery's configurations are chosen by its supervisors: there both complete the same.
    let success = &delivery[1].against.as_ref().unwrap().success;
    assert_eq!((success.only_first, success.only_second), (0, 0));
    println!("{text}");
    cotama_golden::compare("tests/golden/policies.md", &text);
}

#[test]
fn the_page_shows_the_table_of_policies() {
    let page = include_str!("../../../../docs/campaigns.md");
    assert!(page.contains(TABLE), "docs/campaigns.md does not show\n{TABLE}");
}
