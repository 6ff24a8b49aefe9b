//! The patrol with five limited axes on its way.
#![allow(clippy::unwrap_used)]

use cotama_axes::{Ask, Case, Course, Event, ModelError, PATROL, Script, Sense, What};
use cotama_tours::{Cause, Outcome, Run, run};

fn patrol() -> Case {
    Case::parse(PATROL).unwrap()
}

fn of(case: &Case, indicator: &str) -> usize {
    case.mission.indicator(indicator).unwrap()
}

fn driven(case: &Case, script: Script) -> Run {
    run(&Case { course: Course { script, home: None }, ..case.clone() }).unwrap()
}

fn error(case: &Case, indicator: &str, permille: i64) -> Script {
    let error = ModelError { indicator: of(case, indicator), zone: None, permille };
    Script { errors: vec![error], ..Script::default() }
}

/// The constraints whose margins made it plan again, by name, with the metre of the path.
fn again(case: &Case, run: &Run) -> Vec<(String, i64)> {
    let plans = run.plans.iter().filter_map(|it| match it.cause {
        Cause::Margin(at) => Some((case.mission.constraints[at].id.clone(), it.x_mm / 1_000)),
        Cause::Start | Cause::Lost(_) => None,
    });
    plans.collect()
}

#[test]
fn each_end_axis_makes_the_robot_plan_again_and_finish_within_it() {
    let case = patrol();
    // The wishes of the file leave nothing to save: here plans use what they may.
    let most = |indicator: &str| {
        let ask = vec![Ask { sense: Sense::Max, indicator: of(&case, indicator) }];
        Case { ask, ..case.clone() }
    };
    let (slow, strong) = (most("localisation.located"), most("energy.RC"));
    let wait = What::Costs(vec![(of(&case, "duration.MD"), 90_000)]);
    let late = Script { events: vec![Event { x_mm: 70_000, what: wait }], ..Script::default() };
    for (case, script, limit) in [
        (&slow, late, ("duration", 70)),
        (&strong, error(&case, "energy.RC", 80), ("energy", 107)),
        (&strong, error(&case, "energy.LC", 10), ("laptop", 2)),
        (&strong, error(&case, "localisation.located", -20), ("located", 52)),
        (&strong, error(&case, "data.volume", 20), ("data", 18)),
    ] {
        let run = driven(case, script);
        let first = again(case, &run).into_iter().next().unwrap();
        assert_eq!((first.0.as_str(), first.1), limit);
        assert_eq!(run.outcome, Outcome::Completed, "{limit:?}");
    }
}

#[test]
fn a_robot_that_loses_both_lasers_goes_on_at_the_speeds_of_sonars() {
    let case = patrol();
    let laser = case.mission.hardware.iter().position(|it| it.id == "laser").unwrap();
    let lost = Event { x_mm: 130_000, what: What::Lost(laser, 2) };
    let run = driven(&case, Script { events: vec![lost], ..Script::default() });
    assert_eq!((run.outcome, run.plans.len()), (Outcome::Completed, 2));
    let speeds = |at: usize| -> Vec<_> {
        let all = run.plans[at].choices.iter().filter(|it| it.objective == 8);
        all.map(|it| (it.x_start_mm / 1_000, it.speed_mm_s)).collect()
    };
    assert_eq!(speeds(0), [(93, 560), (123, 410), (146, 330), (156, 410)]);
    assert_eq!(speeds(1), [(130, 330), (146, 330), (156, 330)]);
    assert_eq!(run.plans[1].cause, Cause::Lost(laser));
}

#[test]
fn a_robot_that_no_plan_is_left_for_stands_where_it_is() {
    let case = patrol();
    let laser = case.mission.hardware.iter().position(|it| it.id == "laser").unwrap();
    let lost = Event { x_mm: 70_000, what: What::Lost(laser, 2) };
    let run = driven(&case, Script { events: vec![lost], ..Script::default() });
    assert_eq!((run.outcome, run.x_mm), (Outcome::Stopped, 70_000));
}
