//! Rules of the source that no compiler checks; a finding comes with its cure.
//!
//! A rule is a function from text to findings, so each has a canary: a text that it must refuse.

mod circles;
mod source;

use circles::circles;
use source::{Source, blocks, sources, test_names};
use std::collections::BTreeMap;
use std::path::Path;

/// Words that a comment may not begin with: a verb or a noun says sooner what is meant.
const OPENINGS: [&str; 11] =
    ["What", "Who", "Whom", "Whose", "Where", "It", "Its", "Those", "That", "Of", "None"];

/// Words that the name of a test may not begin with: a claim has a subject.
const NAMES: [&str; 6] = ["what", "who", "whom", "whose", "where", "nobody"];

/// Columns of a line, and lines of a file.
const WIDTH: usize = 100;
const LENGTH: usize = 450;

/// Limits of a folder: comments with such an opening, in thousandths of its comments, and tests
/// with such a name. The aim is 10 and 0.
const LIMITS: [(&str, usize, usize); 8] = [
    ("cli", 10, 0),
    ("core", 10, 0),
    ("firmware", 10, 0),
    ("models", 10, 0),
    ("sim", 10, 0),
    ("tests", 10, 0),
    ("tests/evidence", 10, 0),
    ("verification", 10, 0),
];

/// Files beyond the length, each with its largest length.
const LONG: [(&str, usize); 6] = [
    ("core/nets/src/net/macros.rs", 465),
    ("core/nets/src/net/mistakes.rs", 470),
    ("core/nets/src/player/player.rs", 460),
    ("core/nets/src/system/macros.rs", 470),
    ("models/src/missions/reader/fields.rs", 490),
    ("sim/pages/src/team.rs", 460),
];

/// Words of the map, and lines of the page for newcomers.
const MAP_WORDS: usize = 1_500;
const PAGE_LINES: usize = 80;

/// Returns the folder of the limits that a file belongs to.
fn folder(path: &str) -> Option<&'static str> {
    let has = |it: &&(&str, _, _)| path.strip_prefix(it.0).is_some_and(|it| it.starts_with('/'));
    LIMITS.iter().filter(has).max_by_key(|it| it.0.len()).map(|it| it.0)
}

/// Returns whether a comment opens with one of the words.
fn opens_badly(comment: &str) -> bool {
    let text = comment.trim_start_matches(['`', '*', '[', ' ']);
    let word = text.split(|it: char| !it.is_alphanumeric() && it != '_').next();
    OPENINGS.contains(&word.unwrap_or_default())
}

fn is_named_badly(name: &str) -> bool {
    NAMES.contains(&name.split('_').next().unwrap_or_default())
}

fn wide_lines(of: &Source) -> Vec<String> {
    let lines = of.text.lines().enumerate().map(|(at, line)| (at + 1, line, line.chars().count()));
    // A raw string cannot be broken.
    let wide = lines.filter(|it| it.2 > WIDTH && !it.1.contains("r#\""));
    wide.map(|(line, _, columns)| {
        format!("{}:{line}: {columns} columns; break the line after {WIDTH}", of.path)
    })
    .collect()
}

fn too_long(of: &Source) -> Option<String> {
    let lines = of.text.lines().count();
    let most = LONG.iter().find(|it| it.0 == of.path).map_or(LENGTH, |it| it.1);
    (lines > most).then(|| {
        format!("{}: {lines} lines; move a type with its functions to a file of its own", of.path)
    })
}

/// Returns a finding for each folder that has more of something than its limit.
fn above<'f>(
    counts: &BTreeMap<&'f str, Vec<String>>,
    limit: impl Fn(&'f str) -> usize,
    cure: &str,
) -> Vec<String> {
    let above = counts.iter().filter(|(folder, all)| all.len() > limit(folder));
    above
        .map(|(folder, all)| {
            let (most, list) = (limit(folder), all.join("\n  "));
            format!("{folder}: {} where {most} are allowed; {cure}\n  {list}", all.len())
        })
        .collect()
}

fn badly_opened(all: &[Source]) -> Vec<String> {
    let (mut bad, mut counts) = (BTreeMap::<_, Vec<_>>::new(), BTreeMap::<_, usize>::new());
    for of in all {
        let Some(folder) = folder(&of.path) else { continue };
        for (line, comment) in blocks(&of.text) {
            *counts.entry(folder).or_default() += 1;
            if opens_badly(&comment) {
                let begin: String = comment.chars().take(60).collect();
                bad.entry(folder).or_default().push(format!("{}:{line}: {begin}", of.path));
            }
        }
    }
    let share = |folder| LIMITS.iter().find(|it| it.0 == folder).map_or(0, |it| it.1);
    let cure = "begin with a verb or a noun: `Returns ..`, `A marking that ..`, `Adds ..`";
    above(&bad, |it| counts[it] * share(it) / 1_000, cure)
}

fn badly_named(all: &[Source]) -> Vec<String> {
    let mut bad = BTreeMap::<_, Vec<_>>::new();
    for of in all {
        let Some(folder) = folder(&of.path) else { continue };
        let names = test_names(&of.text).into_iter().filter(|it| is_named_badly(&it.1));
        let names = names.map(|(line, name)| format!("{}:{line}: {name}", of.path));
        bad.entry(folder).or_default().extend(names);
    }
    let most = |folder| LIMITS.iter().find(|it| it.0 == folder).map_or(0, |it| it.2);
    above(&bad, most, "name a test by its claim, subject first: `a_full_mailbox_refuses`")
}

/// Returns the circles of files that import each other, but of parent and child.
fn circles_of(all: &[Source]) -> Vec<String> {
    let told = |it: Vec<String>| {
        let files = it.join("\n  ");
        format!("files that import each other; move the shared type to a third file:\n  {files}")
    };
    circles(all).into_iter().map(told).collect()
}

/// Returns a finding if the map or the page for newcomers is too long.
fn long_pages(map: &str, page: &str) -> Vec<String> {
    let (words, lines) = (map.split_whitespace().count(), page.lines().count());
    let reasons = "reasons belong to docs/decisions.md";
    let chores = "chores belong to tests/README.md";
    let all = [
        (words > MAP_WORDS).then(|| format!("ARCHITECTURE.md: {words} words; {reasons}")),
        (lines > PAGE_LINES).then(|| format!("CONTRIBUTING.md: {lines} lines; {chores}")),
    ];
    all.into_iter().flatten().collect()
}

fn assert_none(found: &[String]) {
    assert!(found.is_empty(), "{} findings:\n{}", found.len(), found.join("\n"));
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

fn all() -> Vec<Source> {
    sources(root())
}

#[test]
fn comments_begin_with_a_verb_or_a_noun() {
    assert_none(&badly_opened(&all()));
}

#[test]
fn tests_are_named_by_their_claim() {
    assert_none(&badly_named(&all()));
}

#[test]
fn lines_have_at_most_100_columns() {
    assert_none(&all().iter().flat_map(wide_lines).collect::<Vec<_>>());
}

#[test]
fn files_have_at_most_450_lines() {
    assert_none(&all().iter().filter_map(too_long).collect::<Vec<_>>());
}

#[test]
fn no_files_import_each_other_but_parent_and_child() {
    assert_none(&circles_of(&all()));
}

#[test]
fn the_pages_for_newcomers_are_short() {
    let page = |name| std::fs::read_to_string(root().join(name)).expect("a page");
    assert_none(&long_pages(&page("ARCHITECTURE.md"), &page("CONTRIBUTING.md")));
}

#[test]
fn every_source_has_a_limit() {
    let without: Vec<_> = all().into_iter().filter(|it| folder(&it.path).is_none()).collect();
    assert!(without.is_empty(), "{without:?}");
}

#[test]
fn each_rule_refuses_its_canary() {
    let source = |path: &str, text: &str| Source { path: path.to_owned(), text: text.to_owned() };
    let opened = source("models/src/a.rs", "/// What it is.\nfn a() {}\n\n// Takes one.\n");
    assert!(badly_opened(&[opened])[0].contains("models/src/a.rs:1: What it is."));
    for good in ["Whatever comes", "Items", "Offers", "`Other` is kept", "Nonempty"] {
        assert!(!opens_badly(good), "{good}");
    }
    for bad in ["`None` when empty", "[It] is", "Of these", "Its name", "*That* is"] {
        assert!(opens_badly(bad), "{bad}");
    }
    let named = source("core/src/a.rs", "#[test]\nfn who_waits() {}\n#[test]\nfn a_waits() {}\n");
    assert!(badly_named(&[named])[0].contains("core/src/a.rs:2: who_waits"));
    let wide = source("a.rs", &format!("{}\n{}\n", "ω".repeat(100), "ω".repeat(101)));
    assert_eq!(wide_lines(&wide), ["a.rs:2: 101 columns; break the line after 100"]);
    assert!(too_long(&source("a.rs", &"\n".repeat(450))).is_none());
    assert!(too_long(&source("a.rs", &"\n".repeat(451))).is_some());
    assert_eq!(long_pages(&"a ".repeat(1_501), &"\n".repeat(81)).len(), 2);
    let circle = [
        source("x/src/lib.rs", "mod a;\nmod b;\npub use a::A;\n"),
        source("x/src/a.rs", "use crate::{b::{B, C}};\npub struct A;\n"),
        source("x/src/b.rs", "use super::A;\npub struct B;\n"),
    ];
    assert_eq!(circles_of(&circle).len(), 1);
}
