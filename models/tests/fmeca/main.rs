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
    // Keys of TOML are columns too; lists stand between spaces or `;`; quotes, CRLF and an empty
    // last line are as spreadsheets write them.
    let text = "\u{feff}ID,function,component,failure mode,cause,effect,severity,mtbf_h,flags,\
        latency_ms\r\nA,\"to \"\"see\"\"\",\"a, b\",f,c,e,Hard,8,one two,5\r\n\
        B,see,a,f,c,e,weak,8,one two;,5\r\n,,,,,,,,,\r\n";
    let read = Analysis::parse_csv("table.csv", text).unwrap();
    let [a, b] = read.modes() else { panic!("{read:?}") };
    assert_eq!((a.function.as_str(), a.component.as_str()), ("to \"see\"", "a, b"));
    assert_eq!(read.names(&a.flags), ["one", "two"]);
    assert_eq!(read.names(&b.flags), ["one two"]);
}

#[test]
fn quotes_in_comma_separated_values_are_doubled() {
    let text = with(&[("cause = \"another device\"", "cause = 'a \"foreign\" device, late'")]);
    let csv = Analysis::parse("small.toml", &text).unwrap().to_csv();
    assert!(csv.contains(",\"a \"\"foreign\"\" device, late\","), "{csv}");
}
