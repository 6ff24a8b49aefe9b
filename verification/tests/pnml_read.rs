//! Reading PNML files of other tools, and damaged ones.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, Within};
use cotama_verification::pnml::{self, Imported, Limits};
use std::fmt::Write as _;

/// A file with one page.
fn file(page: &str) -> String {
    format!(
        "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">\
         <net id=\"n\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\">\
         <page id=\"g\">{page}</page></net></pnml>"
    )
}

fn read(text: &str) -> OwnedNet {
    read_bytes(text.as_bytes())
}

fn read_bytes(bytes: &[u8]) -> OwnedNet {
    match pnml::read("net.pnml", bytes) {
        Ok(net) => {
            assert_eq!(net.view().net().defect(), None);
            net
        }
        Err(errors) => panic!("{errors}"),
    }
}

fn place_names(net: &OwnedNet) -> Vec<&str> {
    net.places.iter().map(|place| place.name.as_str()).collect()
}

const P: PlaceId = PlaceId(0);
const Q: PlaceId = PlaceId(1);

#[test]
fn pages_and_references_are_one_net() {
    let net = read(
        "<pnml><net id='n'><page id='g1'>
           <referencePlace id='r2' ref='r1'/>
           <transition id='t'/>
           <arc id='a1' source='r2' target='t'/>
           <page id='g2'>
             <place id='p'><initialMarking><text> 3 </text></initialMarking></place>
             <referencePlace id='r1' ref='p'/>
             <referenceTransition id='rt' ref='t'/>
             <arc id='a2' source='rt' target='r1'><inscription><text>2</text></inscription></arc>
           </page>
         </page></net></pnml>",
    );
    let mut expected = OwnedNet::new("n", "");
    let p = expected.place(OwnedPlace::new("p", 3)).unwrap();
    expected.transition(OwnedTransition::new("t").take(p, 1).give(p, 2)).unwrap();
    assert_eq!(net, expected);
}

#[test]
fn a_net_without_nodes_is_a_net() {
    assert_eq!(read(&file("")), OwnedNet::new("n", ""));
    assert_eq!(read("<pnml><net id='n'/></pnml>"), OwnedNet::new("n", ""));
    assert_eq!(read("<pnml><net/></pnml>"), OwnedNet::new("net", ""));
}

#[test]
fn names_are_trimmed_and_stand_for_ids_otherwise() {
    let net = read(&file(
        "<place id='a'><name><text>\n  two\twords \n</text></name></place>\
         <place id='b'><name><graphics/></name></place>\
         <place id='c'><name><text> </text></name></place>\
         <place id='d'><name><text>x &lt; <![CDATA[<y>]]> &#x1F916;</text></name></place>",
    ));
    assert_eq!(place_names(&net), ["two\twords", "b", "c", "x < <y> 🤖"]);
}

#[test]
fn equal_names_are_told_apart_by_their_ids() {
    let place =
        |id: &str, name: &str| format!("<place id='{id}'><name><text>{name}</text></name></place>");
    let page = [("a", "idle"), ("b", "idle"), ("c", "idle (b)"), ("d", "idle"), ("e", "e")];
    let net = read(&file(&page.map(|(id, name)| place(id, name)).concat()));
    assert_eq!(place_names(&net), ["idle", "idle (b) (b)", "idle (b)", "idle (d)", "e"]);
}

#[test]
fn arcs_between_the_same_nodes_add_up() {
    let net = read(&file(
        "<place id='p'/><place id='q'/><transition id='t'/>\
         <arc source='p' target='t'/><arc source='q' target='t'/>\
         <arc source='p' target='t'><inscription><text>4</text></inscription></arc>",
    ));
    assert_eq!(net.transitions[0], OwnedTransition::new("t").take(P, 5).take(Q, 1));
}

#[test]
fn a_loop_stays_a_loop_and_a_test_arc_is_a_read() {
    let net = read(&file(
        "<place id='p'/><place id='q'/><transition id='t'/>\
         <arc source='p' target='t'/><arc source='t' target='p'/>\
         <arc source='q' target='t' type='test'/>",
    ));
    assert_eq!(net.transitions[0], OwnedTransition::new("t").take(P, 1).give(P, 1).read(Q, 1));
}

#[test]
fn intervals_of_tina_are_milliseconds() {
    let delay = |interval: &str| format!("<delay><interval {interval}</interval></delay>");
    let page = [
        ("a", delay("closure='closed'><cn>4</cn><cn> 9 </cn>")),
        ("b", delay("closure='closed-open'><cn>4</cn><ci>infty</ci>")),
        ("c", delay("><cn>0</cn><infinity/>")),
        ("d", String::new()),
    ];
    let net = read(&file(
        &page.map(|(id, delay)| format!("<transition id='{id}'>{delay}</transition>")).concat(),
    ));
    let within: Vec<_> =
        net.transitions.iter().map(|transition| transition.within.unwrap()).collect();
    let from = |earliest, latest| Within { earliest, latest };
    assert_eq!(within, [from(4, Some(9)), from(4, None), from(0, None), from(0, None)]);
}

#[test]
fn without_intervals_there_is_no_time() {
    assert_eq!(read(&file("<transition id='t'/>")).transitions[0].within, None);
}

#[test]
fn the_dialect_of_pipe_is_read() {
    let net = read(
        "<pnml><net id='Net-One' type='P/T net'><token id='Default' enabled='true' red='0'/>
         <place id='P0'><graphics><position x='1' y='2'/></graphics><name><value>P0</value>\
         <graphics/></name>
           <initialMarking><value>Default,2</value><graphics/></initialMarking><capacity><value>0\
           </value></capacity></place>
         <transition id='T0'><name><value>T0</value></name><rate><value>1.0</value></rate>
           <timed><value>false</value></timed><priority><value>1</value></priority></transition>
         <arc id='P0 to T0' source='P0' target='T0'><inscription><value>Default,3</value>\
         </inscription>
           <arcpath id='000' x='1' y='2'/><type value='normal'/></arc></net></pnml>",
    );
    let mut expected = OwnedNet::new("Net-One", "");
    let p = expected.place(OwnedPlace::new("P0", 2)).unwrap();
    expected.transition(OwnedTransition::new("T0").take(p, 3)).unwrap();
    assert_eq!(net, expected);
}

#[test]
fn a_coloured_net_beside_the_only_plain_one_is_skipped() {
    let coloured = "<net id='c' type='http://www.pnml.org/version-2009/grammar/symmetricnet'>\
        <place id='p'/></net>";
    let net =
        read(&format!("<pnml>{coloured}<net id='plain'><place id='p'/></net>{coloured}</pnml>"));
    assert_eq!((net.name.as_str(), net.places.len()), ("plain", 1));
}

#[test]
fn parts_of_other_tools_comments_and_a_plain_doctype_are_skipped() {
    let net = read(
        "<?xml version='1.0'?><!DOCTYPE pnml SYSTEM 'pnml.dtd'><!-- <place id='no'/> --><?go on?>
         <x:pnml xmlns:x='http://www.pnml.org/version-2009/grammar/pnml'><x:net id='n'>
         <x:toolspecific tool='other' version='7'><place id='p'/><anything><initialMarking/>\
         </anything></x:toolspecific>
         <x:place id='p'><x:toolspecific tool='cotamaran' version='1'><place bound='x'/>\
         </x:toolspecific></x:place>
         </x:net></x:pnml> <!-- end -->",
    );
    assert_eq!(place_names(&net), ["p"]);
}

#[test]
fn the_ids_of_the_file_are_known() {
    let text = file("<place id='p7'><name><text>idle</text></name></place><transition id='t7'/>");
    let Imported { net, place_ids, transition_ids, .. } =
        pnml::read_within("net.pnml", text.as_bytes(), Limits::default()).unwrap();
    assert_eq!(place_names(&net), ["idle"]);
    assert_eq!((place_ids, transition_ids), (vec!["p7".to_owned()], vec!["t7".to_owned()]));
}

#[test]
fn encodings_are_known_by_their_first_bytes_or_their_declaration() {
    let text = file("<place id='p'><name><text>Tür → 🤖</text></name></place>");
    let utf16 = |text: &str, bytes: fn(u16) -> [u8; 2]| {
        text.encode_utf16().flat_map(bytes).collect::<Vec<_>>()
    };
    let declared = format!("<?xml version=\"1.0\" encoding='utf-8'?>{text}");
    let little = utf16(&format!("\u{feff}{text}"), u16::to_le_bytes);
    let big = utf16(&format!("\u{feff}{text}"), u16::to_be_bytes);
    let unmarked = [utf16(&text, u16::to_le_bytes), utf16(&text, u16::to_be_bytes)];
    let marked = format!("\u{feff}{text}").into_bytes();
    for bytes in [declared.into_bytes(), little, big, marked].into_iter().chain(unmarked) {
        assert_eq!(place_names(&read_bytes(&bytes)), ["Tür → 🤖"]);
    }
    let latin =
        format!("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>{}", text.replace(" → 🤖", ""));
    let latin: Vec<u8> = latin.chars().map(|c| u8::try_from(c).unwrap()).collect();
    assert_eq!(place_names(&read_bytes(&latin)), ["Tür"]);
}

#[test]
fn line_ends_of_windows_are_line_ends() {
    let text =
        file("\r\n<place id='p'>\r\n<name><text>two\r\nlines\rmore&#13;</text></name></place>\r\n");
    assert_eq!(place_names(&read(&text)), ["two\nlines\nmore"]);
}

#[test]
fn many_equal_names_and_many_arcs_keep_the_order_of_the_file() {
    let mut page = String::from("<transition id='t'/><transition id='u'/>");
    for index in 0..100_000 {
        write!(page, "<place id='p{index}'><name><text>p</text></name></place>").unwrap();
        write!(page, "<arc source='p{index}' target='t'/><arc source='u' target='p{index}'/>")
            .unwrap();
    }
    let net = pnml::read("net.pnml", file(&page).as_bytes()).unwrap();
    assert_eq!((&*net.places[0].name, &*net.places[99_999].name), ("p", "p (p99999)"));
    for arcs in [&net.transitions[0].take, &net.transitions[1].give] {
        assert!(arcs.iter().map(|arc| arc.place.0).eq(0..100_000));
    }
}

/// Random numbers that are the same everywhere (xorshift64).
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound as u64) as usize
    }
}

#[test]
fn damaged_files_never_panic_and_get_a_position() {
    let written =
        std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/pnml/door.pnml")).unwrap();
    let tina = pnml::write_for_tina(&read_bytes(&written).view().net()).into_bytes();
    let mixed = file(
        "<place id='p'><initialMarking><text>1</text></initialMarking></place><!-- c -->\
         <referencePlace id='r' ref='p'/>\
         <transition id='t'><name><text>&lt;t&#62;<![CDATA[x]]></text></name></transition>\
         <arc id='a' source='r' target='t' type='test'/><arc id='b' source='t' target='p'>\
         <inscription><text>2</text>\
         </inscription></arc>",
    );
    let files = [written, tina, mixed.into_bytes()];
    let pieces: [&[u8]; 12] = [
        b"<",
        b">",
        b"&",
        b"\"",
        b"<page>",
        b"</page>",
        b"<!--",
        b"]]>",
        b"<![CDATA[",
        b"\xff",
        b"99999999999",
        b"<!DOCTYPE x [",
    ];
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let (mut accepted, mut refused) = (0, 0);
    // As many as a longer run asks for.
    let inputs = std::env::var("MUTATED_INPUTS").map_or(100_000, |it| it.parse().unwrap());
    for case in 0..inputs {
        let mut bytes = files[case % files.len()].clone();
        for _ in 0..=dice.below(3) {
            let at = dice.below(bytes.len());
            let until = (at + dice.below(40)).min(bytes.len());
            match dice.below(5) {
                0 => bytes[at] = dice.below(256) as u8,
                1 => drop(bytes.drain(at..until)),
                2 => drop(bytes.splice(at..at, pieces[dice.below(pieces.len())].iter().copied())),
                3 => bytes.truncate(at.max(1)),
                _ => {
                    let copy = bytes[at..until].to_vec();
                    let to = dice.below(bytes.len());
                    bytes.splice(to..to, copy);
                }
            }
            bytes.push(b'\n');
        }
        match pnml::read("net.pnml", &bytes) {
            Ok(net) => {
                assert_eq!(net.view().net().defect(), None);
                assert_eq!(
                    pnml::read("net.pnml", pnml::write(&net.view().net()).as_bytes()).as_ref(),
                    Ok(&net)
                );
                accepted += 1;
            }
            Err(errors) => {
                assert!(!errors.diagnostics().is_empty());
                for diagnostic in errors.diagnostics() {
                    assert!(errors.text().get(diagnostic.at.span.clone()).is_some());
                    assert!(diagnostic.help.is_some(), "{errors}");
                }
                refused += 1;
            }
        }
    }
    assert_eq!(
        (accepted > 1_000, refused > 10_000),
        (true, true),
        "{accepted} accepted, {refused} refused"
    );
}
