//! The page of claims, written from `tests/claims.toml` and the figures that tests assert.

use super::{grouped, root};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;

/// How a claim may be known, and what that says; an ellipsis stands for a bound that is named.
const WORDS: [(&str, &str); 11] = [
    ("compile time", "no program that breaks it can be built"),
    ("checker (…)", "it holds in all so many states of the model"),
    ("exhaustive (…)", "it holds for all so many cases of the bound, and no more is said"),
    ("machine code, all inputs (…)", "all paths of the compiled code were explored"),
    ("no panic reachable (…)", "the linker finds no way to a panic, whatever the arguments"),
    ("Kani (run by Kani)", "Kani holds it for all inputs within the bound"),
    ("Kani harness, not yet run by Kani", "written for Kani, and run by what is named beside it"),
    ("property test (…)", "no counterexample was met among so many drawn cases; no proof"),
    ("sampled", "no counterexample was met among chosen or drawn cases; no proof"),
    ("simulation", "so it went in the runs of a model of the robot; not the robot itself"),
    ("pending", "claimed by nobody yet"),
];

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Claims {
    topics: Vec<Topic>,
    #[serde(rename = "claims")]
    pub(super) all: Vec<Claim>,
    before: Vec<Before>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Topic {
    letter: char,
    title: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Claim {
    pub(super) id: String,
    #[serde(rename = "claim")]
    says: String,
    known: Vec<String>,
    #[serde(default)]
    how: String,
    pub(super) run: Vec<String>,
    #[serde(rename = "where")]
    pub(super) places: Vec<String>,
}

/// What claims said before.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Before {
    of: Vec<String>,
    said: String,
}

impl Claims {
    /// As they are written, the names of figures in braces.
    pub(super) fn read() -> Self {
        Self::of(&text())
    }

    fn of(text: &str) -> Self {
        toml::from_str(text).unwrap_or_else(|error| panic!("tests/claims.toml: {error}"))
    }

    fn page(&self) -> String {
        let mut page = String::from(BEGIN);
        let known: Vec<_> = self.all.iter().flat_map(|it| &it.known).collect();
        page += "\n| known by | says | claims |\n| --- | --- | ---: |\n";
        for (word, says) in WORDS {
            let count = known.iter().filter(|it| is_of(word, it)).count();
            let name = word.trim_end_matches(" (…)");
            let _ = writeln!(page, "| {name} | {says} | {count} |");
        }
        for Topic { letter, title } in &self.topics {
            let _ = write!(page, "\n## {title}\n");
            for claim in self.all.iter().filter(|it| it.id.starts_with(*letter)) {
                page += "\n";
                claim.write(&mut page);
            }
        }
        page += "\n## What claims said before\n\n";
        page += &wrapped(BEFORE, "", "");
        page += "\n";
        for Before { of, said } in &self.before {
            let of: Vec<_> = of.iter().map(|it| format!("**{it}**")).collect();
            page += &wrapped(&format!("{} {said}", of.join(", ")), "- ", "  ");
        }
        page
    }

    /// What breaks the order of the page, or its vocabulary.
    pub(super) fn defects(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        let number = |it: &Claim| {
            let (letter, number) = it.id.split_at(1);
            (letter.to_owned(), number.parse::<u32>().expect("a letter and a number"))
        };
        let order: Vec<_> = self.all.iter().map(number).collect();
        if !order.is_sorted_by(|a, b| a < b) {
            wrong.push("not in the order of ids".into());
        }
        let letters: BTreeSet<_> = order.iter().map(|it| it.0.clone()).collect();
        let topics: Vec<_> = self.topics.iter().map(|it| it.letter.to_string()).collect();
        if !letters.into_iter().eq(topics) {
            wrong.push("topics are not the letters".into());
        }
        for claim in &self.all {
            if claim.known.is_empty() || claim.run.is_empty() || claim.places.is_empty() {
                wrong.push(format!("{}: no word, no command or no place", claim.id));
            }
            for known in &claim.known {
                if WORDS.iter().filter(|it| is_of(it.0, known)).count() != 1 {
                    wrong.push(format!("{}: `{known}` is none of the words", claim.id));
                }
            }
        }
        for id in self.before.iter().flat_map(|it| &it.of) {
            if !self.all.iter().any(|it| it.id == *id) {
                wrong.push(format!("there is no claim {id}"));
            }
        }
        wrong
    }
}

impl Claim {
    /// All that it says, the names of figures in braces.
    pub(super) fn words(&self) -> String {
        format!("{} {} {}", self.says, self.known.join(" "), self.how)
    }

    fn write(&self, page: &mut String) {
        *page += &wrapped(&format!("**{}** {}", self.id, self.says), "- ", "  ");
        let known = format!("*Known:* {}. {}", self.known.join("; "), self.how);
        let places: Vec<_> = self.places.iter().map(|it| format!("`{it}`")).collect();
        *page += &wrapped(&known, "  ", "  ");
        *page += &wrapped(&format!("*Run:* {}", self.commands()), "  ", "  ");
        *page += &wrapped(&format!("*Where:* {}", places.join(", ")), "  ", "  ");
    }

    /// A command that only adds words to the one before it is said by these.
    fn commands(&self) -> String {
        let mut said = String::new();
        for (at, command) in self.run.iter().enumerate() {
            let before = at.checked_sub(1).map(|it| self.run[it].as_str());
            let added = before.and_then(|it| command.strip_prefix(it)).map(str::trim_start);
            said += if at > 0 { ", " } else { "" };
            let _ = match added {
                Some(added) => write!(said, "also with `{added}`"),
                None => write!(said, "`{command}`"),
            };
        }
        said
    }
}

const BEGIN: &str = "\
# Claims, and how each is known

Each claim has a number, what is claimed, how it is known, the commands that show it, and where. It
says no more than its test: *exact* means that a test asserts the number, *long* what waits for
`--ignored` and runs in CI, *by hand* what takes longer and does not. This page is written by a test
from [a file](../tests/claims.toml) and from the figures that other tests assert. `cotama` stands
for `cargo run --release --`.
";

const BEFORE: &str = "Claims that said more than was known, what they said, and why they say \
    something else now. The wrong ones were found by tests that looked where none had looked.";

/// The page, and the names of the figures that it shows.
pub(super) fn page(figures: &BTreeMap<String, u64>) -> (String, BTreeSet<String>) {
    let (text, names) = filled(&text(), figures);
    (Claims::of(&text).page(), names)
}

/// The file, without the lines that speak of it.
fn text() -> String {
    let text = fs::read_to_string(root().join("tests/claims.toml")).expect("the claims");
    text.lines().filter(|it| !it.starts_with('#')).flat_map(|it| [it, "\n"]).collect()
}

/// Whether a claim is known by this word.
fn is_of(word: &str, known: &str) -> bool {
    match word.strip_suffix("(…)") {
        Some(name) => known.strip_prefix(name).is_some_and(|it| it.starts_with('(')),
        None => known == word,
    }
}

/// Lines of at most 100 characters; what stands between backticks may be divided at its spaces.
fn wrapped(text: &str, first: &str, others: &str) -> String {
    let (mut lines, mut line) = (String::new(), first.to_owned());
    for word in text.split_whitespace() {
        let begins = line.len() == first.len().max(others.len());
        if !begins && line.chars().count() + 1 + word.chars().count() > 100 {
            lines += &line;
            lines += "\n";
            line.clear();
            line += others;
        } else if !begins {
            line += " ";
        }
        line += word;
    }
    lines + &line + "\n"
}

/// The text with the figures whose names stand in braces, and these names.
fn filled(text: &str, figures: &BTreeMap<String, u64>) -> (String, BTreeSet<String>) {
    let (mut page, mut names) = (String::new(), BTreeSet::new());
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once('{') {
        page += before;
        match behind.split_once('}') {
            Some((name, behind)) if !name.contains(',') => {
                let figure = figures.get(name).unwrap_or_else(|| panic!("no figure `{name}`"));
                page += &grouped(*figure);
                names.insert(name.to_owned());
                rest = behind;
            }
            _ => {
                page += "{";
                rest = behind;
            }
        }
    }
    (page + rest, names)
}

#[test]
fn figures_stand_where_their_names_are_in_braces() {
    let figures = BTreeMap::from([("a.b".to_owned(), 1_234_567)]);
    let (page, names) = filled("of {a.b}, see `x/{y,z}.rs`", &figures);
    assert_eq!(page, "of 1,234,567, see `x/{y,z}.rs`");
    assert_eq!(names, BTreeSet::from(["a.b".to_owned()]));
}

#[test]
fn a_word_is_known_by_its_name_and_a_bound_where_it_has_one() {
    assert!(is_of("checker (…)", "checker (12 states)") && !is_of("checker (…)", "checker"));
    assert!(is_of("sampled", "sampled") && !is_of("sampled", "sampled (2)"));
}
