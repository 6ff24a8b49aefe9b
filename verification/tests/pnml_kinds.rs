//! Inhibitor arcs, reset arcs, read arcs, priorities and guards, in all the ways in which tools
//! write them: read, or refused, and never taken for something else.

use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::pnml::{self, Imported, Limits};
use cotama_verification::property::parse;
use cotama_verification::pt::{Extras, Pt};

/// A robot that drives, a human who comes and goes, and what joins the human to the driving.
fn gate(special: &str) -> String {
    format!(
        "<pnml xmlns='http://www.pnml.org/version-2009/grammar/pnml'>
         <net id='gate' type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='g'>
         <place id='idle'><initialMarking><text>1</text></initialMarking></place>
         <place id='moving'/><place id='human'/>
         <transition id='drive'/><transition id='stop'/><transition id='enter'/>
         <transition id='leave'/>
         <arc id='a1' source='idle' target='drive'/><arc id='a2' source='drive' target='moving'/>
         <arc id='a3' source='moving' target='stop'/><arc id='a4' source='stop' target='idle'/>
         <arc id='a5' source='idle' target='enter'/><arc id='a6' source='enter' target='human'/>
         <arc id='a7' source='human' target='leave'/><arc id='a8' source='leave' target='idle'/>
         {special}
         </page></net></pnml>"
    )
}

fn arc(attributes: &str, content: &str) -> String {
    gate(&format!("<arc id='a9' source='human' target='drive'{attributes}>{content}</arc>"))
}

fn read(text: &str) -> Imported {
    pnml::read_within("gate.pnml", text.as_bytes(), Limits::default())
        .unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

fn refused(text: &str) -> String {
    match pnml::read_within("gate.pnml", text.as_bytes(), Limits::default()) {
        Err(errors) => errors.to_string(),
        Ok(read) => panic!("{read:?} was read of\n{text}"),
    }
}

fn holds(text: &str, asked: &str) -> bool {
    let Imported { net, extras, .. } = read(text);
    let model = Model::from(Pt::extended(&net.view().net(), &extras));
    let asked = parse(asked, model.pt()).unwrap();
    check(&model, &asked, &Options::default()).verdict == Verdict::Holds(true)
}

const HUMAN: PlaceId = PlaceId(2);
const DRIVE: TransitionId = TransitionId(0);

fn inhibits(weight: u32) -> Extras {
    let arc = Arc { place: HUMAN, weight };
    Extras { inhibitors: vec![(DRIVE, arc)], ..Extras::default() }
}

#[test]
fn an_inhibitor_arc_is_read_in_every_spelling() {
    let spelled = [
        ("", "<arctype><text>inhibitor</text></arctype>"),
        ("", "<arctype>inhibitor</arctype>"),
        ("", "<arctype><value>inhibitor</value></arctype>"),
        ("", "<arctype>\n  <text>\n Inhibitor </text>\n</arctype>"),
        ("", "<arcType value='inhibitor'/>"),
        ("", "<type>inhibitor</type>"),
        ("", "<type value='inhibitor'/>"),
        ("", "<type><text>inhibitor</text></type>"),
        ("", "<type><value>INHIBITOR</value></type>"),
        ("", "<type id='inhibitor'/>"),
        ("", "<inhibitor/>"),
        ("", "<inhibitor><value>1</value></inhibitor>"),
        (
            "",
            "<inscription><inhibitor><annotation><value>dot</value></annotation><condition>\
             <expression>True</expression></condition></inhibitor></inscription>",
        ),
        ("", "<inscription><text>1</text></inscription><arctype><text>inhibitor</text></arctype>"),
        ("", "<type value='inhibitor'/><graphics><position x='1' y='2'/></graphics>"),
        ("", "<toolspecific tool='x' version='1'><arcType>inhibitor</arcType></toolspecific>"),
        ("", "<toolspecific tool='x' version='1'><arc kind='inhibitor'/></toolspecific>"),
        (
            "",
            "<toolspecific tool='ProM' version='6'><a><type><text>inhibitor</text></type></a>\
             </toolspecific>",
        ),
        ("", "<toolspecific tool='x' version='1' arcType='inhibitor'/>"),
        ("", "<s:kind xmlns:s='urn:snoopy'>inhibitor</s:kind>"),
        ("", "<s:kind xmlns:s='urn:x' value='inhibitor-arc'/>"),
        (" type='inhibitor'", ""),
        (" type='tapnInhibitor'", ""),
        (" arctype='inhibitor'", ""),
        (" arcType='Inhibitor_Arc'", ""),
        (" kind='inhibitor'", ""),
        (" inhibitor='true'", ""),
        (" inhibitor='1'", "<inscription><text>1</text></inscription>"),
    ];
    for (attributes, content) in spelled {
        let text = arc(attributes, content);
        assert_eq!(read(&text).extras, inhibits(1), "{attributes} {content}");
        assert!(holds(&text, "EF moving"), "{attributes} {content}");
    }
    let elements = [
        "<inhibitorArc id='a9' source='human' target='drive'/>",
        "<inhibitorarc source='human' target='drive'><inscription><text>1</text></inscription>\
         </inhibitorarc>",
        "<x:inhibitorArc xmlns:x='urn:x' id='a9' source='human' target='drive'/>",
        "<arc id='a9' source='human' target='drive' type='inhibitor' inhibitor='true'/>",
    ];
    for element in elements {
        assert_eq!(read(&gate(element)).extras, inhibits(1), "{element}");
    }
}

#[test]
fn the_weight_of_an_inhibitor_arc_is_the_first_number_that_inhibits() {
    let weighted = [
        (3, "<type value='inhibitor'/><inscription><text>3</text></inscription>"),
        (2, "<inscription><value>Default,2</value></inscription><type value='inhibitor'/>"),
        (4, "<inhibitor><value>4</value></inhibitor>"),
        (7, "<arctype>inhibitor</arctype><inscription><text> 7 </text></inscription>"),
        (9, "<inscription><inhibitor><text>9</text></inhibitor></inscription>"),
    ];
    for (weight, content) in weighted {
        assert_eq!(read(&arc("", content)).extras, inhibits(weight), "{content}");
    }
}

#[test]
fn a_reset_arc_is_read_in_every_spelling() {
    let resets = Extras { resets: vec![(DRIVE, HUMAN)], ..Extras::default() };
    let spelled = [
        ("", "<arctype><text>reset</text></arctype>"),
        ("", "<arctype>reset</arctype>"),
        ("", "<type value='reset'/>"),
        ("", "<type>reset</type>"),
        ("", "<reset/>"),
        (" type='reset'", ""),
        (" reset='true'", "<inscription><text>1</text></inscription>"),
    ];
    for (attributes, content) in spelled {
        assert_eq!(read(&arc(attributes, content)).extras, resets, "{attributes} {content}");
    }
    let element = "<resetArc id='a9' source='human' target='drive'/>";
    assert_eq!(read(&gate(element)).extras, resets);
    // Drawn the other way round it empties the same place.
    let back = "<arc id='a9' source='drive' target='human'><arctype>reset</arctype></arc>";
    assert_eq!(read(&gate(back)).extras, resets);
}

#[test]
fn a_read_arc_is_read_in_every_spelling() {
    let spelled = [
        ("", "<arctype><text>read</text></arctype>"),
        ("", "<arctype>test</arctype>"),
        ("", "<type value='read'/>"),
        ("", "<type>test</type>"),
        ("", "<read/>"),
        ("", "<test><value>1</value></test>"),
        (" type='test'", ""),
        (" read='true'", ""),
        (" arctype='readarc'", ""),
    ];
    for (attributes, content) in spelled {
        let Imported { net, extras, .. } = read(&arc(attributes, content));
        assert!(extras.is_empty());
        let drive = &net.transitions[0];
        assert_eq!(drive.read, [Arc { place: HUMAN, weight: 1 }], "{attributes} {content}");
        assert_eq!(drive.take, [Arc { place: PlaceId(0), weight: 1 }]);
    }
}

#[test]
fn ordinary_arcs_are_ordinary_in_every_spelling() {
    let spelled = [
        ("", "<type value='normal'/>"),
        ("", "<arctype><text>normal</text></arctype>"),
        ("", "<arctype/>"),
        ("", "<name><text>an arc</text></name><graphics/>"),
        (
            "",
            "<arcpath id='000' x='1' y='2' curvePoint='false'/><tagged><value>false</value>\
             </tagged>",
        ),
        (" inhibitor='false'", ""),
        (" type='normal'", ""),
        (" name='a name'", ""),
    ];
    for (attributes, content) in spelled {
        let Imported { net, extras, notes, .. } = read(&arc(attributes, content));
        assert!(extras.is_empty() && notes.is_empty(), "{notes:?}");
        assert_eq!(net.transitions[0].take.len(), 2, "{attributes} {content}");
    }
}

#[test]
fn an_arc_of_unknown_kind_is_refused() {
    let unknown = [
        ("", "<type value='flush'/>", "an arc of the kind `flush`"),
        ("", "<arctype><text>equal</text></arctype>", "an arc of the kind `equal`"),
        (" type='transport'", "", "an arc of the kind `transport`"),
        ("", "<threshold><text>3</text></threshold>", "`<threshold>` of an arc"),
        ("", "<negated/>", "`<negated>` of an arc"),
        ("", "<expression><text>x</text></expression>", "`<expression>` of an arc"),
        ("", "<inscription><multiset>3</multiset></inscription>", "`<multiset>` of an arc"),
        (" negated='true'", "", "an attribute `negated`"),
        (" weight='2'", "", "an attribute `weight`"),
        (" inhibitor='maybe'", "", "`maybe` is neither"),
        (" reset=''", "", "`` is neither"),
        ("", "<inhibitor><value>red</value></inhibitor>", "the annotation `red`"),
        ("", "<type value='inhibitor'/><reset/>", "an arc of two kinds"),
        ("", "<type value='reset'/><inscription><text>2</text></inscription>", "of weight 2"),
        ("", "<type value='inhibitor'/><inscription><text>0</text></inscription>", "weight 0"),
    ];
    for (attributes, content, said) in unknown {
        let errors = refused(&arc(attributes, content));
        assert!(errors.contains(said), "{errors}");
        assert!(errors.starts_with("gate.pnml:11:"), "{errors}");
    }
    let back = "<arc id='a9' source='drive' target='human'><type value='inhibitor'/></arc>";
    assert!(refused(&gate(back)).contains("an inhibitor arc from a transition"));
}

#[test]
fn unknown_kinds_of_nodes_and_nets_are_refused() {
    let unknown = [
        ("<flowArc id='a9' source='human' target='drive'/>", "`<flowArc>` of the net"),
        ("<constraint><text>x</text></constraint>", "`<constraint>` of the net"),
        ("<place id='p'><invariant><text>3</text></invariant></place>", "`<invariant>` of a place"),
        ("<place id='p'><initialMarking><multiset/></initialMarking></place>", "of a marking"),
        ("<place id='p' kind='queue'/>", "an attribute `kind`"),
        (
            "<transition id='t'><delay><text>5</text></delay></transition>",
            "`<text>` of a transition",
        ),
        ("<transition id='t'><cost>1</cost></transition>", "`<cost>` of a transition"),
        ("<transition id='t' urgency='high'/>", "an attribute `urgency`"),
    ];
    for (part, said) in unknown {
        let errors = refused(&gate(part));
        assert!(errors.contains(said), "{errors}");
    }
}

#[test]
fn a_guard_over_data_is_refused_unless_it_is_true() {
    for guard in ["", "true", "True"] {
        read(&gate(&format!("<transition id='t' guard='{guard}'/>")));
        read(&gate(&format!(
            "<transition id='t'><guard><text>{guard}</text></guard></transition>"
        )));
    }
    for guard in ["x &gt; 0", "false", "(a == 1)", "amount&lt;=5", "1"] {
        for transition in [
            format!("<transition id='t' guard='{guard}'/>"),
            format!("<transition id='t'><guard><text>{guard}</text></guard></transition>"),
            format!(
                "<transition id='t'><toolspecific tool='ProM' version='6'><guard>{guard}</guard>\
                 </toolspecific></transition>"
            ),
        ] {
            let errors = refused(&gate(&transition));
            assert!(errors.contains("a transition with the guard `"), "{errors}");
        }
    }
}

/// Two ways to go, of which the first has a priority.
fn priorities(first: &str, second: &str, timed: [bool; 2]) -> String {
    let timed = timed.map(|it| format!("<timed><value>{it}</value></timed>"));
    format!(
        "<pnml><net id='n' type='P/T net'><token id='Default' enabled='true'/>
         <place id='low'><initialMarking><value>Default,1</value></initialMarking></place>
         <place id='charging'><initialMarking><value></value></initialMarking></place>
         <place id='flat'><initialMarking><text/></initialMarking></place>
         <transition id='dock'>{}{first}<rate><value>1.0</value></rate></transition>
         <transition id='on'>{}{second}<infiniteServer><value>false</value></infiniteServer>
         </transition>
         <arc id='a' source='low' target='dock'/><arc id='a' source='dock' target='charging'/>
         <arc id='a' source='low' target='on'/><arc id='low' source='on' target='flat'/>
         </net></pnml>",
        timed[0], timed[1]
    )
}

#[test]
fn of_immediate_transitions_those_of_the_highest_priority_fire() {
    let said = |number: u32| format!("<priority><value>{number}</value></priority>");
    let ask =
        |first: &str, second: &str, timed| holds(&priorities(first, second, timed), "AG flat = 0");
    let immediate = [false, false];
    assert!(ask(&said(2), &said(1), immediate));
    assert!(ask(&said(3), "", immediate));
    assert!(!ask(&said(1), &said(2), immediate));
    assert!(!ask(&said(1), &said(1), immediate));
    assert!(!ask("", "", immediate));
    assert!(!ask(&said(1), "", immediate));
    // Immediate transitions go before those with random delays, whatever these say.
    assert!(ask(&said(1), &said(9), [false, true]));
    assert!(ask(&said(0), &said(1), [false, true]));
    assert!(!ask(&said(9), &said(1), [true, true]));
    for wrong in ["high", "-1", "1.5", "4294967296"] {
        let wrong = format!("<priority><value>{wrong}</value></priority>");
        refused(&priorities(&wrong, "", immediate));
    }
}

#[test]
fn a_random_delay_is_told_with_its_place_and_the_way_out() {
    let read = read(&priorities("", "", [true, true]));
    let random = read.random.unwrap().to_string();
    assert!(random.starts_with("gate.pnml:5:"), "{random}");
    assert!(random.contains("--untimed leaves delays out"), "{random}");
    assert!(read.extras.is_empty());
    let text = priorities("", "", [false, true]);
    assert!(pnml::read("gate.pnml", text.as_bytes()).is_err());
}

#[test]
fn an_empty_marking_is_none() {
    for empty in ["<value></value>", "<value/>", "<text></text>", "<text/>", "<text> \n</text>"] {
        let place = format!("<place id='p'><initialMarking>{empty}</initialMarking></place>");
        assert_eq!(read(&gate(&place)).net.places[3].initial, 0, "{empty}");
    }
}

#[test]
fn ids_that_nothing_refers_to_may_be_any() {
    let any = [
        "<arc id='a1' source='human' target='drive'/>",
        "<arc id='human' source='human' target='drive'/>",
        "<arc id='drive' source='human' target='drive'/>",
        "<page id='drive'/>",
        "<page id='a1'><page id='a1'/></page>",
        "<arc id='later' source='human' target='drive'/><place id='later'/>",
        "<page id='later'/><transition id='later'/>\
         <arc id='x' source='human' target='later'/>",
    ];
    for part in any {
        read(&gate(part));
    }
    let later = read(&gate(
        "<page id='t'><place id='p'/></page><transition id='t'/>\
        <arc id='p' source='p' target='t'/>",
    ));
    assert_eq!(later.net.transitions[4].take, [Arc { place: PlaceId(3), weight: 1 }]);
    assert!(refused(&gate("<place id='human'/>")).contains("that of a place already"));
    assert!(refused(&gate("<transition id='human'/>")).contains("that of a place already"));
    assert!(refused(&gate("<arc id='x' source='g' target='drive'/>")).contains("is a page"));
}

#[test]
fn net_types_with_such_arcs_are_read_and_unknown_ones_noted() {
    let typed = |of: &str| read(&gate("").replace("ptnet", of));
    for of in
        ["inhibitorptnet", "resetptnet", "resetinhibitorptnet", "specialarcs", "pnmlcoremodel"]
    {
        assert!(typed(of).notes.is_empty(), "{of}");
    }
    for of in ["http://www.example.org/mynet", "WorkflowNet", "timednet", "x", "gspn"] {
        assert_eq!(typed(of).notes.len(), 1, "{of}");
    }
}

#[test]
fn final_markings_and_parts_of_unknown_tools_are_noted_once() {
    let finals = "<finalmarkings><marking><place idref='human'><text>1</text></place></marking>\
        </finalmarkings>";
    let notes = read(&gate(&finals.repeat(3))).notes;
    assert_eq!(notes.len(), 1);
    assert!(notes[0].contains("in which markings runs are to end"), "{notes:?}");
    let of = |tool: &str| {
        let part = format!("<toolspecific tool='{tool}' version='1'><a>b</a></toolspecific>");
        read(&gate(&format!("<place id='p'>{part}</place><transition id='t'>{part}</transition>")))
            .notes
    };
    assert!(["ProM", "WoPeD", "nupn", "PNML Framework", "Tina"].iter().all(|it| of(it).is_empty()));
    assert_eq!(of("my own"), ["what the tool `my own` adds to the net is left out"]);
}

#[test]
fn labels_that_say_nothing_about_firings_are_left_out() {
    let harmless = [
        "<toolspecific tool='nupn' version='1.1'><size places='3' transitions='4' arcs='8'/>\
         <structure units='1' root='u0' safe='true'><unit id='u0'><places>idle</places><subunits/>\
         </unit></structure></toolspecific>",
        "<page id='h'><name><text>a page</text></name><graphics/>\
         <toolspecific tool='ePNK'/></page>",
        "<name><text>a page</text></name><graphics><position x='1' y='2'/></graphics>",
        "<labels x='1' y='2'>PIPE</labels><token id='Default' enabled='true' red='0'/>",
        "<place id='p'><graphics><offset x='1' y='1'/></graphics><name><text>p</text></name>\
         </place>",
        "<transition id='t'><orientation><value>0</value></orientation>\
         <rate><value>1</value></rate>\
         <infiniteServer><value>false</value></infiniteServer></transition>",
        "<transition id='t' invisible='true'><toolspecific tool='ProM' version='6.4' \
         activity='$invisible$' localNodeID='x'/></transition>",
        "<referencePlace id='r' ref='human'><name><text>r</text></name><toolspecific tool='x'/>\
         </referencePlace>",
        "<transition id='t'><toolspecific tool='WoPeD' version='1.0'><operator id='t' type='101'/>\
         <time>0</time><timeUnit>1</timeUnit><orientation>1</orientation></toolspecific>\
         </transition>",
    ];
    for part in harmless {
        let read = read(&gate(part));
        assert!(read.notes.is_empty() && read.extras.is_empty(), "{part}: {:?}", read.notes);
    }
}

#[test]
fn tapaals_own_format_is_named_once() {
    let files = [
        "<place id='P' initialMarking='1' invariant='&lt; inf' name='P'/>",
        "<place id='P' invariant='&lt; inf'/>",
        "<transition id='T' urgent='false'/>",
        "<arc id='A' source='human' target='drive' type='timed' inscription='[0,inf)'/>",
        "<transportArc source='human' target='drive'/>",
        "<inputArc source='human' target='drive'/>",
    ];
    for part in files {
        let errors = refused(&gate(&part.repeat(50)));
        assert_eq!(errors.matches("TAPAAL").count(), 2, "{errors}");
        assert!(errors.contains("File > Export > PNML"), "{errors}");
    }
}

#[test]
fn a_written_special_net_is_read_again() {
    let (human, drive, stop) = (HUMAN, DRIVE, TransitionId(1));
    let arc = |place, weight| Arc { place, weight };
    let net = read(&gate("")).net;
    for extras in [
        Extras::default(),
        inhibits(1),
        inhibits(5),
        Extras { resets: vec![(drive, human), (stop, PlaceId(0))], ..inhibits(2) },
        Extras { priorities: vec![3, 1, 1, 2], ..Extras::default() },
        Extras {
            inhibitors: vec![(drive, arc(human, 1)), (stop, arc(PlaceId(0), 3))],
            priorities: vec![0, 1, 0, 0],
            resets: vec![(stop, human)],
        },
    ] {
        let text = pnml::write_extended(&net.view().net(), &extras);
        let again = pnml::read_within("again.pnml", text.as_bytes(), Limits::default()).unwrap();
        assert_eq!((&again.net, &again.extras), (&net, &extras), "{text}");
    }
}
