//! Findings in SARIF, as a forge takes them: each with a physical location whose URI is a reference
//! by RFC 3986.

use crate::common::Folder;
use serde_json::Value;

const NET: &str = "net robot\ntr go idle -> busy\npl idle (1)\n";

/// Returns whether a text is a relative reference or a URI with a scheme (RFC 3986, appendix A),
/// without a query and a fragment.
fn is_reference(text: &str) -> bool {
    let (scheme, rest) = match text.split_once(':') {
        Some((scheme, rest)) if !scheme.contains('/') => (Some(scheme), rest),
        _ => (None, text),
    };
    let scheme_fits = scheme.is_none_or(|it| {
        it.starts_with(|c: char| c.is_ascii_alphabetic())
            && it.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
    });
    let mut bytes = rest.bytes();
    while let Some(byte) = bytes.next() {
        let fits = match byte {
            b'%' => [bytes.next(), bytes.next()]
                .iter()
                .all(|it| it.is_some_and(|it| it.is_ascii_digit() || (b'A'..=b'F').contains(&it))),
            // unreserved, sub-delims, `:`, `@`, `/`
            _ => byte.is_ascii_alphanumeric() || b"-._~!$&'()*+,;=:@/".contains(&byte),
        };
        if !fits {
            return false;
        }
    }
    scheme_fits && !rest.is_empty()
}

/// The bytes that a reference stands for.
fn decoded(text: &str) -> String {
    let (mut bytes, mut rest) = (Vec::new(), text);
    while let Some((before, code)) = rest.split_once('%') {
        bytes.extend(before.bytes());
        bytes.push(u8::from_str_radix(&code[..2], 16).unwrap());
        rest = &code[2..];
    }
    bytes.extend(rest.bytes());
    String::from_utf8(bytes).unwrap()
}

/// Every object below a key, wherever it is.
fn all<'v>(value: &'v Value, key: &str, found: &mut Vec<&'v Value>) {
    match value {
        Value::Object(map) => {
            for (name, it) in map {
                found.extend((name == key).then_some(it));
                all(it, key, found);
            }
        }
        Value::Array(list) => list.iter().for_each(|it| all(it, key, found)),
        _ => {}
    }
}

/// A file as a forge reads it; its URIs, each once.
fn uris(text: &str) -> Vec<String> {
    let log: Value = serde_json::from_str(text).unwrap();
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    let mut ids: Vec<_> = rules.iter().map(|it| it["id"].as_str().unwrap()).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "ids of rules are unique");
    for rule in rules {
        for key in ["shortDescription", "fullDescription", "help"] {
            let said = rule[key]["text"].as_str().unwrap();
            assert!(!said.is_empty() && said.chars().count() <= 1024, "{key}: {rule}");
        }
        assert_ne!(rule["id"], "");
    }
    for result in run["results"].as_array().unwrap() {
        let rule = &rules[result["ruleIndex"].as_u64().unwrap() as usize];
        assert_eq!(rule["id"], result["ruleId"]);
        assert_ne!(result["message"]["text"], "");
        let steps = result["codeFlows"][0]["threadFlows"][0]["locations"].as_array();
        let steps = steps.into_iter().flatten().map(|it| &it["location"]);
        for place in result["locations"].as_array().unwrap().iter().chain(steps) {
            let physical = &place["physicalLocation"];
            assert!(physical["artifactLocation"]["uri"].is_string(), "{place}");
            for key in ["startLine", "startColumn", "endLine", "endColumn"] {
                assert!(physical["region"][key].as_u64() >= Some(1), "{place}");
            }
        }
        assert_eq!(result["locations"].as_array().unwrap().len(), 1);
    }
    let mut found = Vec::new();
    all(&log, "uri", &mut found);
    let mut found: Vec<_> = found.iter().map(|it| it.as_str().unwrap().to_owned()).collect();
    found.sort();
    found.dedup();
    assert!(found.iter().all(|it| is_reference(it)), "{found:?}");
    found
}

fn checked(folder: &Folder, model: &str) -> String {
    let quoted = model.replace('\'', "'\\''");
    let more = "--property 'AG idle' --property 'AG EF idle' --sarif out.sarif";
    let input = if model == "-" { "< robot.net" } else { "" };
    let ended = folder.shell(&format!("cotama check '{quoted}' {more} --untimed {input}"));
    assert_eq!(ended.code, Some(1), "{model}: {ended:?}");
    folder.read("out.sarif")
}

#[test]
fn a_path_of_any_letters_is_a_reference_to_that_path() {
    let folder = Folder::new("sarif_paths");
    for path in [
        "robot.net",
        "line 2 #3/my robot.net",
        "Prüfstand/größe.net",
        "100%/a%20b.net",
        "c:x.net",
        "http:/robot.net",
        "[a]{b}|^`'\"<>?.net",
        "日本/🤖.net",
        "back\\slash.net",
        "a+b=c,d;e&f@g!.net",
    ] {
        let file = folder.path().join(path);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, NET).unwrap();
        let found = uris(&checked(&folder, path));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(decoded(&found[0]).trim_start_matches("./"), path, "{found:?}");
        let is_scheme = found[0].split('/').next().unwrap().contains(':');
        assert!(!is_scheme, "{found:?}");
    }
}

#[test]
fn an_absolute_path_is_a_file_uri() {
    let folder = Folder::new("sarif absolute ß");
    folder.write("my robot.net", NET);
    let path = folder.path().join("my robot.net");
    let found = uris(&checked(&folder, path.to_str().unwrap()));
    assert_eq!(found.len(), 1, "{found:?}");
    let path = found[0].strip_prefix("file://").unwrap();
    assert_eq!(decoded(path), folder.path().join("my robot.net").to_str().unwrap());
}

#[test]
fn a_model_without_a_file_has_a_place_too() {
    let folder = Folder::new("sarif_places");
    folder.write("robot.net", NET);
    assert_eq!(uris(&checked(&folder, "-")), ["standard-input"]);
    for (model, property, uri) in [
        ("door", "EF Open", "builtin/door"),
        ("philosophers:5", "EF deadlock", "builtin/philosophers:5"),
        ("kanban:2", "EF deadlock", "builtin/kanban:2"),
        ("watchdog", "EF Fault", "builtin/watchdog"),
        ("charger", "EF deadlock", "builtin/charger"),
    ] {
        let more = ["--untimed", "--sarif", "out.sarif"];
        let ended = folder.cotama(&[&["check", model, "--property", property], &more[..]].concat());
        assert!(matches!(ended.code, Some(0 | 1)), "{ended:?}");
        let text = folder.read("out.sarif");
        assert_eq!(uris(&text), [uri]);
        let mut names = Vec::new();
        let log: Value = serde_json::from_str(&text).unwrap();
        all(&log, "fullyQualifiedName", &mut names);
        assert!(!names.is_empty() && names.iter().all(|it| *it == model), "{names:?}");
    }
}

#[test]
fn two_questions_of_one_name_are_one_rule_and_two_findings() {
    let folder = Folder::new("sarif_twice");
    folder.write("robot.net", NET);
    let twice = ["--property", "AG idle", "--property", "AG idle", "--sarif", "out.sarif"];
    let ended = folder.cotama(&[&["check", "robot.net"], &twice[..]].concat());
    assert_eq!(ended.code, Some(1), "{ended:?}");
    let log: Value = serde_json::from_str(&folder.read("out.sarif")).unwrap();
    let run = &log["runs"][0];
    assert_eq!(run["tool"]["driver"]["rules"].as_array().unwrap().len(), 1);
    assert_eq!(run["results"].as_array().unwrap().len(), 2);
    uris(&folder.read("out.sarif"));
}

#[test]
fn the_check_of_references_refuses_what_is_none() {
    for text in ["a b", "a#b", "ü", "a%2", "a%zz", "1x:y", "a\\b", "[x]", ""] {
        assert!(!is_reference(text), "{text}");
    }
    for text in ["a%20b", "./c:x", "file:///a", "../x", "a/b:c"] {
        assert!(is_reference(text), "{text}");
    }
}
