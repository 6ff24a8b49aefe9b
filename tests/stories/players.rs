//! The player against the textbook: on random nets and systems both do the same, firing by firing.

pub(crate) mod by_the_book;
mod games;
mod limits;
mod snapshots;
mod steps;

use by_the_book::{Act, Log, Played, Seen, delay, load, play_by_the_book, with_size_of};
use cotama_core::player::{Packed, Player};
use cotama_core::system::System;
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::Game;
use cotama_tests::textbook::nets::{Time, random_net};
use cotama_tests::textbook::systems::{OwnedSystem, random_system};

/// The nets of these seeds, alone.
fn nets(seeds: std::ops::Range<u64>, time: Time) -> impl Iterator<Item = (u64, OwnedSystem, Draw)> {
    seeds.map(move |seed| {
        let mut draw = Draw::new(seed);
        let net = random_net(&mut draw, time);
        (seed, OwnedSystem::alone(net), draw)
    })
}

/// So many systems that fit together, from this seed on.
fn systems(first: u64, count: usize) -> impl Iterator<Item = (u64, OwnedSystem, Draw)> {
    let systems = (first..).map(|seed| {
        let mut draw = Draw::new(seed);
        let system = random_system(&mut draw);
        (seed, system, draw)
    });
    systems.filter(|it| it.1.with(|it| it.defect().is_none())).take(count)
}

#[test]
fn events_are_answered_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(0..20_000, Time::Without) {
        let (draw, seen) = (&mut draw, &mut seen);
        net.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
    }
    seen.assert_enough();
}

#[test]
fn time_passes_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(100_000..120_000, Time::With) {
        let (draw, seen) = (&mut draw, &mut seen);
        net.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
    }
    seen.assert_enough();
    let timed = [seen.by_itself, seen.too_early, seen.too_late];
    assert!(timed.iter().all(|&it| it > 5_000), "{seen:?}");
}

/// Returns the events seen in so many sound systems, and how many more were not sound.
fn together(count: u64) -> (Seen, u64) {
    let mut seen = Seen::default();
    let mut last = 0;
    for (seed, system, mut draw) in systems(700_000, count as usize) {
        let (draw, seen) = (&mut draw, &mut seen);
        system.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
        last = seed;
    }
    (seen, last - 700_000 + 1 - count)
}

#[test]
fn nets_work_together_by_the_book() {
    assert!(together(2_000).1 > 10);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn nets_of_20_000_systems_work_together_by_the_book() {
    let (seen, unsound) = together(20_000);
    assert!(unsound > 100, "{unsound}");
    seen.assert_enough_together();
}

/// Plays the same events and rounds three times: told the time only with them, at every instant,
/// and whenever the player wants to be told. What fires, and when, is the same.
fn polling_makes_no_difference<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
    wakes: &mut u32,
) {
    let mut now = 0;
    let mut acts: Vec<(u64, Act)> = Vec::new();
    for _ in 0..30 {
        now += delay(draw);
        acts.push((now, Act::any(system, draw)));
    }
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = load(&packed, system, draw);
    let mut game = Game::start(system, 0);
    for &(at, act) in &acts {
        match act {
            Act::Offer(event, carries) => _ = game.offer(at, event, carries),
            Act::Round => _ = game.round(at),
            Act::Pass => game.advance(at),
        }
        if game.endless {
            return;
        }
    }
    let play = |until: &mut dyn FnMut(&mut Played<'_, W, C, S>, u64, &mut Log<'_>)| {
        let mut log = Log::new(system);
        let mut player: Played<'_, W, C, S> = Player::start(program, Millis(0), &mut log);
        let (mut outcomes, mut rounds) = (Vec::new(), Vec::new());
        for &(at, act) in &acts {
            until(&mut player, at, &mut log);
            let at = Millis(at);
            match act {
                Act::Offer(event, carries) => {
                    outcomes.push(player.offer_carrying(at, &event, carries, &mut log));
                }
                Act::Round => rounds.push(player.round_with(at, &mut log)),
                Act::Pass => assert!(!player.advance_with(at, &mut log).behind),
            }
        }
        (outcomes, rounds, log.told, player.now(), player.snapshot())
    };
    let late = play(&mut |_, _, _| ());
    let always = play(&mut |player, at, log| {
        for now in player.now().0..at {
            assert!(!player.advance_with(Millis(now), log).behind);
        }
    });
    let when_due = play(&mut |player, at, log| {
        // Until its round comes, a player whose round is due always wants to be told.
        while let Some(due) = player.wake_at().filter(|it| it.0 < at && !player.round_is_due()) {
            if due > player.now() {
                let (mut early, before) = (*player, Millis(due.0 - 1));
                assert_eq!(early.advance(before).fired, 0, "seed {seed}: at {before}");
            }
            let fired = player.advance_with(due, log).fired;
            if fired == 0 && !system.is_alone() {
                return; // it mails more at once than a mailbox holds, so it never can
            }
            assert_ne!(fired, 0, "seed {seed}: at {due}");
            *wakes += 1;
        }
    });
    assert_eq!(late, always, "seed {seed}");
    assert_eq!(late, when_due, "seed {seed}");
    assert_eq!(late.2, game.told, "seed {seed}");
}

#[test]
fn a_player_that_is_told_the_time_late_catches_up() {
    let mut wakes = 0;
    for (seed, net, mut draw) in nets(300_000..305_000, Time::With) {
        let (draw, wakes) = (&mut draw, &mut wakes);
        net.with(|it| with_size_of!(it, draw, polling_makes_no_difference(it, seed, draw, wakes)));
    }
    assert!(wakes > 10_000, "{wakes}");
}

#[test]
fn nets_that_are_told_the_time_late_catch_up_together() {
    assert!(catch_up_together(2_000) > 1_000);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn nets_of_20_000_systems_that_are_told_the_time_late_catch_up_together() {
    assert!(catch_up_together(20_000) > 10_000);
}

/// How often players of so many systems want to be told the time.
fn catch_up_together(count: usize) -> u32 {
    let mut wakes = 0;
    for (seed, system, mut draw) in systems(800_000, count) {
        let (draw, wakes) = (&mut draw, &mut wakes);
        system.with(|it| {
            with_size_of!(it, draw, polling_makes_no_difference(it, seed, draw, wakes));
        });
    }
    wakes
}
