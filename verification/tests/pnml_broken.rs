//! Broken PNML files and what is said about them. The messages are in
//! `tests/golden/pnml/broken.txt`; `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test nets
//! pnml_broken` writes them again.

use cotama_verification::pnml::{self, Limits, PnmlErrors};
use std::fmt::Write as _;

/// A file with one page, in lines.
fn file(page: &str) -> Vec<u8> {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">\n\
         <net id=\"n\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\">\n\
         <page id=\"page\">\n\
         {page}\n\
         </page>\n\
         </net>\n\
         </pnml>\n"
    )
    .into_bytes()
}

/// The page has places `p` and `q`, transitions `t` and `u`, and more.
fn nodes(more: &str) -> Vec<u8> {
    file(&format!(
        "<place id=\"p\"/>\n<place id=\"q\"/>\n<transition id=\"t\"/>\n<transition id=\"u\"/>\n\
         {more}"
    ))
}

fn marking(text: &str) -> Vec<u8> {
    file(&format!("<place id=\"p\"><initialMarking><text>{text}</text></initialMarking></place>"))
}

fn weight(text: &str) -> Vec<u8> {
    nodes(&format!(
        "<arc id=\"a\" source=\"p\" target=\"t\">\n  <inscription><text>{text}</text>\
         </inscription>\n</arc>"
    ))
}

fn interval(closure: &str, bounds: &str) -> Vec<u8> {
    file(&format!(
        "<transition id=\"t\"><delay><interval closure=\"{closure}\">{bounds}</interval></delay>\
         </transition>"
    ))
}

/// A place with a part of this project.
fn own_place(attributes: &str) -> Vec<u8> {
    let own = "<toolspecific tool=\"cotama\" version=\"1\">";
    file(&format!(
        "<place id=\"p\"><initialMarking><text>2</text></initialMarking>\n{own}\
         <place {attributes}/></toolspecific></place>"
    ))
}

fn own_transition(attributes: &str) -> Vec<u8> {
    file(&format!(
        "<transition id=\"t\">\n<toolspecific tool=\"cotama\" version=\"1\">\
         <transition {attributes}/></toolspecific></transition>"
    ))
}

fn own_net(elements: &str) -> Vec<u8> {
    format!(
        "<pnml><net id=\"n\"><place id=\"p\"/><transition id=\"t\"/>\n\
         <toolspecific tool=\"cotama\" version=\"1\">\n{elements}\n</toolspecific></net></pnml>"
    )
    .into_bytes()
}

fn typed(of: &str) -> Vec<u8> {
    format!("<pnml>\n<net id=\"n\" type=\"{of}\"><page id=\"page\"/></net>\n</pnml>").into_bytes()
}

/// A file in ISO-8859-1.
fn latin1(utf8: &[u8]) -> Vec<u8> {
    std::str::from_utf8(utf8).unwrap().chars().map(|c| u8::try_from(c).unwrap()).collect()
}

fn text(text: &str) -> Vec<u8> {
    text.as_bytes().to_vec()
}

fn refusal(name: &str, bytes: &[u8]) -> PnmlErrors {
    let file = format!("{name}.pnml");
    let Err(errors) = pnml::read(&file, bytes) else { panic!("{name} was accepted") };
    for diagnostic in errors.diagnostics() {
        assert!(errors.text().get(diagnostic.at.span.clone()).is_some(), "{name}: {diagnostic:?}");
        assert!(diagnostic.help.is_some(), "{name}: {} has no help", diagnostic.message);
    }
    errors
}

#[test]
fn broken_files_get_cause_position_and_remedy() {
    let bomb = "<!DOCTYPE pnml [\n<!ENTITY a \"ha\">\n<!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">\n\
        ]>\n\
                <pnml><net id=\"&b;\"/></pnml>";
    let cases: &[(&str, Vec<u8>)] = &[
        // Not XML.
        ("empty", vec![]),
        ("blank", text("\n\n")),
        ("binary", b"\x7fELF\x02\x01\x01\0\0\0".to_vec()),
        ("compressed", b"\x1f\x8b\x08\0\0".to_vec()),
        ("plain_text", text("net {Kanban}\ntr t1 p1 -> p2\n")),
        ("html", text("<!DOCTYPE html>\n<html><body>Not found</body></html>\n")),
        ("another_format", text("<sbml level=\"3\"/>\n")),
        ("truncated", file("<place id=\"p\"/>")[..190].to_vec()),
        ("truncated_tag", text("<pnml>\n<net id=\"n")),
        ("unclosed_element", file("<place id=\"p\">")),
        ("unclosed_tag", file("<place id=\"p\"\n<place id=\"q\"/>")),
        ("closed_twice", file("<place id=\"p\"/>\n</place>")),
        ("closed_after_the_end", text("<pnml><net/></pnml>\n</pnml>")),
        ("text_after_the_end", text("<pnml><net/></pnml>\n  more")),
        ("two_roots", text("<pnml><net/></pnml>\n<pnml/>")),
        ("unquoted_attribute", file("<place id=p/>")),
        ("attribute_without_value", file("<place id/>")),
        ("duplicate_attribute", file("<place id=\"p\" id=\"q\"/>")),
        ("open_quote", file("<place id=\"p/>\n<place id=\"q\"/>")),
        ("ampersand", file("<place id=\"p\"><name><text>A & B</text></name></place>")),
        ("ampersand_in_attribute", file("<place id=\"A & B\"/>")),
        ("unknown_entity", file("<place id=\"p\"><name><text>caf&eacute;</text></name></place>")),
        ("impossible_character", file("<place id=\"p\"><name><text>&#0;</text></name></place>")),
        ("control_character", file("<place id=\"p\"><name><text>bell \u{7}</text></name></place>")),
        ("unclosed_comment", file("<!-- <place id=\"p\"/>")),
        ("less_than", file("<place id=\"p\"><name><text>1 < 2</text></name></place>")),
        ("late_declaration", text("\n<?xml version=\"1.0\"?><pnml/>")),
        ("many_attributes", {
            let many = (0..70).map(|n| format!(" a{n}=\"\"")).collect::<Vec<_>>().concat();
            file(&format!("<place id=\"p\"{many}/>"))
        }),
        (
            "long_text",
            file(&format!("<place id=\"p\"><name><text>{}</text></name>\
                </place>", "ab".repeat(600_000))),
        ),
        // Entities and encodings.
        ("entity_bomb", text(bomb)),
        ("doctype_with_declarations", text("<!DOCTYPE pnml [<!ATTLIST arc type CDATA \"test\">]>\
            <pnml/>")),
        ("not_utf8", latin1(&file("<place id=\"p\"/>\n<place id=\"Tür\"/>"))),
        ("half_utf16", vec![0xff, 0xfe, b'<', 0, b'p', 0, 0x00, 0xd8]),
        ("utf32", vec![0xff, 0xfe, 0, 0, b'<', 0, 0, 0]),
        ("not_ascii", text("<?xml version=\"1.0\" encoding=\"US-ASCII\"?>\n<pnml><net id=\"Tür\"/>\
            </pnml>")),
        ("not_utf16", text("<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n<pnml><net/></pnml>")),
        ("unknown_encoding", text("<?xml version=\"1.0\" encoding=\"EBCDIC-FR\"?>\n<pnml><net/>\
            </pnml>")),
        // Nets.
        ("no_net", text("<pnml>\n</pnml>")),
        ("two_nets", text("<pnml>\n<net id=\"a\"/>\n<net id=\"b\"/>\n</pnml>")),
        ("symmetric_net", typed("http://www.pnml.org/version-2009/grammar/symmetricnet")),
        ("high_level_net", typed("http://www.pnml.org/version-2009/grammar/highlevelnet")),
        ("coloured_marking", file("<place id=\"p\"><hlinitialMarking/></place>")),
        ("coloured_condition", file("<transition id=\"t\"><condition/></transition>")),
        // Nodes.
        ("no_id", file("<place/>\n<transition/>\n<referencePlace ref=\"p\"/>")),
        (
            "duplicate_id",
            file("<place id=\"p\"/>\n<transition id=\"p\"/>\n\
                <arc id=\"p\" source=\"p\" target=\"p\"/>"),
        ),
        ("place_in_transition", file("<transition id=\"t\">\n<place id=\"p\"/></transition>")),
        ("negative_marking", marking("-1")),
        ("float_marking", marking("1.5")),
        ("word_marking", marking("one")),
        ("huge_marking", marking("4294967296")),
        ("enormous_marking", marking(&"9".repeat(80))),
        ("coloured_marking_of_pipe", marking("Default,1,Red,2")),
        ("marking_without_text", file("<place id=\"p\"><initialMarking>7</initialMarking>\
            </place>")),
        ("marking_with_two_texts", marking("1</text><text>2")),
        (
            "two_markings",
            file(
                "<place id=\"p\"><initialMarking><text>1</text></initialMarking><initialMarking>\
                 <text>2</text></initialMarking></place>",
            ),
        ),
        (
            "marking_of_tapaal",
            file("<place id=\"p\" initialMarking=\"1\" invariant=\"&lt; inf\"/>"),
        ),
        ("capacity", file("<place id=\"p\"><capacity><value>3</value></capacity></place>")),
        ("random_delay", file("<transition id=\"t\"><timed><value>true</value></timed>\
            </transition>")),
        // References.
        (
            "reference_circle",
            file("<referencePlace id=\"r\" ref=\"s\"/>\n<referencePlace id=\"s\" ref=\"r\"/>"),
        ),
        ("reference_to_itself", file("<referenceTransition id=\"r\" ref=\"r\"/>")),
        ("reference_to_nothing", file("<referencePlace id=\"r\" ref=\"x\"/>")),
        ("reference_to_the_other_kind", file("<transition id=\"t\"/>\n\
            <referencePlace id=\"r\" ref=\"t\"/>")),
        (
            "transition_reference_to_a_place",
            file("<place id=\"p\"/>\n<referenceTransition id=\"r\" ref=\"p\"/>"),
        ),
        ("reference_without_ref", file("<referencePlace id=\"r\"/>")),
        (
            "references_of_two_kinds",
            file(
                "<place id=\"p\"/><referencePlace id=\"r\" ref=\"p\"/>\n\
                 <referenceTransition id=\"s\" ref=\"r\"/>",
            ),
        ),
        // Arcs.
        (
            "arc_to_nowhere",
            nodes("<arc id=\"a\" source=\"p\" target=\"T\"/>\n\
                <arc id=\"b\" source=\"x\" target=\"y\"/>"),
        ),
        ("arc_without_ends", nodes("<arc id=\"a\" source=\"p\"/>\n<arc id=\"b\" target=\"p\"/>")),
        ("arc_between_places", nodes("<arc id=\"a\" source=\"p\" target=\"q\"/>")),
        ("arc_between_transitions", nodes("<arc id=\"a\" source=\"t\" target=\"u\"/>")),
        ("arc_to_a_page", nodes("<arc id=\"a\" source=\"p\" target=\"page\"/>")),
        ("zero_weight", weight("0")),
        ("negative_weight", weight("-2")),
        ("expression_weight", weight("x + 1")),
        ("huge_weight", weight("5000000000")),
        (
            "sum_of_weights",
            nodes(
                &"<arc source=\"p\" target=\"t\"><inscription><text>4294967295</text></inscription>\
                    </arc>\n"
                    .repeat(2),
            ),
        ),
        ("inhibitor_arc", nodes("<arc id=\"a\" source=\"p\" target=\"t\" type=\"inhibitor\"/>")),
        (
            "inhibitor_arc_of_pipe",
            nodes("<arc id=\"a\" source=\"p\" target=\"t\"><type value=\"inhibitor\"/></arc>"),
        ),
        ("reset_arc", nodes("<arc id=\"a\" source=\"p\" target=\"t\"><type><text>reset</text>\
            </type></arc>")),
        ("test_arc_backwards", nodes("<arc id=\"a\" source=\"t\" target=\"p\" type=\"test\"/>")),
        (
            "test_and_take",
            nodes("<arc source=\"p\" target=\"t\" type=\"test\"/>\n\
                <arc source=\"p\" target=\"t\"/>"),
        ),
        // Intervals.
        ("open_interval", interval("open", "<cn>3</cn><cn>5</cn>")),
        ("half_open_interval", interval("closed-open", "<cn>3</cn><cn>5</cn>")),
        ("reversed_interval", interval("closed", "<cn>5</cn><cn>3</cn>")),
        ("endless_interval", interval("closed", "<cn>0</cn><cn>4294967295</cn>")),
        ("interval_without_end", interval("closed", "<cn>5</cn>")),
        ("float_interval", interval("closed", "<cn>0.5</cn><cn>1</cn>")),
        // Parts of this project.
        ("newer_version", file("<place id=\"p\"><toolspecific tool=\"cotama\" version=\"2\"/>\
            </place>")),
        ("unknown_attribute", own_place("bund=\"3\"")),
        ("unknown_role", own_place("role=\"stat\"")),
        ("bound_too_small", own_place("bound=\"1\"")),
        ("complement_of_nothing", own_place("bound=\"2\" role=\"complement\" of=\"x\"")),
        ("complement_that_is_none", own_place("bound=\"2\" role=\"complement\" of=\"p\"")),
        (
            "complement_with_another_bound",
            file(
                "<place id=\"p\"><initialMarking><text>2</text></initialMarking>\n\
                 <toolspecific tool=\"cotama\" version=\"1\"><place bound=\"2\"/></toolspecific>\
                 </place>\n\
                 <place id=\"q\">\n<toolspecific tool=\"cotama\" version=\"1\">\
                 <place bound=\"3\" role=\"complement\" of=\"p\"/></toolspecific></place>",
            ),
        ),
        ("unknown_escape", own_place("doc=\"\\n\"")),
        ("unknown_event", own_transition("on=\"e0\" emits=\"o0 o1\"")),
        ("priority_too_large", own_transition("priority=\"40000\"")),
        ("latest_before_earliest", own_transition("earliest=\"5\" latest=\"4\"")),
        (
            "read_without_return",
            nodes(
                "<arc source=\"p\" target=\"t\"><toolspecific tool=\"cotama\" version=\"1\">\
                 <arc read=\"1\"/></toolspecific></arc>",
            ),
        ),
        (
            "read_more_than_there_is",
            nodes(
                "<arc source=\"p\" target=\"t\"><toolspecific tool=\"cotama\" version=\"1\">\
                 <arc read=\"2\"/></toolspecific></arc>",
            ),
        ),
        ("unknown_law", own_net("<reachible place=\"p\"/>")),
        ("law_of_a_transition", own_net("<reachable place=\"t\"/>")),
        ("law_without_place", own_net("<never-both first=\"p\"/>")),
        (
            "term_twice",
            own_net(
                "<invariant equals=\"1\"><term place=\"p\" weight=\"1\"/>\
                 <term place=\"p\" weight=\"2\"/></invariant>",
            ),
        ),
        (
            "guard_term_twice",
            own_net(
                "<event id=\"e\" name=\"a\"/><ignored event=\"e\" place=\"p\">\
                 <term place=\"p\" weight=\"1\"/><term place=\"p\" weight=\"2\"/></ignored>",
            ),
        ),
        (
            "guard_term_weight_0",
            own_net(
                "<event id=\"e\" name=\"a\"/><ignored event=\"e\" place=\"p\">\
                 <term place=\"p\" weight=\"0\"/></ignored>",
            ),
        ),
        (
            "guard_no_place",
            own_net(
                "<event id=\"e\" name=\"a\"/><ignored event=\"e\" place=\"p\">\
                 <term place=\"x\" weight=\"1\"/></ignored>",
            ),
        ),
        ("event_twice", own_net("<event id=\"e\" name=\"a\"/>\n<event id=\"e\" name=\"b\"/>")),
        // Several at once, in the order of the file, in columns of characters.
        (
            "several",
            file(
                "<place id=\"ü\"><initialMarking><text>-1</text></initialMarking></place>\n\
                 <transition id=\"t\"/>\n\
                          <arc id=\"äöü\" source=\"ü\" target=\"nöwhere\"><inscription><text>0\
                          </text></inscription></arc>",
            ),
        ),
        (
            "very_long_name",
            file(&format!("<arc source=\"{0}\" target=\"\u{202e}{0}\"/>", "long".repeat(30))),
        ),
    ];
    assert_eq!(cases.len(), 109);
    let mut said = String::new();
    for (name, bytes) in cases {
        writeln!(said, "{}\n", refusal(name, bytes)).unwrap();
    }
    cotama_golden::compare("tests/golden/pnml/broken.txt", &said);
}

#[test]
fn a_million_nested_pages_are_refused_on_a_small_stack() {
    let pages = ("<page>".repeat(1_000_000), "</page>".repeat(1_000_000));
    let bytes = format!("<pnml><net>{}{}</net></pnml>", pages.0, pages.1).into_bytes();
    let read = move || refusal("nested", &bytes).to_string();
    let said =
        std::thread::Builder::new().stack_size(64 << 10).spawn(read).unwrap().join().unwrap();
    let expected = "nested.pnml:1:1536: elements are nested more than 256 deep\n  \
                    help: no PNML needs this; the file is damaged or made to do harm";
    assert_eq!(said, expected);
}

#[test]
fn an_error_made_a_thousand_times_is_told_once() {
    let errors = refusal("many", &file(&"<place id=\"p\"/>\n".repeat(1_000)));
    assert_eq!((errors.diagnostics().len(), errors.omitted()), (1, 0));
    assert_eq!(
        errors.to_string(),
        "many.pnml:6:12: the id `p` is that of a place already\n  help: give every part of the net \
         an id of its own\n  see: many.pnml:5:12\n  the same at 998 further places: lines 7, 8, 9, \
         10, 11, ..."
    );
}

#[test]
fn of_one_cause_three_different_errors_are_told() {
    let arcs = |count: usize| {
        let arc = |at| format!("<arc source=\"p\" target=\"gone{at}\"/>\n");
        nodes(&(0..count).map(arc).collect::<String>())
    };
    let told = |count| {
        let errors = refusal("many", &arcs(count));
        let one = |it: &pnml::Diagnostic| (it.message.clone(), it.times, it.also.clone());
        errors.diagnostics().iter().map(one).collect::<Vec<_>>()
    };
    let one = |at: usize| format!("nothing in the net has the id `gone{at}`");
    assert_eq!(told(3), [0, 1, 2].map(|it| (one(it), 1, vec![])));
    assert_eq!(told(4)[2], (one(2), 2, vec![12]));
    let all = told(2_000);
    assert_eq!(all.len(), 3);
    assert_eq!(all[2], (one(2), 1_998, vec![12, 13, 14, 15, 16]));
}

#[test]
fn a_long_chain_of_references_is_followed_once() {
    let mut page = String::from("<place id=\"r0\"/>");
    for index in 1..=300_000 {
        writeln!(page, "<referencePlace id=\"r{index}\" ref=\"r{}\"/>", index - 1).unwrap();
    }
    assert_eq!(pnml::read("chain.pnml", &file(&page)).unwrap().places.len(), 1);
}

#[test]
fn the_limits_hold() {
    let bytes = nodes("");
    let read = |limits| {
        pnml::read_within("net.pnml", &bytes, limits).map(|imported| imported.net.places.len())
    };
    let told = |limits| read(limits).unwrap_err().diagnostics()[0].message.clone();
    let limits = Limits { bytes: bytes.len(), depth: 4, attributes: 2, text: 50, objects: 5 };
    assert_eq!(read(limits), Ok(2));
    let length = bytes.len();
    let shorter = Limits { bytes: length - 1, ..limits };
    assert_eq!(told(shorter), format!("the file has {length} bytes, more than {}", length - 1));
    assert_eq!(told(Limits { depth: 3, ..limits }), "elements are nested more than 3 deep");
    assert_eq!(told(Limits { attributes: 1, ..limits }), "a tag has more than 1 attributes");
    assert_eq!(told(Limits { text: 45, ..limits }), "a text is longer than 45 bytes");
    assert_eq!(told(Limits { objects: 4, ..limits }), "the net has more than 4 parts");
}
