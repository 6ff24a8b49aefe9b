//! The diagnosis of a verdict for a person, byte for byte, on small nets; and the truth of its
//! contents.
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

/// Returns the words of a page, in its lines: without style, script, pictures and tags.
fn words(page: &str) -> String {
    let without = |page: String, element: &str| -> String {
        let (start, end) = (format!("<{element}"), format!("</{element}>"));
        let mut parts = page.split(&start);
        let first = parts.next().unwrap_or_default().to_owned();
        first + &parts.map(|it| it.split_once(&end).expect(&end).1).collect::<String>()
    };
    let page =
        ["style", "script", "svg"].iter().fold(page.to_owned(), |it, name| without(it, name));
    let page = page.replace("</td>", " | ").replace("</th>", " | ").replace("</code> <code>", ", ");
    let text = |line: &str| {
        let parts = line.split('<').map(|it| it.split_once('>').map_or(it, |it| it.1));
        parts.collect::<String>().trim().trim_end_matches(" |").to_owned()
    };
    let lines = page.lines().map(text).filter(|it| !it.is_empty());
    lines.flat_map(|it| [it, "\n".to_owned()]).collect()
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
