//! Screens for people, and their form in pipes, narrow windows and without colours.

use crate::common::{Folder, golden};

#[test]
fn the_screens_of_the_patrol() {
    let folder = Folder::new("screens");
    golden("plan_patrol.txt", &folder.cotama(&["plan", "patrol"]).stdout);
    golden("run_patrol.txt", &folder.cotama(&["run", "patrol"]).stdout);
    golden("run_delivery.txt", &folder.cotama(&["run", "delivery"]).stdout);
    golden("run_delivery_narrow.txt", &folder.shell("COLUMNS=60 cotama run delivery").stdout);
    golden("plan_delivery.txt", &folder.cotama(&["plan", "delivery"]).stdout);
    golden("plan_patrol_narrow.txt", &folder.shell("COLUMNS=60 cotama plan patrol").stdout);
    golden("plan_infeasible.txt", &folder.cotama(&["plan", "patrol", "--lost", "kinect"]).stdout);
    golden(
        "run_infeasible.txt",
        &folder.cotama(&["run", "patrol", "--duration-limit", "400000"]).stdout,
    );
    golden("list.txt", &folder.cotama(&["list"]).stdout);
}

#[test]
fn colours_are_for_terminals_or_on_demand() {
    let folder = Folder::new("screens_colour");
    let coloured = |line: &str| folder.shell(line).stdout.contains("\u{1b}[");
    assert!(!coloured("cotama plan patrol"));
    assert!(coloured("cotama plan patrol --color always"));
    assert!(coloured("CLICOLOR_FORCE=1 cotama plan patrol"));
    assert!(!coloured("CLICOLOR_FORCE=1 NO_COLOR=1 cotama plan patrol"));
    assert!(!coloured("CLICOLOR_FORCE=1 cotama plan patrol --color never"));
    assert!(!coloured("cotama plan patrol --json --color always"));
}

#[test]
fn no_line_is_wider_than_the_window_where_tables_can_be_wrapped() {
    let folder = Folder::new("screens_width");
    for width in [60, 100] {
        for line in [
            "list",
            "plan patrol",
            "plan patrol --objective front",
            "plan patrol --lost kinect",
            "plan delivery",
            "run patrol --no-report",
            "run patrol --no-report --duration-limit 400000",
            "run delivery --no-report",
            "run service --no-report",
            "run fleet --no-report --robots 8 --tasks 20",
            "run two-ways --policy mean",
            "run fleet --robots 4 --tasks 4 --seeds 2",
            "campaign patrol --runs 40 --require completed --shrink 2",
            "campaign patrol --compare --runs 40",
            "campaign delivery --compare --runs 9",
            "models",
            "models door",
            "models delivery",
            "models philosophers",
            "check door",
            "check philosophers:3 --property deadlock_free",
            "check watchdog --property 'bound(w1 -> Fault)'",
            "statespace kanban:2",
            "statespace door",
            "estimate door --untimed --property 'EF Open' --runs 50",
            "simulate door Call EndOpen +5000",
            "simulate philosophers:3 left_first_1",
            "fmeca",
            "fmeca --diagnosability",
        ] {
            let screen = folder.shell(&format!("COLUMNS={width} cotama {line}")).stdout;
            for it in screen.lines() {
                // A command to copy is one line.
                let fits = it.starts_with("next: ") || it.chars().count() <= width;
                assert!(fits, "{line}: {} > {width}: {it}\n{screen}", it.chars().count());
            }
        }
    }
}

/// A table that is too wide goes on in another block, with the names of its rows.
#[test]
fn a_row_of_numbers_is_broken_between_columns_alone() {
    let folder = Folder::new("screens_rows");
    let missions = &["rigid", "usual", "exact", "upward"][..];
    let mut blocks = 0;
    for width in [60, 72, 80, 90, 120, 200] {
        for (line, names) in [
            ("campaign patrol --compare --runs 40", missions),
            ("campaign patrol --compare --runs 1000 --confidence 0.999", missions),
            ("campaign patrol --compare --runs 20 --strategy pairwise", missions),
            ("campaign delivery --compare --runs 9", &["rigid", "rule", "usual", "upward"]),
            ("run fleet --robots 4 --tasks 4 --seeds 2", &["optimal", "rounds", "one-by-one"]),
        ] {
            let screen = folder.shell(&format!("COLUMNS={width} cotama {line}")).stdout;
            let lines: Vec<_> = screen.lines().collect();
            let first = |it: &str| it.split_whitespace().next().unwrap_or_default().to_owned();
            let begins: Vec<_> =
                (0..lines.len()).filter(|it| first(lines[*it]) == names[0]).collect();
            assert!(!begins.is_empty(), "{screen}");
            for at in &begins {
                let found: Vec<_> =
                    lines[*at..at + names.len()].iter().map(|it| first(it)).collect();
                assert_eq!(found, names, "{width}: {line}\n{screen}");
                let head = lines[at - 1];
                assert!(head.starts_with("  ") && lines[at - 2].is_empty(), "{width}:\n{screen}");
            }
            blocks += begins.len();
        }
    }
    assert!(blocks > 40, "{blocks} blocks");
}

/// An abbreviation is in the user's own file, of the analysis that a command lists, or explained
/// on the screen itself.
#[test]
fn no_screen_has_an_abbreviation_that_nothing_explains() {
    let folder = Folder::new("screens_words");
    assert_eq!(folder.cotama(&["new", "mission", "hall"]).code, Some(0));
    let analysis = folder.cotama(&["fmeca", "--json"]).stdout;
    let is_short = |word: &str| {
        let letters = word.chars().filter(char::is_ascii_uppercase).count();
        let shape = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || ".-".contains(c);
        word.len() > 1 && letters > 0 && word.chars().all(shape)
    };
    let words = |text: &str| -> Vec<String> {
        let apart = |c: char| !(c.is_alphanumeric() || ".-_".contains(c));
        let words = text.split(apart).map(|it| it.trim_matches(['.', '-']).to_owned());
        words.collect()
    };
    let mut seen = 0;
    for (mission, line) in [
        ("patrol", "plan patrol"),
        ("patrol", "plan patrol --energy-limit 4000000"),
        ("patrol", "plan patrol --lost kinect"),
        ("patrol", "run patrol --no-report"),
        ("patrol", "campaign patrol --runs 60 --require completed"),
        ("delivery", "plan delivery"),
        ("delivery", "run delivery --no-report"),
        ("delivery", "campaign delivery --runs 60 --require requests<=0 --shrink 3"),
        ("hall.toml", "plan hall.toml"),
        ("hall.toml", "run hall.toml --no-report"),
        ("service", "run service --no-report"),
        ("fleet", "run fleet --robots 6 --tasks 9 --no-report"),
    ] {
        let own = match mission.strip_suffix(".toml") {
            Some(_) => folder.read(mission),
            None => folder.cotama(&["show", mission]).stdout,
        };
        let robot = folder.cotama(&["show", "p3dx-delivery"]).stdout;
        let known = [words(&own), words(&robot), words(&analysis)].concat();
        let ended = folder.cotama(&line.split(' ').collect::<Vec<_>>());
        let screen = ended.stdout;
        assert!(matches!(ended.code, Some(0 | 1)), "{line}: {}", ended.stderr);
        for word in words(&screen).into_iter().filter(|it| is_short(it)) {
            let number = word.strip_prefix('A').is_some_and(|it| it.parse::<u32>().is_ok());
            let explained = number && screen.contains("activities");
            // `PF.OPT`, `TO.FULL`.
            let set = word.contains('.') && screen.contains("sets of modules");
            // `SW1.MCL`: a row that is one of each module.
            let of_module = word.split_once('.').is_some_and(|it| known.contains(&it.0.to_owned()));
            let explained = explained || set || of_module || known.contains(&word);
            assert!(explained, "{line}: `{word}`\n{screen}");
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

#[test]
fn a_closed_pipe_is_no_error() {
    let folder = Folder::new("screens_pipe");
    for command in [
        "plan patrol --json",
        "plan patrol",
        "run patrol",
        "table patrol",
        "man",
        "--help",
        "schema run",
        "models",
        "export door --format svg",
        "simulate door Call",
        "check door --json",
        "statespace door --mcc",
        "fmeca",
        "fmeca --format html",
    ] {
        let ended = folder.shell(&format!("( cotama {command}; echo $? >&2 ) | head -c 1 > one"));
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), "0\n"), "{command}");
        let ended = folder.shell(&format!("( sleep 0.1; cotama {command}; echo $? >&2 ) | true"));
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), "0\n"), "{command}");
    }
}
