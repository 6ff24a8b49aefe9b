//! A test that needs what is no part of the project fails where it is missing, unless it is to be
//! skipped.

use cotama_golden::{folder_or_skip, is_skip, tool_or_skip};
use std::ffi::OsStr;
use std::path::PathBuf;

#[test]
fn a_folder_that_is_named_must_be_there_whether_tests_are_skipped_or_not() {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let empty = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("empty");
    std::fs::create_dir_all(&empty).unwrap();
    for skips in [true, false] {
        assert_eq!(folder_or_skip(Some(here.clone()), skips), Ok(Some(here.clone())));
        assert!(folder_or_skip(Some(here.join("missing")), skips).is_err());
        assert!(folder_or_skip(Some(empty.clone()), skips).unwrap_err().ends_with("is empty"));
    }
}

#[test]
fn a_test_without_its_folder_is_skipped_only_on_request() {
    assert_eq!(folder_or_skip(None, true), Ok(None));
    assert!(folder_or_skip(None, false).unwrap_err().contains("COTAMA_SKIP_PUBLIC=1"));
}

#[test]
fn a_missing_tool_is_passed_over_only_on_request() {
    assert_eq!((tool_or_skip(true, true), tool_or_skip(true, false)), (Ok(true), Ok(true)));
    assert_eq!(tool_or_skip(false, true), Ok(false));
    assert!(tool_or_skip(false, false).unwrap_err().contains("COTAMA_SKIP_PUBLIC=1"));
}

#[test]
fn nothing_is_skipped_but_where_the_variable_is_one() {
    for (value, skips) in [(None, false), (Some("0"), false), (Some(""), false), (Some("1"), true)]
    {
        assert_eq!(is_skip(value.map(OsStr::new)), skips, "{value:?}");
    }
}

/// Nobody else decides what is skipped.
#[test]
fn every_skip_is_asked_of_the_same_variable() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut found = Vec::new();
    for folder in ["core", "models", "verification", "sim", "cli"] {
        let mut text = String::new();
        crate::claims::sources(&root.join(folder), &mut text);
        let said = format!("eprintln!({:?}", "SKIPPED").trim_end_matches('"').to_owned();
        found.extend(text.contains(&said).then_some(folder));
    }
    assert_eq!(found, [""; 0], "a test that passes prints nothing: cotama_golden::skipped");
}
