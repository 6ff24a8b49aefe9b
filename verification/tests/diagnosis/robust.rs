//! Sequences that are no runs are refused, and no run or net leads to a panic or a wide line.

use crate::diagnosis::{nets, parse};
use cotama_core::net::TransitionId;
use cotama_verification::diagnosis::{Case, Diagnosis, NotARun, Run};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::Rest;
use cotama_verification::tpn::Schedule;

/// Returns the rest of a run: the cycle fired for ever, or a deadlock.
fn rest(cycle: Option<Vec<TransitionId>>) -> Rest {
    match cycle {
        None => Rest::Any,
        Some(cycle) if cycle.is_empty() => Rest::Stays,
        Some(cycle) => Rest::Cycle(cycle),
    }
}

fn diagnosed(cycle: Option<&[u32]>, stem: &[u32]) -> Result<Diagnosis, NotARun> {
    let pt = Pt::from(&nets::server().view().net());
    let property = parse(&pt, "AF served");
    let ids = |all: &[u32]| all.iter().map(|it| TransitionId(*it)).collect();
    let run = Run { stem: ids(stem), rest: rest(cycle.map(ids)) };
    Diagnosis::new(&Case::new(&pt, &property, false, &run))
}

#[test]
fn a_sequence_that_is_no_run_is_refused_with_its_place() {
    let error = |cycle, stem| diagnosed(cycle, stem).unwrap_err().to_string();
    assert_eq!(error(None, &[0, 3, 3]), "firing 3: `serve` is not enabled there");
    assert_eq!(error(None, &[9]), "firing 1 is of a transition that the net does not have");
    assert_eq!(
        error(Some(&[1]), &[0]),
        "the cycle does not lead back to the marking in which it begins"
    );
    assert_eq!(error(Some(&[]), &[0]), "the run does not end in a deadlock: `poll` can fire there");
    assert!(diagnosed(Some(&[1, 2]), &[]).is_ok());
}

#[test]
fn a_net_or_dates_of_something_else_are_refused() {
    let (server, trains) = (nets::server(), nets::trains());
    let (server, trains) = (server.view(), trains.view());
    let pt = Pt::from(&server.net());
    let property = parse(&pt, "AG !request");
    let run = Run::to(vec![TransitionId(0)]);
    let case = Case::new(&pt, &property, false, &run);
    assert_eq!(Diagnosis::new(&case.with_net(&trains.net())), Err(NotARun::Net));
    assert_eq!(Diagnosis::new(&case.with_schedule(&Schedule::default())), Err(NotARun::Dates));
}

#[test]
fn a_run_that_shows_nothing_is_said_to_be_a_part() {
    let it = diagnosed(None, &[0, 3]).unwrap();
    assert_eq!(it.cause, "this run is a part of the reason: one run does not show all of it.");
}

#[test]
fn no_line_is_wider_than_a_hundred_characters() {
    let long = "a_name_that_goes_on_and_on_".repeat(9);
    let other = format!("{long} with spaces\nand lines");
    let places = [(long.as_str(), 1, "A doc that goes on. "), (other.as_str(), 0, "x")];
    let mut net = nets::Sketch::new(&long, &"doc ".repeat(80), &places);
    net = net.line(&long, &format!("{long} ->"), &long, &other);
    let pt = Pt::from(&net.0.view().net());
    let property = parse(&pt, "AF false");
    for stem in [vec![], vec![TransitionId(0)]] {
        let run = Run::to(stem);
        let view = net.0.view();
        let core = view.net();
        let case = Case::new(&pt, &property, false, &run);
        for it in [Diagnosis::new(&case).unwrap(), Diagnosis::new(&case.with_net(&core)).unwrap()] {
            let text = it.to_string();
            assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
            assert!(text.lines().all(|line| line == line.trim_end()), "{text}");
        }
    }
}

#[test]
fn every_kind_of_formula_is_explained_on_every_run() {
    let atoms = [
        "request",
        "!served",
        "idle + polling <= 1",
        "fireable(serve)",
        "deadlock",
        "2 * quiet >= served",
    ];
    let forms = [
        "AG (a -> AF b)",
        "EF (a & EG b)",
        "E[a U b]",
        "A[a U b]",
        "AX a",
        "EX EX b",
        "A (G F a)",
        "A (F G b)",
        "A (G F a -> G F b)",
        "AG EF a",
        "AF<=100ms b",
        "a | EG !b",
        "AG a <-> AG b",
    ];
    let pt = Pt::from(&nets::server().view().net());
    let runs = [
        (vec![], None),
        (vec![0], None),
        (vec![0, 3, 4], None),
        (vec![0], Some(vec![1, 2])),
        (vec![], Some(vec![0, 3, 4])),
    ];
    let ids = |all: &[u32]| all.iter().map(|it| TransitionId(*it)).collect::<Vec<_>>();
    let mut explained = 0;
    for form in forms {
        for (at, a) in atoms.iter().enumerate() {
            let b = atoms[(at + 1) % atoms.len()];
            let text: String = form
                .chars()
                .map(|c| match c {
                    'a' => format!("({a})"),
                    'b' => format!("({b})"),
                    other => other.to_string(),
                })
                .collect();
            let property = parse(&pt, &text);
            for (stem, cycle) in &runs {
                let run = Run { stem: ids(stem), rest: rest(cycle.as_deref().map(ids)) };
                for holds in [false, true] {
                    let it = Diagnosis::new(&Case::new(&pt, &property, holds, &run)).unwrap();
                    assert!(
                        !it.summary.is_empty() && it.summary.matches('`').count().is_multiple_of(2),
                        "{}",
                        it.summary
                    );
                    assert!(
                        !it.to_string().is_empty()
                            && !it.html().is_empty()
                            && !it.json().is_empty()
                    );
                    explained += 1;
                }
            }
        }
    }
    assert_eq!(explained, 13 * 6 * 5 * 2);
}
