//! `next:`: a command that repeats what was given, and that works.

use crate::common::{Folder, patrol};

fn next(folder: &Folder, line: &str) -> Option<String> {
    let ended = folder.shell(&format!("cotama {line}"));
    assert!(matches!(ended.code, Some(0 | 1 | 3)), "{line}: {ended:?}");
    ended.stdout.lines().find_map(|it| it.strip_prefix("next: ")).map(str::to_owned)
}

#[test]
fn hints_repeat_the_options_and_run() {
    let folder = Folder::new("hints");
    folder.write("my walk.toml", patrol(&[]));
    folder.write("none.toml", "format = \"panorama-faults/1\"\n");
    for (line, hint) in [
        ("plan patrol", "cotama run patrol"),
        ("plan 'my walk.toml'", "cotama run 'my walk.toml'"),
        (
            "plan patrol --objective quality --lost laser:1 --energy-limit 9000000 --steps 900000",
            "cotama run patrol --objective quality --steps 900000 --lost laser:1 \
             --energy-limit 9000000",
        ),
        ("plan patrol --objective front", "cotama run patrol"),
        (
            "plan patrol --lost laser:1 --energy-limit 4000000",
            "cotama plan patrol --lost laser:1 --energy-limit 4675896",
        ),
        (
            "plan patrol --objective quality --steps 1",
            "cotama plan patrol --objective quality --steps 20",
        ),
        (
            "run patrol --faults none --seed 7 --report mine",
            "cotama run patrol --seed 7 --faults none --report mine --trace run.jsonl && cotama \
             replay run.jsonl",
        ),
        (
            "run 'my walk.toml' --no-report --faults none.toml --trace 'a run.jsonl'",
            "cotama replay 'a run.jsonl'",
        ),
        ("replay 'a run.jsonl'", "cotama replay 'a run.jsonl' --report replayed"),
        (
            "run patrol --no-report --energy-limit 4000000",
            "cotama run patrol --energy-limit 4675896 --no-report",
        ),
        (
            "run patrol --supervised --fidelity plane --no-report",
            "cotama run patrol --fidelity plane --supervised --no-report --trace run.jsonl && \
             cotama replay run.jsonl",
        ),
    ] {
        let said = next(&folder, line);
        assert_eq!(said.as_deref(), Some(hint), "{line}");
        let ended = folder.shell(hint);
        assert!(matches!(ended.code, Some(0 | 1 | 3)), "{hint}: {ended:?}");
    }
}

#[test]
fn no_hint_asks_for_missing_input_or_an_impossible_command() {
    let folder = Folder::new("hints_none");
    folder.write("walk.toml", patrol(&[]));
    assert_eq!(next(&folder, "plan - < walk.toml"), None);
    assert_eq!(next(&folder, "run - --no-report < walk.toml"), None);
    assert_eq!(next(&folder, "plan patrol --lost kinect"), None);
    folder.shell("cotama export door --output door.pnml");
    assert_eq!(next(&folder, "models - < door.pnml"), None);
}
