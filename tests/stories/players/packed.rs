//! What the player is given: every list of random nets and systems, packed, and what a play of them
//! tells.

use super::{Act, Log, Packed, Played, Player, Time, delay, nets, systems, with_size_of};
use crate::efforts::Effort;
use cotama_core::player::{Checked, code, is_state_machine};
use cotama_core::system::System;
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;

/// Notes the lists, and 20 acts.
fn note<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    draw: &mut Draw,
    effort: &mut Effort,
) {
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let code = packed.code();
    effort.note(&(code, code::size(system), code::size_of(system)));
    let program = packed.load(system);
    let (mut log, mut now) = (Log::new(system), 0);
    let mut player: Played<'_, W, C, S> = Player::start(program, Millis(now), &mut log);
    for _ in 0..20 {
        now += delay(draw);
        match Act::any(system, draw) {
            Act::Pass => effort.note(&player.advance_with(Millis(now), &mut log)),
            Act::Offer(event, carries) => {
                effort.note(&player.offer_carrying(Millis(now), &event, carries, &mut log));
            }
            Act::Round => effort.note(&player.round_with(Millis(now), &mut log)),
        }
        let marking = player.marking();
        effort.note(&(player.snapshot(), player.wake_at(), code.state(marking), code.is_alone()));
        for kind in 0..=usize::from(*code.events.last().unwrap()) + 2 * system.components.len() {
            effort.note(&code.row(kind, marking).map(<[_]>::len));
            effort.note(&code.ignores(marking, kind));
        }
        effort.count("fired", u64::from(player.wake_at().is_some()));
    }
    effort.count("told", log.told.len() as u64);
    effort.note(&log.told);
    let stored = player.snapshot();
    // What an observer of steps is told, too.
    let mut log = Log::new(system);
    let player: Player<_, W, C, S, u16> = Player::start(Checked(program), Millis(0), &mut log);
    effort.note(&(stored, player.snapshot(), log.told));
    effort.next();
}

#[test]
fn random_nets_are_packed_as_they_were() {
    let mut effort = Effort::new(100);
    for time in [Time::Without, Time::With] {
        for (_, net, mut draw) in nets(900_000..902_000, time) {
            let (draw, effort) = (&mut draw, &mut effort);
            net.with(|it| {
                effort.note(&it.components.iter().map(|it| is_state_machine(it.net)).next());
                with_size_of!(it, draw, note(it, draw, effort));
            });
        }
    }
    effort.compare("stories/players/packed_nets.txt");
}

#[test]
fn random_systems_are_packed_as_they_were() {
    let mut effort = Effort::new(50);
    for (_, system, mut draw) in systems(900_000, 1_000) {
        let (draw, effort) = (&mut draw, &mut effort);
        system.with(|it| with_size_of!(it, draw, note(it, draw, effort)));
    }
    effort.compare("stories/players/packed_systems.txt");
}
