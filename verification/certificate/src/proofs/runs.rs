//! Runs that go on for ever, and sums of tokens that grow without end.

use super::{Small, accepts, few, pt};
use crate::{Evidence, Formula, Question};
use cotama_property::pt::Pt;

/// Any transitions, so many at most.
fn any_firings(most: u8) -> Vec<u32> {
    let length = few::<2>();
    kani::assume(length <= most);
    (0..length).map(|_| u32::from(few::<1>())).collect()
}

/// The markings before each firing, and the one after all of them.
fn path(small: &Small, from: [u32; 2], fire: &[u32]) -> Option<Vec<[u32; 2]>> {
    let mut all = vec![from];
    for &at in fire {
        all.push(small.fire(*all.last()?, at as usize)?);
    }
    Some(all)
}

fn named(place: &str) -> Vec<String> {
    vec![place.to_string()]
}

/// A lasso is accepted exactly when it is a run of the net, which returns to where its loop began
/// or stays where nothing fires, and of which the formula is true, or false, as claimed.
#[kani::proof]
#[kani::unwind(5)]
pub fn a_run_is_shown_by_itself() {
    let (small, verdict) = (Small::any(), kani::any());
    kani::assume(small.initial == [2, 0] && small.give[1][1] == 0);
    let (stem, cycle) = (any_firings(1), any_firings(2));
    // The truth in each marking: those of the stem, then those of the loop.
    let run = path(&small, small.initial, &stem).and_then(|mut before| {
        let start = before.pop()?;
        let mut round = path(&small, start, &cycle)?;
        let end = round.pop()?;
        let stays = cycle.is_empty() && [0, 1].iter().all(|it| small.fire(end, *it).is_none());
        if cycle.is_empty() {
            round.push(end);
        }
        (start == end && (stays || !cycle.is_empty())).then_some((before, round))
    });
    let (a, b) = (Formula::at_least(1, &named("a")), Formula::at_least(1, &named("b")));
    let (b, always) = (Box::new(b), |it| Formula::Globally(Box::new(it)));
    let asked = few::<2>();
    let path = match asked {
        0 => always(*b),
        1 => always(Formula::Finally(b)),
        2 => Formula::Until(Box::new((a, *b))),
        _ => Formula::Next(b),
    };
    let truth = |(before, round): &(Vec<[u32; 2]>, Vec<[u32; 2]>)| {
        let all: Vec<_> = before.iter().chain(round).chain(&round[..1]).collect();
        match asked {
            0 => all.iter().all(|it| it[1] >= 1),
            1 => round.iter().any(|it| it[1] >= 1),
            2 => all.iter().find(|it| it[1] >= 1 || it[0] == 0).is_some_and(|it| it[1] >= 1),
            _ => all[1][1] >= 1,
        }
    };
    let path = Box::new(path);
    let formula = if verdict { Formula::Exists(path) } else { Formula::All(path) };
    let pt = pt(&small);
    let evidence = Evidence::lasso(&pt, &stem, &cycle);
    let said = accepts(&pt, Question::Formula(formula), verdict, evidence);
    assert!(said == run.as_ref().is_some_and(|it| truth(it) == verdict));
    kani::cover!(said && stem.len() == 1 && cycle.len() == 2 && asked == 1, "now and then");
    kani::cover!(said && cycle.is_empty() && asked == 3, "a deadlock lasts");
    kani::cover!(!said && run.is_some(), "of another run");
}

/// The most tokens that places hold together in markings where none holds more than ten.
fn most(small: &Small, of: [bool; 2]) -> u32 {
    let (mut all, mut next, mut most) = (vec![small.initial], 0, 0);
    while let Some(&marking) = all.get(next) {
        next += 1;
        most = most.max((0..2).filter(|it| of[*it]).map(|it| marking[it]).sum());
        for after in [0, 1].into_iter().filter_map(|it| small.fire(marking, it)) {
            if after.iter().all(|it| *it <= 10) && !all.contains(&after) {
                all.push(after);
            }
        }
    }
    most
}

/// Growth is accepted exactly when the stem can fire, and then again and again the pump, each time
/// with more tokens where asked; and then the net does come to more and more of them.
#[kani::proof]
#[kani::unwind(12)]
pub fn growth_is_without_end() {
    let small = Small::any();
    kani::assume(small.initial == [2, 0]);
    let (stem, pump) = (any_firings(1), any_firings(2));
    let of = [[true, false], [false, true], [true, true]][usize::from(few::<2>()) % 3];
    let sum = |it: [u32; 2]| (0..2).filter(|at| of[*at]).map(|at| it[at]).sum::<u32>();
    let before = path(&small, small.initial, &stem).and_then(|it| it.last().copied());
    // No net here needs more than two tokens: what fires ten times with more each time goes on.
    let grows = before.is_some_and(|before| {
        let rounds = (0..10).try_fold(before, |now, _| {
            let after = *path(&small, now, &pump)?.last()?;
            (sum(after) > sum(now)).then_some(after)
        });
        rounds.is_some_and(|after| after[0] >= before[0] && after[1] >= before[1])
    });
    let pt = pt(&small);
    let evidence =
        Evidence::Growth(crate::Growth { stem: names(&pt, &stem), pump: names(&pt, &pump) });
    let places = ["a", "b"].into_iter().zip(of).filter(|it| it.1);
    let question = Question::Unbounded { places: places.map(|it| it.0.to_string()).collect() };
    let said = accepts(&pt, question, true, evidence);
    assert!(said == grows);
    assert!(!said || small.reachable().is_none() && most(&small, of) >= 8);
    kani::cover!(said && stem.len() == 1 && pump.len() == 2, "two in turn, after a first one");
    kani::cover!(!said && !pump.is_empty() && most(&small, of) >= 8, "by something else");
}

fn names(pt: &Pt, fire: &[u32]) -> Vec<String> {
    fire.iter().map(|it| pt.transitions[*it as usize].clone()).collect()
}
