//! The protocol as the thesis's text has it.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test engines team` writes the runs in
//! `tests/golden/team` anew.

use crate::team::Asked;
use cotama_models::team::protocol::{TEXT, Team};
use cotama_verification::check::{Options, Verdict, check};
use cotama_verification::diagnosis::{Case, Diagnosis};
use cotama_verification::property;
use std::path::Path;

/// Returns the requirements that the text breaks, on fair runs.
fn broken(team: Team) -> (u64, Vec<&'static str>) {
    let asked = Asked::new(&team.with(TEXT));
    (asked.space().states, asked.broken(|it| &it.fair))
}

#[test]
fn the_text_breaks_nine_requirements_with_two_robots() {
    let nine = ["S1", "S3", "S6", "S8", "S9", "L1", "L2", "L3", "L4"];
    assert_eq!(broken(Team::new(2, 1)), (15_716, nine.to_vec()));
}

#[test]
#[ignore = "six seconds"]
fn the_text_breaks_eight_requirements_with_three_robots() {
    let eight = ["S1", "S3", "S6", "S8", "S9", "L1", "L2", "L3"];
    assert_eq!(broken(Team::new(3, 1)), (144_014, eight.to_vec()));
}

#[test]
fn the_text_announces_for_ever_with_two_auctioneers() {
    assert_eq!(broken(Team::rivals()), (2_266, vec!["S8", "L1", "L4"]));
}

/// The run that shows that a property does not hold of the text, as it is printed.
fn shown(file: &str, team: Team, text: &str) {
    let asked = Asked::new(&team.clone().with(TEXT));
    let property = property::parse(text, asked.model.pt()).unwrap();
    let answer = check(&asked.model, &property, &Options::default());
    assert_eq!(answer.verdict, Verdict::Holds(false), "{text}");
    let run = answer.run.unwrap();
    let view = asked.net.view();
    let net = view.net();
    let case = Case::new(asked.model.pt(), &property, false, &run).with_net(&net);
    let text = Diagnosis::new(&case).unwrap().to_string();
    cotama_golden::compare(Path::new("tests/golden/team").join(file), &text);
    // The repaired protocol keeps it.
    let repaired = Asked::new(&team.without_old_messages());
    let property = property::parse(&property.name, repaired.model.pt()).unwrap();
    let verdict = check(&repaired.model, &property, &Options::default()).verdict;
    assert_eq!(verdict, Verdict::Holds(true), "{}", property.name);
}

#[test]
fn p1_a_robot_that_dies_before_its_bid_stops_the_auction() {
    shown("p1_no_deadline.txt", Team::new(3, 1).without_old_messages(), "AG EF !t1.announced");
}

#[test]
fn p2_a_robot_waits_for_a_dead_partner() {
    shown("p2_dead_partner.txt", Team::new(3, 1).without_old_messages(), "AG EF !r1.waiting.t1");
}

#[test]
fn p3_two_auctioneers_hold_one_robot_each() {
    shown(
        "p3_two_auctioneers.txt",
        Team::rivals().without_old_messages(),
        "AG EF (t1.done & t2.done)",
    );
}

#[test]
fn p4_a_task_is_lost_with_its_auctioneer() {
    shown("p4_lost.txt", Team::new(3, 1).without_old_messages(), "AG !t1.lost");
}

#[test]
fn p4_a_task_is_announced_while_it_is_executed() {
    let text = "AG !(r3.executing.t1 & r1.down & t1.announced)";
    shown("p4_executed_twice.txt", Team::new(3, 1).without_old_messages(), text);
}

#[test]
fn p5_an_old_ack_counts() {
    shown("p5_old_ack.txt", Team::new(3, 1), "AG !(t1.executing & t1.named.r1)");
}
