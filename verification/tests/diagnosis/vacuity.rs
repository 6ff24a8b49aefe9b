//! Which questions tell that a property holds for a reason that is none.

use crate::diagnosis::{nets, parse};
use cotama_verification::diagnosis::vacuous;
use cotama_verification::property::Question;
use cotama_verification::pt::Pt;

/// The questions, as texts.
fn asked(text: &str) -> Vec<String> {
    let pt = Pt::from(&nets::alarm().view().net());
    let Question::Formula(formula) = parse(&pt, text).question else { panic!("not a formula") };
    vacuous(&formula).asked.iter().map(|it| it.formula.display(&pt).to_string()).collect()
}

#[test]
fn an_implication_asks_whether_its_condition_comes_and_whether_it_is_needed() {
    assert_eq!(asked("AG (soft_fault -> driving)"), ["AG soft_fault <= 0", "AG driving"]);
    assert_eq!(asked("AG (soft_fault -> AF logged)"), ["AG soft_fault <= 0", "AG AF logged"]);
}

#[test]
fn an_exclusion_asks_whether_each_side_comes_at_all() {
    assert_eq!(asked("AG !(soft_fault & driving)"), ["AG driving <= 0", "AG soft_fault <= 0"]);
}

#[test]
fn an_equation_is_one_part() {
    assert_eq!(asked("AG (driving -> logged = 0)"), ["AG logged <= 0", "AG driving <= 0"]);
}

#[test]
fn a_property_of_one_part_has_no_stronger_question() {
    assert!(asked("AG driving").is_empty());
    assert!(asked("EF (driving & logged)").is_empty());
}

#[test]
fn an_alternative_that_makes_no_difference_is_said() {
    let pt = Pt::from(&nets::alarm().view().net());
    let text = "AG (driving | logged | standing)";
    let Question::Formula(formula) = parse(&pt, text).question else { panic!("not a formula") };
    let words: Vec<String> = vacuous(&formula).asked.iter().map(|it| it.words(text, &pt)).collect();
    let second = "`AG (driving | logged | standing)` holds vacuously: `AG (driving | standing)` \
        holds already, so `logged` makes no difference.";
    assert_eq!(words[1], second);
}

#[test]
fn of_a_large_formula_only_some_questions_are_made() {
    // Each of them doubles what is inside: twelve of them took all memory.
    let pt = Pt::from(&nets::alarm().view().net());
    let nested = (0..12).fold("driving".to_owned(), |it, _| format!("({it} <-> logged)"));
    let Question::Formula(formula) = parse(&pt, &format!("AG {nested}")).question else {
        panic!("not a formula")
    };
    let found = vacuous(&formula);
    assert!(!found.is_complete && found.asked.len() < 1_000, "{}", found.asked.len());
    let Question::Formula(formula) = parse(&pt, "AG (driving -> logged)").question else {
        panic!("not a formula")
    };
    assert!(vacuous(&formula).is_complete);
}
