//! The lists of seeded defects, and of bugs that harnesses must see, name lines that are there.

use std::fs;
use std::path::Path;

/// The file and the text of each defect of a list.
fn texts(list: &str) -> Vec<(&str, String)> {
    let mut found = Vec::new();
    for paragraph in list.split("\n\n") {
        let file = paragraph.lines().find_map(|it| it.strip_prefix("file: "));
        let old =
            |it: &str| (it == "-").then(String::new).or(it.strip_prefix("- ").map(Into::into));
        let old: Vec<_> = paragraph.lines().filter_map(old).collect();
        found.extend(file.map(|file| (file, old.join("\n"))));
    }
    found
}

#[test]
fn each_seeded_defect_changes_a_text_that_stands_once_in_its_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let (mut wrong, mut count) = (Vec::new(), 0);
    let mut lists: Vec<_> =
        fs::read_dir(root.join("tests/mutants")).unwrap().map(|it| it.unwrap().path()).collect();
    lists.push(root.join("tests/proofs/bugs.txt"));
    lists.sort();
    for list in lists.iter().filter(|it| it.extension().is_some_and(|it| it == "txt")) {
        for (file, old) in texts(&fs::read_to_string(list).unwrap()) {
            let found =
                fs::read_to_string(root.join(file)).map_or(0, |it| it.matches(&old).count());
            count += 1;
            if found != 1 {
                let list = list.file_name().unwrap().display();
                wrong.push(format!("{list}: found {found} times in {file}:\n{old}"));
            }
        }
    }
    assert!(count > 1_100, "{count}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
