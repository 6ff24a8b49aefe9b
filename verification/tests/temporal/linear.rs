//! Formulas of LTL.

use super::{formula, lamp, replayed};
use crate::properties::oracle::{Space, lasso};
use crate::properties::random::{Random, atom, net, path, state};
use cotama_core::net::TransitionId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::explicit::{Limit, Limits};
use cotama_verification::property::Formula;
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Reason, Rest, Run, Verdict, all_runs, answer, some_runs};

/// Asks about a path in both ways, and compares verdicts and runs; how many markings were met.
fn compare(pt: &Pt, space: &Space<'_>, path: &Formula) -> [bool; 2] {
    let exists = space
        .satisfying(&Formula::Exists(Formula::And(vec![path.clone(), Formula::TRUE]).into()))[0];
    let not = Formula::Not(path.clone().into());
    let counter = space
        .satisfying(&Formula::Exists(Formula::And(vec![not.clone(), Formula::TRUE]).into()))[0];
    let text = || format!("{} on {pt:?}", path.display(pt));
    for (verdict, found, expected, shown) in [
        (some_runs(pt, path, &Limits::default(), &|_| ()), true, exists, path),
        (all_runs(pt, path, &Limits::default(), &|_| ()), false, counter, &not),
    ] {
        let Verdict::Known { holds, run, states } = verdict else {
            panic!("{verdict:?}: {}", text())
        };
        assert_eq!(holds == found, expected, "{}", text());
        assert!(states <= space.markings.len() as u64);
        assert_eq!(run.is_some(), expected);
        if let Some(run) = run {
            let (positions, back) = replayed(space, &run);
            assert!(lasso(space, &positions, back, shown), "{run:?} does not show {}", text());
        }
    }
    [exists, counter]
}

#[test]
fn verdicts_and_lassos_of_formulas_with_next_are_those_of_the_oracle() {
    let (mut random, mut compared, mut found) = (Random(11), 0, 0);
    while compared < 3_000 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let path = path(&mut random, &pt, 2, false);
        if space.markings.len() > 12 || !path.needs_run() {
            continue;
        }
        compared += 1;
        found += compare(&pt, &space, &path).iter().filter(|it| **it).count();
    }
    assert!((2_000..5_000).contains(&found), "{found}");
}

/// A formula without `X`, of few atoms so that transitions are left that it does not see.
fn stuttering(random: &mut Random, atoms: &[Formula], depth: usize) -> Formula {
    if depth == 0 {
        return random.choose(atoms).clone();
    }
    let mut part = || stuttering(random, atoms, depth - 1);
    let (a, b) = (part(), part());
    match random.below(7) {
        0 => Formula::Finally(Formula::Globally(a.into()).into()),
        1 => Formula::Globally(Formula::Finally(a.into()).into()),
        2 => Formula::Until(a.into(), b.into()),
        3 => Formula::Globally(a.into()),
        4 => Formula::Finally(a.into()),
        5 => Formula::Or(vec![Formula::Not(a.into()), b]),
        _ => Formula::And(vec![a, b]),
    }
}

/// Several small nets side by side, so that much of one makes no difference to the others.
pub(crate) fn side_by_side(random: &mut Random) -> Pt {
    let mut all = OwnedNet::new("all", "");
    for part in 0..2 + random.below(2) {
        let places: Vec<_> = (0..2 + random.below(2))
            .map(|at| {
                all.place(OwnedPlace::new(&format!("{part}.{at}"), u32::from(at == 0))).unwrap()
            })
            .collect();
        for at in 0..=random.below(3) {
            let (from, to) = (*random.choose(&places), *random.choose(&places));
            let mut transition = OwnedTransition::new(&format!("{part}:{at}")).take(from, 1);
            if random.below(5) > 0 {
                transition = transition.give(to, 1);
            }
            if random.below(4) == 0 && part > 0 {
                transition = transition.read(cotama_core::net::PlaceId(0), 1);
            }
            all.transition(transition).unwrap();
        }
    }
    Pt::from(&all.view().net())
}

#[test]
fn verdicts_and_lassos_of_formulas_without_next_are_those_of_the_oracle() {
    let (mut random, mut compared, mut found) = (Random(12), 0, 0);
    while compared < 3_000 {
        let pt = if compared % 3 == 0 { net(&mut random) } else { side_by_side(&mut random) };
        let space = Space::new(&pt);
        let atoms = [atom(&mut random, &pt), state(&mut random, &pt, 1)];
        let path = stuttering(&mut random, &atoms, 2);
        if space.markings.len() > 12 || !path.needs_run() {
            continue;
        }
        compared += 1;
        found += compare(&pt, &space, &path).iter().filter(|it| **it).count();
    }
    assert!((2_000..5_500).contains(&found), "{found}");
}

#[test]
fn a_lamp_that_fails_stays_dark() {
    let pt = lamp();
    let said = formula(&pt, "A (G F off)");
    let run = Run { stem: vec![TransitionId(0), TransitionId(2)], rest: Rest::Stays };
    assert_eq!(
        answer(&pt, &said, &Limits::default(), &|_| ()),
        Verdict::Known { holds: false, run: Some(run), states: 3 }
    );
}

#[test]
fn a_loop_is_as_short_as_it_can_be() {
    let pt = lamp();
    let Formula::All(path) = formula(&pt, "A (G F on & G F off)") else { panic!("not A") };
    let verdict = some_runs(&pt, &path, &Limits::default(), &|_| ());
    let Verdict::Known { holds: true, run: Some(run), .. } = verdict else { panic!("{verdict:?}") };
    assert_eq!(run.stem, []);
    assert_eq!(run.rest, Rest::Cycle(vec![TransitionId(0), TransitionId(1)]));
}

#[test]
fn independent_transitions_are_not_followed_without_need() {
    let mut net = OwnedNet::new("lamp and chains", "");
    let [off, on] =
        ["off", "on"].map(|it| net.place(OwnedPlace::new(it, u32::from(it == "off"))).unwrap());
    net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
    net.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
    for chain in 0..8 {
        let [a, b, c] = [0, 1, 2].map(|at| {
            net.place(OwnedPlace::new(&format!("{chain}.{at}"), u32::from(at == 0))).unwrap()
        });
        net.transition(OwnedTransition::new(&format!("{chain}:0")).take(a, 1).give(b, 1)).unwrap();
        net.transition(OwnedTransition::new(&format!("{chain}:1")).take(b, 1).give(c, 1)).unwrap();
    }
    let pt = Pt::from(&net.view().net());
    let said = formula(&pt, "A (F G on | G F off)");
    let verdict = answer(&pt, &said, &Limits::default(), &|_| ());
    assert_eq!(verdict, Verdict::Known { holds: true, run: None, states: 18 });
    // `X` sees every firing.
    let said = formula(&pt, "A (F G on | G F X off)");
    let verdict = answer(&pt, &said, &Limits::default(), &|_| ());
    assert_eq!(verdict, Verdict::Known { holds: true, run: None, states: 2 * 3_u64.pow(8) });
}

#[test]
fn a_firing_that_is_not_seen_does_not_hide_a_seen_one_that_it_competes_with() {
    let mut net = OwnedNet::new("fork", "One of two ways, and something else.");
    let [fork, left, right, idle, done] = ["fork", "left", "right", "idle", "done"].map(|it| {
        net.place(OwnedPlace::new(it, u32::from(matches!(it, "fork" | "idle")))).unwrap()
    });
    net.transition(OwnedTransition::new("go left").take(fork, 1).give(left, 1)).unwrap();
    net.transition(OwnedTransition::new("go right").take(fork, 1).give(right, 1)).unwrap();
    net.transition(OwnedTransition::new("finish").take(idle, 1).give(done, 1)).unwrap();
    let pt = Pt::from(&net.view().net());
    // Only the left one of the two paths is seen, and it can come after `finish`.
    let Formula::Exists(path) = formula(&pt, "E (F ({done} & !{left} & F {left}))") else {
        panic!("not E")
    };
    let verdict = some_runs(&pt, &path, &Limits::default(), &|_| ());
    assert!(matches!(verdict, Verdict::Known { holds: true, .. }), "{verdict:?}");
}

#[test]
fn a_promise_kept_on_an_inner_cycle_is_kept_on_the_outer_one() {
    let mut net = OwnedNet::new("stairs", "Up and down again, once or often.");
    let [low, middle, high] = ["low", "middle", "high"]
        .map(|it| net.place(OwnedPlace::new(it, u32::from(it == "low"))).unwrap());
    for (name, from, to) in
        [("up", low, middle), ("on", middle, high), ("off", high, middle), ("down", middle, low)]
    {
        net.transition(OwnedTransition::new(name).take(from, 1).give(to, 1)).unwrap();
    }
    let pt = Pt::from(&net.view().net());
    let verdict = answer(&pt, &formula(&pt, "E (G F low & G F high)"), &Limits::default(), &|_| ());
    assert!(matches!(verdict, Verdict::Known { holds: true, .. }), "{verdict:?}");
}

/// A source that fills a place.
fn fountain() -> Pt {
    let mut net = OwnedNet::new("fountain", "");
    let basin = net.place(OwnedPlace::new("basin", 0)).unwrap();
    let spout = net.place(OwnedPlace::new("spout", 1)).unwrap();
    net.transition(OwnedTransition::new("pour").read(spout, 1).give(basin, 1)).unwrap();
    Pt::from(&net.view().net())
}

#[test]
fn an_unbounded_net_is_followed_as_far_as_the_formula_asks() {
    let verdict = answer(
        &fountain(),
        &formula(&fountain(), "A (F basin >= 300)"),
        &Limits::default(),
        &|_| (),
    );
    assert_eq!(verdict, Verdict::Known { holds: true, run: None, states: 301 });
    let verdict = answer(
        &fountain(),
        &formula(&fountain(), "A (G basin <= 300)"),
        &Limits::default(),
        &|_| (),
    );
    let run = Run { stem: vec![TransitionId(0); 301], rest: Rest::Any };
    assert_eq!(verdict, Verdict::Known { holds: false, run: Some(run), states: 302 });
}

#[test]
fn a_way_to_a_loop_does_not_end_elsewhere() {
    let mut net = OwnedNet::new("lake", "A way round a lake, and into it.");
    let [start, shore, near, far, lake] = ["start", "shore", "near", "far", "lake"]
        .map(|it| net.place(OwnedPlace::new(it, u32::from(it == "start"))).unwrap());
    for (name, from, to) in [
        ("walk", start, shore),
        ("come", shore, near),
        ("fall", near, lake),
        ("go", near, far),
        ("back", far, near),
        ("jump", start, lake),
    ] {
        net.transition(OwnedTransition::new(name).take(from, 1).give(to, 1)).unwrap();
    }
    let pt = Pt::from(&net.view().net());
    let said = formula(&pt, "E (G F near)");
    let verdict = answer(&pt, &said, &Limits::default(), &|_| ());
    let run = Run {
        stem: [0, 1].map(TransitionId).to_vec(),
        rest: Rest::Cycle([3, 4].map(TransitionId).to_vec()),
    };
    assert_eq!(verdict, Verdict::Known { holds: true, run: Some(run), states: 5 });
}

#[test]
fn a_loop_that_begins_as_it_ends_is_told_whole() {
    let mut net = OwnedNet::new("pair", "");
    let [p, q] = ["p", "q"].map(|it| net.place(OwnedPlace::new(it, 1)).unwrap());
    net.transition(OwnedTransition::new("one").take(p, 1).give(q, 1)).unwrap();
    net.transition(OwnedTransition::new("both").take(q, 2).give(p, 2)).unwrap();
    let pt = Pt::from(&net.view().net());
    let said = formula(&pt, "E (G p <= 2)");
    let verdict = answer(&pt, &said, &Limits::default(), &|_| ());
    let rest = Rest::Cycle([0, 1, 0].map(TransitionId).to_vec());
    let run = Some(Run { stem: Vec::new(), rest });
    assert_eq!(verdict, Verdict::Known { holds: true, run, states: 3 });
}

/// Two ways out of the middle and back.
pub(super) fn crossing() -> Pt {
    let mut crossing = OwnedNet::new("crossing", "");
    let [middle, left, right] = [("middle", 1), ("left", 0), ("right", 0)]
        .map(|it| crossing.place(OwnedPlace::new(it.0, it.1)).unwrap());
    for (name, from, to) in [
        ("go_left", middle, left),
        ("from_left", left, middle),
        ("go_right", middle, right),
        ("from_right", right, middle),
    ] {
        crossing.transition(OwnedTransition::new(name).take(from, 1).give(to, 1)).unwrap();
    }
    Pt::from(&crossing.view().net())
}

#[test]
fn a_loop_keeps_all_promises() {
    let crossing = crossing();
    let path = "(G F left >= 1) & (G F right >= 1)";
    let said = formula(&crossing, &format!("E ({path})"));
    let verdict = answer(&crossing, &said, &Limits::default(), &|_| ());
    let Verdict::Known { holds: true, run: Some(Run { rest: Rest::Cycle(mut cycle), .. }), .. } =
        verdict
    else {
        panic!("{verdict:?}")
    };
    cycle.sort();
    assert_eq!(cycle, [0, 1, 2, 3].map(TransitionId));
}

#[test]
fn limits_are_answers() {
    let limits = Limits { states: 50, ..Limits::default() };
    let unknown = |limit: Limit, states| Verdict::Unknown { reason: Reason::Limit(limit), states };
    let said = formula(&fountain(), "A (F G basin <= 0)");
    assert_eq!(answer(&fountain(), &said, &limits, &|_| ()), unknown(Limit::States, 50));
    let limits = Limits { deadline: Some(std::time::Instant::now()), ..Limits::default() };
    let Verdict::Unknown { reason: Reason::Limit(Limit::Time), states } =
        answer(&fountain(), &said, &limits, &|_| ())
    else {
        panic!("no limit")
    };
    assert!(states < 300);
    let limits = Limits { bytes: 50_000, ..Limits::default() };
    let Verdict::Unknown { reason: Reason::Limit(Limit::Bytes), states } =
        answer(&fountain(), &said, &limits, &|_| ())
    else {
        panic!("no limit")
    };
    assert!((260..285).contains(&states), "{states}");
}

#[test]
fn a_formula_with_too_many_promises_is_refused() {
    let pt = lamp();
    let place = |at: i64| {
        Formula::Atom(cotama_verification::property::Atom::AtMost(
            cotama_verification::property::Linear {
                constant: -at,
                weights: vec![(cotama_core::net::PlaceId(0), 1)],
            },
        ))
    };
    let path = Formula::And((0..200).map(|at| Formula::Finally(place(at).into())).collect());
    let verdict = some_runs(&pt, &path, &Limits::default(), &|_| ());
    assert_eq!(verdict, Verdict::Unknown { reason: Reason::Formula, states: 0 });
    let twice = Formula::And((0..2).map(|at| Formula::Finally(place(at).into())).collect());
    let nested = Formula::Exists(Formula::Globally(Formula::Exists(twice.into()).into()).into());
    let verdict = answer(&pt, &nested, &Limits::default(), &|_| ());
    assert_eq!(verdict, Verdict::Unknown { reason: Reason::Kind, states: 0 });
}
