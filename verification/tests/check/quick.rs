//! Nets with more markings than anybody passes through: what the structure and a few firings say.

use crate::check::{folder, replay};
use cotama_models::nets::find;
use cotama_verification::certificate::verify;
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::pnml::{Limits, read_within};
use cotama_verification::property;
use cotama_verification::pt::Pt;

/// Answers a question and shows the answer by its run, by its certificate, or by both.
fn answer(pt: Pt, text: &str) -> Verdict {
    let property = property::parse(text, &pt).unwrap();
    let model = Model::from(pt);
    let answer = check(&model, &property, &Options { evidence: true, ..Options::default() });
    let run = replay::replays(model.pt(), &property.question, &answer);
    let certificate = answer.certificate(model.pt(), &property);
    if let Ok(it) = &certificate {
        verify(&it.text()).unwrap_or_else(|error| panic!("{text}: {error}"));
    }
    assert!(run || certificate.is_ok(), "{text}: neither a run nor a certificate: {answer:?}");
    answer.verdict
}

fn family(name: &str) -> Pt {
    Pt::from(&find(name).unwrap().view().net())
}

#[test]
fn two_thousand_cards_never_stop() {
    assert_eq!(answer(family("kanban:2000"), "EF deadlock"), Verdict::Holds(false));
}

#[test]
fn two_hundred_philosophers_stop() {
    assert_eq!(answer(family("philosophers:200"), "EF deadlock"), Verdict::Holds(true));
}

#[test]
fn large_public_nets_are_decided_and_the_decision_is_shown() {
    let Some(folder) = folder("large public nets") else { return };
    let public = |name: &str| {
        let bytes = std::fs::read(folder.join(name.to_owned() + ".pnml")).unwrap();
        Pt::from(&read_within("net", &bytes, Limits::default()).unwrap().net.view().net())
    };
    assert_eq!(answer(public("DiscoveryGPU-PT-15a"), "EF deadlock"), Verdict::Holds(true));
    assert_eq!(answer(public("Peterson-PT-3"), "EF deadlock"), Verdict::Holds(false));
    let lamport = public("LamportFastMutEx-PT-3");
    let critical: Vec<_> = lamport.places.iter().filter(|it| it.starts_with("P-CS_21_")).collect();
    assert_eq!(critical.len(), 4);
    let quoted: Vec<_> = critical.iter().map(|it| format!("\"{it}\"")).collect();
    let exclusive = format!("AG {} <= 1", quoted.join(" + "));
    assert_eq!(answer(lamport, &exclusive), Verdict::Holds(true));
}
