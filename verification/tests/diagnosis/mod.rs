//! What a person sees of a verdict, byte for byte, on small nets; and that what is shown is so.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test nets diagnosis` writes the expected
//! files anew.

mod goldens;
mod nets;
mod pages;
mod player;
mod robust;
mod shrinking;
mod vacuity;

use cotama_core::net::owned::OwnedNet;
use cotama_verification::diagnosis::{Case, Diagnosis, Run};
use cotama_verification::explicit::Limits;
use cotama_verification::property::{self, Property, Question, Reachability};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{self, Verdict};
use cotama_verification::tpn;
use std::path::Path;

/// Compares with a file of `tests/golden/diagnosis`.
fn golden(file: &str, text: &str) {
    cotama_golden::compare(Path::new("tests/golden/diagnosis").join(file), text);
}

fn parse(pt: &Pt, text: &str) -> Property {
    property::parse(text, pt).unwrap_or_else(|error| panic!("{error}"))
}

/// The verdict on a formula, and the run that shows it.
fn checked(pt: &Pt, property: &Property) -> (bool, Run) {
    let Question::Formula(formula) = &property.question else { panic!("not a formula") };
    match temporal::answer(pt, formula, &Limits::default(), &|_| ()) {
        Verdict::Known { holds, run: Some(run), .. } => (holds, run),
        other => panic!("{}: {other:?}", property.name),
    }
}

/// The diagnosis of a formula on a net without time.
fn diagnosis(net: &OwnedNet, text: &str) -> Diagnosis {
    let view = net.view();
    let net = view.net();
    assert_eq!(net.defect(), None);
    let pt = Pt::from(&net);
    let property = parse(&pt, text);
    let (holds, run) = checked(&pt, &property);
    Diagnosis::new(&Case::new(&pt, &property, holds, &run).with_net(&net)).unwrap()
}

/// A run of a net in time to what a formula forbids or asks for.
fn timed(net: &OwnedNet, text: &str) -> (Property, bool, tpn::Schedule) {
    let view = net.view();
    let (net, pt) = (view.net(), Pt::from(&view.net()));
    let property = parse(&pt, text);
    let Question::Formula(formula) = &property.question else { panic!("not a formula") };
    let asked = Reachability::new(formula).expect("one marking decides");
    let goal = property::Condition::new(&asked.goal, &pt).expect("of one marking");
    let converted = tpn::from_net(&net).unwrap();
    match tpn::reach(&converted.net, |it| goal.holds(it), &tpn::Limits::default()) {
        tpn::Reach::Reached(schedule) => (property, asked.expected, schedule),
        other => panic!("{text}: {other:?}"),
    }
}

/// The diagnosis of a formula on a net in time.
fn timed_diagnosis(net: &OwnedNet, text: &str) -> Diagnosis {
    let (property, holds, schedule) = timed(net, text);
    let view = net.view();
    let net = view.net();
    let run = Run::to(schedule.steps.iter().map(|it| it.transition).collect());
    let pt = Pt::from(&net);
    Diagnosis::new(&Case::new(&pt, &property, holds, &run).with_net(&net).with_schedule(&schedule))
        .unwrap()
}
