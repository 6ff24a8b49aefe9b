//! The files of the Model Checking Contest. What is said of broken ones is in
//! `tests/golden/properties/files.txt`; `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test
//! properties` writes it again. Public files are in the folder that the environment variable
//! `COTAMA_MCC_DIR` names: `*.pnml`, and `properties` with files `NET.EXAMINATION.xml` and
//! `verdicts.tsv`, whose columns start with file, property and verdict.

use crate::properties::oracle::{self, Space};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::pnml::{Limits, read_within};
use cotama_verification::property::{
    Formula, Ids, MAX_DEPTH, Property, PropertyError, Question, mcc, parse,
};
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn net() -> Pt {
    let mut net = OwnedNet::new("net", "");
    let p = net.place(OwnedPlace::new("p", 1)).unwrap();
    let q = net.place(OwnedPlace::new("q", 0)).unwrap();
    net.transition(OwnedTransition::new("t").take(p, 1).give(q, 1)).unwrap();
    Pt::from(&net.view().net())
}

fn read(file: &str) -> Result<Vec<Property>, PropertyError> {
    mcc::read("file.xml", file.as_bytes(), &net(), Ids::default())
}

/// A file with one formula.
fn file(formula: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<property-set xmlns=\"http://mcc.lip6.fr/\">\n<property><id>one\
         </id>\n<description>?</description>\n\
         <formula>{formula}</formula></property>\n</property-set>\n"
    )
}

fn written(formula: &str) -> String {
    match read(&file(formula)) {
        Ok(properties) => properties[0].question.display(&net()).to_string(),
        Err(error) => panic!("{formula}\n{error}"),
    }
}

#[test]
fn every_element_is_read() {
    let p = "<integer-le><integer-constant>1</integer-constant><tokens-count><place>p</place>\
        </tokens-count></integer-le>";
    let t = "<is-fireable><transition>t</transition></is-fireable>";
    let sum = "<tokens-count><place>p</place><place> q </place></tokens-count>";
    for (element, text) in [
        (format!("<exists-path><finally>{p}</finally></exists-path>"), "EF p"),
        (
            format!("<all-paths><globally><negation>{t}</negation></globally></all-paths>"),
            "AG \
            !fireable(t)",
        ),
        (format!("<all-paths><next>{t}</next></all-paths>"), "AX fireable(t)"),
        (
            format!(
                "<exists-path><until><before>{p}</before><reach>{t}</reach></until>\
            </exists-path>"
            ),
            "E[p U fireable(t)]",
        ),
        (format!("<all-paths><globally><finally>{p}</finally></globally></all-paths>"), "AG F p"),
        (format!("<conjunction>{p}{t}<deadlock/></conjunction>"), "p & fireable(t) & deadlock"),
        (format!("<disjunction>{p}<true/><false></false></disjunction>"), "p | true | false"),
        (format!("<conjunction>{p}</conjunction>"), "p"),
        (format!("<implication>{p}{t}</implication>"), "!p | fireable(t)"),
        (format!("<equivalence>{p}{t}</equivalence>"), "p & fireable(t) | !p & !fireable(t)"),
        (
            format!("<exclusive-disjunction>{p}{t}</exclusive-disjunction>"),
            "!(p & fireable(t) | !p \
            & !fireable(t))",
        ),
        (
            format!("<integer-lt>{sum}<integer-constant>3</integer-constant></integer-lt>"),
            "p + q \
            <= 2",
        ),
        (
            format!("<integer-ge>{sum}<integer-constant>3</integer-constant></integer-ge>"),
            "p + q \
            >= 3",
        ),
        (
            format!("<integer-gt>{sum}<integer-constant>3</integer-constant></integer-gt>"),
            "p + q \
            >= 4",
        ),
        (
            format!("<integer-eq>{sum}<integer-constant>3</integer-constant></integer-eq>"),
            "p + q = \
            3",
        ),
        (
            format!("<integer-ne>{sum}<integer-constant>-3</integer-constant></integer-ne>"),
            "p + q \
            + 3 != 0",
        ),
        (
            "<integer-le><integer-product><integer-constant>2</integer-constant><tokens-count>\
             <place>p</place></tokens-count></integer-product>\
             <integer-difference><integer-sum><integer-constant>7</integer-constant></integer-sum>\
             <tokens-count><place>q</place></tokens-count></integer-difference>\
             </integer-le>"
                .into(),
            "2 * p + q <= 7",
        ),
        ("<place-bound><place>p</place><place>q</place></place-bound>".into(), "bounds(p + q)"),
        (format!("<!-- a comment --><exists-path><finally>{p}</finally></exists-path>"), "EF p"),
    ] {
        assert_eq!(written(&element), text, "{element}");
    }
}

#[test]
fn nodes_are_called_by_id_and_where_there_is_none_by_name() {
    let ids = [["q", "x&y"], ["t1", ""]].map(|ids| ids.map(str::to_owned));
    let ids = Ids { places: &ids[0], transitions: &ids[1][..1] };
    let bound = |place: &str| {
        let file = file(&format!("<place-bound><place>{place}</place></place-bound>"));
        mcc::read("file.xml", file.as_bytes(), &net(), ids).unwrap()[0].question.clone()
    };
    assert_eq!(bound("q"), Question::Bound(vec![PlaceId(0)]));
    assert_eq!(bound("x&amp;y"), Question::Bound(vec![PlaceId(1)]));
    assert_eq!(bound("x&#38;y"), Question::Bound(vec![PlaceId(1)]));
    assert_eq!(bound("<![CDATA[x&y]]>"), Question::Bound(vec![PlaceId(1)]));
    assert_eq!(bound("p"), Question::Bound(vec![PlaceId(0)]));
}

#[test]
fn an_examination_without_a_file_has_a_question() {
    let deadlock = mcc::examination("ReachabilityDeadlock").unwrap();
    assert_eq!(deadlock.question.display(&net()).to_string(), "EF deadlock");
    for (name, question) in [
        ("Liveness", Question::Liveness),
        ("QuasiLiveness", Question::QuasiLiveness),
        ("StableMarking", Question::StableMarking),
        ("OneSafe", Question::OneSafe),
    ] {
        assert_eq!(mcc::examination(name), Some(Property { name: name.into(), question }));
    }
    assert_eq!(mcc::examination("StateSpace"), None);
    let answers = [
        mcc::Answer::Verdict(true),
        mcc::Answer::Verdict(false),
        mcc::Answer::Bound(3),
        mcc::Answer::Unknown,
    ];
    let lines = answers.map(|it| mcc::answer("OneSafe", it, &["EXPLICIT", "PARALLEL_PROCESSING"]));
    assert_eq!(
        lines,
        [
            "FORMULA OneSafe TRUE TECHNIQUES EXPLICIT PARALLEL_PROCESSING",
            "FORMULA OneSafe FALSE TECHNIQUES EXPLICIT PARALLEL_PROCESSING",
            "FORMULA OneSafe 3 TECHNIQUES EXPLICIT PARALLEL_PROCESSING",
            "FORMULA OneSafe CANNOT_COMPUTE",
        ]
    );
}

#[test]
fn broken_files_are_refused_with_position_and_remedy() {
    let set = |inside: &str| format!("<property-set>\n{inside}\n</property-set>");
    let broken = [
        String::new(),
        "text".into(),
        "<pnml/>".into(),
        "<property-set/><property-set/>".into(),
        "<property-set>\n  loose\n</property-set>".into(),
        "<property-set>".into(),
        "<property-set></property>".into(),
        "</property-set>".into(),
        "<property-set a=b></property-set>".into(),
        "<!DOCTYPE x [<!ENTITY a \"b\">]><property-set/>".into(),
        set("<properties/>"),
        set("<property/>"),
        set("<property><id>one</id></property>"),
        set("<property><id>one</id><id>two</id></property>"),
        file(""),
        file("true"),
        file("<true/><true/>"),
        file("<maybe/>"),
        file("<deadlock>now</deadlock>"),
        file("<finally><true/></finally>"),
        file("<exists-path><finally></finally></exists-path>"),
        file("<exists-path><until><before><true/></before></until></exists-path>"),
        file("<exists-path><until><reach><true/></reach></until></exists-path>"),
        file("<conjunction/>"),
        file("<implication><true/></implication>"),
        file("<is-fireable/>"),
        file("<is-fireable><transition>p</transition></is-fireable>"),
        file("<is-fireable><transition>u</transition></is-fireable>"),
        file("<is-fireable><place>p</place></is-fireable>"),
        file("<is-fireable><transition>&t;</transition></is-fireable>"),
        file("<is-fireable><transition>a & b</transition></is-fireable>"),
        file("<is-fireable><transition><b>t</b></transition></is-fireable>"),
        file("<integer-le><integer-constant>1</integer-constant></integer-le>"),
        file(
            "<integer-le><integer-constant>one</integer-constant><integer-constant>1\
             </integer-constant></integer-le>",
        ),
        file("<integer-le><true/><integer-constant>1</integer-constant></integer-le>"),
        file("<place-bound><place>p</place><place>p</place></place-bound>"),
        file("<place-bound><place>\n  x</place></place-bound>"),
        file("<negation><place-bound><place>p</place></place-bound></negation>"),
        set(&format!("<property>{}", "<a>".repeat(2_000))),
        set(&format!("<property><id>{}</id></property>", "a".repeat(70_000))),
        set("<property><description><a></b></description></property>"),
        file(&format!("{}<true/>", "<negation>".repeat(MAX_DEPTH + 1))),
    ];
    let mut said = String::new();
    for file in broken {
        let error = read(&file).expect_err(&file);
        let shown: String = file
            .lines()
            .last()
            .filter(|_| file.lines().count() < 2)
            .unwrap_or("")
            .chars()
            .take(80)
            .collect();
        let formula = file
            .split_once("<formula>")
            .map_or(shown.as_str(), |(_, rest)| rest.lines().next().unwrap_or(""));
        let formula: String = formula.chars().take(80).collect();
        writeln!(said, "{formula}\n{error}\n").unwrap();
    }
    let not_text =
        mcc::read("file.xml", b"<property-set>\n\xff", &net(), Ids::default()).unwrap_err();
    writeln!(said, "{not_text}").unwrap();
    cotama_golden::compare("tests/golden/properties/files.txt", &said);
}

#[test]
fn a_property_is_called_whatever_its_file_calls_it() {
    let names = |ids: &[&str]| {
        let property =
            |id: &&str| format!("<property><id>{id}</id><formula><true/></formula></property>");
        let all: String = ids.iter().map(property).collect();
        let all = read(&format!("<property-set>{all}</property-set>")).unwrap();
        all.into_iter().map(|it| it.name).collect::<Vec<_>>()
    };
    assert_eq!(names(&["Query Comment/Name Here"]), ["Query Comment/Name Here"]);
    assert_eq!(names(&["EF P4=1", "a\tb", "\u{fc}n\u{ef}"]), ["EF P4=1", "a\tb", "\u{fc}n\u{ef}"]);
    assert_eq!(names(&["one", "one", "two", "one"]), ["one", "one#2", "two", "one#3"]);
    assert_eq!(names(&["", "x", ""]), ["property-1", "x", "property-3"]);
    assert_eq!(names(&["a#2", "a", "a"]), ["a#2", "a", "a#3"]);
    assert_eq!(names(&["&lt;b&gt;"]), ["<b>"]);
}

#[test]
fn a_line_of_the_contest_has_one_word_for_the_name() {
    let line = |name: &str| mcc::answer(name, mcc::Answer::Verdict(true), &["EXPLICIT"]);
    for (name, word) in [
        ("a-PT-01-RF-00", "a-PT-01-RF-00"),
        ("Query Comment/Name Here", r"Query\u{20}Comment/Name\u{20}Here"),
        ("x TRUE\nFORMULA forged", r"x\u{20}TRUE\u{a}FORMULA\u{20}forged"),
        ("a\u{a0}b", r"a\u{a0}b"),
        ("\u{1b}[31m", r"\u{1b}[31m"),
        ("", r"\u{}"),
    ] {
        assert_eq!(line(name), format!("FORMULA {word} TRUE TECHNIQUES EXPLICIT"), "{name:?}");
        assert_eq!(line(name).lines().count(), 1, "{name:?}");
    }
}

#[test]
fn a_deep_formula_is_read_on_a_small_stack() {
    let deep = file(&format!(
        "{}<true/>{}",
        "<negation>".repeat(MAX_DEPTH - 1),
        "</negation>".repeat(MAX_DEPTH - 1)
    ));
    let read = move || read(&deep).unwrap()[0].question.clone();
    let question =
        std::thread::Builder::new().stack_size(1 << 20).spawn(read).unwrap().join().unwrap();
    let Question::Formula(formula) = question else { panic!("not a formula") };
    assert_eq!(formula.simplified(), Formula::FALSE);
}

/// The public property files, each with its net; `None`, said loudly, without the folder.
fn public() -> Option<Vec<(PathBuf, PathBuf)>> {
    let folder = cotama_golden::public_folder("COTAMA_MCC_DIR", "the reader of properties")?;
    let files =
        std::fs::read_dir(folder.join("properties")).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|it| it == "xml")).collect();
    files.sort();
    let net = |file: PathBuf| {
        let model =
            file.file_stem().unwrap().to_str().unwrap().split_once('.').unwrap().0.to_owned();
        (folder.join(model + ".pnml"), file)
    };
    Some(files.into_iter().map(net).collect())
}

fn with_properties(net: &Path, file: &Path) -> (Pt, Vec<Property>) {
    let imported = read_within("net", &std::fs::read(net).unwrap(), Limits::default()).unwrap();
    let pt = Pt::from(&imported.net.view().net());
    let name = file.file_name().unwrap().to_str().unwrap();
    match mcc::read(name, &std::fs::read(file).unwrap(), &pt, Ids::from(&imported)) {
        Ok(properties) => (pt, properties),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn public_files_are_read_and_written_in_the_language() {
    let Some(files) = public() else { return };
    assert!(!files.is_empty());
    for (net, file) in files {
        let (net, properties) = with_properties(&net, &file);
        assert_eq!(properties.len(), 16, "{}", file.display());
        for property in properties {
            let text = property.question.display(&net).to_string();
            assert_eq!(parse(&text, &net).unwrap().question, property.question, "{text}");
        }
    }
}

#[test]
fn public_verdicts_on_small_nets_are_those_of_the_oracle() {
    let Some(files) = public() else { return };
    let table = files[0].1.with_file_name("verdicts.tsv");
    let table = std::fs::read_to_string(table).unwrap();
    let row = |line: &str| {
        let cells: Vec<_> = line.split('\t').map(str::to_owned).collect();
        ((cells[0].clone(), cells[1].clone()), cells[2].clone())
    };
    let verdicts: BTreeMap<_, _> = table.lines().skip(1).map(row).collect();
    let mut compared = 0;
    for (net, file) in files {
        let name = file.file_name().unwrap().to_str().unwrap().to_owned();
        let linear = name.contains(".LTL");
        if !["Angiogenesis-PT-01", "Philosophers-PT-000005"].iter().any(|it| name.starts_with(it)) {
            continue;
        }
        let (net, properties) = with_properties(&net, &file);
        for property in properties {
            let Some(expected) = verdicts.get(&(name.clone(), property.name.clone())) else {
                continue;
            };
            let found = match &property.question {
                Question::Bound(places) => oracle::bound(&net, places).to_string(),
                // The oracle takes a while with long formulas of LTL; simplified, many are short.
                Question::Formula(formula) if linear => {
                    let simplified = formula.simplified();
                    if simplified.display(&net).to_string().matches(['X', 'F', 'G', 'U']).count()
                        > 7
                    {
                        continue;
                    }
                    Space::new(&net).satisfying(&simplified)[0].to_string().to_uppercase()
                }
                question => oracle::verdict(&net, question).unwrap().to_string().to_uppercase(),
            };
            assert_eq!(&found, expected, "{name}: {}", property.question.display(&net));
            compared += 1;
        }
    }
    assert!(compared > 150, "{compared}");
}

#[test]
fn global_properties_are_those_of_the_book() {
    let net = net();
    for (name, expected) in [
        ("Liveness", false),
        ("QuasiLiveness", true),
        ("StableMarking", false),
        ("OneSafe", true),
        ("ReachabilityDeadlock", true),
    ] {
        let property = mcc::examination(name).unwrap();
        assert_eq!(oracle::verdict(&net, &property.question), Some(expected), "{name}");
    }
    assert_eq!(
        oracle::verdict(&net, &Question::Response { from: TransitionId(0), to: PlaceId(0) }),
        None
    );
}
