//! A run without a trace passes over periods in which nothing happens, and comes to the same as one
//! that takes each of them.

use super::delivery;
use cotama_campaign::plan::Plan;
use cotama_campaign::space::{Rates, Space};
use cotama_core::units::Millis;
use cotama_models::missions::Mission;
use cotama_sim::streams::Streams;
use cotama_sim::supervised::{Script, Supervised};
use cotama_sim::trace::Record;

/// So many drawn plans, from none to four faults, come to the same both ways.
fn same(mission: &Mission, plans: u64) {
    let supervised = Supervised::new(mission).unwrap();
    let space = Space::of(mission, Rates::Even, 0..=4);
    let streams = Streams::new(7);
    for plan in 0..plans {
        let mut stream = streams.stream(&format!("plan {plan}"));
        let plan: Plan = space.draw(&mut stream, &space.kinds);
        let script = Script::from(&plan);
        let mut records: Vec<Record> = Vec::new();
        let each = supervised.run_recorded(&script, Millis(10_000), &mut records).unwrap();
        let passed = supervised.run(&script).unwrap();
        assert!(passed == each, "{}\n{each:?}\n{passed:?}", plan.to_toml(mission));
    }
}

#[test]
fn passing_over_quiet_periods_changes_nothing() {
    same(&delivery(), 150);
}

/// With little time and energy, margins fall below zero.
#[test]
fn passing_over_changes_nothing_where_limits_are_tight() {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap();
    for (from, to) in [
        ("duration_ms = 900000", "duration_ms = 400000"),
        ("decides = \"cotama\"", "decides = \"cotama\"\nrecovery = true"),
    ] {
        let text = delivery.text.replacen(from, to, 1);
        same(&Mission::parse("tight", &text).unwrap(), 60);
    }
}

/// `cargo test --release -p cotama-sim --test supervised -- --ignored passing_over`.
#[test]
#[ignore = "half a minute"]
fn passing_over_changes_nothing_in_ten_thousand_plans() {
    same(&delivery(), 10_000);
}
