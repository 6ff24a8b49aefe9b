//! Bad input: one clear message, exit code 2, nothing on standard output, nothing half-written.

use crate::common::{Folder, golden, patrol};

/// Runs a command that cannot work, and compares what it says with a golden file.
fn refused(folder: &Folder, name: &str, arguments: &[&str]) {
    let ended = folder.cotama(arguments);
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{name}: {ended:?}");
    assert!(!ended.stderr.contains("panicked"), "{name}: {}", ended.stderr);
    golden(&format!("bad_{name}.txt"), &ended.stderr);
    if ["export", "table"].contains(&arguments[0]) {
        return;
    }
    // The same is said to a program.
    let ended = folder.cotama(&[arguments, &["--json"]].concat());
    let error = ended.json(2);
    assert_eq!((&error["schema"], ended.stderr.as_str()), (&"cotama/error/1".into(), ""), "{name}");
}

#[test]
fn missions_that_cannot_be_read() {
    let folder = Folder::new("bad_missions");
    refused(&folder, "unknown_mission", &["plan", "patroll"]);
    refused(&folder, "unknown_far", &["run", "moon-landing"]);
    refused(&folder, "missing_file", &["plan", "missions/patrol.toml"]);
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    refused(&folder, "directory", &["plan", "folder"]);
    folder.write("garbage.toml", [b"format = \"".as_slice(), &[0xff, 0xfe, 0x00]].concat());
    refused(&folder, "binary", &["plan", "garbage.toml"]);
    folder.write("empty.toml", "");
    refused(&folder, "empty", &["plan", "empty.toml"]);
    let errors = [
        ("path_length_mm = 187000", "path_lenght_mm = 187000"),
        ("task = \"MOV\"", "task = \"MOVE\""),
        ("units = 2 ", "units = \"two\" "),
    ];
    folder.write("errors.toml", patrol(&errors));
    refused(&folder, "mission_errors", &["plan", "errors.toml"]);
    folder.write("quote.toml", "name = \"\u{1b}[31mred\u{7}\"\nformat = \"\u{202e}x\"\n");
    let ended = folder.cotama(&["plan", "quote.toml"]);
    assert!(ended.code == Some(2) && !ended.stderr.contains('\u{1b}'), "{}", ended.stderr);
}

#[test]
fn no_more_of_a_file_is_read_than_its_limit() {
    let folder = Folder::new("bad_large");
    let file = std::fs::File::create(folder.path().join("large")).unwrap();
    file.set_len(1 << 30).unwrap();
    refused(&folder, "large_mission", &["plan", "large"]);
    refused(&folder, "large_instance", &["allocate", "large"]);
    refused(&folder, "large_trace", &["replay", "large"]);
    std::fs::remove_file(folder.path().join("large")).unwrap();
    if std::path::Path::new("/dev/zero").exists() {
        refused(&folder, "endless", &["plan", "/dev/zero"]);
    }
}

#[test]
fn flags_that_make_no_sense() {
    let folder = Folder::new("bad_flags");
    refused(&folder, "lost_unknown", &["plan", "patrol", "--lost", "radar"]);
    refused(&folder, "lost_many", &["run", "patrol", "--lost", "laser:3"]);
    refused(&folder, "lost_supervised", &["run", "delivery", "--lost", "SMZ"]);
    refused(
        &folder,
        "limit_large",
        &["plan", "patrol", "--duration-limit", "18446744073709551615"],
    );
    for arguments in [
        &["plan"][..],
        &["plan", "patrol", "--objective", "speed"],
        &["run", "patrol", "--objective", "front"],
        &["run", "patrol", "--monitor-period", "0"],
        &["run", "patrol", "--fidelity", "sensor"],
        &["plan", "patrol", "--lost", "laser:x"],
        &["plan", "patrol", "--energy-limit", "-1"],
        &["plan", "patrol", "--steps", "0"],
        &["fly", "patrol"],
        &[],
    ] {
        let ended = folder.cotama(arguments);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{arguments:?}: {ended:?}");
    }
}

#[test]
fn faults_that_do_not_fit() {
    let folder = Folder::new("bad_faults");
    refused(&folder, "faults_missing", &["run", "patrol", "--faults", "faults.toml"]);
    folder.write(
        "other.toml",
        "format = \"panorama-faults/1\"\n[[event]]\nx_mm = 1\nkind = \
        \"fault\"\nhardware = \"radar\"\nunits_lost = 1\n",
    );
    refused(&folder, "faults_hardware", &["run", "patrol", "--faults", "other.toml"]);
    refused(&folder, "faults_no_mission", &["replay", "other.toml"]);
    assert_eq!(folder.files(""), ["other.toml"]);
}

#[test]
fn instances_that_are_none() {
    let folder = Folder::new("bad_instances");
    let limits = "\"limits\": {\"duration_ms\": 9, \"energy_mj\": 9}";
    let cases = [
        ("instance_syntax", "{\"limits\": {\"duration_ms\": 9,,}".to_owned()),
        ("instance_no_limits", "{\"activities\": []}".to_owned()),
        ("instance_empty_activity", format!("{{{limits},\n \"activities\": [[[1,2,3]], []]}}")),
        ("instance_negative", format!("{{{limits},\n \"activities\": [[[1,-2,3]]]}}")),
        ("instance_fraction", format!("{{{limits},\n \"activities\": [[[1,2.5,3]]]}}")),
        ("instance_wide", format!("{{{limits},\n \"activities\": [[[1,2,4294967296]]]}}")),
        ("instance_pair", format!("{{{limits},\n \"activities\": [[[1,2]]]}}")),
        ("instance_four", format!("{{{limits},\n \"activities\": [[[1,2,3,4]]]}}")),
        ("instance_trailing", format!("{{{limits},\n \"activities\": []}} x")),
        (
            "instance_many",
            format!("{{{limits},\n \"activities\": [{}]}}", vec!["[[1,1,1]]"; 65_536].join(",")),
        ),
        ("instance_deep", format!("{{\"x\": {}", "[".repeat(100_000))),
    ];
    for (name, text) in cases {
        folder.write("instance.json", text);
        refused(&folder, name, &["allocate", "instance.json"]);
    }
}

#[test]
fn traces_that_are_none() {
    let folder = Folder::new("bad_traces");
    assert_eq!(
        folder.cotama(&["run", "patrol", "--no-report", "--trace", "t.jsonl"]).code,
        Some(0)
    );
    let trace = folder.read("t.jsonl");
    let lines: Vec<_> = trace.lines().collect();
    folder.write("cut.jsonl", lines[..9].join("\n") + "\n");
    refused(&folder, "trace_cut", &["replay", "cut.jsonl"]);
    folder.write("half.jsonl", lines[..9].join("\n") + &lines[9][..20]);
    refused(&folder, "trace_half", &["replay", "half.jsonl"]);
    folder.write("headless.jsonl", lines[1..].join("\n"));
    refused(&folder, "trace_headless", &["replay", "headless.jsonl"]);
    folder.write("mission.jsonl", trace.replacen("path_length_mm = ", "path_lenght_mm = ", 1));
    let ended = folder.cotama(&["replay", "mission.jsonl"]);
    assert!(ended.code == Some(2) && ended.stderr.contains("path_lenght_mm"), "{ended:?}");
    refused(&folder, "trace_missing", &["replay", "none.jsonl"]);
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::new("bad_outputs");
    folder.write("file", "kept");
    refused(&folder, "report_in_file", &["run", "patrol", "--report", "file"]);
    std::fs::create_dir_all(folder.path().join("there/index.html")).unwrap();
    refused(&folder, "report_is_folder", &["run", "patrol", "--report", "there"]);
    refused(&folder, "trace_in_file", &["run", "patrol", "--no-report", "--trace", "file/t.jsonl"]);
    assert_eq!(folder.read("file"), "kept");
    assert_eq!(folder.files(""), ["file", "there"]);
    if std::path::Path::new("/dev/full").exists() {
        let ended = folder.shell("cotama plan patrol > /dev/full");
        assert_eq!(ended.code, Some(2));
        golden("bad_stdout_full.txt", &ended.stderr);
    }
}

const PLACE: &str = "<place id=\"p\"><initialMarking><text>1</text></initialMarking></place>";

fn pnml(inside: &str) -> String {
    let kind = "http://www.pnml.org/version-2009/grammar/ptnet";
    format!(
        "<pnml>\n <net id=\"n\" type=\"{kind}\">\n  <page id=\"g\">\n{inside}\n  </page>\n </net>\n\
         </pnml>\n"
    )
}

#[test]
fn models_that_cannot_be_read() {
    let folder = Folder::new("bad_models");
    refused(&folder, "model_unknown", &["models", "dor"]);
    refused(&folder, "model_family", &["export", "philosophers", "--format", "dot"]);
    refused(&folder, "model_number", &["export", "philosophers:1", "--format", "dot"]);
    refused(&folder, "model_no_family", &["simulate", "door:5"]);
    refused(&folder, "model_missing", &["simulate", "nets/door.pnml"]);
    let cases = [
        ("empty", String::new()),
        ("closed", pnml("   <place id=\"p\">\n   </plaice>")),
        ("twice", pnml(&format!("   {PLACE}\n   <transition id=\"t\"/>\n   {PLACE}"))),
        ("arc", pnml(&format!("   {PLACE}\n   <arc id=\"a\" source=\"p\" target=\"q\"/>"))),
        (
            "inhibitor",
            pnml(&format!(
                "   {PLACE}<transition id=\"t\"/>\n   <arc id=\"a\" source=\"p\" target=\"t\">\
                 <type value=\"inhibitor\"/></arc>"
            )),
        ),
        (
            "kind",
            pnml(&format!(
                "   {PLACE}<transition id=\"t\"/>\n   <arc id=\"a\" source=\"p\" target=\"t\">\
                 <type value=\"flush\"/></arc>"
            )),
        ),
        ("tokens", pnml(&PLACE.replace(">1<", ">many<"))),
        ("far", pnml(&format!("   {PLACE}\n{}\n   {PLACE}", " \n".repeat(20_000)))),
        ("one_line", format!("{}<net id=\"x\">", pnml(PLACE).replace('\n', &" ".repeat(9_000)))),
    ];
    for (name, text) in cases {
        folder.write("net.pnml", text);
        refused(&folder, &format!("pnml_{name}"), &["models", "net.pnml"]);
    }
    let net = folder.cotama(&["export", "door", "--format", "json"]).stdout;
    let cases = [
        ("syntax", net.replacen("\"initial\": 1,", "\"initial\": 1,,", 1)),
        ("kind", net.replacen("\"initial\": 1,", "\"initial\": \"one\",", 1)),
        ("name", net.replacen("\"place\": \"Closed\"", "\"place\": \"Closd\"", 1)),
    ];
    for (name, text) in cases {
        folder.write("net.json", text);
        refused(&folder, &format!("json_{name}"), &["export", "net.json", "--format", "dot"]);
    }
}

#[test]
fn models_that_cannot_be_written_so() {
    let folder = Folder::new("bad_exports");
    refused(&folder, "export_chart", &["export", "crossing", "--format", "scxml"]);
    refused(&folder, "export_no_format", &["export", "door"]);
    refused(&folder, "export_end", &["export", "door", "--output", "door.txt"]);
    refused(&folder, "export_style", &["export", "door", "--format", "pnml", "--style", "net"]);
    refused(&folder, "export_matrix", &["export", "philosophers:10000", "--format", "matrix"]);
    refused(&folder, "export_folder", &["export", "door", "--format", "svg", "--output", "."]);
    assert_eq!(folder.files(""), [""; 0]);
}

#[test]
fn words_that_a_net_does_not_know() {
    let folder = Folder::new("bad_words");
    refused(&folder, "event_unknown", &["simulate", "door", "Call", "EndOpn"]);
    refused(&folder, "event_by_name", &["simulate", "philosophers:2", "end"]);
    refused(&folder, "event_no_round", &["simulate", "door", "Call,Clear"]);
    refused(&folder, "event_back_in_time", &["simulate", "door", "Call@500", "EndOpen@499"]);
    refused(&folder, "event_no_time", &["simulate", "door", "+1.5"]);
    refused(&folder, "simulate_large", &["simulate", "philosophers:5000"]);
    folder.write("net.pnml", pnml(&PLACE.replace(">1<", ">65536<")));
    refused(&folder, "simulate_tokens", &["simulate", "net.pnml"]);
    let ended = folder.shell("cotama export door --format pnml | cotama simulate - --interactive");
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
}
