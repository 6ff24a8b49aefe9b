//! Broken mission files and what is said about them. The messages are in `tests/golden/`, one file
//! each; `UPDATE_GOLDEN=1 cargo test -p cotama-models --test mission broken` writes them again.
#![cfg(feature = "std")]
#![allow(clippy::format_collect)] // a broken file may be slow to make

use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};

fn patrol() -> &'static str {
    embedded::mission("patrol").unwrap().text
}

/// The patrol with each `(old, new)` text replaced where it stands first.
fn with(edits: &[(&str, &str)]) -> String {
    edits.iter().fold(patrol().to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old:?} is not in the patrol");
        text.replacen(old, new, 1)
    })
}

fn compare(name: &str, said: &str) {
    cotama_golden::compare(format!("tests/golden/{name}.txt"), &format!("{said}\n"));
}

/// Parses a broken file on a thread of the usual 2 MiB, and checks the invariants of its errors.
fn refused(name: &str, text: String) {
    let parse =
        move || Mission::parse("patrol.toml", &text).expect_err("a broken file was accepted");
    let errors =
        std::thread::Builder::new().stack_size(2 << 20).spawn(parse).unwrap().join().unwrap();
    assert!(!errors.diagnostics().is_empty());
    for diagnostic in errors.diagnostics() {
        assert!(errors.text().get(diagnostic.span.clone()).is_some(), "{name}: {diagnostic:?}");
    }
    compare(name, &errors.to_string());
}

#[test]
fn edits_of_the_patrol() {
    let cases: &[(&str, &[(&str, &str)])] = &[
        ("syntax", &[("mass_g = 25000", "mass_g = = 25000"), ("id = \"M1\"", "id = \"M1")]),
        ("duplicate_key", &[("c0 = 4890", "c0 = 4890\nc0 = 4891")]),
        ("format", &[("panorama-mission/1", "panorama-mission/9")]),
        ("format_missing", &[("format = \"panorama-mission/1\"", "")]),
        ("objective_of_plans", &[("plan.objective = \"paper\"", "plan.objective = \"qualty\"")]),
        ("objective_of_no_plan", &[("plan.objective = \"paper\"", "plan.goal = \"paper\"")]),
        ("misspelt_key", &[("path_length_mm", "path_lenght_mm")]),
        ("unknown_key", &[("mass_g = 25000", "mass_g = 25000\nwheels = 3")]),
        ("missing_keys", &[("energy_mj = 8640000", ""), ("speed_max_mm_s = 760", "")]),
        (
            "wrong_types",
            &[
                ("name = \"patrol\"", "name = 7"),
                ("units = 2 ", "units = \"two\" "),
                ("tasks = [\"MOV\", \"LOC\"]", "tasks = \"MOV\""),
                ("source = \"inferred\"", "source = 1"),
            ],
        ),
        (
            "floats",
            &[
                ("mass_g = 25000", "mass_g = nan"),
                ("c1 = 3930", "c1 = 1e3"),
                ("turn_ms = 8000", "turn_ms = 8000.5"),
            ],
        ),
        (
            "numbers",
            &[
                ("mass_g = 25000", "mass_g = -25000"),
                ("duration_ms = 600000", "duration_ms = 0"),
                ("power_mw = 1300", "power_mw = 99_999_999_999_999_999_999"),
                ("c2 = 8466", "c2 = 0x7fff_ffff_ffff"),
            ],
        ),
        ("order_twice", &[("[\"duration\", \"energy\"]", "[\"energy\", \"energy\"]")]),
        ("order_unknown", &[("[\"duration\", \"energy\"]", "[\"durations\", \"quality\"]")]),
        ("order_empty", &[("[\"duration\", \"energy\"]", "[]")]),
        ("rounding", &[("round_half_up(length_mm", "floor(length_mm")]),
        ("harmless_speed", &[("speed_harmless_mm_s = 560", "speed_harmless_mm_s = 566")]),
        (
            "harmless_never",
            &[
                ("impact_energy_max_mj = 4000", "impact_energy_max_mj = 1"),
                ("mass_g = 25000", "mass_g = 1_000_000_000"),
                ("speed_harmless_mm_s = 560", ""),
            ],
        ),
        ("motion_power_point", &[("power_mw=9746", "power_mw=9747")]),
        ("too_many_units", &[("units = 2 ", "units = 8 ")]),
        ("needs_more_than_there_are", &[("laser = 2, actuators", "laser = 3, actuators")]),
        (
            "unknown_hardware",
            &[
                ("{ sonar = 1, actuators = 1 }", "{ sonars = 1, wings = 2 }"),
                ("require_hardware = \"sonar\"", "require_hardware = \"radar\""),
                ("\"laser\"", "\"lasser\""),
            ],
        ),
        (
            "unknown_task",
            &[("task = \"MOV\"", "task = \"MVO\""), ("[\"TUR\", \"LOC\"]", "[\"TURN\", \"fly\"]")],
        ),
        (
            "unknown_option",
            &[("require_tio = \"L2\"", "require_tio = \"L9\""), ("{ D1 =", "{ D7 =")],
        ),
        (
            "unknown_zone",
            &[("\"H2\" = -75", "\"H22\" = -75"), ("\"H1-out\" = 5", "\"H1-out\" = -1000")],
        ),
        (
            "duplicate_ids",
            &[
                ("id = \"M2\"", "id = \"M1\""),
                ("id = \"O2\"", "id = \"O1\""),
                ("id = \"H2\"", "id = \"H1-out\""),
            ],
        ),
        (
            "bad_ids",
            &[("id = \"M2\"", "id = \"M 2\""), ("[hardware.sonar]", "[hardware.\"so\\u001bnar\"]")],
        ),
        ("bad_name", &[("name = \"patrol\"", "name = \"two\\nlines\"")]),
        ("zone_outside", &[("x_end_mm = 187000\nspeed", "x_end_mm = 187001\nspeed")]),
        ("zone_empty", &[("x_start_mm = 31000", "x_start_mm = 41000")]),
        (
            "objectives_gap",
            &[("x_start_mm = 0\nx_end_mm = 37000", "x_start_mm = 5\nx_end_mm = 36000")],
        ),
        (
            "objectives_overlap",
            &[("x_end_mm = 37000\ntasks = [\"DET\"]", "x_end_mm = 36000\ntasks = [\"DET\"]")],
        ),
        ("objectives_short", &[("x_end_mm = 187000\ntasks", "x_end_mm = 180000\ntasks")]),
        (
            "lead_tasks",
            &[
                ("[\"MOV\", \"LOC\"]", "[\"LOC\"]"),
                ("[\"TUR\", \"LOC\"]", "[\"TUR\", \"DET\"]"),
                ("[\"DET\"]", "[\"MOV\"]"),
                ("[\"TUR\", \"LOC\"]", "[\"TUR\", \"LOC\", \"LOC\"]"),
            ],
        ),
        ("no_option_of_a_task", &[("task = \"TUR\"", "task = \"LOC\"")]),
        ("fixed_missing", &[("[fixed] ", "[robot.fixed] ")]),
        ("detect_power_missing", &[(", D2 = 6500", "")]),
        ("emptied", &[("require_tio = \"L2\"", "require_tio = \"T1\"")]),
        (
            "emptied_by_units",
            &[("require_hardware = \"sonar\"", "require_hardware = \"laser\"\nrequire_units = 3")],
        ),
        ("units_without_hardware", &[("require_tio = \"L2\"", "require_units = 2")]),
        ("too_expensive", &[("c0 = 4890 ", "c0 = 1_000_000_000 "), ("at = [", "source = \"\"\n#")]),
        (
            "events",
            &[
                ("x_mm = 12000", "x_mm = 187_001"),
                ("units_lost = 1", "units_lost = 3"),
                ("kind = \"odometry\"", "kind = \"odometer\""),
                ("delay_ms = 500", "extra_mm = 500"),
            ],
        ),
        (
            "random_events",
            &[(
                "[run]",
                "[run]\nrandom = [{ name = \"door\", kind = \"fault\", per_km = 1 }, { name = \
                 \"a\", kind = \"obstacle\", per_km = 0, delay_ms = 5 }, { name = \"a\", kind = \
                 \"odometry\", per_km = 5 }]",
            )],
        ),
        ("monitor_period", &[("monitor_period_ms = 1000", "monitor_period_ms = 0")]),
        (
            "beyond_ascii",
            &[("name = \"patrol\"", "name = \"päß\"; \n"), ("path_length_mm", "\u{feff}")],
        ),
    ];
    assert!(cases.len() >= 25);
    for (name, edits) in cases {
        refused(name, with(edits));
    }
}

/// A key in another unit: the number is that of the unit of files, where it is whole.
#[test]
fn a_quantity_in_another_unit_comes_with_its_number_in_the_unit_of_files() {
    for (line, other, help) in [
        ("path_length_mm = 187000", "path_length_m = 187", "write `path_length_mm = 187000`"),
        ("path_length_mm = 187000", "path_length_km = 0.187", "write `path_length_mm = 187000`"),
        ("path_length_mm = 187000", "path_length_cm = 18700.50", "write `path_length_mm = 187005`"),
        ("path_length_mm = 187000", "path_length_M = 1.5", "write `path_length_mm = 1500`"),
        (
            "path_length_mm = 187000",
            "path_length_m = 1.2345",
            "write `path_length_mm`: one m is 1000 mm",
        ),
        ("path_length_mm = 187000", "path_length = 187", "write `path_length_mm`, in mm"),
        ("duration_ms = 600000", "duration_min = 10", "write `duration_ms = 600000`"),
        ("duration_ms = 600000", "duration_h = 0.25", "write `duration_ms = 900000`"),
        ("duration_ms = 600000", "duration_s = 1e3", "write `duration_ms`: one s is 1000 ms"),
        ("energy_mj = 8640000", "energy_Wh = 2.4", "write `energy_mj = 8640000`"),
        ("energy_mj = 8640000", "energy_kJ = 8.64", "write `energy_mj = 8640000`"),
        ("energy_mj = 8640000", "energy_j = -1", "write `energy_mj`: one j is 1000 mj"),
        ("mass_g = ", "mass_kg = 9.5 # ", "write `mass_g = 9500`"),
    ] {
        let errors = Mission::parse("patrol.toml", &with(&[(line, other)])).unwrap_err();
        let first = &errors.diagnostics()[0];
        let (known, found) = (line.split(' ').next().unwrap(), other.split(' ').next().unwrap());
        assert!(first.message.starts_with(&format!("unknown key `{found}`")), "{errors}");
        assert!(first.message.ends_with(&format!("did you mean `{known}`?")), "{errors}");
        assert_eq!(first.help.as_deref(), Some(help), "{other}");
        // What the help writes is read.
        if let Some(written) = help.split('`').nth(1).filter(|it| it.contains('=')) {
            let rest = if other.ends_with("# ") { " # " } else { "" };
            let mended = with(&[(line, &format!("{written}{rest}"))]);
            let errors = Mission::parse("patrol.toml", &mended).map_err(|it| it.to_string());
            let refused = errors
                .is_err_and(|it| it.contains("unknown key") || it.contains("must be an integer"));
            assert!(!refused, "{written}");
        }
    }
}

#[test]
fn files_of_their_own() {
    refused("empty", String::new());
    refused("only_format", "format = \"panorama-mission/1\"\n".into());
    refused(
        "lists_empty",
        "format = \"panorama-mission/1\"\ntio = []\nobjective = []\nzone = []\n".into(),
    );
    let prose = "# A robot\n\nIt drives on, whatever is in its way.\nSee below.\n";
    refused("prose", prose.repeat(3));
    refused("nested", format!("format = {}", "[".repeat(100_000)));
    refused("nested_tables", format!("format = {}", "{a=".repeat(100_000)));
    refused("nested_keys", format!("{}b = 1", "a.".repeat(100_000)));
    let options: String =
        (0..16).map(|kind| format!("[hardware.h{kind}]\nunits = 1\npower_mw = 1\n")).collect();
    refused("too_many_kinds", with(&[("[hardware.sonar]", &format!("{options}[hardware.sonar]"))]));
    let zone = |i| format!("[[zone]]\nid = \"z{i}\"\nx_start_mm = {i}\nx_end_mm = {}\n", i + 1);
    let zones: String = (0..1001).map(zone).collect();
    refused("too_many_zones", patrol().to_owned() + &zones);
    let tio = |i| format!("[[tio]]\nid = \"x{i}\"\ntask = \"LOC\"\nneeds = {{}}\n");
    let tios: String = (0..200).map(tio).collect();
    refused("too_many_alternatives", patrol().to_owned() + &tios);
    let zones: String = (0..900).map(zone).collect();
    let tios: String = (0..60).map(tio).collect();
    refused("too_many_alternatives_in_all", patrol().to_owned() + &zones + &tios);
    let wrong: String = (0..500).map(|i| format!("wrong{i} = 1\n")).collect();
    refused("too_many_errors", wrong + patrol());
}

#[test]
fn files_of_faults() {
    let mission = Mission::parse("patrol", patrol()).unwrap();
    let run = &patrol()[patrol().find("[run]").unwrap()..];
    let script = run
        .replace("[run]", "format = \"panorama-faults/1\"")
        .replace("[[run.event]]", "[[event]]");
    let stand_alone = script.replace("monitor_period_ms = 1000", "");
    assert_eq!(
        Faults::parse("faults.toml", &stand_alone, &mission).as_ref(),
        Ok(&mission.run.faults)
    );
    let errors = Faults::parse("faults.toml", &script, &mission).unwrap_err();
    assert_eq!((errors.source_name(), errors.text()), ("faults.toml", &*script));
    compare("faults_with_period", &errors.to_string());
    let errors = Faults::parse("faults.toml", patrol(), &mission).unwrap_err();
    compare("faults_of_another_format", &errors.to_string());
}

#[test]
fn the_events_of_a_run_are_sorted_by_place() {
    let later_first = with(&[("x_mm = 12000", "x_mm = 170_000"), ("monitor_period_ms = 1000", "")]);
    let mission = Mission::parse("patrol", &later_first).unwrap();
    let places: Vec<_> = mission.run.faults.events.iter().map(|event| event.x.0).collect();
    let expected = [
        20_000, 27_000, 50_000, 63_400, 75_000, 105_000, 118_000, 131_000, 150_000, 170_000,
        170_000,
    ];
    assert_eq!(places, expected);
    assert_eq!(mission.run.monitor_period.0, 1000);
}
