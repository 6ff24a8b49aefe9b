//! Refusals of `net!` and `system!` while compiling, with their words.
//!
//! Every file in `cases` is a library with nets and systems. Those named `*_ok` compile without a
//! warning; the others are refused, as `golden.txt` says. After a change of the words:
//! `UPDATE_GOLDEN=1 cargo test -p cotama-tests --test refused`, and read the difference as a
//! stranger would.
//!
//! Two more cases are the supervisor of the README: as it stands there, and without its `ignore`,
//! which is refused in the words that the README shows.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Nets that are refused when they are used, which only generating code finds out.
const WHEN_USED: [&str; 2] = ["state_of_33_places", "state_of_two_tokens"];

/// The supervisor of the README, and the same without its `ignore`.
const README_CASES: [&str; 2] = ["readme", "readme_without_ignore"];
/// The text before the words of `net!`.
const OURS: &str = "evaluation panicked: ";

/// The words of the compiler on one case.
#[derive(Default)]
struct Said {
    /// Errors in the words of `net!`.
    refusals: Vec<String>,
    /// Errors in the compiler's own words; it stops reading there.
    stops: Vec<String>,
    warnings: Vec<String>,
}

impl Said {
    /// Returns the errors. Beside the words of `net!` those of the compiler say the same once more,
    /// or follow from it.
    fn errors(&self) -> &[String] {
        if self.refusals.is_empty() { &self.stops } else { &self.refusals }
    }
}

#[test]
fn every_refusal_reads_as_agreed_and_every_twin_compiles() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("refused");
    let names = case_names(&here);
    let package = package(&here, &names);
    let mut said = compile(&package);
    let readme = README_CASES.map(|name| said.remove(name).unwrap_or_default());
    assert!(
        said.keys().all(|name| names.contains(name)),
        "the library itself does not compile or is warned of"
    );

    let (mut refused, mut wrong) = (Vec::new(), Vec::new());
    for name in &names {
        let (errors, warnings) =
            said.get(name).map_or((&[][..], &[][..]), |it| (it.errors(), &it.warnings));
        match (name.ends_with("_ok"), errors.is_empty()) {
            (true, true) if warnings.is_empty() => {}
            (true, _) => {
                wrong.push(format!("{name} is refused or warned of: {errors:?} {warnings:?}"));
            }
            (false, true) => wrong.push(format!("{name} is not refused")),
            (false, false) => refused.push(format!("== {name}\n{}\n\n", errors.join("\n"))),
        }
    }
    cotama_golden::compare("refused/golden.txt", &refused.concat());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let [whole, without_ignore] = &readme;
    assert!(whole.errors().is_empty() && whole.warnings.is_empty(), "README: {:?}", whole.errors());
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let shown = block("text").split_once(OURS).expect("the README shows a refusal").1;
    assert_eq!(
        without_ignore.errors().iter().map(|it| words(it)).collect::<Vec<_>>(),
        [words(shown)]
    );
}

/// The first block of the README in a language.
fn block(language: &str) -> &'static str {
    const README: &str = include_str!("../../README.md");
    let (_, rest) = README.split_once(&format!("```{language}\n")).expect("the README has it");
    rest.split_once("```").expect("it ends").0
}

fn case_names(here: &Path) -> Vec<String> {
    let cases = fs::read_dir(here.join("cases")).expect("there are cases");
    let mut names: Vec<String> = cases
        .filter_map(|case| Some(case.ok()?.path().file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

/// A package of its own in which every case is an example.
fn package(here: &Path, names: &[String]) -> PathBuf {
    let package = Path::new(env!("CARGO_TARGET_TMPDIR")).join("refused");
    let core = here.join("../../core");
    let core = core.display();
    let mut manifest = vec![format!(
        "[workspace]\n[package]\nname = \"refused\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
         autoexamples = false\n\
         [lib]\npath = \"lib.rs\"\n[dev-dependencies]\ncotama-core = {{ path = '{core}' }}\n"
    )];
    let example = |name: &str, path: &Path| {
        let path = path.display();
        format!("[[example]]\nname = '{name}'\npath = '{path}'\ncrate-type = ['lib']\n")
    };
    for name in names {
        manifest.push(example(name, &here.join("cases").join(name).with_extension("rs")));
    }
    fs::create_dir_all(&package).expect("the directory for tests can be written");
    let whole = format!("//! The README.\nuse cotama_core::net;\n{}", block("rust"));
    let less =
        whole.lines().filter(|it| !it.trim_start().starts_with("ignore")).collect::<Vec<_>>();
    for (name, text) in README_CASES.into_iter().zip([whole.clone(), less.join("\n")]) {
        let path = package.join(name).with_extension("rs");
        fs::write(&path, text).expect("a case can be written");
        manifest.push(example(name, &path));
    }
    fs::write(package.join("Cargo.toml"), manifest.concat()).expect("the manifest can be written");
    fs::write(package.join("lib.rs"), "").expect("the library can be written");
    package
}

/// Returns the words of the compiler on each case.
fn compile(package: &Path) -> BTreeMap<String, Said> {
    let mut said = BTreeMap::new();
    for task in [
        &["clippy", "--examples", "--keep-going"][..],
        &["build", "--keep-going", "--example", WHEN_USED[0], "--example", WHEN_USED[1]],
    ] {
        let output = Command::new(env!("CARGO"))
            .args(task)
            .args(["--offline", "--message-format=json"])
            .current_dir(package)
            .env("CARGO_TARGET_DIR", package.join("target"))
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_ENCODED_RUSTFLAGS")
            .output()
            .expect("cargo runs");
        let lines = String::from_utf8(output.stdout).expect("cargo speaks UTF-8");
        assert!(lines.contains("compiler-message"), "{}", String::from_utf8_lossy(&output.stderr));
        for line in lines.lines() {
            let line: Value = serde_json::from_str(line).expect("a line is JSON");
            if line["reason"] == "compiler-message" {
                let name = line["target"]["name"].as_str().expect("a target has a name").to_owned();
                hear(said.entry(name).or_default(), &line["message"]);
            }
        }
    }
    said
}

/// Takes down a message of the compiler, without what depends on its version.
fn hear(said: &mut Said, message: &Value) {
    let text = message["message"].as_str().unwrap_or_default();
    if message["level"] != "error" {
        // "generated 1 warning" is none.
        if message["level"] == "warning" && !message["spans"].as_array().is_none_or(Vec::is_empty) {
            said.warnings.push(text.to_owned());
        }
        return;
    }
    let ours = text.strip_prefix(OURS);
    // `compile_error!` has no code, as errors of syntax, but a net or system.
    let names = text.starts_with("net `") || text.starts_with("system `");
    let ours = ours.or_else(|| (message["code"].is_null() && names).then_some(text));
    let (list, error) = match ours {
        Some(ours) => (&mut said.refusals, ours.to_owned()),
        None => (&mut said.stops, place(message)),
    };
    if !error.is_empty() && !list.contains(&error) {
        list.push(error);
    }
}

/// Returns the place where the compiler stops reading: the words are its own.
fn place(message: &Value) -> String {
    let Some(span) = message["spans"]
        .as_array()
        .and_then(|spans| spans.iter().find(|it| it["is_primary"] == true))
    else {
        return String::new();
    };
    let text = &span["text"][0];
    let line = text["text"].as_str().unwrap_or_default();
    let column = |name: &str| text[name].as_u64().map_or(0, |column| column as usize - 1);
    let token: String =
        line.chars().take(column("highlight_end")).skip(column("highlight_start")).collect();
    format!("(the compiler stops at `{token}` in `{}`)", line.trim())
}
