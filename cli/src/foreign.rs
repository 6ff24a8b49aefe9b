//! Files of other tools, as far as their beginning tells: so that one is named, with the way out,
//! and is not an error in every line.

/// A file of another tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Foreign {
    /// A few words for it.
    pub(crate) is: &'static str,
    /// The way out.
    pub(crate) out: &'static str,
}

const TAPAAL: Foreign = Foreign {
    is: "a file of TAPAAL's editor (.tapn)",
    out: "in TAPAAL: File, Export, PNML; and its queries by Export, XML Queries",
};
const UNPACK: &str = "unpack it first";
const BAG: &str = "write one line of JSON an event: {\"t_ms\":0,\"event\":\"Call\"}; `cotama help \
    conform` shows such a log";
const PICTURE: &str = "a picture holds no data that is read here";
const CSV: &str = "save the sheet as CSV in UTF-8";

/// Bytes that a file begins with, what it is, and the way out.
const BYTES: [(&[u8], &str, &str); 24] = [
    (b"\x89PNG", "a picture (PNG)", PICTURE),
    (b"\xff\xd8\xff", "a picture (JPEG)", PICTURE),
    (b"GIF8", "a picture (GIF)", PICTURE),
    (b"RIFF", "a picture or a sound (RIFF)", PICTURE),
    (b"II*\0", "a picture (TIFF)", PICTURE),
    (b"%PDF", "a page (PDF)", "a page holds no data that is read here"),
    (
        b"PK\x03\x04",
        "an archive (ZIP), or a spreadsheet (XLSX, ODS)",
        "unpack it, or save the \
        sheet as CSV in UTF-8",
    ),
    (b"\x1f\x8b", "an archive (gzip)", UNPACK),
    (b"BZh", "an archive (bzip2)", UNPACK),
    (b"\xfd7zXZ", "an archive (xz)", UNPACK),
    (b"\x28\xb5\x2f\xfd", "an archive (zstd)", UNPACK),
    (b"7z\xbc\xaf", "an archive (7z)", UNPACK),
    (b"\xd0\xcf\x11\xe0", "a document of an old office program (XLS, DOC)", CSV),
    (b"\x7fELF", "a program (ELF)", "give the file that the program reads"),
    (b"MZ\x90", "a program (EXE)", "give the file that the program reads"),
    (b"\0asm", "a program (WebAssembly)", "give the file that the program reads"),
    (b"\x89MCAP", "a recording of robots (MCAP)", BAG),
    (b"#ROSBAG", "a recording of ROS (bag)", BAG),
    (b"SQLite format 3", "a data base (SQLite), as rosbag2 writes", BAG),
    (b"ULog\x01", "a flight log (ULog)", BAG),
    (b"PAR1", "a table of columns (Parquet)", "save it as JSON or CSV"),
    (b"ARROW1", "a table of columns (Arrow)", "save it as JSON or CSV"),
    (b"\x93NUMPY", "an array (NumPy)", "save it as JSON"),
    (b"\x80\x04\x95", "an object of Python (pickle)", "save it as JSON"),
];

const PNML: &str = "its editor exports PNML, which is read";
const STORED: &str = "`cotama` writes this format and does not read it; give the net it came from, \
    as PNML, JSON or TINA's .net";

/// The first element of an XML file, what it is, and the way out.
const ELEMENTS: [(&str, &str, &str); 23] = [
    ("log", "an event log (XES)", BAG),
    ("project", "a project of GreatSPN (.PNPRO)", "in GreatSPN's editor: export the net as PNML"),
    ("scxml", "a state machine (SCXML)", STORED),
    ("nta", "timed automata of UPPAAL", "give a time net as TINA's .net"),
    (
        "workspaceElements",
        "a coloured net of CPN Tools",
        "unfold it into a net without colours, \
        as PNML",
    ),
    ("definitions", "a process (BPMN)", "turn it into a net in PNML, as pm4py and ProM do"),
    ("Snoopy", "a net of Snoopy", PNML),
    ("apnn", "a net in APNN", PNML),
    ("YAWL", "a workflow of YAWL", "turn it into a net in PNML, as ProM does"),
    ("specificationSet", "a workflow of YAWL", "turn it into a net in PNML, as ProM does"),
    ("TDNetViewer", "a net of Visual Object Net", PNML),
    ("sbml", "a biochemical model (SBML)", "turn it into a net in PNML"),
    ("ptml", "a process tree (PTML)", "turn it into a net in PNML, as pm4py does"),
    ("graphml", "a graph (GraphML)", "give a net in PNML, JSON or TINA's .net"),
    ("gexf", "a graph (GEXF)", "give a net in PNML, JSON or TINA's .net"),
    ("mxfile", "a drawing (draw.io)", PICTURE),
    ("svg", "a picture (SVG)", PICTURE),
    ("html", "a page (HTML)", "a page holds no data that is read here"),
    (
        "robot",
        "a robot (URDF)",
        "a robot stands in a mission file, in TOML: `cotama new mission \
        NAME` begins one",
    ),
    ("sdf", "a world of Gazebo (SDF)", "`cotama new mission NAME` begins a mission"),
    ("launch", "a launch file of ROS", "`cotama new mission NAME` begins a mission"),
    ("testsuites", "a report of tests (JUnit)", "give what was checked, not what was found"),
    ("feed", "a feed (Atom)", "a feed holds no data that is read here"),
];

/// The file of another tool that begins with these bytes, if it is one.
pub(crate) fn of_bytes(bytes: &[u8]) -> Option<Foreign> {
    let known = BYTES.iter().find(|it| bytes.starts_with(it.0)).map(|it| (it.1, it.2));
    let tar = bytes.get(257..262) == Some(b"ustar");
    known.or(tar.then_some(("an archive (tar)", UNPACK))).map(|(is, out)| Foreign { is, out })
}

/// The file of another tool that begins with this text, which has no white space in front.
pub(crate) fn of_text(start: &str) -> Option<Foreign> {
    if start.starts_with('<') {
        return of_markup(start);
    }
    if start.starts_with(['{', '[']) {
        return of_json(start);
    }
    of_words(start)
}

fn of_markup(start: &str) -> Option<Foreign> {
    let root = root(start)?;
    if root == "pnml" {
        let signs = ["<k-bound ", "<shared-place ", "<shared-transition ", "<feature isGame"];
        let is_edited = start.contains(" markingOffsetX=\"")
            || start.contains("<place ") && start.contains(" invariant=\"&lt;");
        let is_tapn = is_edited || signs.iter().any(|it| start.contains(it));
        return is_tapn.then_some(TAPAAL);
    }
    let found = ELEMENTS.iter().find(|it| it.0 == root)?;
    Some(Foreign { is: found.1, out: found.2 })
}

/// The name of the first element, without its prefix.
pub(crate) fn root(start: &str) -> Option<&str> {
    let mut rest = start;
    loop {
        rest = rest.split_once('<')?.1;
        if let Some(comment) = rest.strip_prefix("!--") {
            rest = comment.split_once("-->")?.1;
        } else if !rest.starts_with(['?', '!']) {
            break;
        }
    }
    let name = rest.split(|c: char| c.is_whitespace() || c == '>' || c == '/').next()?;
    Some(name.split_once(':').map_or(name, |it| it.1))
}

fn of_json(start: &str) -> Option<Foreign> {
    let has = |key: &str| start.contains(key);
    let (is, out) = if has("\"jani-version\"") {
        ("a model in JANI", STORED)
    } else if has("\"nbformat\"") {
        ("a notebook (Jupyter)", "write the data of its cells into a file")
    } else if has("\"$schema\"") && has("sarif") {
        ("a report of checks (SARIF)", "give what was checked, not what was found")
    } else if has("\"ocel:") {
        ("an event log (OCEL)", BAG)
    } else {
        return None;
    };
    Some(Foreign { is, out })
}

fn of_words(start: &str) -> Option<Foreign> {
    let lines = || start.lines().map(str::trim).filter(|it| !it.is_empty());
    let mut plain = lines().filter(|it| !it.starts_with("//") && !it.starts_with("/*"));
    let first = plain.next()?;
    let word = first.split(|c: char| c.is_whitespace() || matches!(c, '(' | '{' | ';')).next()?;
    let (is, out) = if first.starts_with("|0|") {
        ("a net of GreatSPN (.net)", "in GreatSPN's editor: open it, then export it as PNML")
    } else if first.starts_with("|256") {
        (
            "the marking and rates of a net of GreatSPN (.def)",
            "in GreatSPN's editor: open the net \
            that it belongs to, then export it as PNML",
        )
    } else if matches!(word, "digraph" | "strict") || word == "graph" && start.contains("--") {
        ("a graph for Graphviz (DOT)", "give the net that it draws: PNML, JSON or TINA's .net")
    } else if matches!(first, "mdp" | "dtmc" | "ctmc" | "pta" | "smg" | "probabilistic") {
        ("a model of PRISM", "give a net: PNML, JSON or TINA's .net")
    } else if word == "MODULE" {
        ("a model of NuSMV", "give a net: PNML, JSON or TINA's .net")
    } else if matches!(word, "PLACE" | "DOMAIN" | "SORT") {
        ("a net of LoLA", "turn it into PNML")
    } else if first.starts_with("---- MODULE") {
        ("a specification in TLA+", "give a net: PNML, JSON or TINA's .net")
    } else if matches!(word, "proctype" | "active" | "mtype") {
        ("a model of SPIN (Promela)", "give a net: PNML, JSON or TINA's .net")
    } else if matches!(word, ".model" | ".inputs" | ".outputs" | ".graph") {
        ("a signal transition graph (.g)", "turn it into PNML, as Petrify and Workcraft do")
    } else if matches!(first, "stateDiagram" | "stateDiagram-v2" | "flowchart TD" | "flowchart LR")
    {
        ("a drawing (Mermaid)", "give the net that it draws: PNML, JSON or TINA's .net")
    } else if first.starts_with("@startuml") {
        ("a drawing (PlantUML)", "give the net that it draws: PNML, JSON or TINA's .net")
    } else {
        return None;
    };
    Some(Foreign { is, out })
}

/// Whether a text is YAML: its first line is a key with a colon, or three dashes.
pub(crate) fn is_yaml(start: &str) -> bool {
    let mut lines = start.lines().filter(|it| !it.trim().is_empty() && !it.starts_with('#'));
    let Some(first) = lines.next() else { return false };
    if first.trim_end() == "---" || first.starts_with("%YAML") {
        return true;
    }
    let Some((key, rest)) = first.split_once(':') else { return false };
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
    !key.is_empty() && key.chars().all(plain) && (rest.is_empty() || rest.starts_with(' '))
}

#[cfg(test)]
mod tests {
    use super::{is_yaml, of_bytes, of_text, root};

    #[test]
    fn a_file_of_another_tool_is_named() {
        let named = |text: &str| of_text(text).map(|it| it.is);
        let tapn = "<pnml xmlns=\"http://www.informatik.hu-berlin.de/top/pnml/ptNetb\">\n\
            <net active=\"true\" id=\"N\" type=\"P/T net\">\n\
            <place displayName=\"true\" id=\"P0\" initialMarking=\"1\" invariant=\"&lt; inf\"/>";
        for (text, is) in [
            (tapn, "a file of TAPAAL's editor (.tapn)"),
            (
                "<pnml><net id='a'/><k-bound bound=\"3\"/></pnml>",
                "a file of TAPAAL's editor (.tapn)",
            ),
            (
                "<?xml version=\"1.0\"?>\n<!-- <pnml> -->\n<log xes.version=\"1.0\">",
                "an event log (XES)",
            ),
            ("<project version=\"121\" name=\"P\"><gspn/>", "a project of GreatSPN (.PNPRO)"),
            ("|0|\n|\nf   0   3   0   4   0   0   0\n", "a net of GreatSPN (.net)"),
            ("|256\n%\n|\n", "the marking and rates of a net of GreatSPN (.def)"),
            ("{\"jani-version\": 1, \"name\": \"x\"}", "a model in JANI"),
            ("<scxml version=\"1.0\" initial=\"a\"/>", "a state machine (SCXML)"),
            ("<bpmn:definitions>", "a process (BPMN)"),
            ("<nta><declaration/></nta>", "timed automata of UPPAAL"),
            ("digraph net { a -> b }", "a graph for Graphviz (DOT)"),
            ("// a robot\nmdp\n\nmodule m", "a model of PRISM"),
            ("MODULE main\nVAR x: boolean;", "a model of NuSMV"),
        ] {
            assert_eq!(named(text), Some(is), "{text}");
        }
        let pnml = "<pnml><net id=\"n\"><place id=\"p\"><initialMarking><text>1</text>\
            </initialMarking></place></net></pnml>";
        for own in [pnml, "net lamp\ntr on off -> lit", "{\"schema\": \"cotama/net/1\"}", "A: 1"] {
            assert_eq!(named(own), None, "{own}");
        }
    }

    #[test]
    fn bytes_that_are_no_text_are_named() {
        let named = |bytes: &[u8]| of_bytes(bytes).map(|it| it.is);
        assert_eq!(named(b"\x89MCAP0\r\n"), Some("a recording of robots (MCAP)"));
        assert_eq!(named(b"#ROSBAG V2.0\n"), Some("a recording of ROS (bag)"));
        assert_eq!(named(b"SQLite format 3\0"), Some("a data base (SQLite), as rosbag2 writes"));
        assert_eq!(named(b"\x1f\x8b\x08"), Some("an archive (gzip)"));
        assert_eq!(named(b"GIF89a"), Some("a picture (GIF)"));
        let tar = [vec![b'a'; 257], b"ustar".to_vec()].concat();
        assert_eq!(named(&tar), Some("an archive (tar)"));
        assert_eq!(named(b"net lamp"), None);
    }

    #[test]
    fn yaml_is_known_by_its_first_line() {
        for text in ["---\nformat: x\n", "# a map\nimage: map.pgm\n", "limits:\n  energy: 3\n"] {
            assert!(is_yaml(text), "{text}");
        }
        for text in ["format = 'x'", "[limits]", "net a", "a:b", "", "# nothing"] {
            assert!(!is_yaml(text), "{text}");
        }
    }

    #[test]
    fn the_first_element_stands_behind_declarations_and_comments() {
        assert_eq!(root("<?xml?><!DOCTYPE a><!-- <b> --><n:c d=\"\">"), Some("c"));
        assert_eq!(root("<a/>"), Some("a"));
        assert_eq!(root("<!-- never closed <b>"), None);
    }
}
