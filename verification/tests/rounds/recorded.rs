//! A recording is a run of what was played, and with one line changed it is none.

use crate::conformance::Draw;
use cotama_core::net::EventId;
use cotama_core::player::{Loaded, Packed, Player, Recorder};
use cotama_core::system::{Component, Of, System};
use cotama_core::units::Millis;
use cotama_models::nets::by_hand::delivery;
use cotama_models::nets::{charger, crossing, door, watchdog};
use cotama_verification::conform::{Options, Recording, Verdict, conform};

const SLOTS: usize = 64;

/// A random run of a system, as a recorder writes it.
fn run(system: &System<'_>, draw: &mut Draw, steps: u32, rounds: u32) -> String {
    let packed = Packed::<16, 16, SLOTS>::of(system).unwrap();
    let mut recorder = Recorder::new(String::new());
    let start = Millis(draw.below(3).into());
    let mut player: Player<Loaded<'_, 16, 16, SLOTS>, 16, 16, SLOTS> =
        recorder.start(packed.load(system), start);
    let events: Vec<Of<EventId>> = (0_u16..)
        .zip(system.components)
        .flat_map(|(component, it)| {
            (0..it.net.events.len() as u32).map(move |id| Of { component, id: EventId(id) })
        })
        .filter(|it| system.delivery(*it).is_none())
        .collect();
    let mut now = start.0;
    for _ in 0..steps {
        now += [0, 1, 7, 40, 100, 1_000, 9_000][draw.below(7) as usize];
        match draw.below(6) {
            0 => _ = recorder.advance(&mut player, Millis(now)),
            _ if events.is_empty() => _ = recorder.advance(&mut player, Millis(now)),
            _ => {
                let event = events[draw.below(events.len() as u32) as usize];
                let _ = recorder.offer(&mut player, Millis(now), &event);
            }
        }
        if draw.below(rounds) == 0 {
            let _ = recorder.round(&mut player, Millis(now));
        }
    }
    recorder.finish(&mut player, Millis(now + u64::from(draw.below(500))));
    assert!(!recorder.is_cut());
    recorder.into_inner()
}

fn judged(system: &System<'_>, text: &str) -> Verdict {
    let recording = Recording::read("log", text).unwrap_or_else(|it| panic!("{it}\n{text}"));
    conform(system, &recording, Options::default()).unwrap()
}

fn with_nets(then: &mut dyn FnMut(&System<'_>)) {
    let nets = [&charger::NET, &crossing::NET, &door::NET, &watchdog::NET];
    for net in nets {
        then(&System::alone(&[Component::alone(net)]));
    }
    then(&delivery::SYSTEM);
}

#[test]
fn a_recorded_run_of_any_shipped_net_and_system_is_accepted() {
    let (mut runs, mut lines) = (0, 0);
    with_nets(&mut |system| {
        for seed in 0..40 {
            let mut draw = Draw(seed);
            let text = run(system, &mut draw, 60, 1 + (seed as u32) % 4);
            let verdict = judged(system, &text);
            assert_eq!(verdict.departs, None, "{} {seed}\n{text}", system.name);
            let count = |kind: &str| text.matches(kind).count() as u64;
            assert_eq!(verdict.fired, count("\"fired\""), "{} {seed}", system.name);
            assert_eq!(verdict.outputs, count("\"output\""), "{} {seed}", system.name);
            (runs, lines) = (runs + 1, lines + text.lines().count());
        }
    });
    assert!(runs == 200 && lines > 10_000, "{runs} {lines}");
}

/// A firing or an output that is called otherwise, comes a second later or is left out.
#[test]
fn a_recorded_run_with_one_line_changed_is_refused() {
    let mut changed = 0;
    with_nets(&mut |system| {
        let names: Vec<_> = system.components[0].net.transitions.iter().map(|it| it.name).collect();
        for seed in 0..10 {
            let mut draw = Draw(seed);
            let text = run(system, &mut draw, 30, 1);
            let lines: Vec<_> = text.lines().collect();
            let answers = (0..lines.len()).filter(|&at| lines[at].contains("\"fired\""));
            for at in answers {
                let with = |line: Option<String>| {
                    let before = lines[..at].iter().map(|it| (*it).to_owned());
                    let after = lines[at + 1..].iter().map(|it| (*it).to_owned());
                    before.chain(line).chain(after).collect::<Vec<_>>().join("\n")
                };
                let own = lines[at].rsplit('"').nth(1).unwrap();
                let prefix = if system.is_alone() {
                    String::new()
                } else {
                    format!("{}.", system.components[0].name)
                };
                let other = names.iter().map(|it| format!("{prefix}{it}")).find(|it| it != own);
                let other =
                    other.map(|it| lines[at].replace(&format!("\"{own}\""), &format!("\"{it}\"")));
                let edits = [Some(with(None)), other.map(|it| with(Some(it)))];
                for text in edits.into_iter().flatten() {
                    assert!(judged(system, &text).departs.is_some(), "{}: {text}", system.name);
                    changed += 1;
                }
            }
        }
    });
    assert!(changed > 1_000, "{changed}");
}
