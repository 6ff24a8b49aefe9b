//! Which public items have an example in their documentation: counted, and those without listed.
//!
//! The rule, line by line over `src` of the library crates:
//!
//! - *Public* is a type, trait or function whose `pub` stands at the start of a line, and a macro
//!   of `macro_rules!` below `#[macro_export]`. What is public can be reached by a user, or the
//!   lint `unreachable_pub` says no; what has no documentation at all does not compile, as
//!   `missing_docs` is denied. Methods, constants and what macros make (`Millis`) are not counted.
//! - Left out are `tests` and `proofs`, what is `#[doc(hidden)]`, and the files that [`EXPANDED`]
//!   names.
//! - *With an example* is one whose own documentation, the lines `///` right above it and above its
//!   attributes, has a code block that rustdoc compiles.
//!
//! A new public item without an example changes the golden file, and so is seen in review.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const CRATES: [&str; 4] = ["core", "models", "sim", "verification"];
/// What `net!` and `system!` expand to: no part of the API.
const EXPANDED: [&str; 4] = ["net/lower.rs", "net/size.rs", "net/source.rs", "system/source.rs"];

#[test]
fn items_without_an_example_are_listed_and_there_are_200_examples() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let mut table =
        format!("{:14}{:>8}{:>14}{:>10}\n", "crate", "public", "with example", "examples");
    let (mut list, mut all) = (String::new(), 0);
    for name in CRATES {
        let source = root.join(name).join("src");
        let (mut items, mut with, mut examples) = (0, 0, 0);
        for path in files(&source) {
            let text = fs::read_to_string(&path).expect("a file of the source");
            examples += count_examples(&text, path.extension().is_some_and(|it| it == "md"));
            let file = path.strip_prefix(root).expect("below the workspace").display().to_string();
            if ["tests", "proofs"].iter().any(|it| file.contains(it))
                || EXPANDED.iter().any(|it| file.ends_with(it))
            {
                continue;
            }
            for item in public_items(&text) {
                items += 1;
                if item.has_example {
                    with += 1;
                } else {
                    writeln!(list, "{file}: {} {}", item.kind, item.name).expect("a string");
                }
            }
        }
        writeln!(table, "{name:14}{items:>8}{with:>14}{examples:>10}").expect("a string");
        all += examples;
    }
    cotama_golden::compare(
        "stories/doc_examples.txt",
        &format!("{table}\nwithout an example:\n{list}"),
    );
    assert!(all >= 200, "{all} examples");
}

/// Rust and Markdown below a folder, by name.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut below: Vec<_> =
        fs::read_dir(folder).expect("a folder").map(|it| it.expect("an entry").path()).collect();
    below.sort();
    let is_source = |it: &PathBuf| it.extension().is_some_and(|it| it == "rs" || it == "md");
    below
        .into_iter()
        .flat_map(|it| if it.is_dir() { files(&it) } else { vec![it] })
        .filter(is_source)
        .collect()
}

struct Item<'t> {
    kind: &'t str,
    name: &'t str,
    has_example: bool,
}

/// The public items of a file.
fn public_items(text: &str) -> Vec<Item<'_>> {
    let (mut items, mut docs) = (Vec::new(), String::new());
    let (mut exported, mut hidden) = (false, false);
    for line in text.lines() {
        if let Some(doc) = line.strip_prefix("///") {
            docs += doc.strip_prefix(' ').unwrap_or(doc);
            docs.push('\n');
        } else if line.starts_with("#[") {
            exported |= line == "#[macro_export]";
            hidden |= line == "#[doc(hidden)]";
        } else if !line.starts_with([' ', ')', ']']) {
            // Neither documentation nor an attribute or its rest: an item, or something else.
            let named = public_name(line, exported).filter(|_| !hidden);
            let has_example = count_examples(&docs, true) > 0;
            items.extend(named.map(|(kind, name)| Item { kind, name, has_example }));
            docs.clear();
            (exported, hidden) = (false, false);
        }
    }
    items
}

/// What kind of public item begins in a line, and its name.
fn public_name(line: &str, exported: bool) -> Option<(&str, &str)> {
    const KINDS: [&str; 6] = ["struct", "enum", "union", "trait", "type", "fn"];
    let (kind, rest) = match line.strip_prefix("pub ") {
        Some(rest) => rest.strip_prefix("const fn").map_or(rest, |_| &rest["const ".len()..]),
        None if exported => line,
        None => return None,
    }
    .split_once(' ')?;
    let kind = if kind == "macro_rules!" { "macro" } else { kind };
    let end = rest.find(|it: char| !it.is_alphanumeric() && it != '_').unwrap_or(rest.len());
    (kind == "macro" || KINDS.contains(&kind)).then_some((kind, &rest[..end]))
}

/// How many code blocks of documentation rustdoc compiles: those of no language but Rust.
fn count_examples(text: &str, is_markdown: bool) -> usize {
    let (mut count, mut open) = (0, false);
    for line in text.lines() {
        let line = line.trim_start();
        let doc = if is_markdown {
            Some(line)
        } else {
            line.strip_prefix("///").or_else(|| line.strip_prefix("//!")).map(str::trim_start)
        };
        if let Some(fence) = doc.and_then(|it| it.strip_prefix("```")) {
            open = !open;
            let is_rust = fence.split(',').all(|it| {
                matches!(it, "" | "rust" | "should_panic" | "compile_fail") || it.starts_with("E0")
            });
            count += usize::from(open && is_rust);
        }
    }
    count
}

#[test]
fn an_example_counts_where_it_stands_and_only_if_it_is_compiled() {
    let text = "\
/// Has one.
///
/// ```
/// assert!(true);
/// ```
#[derive(Clone)]
pub struct Shown(u8);

/// Only text.
///
/// ```text
/// a -> b
/// ```
#[allow(
    dead_code
)]
pub const fn told() {}

/// Of the item above no documentation is left over.
pub enum Plain {}

/// A method is not counted.
impl Plain {
    /// ```
    /// ```
    pub fn method() {}
}

/// Not exported.
macro_rules! inner { () => {} }

/// Exported.
#[macro_export]
macro_rules! outer { () => {} }

/// Not for users.
#[doc(hidden)]
pub fn hidden() {}

pub(crate) fn inside() {}
";
    let found: Vec<_> =
        public_items(text).iter().map(|it| (it.kind, it.name, it.has_example)).collect();
    let expected = [
        ("struct", "Shown", true),
        ("fn", "told", false),
        ("enum", "Plain", false),
        ("macro", "outer", false),
    ];
    assert_eq!(found, expected);
    assert_eq!(count_examples(text, false), 2);
}
