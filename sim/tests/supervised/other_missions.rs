//! Missions of the same objectives in another order: their global supervisor is made from the file.

use cotama_models::cotama::FailureMode;
use cotama_models::missions::Mission;
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};

const OBJECTIVES: &str = r#"
[[objective]]
id = "Fetch"
does = "drive"
x_start_mm = 0
x_end_mm = 6000
tasks = ["MOV"]
[[objective]]
id = "Load"
does = "receive"
x_start_mm = 6000
x_end_mm = 6000
tasks = ["RCV"]
[[objective]]
id = "Rest"
does = "wait"
x_start_mm = 6000
x_end_mm = 6000
tasks = ["WAI"]
[[objective]]
id = "Bring"
does = "drive"
x_start_mm = 6000
x_end_mm = 9000
tasks = ["MOV"]
[[objective]]
id = "Hand"
does = "deliver"
x_start_mm = 9000
x_end_mm = 9000
tasks = ["DLV"]
[[objective]]
id = "Return"
does = "drive"
x_start_mm = 9000
x_end_mm = 12000
tasks = ["MOV"]
[[tio]]
id = "rest"
task = "WAI"
needs = { P3D = 1 }
duration_ms = 5000
power_mw = 4600
"#;

/// Three drives and a rest, with the robot of the delivery.
fn rounds_of_the_office() -> Mission {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap().text;
    let robot = delivery.split("[[objective]]").next().unwrap();
    let text = robot.replace("path_length_mm = 80000", "path_length_mm = 12000") + OBJECTIVES;
    Mission::parse("office", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn run(injections: Vec<Injection>) -> Run {
    let mission = rounds_of_the_office();
    Supervised::new(&mission).unwrap().run(&Script { injections, answers: Vec::new() }).unwrap()
}

fn global(run: &Run) -> Vec<&str> {
    run.fired.iter().filter(|it| it.net == "gs").map(|it| it.transition.as_str()).collect()
}

#[test]
fn the_objectives_are_done_in_their_order() {
    let run = run(Vec::new());
    assert_eq!((run.outcome, run.x.0), (Outcome::Completed, 12_000));
    assert_eq!(global(&run).len(), 7);
}

#[test]
fn a_vital_loss_ends_it_from_anywhere() {
    let run = run(vec![Injection::new(
        When::Place(cotama_core::units::Millimetres(10_000)),
        FailureMode::Bat3,
    )]);
    assert_eq!(run.outcome, Outcome::Safe);
    assert!(!run.moved_when_safe);
    println!("{:?}", global(&run));
}
