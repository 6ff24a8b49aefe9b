//! Limits of the property language: lengths of texts and depths of formulas.

use super::language::{P, formula, marked, net};
use cotama_verification::property::{MAX_DEPTH, MAX_TEXT, Question, parse};

/// Reads a text of this depth, on a stack of 1 MiB.
fn nested(text: String) -> Result<usize, String> {
    let read = move || {
        let property = parse(&text, &net()).map_err(|error| error.to_string())?;
        let Question::Formula(formula) = &property.question else { panic!("not a formula") };
        Ok(formula.simplified().display(&net()).to_string().len()
            + formula.clone().display(&net()).to_string().len())
    };
    std::thread::Builder::new().stack_size(1 << 20).spawn(read).unwrap().join().unwrap()
}

#[test]
fn texts_may_be_nested_so_deep_and_no_deeper_on_a_small_stack() {
    type Text = fn(usize) -> String;
    // With how many bytes a level takes.
    let texts: [(Text, usize); 5] = [
        (|depth| format!("{}p{}", "(".repeat(depth), ")".repeat(depth)), 2),
        (|depth| format!("{}p", "!".repeat(depth)), 1),
        (|depth| format!("A {}p", "X ".repeat(depth - 1)), 2),
        (|depth| format!("{}p", "p -> ".repeat(depth)), 5),
        (|depth| format!("A[{}p]", "p U ".repeat(depth - 1)), 4),
    ];
    for (text, bytes) in texts {
        assert!(nested(text(MAX_DEPTH)).is_ok());
        for depth in [MAX_DEPTH + 1, MAX_TEXT / bytes - 16] {
            let said = nested(text(depth)).unwrap_err();
            assert!(said.contains("operators are nested more than 128 deep"), "{said}");
        }
    }
    let mixed = |depth: usize| format!("EF {}p{}", "(p & EF ".repeat(depth), ")".repeat(depth));
    assert!(nested(mixed((MAX_DEPTH - 1) / 2)).is_ok());
    assert!(nested(mixed(MAX_DEPTH / 2)).is_err());
}

#[test]
fn a_text_may_be_long_and_no_longer() {
    let text = "p & ".repeat(MAX_TEXT / 4 - 1) + "p";
    assert_eq!(formula(&text).simplified(), marked(P));
    let error = parse(&"p".repeat(MAX_TEXT + 1), &net()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "property:1:1: the text has 1048577 bytes, more than 1048576\n  help: ask for its parts \
         one by one"
    );
}

#[test]
fn equivalences_may_not_double_a_formula_for_ever() {
    assert!(parse(&("p <-> ".repeat(12) + "p"), &net()).is_ok());
    for text in
        ["p <-> ".repeat(40) + "p", format!("({}p) & ", "p <-> ".repeat(12)).repeat(1_000) + "p"]
    {
        let error = parse(&text, &net()).unwrap_err();
        assert_eq!(error.message, "the formula is too long when its equivalences are written out");
    }
}
