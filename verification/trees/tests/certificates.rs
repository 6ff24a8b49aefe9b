//! Certificates of real trees: each answer that is good is accepted, each other is refused.

use crate::folder::{folder, real};
use cotama_trees::certificate::{Certificate, MOST_STATES, SHOWN};
use cotama_trees::explore::Limits;
use cotama_trees::findings::{Asked, Wishes, check};
use cotama_trees::reader::read;
use cotama_trees::supervisor::Supervisor;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Returns how many answers were accepted and refused, of a file with a tree that is small enough.
fn asked(folder: &Path, path: &Path) -> Option<[usize; 2]> {
    let mut files = BTreeMap::new();
    let mut from = |path: &str| {
        let text = std::fs::read_to_string(path).map_err(|it| it.to_string())?;
        files.insert(path.to_owned(), text.clone());
        Ok(text.into_bytes())
    };
    let options = real(folder, None);
    let path = path.to_str().unwrap();
    let tree = read(path, &mut from, &options).ok()?.tree;
    let report = check(&tree, &Wishes::default(), Limits::default());
    if report.facts.states > MOST_STATES || !report.complete {
        return None;
    }
    let mut none = |_: &str, _: Option<u32>, _: &[&str]| -> Result<Supervisor, String> {
        Err("no supervisor".to_owned())
    };
    let new = Certificate::new(path, files, &options);
    let mut shows = |questions: &[&str]| {
        let mut asks = new.clone();
        asks.shows = questions.iter().map(|it| (*it).to_owned()).collect();
        asks.verify(&mut none)
    };
    let (good, bad): (Vec<&Asked>, Vec<_>) =
        report.asked.iter().partition(|it| it.holds == Some(true));
    let good: Vec<_> = good.iter().map(|it| it.question).collect();
    assert_eq!(shows(&good).map(|it| it.shows.len()), Ok(good.len()), "{path}");
    for it in &bad {
        assert!(SHOWN.contains(&it.question));
        assert!(shows(&[it.question]).is_err(), "{path}: {}", it.question);
    }
    let count = [bad.len(), good.len()];
    Some(count)
}

/// Adds the XML files of a folder and of those in it.
fn collect(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, into);
        } else if path.extension().is_some_and(|it| it == "xml") {
            into.push(path);
        }
    }
}

#[test]
fn each_good_answer_about_a_real_tree_is_shown_and_no_other() {
    let Some(folder) = folder() else { return };
    let (mut trees, mut sum) = (0, [0, 0]);
    let mut paths = Vec::new();
    collect(&folder.join("trees"), &mut paths);
    paths.sort();
    for path in &paths {
        if let Some(count) = asked(&folder, path) {
            trees += 1;
            sum = [sum[0] + count[0], sum[1] + count[1]];
        }
    }
    assert_eq!((trees, sum), (44, [76, 540]));
}
