//! Files that are read, and written again.

use crate::tpn::{folder, net};
use cotama_core::net::{Arc, PlaceId};
use cotama_verification::tina::{self, Limits};
use cotama_verification::tpn::{Interval, TimeNet, TimePlace, TimeTransition};
use proptest::prelude::*;

fn arcs(arcs: &[(u32, u32)]) -> Vec<Arc> {
    arcs.iter().map(|&(place, weight)| Arc { place: PlaceId(place), weight }).collect()
}

#[test]
fn all_that_the_format_has_is_read() {
    let net = net("# a comment\n\
                   net {a net}\n\
                   pl a : {first \\{one\\}} (2K)\n\
                   tr t : go ]2,5[ a*3 {b c}?2 -> d a*1K # to the end of the line\n\
                   tr u [4,w[ d\n\t->\n\
                   tr source -> a\n\
                   nt note 1 {read and not kept}\n\
                   tr never\n\
                   pl e");
    assert_eq!(net.name(), "a net");
    let names: Vec<_> = net.places().iter().map(|it| (it.name.as_str(), it.initial)).collect();
    assert_eq!(names, [("a", 2_000), ("b c", 0), ("d", 0), ("e", 0)]);
    assert_eq!(net.places()[0].label.as_deref(), Some("first {one}"));
    let t = &net.transitions()[0];
    assert_eq!((t.name.as_str(), t.label.as_deref()), ("t", Some("go")));
    assert_eq!(
        (&t.take, &t.read, &t.give),
        (&arcs(&[(0, 3)]), &arcs(&[(1, 2)]), &arcs(&[(0, 1_000), (2, 1)]))
    );
    let intervals: Vec<_> = net.transitions().iter().map(|it| it.interval.to_string()).collect();
    assert_eq!(intervals, ["]2,5[", "[4,w[", "[0,w[", "[0,w["]);
    assert_eq!(net.transitions()[3], TimeTransition::new("never"));
}

#[test]
fn every_bracket_has_its_usual_meaning() {
    let interval = |text: &str| net(&format!("tr t {text} ->")).transitions()[0].interval;
    assert_eq!(interval("[2,5]"), Interval::closed(2, 5));
    assert_eq!(interval("]2,5]"), Interval { lower_strict: true, ..Interval::closed(2, 5) });
    assert_eq!(interval("[2,5["), Interval { upper_strict: true, ..Interval::closed(2, 5) });
    assert_eq!(interval("]2,w["), Interval { lower_strict: true, ..Interval::at_least(2) });
    assert_eq!(interval("[ 0 , 0 ]"), Interval::NOW);
    assert_eq!(interval(""), Interval::ANY);
}

#[test]
fn declarations_of_one_node_add_up() {
    let net = net(
        "tr t [0,8] a -> b  pl a (1)  tr t : late ]3,9] a b -> b*2  pl a : place (2)  pl {a} (3)",
    );
    assert_eq!(net.places().len(), 2);
    assert_eq!(
        net.places()[0],
        TimePlace { name: "a".into(), label: Some("place".into()), initial: 6 }
    );
    let t = &net.transitions()[0];
    assert_eq!(t.interval.to_string(), "]3,8]");
    assert_eq!(
        (&t.take, &t.give, t.label.as_deref()),
        (&arcs(&[(0, 2), (1, 1)]), &arcs(&[(1, 3)]), Some("late"))
    );
}

#[test]
fn keywords_are_names_in_braces_only() {
    let net = net("tr {tr} {pl} -> {net}\npl w tr w' w -> 1a");
    let places: Vec<_> = net.places().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(places, ["pl", "net", "w", "1a"]);
    assert_eq!(net.transition("tr").map(|it| it.0), Some(0));
}

#[test]
fn an_empty_file_is_an_empty_net() {
    assert_eq!(net(""), TimeNet::default());
    assert_eq!(net("# nothing"), TimeNet::default());
    assert_eq!(tina::write(&TimeNet::default()), "");
}

#[test]
fn a_net_is_written_in_one_way() {
    let net = net(
        "tr t : {a label} ]2,w[ {b c}?1 a*2 -> {b c} {\\\\}*3 pl a (2) tr {net} [0,0] -> net n",
    );
    assert_eq!(
        tina::write(&net),
        "net n\n\
         pl {b c}\n\
         pl a (2)\n\
         pl {\\\\}\n\
         tr t : {a label} ]2,w[ a*2 {b c}?1 -> {b c} {\\\\}*3\n\
         tr {net} [0,0] ->\n"
    );
}

#[test]
fn limits_are_kept() {
    let usual = Limits::default();
    let read = |limits| tina::read_within("n.net", b"pl long_name tr t long_name -> a", limits);
    assert!(read(usual).is_ok());
    let refusal = |limits| read(limits).unwrap_err().to_string();
    assert_eq!(
        refusal(Limits { bytes: 10, ..usual }),
        "n.net:1:1: the file has 32 bytes, more than 10\n  help: raise the limit, or make the net \
         smaller"
    );
    assert_eq!(refusal(Limits { name: 8, ..usual }), "n.net:1:4: a name is longer than 8 bytes");
    assert_eq!(
        refusal(Limits { objects: 4, ..usual }),
        "n.net:1:32: the net has more than 4 parts"
    );
    assert!(read(Limits { objects: 5, ..usual }).is_ok());
}

#[test]
fn known_nets_survive_being_written() {
    let Some(folder) = folder("what is written of them") else { return };
    let mut nets = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|it| it == "net") {
            let read = net(&std::fs::read_to_string(&path).unwrap());
            assert_eq!(net(&tina::write(&read)), read, "{path:?}");
            nets += 1;
        }
    }
    assert_eq!(nets, 17);
}

fn interval() -> impl Strategy<Value = Interval> {
    let bound = || prop_oneof![0..9_u64, Just(Interval::LARGEST)];
    (bound(), any::<bool>(), proptest::option::of(bound()), any::<bool>())
        .prop_map(|(lower, lower_strict, upper, upper_strict)| Interval {
            lower,
            lower_strict,
            upper,
            upper_strict: upper_strict || upper.is_none(),
        })
        .prop_filter("not empty", |it| !it.is_empty())
}

fn nets() -> impl Strategy<Value = TimeNet> {
    let label = || proptest::option::of("\\PC{0,6}");
    let arcs = || proptest::collection::vec((0..4_u32, 1..4_u32), 0..3).prop_map(|it| arcs(&it));
    let names = || proptest::collection::hash_set("\\PC{0,3}|[a-z]{2}", 4..5);
    let transition = (label(), interval(), arcs(), arcs(), arcs());
    let places = (names(), proptest::collection::vec((label(), any::<u32>()), 4));
    (any::<String>(), places, names(), proptest::collection::vec(transition, 4)).prop_map(
        |(name, (place_names, places), names, transitions)| {
            let place = |(name, (label, initial))| TimePlace { name, label, initial };
            let transition = |(name, (label, interval, take, read, give))| TimeTransition {
                name,
                label,
                interval,
                take,
                read,
                give,
            };
            let places = place_names.into_iter().zip(places).map(place).collect();
            TimeNet::new(name, places, names.into_iter().zip(transitions).map(transition).collect())
                .unwrap()
        },
    )
}

proptest! {
    #[test]
    fn a_written_net_reads_as_the_same_net(net in nets()) {
        prop_assert_eq!(tina::read("n.net", tina::write(&net).as_bytes()), Ok(net));
    }

    #[test]
    fn no_text_makes_the_reader_fail_other_than_with_an_error(
        text in "((pl|tr|net|nt|a|b|7|7K|\\{x|\\}|\\\\|:|->|[\\[\\],*?!()-]|[0-9]{1,20}|w|#|\n| \
            |\\PC) ?){0,30}",
    ) {
        if let Err(error) = tina::read("n.net", text.as_bytes()) {
            prop_assert!(error.line <= 1 + text.matches('\n').count());
        }
    }

    #[test]
    fn no_bytes_do_either(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
        let _ = tina::read("n.net", &bytes);
    }
}
