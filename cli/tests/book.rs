//! The README and the pages in `docs/`, followed word by word: every command that they show runs,
//! and prints what they say.
//!
//! A block ```` ```console ```` shows commands (`$ cotama ...`) and what they print; `…` stands for
//! any text in a line, and alone for any lines. `# exit code 1` behind a command says how it ends.
//! A block with a name behind its language, ```` ```toml room.toml ````, is a file that the
//! commands after it find in their folder. A page has one folder. `UPDATE_GOLDEN=1` writes the
//! whole output of commands that print something else into the page.

use crate::common::Folder;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Commands that are not run here, as they need a clone or take long; `.ci/run` runs them.
const ELSEWHERE: [&str; 11] = [
    "cargo run --release -- run patrol",
    "cotama fmeca --measure delivery --seeds 20 --output models/robots/p3dx-delivery.measured.toml",
    "cargo test --workspace",
    "cargo install --path cli --profile dist",
    "cargo run",
    "cargo test",
    "cargo run --example model > watch.json",
    "firmware/check.sh",
    "tests/evidence/no_panic/check.sh",
    "tests/evidence/no_std/check.sh",
    "tests/evidence/proofs/check.sh",
];

/// Crates are built without a network, all in one folder, as quickly as can be.
const BUILD: &str = "export CARGO_NET_OFFLINE=true CARGO_TARGET_DIR=$PWD/target \
    CARGO_PROFILE_DEV_DEBUG=0 RUST_BACKTRACE=0; unset RUSTFLAGS CARGO_ENCODED_RUSTFLAGS";

/// The page whose commands build crates.
const BUILDS_CRATES: &str = "your-own.md";

/// The page whose crates are begun beside the sources.
const BESIDE_SOURCES: &str = "embed.md";

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let docs = fs::read_dir(root.join("docs")).unwrap().map(|it| it.unwrap().path());
    let mut pages: Vec<_> = docs.filter(|it| it.extension().is_some_and(|it| it == "md")).collect();
    pages.push(root.join("README.md"));
    pages.sort();
    pages
}

/// Whether a line is as shown, where `…` is any text.
fn reads(line: &str, shown: &str) -> bool {
    let mut parts = shown.split('…');
    let Some(mut rest) = parts.next().and_then(|first| line.strip_prefix(first)) else {
        return false;
    };
    let mut last = None;
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        (rest, last) = (&rest[at + part.len()..], Some(part));
    }
    // A line that ends with `…` may go on in any way.
    rest.is_empty() || last == Some("") || last.is_some_and(|it| line.ends_with(it))
}

/// Whether lines are as shown, where a line `…` is any lines.
fn is_shown(lines: &[&str], shown: &[&str]) -> bool {
    match shown.split_first() {
        None => lines.is_empty(),
        Some((&"…", shown)) => (0..=lines.len()).any(|at| is_shown(&lines[at..], shown)),
        Some((first, shown)) => lines
            .split_first()
            .is_some_and(|(line, lines)| reads(line.trim_end(), first) && is_shown(lines, shown)),
    }
}

/// Runs the commands of a block; the block with what they print, where that is something else.
fn follow(block: &[&str], folder: &Folder, page: &str) -> String {
    let mut written = String::new();
    let mut at = 0;
    while at < block.len() {
        let command = block[at].strip_prefix("$ ");
        let command = command.unwrap_or_else(|| panic!("{page}: no command: {}", block[at]));
        let end = (at + 1..block.len()).find(|&it| block[it].starts_with("$ "));
        let shown = &block[at + 1..end.unwrap_or(block.len())];
        let expected =
            command.split_once("# exit code ").map_or(0, |(_, code)| code.parse().unwrap());
        let ended = folder.shell(&format!("exec 2>&1\n{BUILD}\n{command}"));
        assert_eq!(ended.code, Some(expected), "{page}: {command}: {ended:?}");
        let lines: Vec<&str> = ended.stdout.lines().collect();
        let shown_lines: Vec<&str> = shown.iter().map(|it| it.trim_end()).collect();
        let _ = writeln!(written, "{}", block[at]);
        let printed = if is_shown(&lines, &shown_lines) { shown } else { &lines[..] };
        for line in printed {
            let _ = writeln!(written, "{}", line.trim_end());
        }
        at = end.unwrap_or(block.len());
    }
    written
}

/// Follows a page in a folder; how many commands it has.
fn follow_page(path: &Path, folder: &Folder) -> usize {
    let page = path.file_name().unwrap().to_str().unwrap();
    let text = fs::read_to_string(path).unwrap();
    let (mut written, mut lines, mut commands) = (String::new(), text.lines(), 0);
    while let Some(line) = lines.next() {
        let _ = writeln!(written, "{line}");
        let Some(info) = line.strip_prefix("```") else { continue };
        let block: Vec<&str> = lines.by_ref().take_while(|it| *it != "```").collect();
        let body = match info.split_once(' ') {
            _ if block.is_empty() => String::new(),
            _ if info == "console" => {
                commands += block.iter().filter(|it| it.starts_with("$ ")).count();
                follow(&block, folder, page)
            }
            _ if info == "sh" => {
                for line in &block {
                    let command = line.split(" #").next().unwrap().trim();
                    assert!(ELSEWHERE.contains(&command), "{page}: nothing runs {line:?}");
                }
                block.join("\n") + "\n"
            }
            Some((_, name)) => {
                let body = block.join("\n") + "\n";
                folder.write(name, &body);
                body
            }
            None => block.join("\n") + "\n",
        };
        let _ = writeln!(written, "{body}```");
    }
    cotama_golden::compare(path, &written);
    commands
}

#[test]
fn every_page_agrees_with_the_program() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = |path: &Path| {
        let page = path.file_name().unwrap().to_str().unwrap();
        let folder = Folder::new(&format!("book_{page}"));
        if page == BESIDE_SOURCES {
            std::os::unix::fs::symlink(&root, folder.path().join("cotama")).unwrap();
        }
        folder
    };
    let quick = pages().into_iter().filter(|it| !it.ends_with(BUILDS_CRATES));
    let commands: usize = quick.map(|it| follow_page(&it, &folder(&it))).sum();
    assert!(commands > 10, "{commands}");
}

/// In a folder with the sources beside it, and without a network: with the versions of this
/// project.
#[test]
#[ignore = "a minute: CI runs it"]
fn the_page_that_builds_crates_agrees_with_the_builds() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = Folder::new("book_crates");
    std::os::unix::fs::symlink(&root, folder.path().join("cotama")).unwrap();
    assert_eq!(follow_page(&root.join("docs").join(BUILDS_CRATES), &folder), 11);
}

/// Every link of a text: where it leads.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices("](").filter_map(|(at, _)| text[at + 2..].split(')').next())
}

/// The link leads to a file beside `path`, if to a heading then to one that is there.
fn leads_somewhere(path: &Path, link: &str) -> Result<Option<PathBuf>, String> {
    if link.starts_with("http") {
        return Ok(None);
    }
    if link.contains("::") {
        return Err(format!("{}: only rustdoc reads {link}", path.display()));
    }
    let (target, heading) = link.split_once('#').map_or((link, None), |(a, b)| (a, Some(b)));
    let target = match target {
        "" => path.to_owned(),
        _ => path.parent().unwrap().join(target),
    };
    let (true, Some(heading)) = (target.exists(), heading) else {
        return if target.exists() {
            Ok(Some(target))
        } else {
            Err(format!("{}: {link} is not there", path.display()))
        };
    };
    let text = fs::read_to_string(&target).unwrap();
    let mut headings = text.lines().filter(|it| it.starts_with('#')).map(|it| {
        let words = it.trim_start_matches('#').trim().to_lowercase();
        let kept = words.chars().filter(|it| it.is_alphanumeric() || " -_".contains(*it));
        kept.collect::<String>().replace(' ', "-")
    });
    if headings.any(|it| it == heading) {
        Ok(Some(target))
    } else {
        Err(format!("{}: {link} is no heading", path.display()))
    }
}

/// Pages, and the texts in the sources to which they lead.
#[test]
fn every_link_of_a_page_leads_somewhere() {
    let (mut wrong, mut pages) = (Vec::new(), pages());
    let mut at = 0;
    while let Some(path) = pages.get(at).cloned() {
        at += 1;
        let text = fs::read_to_string(&path).unwrap();
        for link in links(&text) {
            match leads_somewhere(&path, link) {
                Ok(Some(target)) if target.extension().is_some_and(|it| it == "md") => {
                    let target = target.canonicalize().unwrap();
                    if !pages.iter().any(|it| it.canonicalize().unwrap() == target) {
                        pages.push(target);
                    }
                }
                Ok(_) => {}
                Err(error) => wrong.push(error),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Writes a text of the sources with headings two levels deeper, as a page shows it.
fn as_part(text: &str) -> String {
    let mut code = false;
    let mut deeper = |line: &str| {
        code ^= line.starts_with("```");
        let heading = !code && line.starts_with('#');
        format!("{}{line}\n", if heading { "##" } else { "" })
    };
    text.trim_end().lines().map(&mut deeper).collect()
}

/// Between `<!-- FILE -->` and `<!-- end -->` stands the text of a file.
#[test]
fn the_page_of_the_languages_holds_the_documentation_of_the_macros() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join("docs/language.md");
    let page = fs::read_to_string(&path).unwrap();
    let (mut written, mut rest, mut parts) = (String::new(), &page[..], Vec::new());
    while let Some((before, behind)) = rest.split_once("<!-- core/") {
        let (name, behind) = behind.split_once(" -->").unwrap();
        let (_, behind) = behind.split_once("<!-- end -->").unwrap();
        let text = fs::read_to_string(root.join("core").join(name)).unwrap();
        let text = as_part(&text);
        let _ = write!(written, "{before}<!-- core/{name} -->\n\n{text}\n<!-- end -->");
        parts.push(name);
        rest = behind;
    }
    written.push_str(rest);
    let all = ["net/sections", "net/laws", "system/sections", "system/laws/law", "system/extends"];
    assert_eq!(parts, all.map(|it| format!("nets/src/{it}.md")));
    cotama_golden::compare(&path, &written);
}

#[test]
fn every_command_stands_on_the_page_of_commands() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/commands.md");
    let page = fs::read_to_string(page).unwrap();
    for command in crate::help::COMMANDS {
        assert!(page.contains(&format!("`cotama {command} ")), "{command}");
    }
}
