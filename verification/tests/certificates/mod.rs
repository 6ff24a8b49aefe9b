//! Certificates: what they show, and that nothing else is believed.

mod engines;
mod graph;
mod inductive;
mod lasso;
mod mutations;
mod parts;
mod random;
mod refutation;
mod search;
mod small;
mod stories;
mod trace;

use cotama_verification::certificate::{Certificate, verify};
use serde_json::Value;

/// Returns the proven statement of a certificate, in words.
fn shown(certificate: &Certificate) -> String {
    verify(&certificate.text())
        .unwrap_or_else(|error| panic!("{error}\n{}", certificate.text()))
        .to_string()
}

/// Why a certificate is refused when the value at a place in its JSON is another one.
fn refused(certificate: &Certificate, pointer: &str, other: Value) -> String {
    let mut json: Value = serde_json::from_str(&certificate.text()).unwrap();
    let place = json
        .pointer_mut(pointer)
        .unwrap_or_else(|| panic!("no {pointer} in {}", certificate.text()));
    assert_ne!(*place, other, "{pointer} is not changed");
    *place = other;
    verify(&json.to_string()).expect_err("is refused").to_string()
}

/// How many of a few changes at random are refused, at most so many; the opposite verdict always
/// is.
fn mutated(certificate: &Certificate, dice: &mut random::Dice, most: usize) -> usize {
    let json: Value = serde_json::from_str(&certificate.text()).unwrap();
    refused(certificate, "/verdict", Value::Bool(!certificate.verdict));
    let tries = (0..10 * most).filter(|_| {
        let mut other = json.clone();
        mutations::change(&mut other, dice);
        other != json && verify(&other.to_string()).is_err()
    });
    tries.take(most).count()
}

/// Checks that all these changes are refused, with these words.
fn all_refused(certificate: &Certificate, changes: Vec<(&str, Value, &str)>) {
    for (pointer, other, words) in changes {
        assert_eq!(refused(certificate, pointer, other.clone()), words, "{pointer} = {other}");
    }
}
