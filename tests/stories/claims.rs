//! The figures of the pages are those that tests assert: each stands in one file, or is counted.
//! The page of claims is read in its regular form, and what it names must be there.
//!
//! A page shows a figure in front of a comment that names it, `110,346<!--=delivery.states-->`;
//! with `UPDATE_GOLDEN=1` the numbers are written anew.

mod commands;
mod page;

use cotama_golden::figures;
use page::Claims;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const MARK: &str = "<!--=";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

/// The README and the book.
fn pages() -> Vec<PathBuf> {
    let docs = fs::read_dir(root().join("docs")).expect("the book");
    let docs = docs.map(|it| it.expect("a page").path());
    let mut pages: Vec<_> = docs.filter(|it| it.extension().is_some_and(|it| it == "md")).collect();
    pages.push(root().join("README.md"));
    pages.sort();
    pages
}

/// Returns the figures that are kept, and those that are counted in golden lists.
fn all() -> BTreeMap<String, u64> {
    let mut all: BTreeMap<_, _> = figures().map(|it| (it.0.to_owned(), it.1)).collect();
    count_harnesses(&mut all);
    count_mistakes(&mut all);
    all.extend(Claims::read().counts());
    all
}

/// The harnesses of the table on their page, and how they are run; the bugs planted for them.
fn count_harnesses(all: &mut BTreeMap<String, u64>) {
    let page = fs::read_to_string(root().join("docs/proofs.md")).expect("the harnesses");
    let table = page.split("## What holds").nth(1).expect("the table");
    let words = |it: &str| it.split_whitespace().collect::<Vec<_>>().join(" ");
    let entries: Vec<_> = table.split("\n- `").skip(1).map(words).collect();
    let of = |word: &str| entries.iter().filter(|it| it.contains(word)).count() as u64;
    all.insert("proofs.harnesses".into(), entries.len() as u64);
    all.insert("proofs.exhaustive".into(), of("*exhaustive ("));
    all.insert("proofs.sampled".into(), of("*sampled ("));
    all.insert("proofs.symbolic".into(), of("machine code, all"));
    let bugs = fs::read_to_string(root().join("tests/evidence/proofs/bugs.txt")).expect("the bugs");
    let bugs = bugs.lines().filter(|it| it.starts_with("harness: ")).count();
    all.insert("proofs.bugs".into(), bugs as u64);
}

/// The small mistakes in the nets, and what becomes of them.
fn count_mistakes(all: &mut BTreeMap<String, u64>) {
    let lists = fs::read_dir(root().join("models/tests/golden/nets")).expect("golden lists");
    let lists = lists.map(|it| it.expect("a list").path());
    let lists = lists.filter(|it| it.to_string_lossy().ends_with("_mutants.txt"));
    for list in lists.map(|it| fs::read_to_string(it).expect("a list")) {
        let counted = |line: &str| line.split(' ').find_map(|it| it.parse::<u64>().ok());
        for (name, words) in [
            ("mistakes", " mutants"),
            ("mistakes.laws", " caught by laws"),
            ("mistakes.equivalent", " equivalent"),
            ("mistakes.table", " seen only in the table of events"),
            ("mistakes.unnoticed", " survive"),
        ] {
            let line = list.lines().find(|it| it.ends_with(words) && !it.starts_with(' '));
            *all.entry(name.to_owned()).or_default() += line.and_then(counted).expect(name);
        }
    }
}

/// With commas between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    groups.collect::<Vec<_>>().join(",")
}

/// The page with its figures, and their names.
fn filled(text: &str, figures: &BTreeMap<String, u64>) -> (String, BTreeSet<String>) {
    let (mut page, mut names) = (String::new(), BTreeSet::new());
    let mut parts = text.split(MARK);
    let mut before = parts.next().unwrap_or_default();
    for part in parts {
        let (name, _) = part.split_once("-->").expect("the end of a figure's name");
        let figure = figures.get(name).unwrap_or_else(|| panic!("no figure `{name}`"));
        page += before.trim_end_matches(|it: char| it.is_ascii_digit() || it == ',');
        page += &grouped(*figure);
        page += MARK;
        names.insert(name.to_owned());
        before = part;
    }
    (page + before, names)
}

#[test]
fn a_figure_of_a_page_is_the_one_that_a_test_asserts() {
    let (figures, mut shown) = (all(), BTreeSet::new());
    for path in pages() {
        let text = fs::read_to_string(&path).expect("a page");
        let (page, names) = filled(&text, &figures);
        cotama_golden::compare(&path, &page);
        shown.extend(names);
    }
    // Not kept for nothing: a page shows it, and a test reads it.
    let mut asserted = String::new();
    for folder in [
        "models/tests",
        "sim/tests",
        "sim/campaign/tests",
        "verification/tests",
        "cli/tests",
        "tests/stories",
        "tests/evidence/measure",
    ] {
        sources(&root().join(folder), &mut asserted);
    }
    for name in figures.keys() {
        assert!(shown.contains(name), "no page shows `{name}`");
        let reads = [format!("\"{name}\""), format!("figure {name})")];
        let is_asserted = reads.iter().any(|it| asserted.contains(it));
        let counted = ["claims.", "mistakes", "proofs."];
        let is_counted = counted.iter().any(|it| name.starts_with(it));
        assert!(is_asserted || is_counted, "no test asserts `{name}`");
    }
}

#[test]
fn a_claim_has_its_words_and_names_existing_files() {
    let claims = Claims::read();
    let mut wrong = claims.defects();
    wrong.extend(claims.all.iter().flat_map(commands::defects));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The text of a file, or of all sources below a folder.
pub(super) fn sources(path: &Path, text: &mut String) {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a folder").map(|it| it.expect("an entry").path());
        let is_source = |it: &PathBuf| {
            let kind = it.extension().and_then(|it| it.to_str());
            it.is_dir() || kind.is_some_and(|it| ["rs", "sh", "py"].contains(&it))
        };
        entries.filter(is_source).for_each(|it| sources(&it, text));
    } else {
        *text += &fs::read_to_string(path).unwrap_or_default();
    }
}

#[test]
fn figures_are_written_in_front_of_their_names() {
    let figures = BTreeMap::from([("a".to_owned(), 1_234_567), ("b".to_owned(), 12)]);
    let (page, names) = filled("of 1,2<!--=a--> or <!--=b-->, 3", &figures);
    assert_eq!(page, "of 1,234,567<!--=a--> or 12<!--=b-->, 3");
    assert_eq!(names, BTreeSet::from(["a".to_owned(), "b".to_owned()]));
}
