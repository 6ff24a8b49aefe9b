//! Plans at the edges of limits and activities.

use super::*;
use crate::options::Options;
use cotama_models::missions::{Mission, embedded};

#[test]
fn a_plan_that_fills_a_limit_to_the_last_unit_keeps_it() {
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    let of = Plannable::new(&mission, &Options::default()).unwrap();
    let start = Progress::start(Millimetres(0));
    let planning = Planning::start(&of, &start, mission.available()).unwrap();
    let left = planning.margins(&start).map(i64::unsigned_abs);
    let cause = |used| {
        let at = Progress { used, ..start };
        match planning.clone().assess(&at, mission.available(), None) {
            Assessed::Keeps => None,
            Assessed::Fails(cause, _) => Some(cause),
            Assessed::Planned => planning.made.last().map(|it| it.cause),
        }
    };
    assert_eq!(cause(left), None);
    let margin = |axis| Some(PlanCause::Margin { axis });
    assert_eq!(cause(left.map(|it| it + 1)), margin(mission.order[0]));
}

#[test]
fn an_activity_is_under_way_at_its_start() {
    let delivery = embedded::mission("delivery").unwrap();
    let zone = "[[zone]]\nid = \"hall\"\nx_start_mm = 60000\nx_end_mm = 70000\n[run]";
    let text = delivery.text.replacen("[run]", zone, 1);
    let mission = Mission::parse(delivery.name, &text).unwrap();
    let of = Plannable::new(&mission, &Options::default()).unwrap();
    let start = Progress::start(Millimetres(0));
    let planning = Planning::start(&of, &start, mission.available()).unwrap();
    let at = |x_mm: u64| planning.activity(2, x_mm);
    // The first drive, the object, and three parts of the second drive.
    assert_eq!([40_000, 59_999, 60_000, 69_999, 70_000, 80_000].map(at), [2, 2, 3, 3, 4, 4]);
}
