//! The reference of mission files, against what the reader knows.

use crate::common::Folder;
use std::collections::BTreeSet;
use std::path::Path;

/// Each table of the page, a mission that has it, and the line behind which another key is put.
const TABLES: [(&str, &str, &str); 12] = [
    ("the file", "patrol", "format = \"panorama-mission/1\""),
    ("[limits]", "patrol", "[limits]"),
    ("[plan]", "patrol", "plan.objective = \"paper\""),
    ("[robot]", "patrol", "[robot]"),
    ("[motion_power]", "patrol", "[motion_power]"),
    ("[hardware.NAME]", "patrol", "[hardware.laser]"),
    ("[fixed]", "patrol", "[fixed]"),
    ("[[tio]]", "delivery", "[[tio]]"),
    ("[[zone]]", "patrol", "id = \"glass-out\""),
    ("[[objective]]", "delivery", "[[objective]]"),
    ("[supervision]", "delivery", "[supervision]"),
    ("[run]", "patrol", "[run]"),
];

/// The keys of a table of the page.
fn described<'p>(page: &'p str, heading: &str) -> BTreeSet<&'p str> {
    let (_, rest) = page.split_once(&format!("### {heading}\n")).expect(heading);
    let rows = rest.lines().take_while(|it| !it.starts_with('#'));
    rows.filter_map(|it| it.strip_prefix("| `")?.split_once('`')).map(|it| it.0).collect()
}

#[test]
fn the_page_of_missions_has_every_key_that_the_reader_knows() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/missions.md");
    let page = std::fs::read_to_string(page).unwrap();
    assert_eq!(page.matches("\n### ").count(), TABLES.len());
    let folder = Folder::new("reference");
    for (heading, mission, line) in TABLES {
        let text = folder.cotama(&["show", mission]).stdout;
        let end = text.match_indices(line).find(|(at, _)| text[..*at].ends_with('\n')).expect(line);
        let end = end.0 + text[end.0..].find('\n').unwrap() + 1;
        let key = if heading == "[plan]" { "plan.nonsense" } else { "nonsense" };
        let text = format!("{}{key} = 1\n{}", &text[..end], &text[end..]);
        folder.write("mission.toml", text);
        let said = folder.cotama(&["plan", "mission.toml"]).stderr;
        let (_, known) = said.split_once("known keys here: ").unwrap_or_else(|| panic!("{said}"));
        let (known, _) = known.split_once("\n\n").unwrap_or((known, ""));
        let known: BTreeSet<_> =
            known.split([',', ' ', '\n']).filter(|it| !it.is_empty()).collect();
        assert_eq!(described(&page, heading), known, "{heading}");
    }
}
