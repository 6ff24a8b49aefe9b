//! The page of claims, `docs/claims.md`, read in its regular form: topics, and in each of them
//! items of four parts (claim, known, run, where), each part on lines of its own.

use super::{MARK, root};
use std::collections::BTreeSet;
use std::fs;

/// Words by which a claim may be known; an ellipsis stands for a bound that is named.
const WORDS: [&str; 11] = [
    "compile time",
    "checker (…)",
    "exhaustive (…)",
    "machine code, all inputs (…)",
    "no panic reachable (…)",
    "Kani (run by Kani)",
    "Kani harness, not yet run by Kani",
    "property test (…)",
    "sampled",
    "simulation",
    "pending",
];

const BEFORE: &str = "What claims said before";

/// The page as it is read.
pub(super) struct Claims {
    pub(super) all: Vec<Claim>,
    /// Ids of each topic.
    topics: Vec<Vec<String>>,
    /// Ids of claims whose earlier text is told.
    before: Vec<String>,
}

#[derive(Debug, PartialEq)]
pub(super) struct Claim {
    pub(super) id: String,
    says: String,
    known: Vec<String>,
    how: String,
    pub(super) run: Vec<String>,
    pub(super) places: Vec<String>,
}

impl Claims {
    pub(super) fn read() -> Self {
        Self::of(&fs::read_to_string(root().join("docs/claims.md")).expect("the claims"))
    }

    fn of(page: &str) -> Self {
        let (mut all, mut topics, mut before) = (Vec::new(), Vec::new(), Vec::new());
        for topic in page.split("\n## ").skip(1) {
            let items = topic.split("\n- ").skip(1);
            if topic.starts_with(BEFORE) {
                let ids = |item: &str| {
                    let bold = item.split("**").skip(1).step_by(2).map(str::to_owned);
                    bold.take_while(|it| is_id(it)).collect::<Vec<_>>()
                };
                before = items.flat_map(ids).collect();
                continue;
            }
            let claims: Vec<_> = items.map(Claim::of).collect();
            topics.push(claims.iter().map(|it| it.id.clone()).collect());
            all.extend(claims);
        }
        Self { all, topics, before }
    }

    /// Returns how many claims are known by each word, named as figures.
    pub(super) fn counts(&self) -> impl Iterator<Item = (String, u64)> {
        WORDS.iter().map(|word| {
            let known = self.all.iter().flat_map(|it| &it.known);
            let name = word.trim_end_matches("(…)").to_lowercase();
            let words =
                name.split(|it: char| !it.is_ascii_alphabetic()).filter(|it| !it.is_empty());
            let name = format!("claims.{}", words.collect::<Vec<_>>().join("-"));
            (name, known.filter(|it| is_of(word, it)).count() as u64)
        })
    }

    /// Returns the breaches of the page's order, or of its vocabulary.
    pub(super) fn defects(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        let number = |it: &Claim| (it.id[..1].to_owned(), it.id[1..].parse::<u32>());
        let order: Vec<_> = self.all.iter().map(number).collect();
        if !order.is_sorted_by(|a, b| (&a.0, a.1.as_ref().ok()) < (&b.0, b.1.as_ref().ok())) {
            wrong.push("not in the order of ids".into());
        }
        let letters = |ids: &Vec<String>| ids.iter().map(|it| it[..1].to_owned()).collect();
        let topics: Vec<BTreeSet<String>> = self.topics.iter().map(letters).collect();
        let all: BTreeSet<_> = topics.iter().flatten().collect();
        if topics.iter().any(|it| it.len() != 1) || all.len() != topics.len() {
            wrong.push("topics are not the letters".into());
        }
        for claim in &self.all {
            if !is_id(&claim.id) || claim.says.is_empty() {
                wrong.push(format!("{}: no id, or nothing claimed", claim.id));
            }
            if claim.known.is_empty() || claim.run.is_empty() || claim.places.is_empty() {
                wrong.push(format!("{}: no word, no command or no place", claim.id));
            }
        }
        for id in &self.before {
            if !self.all.iter().any(|it| it.id == *id) {
                wrong.push(format!("there is no claim {id}"));
            }
        }
        wrong
    }
}

impl Claim {
    fn of(item: &str) -> Self {
        let item = item.split_whitespace().collect::<Vec<_>>().join(" ");
        let (id, rest) = item.strip_prefix("**").and_then(|it| it.split_once("** ")).expect(&item);
        let (says, rest) = rest.split_once(" *Known:* ").expect("how a claim is known");
        let (known, rest) = rest.split_once(" *Run:* ").expect("commands of a claim");
        let (run, places) = rest.split_once(" *Where:* ").expect("places of a claim");
        let (known, how) = known_by(known);
        let places = places.split('`').skip(1).step_by(2).map(str::to_owned).collect();
        Self {
            id: id.into(),
            says: says.into(),
            known,
            how: how.into(),
            run: commands(run),
            places,
        }
    }

    /// Returns all that it says but figures, which are held to their tests.
    pub(super) fn words(&self) -> String {
        let text = format!("{} {} {}", self.says, self.known.join(" "), self.how);
        let parts: Vec<_> = text.split(MARK).collect();
        let words = parts.iter().enumerate().map(|(at, part)| {
            let part = part.split_once("-->").filter(|_| at > 0).map_or(*part, |it| it.1);
            let is_last = at + 1 == parts.len();
            part.trim_end_matches(|it: char| !is_last && (it.is_ascii_digit() || it == ','))
        });
        words.collect()
    }
}

/// Returns the words at the beginning, each with its bound, and what is said behind them.
fn known_by(text: &str) -> (Vec<String>, &str) {
    let (mut known, mut rest) = (Vec::new(), text);
    loop {
        let is_first = |word: &&&str| rest.starts_with(word.trim_end_matches("…)"));
        let word = WORDS.iter().find(is_first);
        let word = word.unwrap_or_else(|| panic!("`{rest}` begins with none of the words"));
        let length = if word.ends_with("(…)") { rest.find(')').map(|it| it + 1) } else { None };
        let (found, behind) = rest.split_at(length.unwrap_or(word.len()));
        known.push(found.to_owned());
        match behind.strip_prefix("; ") {
            Some(next) => rest = next,
            None => return (known, behind.strip_prefix('.').expect(text).trim_start()),
        }
    }
}

/// Returns commands whole: `a`, also with `b` are two.
fn commands(text: &str) -> Vec<String> {
    let mut commands: Vec<String> = Vec::new();
    let mut between = "";
    for (at, part) in text.split('`').enumerate() {
        let before = commands.last().filter(|_| between == ", also with ");
        match before {
            _ if at % 2 == 0 => between = part,
            Some(before) => commands.push(format!("{before} {part}")),
            None => commands.push(part.to_owned()),
        }
    }
    commands
}

/// Returns whether it is a letter and a number.
fn is_id(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(|it| it.is_ascii_uppercase())
        && text.len() > 1
        && letters.all(|it| it.is_ascii_digit())
}

/// Whether a claim is known by this word.
fn is_of(word: &str, known: &str) -> bool {
    match word.strip_suffix("(…)") {
        Some(name) => known.strip_prefix(name).is_some_and(|it| it.starts_with('(')),
        None => known == word,
    }
}

#[test]
fn a_claim_is_read_from_its_four_parts() {
    let item = "**A1** says\n  1,234<!--=a.b--> of 56.\n  *Known:* checker (7 states); sampled.\n \
                So it is.\n  *Run:* `a b`, also with `-- c`, `d`\n  *Where:* `x`, `y/{z,w}`\n";
    let claim = Claim::of(item);
    let all = |it: &[&str]| it.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>();
    let expected = Claim {
        id: "A1".into(),
        says: "says 1,234<!--=a.b--> of 56.".into(),
        known: all(&["checker (7 states)", "sampled"]),
        how: "So it is.".into(),
        run: all(&["a b", "a b -- c", "d"]),
        places: all(&["x", "y/{z,w}"]),
    };
    assert_eq!(claim, expected);
    assert_eq!(claim.words(), "says  of 56. checker (7 states) sampled So it is.");
}

#[test]
fn a_word_is_known_by_its_name_and_a_bound_where_it_has_one() {
    assert!(is_of("checker (…)", "checker (12 states)") && !is_of("checker (…)", "checker"));
    assert!(is_of("sampled", "sampled") && !is_of("sampled", "sampled (2)"));
}

#[test]
#[should_panic(expected = "none of the words")]
fn a_claim_that_is_known_by_another_word_is_refused() {
    known_by("guessed. By us.");
}
