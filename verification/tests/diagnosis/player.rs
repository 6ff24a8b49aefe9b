//! The player of the core fires what a diagnosis says.

use crate::diagnosis::{checked, nets, parse, timed};
use cotama_core::net::TransitionId;
use cotama_core::net::owned::OwnedNet;
use cotama_core::player::{Firing, Loaded, Outcome, Packed, Player, words};
use cotama_core::system::{Component, System};
use cotama_core::units::Millis;
use cotama_models::nets::find;
use cotama_verification::diagnosis::Run;
use cotama_verification::pt::Pt;
use cotama_verification::tpn;

/// More than any of these nets has.
const CLOCKS: usize = 16;

/// Plays a net: each firing of an event by offering it, all others by letting time pass. Compares
/// what fires, and the tokens in the end.
fn replay(net: &OwnedNet, run: &Run, dates: &[tpn::Step]) {
    let view = net.view();
    let net = view.net();
    match words(&System::alone(&[Component::alone(&net)])) {
        Some(1) => play::<1>(&net, run, dates),
        Some(2..=4) => play::<4>(&net, run, dates),
        other => panic!("{}: {other:?} words", net.name),
    }
}

fn play<const W: usize>(net: &cotama_core::net::Net<'_>, run: &Run, dates: &[tpn::Step]) {
    let pt = Pt::from(net);
    let packed = Packed::<W, CLOCKS>::alone(net).unwrap();
    let alone = [Component::alone(net)];
    let system = System::alone(&alone);
    let expected: Vec<TransitionId> = run.firings().collect();
    let mut fired = Vec::new();
    let mut observer = |it: &Firing<'_, Loaded<'_, W, CLOCKS>>| fired.push((it.id.id, it.at.0));
    let mut player = Player::<_, W, CLOCKS>::start(packed.load(&system), Millis(0), &mut observer);
    for (at, transition) in expected.iter().enumerate() {
        let now = dates.get(at).map(|it| {
            assert_eq!(it.date.per_unit, 1);
            Millis(it.date.parts)
        });
        if let Some(event) = net.transitions[transition.0 as usize].on {
            let outcome =
                player.offer_with(now.unwrap_or(player.now()), &event.into(), &mut observer);
            let is_it =
                matches!(outcome, Outcome::Fired { transition: it, .. } if it.id == *transition);
            assert!(is_it, "step {}: {outcome:?}", at + 1);
        } else {
            let until = now.or(player.wake_at()).unwrap_or(player.now());
            assert!(!player.advance_with(until, &mut observer).behind);
        }
    }
    let ids: Vec<TransitionId> = fired.iter().map(|it| it.0).collect();
    assert_eq!(ids[..expected.len()], expected, "{}", net.name);
    if let Some(last) = dates.last() {
        let times: Vec<u64> = fired.iter().map(|it| it.1).collect();
        let expected: Vec<u64> = dates.iter().map(|it| it.date.parts).collect();
        assert_eq!(times[..expected.len()], expected, "{}", net.name);
        // More can be due at the last instant.
        assert!(times[expected.len()..].iter().all(|it| *it == last.date.parts));
    } else {
        assert_eq!(ids.len(), expected.len(), "{}", net.name);
    }
    let mut last = pt.initial.clone();
    Run::to(ids).walk(&pt, |_, marking| last.copy_from_slice(marking)).unwrap();
    let place = |it| player.tokens(cotama_core::net::PlaceId(it));
    assert_eq!((0..last.len() as u32).map(place).collect::<Vec<_>>(), last, "{}", net.name);
}

#[test]
fn the_player_runs_into_every_counterexample() {
    let cases = [
        (nets::philosophers(), "AG !deadlock"),
        (nets::trains(), "AG !(west_in_section & east_in_section)"),
        (nets::mailbox(), "AG mailbox <= 3"),
        (nets::charger(), "AG !(on & hot)"),
        (nets::server(), "AG (request -> AF served)"),
        (nets::belts(), "AG belt_a + belt_b <= 3"),
    ];
    for (net, text) in cases {
        let pt = Pt::from(&net.view().net());
        let (holds, run) = checked(&pt, &parse(&pt, text));
        assert!(!holds);
        replay(&net, &run, &[]);
    }
}

#[test]
fn the_player_runs_into_every_counterexample_in_time() {
    let cases = [(nets::crossing(), "AG !(Walk & Green)"), (nets::watchdog(), "AG !overdue")];
    for (net, text) in cases {
        let (_, holds, schedule) = timed(&net, text);
        assert!(!holds);
        replay(
            &net,
            &Run::to(schedule.steps.iter().map(|it| it.transition).collect()),
            &schedule.steps,
        );
    }
}

#[test]
fn the_player_follows_witnesses_of_the_shipped_nets() {
    let cases = [
        ("watchdog", "EF Fault"),
        ("watchdog", "EF misses = 2"),
        ("charger", "EF Done"),
        ("charger", "EF (Fault & hot)"),
        ("crossing", "EF Walk"),
        ("door", "EF fireable(close)"),
    ];
    for (name, text) in cases {
        let net = find(name).unwrap();
        let text = if name == "door" {
            format!("EF {}", net.places.last().unwrap().name)
        } else {
            text.to_owned()
        };
        let (_, holds, schedule) = timed(&net, &text);
        assert!(holds);
        replay(
            &net,
            &Run::to(schedule.steps.iter().map(|it| it.transition).collect()),
            &schedule.steps,
        );
    }
}
