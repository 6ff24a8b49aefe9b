//! The printed diagnoses of ten small nets.

use crate::diagnosis::{diagnosis, golden, nets, parse, timed_diagnosis, words};
use cotama_core::net::TransitionId;
use cotama_verification::diagnosis::{Case, Diagnosis, Run, Unused, vacuous};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::property::{Formula, Question};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{self, Verdict};

#[test]
fn philosophers_wait_for_each_other() {
    golden("philosophers.txt", &diagnosis(&nets::philosophers(), "AG !deadlock").to_string());
}

#[test]
fn two_trains_meet_in_one_section() {
    let text = diagnosis(&nets::trains(), "AG !(west_in_section & east_in_section)").to_string();
    golden("trains.txt", &text);
}

#[test]
fn a_mailbox_overflows() {
    golden("mailbox.txt", &diagnosis(&nets::mailbox(), "AG mailbox <= 3").to_string());
}

#[test]
fn both_lights_are_green() {
    golden("crossing.txt", &timed_diagnosis(&nets::crossing(), "AG !(Walk & Green)").to_string());
}

#[test]
fn a_charger_stays_switched_on_in_the_heat() {
    golden("charger.txt", &diagnosis(&nets::charger(), "AG !(on & hot)").to_string());
}

#[test]
fn a_watchdog_loses_its_timeout() {
    golden("watchdog.txt", &timed_diagnosis(&nets::watchdog(), "AG !overdue").to_string());
}

#[test]
fn a_request_is_never_served() {
    golden("server.txt", &diagnosis(&nets::server(), "AG (request -> AF served)").to_string());
}

#[test]
fn belts_hold_more_than_their_bound() {
    golden("belts.txt", &diagnosis(&nets::belts(), "AG belt_a + belt_b <= 3").to_string());
}

#[test]
fn an_alarm_is_never_raised() {
    let net = nets::alarm();
    let pt = Pt::from(&net.view().net());
    let mut said = String::new();
    for text in [
        "AG (hard_fault -> AF standing)",
        "AG !(hard_fault & driving)",
        "AG (soft_fault -> EF !soft_fault)",
    ] {
        let property = parse(&pt, text);
        let Question::Formula(formula) = &property.question else { panic!("not a formula") };
        let limits = Limits { states: 10_000, ..Limits::default() };
        let holds = |it: &Formula| {
            matches!(
                temporal::answer(&pt, it, &limits, &|_| ()),
                Verdict::Known { holds: true, .. }
            )
        };
        let mut words = vacuous(formula)
            .asked
            .into_iter()
            .filter(|it| holds(&it.formula))
            .map(|it| it.words(text, &pt));
        said += &words.next().unwrap_or_else(|| format!("`{text}` is put to the test."));
        said += "\n";
    }
    golden("alarm.txt", &said);
}

/// Returns the parts that no run fires or marks.
fn unused(pt: &Pt) -> Unused<'_> {
    let graph = Graph::new(pt, &Limits::default(), &|_| ()).unwrap();
    let (mut fired, mut marked) = (vec![false; pt.transitions.len()], vec![false; pt.places.len()]);
    for state in 0..graph.states() as u32 {
        for TransitionId(it) in graph.transitions(state) {
            fired[it as usize] = true;
        }
        for (it, tokens) in marked.iter_mut().zip(graph.marking(state)) {
            *it |= tokens > 0;
        }
    }
    Unused::new(pt, &fired, &marked)
}

#[test]
fn two_transitions_are_never_used() {
    let mut net = nets::alarm();
    // Without the unbounded place.
    net.transitions.retain(|it| it.name != "warm_up");
    let pt = Pt::from(&net.view().net());
    golden("unused.txt", &unused(&pt).to_string());
    golden("unused_page.txt", &words(&unused(&pt).html(Some(&net.view().net()))));
    golden("unused.svg", &unused(&pt).svg(Some(&net.view().net())));
    let trains = Pt::from(&nets::trains().view().net());
    assert!(unused(&trains).is_empty());
    let words = "Every transition fires in some run, and every place is marked in one.\n";
    assert_eq!(unused(&trains).to_string(), words);
}

#[test]
fn a_long_run_is_shown_without_its_middle() {
    let places: Vec<(String, u32)> =
        (0..60).map(|at| (format!("stage_{at}"), u32::from(at == 0))).collect();
    let places: Vec<_> = places.iter().map(|it| (it.0.as_str(), it.1, "")).collect();
    let mut net = nets::Sketch::new("pipeline", "", &places);
    for at in 1..60 {
        net =
            net.line(&format!("advance_{at}"), &format!("stage_{} -> stage_{at}", at - 1), "", "");
    }
    golden("pipeline.txt", &diagnosis(&net.0, "AG !stage_59").to_string());
}

#[test]
fn other_questions_have_their_own_words() {
    let net = nets::belts();
    let view = net.view();
    let pt = Pt::from(&view.net());
    let fire =
        |names: &[&str]| names.iter().map(|it| pt.transition(it).unwrap()).collect::<Vec<_>>();
    let say = |text: &str, holds: bool, names: &[&str]| {
        let property = parse(&pt, text);
        let run = Run::to(fire(names));
        let it = Diagnosis::new(&Case::new(&pt, &property, holds, &run)).unwrap();
        format!("{}\n{}\n{}\n", it.summary, it.cause, it.notes.join("\n"))
    };
    let bound = "\
`bounds(belt_a + belt_b)`: after 3 firings `belt_a` + `belt_b` hold 4 tokens.
`load_one` fired: it raised `belt_a` + `belt_b` to the most.
`belt_a` + `belt_b` grew to 1 at step 1 (`load_one`), 3 at step 2 (`load_pair`) and 4 at step 3 \
(`load_one`).
";
    assert_eq!(say("bounds(belt_a + belt_b)", true, &["load_one", "load_pair", "load_one"]), bound);
    let one_safe = "\
`one_safe` does not hold: at the start `crates` holds 5 tokens.
it is so from the start.

";
    assert_eq!(say("one_safe", false, &[]), one_safe);
    let response = "\
`bound(load_one -> shipped)`: `load_one` fires after 1 firing, and `shipped` is marked after 2 \
firings.


";
    assert_eq!(say("bound(load_one -> shipped)", true, &["load_one", "unload_b"]), response);
    let witness = "\
`EF (shipped = 2 & crates <= 3)` holds: after 3 firings `shipped` holds 2 tokens and `crates` \
holds 3 tokens.
`unload_a` fired while `crates` held 3 tokens: it raised `shipped` from 1 to 2.
`shipped` grew to 1 at step 2 (`unload_a`) and 2 at step 3 (`unload_a`).
";
    let fired = ["load_pair", "unload_a", "unload_a"];
    assert_eq!(say("EF (shipped = 2 & crates <= 3)", true, &fired), witness);
}
