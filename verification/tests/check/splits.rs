//! Atomic classes: splitting them, and what leads where when they are split.

use super::timed_logic::{answers, reachable, space};
use crate::properties::random::Random;
use crate::tpn::regions::regions;
use cotama_verification::check::Verdict;
use cotama_verification::property::Question;
use cotama_verification::{assert_holds, tina};

/// Places that are opened after some time, and transitions that wait for some of them and for one
/// token.
fn gates(random: &mut Random) -> String {
    let interval = |random: &mut Random| {
        let lower = random.below(4);
        format!("[{lower},{}]", lower + random.below(4))
    };
    let mut net = vec!["pl a (1)".to_owned()];
    for gate in 0..2 {
        let latest = 1 + random.below(4);
        net.push(format!("pl s{gate} (1) tr open{gate} [0,{latest}] s{gate} -> r{gate}"));
    }
    for way in 0..3 {
        let interval = interval(random);
        let arcs = [0, 1].map(|gate| match random.below(3) {
            0 => String::new(),
            1 => format!(" r{gate}"),
            _ => format!(" r{gate}?1"),
        });
        net.push(format!("tr way{way} {interval} a{} -> b{way}", arcs.concat()));
    }
    net.push(format!(
        "tr on {} b0 r0?1 -> c tr out {} b0 -> d",
        interval(random),
        interval(random)
    ));
    net.join(" ")
}

#[test]
fn classes_are_split_as_often_as_needed() {
    let mut random = Random(77);
    for _ in 0..8 {
        let net = tina::read("gates.net", gates(&mut random).as_bytes()).unwrap();
        let (pt, instants) = (net.untimed(), regions(&net, 20_000, 3).unwrap().instants());
        let space = space(&pt, &instants);
        let asked: Vec<_> =
            (0..20).map(|it| Question::Formula(reachable(&mut random, &pt, 1 + it % 3))).collect();
        for (question, found) in asked.iter().zip(answers(&net, &asked)) {
            let Question::Formula(said) = question else { unreachable!() };
            let text = || format!("{}\n{}", question.display(&pt), tina::write(&net));
            assert_eq!(found.verdict, Verdict::Holds(space.satisfying(said)[0]), "{}", text());
        }
    }
}

#[test]
fn a_class_is_split_where_another_transition_may_not_wait_as_long() {
    // At `open` the clock of `slow` shows up to 3; it is the first one if it shows 2 or more.
    let net = |slow: &str| {
        let net = format!(
            "pl s (1) pl a (1) tr open [0,3] s -> r tr fast [1,1] a r -> b tr slow {slow} a -> d"
        );
        tina::read("gate.net", net.as_bytes()).unwrap()
    };
    assert_holds!(net("[3,4]"), "EX (r & AX b)", "EX (r & EX d)", "AG (r & a -> EX b)");
    // If it may not wait either, `fast` is the first one below 2 alone.
    assert_holds!(net("[3,3]"), "EX (r & AX b)", "EX (r & EX b & EX d)", "EX (r & AX d)");
}

#[test]
fn parts_of_a_class_are_split_too() {
    // After `open` at 2 alone `slow` is as fast as `fast` when `ring` has fired.
    let net = b"pl s (1) pl a (1) pl w (1) tr open [0,3] s -> r tr fast [1,1] a r -> b
        tr slow [3,3] a -> d tr ring [2,2] w -> v";
    let net = tina::read("bell.net", net).unwrap();
    assert_holds!(
        net,
        "EX (r & w & AX (v & EX d))",
        "EX (r & w & AX (v & AX b))",
        "EX (r & w & AX b)",
        "EX (r & w & EX b & EX v)"
    );
}

#[test]
fn a_predecessor_of_a_split_class_is_examined_again() {
    let gates = |s0: u32, s1: u32, ways: &str| {
        let doors = format!("tr open0 [0,{s0}] s0 -> r0 tr open1 [0,{s1}] s1 -> r1");
        let net = format!("pl a (1) pl s0 (1) pl s1 (1) {doors} {ways}");
        tina::read("gates.net", net.as_bytes()).unwrap()
    };
    let net = gates(
        2,
        3,
        "tr way0 [3,4] a r1 r0?1 -> b0  tr way1 [3,4] a -> b1  tr way2 [3,3] a r1 r0?1 -> b2
        tr on [3,4] b0 r0?1 -> c  tr out [1,2] b0 -> d",
    );
    assert_holds!(net, "EF (AX (AX r1 & AX r0) & EX (EX deadlock & EX r0))");
    // The rest of a class may be several parts.
    let net = gates(
        3,
        4,
        "tr way0 [2,5] a r0?1 -> b0  tr way1 [1,2] a r0 r1?1 -> b1  tr way2 [3,3] a -> b2
        tr on [2,5] b0 r0?1 -> c  tr out [0,0] b0 -> d",
    );
    assert_holds!(net, "!EF (AX fireable(open1, on) & EX b2)");
    // A clock that starts anew shows zero.
    let net = gates(
        3,
        3,
        "tr way0 [3,5] a -> b0  tr way1 [2,2] a r0 r1?1 -> b1  tr way2 [2,2] a r0?1 -> b2
        tr on [0,3] b0 r0?1 -> c  tr out [3,3] b0 -> d",
    );
    let (near, far) = ("r0 + 3 * s1 + 3 * b0 + 3 * b1 + d + 2", "2 * s0 + 2 * r1 + b2 + 2 * c");
    let said = format!("!EF (EX (AX r0 & AX fireable(on)) & EX (EX r0 & AX {near} <= {far}))");
    assert_holds!(net, &said);
}

#[test]
fn transitions_from_class_to_class_are_all_there_in_their_order() {
    let twice = b"tr one [1,2] a -> b  tr two [1,2] a -> b  tr back [1,1] b -> a  pl a (1)";
    assert_holds!(tina::read("twice.net", twice).unwrap(), "live");
    // `on` leads to a later class than `back`.
    let net = b"tr go [1,1] p -> q  tr jump [1,1] p -> r  tr on [1,1] q -> r
        tr back [1,1] q -> p  tr again [1,1] r -> p  pl p (1)";
    let net = tina::read("triangle.net", net).unwrap();
    assert_holds!(
        net,
        "EG EX true assuming often(q), strong(on)",
        "AG AF r assuming strong(on)",
        "!AG AF r assuming weak(on)"
    );
}

#[test]
fn a_transition_that_leads_to_several_classes_fires_fairly_whichever_is_met() {
    // `open` leads to a class from which `fast` is the first, and to one from which `slow` is.
    let net = b"tr open [0,3] s -> r  tr fast [1,1] a r -> b  tr slow [4,5] a -> d
        tr back [1,1] b -> a s  tr return [1,1] d r -> a s  pl a (1)  pl s (1)";
    let net = tina::read("gate.net", net).unwrap();
    assert_holds!(
        net,
        "EG !(r & AX b) assuming strong(open)",
        "EG !(r & EX d) assuming strong(open)"
    );
}
