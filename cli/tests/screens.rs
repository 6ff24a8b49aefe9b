//! What people see, and what becomes of it in pipes, narrow windows and without colours.

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
    for width in [60, 80, 100, 200] {
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
            "run fleet --robots 4 --tasks 4 --seeds 2",
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

#[test]
fn a_reader_who_goes_away_is_no_error() {
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
