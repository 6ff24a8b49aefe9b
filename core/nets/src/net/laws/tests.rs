//! How zones are divided where a law asks for the future of each of their points: no verdict tells.

use super::cuts::Cuts;
use super::graph::Graph;
use crate::net::PlaceId;
use crate::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use crate::player::Packed;
use std::format;
use std::string::String;

#[allow(unreachable_pub)] // tests outside of the library read it too
#[path = "../../../../tests/common/draw.rs"]
mod draw;

use draw::Draw;

/// An interval of some milliseconds, mostly of one.
fn some(draw: &mut Draw, it: OwnedTransition) -> OwnedTransition {
    let earliest = draw.between(1, 9) as u32;
    let more = [0, 0, 1, 2][draw.between(0, 3) as usize];
    let open = draw.between(0, 7) == 0;
    it.within(earliest, (!open).then_some(earliest + more))
}

/// A job that takes some time and is aborted now and then, or two timers that begin apart: what
/// comes first depends on differences of clocks. In some nets more of it takes time.
fn timers(draw: &mut Draw) -> OwnedNet {
    let mut net = OwnedNet::new("timers", "");
    let [go, back] = ["go", "back"].map(|it| net.event(it, "").unwrap());
    let mut place = |name, tokens| net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap();
    let [a, b, c] = [("A", 1), ("B", 0), ("C", 0)].map(|it| place(it.0, it.1));
    let [waits, over, mark] = [("Waits", 1), ("Over", 0), ("Mark", 0)].map(|it| place(it.0, it.1));
    let step = |name: &str, from: PlaceId, to: PlaceId| {
        OwnedTransition::new(name).take(from, 1).give(to, 1)
    };
    let mut all = if draw.between(0, 1) == 0 {
        std::vec![
            some(draw, step("ends", b, c)),
            some(draw, step("tick", waits, over)),
            step("abort", b, a).take(over, 1).give(waits, 1),
            step("renew", over, waits),
            step("go", a, b).on(go),
            step("back", c, a).on(back),
        ]
    } else {
        std::vec![
            some(draw, OwnedTransition::new("unmark").take(mark, 1)),
            some(draw, step("tick", waits, waits).give(mark, 1)),
            step("begin", a, b).on(go),
            some(draw, step("other", b, over)),
            step("hit", over, c).read(mark, 1),
            step("miss", over, b),
        ]
    };
    if draw.between(0, 2) == 0 {
        all.push(some(draw, step("late", c, a)));
    }
    if draw.between(0, 3) == 0 {
        all.push(some(draw, step("asked", b, a).on(back)));
    }
    // Events on the same side of an instant keep their order.
    for last in (1..all.len()).rev() {
        if draw.between(0, 2) == 0 {
            all.swap(last, draw.between(0, last as u64) as usize);
        }
    }
    net.transitions = all;
    net
}

#[test]
fn two_thousand_drawn_nets_divide_zones_into_105497_classes() {
    // Graphs are large, and live on the stack.
    let thread = std::thread::Builder::new().stack_size(64 << 20).spawn(divided);
    let said = thread.unwrap().join().unwrap();
    assert_eq!(said, "2032 rounds, 105497 classes, 8111 cuts, 4414 open");
}

/// Counts how often zones are divided for the laws of drawn nets.
fn divided() -> String {
    let mut draw = Draw::new(131);
    let (mut rounds, mut classes, mut cut, mut open) = (0, 0, 0, 0);
    for _ in 0..2_000 {
        let owned = timers(&mut draw);
        let view = owned.view();
        let net = view.net();
        let packed = Packed::<1, 7>::alone(&net).unwrap();
        let code = packed.code();
        let first = Graph::of(&net, &code);
        if first.limit.is_some() || first.overflow.is_some() {
            continue;
        }
        for place in 0..net.places.len() as u32 {
            let (mut graph, mut cuts) = (first, Cuts::NONE);
            for _ in 0..6 {
                let surely = graph.leading(&code, PlaceId(place), true);
                if graph.left_out(&surely).is_none() {
                    break;
                }
                open += 1;
                if !graph.refine(&surely, &mut cuts) || cuts.full {
                    break;
                }
                graph = Graph::with(&net, &code, &cuts);
                rounds += 1;
                classes += graph.classes();
                if graph.limit.is_some() || graph.overflow.is_some() {
                    break;
                }
            }
            cut += cuts.count();
        }
    }
    format!("{rounds} rounds, {classes} classes, {cut} cuts, {open} open")
}
