//! A formula that is written and read is the same formula.

use crate::properties::random::{NAMES, Random, branching, net, path, quantified, state};
use cotama_core::net::TransitionId;
use cotama_verification::property::{Assumptions, Formula, Question, parse};
use cotama_verification::pt::Pt;

fn assert_read_back(question: &Question, net: &Pt) {
    let text = question.display(net).to_string();
    match parse(&text, net) {
        Ok(property) => assert_eq!(&property.question, question, "{text}"),
        Err(error) => panic!("{text}\n{error}"),
    }
}

#[test]
fn random_formulas_are_read_back() {
    let mut random = Random(11);
    for round in 0..20_000 {
        let mut net = net(&mut random);
        for name in net.places.iter_mut().chain(&mut net.transitions) {
            let odd = random.below(2) == 0;
            *name = if odd { format!("{}{name}", random.choose(&NAMES)) } else { name.clone() };
        }
        if round % 5 == 0 {
            net.places[0] = (*random.choose(&NAMES)).to_owned();
        }
        let path = path(&mut random, &net, 5, true);
        let path =
            if random.below(9) == 0 { Formula::Within(random.next(), path.into()) } else { path };
        let formula = quantified(&mut random, path);
        assert_read_back(&Question::Formula(formula.clone()), &net);
        assert_read_back(&Question::Formula(formula.simplified()), &net);
    }
}

#[test]
fn random_assumptions_are_read_back() {
    let mut random = Random(13);
    for _ in 0..2_000 {
        let net = net(&mut random);
        let some = |random: &mut Random| -> Vec<_> {
            (0..net.transitions.len() as u32)
                .map(TransitionId)
                .filter(|_| random.below(3) == 0)
                .collect()
        };
        let (weak, strong) = (some(&mut random), some(&mut random));
        let often = (0..=random.below(2)).map(|_| state(&mut random, &net, 2)).collect();
        let formula = branching(&mut random, &net, 3);
        assert_read_back(&Question::Fair(formula, Assumptions { weak, strong, often }), &net);
    }
}

#[test]
fn numbers_at_the_limits_are_read_back() {
    let net = net(&mut Random(12));
    for text in [
        "9223372036854775807 * p0 <= 9223372036854775807 * p1",
        "p0 <= 9223372036854775807",
        "p0 - 9223372036854775807 - 1 <= p1",
        "0 - 9223372036854775807 * p0 >= p1",
        "9223372036854775808 * p0 >= 1",
        "p0 = p1 + 9223372036854775807",
        "3 <= 2",
        "0 = 0",
        "AF<=18446744073709551615ms p0",
    ] {
        assert_read_back(&parse(text, &net).unwrap().question, &net);
    }
}
