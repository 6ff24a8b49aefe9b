//! Wrong files: the class of each is that of the list, and its message is kept.

use crate::folder::{folder, load, text};
use cotama_trees::diagnostic::Severity;
use cotama_trees::reader::Options;

#[test]
fn every_wrong_file_is_refused_or_accepted_with_its_message() {
    let Some(folder) = folder() else { return };
    let mut all = String::new();
    for line in text(&folder.join("broken/BROKEN.tsv")).lines().filter(|it| !it.starts_with('#')) {
        let columns: Vec<_> = line.split('\t').collect();
        let (name, wanted) = (columns[0], columns[3]);
        let (found, notes) = match load(&folder.join("broken").join(name), &Options::default()) {
            Err(refusal) => ("error", refusal.diagnostics),
            Ok(loaded) => {
                let worst = loaded.notes.iter().map(|it| it.severity).max();
                let class = match worst {
                    None => "accept",
                    Some(Severity::Warning) => "accept, warn",
                    Some(_) => "error",
                };
                (class, loaded.notes)
            }
        };
        let wants = match wanted {
            _ if wanted.starts_with("error or warn") => "accept, warn",
            _ if wanted.starts_with("accept, warn") => "accept, warn",
            _ if wanted.starts_with("error") => "error",
            _ => "accept",
        };
        assert_eq!(found, wants, "{name}: {wanted}");
        all += &format!("{name}: {found}\n");
        for it in notes {
            let shown = it.to_string().replace(&format!("{}/broken/", folder.display()), "");
            all += &format!("  {}\n", shown.replace('\n', "\n  "));
        }
    }
    cotama_golden::compare(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/broken.txt"), &all);
}
