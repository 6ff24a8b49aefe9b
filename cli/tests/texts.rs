//! Every text that the program reads comes in by one way: a byte order mark, line ends of Windows
//! and a missing last line end change nothing; another encoding and bytes that are no text are
//! refused, with what to do.

use crate::common::{Folder, patrol};
use serde_json::Value;

/// A reader: what it is called, its file, a comment of its language if it has any, and a command.
struct Reader {
    name: &'static str,
    file: &'static str,
    text: Vec<u8>,
    comment: Option<&'static str>,
    line: &'static str,
    /// The exit code for a right file.
    code: i32,
    /// A reader of XML, which knows encodings itself.
    is_xml: bool,
}

const LAMP: &str = "net lamp\ntr on off -> lit\ntr out lit -> off\npl off (1)\n";
const EVENTS: &str = "Call\nEndOpen\n";
const RECORDING: &str = "{\"t_ms\":0,\"event\":\"Call\"}\n{\"t_ms\":0,\"fired\":\"call\"}\n";
const INSTANCE: &str = "{\"limits\": {\"duration_ms\": 9, \"energy_mj\": 9},\n \
    \"activities\": [[[1, 2, 3]]]}\n";
const TEAM: &str = "{\"format\": \"cotama-team-assignment/1\", \"name\": \"t\",\n \
    \"kind\": \"single\", \"cost_denominator\": 1, \"robots\": [\"a\"],\n \
    \"tasks\": [{\"name\": \"mop\", \"skip_cost\": null, \"cost\": [3]}]}\n";
const CSV: &str = "id,function,component,failure,cause,effect,severity,mtbf_h\n\
    A,see,lidar,stands,worn,blind,hard,8000\n";
const PROPERTIES: &str = "shut: AG !(Closing & Open)\nEF Open\n";
const CONTEST: &str = "<property-set>\n<property><id>a</id><formula><exists-path><finally>\
    <deadlock/>\n</finally></exists-path></formula></property></property-set>\n";

fn readers(folder: &Folder) -> Vec<Reader> {
    let made = |line: &str, file: &str| {
        let ended = folder.shell(line);
        assert_eq!(ended.code, Some(0), "{line}: {ended:?}");
        folder.read(file).into_bytes()
    };
    let net = made("cotama export door --output made.json", "made.json");
    let pnml = made("cotama export door --output made.pnml", "made.pnml");
    let ask = "cotama check kanban:2 --property deadlock_free --certificate made.cert";
    let certificate = made(ask, "made.cert");
    let trace = made("cotama run patrol --no-report --trace made.jsonl", "made.jsonl");
    let analysis = made("cotama new fmeca made", "made.toml");
    for file in ["made.json", "made.pnml", "made.cert", "made.jsonl", "made.toml"] {
        std::fs::remove_file(folder.path().join(file)).unwrap();
    }
    let reader = |name, file, text: &[u8], comment, line| Reader {
        name,
        file,
        text: text.to_vec(),
        comment,
        line,
        code: 0,
        is_xml: false,
    };
    let (hash, none) = (Some("# it\n"), None);
    let xml = |reader| Reader { is_xml: true, ..reader };
    let mission = patrol(&[]);
    let faults = "format = 'panorama-faults/1'\n";
    vec![
        reader("a net in JSON", "net.json", &net, none, "models net.json"),
        reader("a net of TINA", "lamp.net", LAMP.as_bytes(), hash, "models lamp.net"),
        reader("a net of any name", "lamp", LAMP.as_bytes(), hash, "check lamp"),
        xml(reader("PNML", "door.pnml", &pnml, none, "models door.pnml")),
        reader("a certificate", "it.json", &certificate, none, "verify it.json"),
        reader("properties", "p.txt", PROPERTIES.as_bytes(), hash, "check door --properties p.txt"),
        Reader {
            code: 1,
            ..xml(reader(
                "contest",
                "p.xml",
                CONTEST.as_bytes(),
                none,
                "check door --properties p.xml",
            ))
        },
        reader("events", "events", EVENTS.as_bytes(), none, "simulate door < events"),
        reader("a trace", "t.jsonl", &trace, none, "replay t.jsonl"),
        reader("a recording", "r.jsonl", RECORDING.as_bytes(), none, "conform door r.jsonl"),
        reader("an instance", "i.json", INSTANCE.as_bytes(), none, "allocate i.json"),
        reader("a team", "team.json", TEAM.as_bytes(), none, "assign team.json"),
        reader("a mission", "m.toml", mission.as_bytes(), hash, "plan m.toml"),
        reader(
            "faults",
            "f.toml",
            faults.as_bytes(),
            hash,
            "run patrol --no-report --faults f.toml",
        ),
        reader("an FMECA in CSV", "a.csv", CSV.as_bytes(), none, "fmeca a.csv"),
        reader("an FMECA in TOML", "a.toml", &analysis, hash, "fmeca a.toml"),
    ]
}

/// The text in UTF-16, the lower byte first, behind a byte order mark.
fn wide(text: &[u8]) -> Vec<u8> {
    let text = String::from_utf8(text.to_vec()).unwrap();
    let units = std::iter::once(0xfeff).chain(text.encode_utf16());
    units.flat_map(u16::to_le_bytes).collect()
}

/// The answer without the time that it took.
fn timeless(text: &str) -> String {
    let numbers = |line: &str| line.contains("seconds") || line.contains(" s, ");
    text.lines().filter(|it| !numbers(it)).map(|it| it.to_owned() + "\n").collect()
}

#[test]
fn each_reader_takes_each_form_of_a_text_or_says_what_to_do() {
    const MARK: &[u8] = b"\xef\xbb\xbf";
    let folder = Folder::new("texts");
    let mut seen = 0;
    for it in readers(&folder) {
        let run = |bytes: &[u8]| {
            folder.write(it.file, bytes);
            folder.shell(&format!("cotama {}", it.line))
        };
        let plain = run(&it.text);
        assert_eq!(plain.code, Some(it.code), "{}: {plain:?}", it.name);
        let windows = String::from_utf8(it.text.clone()).unwrap().replace('\n', "\r\n");
        let short = String::from_utf8(it.text.clone()).unwrap();
        let mut forms = vec![
            ("a byte order mark", [MARK, &it.text].concat()),
            ("line ends of Windows", windows.into_bytes()),
            ("no last line end", short.trim_end().as_bytes().to_vec()),
        ];
        if let Some(comment) = it.comment {
            forms.push(("a mark and a comment", [MARK, comment.as_bytes(), &it.text].concat()));
        }
        for (form, bytes) in forms {
            let ended = run(&bytes);
            assert_eq!(ended.code, Some(it.code), "{} with {form}: {ended:?}", it.name);
            assert_eq!(timeless(&ended.stdout), timeless(&plain.stdout), "{} with {form}", it.name);
            seen += 1;
        }
        let wide = run(&wide(&it.text));
        if it.is_xml && it.name == "PNML" {
            assert_eq!(wide.code, Some(it.code), "{}: {wide:?}", it.name);
        } else {
            assert_eq!(wide.code, Some(2), "{}: {wide:?}", it.name);
            let says = wide.stderr.contains("UTF-16") && wide.stderr.contains("save it as UTF-8");
            assert!(says, "{}: {}", it.name, wide.stderr);
        }
        let nul = run(&[it.text.as_slice(), b"\0\0\0"].concat());
        assert_eq!(nul.code, Some(2), "{}: {nul:?}", it.name);
        let latin = run(&[it.text.as_slice(), b"\xe9"].concat());
        assert_eq!(latin.code, Some(2), "{}: {latin:?}", it.name);
        if !it.is_xml {
            assert!(nul.stderr.contains("a NUL, the byte 0x00"), "{}: {}", it.name, nul.stderr);
            assert!(nul.stderr.contains("loss of power"), "{}: {}", it.name, nul.stderr);
            assert!(latin.stderr.contains("the byte 0xe9 is not UTF-8"), "{}", latin.stderr);
            assert!(latin.stderr.contains("-->"), "{}: without a place", it.name);
        }
    }
    assert_eq!(seen, 54);
}

#[test]
fn a_place_in_a_text_with_a_mark_is_counted_without_it() {
    let folder = Folder::new("texts_mark");
    for (file, text, line, place) in [
        ("r.jsonl", "{\"t_ms\":0,\"event\":\"Cal\"}\n", "conform door r.jsonl", "1:19"),
        ("net.net", "tr a b - c\n", "check net.net", "1:8"),
        ("i.json", "{\"limits\": 3}", "allocate i.json", "1:12"),
        ("p.txt", "AG (Opn)\n", "check door --properties p.txt", "1:5"),
        ("m.toml", "formt = 'x'\n", "plan m.toml", "1:1"),
    ] {
        for mark in ["", "\u{feff}"] {
            folder.write(file, format!("{mark}{text}"));
            let said = folder.shell(&format!("cotama {line}")).stderr;
            assert!(said.contains(&format!("{file}:{place}")), "{file} {mark:?}: {said}");
        }
    }
}

#[test]
fn a_byte_that_is_no_text_has_a_line_and_a_column() {
    let folder = Folder::new("texts_place");
    folder.write("m.toml", b"format = \"panorama-mission/1\"\nname = \"caf\xe9\"\n");
    let error = folder.cotama(&["plan", "m.toml", "--json"]).json(2);
    assert_eq!((&error["line"], &error["column"]), (&2.into(), &12.into()), "{error}");
    let help = error["help"].as_str().unwrap();
    assert!(help.contains("Latin-1"), "{help}");
    // A log that a loss of power ended: the last block of the file is not written.
    folder.write("r.jsonl", [RECORDING.as_bytes(), &[0; 40]].concat());
    let error = folder.cotama(&["conform", "door", "r.jsonl", "--json"]).json(2);
    assert_eq!(error["line"], Value::from(3));
    assert!(error["help"].as_str().unwrap().contains("remove them"), "{error}");
}

#[test]
fn files_of_other_tools_are_named_with_the_way_out() {
    let folder = Folder::new("texts_foreign");
    let tapn = "<?xml version=\"1.0\"?>\n<pnml xmlns=\"http://www.informatik.hu-berlin.de/top/\
        pnml/ptNetb\">\n<net active=\"true\" id=\"N\" type=\"P/T net\">\n<place id=\"P\" \
        initialMarking=\"0\" invariant=\"&lt; inf\" name=\"P\"/></net>\
        <k-bound bound=\"3\"/></pnml>";
    for (file, text, line, is) in [
        ("a.tapn", tapn, "check a.tapn", "a file of TAPAAL's editor (.tapn)"),
        (
            "log.xes",
            "<log xes.version=\"2.0\"></log>",
            "conform door log.xes",
            "an event log (XES)",
        ),
        ("g.net", "|0|\n|\nf   0   1   0   1   0   0   0\n", "check g.net", "a net of GreatSPN"),
        ("g.PNPRO", "<project version=\"121\">", "check g.PNPRO", "a project of GreatSPN"),
        ("m.jani", "{\"jani-version\": 1}", "check m.jani", "a model in JANI"),
        ("m.json", "{\"jani-version\": 1}", "check m.json", "a model in JANI"),
        ("s.scxml", "<scxml version=\"1.0\"/>", "simulate s.scxml", "a state machine (SCXML)"),
        ("t.xml", "<root BTCPP_format=\"4\"/>", "verify t.xml", "a behaviour tree"),
        ("m.yaml", "limits:\n  energy: 3\n", "plan m.yaml", "YAML, it seems"),
        ("m.yml", "---\na: 1\n", "run m.yml", "YAML, it seems"),
        ("m.json", "{\"limits\": 3}", "plan m.json", "JSON"),
        ("b.bag", "#ROSBAG V2.0\n", "conform door b.bag", "a recording of ROS (bag)"),
        ("b.mcap", "\u{89}MCAP0", "conform door b.mcap", "not UTF-8"),
        ("n.dot", "digraph n { a -> b }", "check n.dot", "a graph for Graphviz (DOT)"),
        ("n.prism", "mdp\nmodule a\nendmodule", "check n.prism", "a model of PRISM"),
        ("p.svg", "<svg xmlns=\"x\"/>", "fmeca p.svg.csv", "a picture (SVG)"),
        ("n.gz", "\u{1f}\u{8b}", "check n.gz", ""),
    ] {
        if is == "not UTF-8" || is.is_empty() {
            continue; // as bytes below
        }
        let file = if line.ends_with("p.svg.csv") { "p.svg.csv" } else { file };
        folder.write(file, text);
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{file}: {ended:?}");
        assert!(ended.stderr.contains(&format!("this is {is}")), "{file}: {}", ended.stderr);
        assert!(ended.stderr.contains("help: "), "{file}: {}", ended.stderr);
        assert!(ended.stderr.lines().count() <= 5, "{file}: {}", ended.stderr);
    }
    for (file, bytes, line, is) in [
        ("b.mcap", b"\x89MCAP0\r\n\x01".as_slice(), "conform door b.mcap", "(MCAP)"),
        ("b.db3", b"SQLite format 3\0", "conform door b.db3", "(SQLite)"),
        ("n.gz", b"\x1f\x8b\x08\0", "check n.gz", "(gzip)"),
        ("n.zip", b"PK\x03\x04\x14\0", "check n.zip", "(ZIP)"),
        ("a.csv", b"PK\x03\x04\x14\0", "fmeca a.csv", "a spreadsheet (XLSX"),
        ("n.jpg", b"\xff\xd8\xff\xe0", "check n.jpg", "a picture (JPEG)"),
        ("n.elf", b"\x7fELF\x02", "verify n.elf", "a program (ELF)"),
        ("l.ulg", b"ULog\x01\x12\x35", "conform door l.ulg", "a flight log"),
    ] {
        folder.write(file, bytes);
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{file}: {ended:?}");
        assert!(ended.stderr.contains(is), "{file}: {}", ended.stderr);
        assert!(ended.stderr.lines().count() <= 5, "{file}: {}", ended.stderr);
    }
}

#[test]
fn json_is_refused_in_words_of_users() {
    let folder = Folder::new("texts_json");
    let limits = "\"limits\": {\"duration_ms\": 9, \"energy_mj\": 9}";
    let team = |cost: &str| TEAM.replace("[3]", cost);
    for (file, text, line, says) in [
        ("r.jsonl", "[{\"t_ms\":0}]".to_owned(), "conform door r.jsonl", "one object a line"),
        ("r.jsonl", "{\n\"t_ms\":0}\n".to_owned(), "conform door r.jsonl", "one object a line"),
        ("r.jsonl", RECORDING.replace("0,\"f", "0.5,\"f"), "conform door r.jsonl", "not 0.5"),
        ("r.jsonl", format!("{RECORDING}{{\"t_ms\":5,\"ev"), "conform door r.jsonl", "is cut off"),
        ("r.jsonl", "t_ms,event\n0,Call\n".to_owned(), "conform door r.jsonl", "a line is {"),
        ("i.json", "[1, 2]".to_owned(), "allocate i.json", "a list stands where an object"),
        ("i.json", String::new(), "allocate i.json", "this is empty"),
        (
            "i.json",
            format!("{{{limits}, \"activities\": [[[1, NaN, 3]]]}}"),
            "allocate i.json",
            "`null`",
        ),
        (
            "i.json",
            format!("{{{limits}, \"activities\": [[[1, 2.5, 3]]]}}"),
            "allocate i.json",
            "same factor",
        ),
        (
            "i.json",
            format!("{{{limits}, \"activities\": {{}}}}"),
            "allocate i.json",
            "not an object",
        ),
        ("i.json", format!("{{{limits}, \"activities\": [[[1, 2"), "allocate i.json", "cut off"),
        ("t.json", team("[NaN]"), "assign t.json", "`null` where a robot is not capable"),
        ("t.json", team("[-Infinity]"), "assign t.json", "`null` where a robot is not capable"),
        ("t.json", team("[0.4]"), "assign t.json", "multiply all by the same factor"),
        ("n.json", String::new(), "check n.json", "this is empty"),
        ("n.json", "[]".to_owned(), "check n.json", "a list stands where an object"),
        ("n.json", "{\"schema\": \"cotama/net/1\", \"nam".to_owned(), "check n.json", "cut off"),
        (
            "n.json",
            "{\"schema\": \"cotama/net/1\", \"a\": 1}".to_owned(),
            "check n.json",
            "unknown key",
        ),
        (
            "c.json",
            "{\"schema\": \"cotama-certificate/1\"}".to_owned(),
            "verify c.json",
            "is missing",
        ),
        (
            "t.jsonl",
            "{\"schema\": \"cotama-trace/1\", \"ver".to_owned(),
            "replay t.jsonl",
            "cut off",
        ),
    ] {
        folder.write(file, &text);
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{text}: {ended:?}");
        assert!(ended.stderr.contains(says), "{text}: {}", ended.stderr);
        for word in ["u64", "u32", "i16", "EOF", "invalid type", "expected value", "struct", "map,"]
        {
            assert!(!ended.stderr.contains(word), "{word} in {}", ended.stderr);
        }
    }
    // A whole number that is too large is no fraction.
    for (number, says) in [
        ("99999999999999999999999", "from 0 to 4294967295 is needed here, not 1e23"),
        ("1e23", "from 0 to 4294967295 is needed here, not 1e23"),
        ("-1e300", "from 0 to 4294967295 is needed here, not -1e300"),
        ("4294967296", "from 0 to 4294967295 is needed here, not 4294967296"),
        ("4294967296.0", "from 0 to 4294967295 is needed here, not 4294967296"),
        ("1e16", "from 0 to 4294967295 is needed here, not 1e16"),
    ] {
        folder.write("i.json", format!("{{{limits}, \"activities\": [[[1, {number}, 3]]]}}"));
        let said = folder.cotama(&["allocate", "i.json"]).stderr;
        assert!(said.contains(&format!("a whole number {says}")), "{number}: {said}");
        assert!(!said.contains("same factor"), "{number}: {said}");
    }
    folder.write("i.json", INSTANCE.replace(": 9}", ": 1e16}"));
    let said = folder.cotama(&["allocate", "i.json"]).stderr;
    assert!(said.contains("a whole number with all its digits is needed here, not 1e16"), "{said}");
    // Whole numbers, however they are written.
    for (file, text, line, code) in [
        ("r.jsonl", RECORDING.replace(":0,", ":0.0,"), "conform door r.jsonl", 0),
        (
            "i.json",
            format!("{{{limits}, \"activities\": [[[1.0, 2e0, 3.0]]]}}"),
            "allocate i.json",
            0,
        ),
        ("i.json", INSTANCE.replace(": 9,", ": 9.0,"), "allocate i.json", 0),
        ("t.json", team("[3.0]"), "assign t.json", 0),
        ("t.json", team("[3e0]"), "assign t.json", 0),
    ] {
        folder.write(file, &text);
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(code), "{text}: {ended:?}");
    }
    let net = folder.cotama(&["export", "door", "--format", "json"]).stdout;
    folder.write("n.json", net.replace("\"initial\": 1,", "\"initial\": 1.0,"));
    assert_eq!(folder.cotama(&["models", "n.json"]).code, Some(0));
}
