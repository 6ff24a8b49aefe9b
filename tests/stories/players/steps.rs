//! Synchronous steps go by the book.

use super::{Log, Packed, delay, nets, with_size_of};
use cotama_core::net::EventId;
use cotama_core::player::{Checked, Player};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::nets::{Time, one_in};
use cotama_tests::textbook::{Game, Told};

/// Plays 50 steps, with an offer in between now and then.
fn steps_are_those_of_the_book<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
    seen: &mut [u32; 3],
) {
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = Checked(packed.load(system));
    let (mut log, mut now) = (Log::new(system), 0);
    let mut player: Player<_, W, C, S, u16> = Player::start(program, Millis(now), &mut log);
    let mut game = Game::start(system, now);
    let kinds = system.components[0].net.events.len() as u64;
    for _ in 0..50 {
        if game.endless {
            return;
        }
        assert_eq!(log.told, game.told, "seed {seed}");
        assert_eq!(player.wake_at(), game.wake_at().map(Millis), "seed {seed}");
        now += delay(draw) / 2;
        let some = if kinds == 0 { 0 } else { draw.between(0, 4) };
        let event = |_| EventId(draw.between(0, kinds - 1) as u32);
        let events: Vec<EventId> = (0..some).map(event).collect();
        if let Some(&event) = events.first().filter(|_| one_in(draw, 16)) {
            let event = Of::from(event);
            let outcome = player.offer_carrying(Millis(now), &event, 5, &mut log);
            let by_the_book = game.offer(now, event, 5);
            assert!(game.endless || outcome == by_the_book, "seed {seed}");
            continue;
        }
        let before = game.clone();
        let offered: Vec<Of<EventId>> = events.iter().map(|&it| it.into()).collect();
        let step = player.step_with(Millis(now), &offered, &mut log);
        assert_eq!(step, game.step(now, &events), "seed {seed}");
        seen[0] += u32::from(step.full);
        seen[1] += u32::from(step.fired > 1);
        seen[2] += u32::from(step.ignored.count_ones() > 1);
        if step.full {
            assert_eq!(game.state, before.state);
            assert_eq!(step.ignored.count_ones() as usize, events.len());
        }
        is_one_of_the_interleavings(before, &game, seed);
    }
}

/// Checks that the transitions of a step can also fire one after another, and come to the same
/// marking.
fn is_one_of_the_interleavings(mut before: Game<'_>, after: &Game<'_>, seed: u64) {
    for told in &after.told[before.told.len()..] {
        let Told::Fired(id, ..) = *told else { panic!("in a step transitions fire") };
        let line = before.book.lines.iter().position(|it| it.id == id).unwrap();
        assert!(before.force(line), "seed {seed}: {id:?} is not enabled");
    }
    assert_eq!(before.state.tokens, after.state.tokens, "seed {seed}");
}

#[test]
fn steps_go_by_the_book() {
    let mut seen = [0; 3];
    for time in [Time::Without, Time::With] {
        for (seed, net, mut draw) in nets(200_000..200_000 + 10_000, time) {
            let (draw, seen) = (&mut draw, &mut seen);
            net.with(|it| {
                with_size_of!(it, draw, steps_are_those_of_the_book(it, seed, draw, seen));
            });
        }
    }
    assert!(seen.iter().all(|&it| it > 5_000), "{seen:?}");
}
