//! Broken texts and files of all kinds: they are read or refused, and nothing else happens.

use crate::properties::random::{NAMES, Random, branching, net, path, quantified};
use cotama_verification::property::{Ids, Question, mcc, parse};

const WORDS: [&str; 51] = [
    "A",
    "E",
    "X",
    "F",
    "G",
    "U",
    "AX",
    "EF",
    "AG",
    "and",
    "or",
    "not",
    "true",
    "false",
    "deadlock",
    "fireable(",
    "bounds(",
    "bound(",
    " assuming ",
    "weak(",
    "often(",
    "live",
    "(",
    ")",
    "[",
    "]",
    "<->",
    "->",
    "<=",
    "<",
    "=",
    "!=",
    "|",
    "&",
    "!",
    "+",
    "-",
    "*",
    ",",
    "\"",
    "{",
    "}",
    "\\",
    "\\u{",
    "18446744073709551615",
    "<=5ms",
    "<=7s",
    "p0",
    "t0",
    "é",
    "\u{202e}",
];

fn mutate(random: &mut Random, text: &mut Vec<u8>, words: &[&str]) {
    for _ in 0..=random.below(2) {
        let at = random.below(text.len() + 1);
        let end = (at + random.below(12)).min(text.len());
        match random.below(5) {
            0 => drop(text.drain(at..end)),
            1 => {
                let part = text[at..end].to_vec();
                let to = random.below(text.len() + 1);
                text.splice(to..to, part);
            }
            2 => {
                if let Some(byte) = text.get_mut(at) {
                    *byte = random.next() as u8;
                }
            }
            3 => text.truncate(at),
            _ => drop(text.splice(at..at, random.choose(words).bytes())),
        }
    }
}

/// How many mutated inputs: `MUTATED_INPUTS` asks for a longer run.
fn inputs(usual: usize) -> usize {
    std::env::var("MUTATED_INPUTS").map_or(usual, |it| it.parse().unwrap())
}

#[test]
fn a_hundred_thousand_mutated_texts_are_read_or_refused() {
    let mut random = Random(21);
    let (mut read, mut refused) = (0, 0);
    while read + refused < inputs(100_000) {
        let mut net = net(&mut random);
        net.places[0] = (*random.choose(&NAMES)).to_owned();
        let original = if random.below(2) == 0 {
            branching(&mut random, &net, 3)
        } else {
            let path = path(&mut random, &net, 3, true);
            quantified(&mut random, path)
        };
        let original = original.display(&net).to_string();
        for _ in 0..20 {
            let mut bytes = original.clone().into_bytes();
            mutate(&mut random, &mut bytes, &WORDS);
            let text = String::from_utf8_lossy(&bytes);
            match parse(&text, &net) {
                Ok(property) => {
                    read += 1;
                    let written = property.question.display(&net).to_string();
                    assert_eq!(
                        parse(&written, &net).map(|it| it.question),
                        Ok(property.question),
                        "{text}"
                    );
                }
                Err(error) => {
                    refused += 1;
                    assert!(text.get(error.at.span.clone()).is_some(), "{text:?}: {error:?}");
                    assert!(!error.to_string().is_empty());
                }
            }
        }
    }
    assert!(read > 5_000 && refused > 5_000, "{read} read, {refused} refused");
}

const ELEMENTS: [&str; 24] = [
    "<property-set>",
    "</property-set>",
    "<property>",
    "</property>",
    "<id>",
    "</id>",
    "<formula>",
    "</formula>",
    "<all-paths>",
    "</all-paths>",
    "<finally>",
    "</finally>",
    "<negation>",
    "</negation>",
    "<true/>",
    "<deadlock/>",
    "<place>",
    "</place>",
    "&amp;",
    "&#0;",
    "&#x110000;",
    "<![CDATA[",
    "<!--",
    "]]>",
];

#[test]
fn twenty_thousand_mutated_files_are_read_or_refused() {
    let file = "\u{feff}<?xml version=\"1.0\"?>\n<property-set xmlns=\"http://mcc.lip6.fr/\">\
        <property><id>a</id><description>é</description>
        <formula><all-paths><globally><disjunction><integer-le><tokens-count><place>p0</place>\
        <place>p1</place></tokens-count>
        <integer-sum><integer-constant>3</integer-constant><integer-constant>9223372036854775804\
        </integer-constant></integer-sum></integer-le>
        <exists-path><until><before><true/></before><reach><is-fireable><transition>t0</transition>\
        </is-fireable></reach></until></exists-path>
        </disjunction></globally></all-paths></formula></property><!-- b -->
        <property><id>b</id><formula><place-bound><place>p0</place></place-bound></formula>\
        </property>
        <property><id>c</id><formula><equivalence><deadlock/><negation><false></false></negation>\
        </equivalence></formula></property></property-set>";
    let mut random = Random(22);
    let net = net(&mut random);
    assert_eq!(mcc::read("file", file.as_bytes(), &net, Ids::default()).map(|it| it.len()), Ok(3));
    let mut read = 0;
    for _ in 0..inputs(20_000) {
        let mut bytes = file.as_bytes().to_vec();
        mutate(&mut random, &mut bytes, &ELEMENTS);
        if random.below(4) == 0 {
            mutate(&mut random, &mut bytes, &WORDS);
        }
        match mcc::read("file", &bytes, &net, Ids::default()) {
            Ok(properties) => {
                read += 1;
                for property in properties {
                    let Question::Formula(formula) = property.question else { continue };
                    let _ = formula.simplified();
                }
            }
            Err(error) => assert!(error.to_string().starts_with("file:")),
        }
    }
    assert!(read > 500, "{read}");
}
