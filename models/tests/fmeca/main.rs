//! Analyses from files, and the robot's on the same path.
#![cfg(feature = "std")]

mod amount;
mod broken;
mod criticality;
mod groups;
mod limits;
mod robot;

use cotama_models::fmeca::Analysis;

/// A lidar and a gripper, by hand: LID1 and LID2 share `lidar silent`, LID2 and LID3 `lidar late`.
const SMALL: &str = r#"format = "cotama-fmeca/1"
title = "A small robot"
period_h = 10

[[flag]]
name = "lidar silent"
observer = "driver"
[[flag]]
name = "lidar late"
[[flag]]
name = "force low"

[[probe]]
name = "voltage at the lidar"
shows = ["LID1"]
[[probe]]
name = "load of the bus"
shows = ["LID2"]

[[mode]]
id = "LID1"
function = "see"
component = "lidar"
failure = "no supply"
cause = "cable"
effect = "blind"
severity = "hard"
flags = ["lidar silent"]
latency_ms = 100
mtbf_h = 500

[[mode]]
id = "LID2"
function = "see"
component = "lidar"
failure = "bus overloaded"
cause = "another device"
effect = "late or no ranges"
severity = "medium"
severity_operator = "weak"
sometimes = ["lidar silent", "lidar late"]
flags = []
latency_ms = 100
failures_per_million_h = 20_000

[[mode]]
id = "LID3"
function = "see"
component = "lidar"
failure = "late ranges"
cause = "load"
effect = "slower"
severity = "weak"
flags = ["lidar late"]
sometimes = ["lidar silent"]
latency_ms = 1001
mtbf_h = 0.5

[[mode]]
id = "GRP1"
function = "hold"
component = "gripper"
failure = "loses its grip"
cause = "worn pads"
effect = "the object falls"
severity = "fatal"
silent = "nothing measures the force"
mtbf_h = 1e5
alpha_permille = 250
beta_permille = 400
"#;

/// The small file with texts replaced where they stand first.
fn with(edits: &[(&str, &str)]) -> String {
    edits.iter().fold(SMALL.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old:?} is not in the small file");
        text.replacen(old, new, 1)
    })
}

fn small() -> Analysis {
    Analysis::parse("small.toml", SMALL).unwrap()
}

#[test]
fn a_file_is_read_as_it_is_written() {
    let small = small();
    assert_eq!((small.title(), small.period_h()), ("A small robot", 10));
    assert_eq!(small.functions(), ["see", "hold"]);
    let ribs = small.ribs("see");
    assert_eq!((ribs.len(), ribs[0].component, ribs[0].modes.len()), (1, "lidar", 3));
    assert_eq!(small.ribs("fly"), []);
    let mtbf: Vec<_> = small.modes().iter().map(|it| it.mtbf_mh).collect();
    assert_eq!(mtbf, [500_000, 50_000, 500, 100_000_000]);
    assert_eq!(small.flags()[0].observer, "driver");
    // Without [[flag]] the rows themselves say which flags there are.
    let (head, rest) = SMALL.split_once("[[flag]]").unwrap();
    let undeclared = format!("{head}{}", &rest[rest.find("[[probe]]").unwrap()..]);
    let undeclared = Analysis::parse("small.toml", &undeclared).unwrap();
    let names: Vec<_> = undeclared.flags().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["lidar silent", "lidar late"]);
}

/// By hand: LID1 raises {silent}; LID2 nothing, silent, late or both, but nothing for sure, so it
/// is not detected; LID3 {late} or {late, silent}. With `lidar late` among what LID1 may raise, it
/// and LID3 share {silent, late}.
#[test]
fn groups_of_a_small_file_by_hand() {
    let told = small().diagnose(&small().sound());
    assert_eq!((told.detectable, told.undetectable), (vec![0, 2], vec![1, 3]));
    assert_eq!((told.pairs.len(), told.groups.list.len(), told.separable), (0, 0, true));

    // LID2 always raises `lidar silent` now: {silent} is LID1 or LID2, {silent, late} LID2 or LID3.
    let edits =
        [("sometimes = [\"lidar silent\", \"lidar late\"]", "sometimes = [\"lidar late\"]")];
    let text = with(&edits).replacen("flags = []", "flags = [\"lidar silent\"]", 1);
    let open = Analysis::parse("small.toml", &text).unwrap();
    let status = open.sound();
    let told = open.diagnose(&status);
    assert_eq!(told.groups.list, [vec![0, 1], vec![1, 2]]);
    assert!(told.groups.complete);
    let pairs: Vec<_> = told.pairs.iter().map(|it| (it.modes, it.probes.clone())).collect();
    assert_eq!(pairs, [([0, 1], vec![0, 1]), ([1, 2], vec![1])]);
    // The load of the bus shows LID2 and tells both pairs apart.
    assert_eq!((told.least_probes, told.separable), (vec![1], true));
    let (least, most) = open.shared(&[1, 2], &status).unwrap();
    assert_eq!(
        (open.names(&least), open.names(&most)),
        (vec!["lidar silent", "lidar late"], vec!["lidar silent", "lidar late"])
    );
    assert_eq!(open.shared(&[0, 2], &status), None);
}

#[test]
fn comma_separated_values_hold_all_but_the_declarations() {
    let small = small();
    let again = Analysis::parse_csv("folder/small.csv", &small.to_csv()).unwrap();
    assert_eq!((again.title(), again.period_h()), ("small", 8));
    assert_eq!(again.to_csv().lines().count(), 5);
    let rows = |it: &Analysis| -> Vec<_> {
        let named = |at: usize| {
            let mode = &it.modes()[at];
            (mode.id.clone(), it.names(&mode.flags).join("|"), it.names(&mode.sometimes).join("|"))
        };
        (0..it.modes().len()).map(named).collect()
    };
    assert_eq!(rows(&again), rows(&small));
    for (one, other) in again.modes().iter().zip(small.modes()) {
        assert_eq!((one.mtbf_mh, one.latency_ms), (other.mtbf_mh, other.latency_ms));
        assert_eq!((&one.silent, one.alpha_permille), (&other.silent, other.alpha_permille));
    }
    // Keys of TOML are columns too; lists stand between `;`; quotes, CRLF and an empty last line
    // are as spreadsheets write them.
    let text = "\u{feff}ID,function,component,failure mode,cause,effect,severity,mtbf_h,flags,\
        latency_ms\r\nA,\"to \"\"see\"\"\",\"a, b\",f,c,e,Hard,8,one;two,5\r\n\
        B,see,a,f,c,e,weak,8,one two;,5\r\n,,,,,,,,,\r\n";
    let read = Analysis::parse_csv("table.csv", text).unwrap();
    let [a, b] = read.modes() else { panic!("{read:?}") };
    assert_eq!((a.function.as_str(), a.component.as_str()), ("to \"see\"", "a, b"));
    assert_eq!(read.names(&a.flags), ["one", "two"]);
    assert_eq!(read.names(&b.flags), ["one two"]);
}

const HEAD: &str = "id,function,component,failure,cause,effect,severity,flags,latency_ms,mtbf_h";
const ROW: &str = "A,see,lidar,stands,worn,blind,hard,scan late;,200,8000";

#[test]
fn empty_columns_cells_and_rows_of_a_spreadsheet_are_passed_over() {
    let right = Analysis::parse_csv("t.csv", &format!("{HEAD}\n{ROW}\n")).unwrap();
    for text in [
        format!("{HEAD},,\n{ROW},,\n"),
        format!("{HEAD}\n{ROW},,,\n"),
        format!("{HEAD},,\n{ROW}\n"),
        format!("{HEAD},,\n{ROW},,\n,,,,,,,,,,,\n,,,,,,,,,,,\n"),
        format!("\n,,,\n{HEAD},\r\n\r\n{ROW},\r\n"),
        format!("{HEAD}, ,\n{ROW}, ,  \n"),
        format!(",{HEAD}\n,{ROW}\n"),
        HEAD.replace("cause,effect", "cause,,effect") + "\n" + &ROW.replace("worn,", "worn,,"),
    ] {
        let read = Analysis::parse_csv("t.csv", &text);
        assert_eq!(read.as_ref().ok(), Some(&right), "{text}: {read:?}");
    }
}

#[test]
fn a_table_that_is_not_one_has_one_error_for_its_cause() {
    for (text, first) in [
        (
            format!("FMEA robot arm,,,,,,,,,\n{HEAD}\n{ROW}\n{ROW}\n"),
            "t.csv:1:1: the first row holds the names of the columns, and this one does not",
        ),
        (
            format!("FMEA,arm\nof,2026\n\n{HEAD}\n{ROW}\n"),
            "t.csv:1:1: the first row holds the names of the columns, and this one does not",
        ),
        (format!("{HEAD},\n{ROW},note\n"), "t.csv:1:77: this column has no name"),
        (
            format!("{HEAD}\n{}\n", ROW.replace("worn", "worn, old")),
            "t.csv:2:1: this row has 11 cells, but there are 10 columns",
        ),
        (
            format!("{HEAD}\n{}\n", ROW.replace(",8000", "")),
            "t.csv:2:1: this row has 9 cells, but there are 10 columns",
        ),
        (
            format!("{HEAD}\n{}\n", ROW.replace("scan late;", "scan late")),
            "t.csv:2:36: `scan late` is one name, or several",
        ),
    ] {
        let errors = Analysis::parse_csv("t.csv", &text).unwrap_err();
        let said = errors.to_string();
        assert_eq!(said.lines().next(), Some(first), "{said}");
        assert_eq!(errors.diagnostics().len(), 1, "{said}");
    }
}

#[test]
fn names_in_a_list_are_told_apart_by_a_semicolon_or_a_line_end() {
    let flags = |cell: &str| {
        let text = format!("{HEAD}\n{}\n", ROW.replace("scan late;", cell));
        let read = Analysis::parse_csv("t.csv", &text).unwrap();
        read.names(&read.modes()[0].flags).iter().map(|it| (*it).to_owned()).collect::<Vec<_>>()
    };
    for (cell, names) in [
        ("scan late;", vec!["scan late"]),
        ("scan; late", vec!["scan", "late"]),
        ("scan;late;", vec!["scan", "late"]),
        ("scan", vec!["scan"]),
        ("\"scan late\nframe late\"", vec!["scan late", "frame late"]),
        (" scan ; frame late ", vec!["scan", "frame late"]),
    ] {
        assert_eq!(flags(cell), names, "{cell}");
    }
}

/// Separators of names in one table stand within a name of another one.
#[test]
fn a_cell_that_could_be_one_name_or_several_is_refused_with_both_spellings() {
    let read = |cell: &str| {
        let text = format!("{HEAD}\n{}\n", ROW.replace("scan late;", &format!("\"{cell}\"")));
        Analysis::parse_csv("t.csv", &text)
    };
    let flags = |cell: &str| {
        let read = read(cell).unwrap_or_else(|errors| panic!("{cell}: {errors}"));
        read.names(&read.modes()[0].flags).iter().map(|it| (*it).to_owned()).collect::<Vec<_>>()
    };
    for (cell, one, apart) in [
        ("scan late", "scan late", &["scan", "late"][..]),
        ("scan, late", "scan, late", &["scan", "late"]),
        ("scan,late", "scan,late", &["scan", "late"]),
        ("scan late,", "scan late,", &["scan", "late"]),
        ("scan|late", "scan|late", &["scan", "late"]),
        ("scan + late", "scan + late", &["scan", "late"]),
        ("scan&late&stall", "scan&late&stall", &["scan", "late", "stall"]),
        ("scan、late", "scan、late", &["scan", "late"]),
        (" scan \t late ", "scan late", &["scan", "late"]),
    ] {
        let errors = read(cell).unwrap_err();
        assert_eq!(errors.diagnostics().len(), 1, "{errors}");
        let several = apart.join("; ");
        let message = format!("`{one}` is one name, or several");
        let help = format!("write `{one};` for one name, `{several}` for several");
        let found = &errors.diagnostics()[0];
        assert_eq!((&*found.message, found.help.as_deref()), (&*message, Some(&*help)));
        // Both spellings are read as they say, and so is what is written of them.
        assert_eq!(flags(&format!("{one};")), [one]);
        let mut sorted = apart.to_vec();
        sorted.sort_unstable();
        let mut found = flags(&several);
        found.sort_unstable();
        assert_eq!(found, sorted);
        for cell in [format!("{one};"), several] {
            let read = read(&cell).unwrap();
            let again = Analysis::parse_csv("t.csv", &read.to_csv()).unwrap();
            let names = |it: &Analysis| {
                it.names(&it.modes()[0].flags).iter().map(|it| (*it).to_owned()).collect::<Vec<_>>()
            };
            let sorted = |mut it: Vec<String>| {
                it.sort_unstable();
                it
            };
            assert_eq!(sorted(names(&again)), sorted(names(&read)), "{cell}");
        }
    }
    for cell in ["scan", "scan_late", "scan-late", "scan/late", "I/O", "slip>5%", "lost:2"] {
        assert_eq!(flags(cell), [cell]);
    }
}

#[test]
fn quotes_in_comma_separated_values_are_doubled() {
    let text = with(&[("cause = \"another device\"", "cause = 'a \"foreign\" device, late'")]);
    let csv = Analysis::parse("small.toml", &text).unwrap().to_csv();
    assert!(csv.contains(",\"a \"\"foreign\"\" device, late\","), "{csv}");
}
