//! The shipped patrol with one edit each: all that is said, with line and column, is in
//! `edited.txt`.

use cotama_axes::{Case, Lifted, PATROL, Steps, Table};
use proptest::prelude::*;
use std::fmt::Write;
use std::path::Path;

/// A fault of the file, and how the patrol is edited to have it.
type Edit = (&'static str, &'static str, &'static str);

const EDITS: [Edit; 81] = [
    ("an unknown format", "\"cotama-axes/1\"", "\"cotama-axes/7\""),
    ("a name with a space", "name = \"patrol-axes\"", "name = \"the patrol\""),
    ("no length of the path", "path_length_mm = 187000", ""),
    ("a float", "path_length_mm = 187000", "path_length_mm = 187.5"),
    ("a negative number", "path_length_mm = 187000", "path_length_mm = -1"),
    ("a number beyond 64 bits", "mass_g = 25000", "mass_g = 99999999999999999999"),
    ("a number too large", "mass_g = 25000", "mass_g = 9000000000000000"),
    ("a text for a number", "mass_g = 25000", "mass_g = \"heavy\""),
    ("an unknown sense", "[\"min\", \"data.volume\"]", "[\"least\", \"data.volume\"]"),
    ("an unknown indicator asked for", "[\"min\", \"energy.RC\"]", "[\"min\", \"energy.RD\"]"),
    ("no sum asked for", "[\"min\", \"energy.RC\"]", "[\"min\", \"safety.impact\"]"),
    ("an indicator asked for twice", "[\"min\", \"energy.LC\"]", "[\"max\", \"energy.RC\"]"),
    ("a wish of one word", "[\"min\", \"energy.LC\"]", "[\"energy.LC\"]"),
    ("a table by another name", "[robot]", "[robots]"),
    ("no step of speeds", "speed_step_mm_s = 10", ""),
    ("a step of nothing", "speed_step_mm_s = 10", "speed_step_mm_s = 0"),
    ("a misspelt key", "speed_max_mm_s = 760", "speed_max_mms = 760"),
    (
        "levels and a step",
        "speed_step_mm_s = 10",
        "speed_levels_mm_s = [330]\nspeed_step_mm_s = 10",
    ),
    ("levels that fall", "speed_step_mm_s = 10", "speed_levels_mm_s = [410, 330, 560]"),
    ("an empty list of levels", "speed_step_mm_s = 10", "speed_levels_mm_s = []"),
    ("levels above the most", "speed_step_mm_s = 10", "speed_levels_mm_s = [900]"),
    ("an unknown way to detect", "detect_by = \"zone\"", "detect_by = \"zones\""),
    ("an unknown key of a closed table", "c2 = 8466", "c2 = 8466\nc3 = 1"),
    ("hardware without units", "[hardware.sonar]\nunits = 1", "[hardware.sonar]"),
    ("hardware of no unit", "[hardware.sonar]\nunits = 1", "[hardware.sonar]\nunits = 0"),
    ("unknown hardware", "needs = { laser = 1, actuators = 1 }", "needs = { lazer = 1 }"),
    ("more hardware than there is", "needs = { kinect = 1 }", "needs = { kinect = 2 }"),
    ("a list for a table", "needs = { kinect = 1 }", "needs = [\"kinect\"]"),
    ("two options of one name", "id = \"M2\"", "id = \"M1\""),
    ("an option without a task", "id = \"T1\"\ntask = \"TUR\"", "id = \"T1\""),
    ("an option without a name", "id = \"M7\"", "label = \"M7\""),
    ("an unknown task", "tasks = [\"TUR\", \"LOC\"]", "tasks = [\"TURN\", \"LOC\"]"),
    ("an empty list of tasks", "tasks = [\"DET\"]", "tasks = []"),
    ("one task twice", "tasks = [\"TUR\", \"LOC\"]", "tasks = [\"TUR\", \"TUR\"]"),
    ("five tasks", "tasks = [\"DET\"]", "tasks = [\"DET\", \"MOV\", \"LOC\", \"TUR\", \"X\"]"),
    (
        "an objective beyond the path",
        "x_start_mm = 93500\nx_end_mm = 187000",
        "x_start_mm = 93500\nx_end_mm = 187001",
    ),
    (
        "an objective that ends before it begins",
        "x_start_mm = 0\nx_end_mm = 37000",
        "x_start_mm = 37000\nx_end_mm = 0",
    ),
    (
        "an objective that goes back",
        "id = \"O5\"\nx_start_mm = 37000",
        "id = \"O5\"\nx_start_mm = 36000",
    ),
    ("an unknown key of an objective", "id = \"O5\"", "id = \"O5\"\ntask = \"MOV\""),
    (
        "a zone beyond the path",
        "x_start_mm = 123500\nx_end_mm = 187000\nwidth",
        "x_start_mm = 123500\nx_end_mm = 1870000\nwidth",
    ),
    (
        "a zone that ends before it begins",
        "x_start_mm = 31000\nx_end_mm = 41000",
        "x_start_mm = 41000\nx_end_mm = 31000",
    ),
    (
        "a zone without length",
        "x_start_mm = 31000\nx_end_mm = 41000",
        "x_start_mm = 31000\nx_end_mm = 31000",
    ),
    ("zones at odds", "blind = [\"laser\"]", "blind = [\"laser\"]\nrequire_tio = \"L1\""),
    ("unknown hardware that is blind", "blind = [\"laser\"]", "blind = [\"lasers\"]"),
    ("an unknown option of a zone", "require_tio = \"L2\"", "require_tio = \"L4\""),
    ("unknown hardware of a zone", "require_hardware = \"sonar\"", "require_hardware = \"radar\""),
    ("two zones of one name", "id = \"H1-back\"", "id = \"H2\""),
    ("two axes of one name", "[[axis]]\nid = \"data\"", "[[axis]]\nid = \"energy\""),
    (
        "an unknown class of an axis",
        "id = \"data\"\nclass = \"minor\"",
        "id = \"data\"\nclass = \"small\"",
    ),
    ("two indicators of one name", "id = \"cpu\"  ", "id = \"frame_shift\"  "),
    (
        "an indicator without formula",
        "travel = { form = \"length_over_speed\" }\n\
     stand = { form = \"sum\", of = [\"option(stand_ms)\"] }",
        "",
    ),
    (
        "an unknown way to combine",
        "unit = \"um\"\ncombine = \"each\"",
        "unit = \"um\"\ncombine = \"all\"",
    ),
    (
        "a unit that a form does not yield",
        "id = \"RC\"                              # robot \
     consumption, eq. 5 times the duration\nunit = \"mJ\"",
        "id = \"RC\"\nunit = \"ms\"",
    ),
    (
        "a unit of a term that is another one",
        "power = [\"motion_mw\", \"hardware(power_mw)\"]",
        "power = [\"motion_mw\", \"hardware(data_kb_s)\"]",
    ),
    (
        "a speed for a power",
        "power = [\"motion_mw\", \"hardware(power_mw)\"]",
        "power = [\"speed_mm_s\", \"hardware(power_mw)\"]",
    ),
    ("a term without a unit", "of = [\"option(fix_dm)\"]", "of = [\"option(frames)\"]"),
    ("an unknown form", "form = \"length_over_speed\"", "form = \"length_by_speed\""),
    (
        "a form without what it needs",
        "{ form = \"share_of_length\", share = \
     \"option(fix_permille)\", round = \"down\" }",
        "{ form = \"share_of_length\" }",
    ),
    ("an unknown key of a form", "round = \"down\"", "rounding = \"down\""),
    ("an unknown way to round", "round = \"down\"", "round = \"floor\""),
    (
        "a length of one that stands",
        "stand = { form = \"sum\", of = [\"option(fix_dm)\"] }",
        "stand = { form = \"share_of_length\", share = \"option(fix_permille)\" }",
    ),
    ("a formula that reads itself", "of = [\"option(fix_dm)\"]", "of = [\"localisation.located\"]"),
    (
        "two formulas that read each other",
        "unit = \"um\"\ncombine = \"each\"\n\
     travel = \"div_up(1000 * speed_mm_s * option(frames), 30)\"",
        "unit = \"um\"\ncombine = \"each\"\ntravel = { form = \"sum\", of = [\"stability.b\"] }\n\
     [[axis.indicator]]\nid = \"b\"\nunit = \"um\"\ncombine = \"each\"\n\
     travel = { form = \"sum\", of = [\"stability.frame_shift\"] }\n#",
    ),
    (
        "an indicator that is not there when one stands",
        "of = [\"option(fix_dm)\"]",
        "of = [\"safety.impact\"]",
    ),
    ("an unknown inducer of the robot", "robot.mass_g * speed", "robot.mas_g * speed"),
    ("a misspelt key of an option", "cpu_permille = 110", "cpu_permile = 110"),
    ("a misspelt key of hardware", "range_mm = 5000", "rangee_mm = 5000"),
    ("an unknown inducer of options", "option(frames)", "option(frame)"),
    (
        "an unknown inducer",
        "travel = \"div_up(robot.mass_g * speed_mm_s",
        "travel = \"div_up(robot.mass_g * sped_mm_s",
    ),
    (
        "an unknown function",
        "travel = \"div_up(1000 * speed_mm_s",
        "travel = \"div(1000 * speed_mm_s",
    ),
    ("a formula that is cut off", "option(frames), 30)\"", "option(frames), 30\""),
    ("an unknown operator", "op = \"<=\"", "op = \"=<\""),
    (
        "an unknown kind, and an unknown indicator",
        "indicator = \"energy.RC\"\nkind = \"end\"",
        "indicator = \"energy.R\"\nkind = \"ends\"",
    ),
    (
        "an equality of a sum in each activity",
        "indicator = \"energy.RC\"\nkind = \"end\"\nop = \"<=\"",
        "indicator = \"energy.RC\"\nkind = \"core\"\nop = \"=\"",
    ),
    ("a constraint without its limit", "goal = 8640000", ""),
    (
        "a goal that varies, at the end",
        "goal = 8640000",
        "at = [{ zone = \"H2\", goal = 1 }]\ngoal = 8640000",
    ),
    (
        "an end of what has no sum",
        "indicator = \"stability.cpu\"\nkind = \"core\"",
        "indicator = \"stability.cpu\"\nkind = \"end\"",
    ),
    ("a goal in an unknown zone", "{ zone = \"valve1-approach\"", "{ zone = \"valve1-aproach\""),
    ("an unknown key of a constraint", "goal = 8640000", "goal = 8640000\nunit = \"mJ\""),
    (
        "a table that is not closed",
        "[[constraint]]\nid = \"harmless\"",
        "[[constraint]\nid = \"harmless\"",
    ),
    ("a key twice", "mass_g = 25000", "mass_g = 25000\nmass_g = 26000"),
];

fn edited(&(fault, from, to): &Edit) -> String {
    assert!(PATROL.contains(from), "{fault}: {from}");
    PATROL.replacen(from, to, 1)
}

#[test]
fn every_fault_of_a_file_is_said_with_its_place_and_its_remedy() {
    let mut said = String::new();
    for edit in &EDITS {
        let Err(wrongs) = Case::parse(&edited(edit)) else { panic!("{} is read", edit.0) };
        let _ = writeln!(said, "{}\n  {}\n", edit.0, wrongs.to_string().replace('\n', "\n  "));
    }
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/edited.txt");
    cotama_golden::compare(stored, &said);
}

/// Edits that do not touch one another are all found in one reading.
#[test]
fn faults_of_a_file_are_said_all_at_once() {
    let edits = [
        "a negative number",
        "an unknown operator",
        "an unknown option of a zone",
        "a unit that a form does not yield",
        "two options of one name",
    ];
    let chosen = EDITS.iter().filter(|it| edits.contains(&it.0));
    let text = chosen.fold(PATROL.to_owned(), |text, it| text.replacen(it.1, it.2, 1));
    let wrongs = Case::parse(&text).unwrap_err();
    // The unit is that of two formulas.
    assert_eq!(wrongs.all.len(), edits.len() + 1, "{wrongs}");
    assert!(wrongs.all.is_sorted_by_key(|it| (it.line, it.column)));
}

/// A hostile file costs little: tables and faults have limits.
#[test]
fn a_file_of_many_keys_is_refused_with_few_words() {
    let keys =
        |count: usize| (0..count).fold(String::new(), |text, it| text + &format!("k{it} = \"\"\n"));
    let many = PATROL.replacen("[robot]\n", &format!("[robot]\n{}", keys(100_000)), 1);
    let wrongs = Case::parse(&many).unwrap_err();
    assert_eq!((wrongs.all.len(), wrongs.omitted), (64, 1));
    let first = "18:1: `robot` has 100005 further keys, at most 64 are read";
    assert_eq!(wrongs.all[0].to_string(), first);
    let many = PATROL.replacen("[motion_power]", &format!("[motion_power]\n{}", keys(9_000)), 1);
    let wrongs = Case::parse(&many).unwrap_err();
    assert_eq!((wrongs.all.len(), wrongs.omitted), (64, 9_000 - 64));
}

proptest! {
    /// A file with some bytes changed is read, or refused; what is read has a table, or none.
    #[test]
    fn changed_bytes_never_end_the_program(
        changes in prop::collection::vec((0..PATROL.len(), any::<u8>()), 1..12),
        cut in 0..PATROL.len(),
    ) {
        let mut bytes = PATROL.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        bytes.truncate(if cut % 4 == 0 { cut } else { PATROL.len() });
        let text = String::from_utf8_lossy(&bytes);
        match Case::parse(&text) {
            Ok(case) => {
                let _ = Table::new(&case.mission, Lifted::default(), &mut Steps::new(1_000_000));
            }
            Err(wrongs) => {
                let lines = 1 + text.matches('\n').count();
                prop_assert!(!wrongs.all.is_empty());
                prop_assert!(wrongs.all.iter().all(|it| it.line <= lines && it.column > 0));
            }
        }
    }
}
