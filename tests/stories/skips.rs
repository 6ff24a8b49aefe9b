//! A test that needs what is no part of the project fails where it is missing, unless it is to be
//! skipped.

use cotama_golden::folder_or_skip;
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
fn without_a_folder_a_test_is_skipped_only_where_it_was_asked_for() {
    assert_eq!(folder_or_skip(None, true), Ok(None));
    assert!(folder_or_skip(None, false).unwrap_err().contains("COTAMA_SKIP_PUBLIC=1"));
}
